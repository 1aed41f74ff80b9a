// Help: on a word it prints all that the tables of parameters, options, scenes
// and outcomes have of it, and sections of help.txt, which the Makefile puts
// into the program. Columns are as in the manuals of other programs.
//
// Completions: the script of a shell, a section of help.txt, runs the command
// `complete WORD...`, which prints what may stand behind these words: so it
// offers what the tables of commands and options have, and never grows old.

#include "command.h"
#include "setup/scene_file.h"
#include "sweep/point.h"

#define WIDTH 79     // columns
#define COLUMN 23    // at which the text of an option begins
#define CHOICE 13    // and behind that, the meaning of a word
#define COMMAND 21   // at which the text of a command begins
#define NUMBER 36    // at which the text of a parameter begins
#define WORD_ROOM 32 // more than any word of a section has

// Its lines, and NULL.
extern const char *const cli_help_text[];

// The length of the first line of a text. A word that is longer than a line, as
// a list of columns is, goes on behind a comma.
static size_t line_length(const char *text, size_t room) {
  size_t end = room;
  if (strlen(text) <= room) return strlen(text);
  while (end > 0 && text[end] != ' ') end--;
  const char *next = text + end + (text[end] == ' ' ? 1 : 0);
  if (strcspn(next, " ") > room)
    for (end = room; end > 0 && text[end - 1] != ',';) end--;
  return end;
}

// Prints text in lines, the first of which begins at the margin.
static void print_filled(const char *text, size_t margin) {
  for (int indent = 0; *text != '\0'; indent = (int)margin) {
    const size_t length = line_length(text, WIDTH - margin);
    (void)printf("%*s%.*s\n", indent, "", (int)length, text);
    text += length;
    text += strspn(text, " ");
  }
}

// margin: of the words of a value.
static void describe(const cli_option_t *option, size_t column, size_t margin) {
  char out[1024];
  int used = snprintf(out, sizeof out, "%s", option->what);
  const bool is_open = option->kind == CLI_POSITIVE;
  if (is_open || option->kind == CLI_WHOLE || option->kind == CLI_REAL) {
    used += snprintf(out + used, sizeof out - (size_t)used,
                     "; in %s%.10g, %.10g]%s%s", is_open ? "(" : "[",
                     option->low, option->high, option->unit != NULL ? " " : "",
                     option->unit != NULL ? option->unit : "");
    if (option->usual > 0) {
      (void)snprintf(out + used, sizeof out - (size_t)used, ", default %g",
                     option->usual);
    }
  }
  print_filled(out, column);
  for (const cli_choice_t *at = option->choices; at != NULL && at->name != NULL;
       at++) {
    if (at->what[0] != '\0') {
      (void)printf("%*s%-*s", (int)margin, "", CHOICE, at->name);
      print_filled(at->what, margin + CHOICE);
    }
  }
}

static void print_page(const cli_command_t *command) {
  (void)printf("usage: twofold %s %s\n\n%s\n%s", command->name, command->words,
               command->what, command->bit != 0 ? "\n" : "");
  for (size_t i = 0; i < cli_option_count; i++) {
    const cli_option_t *option = &cli_options[i];
    if (!cli_takes(command, option)) continue;
    int used =
        option->letter != 0 ? printf("  -%c, ", option->letter) : printf("  ");
    used += printf("%s %s", option->name,
                   option->value != NULL ? option->value : "");
    (void)printf("%*s", used < COLUMN ? COLUMN - used : 1, "");
    describe(option, COLUMN, COLUMN);
  }
  (void)puts("");
}

static void print_commands(void) {
  for (size_t i = 0; i < cli_command_count; i++) {
    const cli_command_t *command = &cli_commands[i];
    const int first = (int)strcspn(command->words, " |");
    const int used = printf("  %s %.*s", command->name, first, command->words);
    (void)printf("%*s%s\n", used < COMMAND ? COMMAND - used : 2, "",
                 command->what);
  }
}

