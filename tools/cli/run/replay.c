// A record is read as a whole and walked through once before the replay, which
// says how many steps it has. The replay itself keeps what a board keeps, a
// simulation and a link; commands go through the link as they do there, and the
// system of the run is the simulation's machine and state.

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../text/buffer.h"
#include "../text/message.h"
#include "../text/number.h"
#include "../text/trailer.h"
#include "record.h"
#include "row.h"

#define LINE_ROOM 1024
// Where these stand in the payload of a schema.
#define SCHEMA_SCHEME 3
#define SCHEMA_SEED 5
#define SCHEMA_HASH 9
#define SCHEMA_DEADMAN 21
#define SCHEMA_LEAST 29

static bool read_hex(const char *text, size_t length, cli_replay_row_t *row) {
  if (length % 2 != 0 || length / 2 > sizeof row->data ||
      strspn(text, "0123456789abcdef") < length) {
    return false;
  }
  for (size_t i = 0; i < length; i += 2) {
    const char byte[3] = {text[i], text[i + 1], '\0'};
    row->data[i / 2] = (uint8_t)strtoul(byte, NULL, 16);
  }
  row->length = (uint8_t)(length / 2);
  return true;
}

// TICK,TYPE,DATA,COMMAND
static bool read_row(char *line, cli_replay_row_t *row, const char **command) {
  cli_replay_row_t type;
  char *field[3];
  for (size_t i = 0; i < 3; i++) {
    field[i] = line;
    line += strcspn(line, ",");
    if (*line != ',') {
      return false;
    }
    *line++ = '\0';
  }
  memset(row, 0, sizeof *row);
  if (!cli_read_whole(field[0], 0, TF_LINK_TICKS - 1, &row->tick) ||
      strlen(field[1]) != 2 || !read_hex(field[1], 2, &type)) {
    return false;
  }
  row->type = type.data[0];
  *command = line;
  return read_hex(field[2], strlen(field[2]), row);
}

typedef struct {
  cli_replay_t *replay;
  cli_trailer_t sum; // of header and rows so far
  unsigned long line;
  bool has_header, has_schema, is_whole;
} reader_t;

static int no_record(const reader_t *reader) {
  return cli_message(CLI_USAGE, "%s:%lu: no record of 'monitor --record'",
                     reader->replay->name, reader->line);
}

static int cut_off(const reader_t *reader) {
  return cli_message(CLI_REFUSED,
                     "%s: cut off or changed: no last line counts its rows",
                     reader->replay->name);
}

static int take_row(reader_t *reader, char *line) {
  cli_replay_t *replay = reader->replay;
  cli_replay_row_t row;
  const char *command = NULL;
  if (!read_row(line, &row, &command) ||
      (row.type == TF_DOWN_SCHEMA) == reader->has_schema) {
    return no_record(reader);
  }
  if (!reader->has_schema) {
    if (strcmp(command, CLI_RECORD_SCHEMA) != 0) {
      return cli_message(CLI_REFUSED,
                         "%s: '%s', here it is '" CLI_RECORD_SCHEMA
                         "': record the session again",
                         replay->name, command);
    }
    reader->has_schema = true;
    replay->schema = row;
    return row.length >= SCHEMA_LEAST ? CLI_DONE : no_record(reader);
  }
  cli_replay_row_t *rows =
      cli_grow(replay->rows, replay->count, &replay->room, sizeof *rows);
  if (rows == NULL) {
    return cli_message(CLI_STOPPED, "%s: out of memory", replay->name);
  }
  replay->rows = rows;
  replay->rows[replay->count++] = row;
  return CLI_DONE;
}

// The last line has to be that of the rows before it, and the last one.
static int take_line(reader_t *reader, char *line) {
  char last[CLI_TRAILER_ROOM];
  const size_t length = strlen(line);
  if (reader->is_whole) {
    return cut_off(reader);
  }
  if (strncmp(line, CLI_TRAILER_MARK, sizeof CLI_TRAILER_MARK - 1) == 0) {
    const size_t end = cli_trailer_line(&reader->sum, &cli_whole_shard, last);
    reader->is_whole = length + 1 == end && memcmp(line, last, length) == 0;
    return reader->is_whole ? CLI_DONE : cut_off(reader);
  }
  if (line[0] == '#') {
    return CLI_DONE;
  }
  if (reader->has_header && !reader->has_schema) {
    reader->sum.run = cli_crc(0, line, length);
  }
  cli_trailer_add(&reader->sum, line, length, reader->has_header);
  cli_trailer_add(&reader->sum, "\n", 1, 0);
  if (reader->has_header) {
    return take_row(reader, line);
  }
  reader->has_header = true;
  return strcmp(line, "tick,type,data,command") == 0 ? CLI_DONE
                                                     : no_record(reader);
}

static int parse(cli_replay_t *replay, FILE *file) {
  char line[LINE_ROOM];
  reader_t reader = {.replay = replay};
  cli_line_t found;
  while ((found = cli_read_line(file, line, sizeof line)) != CLI_LINE_END) {
    reader.line++;
    CLI_TRY(found == CLI_LINE ? take_line(&reader, line) : no_record(&reader));
  }
  if (ferror(file) != 0) {
    return cli_message(CLI_USAGE, "%s: %s", replay->name, strerror(errno));
  }
  if (!reader.has_schema) {
    return no_record(&reader);
  }
  replay->hash = reader.sum.crc;
  return reader.is_whole ? CLI_DONE : cut_off(&reader);
}

