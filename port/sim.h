/// @file
/// The simulation of a firmware, from tick to tick.
///
/// Locked (without UPLINK) the machine is a constant and bytes that come in are
/// ignored. With UPLINK they are commands, which take effect at the tick that
/// they name, or at the first one after they came. Inputs that come this way
/// hold for DEADMAN ticks of the board's clock, by default half a second: 25
/// records at the default rate, so that a controller may miss most of them, and
/// still short against the two seconds that scene `chaos` stays in one mode.
/// With UPLINK_KEY, a file to include that has 16 bytes, commands need the tag
/// of that key, and each start of the board begins a session of its own: by
/// port_boot, or with KEY_WEAK, as without a key, by when the first bytes come.
#ifndef TWOFOLD_PORT_SIM_H
#define TWOFOLD_PORT_SIM_H

#include "app.h"
#include "core.h"
#include "port.h"

#ifndef RATE
#define RATE 1000
#endif
#ifndef EVERY
#define EVERY ((RATE + 49) / 50)
#endif

#ifndef BAUD
#define BAUD 0 // of a line that is not known
#endif
#define BUILD_NAME "twofold"

#ifdef UPLINK

#ifndef DEADMAN
#define DEADMAN ((RATE + 1) / 2)
#endif

static struct {
  tf_simulation_t simulation;
  tf_link_t link;
  uint64_t expected;     // tick of the next step, unless a command changes it
  bool is_under_way;     // the last tick took that step
  uint32_t ticks;        // of the board's clock, when commands last took effect
  uint32_t until, every; // ticks to the next record, and to that behind it
  // Inputs that have expired, which is to be told behind so many answers.
  bool has_expired;
  uint8_t answers;
  uint64_t expired_at; // tick of the machine
} sim;
#define SIM_STATE sim.simulation.state
#define SIM_TALLY sim.simulation.tally
#define SIM_REPORT sim.simulation.report
#define SIM_PARAMS sim.link.params
#define SIM_SOURCE sim.simulation.stepped
#define SIM_TAKES_COMMANDS true
#ifdef UPLINK_KEY
#define SIM_WANTS_TAG true
static const uint8_t sim_key[TF_KEY_BYTES] = {
#include UPLINK_KEY
};
#else
#define SIM_WANTS_TAG false
#endif

#if defined(UPLINK_KEY) && !defined(KEY_WEAK)
// Returns: whether the board had a number for it.
static bool sim_begin_session(void) {
  const uint32_t number = port_boot();
  if (number != 0) tf_link_begin_session(&sim.link, number, sim_key);
  return number != 0;
}
#else
static bool sim_begin_session(void) { return true; }
#endif

static bool sim_begin(void) {
  const tf_params_t params = scene_params(SCENE);
  tf_link_open(&sim.link, SCENE, &params);
  const tf_status_t status =
      tf_simulation_open(&sim.simulation, SCENE, &params, 1);
  sim.simulation.deadman = DEADMAN;
  sim.link.line = tf_line_of_frames(RATE, BAUD, SCENE->name, BUILD_NAME, true,
                                    SIM_WANTS_TAG ? TF_TAG_BYTES : 0);
  sim.link.every = sim.every = sim.until = EVERY;
  return status == TF_OK && sim_begin_session();
}

// The times of the first bytes differ from start to start.
static void sim_receive(uint8_t byte, uint32_t when) {
  if (sim.link.session == 0) tf_link_add_entropy(&sim.link, when);
#ifdef UPLINK_KEY
  tf_link_receive_tagged(&sim.link, byte, sim_key);
#else
  tf_link_receive(&sim.link, byte);
#endif
}

// Each tick of the clock is counted once, also where it comes between the
// loop's look at it and this one.
static void sim_latch(void) {
  const uint32_t now = port_ticks();
  tf_simulation_pass(&sim.simulation, now - sim.ticks - 1);
  sim.ticks = now;
  (void)tf_link_boundary(&sim.link, &sim.simulation);
}

// What took effect before is told before.
static void sim_note_expired(uint64_t tick) {
  const tf_link_t *link = &sim.link;
  sim.has_expired = true;
  sim.expired_at = tick;
  sim.answers = link->has_aside;
  for (unsigned i = 0; i < link->waiting; i++)
    sim.answers = (uint8_t)(sim.answers + link->queue[i].done);
}

// Whatever commands do, records are of ticks that are multiples of `every`: a
// program that drives the machine knows beforehand which it will see.
static void sim_count(uint32_t *until_record) {
  const tf_simulation_t *simulation = &sim.simulation;
  const bool was_under_way = sim.is_under_way;
  const uint32_t every = sim.link.every;
  sim.is_under_way = simulation->running;
  if (sim.every != every ||
      (simulation->running &&
       (!was_under_way || simulation->state.tick != sim.expected)))
    sim.until = every - (uint32_t)(simulation->state.tick % every);
  sim.every = every;
  *until_record = sim.until;
  sim.until = sim.until > 1 ? sim.until - 1 : every;
}

static loop_step_t sim_step(uint32_t *until_record) {
  tf_simulation_t *simulation = &sim.simulation;
  sim_count(until_record);
  if (!simulation->running) return LOOP_STOOD;
  const uint32_t expired = simulation->expired;
  const tf_input_t input = tf_simulation_input(simulation, SCENE);
  if (simulation->expired != expired) sim_note_expired(simulation->state.tick);
  const tf_status_t status = scheme_step(
      &simulation->machine, &simulation->state, &input, &simulation->report);
  tf_tally_count(&simulation->tally, simulation->state.tick, status);
  sim.expected = simulation->state.tick;
  return status < 0 ? LOOP_STOOD : LOOP_STEPPED;
}

#else

static struct {
  tf_state_t state;
  tf_report_t report;
  tf_input_t input;
  tf_tally_t tally;
  uint32_t steps;
} sim;
#define SIM_STATE sim.state
#define SIM_TALLY sim.tally
#define SIM_REPORT sim.report
#define SIM_PARAMS SCENE->params
#define SIM_SOURCE TF_INPUT_SCENE
#define SIM_TAKES_COMMANDS false

static bool sim_begin(void) { return scene_begin(&sim.state, &sim.report); }

static void sim_receive(uint8_t byte, uint32_t when) {
  (void)byte;
  (void)when;
}

static void sim_latch(void) { sim.input = scene_input(sim.steps + 1); }

// The count stays at its end: the inputs of a scene are constant by then.
static loop_step_t sim_step(uint32_t *until_record) {
  (void)until_record;
  if (sim.steps < UINT32_MAX - 1) sim.steps++;
  const tf_status_t status =
      scheme_step(SCENE_MACHINE, &sim.state, &sim.input, &sim.report);
  tf_tally_count(&sim.tally, sim.state.tick, status);
  return status < 0 ? LOOP_BROKE : LOOP_STEPPED; // a refusal ends the loop
}

#endif

// Counts of the tally in a heartbeat.
static uint32_t at_most_32_bits(uint64_t count) {
  return count < UINT32_MAX ? (uint32_t)count : UINT32_MAX;
}

#endif
