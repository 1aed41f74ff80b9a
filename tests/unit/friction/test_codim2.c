/* Slips that leave h = g = 0, against a search through all angles with the
 * paper's law and field. */
#include "event/segment.h"
#include "friction/codim2.h"
#include "sample.h"

#define STICKS (TF_MODE_BIT(TF_STICK_PLUS) | TF_MODE_BIT(TF_STICK_MINUS))

/* The machine at rest on the turntable, under its loads: its accelerations of h
 * and g without friction, by F = 1 N and by M = 1 N m. */
typedef struct {
  paper_t paper;
  real h[3], g[3];
} rest_t;

static rest_t rest_at(const tf_params_t *params, const tf_input_t *u,
                      tf_real_t r) {
  rest_t at = {.paper = paper_of(params)};
  /* The paper has no loads: one by the spring, the other by its damper. */
  at.paper.r0 += wide(u->force) / at.paper.k2;
  at.paper.c1 -= wide(u->torque) / at.paper.omega0;
  const real x[3] = {wide(r), 0, at.paper.omega0};
  real h_x[3], g_x[3];
  paper_h_x(&at.paper, x, h_x);
  paper_g_x(&at.paper, x, g_x);
  for (int by = 0; by < 3; by++) {
    real dx[3];
    paper_rhs_time(&at.paper, x, by == 1, by == 2, dx);
    for (int i = 0; i < 3; i++) {
      at.h[by] += h_x[i] * dx[i];
      at.g[by] += g_x[i] * dx[i];
    }
    if (by == 0) continue;
    at.h[by] -= at.h[0];
    at.g[by] -= at.g[0];
  }
  return at;
}

/* Slip of 1 m/s at an angle from the h axis of one side: how fast it turns to
 * larger angles, and grows. */
typedef struct {
  real turns, grows;
} rate_t;

static rate_t rate_at(const rest_t *at, int side, real angle) {
  const real h = (real)side * cosl(angle), g = sinl(angle);
  real F, M;
  paper_friction(&at->paper, h, g, &F, &M);
  const real dh = at->h[0] + F * at->h[1] + M * at->h[2];
  const real dg = at->g[0] + F * at->g[1] + M * at->g[2];
  return (rate_t){(real)side * (dg * h - dh * g), dh * h + dg * g};
}

static real bisected(const rest_t *at, int side, real low, real high) {
  const bool up = rate_at(at, side, low).turns > 0;
  for (int i = 0; i < 80; i++) {
    const real middle = (low + high) / 2;
    if ((rate_at(at, side, middle).turns > 0) == up)
      low = middle;
    else
      high = middle;
  }
  return (low + high) / 2;
}

/* A way out on one side: whether its neighbours turn to it, and how fast slip
 * along it grows; 0: there is none. */
typedef struct {
  real grows;
  bool attracts;
} exit_t;

/* Of those that their neighbours turn to, or else of all, the fastest; on a
 * grid of angles, which two near to each other escape. */
static exit_t search(const rest_t *at, int side) {
  enum { ANGLES = 100 };
  const real quarter = PAPER_PI / 2, edge = 1e-7L;
  exit_t best = {0, false};
  for (int roll = -1; roll <= 1; roll += 2) {
    real low = 0, turns = 0;
    for (int i = 0; i <= ANGLES; i++) {
      const real share = fminl(fmaxl((real)i / ANGLES, edge), 1 - edge);
      const real angle = (real)roll * quarter * share, before = turns;
      turns = rate_at(at, side, angle).turns;
      if (i > 0 && (before > 0) != (turns > 0)) {
        const real way = bisected(at, side, low, angle);
        const exit_t next = {rate_at(at, side, way).grows,
                             (before > 0) == (roll > 0)};
        if (next.grows > 0 &&
            (next.attracts == best.attracts ? next.grows > best.grows
                                            : next.attracts || best.grows == 0))
          best = next;
      }
      low = angle;
    }
  }
  return best;
}

/* The angle along which slip leaves, from its T = cot(psi). */
static real angle_of(const rest_t *at, real T, int roll) {
  return (real)roll * (PAPER_PI / 2) * atanl(T) / atanl(6 * at->paper.kappa);
}

