// Completions for three shells, from the same tables as the reading of command
// lines. The texts are those of the help, up to their first pause.

#include <stdio.h>
#include <string.h>

#include "command.h"
#include "text/message.h"
#include "twofold.h"

static const char shells[] = "bash zsh fish";

static bool takes(const cli_command_t *command, const cli_option_t *option) {
  return option->name != NULL && (option->commands & command->bit) != 0;
}

static bool takes_file(const cli_option_t *option) {
  return (option->how & (CLI_READS | CLI_WRITES)) != 0;
}

// What a shell shows of a text: no more than a clause, and no character that
// means something to it.
static void print_brief(const char *text) {
  size_t length = strcspn(text, ";([");
  length -= length > 0 && text[length - 1] == ' ';
  for (size_t i = 0; i < length; i++) {
    (void)putchar(strchr("'\"`$\\]:", text[i]) != NULL ? ' ' : text[i]);
  }
}

static void print_commands(void) {
  for (size_t i = 0; i < cli_command_count; i++) {
    (void)printf("%s ", cli_commands[i].name);
  }
}

// colon: what stands for one at the end.
static void print_choices(const cli_option_t *option, const char *colon) {
  for (const cli_choice_t *at = option->choices; at->name != NULL; at++) {
    const size_t bare = strcspn(at->name, ":");
    (void)printf("%.*s%s ", (int)bare, at->name,
                 at->name[bare] != '\0' ? colon : "");
  }
}

// The words that stand in place of options, of a command without any.
static void print_words(const cli_command_t *command) {
  if (strcmp(command->name, "help") == 0) {
    print_commands();
  } else if (strcmp(command->name, "completions") == 0) {
    (void)fputs(shells, stdout);
  } else if (command->bit != 0 && command->take == NULL) {
    for (size_t i = 0; i < TF_SCENES; i++) {
      (void)printf("%s ", tf_scenes[i]->name);
    }
  }
}

static void bash_command(const cli_command_t *command) {
  for (size_t i = 0; i < cli_option_count; i++) {
    const cli_option_t *option = &cli_options[i];
    if (!takes(command, option) || option->value == NULL) {
      continue;
    }
    (void)printf("  %s:%s) ", command->name, option->name);
    if (option->choices != NULL) {
      (void)fputs("words='", stdout);
      print_choices(option, ":");
      (void)fputs("' ", stdout);
    } else if (!takes_file(option)) {
      (void)fputs("compopt +o default ", stdout);
    }
    (void)puts(";;");
  }
  (void)printf("  %s:*) words='", command->name);
  print_words(command);
  for (size_t i = 0; i < cli_option_count; i++) {
    if (takes(command, &cli_options[i])) {
      (void)printf("%s ", cli_options[i].name);
    }
  }
  (void)puts("' ;;");
}

static void print_bash(void) {
  (void)fputs(
      "_twofold() {\n"
      "  local words= before=${COMP_WORDS[COMP_CWORD-1]}\n"
      "  case $COMP_CWORD in 1) before=twofold ;; esac\n"
      "  case ${COMP_WORDS[1]}:$before in\n"
      "  *:twofold) words='",
      stdout);
  print_commands();
  (void)puts("--version' ;;");
  for (size_t i = 0; i < cli_command_count; i++) {
    bash_command(&cli_commands[i]);
  }
  (void)puts(
      "  esac\n"
      "  COMPREPLY=($(compgen -W \"$words\" -- "
      "\"${COMP_WORDS[COMP_CWORD]}\"))\n"
      "}\n"
      "complete -o default -F _twofold twofold");
}

static void zsh_option(const cli_option_t *option) {
  const bool repeats = (option->how & CLI_REPEATABLE) != 0;
  (void)printf(" \\\n      '%s%s%s[", repeats ? "*" : "", option->name,
               option->value != NULL ? "=" : "");
  print_brief(option->what);
  (void)putchar(']');
  if (option->value != NULL) {
    (void)fputs(":value:", stdout);
    if (option->choices != NULL) {
      (void)putchar('(');
      print_choices(option, "\\:");
      (void)putchar(')');
    } else if (takes_file(option)) {
      (void)fputs("_files", stdout);
    }
  }
  (void)putchar('\'');
}

static void print_zsh(void) {
  (void)puts("#compdef twofold\n_twofold() {\n  local -a commands=(");
  for (size_t i = 0; i < cli_command_count; i++) {
    (void)printf("    '%s:", cli_commands[i].name);
    print_brief(cli_commands[i].what);
    (void)puts("'");
  }
  (void)puts(
      "  )\n"
      "  if (( CURRENT == 2 )); then\n"
      "    _describe command commands\n"
      "    return\n"
      "  fi\n"
      "  local command=$words[2]\n"
      "  shift words\n"
      "  (( CURRENT-- ))\n"
      "  case $command in");
  for (size_t i = 0; i < cli_command_count; i++) {
    const cli_command_t *command = &cli_commands[i];
    (void)printf("  %s) _arguments", command->name);
    for (size_t k = 0; k < cli_option_count; k++) {
      if (takes(command, &cli_options[k])) {
        zsh_option(&cli_options[k]);
      }
    }
    (void)fputs(" \\\n      '*: :{_alternative \"words:word:(", stdout);
    print_words(command);
    (void)puts(")\" \"files:file:_files\"}' ;;");
  }
  (void)puts(
      "  esac\n}\n"
      "if [ \"$funcstack[1]\" = _twofold ]; then _twofold; else "
      "compdef _twofold twofold; fi");
}

static void fish_option(const cli_command_t *command,
                        const cli_option_t *option) {
  (void)printf("complete -c twofold -n '__fish_seen_subcommand_from %s' -l %s",
               command->name, option->name + 2);
  if (option->value != NULL) {
    (void)fputs(takes_file(option) ? " -r -F" : " -x", stdout);
  }
  if (option->choices != NULL) {
    (void)fputs(" -a '", stdout);
    print_choices(option, ":");
    (void)putchar('\'');
  }
  (void)fputs(" -d '", stdout);
  print_brief(option->what);
  (void)puts("'");
}

static void print_fish(void) {
  (void)puts("complete -c twofold -n __fish_use_subcommand -f");
  for (size_t i = 0; i < cli_command_count; i++) {
    const cli_command_t *command = &cli_commands[i];
    (void)printf("complete -c twofold -n __fish_use_subcommand -a %s -d '",
                 command->name);
    print_brief(command->what);
    (void)printf(
        "'\ncomplete -c twofold -n "
        "'__fish_seen_subcommand_from %s' -a '",
        command->name);
    print_words(command);
    (void)puts("'");
    for (size_t k = 0; k < cli_option_count; k++) {
      if (takes(command, &cli_options[k])) {
        fish_option(command, &cli_options[k]);
      }
    }
  }
}

int cli_completions(int argc, char *const argv[]) {
  static const struct {
    const char *name;
    void (*print)(void);
  } known[] = {{"bash", print_bash}, {"zsh", print_zsh}, {"fish", print_fish}};
  for (size_t i = 0; argc == 1 && i < sizeof known / sizeof known[0]; i++) {
    if (strcmp(argv[0], known[i].name) == 0) {
      known[i].print();
      return cli_finish_stdout();
    }
  }
  return cli_message(CLI_USAGE, "completions: of which shell? (%s)", shells);
}
