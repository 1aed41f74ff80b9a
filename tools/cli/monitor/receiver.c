// From payloads to numbers. The schema has the sender's real type, and every
// length is checked against it.

#include "receiver.h"

#include <float.h>
#include <string.h>

// Where the step stands in a schema, after what does not depend on the type.
#define SCHEMA_DT 29u

static unsigned real_bytes(const cli_receiver_t *receiver) {
  return receiver->is_float ? 4 : 8;
}

double cli_receiver_real(const cli_receiver_t *receiver, const uint8_t *at) {
  if (receiver->is_float) {
    const uint32_t bits = (uint32_t)tf_wire_get(at, 4);
    float value = 0;
    memcpy(&value, &bits, sizeof value);
    return (double)value;
  }
  const uint64_t bits = tf_wire_get(at, 8);
  double value = 0;
  memcpy(&value, &bits, sizeof value);
  return value;
}

static const uint8_t *reals_at(const cli_receiver_t *receiver,
                               const uint8_t *at, double *values,
                               size_t count) {
  for (size_t i = 0; i < count; i++, at += real_bytes(receiver))
    values[i] = cli_receiver_real(receiver, at);
  return at;
}

// Copies the printable characters up to the zero or the end.
static const uint8_t *text_at(const uint8_t *at, const uint8_t *end,
                              char out[CLI_RECEIVED_TEXT]) {
  size_t length = 0;
  for (; at < end && *at != 0; at++)
    if (length + 1 < CLI_RECEIVED_TEXT && *at >= ' ' && *at <= '~')
      out[length++] = (char)*at;
  out[length] = '\0';
  return at < end ? at + 1 : end;
}

static void note_other(cli_receiver_t *receiver, uint64_t tick) {
  if (receiver->other_runs++ == 0) {
    receiver->between[0] = receiver->vouched;
    receiver->between[1] = tick;
  }
}

// Of a run all schemas and heartbeats have one hash.
static void note_run(cli_receiver_t *receiver, uint64_t tick, uint32_t run) {
  const bool is_first = !receiver->has_schema && !receiver->has_heartbeat;
  if (receiver->breaks || (!is_first && receiver->run != run))
    note_other(receiver, tick);
  receiver->run = run;
}

// The chain is known from number 0 on, or from a heartbeat, up to a frame that
// is missing, which the decoder counts.
static void note_chain(cli_receiver_t *receiver, const tf_frame_t *frame) {
  receiver->knows_chain &= frame->sequence == receiver->next;
  receiver->next = frame->sequence + 1u;
  receiver->breaks = false;
  if (!receiver->knows_chain && frame->sequence == 0) {
    receiver->knows_chain = true;
    receiver->chain = 0;
    receiver->vouched = frame->tick;
  }
  if (frame->type == TF_DOWN_HEARTBEAT && frame->length >= TF_HEARTBEAT_BYTES) {
    const uint32_t told =
        (uint32_t)tf_wire_get(frame->payload + TF_HEARTBEAT_BYTES - 4, 4);
    receiver->breaks = receiver->knows_chain && told != receiver->chain;
    receiver->knows_chain = true;
    receiver->chain = told;
  }
  receiver->chain =
      tf_frame_chain(receiver->chain, frame->payload + frame->length);
}

