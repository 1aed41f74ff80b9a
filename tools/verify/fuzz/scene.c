// Text to the reader of scenes. What is accepted has its parameters in their
// ranges, and prints as a text that reads back to the same bits; what is
// refused is refused by a code of the command line.
#include "cli/setup/scene_file.h"
#include "cli/text/text.h"
#include "verify/fuzz/fuzz.h"

static int same_knots(const tf_scene_t *a, const tf_scene_t *b) {
  int same = a->knots == b->knots;
  for (int i = 0; same && i < a->knots; i++)
    same = fuzz_same(a->profile[i].t, b->profile[i].t) &&
           fuzz_same(a->profile[i].omega0, b->profile[i].omega0);
  return same;
}

static int same_params(const tf_params_t *a, const tf_params_t *b) {
  for (int i = 0; i < TF_PARAMETERS; i++) {
    const size_t offset = tf_parameter_ranges[i].offset;
    if (memcmp((const char *)a + offset, (const char *)b + offset,
               sizeof(tf_real_t)) != 0)
      return 0;
  }
  return a->law == b->law && a->rule == b->rule && a->rest == b->rest &&
         a->with_angle == b->with_angle;
}

const char *fuzz_scene(const uint8_t *data, size_t size) {
  static cli_scene_file_t file, again;
  static char text[CLI_SCENE_BYTES];
  cli_buffer_t printed = {text, 0, sizeof text, false};
  tf_machine_t machine;
  int code = cli_scene_parse(&file, "fuzz.scene", (const char *)data, size);
  FUZZ_HOLD(code == CLI_DONE || code == CLI_USAGE || code == CLI_REFUSED);
  if (code != CLI_DONE) return NULL;
  const tf_scene_t *a = &file.scene, *b = &again.scene;
  FUZZ_HOLD(tf_prepare(&machine, &a->params, NULL) == TF_OK);
  cli_scene_print(a, &a->params, &printed);
  FUZZ_HOLD(!printed.truncated);
  code = cli_scene_parse(&again, "printed.scene", text, printed.used);
  FUZZ_HOLD(code == CLI_DONE);
  FUZZ_HOLD(same_params(&a->params, &b->params) && same_knots(a, b));
  FUZZ_HOLD(fuzz_same(a->r, b->r) && fuzz_same(a->omega, b->omega));
  FUZZ_HOLD(fuzz_same(a->h, b->h) && fuzz_same(a->v, b->v));
  FUZZ_HOLD(fuzz_same(a->t_end, b->t_end) && a->v_is_given == b->v_is_given);
  FUZZ_HOLD(strcmp(a->name, b->name) == 0);
  FUZZ_HOLD(strcmp(a->shows, b->shows) == 0);
  FUZZ_HOLD(strcmp(a->leaves_out, b->leaves_out) == 0);
  return NULL;
}
