// Reading of command lines. Commands read and check everything before they open
// a file, so that a mistyped command never overwrites the result of an earlier
// one. The message about an unknown option or value suggests the closest one.

#include "command.h"
#include "host/output.h"
#include "setup/scene_file.h"

#define MAX_VALUES 1000000u // in one range
#define MOST 128            // options of the table
#define PATH_ROOM 4200

// What was given, in its order, but not what may be given again.
typedef struct {
  cli_given_t given; ///< name: "" of the positional argument
  cli_kind_t kind;
} word_t;

typedef struct {
  const cli_command_t *command;
  cli_args_t *args;
  size_t count;
  word_t words[MOST + 1];
} line_t;

static void set_usual(const cli_command_t *command, cli_args_t *args) {
  for (size_t i = 0; i < cli_option_count; i++) {
    const cli_option_t *option = &cli_options[i];
    void *to = (char *)args + option->member;
    if (!cli_takes(command, option)) continue;
    if (option->kind == CLI_WHOLE)
      *(uint64_t *)to = (uint64_t)option->usual;
    else if (option->kind == CLI_REAL || option->kind == CLI_POSITIVE)
      *(double *)to = option->usual;
    else if (option->kind == CLI_CHOICE)
      *(unsigned *)to = (unsigned)option->usual;
  }
}

// The option that a word begins. NULL: there is none, after a message.
static const cli_option_t *find_option(const cli_command_t *command,
                                       const char *word) {
  const size_t length = strcspn(word, "=");
  cli_closest_t closest = cli_closest_to(word);
  for (size_t i = 0; i < cli_option_count; i++) {
    const cli_option_t *option = &cli_options[i];
    if (!cli_takes(command, option)) continue;
    if ((strlen(option->name) == length &&
         strncmp(option->name, word, length) == 0) ||
        (option->letter != 0 && word[1] == option->letter))
      return option;
    cli_closest_offer(&closest, option->name);
  }
  (void)cli_usage("unknown option %s%s ('twofold help %s' lists them)", word,
                  closest.hint, command->name);
  return NULL;
}

static int read_whole(const cli_option_t *option, const cli_given_t *given,
                      uint64_t *out) {
  const uint64_t low = (uint64_t)option->low, high = (uint64_t)option->high;
  if (cli_read_whole(given->value, low, high, out)) return CLI_DONE;
  return cli_blame(CLI_USAGE, given,
                   "must be a whole number in [%" PRIu64 ", %" PRIu64 "]", low,
                   high);
}

static bool lies_in(const cli_option_t *option, double value) {
  const bool is_open = option->kind == CLI_POSITIVE;
  return !(option->low < option->high) ||
         (value <= option->high &&
          (is_open ? value > option->low : value >= option->low));
}

