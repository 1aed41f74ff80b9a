// Where a run stands, as text:
//
//   twofold-state 3          version of this format
//   number double            type of all numbers below
//   scheme moreau
//   inputs 00000000          hash of the table of --inputs, 0: none
//   source outside           or safe: inputs that a board got by a command hold
//                            on or have expired; else this line is missing
//   tick 12345, seed, mode, r, v, omega, phi, what the rounding of these has
//                            left out, and the last report: a line each;
//                            where there is a source, the dead-man behind the
//                            last whole number and those inputs at the end
//   scene                    then the scene, as `twofold scene` prints it
//   crc32 0123abcd           of all bytes before
//
// The scene is there as a whole, not as a hash: what differs is reported by
// name. Its start is not compared: the state is in its place.

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../setup/scene_file.h"
#include "../setup/setup.h"
#include "../text/message.h"
#include "../text/number.h"
#include "../text/trailer.h"
#include "record.h"

#define VERSION "3"
#define REALS 19
#define HELD_REALS 5 // the last ones, where a command's inputs hold
#define WHOLES 9
#define HELD_WHOLES 2
#define CRC_LINE 15 // "crc32 0123abcd\n"

// The members of cli_stand_t that are numbers, in the order of their lines.
static const struct {
  const char *name;
  size_t at;
} reals[REALS] = {{"r", offsetof(cli_stand_t, state.r)},
                  {"v", offsetof(cli_stand_t, state.v)},
                  {"omega", offsetof(cli_stand_t, state.w)},
                  {"phi", offsetof(cli_stand_t, state.phi)},
                  {"compensation-r", offsetof(cli_stand_t, compensation.r)},
                  {"compensation-v", offsetof(cli_stand_t, compensation.v)},
                  {"compensation-w", offsetof(cli_stand_t, compensation.w)},
                  {"compensation-phi", offsetof(cli_stand_t, compensation.phi)},
                  {"force-F", offsetof(cli_stand_t, report.force.F)},
                  {"force-M", offsetof(cli_stand_t, report.force.M)},
                  {"slip-h", offsetof(cli_stand_t, report.slip.h)},
                  {"slip-g", offsetof(cli_stand_t, report.slip.g)},
                  {"delassus", offsetof(cli_stand_t, report.delassus)},
                  {"residual", offsetof(cli_stand_t, report.residual)},
                  {"held-omega0", offsetof(cli_stand_t, held.input.omega0)},
                  {"held-r0", offsetof(cli_stand_t, held.input.r0)},
                  {"held-force", offsetof(cli_stand_t, held.input.force)},
                  {"held-torque", offsetof(cli_stand_t, held.input.torque)},
                  {"held-alpha", offsetof(cli_stand_t, held.input.alpha)}};
static const struct {
  const char *name;
  uint64_t most;
} wholes[WHOLES] = {
    {"tick", UINT64_C(1) << 62},   {"seed", UINT32_MAX},
    {"mode", TF_MODES - 1},        {"report-mode", TF_MODES - 1},
    {"set", (1u << TF_MODES) - 1}, {"choices", TF_MODES},
    {"status", TF_STALLED},        {"deadman", UINT32_MAX},
    {"left", UINT32_MAX}};
static const char *const sources[] = {"scene", "outside", "safe"};

static tf_real_t *real_of(cli_stand_t *stand, size_t i) {
  return (tf_real_t *)(void *)((char *)stand + reals[i].at);
}

size_t cli_state_print(const cli_stand_t *stand, const cli_setup_t *setup,
                       const cli_scheme_t *scheme, char out[CLI_STATE_BYTES]) {
  cli_buffer_t text = {out, 0, CLI_STATE_BYTES, false};
  cli_stand_t copy = *stand;
  const uint64_t whole[WHOLES] = {stand->state.tick,
                                  stand->state.seed,
                                  stand->state.mode,
                                  stand->report.mode,
                                  stand->report.set,
                                  stand->report.choices,
                                  (uint64_t)stand->report.status,
                                  stand->held.deadman,
                                  stand->held.left};
  const size_t held = stand->held.source != TF_INPUT_SCENE;
  cli_add_form(&text, "twofold-state %s\nnumber %s\nscheme %s\ninputs ",
               VERSION, CLI_NUMBER_TYPE, scheme->name);
  cli_add_hash(&text, stand->inputs);
  cli_add(&text, "\n");
  if (held != 0) {
    cli_add_form(&text, "source %s\n", sources[stand->held.source]);
  }
  for (size_t i = 0; i < WHOLES - HELD_WHOLES + held * HELD_WHOLES; i++) {
    cli_add_form(&text, "%s %" PRIu64 "\n", wholes[i].name, whole[i]);
  }
  for (size_t i = 0; i < REALS - HELD_REALS + held * HELD_REALS; i++) {
    cli_add_form(&text, "%s %g\n", reals[i].name, (double)*real_of(&copy, i));
  }
  cli_add(&text, "scene\n");
  cli_scene_print(setup->scene, &setup->params, &text);
  const uint32_t crc = cli_crc(0, out, text.used);
  cli_add(&text, "crc32 ");
  cli_add_hash(&text, crc);
  cli_add(&text, "\n");
  return text.used;
}

