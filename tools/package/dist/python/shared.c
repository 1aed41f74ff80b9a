/* What the package calls beside the public functions: the layout of structs, so
 * that Python can hold them, and loops, which would be slow there. Each real
 * type is a library of its own, with the command line in it. */
#include <math.h>

#include "cli/run/row.h"
#include "cli/setup/scene_file.h"
#include "cli/sweep/point.h"
#include "twofold.c"

/* A motion, the scene that drives it, and the scheme that advances it. */
typedef struct {
  motion_t *motion;
  const tf_scene_t *scene;
  int scheme;
} run_t;

/* Takes steps of an ensemble, block by block, behind `from` of them up to `to`.
 * input: that of the first of them, behind which the turntable keeps its speed;
 * NULL: those of the scene. */
void twofold_lanes(const run_t *of, tf_state_block_t *states, size_t n,
                   tf_input_t *input, tf_report_block_t *reports, uint64_t from,
                   uint64_t to) {
  const tf_machine_t *machine = &of->motion->machine.machine;
  for (size_t at = 0; at < n; at += TF_LANES) {
    tf_input_t u = input ? *input : tf_input_default(machine);
    for (uint64_t i = from + 1; i <= to; i++) {
      if (!input) u = tf_scene_input(of->scene, machine, i);
      cli_step_lanes(machine, states + at / TF_LANES,
                     n - at < TF_LANES ? n - at : TF_LANES, &u,
                     reports + at / TF_LANES);
      u.alpha = 0;
    }
  }
  if (input && to > from) input->alpha = 0;
}

typedef struct {
  tf_real_t r, v, omega, g, K[4], J1, J2, eigenvalue[2], time_scale;
  uint8_t type, paper_case;
} fold_t;
typedef struct {
  tf_real_t r, omega, lambda, delassus;
  uint8_t region;
} place_t;

/* A table of inputs, and the machine that it drives. */
typedef struct {
  cli_drive_t drive;
  cli_setup_t setup;
} table_t;

/* Columns of a row, with units; sizes in the order that the module knows. */
const char *const twofold_columns =
    EACH_COLUMN(CLI_CSV_UNIT, CLI_CSV_NEXT_UNIT, CLI_CSV_NEXT_UNIT);
const uint32_t twofold_layout[] = {sizeof(tf_compensated_t),
                                   sizeof(tf_report_t),
                                   TF_PARAMETERS,
                                   TF_SCENES,
                                   sizeof(cli_scene_file_t),
                                   sizeof(table_t),
                                   sizeof(cli_outcome_t),
                                   sizeof(cli_lanes_t),
                                   CLI_MEASURES};

/* Reads a scene, or inputs over time, from the text of a file. path: of it,
 * kept. why: out, empty, the messages. Returns: 0, or the code of a refusal. */
int twofold_scene(cli_scene_file_t *file, const char *path, const char *text,
                  size_t size, char *why, size_t room) {
  cli_message_divert(why, room);
  const int code = cli_scene_parse(file, path, text, size);
  cli_message_divert(NULL, 0);
  return code;
}

/* begin, end: of the run [s], for a note where the table does not fit it. */
int twofold_table(table_t *table, const tf_scene_t *scene, bool linear,
                  double begin, double end, const char *path, const char *text,
                  size_t size, char *why, size_t room) {
  cli_inputs_t *inputs = &table->drive.table;
  cli_message_divert(why, room);
  int code = cli_drive_read(&table->drive, scene, NULL, 0);
  inputs->linear = linear;
  if (code == CLI_DONE) code = cli_inputs_parse(inputs, path, text, size);
  if (inputs->given[CLI_INPUT_OMEGA0]) cli_inputs_free(&table->drive.profile);
  if (code == CLI_DONE)
    cli_drive_notes(&table->drive, &table->setup, begin, end);
  cli_message_divert(NULL, 0);
  return code;
}

/* Goes to where a motion is. Returns: the inputs there. */
tf_input_t twofold_drive(table_t *table, const run_t *of,
                         const tf_params_t *params) {
  table->setup.params = *params;
  table->setup.machine = of->motion->machine.machine;
  table->setup.scheme = of->scheme;
  return cli_drive_begin(&table->drive, &table->setup.machine,
                         of->motion->state.tick);
}

void twofold_free(table_t *table) { cli_drive_free(&table->drive); }

motion_row_t twofold_row(const run_t *of) { return motion_row(of->motion); }

static tf_real_t or_else(tf_real_t given, tf_real_t usual) {
  return isnan(given) ? usual : given;
}

int twofold_takes_law(int scheme, int law) {
  return motion_takes_law(scheme, law);
}

/* Begins a motion. given: r, v, omega, h, phi; NaN: that of the scene. input:
 * at tick 0; NULL: that of the scene. */
tf_status_t twofold_begin(const run_t *of, uint32_t seed,
                          const tf_real_t given[5], const tf_input_t *input) {
  const tf_input_t u =
      input ? *input
            : tf_scene_input(of->scene, &of->motion->machine.machine, 0);
  motion_start_t start = motion_start(of->scene, seed);
  start.from_h = isnan(given[1]) && (start.from_h || !isnan(given[3]));
  start.state.r = or_else(given[0], start.state.r);
  start.state.v = or_else(given[1], start.state.v);
  start.state.w = or_else(given[2], start.state.w);
  start.h = or_else(given[3], start.h);
  start.state.phi = or_else(given[4], start.state.phi);
  return motion_begin(of->motion, of->scheme, &start, &u);
}

