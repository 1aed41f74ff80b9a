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
  double t_end;          ///< 0: that of the class
  long show;             ///< commands printed for each count
  const char *row, *dts; ///< of table: its class, steps instead of its own
  long jobs;             ///< of table: processes
} options_t;

/// A machine to judge; a class may change it and the time on the way.
typedef struct {
  const options_t *options;
  const struct class *class;
  long index;
  draw_t draw;
  lib_machine_t machine;
  double t_end;
} trial_t;

/// A subcommand.
typedef struct class {
  const char *name, *about;
  long machines;
  double t_end;
  void (*begin)(const struct class *class); ///< adds the rows; may be NULL
  void (*judge)(trial_t *trial);            ///< one machine; may be NULL
  int (*finish)(const options_t *options);  ///< exit code; NULL: 0
} class_t;

/// Announced and parsed by main.c; returns the exit code.
int class_run(const class_t *class, const options_t *options);

/// A row of the report: offenders among tries.
typedef struct {
  char what[96];
  const char *scheme; ///< that replays an offender
  bool shows;         ///< prints how to replay the first offenders
  long hits, tries, shown;
} count_t;

/// Next row. Its offenders are those of tf_step.
count_t *count_add(bool shows, const char *what);
/// Counts one try.
void count_try(count_t *count, const trial_t *trial, bool hit);

/// Runs of the library that a class compares: each scheme in double, or in both
/// real types, at some steps.
enum { RUNS = 12 };
typedef struct {
  int reals, dts;
  double located;    ///< of dt, in located steps
  double dt[3];      ///< 0: that of the machine
  const char *group; ///< first words of the name of a run
} runs_t;
typedef struct {
  lib_scheme_t scheme;
  const lib_table_t *real;
  double dt;
} run_t;

int runs_count(const runs_t *runs);
run_t runs_at(const runs_t *runs, int k);
/// A row that shows for each run, named by it.
void count_runs(count_t *counts[RUNS], const runs_t *runs, const char *kind);
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

extern const class_t class_validate, class_second, class_branch, class_energy,
    class_table;

#endif
