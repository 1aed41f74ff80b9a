// The command `atlas`: the conditions of the paper's figure 4, panel by panel,
// and their overlap, over a grid of points at which a two-fold is to be.

#include <math.h>

#include "../text/buffer.h"
#include "../text/message.h"
#include "commands.h"
#include "grid.h"

static const char header[] =
    "r,omega,v,g,kappa,k2,K++,K+-,K-+,K--,J1,J2,K--_positive,K++_negative,"
    "J1_negative,J2_negative,J1J2_above_1,kappa_positive,k2_positive,overlap\n";

#define VALUES 10
#define CONDITIONS 7

static int write_row(const cli_analysis_t *a, tf_real_t r, tf_real_t omega,
                     char out[CLI_GRID_ROOM], size_t *length) {
  cli_buffer_t text = {out, 0, CLI_GRID_ROOM, false};
  tf_design_t design;
  (void)tf_design_two_fold(&a->setup.machine, &a->setup.input, r, omega,
                           &design);
  const bool exists = design.obstacle == TF_DESIGN_FOUND ||
                      design.obstacle == TF_DESIGN_KAPPA ||
                      design.obstacle == TF_DESIGN_K2;
  const tf_two_fold_t *at = &design.two_fold;
  const tf_real_t c2 = at->time_scale * at->time_scale;
  const tf_real_t values[VALUES] = {
      at->point.v,  at->point.g,  design.kappa, design.k2, c2 * at->Kpp,
      c2 * at->Kpm, c2 * at->Kmp, c2 * at->Kmm, at->J1,    at->J2};
  const bool holds[CONDITIONS] = {
      at->Kmm > 0,         // (b)
      0 > at->Kpp,         // (c)
      0 > at->J1,          // (d)
      0 > at->J2,          // (e)
      at->J1 * at->J2 > 1, // (f)
      design.kappa > 0,    // (g)
      design.k2 > 0,
  };
  bool all = exists;
  cli_add_real(&text, r);
  cli_add(&text, ",");
  cli_add_real(&text, omega);
  for (int i = 0; i < VALUES; i++) {
    cli_add(&text, ",");
    if (exists && isfinite(values[i])) {
      cli_add_real(&text, values[i]);
    }
  }
  for (int i = 0; i < CONDITIONS; i++) {
    cli_add(&text, !exists ? "," : holds[i] ? ",1" : ",0");
    all = all && holds[i];
  }
  cli_add(&text, all ? ",1\n" : ",0\n");
  *length = text.used;
  return CLI_DONE;
}

// What would refuse every point is reported once, before the first row.
static int check(const cli_analysis_t *a) {
  const tf_machine_t *k = &a->setup.machine;
  if (!(k->tyre.mu > 0)) {
    return cli_analysis_refuse_mu(a);
  }
  const bool too_small = fabs((double)k->sin_gamma) < (double)TF_MIN_SINE ||
                         fabs((double)k->cos_gamma) < (double)TF_MIN_SINE;
  return too_small ? cli_analysis_refuse_gamma(a) : CLI_DONE;
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
  return code == CLI_DONE
             ? cli_analysis_grid(&a, header,
                                 "r m, omega rad/s, v m/s, g m/s, kappa m, k2 "
                                 "N/m, K in rescaled time, others 1",
                                 write_row)
             : code;
}
