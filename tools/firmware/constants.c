// Writes the header of constants for a firmware of one scene:
//   constants SCENE [RATE]     dt is the scene's own, or 1/RATE
//   constants --number SCENE   its number in tf_scenes
// What tf_prepare and tf_begin compute is computed here, by the same code with
// the same bits, and written in hexadecimal: nothing is rounded on the way.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "twofold.h"

#ifdef TF_REAL_FLOAT
#define SUFFIX "f"
#else
#define SUFFIX ""
#endif

#define REAL(of, member) \
  printf("    .%s = %a" SUFFIX ",\n", #member, (double)(of)->member)

static void list(const char *name, const tf_real_t *value, int count) {
  printf("    .%s = {", name);
  for (int i = 0; i < count; i++)
    printf("%s%a" SUFFIX, i ? ", " : "", (double)value[i]);
  printf("},\n");
}

static void write_machine(const tf_machine_t *k) {
  printf("static const tf_machine_t scene_machine = {\n");
  REAL(k, m);
  REAL(k, d);
  REAL(k, k2);
  REAL(k, c1);
  REAL(k, c2);
  REAL(k, r0);
  REAL(k, omega0);
  REAL(k, sin_gamma);
  REAL(k, cos_gamma);
  REAL(k, minus_sin_gamma);
  REAL(k, d_sin_gamma);
  REAL(k, beta2);
  REAL(k, dt);
  REAL(k, theta);
  REAL(k, theta_dt);
  REAL(k, explicit_dt);
  REAL(k, a);
  REAL(k, d_a);
  REAL(k, m_plus_a);
  REAL(k, m_a_d2);
  REAL(k, inertia);
  REAL(k, mu_sin_gamma);
  REAL(k, mu_d_sin_gamma);
  REAL(k, stick_kappa);
  REAL(k, kappa_mu);
  REAL(k, inv_mu);
  REAL(k, inv_kappa_mu);
  REAL(k, inv_mu_dt);
  REAL(k, tolerance);
  REAL(k, tyre.mu);
  REAL(k, tyre.kappa);
  REAL(k, tyre.inv_18_kappa);
  REAL(k, tyre.inv_6_kappa);
  REAL(k, tyre.epsilon);
  REAL(k, tyre.k);
  REAL(k, tyre.delta);
  REAL(k, tyre.sigma);
  REAL(k, tyre.rho);
  REAL(k, tyre.a);
  list("tyre.T_anchor", k->tyre.T_anchor, TF_TYRE_ANCHORS);
  list("tyre.T_series", k->tyre.T_series, TF_TYRE_TERMS);
  printf("    .tyre.law = (tf_tyre_law_t)%d,\n", (int)k->tyre.law);
  printf("    .exit_threshold = %llull,\n",
         (unsigned long long)k->exit_threshold);
  printf("    .rule = (tf_rule_t)%d,\n    .with_angle = %d};\n\n", (int)k->rule,
         k->with_angle);
}

static void write_start(const tf_state_t *x, const tf_report_t *report) {
  printf("static const tf_state_t scene_start = {\n");
  REAL(x, r);
  REAL(x, v);
  REAL(x, w);
  REAL(x, phi);
  printf("    .seed = %lu,\n    .mode = %d};\n\n", (unsigned long)x->seed,
         x->mode);
  printf("static const tf_report_t scene_start_report = {\n");
  REAL(report, force.F);
  REAL(report, force.M);
  REAL(report, slip.h);
  REAL(report, slip.g);
  REAL(report, delassus);
  REAL(report, residual);
  printf("    .mode = %d,\n    .set = %d,\n    .choices = %d};\n\n",
         report->mode, report->set, report->choices);
}

static void write_scene(const tf_scene_t *scene, const tf_params_t *p) {
  printf("static const tf_scene_t scene_constants = {\n    .name = \"%s\",\n",
         scene->name);
  for (int i = 0; i < TF_PARAMETERS; i++) {
    const tf_parameter_range_t *range = &tf_parameter_ranges[i];
    tf_real_t value;
    memcpy(&value, (const char *)p + range->offset, sizeof value);
    printf("    .params.%s = %a" SUFFIX ",\n", range->name, (double)value);
  }
  printf("    .params.law = (tf_tyre_law_t)%d,\n", (int)p->law);
  printf("    .params.rule = (tf_rule_t)%d,\n", (int)p->rule);
  printf("    .params.with_angle = %d,\n", p->with_angle);
  REAL(scene, r);
  REAL(scene, omega);
  REAL(scene, h);
  REAL(scene, v);
  printf("    .v_is_given = %d,\n", scene->v_is_given);
  printf("    .knots = %d,\n    .profile = {", scene->knots);
  for (int i = 0; i < TF_SCENE_KNOTS; i++)
    printf("{%a" SUFFIX ", %a" SUFFIX "}%s", (double)scene->profile[i].t,
           (double)scene->profile[i].omega0,
           i + 1 < TF_SCENE_KNOTS ? ", " : "}};\n");
}

static int write_header(const tf_scene_t *scene, const char *rate) {
  tf_params_t params = scene->params;
  tf_machine_t k;
  tf_report_t report = {0};
  tf_state_t x = {.r = scene->r, .w = scene->omega, .v = scene->v, .seed = 1};
  if (rate != NULL) params.dt = 1 / (tf_real_t)atof(rate);
  if (tf_prepare(&k, &params, NULL) != TF_OK) {
    fprintf(stderr, "constants: rate %s is refused\n", rate);
    return 3;
  }
  const tf_input_t input = tf_scene_input(scene, &k, 0);
  x.mode = (uint8_t)(scene->h > 0 ? TF_SLIP_PLUS : TF_MODES);
  if (!scene->v_is_given)
    (void)tf_speed_for_slip(&k, x.r, x.w, input.omega0, scene->h, &x.v);
  if (tf_begin(&k, &x, &input, &report) != TF_OK) return 3;
  printf("// Scene %s, made by tools/firmware/constants.c.\n\n", scene->name);
  write_machine(&k);
  write_start(&x, &report);
  write_scene(scene, &params);
  return ferror(stdout) || fflush(stdout) ? 4 : 0;
}

int main(int argc, char **argv) {
  const bool number = argc == 3 && !strcmp(argv[1], "--number");
  const char *name = argc > 1 ? argv[number ? 2 : 1] : "";
  for (int i = 0; i < TF_SCENES; i++) {
    if (strcmp(tf_scenes[i]->name, name) != 0) continue;
    if (!number) return write_header(tf_scenes[i], argc > 2 ? argv[2] : NULL);
    printf("%d\n", i);
    return 0;
  }
  fprintf(stderr, "constants: no scene is named '%s'; there are:\n", name);
  for (int i = 0; i < TF_SCENES; i++)
    fprintf(stderr, "  %s\n", tf_scenes[i]->name);
  return 2;
}
