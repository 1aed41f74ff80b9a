// Events are read off consecutive reports and nothing else, so that a recorded
// run would show the same ones. What is to be seen:
//
//   slip to stick, stick to slip, slip to slip, pinned to stick: the mode
//     changed. The two changes that are left, stick to pinned and stick to
//     stick, are codimension two: no change of mode goes unseen.
//   codimension two: h and g vanish within one step. The wheel is pinned, or
//     stick changes its sign, or g changes its sign where stick begins or ends.
//   two-fold: in stick, both vector fields are tangent to h = 0 where the
//     Delassus scalar vanishes. It is reached where a stick of one sign goes on
//     while the scalar turns from + to -; or where the stick is left in the
//     very step in which it does so, at the same sign of g.
//   returned: after that, the first stick that attracts.

#include "events.h"

#include <inttypes.h>
#include <stdlib.h>

static bool is_slip(unsigned mode) { return mode <= TF_SLIP_MINUS; }

static bool is_stick(unsigned mode) {
  return mode == TF_STICK_PLUS || mode == TF_STICK_MINUS;
}

static bool changes_sign(tf_real_t a, tf_real_t b) {
  return (a > 0 && b < 0) || (a < 0 && b > 0);
}

static bool is_codimension_two(const tf_report_t *before,
                               const tf_report_t *after) {
  if (after->mode == TF_PINNED) {
    return before->mode != TF_PINNED;
  }
  if (is_stick(before->mode) && is_stick(after->mode)) {
    return before->mode != after->mode;
  }
  return is_stick(before->mode) != is_stick(after->mode) &&
         before->mode != TF_PINNED &&
         changes_sign(before->slip.g, after->slip.g);
}

static bool is_two_fold(const tf_report_t *before, const tf_report_t *after) {
  if (!is_stick(before->mode) || !(before->delassus > 0) ||
      after->delassus > 0) {
    return false;
  }
  if (is_stick(after->mode)) {
    return before->mode == after->mode;
  }
  return is_slip(after->mode) && !changes_sign(before->slip.g, after->slip.g);
}

// Room for one more, or NULL beyond the limit; where memory is short the list
// ends there, so that it has no gap.
static cli_event_t *new_event(cli_events_t *events) {
  if (events->used >= events->limit) {
    return NULL;
  }
  if (events->used == events->room) {
    const size_t room = events->room == 0 ? 64 : 2 * events->room;
    cli_event_t *list = NULL;
    if (room <= SIZE_MAX / sizeof *list) {
      list = realloc(events->list, room * sizeof *list);
    }
    if (list == NULL) {
      events->limit = events->used;
      return NULL;
    }
    events->list = list;
    events->room = room;
  }
  return &events->list[events->used++];
}

// Whether a stick with a positive Delassus scalar begins.
static bool is_attracting_stick(const tf_report_t *before,
                                const tf_report_t *after) {
  return before->mode != after->mode && is_stick(after->mode) &&
         after->delassus > 0;
}

// Bits of all kinds that two consecutive reports show.
static unsigned kinds_between(const tf_report_t *before,
                              const tf_report_t *after) {
  unsigned kinds = 0;
  if (is_two_fold(before, after)) {
    kinds |= 1u << CLI_TWO_FOLD;
  }
  if (before->mode == after->mode) {
    return kinds;
  }
  if (is_slip(before->mode) && is_slip(after->mode)) {
    kinds |= 1u << CLI_SLIP_TO_SLIP;
  } else if (is_slip(before->mode)) {
    kinds |= 1u << CLI_SLIP_TO_STICK;
  } else if (is_slip(after->mode)) {
    kinds |= 1u << CLI_STICK_TO_SLIP;
  } else if (before->mode == TF_PINNED) {
    kinds |= 1u << CLI_PINNED_TO_STICK;
  }
  if (is_codimension_two(before, after)) {
    kinds |= 1u << CLI_CODIMENSION_TWO;
  }
  return kinds;
}

