/* population.h - machines, states and loads of all kinds, and a hash of what
 * the core makes of them: the same bits on every target. It needs no library: a
 * program for a board includes it after the core. Numbers are drawn by
 * operations that IEEE 754 defines to the last bit. */
#ifndef TESTS_GOLDEN_POPULATION_H
#define TESTS_GOLDEN_POPULATION_H

/* The draws keep their bits under any options, as the core does. */
#include "../../src/num/rounding.h"
#include "twofold.h"

typedef struct {
  uint64_t state, hash;
} draw_t;

static inline draw_t population(uint64_t seed) {
  return (draw_t){seed, 0xCBF29CE484222325u};
}

/* splitmix64 */
static inline uint32_t drawn(draw_t *d) {
  uint64_t z = (d->state += 0x9E3779B97F4A7C15u);
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return (uint32_t)((z ^ (z >> 31)) >> 32);
}

static inline unsigned below(draw_t *d, unsigned n) { return drawn(d) % n; }
static inline bool one_of(draw_t *d, unsigned n) { return below(d, n) == 0; }

/* In [0, 1), of 24 bits: exact in either real type. */
static inline tf_real_t share(draw_t *d) {
  return (tf_real_t)(drawn(d) >> 8) * TF_R(0x1p-24);
}

static inline tf_real_t between(draw_t *d, tf_real_t low, tf_real_t high) {
  return low + (high - low) * share(d);
}

/* Of this size, or less by up to so many halvings. */
static inline tf_real_t up_to(draw_t *d, tf_real_t size, unsigned halvings) {
  tf_real_t x = size * (1 - share(d) / 2);
  for (unsigned n = below(d, halvings + 1); n > 0; n--) x *= TF_R(0.5);
  return x;
}

static inline tf_real_t of_drawn_sign(draw_t *d, tf_real_t x) {
  return one_of(d, 2) ? -x : x;
}

/* FNV-1a, over a value: the lowest byte first, wherever memory has it. */
static inline void mix(draw_t *d, uint64_t value, unsigned bytes) {
  for (; bytes > 0; bytes--, value >>= 8)
    d->hash = (d->hash ^ (value & 0xFFu)) * 0x100000001B3u;
}

/* -0 counts as 0. */
static inline void mix_real(draw_t *d, tf_real_t x) {
  const union {
    tf_real_t real;
#ifdef TF_REAL_FLOAT
    uint32_t bits;
#else
    uint64_t bits;
#endif
  } number = {x + 0};
  mix(d, number.bits, sizeof number);
}

static inline void mix_small(draw_t *d, unsigned x) { mix(d, x & 0xFFu, 1); }

/* Machines about the size of the paper's. */
static inline tf_params_t usual_params(draw_t *d) {
  tf_params_t p = tf_scenes[0]->params;
  const unsigned law = one_of(d, 3) ? below(d, TF_TYRE_LAWS) : TF_TYRE_JUMP;
  const unsigned rule = below(d, TF_RULES);
  p.law = (tf_tyre_law_t)law;
  p.rule = (tf_rule_t)rule;
  p.with_angle = one_of(d, 2);
  p.m = between(d, TF_R(0.25), 4);
  p.d = one_of(d, 3) ? 0 : between(d, -2, 2);
  p.beta = between(d, TF_R(0.02), TF_R(0.2));
  p.kappa = between(d, TF_R(0.05), 1);
  p.k2 = one_of(d, 8) ? 0 : between(d, 0, 5);
  p.r0 = between(d, TF_R(-0.5), TF_R(0.5));
  p.omega0 = between(d, -2, 2);
  p.mu = one_of(d, 16) ? 0 : between(d, TF_R(0.5), 2);
  p.c1 = between(d, 0, TF_R(0.1));
  p.c2 = between(d, 0, TF_R(0.1));
  p.gamma = between(d, -3, 3);
  if (one_of(d, 8)) /* -pi/2, 0, pi/2 */
    p.gamma = (tf_real_t)((int)below(d, 3) - 1) * TF_R(1.5707963267948966);
  p.epsilon = between(d, TF_R(1e-4), TF_R(1e-2));
  p.k = between(d, 1, 20);
  p.delta = between(d, 1, 10);
  p.sigma = one_of(d, 4) ? 0 : between(d, 0, 1);
  p.rho = between(d, TF_R(0.25), 1);
  p.a = between(d, TF_R(0.1), 1);
  p.theta = one_of(d, 3) ? 1 : between(d, TF_R(0.5), 1);
  p.dt = up_to(d, TF_R(0.125), 14);
  p.rate = between(d, 0, 100);
  p.tolerance = one_of(d, 2) ? 0 : up_to(d, TF_R(1e-3), 24);
  return p;
}

