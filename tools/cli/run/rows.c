// The rows of a run: text, or frames, made by the functions that a board calls,
// so that whatever reads a board reads a recorded run as well.

#include "../host/host.h"
#include "run.h"

static void put(cli_run_t *run, const void *bytes, size_t length) {
  if (!cli_output_lines(&run->output, bytes, length))
    run->end = CLI_NOT_WRITTEN;
}

static void put_text(cli_run_t *run, const char *text) {
  put(run, text, strlen(text));
}

// The rows on a terminal, where nobody asked for all of them: the first and the
// last ones, in columns that a terminal has room for.

#define GLANCE 5  // rows at each end
#define GLANCED 6 // a terminal of 80 columns has no room for F and M
#define GLANCE_ROOM 128

static struct {
  uint64_t rows; // so far
  char last[GLANCE][GLANCE_ROOM];
} glance;

static void glance_at(cli_run_t *run, const cli_csv_t *row) {
  char *line = glance.last[glance.rows++ % GLANCE];
  size_t used = 0;
  for (size_t i = 0; i < GLANCED; i++) {
    used += (size_t)snprintf(line + used, GLANCE_ROOM - used, "%11.4g",
                             row->column[i]);
  }
  char set[CLI_SET_ROOM];
  (void)snprintf(line + used, GLANCE_ROOM - used,
                 row->choices > 1 ? " %-6s %u %s\n" : " %-6s %u\n",
                 tf_mode_name(row->mode), row->choices,
                 cli_write_set(set, row->set));
  if (glance.rows <= GLANCE) put_text(run, line);
}

#define FRAME_ROOM TF_FRAME_SIZE(TF_FRAME_PAYLOAD)

static struct {
  uint32_t sequence; // number of the next one
  uint32_t chain;    // hash of those before it
  uint32_t run;      // hash of the run
} frames;

static void chain(const uint8_t *end) {
  frames.chain = tf_frame_chain(frames.chain, end - 1 - TF_FRAME_CRC);
}

static void put_frame(cli_run_t *run, const uint8_t *frame, size_t size) {
  chain(frame + size);
  put(run, frame, size);
}

// setup: in, kept.
static tf_schema_t schema_of(const cli_run_t *run, const cli_setup_t *setup) {
  return (tf_schema_t){.params = &setup->params,
                       .scene = setup->scene->name,
                       .build = "twofold " TF_VERSION ", host",
                       .seed = setup->seed,
                       .scheme = (uint8_t)run->setup->scheme,
                       .ends = true,
                       .run = frames.run};
}

void cli_rows_schema(cli_run_t *run) {
  const uint64_t at = run->system.state.tick;
  uint32_t *next = &frames.sequence;
  uint8_t to[FRAME_ROOM];
  const cli_setup_t setup = cli_run_setup(run);
  const tf_schema_t schema = schema_of(run, &setup);
  put_frame(run, to, tf_send_schema(to, next, at, &schema));
  put_frame(run, to,
            tf_send_layout(to, next, at, TF_DOWN_STATE, tf_layout_state));
  put_frame(run, to,
            tf_send_layout(to, next, at, TF_DOWN_REPORT, tf_layout_report));
  put_frame(
      run, to,
      tf_send_layout(to, next, at, TF_DOWN_HEARTBEAT, tf_layout_heartbeat));
}

// Both together: a state without its report is not a row.
static void put_state(cli_run_t *run) {
  const tf_state_t *state = &run->system.state;
  const tf_input_source_t source = run->drive.table.count > 0
                                       ? TF_INPUT_SET
                                       : run->replay.simulation.stepped;
  uint32_t *next = &frames.sequence;
  uint8_t to[2 * FRAME_ROOM];
  size_t used = tf_send_state(to, next, state);
  chain(to + used);
  used += tf_send_report(to + used, next, state->tick, &run->system.report,
                         (uint8_t)source);
  chain(to + used);
  put(run, to, used);
}

static uint32_t at_most_32_bits(uint64_t count) {
  return count < UINT32_MAX ? (uint32_t)count : UINT32_MAX;
}

