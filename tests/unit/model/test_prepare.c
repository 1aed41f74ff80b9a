/* The border of the core: what tf_prepare accepts, what it refuses and which
 * member it blames; then constants that it derives.
 * Behind this border nothing is validated again, so every entry of the table
 * is tried at both ends, just outside them and at what is not a number. */
#include <stddef.h>

#include "common.h"

/* Refused with this offender, without a mark on the machine. */
static void refused(const tf_params_t *params, int blamed) {
  tf_machine_t machine, before;
  int offender = -7;
  memset(&machine, 0xA5, sizeof machine);
  memset(&before, 0xA5, sizeof before);
  CHECK(tf_prepare(&machine, params, &offender) == TF_BAD_PARAMETER);
  CHECK(memcmp(&machine, &before, sizeof machine) == 0);
  if (!CHECK(offender == blamed))
    printf("# blamed %d, should be %d\n", offender, blamed);
  CHECK(tf_prepare(&machine, params, NULL) == TF_BAD_PARAMETER);
  CHECK(memcmp(&machine, &before, sizeof machine) == 0);
  tf_compensated_t pairs, old;
  memset(&pairs, 0xA5, sizeof pairs);
  memset(&old, 0xA5, sizeof old);
  offender = -7;
  CHECK(tf_prepare_compensated(&pairs, params, &offender) == TF_BAD_PARAMETER);
  CHECK(memcmp(&pairs, &old, sizeof pairs) == 0 && offender == blamed);
}

static tf_machine_t accepted(const tf_params_t *params) {
  tf_machine_t machine;
  int offender = -7;
  memset(&machine, 0, sizeof machine);
  CHECK(tf_prepare(&machine, params, &offender) == TF_OK);
  CHECK(offender == -7);
  CHECK(tf_prepare(&machine, params, NULL) == TF_OK);
  return machine;
}

/* One member set to one value under one law. */
static void judge(tf_tyre_law_t law, int i, tf_real_t value, bool in_range) {
  tf_params_t p = params_of_law(law);
  *member(&p, i) = value;
  if (in_range || !((tf_parameter_ranges[i].laws >> law) & 1u))
    accepted(&p);
  else
    refused(&p, i);
}

static void first_of_two(tf_tyre_law_t law, int i, int j) {
  tf_params_t p = params_of_law(law);
  *member(&p, i) = (tf_real_t)NAN;
  *member(&p, j) = (tf_real_t)INFINITY;
  const bool i_counts = (tf_parameter_ranges[i].laws >> law) & 1u;
  const bool j_counts = (tf_parameter_ranges[j].laws >> law) & 1u;
  if (i_counts || j_counts) refused(&p, i_counts ? i : j);
}

TEST(prepare_names_the_first_broken_rule) {
  for (int n = 0; n < TF_TYRE_LAWS; n++) {
    const tf_tyre_law_t law = (tf_tyre_law_t)n;
    const tf_params_t good = params_of_law(law);
    accepted(&good);
    for (int i = 0; i < TF_PARAMETERS; i++) {
      const tf_parameter_range_t *range = &tf_parameter_ranges[i];
      const tf_real_t infinity = (tf_real_t)INFINITY;
      judge(law, i, range->low, true);
      judge(law, i, range->high, true);
      judge(law, i, NEXT(range->low, range->high), true);
      judge(law, i, NEXT(range->high, range->low), true);
      judge(law, i, NEXT(range->low, -infinity), false);
      judge(law, i, NEXT(range->high, infinity), false);
      judge(law, i, infinity, false);
      judge(law, i, -infinity, false);
      judge(law, i, (tf_real_t)NAN, false);
      for (int j = i + 1; j < TF_PARAMETERS; j++) first_of_two(law, i, j);
    }
  }
}

/* Before any member is looked at. */
TEST(an_unknown_law_or_rule_is_blamed_on_neither_member) {
  const unsigned wrong[][2] = {
      {TF_TYRE_LAWS, TF_RULES}, {99, 99}, {UINT32_MAX, UINT32_MAX}};
  for (int i = 0; i < 3; i++) {
    tf_params_t law = params_of_law(TF_TYRE_JUMP), rule = law;
    law.law = (tf_tyre_law_t)wrong[i][0];
    rule.rule = (tf_rule_t)wrong[i][1];
    refused(&law, TF_PARAMETERS);
    refused(&rule, TF_PARAMETERS);
    law.m = rule.m = -1;
    refused(&law, TF_PARAMETERS);
    refused(&rule, TF_PARAMETERS);
  }
  for (int i = 0; i < TF_RULES; i++) {
    tf_params_t p = params_of_law(TF_TYRE_JUMP);
    p.rule = (tf_rule_t)i;
    CHECK(accepted(&p).contact.rule == p.rule);
  }
}

