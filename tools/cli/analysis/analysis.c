// The commands that examine a machine without running it: singularities and
// design, which write two-folds, regions, atlas and tyre, which write tables.

#include "../host/host.h"
#include "../host/output.h"
#include "../setup/args.h"
#include "../text/summary.h"

// The command that runs, ready to compute and write.
static struct {
  const cli_args_t *args;
  cli_setup_t setup; // machine and input at t = 0
  cli_range_t r, omega;
  cli_output_t output;
} job;

int cli_analysis_check(cli_args_t *args) {
  const bool has_r = args->r.text != NULL;
  if (has_r && args->omega.text != NULL) return CLI_DONE;
  return cli_usage("design: %s is missing", has_r ? "--omega W" : "--r R");
}

// Prepares the machine. finds_kappa: the command computes kappa, so a scene
// without kappa is not refused.
static int prepare(const cli_args_t *args, bool finds_kappa) {
  // The first two are found, the others are of a run.
  static const char *const unused[] = {
      "kappa", "k2", "dt", "theta", "tolerance", "r", "v", "omega", "h", "phi"};
  job.args = args;
  job.r = args->r;
  job.omega = args->omega;
  CLI_TRY(cli_setup_read(&job.setup, args->scene, &args->settings, NULL));
  if (finds_kappa && !(job.setup.params.kappa > 0) &&
      cli_settings_find(&args->settings, "kappa") == NULL)
    job.setup.params.kappa = 1; // any value in its range
  CLI_TRY(cli_setup_machine(&job.setup));
  cli_setup_notes(&job.setup);
  for (size_t i = finds_kappa ? 0 : 2; i < sizeof unused / sizeof unused[0];
       i++) {
    const cli_setting_t *setting =
        cli_settings_find(&job.args->settings, unused[i]);
    if (setting != NULL) {
      cli_note("%s %s has no effect: %s %s", setting->given.name,
               setting->given.value, job.args->command,
               i < 2 ? "finds it" : "does not run");
    }
  }
  return CLI_DONE;
}

// Where a value came from: "--set NAME=VALUE" or "scene NAME".
static cli_given_t origin_of(const char *name) {
  const cli_setting_t *setting = cli_settings_find(&job.args->settings, name);
  return setting != NULL
             ? (cli_given_t){setting->given.name, setting->given.value}
             : (cli_given_t){"scene", job.args->scene->name};
}

static int needs_jump(bool needs_moment) {
  const tf_tyre_law_t law = job.setup.params.law;
  const cli_given_t origin = origin_of("law");
  if (needs_moment ? law == TF_TYRE_JUMP : tf_tyre_is_set_valued(law))
    return CLI_DONE;
  return cli_blame(CLI_REFUSED, &origin, "%s needs law %s, not %s: %s",
                   job.args->command, needs_moment ? "jump" : "jump or coulomb",
                   tf_tyre_law_name(law),
                   tf_tyre_is_set_valued(law) ? "stick has no moment under it"
                                              : "it does not jump at h = 0");
}

static int check_design(void) {
  const tf_machine_t *k = &job.setup.machine;
  const cli_given_t mu = origin_of("mu");
  const cli_given_t gamma = origin_of("gamma");
  CLI_TRY(needs_jump(true));
  if (!(k->contact.tyre.mu > 0))
    return cli_blame(CLI_REFUSED, &mu, "%s needs mu > 0", job.args->command);
  if (fabs((double)k->sin_gamma) >= (double)TF_MIN_SINE &&
      fabs((double)k->cos_gamma) >= (double)TF_MIN_SINE)
    return CLI_DONE;
  return cli_blame(CLI_REFUSED, &gamma,
                   "%s needs |sin(gamma)| and |cos(gamma)| in [1e-06, 1]; they "
                   "are %g and %g",
                   job.args->command, (double)k->sin_gamma,
                   (double)k->cos_gamma);
}

// The commands that write two-folds as JSON. All numbers of one are finite. K,
// J1, J2 and the eigenvalues are in the paper's time, others in these units.
#define FOLD_UNITS                                                      \
  "'r': 'm', 'v': 'm/s', 'omega': 'rad/s', 'g': 'm/s', 'lambda': 'N', " \
  "'time_scale': 'kg m^2', 'physical': 'm/s^3'},\n"
#define ROOM 32768 // bytes; eight two-folds take less than half of it

static void begin_json(cli_buffer_t *text) {
  cli_add_json(text,
               "{\n  'version': %s, 'commit': %s, 'number': %s,\n"
               "  'scene': %s, 'parameters': %x,\n"
               "  'units': {",
               TF_VERSION, cli_commit, CLI_NUMBER_TYPE, job.args->scene->name,
               tf_params_hash(&job.setup.params));
}

