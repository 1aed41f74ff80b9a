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

#include "../setup/scene_file.h"
#include "run.h"

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
// By tf_input_source_t; the scene's own have no line.
static const char *const sources[] = {"", "outside", "safe"};
#define SOURCES (sizeof sources / sizeof sources[0])

// Whole members have 8, 4 or 1 bytes.

static uint64_t whole_of(const cli_stand_t *stand, size_t i) {
  const void *at = (const char *)stand + members[i].at;
  return members[i].size == 8   ? *(const uint64_t *)at
         : members[i].size == 4 ? *(const uint32_t *)at
                                : *(const uint8_t *)at;
}

static void put_whole(cli_stand_t *stand, size_t i, uint64_t value) {
  void *at = (char *)stand + members[i].at;
  if (members[i].size == 8)
    *(uint64_t *)at = value;
  else if (members[i].size == 4)
    *(uint32_t *)at = (uint32_t)value;
  else
    *(uint8_t *)at = (uint8_t)value;
}

size_t cli_state_print(const cli_stand_t *stand, const cli_setup_t *setup,
                       char out[CLI_STATE_BYTES]) {
  cli_buffer_t text = {out, 0, CLI_STATE_BYTES, false};
  const bool holds = stand->held.source != TF_INPUT_SCENE;
  cli_add_form(&text, "twofold-state %s\nnumber %s\nscheme %s\ninputs %08x\n",
               VERSION, CLI_NUMBER_TYPE, motion_scheme_name(setup->scheme),
               stand->inputs);
  if (holds) cli_add_form(&text, "source %s\n", sources[stand->held.source]);
  for (size_t i = 0; i < MEMBERS; i++) {
    if (members[i].held && !holds) continue;
    cli_add_form(&text, "%s ", members[i].name);
    if (members[i].most > 0) {
      cli_add_count(&text, whole_of(stand, i));
    } else {
      tf_real_t value;
      memcpy(&value, (const char *)stand + members[i].at, sizeof value);
      cli_add_real(&text, value);
    }
    cli_add(&text, "\n");
  }
  cli_add(&text, "scene\n");
  cli_scene_print(setup->scene, &setup->params, &text);
  cli_add_form(&text, "crc32 %08x\n", cli_crc(0, out, text.used));
  return text.used;
}

typedef struct {
  const char *path;
  char *at; // what is still to be read
} reader_t;

// The value of the next line if it has this key; else empty.
static const char *next_value(reader_t *reader, const char *key) {
  const size_t length = strlen(key);
  char *end = strchr(reader->at, '\n');
  if (end == NULL || strncmp(reader->at, key, length) != 0 ||
      reader->at[length] != ' ')
    return "";
  const char *value = reader->at + length + 1;
  *end = '\0';
  reader->at = end + 1;
  return value;
}

static int no_state(const reader_t *reader) {
  return cli_usage("--from %s: not from --save", reader->path);
}

// Refuses what is not the same there, in the file, as here.
static int same(const reader_t *reader, const char *what, const char *there,
                const char *here) {
  if (there[0] == '\0') return no_state(reader);
  if (strcmp(there, here) == 0) return CLI_DONE;
  return cli_refuse("--from %s: %s is %s there and %s here", reader->path, what,
                    there, here);
}

static int read_scheme(reader_t *reader, cli_setup_t *setup) {
  const char *there = next_value(reader, "scheme");
  for (unsigned i = 0; i < MOTION_SCHEMES; i++) {
    if (strcmp(there, motion_scheme_name(i)) == 0) {
      const bool open = setup->scheme == MOTION_SCHEMES;
      const char *here = open ? there : motion_scheme_name(setup->scheme);
      setup->scheme = (motion_scheme_t)i;
      return same(reader, "scheme", there, here);
    }
  }
  return no_state(reader);
}

