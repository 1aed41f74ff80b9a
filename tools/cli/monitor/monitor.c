// The command `monitor`. It reads as fast as bytes come and reports at the end
// what was lost. A device that is unplugged is an error unless --follow waits
// for it to come back.

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "../live/live.h"
#include "../text/summary.h"
#include "board_command.h"

#define WAIT 100 // for bytes, and between two attempts to open a device [ms]
#define BLOCK 65536
#define FLUSH_EVERY 0.2 // [s]
#define LIVE_SPAN 10.0  // [s] that --live shows
#define TITLE_ROOM 512
#define PROVENANCE_ROOM 1024

typedef struct {
  const cli_args_t *args;
  const cli_stream_t *as; ///< NULL: a live view
  cli_board_commands_t commands;
  cli_source_t source;
  cli_output_t output;
  cli_session_file_t record;
  cli_receiver_t receiver;
  cli_live_t *live; ///< the picture, or NULL
  bool begun;       ///< what stands before the rows is written
  bool at_end;      ///< of a file or a pipe
  uint8_t buffer[TF_DECODER_SIZE(TF_FRAME_PAYLOAD)];
  uint8_t block[BLOCK];
} monitor_t;

static void write_title(const monitor_t *monitor, char title[TITLE_ROOM]) {
  const tf_decoder_t *decoder = &monitor->receiver.decoder;
  const cli_receiver_t *receiver = &monitor->receiver;
  const tf_heartbeat_t *beat = &receiver->heartbeat;
  const int used = snprintf(
      title, TITLE_ROOM,
      "%.256s: scene %s; %" PRIu32 " frames, %" PRIu32 " broken, %" PRIu32
      " lost",
      monitor->source.name,
      receiver->has_schema ? receiver->scene : "not known yet", decoder->frames,
      decoder->bad + decoder->too_long + decoder->bad_version, decoder->lost);
  if (receiver->has_heartbeat) {
    (void)snprintf(title + used, TITLE_ROOM - (size_t)used,
                   "; %" PRIu32 " overruns, %" PRIu32 " skipped, %" PRIu32
                   " dropped, %" PRIu32 " times without inputs",
                   beat->overruns, beat->skipped, beat->dropped, beat->expired);
  }
}

// Four comment lines, as cli_provenance() writes them, of the sender.
static size_t provenance_of(const cli_receiver_t *receiver,
                            char out[PROVENANCE_ROOM]) {
  char dt[CLI_REAL_ROOM];
  (void)decimal_write(dt, receiver->dt, receiver->is_float);
  return (size_t)snprintf(
      out, PROVENANCE_ROOM,
      "# twofold %s, commit %s, rows of a stream, numbers are %s\n"
      "# scene %s, parameters %08" PRIx32
      "\n"
      "# sender %s, dt %s s\n"
      "# units: " CLI_CSV_UNITS "\n",
      TF_VERSION, cli_commit, receiver->is_float ? "float" : "double",
      receiver->has_schema ? receiver->scene : "not known", receiver->hash,
      receiver->has_schema ? receiver->build : "not known", dt);
}

// What stands before the rows, once. What they are of is known with the schema,
// which comes before the first one.
static void begin_rows(monitor_t *monitor) {
  const char *header = monitor->as->header;
  char lines[PROVENANCE_ROOM];
  if (monitor->begun) return;
  monitor->begun = true;
  if (monitor->args->provenance) {
    (void)cli_output_lines(&monitor->output, lines,
                           provenance_of(&monitor->receiver, lines));
  }
  (void)cli_output_lines(&monitor->output, header, strlen(header));
}