typedef struct {
  const char *path;
  char *at; // what is still to be read
} reader_t;

// The value of the next line, which has to have this key, or NULL.
static char *next_value(reader_t *reader, const char *key) {
  const size_t length = strlen(key);
  char *end = strchr(reader->at, '\n');
  if (end == NULL || strncmp(reader->at, key, length) != 0 ||
      reader->at[length] != ' ') {
    return NULL;
  }
  char *value = reader->at + length + 1;
  *end = '\0';
  reader->at = end + 1;
  return value;
}

static int no_state(const reader_t *reader, const char *why) {
  return cli_message(CLI_USAGE, "--from %s: %s", reader->path, why);
}

static int differs(const reader_t *reader, const char *what, const char *there,
                   const char *here) {
  return cli_message(CLI_REFUSED, "--from %s: %s is %s there and %s here",
                     reader->path, what, there, here);
}

// The scheme has to be the one asked for, where one is.
static int read_scheme(reader_t *reader, const cli_scheme_t **scheme) {
  const char *here = *scheme != NULL ? (*scheme)->name : NULL;
  const char *there = next_value(reader, "scheme");
  for (size_t i = 0; there != NULL && i < CLI_SCHEMES; i++) {
    if (strcmp(there, cli_schemes[i].name) == 0) {
      *scheme = &cli_schemes[i];
      return here == NULL || strcmp(there, here) == 0
                 ? CLI_DONE
                 : differs(reader, "scheme", there, here);
    }
  }
  return no_state(reader, "no file of --save");
}

static int compare_params(const reader_t *reader, const tf_params_t *there,
                          const tf_params_t *here) {
  char one[CLI_REAL_ROOM], two[CLI_REAL_ROOM];
  for (size_t i = 0; i < TF_PARAMETERS; i++) {
    const tf_real_t a = cli_parameter(there, i), b = cli_parameter(here, i);
    if (memcmp(&a, &b, sizeof a) != 0) {
      (void)cli_write_real(one, a);
      (void)cli_write_real(two, b);
      return differs(reader, tf_parameter_ranges[i].name, one, two);
    }
  }
  const struct {
    const char *name, *there, *here;
  } words[] = {
      {"law", tf_tyre_law_name(there->law), tf_tyre_law_name(here->law)},
      {"rule", tf_rule_name(there->rule), tf_rule_name(here->rule)},
      {"rest", tf_rest_law_name(there->rest), tf_rest_law_name(here->rest)},
      {"with-angle", there->with_angle ? "yes" : "no",
       here->with_angle ? "yes" : "no"}};
  for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
    if (strcmp(words[i].there, words[i].here) != 0) {
      return differs(reader, words[i].name, words[i].there, words[i].here);
    }
  }
  return CLI_DONE;
}

static bool same_profile(const tf_scene_t *a, const tf_scene_t *b) {
  bool same = a->knots == b->knots;
  for (size_t i = 0; same && i < a->knots; i++) {
    same = memcmp(&a->profile[i], &b->profile[i], sizeof a->profile[i]) == 0;
  }
  return same;
}

static int compare_scene(reader_t *reader, const cli_setup_t *setup) {
  cli_scene_file_t file;
  if (strncmp(reader->at, "scene\n", 6) != 0) {
    return no_state(reader, "no file of --save");
  }
  const char *text = reader->at + 6;
  CLI_TRY(cli_scene_parse(&file, reader->path, text, strlen(text)));
  CLI_TRY(compare_params(reader, &file.scene.params, &setup->params));
  return same_profile(&file.scene, setup->scene)
             ? CLI_DONE
             : differs(reader, "the profile of the turntable",
                       "that of its scene", "another one");
}

// Whose inputs the next step has. Returns: whether that can be read.
static bool read_source(reader_t *reader, cli_stand_t *stand) {
  const char *source = next_value(reader, "source");
  if (source == NULL) {
    return true;
  }
  if (strcmp(source, sources[TF_INPUT_SAFE]) == 0) {
    stand->held.source = TF_INPUT_SAFE;
  } else if (strcmp(source, sources[TF_INPUT_SET]) == 0) {
    stand->held.source = TF_INPUT_SET;
  }
  return stand->held.source != TF_INPUT_SCENE;
}

