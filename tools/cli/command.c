// The program `twofold`, which links libc, libm and the core: from a command
// line to a command. It is made of these folders; each line includes only
// folders below it (check `arrows` has the same table):
//
//   .          command (with the commands `scenes` and `scene`), table (of
//              the options), options (reads them), help and completions
//   monitor/   the command `monitor`; takes row.h and session.h of run/
//   run/       the command `run`: loop, rows, frames, events, summary
//   analysis/  singularities, regions, design, atlas and tyre
//   diverge/   the command `diverge`. Bottom up: canard, motion (with noise),
//              random, exhaustive, diverge
//   sweep/     the command `sweep`; takes only events.h of run/
//   setup/     a scene, by its name or from a file, with --set and --select
//              becomes a machine with its initial state; schemes, names; what a
//              command line gives (args.h)
//   live/      --live of run and monitor: planes and modes in a terminal
//   host/      what POSIX provides: clock, signals, files, lines, progress;
//              files that are gone on with after a kill (sheet)
//   text/      messages, numbers, options, text in buffers
//
// run, analysis, diverge and sweep do not include each other otherwise.

#include "command.h"

#include <fenv.h>

#include "host/host.h"
#include "host/output.h"
#include "setup/scene_file.h"
#include "text/summary.h"

static int scenes(int argc, char *const argv[]) {
  if (argc > 0) return cli_usage("scenes: unexpected argument '%s'", argv[0]);
  for (size_t i = 0; i < TF_SCENES; i++) {
    (void)printf("%-12s  %s (leaves out: %s)\n", tf_scenes[i]->name,
                 tf_scenes[i]->shows, tf_scenes[i]->leaves_out);
  }
  return cli_finish_stdout();
}

static int version(int argc, char *const argv[]) {
  if (argc > 0) return cli_usage("version: unexpected argument '%s'", argv[0]);
  (void)puts("twofold " TF_VERSION ", tf_real_t is " CLI_NUMBER_TYPE);
  return cli_finish_stdout();
}