/* Some of the machines as in the other tests, most of extreme shapes, where two
 * directions of one kind are more often close to each other. */
static tf_params_t any_params(int n) {
  tf_params_t params = random_params();
  params.omega0 = uniform(-2, 2);
  if (n % 4 == 0) return params;
  params.kappa = uniform(0.5, 20);
  params.beta = uniform(0.001, 0.5);
  params.d = uniform(-5, 5);
  return params;
}

TEST(slip_leaves_rest_as_a_search_finds) {
  int found[2] = {0}, none = 0, escaped = 0;
  for (int n = 0; n < 4000; n++) {
    const tf_params_t params = any_params(n);
    const tf_machine_t k = prepared(&params);
    tf_input_t u = tf_input_default(&k);
    if (n % 3 == 0) {
      u.force = uniform(-3, 3);
      u.torque = uniform(-3, 3);
    }
    const tf_real_t r = uniform(-0.6, 0.6);
    const rest_t at = rest_at(&params, &u, r);
    const tf_rates_t rates = rates_at(&k, &u, r, 0, 0, u.omega0);
    const real size =
        1 + fabsl(wide(rates.p)) + fabsl(wide(rates.q)) +
        wide(params.mu) * (fabsl(wide(rates.Fp)) + fabsl(wide(rates.Fq)) +
                           fabsl(wide(params.kappa * rates.Mq)));
    tf_consistent_t out;
    tf_codim2_modes(&k, &rates, &out);
    for (int slip = 0; slip < 2; slip++) {
      const int side = slip == 0 ? 1 : -1, roll = out.sign_g[slip];
      const exit_t want = search(&at, side);
      if (!(out.solutions.set & TF_MODE_BIT(TF_SLIP_PLUS + slip))) {
        none++;
        CHECK(want.grows < 1e-3L * size); /* or nearly so */
        continue;
      }
      const real angle = angle_of(&at, wide(out.T[slip]), roll);
      const rate_t is = rate_at(&at, side, angle);
      const real edge = fminl(fabsl(angle), PAPER_PI / 2 - fabsl(angle)) / 2;
      const real near = (real)roll * fminl(edge, 1e-4L);
      const real tolerance = 1e4L * EPSILON * size;
      const bool attracts =
          (real)roll * (rate_at(&at, side, angle + near).turns -
                        rate_at(&at, side, angle - near).turns) <
          0;
      CHECK_NEAR(is.turns, 0, tolerance);
      CHECK_NEAR((real)side * wide(out.solutions.h_limit[slip]), is.grows,
                 tolerance);
      CHECK(attracts || !want.attracts);
      CHECK(is.grows > want.grows - tolerance || attracts > want.attracts);
      found[slip]++;
      escaped += want.grows == 0;
    }
  }
  printf(
      "# ways out: %d with h > 0, %d with h < 0; %d times none; %d of them too "
      "narrow for the search\n",
      found[0], found[1], none, escaped);
  CHECK(found[0] > 500 && found[1] > 500 && none > 500);
}

/* Next to a limit direction the angle d off it changes with d' = c d / R, and R
 * with R' = v: d goes with t^(c/v). */
