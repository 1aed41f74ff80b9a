/// @file
/// The fixed-rate loop of a firmware. In every tick, in this order:
///   latch   what came in takes effect, at once and only here
///   step    the simulation advances by one step
///   output  what the world is to see of it
/// and in the time that is left the serial line: records are written and sent,
/// bytes come in. A record that does not fit, in room or in time, is dropped;
/// a step never is for its sake. Both are counted, and the counts go out on
/// the line themselves (heartbeat).
///
/// Overrun: step and output end after the next tick. Policy LOOP_SKIP: they
/// are finished, the ticks that went by meanwhile get no step (`skipped`
/// counts them) and the loop goes on at the next tick, so the simulation falls
/// behind by so many steps but never doubles one. LOOP_STOP: the loop ends.
#ifndef TWOFOLD_PORT_LOOP_H
#define TWOFOLD_PORT_LOOP_H

#include <stdint.h>

/// Bytes that wait for the line, and the largest record.
#ifdef FRAMES
#define LOOP_ROOM 544u
#define LOOP_RECORD 264u
#endif
#ifndef LOOP_ROOM
#define LOOP_ROOM 256u
#define LOOP_RECORD 128u
#endif

typedef enum { LOOP_SKIP, LOOP_STOP } loop_policy_t;

/// What app_step did.
typedef enum { LOOP_STEPPED, LOOP_STOOD, LOOP_BROKE } loop_step_t;

typedef struct {
  uint32_t rate;        ///< of the tick [Hz]
  uint32_t steps;       ///< how many; 0: without end
  uint32_t every;       ///< ticks from record to record, > 0
  uint32_t heartbeat;   ///< ticks from heartbeat to heartbeat, > 0
  loop_policy_t policy; ///< of overruns
} loop_plan_t;

/// What the loop counts. Times are in units of port_clock, of latch, step and
/// output together.
typedef struct {
  uint32_t steps;    ///< taken; a tick at which the app stands adds none
  uint32_t overruns; ///< steps that ended after the next tick
  uint32_t skipped;  ///< ticks without a step
  uint32_t sent;     ///< records
  uint32_t dropped;  ///< records
  uint32_t shortest, longest;
  uint64_t sum; ///< of the times; the mean is sum / steps
} loop_counts_t;

/// How the loop ended.
typedef enum {
  LOOP_DONE,     ///< all steps of the plan
  LOOP_REFUSED,  ///< app_step: LOOP_BROKE
  LOOP_OVERRAN,  ///< policy LOOP_STOP
  LOOP_NO_TIMER, ///< the board cannot tick at this rate
  LOOP_ENDED     ///< app_latch said so
} loop_end_t;

/// Runs the loop. counts: out, and up to date in every call below.
loop_end_t loop_run(const loop_plan_t *plan, loop_counts_t *counts);

/// The next record is due after so many ticks, > 0; then every plan->every. For
/// app_step: a run that starts, or jumps in time, has its records at the same
/// steps as any other.
void loop_record_in(uint32_t ticks);

// What the firmware defines. Each is short, bounded and never waits.

/// A byte came in. Between steps; changes nothing that a step reads.
void app_receive(uint8_t byte);

/// What was received takes effect. Returns: 0; else the loop ends.
int app_latch(void);

/// One step, or none (LOOP_STOOD), or the end of the loop (LOOP_BROKE).
loop_step_t app_step(void);

/// What the world is to see of the step.
void app_output(void);

/// Writes the record of the present state; at most LOOP_RECORD bytes.
/// Returns: how many.
unsigned app_record(uint8_t to[]);

/// Something else that is to be told: an answer, a description. Asked for when
/// there is room and time, so never dropped. Returns: bytes; 0: nothing.
unsigned app_other(uint8_t to[]);

/// Writes a heartbeat, alike.
unsigned app_heartbeat(const loop_counts_t *counts, uint8_t to[]);

#endif
