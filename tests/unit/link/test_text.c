/* The text mode: numbers as printf would write them, in labelled pairs. */
#include "common.h"
#include "link/parts.h"

static const char *text(tf_real_t value) {
  static char out[DECIMAL_SIZE + 2];
  memset(out, '~', sizeof out);
  const size_t length = tf_decimal(out, value);
  CHECK(length >= 1 && length <= DECIMAL_SIZE && out[length] == '~');
  out[length] = '\0';
  return out;
}

TEST(text_numbers_are_plain) {
  static const struct {
    tf_real_t value;
    const char *want;
  } known[] = {{0, "0"},
               {1, "1"},
               {-1, "-1"},
               {TF_R(0.18), "0.18"},
               {TF_R(-1.037), "-1.037"},
               {TF_R(0.1), "0.1"},
               {10, "10"},
               {120, "120"},
               {TF_R(120.5), "120.5"},
               {123456, "123456"},
               {TF_R(999999.9), "1e6"},
               {TF_R(0.99999996), "1"},
               {TF_R(0.5), "0.5"},
               {TF_R(0.00012345), "0.00012345"},
               {TF_R(0.000012345), "0.000012345"},
               {TF_R(1e-10), "1e-10"},
               {TF_R(1.5e-10), "1.5e-10"},
               {1234567, "1.23457e6"},
               {TF_R(-2.5e30), "-2.5e30"}};
  for (unsigned i = 0; i < sizeof known / sizeof known[0]; i++) {
    const char *got = text(known[i].value);
    if (!CHECK(!strcmp(got, known[i].want)))
      printf("# %s, want %s\n", got, known[i].want);
  }
  CHECK(!strcmp(text((tf_real_t)NAN), "nan"));
  CHECK(!strcmp(text((tf_real_t)INFINITY), "inf") &&
        !strcmp(text(-(tf_real_t)INFINITY), "-inf"));
  CHECK(strlen(text(-TF_REAL_MAX)) > 5 && strlen(text(TF_REAL_MIN)) > 5);
  text(TF_REAL_MIN * TF_REAL_EPSILON);
}

TEST(text_numbers_read_back) {
  for (int n = 0; n < samples(200000); n++) {
    tf_real_t value = 0;
    const uint64_t bits = tap_bits();
    if (n % 2)
      value = uniform(-10, 10);
    else
      memcpy(&value, &bits, sizeof value);
    const real size = fabsl(wide(value));
    if (!(size <= wide(TF_REAL_MAX)) || size < wide(TF_REAL_MIN)) continue;
    /* Half a unit of the sixth digit, and what scaling may cost. */
    const real scaling = n % 2 ? 4e-7L : 400 * EPSILON;
    CHECK_NEAR(strtold(text(value), NULL), wide(value),
               size * (5.001e-6L + scaling));
  }
}

TEST(text_rows_are_label_value_pairs) {
  tf_state_t state = {.r = TF_R(0.18), .v = TF_R(-2.5), .w = TF_R(-1.037)};
  tf_report_t report = {.slip = {.h = TF_R(1e-10)}};
  char out[TF_TEXT_ROW_ROOM + 1];
  size_t length = tf_text_row(out, &state, &report);
  const char want[] = "r:0.18 v:-2.5 omega:-1.037 h:1e-10 g:0\n";
  CHECK(length == strlen(want) && !memcmp(out, want, length));
  const tf_real_t longest = IS_DOUBLE ? -TF_REAL_MIN : TF_R(-1.23456e-30);
  state.r = state.v = state.w = longest;
  report.slip.h = report.slip.g = longest;
  length = tf_text_row(out, &state, &report);
  CHECK(length <= TF_TEXT_ROW_ROOM && out[length - 1] == '\n');
}