TEST(exponent_of_a_limit_direction) {
  int seen = 0;
  for (int n = 0; n < 2000; n++) {
    const tf_params_t params = any_params(n);
    const tf_machine_t k = prepared(&params);
    const tf_input_t u = tf_input_default(&k);
    const tf_real_t r = uniform(-0.6, 0.6);
    const rest_t at = rest_at(&params, &u, r);
    const tf_rates_t rates = rates_at(&k, &u, r, 0, 0, u.omega0);
    tf_segment_t segment = {.contact = TF_CONTACT_CODIM2_SLIP,
                            .sign_h = n & 1 ? 1 : -1,
                            .sign_g = n & 2 ? 1 : -1,
                            .h_zero_order = 1,
                            .g_starts_at_zero = true};
    if (!tf_codim2_attractor(&k, &rates, segment.sign_g, segment.sign_h,
                             &segment.T))
      continue;
    static tf_taylor_t motion;
    begin_taylor(&motion, &k, &u, u.omega0, (tf_phase_point_t){r, 0, 0});
    CHECK(tf_taylor_coefficients(&motion, &segment));
    const real angle = angle_of(&at, wide(segment.T), segment.sign_g),
               off = 1e-5L;
    const real v = rate_at(&at, segment.sign_h, angle).grows;
    const real c = (rate_at(&at, segment.sign_h, angle + off).turns -
                    rate_at(&at, segment.sign_h, angle - off).turns) /
                   (2 * off);
    if (fabsl(v) < 0.1L || fabsl(angle) < 1e-2L ||
        PAPER_PI / 2 - fabsl(angle) < 1e-2L)
      continue;
    CHECK_NEAR(wide(motion.exponent), c / v,
               (1e-3L + 1e4L * EPSILON) * (1 + fabsl(c / v)));
    seen++;
  }
  CHECK(seen > 200);
}

/* A torque at which two directions meet and the way out ends: up to it, as near
 * as numbers go, it is found, and is one. */
TEST(way_out_ends_where_two_directions_meet) {
  tf_params_t params = tf_scenes[0]->params;
  params.mu = TF_R(1.4275264971601307);
  params.kappa = TF_R(1.63676920002369);
  params.beta = TF_R(0.24305677444984738);
  params.d = TF_R(-1.2904105885501247);
  params.gamma = TF_R(2.5423606082106533);
  params.k2 = TF_R(3.6521055557989159);
  params.r0 = TF_R(0.4050161972248435);
  params.omega0 = TF_R(-0.15350910904364845);
  params.m = TF_R(3.4708997806674069);
  params.c1 = TF_R(0.051323058735277698);
  params.c2 = TF_R(0.015880019630477717);
  const tf_machine_t k = prepared(&params);
  const tf_real_t r = TF_R(-0.55555597584075833);
  tf_real_t with = 0, without = 50;
  int ways = 0;
  for (int n = 0; n < 60; n++) {
    tf_input_t u = tf_input_default(&k);
    u.torque = n == 0 ? with : n == 1 ? without : with + (without - with) / 2;
    const rest_t at = rest_at(&params, &u, r);
    const tf_rates_t rates = rates_at(&k, &u, r, 0, 0, u.omega0);
    tf_consistent_t out;
    tf_codim2_modes(&k, &rates, &out);
    const bool is = out.solutions.set & TF_MODE_BIT(TF_SLIP_PLUS);
    if (n < 2) CHECK(is == (n == 0));
    if (is)
      with = u.torque;
    else
      without = u.torque;
    if (!is) continue;
    const real angle = angle_of(&at, wide(out.T[0]), out.sign_g[0]);
    CHECK_NEAR(rate_at(&at, 1, angle).turns, 0, 1e6L * EPSILON);
    ways++;
  }
  printf("# ends at %.9Lg N m, seen %d times\n", wide(with), ways);
  CHECK(ways > 20);
  CHECK_NEAR(wide(with), 0.04724L, 1e-4L);
}

/* Where the wheel may roll off either way the side of g that it came from
 * decides, by however little. */
TEST(of_two_sticks_the_near_one_is_taken) {
  int taken[2] = {0};
  for (int n = 0; n < 20000; n++) {
    tf_params_t params = any_params(n);
    params.dt = TF_R(1e-6);
    const tf_machine_t k = prepared(&params);
    const tf_input_t u = tf_input_default(&k);
    const tf_real_t r = uniform(-0.6, 0.6);
    const tf_rates_t rates = rates_at(&k, &u, r, 0, 0, u.omega0);
    tf_consistent_t out;
    tf_report_t report;
    tf_codim2_modes(&k, &rates, &out);
    if ((out.solutions.set & out.solutions.attracting & STICKS) != STICKS)
      continue;
    tf_state_t x = {
        .r = r, .v = TF_REAL_EPSILON * uniform(-1e-4, 1e-4), .w = u.omega0};
    if (n % 8 == 0) x.v = 0; /* as from g > 0 */
    const tf_slip_t slip = tf_slip(&k, x.r, x.v, x.w, u.omega0);
    x.mode = slip.h > 0 ? TF_SLIP_MINUS : TF_SLIP_PLUS; /* not believed */
    if (tf_step_located(&k, &x, &u, &report) != TF_OK || x.mode == TF_PINNED)
      continue;
    CHECK(x.mode == (slip.g < 0 ? TF_STICK_MINUS : TF_STICK_PLUS));
    taken[x.mode == TF_STICK_MINUS]++;
  }
  printf("# stick+ %d times, stick- %d times\n", taken[0], taken[1]);
  CHECK(taken[0] > 20 && taken[1] > 20);
}

