// What the core makes of random machines, as one hash for each of its parts:
//   outputs SEED MACHINES
// For changes that are said to make no difference (tools/verify/mutation/excused.py).
#include <stdio.h>
#include <stdlib.h>

#include "golden/population.h"
#include "num/polynomial.h"
#include "twofold.h"
#include "twofold/frame.h"
#include "twofold/telemetry.h"

static uint64_t seed;
static unsigned machines;

static void show(const char *name, uint64_t hash) {
  printf("%s %016llx\n", name, (unsigned long long)hash);
}

// Runs of each kind of step from one start, under one load.
static void steps(const char *name, one_step_t step) {
  draw_t d = population(seed);
  for (unsigned n = 0; n < machines; n++) {
    tf_machine_t k;
    tf_report_t report;
    if (any_machine(&d, n, &k) != TF_OK) continue;
    tf_input_t u = any_input(&d, &k);
    tf_state_t x = any_state(&d, &k, &u);
    mix_small(&d, (unsigned)tf_begin(&k, &x, &u, &report));
    for (int i = 0; i < 12; i++) {
      u.omega0 += u.alpha * k.dt;
      const tf_status_t done = step(&k, &x, &u, &report);
      mix_small(&d, (unsigned)done);
      if (done < 0) break;
      mix_step(&d, &x, &report);
    }
  }
  show(name, d.hash);
}

static void compensated(void) {
  draw_t d = population(seed + 1);
  for (unsigned n = 0; n < machines; n++) {
    const tf_params_t p = any_params(&d, n);
    tf_compensated_t k;
    if (tf_prepare_compensated(&k, &p, NULL) != TF_OK) continue;
    const tf_input_t u = any_input(&d, &k.machine);
    tf_state_t x = any_state(&d, &k.machine, &u);
    tf_compensation_t low = {0, 0, 0, 0};
    tf_report_t report;
    if (tf_begin(&k.machine, &x, &u, &report) != TF_OK) continue;
    for (int i = 0; i < 8; i++) {
      const tf_status_t done = tf_step_compensated(&k, &x, &low, &u, &report);
      mix_small(&d, (unsigned)done);
      if (done < 0) break;
      mix_step(&d, &x, &report);
      mix_real(&d, low.r);
      mix_real(&d, low.v);
      mix_real(&d, low.w);
    }
  }
  show("compensated", d.hash);
}

// As many states as fill some blocks and a part of one.
#define STATES (2 * TF_LANES + 3)

static void ensembles(void) {
  draw_t d = population(seed + 2);
  for (unsigned n = 0; n < machines / 4; n++) {
    static tf_state_block_t blocks[TF_BLOCKS(STATES)];
    static tf_report_block_t reports[TF_BLOCKS(STATES)];
    tf_machine_t k;
    if (any_machine(&d, n, &k) != TF_OK) continue;
    const tf_input_t u = any_input(&d, &k);
    for (size_t i = 0; i < STATES; i++) {
      tf_state_t x = any_state(&d, &k, &u);
      x.mode = (uint8_t)(x.mode % TF_MODES);
      tf_ensemble_put(blocks, i, &x);
    }
    for (int i = 0; i < 4; i++)
      tf_ensemble_step(&k, blocks, STATES, &u, reports);
    for (size_t i = 0; i < STATES; i++) {
      const tf_state_t x = tf_ensemble_get(blocks, i);
      const tf_report_t report = tf_ensemble_report(reports, i);
      mix_small(&d, (unsigned)report.status);
      if (report.status >= 0) mix_step(&d, &x, &report);
    }
  }
  show("ensemble", d.hash);
}

static void mix_reals(draw_t *d, const tf_real_t *x, int count) {
  for (int i = 0; i < count; i++) mix_real(d, x[i]);
}

