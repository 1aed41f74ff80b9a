/// @file
/// The harness of the reference's subcommands. Each says what it draws beyond a
/// random machine, how it judges that, and which rows it counts in; the loop
/// over machines, the report and the exit code are the harness's.
#ifndef REFERENCE_CLASSES_H
#define REFERENCE_CLASSES_H

#include "draw.h"

/// What the command line asks for.
typedef struct {
  long machines, first;
  uint64_t seed;
  draw_range_t range;
  double t_end;          ///< 0: that of the class
  long show;             ///< replay commands printed for each count
  lib_machine_t machine; ///< that of replay
} options_t;

/// A machine to judge; a class may change it and the time on the way.
typedef struct {
  const options_t *options;
  long index;
  draw_t draw;
  lib_machine_t machine;
  double t_end;
} trial_t;

/// A subcommand.
typedef struct {
  const char *name, *about; ///< about NULL: neither listed nor announced
  long machines;
  double t_end;
  void (*begin)(void);                     ///< adds the rows; may be NULL
  void (*judge)(trial_t *trial);           ///< one machine; may be NULL
  int (*finish)(const options_t *options); ///< exit code; NULL: 0
} class_t;

/// Announced and parsed by main.c; returns the exit code.
int class_run(const class_t *class, const options_t *options);

/// A row of the report: offenders among tries.
typedef struct {
  char what[96], note[96]; ///< note: a line below, "" for none
  const char *scheme;      ///< that replays an offender
  bool shows;              ///< prints the command of the first offenders
  long hits, tries, shown;
} count_t;

/// Next row. Its offenders are those of tf_step.
count_t *count_add(bool shows, const char *what);
/// Counts one try; NULL counts nothing.
void count_try(count_t *count, const trial_t *trial, bool hit);

/// Runs of the library that a class compares: each scheme in double, or in both
/// real types, at some steps.
enum { RUNS = 12 };
typedef struct {
  int reals, dts;
  double dt[3];       ///< none: that of the machine
  const char *before; ///< words before dt in the name of a run
  const char *group;  ///< and before all; NULL: none
} runs_t;
typedef struct {
  lib_scheme_t scheme;
  const lib_table_t *real;
  double dt;
} run_t;

int runs_count(const runs_t *runs);
run_t runs_at(const runs_t *runs, int k);
/// Next row, named by run k.
count_t *count_run(const runs_t *runs, int k, bool shows, const char *kind);
/// A row for each run.
void count_runs(count_t *counts[RUNS], const runs_t *runs, bool shows,
                const char *kind);
/// Run k of a machine to its end, with the machine's dt set; returns how many
/// steps did not say OK, or -1 where the library refused.
long trial_run(trial_t *trial, const runs_t *runs, int k, lib_row_t *row);

/// Orbit of the reference at the start of a machine, by the hexagon.
ref_orbit_t class_orbit(const lib_machine_t *machine, ref_machine_t *q,
                        const lib_table_t *real);
/// Largest difference of r [m], v [m/s], w [rad/s], each against its own size
/// or that of the machine.
double class_difference(const ref_machine_t *q, ref_state_t x,
                        const lib_row_t *row);
double class_distance(const ref_machine_t *q, ref_state_t a, ref_state_t b);
/// Runs to the end at the orbit's tolerance and at a coarser one, which judges
/// it; returns how far they are apart.
double class_doubt(ref_orbit_t *orbit, real_t end, ref_stop_t *coarse);

extern const class_t class_validate, class_second, class_signs, class_grid,
    class_rest_law, class_false_rest, class_branch, class_path, class_rounding,
    class_energy, class_impulses, class_standing, class_replay;
/// The machine of replay, before --set.
extern const lib_machine_t replay_machine;

#endif
