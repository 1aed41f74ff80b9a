// Reading of command lines. Commands read and check everything before they open
// a file, so that a mistyped command never overwrites the result of an earlier
// one. The message about an unknown option or value suggests the closest one.

#include "options.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "twofold.h"

#define MAX_VALUES 1000000u // in one range

static bool is_row(const cli_syntax_t *syntax, size_t i) {
  return (syntax->options[i].commands & syntax->bit) != 0 &&
         syntax->options[i].name != NULL;
}

void cli_usual_values(const cli_syntax_t *syntax, void *args) {
  for (size_t i = 0; i < syntax->count; i++) {
    const cli_option_t *option = &syntax->options[i];
    void *to = (char *)args + option->member;
    if (is_row(syntax, i) && option->kind == CLI_WHOLE) {
      *(uint64_t *)to = (uint64_t)option->usual;
    } else if (is_row(syntax, i) && option->kind == CLI_REAL) {
      *(double *)to = option->usual;
    } else if (is_row(syntax, i) && option->kind == CLI_CHOICE) {
      *(unsigned *)to = (unsigned)option->usual;
    }
  }
}

static int unknown_option(const cli_syntax_t *syntax, const char *word) {
  cli_closest_t closest = cli_closest_to(word);
  for (size_t i = 0; i < syntax->count; i++) {
    if (is_row(syntax, i)) {
      cli_closest_offer(&closest, syntax->options[i].name);
    }
  }
  return cli_message(CLI_USAGE,
                     "unknown option %s%s ('twofold help %s' lists them)", word,
                     closest.hint, syntax->command);
}

static bool is_option(const char *word) {
  return word[0] == '-' && word[1] != '\0';
}

// The number of the option that a word begins, syntax->count: unknown.
static size_t find_option(const cli_syntax_t *syntax, const char *word) {
  const size_t length = strcspn(word, "=");
  size_t i = 0;
  while (i < syntax->count &&
         (!is_row(syntax, i) || strlen(syntax->options[i].name) != length ||
          strncmp(syntax->options[i].name, word, length) != 0)) {
    i++;
  }
  return i;
}

static int read_whole(const cli_option_t *option, const cli_given_t *given,
                      uint64_t *out) {
  const uint64_t low = (uint64_t)option->low, high = (uint64_t)option->high;
  if (cli_read_whole(given->value, low, high, out)) {
    return CLI_DONE;
  }
  return cli_message(
      CLI_USAGE, "%s %s: must be a whole number in [%" PRIu64 ", %" PRIu64 "]",
      given->name, given->value, low, high);
}

static int read_real(const cli_option_t *option, const cli_given_t *given,
                     double *out) {
  tf_real_t value = 0;
  CLI_TRY(cli_read_number(given->name, given->value, given->value, &value));
  const bool open = (option->how & CLI_OPEN) != 0;
  *out = (double)value;
  if (!(*out >= option->low && *out <= option->high) ||
      (open && !(*out > option->low))) {
    return cli_message(CLI_REFUSED, "%s %s: must lie in %s%g, %g]%s%s",
                       given->name, given->value, open ? "(" : "[", option->low,
                       option->high, option->unit != NULL ? " " : "",
                       option->unit != NULL ? option->unit : "");
  }
  return CLI_DONE;
}

static bool lies_in(const cli_option_t *option, double value) {
  return value >= option->low && value <= option->high;
}

static int read_range(const cli_option_t *option, const cli_given_t *given,
                      cli_range_t *out) {
  if (option->kind == CLI_RANGE) {
    CLI_TRY(cli_read_range(given->name, given->value, given->value, MAX_VALUES,
                           false, out));
  } else {
    out->text = given->value;
    out->count = 1;
    tf_real_t value = 0;
    CLI_TRY(cli_read_number(given->name, given->value, given->value, &value));
    out->from = out->to = (double)value;
  }
  return !(option->low < option->high) ||
                 (lies_in(option, out->from) && lies_in(option, out->to))
             ? CLI_DONE
             : cli_message(CLI_REFUSED, "%s %s: %s must lie in [%g, %g] %s",
                           given->name, given->value, given->name + 2,
                           option->low, option->high, option->unit);
}

static int refuse_choice(const cli_option_t *option, const cli_given_t *given) {
  char list[128] = "";
  cli_closest_t closest = cli_closest_to(given->value);
  for (const cli_choice_t *at = option->choices; at->name != NULL; at++) {
    const bool last = at[1].name == NULL;
    const size_t used = strlen(list);
    (void)snprintf(list + used, sizeof list - used, "%s%s",
                   used == 0 ? ""
                   : !last   ? ", "
                             : (option->noun != NULL ? " and " : " or "),
                   at->name);
    cli_closest_offer(&closest, at->name);
  }
  return option->noun == NULL
             ? cli_message(CLI_USAGE, "%s %s: must be %s%s", given->name,
                           given->value, list, closest.hint)
             : cli_message(CLI_USAGE, "%s %s: unknown %s; %ss are %s%s",
                           given->name, given->value, option->noun,
                           option->noun, list, closest.hint);
}