/* Slip of a machine at rest at r along a limit direction, so far from h = g = 0
 * that it gets there in half of a step. */
static tf_state_t on_its_way(const tf_machine_t *k, const rest_t *at,
                             tf_real_t r, int side, real angle) {
  const real size = -rate_at(at, side, angle).grows * wide(k->dt) / 2;
  const real h = (real)side * size * cosl(angle), g = size * sinl(angle);
  const real sine = wide(k->sin_gamma), cosine = wide(k->cos_gamma);
  const real p = -h * sine - g * cosine;
  const real z = (-h * cosine + g * sine) / wide(r);
  return (tf_state_t){.r = r,
                      .v = (tf_real_t)(p + wide(k->d) * z),
                      .w = (tf_real_t)(wide(k->omega0) + z),
                      .mode = side > 0 ? TF_SLIP_PLUS : TF_SLIP_MINUS};
}

/* Machines whose slip falls into h = g = 0 where both sticks may follow are one
 * in a hundred thousand. These were found by a search: where it drew them from,
 * and as which. */
static const struct {
  uint64_t state;
  int number;
} falling[] = {{0x1FE57EE383B36A5Fu, 425723},  {0xC2C46BB8AAAD81D3u, 480175},
               {0xD6094B6137C44102u, 920444},  {0x127AF1DBA0FB2337u, 1009248},
               {0x90CCD0534BC0CB27u, 1120001}, {0x49ADF234423353A7u, 1240183},
               {0x94962056FB6932C3u, 1324836}, {0xFB2358F26EBD33D8u, 1340666},
               {0x74EAFA833BA81F7Cu, 1412796}, {0xBF7DA5D5D1FA19E3u, 1575484},
               {0xF1851A8B7464E6AEu, 1639772}, {0x5B99376778692633u, 1772206},
               {0xD64B0F408713C91Du, 1900579}};

TEST(a_fall_ends_on_the_stick_of_its_side) {
  int taken[2] = {0};
  for (size_t n = 0; n < sizeof falling / sizeof *falling; n++) {
    tap.state = falling[n].state;
    tf_params_t params = any_params(falling[n].number);
    params.dt = TF_R(1e-2);
    const tf_machine_t k = prepared(&params);
    const tf_input_t u = tf_input_default(&k);
    const tf_real_t r = uniform(-0.6, 0.6);
    const tf_rates_t rates = rates_at(&k, &u, r, 0, 0, u.omega0);
    const rest_t at = rest_at(&params, &u, r);
    for (int way = 0; way < 4; way++) {
      const int side = way & 1 ? -1 : 1, roll = way & 2 ? -1 : 1;
      tf_real_t T;
      if (!tf_codim2_attractor(&k, &rates, roll, side, &T)) continue;
      const real angle = angle_of(&at, wide(T), roll);
      if (!(rate_at(&at, side, angle).grows < 0)) continue;
      tf_state_t x = on_its_way(&k, &at, r, side, angle);
      tf_report_t report;
      CHECK(tf_step_located(&k, &x, &u, &report) == TF_OK);
      if ((report.set & STICKS) != STICKS) continue;
      CHECK(x.mode == (roll < 0 ? TF_STICK_MINUS : TF_STICK_PLUS));
      taken[x.mode == TF_STICK_MINUS]++;
    }
  }
  printf("# stick+ %d times, stick- %d times\n", taken[0], taken[1]);
  CHECK(taken[0] > 3 && taken[1] > 3);
}