// The scene with what the command line has changed of it.
static int apply(const cli_args_t *args, tf_scene_t *scene) {
  cli_setup_t setup;
  CLI_TRY(cli_setup_read(&setup, args->scene, &args->settings, args->select));
  if (args->select != NULL && strchr(args->select, ':') != NULL) {
    return cli_usage("--select %s: a scene has no seed; give it to 'run'",
                     args->select);
  }
  if (setup.set[CLI_PHI] != NULL) {
    return cli_usage("--set %s: a scene starts with phi = 0; give it to 'run'",
                     setup.set[CLI_PHI]->given.value);
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

static int print_scene(const cli_args_t *args) {
  static cli_output_t output;
  char text[CLI_SCENE_BYTES];
  cli_buffer_t buffer = {text, 0, sizeof text, false};
  tf_scene_t scene;
  CLI_TRY(apply(args, &scene));
  cli_add(&buffer, CLI_SCENE_TITLE);
  cli_scene_print(&scene, &scene.params, &buffer);
  return cli_output_write(&output, "--out", args->out, text, buffer.used);
}

const cli_command_t cli_commands[] = {
    {"scenes", "", "list the scenes", .raw = scenes},
    {"scene", "SCENE [OPTION]...",
     "print a scene as a file that can be changed", .bit = CLI_SCENE,
     .perform = print_scene},
    {"run", "SCENE [OPTION]...", "simulate a scene, one row per instant",
     .bit = CLI_RUN, .check = cli_run_check, .perform = cli_run},
    {"monitor", "FILE|DEVICE|- [OPTION]...",
     "decode frames from a board, a file or a pipe", .bit = CLI_MONITOR,
     .of_source = true, .check = cli_monitor_check, .perform = cli_monitor},
    {"singularities", "SCENE [OPTION]...", "all two-folds, as JSON",
     .bit = CLI_SINGULARITIES, .perform = cli_singularities},
    {"regions", "SCENE [OPTION]...",
     "sliding, escaping, crossing: a grid of (r, omega)", .bit = CLI_REGIONS,
     .perform = cli_regions},
    {"design", "SCENE --r R --omega W [OPTION]...",
     "kappa and k2 that put a two-fold at (r, omega)", .bit = CLI_DESIGN,
     .check = cli_analysis_check, .perform = cli_design},
    {"atlas", "SCENE [OPTION]...",
     "for which (r, omega) it is a Teixeira singularity", .bit = CLI_ATLAS,
     .perform = cli_atlas},
    {"tyre", "SCENE [OPTION]...", "force and moment over the slip angle",
     .bit = CLI_TYRE, .perform = cli_tyre},
    {"diverge", "SCENE [OPTION]...",
     "what can follow a two-fold: exits, returns, samples", .bit = CLI_DIVERGE,
     .check = cli_diverge_check, .perform = cli_diverge},
    {"sweep", "SCENE --over NAME=A:B:N [OPTION]...",
     "a grid of settings: what becomes of each point", .bit = CLI_SWEEP,
     .check = cli_sweep_check, .perform = cli_sweep},
    {"completions", "SHELL", "a script by which a shell completes all this",
     .raw = cli_completions},
    {"version", "", "version and number type", .raw = version},
    {"help", "[COMMAND]", "this text, or the options of a command",
     .raw = cli_help},
};
const size_t cli_command_count = sizeof cli_commands / sizeof cli_commands[0];

const cli_command_t *cli_find_command(cli_closest_t *closest) {
  const size_t i = cli_closest_find(closest, cli_commands, cli_command_count,
                                    sizeof cli_commands[0]);
  return i < cli_command_count ? &cli_commands[i] : NULL;
}

static bool has(int argc, char *const argv[], const char *word) {
  int i = 0;
  while (i < argc && strcmp(argv[i], word) != 0) i++;
  return i < argc;
}

static bool asks_for_help(int argc, char *const argv[]) {
  return has(argc, argv, "--help") || has(argc, argv, "-h");
}

static bool asks_for_json(int argc, char *const argv[]) {
  bool asks = has(argc, argv, "--summary=json");
  for (int i = 1; i < argc; i++) {
    asks = asks || (strcmp(argv[i - 1], "--summary") == 0 &&
                    strcmp(argv[i], "json") == 0);
  }
  return asks;
}

static int carry_out(const cli_command_t *command, int argc,
                     char *const argv[]) {
  static cli_args_t args = {.points = 1, .listed = 20, .shard = {1, 1}};
  if (command->raw != NULL) return command->raw(argc, argv);
  args.command = command->name;
  CLI_TRY(cli_read_words(command, &args, argc, argv));
  if (!command->of_source && args.scene == NULL) {
    return cli_usage("%s: which scene? ('twofold scenes' lists them)",
                     command->name);
  }
  if (command->check != NULL) CLI_TRY(command->check(&args));
  return command->perform(&args);
}

// A program that has asked for JSON gets it also where the command ends before
// its summary: the reason and the exit code.
static int perform(const cli_command_t *command, int argc, char *const argv[]) {
  cli_be_quiet(has(argc, argv, "--quiet") || has(argc, argv, "-q"));
  const int code = carry_out(command, argc, argv);
  if (asks_for_json(argc, argv) && !cli_put_ended()) {
    cli_put_begin(command->name);
    cli_put("'message': %s, ", cli_last_message());
    cli_put_exit(code);
  }
  return code;
}

// The benchmarks need several builds of the core, so they belong to make.
static int choose(int argc, char *const argv[]) {
  if (argc < 1) return cli_help(0, argv) == CLI_DONE ? CLI_USAGE : CLI_STOPPED;
  if (asks_for_help(1, argv)) return cli_help(argc - 1, argv + 1);
  if (strcmp(argv[0], "complete") == 0) return cli_complete(argc - 1, argv + 1);
  if (has(1, argv, "--version") || has(1, argv, "-v")) return version(0, NULL);
  const char *name = argv[0];
  cli_closest_t closest = cli_closest_to(name);
  const cli_command_t *command = cli_find_command(&closest);
  if (asks_for_help(argc - 1, argv + 1))
    return cli_help(command != NULL ? 1 : 0, argv);
  if (command != NULL) return perform(command, argc - 1, argv + 1);
  if (strcmp(name, "bench") == 0 || strcmp(name, "stability") == 0)
    return cli_usage("%s is a target of make: 'make %s'", name, name);
  return cli_usage("unknown command '%s'%s ('twofold help' lists them)", name,
                   closest.hint);
}

// What a command reports is part of what it was asked for: where it could not
// be written, on a full disk, the command was not done. Standard output is
// looked after by each command, which names it.
//
// A library that was loaded before may have set another rounding mode or FTZ.
// The process is this program's own, so it takes the usual ones back; what a
// compiler has done stays.
int main(int argc, char *argv[]) {
  cli_guard_descriptors();
  (void)fesetenv(FE_DFL_ENV);
  const tf_arithmetic_t found = tf_arithmetic();
  const int code = found == TF_ARITHMETIC_OK
                       ? choose(argc - 1, argv + 1)
                       : cli_stop("this build has other bits: %s",
                                  tf_arithmetic_name(found));
  return code == CLI_DONE && ferror(stderr) ? CLI_STOPPED : code;
}