static int compare_scene(const reader_t *reader, const cli_setup_t *setup) {
  cli_scene_file_t file;
  if (strncmp(reader->at, "scene\n", 6) != 0) return no_state(reader);
  const char *text = reader->at + 6;
  CLI_TRY(cli_scene_parse(&file, reader->path, text, strlen(text)));
  const tf_params_t *there = &file.scene.params, *here = &setup->params;
  for (size_t i = 0; i < TF_PARAMETERS; i++) {
    char theirs[CLI_REAL_ROOM], ours[CLI_REAL_ROOM];
    (void)cli_write_real(theirs, cli_parameter(there, i));
    (void)cli_write_real(ours, cli_parameter(here, i));
    CLI_TRY(same(reader, tf_parameter_ranges[i].name, theirs, ours));
  }
  CLI_TRY(same(reader, "law", tf_tyre_law_name(there->law),
               tf_tyre_law_name(here->law)));
  CLI_TRY(same(reader, "rest", tf_rest_law_name(there->rest),
               tf_rest_law_name(here->rest)));
  CLI_TRY(same(reader, "rule", tf_rule_name(there->rule),
               tf_rule_name(here->rule)));
  CLI_TRY(same(reader, "with-angle", there->with_angle ? "yes" : "no",
               here->with_angle ? "yes" : "no"));
  const bool same_profile =
      file.scene.knots == setup->scene->knots &&
      memcmp(file.scene.profile, setup->scene->profile,
             file.scene.knots * sizeof *file.scene.profile) == 0;
  return same(reader, "the profile of the turntable", "that of its scene",
              same_profile ? "that of its scene" : "another one");
}

// Reads a member. The checksum says that the file is as it was written, not
// that a run wrote it.
static int read_member(reader_t *reader, size_t i, cli_stand_t *stand) {
  const char *why = "";
  uint64_t whole = 0;
  tf_real_t real = 0;
  const char *value = next_value(reader, members[i].name);
  if (members[i].most > 0) {
    if (!cli_read_whole(value, 0, members[i].most, &whole))
      return no_state(reader);
    put_whole(stand, i, whole);
    return CLI_DONE;
  }
  if (!cli_read_real(value, &real, &why)) return no_state(reader);
  memcpy((char *)stand + members[i].at, &real, sizeof real);
  if (isfinite(real)) return CLI_DONE;
  return cli_refuse("--from %s: %s is not finite", reader->path,
                    members[i].name);
}

static int read_values(reader_t *reader, cli_stand_t *stand) {
  const tf_state_t *x = &stand->state;
  const char *hash = next_value(reader, "inputs");
  if (strlen(hash) != 8 || strspn(hash, "0123456789abcdef") != 8)
    return no_state(reader);
  stand->inputs = (uint32_t)strtoul(hash, NULL, 16);
  const char *source = next_value(reader, "source");
  size_t found = 0;
  while (found < SOURCES && strcmp(source, sources[found]) != 0) found++;
  if (found == SOURCES) return no_state(reader);
  stand->held.source = (tf_input_source_t)found;
  for (size_t i = 0; i < MEMBERS; i++)
    if (!members[i].held || found > 0) CLI_TRY(read_member(reader, i, stand));
  const double reach =
      fabs((double)x->r) + fabs((double)x->v) + fabs((double)x->w);
  if (reach <= (double)TF_STATE_LIMIT) return CLI_DONE;
  return cli_refuse("--from %s: |r| + |v| + |omega| = %g, beyond %g",
                    reader->path, reach, (double)TF_STATE_LIMIT);
}

// Cuts the last line off, the checksum. crc: out. Returns: whether it is right.
static bool is_whole(char *text, size_t size, uint32_t *crc) {
  char line[CRC_LINE + 1];
  if (size < CRC_LINE || memchr(text, 0, size) != NULL) return false;
  *crc = cli_crc(0, text, size - CRC_LINE);
  (void)snprintf(line, sizeof line, "crc32 %08" PRIx32 "\n", *crc);
  const bool right = memcmp(text + size - CRC_LINE, line, CRC_LINE) == 0;
  text[size - CRC_LINE] = '\0';
  return right;
}

int cli_state_parse(cli_stand_t *stand, const char *path, char *text,
                    size_t size, cli_setup_t *setup) {
  reader_t reader = {path, text};
  *stand = (cli_stand_t){.state = {.r = 0}};
  if (strncmp(text, "twofold-state ", 14) != 0 || strchr(text, '\n') == NULL)
    return no_state(&reader);
  if (!is_whole(text, size, &stand->hash)) {
    return cli_refuse("--from %s: cut off or changed: its checksum is wrong",
                      path);
  }
  CLI_TRY(same(&reader, "its version (run up to it again, with --save)",
               next_value(&reader, "twofold-state"), VERSION));
  CLI_TRY(
      same(&reader, "number", next_value(&reader, "number"), CLI_NUMBER_TYPE));
  CLI_TRY(read_scheme(&reader, setup));
  CLI_TRY(read_values(&reader, stand));
  return compare_scene(&reader, setup);
}

int cli_state_read(cli_stand_t *stand, const char *path, cli_setup_t *setup) {
  char *text = NULL;
  size_t size = 0;
  CLI_TRY(cli_read_text("--from ", path, CLI_STATE_BYTES, &text, &size));
  const int code = cli_state_parse(stand, path, text, size, setup);
  free(text);
  return code;
}