// length: in, of the word at the begin of the value.
static int read_choice(const cli_option_t *option, const cli_given_t *given,
                       size_t length, unsigned *out) {
  for (unsigned i = 0; option->choices[i].name != NULL; i++) {
    const char *name = option->choices[i].name;
    if (strlen(name) == length && strncmp(given->value, name, length) == 0) {
      *out = i;
      return CLI_DONE;
    }
  }
  return refuse_choice(option, given);
}

static int read_value(const cli_option_t *option, const cli_given_t *given,
                      void *args) {
  void *to = (char *)args + option->member;
  unsigned place = 0;
  switch (option->kind) {
    case CLI_FLAG:
      *(bool *)to = true;
      return CLI_DONE;
    case CLI_PATH:
      if (given->value[0] == '\0') {
        return cli_message(CLI_USAGE, "%s: the name of the file is empty",
                           given->name);
      }
      *(const char **)to = given->value;
      return CLI_DONE;
    case CLI_TEXT:
      *(const char **)to = given->value;
      return option->choices == NULL
                 ? CLI_DONE
                 : read_choice(option, given, strcspn(given->value, ":"),
                               &place);
    case CLI_WHOLE:
      return read_whole(option, given, to);
    case CLI_REAL:
      return read_real(option, given, to);
    case CLI_NUMBER:
    case CLI_RANGE:
      return read_range(option, given, to);
    case CLI_CHOICE:
      return read_choice(option, given, strlen(given->value), to);
    case CLI_OTHER:
      break;
  }
  return option->read(args, given);
}

// Reads the option that starts at argv[*at] and moves *at to its last word.
// seen: in/out, the options before. file: out, that its value is.
static int read_option(const cli_syntax_t *syntax, void *args, int argc,
                       char *const argv[], int *at, bool seen[CLI_ROWS],
                       cli_file_t *file) {
  const char *word = argv[*at];
  const size_t length = strcspn(word, "=");
  const size_t i = find_option(syntax, word);
  if (i == syntax->count) {
    return unknown_option(syntax, word);
  }
  const cli_option_t *option = &syntax->options[i];
  const bool valued = word[length] == '=';
  cli_given_t given = {option->name, ""};
  if (option->value == NULL) {
    if (valued) {
      return cli_message(CLI_USAGE, "%s: takes no value", word);
    }
  } else if (valued) {
    given.value = word + length + 1;
  } else if (*at + 1 < argc) {
    given.value = argv[++*at];
  } else {
    return cli_message(CLI_USAGE, "%s: expected a value", given.name);
  }
  if ((option->how & CLI_REPEATABLE) == 0 && seen[i]) {
    return cli_message(CLI_USAGE, "%s%s%s: %s was already given", given.name,
                       given.value[0] != '\0' ? " " : "", given.value,
                       given.name);
  }
  seen[i] = true;
  *file = (cli_file_t){given, option->how & (CLI_WRITES | CLI_READS)};
  return read_value(option, &given, args);
}

static bool is_built_in(const char *name) {
  int i = 0;
  while (i < TF_SCENES && strcmp(tf_scenes[i]->name, name) != 0) {
    i++;
  }
  return i < TF_SCENES;
}

static int check_needs(const cli_syntax_t *syntax, const bool seen[CLI_ROWS]) {
  for (size_t i = 0; i < syntax->count; i++) {
    const char *needs = syntax->options[i].needs;
    if (seen[i] && needs != NULL && !seen[find_option(syntax, needs)]) {
      return cli_message(CLI_USAGE, "%s: only with %s", syntax->options[i].name,
                         needs);
    }
  }
  return CLI_DONE;
}

int cli_read_words(const cli_syntax_t *syntax, void *args, int argc,
                   char *const argv[], cli_file_t *files) {
  bool seen[CLI_ROWS] = {false};
  for (int at = 0; at < argc; at++) {
    const char *word = argv[at];
    if (is_option(word)) {
      CLI_TRY(read_option(syntax, args, argc, argv, &at, seen, files++));
    } else {
      *files++ = (cli_file_t){{"", word}, is_built_in(word) ? 0 : CLI_READS};
      CLI_TRY(syntax->take(args, word));
    }
  }
  return check_needs(syntax, seen);
}