static int read_range(const cli_option_t *option, const cli_given_t *given,
                      cli_range_t *out) {
  const bool is_real = option->kind == CLI_REAL || option->kind == CLI_POSITIVE;
  char what[32] = "";
  if (!is_real) (void)snprintf(what, sizeof what, "%s ", given->name + 2);
  if (option->kind == CLI_RANGE) {
    CLI_TRY(cli_read_range(given, given->value, MAX_VALUES, false, out));
  } else {
    tf_real_t value = 0;
    CLI_TRY(cli_read_number(given, given->value, &value));
    *out = (cli_range_t){given->value, (double)value, (double)value, 1};
  }
  if (lies_in(option, out->from) && lies_in(option, out->to)) return CLI_DONE;
  return cli_blame(CLI_REFUSED, given, "%smust lie in %s%g, %g]%s%s", what,
                   option->kind == CLI_POSITIVE ? "(" : "[", option->low,
                   option->high, option->unit != NULL ? " " : "",
                   option->unit != NULL ? option->unit : "");
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
             ? cli_blame(CLI_USAGE, given, "must be %s%s", list, closest.hint)
             : cli_blame(CLI_USAGE, given, "unknown %s; %ss are %s%s",
                         option->noun, option->noun, list, closest.hint);
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
                      cli_args_t *args) {
  void *to = (char *)args + option->member;
  unsigned place = 0;
  cli_range_t range;
  switch (option->kind) {
    case CLI_FLAG:
      *(bool *)to = true;
      return CLI_DONE;
    case CLI_READS:
    case CLI_WRITES:
      *(const char **)to = given->value;
      if (given->value[0] != '\0') return CLI_DONE;
      return cli_usage("%s: the name of the file is empty", given->name);
    case CLI_WORD:
      *(const char **)to = given->value;
      return read_choice(option, given, strcspn(given->value, ":"), &place);
    case CLI_WHOLE:
      return read_whole(option, given, to);
    case CLI_REAL:
    case CLI_POSITIVE:
      CLI_TRY(read_range(option, given, &range));
      *(double *)to = range.from;
      return CLI_DONE;
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

static bool was_given(const line_t *line, const char *name) {
  size_t i = 0;
  while (i < line->count && strcmp(line->words[i].given.name, name) != 0) i++;
  return i < line->count;
}

// Reads the option that starts at argv[*at] and moves *at to its last word.
static int read_option(line_t *line, int argc, char *const argv[], int *at) {
  const char *word = argv[*at];
  const cli_option_t *option = find_option(line->command, word);
  if (option == NULL) return CLI_USAGE;
  const bool is_short = word[1] != '-';
  const size_t length = is_short ? 1 : strcspn(word, "=");
  const bool valued = word[length] == '=' || (is_short && word[2] != '\0');
  cli_given_t given = {option->name, ""};
  if (option->value == NULL) {
    if (valued) return cli_usage("%s: takes no value", word);
  } else if (valued) {
    given.value = word + length + 1;
  } else if (*at + 1 < argc) {
    given.value = argv[++*at];
  } else {
    return cli_usage("%s: expected a value", given.name);
  }
  if (!option->is_repeatable) {
    if (was_given(line, given.name)) {
      return cli_usage("%s%s%s: %s was already given", given.name,
                       given.value[0] != '\0' ? " " : "", given.value,
                       given.name);
    }
    line->words[line->count++] = (word_t){given, option->kind};
  }
  return read_value(option, &given, line->args);
}

// Takes a positional argument. A scene of a file has a . or a / in its name.
static int take(line_t *line, const char *word) {
  cli_args_t *args = line->args;
  const bool of_source = line->command->of_source;
  if (!of_source) {
    CLI_TRY(cli_take_scene(&args->scene, word));
  } else if (args->source != NULL) {
    return cli_usage("%s: one source at a time (%s was given)", word,
                     args->source);
  } else {
    args->source = word;
  }
  const bool is_file = of_source || strpbrk(word, "./") != NULL;
  line->words[line->count++] =
      (word_t){{"", word}, is_file ? CLI_READS : CLI_WORD};
  return CLI_DONE;
}

// Whether writing the one, or the `.part` or `.resume` beside it, would destroy
// the other. Standard output takes the rows of one option.
static bool destroys(const word_t *writer, const word_t *file) {
  static const char *const beside[] = {"", ".part", ".resume"};
  const char *value = writer->given.value;
  if (strcmp(value, "-") == 0)
    return file->kind == CLI_WRITES && strcmp(file->given.value, "-") == 0;
  for (size_t i = 0; i < sizeof beside / sizeof beside[0]; i++) {
    char path[PATH_ROOM];
    const int length = snprintf(path, sizeof path, "%s%s", value, beside[i]);
    if (length > 0 && (size_t)length < sizeof path &&
        cli_one_file(path, file->given.value))
      return true;
  }
  return false;
}

static int check_files(const line_t *line) {
  for (size_t i = 0; i < line->count; i++) {
    const word_t *writer = &line->words[i];
    for (size_t k = 0; k < line->count && writer->kind == CLI_WRITES; k++) {
      const word_t *file = &line->words[k];
      const bool is_file = file->kind == CLI_READS || file->kind == CLI_WRITES;
      if (k != i && is_file && destroys(writer, file)) {
        return cli_usage(
            "%s %s would write over %s%s%s: two files are needed",
            writer->given.name, writer->given.value, file->given.name,
            file->given.name[0] != '\0' ? " " : "", file->given.value);
      }
    }
  }
  return CLI_DONE;
}

int cli_read_words(const cli_command_t *command, cli_args_t *args, int argc,
                   char *const argv[]) {
  line_t line = {.command = command, .args = args};
  set_usual(command, args);
  for (int at = 0; at < argc; at++) {
    const char *word = argv[at];
    const bool is_option = word[0] == '-' && word[1] != '\0';
    CLI_TRY(is_option ? read_option(&line, argc, argv, &at)
                      : take(&line, word));
  }
  for (size_t i = 0; i < cli_option_count; i++) {
    const cli_option_t *option = &cli_options[i];
    if (cli_takes(line.command, option) && option->needs != NULL &&
        was_given(&line, option->name) && !was_given(&line, option->needs))
      return cli_usage("%s: only with %s", option->name, option->needs);
  }
  return check_files(&line);
}
