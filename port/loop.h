/// @file
/// The fixed-rate loop of a firmware. In every tick, in this order:
///   latch   what came in takes effect, at once and only here
///   step    the simulation advances by one step
///   output  what the outside sees of it
/// and in the time that is left the serial line: records are written and sent,
/// and bytes are received. A record that does not fit, in room or in time, is
/// dropped; a step never is. Both are counted, and the counts are sent in the
/// heartbeats, which come by the clock: of a board that is late as often.
///
/// Overrun: step and output end after the next tick. Under policy LOOP_SKIP
/// they are finished, the ticks that passed meanwhile get no step (`skipped`
/// counts them), and the loop goes on at the next tick; so the simulation falls
/// behind by that many steps, and no tick ever gets two. Under LOOP_STOP the
/// loop ends.
#ifndef TWOFOLD_PORT_LOOP_H
#define TWOFOLD_PORT_LOOP_H

#include "app.h"

/// Bytes that can wait for the line.
#ifndef LOOP_ROOM
#ifdef FRAMES
#define LOOP_ROOM 544u
#else
#define LOOP_ROOM 384u
#endif
#endif

/// How the loop ended; the exit code of the program.
typedef enum {
  LOOP_DONE,     ///< all steps of the plan
  LOOP_REFUSED,  ///< app_step: LOOP_BROKE
  LOOP_OVERRAN,  ///< policy LOOP_STOP
  LOOP_NO_TIMER, ///< the board cannot tick at this rate
  LOOP_ENDED     ///< app_latch ended it
} loop_end_t;

/// Runs the loop. counts: out, and up to date in every call of the application.
loop_end_t loop_run(const loop_plan_t *plan, loop_counts_t *counts);

#endif
