// The header of constants for a firmware of one scene. tf_prepare and
// tf_scene_start run here instead of on the board, and compute the same bits;
// what they return is written in hexadecimal, so that nothing is rounded on the
// way.
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
  REAL(out, k, contact.stick_kappa);
  REAL(out, k, contact.kappa_mu);
  REAL(out, k, contact.inv_mu);
  REAL(out, k, contact.inv_kappa_mu);
  REAL(out, k, inv_mu_dt);
  REAL(out, k, tolerance);
  REAL(out, k, contact.tyre.mu);
  REAL(out, k, contact.tyre.kappa);
  REAL(out, k, contact.tyre.inv_18_kappa);
  REAL(out, k, contact.tyre.inv_6_kappa);
  REAL(out, k, contact.tyre.epsilon);
  REAL(out, k, contact.tyre.k);
  REAL(out, k, contact.tyre.delta);
  REAL(out, k, contact.tyre.sigma);
  REAL(out, k, contact.tyre.rho);
  REAL(out, k, contact.tyre.a);
  list(out, "contact.tyre.T_anchor", k->contact.tyre.T_anchor, TF_TYRE_ANCHORS);
  list(out, "contact.tyre.T_series", k->contact.tyre.T_series, TF_TYRE_TERMS);
  fprintf(out, "    .contact.tyre.law = (tf_tyre_law_t)%d,\n",
          (int)k->contact.tyre.law);
  fprintf(out, "    .segments = %d,\n", k->segments);
  fprintf(out, "    .contact.exit_threshold = %llull,\n",
          (unsigned long long)k->contact.exit_threshold);
  fprintf(out, "    .contact.rule = (tf_rule_t)%d,\n", (int)k->contact.rule);
  fprintf(out, "    .contact.rest = (tf_rest_law_t)%d,\n    .with_angle = %d",
          (int)k->contact.rest, k->with_angle);
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
  REAL(out, report, force.F);
  REAL(out, report, force.M);
  REAL(out, report, slip.h);
  REAL(out, report, slip.g);
  REAL(out, report, delassus);
  REAL(out, report, residual);
  fprintf(out, "    .mode = %d,\n    .set = %d,\n    .choices = %d};\n\n",
          report->mode, report->set, report->choices);
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
    fprintf(out, "    .params.%s = %a" SUFFIX ",\n", range->name,
            (double)value);
  }
  fprintf(out, "    .params.law = (tf_tyre_law_t)%d,\n", (int)p->law);
  fprintf(out, "    .params.rule = (tf_rule_t)%d,\n", (int)p->rule);
  fprintf(out, "    .params.rest = (tf_rest_law_t)%d,\n", (int)p->rest);
  fprintf(out, "    .params.with_angle = %d,\n", p->with_angle);
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
