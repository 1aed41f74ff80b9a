// The header of constants for a firmware of one scene. tf_prepare and
// tf_scene_start run here instead of on the board, and compute the same bits;
// what they return is written in hexadecimal, so that nothing is rounded on the
// way. Members are in the order of their structs, as C++ wants them.
#include "constants.h"

#include <stdlib.h>
#include <string.h>

#ifdef TF_REAL_FLOAT
#define SUFFIX "f"
#else
#define SUFFIX ""
#endif

#define REAL(out, of, member) \
  fprintf(out, "    .%s = %a" SUFFIX ",\n", #member, (double)(of)->member)

static void list(FILE *out, const char *name, const tf_real_t *value,
                 int count) {
  fprintf(out, "    .%s = {", name);
  for (int i = 0; i < count; i++)
    fprintf(out, "%s%a" SUFFIX, i ? ", " : "", (double)value[i]);
  fprintf(out, "},\n");
}

void constants_of_machine(FILE *out, const tf_machine_t *k) {
  const tf_contact_t *contact = &k->contact;
  const tf_tyre_t *tyre = &contact->tyre;
  REAL(out, k, m);
  REAL(out, k, d);
  REAL(out, k, k2);
  REAL(out, k, c1);
  REAL(out, k, c2);
  REAL(out, k, r0);
  REAL(out, k, omega0);
  REAL(out, k, sin_gamma);
  REAL(out, k, cos_gamma);
  REAL(out, k, minus_sin_gamma);
  REAL(out, k, d_sin_gamma);
  REAL(out, k, beta2);
  REAL(out, k, dt);
  REAL(out, k, theta);
  REAL(out, k, theta_dt);
  REAL(out, k, explicit_dt);
  REAL(out, k, a);
  REAL(out, k, d_a);
  REAL(out, k, m_plus_a);
  REAL(out, k, m_a_d2);
  REAL(out, k, inertia);
  REAL(out, k, mu_sin_gamma);
  REAL(out, k, mu_d_sin_gamma);
  REAL(out, k, inv_mu_dt);
  REAL(out, k, tolerance);
  fprintf(out, "    .segments = %d,\n    .with_angle = %d,\n", k->segments,
          k->with_angle);
  fprintf(out, "    .contact = {.tyre = {.law = (tf_tyre_law_t)%d,\n",
          (int)tyre->law);
  REAL(out, tyre, mu);
  REAL(out, tyre, kappa);
  REAL(out, tyre, inv_18_kappa);
  REAL(out, tyre, inv_6_kappa);
  list(out, "T_anchor", tyre->T_anchor, TF_TYRE_ANCHORS);
  list(out, "T_series", tyre->T_series, TF_TYRE_TERMS);
  REAL(out, tyre, epsilon);
  REAL(out, tyre, stiffness);
  REAL(out, tyre, delta);
  REAL(out, tyre, sigma);
  REAL(out, tyre, rho);
  fprintf(out, "    .a = %a" SUFFIX "},\n", (double)tyre->a);
  REAL(out, contact, stick_kappa);
  REAL(out, contact, kappa_mu);
  REAL(out, contact, inv_mu);
  REAL(out, contact, inv_kappa_mu);
  // C++98 has no constants of 64 bits.
  fprintf(out, "    .exit_threshold = ((uint64_t)%luu << 32 | %luu),\n",
          (unsigned long)(contact->exit_threshold >> 32),
          (unsigned long)(contact->exit_threshold & 0xFFFFFFFFu));
  fprintf(out, "    .rule = (tf_rule_t)%d,\n    .rest = (tf_rest_law_t)%d}",
          (int)contact->rule, (int)contact->rest);
}

static void write_start(FILE *out, const tf_state_t *x,
                        const tf_report_t *report) {
  fprintf(out, "static const tf_state_t scene_start = {\n");
  REAL(out, x, r);
  REAL(out, x, v);
  REAL(out, x, w);
  REAL(out, x, phi);
  fprintf(out, "    .seed = %lu,\n    .mode = %d};\n\n", (unsigned long)x->seed,
          x->mode);
  fprintf(out, "static const tf_report_t scene_start_report = {\n");
  fprintf(out, "    .mode = %d,\n    .set = %d,\n    .choices = %d,\n",
          report->mode, report->set, report->choices);
  fprintf(out, "    .force = {.F = %a" SUFFIX ", .M = %a" SUFFIX "},\n",
          (double)report->force.F, (double)report->force.M);
  fprintf(out, "    .slip = {.h = %a" SUFFIX ", .g = %a" SUFFIX "},\n",
          (double)report->slip.h, (double)report->slip.g);
  REAL(out, report, delassus);
  fprintf(out, "    .residual = %a" SUFFIX "};\n\n", (double)report->residual);
}

void constants_of_scene(FILE *out, const tf_scene_t *scene,
                        const tf_params_t *p) {
  fprintf(out,
          "static const tf_scene_t scene_constants = {\n    .name = \"%s\",\n",
          scene->name);
  for (int i = 0; i < TF_PARAMETERS; i++) {
    const tf_parameter_range_t *range = &tf_parameter_ranges[i];
    tf_real_t value;
    memcpy(&value, (const char *)p + range->offset, sizeof value);
    fprintf(out, "    %s.%s = %a" SUFFIX ",\n", i > 0 ? "" : ".params = {",
            range->name, (double)value);
  }
  fprintf(out, "    .law = (tf_tyre_law_t)%d,\n", (int)p->law);
  fprintf(out, "    .rule = (tf_rule_t)%d,\n", (int)p->rule);
  fprintf(out, "    .rest = (tf_rest_law_t)%d,\n", (int)p->rest);
  fprintf(out, "    .with_angle = %d},\n", p->with_angle);
  REAL(out, scene, r);
  REAL(out, scene, omega);
  REAL(out, scene, h);
  REAL(out, scene, v);
  fprintf(out, "    .v_is_given = %d,\n", scene->v_is_given);
  fprintf(out, "    .knots = %d,\n    .profile = {", scene->knots);
  for (int i = 0; i < TF_SCENE_KNOTS; i++)
    fprintf(out, "{%a" SUFFIX ", %a" SUFFIX "}%s", (double)scene->profile[i].t,
            (double)scene->profile[i].omega0,
            i + 1 < TF_SCENE_KNOTS ? ", " : "}};\n");
}

int constants_of_firmware(FILE *out, const tf_scene_t *scene,
                          const char *rate) {
  tf_params_t params = scene->params;
  tf_machine_t k;
  tf_state_t x;
  tf_report_t report = {0};
  if (rate != NULL) params.dt = 1 / (tf_real_t)atof(rate);
  if (tf_prepare(&k, &params, NULL) != TF_OK) {
    fprintf(stderr, "constants: rate %s is refused\n", rate);
    return 3;
  }
  if (tf_scene_start(scene, &k, 1, &x, &report) != TF_OK) {
    fprintf(stderr, "constants: scene %s cannot start\n", scene->name);
    return 3;
  }
  fprintf(out, "// Scene %s, made by tools/board/constants/constants.c.\n\n",
          scene->name);
  fprintf(out, "static const tf_machine_t scene_machine = {\n");
  constants_of_machine(out, &k);
  fprintf(out, "};\n\n");
  write_start(out, &x, &report);
  constants_of_scene(out, scene, &params);
  return ferror(out) || fflush(out) ? 4 : 0;
}