// Where the output fails, nothing more is written, and the caller finds its
// error.
static void take_block(monitor_t *monitor, size_t length) {
  const uint8_t *at = monitor->block;
  size_t taken = 0;
  tf_frame_t frame;
  cli_csv_t row;
  char line[CLI_ROW_ROOM];
  const cli_stream_t *as = monitor->as;
  cli_receiver_t *receiver = &monitor->receiver;
  receiver->bytes += length;
  receiver->is_device = monitor->source.is_device;
  if (monitor->args->format == CLI_FORMAT_FRAMES && !monitor->at_end)
    (void)cli_output_lines(&monitor->output, at, length);
  while (tf_decoder_block(&receiver->decoder, at, length, &taken, &frame)) {
    at += taken;
    length -= taken;
    cli_guard_t *guard = &monitor->commands.guard;
    const bool tagged = guard->key != NULL && tf_is_vouched_for(frame.type);
    if (!cli_guard_takes(guard, &frame) || (guard->mute && !tagged)) continue;
    const bool completes = cli_receiver_take(receiver, &frame, &row);
    if (tagged) frame.length = (uint8_t)(frame.length - TF_TAG_BYTES);
    cli_board_commands_answer(&monitor->commands, &frame, receiver,
                              &monitor->record);
    cli_session_frame(&monitor->record, &frame);
    if (!completes) continue;
    cli_live_note(monitor->live, &row);
    if (as != NULL && as->row != NULL) {
      begin_rows(monitor);
      cli_buffer_t text = {line, 0, sizeof line, false};
      as->row(&row, &text);
      (void)cli_output_lines(&monitor->output, line, text.used);
    }
  }
}

// Returns: CLI_DONE once it is back or a signal has asked for a stop.
static int wait_for_device(monitor_t *monitor) {
  cli_source_t *source = &monitor->source;
  const char *why = source->error == 0 ? "it ended" : strerror(source->error);
  if (!monitor->args->follow) {
    return cli_message(CLI_STOPPED, "%s: the device went away: %s",
                       source->name, why);
  }
  (void)cli_message(CLI_DONE, "%s: the device went away: %s; waiting",
                    source->name, why);
  cli_source_close(source);
  const cli_args_t *args = monitor->args;
  while (!cli_stop_asked() && !cli_source_open(source, args->source, args->baud,
                                               monitor->commands.count > 0))
    cli_sleep(WAIT);
  if (!cli_stop_asked()) (void)cli_message(CLI_DONE, "%s: back", source->name);
  return cli_board_commands_again(&monitor->commands);
}

static int follow_stream(monitor_t *monitor) {
  char title[TITLE_ROOM];
  const cli_args_t *args = monitor->args;
  cli_board_commands_t *commands = &monitor->commands;
  while (!cli_stop_asked() && !monitor->at_end) {
    size_t count = 0;
    CLI_TRY(cli_board_commands_send(commands, &monitor->receiver,
                                    &monitor->source));
    if (args->sends > 0 && commands->next == commands->count &&
        monitor->as == NULL && monitor->live == NULL)
      return CLI_DONE; // every command is answered, and nothing is shown
    const cli_source_found_t found =
        cli_source_read(&monitor->source, monitor->block, BLOCK, WAIT, &count);
    const double now = cli_now();
    if (found == CLI_SOURCE_END && !args->follow) {
      // What stands in the decoder is a frame without its last byte, or a piece
      // of one, which is counted.
      monitor->at_end = true;
      monitor->block[0] = 0;
      monitor->receiver.bytes--;
      count = 1;
    }
    if (count > 0) take_block(monitor, count);
    write_title(monitor, title);
    cli_live_draw(monitor->live, title, now);
    // Rows of a slow board are flushed before the next wait.
    if (monitor->as != NULL && (found != CLI_SOURCE_BYTES ||
                                now - monitor->output.flushed >= FLUSH_EVERY))
      (void)cli_output_flush(&monitor->output);
    if (monitor->output.error != 0) {
      return cli_message(CLI_STOPPED, "%s: %s", monitor->output.name,
                         cli_output_reason(&monitor->output));
    }
    if (found == CLI_SOURCE_END && args->follow)
      cli_sleep(WAIT); // a file may still grow
    else if (found == CLI_SOURCE_GONE)
      CLI_TRY(wait_for_device(monitor));
  }
  return CLI_DONE;
}

static int open_both(monitor_t *monitor) {
  const cli_args_t *args = monitor->args;
  if (!cli_source_open(&monitor->source, args->source, args->baud,
                       monitor->commands.count > 0)) {
    return cli_message(CLI_STOPPED, "%s: %s", args->source,
                       monitor->source.error == EINVAL && args->baud != 0
                           ? "the device does not take this --baud"
                           : strerror(monitor->source.error));
  }
  if (args->key != NULL && !monitor->source.is_device)
    return cli_message(CLI_STOPPED,
                       "--key: %s is not a device and cannot answer",
                       monitor->source.name);
  const cli_begin_t how = cli_is_regular(monitor->source.descriptor)
                              ? CLI_WRITE_OVER
                              : CLI_WRITE_ONCE;
  if (monitor->as != NULL)
    CLI_TRY(cli_output_begin(&monitor->output, "--out", args->out, how));
  if (args->format == CLI_FORMAT_FRAMES) monitor->output.last = '\0';
  if (monitor->as != NULL && !args->provenance) begin_rows(monitor);
  return args->record != NULL
             ? cli_session_open(&monitor->record, args->record, how)
             : CLI_DONE;
}

