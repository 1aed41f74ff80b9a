// Events are determined from consecutive reports alone, so that a recorded run
// would show the same ones:
//
//   slip to stick, stick to slip, slip to slip, pinned to stick: the mode
//     changed. The two remaining changes, stick to pinned and stick to stick,
//     are codimension two, so that no change of mode is missed.
//   codimension two: h and g vanish within one step. The wheel becomes pinned,
//     or stick changes its sign, or g changes its sign as stick begins or ends.
//   two-fold: in stick, where the Delassus scalar vanishes, both vector fields
//     are tangent to h = 0. It is reached where stick of one sign goes on while
//     the scalar changes from + to -, or where that stick ends in the very step
//     in which the scalar does so, with g of the same sign.
//   returned: the first stick in a sliding region after a two-fold.

#include "events.h"

#include "../setup/setup.h"

static bool changes_sign(tf_real_t a, tf_real_t b) {
  return (a > 0 && b < 0) || (a < 0 && b > 0);
}

static bool is_codimension_two(const tf_report_t *before,
                               const tf_report_t *after) {
  if (after->mode == TF_PINNED) return before->mode != TF_PINNED;
  if (cli_is_stick(before->mode) && cli_is_stick(after->mode))
    return before->mode != after->mode;
  return cli_is_stick(before->mode) != cli_is_stick(after->mode) &&
         before->mode != TF_PINNED &&
         changes_sign(before->slip.g, after->slip.g);
}

static bool is_two_fold(const tf_report_t *before, const tf_report_t *after) {
  if (!cli_is_stick(before->mode) || !(before->delassus > 0) ||
      after->delassus > 0)
    return false;
  if (cli_is_stick(after->mode)) return before->mode == after->mode;
  return tf_mode_is_slip(after->mode) &&
         !changes_sign(before->slip.g, after->slip.g);
}

// If there is no memory left the list ends there, so that it has no gap.
static cli_event_t *new_event(cli_events_t *events) {
  if (events->used >= events->limit) return NULL;
  cli_event_t *list =
      cli_grow(events->list, events->used, &events->room, sizeof *list);
  if (list == NULL) {
    events->limit = events->used;
    return NULL;
  }
  events->list = list;
  return &events->list[events->used++];
}

static unsigned kinds_between(const tf_report_t *before,
                              const tf_report_t *after) {
  unsigned kinds = 0;
  if (is_two_fold(before, after)) kinds |= 1u << CLI_TWO_FOLD;
  if (before->mode == after->mode) return kinds;
  if (tf_mode_is_slip(before->mode) && tf_mode_is_slip(after->mode))
    kinds |= 1u << CLI_SLIP_TO_SLIP;
  else if (tf_mode_is_slip(before->mode))
    kinds |= 1u << CLI_SLIP_TO_STICK;
  else if (tf_mode_is_slip(after->mode))
    kinds |= 1u << CLI_STICK_TO_SLIP;
  else if (before->mode == TF_PINNED)
    kinds |= 1u << CLI_PINNED_TO_STICK;
  if (is_codimension_two(before, after)) kinds |= 1u << CLI_CODIMENSION_TWO;
  return kinds;
}

void cli_events_begin(cli_events_t *events, uint64_t limit,
                      const tf_report_t *start) {
  const double choices = start != NULL ? start->choices : (double)NAN;
  *events =
      (cli_events_t){.limit = limit,
                     .choices_at_start = choices,
                     .ambiguous_since = choices > 1 ? 0 : (double)NAN,
                     .set = start != NULL && choices > 1 ? start->set : 0};
}

tf_report_t cli_before_change(const tf_report_t *before,
                              const tf_located_change_t *change) {
  const tf_report_t *after = &change->report;
  const bool away = fabs((double)after->slip.g) > (double)TF_REAL_MIN;
  tf_report_t report = *before;
  report.slip.g = away ? after->slip.g : -after->slip.g;
  if (away && tf_mode_is_slip(after->mode)) report.force = after->force;
  return report;
}

void cli_events_observe(cli_events_t *events, const tf_report_t *before,
                        const tf_report_t *after, const tf_state_t *state,
                        double t) {
  unsigned kinds = kinds_between(before, after);
  if (after->choices > 1) {
    events->ambiguous++;
    events->ambiguous_since = fmin(events->ambiguous_since, t); // NAN loses
    if (events->set == 0) events->set = after->set;
  }
  if (kinds == 0) return;
  const bool winds = events->away && kinds == 1u << CLI_SLIP_TO_SLIP;
  events->windings += winds;
  if (kinds >> CLI_TWO_FOLD & 1u) {
    events->away = true;
    events->windings = 0;
  } else if (events->away && before->mode != after->mode &&
             cli_is_stick(after->mode) && after->delassus > 0) {
    events->away = false;
    kinds |= 1u << CLI_RETURNED;
  }
  events->steps++;
  for (unsigned kind = 0; kind < CLI_EVENT_KINDS; kind++)
    events->counts[kind] += (kinds >> kind) & 1u;
  if (winds && events->limit < UINT64_MAX) {
    events->merged++;
    return;
  }
  cli_event_t *event = new_event(events);
  if (event == NULL) return;
  event->merged = events->merged;
  events->merged = 0;
  event->windings = events->windings;
  event->kinds = kinds;
  event->from = before->mode;
  event->to = after->mode;
  event->arrival = events->counts[CLI_TWO_FOLD];
  event->t = t;
  event->r = (double)state->r;
  event->omega = (double)state->w;
  event->g = (double)after->slip.g;
  if (fabs(event->g) <= (double)TF_REAL_MIN) event->g = 0;
  event->lambda = !tf_mode_is_slip(after->mode)    ? (double)after->force.F
                  : !tf_mode_is_slip(before->mode) ? (double)before->force.F
                                                   : (double)NAN;
}
