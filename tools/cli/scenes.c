// The scenes: a list of them, and one as text that can be changed.

#include "scenes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "host/output.h"
#include "setup/names.h"
#include "setup/scene.h"
#include "setup/scene_file.h"
#include "setup/scene_keys.h"
#include "setup/setup.h"
#include "text/message.h"
#include "text/options.h"

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

typedef struct {
  const tf_scene_t *scene;
  cli_settings_t settings;
  const char *select, *out;
} scene_args_t;

static int read_set(void *to, const cli_given_t *option) {
  scene_args_t *args = to;
  return cli_settings_add(&args->settings, option->name, option->value);
}

static int read_dt(void *to, const cli_given_t *option) {
  scene_args_t *args = to;
  return cli_settings_add_named(&args->settings, option->name, "dt",
                                option->value);
}

static int read_select(void *to, const cli_given_t *option) {
  scene_args_t *args = to;
  args->select = option->value;
  return CLI_DONE;
}

static int read_out(void *to, const cli_given_t *option) {
  scene_args_t *args = to;
  return cli_read_path(option, &args->out);
}

static int take(void *to, const char *word) {
  scene_args_t *args = to;
  return cli_take_scene(&args->scene, word);
}

static const cli_option_t options[] = {{"--set", read_set, CLI_REPEATABLE},
                                       {"--dt", read_dt, CLI_REPEATABLE},
                                       {"--select", read_select, CLI_ONCE},
                                       {"--out", read_out, CLI_WRITES}};

// The scene with what the command line has changed of it.
static int apply(const scene_args_t *args, tf_scene_t *scene) {
  cli_setup_t setup;
  int code = cli_setup_read(&setup, args->scene, &args->settings, args->select);
  if (code == CLI_DONE && args->select != NULL &&
      strchr(args->select, ':') != NULL) {
    return cli_message(CLI_USAGE,
                       "--select %s: a scene has no seed; give it to 'run'",
                       args->select);
  }
  if (code == CLI_DONE && setup.set_start[CLI_START_PHI] != NULL) {
    return cli_message(CLI_USAGE,
                       "--set %s: a scene starts with phi = 0; give it to "
                       "'run'",
                       setup.set_start[CLI_START_PHI]->text);
  }
  code = code == CLI_DONE ? cli_setup_machine(&setup) : code;
  code = code == CLI_DONE ? cli_setup_start(&setup) : code;
  if (code != CLI_DONE) {
    return code;
  }
  *scene = *args->scene;
  scene->params = setup.params;
  scene->r = setup.start[CLI_START_R];
  scene->omega = setup.start[CLI_START_OMEGA];
  scene->v_is_given = !setup.v_from_h;
  scene->v = setup.v_from_h ? 0 : setup.start[CLI_START_V];
  scene->h = setup.v_from_h ? setup.start[CLI_START_H] : 0;
  return CLI_DONE;
}

static int write_text(const scene_args_t *args, const char *text,
                      size_t length) {
  cli_output_t *output = calloc(1, sizeof *output);
  if (output == NULL) {
    return cli_message(CLI_STOPPED, "out of memory");
  }
  int code = cli_output_begin(output, "--out", args->out);
  if (code == CLI_DONE) {
    (void)cli_output_lines(output, text, length);
    code = cli_output_end(output, CLI_DONE);
  }
  free(output);
  return code;
}

int cli_scene(int argc, char *const argv[]) {
  static const cli_syntax_t syntax = {"scene", options,
                                      sizeof options / sizeof options[0], take};
  char text[CLI_SCENE_BYTES];
  cli_buffer_t buffer = {text, 0, sizeof text, false};
  scene_args_t args;
  tf_scene_t scene;
  memset(&args, 0, sizeof args);
  int code = cli_read_words(&syntax, &args, argc, argv);
  code = code == CLI_DONE ? cli_need_scene(args.scene, "scene") : code;
  code = code == CLI_DONE ? apply(&args, &scene) : code;
  if (code != CLI_DONE) {
    return code;
  }
  cli_add(&buffer, CLI_SCENE_TITLE);
  cli_scene_print(&scene, &scene.params, &buffer);
  return write_text(&args, text, buffer.used);
}

static const char page[] =
    "usage: twofold scene SCENE [OPTION]...\n"
    "\n"
    "Prints a scene as text. All commands, and 'make firmware' and 'make "
    "fmu',\n"
    "take a file of such text as SCENE; it reads back to the same bits. A\n"
    "word with a . or a / in it names a file, any other one a scene of\n"
    "'twofold scenes'.\n"
    "\n"
    "  --set NAME=VALUE     as in 'twofold help run', likewise the next two\n"
    "  --dt S\n"
    "  --select RULE\n"
    "  --out FILE           instead of standard output\n"
    "\n"
    "A line is KEY VALUE or KEY = VALUE; # begins a comment. No key may be\n"
    "given twice. A file may begin with 'based-on SCENE', one of 'twofold\n"
    "scenes', and then gives only what differs. For example:\n"
    "\n"
    "  based-on chaos\n"
    "  kappa 0.3        # m\n"
    "  h 0              # starts in stick\n"
    "\n"
    "keys:\n"
    "  name, shows, leaves-out   text; name: that of the file if not given\n"
    "  law, rest, rule           words as in 'twofold help run'\n"
    "  with-angle                yes: the angle phi is integrated; or no\n"
    "  r, omega, v or h          the start [m, rad/s, m/s, m/s]\n"
    "  t-end                     how long it runs by default [s]\n"
    "  profile                   speed of the turntable, linear between up to\n"
    "                            8 knots TIME:SPEED [s:rad/s]; or none\n"
    "and the parameters:\n";

void cli_scene_help(void) {
  (void)fputs(page, stdout);
  cli_print_ranges();
}