// What is wrong with the stream as a whole, NULL: nothing. Where all frames are
// right, they may still be of more than one run, or of a part of one. With
// --follow a board may be started again.
static const char *fault_of(const monitor_t *monitor) {
  static char where[160];
  const cli_receiver_t *receiver = &monitor->receiver;
  if (monitor->source.broke) return "the board reported a fault";
  if (receiver->is_device && !receiver->has_schema)
    return "no schema has come, and rows need one: a board sends one each "
           "second";
  const uint64_t missing = cli_receiver_missing(receiver);
  if (cli_receiver_lost(receiver) > 0 ||
      (!receiver->is_device && missing > receiver->dropped))
    return "frames were lost or broken: see the counts";
  if (missing > 0) // a heartbeat may not have counted all yet
    return "the board dropped records: its line or its ticks have no "
           "room for them (EVERY)";
  if (receiver->decoder.restarts > 0 && !monitor->args->follow) {
    return "the sender was started again, or frames came twice: these are rows "
           "of more than one run";
  }
  if (receiver->other_runs > 0 && !monitor->args->follow) {
    (void)snprintf(where, sizeof where,
                   "between steps %" PRIu64 " and %" PRIu64
                   " frames are of another run: these are rows of more than "
                   "one run",
                   receiver->between[0], receiver->between[1]);
    return where;
  }
  return monitor->at_end && receiver->ends && !receiver->ended
             ? "ends early: the run's last heartbeat is missing"
             : NULL;
}

static int judge_stream(const monitor_t *monitor, int code) {
  const cli_receiver_t *receiver = &monitor->receiver;
  const tf_tally_t flagged = cli_receiver_flagged(receiver);
  const char *fault = fault_of(monitor);
  CLI_TRY(code);
  CLI_TRY(monitor->commands.refused > 0 ? CLI_REFUSED : CLI_DONE);
  const tf_decoder_t *decoder = &receiver->decoder;
  if (decoder->frames == 0 && decoder->bad_version > 0) {
    return cli_message(CLI_STOPPED,
                       "%s: its protocol is version %u, here it is %d: "
                       "rebuild the sender from these sources",
                       monitor->args->source, (unsigned)decoder->version,
                       TF_FRAME_VERSION);
  }
  if (decoder->frames == 0) {
    return cli_message(CLI_STOPPED, "%s: no frame of protocol version %d",
                       monitor->args->source, TF_FRAME_VERSION);
  }
  if (fault != NULL)
    return cli_message(CLI_DAMAGED, "%s: %s", monitor->source.name, fault);
  if (receiver->not_finite > 0) return CLI_DAMAGED;
  return receiver->skipped > 0 ? CLI_FLAGGED : cli_tally_code(&flagged);
}

// The summary, for a person and as JSON: what a board does not report is left
// out of the text and is null in JSON.

static void print_board(const tf_heartbeat_t *beat) {
  cli_say("board      %" PRIu32 " steps, %" PRIu32 " overruns, %" PRIu32
          " ticks without a step, %" PRIu32 " frames dropped, %" PRIu32
          " steps refused",
          beat->steps, beat->overruns, beat->skipped, beat->dropped,
          beat->refused);
  if (beat->exec_max > 0) {
    cli_say("; a step takes %" PRIu32 " to %" PRIu32 " ns, mean %" PRIu32,
            beat->exec_min, beat->exec_max, beat->exec_mean);
  }
  cli_say("\n");
  if (beat->bad + beat->lost + beat->ignored + beat->unread > 0) {
    cli_say("commands   %" PRIu32 " broken, %" PRIu32 " lost, %" PRIu32
            " ignored; %" PRIu32 " bytes lost before they were read\n",
            beat->bad, beat->lost, beat->ignored, beat->unread);
  }
  if (beat->superseded + beat->late > 0) {
    cli_say("setpoints  %" PRIu32 " superseded, %" PRIu32 " late\n",
            beat->superseded, beat->late);
  }
  if (beat->expired > 0) {
    cli_say("inputs     expired %" PRIu32
            " times: nobody renewed them, the machine coasted\n",
            beat->expired);
  }
}