static void add_K(cli_buffer_t *text, const tf_two_fold_t *at,
                  tf_real_t scale) {
  cli_add_json(text, "'K++': %g, 'K+-': %g, 'K-+': %g, 'K--': %g",
               (double)(scale * at->Kpp), (double)(scale * at->Kpm),
               (double)(scale * at->Kmp), (double)(scale * at->Kmm));
}

static void add_direction(cli_buffer_t *text, const tf_direction_t *direction) {
  cli_add_json(
      text, "      {'eigenvalue': %g, 'velocity': [%g, %g, %g], 'lambda': %g, ",
      (double)direction->value, (double)direction->velocity.r,
      (double)direction->velocity.v, (double)direction->velocity.w,
      direction->sticks ? (double)direction->lambda : (double)NAN);
  cli_add_json(text,
               direction->sticks ? "'sticks': true}" : "'sticks': false}");
}

static void add_two_fold(cli_buffer_t *text, const tf_two_fold_t *at) {
  const bool through_first = at->through.value > at->across.value;
  const tf_direction_t *first = through_first ? &at->through : &at->across;
  const tf_direction_t *second = through_first ? &at->across : &at->through;
  cli_add_json(text,
               "    {\n      'r': %g, 'v': %g, 'omega': %g, 'g': %g,\n"
               "      ",
               (double)at->point.r, (double)at->point.v, (double)at->point.w,
               (double)at->point.g);
  add_K(text, at, at->time_scale * at->time_scale);
  cli_add_json(text,
               ",\n      'J1': %g, 'J2': %g,\n"
               "      'eigenvalues': [%g, %g],\n      'directions': [\n"
               "  ",
               (double)at->J1, (double)at->J2, (double)first->value,
               (double)second->value);
  add_direction(text, first);
  cli_add(text, ",\n  ");
  add_direction(text, second);
  cli_add_json(text,
               "],\n      'type': %s, 'case': %f,\n"
               "      'time_scale': %g, 'residual': %g,\n      'physical': {",
               tf_folds_name(at->type),
               at->paper_case > 0 ? at->paper_case : (double)NAN,
               (double)at->time_scale, (double)at->residual);
  add_K(text, at, 1);
  cli_add(text, "}\n    }");
}

static int describe_all(cli_buffer_t *text) {
  tf_surface_point_t points[TF_TWO_FOLDS];
  tf_absence_t absence = TF_ABSENCE_NONE;
  int count = 0;
  const cli_setup_t *setup = &job.setup;
  tf_status_t status =
      tf_two_folds(&setup->machine, &setup->input, points, &count, &absence);
  begin_json(text);
  cli_add_json(text,
               FOLD_UNITS "  'count': %u,\n  'reason': %s,\n  'two_folds': [",
               (unsigned)count,
               absence != TF_ABSENCE_NONE ? tf_absence_name(absence) : NULL);
  for (int i = 0; i < count && status == TF_OK; i++) {
    tf_two_fold_t at;
    status = tf_normal_form(&setup->machine, &setup->input, &points[i], &at);
    if (status == TF_OK) {
      cli_add(text, i > 0 ? ",\n" : "\n");
      add_two_fold(text, &at);
    }
  }
  cli_add(text, count > 0 ? "\n  ]\n}\n" : "]\n}\n");
  if (status == TF_OK) return CLI_DONE;
  return cli_stop("scene %s: singularities: %s", job.args->scene->name,
                  tf_status_name(status));
}

static int write_json(const cli_args_t *args, bool finds_kappa,
                      int (*describe)(cli_buffer_t *text)) {
  char room[ROOM];
  cli_buffer_t text = {room, 0, sizeof room, false};
  CLI_TRY(prepare(args, finds_kappa));
  CLI_TRY(describe(&text));
  return cli_output_write(&job.output, "--out", args->out, room, text.used);
}

int cli_singularities(const cli_args_t *args) {
  return write_json(args, false, describe_all);
}

static int out_of_range(const char *name, tf_real_t value) {
  return cli_refuse("--r %s --omega %s: %s would be %g, it %s",
                    job.args->r.text, job.args->omega.text, name, (double)value,
                    cli_must(cli_number(cli_number_index(name))));
}

