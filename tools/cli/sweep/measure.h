/// @file
/// The outcomes that `sweep` knows, and what a motion shows of them.
#ifndef TWOFOLD_CLI_MEASURE_H
#define TWOFOLD_CLI_MEASURE_H

#include "../run/events.h"
#include "../text/buffer.h"
#include "twofold.h"

typedef enum {
  CLI_MODES,
  CLI_FINAL,
  CLI_CHANGES,
  CLI_REST,
  CLI_ARRIVALS,
  CLI_ARRIVAL,
  CLI_RECURRENCE,
  CLI_AMBIGUOUS,
  CLI_AMBIGUOUS_SHARE,
  CLI_STICK_SHARE,
  CLI_ENERGY,
  CLI_ENERGY_CHANGE,
  CLI_R_LOW,
  CLI_R_HIGH,
  CLI_END_R,
  CLI_END_V,
  CLI_END_OMEGA,
  CLI_END_H,
  CLI_END_G
} cli_measure_t;
#define CLI_MEASURES 19

/// Name of a column, unit ("" of what is not a number), and what it is.
typedef struct {
  const char *name, *unit, *what;
} cli_measure_info_t;
extern const cli_measure_info_t cli_measures[CLI_MEASURES];

/// What was seen of a motion so far. All zero but for the first report, the
/// energy, and r at the start.
typedef struct {
  uint64_t steps; ///< seen
  double t;       ///< [s], after them
  tf_state_t state;
  tf_report_t report; ///< of the last step
  cli_events_t events;
  unsigned modes; ///< bits TF_MODE_BIT
  uint64_t changes, stuck;
  cli_ambiguity_t ambiguity;
  double pinned_since;                ///< [s], of the last time
  double first_arrival, last_arrival; ///< at the two-fold [s]
  double energy, energy_at_start;     ///< [J]
  double r_low, r_high;               ///< [m]
} cli_course_t;

void cli_course_begin(cli_course_t *course, const tf_state_t *state,
                      const tf_report_t *report);

/// Sees a step. t: its end [s].
void cli_course_see(cli_course_t *course, double t, const tf_state_t *state,
                    const tf_report_t *report);

void cli_measure_add(cli_measure_t measure, const cli_course_t *course,
                     cli_buffer_t *text);

#endif