static void print_summary(const cli_receiver_t *receiver) {
  const tf_decoder_t *decoder = &receiver->decoder;
  if (receiver->has_schema) {
    cli_say("sender     %s, scene %s, %s, dt = %g s, ", receiver->build,
            receiver->scene, receiver->is_float ? "float" : "double",
            receiver->dt);
    cli_say("parameters %08" PRIx32 "\n", receiver->hash);
  }
  cli_say("frames     %" PRIu32 " in %" PRIu64 " bytes, %" PRIu64
          " rows, %" PRIu64 " without a match, %" PRIu64 " unknown\n",
          decoder->frames, receiver->bytes, receiver->rows,
          receiver->incomplete + receiver->has_state, receiver->unknown);
  cli_say("line       %" PRIu32 " lost, %" PRIu32 " broken, %" PRIu32
          " too long, %" PRIu32 " of another version, %" PRIu32
          " restarts, %" PRIu64 " changes of the run\n",
          decoder->lost, decoder->bad, decoder->too_long, decoder->bad_version,
          decoder->restarts, receiver->other_runs);
  if (receiver->has_heartbeat) print_board(&receiver->heartbeat);
  if (receiver->rows > 0 || receiver->has_heartbeat) {
    const tf_tally_t tally = cli_receiver_flagged(receiver);
    cli_tally_print(&tally, "first reported",
                    receiver->has_first ? receiver->first : (double)NAN);
  }
  if (receiver->has_schema && receiver->rows > 0) {
    cli_say("last       step %" PRIu64
            ", r = %.9g m, v = %.9g m/s, omega = %.9g rad/s, %s\n",
            receiver->tick, receiver->state[0], receiver->state[1],
            receiver->state[2], tf_mode_name(receiver->mode));
  }
  if (receiver->not_finite > 0) {
    cli_say("values     %" PRIu64
            " rows with one that is not finite, first at step %" PRIu64 "\n",
            receiver->not_finite, receiver->first_tick);
  }
}

static void put_sender(const cli_receiver_t *receiver) {
  if (!receiver->has_schema) {
    cli_put("'sender': null, ");
    return;
  }
  cli_put(
      "'sender': %s, 'scene': %s, 'number': %s, 'parameters': %x, "
      "'dt': %f, ",
      receiver->build, receiver->scene, receiver->is_float ? "float" : "double",
      receiver->hash, receiver->dt);
}

static void put_counts(const cli_receiver_t *receiver) {
  const tf_decoder_t *decoder = &receiver->decoder;
  cli_put("'bytes': %" PRIu64 ", 'frames': %u, 'rows': %" PRIu64
          ", 'unmatched': %" PRIu64 ", 'unknown': %" PRIu64
          ", 'lost': %u, "
          "'broken': %u, 'too_long': %u, 'other_version': %u, 'restarts': %u, "
          "'other_runs': %" PRIu64 ", 'missing': %" PRIu64
          ", 'not_finite': %" PRIu64 ", ",
          receiver->bytes, decoder->frames, receiver->rows,
          receiver->incomplete + receiver->has_state, receiver->unknown,
          decoder->lost, decoder->bad, decoder->too_long, decoder->bad_version,
          decoder->restarts, receiver->other_runs,
          cli_receiver_missing(receiver), receiver->not_finite);
}

static void put_board(const cli_receiver_t *receiver) {
  const tf_heartbeat_t *beat = &receiver->heartbeat;
  if (!receiver->has_heartbeat) {
    cli_put("'board': null, ");
    return;
  }
  cli_put(
      "'board': {'steps': %u, 'overruns': %u, 'skipped': %u, "
      "'dropped': %u, 'broken': %u, 'lost': %u, 'ignored': %u, "
      "'unread': %u, 'superseded': %u, 'late': %u, 'expired': %u, "
      "'exec_min_ns': %u, 'exec_mean_ns': %u, 'exec_max_ns': %u, "
      "'refused': %u}, ",
      beat->steps, beat->overruns, beat->skipped, beat->dropped, beat->bad,
      beat->lost, beat->ignored, beat->unread, beat->superseded, beat->late,
      beat->expired, beat->exec_min, beat->exec_mean, beat->exec_max,
      beat->refused);
}

