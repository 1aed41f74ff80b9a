// The scenes: a list of them, and one as text that can be changed.

#include <stdio.h>
#include <string.h>

#include "command.h"
#include "host/output.h"
#include "setup/scene_file.h"
#include "setup/setup.h"
#include "text/text.h"

int cli_scenes(int argc, char *const argv[]) {
  int width = 0;
  if (argc > 0) {
    return cli_message(CLI_USAGE, "scenes: unexpected argument '%s'", argv[0]);
  }
  for (size_t i = 0; i < TF_SCENES; i++) {
    const int length = (int)strlen(tf_scenes[i]->name);
    width = length > width ? length : width;
  }
  for (size_t i = 0; i < TF_SCENES; i++) {
    (void)printf("%-*s  %s (leaves out: %s)\n", width, tf_scenes[i]->name,
                 tf_scenes[i]->shows, tf_scenes[i]->leaves_out);
  }
  return cli_finish_stdout();
}

// The scene with what the command line has changed of it.
static int apply(const cli_args_t *args, tf_scene_t *scene) {
  cli_setup_t setup;
  CLI_TRY(cli_setup_read(&setup, args->scene, &args->settings, args->select));
  if (args->select != NULL && strchr(args->select, ':') != NULL) {
    return cli_message(CLI_USAGE,
                       "--select %s: a scene has no seed; give it to 'run'",
                       args->select);
  }
  if (setup.set[CLI_PHI] != NULL) {
    return cli_message(CLI_USAGE,
                       "--set %s: a scene starts with phi = 0; give it to "
                       "'run'",
                       setup.set[CLI_PHI]->text);
  }
  CLI_TRY(cli_setup_machine(&setup));
  CLI_TRY(cli_setup_start(&setup));
  *scene = *args->scene;
  scene->params = setup.params;
  scene->r = setup.start.state.r;
  scene->omega = setup.start.state.w;
  scene->v_is_given = !setup.start.from_h;
  scene->v = setup.start.from_h ? 0 : setup.start.state.v;
  scene->h = setup.start.from_h ? setup.start.h : 0;
  return CLI_DONE;
}

int cli_scene(const cli_args_t *args) {
  static cli_output_t output;
  char text[CLI_SCENE_BYTES];
  cli_buffer_t buffer = {text, 0, sizeof text, false};
  tf_scene_t scene;
  CLI_TRY(apply(args, &scene));
  cli_add(&buffer, CLI_SCENE_TITLE);
  cli_scene_print(&scene, &scene.params, &buffer);
  return cli_output_write(&output, "--out", args->out, text, buffer.used);
}