/* A pinned wheel has no side of g: where it is let go, within a step or at its
 * begin, and may roll either way, it rolls as from g = 0. */
TEST(a_wheel_let_go_has_no_side) {
  int taken = 0;
  for (int n = 0; n < 200000; n++) {
    tf_params_t params = any_params(n);
    params.dt = TF_R(1e-2);
    const tf_machine_t k = prepared(&params);
    tf_input_t u = tf_input_default(&k);
    tf_state_t x = {.r = uniform(-0.6, 0.6), .w = u.omega0, .mode = TF_PINNED};
    tf_consistent_t out;
    tf_report_t report;
    const tf_rates_t rates = rates_at(&k, &u, x.r, 0, 0, u.omega0);
    tf_codim2_modes(&k, &rates, &out);
    u.alpha = uniform(-100, 100);
    u.omega0 += u.alpha * k.dt;
    if (!(out.solutions.set & TF_MODE_BIT(TF_PINNED)) ||
        (out.solutions.attracting & STICKS) != STICKS ||
        tf_step_located(&k, &x, &u, &report) != TF_OK ||
        (report.set & STICKS) != STICKS || !(TF_MODE_BIT(x.mode) & STICKS))
      continue;
    CHECK(x.mode == TF_STICK_PLUS);
    taken++;
  }
  printf("# stick+ %d times\n", taken);
  CHECK(taken > 20);
}

/* A wheel across its slot (gamma = pi/2) rests where the law holds force and
 * moment that it takes; along it (gamma = 0) none holds the slider. */
TEST(wheel_rests_where_the_law_allows) {
  int rests = 0, moves = 0;
  for (int n = 0; n < 4000; n++) {
    tf_params_t params = random_params();
    params.gamma = n % 4 ? TF_R(1.5707963267948966) : 0;
    params.d = 0;
    tf_machine_t k = prepared(&params);
    if (n % 4) { /* to the last bit */
      k.sin_gamma = 1;
      k.minus_sin_gamma = -1;
      k.cos_gamma = 0;
    }
    const tf_input_t u = tf_input_default(&k);
    const tf_real_t r = n % 16 == 1 ? 0 : uniform(-0.6, 0.6);
    const tf_rates_t rates = rates_at(&k, &u, r, 0, 0, u.omega0);
    tf_consistent_t out;
    tf_codim2_modes(&k, &rates, &out);
    if (r == 0) /* nothing starts to roll on the axis */
      CHECK(!(out.solutions.set &
              (TF_MODE_BIT(TF_STICK_PLUS) | TF_MODE_BIT(TF_STICK_MINUS))));
    const real w = wide(u.omega0);
    const real F =
        -(wide(k.k2) * (wide(k.r0) - wide(r)) + wide(k.m) * wide(r) * w * w);
    const real M = wide(k.c1) * w, mu = wide(params.mu);
    if (fabsl(fabsl(F) - mu) < 1e-4L ||
        fabsl(fabsl(M) - wide(params.kappa) * fabsl(F)) < 1e-4L)
      continue;
    const bool holds =
        n % 4 && fabsl(F) < mu && fabsl(M) < wide(params.kappa) * fabsl(F);
    CHECK(holds == !!(out.solutions.set & TF_MODE_BIT(TF_PINNED)));
    if (holds)
      rests++;
    else
      moves++;
  }
  printf("# %d rest, %d move\n", rests, moves);
  CHECK(rests > 300 && moves > 1000);
}

int main(int argc, char **argv) {
  tap_begin(argc, argv);
  RUN(slip_leaves_rest_as_a_search_finds);
  RUN(exponent_of_a_limit_direction);
  RUN(way_out_ends_where_two_directions_meet);
  RUN(of_two_sticks_the_near_one_is_taken);
  RUN(a_fall_ends_on_the_stick_of_its_side);
  RUN(a_wheel_let_go_has_no_side);
  RUN(wheel_rests_where_the_law_allows);
  return tap_end();
}