// Numbers of --set: name, range, unit, and what they are.
static void print_numbers(size_t i, size_t end) {
  for (; i < end; i++) {
    const tf_parameter_range_t *range = cli_number(i);
    const bool plain = strcmp(range->unit, "1") == 0;
    char text[NUMBER];
    (void)snprintf(text, sizeof text, "[%g, %g]%s%s", (double)range->low,
                   (double)range->high, plain ? "" : " ",
                   plain ? "" : range->unit);
    (void)printf("  %-9s %-*s", range->name, NUMBER - 12, text);
    print_filled(i < TF_PARAMETERS ? cli_parameter_about[i] : "at the start",
                 NUMBER);
  }
}

static void print_measure(const cli_measure_info_t *info) {
  (void)printf("  %-16s %-6s %s\n", info->name, info->unit, info->what);
}

static void print_line(const char *line) {
  if (strcmp(line, "COMMANDS") == 0)
    print_commands();
  else if (strcmp(line, "PARAMETERS") == 0)
    print_numbers(0, TF_PARAMETERS);
  else if (strcmp(line, "NUMBERS") == 0)
    print_numbers(0, CLI_NUMBERS);
  else if (strcmp(line, "OUTCOMES") == 0)
    for (size_t i = 0; i < CLI_MEASURES; i++) print_measure(&cli_measures[i]);
  else
    (void)puts(line);
}

// Cuts the next word off the words of a heading. Returns: whether there is one.
static bool next_word(const char **words, char word[WORD_ROOM]) {
  *words += strspn(*words, "[ ]");
  const size_t length = strcspn(*words, " ]");
  (void)snprintf(word, WORD_ROOM, "%.*s", (int)length, *words);
  *words += length;
  return length > 0;
}

static bool print_sections(cli_closest_t *closest) {
  bool found = false, prints = false, is_heading = false;
  const cli_command_t *page = NULL;
  for (const char *const *line = cli_help_text; *line != NULL; line++) {
    const char *words = *line;
    char word[WORD_ROOM];
    if (words[0] == '[') {
      prints = prints && is_heading;
      for (bool first = !is_heading; next_word(&words, word); first = false) {
        cli_closest_t name = cli_closest_to(word);
        page = first ? cli_find_command(&name) : page;
        prints = prints || strcmp(word, closest->word) == 0;
        cli_closest_offer(closest, word);
      }
      is_heading = true;
      found = found || prints;
      continue;
    }
    if (prints && is_heading && page != NULL) print_page(page);
    if (prints) print_line(*line);
    is_heading = false;
  }
  return found;
}

// An option is printed for its name without the dashes, for what its value is,
// and for a word that it may be, beside the others: some say "likewise".
static bool is_of(const cli_option_t *option, const char *word) {
  bool is = strcmp(option->name + 2, word) == 0 ||
            (option->noun != NULL && strcmp(option->noun, word) == 0);
  for (const cli_choice_t *at = option->choices; at != NULL && at->name != NULL;
       at++)
    is = is || strcmp(at->name, word) == 0;
  return is;
}

static bool print_option(cli_closest_t *closest) {
  bool found = false;
  for (size_t i = 0; i < cli_option_count; i++) {
    const cli_option_t *option = &cli_options[i];
    cli_closest_offer(closest, option->name + 2);
    if (!is_of(option, closest->word)) continue;
    (void)printf("%s %s", option->name,
                 option->value != NULL ? option->value : "");
    const char *separator = " of";
    for (size_t k = 0; k < cli_command_count; k++) {
      if (cli_takes(&cli_commands[k], option)) {
        (void)printf("%s '%s'", separator, cli_commands[k].name);
        separator = ",";
      }
    }
    (void)puts(":");
    describe(option, 0, 2);
    found = true;
  }
  return found;
}

