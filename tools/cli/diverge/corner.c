// Where the noise decides is a layer: |h| as large as sqrt(|g|). A step that is
// a share of the distance to h = g = 0 never resolves it.

#ifdef TF_REAL_FLOAT
#define IS_FLOAT
#undef TF_REAL_FLOAT
#endif
#include "corner.h"

#include <math.h>

#include "../../../src/model/rates.h"

// Random numbers have no real, and the library that is linked has its own name.
#ifdef IS_FLOAT
void tf_philox_f32(uint64_t counter, uint32_t key, uint32_t out[2]);
#undef tf_philox
#define tf_philox tf_philox_f32
#endif

#define PI 3.141592653589793
#define FAR 0.125     // eps |g| of an averaged stick
#define WIDTH 4.0     // |h| that no stick- has
#define AWAY 10.0     // |b g| / s2 from where on noise does not turn stick-
#define WHOLE 8e6     // far from what decides
#define MOST 10000000 // steps of a walk

static void draw(cli_random_t *random, double out[2]) {
  uint32_t word[2];
  tf_philox(random->number++, random->key, word);
  for (int i = 0; i < 2; i++) out[i] = ((double)word[i] + 0.5) * 0x1p-32;
}

double cli_uniform(cli_random_t *random) {
  double u[2];
  draw(random, u);
  return u[0];
}

double cli_normal(cli_random_t *random) {
  random->has = !random->has;
  if (!random->has) return random->kept;
  double u[2];
  draw(random, u);
  const double size = sqrt(-2 * log(u[0]));
  random->kept = size * sin(2 * PI * u[1]);
  return size * cos(2 * PI * u[1]);
}

static cli_slip_t field(const cli_corner_t *c, double h, double g) {
  const double T = tan(c->share * atan2(fabs(g), fabs(h)));
  const double F = copysign(4.0 / 3 - T / (18 * c->kappa), h);
  const double M = copysign(T / 6, h) * copysign(1, g);
  return (cli_slip_t){.h = c->smooth.h + c->of_F.h * F + c->of_M.h * M,
                      .g = c->smooth.g + c->of_F.g * F + c->of_M.g * M};
}

// S(x) of a drift: the integral of exp(-2 drift y) from 0 to x.
static double exit_scale(double drift, double x) {
  const double a = -2 * drift;
  return fabs(a * x) < 1e-12 ? x : expm1(a * x) / a;
}

// How a diffusion leaves the strip.
typedef struct {
  double up;      // the probability to leave at 2 d
  double time[2]; // mean times with h > 0 and h < 0
} exit_t;

// The mean time in (0, x) of a diffusion that begins at 0, is reflected there,
// and ends at x.
static double time_to(double drift, double x) {
  const double a = 2 * drift, ax = a * x;
  if (fabs(ax) < 1e-4) return x * x * (1 - ax / 3 + ax * ax / 12);
  return 2 * (x + expm1(-ax) / a) / a;
}

// From h in (-2 d, 2 d), by the scale function. The mean time u on one side
// solves u''/2 + drift u' = -1 there, u''/2 + drift u' = 0 on the other one.
static exit_t exit_strip(const double drift[2], double h, double d) {
  const double end[2] = {exit_scale(drift[0], 2 * d),
                         -exit_scale(drift[1], -2 * d)};
  const double at = exit_scale(drift[h < 0], h), all = end[0] + end[1];
  exit_t exit = {.up = (at + end[1]) / all};
  for (int side = 0; side < 2; side++) {
    const double inward = side == 0 ? drift[0] : -drift[1];
    const double x = side == 0 ? h : -h, S = side == 0 ? at : -at;
    const double whole = time_to(inward, 2 * d);
    const double from_0 = whole * end[1 - side] / all;
    exit.time[side] =
        x > 0 ? from_0 + (whole - from_0) * S / end[side] - time_to(inward, x)
              : from_0 * (1 + S / end[1 - side]);
  }
  return exit;
}