/* All but the budget of segments, which is the last. */
#define DRAWN_PARAMETERS (TF_PARAMETERS - 1)

/* Some members from anywhere in their ranges, ends included. */
static inline void strain(draw_t *d, tf_params_t *p) {
  for (unsigned n = 1 + below(d, 6); n > 0; n--) {
    const tf_parameter_range_t *range =
        &tf_parameter_ranges[below(d, DRAWN_PARAMETERS)];
    tf_real_t x = up_to(d, range->high, 60);
    if (range->low < 0) x = of_drawn_sign(d, x);
    if (one_of(d, 8)) x = one_of(d, 2) ? range->low : range->high;
    if (x < range->low) x = range->low;
    *(tf_real_t *)(void *)((char *)p + range->offset) = x;
  }
}

/* Every third machine is strained. */
static inline tf_params_t any_params(draw_t *d, unsigned n) {
  tf_params_t p = usual_params(d);
  if (n % 3 == 0) strain(d, &p);
  return p;
}

static inline tf_status_t any_machine(draw_t *d, unsigned n, tf_machine_t *k) {
  const tf_params_t p = any_params(d, n);
  *k = (tf_machine_t){.m = 0};
  return tf_prepare(k, &p, 0);
}

static inline tf_input_t any_input(draw_t *d, const tf_machine_t *k) {
  tf_input_t u = {.omega0 = k->omega0, .r0 = k->r0};
  if (one_of(d, 3)) {
    u.force = between(d, -3, 3);
    u.torque = between(d, -3, 3);
  }
  if (one_of(d, 4)) u.alpha = between(d, -2, 2);
  return u;
}

/* Next to h = 0, next to h = g = 0, on them, or anywhere. */
static inline tf_state_t any_state(draw_t *d, const tf_machine_t *k,
                                   const tf_input_t *u) {
  tf_state_t x = {.phi = 0};
  const tf_real_t far = between(d, -1, 1);
  const tf_real_t h = one_of(d, 3) ? 0 : of_drawn_sign(d, up_to(d, 1, 30));
  x.seed = drawn(d);
  x.r = one_of(d, 16) ? 0 : between(d, TF_R(-0.7), TF_R(0.7));
  x.w = u->omega0;
  if (!one_of(d, 8)) x.w += of_drawn_sign(d, up_to(d, 2, 24));
  if (one_of(d, 4) || tf_speed_for_slip(k, x.r, x.w, u->omega0, h, &x.v))
    x.v = one_of(d, 2) ? k->d * (x.w - u->omega0) : far;
  x.mode = (uint8_t)below(d, TF_MODES + 1);
  return x;
}

static inline void mix_step(draw_t *d, const tf_state_t *x,
                            const tf_report_t *report) {
  mix_real(d, x->r);
  mix_real(d, x->v);
  mix_real(d, x->w);
  mix_real(d, x->phi);
  mix_small(d, x->mode);
  mix_small(d, report->mode);
  mix_small(d, report->set);
  mix_small(d, report->choices);
  mix_real(d, report->force.F);
  mix_real(d, report->force.M);
  mix_real(d, report->slip.h);
  mix_real(d, report->slip.g);
  mix_real(d, report->delassus);
  mix_real(d, report->residual);
}

typedef tf_status_t (*one_step_t)(const tf_machine_t *machine,
                                  tf_state_t *state, const tf_input_t *input,
                                  tf_report_t *report);

/* Runs of some steps: every fourth start left in the mode that was drawn, the
 * loads changed under way. */
static inline uint64_t hash_of_steps(one_step_t step, unsigned machines,
                                     unsigned steps) {
  draw_t d = population(1);
  for (unsigned n = 0; n < machines; n++) {
    tf_machine_t k;
    tf_report_t report;
    const tf_status_t status = any_machine(&d, n, &k);
    mix_small(&d, (unsigned)status);
    if (status != TF_OK) continue;
    tf_input_t u = any_input(&d, &k);
    tf_state_t x = any_state(&d, &k, &u);
    if (n % 4 != 0 || x.mode == TF_NO_MODE) {
      const tf_status_t begun = tf_begin(&k, &x, &u, &report);
      mix_small(&d, (unsigned)begun);
      if (begun != TF_OK) continue;
      mix_step(&d, &x, &report);
    }
    for (unsigned i = 0; i < steps; i++) {
      if (i == steps / 2) u.torque += between(&d, -1, 1);
      u.omega0 += u.alpha * k.dt;
      const tf_status_t done = step(&k, &x, &u, &report);
      mix_small(&d, (unsigned)done);
      if (done < 0) break;
      mix_step(&d, &x, &report);
    }
  }
  return d.hash;
}

#endif