static void put_last(const cli_receiver_t *receiver) {
  if (!receiver->has_schema || receiver->rows == 0) {
    cli_put("'last': null, ");
    return;
  }
  cli_put("'last': {'step': %" PRIu64 ", ", receiver->tick);
  for (int i = 0; i < 3; i++) {
    static const char *const names[] = {"r", "v", "omega"};
    const double value = receiver->state[i];
    char digits[CLI_REAL_ROOM] = "null";
    if (isfinite(value)) (void)decimal_write(digits, value, receiver->is_float);
    cli_say("\"%s\": %s, ", names[i], digits);
  }
  cli_put("'mode': %s}, ", tf_mode_name(receiver->mode));
}

static void put_summary(const cli_receiver_t *receiver, int code) {
  const tf_tally_t tally = cli_receiver_flagged(receiver);
  cli_put("{'version': %s, 'commit': %s, 'command': 'monitor', 'source': %s, ",
          TF_VERSION, cli_commit, receiver->source);
  put_sender(receiver);
  put_counts(receiver);
  put_board(receiver);
  cli_tally_put(&tally);
  put_last(receiver);
  cli_put_exit(code);
}

static int perform(monitor_t *monitor) {
  char title[TITLE_ROOM];
  int code = open_both(monitor);
  if (code != CLI_DONE) {
    cli_source_close(&monitor->source);
    return code;
  }
  const bool shows = monitor->as == NULL && cli_is_terminal(STDOUT_FILENO);
  monitor->live =
      monitor->args->live || shows ? cli_live_open(LIVE_SPAN) : NULL;
  code = follow_stream(monitor);
  // What has an end of its own has to be read to its end; all else is read
  // until a signal says that it is enough.
  if (code == CLI_DONE && cli_stop_asked() && !monitor->args->follow &&
      cli_is_regular(monitor->source.descriptor))
    code = cli_message(CLI_STOPPED, "%s: interrupted", monitor->source.name);
  write_title(monitor, title);
  cli_live_close(monitor->live, title);
  // A file of rows that are not all of one stream does not get its name, by
  // which it would say that they are.
  const bool is_whole =
      monitor->receiver.decoder.frames > 0 && fault_of(monitor) == NULL;
  const int whole = is_whole ? code : CLI_DAMAGED;
  int closed = whole;
  if (monitor->as != NULL) {
    begin_rows(monitor); // a stream without a row has a header, too
    closed = cli_output_end(&monitor->output, closed);
  }
  closed = cli_session_close(&monitor->record, closed);
  code = closed == whole ? code : closed;
  cli_source_close(&monitor->source);
  monitor->receiver.source = monitor->source.name;
  if (monitor->args->summary == 0) print_summary(&monitor->receiver);
  code = judge_stream(monitor, code);
  if (monitor->args->summary != 0) put_summary(&monitor->receiver, code);
  return code;
}

int cli_monitor_check(cli_args_t *args) {
  if (args->source == NULL) {
    return cli_message(CLI_USAGE,
                       "monitor: which file or device? (- is standard input)");
  }
  if (args->live && args->format != CLI_NOT_GIVEN && args->out == NULL) {
    return cli_message(CLI_USAGE,
                       "--live --format: rows go to --out FILE only");
  }
  if (args->out != NULL && args->format == CLI_NOT_GIVEN)
    return cli_message(CLI_USAGE, "--out %s: only with --format", args->out);
  if (args->provenance && args->format != CLI_FORMAT_CSV)
    return cli_message(CLI_USAGE, "--provenance: only with --format csv");
  return CLI_DONE;
}

int cli_monitor(const cli_args_t *args) {
  static monitor_t monitor;
  monitor.args = args;
  monitor.as =
      args->format != CLI_NOT_GIVEN ? &cli_streams[args->format] : NULL;
  CLI_TRY(cli_board_commands_open(&monitor.commands, args));
  tf_decoder_init(&monitor.receiver.decoder, monitor.buffer,
                  sizeof monitor.buffer);
  cli_catch_signals();
  return perform(&monitor);
}