void cli_events_observe(cli_events_t *events, const tf_report_t *before,
                        const tf_report_t *after, const tf_state_t *state,
                        double t) {
  unsigned kinds = kinds_between(before, after);
  if (kinds == 0) {
    return;
  }
  const bool winds = events->away && kinds == 1u << CLI_SLIP_TO_SLIP;
  events->windings += winds;
  if (kinds >> CLI_TWO_FOLD & 1u) {
    events->away = true;
    events->windings = 0;
  } else if (events->away && is_attracting_stick(before, after)) {
    events->away = false;
    kinds |= 1u << CLI_RETURNED;
  }
  events->steps++;
  for (unsigned kind = 0; kind < CLI_EVENT_KINDS; kind++) {
    events->counts[kind] += (kinds >> kind) & 1u;
  }
  if (winds && events->limit < UINT64_MAX) {
    events->merged++;
    return;
  }
  cli_event_t *event = new_event(events);
  if (event == NULL) {
    return;
  }
  events->told += events->merged + 1;
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
  event->has_lambda = !is_slip(after->mode) || !is_slip(before->mode);
  event->lambda =
      (double)(is_slip(after->mode) ? before->force.F : after->force.F);
}

// "1st", "2nd", "3rd", "4th", "11th", ...
static const char *ordinal_ending(uint64_t n) {
  static const char *const endings[4] = {"th", "st", "nd", "rd"};
  const uint64_t last = n % 10;
  return last > 3 || (n / 10) % 10 == 1 ? endings[0] : endings[last];
}

#define EVENT_ROOM 96

// What happened, in words: the change of mode, then what makes it special.
static void describe(const cli_event_t *event, char text[EVENT_ROOM]) {
  const bool two_fold = ((event->kinds >> CLI_TWO_FOLD) & 1u) != 0;
  const bool special = ((event->kinds >> CLI_CODIMENSION_TWO) & 1u) != 0;
  char modes[24] = "";
  char place[64] = "";
  if (event->from != event->to) {
    (void)snprintf(modes, sizeof modes, "%s to %s", tf_mode_name(event->from),
                   tf_mode_name(event->to));
  }
  if (two_fold && event->arrival == 1) {
    (void)snprintf(place, sizeof place, "two-fold reached");
  } else if (two_fold) {
    const uint64_t n = event->arrival - 1;
    (void)snprintf(place, sizeof place,
                   "returned to the two-fold (%" PRIu64 "%s time)", n,
                   ordinal_ending(n));
  } else if ((event->kinds >> CLI_RETURNED) & 1u) {
    (void)snprintf(place, sizeof place,
                   "returned after %" PRIu64 " changes of slip",
                   event->windings);
  } else if (special) {
    (void)snprintf(place, sizeof place, "codimension two");
  }
  (void)snprintf(text, EVENT_ROOM, "%s%s%s", modes,
                 modes[0] != '\0' && place[0] != '\0' ? ", " : "", place);
}

static void print_merged(uint64_t merged, FILE *file) {
  if (merged > 0) {
    (void)fprintf(file, "  ... %" PRIu64 " x slip to slip (--events all)\n",
                  merged);
  }
}

static void print_list(const cli_events_t *events, FILE *file) {
  uint64_t told = events->told;
  if (events->used > 0) {
    (void)fprintf(file, "  %-11s%11s%15s%12s%12s  %s\n", "t [s]", "r [m]",
                  "omega [rad/s]", "g [m/s]", "lambda [N]", "event");
  }
  for (size_t i = 0; i < events->used; i++) {
    const cli_event_t *event = &events->list[i];
    char text[EVENT_ROOM];
    char lambda[16] = "-";
    print_merged(event->merged, file);
    describe(event, text);
    if (event->has_lambda) {
      (void)snprintf(lambda, sizeof lambda, "%.5g", event->lambda);
    }
    (void)fprintf(file, "  %-11.7g%11.5g%15.5g%12.5g%12s  %s\n", event->t,
                  event->r, event->omega, event->g, lambda, text);
  }
  if (events->used < events->limit) {
    print_merged(events->merged, file);
    told += events->merged;
  }
  if (events->steps > told) {
    (void)fprintf(file, "  ... %" PRIu64 " more events (--events all)\n",
                  events->steps - told);
  }
}

void cli_events_print(const cli_events_t *events, FILE *file) {
  static const char *const names[CLI_EVENT_KINDS] = {
      "slip to stick",   "stick to slip",    "slip to slip", "pinned to stick",
      "codimension two", "two-fold reached", "returned"};
  const char *separator = "";
  (void)fputs("events     ", file);
  for (size_t i = 0; i < CLI_EVENT_KINDS; i++) {
    if (events->counts[i] > 0) {
      (void)fprintf(file, "%s%s %" PRIu64, separator, names[i],
                    events->counts[i]);
      separator = ", ";
    }
  }
  (void)fprintf(file, "%s\n", events->steps > 0 ? "" : "none");
  print_list(events, file);
}

void cli_events_free(cli_events_t *events) {
  free(events->list);
  events->list = NULL;
  events->used = 0;
  events->room = 0;
}
