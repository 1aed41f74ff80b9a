// Both forms of the summary have the same counts. What a board has not told is
// left out of the text and is null in JSON.
//
// A file of frames and a pipe begin where the sender began: everything in them
// that is not a frame is damage. A line does not: whoever starts to listen
// hears half a frame first, and states that mean nothing before the schema.

#include "monitor_summary.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>

#include "../run/row.h"
#include "../text/message.h"
#include "../text/number.h"
#include "../text/summary.h"

// The decoder counts modulo 2^32: so does this sum, and a frame adds far less.
static uint32_t counted(const tf_decoder_t *decoder) {
  return decoder->lost + decoder->bad + decoder->too_long +
         decoder->bad_version;
}

static uint64_t missing_so_far(const cli_seen_t *seen) {
  return seen->missed +
         (uint32_t)(counted(&seen->decoder) - seen->last_counted) +
         seen->receiver.incomplete;
}

// A count that went back is that of a board that was started again, and counts
// from 0; one that went on may have passed 2^32.
static void note_told(cli_told_t *count, uint32_t told) {
  const uint32_t more = told - count->last;
  if (count->is_known) {
    count->more += more <= UINT32_MAX / 2 ? more : told;
  }
  count->is_known = true;
  count->last = told;
}

static void note_row(cli_seen_t *seen, const cli_csv_t *row) {
  bool finite = true;
  for (size_t i = 0; i < CLI_CSV_COLUMNS; i++) {
    finite = finite && isfinite(row->column[i]);
  }
  if (!finite && seen->not_finite++ == 0) {
    seen->first_tick = seen->receiver.tick;
  }
}

static tf_tally_t most(const tf_tally_t *a, const tf_tally_t *b) {
  tf_tally_t tally = *a;
  tally.degraded = a->degraded > b->degraded ? a->degraded : b->degraded;
  tally.fell_back = a->fell_back > b->fell_back ? a->fell_back : b->fell_back;
  tally.coarse = a->coarse > b->coarse ? a->coarse : b->coarse;
  tally.stalled = a->stalled > b->stalled ? a->stalled : b->stalled;
  return tally;
}

static void note_report(cli_seen_t *seen, const cli_csv_t *row) {
  const cli_receiver_t *receiver = &seen->receiver;
  const bool repeats = seen->has_report && seen->tick == receiver->tick;
  seen->has_report = true;
  seen->tick = receiver->tick;
  if (repeats) {
    return;
  }
  if (cli_tally_reserved(&seen->reported) == 0) {
    seen->first = row->column[0];
  }
  tf_tally_count(&seen->reported, receiver->tick, receiver->status);
}

bool cli_seen_frame(cli_seen_t *seen, const tf_frame_t *frame, cli_csv_t *row) {
  const cli_receiver_t *receiver = &seen->receiver;
  const bool completes = cli_receiver_take(&seen->receiver, frame, row);
  const tf_heartbeat_t *beat = &receiver->heartbeat;
  seen->missed += (uint32_t)(counted(&seen->decoder) - seen->last_counted);
  seen->last_counted = counted(&seen->decoder);
  if (receiver->has_schema && !seen->heard) {
    seen->heard = true;
    seen->before = seen->is_device ? missing_so_far(seen) : 0;
  }
  seen->is_open = receiver->ends && frame->type != TF_DOWN_HEARTBEAT;
  if (receiver->has_heartbeat) {
    note_told(&seen->dropped, beat->dropped);
    note_told(&seen->skipped, beat->skipped);
    // A board that was started again counts from 0, and what it reported before
    // holds.
    const tf_tally_t told = {.degraded = beat->degraded,
                             .fell_back = beat->fell_back,
                             .coarse = beat->coarse,
                             .stalled = beat->stalled};
    seen->counted = most(&seen->counted, &told);
  }
  if (completes) { // it is a report
    note_report(seen, row);
    note_row(seen, row);
  }
  return completes;
}

uint64_t cli_seen_missing(const cli_seen_t *seen) {
  return missing_so_far(seen) + seen->receiver.has_state - seen->before +
         seen->dropped.more;
}

tf_tally_t cli_seen_flagged(const cli_seen_t *seen) {
  return most(&seen->counted, &seen->reported);
}

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
  if (beat->expired > 0) {
    cli_say("inputs     expired %" PRIu32
            " times: nobody renewed them, the machine coasted\n",
            beat->expired);
  }
}

