/* Every file of the corpus, and every input that once broke a promise
 * (tests/regress/crash-TARGET-*), through its fuzz target: what the fuzzer has
 * found out is held by every compiler, without libFuzzer. Runs from the root of
 * the project. */
#ifndef _POSIX_C_SOURCE
#define _POSIX_C_SOURCE 200809L
#endif
#include <dirent.h>

#include "../../tools/verify/fuzz/fuzz.h"
#include "tap.h"

#define LONGEST 65536

static void replay(const char *path, fuzz_target_t target) {
  static uint8_t data[LONGEST];
  FILE *file = fopen(path, "rb");
  CHECK(file != NULL);
  if (file == NULL) return;
  const size_t size = fread(data, 1, sizeof data, file);
  fclose(file);
  /* A copy of its own size, for the sanitizers. */
  uint8_t *copy = malloc(size + 1);
  CHECK(copy != NULL);
  if (copy == NULL) return;
  memcpy(copy, data, size);
  const char *broken = target(copy, size);
  if (!CHECK(broken == NULL)) printf("#   %s: %s\n", path, broken);
  free(copy);
}

/* Returns: how many files of a directory whose names begin so. */
static int replay_all(const char *room, const char *prefix,
                      fuzz_target_t target) {
  int count = 0;
  DIR *directory = opendir(room);
  CHECK(directory != NULL);
  if (directory == NULL) return 0;
  for (struct dirent *at; (at = readdir(directory)) != NULL;) {
    char path[512];
    if (at->d_name[0] == '.' ||
        strncmp(at->d_name, prefix, strlen(prefix)) != 0)
      continue;
    const int length = snprintf(path, sizeof path, "%s/%s", room, at->d_name);
    if (!CHECK(length > 0 && length < (int)sizeof path)) continue;
    replay(path, target);
    count++;
  }
  closedir(directory);
  return count;
}

static void replay_target(const char *room, const char *crashes,
                          fuzz_target_t target) {
  const int files = replay_all(room, "", target);
  const int crashed = replay_all("tests/regress", crashes, target);
  printf("# %s: %d files, %d of former crashes\n", room, files, crashed);
  CHECK(files > 0);
}

/* Complaints about what was typed are what these targets are meant to cause. */
static void replay_quietly(const char *room, const char *crashes,
                           fuzz_target_t target) {
  CHECK(freopen("/dev/null", "w", stderr) != NULL);
  replay_target(room, crashes, target);
}

TEST(corpus_of_machines_keeps_the_promises) {
  replay_target("tests/corpus/machine", "crash-machine-", fuzz_machine);
}

TEST(corpus_of_frames_keeps_the_promises) {
  replay_target("tests/corpus/frame", "crash-frame-", fuzz_frame);
}

TEST(corpus_of_arguments_keeps_the_promises) {
  replay_quietly("tests/corpus/arguments", "crash-arguments-", fuzz_arguments);
}

TEST(corpus_of_scenes_keeps_the_promises) {
  replay_quietly("tests/corpus/scene", "crash-scene-", fuzz_scene);
}

TEST(corpus_of_tables_keeps_the_promises) {
  replay_quietly("tests/corpus/table", "crash-table-", fuzz_table);
}

TEST(corpus_of_states_keeps_the_promises) {
  replay_quietly("tests/corpus/state", "crash-state-", fuzz_state);
}

TEST(corpus_of_records_keeps_the_promises) {
  replay_quietly("tests/corpus/record", "crash-record-", fuzz_record);
}
