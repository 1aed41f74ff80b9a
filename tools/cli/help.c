// Help from the tables. Columns of options and of words that a value may be are
// as in the manuals of other programs; what depends on the length of a text is
// found here, so that a row of a table holds only words.

#include <stdio.h>
#include <string.h>

#include "command.h"
#include "twofold.h"

#define WIDTH 79   // columns
#define COLUMN 23  // at which the text of an option begins
#define CHOICE 13  // and behind that, the meaning of a word
#define COMMAND 21 // at which the text of a command begins

// Begins a line. Returns: its column.
static size_t new_line(size_t margin) {
  (void)printf("\n%*s", (int)margin, "");
  return margin;
}

void cli_print_filled(const char *text, size_t first, size_t margin) {
  size_t column = first, begin = first; // begin: of this line's text
  while (*text != '\0') {
    const size_t line = strcspn(text, "\n");
    if (*text == ' ') {
      (void)printf("%.*s", (int)line, text);
      text += line;
    }
    size_t word = strcspn(text, " \n");
    while (word > WIDTH - margin) { // a long list of columns
      size_t kept = WIDTH - column;
      while (kept > 0 && text[kept - 1] != ',') {
        kept--;
      }
      (void)printf("%.*s", (int)kept, text);
      text += kept;
      word -= kept;
      column = begin = new_line(margin);
    }
    if (column > begin && column + 1 + word > WIDTH) {
      column = begin = new_line(margin);
    } else if (column > begin && word > 0) {
      (void)putchar(' ');
      column++;
    }
    (void)printf("%.*s", (int)word, text);
    column += word;
    text += word;
    if (*text == '\n') {
      column = begin = new_line(margin);
      text++;
    } else {
      text += strspn(text, " ");
    }
  }
  (void)putchar('\n');
}

static bool is_number(const cli_option_t *option) {
  return option->kind == CLI_WHOLE || option->kind == CLI_REAL;
}

// The words of a value are told with the first option that takes them.
static bool is_told_before(const cli_option_t *option) {
  for (const cli_option_t *at = cli_options; at < option; at++) {
    if (at->choices == option->choices &&
        (at->commands & option->commands) != 0) {
      return true;
    }
  }
  return false;
}

static void describe(const cli_option_t *option, size_t first, size_t margin) {
  char out[1024];
  const size_t room = sizeof out;
  int used = snprintf(out, room, "%s", option->what);
  if (is_number(option)) {
    used +=
        snprintf(out + used, room - (size_t)used, "; in %s%.10g, %.10g]%s%s",
                 (option->how & CLI_OPEN) != 0 ? "(" : "[", option->low,
                 option->high, option->unit != NULL ? " " : "",
                 option->unit != NULL ? option->unit : "");
  }
  if (is_number(option) && option->usual > 0) {
    (void)snprintf(out + used, room - (size_t)used, ", default %g",
                   option->usual);
  }
  cli_print_filled(out, first, first);
  for (const cli_choice_t *at = option->choices;
       at != NULL && at->name != NULL && !is_told_before(option); at++) {
    if (at->what[0] != '\0') {
      (void)printf("%*s%-*s", (int)margin, "", CHOICE, at->name);
      cli_print_filled(at->what, margin + CHOICE, margin + CHOICE);
    }
  }
}

static void print_option(const cli_option_t *option) {
  const int used = printf("  %s %s", option->name,
                          option->value != NULL ? option->value : "");
  (void)printf("%*s", used < COLUMN ? COLUMN - used : 1, "");
  describe(option, COLUMN, COLUMN);
}

void cli_print_overview(void) {
  (void)puts("usage: twofold COMMAND\n");
  for (size_t i = 0; i < cli_command_count; i++) {
    const cli_command_t *command = &cli_commands[i];
    const int first = (int)strcspn(command->words, " |");
    const int used = printf("  %s %.*s", command->name, first, command->words);
    (void)printf("%*s%s\n", used < COMMAND ? COMMAND - used : 2, "",
                 command->what);
  }
  (void)fputs(
      "  help WORD          a parameter, column, mode, law, option, scene, or: "
      "csv,\n"
      "                     inputs, exit, save, replay, summary, provenance\n"
      "  --version          version and number type\n"
      "\n",
      stdout);
  cli_print_filled(CLI_EXIT_CODES, 0, 0);
}

void cli_print_page(const cli_command_t *command) {
  (void)printf("usage: twofold %s %s\n\n", command->name, command->words);
  if (command->about != NULL) {
    cli_print_filled(command->about, 0, 0);
    (void)putchar('\n');
  }
  for (size_t i = 0; i < cli_option_count; i++) {
    const cli_option_t *option = &cli_options[i];
    if ((option->commands & command->bit) == 0) {
      continue;
    }
    if (option->name == NULL) {
      (void)puts(option->what);
    } else {
      print_option(option);
    }
  }
  if (command->notes != NULL) {
    (void)putchar('\n');
    cli_print_filled(command->notes, 0, 0);
  }
  if (command->tail != NULL) {
    command->tail();
  }
}

static void print_commands(const cli_option_t *option) {
  const char *separator = "of";
  for (size_t i = 0; i < cli_command_count; i++) {
    if ((option->commands & cli_commands[i].bit) != 0) {
      (void)printf("%s '%s'", separator, cli_commands[i].name);
      separator = ",";
    }
  }
}

// A word of a value is told with those beside it: some say "likewise".
static bool is_of(const cli_option_t *option, const char *word) {
  const cli_choice_t *at = option->choices;
  while (at != NULL && at->name != NULL &&
         (at->what[0] == '\0' || strcmp(at->name, word) != 0)) {
    at++;
  }
  return option->name != NULL && (strcmp(option->name + 2, word) == 0 ||
                                  (at != NULL && at->name != NULL));
}

bool cli_print_option(const char *word) {
  bool found = false;
  for (size_t i = 0; i < cli_option_count; i++) {
    const cli_option_t *option = &cli_options[i];
    if (is_of(option, word)) {
      (void)printf("%s %s ", option->name,
                   option->value != NULL ? option->value : "");
      print_commands(option);
      (void)puts(":");
      describe(option, 0, 2);
      found = true;
    }
  }
  return found;
}
