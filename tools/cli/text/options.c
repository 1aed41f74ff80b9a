// Reading of command lines. Commands read and check everything before they
// open a file, so that a mistyped command never overwrites the result of an
// earlier one. The message about an unknown option suggests the closest one.

#include "options.h"

#include <inttypes.h>
#include <stdbool.h>
#include <string.h>

#include "closest.h"
#include "message.h"
#include "number.h"

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

// Reads the option that starts at argv[*at] and moves *at to its last word.
// seen: in/out, bits of the options before.
static int read_option(const cli_syntax_t *syntax, void *args, int argc,
                       char *const argv[], int *at, uint64_t *seen) {
  const char *word = argv[*at];
  const size_t length = strcspn(word, "=");
  size_t i = 0;
  while (i < syntax->count &&
         (strlen(syntax->options[i].name) != length ||
          strncmp(syntax->options[i].name, word, length) != 0)) {
    i++;
  }
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

int cli_read_words(const cli_syntax_t *syntax, void *args, int argc,
                   char *const argv[]) {
  uint64_t seen = 0;
  int code = CLI_DONE;
  for (int at = 0; at < argc && code == CLI_DONE; at++) {
    const char *word = argv[at];
    code = word[0] == '-' && word[1] != '\0'
               ? read_option(syntax, args, argc, argv, &at, &seen)
               : syntax->take(args, word);
  }
  return code;
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