int cli_replay_read(cli_replay_t *replay, const char *path,
                    const cli_scheme_t **scheme) {
  FILE *file = fopen(path, "r");
  if (file == NULL) {
    return cli_message(CLI_USAGE, "--replay %s: %s", path, strerror(errno));
  }
  replay->name = path;
  const int code = parse(replay, file);
  (void)fclose(file);
  CLI_TRY(code);
  const uint8_t there = replay->schema.data[SCHEMA_SCHEME];
  if (*scheme == NULL && there < CLI_SCHEMES) {
    *scheme = &cli_schemes[there];
  }
  return CLI_DONE;
}

// The tick after a command, of which the tick before it is known.
static uint64_t tick_after(const cli_replay_row_t *row, uint64_t *saved) {
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
  for (size_t i = 0; i < replay->count; i++) {
    const cli_replay_row_t *row = &replay->rows[i];
    if (row->tick < tick) {
      return cli_message(CLI_REFUSED,
                         "--replay %s: row %zu is at step %" PRIu64
                         ", when the board has taken %" PRIu64,
                         replay->name, i + 1, row->tick, tick);
    }
    if (row->tick - tick > CLI_MAX_STEPS - *steps) {
      return cli_message(CLI_REFUSED, "--replay %s: more than 1e15 steps",
                         replay->name);
    }
    *steps += row->tick - tick;
    tick = tick_after(row, &saved);
  }
  return CLI_DONE;
}

static int compare(const cli_replay_t *replay, const cli_setup_t *setup,
                   const cli_scheme_t *scheme) {
  const uint8_t *schema = replay->schema.data;
  const uint32_t hash = (uint32_t)tf_wire_get(schema + SCHEMA_HASH, 4);
  const uint32_t here = tf_params_hash(&setup->params);
  if (schema[0] != TF_REAL_BYTES) {
    return cli_message(CLI_REFUSED,
                       "--replay %s: the board computes in %s, this program "
                       "in %s",
                       replay->name, schema[0] == 4 ? "float" : "double",
                       TF_REAL_BYTES == 4 ? "float" : "double");
  }
  if (schema[SCHEMA_SCHEME] != scheme->code) {
    return cli_message(CLI_REFUSED,
                       "--replay %s: the scheme of the board is %s, not %s",
                       replay->name,
                       schema[SCHEMA_SCHEME] < CLI_SCHEMES
                           ? cli_schemes[schema[SCHEMA_SCHEME]].name
                           : "unknown",
                       scheme->name);
  }
  if (hash != here) {
    return cli_message(CLI_REFUSED,
                       "--replay %s: the parameters of the board have the hash "
                       "%08" PRIx32 ", those here %08" PRIx32
                       "; is --dt 1/RATE of the firmware?",
                       replay->name, hash, here);
  }
  return CLI_DONE;
}

int cli_replay_begin(cli_replay_t *replay, cli_setup_t *setup,
                     const cli_scheme_t *scheme, uint64_t *steps) {
  const uint8_t *schema = replay->schema.data;
  CLI_TRY(compare(replay, setup, scheme));
  CLI_TRY(count_steps(replay, steps));
  setup->seed = (uint32_t)tf_wire_get(schema + SCHEMA_SEED, 4);
  setup->state.seed = setup->seed;
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
static bool perform(cli_replay_t *replay, const cli_replay_row_t *row) {
  uint8_t wire[TF_FRAME_SIZE(TF_FRAME_PAYLOAD)];
  uint32_t down = 0;
  if (row->length > TF_COMMAND_MOST) {
    return false;
  }
  memcpy(wire + TF_COMMAND_AT, row->data, row->length);
  const size_t length =
      tf_command_seal(wire, row->type, row->length, replay->link.session,
                      &replay->sequence, 0, NULL);
  for (size_t i = 0; i < length; i++) {
    tf_link_receive(&replay->link, wire[i]);
  }
  const unsigned done = tf_link_boundary(&replay->link, &replay->simulation);
  (void)tf_link_answer(&replay->link, wire, &down);
  replay->commands += done;
  return done == 1;
}

static bool same_state(const cli_replay_row_t *row, const tf_state_t *state) {
  tf_state_t there;
  if (row->length != TF_STATE_BYTES) {
    return false;
  }
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

bool cli_replay_next(cli_replay_t *replay, cli_system_t *system,
                     const tf_scene_t *scene, tf_report_t *report,
                     tf_input_t *input) {
  tf_simulation_t *simulation = &replay->simulation;
  simulation->state = system->state;
  while (replay->next < replay->count &&
         replay->rows[replay->next].tick == simulation->state.tick &&
         replay->failed == NULL) {
    const cli_replay_row_t *row = &replay->rows[replay->next++];
    if (row->type == TF_DOWN_STATE) {
      replay->states++;
      if (!same_state(row, &simulation->state)) {
        replay->failed = "the state is not that of the board";
      }
    } else if (row->type == TF_DOWN_EXPIRED) {
      if (simulation->source != TF_INPUT_SET || simulation->deadman == 0) {
        replay->failed = "inputs expire that do not hold";
      }
      simulation->left = 0; // the next step finds that they have
    } else if (!perform(replay, row)) {
      replay->failed = "a command is refused that the board took";
    } else {
      look_again(simulation, scene, row->type, report);
    }
  }
  system->state = simulation->state;
  system->machine.machine = simulation->machine;
  if (replay->failed != NULL || replay->next == replay->count) {
    return false;
  }
  if (!simulation->running) {
    replay->failed = "the board stood still, and is said to have moved";
    return false;
  }
  *input = tf_simulation_input(simulation, scene);
  return true;
}
