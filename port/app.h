/// @file
/// What the loop (loop.h) asks of an application, as port.h says what is asked
/// of a board: functions that are called by name. Each is short and bounded and
/// never waits. firmware.c is the application of this project.
#ifndef TWOFOLD_PORT_APP_H
#define TWOFOLD_PORT_APP_H

#include <stdbool.h>
#include <stdint.h>

/// Bytes of the longest record.
#ifndef LOOP_RECORD
#ifdef FRAMES
#define LOOP_RECORD 264u
#else
#define LOOP_RECORD 160u
#endif
#endif

/// What to do about an overrun (loop.h).
typedef enum { LOOP_SKIP, LOOP_STOP } loop_policy_t;

/// What app_step did.
typedef enum {
  LOOP_STEPPED, ///< one step
  LOOP_STOOD,   ///< none: the application stands still at this tick
  LOOP_BROKE    ///< none, and the loop has to end
} loop_step_t;

typedef struct {
  uint32_t rate;        ///< of the tick [Hz]
  uint32_t steps;       ///< how many; 0: without end
  uint32_t every;       ///< ticks from record to record, > 0
  uint32_t heartbeat;   ///< ticks from heartbeat to heartbeat, > 0
  loop_policy_t policy; ///< of overruns
} loop_plan_t;

/// What the loop counts, modulo 2^32 where it has 32 bits. Times are in units
/// of port_clock, of latch, step and output together; a time that the clock
/// cannot measure, 2^31 units or more, counts as 2^32 - 1.
typedef struct {
  uint64_t steps; ///< taken; a tick at which the application stands adds none
  uint32_t overruns; ///< steps that ended after the next tick
  uint32_t skipped;  ///< ticks without a step
  uint32_t sent;     ///< records
  uint32_t dropped;  ///< records
  uint32_t shortest, longest;
  uint64_t sum; ///< of the times
} loop_counts_t;

/// The mean of the times, sum / steps, which has 32 bits; 0 without a step. A
/// library's division of 64 bits would take 700 bytes for this alone.
static inline uint32_t loop_mean(const loop_counts_t *counts) {
  uint64_t rest = counts->sum;
  uint32_t mean = 0;
  for (unsigned bit = 32; bit-- > 0 && counts->steps > 0;) {
    if (rest >> bit < counts->steps) continue;
    rest -= counts->steps << bit;
    mean |= (uint32_t)1 << bit;
  }
  return mean;
}

/// How the application wants to be run.
extern const loop_plan_t app_plan;

/// Called once, before the loop. Returns: whether the application can start.
bool app_begin(void);

/// A byte came in. Called between steps; changes nothing that a step reads.
/// when: the clock at which the loop took it, which is never the same twice
///   from start to start.
void app_receive(uint8_t byte, uint32_t when);

/// What was received takes effect. Returns: 0; anything else ends the loop.
int app_latch(void);

/// One step, or none.
/// until_record: in/out, ticks until the next record, this one included, > 0.
///   An application that starts or jumps in time may set it, so that its
///   records are of the same steps as in any other run; after that record one
///   follows every app_plan.every ticks.
loop_step_t app_step(uint32_t *until_record);

/// Outputs of the step to the outside.
void app_output(void);

/// Writes the record of the present state; at most LOOP_RECORD bytes.
/// Returns: how many.
unsigned app_record(uint8_t to[]);

/// Writes something else that is to be sent: an answer, a description. Called
/// only where there is room and time, so it is never dropped. At most
/// LOOP_RECORD bytes. Returns: how many; 0: nothing.
unsigned app_other(uint8_t to[]);

/// Writes a heartbeat; at most LOOP_RECORD bytes. Returns: how many.
unsigned app_heartbeat(const loop_counts_t *counts, uint8_t to[]);

#endif
