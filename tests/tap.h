/* tap.h - the whole test harness: named checks, TAP on standard output, and
 * for each failure the one command that replays it. A test file is one
 * program: `TEST(name) { ... }` functions, which run in the order of the file;
 * main stands here. A test that has nothing to check in this build returns by
 * SKIP(reason): it is named, and is neither passed nor failed. Options:
 * --seed N, --only NAME. With TAP_BAIL in the environment a program ends at the
 * first test that fails. */
#ifndef TAP_H
#define TAP_H

#include <inttypes.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct tap_test {
  const char *name;
  void (*run)(void);
  int line;
  struct tap_test *next;
} tap_test_t;

static struct {
  tap_test_t *first;
  const char *program, *only, *skip; /* skip: why this test is, or NULL */
  uint64_t seed, state;
  int run, failed, skipped, checks, bad, full;
} tap;

/* How many samples of n a test draws; with FULL=yes in the environment all. */
static inline int samples(int n) { return tap.full ? n : n / 4; }

/* splitmix64; every test starts from the seed again, so order is free. */
static inline uint64_t tap_bits(void) {
  uint64_t z = (tap.state += 0x9E3779B97F4A7C15u);
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}
static inline double tap_uniform(double lo, double hi) {
  return lo + (hi - lo) * ((double)(tap_bits() >> 11) * 0x1p-53);
}

static inline int tap_check(int ok, const char *file, int line,
                            const char *text) {
  tap.checks++;
  if (!ok && tap.bad++ < 5) printf("# %s:%d: %s\n", file, line, text);
  return ok;
}
static inline int tap_near(long double got, long double want, long double tol,
                           const char *file, int line, const char *text) {
  int ok = fabsl(got - want) <= tol; /* false for NaN on either side */
  if (!tap_check(ok, file, line, text) && tap.bad <= 5)
    printf("#   got %.21Lg, want %.21Lg, off by %.3Lg > %.3Lg\n", got, want,
           got - want, tol);
  return ok;
}
static inline int tap_above(long double got, long double least,
                            const char *file, int line, const char *text) {
  int ok = got > least;
  if (!tap_check(ok, file, line, text) && tap.bad <= 5)
    printf("#   %.6Lg is not above %.6Lg\n", got, least);
  return ok;
}
#define CHECK(cond) tap_check(!!(cond), __FILE__, __LINE__, #cond)
#define CHECK_NEAR(got, want, tol) \
  tap_near((got), (want), (tol), __FILE__, __LINE__, #got " near " #want)
/* How often something was seen, or how small it stayed. */
#define CHECK_ABOVE(got, least) \
  tap_above((got), (least), __FILE__, __LINE__, #got " > " #least)
#define CHECK_BELOW(got, most) CHECK_ABOVE(most, got)

static inline void tap_run(const tap_test_t *test) {
  if (tap.only && strcmp(tap.only, test->name)) return;
  tap.skip = NULL;
  tap.state = tap.seed;
  tap.checks = tap.bad = 0;
  test->run();
  if (!tap.checks && !tap.skip)
    printf("# %s checks nothing\n", test->name), tap.bad = 1;
  tap.run++;
  tap.failed += tap.bad > 0;
  tap.skipped += tap.skip && !tap.bad;
  printf("%sok %d - %s%s%s\n", tap.bad ? "not " : "", tap.run, test->name,
         tap.skip ? " # SKIP " : "", tap.skip ? tap.skip : "");
  if (tap.bad)
    printf("# replay: %s --only %s --seed %" PRIu64 "\n", tap.program,
           test->name, tap.seed);
  fflush(stdout);
  if (tap.bad && getenv("TAP_BAIL")) exit(1);
}

/* Each test enters itself before main begins, in the order of its lines. */
static inline void tap_enter(tap_test_t *test) {
  tap_test_t **at = &tap.first;
  while (*at && (*at)->line < test->line) at = &(*at)->next;
  test->next = *at;
  *at = test;
}
#define TEST(name)                                              \
  static void name(void);                                       \
  __attribute__((constructor)) static void enter_##name(void) { \
    static tap_test_t test = {#name, name, __LINE__, NULL};     \
    tap_enter(&test);                                           \
  }                                                             \
  static void name(void)
#define SKIP(reason)     \
  do {                   \
    tap.skip = (reason); \
    return;              \
  } while (0)

static inline int tap_main(int argc, char **argv) {
  tap.program = argv[0];
  tap.seed = 20140911u;
  const char *full = getenv("FULL");
  tap.full = full && *full;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (!strcmp(argv[i], "--seed")) tap.seed = strtoull(argv[i + 1], NULL, 0);
    if (!strcmp(argv[i], "--only")) tap.only = argv[i + 1];
  }
  for (const tap_test_t *test = tap.first; test; test = test->next)
    tap_run(test);
  printf("1..%d\n", tap.run);
  if (tap.skipped) printf("# %d skipped\n", tap.skipped);
  printf("%d passed, %d failed\n", tap.run - tap.failed - tap.skipped,
         tap.failed);
  return tap.failed || !tap.run;
}

int main(int argc, char **argv) { return tap_main(argc, argv); }

#endif
