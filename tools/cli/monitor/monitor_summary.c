// Both forms of the summary have the same counts. What a board has not told is
// left out of the text and is null in JSON.

#include "monitor_summary.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>

#include "../run/row.h"
#include "../text/commit.h"
#include "../text/number.h"
#include "../text/summary.h"
#include "receiver.h"

static uint64_t larger(uint64_t a, uint64_t b) { return a > b ? a : b; }

// A board that was started again counts from 0, and what it reported before
// holds.
static void raise_to(tf_tally_t *tally, tf_tally_t least) {
  tally->degraded = larger(tally->degraded, least.degraded);
  tally->fell_back = larger(tally->fell_back, least.fell_back);
  tally->coarse = larger(tally->coarse, least.coarse);
  tally->stalled = larger(tally->stalled, least.stalled);
}

static void note_report(cli_flagged_t *flagged, const cli_receiver_t *receiver,
                        const cli_csv_t *row) {
  const bool repeats = flagged->has_report && flagged->tick == receiver->tick;
  flagged->has_report = true;
  flagged->tick = receiver->tick;
  if (repeats) {
    return;
  }
  const uint64_t none = cli_tally_reserved(&flagged->reported);
  tf_tally_count(&flagged->reported, receiver->tick, receiver->status);
  if (none == 0) {
    flagged->first = row->column[0];
  }
}

void cli_flagged_frame(cli_flagged_t *flagged, const tf_frame_t *frame,
                       const cli_receiver_t *receiver, const cli_csv_t *row) {
  if (frame->type == TF_DOWN_HEARTBEAT && receiver->has_heartbeat) {
    const tf_heartbeat_t *beat = &receiver->heartbeat;
    raise_to(&flagged->counted,
             (tf_tally_t){beat->degraded, beat->fell_back, beat->coarse,
                          beat->stalled, 0, 0});
  } else if (frame->type == TF_DOWN_REPORT && row != NULL) {
    note_report(flagged, receiver, row);
  }
}

// The steps that are known to be flagged.
static tf_tally_t flagged_tally(const cli_flagged_t *flagged) {
  tf_tally_t tally = flagged->counted;
  raise_to(&tally, flagged->reported);
  return tally;
}

// Prints the line of the summary if the stream has any status.
static void print_flagged(const cli_flagged_t *flagged,
                          const cli_receiver_t *receiver) {
  const tf_tally_t tally = flagged_tally(flagged),
                   *reported = &flagged->reported;
  if (flagged->has_report || receiver->has_heartbeat) {
    cli_tally_print(
        &tally, "first reported",
        cli_tally_reserved(reported) > 0 ? flagged->first : (double)NAN);
  }
}

int cli_flagged_code(const cli_flagged_t *flagged) {
  const tf_tally_t tally = flagged_tally(flagged);
  return cli_tally_code(&tally);
}

static void print_board(const tf_heartbeat_t *beat) {
  (void)fprintf(stderr,
                "board      %" PRIu32 " steps, %" PRIu32 " overruns, %" PRIu32
                " frames dropped, %" PRIu32 " steps refused",
                beat->steps, beat->overruns, beat->dropped, beat->refused);
  if (beat->exec_max > 0) {
    (void)fprintf(stderr,
                  "; a step takes %" PRIu32 " to %" PRIu32 " ns, mean %" PRIu32,
                  beat->exec_min, beat->exec_max, beat->exec_mean);
  }
  (void)fputc('\n', stderr);
  if (beat->expired > 0) {
    (void)fprintf(stderr,
                  "inputs     expired %" PRIu32
                  " times: nobody renewed them, the machine coasted\n",
                  beat->expired);
  }
}

void cli_seen_print(const cli_seen_t *seen) {
  const cli_receiver_t *receiver = &seen->receiver;
  const tf_decoder_t *decoder = &seen->decoder;
  if (receiver->has_schema) {
    (void)fprintf(stderr, "sender     %s, scene %s, %s, dt = %g s, ",
                  receiver->build, receiver->scene,
                  receiver->is_float ? "float" : "double", receiver->dt);
    (void)fprintf(stderr, "parameters %08" PRIx32 "\n", receiver->hash);
  }
  (void)fprintf(stderr,
                "frames     %" PRIu32 " in %" PRIu64 " bytes, %" PRIu64
                " rows, %" PRIu64 " without a match, %" PRIu64 " unknown\n",
                decoder->frames, seen->bytes, receiver->rows,
                receiver->incomplete + receiver->has_state, receiver->unknown);
  (void)fprintf(stderr,
                "line       %" PRIu32 " lost, %" PRIu32 " broken, %" PRIu32
                " too long, %" PRIu32 " of another version, %" PRIu32
                " restarts\n",
                decoder->lost, decoder->bad, decoder->too_long,
                decoder->bad_version, decoder->restarts);
  if (receiver->has_heartbeat) {
    print_board(&receiver->heartbeat);
  }
  print_flagged(&seen->flagged, receiver);
  if (receiver->has_schema && receiver->rows > 0) {
    (void)fprintf(stderr,
                  "last       step %" PRIu64
                  ", r = %.9g m, v = %.9g m/s, "
                  "omega = %.9g rad/s, %s\n",
                  receiver->tick, receiver->state[0], receiver->state[1],
                  receiver->state[2], tf_mode_name(receiver->mode));
  }
  if (seen->damage.not_finite > 0) {
    (void)fprintf(stderr,
                  "values     %" PRIu64
                  " rows with one that is not finite, first at step %" PRIu64
                  "\n",
                  seen->damage.not_finite, seen->damage.first_tick);
  }
}

static void put_sender(const cli_receiver_t *receiver) {
  if (!receiver->has_schema) {
    cli_put_null("sender");
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
  cli_put_count("missing",
                cli_damage_missing(&seen->damage, receiver, decoder));
  cli_put_count("not_finite", seen->damage.not_finite);
}

static void put_board(const cli_receiver_t *receiver) {
  const tf_heartbeat_t *beat = &receiver->heartbeat;
  if (!receiver->has_heartbeat) {
    cli_put_null("board");
    return;
  }
  (void)fputs("\"board\": {", stderr);
  cli_put_count("steps", beat->steps);
  cli_put_count("overruns", beat->overruns);
  cli_put_count("dropped", beat->dropped);
  cli_put_count("expired", beat->expired);
  cli_put_count("exec_min_ns", beat->exec_min);
  cli_put_count("exec_mean_ns", beat->exec_mean);
  cli_put_count("exec_max_ns", beat->exec_max);
  (void)fprintf(stderr, "\"refused\": %" PRIu32 "}, ", beat->refused);
}

static void put_last(const cli_receiver_t *receiver) {
  if (!receiver->has_schema || receiver->rows == 0) {
    cli_put_null("last");
    return;
  }
  (void)fputs("\"last\": {", stderr);
  cli_put_count("step", receiver->tick);
  cli_put_number("r", receiver->state[0], receiver->is_float);
  (void)fputs(", ", stderr);
  cli_put_number("v", receiver->state[1], receiver->is_float);
  (void)fputs(", ", stderr);
  cli_put_number("omega", receiver->state[2], receiver->is_float);
  (void)fprintf(stderr, ", \"mode\": \"%s\"}, ", tf_mode_name(receiver->mode));
}

void cli_seen_put(const cli_seen_t *seen, int code) {
  const tf_tally_t tally = flagged_tally(&seen->flagged);
  (void)fputs("{", stderr);
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