cli_corner_t cli_corner_at(const cli_wide_t *given, double r, const double n[2],
                           double eps) {
  const tf_machine_t k = {CLI_WIDE(given),
                          .contact.stick_kappa = given->stick_kappa};
  const tf_input_t input = {.omega0 = k.omega0, .r0 = k.r0};
  const rates_t a = rates_at(&k, &input, r, 0, 0, k.omega0);
  const tf_slip_t smooth = slip_from_pq(&k, a.dp, a.dq);
  const tf_slip_t of_F = slip_from_pq(&k, a.Fp * given->mu, a.Fq * given->mu);
  const tf_slip_t of_M = slip_from_pq(&k, 0, a.Mq * given->mu);
  cli_corner_t c = {.smooth = {smooth.h, smooth.g, 0},
                    .of_F = {of_F.h, of_F.g, 0},
                    .of_M = {of_M.h, of_M.g, 0},
                    .kappa = given->stick_kappa,
                    .share = 2 / PI * atan(6 * given->stick_kappa),
                    .n_g = n[0],
                    .n_2 = n[1],
                    .eps = eps,
                    .far = FAR / eps};
  for (int i = 0; i < 4; i++) {
    const cli_slip_t f =
        field(&c, i % 2 == 0 ? 1e-300 : -1e-300, i < 2 ? 1 : -1);
    c.h[i / 2][i % 2] = f.h;
    c.g[i / 2][i % 2] = f.g;
  }
  const double *h = c.h[1], *g = c.g[1];
  const double s = n[0] - (g[0] - g[1]) / (h[0] - h[1]);
  const double up = h[1] / (h[1] - h[0]); // the share of time with h > 0
  c.b = -(up * g[0] + (1 - up) * g[1]);
  c.s2 = s * s + n[1] * n[1];
  return c;
}

// h/g where the field points to 0 or away from it, by bisection.
cli_slip_t cli_corner_ray(const cli_corner_t *c, double side, double g) {
  double low = 1e-9, high = 10;
  for (int i = 0; i < 100; i++) {
    const double slope = sqrt(low * high);
    const cli_slip_t f = field(c, side * slope, 1);
    *(side * f.h > slope * f.g ? &low : &high) = slope;
  }
  return (cli_slip_t){.h = side * low * g, .g = g};
}

// In a time in which the noise on h is dW.
static double noise_of_g(const cli_corner_t *c, cli_random_t *random, double dt,
                         double dW) {
  return c->n_g * dW +
         (c->n_2 > 0 ? c->n_2 * sqrt(dt) * cli_normal(random) : 0);
}

cli_slip_t cli_corner_step(const cli_corner_t *c, cli_random_t *random,
                           cli_slip_t x) {
  const double eps = c->eps, d = eps * (x.g > 0.25 ? sqrt(x.g) : 0.5);
  if (fabs(x.h) < d) {
    const double *h = c->h[x.g < 0], *g = c->g[x.g < 0];
    const exit_t exit = exit_strip(h, x.h, d);
    const double to = cli_uniform(random) < exit.up ? 2 * d : -2 * d;
    const double dW = to - x.h - h[0] * exit.time[0] - h[1] * exit.time[1];
    const double dg = g[0] * exit.time[0] + g[1] * exit.time[1];
    const double dt = exit.time[0] + exit.time[1];
    return (cli_slip_t){to, x.g + dg + noise_of_g(c, random, dt, dW), x.t + dt};
  }
  const cli_slip_t rate = field(c, x.h, x.g);
  double dt = fmin(1.6 * eps * x.h * x.h, 3 * eps * fabs(x.h / rate.h));
  dt = fmin(dt, 2 * eps * hypot(x.h, x.g));
  const double dW = sqrt(dt) * cli_normal(random);
  return (cli_slip_t){x.h + rate.h * dt + dW,
                      x.g + rate.g * dt + noise_of_g(c, random, dt, dW),
                      x.t + dt};
}

bool cli_corner_sticks(const cli_corner_t *c, cli_slip_t x) {
  return x.g < -c->far && fabs(x.h) < WIDTH;
}

bool cli_corner_attracts(const cli_corner_t *c) {
  return c->h[1][0] < 0 && c->h[1][1] > 0;
}

double cli_corner_away(const cli_corner_t *c) {
  return fmin(AWAY * c->s2 / fabs(c->b), CLI_CORNER_REACH / 2);
}

bool cli_corner_walk(const cli_corner_t *c, cli_random_t *random, double reach,
                     cli_slip_t *x) {
  const bool attracts = cli_corner_attracts(c);
  const bool slips = c->h[0][1] < 0 && c->g[0][1] > 0; // slip- leaves
  const double away = cli_corner_away(c);
  for (int i = 0; i < MOST; i++) {
    if (hypot(x->h, x->g) > reach) return true;
    if (attracts && cli_corner_sticks(c, *x) && (c->b > 0 || slips)) {
      const double t = x->t + (c->b > 0 ? away / c->b : 0);
      *x = c->b > 0 ? (cli_slip_t){.h = 0, .g = -away}
                    : cli_corner_ray(c, -1, reach);
      x->t = t;
      return true;
    }
    *x = cli_corner_step(c, random, *x);
  }
  return false;
}

bool cli_corner_selects(const cli_corner_t *c, cli_random_t *random) {
  cli_slip_t x = cli_corner_ray(c, 1, WHOLE / 2);
  return !(c->b > 0) || !cli_corner_walk(c, random, WHOLE, &x) || x.g > 0;
}