static int read_values(reader_t *reader, cli_stand_t *stand) {
  uint64_t whole[WHOLES] = {0};
  const char *why = "";
  const char *value = next_value(reader, "inputs");
  bool good = value != NULL && strlen(value) == 8 &&
              strspn(value, "0123456789abcdef") == 8;
  stand->inputs = good ? (uint32_t)strtoul(value, NULL, 16) : 0;
  good = good && read_source(reader, stand);
  const size_t held = stand->held.source != TF_INPUT_SCENE;
  for (size_t i = 0; i < WHOLES - HELD_WHOLES + held * HELD_WHOLES; i++) {
    value = good ? next_value(reader, wholes[i].name) : NULL;
    good = value != NULL && cli_read_whole(value, 0, wholes[i].most, &whole[i]);
  }
  for (size_t i = 0; i < REALS - HELD_REALS + held * HELD_REALS; i++) {
    value = good ? next_value(reader, reals[i].name) : NULL;
    good = value != NULL && cli_read_real(value, real_of(stand, i), &why);
  }
  if (!good) {
    return no_state(reader, "no file of --save");
  }
  stand->state.tick = whole[0];
  stand->state.seed = (uint32_t)whole[1];
  stand->state.mode = (uint8_t)whole[2];
  stand->report.mode = (uint8_t)whole[3];
  stand->report.set = (uint8_t)whole[4];
  stand->report.choices = (uint8_t)whole[5];
  stand->report.status = (tf_status_t)whole[6];
  stand->held.deadman = (uint32_t)whole[7];
  stand->held.left = (uint32_t)whole[8];
  return CLI_DONE;
}

// The checksum says that the file is as it was written, not that a run wrote
// it.
static int check_stand(const reader_t *reader, cli_stand_t *stand) {
  const tf_state_t *x = &stand->state;
  for (size_t i = 0; i < REALS; i++) {
    if (!isfinite(*real_of(stand, i))) {
      return cli_message(CLI_REFUSED, "--from %s: %s is not finite",
                         reader->path, reals[i].name);
    }
  }
  const double reach =
      fabs((double)x->r) + fabs((double)x->v) + fabs((double)x->w);
  return reach <= (double)TF_STATE_LIMIT
             ? CLI_DONE
             : cli_message(CLI_REFUSED,
                           "--from %s: |r| + |v| + |omega| = %g, beyond %g",
                           reader->path, reach, (double)TF_STATE_LIMIT);
}

// Cuts the last line off, the checksum. crc: out. Returns: whether it is right.
static bool is_whole(char *text, size_t size, uint32_t *crc) {
  char line[CRC_LINE + 1];
  if (size < CRC_LINE || memchr(text, 0, size) != NULL) {
    return false;
  }
  *crc = cli_crc(0, text, size - CRC_LINE);
  (void)snprintf(line, sizeof line, "crc32 %08" PRIx32 "\n", *crc);
  const bool right = memcmp(text + size - CRC_LINE, line, CRC_LINE) == 0;
  text[size - CRC_LINE] = '\0';
  return right;
}

int cli_state_parse(cli_stand_t *stand, const char *path, char *text,
                    size_t size, const cli_setup_t *setup,
                    const cli_scheme_t **scheme) {
  reader_t reader = {path, text};
  *stand = (cli_stand_t){.state = {.r = 0}};
  if (strncmp(text, "twofold-state ", 14) != 0 || strchr(text, '\n') == NULL) {
    return no_state(&reader, "no file of --save");
  }
  if (!is_whole(text, size, &stand->hash)) {
    return cli_message(CLI_REFUSED,
                       "--from %s: cut off or changed: its checksum is wrong",
                       path);
  }
  const char *version = next_value(&reader, "twofold-state");
  if (strcmp(version, VERSION) != 0) {
    return differs(&reader, "its version (run up to it again, with --save)",
                   version, VERSION);
  }
  const char *number = next_value(&reader, "number");
  if (number == NULL) {
    return no_state(&reader, "no file of --save");
  }
  if (strcmp(number, CLI_NUMBER_TYPE) != 0) {
    return differs(&reader, "number", number, CLI_NUMBER_TYPE);
  }
  CLI_TRY(read_scheme(&reader, scheme));
  CLI_TRY(read_values(&reader, stand));
  CLI_TRY(check_stand(&reader, stand));
  return compare_scene(&reader, setup);
}

int cli_state_read(cli_stand_t *stand, const char *path,
                   const cli_setup_t *setup, const cli_scheme_t **scheme) {
  char text[CLI_STATE_BYTES + 1];
  const reader_t reader = {path, text};
  FILE *file = fopen(path, "r");
  if (file == NULL) {
    return no_state(&reader, strerror(errno));
  }
  const size_t size = fread(text, 1, sizeof text - 1, file);
  const int error = ferror(file) != 0 ? errno : 0;
  (void)fclose(file);
  if (error != 0) {
    return no_state(&reader, strerror(error));
  }
  text[size] = '\0';
  return cli_state_parse(stand, path, text, size, setup, scheme);
}
