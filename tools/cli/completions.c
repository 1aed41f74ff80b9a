// Completions. The script of a shell, a section of help.txt, runs the command
// `complete WORD...`, which prints what may stand behind these words: so it
// offers what the tables of commands and options have, and never grows old.

#include <stdio.h>
#include <string.h>

#include "command.h"
#include "text/text.h"
#include "twofold.h"

static const char *const shells[] = {"bash", "zsh", "fish"};
#define SHELLS (sizeof shells / sizeof shells[0])

// A word, and of what it means a clause.
static void offer(const char *word, const char *what) {
  (void)printf("%s\t%.*s\n", word, (int)strcspn(what, ";(["), what);
}

static void offer_commands(void) {
  for (size_t i = 0; i < cli_command_count; i++) {
    offer(cli_commands[i].name, cli_commands[i].what);
  }
}

// What may stand in place of an option.
static void offer_words(const cli_command_t *command) {
  if (strcmp(command->name, "help") == 0) {
    offer_commands();
  } else if (strcmp(command->name, "completions") == 0) {
    for (size_t i = 0; i < SHELLS; i++) offer(shells[i], "");
  } else if (command->bit != 0 && command->take == NULL) {
    for (size_t i = 0; i < TF_SCENES; i++) {
      offer(tf_scenes[i]->name, tf_scenes[i]->shows);
    }
  }
}

static int offer_value(const cli_option_t *option) {
  for (const cli_choice_t *at = option->choices; at != NULL && at->name != NULL;
       at++) {
    offer(at->name, at->what);
  }
  const bool is_file = option->kind == CLI_READS || option->kind == CLI_WRITES;
  return is_file ? CLI_DONE : CLI_USAGE;
}

// What may stand behind some words. The code is CLI_DONE where a file may, too.
int cli_complete(int argc, char *const argv[]) {
  const cli_command_t *command = argc > 0 ? cli_find_command(argv[0]) : NULL;
  if (command == NULL) {
    offer_commands();
    offer("--version", "");
    return CLI_USAGE;
  }
  for (size_t i = 0; i < cli_option_count; i++) {
    const cli_option_t *option = &cli_options[i];
    if (cli_takes(command, option) && option->value != NULL &&
        strcmp(option->name, argv[argc - 1]) == 0) {
      return offer_value(option);
    }
  }
  offer_words(command);
  for (size_t i = 0; i < cli_option_count; i++) {
    if (cli_takes(command, &cli_options[i])) {
      offer(cli_options[i].name, cli_options[i].what);
    }
  }
  return CLI_DONE;
}

int cli_completions(int argc, char *const argv[]) {
  char section[32];
  (void)snprintf(section, sizeof section, "completions-%s",
                 argc == 1 ? argv[0] : "");
  return cli_print_section(section)
             ? cli_finish_stdout()
             : cli_message(CLI_USAGE,
                           "completions: of which shell? (bash zsh fish)");
}
