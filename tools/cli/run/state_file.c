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

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../setup/scene_file.h"
#include "../setup/setup.h"
#include "../text/lines.h"
#include "../text/message.h"
#include "../text/number.h"
#include "../text/shard.h"
#include "record.h"

#define VERSION "3"
#define CRC_LINE 15 // "crc32 0123abcd\n"

// The members of cli_stand_t in the order of their lines. most: of a whole
// number; 0: it is a tf_real_t. held: only where inputs by a command hold.
#define MEMBER(name) \
  offsetof(cli_stand_t, name), sizeof(((cli_stand_t *)0)->name)
static const struct {
  const char *name;
  size_t at, size;
  uint64_t most;
  bool held;
} members[] = {{"tick", MEMBER(state.tick), UINT64_C(1) << 62, false},
               {"seed", MEMBER(state.seed), UINT32_MAX, false},
               {"mode", MEMBER(state.mode), TF_MODES - 1, false},
               {"report-mode", MEMBER(report.mode), TF_MODES - 1, false},
               {"set", MEMBER(report.set), (1u << TF_MODES) - 1, false},
               {"choices", MEMBER(report.choices), TF_MODES, false},
               {"status", MEMBER(report.status), TF_STALLED, false},
               {"deadman", MEMBER(held.deadman), UINT32_MAX, true},
               {"left", MEMBER(held.left), UINT32_MAX, true},
               {"r", MEMBER(state.r), 0, false},
               {"v", MEMBER(state.v), 0, false},
               {"omega", MEMBER(state.w), 0, false},
               {"phi", MEMBER(state.phi), 0, false},
               {"compensation-r", MEMBER(compensation.r), 0, false},
               {"compensation-v", MEMBER(compensation.v), 0, false},
               {"compensation-w", MEMBER(compensation.w), 0, false},
               {"compensation-phi", MEMBER(compensation.phi), 0, false},
               {"force-F", MEMBER(report.force.F), 0, false},
               {"force-M", MEMBER(report.force.M), 0, false},
               {"slip-h", MEMBER(report.slip.h), 0, false},
               {"slip-g", MEMBER(report.slip.g), 0, false},
               {"delassus", MEMBER(report.delassus), 0, false},
               {"residual", MEMBER(report.residual), 0, false},
               {"held-omega0", MEMBER(held.input.omega0), 0, true},
               {"held-r0", MEMBER(held.input.r0), 0, true},
               {"held-force", MEMBER(held.input.force), 0, true},
               {"held-torque", MEMBER(held.input.torque), 0, true},
               {"held-alpha", MEMBER(held.input.alpha), 0, true}};
#define MEMBERS (sizeof members / sizeof members[0])
static const char *const sources[] = {"scene", "outside", "safe"};

// The value of a whole member; and puts one there.
static uint64_t whole_of(const cli_stand_t *stand, size_t i) {
  const void *at = (const char *)stand + members[i].at;
  return members[i].size == 8   ? *(const uint64_t *)at
         : members[i].size == 4 ? *(const uint32_t *)at
                                : *(const uint8_t *)at;
}

static void put_whole(cli_stand_t *stand, size_t i, uint64_t value) {
  void *at = (char *)stand + members[i].at;
  if (members[i].size == 8) {
    *(uint64_t *)at = value;
  } else if (members[i].size == 4) {
    *(uint32_t *)at = (uint32_t)value;
  } else {
    *(uint8_t *)at = (uint8_t)value;
  }
}

static tf_real_t real_of(const cli_stand_t *stand, size_t i) {
  tf_real_t value;
  memcpy(&value, (const char *)stand + members[i].at, sizeof value);
  return value;
}

