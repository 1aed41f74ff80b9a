// The command `atlas`: the conditions of the paper's figure 4 over a grid of
// wished two-folds, panel by panel, and their overlap.

#include <math.h>

#include "analysis.h"
#include "text.h"

static const char header[] =
    "r,omega,v,g,kappa,k2,K++,K+-,K-+,K--,J1,J2,K--_positive,K++_negative,"
    "J1_negative,J2_negative,J1J2_above_1,kappa_positive,k2_positive,overlap\n";

#define VALUES 10
#define CONDITIONS 7

static int write_row(const cli_analysis_t *a, tf_real_t r, tf_real_t omega,
                     char out[CLI_GRID_ROOM], size_t *length) {
  cli_buffer_t text = {out, 0, CLI_GRID_ROOM, false};
  tf_design_t wish;
  (void)tf_design_two_fold(&a->setup.machine, &a->setup.input, r, omega, &wish);
  const bool open = wish.obstacle == TF_DESIGN_FOUND ||
                    wish.obstacle == TF_DESIGN_KAPPA ||
                    wish.obstacle == TF_DESIGN_K2;
  const tf_two_fold_t *at = &wish.two_fold;
  const tf_real_t c2 = at->time_scale * at->time_scale;
  const tf_real_t values[VALUES] = {
      at->point.v,  at->point.g,  wish.kappa,   wish.k2, c2 * at->Kpp,
      c2 * at->Kpm, c2 * at->Kmp, c2 * at->Kmm, at->J1,  at->J2};
  const bool holds[CONDITIONS] = {
      at->Kmm > 0,
      at->Kpp<0, at->J1<0, at->J2<0, at->J1 * at->J2> 1, wish.kappa> 0,
              wish.k2> 0};
  bool all = open;
  cli_add_real(&text, r);
  cli_add(&text, ",");
  cli_add_real(&text, omega);
  for (int i = 0; i < VALUES; i++) {
    cli_add(&text, ",");
    if (open && isfinite(values[i])) {
      cli_add_real(&text, values[i]);
    }
  }
  for (int i = 0; i < CONDITIONS; i++) {
    cli_add(&text, !open ? "," : holds[i] ? ",1" : ",0");
    all = all && holds[i];
  }
  cli_add(&text, all ? ",1\n" : ",0\n");
  *length = text.used;
  return CLI_DONE;
}

// What is in the way of every wish is told once, before a row.
static int check(const cli_analysis_t *a) {
  const tf_machine_t *k = &a->setup.machine;
  const cli_culprit_t gamma = cli_analysis_culprit(a, "gamma");
  const cli_culprit_t mu = cli_analysis_culprit(a, "mu");
  if (!(k->tyre.mu > 0)) {
    return cli_complain(CLI_REFUSED, "%s %s: atlas needs mu > 0", mu.option,
                        mu.text);
  }
  if (fabs((double)k->sin_gamma) < 1e-6 || fabs((double)k->cos_gamma) < 1e-6) {
    return cli_complain(
        CLI_REFUSED,
        "%s %s: atlas needs |sin(gamma)| and |cos(gamma)| in [1e-06, 1], they "
        "are %g and %g",
        gamma.option, gamma.text, (double)k->sin_gamma, (double)k->cos_gamma);
  }
  return CLI_DONE;
}

int cli_atlas(int argc, char *const argv[]) {
  cli_analysis_t a;
  int code = cli_analysis_read(&a, "atlas", CLI_TAKES_GRID, true, argc, argv);
  if (code == CLI_DONE) {
    code = cli_analysis_needs_jump(&a, true);
  }
  if (code == CLI_DONE) {
    code = check(&a);
  }
  return code == CLI_DONE ? cli_analysis_grid(&a, header, write_row) : code;
}
