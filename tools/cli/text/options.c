// Reading of command lines. Commands read and check everything before they
// open a file, so that a mistyped command never overwrites the result of an
// earlier one. The message about an unknown option suggests the closest one.

#include "options.h"

#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "closest.h"
#include "message.h"
#include "number.h"
#include "one_file.h"
#include "twofold.h"

#define PATH_ROOM 4200

static int unknown_option(const cli_syntax_t *syntax, const char *word) {
  cli_closest_t closest = cli_closest_to(word);
  for (size_t i = 0; i < syntax->count; i++) {
    cli_closest_offer(&closest, syntax->options[i].name);
  }
  const cli_hint_t hint = cli_closest_hint(&closest);
  return cli_message(CLI_USAGE,
                     "unknown option %s%s%s%s ('twofold help %s' lists them)",
                     word, hint.before, hint.name, hint.after, syntax->command);
}

static int given_twice(const cli_given_t *given) {
  return cli_message(CLI_USAGE, "%s%s%s: %s was already given", given->name,
                     given->value[0] != '\0' ? " " : "", given->value,
                     given->name);
}

static bool is_option(const char *word) {
  return word[0] == '-' && word[1] != '\0';
}

// The number of the option that a word begins, syntax->count: unknown.
static size_t find_option(const cli_syntax_t *syntax, const char *word) {
  const size_t length = strcspn(word, "=");
  size_t i = 0;
  while (i < syntax->count &&
         (strlen(syntax->options[i].name) != length ||
          strncmp(syntax->options[i].name, word, length) != 0)) {
    i++;
  }
  return i;
}

// Reads the option that starts at argv[*at] and moves *at to its last word.
// seen: in/out, bits of the options before.
static int read_option(const cli_syntax_t *syntax, void *args, int argc,
                       char *const argv[], int *at, uint64_t *seen) {
  const char *word = argv[*at];
  const size_t length = strcspn(word, "=");
  const size_t i = find_option(syntax, word);
  if (i == syntax->count) {
    return unknown_option(syntax, word);
  }
  const cli_option_t *option = &syntax->options[i];
  const bool valued = word[length] == '=';
  cli_given_t given = {option->name, ""};
  if ((option->how & CLI_FLAG) != 0) {
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
  if ((option->how & CLI_REPEATABLE) == 0 && ((*seen >> i) & 1u) != 0) {
    return given_twice(&given);
  }
  *seen |= UINT64_C(1) << i;
  return option->read(args, &given);
}

// A file that a command line names. how: CLI_WRITES, CLI_READS, or 0: none.
typedef struct {
  cli_given_t given;
  unsigned how;
} file_t;

static bool is_built_in(const char *name) {
  for (int i = 0; i < TF_SCENES; i++) {
    if (strcmp(tf_scenes[i]->name, name) == 0) {
      return true;
    }
  }
  return false;
}

// What the words from argv[*at] on name; moves *at behind them. They were read
// before, so that they are right.
static file_t next_file(const cli_syntax_t *syntax, char *const *argv,
                        int *at) {
  const char *word = argv[(*at)++];
  if (!is_option(word)) {
    return (file_t){{"", word}, is_built_in(word) ? 0 : CLI_READS};
  }
  const cli_option_t *option = &syntax->options[find_option(syntax, word)];
  const char *equals = strchr(word, '=');
  file_t file = {{option->name, ""}, option->how & (CLI_WRITES | CLI_READS)};
  if (equals != NULL) {
    file.given.value = equals + 1;
  } else if ((option->how & CLI_FLAG) == 0) {
    file.given.value = argv[(*at)++];
  }
  return file;
}

// Whether writing the one would destroy the other. Standard output takes the
// rows of one option.
static bool destroys(const file_t *writer, const file_t *file) {
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
    const file_t writer = next_file(syntax, argv, &at);
    for (int other = 0; writer.how == CLI_WRITES && other < argc;) {
      const bool itself = other == begin;
      const file_t file = next_file(syntax, argv, &other);
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

int cli_read_words(const cli_syntax_t *syntax, void *args, int argc,
                   char *const argv[]) {
  uint64_t seen = 0;
  int code = CLI_DONE;
  for (int at = 0; at < argc && code == CLI_DONE; at++) {
    const char *word = argv[at];
    code = is_option(word) ? read_option(syntax, args, argc, argv, &at, &seen)
                           : syntax->take(args, word);
  }
  return code == CLI_DONE ? check_files(syntax, argc, argv) : code;
}

int cli_read_path(const cli_given_t *given, const char **out) {
  if (given->value[0] == '\0') {
    return cli_message(CLI_USAGE, "%s: the name of the file is empty",
                       given->name);
  }
  *out = given->value;
  return CLI_DONE;
}

int cli_read_summary(const cli_given_t *given, bool *json) {
  *json = strcmp(given->value, "json") == 0;
  return *json || strcmp(given->value, "text") == 0
             ? CLI_DONE
             : cli_message(CLI_USAGE, "%s %s: must be text or json",
                           given->name, given->value);
}

int cli_read_count(const cli_given_t *given, uint64_t low, uint64_t high,
                   uint64_t *out) {
  if (cli_read_whole(given->value, low, high, out)) {
    return CLI_DONE;
  }
  return cli_message(
      CLI_USAGE, "%s %s: must be a whole number in [%" PRIu64 ", %" PRIu64 "]",
      given->name, given->value, low, high);
}
