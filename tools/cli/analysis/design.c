// The command `design`: kappa and k2 that put a two-fold at a given point, or
// why there are none.

#include "../setup/names.h"
#include "../text/buffer.h"
#include "../text/message.h"
#include "analysis.h"
#include "commands.h"
#include "two_fold.h"

#define ROOM 8192 // bytes; one two-fold takes about 1500
#define UNITS "\"kappa\": \"m\", \"k2\": \"N/m\", " CLI_TWO_FOLD_UNITS

static int out_of_range(const cli_analysis_t *a, const char *name,
                        tf_real_t value) {
  const tf_parameter_range_t *range =
      &tf_parameter_ranges[cli_parameter_index(name)];
  return cli_message(CLI_REFUSED,
                     "--r %s --omega %s: %s would be %g, it must lie in [%g, "
                     "%g] %s",
                     a->r.text, a->omega.text, name, (double)value,
                     (double)range->low, (double)range->high, range->unit);
}

static int refuse(const cli_analysis_t *a, const tf_design_t *design) {
  switch ((tf_design_obstacle_t)design->obstacle) {
    case TF_DESIGN_LAW:
      return cli_analysis_refuse_mu(a);
    case TF_DESIGN_GAMMA:
      return cli_analysis_refuse_gamma(a);
    case TF_DESIGN_R:
      return cli_message(CLI_REFUSED,
                         "--r %s: r must not be 0, nor so large or small that "
                         "the normal form overflows",
                         a->r.text);
    case TF_DESIGN_OMEGA:
      return cli_message(CLI_REFUSED,
                         "--omega %s: omega must differ from omega0 = %g "
                         "rad/s, where h = 0 has g = 0",
                         a->omega.text, (double)a->setup.input.omega0);
    case TF_DESIGN_SPRING:
      return cli_message(CLI_REFUSED,
                         "--r %s: k2 does not act on h at r = r0 = %g m, nor "
                         "where d r cos(gamma) + (beta^2 + r^2) sin(gamma) is "
                         "0",
                         a->r.text, (double)a->setup.input.r0);
    case TF_DESIGN_KAPPA:
      return out_of_range(a, "kappa", design->kappa);
    case TF_DESIGN_K2:
      return out_of_range(a, "k2", design->k2);
    case TF_DESIGN_FOUND:
      break;
  }
  return CLI_DONE;
}

static void describe(const cli_analysis_t *a, const tf_design_t *design,
                     cli_buffer_t *text) {
  cli_analysis_begin_json(a, UNITS, text);
  cli_add(text, "  \"kappa\": ");
  cli_add_real(text, design->kappa);
  cli_add(text, ",\n  \"k2\": ");
  cli_add_real(text, design->k2);
  cli_add(text, ",\n  \"set\": \"--set kappa=");
  cli_add_real(text, design->kappa);
  cli_add(text, " --set k2=");
  cli_add_real(text, design->k2);
  cli_add(text, "\",\n  \"two_fold\":\n");
  cli_add_two_fold(text, &design->two_fold, "    ");
  cli_add(text, "\n}\n");
}

int cli_design(int argc, char *const argv[]) {
  cli_analysis_t a;
  tf_design_t design;
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
                         a.omega.from, &design) != TF_OK) {
    return refuse(&a, &design);
  }
  describe(&a, &design, &text);
  return text.truncated ? cli_message(CLI_STOPPED, "design: out of room")
                        : cli_analysis_write(&a, room, text.used);
}
