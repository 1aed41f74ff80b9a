/// @file
/// Events of a run: where the contact changes its mode, and where the motion
/// passes the singularities that the scenes are about.
#ifndef TWOFOLD_CLI_EVENTS_H
#define TWOFOLD_CLI_EVENTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "twofold.h"

typedef enum {
  CLI_SLIP_TO_STICK,   ///< pinned counts as stick
  CLI_STICK_TO_SLIP,   ///< pinned counts as stick
  CLI_SLIP_TO_SLIP,    ///< h changes sign without stick
  CLI_PINNED_TO_STICK, ///< the wheel rolls off
  CLI_CODIMENSION_TWO, ///< h = 0 and g = 0 in one step
  CLI_TWO_FOLD,        ///< the Delassus scalar turns from + to - in stick
  CLI_RETURNED         ///< an attracting stick begins, after a two-fold
} cli_event_kind_t;
#define CLI_EVENT_KINDS 7

/// What one step showed; it may be several things at once.
typedef struct {
  uint64_t merged;    ///< changes of slip just before, not listed themselves
  unsigned kinds;     ///< bits 1 << cli_event_kind_t
  uint8_t from, to;   ///< tf_mode_t
  uint64_t arrival;   ///< at the two-fold, from 1, if that is among the kinds
  uint64_t windings;  ///< changes of slip since the two-fold, if returned
  double t;           ///< end of the step [s]
  double r, omega, g; ///< at t
  bool has_lambda;
  double lambda; ///< F in stick [N], of the one that begins or else ends
} cli_event_t;

/// All events of a run: the first `limit` steps in detail, the rest as counts.
/// The windings around the two-fold, slip to slip, are listed one by one only
/// where limit is UINT64_MAX; else a line between two events tells how many
/// they were, so that every change of mode is either listed or counted there.
typedef struct {
  uint64_t limit;
  uint64_t steps;    ///< with at least one event
  bool away;         ///< the two-fold was passed and no return seen since
  uint64_t windings; ///< changes of slip since then
  uint64_t told;     ///< steps that the list accounts for
  uint64_t merged;   ///< changes of slip since the last event of the list
  uint64_t counts[CLI_EVENT_KINDS];
  cli_event_t *list; ///< from the heap, NULL while empty
  size_t used, room;
} cli_events_t;

/// Looks for events between two consecutive reports.
/// state, t: after the step that gave `after`.
void cli_events_observe(cli_events_t *events, const tf_report_t *before,
                        const tf_report_t *after, const tf_state_t *state,
                        double t);

/// Prints the list and the counts. Cost: one line an event.
void cli_events_print(const cli_events_t *events, FILE *file);

/// Gives the memory back.
void cli_events_free(cli_events_t *events);

#endif