/* Which law needs which member, from the comments of tf_params_t. */
TEST(the_table_is_the_contract) {
  const double PI = 3.14159265358979323846;
  const unsigned all = (1u << TF_TYRE_LAWS) - 1;
  const unsigned kappa =
      1u << TF_TYRE_JUMP | 1u << TF_TYRE_TWO_PIECE | 1u << TF_TYRE_SMOOTH;
  const unsigned string = 1u << TF_TYRE_STRING;
  const struct {
    const char *name;
    unsigned laws;
    double low, high;
  } want[TF_PARAMETERS] = {{"m", all, 1e-12, 1e12},
                           {"d", all, -1e6, 1e6},
                           {"beta", all, 1e-9, 1e6},
                           {"k2", all, 0, 1e15},
                           {"c1", all, 0, 1e12},
                           {"c2", all, 0, 1e12},
                           {"r0", all, -1e6, 1e6},
                           {"omega0", all, -1e6, 1e6},
                           {"mu", all, 0, 1e9},
                           {"kappa", kappa, 1e-9, 1e6},
                           {"gamma", all, -PI, PI},
                           {"epsilon", 1u << TF_TYRE_SMOOTH, 1e-12, 1e6},
                           {"k", string | 1u << TF_TYRE_TWO_PIECE, 1e-9, 1e12},
                           {"delta", string, 1e-9, 1e9},
                           {"sigma", string, 0, 1e6},
                           {"rho", string, 1e-6, 1},
                           {"a", string, 1e-9, 1e6},
                           {"theta", all, 0.5, 1},
                           {"dt", all, 1e-9, 1},
                           {"rate", all, 0, 1e9},
                           {"tolerance", all, 0, 1e-3},
                           {"segments", all, 0, 1000}};
  for (int i = 0; i < TF_PARAMETERS; i++) {
    const tf_parameter_range_t *range = &tf_parameter_ranges[i];
    CHECK(strcmp(range->name, want[i].name) == 0);
    CHECK(range->laws == want[i].laws);
    CHECK(range->low == (tf_real_t)want[i].low);
    CHECK(range->high == (tf_real_t)want[i].high);
    CHECK(range->unit && range->unit[0]);
    CHECK(range->offset == (size_t)i * sizeof(tf_real_t));
  }
  CHECK(offsetof(tf_params_t, segments) == 21 * sizeof(tf_real_t));
}

TEST(exit_threshold_at_its_ends) {
  tf_params_t p = params_of_law(TF_TYRE_JUMP);
  p.rate = 0;
  CHECK(accepted(&p).contact.exit_threshold == 0);
  p.rate = TF_R(1e9);
  p.dt = 1;
  CHECK(accepted(&p).contact.exit_threshold == UINT64_C(1) << 63);
}

/* Without friction, or with less than a normal number, nothing is divided by
 * it: each inverse is 0. */
TEST(no_friction_has_no_inverse) {
  const tf_real_t none[] = {0, TF_REAL_MIN / 2};
  for (int i = 0; i < 2; i++) {
    tf_params_t p = params_of_law(TF_TYRE_JUMP);
    p.mu = none[i];
    const tf_machine_t k = accepted(&p);
    CHECK(k.contact.inv_mu == 0 && k.contact.inv_kappa_mu == 0 &&
          k.inv_mu_dt == 0);
  }
  tf_params_t p = params_of_law(TF_TYRE_JUMP);
  p.mu = TF_REAL_MIN; /* the least normal one has an inverse */
  const tf_machine_t k = accepted(&p);
  CHECK(k.contact.inv_mu * TF_REAL_MIN == 1);
  p.kappa = TF_R(0.125);
  for (int i = 2; i <= 32; i *= 2) { /* nor has stick a smaller moment */
    p.mu = (tf_real_t)i * TF_REAL_MIN;
    CHECK((accepted(&p).contact.stick_kappa > 0) == (i >= 8));
  }
}