// A word may be several things: `string` is a law and a scene.
int cli_help(int argc, char *const argv[]) {
  if (argc > 1) return cli_usage("help: one word at a time");
  const char *given = argc > 0 ? argv[0] : "overview";
  const char *word = given + (strncmp(given, "--", 2) == 0 ? 2 : 0);
  cli_closest_t closest = cli_closest_to(word);
  const size_t i =
      cli_closest_find(&closest, tf_parameter_ranges, TF_PARAMETERS,
                       sizeof tf_parameter_ranges[0]);
  if (i < TF_PARAMETERS) {
    (void)printf("Parameter: name, range, unit, what it is; --set %s=VALUE:\n",
                 word);
    print_numbers(i, i + 1);
  }
  const bool of_option = print_option(&closest);
  const tf_scene_t *scene = cli_find_scene(&closest);
  if (scene != NULL) {
    (void)printf(
        "Scene %s: %s.\nIt leaves out: %s. 'twofold scene %s' prints it.\n",
        word, scene->shows, scene->leaves_out, word);
  }
  const size_t k = cli_closest_find(&closest, cli_measures, CLI_MEASURES,
                                    sizeof cli_measures[0]);
  if (k < CLI_MEASURES) {
    (void)puts("Outcome of 'sweep', its unit, and what it is:");
    print_measure(&cli_measures[k]);
  }
  if (print_sections(&closest) || i < TF_PARAMETERS || of_option ||
      scene != NULL || k < CLI_MEASURES)
    return cli_finish_stdout();
  return cli_usage(
      "help: no help on '%s'%s; try 'twofold help' or 'twofold help run'",
      given, closest.hint);
}

// Prints a word and the first clause of its meaning.
static void offer(const char *word, const char *what) {
  (void)printf("%s\t%.*s\n", word, (int)strcspn(what, ";(["), what);
}

static void offer_commands(void) {
  for (size_t i = 0; i < cli_command_count; i++)
    offer(cli_commands[i].name, cli_commands[i].what);
}

// What may stand in place of an option.
static void offer_words(const cli_command_t *command) {
  if (strcmp(command->name, "help") == 0) {
    offer_commands();
  } else if (strcmp(command->name, "completions") == 0) {
    offer("bash", "");
    offer("zsh", "");
    offer("fish", "");
  } else if (command->bit != 0 && !command->of_source) {
    for (size_t i = 0; i < TF_SCENES; i++)
      offer(tf_scenes[i]->name, tf_scenes[i]->shows);
  }
}

// What may stand behind some words. The code is CLI_DONE where a file may, too.
int cli_complete(int argc, char *const argv[]) {
  cli_closest_t name = cli_closest_to(argc > 0 ? argv[0] : "");
  const cli_command_t *command = cli_find_command(&name);
  if (command == NULL) {
    offer_commands();
    offer("--version", "");
    return CLI_USAGE;
  }
  for (size_t i = 0; i < cli_option_count; i++) {
    const cli_option_t *option = &cli_options[i];
    if (!cli_takes(command, option) || option->value == NULL ||
        strcmp(option->name, argv[argc - 1]) != 0)
      continue;
    for (const cli_choice_t *at = option->choices;
         at != NULL && at->name != NULL; at++)
      offer(at->name, at->what);
    return option->kind == CLI_READS || option->kind == CLI_WRITES ? CLI_DONE
                                                                   : CLI_USAGE;
  }
  offer_words(command);
  for (size_t i = 0; i < cli_option_count; i++)
    if (cli_takes(command, &cli_options[i]))
      offer(cli_options[i].name, cli_options[i].what);
  return CLI_DONE;
}

int cli_completions(int argc, char *const argv[]) {
  char section[32];
  (void)snprintf(section, sizeof section, "completions-%s",
                 argc == 1 ? argv[0] : "");
  cli_closest_t closest = cli_closest_to(section);
  return print_sections(&closest)
             ? cli_finish_stdout()
             : cli_usage("completions: of which shell? (bash zsh fish)");
}
