// The program `twofold`, which links libc, libm and the core: from a command
// line to a command. Reading is the same for all that take options; what they
// give is checked together by the command itself. commands.c has the table of
// the commands and lists the folders.

#include "command.h"

#include <stdio.h>
#include <string.h>

#include "host/host.h"
#include "text/summary.h"

static const cli_command_t *find(cli_closest_t *closest) {
  const size_t i = cli_closest_find(closest, cli_commands, cli_command_count,
                                    sizeof cli_commands[0]);
  return i < cli_command_count ? &cli_commands[i] : NULL;
}

const cli_command_t *cli_find_command(const char *name) {
  cli_closest_t closest = cli_closest_to(name);
  return find(&closest);
}

// There is help on every word but this one: the closest that has some.
static int no_help(const char *word) {
  cli_closest_t closest = cli_closest_to(word);
  (void)find(&closest);
  cli_topics_offer(&closest);
  return cli_message(CLI_USAGE,
                     "help: no help on '%s'%s; try 'twofold help' or 'twofold "
                     "help run'",
                     word, closest.hint);
}

// Of an option the dashes are left out.
int cli_help(int argc, char *const argv[]) {
  if (argc == 0) {
    cli_print_overview();
    return cli_finish_stdout();
  }
  const char *word = argv[argc - 1];
  word += strncmp(word, "--", 2) == 0 ? 2 : 0;
  cli_closest_t closest = cli_closest_to(word);
  const cli_command_t *command = argc == 1 ? find(&closest) : NULL;
  if (command != NULL && (command->bit != 0 || command->about != NULL)) {
    cli_print_page(command);
  } else if (command != NULL) {
    cli_print_overview();
  } else if (argc > 1) {
    return cli_message(CLI_USAGE, "help: one word at a time");
  } else if (!cli_topic(word)) {
    return no_help(argv[argc - 1]);
  }
  return cli_finish_stdout();
}

// The benchmarks need several builds of the core, so they belong to make.
static int unknown_command(const cli_closest_t *closest) {
  const char *name = closest->word;
  if (strcmp(name, "bench") == 0 || strcmp(name, "stability") == 0) {
    return cli_message(CLI_USAGE, "%s is a target of make: 'make %s'", name,
                       name);
  }
  return cli_message(CLI_USAGE,
                     "unknown command '%s'%s ('twofold help' lists them)", name,
                     closest->hint);
}

static bool has(int argc, char *const argv[], const char *word) {
  int i = 0;
  while (i < argc && strcmp(argv[i], word) != 0) {
    i++;
  }
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

static int read_args(const cli_command_t *command, cli_args_t *args, int argc,
                     char *const argv[]) {
  args->command = command->name;
  args->points = 1;
  args->listed = 20;
  args->shard = (cli_shard_t){1, 1};
  CLI_TRY(cli_read_words(command, args, argc, argv));
  if (command->take == NULL && args->scene == NULL) {
    return cli_message(CLI_USAGE,
                       "%s: which scene? ('twofold scenes' lists them)",
                       command->name);
  }
  return command->check != NULL ? command->check(args) : CLI_DONE;
}

// A program that has asked for JSON gets it also where the command ends before
// its summary: the reason and the exit code.
static int perform(const cli_command_t *command, int argc, char *const argv[]) {
  static cli_args_t args;
  int code = command->raw != NULL ? command->raw(argc, argv)
                                  : read_args(command, &args, argc, argv);
  if (code == CLI_DONE && command->raw == NULL) {
    code = command->perform(&args);
  }
  if (asks_for_json(argc, argv) && !cli_put_ended()) {
    cli_put_begin(command->name);
    cli_put_text("message", cli_last_message());
    cli_put_exit(code);
  }
  return code;
}

static int choose(int argc, char *const argv[]) {
  if (argc < 1) {
    return cli_message(CLI_USAGE, "which command? ('twofold help' lists them)");
  }
  if (asks_for_help(1, argv)) {
    return cli_help(argc - 1, argv + 1);
  }
  if (strcmp(argv[0], "complete") == 0) {
    return cli_complete(argc - 1, argv + 1);
  }
  if (strcmp(argv[0], "--version") == 0) {
    (void)puts("twofold " TF_VERSION ", tf_real_t is " CLI_NUMBER_TYPE);
    return cli_finish_stdout();
  }
  cli_closest_t closest = cli_closest_to(argv[0]);
  const cli_command_t *command = find(&closest);
  if (asks_for_help(argc - 1, argv + 1)) {
    return cli_help(command != NULL ? 1 : 0, argv);
  }
  return command != NULL ? perform(command, argc - 1, argv + 1)
                         : unknown_command(&closest);
}

// What a command reports is part of what it was asked for: where it could not
// be written, on a full disk, the command was not done. Standard output is
// looked after by each command, which names it.
int main(int argc, char *argv[]) {
  cli_guard_descriptors();
  const int code = choose(argc - 1, argv + 1);
  return code == CLI_DONE && ferror(stderr) ? CLI_STOPPED : code;
}
