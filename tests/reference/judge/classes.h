/// @file
/// The subcommands of the reference: its own validation, and one for each
/// class of wrong step that is counted.
#ifndef REFERENCE_CLASSES_H
#define REFERENCE_CLASSES_H

#include "draw.h"

/// What the command line asks for.
typedef struct {
  long machines, first;
  uint64_t seed;
  draw_range_t range;
  double t_end; ///< 0: that of the class
  long show;    ///< replay commands printed for each count
} options_t;

/// A count of offenders among tries.
typedef struct {
  const char *what;
  long hits, tries;
  long shown;
} count_t;

/// Counts one try; prints the replay command of the first offenders.
void count_try(count_t *count, bool hit, const options_t *options, long index,
               const lib_machine_t *machine, double t_end, const char *scheme);
/// One line: hits, tries, rate and its 95 % interval (Wilson).
void count_print(const count_t *count);
/// Orbit of the reference at the start of a machine, by the bow tie.
ref_orbit_t class_orbit(const lib_machine_t *machine, ref_machine_t *q,
                        const lib_table_t *real);
/// Largest difference of r [m], v [m/s], w [rad/s], each against its own size
/// or that of `scale`.
double class_difference(const ref_machine_t *q, ref_state_t x,
                        const lib_row_t *row);

/// Runs the library for so many steps; returns how many did not say OK, or -1
/// where it refused.
long class_steps(const lib_table_t *real, lib_t *lib, long steps,
                 lib_row_t *row);
/// Opens and runs to time `end`, as class_steps.
long class_run(const lib_table_t *real, const lib_machine_t *machine,
               lib_scheme_t scheme, double end, lib_row_t *row);

int class_validate(const options_t *options);
int class_second(const options_t *options);
int class_replay(const options_t *options, int argc, char **argv);
int class_signs(const options_t *options);
int class_grid(const options_t *options);
int class_rest_law(const options_t *options);
int class_false_rest(const options_t *options);
int class_branch(const options_t *options);
int class_path(const options_t *options);
int class_rounding(const options_t *options);
int class_energy(const options_t *options);
int class_impulses(const options_t *options);
int class_standing(const options_t *options);

#endif
