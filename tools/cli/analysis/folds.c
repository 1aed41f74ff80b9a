// The commands that write two-folds as JSON. `singularities`: all of a machine,
// or why there are none. `design`: kappa and k2 that put one at a given point,
// or why there are none. JSON has no infinities; the core only returns
// two-folds whose numbers are all finite.

#include <inttypes.h>

#include "../setup/names.h"
#include "../text/buffer.h"
#include "../text/message.h"
#include "analysis.h"

// The units of its members, for cli_analysis_begin_json(). K, J1, J2 and the
// eigenvalues are in the paper's time.
#define FOLD_UNITS                                                       \
  "\"r\": \"m\", \"v\": \"m/s\", \"omega\": \"rad/s\", \"g\": \"m/s\", " \
  "\"lambda\": \"N\", \"time_scale\": \"kg m^2\", \"physical\": \"m/s^3\""
#define ROOM 32768 // bytes; eight two-folds take less than half of it
#define DESIGN_UNITS "\"kappa\": \"m\", \"k2\": \"N/m\", " FOLD_UNITS

static void add_K(cli_buffer_t *text, const tf_two_fold_t *at,
                  tf_real_t scale) {
  cli_add_form(text, "\"K++\": %g, \"K+-\": %g, \"K-+\": %g, \"K--\": %g",
               (double)(scale * at->Kpp), (double)(scale * at->Kpm),
               (double)(scale * at->Kmp), (double)(scale * at->Kmm));
}

static void add_direction(cli_buffer_t *text, const tf_direction_t *direction) {
  cli_add_form(text, "      {\"eigenvalue\": %g, \"velocity\": [%g, %g, %g], ",
               (double)direction->value, (double)direction->velocity.r,
               (double)direction->velocity.v, (double)direction->velocity.w);
  if (direction->sticks) {
    cli_add_form(text, "\"lambda\": %g, \"sticks\": true}",
                 (double)direction->lambda);
  } else {
    cli_add(text, "\"lambda\": null, \"sticks\": false}");
  }
}

// Appends one two-fold as an object.
static void add_two_fold(cli_buffer_t *text, const tf_two_fold_t *at) {
  static const char *const cases[] = {"null", "1", "2", "3"};
  const bool through_first = at->through.value > at->across.value;
  const tf_direction_t *first = through_first ? &at->through : &at->across;
  const tf_direction_t *second = through_first ? &at->across : &at->through;
  cli_add_form(text,
               "    {\n"
               "      \"r\": %g, \"v\": %g, \"omega\": %g, \"g\": %g,\n"
               "      ",
               (double)at->point.r, (double)at->point.v, (double)at->point.w,
               (double)at->point.g);
  add_K(text, at, at->time_scale * at->time_scale);
  cli_add_form(text,
               ",\n"
               "      \"J1\": %g, \"J2\": %g,\n"
               "      \"eigenvalues\": [%g, %g],\n"
               "      \"directions\": [\n  ",
               (double)at->J1, (double)at->J2, (double)first->value,
               (double)second->value);
  add_direction(text, first);
  cli_add(text, ",\n  ");
  add_direction(text, second);
  cli_add_form(text,
               "],\n"
               "      \"type\": \"%s\", \"case\": %s,\n"
               "      \"time_scale\": %g, \"residual\": %g,\n"
               "      \"physical\": {",
               tf_folds_name(at->type), cases[at->paper_case],
               (double)at->time_scale, (double)at->residual);
  add_K(text, at, 1);
  cli_add(text, "}\n    }");
}

static int describe_all(const cli_analysis_t *a, cli_buffer_t *text) {
  tf_surface_point_t points[TF_TWO_FOLDS];
  tf_absence_t absence = TF_ABSENCE_NONE;
  int count = 0;
  const cli_setup_t *setup = &a->setup;
  tf_status_t status =
      tf_two_folds(&setup->machine, &setup->input, points, &count, &absence);
  cli_analysis_begin_json(a, FOLD_UNITS, text);
  const bool absent = absence != TF_ABSENCE_NONE;
  const char *quote = absent ? "\"" : "";
  cli_add_form(text,
               "  \"count\": %" PRIu64
               ",\n  \"reason\": %s%s%s,\n  \"two_folds\": [",
               (uint64_t)count, quote,
               absent ? tf_absence_name(absence) : "null", quote);
  for (int i = 0; i < count && status == TF_OK; i++) {
    tf_two_fold_t at;
    status = tf_normal_form(&setup->machine, &setup->input, &points[i], &at);
    if (status == TF_OK) {
      cli_add(text, i > 0 ? ",\n" : "\n");
      add_two_fold(text, &at);
    }
  }
  cli_add(text, count > 0 ? "\n  ]\n}\n" : "]\n}\n");
  return status == TF_OK
             ? CLI_DONE
             : cli_message(CLI_STOPPED, "scene %s: singularities: %s",
                           a->args->scene->name, tf_status_name(status));
}