size_t cli_state_print(const cli_stand_t *stand, const cli_setup_t *setup,
                       const cli_scheme_t *scheme, char out[CLI_STATE_BYTES]) {
  cli_buffer_t text = {out, 0, CLI_STATE_BYTES, false};
  const bool holds = stand->held.source != TF_INPUT_SCENE;
  cli_add_form(&text, "twofold-state %s\nnumber %s\nscheme %s\ninputs ",
               VERSION, CLI_NUMBER_TYPE, scheme->name);
  cli_add_hash(&text, stand->inputs);
  cli_add(&text, "\n");
  if (holds) {
    cli_add_form(&text, "source %s\n", sources[stand->held.source]);
  }
  for (size_t i = 0; i < MEMBERS; i++) {
    if (members[i].held && !holds) {
      continue;
    }
    cli_add_form(&text, "%s ", members[i].name);
    if (members[i].most > 0) {
      cli_add_count(&text, whole_of(stand, i));
    } else {
      cli_add_real(&text, real_of(stand, i));
    }
    cli_add(&text, "\n");
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
  for (size_t i = 0; there != NULL && i < MOTION_SCHEMES; i++) {
    if (strcmp(there, cli_schemes[i].name) == 0) {
      *scheme = &cli_schemes[i];
      return here == NULL || strcmp(there, here) == 0
                 ? CLI_DONE
                 : differs(reader, "scheme", there, here);
    }
  }
  return no_state(reader, "no file of --save");
}

#define VALUE_ROOM 512

// The value of a key in the text of a scene, without its unit; or empty.
static const char *value_in(const char *scene, const char *key,
                            char value[VALUE_ROOM]) {
  const size_t length = strlen(key);
  value[0] = '\0';
  while (*scene != '\0') {
    const char *begin = scene + length;
    if (strncmp(scene, key, length) == 0 && *begin == ' ') {
      (void)snprintf(value, VALUE_ROOM, "%.*s", (int)strcspn(begin, "\n#"),
                     begin);
    }
    scene += strcspn(scene, "\n");
    scene += *scene == '\n';
  }
  return cli_trim(value);
}

// One function prints both scenes, so equal values have equal text.
static int compare_scene(const reader_t *reader, const cli_setup_t *setup) {
  static const char *const words[] = {"law", "rule", "rest", "with-angle",
                                      "profile"};
  const size_t count = TF_PARAMETERS + sizeof words / sizeof words[0];
  char theirs[CLI_STATE_BYTES], ours[CLI_STATE_BYTES];
  char there_room[VALUE_ROOM], here_room[VALUE_ROOM];
  cli_buffer_t as_read = {theirs, 0, sizeof theirs, false};
  cli_buffer_t as_set = {ours, 0, sizeof ours, false};
  cli_scene_file_t file;
  if (strncmp(reader->at, "scene\n", 6) != 0) {
    return no_state(reader, "no file of --save");
  }
  const char *text = reader->at + 6;
  CLI_TRY(cli_scene_parse(&file, reader->path, text, strlen(text)));
  cli_scene_print(&file.scene, &file.scene.params, &as_read);
  cli_scene_print(setup->scene, &setup->params, &as_set);
  for (size_t i = 0; i < count; i++) {
    const char *key = i < TF_PARAMETERS ? tf_parameter_ranges[i].name
                                        : words[i - TF_PARAMETERS];
    const char *there = value_in(theirs, key, there_room);
    const char *here = value_in(ours, key, here_room);
    if (strcmp(there, here) != 0) {
      return i + 1 < count ? differs(reader, key, there, here)
                           : differs(reader, "the profile of the turntable",
                                     "that of its scene", "another one");
    }
  }
  return CLI_DONE;
}

// Whose inputs the next step has. Returns: whether that can be read.
static bool read_source(reader_t *reader, cli_stand_t *stand) {
  const char *source = next_value(reader, "source");
  unsigned i = 0;
  while (source != NULL && i < 3 && strcmp(source, sources[i]) != 0) i++;
  stand->held.source = (tf_input_source_t)(i % 3);
  return source == NULL || stand->held.source != TF_INPUT_SCENE;
}

static int read_values(reader_t *reader, cli_stand_t *stand) {
  const char *why = "";
  const char *value = next_value(reader, "inputs");
  bool good = value != NULL && strlen(value) == 8 &&
              strspn(value, "0123456789abcdef") == 8;
  stand->inputs = good ? (uint32_t)strtoul(value, NULL, 16) : 0;
  good = good && read_source(reader, stand);
  for (size_t i = 0; i < MEMBERS && good; i++) {
    uint64_t whole = 0;
    tf_real_t real = 0;
    if (members[i].held && stand->held.source == TF_INPUT_SCENE) {
      continue;
    }
    value = next_value(reader, members[i].name);
    if (members[i].most > 0) {
      good = value != NULL && cli_read_whole(value, 0, members[i].most, &whole);
      put_whole(stand, i, whole);
    } else {
      good = value != NULL && cli_read_real(value, &real, &why);
      memcpy((char *)stand + members[i].at, &real, sizeof real);
    }
  }
  return good ? CLI_DONE : no_state(reader, "no file of --save");
}

// The checksum says that the file is as it was written, not that a run wrote
// it.
static int check_stand(const reader_t *reader, const cli_stand_t *stand) {
  const tf_state_t *x = &stand->state;
  for (size_t i = 0; i < MEMBERS; i++) {
    if (members[i].most == 0 && !isfinite(real_of(stand, i))) {
      return cli_message(CLI_REFUSED, "--from %s: %s is not finite",
                         reader->path, members[i].name);
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
  char *text = NULL;
  size_t size = 0;
  CLI_TRY(cli_read_text("--from ", path, CLI_STATE_BYTES, &text, &size));
  const int code = cli_state_parse(stand, path, text, size, setup, scheme);
  free(text);
  return code;
}
