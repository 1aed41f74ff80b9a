// The events of a run in words: their counts, then one line each.

#include <inttypes.h>

#include "events.h"

// "1st", "2nd", "3rd", "4th", "11th", ...
static const char *ordinal_ending(uint64_t n) {
  static const char *const endings[4] = {"th", "st", "nd", "rd"};
  const uint64_t last = n % 10;
  return last > 3 || (n / 10) % 10 == 1 ? endings[0] : endings[last];
}

#define EVENT_ROOM 96

// The change of mode, then the singularity, if there is one.
static void describe(const cli_event_t *event, char text[EVENT_ROOM]) {
  const bool two_fold = ((event->kinds >> CLI_TWO_FOLD) & 1u) != 0;
  const bool codim2 = ((event->kinds >> CLI_CODIMENSION_TWO) & 1u) != 0;
  char modes[24] = "";
  char singularity[64] = "";
  if (event->from != event->to) {
    (void)snprintf(modes, sizeof modes, "%s to %s", tf_mode_name(event->from),
                   tf_mode_name(event->to));
  }
  if (two_fold && event->arrival == 1) {
    (void)snprintf(singularity, sizeof singularity, "two-fold reached");
  } else if (two_fold) {
    const uint64_t n = event->arrival - 1;
    (void)snprintf(singularity, sizeof singularity,
                   "returned to the two-fold (%" PRIu64 "%s time)", n,
                   ordinal_ending(n));
  } else if ((event->kinds >> CLI_RETURNED) & 1u) {
    (void)snprintf(singularity, sizeof singularity,
                   "returned after %" PRIu64 " changes of slip",
                   event->windings);
  } else if (codim2) {
    (void)snprintf(singularity, sizeof singularity, "codimension two");
  }
  (void)snprintf(text, EVENT_ROOM, "%s%s%s", modes,
                 modes[0] != '\0' && singularity[0] != '\0' ? ", " : "",
                 singularity);
}

static void print_merged(uint64_t merged, FILE *file) {
  if (merged > 0) {
    (void)fprintf(file, "  ... %" PRIu64 " x slip to slip (--events all)\n",
                  merged);
  }
}

static void print_list(const cli_events_t *events, FILE *file) {
  uint64_t covered = events->covered;
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
    covered += events->merged;
  }
  if (events->steps > covered) {
    (void)fprintf(file, "  ... %" PRIu64 " more events (--events all)\n",
                  events->steps - covered);
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
