// The formats of a row. Scripts rely on the columns of the CSV, so no column is
// ever appended. The plotter format is the one that the serial plotter of the
// Arduino IDE draws: label:value pairs on one line, without a time, because the
// plotter counts rows, and without the friction, as on a slow line. JSON, an
// object a line with its seconds in "timestamp", is for PlotJuggler over UDP.

#include "row.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../text/buffer.h"
#include "../text/number.h"

#define PLOTTED 6 // columns from the second up to this one

#define COLUMN(name, unit, value) {#name, unit},
static const cli_quantity_t columns[] = {CLI_CSV_NUMBERS(COLUMN, COLUMN)};

static void add(cli_buffer_t *text, const cli_csv_t *row, size_t i) {
  cli_add_number(text, row->column[i], row->is_float);
}

static size_t csv(const cli_csv_t *row, char out[CLI_ROW_ROOM]) {
  cli_buffer_t text = {out, 0, CLI_ROW_ROOM, false};
  for (size_t i = 0; i < CLI_CSV_COLUMNS; i++) {
    add(&text, row, i);
    cli_add(&text, ",");
  }
  cli_add_form(&text, "%s,%" PRIu64 "\n", tf_mode_name(row->mode),
               (uint64_t)row->choices);
  return text.used;
}

static size_t plotter(const cli_csv_t *row, char out[CLI_ROW_ROOM]) {
  cli_buffer_t text = {out, 0, CLI_ROW_ROOM, false};
  for (size_t i = 1; i < PLOTTED; i++) {
    cli_add_form(&text, "%s:", columns[i].name);
    add(&text, row, i);
    cli_add(&text, " ");
  }
  cli_add_form(&text, "mode:%" PRIu64 " choices:%" PRIu64 "\n",
               (uint64_t)row->mode, (uint64_t)row->choices);
  return text.used;
}

static size_t teleplot(const cli_csv_t *row, char out[CLI_ROW_ROOM]) {
  cli_buffer_t text = {out, 0, CLI_ROW_ROOM, false};
  char room[CLI_REAL_ROOM];
  const double ms = row->column[0] * 1000;
  cli_buffer_t at = {room, 0, sizeof room, false};
  cli_add_number(&at, row->is_float ? (double)(float)ms : ms, row->is_float);
  for (size_t i = 1; i < CLI_CSV_COLUMNS; i++) {
    cli_add_form(&text, "%s:%s:", columns[i].name, room);
    add(&text, row, i);
    // The section sign stands before the unit.
    cli_add_form(&text, "\xC2\xA7%s|g\n", columns[i].unit);
  }
  cli_add_form(&text, "mode:%s:%s|t\nchoices:%s:%" PRIu64 "|g\n", room,
               tf_mode_name(row->mode), room, (uint64_t)row->choices);
  return text.used;
}

static size_t json(const cli_csv_t *row, char out[CLI_ROW_ROOM]) {
  cli_buffer_t text = {out, 0, CLI_ROW_ROOM, false};
  for (size_t i = 0; i < CLI_CSV_COLUMNS; i++) {
    cli_add_form(&text, "%s\"%s\":", i == 0 ? "{" : ",",
                 i == 0 ? "timestamp" : columns[i].name);
    if (isfinite(row->column[i])) {
      add(&text, row, i);
    } else {
      cli_add(&text, "null"); // JSON has no other word for it
    }
  }
  cli_add_form(&text, ",\"mode\":%" PRIu64 ",\"choices\":%" PRIu64 "}\n",
               (uint64_t)row->mode, (uint64_t)row->choices);
  return text.used;
}

const cli_stream_t cli_streams[CLI_FORMATS] = {
    [CLI_FORMAT_CSV] = {CLI_CSV_HEADER "\n", csv},
    [CLI_FORMAT_FRAMES] = {"", NULL},
    [CLI_FORMAT_JSON] = {"", json},
    [CLI_FORMAT_PLOTTER] = {"", plotter},
    [CLI_FORMAT_TELEPLOT] = {"", teleplot}};

#define NUMBER(name, unit, value) (double)(value),
cli_csv_t cli_row(tf_real_t t, const tf_state_t *state,
                  const tf_report_t *report) {
  return (cli_csv_t){{CLI_CSV_NUMBERS(NUMBER, NUMBER)},
                     sizeof(tf_real_t) == sizeof(float),
                     report->mode,
                     report->choices};
}

#define GLANCED 6 // a terminal of 80 columns has no room for F and M

static bool put(cli_output_t *output, const char *line) {
  return cli_output_lines(output, line, strlen(line));
}

