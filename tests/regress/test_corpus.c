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

TEST(corpus_keeps_the_promises) {
  static const struct {
    const char *name;
    fuzz_target_t target;
  } targets[] = {{"machine", fuzz_machine},
                 {"frame", fuzz_frame},
                 {"scene", fuzz_scene},
                 {"table", fuzz_table},
                 {"state", fuzz_state}};
  /* Some of them are meant to cause complaints about what was typed. */
  CHECK(freopen("/dev/null", "w", stderr) != NULL);
  for (size_t i = 0; i < sizeof targets / sizeof *targets; i++) {
    char room[64], crashes[64];
    snprintf(room, sizeof room, "tests/corpus/%s", targets[i].name);
    snprintf(crashes, sizeof crashes, "crash-%s-", targets[i].name);
    const int files = replay_all(room, "", targets[i].target);
    const int crashed = replay_all("tests/regress", crashes, targets[i].target);
    printf("# %s: %d files, %d of former crashes\n", room, files, crashed);
    CHECK(files > 0);
  }
}