static tf_input_t next_input(const run_t *of, const tf_input_t *held) {
  return held ? *held
              : tf_scene_input(of->scene, &of->motion->machine.machine,
                               of->motion->state.tick + 1);
}

/* Goes on behind `from` of so many steps, for `most` of them, and writes a row
 * before the first, after every `every` of all and after the last. input: held,
 * its alpha is 0 behind a step; NULL: those of the scene, or of a table that
 * is not NULL. seen: in/out, begun, for a sweep; NULL: no outcomes. Returns:
 * steps taken, with `from`; fewer where one is refused, whose status is in
 * `status`. */
uint64_t twofold_run(const run_t *of, tf_input_t *input, table_t *table,
                     cli_outcome_t *seen, uint64_t from, uint64_t most,
                     uint64_t steps, uint64_t every, motion_row_t *rows,
                     int *status) {
  const uint64_t end = steps - from > most ? from + most : steps;
  motion_changes_t changes;
  if (from == 0) rows[0] = motion_row(of->motion);
  for (uint64_t i = from + 1; i <= end; i++) {
    tf_input_t u = next_input(of, input);
    changes.count = 0;
    *status = table
                  ? cli_drive_take(&table->drive, &table->setup, of->motion, &u)
                  : motion_step_changes(of->motion, of->scheme, &u, &changes);
    if (seen) {
      tf_report_t report = of->motion->report;
      report.status = *status;
      cli_outcome_see(seen, i, &seen->report, &report, &of->motion->state, &u,
                      table ? &table->drive.changes : &changes);
    }
    if (*status < 0) return i - 1;
    if (input) input->alpha = 0;
    if (i % every == 0 || i == steps)
      rows[(i - 1) / every + 1] = motion_row(of->motion);
  }
  return end;
}

/* The same in lanes, of a sweep under the inputs of the scene. */
void twofold_together(const run_t *of, cli_lanes_t *lanes, uint64_t from,
                      uint64_t most, uint64_t steps) {
  const uint64_t end = steps - from > most ? from + most : steps;
  if (from == 0) cli_lanes_begin(lanes);
  for (uint64_t i = from + 1; i <= end && lanes->going > 0; i++) {
    const tf_input_t u =
        tf_scene_input(of->scene, &of->motion->machine.machine, i);
    cli_lanes_step(lanes, i, &u);
  }
  if (end == steps) cli_lanes_end(lanes, steps);
}

/* One step into a mode that it may take. */
tf_status_t twofold_take(const run_t *of, const tf_input_t *input,
                         unsigned mode) {
  const tf_input_t u = next_input(of, input);
  return motion_take(of->motion, of->scheme, &u, mode);
}

/* The two-folds, with K in the paper's time. */
tf_status_t twofold_folds(const run_t *of, fold_t rows[TF_TWO_FOLDS],
                          int *count) {
  const tf_machine_t *machine = &of->motion->machine.machine;
  const tf_input_t u = tf_scene_input(of->scene, machine, 0);
  tf_surface_point_t points[TF_TWO_FOLDS];
  tf_status_t status = tf_two_folds(machine, &u, points, count, NULL);
  for (int i = 0; status >= 0 && i < *count; i++) {
    tf_two_fold_t at;
    status = tf_normal_form(machine, &u, &points[i], &at);
    if (status < 0) break;
    const tf_real_t c = at.time_scale * at.time_scale;
    const tf_real_t a = at.through.value, b = at.across.value;
    rows[i] = (fold_t){points[i].r,
                       points[i].v,
                       points[i].w,
                       points[i].g,
                       {c * at.Kpp, c * at.Kpm, c * at.Kmp, c * at.Kmm},
                       at.J1,
                       at.J2,
                       {a > b ? a : b, a > b ? b : a},
                       at.time_scale,
                       at.type,
                       at.paper_case};
  }
  return status;
}

/* The regions of h = 0 at places whose r and omega are filled in; NaN: lambda
 * or delassus is not defined there. */
tf_status_t twofold_regions(const run_t *of, place_t *places, size_t n) {
  const tf_machine_t *machine = &of->motion->machine.machine;
  const tf_input_t u = tf_scene_input(of->scene, machine, 0);
  tf_status_t status = TF_OK;
  for (size_t i = 0; status >= 0 && i < n; i++) {
    place_t *at = &places[i];
    tf_surface_t found = {0};
    tf_real_t v = 0;
    status = tf_speed_for_slip(machine, at->r, at->omega, u.omega0, 0, &v);
    if (status >= 0)
      status = tf_surface_at(machine, &u, at->r, v, at->omega, &found);
    at->lambda = found.lambda_is_given ? found.lambda : (tf_real_t)NAN;
    at->delassus =
        found.region == TF_REGION_CODIM2 ? (tf_real_t)NAN : found.delassus;
    at->region = found.region;
  }
  return status;
}
