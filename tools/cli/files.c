// One rule for all commands: what an option writes is no other word's file.
// Words that are no files name none; only a number or a mode that happens to be
// the name of a file here is refused without need, and says so.

#include "files.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "host/destination.h"
#include "text/message.h"
#include "twofold.h"

static const char *const writers[] = {"--out",      "--save",  "--record",
                                      "--lateness", "--exits", "--returns",
                                      "--counts"};
// What a writer has beside its file while it is not whole, or goes on.
static const char *const beside[] = {"", ".part", ".resume"};

// The option whose value stands at argv[at], and the value; name NULL: a word
// of its own.
typedef struct {
  const char *name, *value;
  size_t length; ///< of the name
} word_t;

static word_t word_at(int at, char *const argv[]) {
  const char *equals = strchr(argv[at], '=');
  if (argv[at][0] == '-' && equals != NULL) {
    return (word_t){argv[at], equals + 1, (size_t)(equals - argv[at])};
  }
  if (at > 0 && strncmp(argv[at - 1], "--", 2) == 0) {
    return (word_t){argv[at - 1], argv[at], strlen(argv[at - 1])};
  }
  return (word_t){NULL, argv[at], 0};
}

static bool is_writer(const word_t *word) {
  for (size_t i = 0; i < sizeof writers / sizeof writers[0]; i++) {
    if (word->name != NULL && strlen(writers[i]) == word->length &&
        strncmp(writers[i], word->name, word->length) == 0) {
      return true;
    }
  }
  return false;
}

static bool is_built_in(const char *name) {
  for (int i = 0; i < TF_SCENES; i++) {
    if (strcmp(tf_scenes[i]->name, name) == 0) {
      return true;
    }
  }
  return false;
}

// Whether the word is the file of the writer, or what is beside it; standard
// output takes the rows of one.
static bool meets(const word_t *writer, const word_t *word) {
  char path[CLI_PATH_ROOM];
  if (strcmp(writer->value, "-") == 0) {
    return is_writer(word) && strcmp(word->value, "-") == 0;
  }
  for (size_t i = 0; i < sizeof beside / sizeof beside[0]; i++) {
    const int length =
        snprintf(path, sizeof path, "%s%s", writer->value, beside[i]);
    if (length > 0 && (size_t)length < sizeof path &&
        cli_one_file(path, word->value)) {
      return true;
    }
  }
  return false;
}

// The same option twice is told by who reads it.
static bool same_option(const word_t *one, const word_t *other) {
  return other->name != NULL && one->length == other->length &&
         strncmp(one->name, other->name, one->length) == 0;
}

int cli_check_files(int argc, char *const argv[]) {
  for (int i = 0; i < argc; i++) {
    const word_t writer = word_at(i, argv);
    for (int j = 0; is_writer(&writer) && j < argc; j++) {
      const word_t word = word_at(j, argv);
      if (j != i && !same_option(&writer, &word) &&
          !(word.name == NULL && is_built_in(word.value)) &&
          meets(&writer, &word)) {
        return cli_message(
            CLI_USAGE, "%.*s %s would write over %s: two files are needed",
            (int)writer.length, writer.name, writer.value, word.value);
      }
    }
  }
  return CLI_DONE;
}
