// Genes to machines and states. A gene's low three bits say how a number is
// made, its high bits which: so a change of one bit may be a small step or a
// leap, and every scene, border and special value is near. A search varies the
// genes, and the worst that it finds can be called again.
#ifndef COST_SUBJECT_H
#define COST_SUBJECT_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "twofold.h"

// Genes from OWN_GENES on are the functions' own.
#define OWN_GENES 44
#define GENES 54
// Parameters that have a gene: all but the budget of segments, the last.
#define DRAWN_PARAMETERS (TF_PARAMETERS - 1)

typedef struct {
  uint32_t gene[GENES];
  tf_params_t params;
  tf_compensated_t machine;
  tf_state_t state;
  tf_input_t input;
  unsigned units; // bytes, states or segments that it gets
  bool valid;     // false: tf_prepare or tf_begin refused
} subject_t;

#ifdef TF_REAL_FLOAT
#define LARGEST 128
#define SMALLEST (-149)
#else
#define LARGEST 1024
#define SMALLEST (-1074)
#endif
#define PI TF_R(3.14159265358979323846)

// [0, 1) from the high bits.
static double share_of(uint32_t gene) { return (double)(gene >> 8) * 0x1p-24; }

// 2^x, straight between whole x: exact, and the same with every libm.
static double power_of_2(double x) {
  const double whole = floor(x);
  return ldexp(1 + (x - whole), (int)whole);
}

// One with a magnitude between two powers of two, or 0.
static tf_real_t sized_of(uint32_t gene, int low, int high) {
  if ((gene & 7u) == 0) return 0;
  const double size = power_of_2(low + (high - low) * share_of(gene));
  return (tf_real_t)(gene & 8u ? -size : size);
}

// A real of any size and sign, 0, subnormals and simple numbers among them.
static tf_real_t real_of(uint32_t gene) {
  switch (gene & 7u) {
    case 0:
      return 0;
    case 1:
      return (tf_real_t)((int)(gene >> 4 & 15u) - 8);
    case 2:
      return sized_of(gene | 1u, SMALLEST, SMALLEST / 2);
    case 3:
      return sized_of(gene | 1u, -64, 0);
    case 4:
      return sized_of(gene | 1u, 0, 30);
    case 5:
      return sized_of(gene | 1u, 0, LARGEST);
    default:
      return sized_of(gene | 1u, -12, 4);
  }
}

static tf_real_t angle_of(uint32_t gene, tf_real_t usual) {
  switch (gene & 3u) {
    case 0:
      return usual;
    case 1:
      return PI * (tf_real_t)((int)(gene >> 4 & 15u) - 8) / 8;
    case 2:
      return PI * (tf_real_t)(2 * share_of(gene) - 1);
    default: // near a multiple of pi/2
      return (PI / 2) * (tf_real_t)((int)(gene >> 4 & 1u)) +
             sized_of(gene | 1u, -40, -1);
  }
}

static tf_real_t parameter_of(uint32_t gene, const tf_parameter_range_t *range,
                              tf_real_t usual) {
  const double low = (double)range->low, high = (double)range->high;
  double value = (double)usual;
  switch (gene & 7u) {
    case 0:
    case 1:
    case 2:
      break;
    case 3:
      value = gene & 8u ? low : high;
      break;
    case 4: { // anywhere, by its order of magnitude
      const double least = low > 0 ? low : 1e-12;
      int size;
      (void)frexp(high / least, &size);
      value = least * power_of_2(size * share_of(gene));
      if (low < 0 && gene & 8u) value = -value;
      break;
    }
    case 5:
      value = gene & 8u ? 0 : 1;
      break;
    default: // about as usual
      value = (value == 0 ? 1 : value) * power_of_2(8 * share_of(gene) - 4);
      if (low < 0 && gene & 8u) value = -value;
      break;
  }
  if (!(value >= low)) value = low;
  if (value > high) value = high;
  const tf_real_t real = (tf_real_t)value;
  return real < range->low    ? range->low
         : real > range->high ? range->high
                              : real;
}

