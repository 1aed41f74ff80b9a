/* The passes of an ensemble that find its solution sets, against the
 * enumeration, on inclusions of small whole numbers: ties and zeros of every
 * kind are common there, and each number is exact. */
#include "moreau/lanes_solve.h"
#include "sample.h"

/* -1.5, -1, ... 1.5; 0 more often. */
static tf_real_t small(void) {
  const int n = (int)(tap_bits() % 9);
  return n > 6 ? 0 : (tf_real_t)(n - 3) / 2;
}

static form_t small_form(void) {
  form_t f = {.c0 = small(), .cx = small(), .cy = small()};
  if (tap_bits() % 2) {
    f.cxx = small() / 64;
    f.cxy = small() / 64;
    f.cyy = small() / 64;
  }
  return f;
}

/* A machine whose g is r z, and whose pinning force is read off p and z. */
static const tf_machine_t upright = {.sin_gamma = 1,
                                     .minus_sin_gamma = -1,
                                     .inv_mu = 1,
                                     .inv_kappa_mu = 1,
                                     .tyre = {.mu = 1}};

static void put(tf_state_block_t *block, work_t *work, const inclusion_t *in,
                int i) {
  put_form(&work->h, &in->h, i);
  put_form(&work->g, &in->g, i);
  block->r[i] = in->g_now;
  work->z[i] = 1;
  work->free_z[i] = -1 - in->pin_y;
  work->p[i] = 0;
  work->free_p[i] = -in->pin_x;
  work->p_b[i] = work->z_t[i] = 1;
}

static unsigned counted[TF_MODES + 1], rare;

static void compare(const work_t *work, const inclusion_t *in, int i) {
  solutions_t want = {0};
  memset(&want, 0, sizeof want);
  if (work->rare[i]) { /* tf_step does it */
    rare++;
    return;
  }
  enumerate(in, signs_of(&in->g), &want);
  CHECK(work->set[i] == want.set);
  CHECK(work->attracting[i] == want.attracting);
  CHECK((work->nearer_minus[i] ? TF_STICK_MINUS : TF_STICK_PLUS) ==
        want.near_stick);
  for (unsigned s = 0; s < 2; s++) {
    CHECK(work->h_limit[s][i] == want.h_limit[s]);
    if (want.set & TF_MODE_BIT(TF_STICK_PLUS + s))
      CHECK(work->root[s][i] == want.x[s]);
  }
  unsigned size = 0;
  for (unsigned mode = 0; mode < TF_MODES; mode++) size += want.set >> mode & 1;
  counted[size]++;
}

static form_t scaled(form_t f, tf_real_t scale) {
  return (form_t){f.c0 * scale,  f.cx * scale,  f.cy * scale,
                  f.cxx * scale, f.cxy * scale, f.cyy * scale};
}

static void compare_blocks(unsigned long blocks, tf_real_t scale) {
  static tf_state_block_t block;
  static work_t work;
  inclusion_t in[TF_LANES];
  for (unsigned long n = 0; n < blocks; n++) {
    memset(&block, 0, sizeof block);
    memset(&work, 0, sizeof work);
    for (int i = 0; i < TF_LANES; i++) {
      in[i] = (inclusion_t){.h = scaled(small_form(), scale),
                            .g = scaled(small_form(), scale),
                            .g_now = small(),
                            .has_moment = true,
                            .pin_x = small(),
                            .pin_y = small()};
      put(&block, &work, &in[i], i);
    }
    pin_all(&upright, &work);
    g_along_all(&work);
    h_along_all(&upright, &block, &work);
    roots_all(&work);
    sticks_all(&work);
    slips_all(&work);
    for (int i = 0; i < TF_LANES; i++) compare(&work, &in[i], i);
  }
}

TEST(lanes_find_the_sets_of_the_enumeration) {
  const unsigned long blocks = (unsigned long)samples(100000);
  compare_blocks(blocks, 1);
  printf("# %u rare; sets of 0 to 5 modes: %u %u %u %u %u %u\n", rare,
         counted[0], counted[1], counted[2], counted[3], counted[4],
         counted[5]);
  CHECK(rare < blocks * TF_LANES / 2);
  for (int size = 0; size <= TF_MODES; size++)
    CHECK(counted[size] > (unsigned)samples(100));
}

/* Sums of such numbers are infinite; with a halving or two they are not. */
TEST(lanes_find_them_next_to_the_largest_number) {
  const unsigned before = counted[1];
  for (int n = 2; n < 10; n++)
    compare_blocks(2000, TF_REAL_MAX / (tf_real_t)(1 << n));
  CHECK(counted[1] > before);
}

/* The root by its series alone has the bits of the whole function, or is left
 * to that: from q = 2^-12 on. */