static bool take_schema(cli_receiver_t *receiver, const tf_frame_t *frame) {
  const uint8_t *at = frame->payload;
  const uint8_t *end = at + frame->length;
  if (frame->length < SCHEMA_DT + 4 || (at[0] != 4 && at[0] != 8) ||
      frame->length < SCHEMA_DT + at[0])
    return false;
  const double before = receiver->dt;
  receiver->is_float = at[0] == 4;
  receiver->hash = (uint32_t)tf_wire_get(at + 9, 4);
  receiver->ends = (at[4] & 32u) != 0;
  note_run(receiver, frame->tick, (uint32_t)tf_wire_get(at + 25, 4));
  const uint32_t session = (uint32_t)tf_wire_get(at + 13, 4);
  if (receiver->session != 0 && session != receiver->session)
    note_other(receiver, frame->tick); // of another start of a board
  receiver->session = session;
  receiver->sequence = (uint32_t)tf_wire_get(at + 17, 4);
  receiver->schemas++;
  at = reals_at(receiver, at + SCHEMA_DT, &receiver->dt, 1);
  at = text_at(at, end, receiver->scene);
  (void)text_at(at, end, receiver->build);
  if (!receiver->has_schema && receiver->is_device) {
    receiver->unheard = receiver->missed;
    receiver->before = receiver->missed + receiver->incomplete;
  }
  if (frame->tick == 0 || !receiver->has_schema)
    receiver->base = 0;
  else if (before < receiver->dt || before > receiver->dt)
    receiver->base += (double)frame->tick * (before - receiver->dt);
  receiver->has_schema = true;
  return true;
}

static void take_state(cli_receiver_t *receiver, const tf_frame_t *frame) {
  receiver->incomplete += receiver->has_state;
  const uint8_t *at = reals_at(receiver, frame->payload, receiver->state, 4);
  receiver->tick = frame->tick;
  receiver->mode = at[4];
  receiver->has_state = true;
}

static void note_row(cli_receiver_t *receiver, const cli_csv_t *row) {
  bool finite = true;
  for (size_t i = 0; i < CLI_CSV_COLUMNS; i++)
    finite = finite && row->column[i] >= -DBL_MAX && row->column[i] <= DBL_MAX;
  if (!finite && receiver->not_finite++ == 0)
    receiver->first_tick = receiver->tick;
  const bool repeats =
      receiver->rows++ > 0 && receiver->last_reported == receiver->tick;
  receiver->last_reported = receiver->tick;
  if (repeats) return;
  if (receiver->status > TF_OK && !receiver->has_first) {
    receiver->has_first = true;
    receiver->first = row->column[0];
  }
  tf_tally_count(&receiver->reported, receiver->tick, receiver->status);
}

static bool take_report(cli_receiver_t *receiver, const tf_frame_t *frame,
                        cli_csv_t *row) {
  const uint8_t *at = reals_at(receiver, frame->payload, receiver->report, 6);
  const bool belongs = receiver->has_state && receiver->tick == frame->tick;
  if (!belongs || at[0] >= TF_MODES || at[1] >> TF_MODES != 0 ||
      at[2] > TF_MODES) {
    receiver->incomplete++;
    receiver->has_state = false;
    return false;
  }
  receiver->status = (tf_status_t)(at[3] < 128 ? at[3] : (int)at[3] - 256);
  receiver->has_state = false;
  receiver->mode = at[0];
  receiver->choices = at[2];
  const double t = receiver->base + (double)receiver->tick * receiver->dt;
  *row = (cli_csv_t){
      {receiver->is_float ? (double)(float)t : t, receiver->state[0],
       receiver->state[1], receiver->state[2], receiver->report[0],
       receiver->report[1], receiver->report[2], receiver->report[3]},
      receiver->is_float,
      receiver->mode,
      receiver->choices,
      at[1]};
  note_row(receiver, row);
  return true;
}

static uint64_t larger(uint64_t a, uint64_t b) { return a > b ? a : b; }

static tf_tally_t most(const tf_tally_t *a, const tf_tally_t *b) {
  return (tf_tally_t){.degraded = larger(a->degraded, b->degraded),
                      .fell_back = larger(a->fell_back, b->fell_back),
                      .coarse = larger(a->coarse, b->coarse),
                      .stalled = larger(a->stalled, b->stalled)};
}

// By how much a count of the board grew. One that went back is that of a board
// that was started again, and counts from 0; one that went on may have passed
// 2^32.
static uint32_t growth(uint32_t before, uint32_t now) {
  const uint32_t more = now - before;
  return more <= UINT32_MAX / 2 ? more : now;
}

