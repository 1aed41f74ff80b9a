/// Events of a run: changes of the contact's mode, and passages through the
/// singularities of the model; and instants with several consistent modes.
#pragma once

#include "twofold.h"

typedef enum {
  CLI_SLIP_TO_STICK,   ///< pinned counts as stick
  CLI_STICK_TO_SLIP,   ///< pinned counts as stick
  CLI_SLIP_TO_SLIP,    ///< h changes sign without stick
  CLI_PINNED_TO_STICK, ///< the wheel starts to roll
  CLI_CODIMENSION_TWO, ///< h = 0 and g = 0 in one step
  CLI_TWO_FOLD,        ///< the Delassus scalar changes from + to - in stick
  CLI_RETURNED         ///< sliding region reached for the first time since
} cli_event_kind_t;
#define CLI_EVENT_KINDS 7

/// The events of one step; several may coincide.
typedef struct {
  uint64_t merged;    ///< changes of slip just before that are not listed
  unsigned kinds;     ///< bits 1 << cli_event_kind_t
  uint8_t from, to;   ///< tf_mode_t
  uint64_t arrival;   ///< number of the arrival at the two-fold, from 1
  uint64_t windings;  ///< changes of slip since the two-fold
  double t;           ///< end of the step [s]
  double r, omega, g; ///< at t
  double lambda; ///< F in stick [N], at its begin or else at its end, or NAN
} cli_event_t;

/// All events of a run: the first `limit` steps in detail, the others counted.
/// The windings around the two-fold, from slip to slip, are listed one by one
/// only if limit is UINT64_MAX; else a line between two events counts them.
typedef struct {
  uint64_t limit;
  uint64_t steps;    ///< with at least one event
  bool away;         ///< the two-fold was passed, without a return since
  uint64_t windings; ///< changes of slip since then
  uint64_t merged;   ///< changes of slip since the last event of the list
  uint64_t counts[CLI_EVENT_KINDS];
  cli_event_t *list; ///< from the heap, NULL while empty
  size_t used, room;
  double choices_at_start; ///< consistent modes there, NAN: not seen
  uint64_t ambiguous;      ///< steps with several of them
  double ambiguous_since;  ///< [s], the start, too; NAN: at no time so far
  unsigned set;            ///< which they were then, 0: at no time so far
} cli_events_t;

/// Begins. start: in, the report of the start, NULL where the motion goes on
/// from another one.
void cli_events_begin(cli_events_t *events, uint64_t limit,
                      const tf_report_t *start);

/// The report before a change within a step: g changes its sign there only at g
/// = 0, whatever it did since, and a stick that ends elsewhere ends with the
/// force of the slip that begins.
tf_report_t cli_before_change(const tf_report_t *before,
                              const tf_located_change_t *change);

/// Whether cli_events_observe may find something between two reports: of most
/// steps it does not.
static inline bool cli_events_between(const tf_report_t *before,
                                      const tf_report_t *after) {
  return before->mode != after->mode || after->choices > 1 ||
         (before->delassus > 0) != (after->delassus > 0);
}

/// Looks for events between two consecutive reports.
/// state, t: after the step that gave `after`.
void cli_events_observe(cli_events_t *events, const tf_report_t *before,
                        const tf_report_t *after, const tf_state_t *state,
                        double t);