// A heartbeat with the counts of all steps: most of them may lie between two
// rows. A run has no clock that ticks, so its times are 0. A run that was
// interrupted has no end, by which a reader recognises it.
static void end_frames(cli_run_t *run) {
  uint8_t frame[FRAME_ROOM];
  if (run->end == CLI_NOT_WRITTEN || run->end == CLI_INTERRUPTED) return;
  const tf_tally_t *tally = &run->tally;
  const tf_heartbeat_t beat = {
      .steps = (uint32_t)(run->done - run->first),
      .refused =
          at_most_32_bits(tally->refused + (run->end == CLI_STEP_REFUSED)),
      .overruns = (uint32_t)run->late,
      .degraded = at_most_32_bits(tally->degraded),
      .fell_back = at_most_32_bits(tally->fell_back),
      .coarse = at_most_32_bits(tally->coarse),
      .stalled = at_most_32_bits(tally->stalled),
      .run = frames.run,
      .chain = frames.chain};
  put(run, frame,
      tf_send_heartbeat(frame, &frames.sequence, run->system.state.tick,
                        &beat));
}

size_t cli_run_provenance(const cli_run_t *run, const char *units,
                          char lines[CLI_PROVENANCE_ROOM]) {
  char how[CLI_ROW_ROOM];
  const cli_inputs_t *table = &run->drive.table;
  cli_buffer_t text = {how, 0, sizeof how, false};
  cli_add_form(&text, "scheme %s, dt %g s",
               motion_scheme_name(run->setup->scheme),
               (double)run->setup->machine.dt);
  if (table->count > 0)
    cli_add_form(&text, ", %s inputs %08x", table->linear ? "linear" : "held",
                 cli_inputs_hash(table));
  if (run->args->accuracy > 0)
    cli_add_form(&text, ", accuracy %g", run->args->accuracy);
  if (run->replays)
    cli_add_form(&text, ", replayed from a record with hash %08x",
                 run->replay.session.hash);
  if (run->args->from != NULL)
    cli_add_form(&text, ", from step %" PRIu64 " of a state %08x", run->first,
                 run->from.hash);
  return cli_provenance(run->setup, how, units, lines);
}

void cli_rows_begin(cli_run_t *run) {
  char lines[CLI_PROVENANCE_ROOM];
  if (run->rowless) return;
  if (run->glance) {
    put_text(run,
             "       t[s]       r[m]     v[m/s] omega[/s]     h[m/s]     "
             "g[m/s] mode   choices\n");
  } else if (run->args->format == CLI_FORMAT_FRAMES) {
    char every[CLI_REAL_ROOM];
    const cli_setup_t setup = cli_run_setup(run);
    const tf_schema_t schema = schema_of(run, &setup);
    (void)snprintf(every, sizeof every, "%" PRIu64, run->args->every);
    // In place of the units stands what else the rows depend on.
    const size_t length = cli_run_provenance(run, every, lines);
    frames.run =
        tf_run_hash(cli_crc(0, lines, length), &schema, &run->system.state);
    run->output.last = '\0';
    cli_rows_schema(run);
  } else {
    if (run->args->provenance)
      put(run, lines, cli_run_provenance(run, CLI_CSV_UNITS, lines));
    put_text(run, cli_streams[run->args->format].header);
  }
}

void cli_rows_add(cli_run_t *run) {
  const double started = cli_now();
  const tf_real_t t = (tf_real_t)cli_run_time(run, run->system.state.tick);
  const cli_csv_t row = cli_row(t, &run->system.state, &run->system.report);
  char line[CLI_ROW_ROOM];
  cli_buffer_t text = {line, 0, sizeof line, false};
  run->written = run->done;
  if (run->rowless) return;
  if (run->glance)
    glance_at(run, &row);
  else if (run->args->format == CLI_FORMAT_FRAMES)
    put_state(run);
  else
    cli_streams[run->args->format].row(&row, &text);
  put(run, line, text.used);
  run->output_seconds += cli_now() - started;
}

void cli_rows_end(cli_run_t *run) {
  if (run->glance) {
    const uint64_t rows = glance.rows;
    const uint64_t left = rows > GLANCE ? rows - GLANCE : 0;
    const uint64_t shown = left < GLANCE ? left : GLANCE;
    char line[GLANCE_ROOM];
    put_text(run, left > shown ? "        ...\n" : "");
    for (uint64_t i = rows - shown; i < rows; i++)
      put_text(run, glance.last[i % GLANCE]);
    (void)snprintf(
        line, sizeof line,
        "%" PRIu64
        " rows; all of them, with all digits: --out FILE, or into a pipe.\n\n",
        rows);
    put_text(run, line);
  } else if (run->args->format == CLI_FORMAT_FRAMES && !run->rowless) {
    end_frames(run);
  }
}