static void take_heartbeat(cli_receiver_t *receiver, const tf_frame_t *frame) {
  tf_heartbeat_t *beat = &receiver->heartbeat;
  const tf_heartbeat_t before = *beat;
  tf_read_heartbeat(frame->payload, beat);
  note_run(receiver, frame->tick, beat->run);
  if (receiver->has_heartbeat) {
    receiver->dropped += growth(before.dropped, beat->dropped);
    receiver->skipped += growth(before.skipped, beat->skipped);
  }
  receiver->has_heartbeat = true;
  receiver->vouched = frame->tick;
  // What a board reported before it was started again holds.
  const tf_tally_t told = {.degraded = beat->degraded,
                           .fell_back = beat->fell_back,
                           .coarse = beat->coarse,
                           .stalled = beat->stalled};
  receiver->told = most(&receiver->told, &told);
}

// Bytes of a payload of fixed length; 0 where the length depends on the data.
static unsigned length_of(const cli_receiver_t *receiver, uint8_t type) {
  static const struct {
    unsigned reals, bytes;
  } parts[] = {[TF_DOWN_STATE] = {4, 5},
               [TF_DOWN_REPORT] = {6, 5},
               [TF_DOWN_HEARTBEAT] = {0, TF_HEARTBEAT_BYTES},
               [TF_DOWN_EXPIRED] = {0, TF_EXPIRED_BYTES}};
  return type < sizeof parts / sizeof parts[0]
             ? parts[type].reals * real_bytes(receiver) + parts[type].bytes
             : 0;
}

// The decoder counts modulo 2^32: so does this sum, and a frame adds far less.
static uint32_t newly_damaged(const cli_receiver_t *receiver) {
  const tf_decoder_t *decoder = &receiver->decoder;
  return decoder->lost + decoder->bad + decoder->too_long +
         decoder->bad_version - receiver->counted;
}

uint64_t cli_receiver_lost(const cli_receiver_t *receiver) {
  return receiver->missed + newly_damaged(receiver) - receiver->unheard;
}

uint64_t cli_receiver_missing(const cli_receiver_t *receiver) {
  return receiver->missed + newly_damaged(receiver) + receiver->incomplete +
         receiver->has_state - receiver->before + receiver->dropped;
}

tf_tally_t cli_receiver_flagged(const cli_receiver_t *receiver) {
  return most(&receiver->told, &receiver->reported);
}

bool cli_receiver_take(cli_receiver_t *receiver, const tf_frame_t *frame,
                       cli_csv_t *row) {
  const bool is_row =
      frame->type == TF_DOWN_STATE || frame->type == TF_DOWN_REPORT;
  const uint32_t damaged = newly_damaged(receiver);
  receiver->missed += damaged;
  receiver->counted += damaged;
  receiver->ended = frame->type == TF_DOWN_HEARTBEAT;
  note_chain(receiver, frame);
  if (is_row && !receiver->has_schema) {
    // A report belongs to the state before it, which counts for both.
    receiver->incomplete += frame->type != TF_DOWN_REPORT || !receiver->early;
    receiver->early = frame->type == TF_DOWN_STATE;
    return false;
  }
  const unsigned length = length_of(receiver, frame->type);
  const unsigned tag = tf_is_vouched_for(frame->type) ? TF_TAG_BYTES : 0;
  if (length != 0 && length != frame->length && length + tag != frame->length) {
    receiver->unknown++;
    return false;
  }
  switch (frame->type) {
    case TF_DOWN_SCHEMA:
      receiver->unknown += !take_schema(receiver, frame);
      return false;
    case TF_DOWN_STATE:
      take_state(receiver, frame);
      return false;
    case TF_DOWN_REPORT:
      return take_report(receiver, frame, row);
    case TF_DOWN_HEARTBEAT:
      take_heartbeat(receiver, frame);
      return false;
    case TF_DOWN_ANSWER:
    case TF_DOWN_EXPIRED:
    case TF_DOWN_LAYOUT:
      return false;
    default:
      receiver->unknown++;
      return false;
  }
}