static void analysis(void) {
  draw_t d = population(seed + 3);
  for (unsigned n = 0; n < machines; n++) {
    tf_machine_t k;
    if (any_machine(&d, n, &k) != TF_OK) continue;
    const tf_input_t u = any_input(&d, &k);
    const tf_state_t x = any_state(&d, &k, &u);
    tf_surface_t at;
    if (tf_surface_at(&k, &u, x.r, x.v, x.w, &at) == TF_OK)
      mix_reals(&d,
                (tf_real_t[]){at.lie_plus, at.lie_minus, at.delassus, at.lambda,
                              (tf_real_t)at.region},
                5);
    tf_surface_point_t places[TF_TWO_FOLDS];
    int count = 0;
    tf_absence_t absence = TF_ABSENCE_NONE;
    mix_small(&d, (unsigned)tf_two_folds(&k, &u, places, &count, &absence));
    mix_small(&d, (unsigned)absence);
    for (int i = 0; i < count; i++) {
      tf_two_fold_t fold;
      if (tf_normal_form(&k, &u, &places[i], &fold) != TF_OK) continue;
      mix_reals(&d,
                (tf_real_t[]){fold.point.r, fold.point.w, fold.Kpp, fold.Kpm,
                              fold.Kmp, fold.Kmm, (tf_real_t)fold.type},
                7);
    }
    tf_design_t design;
    if (tf_design_two_fold(&k, &u, x.r, x.w, &design) == TF_OK)
      mix_reals(&d, (tf_real_t[]){design.kappa, design.k2}, 2);
  }
  show("analysis", d.hash);
}

static void roots(void) {
  draw_t d = population(seed + 4);
  for (unsigned n = 0; n < 4 * machines; n++) {
    series_t s;
    tf_real_t root = -1;
    for (int i = 0; i <= SERIES_ORDER; i++)
      s.c[i] = one_of(&d, 3) ? 0 : of_any_sign(&d, up_to(&d, 1, 30));
    s.c[0] = one_of(&d, 4) ? 0 : up_to(&d, 1, 60);
    if (n % 2) { // (t - a) (t - b): as near to 0 and to each other as may be
      const tf_real_t a = up_to(&d, 1, 60), b = a * between(&d, 1, 4);
      s = (series_t){.c = {a * b, -(a + b), 1}};
    }
    mix_small(&d, tf_first_root(&s, SERIES_ORDER, up_to(&d, 2, 10), &root));
    mix_real(&d, root);
  }
  show("roots", d.hash);
}

// Frames that go down and come back, some of them broken.
static void frames(void) {
  draw_t d = population(seed + 5);
  static uint8_t buffer[TF_DECODER_SIZE(TF_FRAME_PAYLOAD)];
  tf_decoder_t decoder;
  tf_decoder_init(&decoder, buffer, sizeof buffer);
  uint16_t sequence = 0;
  for (unsigned n = 0; n < machines; n++) {
    static uint8_t wire[TF_FRAME_SIZE(TF_FRAME_PAYLOAD)];
    const size_t length = below(&d, TF_FRAME_PAYLOAD + 1);
    for (size_t i = 0; i < length; i++)
      wire[TF_FRAME_AT + i] = (uint8_t)(one_of(&d, 3) ? 0 : drawn(&d));
    const uint64_t tick = (uint64_t)drawn(&d) << 32 | drawn(&d);
    const size_t size =
        tf_frame_seal(wire, (uint8_t)below(&d, 256), length, &sequence, tick);
    mix(&d, wire, (unsigned)size);
    if (one_of(&d, 4)) wire[below(&d, (unsigned)size)] = (uint8_t)drawn(&d);
    tf_frame_t frame;
    for (size_t at = 0, taken; at < size; at += taken) {
      const bool whole =
          tf_decoder_block(&decoder, wire + at, size - at, &taken, &frame);
      mix_small(&d, whole);
      if (!whole) continue;
      mix(&d, frame.payload, frame.length);
      mix(&d, &frame.tick, sizeof frame.tick);
    }
  }
  show("frames", d.hash);
}

int main(int argc, char **argv) {
  if (argc != 3) return 2;
  seed = strtoull(argv[1], NULL, 0);
  machines = (unsigned)strtoul(argv[2], NULL, 0);
  steps("step", tf_step);
  steps("located", tf_step_located);
  compensated();
  ensembles();
  analysis();
  roots();
  frames();
  return 0;
}