static int refuse(const tf_design_t *design) {
  switch ((tf_design_obstacle_t)design->obstacle) {
    case TF_DESIGN_R:
      return cli_refuse(
          "--r %s: r must not be 0, nor so large or small that the normal form "
          "overflows",
          job.args->r.text);
    case TF_DESIGN_OMEGA:
      return cli_refuse(
          "--omega %s: omega must differ from omega0 = %g rad/s, where h = 0 "
          "has g = 0",
          job.args->omega.text, (double)job.setup.input.omega0);
    case TF_DESIGN_SPRING:
      return cli_refuse(
          "--r %s: k2 does not act on h at r = r0 = %g m, nor where d r "
          "cos(gamma) + (beta^2 + r^2) sin(gamma) is 0",
          job.args->r.text, (double)job.setup.input.r0);
    case TF_DESIGN_KAPPA:
      return out_of_range("kappa", design->kappa);
    case TF_DESIGN_K2:
      return out_of_range("k2", design->k2);
    case TF_DESIGN_LAW:
    case TF_DESIGN_GAMMA: // were refused before
    case TF_DESIGN_FOUND:
      break;
  }
  return CLI_REFUSED;
}

static int describe_design(cli_buffer_t *text) {
  tf_design_t design;
  CLI_TRY(check_design());
  if (tf_design_two_fold(&job.setup.machine, &job.setup.input,
                         (tf_real_t)job.args->r.from,
                         (tf_real_t)job.args->omega.from, &design) != TF_OK)
    return refuse(&design);
  begin_json(text);
  const double kappa = (double)design.kappa, k2 = (double)design.k2;
  cli_add_json(text,
               "'kappa': 'm', 'k2': 'N/m', " FOLD_UNITS
               "  'kappa': %g,\n  'k2': %g,\n"
               "  'set': '--set kappa=%g --set k2=%g',\n  'two_fold':\n",
               kappa, k2, kappa, k2);
  add_two_fold(text, &design.two_fold);
  cli_add(text, "\n}\n");
  return CLI_DONE;
}

int cli_design(const cli_args_t *args) {
  return write_json(args, true, describe_design);
}

// The commands that write a grid of (r, omega), or angles, as CSV. `atlas` has
// the conditions of the paper's figure 4, panel by panel, and their overlap.

#define FLUSH_EVERY 0.2 // [s]
#define ROW_ROOM 768

// Adds one row with its newline; a code other than CLI_DONE ends the grid.
typedef int (*row_t)(tf_real_t r, tf_real_t omega, cli_buffer_t *text);

// omega is the inner loop.
static int write_rows(row_t row, cli_progress_t *progress) {
  const cli_range_t *r = &job.r, *omega = &job.omega;
  const uint64_t points = r->count * omega->count;
  char bytes[ROW_ROOM];
  for (uint64_t i = 0; i < points; i++) {
    cli_buffer_t text = {bytes, 0, sizeof bytes, false};
    if (cli_stop_asked()) return cli_stop("interrupted at point %" PRIu64, i);
    CLI_TRY(row((tf_real_t)cli_range_at(r, i / omega->count),
                (tf_real_t)cli_range_at(omega, i % omega->count), &text));
    if (!cli_output_lines(&job.output, bytes, text.used))
      return CLI_STOPPED; // the message is that of cli_output_end
    const double now = cli_now();
    if (now - job.output.flushed >= FLUSH_EVERY)
      (void)cli_output_flush(&job.output);
    cli_progress_say(progress, now, (double)(i + 1) / (double)points,
                     "%" PRIu64 " of %" PRIu64 " points", i + 1, points);
  }
  return CLI_DONE;
}

// units: of the columns, for --provenance.
static int write_grid(const char *header, const char *units, row_t row) {
  char lines[CLI_PROVENANCE_ROOM];
  CLI_TRY(
      cli_output_begin(&job.output, "--out", job.args->out, CLI_WRITE_OVER));
  if (job.args->provenance) {
    const size_t length =
        cli_provenance(&job.setup, "inputs at t = 0, no motion", units, lines);
    (void)cli_output_lines(&job.output, lines, length);
  }
  (void)cli_output_lines(&job.output, header, strlen(header));
  cli_progress_t progress =
      cli_progress_start(cli_now(), job.output.descriptor);
  const int code = write_rows(row, &progress);
  cli_progress_clear(&progress);
  return cli_output_end(&job.output, code);
}

// A range around a place, from 0, unless one was given.
static void take_range(cli_range_t *range, tf_real_t place) {
  const double at = (double)place, size = at != 0 ? fabs(at) : 1;
  if (range->text == NULL) *range = (cli_range_t){"", at - size, at + size, 41};
}

// What was not given of the window is taken around the first two-fold.
static int take_window(void) {
  tf_surface_point_t points[TF_TWO_FOLDS];
  int count = 0;
  if (job.r.text != NULL && job.omega.text != NULL) return CLI_DONE;
  (void)tf_two_folds(&job.setup.machine, &job.setup.input, points, &count,
                     NULL);
  if (count < 1) {
    return cli_usage(
        "%s: --r A:B:N and --omega A:B:N are needed: scene %s has no two-fold "
        "to look around",
        job.args->command, job.args->scene->name);
  }
  take_range(&job.r, points[0].r);
  take_range(&job.omega, points[0].w);
  return cli_message(CLI_DONE, "note: r in [%.6g, %.6g], omega in [%.6g, %.6g]",
                     job.r.from, job.r.to, job.omega.from, job.omega.to);
}