bool cli_glance_row(cli_glance_t *glance, const cli_csv_t *row,
                    cli_output_t *output) {
  char *line = glance->last[glance->rows % CLI_GLANCE];
  size_t used = 0;
  for (size_t i = 0; i < GLANCED; i++) {
    used += (size_t)snprintf(line + used, CLI_GLANCE_ROOM - used, "%11.4g",
                             row->column[i]);
  }
  (void)snprintf(line + used, CLI_GLANCE_ROOM - used, " %-6s %u\n",
                 tf_mode_name(row->mode), row->choices);
  glance->rows++;
  return glance->rows > CLI_GLANCE || put(output, line);
}

bool cli_glance_begin(cli_output_t *output) {
  return put(output,
             "       t[s]       r[m]     v[m/s] omega[/s]     h[m/s]  "
             "   g[m/s] mode   choices\n");
}

bool cli_glance_end(cli_glance_t *glance, cli_output_t *output) {
  const uint64_t rows = glance->rows;
  const uint64_t left = rows > CLI_GLANCE ? rows - CLI_GLANCE : 0;
  const uint64_t shown = left < CLI_GLANCE ? left : CLI_GLANCE;
  bool good = left == shown || put(output, "        ...\n");
  for (uint64_t i = rows - shown; good && i < rows; i++) {
    good = put(output, glance->last[i % CLI_GLANCE]);
  }
  char line[CLI_GLANCE_ROOM];
  (void)snprintf(line, sizeof line,
                 "%" PRIu64
                 " rows; all of them, with all digits: --out FILE, "
                 "or into a pipe.\n\n",
                 rows);
  return good && put(output, line);
}

// A run as frames, made by the functions that a board calls, so that whatever
// reads a board reads a recorded run as well.

static tf_schema_t schema_of(const cli_setup_t *setup,
                             const cli_scheme_t *scheme) {
  return (tf_schema_t){.params = &setup->params,
                       .scene = setup->scene->name,
                       .build = "twofold " TF_VERSION ", host",
                       .seed = setup->seed,
                       .scheme = (uint8_t)scheme->code,
                       .ends = true};
}

uint32_t cli_frames_run(const cli_setup_t *setup, const cli_scheme_t *scheme,
                        const tf_state_t *first, uint32_t before) {
  const tf_schema_t schema = schema_of(setup, scheme);
  return tf_run_hash(before, &schema, first);
}

// Returns: the size of a frame, after which the next one stands.
static size_t chain(cli_frames_t *frames, const uint8_t *frame, size_t size) {
  const uint8_t *crc = frame + size - 1 - TF_FRAME_CRC;
  frames->chain = tf_frame_chain(frames->chain, crc);
  return size;
}

static size_t layout(cli_frames_t *frames, uint64_t tick, tf_type_t type,
                     const char *text, uint8_t *out) {
  return chain(frames, out,
               tf_send_layout(out, &frames->sequence, tick, type, text));
}

size_t cli_frames_header(const cli_setup_t *setup, const cli_scheme_t *scheme,
                         uint64_t tick, cli_frames_t *frames,
                         uint8_t out[CLI_FRAMES_ROOM]) {
  tf_schema_t schema = schema_of(setup, scheme);
  schema.run = frames->run;
  size_t at =
      chain(frames, out, tf_send_schema(out, &frames->sequence, tick, &schema));
  at += layout(frames, tick, TF_DOWN_STATE, tf_layout_state, out + at);
  at += layout(frames, tick, TF_DOWN_REPORT, tf_layout_report, out + at);
  return at +
         layout(frames, tick, TF_DOWN_HEARTBEAT, tf_layout_heartbeat, out + at);
}

size_t cli_frames_row(cli_frames_t *frames, const tf_state_t *state,
                      const tf_report_t *report, tf_input_source_t source,
                      uint8_t out[CLI_FRAMES_ROOM]) {
  const size_t at =
      chain(frames, out, tf_send_state(out, &frames->sequence, state));
  return at + chain(frames, out + at,
                    tf_send_report(out + at, &frames->sequence, state->tick,
                                   report, (uint8_t)source));
}

static uint32_t at_most_32_bits(uint64_t count) {
  return count < UINT32_MAX ? (uint32_t)count : UINT32_MAX;
}

size_t cli_frames_end(cli_frames_t *frames, uint64_t tick, uint64_t steps,
                      uint64_t late, const tf_tally_t *tally,
                      uint8_t out[CLI_FRAMES_ROOM]) {
  const tf_heartbeat_t beat = {.steps = (uint32_t)steps,
                               .refused = at_most_32_bits(tally->refused),
                               .overruns = (uint32_t)late,
                               .degraded = at_most_32_bits(tally->degraded),
                               .fell_back = at_most_32_bits(tally->fell_back),
                               .coarse = at_most_32_bits(tally->coarse),
                               .stalled = at_most_32_bits(tally->stalled),
                               .run = frames->run,
                               .chain = frames->chain};
  return tf_send_heartbeat(out, &frames->sequence, tick, &beat);
}
