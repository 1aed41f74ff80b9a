// The command `regions`: the regions of the surface h = 0 over a grid of
// (r, omega).

#include <math.h>

#include "../text/buffer.h"
#include "../text/message.h"
#include "commands.h"
#include "grid.h"

static int write_row(const cli_analysis_t *a, tf_real_t r, tf_real_t omega,
                     char out[CLI_GRID_ROOM], size_t *length) {
  const cli_setup_t *setup = &a->setup;
  cli_buffer_t text = {out, 0, CLI_GRID_ROOM, false};
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
  cli_add_real(&text, r);
  cli_add(&text, ",");
  cli_add_real(&text, omega);
  cli_add(&text, ",");
  cli_add(&text, tf_region_name(at.region));
  cli_add(&text, ",");
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

int cli_regions(int argc, char *const argv[]) {
  cli_analysis_t a;
  int code =
      cli_analysis_read(&a, "regions", CLI_TAKES_GRID, false, argc, argv);
  if (code == CLI_DONE) {
    code = cli_analysis_needs_jump(&a, false);
  }
  if (code == CLI_DONE) {
    code = check_gamma(&a);
  }
  if (code == CLI_DONE) {
    code = cli_analysis_grid(&a, "r,omega,region,lambda,delassus\n",
                             "r m, omega rad/s, lambda N, delassus 1/kg",
                             write_row);
  }
  return code;
}