static int regions_row(tf_real_t r, tf_real_t omega, cli_buffer_t *text) {
  const cli_setup_t *setup = &job.setup;
  tf_surface_t at;
  tf_real_t v = 0;
  tf_status_t status = tf_speed_for_slip(&setup->machine, r, omega,
                                         setup->input.omega0, TF_R(0.0), &v);
  if (status == TF_OK)
    status = tf_surface_at(&setup->machine, &setup->input, r, v, omega, &at);
  if (status != TF_OK) {
    return cli_stop("stopped at r = %g m, omega = %g rad/s, v = %g m/s: %s",
                    (double)r, (double)omega, (double)v,
                    tf_status_name(status));
  }
  cli_add_form(text, "%g,%g,%s,", (double)r, (double)omega,
               tf_region_name(at.region));
  if (at.lambda_is_given) cli_add_real(text, at.lambda);
  cli_add(text, ",");
  if (at.region != TF_REGION_CODIM2) cli_add_real(text, at.delassus);
  cli_add(text, "\n");
  return CLI_DONE;
}

// Where sin(gamma) = 0 the surface is w = omega0 (and r = 0). Then v does not
// follow from h = 0, and (r, omega) does not determine a point of the surface.
int cli_regions(const cli_args_t *args) {
  CLI_TRY(prepare(args, false));
  CLI_TRY(needs_jump(false));
  const cli_given_t gamma = origin_of("gamma");
  const double sine = fabs((double)job.setup.machine.sin_gamma);
  if (!(sine >= (double)TF_MIN_SINE)) {
    return cli_blame(CLI_REFUSED, &gamma,
                     "regions needs |sin(gamma)| in [%g, 1], it is %g: no "
                     "speed v follows from h = 0",
                     (double)TF_MIN_SINE, sine);
  }
  CLI_TRY(take_window());
  return write_grid("r,omega,region,lambda,delassus\n",
                    "r m, omega rad/s, lambda N, delassus 1/kg", regions_row);
}

static const char atlas_header[] =
    "r,omega,v,g,kappa,k2,K++,K+-,K-+,K--,J1,J2,K--_positive,K++_negative,"
    "J1_negative,J2_negative,J1J2_above_1,kappa_positive,k2_positive,overlap\n";

#define VALUES 10
#define CONDITIONS 7

static int atlas_row(tf_real_t r, tf_real_t omega, cli_buffer_t *text) {
  tf_design_t design;
  (void)tf_design_two_fold(&job.setup.machine, &job.setup.input, r, omega,
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
  cli_add_form(text, "%g,%g", (double)r, (double)omega);
  for (int i = 0; i < VALUES; i++) {
    cli_add(text, ",");
    if (exists && isfinite(values[i])) cli_add_real(text, values[i]);
  }
  for (int i = 0; i < CONDITIONS; i++) {
    cli_add(text, !exists ? "," : holds[i] ? ",1" : ",0");
    all = all && holds[i];
  }
  cli_add(text, all ? ",1\n" : ",0\n");
  return CLI_DONE;
}

int cli_atlas(const cli_args_t *args) {
  CLI_TRY(prepare(args, true));
  CLI_TRY(check_design());
  CLI_TRY(take_window());
  return write_grid(atlas_header,
                    "r m, omega rad/s, v m/s, g m/s, kappa m, k2 N/m, K in "
                    "rescaled time, others 1",
                    atlas_row);
}

// The angles are those of a slip of 1 m/s, which law smooth alone asks for.
static int tyre_row(tf_real_t angle, tf_real_t other, cli_buffer_t *text) {
  const double degree = acos(-1.0) / 180, phi = (double)angle;
  const tf_force_t f = tf_tyre_force(
      &job.setup.machine.contact.tyre, angle < 0 ? TF_R(-1.0) : TF_R(1.0),
      (tf_real_t)sin(degree * phi), (tf_real_t)sin(degree * (90 - fabs(phi))));
  (void)other;
  cli_add_form(text, "%g,%g,%g\n", phi, (double)f.F, (double)f.M);
  return CLI_DONE;
}

int cli_tyre(const cli_args_t *args) {
  cli_args_t angles = *args;
  angles.r = args->r.text != NULL ? args->r : (cli_range_t){"", 0, 90, 91};
  angles.omega.count = 1;
  CLI_TRY(prepare(&angles, false));
  return write_grid("angle,F,M\n", "angle degrees, F N, M N m", tyre_row);
}
