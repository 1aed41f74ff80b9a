// Outcomes: what is left of a motion when its rows are not kept. All are of the
// steps themselves, so they agree with what `run` prints of the same motion.

#include "measure.h"

#include <math.h>
#include <string.h>

#include "../setup/names.h"

const cli_measure_info_t cli_measures[CLI_MEASURES] = {
    [CLI_MODES] = {"modes", "", "the modes visited, in a fixed order"},
    [CLI_FINAL] = {"final", "", "the mode at the end"},
    [CLI_CHANGES] = {"changes", "1", "number of changes of mode"},
    [CLI_REST] = {"rest", "s", "since when the wheel is pinned, to the end"},
    [CLI_ARRIVALS] = {"arrivals", "1", "number of arrivals at the two-fold"},
    [CLI_ARRIVAL] = {"arrival", "s", "time of the first of them"},
    [CLI_RECURRENCE] = {"recurrence", "s", "mean time from one to the next"},
    [CLI_AMBIGUOUS] = {"ambiguous", "s", "first instant with several futures"},
    [CLI_AMBIGUOUS_SHARE] = {"ambiguous_share", "1",
                             "share of steps with several futures"},
    [CLI_STICK_SHARE] = {"stick_share", "1", "share of steps without slip"},
    [CLI_ENERGY] = {"energy", "J", "mechanical energy at the end"},
    [CLI_ENERGY_CHANGE] = {"energy_change", "J", "that less the one at t = 0"},
    [CLI_R_LOW] = {"r_low", "m", "least r"},
    [CLI_R_HIGH] = {"r_high", "m", "largest r"},
    [CLI_END_R] = {"end_r", "m", "state at the end"},
    [CLI_END_V] = {"end_v", "m/s", ""},
    [CLI_END_OMEGA] = {"end_omega", "rad/s", ""},
    [CLI_END_H] = {"end_h", "m/s", ""},
    [CLI_END_G] = {"end_g", "m/s", ""},
};

void cli_course_begin(cli_course_t *course, const tf_state_t *state,
                      const tf_report_t *report) {
  memset(course, 0, sizeof *course);
  course->state = *state;
  course->report = *report;
  course->modes = TF_MODE_BIT(report->mode);
  course->r_low = course->r_high = (double)state->r;
  cli_ambiguity_begin(&course->ambiguity, report);
}

void cli_course_see(cli_course_t *course, double t, const tf_state_t *state,
                    const tf_report_t *report) {
  const uint64_t arrivals = course->events.counts[CLI_TWO_FOLD];
  cli_events_observe(&course->events, &course->report, report, state, t);
  if (course->events.counts[CLI_TWO_FOLD] > arrivals) {
    course->first_arrival = arrivals == 0 ? t : course->first_arrival;
    course->last_arrival = t;
  }
  if (report->mode == TF_PINNED && course->report.mode != TF_PINNED) {
    course->pinned_since = t;
  }
  cli_ambiguity_see(&course->ambiguity, report, t);
  course->steps++;
  course->t = t;
  course->modes |= TF_MODE_BIT(report->mode);
  course->changes += report->mode != course->report.mode;
  course->stuck += !cli_is_slip(report->mode);
  course->r_low = fmin(course->r_low, (double)state->r);
  course->r_high = fmax(course->r_high, (double)state->r);
  course->state = *state;
  course->report = *report;
}

static void add_modes(unsigned modes, cli_buffer_t *text) {
  const char *separator = "";
  for (unsigned mode = 0; mode < TF_MODES; mode++) {
    if ((modes & TF_MODE_BIT(mode)) != 0) {
      cli_add(text, separator);
      cli_add(text, tf_mode_name(mode));
      separator = "|";
    }
  }
}

// The number, NaN where there is none. A share is one of all steps; there is
// none without a step.
static double number_of(cli_measure_t measure, const cli_course_t *course) {
  const double none = (double)NAN, steps = (double)course->steps;
  const uint64_t arrivals = course->events.counts[CLI_TWO_FOLD];
  const bool rests = course->report.mode == TF_PINNED;
  const double between = course->last_arrival - course->first_arrival;
  const double values[CLI_MEASURES] = {
      [CLI_REST] = rests ? course->pinned_since : none,
      [CLI_ARRIVAL] = arrivals > 0 ? course->first_arrival : none,
      [CLI_RECURRENCE] = arrivals > 1 ? between / (double)(arrivals - 1) : none,
      [CLI_AMBIGUOUS] = course->ambiguity.since,
      [CLI_AMBIGUOUS_SHARE] = (double)course->ambiguity.steps / steps,
      [CLI_STICK_SHARE] = (double)course->stuck / steps,
      [CLI_ENERGY] = course->energy,
      [CLI_ENERGY_CHANGE] = course->energy - course->energy_at_start,
      [CLI_R_LOW] = course->r_low,
      [CLI_R_HIGH] = course->r_high,
      [CLI_END_R] = (double)course->state.r,
      [CLI_END_V] = (double)course->state.v,
      [CLI_END_OMEGA] = (double)course->state.w,
      [CLI_END_H] = (double)course->report.slip.h,
      [CLI_END_G] = (double)course->report.slip.g,
  };
  return values[measure];
}

void cli_measure_add(cli_measure_t measure, const cli_course_t *course,
                     cli_buffer_t *text) {
  if (measure == CLI_MODES) {
    add_modes(course->modes, text);
  } else if (measure == CLI_FINAL) {
    cli_add(text, tf_mode_name(course->report.mode));
  } else if (measure == CLI_CHANGES) {
    cli_add_count(text, course->changes);
  } else if (measure == CLI_ARRIVALS) {
    cli_add_count(text, course->events.counts[CLI_TWO_FOLD]);
  } else {
    const double value = number_of(measure, course);
    if (isfinite(value)) {
      cli_add_real(text, (tf_real_t)value);
    }
  }
}