// Computes and writes. describe: returns CLI_DONE, or another code after a
// message.
static int write_json(const cli_args_t *args, bool finds_kappa,
                      int (*describe)(const cli_analysis_t *a,
                                      cli_buffer_t *text)) {
  cli_analysis_t a;
  char room[ROOM];
  cli_buffer_t text = {room, 0, sizeof room, false};
  int code = cli_analysis_begin(&a, args, finds_kappa);
  code = code == CLI_DONE ? describe(&a, &text) : code;
  if (code == CLI_DONE && text.truncated) {
    code = cli_message(CLI_STOPPED, "%s: out of room", args->command);
  }
  return code == CLI_DONE
             ? cli_output_write(&a.output, "--out", args->out, room, text.used)
             : code;
}

int cli_singularities(const cli_args_t *args) {
  return write_json(args, false, describe_all);
}

static int out_of_range(const cli_analysis_t *a, const char *name,
                        tf_real_t value) {
  const tf_parameter_range_t *range =
      &tf_parameter_ranges[cli_parameter_index(name)];
  return cli_message(CLI_REFUSED,
                     "--r %s --omega %s: %s would be %g, it must lie in [%g, "
                     "%g] %s",
                     a->args->r.text, a->args->omega.text, name, (double)value,
                     (double)range->low, (double)range->high, range->unit);
}

static int refuse(const cli_analysis_t *a, const tf_design_t *design) {
  switch ((tf_design_obstacle_t)design->obstacle) {
    case TF_DESIGN_R:
      return cli_message(CLI_REFUSED,
                         "--r %s: r must not be 0, nor so large or small that "
                         "the normal form overflows",
                         a->args->r.text);
    case TF_DESIGN_OMEGA:
      return cli_message(CLI_REFUSED,
                         "--omega %s: omega must differ from omega0 = %g "
                         "rad/s, where h = 0 has g = 0",
                         a->args->omega.text, (double)a->setup.input.omega0);
    case TF_DESIGN_SPRING:
      return cli_message(CLI_REFUSED,
                         "--r %s: k2 does not act on h at r = r0 = %g m, nor "
                         "where d r cos(gamma) + (beta^2 + r^2) sin(gamma) is "
                         "0",
                         a->args->r.text, (double)a->setup.input.r0);
    case TF_DESIGN_KAPPA:
      return out_of_range(a, "kappa", design->kappa);
    case TF_DESIGN_K2:
      return out_of_range(a, "k2", design->k2);
    case TF_DESIGN_LAW:
    case TF_DESIGN_GAMMA: // were refused before
    case TF_DESIGN_FOUND:
      break;
  }
  return CLI_REFUSED;
}

static int describe_design(const cli_analysis_t *a, cli_buffer_t *text) {
  tf_design_t design;
  const int code = cli_analysis_check_design(a);
  if (code != CLI_DONE) {
    return code;
  }
  if (tf_design_two_fold(&a->setup.machine, &a->setup.input, a->args->r.from,
                         a->args->omega.from, &design) != TF_OK) {
    return refuse(a, &design);
  }
  cli_analysis_begin_json(a, DESIGN_UNITS, text);
  const double kappa = (double)design.kappa, k2 = (double)design.k2;
  cli_add_form(text,
               "  \"kappa\": %g,\n  \"k2\": %g,\n"
               "  \"set\": \"--set kappa=%g --set k2=%g\",\n"
               "  \"two_fold\":\n",
               kappa, k2, kappa, k2);
  add_two_fold(text, &design.two_fold);
  cli_add(text, "\n}\n");
  return CLI_DONE;
}

int cli_design(const cli_args_t *args) {
  return write_json(args, true, describe_design);
}