TEST(lane_root_is_the_root_within) {
  const tf_real_t edge = TF_R(0x1p-10), c0 = TF_R(-0.25);
  for (int sign = -1; sign <= 1; sign += 2) {
    const tf_real_t c2 = (tf_real_t)sign * edge;
    CHECK(lane_root(c0, 1, c2).rare);
    const tf_real_t less = c2 * (1 - TF_REAL_EPSILON);
    CHECK(!lane_root(c0, 1, less).rare);
    CHECK(lane_root(c0, 1, less).x == root_within(c0, 1, less));
    /* A slope that is not a normal number has the root 0 there. */
    const tf_real_t least = (tf_real_t)sign * TF_REAL_MIN;
    CHECK(!lane_root(least / 4, least, 0).rare);
    CHECK(lane_root(least / 8, least / 2, 0).rare);
  }
}

/* The slip of a form under a force of the step. */
static real slip_by(const lane_form_t *form, const tf_machine_t *k,
                    tf_force_t force, int i) {
  const form_t f = form_of(form, i);
  const real x = wide(force.F * k->inv_mu), y = wide(force.M * k->inv_kappa_mu);
  return wide(f.c0) + x * wide(f.cx) + y * wide(f.cy) + x * x * wide(f.cxx) +
         x * y * wide(f.cxy) + y * y * wide(f.cyy);
}

/* A lane is left to tf_step where that refuses it; where it sticks, the forms
 * of the lane vanish under its force. */
TEST(lanes_have_the_forms_of_the_step) {
  static tf_state_block_t block;
  static work_t work;
  int sticks = 0, rests = 0, refused = 0;
  for (int n = 0; n < samples(2000); n++) {
    tf_params_t params = random_params();
    params.theta = uniform(0, 1) < TF_R(0.5) ? TF_R(0.5) : 1;
    const tf_machine_t k = prepared(&params);
    const tf_input_t u = tf_input_default(&k);
    for (int i = 0; i < TF_LANES; i++) {
      block.r[i] = uniform(-0.5, 0.5);
      block.w[i] = n % 4 ? uniform(-2, 2) : u.omega0;
      CHECK(tf_speed_for_slip(&k, block.r[i], block.w[i], u.omega0, 0,
                              &block.v[i]) == TF_OK);
      if (i == n % TF_LANES && n % 3 == 0)
        block.w[i] =
            n % 2 ? TF_R(2.0) * (tf_real_t)TF_STATE_LIMIT : (tf_real_t)NAN;
    }
    linearise_all(&k, &block, &u, &work);
    forms_all(&k, &work);
    for (int i = 0; i < TF_LANES; i++) {
      tf_state_t x = {.r = block.r[i], .v = block.v[i], .w = block.w[i]};
      tf_report_t report;
      const tf_status_t status = tf_step(&k, &x, &u, &report);
      CHECK((work.rare[i] != 0) == (status < TF_OK));
      refused += status < TF_OK;
      if (status != TF_OK || x.mode <= TF_SLIP_MINUS) continue;
      const real tolerance = 1e3L * EPSILON;
      CHECK(fabsl(slip_by(&work.h, &k, report.force, i)) < tolerance);
      sticks++;
      if (x.mode != TF_PINNED) continue;
      CHECK(fabsl(slip_by(&work.g, &k, report.force, i)) < tolerance);
      rests++;
    }
  }
  printf("# %d sticks, %d of them pinned, %d refused\n", sticks, rests,
         refused);
  CHECK(sticks > samples(1000) && rests > samples(100));
  CHECK(refused > samples(100));
}

/* The slip law of a lane is that of a single step, on the borders between its
 * anchors and at equal components too. */
TEST(lanes_have_the_law_of_the_step) {
  tf_params_t params = tf_scenes[0]->params;
  unsigned long done = 0;
  for (int n = 0; n < 100000; n++) {
    params.kappa = uniform(0.01, 2);
    const tf_machine_t k = prepared(&params);
    const tf_real_t side = n % 2 ? TF_R(1.0) : TF_R(-1.0);
    const tf_real_t share = n % 3   ? border[tap_bits() % 4]
                            : n % 2 ? 1
                                    : uniform(0, 1);
    tf_slip_t slip = {side, share};
    if (tap_bits() % 2) slip = (tf_slip_t){side * share, 1};
    if (tap_bits() % 2) slip.g = -slip.g;
    if (tap_bits() % 8 == 0) slip.h = -slip.h; /* behind the jump */
    const lane_multipliers_t lane = lane_multipliers(&k.tyre, side, slip);
    const multipliers_t step = jump_multipliers(&k.tyre, side, slip.h, slip.g);
    if (lane.rare) continue;
    CHECK(lane.x == step.x && lane.y == step.y);
    done++;
  }
  CHECK(done > 90000);
}