void cli_seen_print(const cli_seen_t *seen) {
  const cli_receiver_t *receiver = &seen->receiver;
  const tf_decoder_t *decoder = &seen->decoder;
  if (receiver->has_schema) {
    cli_say("sender     %s, scene %s, %s, dt = %g s, ", receiver->build,
            receiver->scene, receiver->is_float ? "float" : "double",
            receiver->dt);
    cli_say("parameters %08" PRIx32 "\n", receiver->hash);
  }
  cli_say("frames     %" PRIu32 " in %" PRIu64 " bytes, %" PRIu64
          " rows, %" PRIu64 " without a match, %" PRIu64 " unknown\n",
          decoder->frames, seen->bytes, receiver->rows,
          receiver->incomplete + receiver->has_state, receiver->unknown);
  cli_say("line       %" PRIu32 " lost, %" PRIu32 " broken, %" PRIu32
          " too long, %" PRIu32 " of another version, %" PRIu32
          " restarts, %" PRIu64 " changes of the run\n",
          decoder->lost, decoder->bad, decoder->too_long, decoder->bad_version,
          decoder->restarts, receiver->other_runs);
  if (receiver->has_heartbeat) {
    print_board(&receiver->heartbeat);
  }
  if (seen->has_report || receiver->has_heartbeat) {
    const tf_tally_t tally = cli_seen_flagged(seen);
    cli_tally_print(
        &tally, "first reported",
        cli_tally_reserved(&seen->reported) > 0 ? seen->first : (double)NAN);
  }
  if (receiver->has_schema && receiver->rows > 0) {
    cli_say("last       step %" PRIu64
            ", r = %.9g m, v = %.9g m/s, omega = %.9g rad/s, %s\n",
            receiver->tick, receiver->state[0], receiver->state[1],
            receiver->state[2], tf_mode_name(receiver->mode));
  }
  if (seen->not_finite > 0) {
    cli_say("values     %" PRIu64
            " rows with one that is not finite, first at step %" PRIu64 "\n",
            seen->not_finite, seen->first_tick);
  }
}

static void put_sender(const cli_receiver_t *receiver) {
  if (!receiver->has_schema) {
    cli_put_double("sender", (double)NAN);
    return;
  }
  cli_put_text("sender", receiver->build);
  cli_put_text("scene", receiver->scene);
  cli_put_word("number", receiver->is_float ? "float" : "double");
  cli_put_hash("parameters", receiver->hash);
  cli_put_double("dt", receiver->dt);
}

static void put_line(const cli_seen_t *seen) {
  const cli_receiver_t *receiver = &seen->receiver;
  const tf_decoder_t *decoder = &seen->decoder;
  cli_put_count("bytes", seen->bytes);
  cli_put_count("frames", decoder->frames);
  cli_put_count("rows", receiver->rows);
  cli_put_count("unmatched", receiver->incomplete + receiver->has_state);
  cli_put_count("unknown", receiver->unknown);
  cli_put_count("lost", decoder->lost);
  cli_put_count("broken", decoder->bad);
  cli_put_count("too_long", decoder->too_long);
  cli_put_count("other_version", decoder->bad_version);
  cli_put_count("restarts", decoder->restarts);
  cli_put_count("other_runs", receiver->other_runs);
  cli_put_count("missing", cli_seen_missing(seen));
  cli_put_count("not_finite", seen->not_finite);
}

static void put_board(const cli_receiver_t *receiver) {
  const tf_heartbeat_t *beat = &receiver->heartbeat;
  if (!receiver->has_heartbeat) {
    cli_put_double("board", (double)NAN);
    return;
  }
  cli_say("\"board\": {");
  cli_put_count("steps", beat->steps);
  cli_put_count("overruns", beat->overruns);
  cli_put_count("skipped", beat->skipped);
  cli_put_count("dropped", beat->dropped);
  cli_put_count("expired", beat->expired);
  cli_put_count("exec_min_ns", beat->exec_min);
  cli_put_count("exec_mean_ns", beat->exec_mean);
  cli_put_count("exec_max_ns", beat->exec_max);
  cli_say("\"refused\": %" PRIu32 "}, ", beat->refused);
}

static void put_last(const cli_receiver_t *receiver) {
  if (!receiver->has_schema || receiver->rows == 0) {
    cli_put_double("last", (double)NAN);
    return;
  }
  cli_say("\"last\": {");
  cli_put_count("step", receiver->tick);
  for (int i = 0; i < 3; i++) {
    static const char *const names[] = {"r", "v", "omega"};
    cli_put_number(names[i], receiver->state[i], receiver->is_float);
    cli_say(", ");
  }
  cli_say("\"mode\": \"%s\"}, ", tf_mode_name(receiver->mode));
}

void cli_seen_put(const cli_seen_t *seen, int code) {
  const tf_tally_t tally = cli_seen_flagged(seen);
  cli_say("{");
  cli_put_word("version", TF_VERSION);
  cli_put_word("commit", cli_commit);
  cli_put_word("command", "monitor");
  cli_put_text("source", seen->source);
  put_sender(&seen->receiver);
  put_line(seen);
  put_board(&seen->receiver);
  cli_tally_put(&tally);
  put_last(&seen->receiver);
  cli_put_exit(code);
}

size_t cli_received_provenance(const cli_receiver_t *receiver,
                               char out[CLI_RECEIVED_ROOM]) {
  char dt[CLI_REAL_ROOM];
  (void)cli_write_number(dt, receiver->dt, receiver->is_float);
  return (size_t)snprintf(
      out, CLI_RECEIVED_ROOM,
      "# twofold %s, commit %s, rows of a stream, numbers are %s\n"
      "# scene %s, parameters %08" PRIx32
      "\n"
      "# sender %s, dt %s s\n"
      "# units: " CLI_CSV_UNITS "\n",
      TF_VERSION, cli_commit, receiver->is_float ? "float" : "double",
      receiver->has_schema ? receiver->scene : "not known", receiver->hash,
      receiver->has_schema ? receiver->build : "not known", dt);
}
