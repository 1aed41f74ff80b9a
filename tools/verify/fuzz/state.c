// A file of --save to the reader of --from. The input is a list of changes to
// the file that a run of some scene has left, whose checksum is made right
// again or not: random text would never have one. A file that is not changed
// is accepted. What is accepted is a state that a step may leave, and, saved
// again, reads back to the same bits.
#include <stdio.h>

#include "cli/run/run.h"
#include "cli/text/text.h"
#include "verify/fuzz/fuzz.h"

#define CRC_LINE 15
#define MAX_CHANGES 16

typedef struct {
  cli_setup_t setup;
  char text[CLI_STATE_BYTES + 1];
  size_t size;
} file_t;

// What a run of a scene leaves after some steps.
static const char *make_file(file_t *file, fuzz_bytes_t *in) {
  static const cli_settings_t none = {.count = 0};
  cli_stand_t stand = {.state = {.r = 0}};
  const tf_scene_t *scene = tf_scenes[fuzz_byte(in) % TF_SCENES];
  const unsigned scheme = fuzz_byte(in) % MOTION_SCHEMES;
  FUZZ_HOLD(cli_setup_read(&file->setup, scene, &none, NULL) == CLI_DONE);
  file->setup.scheme = (motion_scheme_t)scheme;
  FUZZ_HOLD(cli_setup_machine(&file->setup) == CLI_DONE);
  FUZZ_HOLD(cli_setup_start(&file->setup) == CLI_DONE);
  motion_t system = file->setup.motion;
  const unsigned byte = fuzz_byte(in);
  stand.held = (tf_simulation_t){.source = (tf_input_source_t)(byte / 16 % 3),
                                 .deadman = byte,
                                 .left = byte / 2,
                                 .input = file->setup.input};
  stand.report = system.report;
  for (unsigned n = byte % 16u; n > 0; n--) {
    const tf_input_t *input = &file->setup.input;
    if (motion_step(&system, file->setup.scheme, input) < 0) break;
    stand.report = system.report;
  }
  stand.state = system.state;
  stand.compensation = system.low;
  file->size = cli_state_print(&stand, &file->setup, file->text);
  FUZZ_HOLD(file->size < CLI_STATE_BYTES);
  return NULL;
}

// Replaces some bytes by others. Returns: the new size.
static size_t change(char *text, size_t size, fuzz_bytes_t *in) {
  const size_t at = (fuzz_byte(in) | (size_t)fuzz_byte(in) << 8) % (size + 1);
  size_t out = fuzz_byte(in) % 32u, count = fuzz_byte(in) % 32u;
  if (out > size - at) out = size - at;
  if (count > CLI_STATE_BYTES - (size - out)) count = 0;
  memmove(text + at + count, text + at + out, size - at - out);
  for (size_t i = 0; i < count; i++) text[at + i] = (char)fuzz_byte(in);
  return size - out + count;
}

// Returns: whether the file is as it was.
static bool change_file(file_t *file, fuzz_bytes_t *in) {
  const bool seals = fuzz_byte(in) % 4u != 0;
  const unsigned changes = fuzz_byte(in) % MAX_CHANGES;
  if (seals) file->size -= CRC_LINE;
  for (unsigned i = 0; i < changes; i++)
    file->size = change(file->text, file->size, in);
  if (seals && file->size + CRC_LINE <= CLI_STATE_BYTES) {
    (void)snprintf(file->text + file->size, CRC_LINE + 1, "crc32 %08lx\n",
                   (unsigned long)cli_crc(0, file->text, file->size));
    file->size += CRC_LINE;
  }
  file->text[file->size] = '\0';
  return changes == 0;
}

static const char *judge(const cli_stand_t *stand, const file_t *file) {
  static char again[CLI_STATE_BYTES + 1];
  cli_stand_t copy;
  cli_setup_t setup = file->setup;
  const tf_state_t *x = &stand->state, *y = &copy.state;
  FUZZ_HOLD(fuzz_in_reach(x) && fuzz_finite(x->phi) && x->mode < TF_MODES);
  FUZZ_HOLD(fuzz_finite(stand->report.force.F));
  FUZZ_HOLD(fuzz_finite(stand->report.residual));
  FUZZ_HOLD(stand->report.mode < TF_MODES && stand->report.status >= 0);
  const size_t size = cli_state_print(stand, &file->setup, again);
  again[size] = '\0';
  setup.scheme = MOTION_SCHEMES;
  FUZZ_HOLD(cli_state_parse(&copy, "again", again, size, &setup) == CLI_DONE);
  FUZZ_HOLD(setup.scheme == file->setup.scheme);
  FUZZ_HOLD(fuzz_same(x->r, y->r) && fuzz_same(x->v, y->v));
  FUZZ_HOLD(fuzz_same(x->w, y->w) && fuzz_same(x->phi, y->phi));
  FUZZ_HOLD(x->tick == y->tick && x->seed == y->seed && x->mode == y->mode);
  FUZZ_HOLD(fuzz_same(stand->compensation.phi, copy.compensation.phi));
  FUZZ_HOLD(fuzz_same(stand->report.force.M, copy.report.force.M));
  FUZZ_HOLD(stand->held.source == copy.held.source);
  FUZZ_HOLD(stand->held.left == copy.held.left);
  FUZZ_HOLD(fuzz_same(stand->held.input.alpha, copy.held.input.alpha));
  return NULL;
}

const char *fuzz_state(const uint8_t *data, size_t size) {
  static file_t file;
  cli_stand_t stand;
  fuzz_bytes_t in = {data, data + size};
  FUZZ_HOLD_ALL(make_file(&file, &in));
  const bool same = change_file(&file, &in);
  cli_setup_t setup = file.setup;
  if (fuzz_byte(&in) % 2u == 0) setup.scheme = MOTION_SCHEMES;
  const int code =
      cli_state_parse(&stand, "fuzz.state", file.text, file.size, &setup);
  FUZZ_HOLD(code == CLI_DONE || code == CLI_USAGE || code == CLI_REFUSED);
  FUZZ_HOLD(!same || (code == CLI_DONE && setup.scheme == file.setup.scheme));
  return code == CLI_DONE ? judge(&stand, &file) : NULL;
}