static tf_params_t params_of(const uint32_t *gene, const tf_scene_t *scene) {
  const uint32_t what = gene[21];
  tf_params_t params = scene->params;
  for (int i = 0; i < DRAWN_PARAMETERS; i++) {
    const tf_parameter_range_t *range = &tf_parameter_ranges[i];
    char *member = (char *)&params + range->offset;
    tf_real_t value;
    memcpy(&value, member, sizeof value);
    value = strcmp(range->name, "gamma") == 0
                ? angle_of(gene[i], value)
                : parameter_of(gene[i], range, value);
    memcpy(member, &value, sizeof value);
  }
  if (what & 1u) params.law = (tf_tyre_law_t)((what >> 4) % TF_TYRE_LAWS);
  if (what & 2u) params.rule = (tf_rule_t)((what >> 8) % TF_RULES);
  params.rest = (tf_rest_law_t)((what >> 12) % TF_REST_LAWS);
  params.with_angle = (what & 4u) != 0;
  return params;
}

// On h = 0, beside it, at h = g = 0, beside that, at a two-fold, or anywhere.
static void place(subject_t *s) {
  const uint32_t *gene = s->gene;
  const tf_machine_t *k = &s->machine.machine;
  tf_state_t *x = &s->state;
  switch (gene[27] & 7u) {
    case 0:
      return;
    case 1:
    case 2:
    case 3: {
      const tf_real_t h = gene[27] & 2u ? sized_of(gene[28], -60, 4) : 0;
      (void)tf_speed_for_slip(k, x->r, x->w, s->input.omega0, h, &x->v);
      return;
    }
    case 4:
      x->w = s->input.omega0 + sized_of(gene[28], -60, -4);
      x->v = sized_of(gene[29], -60, -4);
      return;
    case 5: {
      x->r = sized_of(gene[28], -60, -4);
      x->v = k->d * (x->w - s->input.omega0) + sized_of(gene[29], -60, -4);
      return;
    }
    default: {
      tf_surface_point_t places[TF_TWO_FOLDS];
      int count = 0;
      if (tf_two_folds(k, &s->input, places, &count, NULL) != TF_OK ||
          count == 0)
        return;
      const tf_surface_point_t *at = &places[(gene[27] >> 4) % (unsigned)count];
      x->r = at->r + sized_of(gene[28], -40, -4);
      x->w = at->w + sized_of(gene[29], -40, -4);
      x->v = at->v;
      (void)tf_speed_for_slip(k, x->r, x->w, s->input.omega0,
                              sized_of(gene[30], -60, -10), &x->v);
    }
  }
}

static tf_real_t input_of(uint32_t gene) {
  return gene & 16u ? sized_of(gene, -20, 20) : 0;
}

// Makes what the genes of a subject spell.
static void make_subject(subject_t *s) {
  const uint32_t *gene = s->gene;
  const tf_scene_t *scene = tf_scenes[gene[22] % TF_SCENES];
  s->params = params_of(gene, scene);
  s->valid = tf_prepare_compensated(&s->machine, &s->params, NULL) == TF_OK;
  if (!s->valid) return;
  const tf_machine_t *k = &s->machine.machine;
  s->input = tf_input_default(k);
  s->input.omega0 += input_of(gene[35]);
  s->input.r0 += input_of(gene[36]);
  s->input.force = input_of(gene[37]);
  s->input.torque = input_of(gene[38]);
  s->input.alpha = input_of(gene[39]);
  s->state.r = gene[24] & 16u ? real_of(gene[24]) : scene->r;
  s->state.v = gene[25] & 16u ? real_of(gene[25]) : scene->v;
  s->state.w = gene[26] & 16u ? real_of(gene[26]) : scene->omega;
  s->state.seed = gene[32];
  s->state.tick = gene[33];
  place(s);
  s->state.mode = (uint8_t)(gene[34] % (TF_MODES + 1));
  tf_report_t report;
  if (gene[34] & 64u || s->state.mode == TF_NO_MODE)
    s->valid = tf_begin(k, &s->state, &s->input, &report) == TF_OK;
  // A place that the motion comes to by itself.
  for (unsigned n = gene[40] & 16u ? gene[40] % 16u : 0; s->valid && n > 0; n--)
    if (gene[40] & 32u)
      (void)tf_step_located(k, &s->state, &s->input, &report);
    else
      (void)tf_step(k, &s->state, &s->input, &report);
}

#endif
