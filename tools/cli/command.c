// The table of the commands: a function that performs each one and, if it has
// options, its help page. The command line is made of these folders; each line
// includes only folders below it (check `arrows` has the same table):
//
//   .          command (this table), help (overview, version), topics (help on
//              single words), the commands `scenes` and `scene`
//   monitor/   the command `monitor`: frames of a board become rows or a live
//              view, and commands are sent to it; takes only row.h of run/
//   run/       the command `run`: loop, rows, frames, events, summary
//   analysis/  singularities, regions, design and atlas: they examine a machine
//              without running it
//   diverge/   the command `diverge`: samples of the motions that can follow a
//              two-fold. Bottom up: vector_field, canard, tracker, job, motion,
//              the steppers random, perturbed and lagged, counts, diverge;
//              `merge` adds its counts
//   sweep/     the command `sweep`: one row for each point of a grid of
//              settings; takes only events.h and ambiguity.h of
//              run/
//   setup/     a scene, by its name or from a file, with --set and --select
//              becomes a machine with its initial state; schemes, names
//   live/      --live of run and monitor: planes and modes in a terminal
//   host/      what POSIX provides: clock, signals, output files, serial lines,
//              progress
//   text/      messages, numbers, options, text in buffers
//
// run, analysis, diverge and sweep do not include each other otherwise. In the
// folder of a command NAME_args reads its command line and NAME_help is its
// help page.

#include "command.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "analysis/analysis_help.h"
#include "analysis/commands.h"
#include "diverge/diverge.h"
#include "diverge/diverge_help.h"
#include "help.h"
#include "monitor/monitor.h"
#include "monitor/monitor_help.h"
#include "run/run.h"
#include "run/run_help.h"
#include "scenes.h"
#include "sweep/sweep.h"
#include "sweep/sweep_help.h"
#include "text/closest.h"
#include "text/commit.h"
#include "text/json.h"
#include "text/message.h"
#include "topics.h"

typedef struct {
  const char *name;
  int (*perform)(int argc, char *const argv[]);
  void (*help)(void); // NULL: no page
} command_t;

static int perform_help(int argc, char *const argv[]);

static const command_t commands[] = {
    {"scenes", cli_scenes, NULL},
    {"scene", cli_scene, cli_scene_help},
    {"run", cli_run, cli_run_help},
    {"monitor", cli_monitor, cli_monitor_help},
    {"singularities", cli_singularities, cli_singularities_help},
    {"regions", cli_regions, cli_regions_help},
    {"design", cli_design, cli_design_help},
    {"atlas", cli_atlas, cli_atlas_help},
    {"diverge", cli_diverge, cli_diverge_help},
    {"merge", cli_merge, cli_merge_help},
    {"sweep", cli_sweep, cli_sweep_help},
    {"help", perform_help, NULL},
};
#define COMMANDS (sizeof commands / sizeof commands[0])

// The command of that name, NULL where there is none.
static const command_t *find_command(const char *name) {
  for (size_t i = 0; i < COMMANDS; i++) {
    if (strcmp(commands[i].name, name) == 0) {
      return &commands[i];
    }
  }
  return NULL;
}

// There is no help on a word: the closest one that has some.
static int no_help(const char *word) {
  cli_closest_t closest = cli_closest_to(word);
  for (size_t i = 0; i < COMMANDS; i++) {
    cli_closest_offer(&closest, commands[i].name);
  }
  cli_topics_offer(&closest);
  const cli_hint_t hint = cli_closest_hint(&closest);
  return cli_message(CLI_USAGE,
                     "help: no help on '%s'%s%s%s; try 'twofold help' or "
                     "'twofold help run'",
                     word, hint.before, hint.name, hint.after);
}

// `twofold help [COMMAND|WORD]`; of an option the dashes are left out.
static int perform_help(int argc, char *const argv[]) {
  if (argc == 0) {
    cli_overview();
    return cli_finish_stdout();
  }
  const char *word = argv[argc - 1];
  word += strncmp(word, "--", 2) == 0 ? 2 : 0;
  const command_t *command = argc == 1 ? find_command(word) : NULL;
  if (command != NULL && command->help != NULL) {
    command->help();
  } else if (command != NULL) {
    cli_overview();
  } else if (argc > 1) {
    return cli_message(CLI_USAGE, "help: one word at a time");
  } else if (!cli_topic(word)) {
    return no_help(argv[argc - 1]);
  }
  return cli_finish_stdout();
}

// The benchmarks need several builds of the core, so they belong to make.
static int unknown_command(const char *name) {
  if (strcmp(name, "bench") == 0 || strcmp(name, "stability") == 0) {
    return cli_message(CLI_USAGE, "%s is a target of make: 'make %s'", name,
                       name);
  }
  cli_closest_t closest = cli_closest_to(name);
  for (size_t i = 0; i < COMMANDS; i++) {
    cli_closest_offer(&closest, commands[i].name);
  }
  const cli_hint_t hint = cli_closest_hint(&closest);
  return cli_message(CLI_USAGE,
                     "unknown command '%s'%s%s%s ('twofold help' lists them)",
                     name, hint.before, hint.name, hint.after);
}

static bool is_help_option(const char *word) {
  return strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0;
}

static bool asks_for_help(int argc, char *const argv[]) {
  for (int i = 0; i < argc; i++) {
    if (is_help_option(argv[i])) {
      return true;
    }
  }
  return false;
}

static bool asks_for_json(int argc, char *const argv[]) {
  for (int i = 0; i < argc; i++) {
    if (strcmp(argv[i], "--summary=json") == 0 ||
        (i > 0 && strcmp(argv[i - 1], "--summary") == 0 &&
         strcmp(argv[i], "json") == 0)) {
      return true;
    }
  }
  return false;
}

// Performs a command. A program that has asked for JSON gets it also where the
// command ends before its summary: the reason and the exit code.
static int perform(const command_t *command, int argc, char *const argv[]) {
  const int code = command->perform(argc, argv);
  if (asks_for_json(argc, argv) && !cli_put_ended()) {
    (void)fprintf(stderr, "{" CLI_JSON_BUILD ", ", cli_commit);
    cli_put_word("command", command->name);
    cli_put_text("message", cli_last_message());
    cli_put_exit(code);
  }
  return code;
}

int cli_command(int argc, char *const argv[]) {
  if (argc < 1) {
    return cli_message(CLI_USAGE, "which command? ('twofold help' lists them)");
  }
  if (is_help_option(argv[0])) {
    return perform_help(argc - 1, argv + 1);
  }
  if (strcmp(argv[0], "--version") == 0) {
    return cli_version();
  }
  const command_t *command = find_command(argv[0]);
  if (asks_for_help(argc - 1, argv + 1)) {
    return perform_help(command != NULL && command->help != NULL ? 1 : 0, argv);
  }
  return command != NULL ? perform(command, argc - 1, argv + 1)
                         : unknown_command(argv[0]);
}
