// Both forms of the summary have the same counts. What a board has not told is
// left out of the text and is null in JSON.

#include <inttypes.h>
#include <math.h>
#include <stdio.h>

#include "../run/row.h"
#include "../text/summary.h"
#include "../text/text.h"
#include "receiver.h"

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

void cli_receiver_print(const cli_receiver_t *receiver) {
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
    cli_put_double("sender", (double)NAN);
    return;
  }
  cli_put_word("sender", receiver->build);
  cli_put_word("scene", receiver->scene);
  cli_put_word("number", receiver->is_float ? "float" : "double");
  cli_put_hash("parameters", receiver->hash);
  cli_put_double("dt", receiver->dt);
}

static void put_line(const cli_receiver_t *receiver) {
  const tf_decoder_t *decoder = &receiver->decoder;
  cli_put_count("bytes", receiver->bytes);
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
  cli_put_count("missing", cli_receiver_missing(receiver));
  cli_put_count("not_finite", receiver->not_finite);
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

void cli_receiver_put(const cli_receiver_t *receiver, int code) {
  const tf_tally_t tally = cli_receiver_flagged(receiver);
  cli_say("{");
  cli_put_word("version", TF_VERSION);
  cli_put_word("commit", cli_commit);
  cli_put_word("command", "monitor");
  cli_put_word("source", receiver->source);
  put_sender(receiver);
  put_line(receiver);
  put_board(receiver);
  cli_tally_put(&tally);
  put_last(receiver);
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
