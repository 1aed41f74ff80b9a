// A session is walked through once before the replay, which says how many steps
// it has. The replay itself keeps what a board keeps, a simulation and a link;
// commands go through the link as they do there, and the system of the run is
// the simulation's machine and state.

#include "run.h"

// Where these stand in the payload of a schema.
#define SCHEMA_SCHEME 3
#define SCHEMA_SEED 5
#define SCHEMA_HASH 9
#define SCHEMA_DEADMAN 21

int cli_replay_read(cli_replay_t *replay, const char *path,
                    cli_setup_t *setup) {
  CLI_TRY(cli_session_read(&replay->session, path));
  const uint8_t there = replay->session.schema.data[SCHEMA_SCHEME];
  if (setup->scheme == MOTION_SCHEMES && there < MOTION_SCHEMES)
    setup->scheme = (motion_scheme_t)there;
  return CLI_DONE;
}

// The tick after a command, of which the tick before it is known.
static uint64_t tick_after(const cli_session_row_t *row, uint64_t *saved) {
  switch (row->type) {
    case TF_UP_RESET:
      return 0;
    case TF_UP_SNAPSHOT:
      *saved = row->tick;
      return row->tick;
    case TF_UP_RESTORE:
      return row->length >= 8 ? tf_wire_get(row->data, 8) : *saved;
    default:
      return row->tick;
  }
}

static int count_steps(const cli_replay_t *replay, uint64_t *steps) {
  uint64_t tick = 0, saved = 0;
  *steps = 0;
  for (size_t i = 0; i < replay->session.count; i++) {
    const cli_session_row_t *row = &replay->session.rows[i];
    if (row->tick < tick) {
      return cli_refuse("--replay %s: row %zu is at step %" PRIu64
                        ", when the board has taken %" PRIu64,
                        replay->session.name, i + 1, row->tick, tick);
    }
    if (row->tick - tick > CLI_MAX_STEPS - *steps) {
      return cli_refuse("--replay %s: more than 1e15 steps",
                        replay->session.name);
    }
    *steps += row->tick - tick;
    tick = tick_after(row, &saved);
  }
  return CLI_DONE;
}

int cli_replay_begin(cli_replay_t *replay, cli_setup_t *setup,
                     uint64_t *steps) {
  const uint8_t *schema = replay->session.schema.data;
  const uint32_t hash = (uint32_t)tf_wire_get(schema + SCHEMA_HASH, 4);
  const uint32_t here = tf_params_hash(&setup->params);
  if (schema[0] != TF_REAL_BYTES) {
    return cli_refuse(
        "--replay %s: the board computes in %s, this program in %s",
        replay->session.name, schema[0] == 4 ? "float" : "double",
        TF_REAL_BYTES == 4 ? "float" : "double");
  }
  if (schema[SCHEMA_SCHEME] != setup->scheme) {
    return cli_refuse("--replay %s: the scheme of the board is %s, not %s",
                      replay->session.name,
                      schema[SCHEMA_SCHEME] < MOTION_SCHEMES
                          ? motion_scheme_name(schema[SCHEMA_SCHEME])
                          : "unknown, or of SPLIT=no",
                      motion_scheme_name(setup->scheme));
  }
  if (hash != here) {
    return cli_refuse(
        "--replay %s: the parameters of the board have the hash %08" PRIx32
        ", those here %08" PRIx32 "; is --dt 1/RATE of the firmware?",
        replay->session.name, hash, here);
  }
  CLI_TRY(count_steps(replay, steps));
  setup->seed = (uint32_t)tf_wire_get(schema + SCHEMA_SEED, 4);
  tf_link_open(&replay->link, setup->scene, &setup->params);
  (void)tf_simulation_open(&replay->simulation, setup->scene, &setup->params,
                           setup->seed);
  replay->simulation.deadman =
      (uint32_t)tf_wire_get(schema + SCHEMA_DEADMAN, 4);
  replay->link.session = 1;
  replay->link.describe = false;
  replay->link.every = 1; // records are not replayed
  return CLI_DONE;
}

// Returns: whether the command took effect.
static bool perform(cli_replay_t *replay, const cli_session_row_t *row) {
  uint8_t wire[TF_FRAME_SIZE(TF_FRAME_PAYLOAD)];
  uint32_t down = 0;
  if (row->length > TF_COMMAND_MOST) return false;
  memcpy(wire + TF_COMMAND_AT, row->data, row->length);
  const size_t length =
      tf_command_seal(wire, row->type, row->length, replay->link.session,
                      &replay->sequence, 0, NULL);
  for (size_t i = 0; i < length; i++) tf_link_receive(&replay->link, wire[i]);
  const unsigned done = tf_link_boundary(&replay->link, &replay->simulation);
  (void)tf_link_answer(&replay->link, wire, &down);
  replay->commands += done;
  return done == 1;
}

static bool same_state(const cli_session_row_t *row, const tf_state_t *state) {
  tf_state_t there;
  if (row->length != TF_STATE_BYTES) return false;
  tf_read_state(row->data, row->tick, &there);
  return memcmp(&there.r, &state->r, sizeof there.r) == 0 &&
         memcmp(&there.v, &state->v, sizeof there.v) == 0 &&
         memcmp(&there.w, &state->w, sizeof there.w) == 0 &&
         memcmp(&there.phi, &state->phi, sizeof there.phi) == 0 &&
         there.seed == state->seed && there.mode == state->mode;
}

// The report of a state that a command has put in the place of another one:
// that of the start after a reset, and of a motion that starts there after a
// restore.
static void look_again(const tf_simulation_t *simulation,
                       const tf_scene_t *scene, uint8_t command,
                       tf_report_t *report) {
  if (command == TF_UP_RESET) {
    *report = simulation->report;
  } else if (command == TF_UP_RESTORE) {
    tf_simulation_t before = *simulation;
    before.state.tick--;
    const tf_input_t input = tf_simulation_input(&before, scene);
    (void)tf_begin(&before.machine, &before.state, &input, report);
  }
}

bool cli_replay_next(cli_replay_t *replay, motion_t *system,
                     const tf_scene_t *scene, tf_report_t *report,
                     tf_input_t *input) {
  tf_simulation_t *simulation = &replay->simulation;
  simulation->state = system->state;
  while (replay->next < replay->session.count &&
         replay->session.rows[replay->next].tick == simulation->state.tick &&
         replay->failed == NULL) {
    const cli_session_row_t *row = &replay->session.rows[replay->next++];
    if (row->type == TF_DOWN_STATE) {
      replay->states++;
      if (!same_state(row, &simulation->state))
        replay->failed = "the state is not that of the board";
    } else if (row->type == TF_DOWN_EXPIRED) {
      if (simulation->source != TF_INPUT_SET || simulation->deadman == 0)
        replay->failed = "inputs expire that are not in effect";
      simulation->left = 0; // the next step finds that they have
    } else if (!perform(replay, row)) {
      replay->failed = "a command that the board took is refused";
    } else {
      look_again(simulation, scene, row->type, report);
    }
  }
  system->state = simulation->state;
  system->machine.machine = simulation->machine;
  if (replay->failed != NULL || replay->next == replay->session.count)
    return false;
  if (!simulation->running) {
    replay->failed = "the record has a stopped board moving";
    return false;
  }
  *input = tf_simulation_input(simulation, scene);
  return true;
}
