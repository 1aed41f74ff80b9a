// The command `design`: kappa and k2 that put a two-fold at a wished place, or
// what stands in the way.

#include <string.h>

#include "analysis.h"
#include "text.h"

#define ROOM 8192 // one two-fold takes about 1500

static int out_of_range(const cli_analysis_t *a, const char *name,
                        tf_real_t value) {
  double low = 0;
  double high = 0;
  const char *unit = "";
  for (size_t i = 0; i < TF_PARAMETERS; i++) {
    if (strcmp(tf_parameter_ranges[i].name, name) == 0) {
      low = (double)tf_parameter_ranges[i].low;
      high = (double)tf_parameter_ranges[i].high;
      unit = tf_parameter_ranges[i].unit;
    }
  }
  return cli_complain(CLI_REFUSED,
                      "--r %s --omega %s: %s would be %g, it must lie in [%g, "
                      "%g] %s",
                      a->r.text, a->omega.text, name, (double)value, low, high,
                      unit);
}

static int refuse(const cli_analysis_t *a, const tf_design_t *wish) {
  const cli_culprit_t gamma = cli_analysis_culprit(a, "gamma");
  const cli_culprit_t mu = cli_analysis_culprit(a, "mu");
  switch ((tf_design_obstacle_t)wish->obstacle) {
    case TF_DESIGN_LAW:
      return cli_complain(CLI_REFUSED, "%s %s: design needs mu > 0", mu.option,
                          mu.text);
    case TF_DESIGN_GAMMA:
      return cli_complain(
          CLI_REFUSED,
          "%s %s: design needs |sin(gamma)| and |cos(gamma)| in [1e-06, 1], "
          "they are %g and %g",
          gamma.option, gamma.text, (double)a->setup.machine.sin_gamma,
          (double)a->setup.machine.cos_gamma);
    case TF_DESIGN_R:
      return cli_complain(CLI_REFUSED,
                          "--r %s: r must not be 0, nor so large or small that "
                          "the normal form overflows",
                          a->r.text);
    case TF_DESIGN_OMEGA:
      return cli_complain(CLI_REFUSED,
                          "--omega %s: omega must differ from omega0 = %g "
                          "rad/s, where h = 0 has g = 0",
                          a->omega.text, (double)a->setup.input.omega0);
    case TF_DESIGN_SPRING:
      return cli_complain(CLI_REFUSED,
                          "--r %s: k2 has no hold on h at r = r0 = %g m, nor "
                          "where d r cos(gamma) + (beta^2 + r^2) sin(gamma) is "
                          "0",
                          a->r.text, (double)a->setup.input.r0);
    case TF_DESIGN_KAPPA:
      return out_of_range(a, "kappa", wish->kappa);
    case TF_DESIGN_K2:
      return out_of_range(a, "k2", wish->k2);
    case TF_DESIGN_FOUND:
      break;
  }
  return CLI_DONE;
}

static void describe(const cli_analysis_t *a, const tf_design_t *wish,
                     cli_buffer_t *text) {
  cli_add(text, "{\n  \"scene\": \"");
  cli_add(text, a->scene->name);
  cli_add(text, "\",\n  \"kappa\": ");
  cli_add_real(text, wish->kappa);
  cli_add(text, ",\n  \"k2\": ");
  cli_add_real(text, wish->k2);
  cli_add(text, ",\n  \"set\": \"--set kappa=");
  cli_add_real(text, wish->kappa);
  cli_add(text, " --set k2=");
  cli_add_real(text, wish->k2);
  cli_add(text, "\",\n  \"two_fold\":\n");
  cli_add_two_fold(text, &wish->two_fold, "    ");
  cli_add(text, "\n}\n");
}

int cli_design(int argc, char *const argv[]) {
  cli_analysis_t a;
  tf_design_t wish;
  char room[ROOM];
  cli_buffer_t text = {room, 0, sizeof room, false};
  int code = cli_analysis_read(&a, "design", CLI_TAKES_POINT, true, argc, argv);
  if (code == CLI_DONE) {
    code = cli_analysis_needs_jump(&a, true);
  }
  if (code != CLI_DONE) {
    return code;
  }
  if (tf_design_two_fold(&a.setup.machine, &a.setup.input, a.r.from,
                         a.omega.from, &wish) != TF_OK) {
    return refuse(&a, &wish);
  }
  describe(&a, &wish, &text);
  return text.cut ? cli_complain(CLI_STOPPED, "design: out of room")
                  : cli_analysis_write(&a, room, text.used);
}
