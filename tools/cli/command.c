// From a command line to a command. Reading is the same for all that take
// options; what they give is checked together by the command itself.

#include "command.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "host/output.h"
#include "text/message.h"
#include "text/summary.h"

const cli_command_t *cli_find_command(const char *name) {
  for (size_t i = 0; i < cli_command_count; i++) {
    if (strcmp(cli_commands[i].name, name) == 0) {
      return &cli_commands[i];
    }
  }
  return NULL;
}

static void offer_commands(cli_closest_t *closest) {
  (void)cli_closest_find(closest, cli_commands, cli_command_count,
                         sizeof cli_commands[0]);
}

// There is help on every word but this one: the closest that has some.
static int no_help(const char *word) {
  cli_closest_t closest = cli_closest_to(word);
  offer_commands(&closest);
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
  const cli_command_t *command = argc == 1 ? cli_find_command(word) : NULL;
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
static int unknown_command(const char *name) {
  if (strcmp(name, "bench") == 0 || strcmp(name, "stability") == 0) {
    return cli_message(CLI_USAGE, "%s is a target of make: 'make %s'", name,
                       name);
  }
  cli_closest_t closest = cli_closest_to(name);
  offer_commands(&closest);
  return cli_message(CLI_USAGE,
                     "unknown command '%s'%s ('twofold help' lists them)", name,
                     closest.hint);
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

#define PATH_ROOM 4200

// Whether writing the one would destroy the other. Standard output takes the
// rows of one option.
static bool destroys(const cli_file_t *writer, const cli_file_t *file) {
  static const char *const beside[] = {"", ".part", ".resume"};
  const char *value = writer->given.value;
  if (strcmp(value, "-") == 0) {
    return file->how == CLI_WRITES && strcmp(file->given.value, "-") == 0;
  }
  for (size_t i = 0; i < sizeof beside / sizeof beside[0]; i++) {
    char path[PATH_ROOM];
    const int length = snprintf(path, sizeof path, "%s%s", value, beside[i]);
    if (length > 0 && (size_t)length < sizeof path &&
        cli_one_file(path, file->given.value)) {
      return true;
    }
  }
  return false;
}

static int check_files(const cli_syntax_t *syntax, int argc,
                       char *const argv[]) {
  for (int at = 0; at < argc;) {
    const int begin = at;
    const cli_file_t writer = cli_next_file(syntax, argv, &at);
    for (int other = 0; writer.how == CLI_WRITES && other < argc;) {
      const bool itself = other == begin;
      const cli_file_t file = cli_next_file(syntax, argv, &other);
      if (!itself && file.how != 0 && destroys(&writer, &file)) {
        return cli_message(
            CLI_USAGE,
            "%s %s would write over %s%s%s: two files are "
            "needed",
            writer.given.name, writer.given.value, file.given.name,
            file.given.name[0] != '\0' ? " " : "", file.given.value);
      }
    }
  }
  return CLI_DONE;
}

int cli_read_args(const cli_command_t *command, cli_args_t *args, int argc,
                  char *const argv[]) {
  const cli_syntax_t syntax = {cli_options, cli_option_count, command->name,
                               command->bit, command->take};
  memset(args, 0, sizeof *args);
  args->command = command->name;
  args->points = 1;
  args->listed = 20;
  args->shard = cli_whole_shard;
  cli_usual_values(&syntax, args);
  int code = cli_read_words(&syntax, args, argc, argv);
  code = code == CLI_DONE ? check_files(&syntax, argc, argv) : code;
  if (code == CLI_DONE && args->scene == NULL &&
      strncmp(command->words, "SCENE", 5) == 0) {
    return cli_message(CLI_USAGE,
                       "%s: which scene? ('twofold scenes' lists them)",
                       command->name);
  }
  return code == CLI_DONE && command->check != NULL ? command->check(args)
                                                    : code;
}

// A program that has asked for JSON gets it also where the command ends before
// its summary: the reason and the exit code.
static int perform(const cli_command_t *command, int argc, char *const argv[]) {
  static cli_args_t args;
  int code = command->raw != NULL ? command->raw(argc, argv)
                                  : cli_read_args(command, &args, argc, argv);
  if (code == CLI_DONE && command->raw == NULL) {
    code = command->perform(&args);
  }
  free((void *)args.files);
  if (asks_for_json(argc, argv) && !cli_put_ended()) {
    cli_put_begin(command->name);
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
    return cli_help(argc - 1, argv + 1);
  }
  if (strcmp(argv[0], "--version") == 0) {
    return cli_print_version();
  }
  const cli_command_t *command = cli_find_command(argv[0]);
  if (asks_for_help(argc - 1, argv + 1)) {
    return cli_help(command != NULL ? 1 : 0, argv);
  }
  return command != NULL ? perform(command, argc - 1, argv + 1)
                         : unknown_command(argv[0]);
}
