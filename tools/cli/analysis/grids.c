// The commands that write a grid of (r, omega) as CSV, row by row; rows reach
// the file whole. `regions`: the regions of the surface h = 0. `atlas`: the
// conditions of the paper's figure 4, panel by panel, and their overlap, at
// points at which a two-fold is to be.

#include <math.h>
#include <string.h>

#include "../host/host.h"
#include "../setup/setup.h"
#include "../text/buffer.h"
#include "../text/message.h"
#include "analysis.h"

#define FLUSH_EVERY 0.2 // [s]
// Room for one row.
#define ROW_ROOM 768

// Writes one row with its newline into out. length: out.
// Returns: CLI_DONE, or another code after a message, which ends the grid.
typedef int (*row_t)(const cli_analysis_t *a, tf_real_t r, tf_real_t omega,
                     char out[ROW_ROOM], size_t *length);

// The rows of one r, the one with number i.
static int write_line(cli_analysis_t *a, uint64_t i, row_t row,
                      cli_progress_t *progress) {
  const tf_real_t r = cli_range_at(&a->args->r, i);
  char text[ROW_ROOM];
  for (uint64_t j = 0; j < a->args->omega.count; j++) {
    size_t length = 0;
    if (cli_stop_asked()) {
      return cli_message(CLI_STOPPED, "interrupted at r = %g m", (double)r);
    }
    const int code = row(a, r, cli_range_at(&a->args->omega, j), text, &length);
    if (code != CLI_DONE) {
      return code;
    }
    if (!cli_output_lines(&a->output, text, length)) {
      return CLI_STOPPED; // the message is that of cli_output_end
    }
    const double now = cli_now();
    if (now - a->output.flushed >= FLUSH_EVERY) {
      (void)cli_output_flush(&a->output);
    }
    const double line = (double)a->args->omega.count;
    const double done = (double)i * line + (double)(j + 1);
    const double points = (double)a->args->r.count * line;
    cli_progress_say(progress, now, done / points, "%.0f of %.0f points", done,
                     points);
  }
  return CLI_DONE;
}

// Writes header and rows, omega inner, r outer, and closes the output. units:
// of the columns, for --provenance.
static int write_grid(cli_analysis_t *a, const char *header, const char *units,
                      row_t row) {
  char lines[CLI_PROVENANCE_ROOM];
  int code = cli_output_begin(&a->output, "--out", a->args->out, false);
  if (code != CLI_DONE) {
    return code;
  }
  if (a->args->provenance) {
    const size_t length =
        cli_provenance(&a->setup, "inputs at t = 0, no motion", units, lines);
    (void)cli_output_lines(&a->output, lines, length);
  }
  (void)cli_output_lines(&a->output, header, strlen(header));
  cli_progress_t progress =
      cli_progress_start(cli_now(), a->output.to.descriptor);
  for (uint64_t i = 0; i < a->args->r.count && code == CLI_DONE; i++) {
    code = write_line(a, i, row, &progress);
  }
  cli_progress_clear(&progress);
  return cli_output_end(&a->output, code);
}

static int regions_row(const cli_analysis_t *a, tf_real_t r, tf_real_t omega,
                       char out[ROW_ROOM], size_t *length) {
  const cli_setup_t *setup = &a->setup;
  cli_buffer_t text = {out, 0, ROW_ROOM, false};
  tf_surface_t at;
  tf_real_t v = 0;
  tf_status_t status = tf_speed_for_slip(&setup->machine, r, omega,
                                         setup->input.omega0, TF_R(0.0), &v);
  if (status == TF_OK) {
    status = tf_surface_at(&setup->machine, &setup->input, r, v, omega, &at);
  }
  if (status != TF_OK) {
    return cli_message(
        CLI_STOPPED, "stopped at r = %g m, omega = %g rad/s, v = %g m/s: %s",
        (double)r, (double)omega, (double)v, tf_status_name(status));
  }
  cli_add_form(&text, "%g,%g,%s,", (double)r, (double)omega,
               tf_region_name(at.region));
  if (at.lambda_is_given) {
    cli_add_real(&text, at.lambda);
  }
  cli_add(&text, ",");
  if (at.region != TF_REGION_CODIM2) {
    cli_add_real(&text, at.delassus);
  }
  cli_add(&text, "\n");
  *length = text.used;
  return CLI_DONE;
}

// Where sin(gamma) = 0 the surface is w = omega0 (and r = 0). Then v does not
// follow from h = 0, and (r, omega) does not determine a point of the surface.
static int check_gamma(const cli_analysis_t *a) {
  const cli_origin_t origin = cli_analysis_origin(a, "gamma");
  const double sine = (double)a->setup.machine.sin_gamma;
  if (fabs(sine) >= (double)TF_MIN_SINE) {
    return CLI_DONE;
  }
  return cli_message(CLI_REFUSED,
                     "%s %s: regions needs |sin(gamma)| in [%g, 1], it is "
                     "%g: no speed v follows from h = 0",
                     origin.option, origin.text, (double)TF_MIN_SINE,
                     fabs(sine));
}

int cli_regions(const cli_args_t *args) {
  cli_analysis_t a;
  int code = cli_analysis_begin(&a, args, false);
  code = code == CLI_DONE ? cli_analysis_needs_jump(&a, false) : code;
  code = code == CLI_DONE ? check_gamma(&a) : code;
  return code == CLI_DONE
             ? write_grid(&a, "r,omega,region,lambda,delassus\n",
                          "r m, omega rad/s, lambda N, delassus 1/kg",
                          regions_row)
             : code;
}

static const char atlas_header[] =
    "r,omega,v,g,kappa,k2,K++,K+-,K-+,K--,J1,J2,K--_positive,K++_negative,"
    "J1_negative,J2_negative,J1J2_above_1,kappa_positive,k2_positive,overlap\n";

#define VALUES 10
#define CONDITIONS 7

static int atlas_row(const cli_analysis_t *a, tf_real_t r, tf_real_t omega,
                     char out[ROW_ROOM], size_t *length) {
  cli_buffer_t text = {out, 0, ROW_ROOM, false};
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
  cli_add_form(&text, "%g,%g", (double)r, (double)omega);
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

int cli_atlas(const cli_args_t *args) {
  cli_analysis_t a;
  int code = cli_analysis_begin(&a, args, true);
  code = code == CLI_DONE ? cli_analysis_check_design(&a) : code;
  return code == CLI_DONE
             ? write_grid(&a, atlas_header,
                          "r m, omega rad/s, v m/s, g m/s, kappa m, k2 N/m, K "
                          "in rescaled time, others 1",
                          atlas_row)
             : code;
}
