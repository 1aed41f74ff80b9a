/* Names are a contract: tables and messages contain them. So are their numbers,
 * which docs/PROTOCOL.md lists: frames contain them. */
#include <limits.h>

#include "tap.h"
#include "twofold.h"

/* The functions take enumerations of their own; here all take a number. */
static const char *status(unsigned i) { return tf_status_name((tf_status_t)i); }
static const char *law(unsigned i) {
  return tf_tyre_law_name((tf_tyre_law_t)i);
}
static const char *rule(unsigned i) { return tf_rule_name((tf_rule_t)i); }
static const char *rest(unsigned i) {
  return tf_rest_law_name((tf_rest_law_t)i);
}

static const struct {
  const char *(*name_of)(unsigned);
  unsigned count;
  const char *unknown;
  const char *names[6];
} contract[] = {
    {tf_mode_name,
     TF_MODES,
     "unknown mode",
     {"slip+", "slip-", "stick+", "stick-", "pinned"}},
    {law,
     TF_TYRE_LAWS,
     "unknown law",
     {"jump", "coulomb", "two_piece", "string", "smooth", "none"}},
    {rule, TF_RULES, "unknown rule", {"persist", "slip+", "slip-", "random"}},
    {rest, TF_REST_LAWS, "unknown law of rest", {"hull", "square", "bow_tie"}},
    {tf_region_name,
     TF_REGIONS,
     "unknown",
     {"sliding", "escaping", "crossing_up", "crossing_down", "codim2"}},
    {tf_folds_name,
     TF_FOLDS,
     "unknown",
     {"invisible", "visible", "visible-invisible", "degenerate",
      "continuous"}}};

TEST(names_are_the_contract) {
  for (size_t i = 0; i < sizeof contract / sizeof *contract; i++) {
    for (unsigned n = 0; n < contract[i].count; n++)
      CHECK(!strcmp(contract[i].name_of(n), contract[i].names[n]));
    const unsigned beyond[] = {contract[i].count, UINT_MAX};
    for (int n = 0; n < 2; n++)
      CHECK(!strcmp(contract[i].name_of(beyond[n]), contract[i].unknown));
  }
  const unsigned mode[] = {TF_SLIP_PLUS, TF_SLIP_MINUS, TF_STICK_PLUS,
                           TF_STICK_MINUS, TF_PINNED};
  for (unsigned i = 0; i < TF_MODES; i++)
    CHECK(mode[i] == i && TF_MODE_BIT(i) == 1u << i);
  for (unsigned i = TF_ABSENCE_MOMENT; i <= TF_ABSENCE_ARM; i++)
    CHECK(strstr(tf_absence_name(i), "positive everywhere"));
}

/* Of statuses and of reasons, which are sentences: each has its own. */
static void judge_distinct(const char *(*name_of)(unsigned), int first,
                           int last, const char *unknown) {
  for (int i = first; i <= last; i++) {
    const char *name = name_of((unsigned)i);
    CHECK(name[0] && strcmp(name, unknown) != 0);
    for (int j = first; j < i; j++)
      CHECK(strcmp(name, name_of((unsigned)j)) != 0);
  }
  const int beyond[] = {first - 1, last + 1, INT_MAX, INT_MIN};
  for (int i = 0; i < 4; i++)
    CHECK(!strcmp(name_of((unsigned)beyond[i]), unknown));
}

TEST(status_names_are_distinct) {
  judge_distinct(status, TF_STEP_TOO_LONG, TF_STALLED, "unknown status");
}

TEST(reasons_and_types_have_names) {
  judge_distinct(tf_absence_name, 0, TF_ABSENCES - 1, "unknown");
}
