/* Numbers as text against the C library's: the fewest digits of "%.*g" that
 * read back, from the number of digits that any decimal survives; of subnormals
 * from one. Where the gap below a power of two hides them, the decimal above
 * the nearest one has as few. */
#include <float.h>

#include "../../tools/cli/text/text.h"
#include "tap.h"

static bool reads_back(const char *text, double value, bool is_float) {
  return (is_float ? (double)strtof(text, NULL) : strtod(text, NULL)) == value;
}

/* The decimal next above the nearest one. */
static bool is_above(char text[CLI_REAL_ROOM], int digits, double value,
                     bool is_float) {
  (void)snprintf(text, CLI_REAL_ROOM, "%.*e", digits - 1, value);
  char *last = strchr(text, 'e') - 1;
  if (*last < '0' || *last > '8') return false;
  ++*last;
  return reads_back(text, value, is_float);
}

static void write_by_search(char text[CLI_REAL_ROOM], double value,
                            bool is_float) {
  int exponent;
  const bool is_power = fabs(frexp(value, &exponent)) == 0.5;
  const bool subnormal = fabs(value) < (is_float ? (double)FLT_MIN : DBL_MIN);
  const int enough = is_float ? 9 : 17;
  int digits = subnormal ? 1 : is_float ? FLT_DIG : DBL_DIG;
  for (; digits <= enough; digits++) {
    (void)snprintf(text, CLI_REAL_ROOM, "%.*g", digits, value);
    if (reads_back(text, value, is_float) ||
        (is_power && digits < enough &&
         is_above(text, digits, value, is_float)))
      return;
  }
}

static void judge(double value, bool is_float) {
  char got[CLI_REAL_ROOM], want[CLI_REAL_ROOM];
  const size_t length = decimal_write(got, value, is_float);
  write_by_search(want, value, is_float);
  if (!CHECK(strcmp(got, want) == 0 && length == strlen(got)))
    printf("# %a%s: %s, not %s\n", value, is_float ? "f" : "", got, want);
}

static double of_bits(uint64_t bits, bool is_float) {
  const uint32_t half = (uint32_t)bits;
  double value;
  float single;
  memcpy(&value, &bits, sizeof value);
  memcpy(&single, &half, sizeof single);
  return is_float ? (double)single : value;
}

TEST(any_bits_are_written_with_the_fewest_digits) {
  for (int i = tap.full ? 100000000 : 25000; i > 0; i--) {
    const uint64_t bits = tap_bits();
    if (!isnan(of_bits(bits, false))) judge(of_bits(bits, false), false);
    if (!isnan(of_bits(bits, true))) judge(of_bits(bits, true), true);
  }
}

TEST(numbers_of_usual_size_and_subnormals_are) {
  for (int i = samples(200000); i > 0; i--) {
    const double value = tap_uniform(-1, 1) * pow(10, tap_uniform(-17, 17));
    judge(value, false);
    judge((double)(float)value, true);
    judge((double)(tap_bits() % 2000000) * 1e-4, false);
    judge(of_bits(tap_bits() >> 12, false), false);
    judge(of_bits(tap_bits() >> 41, true), true);
  }
}

TEST(powers_of_two_and_of_ten_and_their_neighbours_are) {
  for (int e = -1074; e < 1024; e++)
    for (int i = -2; i <= 2; i++) {
      const double value = ldexp(1, e);
      judge(i < 0   ? nextafter(value, -1)
            : i > 0 ? nextafter(value, 9)
                    : value,
            false);
      if (e >= -149 && e < 128) judge(value, true);
    }
  for (int e = -323; e <= 308; e++) {
    char text[CLI_REAL_ROOM];
    for (int digit = 1; digit < 10; digit++) {
      (void)snprintf(text, sizeof text, "%de%d", digit, e);
      judge(strtod(text, NULL), false);
      judge((double)strtof(text, NULL), true);
    }
  }
}

TEST(the_smallest_numbers_and_whole_ones_are) {
  for (uint64_t bits = 1; bits < 3000; bits++) {
    judge(of_bits(bits, false), false);
    judge(of_bits(bits, true), true);
    judge((double)bits, false);
    judge((double)bits, true);
    judge(9007199254740992.0 - (double)bits, false);
  }
}

TEST(what_has_no_digits_has_a_word) {
  char text[CLI_REAL_ROOM];
  static const struct {
    double value;
    const char *text;
  } words[] = {{0, "0"}, {-0.0, "-0"}, {INFINITY, "inf"}, {-INFINITY, "-inf"}};
  for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
    CHECK(decimal_write(text, words[i].value, i % 2 == 0) ==
          strlen(words[i].text));
    CHECK(strcmp(text, words[i].text) == 0);
  }
  (void)decimal_write(text, (double)NAN, false);
  CHECK(strcmp(text + (text[0] == '-'), "nan") == 0);
}
