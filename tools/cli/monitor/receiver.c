// From payloads to numbers. The schema has the sender's real type, and every
// length is checked against it.

#include "receiver.h"

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
  for (size_t i = 0; i < count; i++, at += real_bytes(receiver)) {
    values[i] = cli_receiver_real(receiver, at);
  }
  return at;
}

// Copies the printable characters up to the zero or the end.
static const uint8_t *text_at(const uint8_t *at, const uint8_t *end,
                              char out[CLI_RECEIVED_TEXT]) {
  size_t length = 0;
  for (; at < end && *at != 0; at++) {
    if (length + 1 < CLI_RECEIVED_TEXT && *at >= ' ' && *at <= '~') {
      out[length++] = (char)*at;
    }
  }
  out[length] = '\0';
  return at < end ? at + 1 : end;
}

// Of a run all schemas and heartbeats have one hash.
static void note_run(cli_receiver_t *receiver, uint32_t run) {
  receiver->other_runs += receiver->knows_run && receiver->run != run;
  receiver->knows_run = true;
  receiver->run = run;
}

// A session is that of one start, and the next one follows its last number; of
// a board with a key it may be any other.
static void note_session(cli_receiver_t *receiver, uint32_t session) {
  const uint32_t before = receiver->session;
  const uint32_t follows = before == UINT32_MAX ? 1 : before + 1u;
  receiver->other_runs += !receiver->is_tagged && before != 0 &&
                          session != before && session != follows;
  receiver->session = session;
}

// What comes before a schema, or stands for another start, is not of this one.
bool cli_receiver_open(cli_receiver_t *receiver, tf_frame_t *frame,
                       const uint8_t *key) {
  uint32_t session = 0;
  const bool begins = frame->type == TF_DOWN_SCHEMA && frame->length > 4;
  if (key == NULL) {
    const bool is_early = !receiver->has_schema &&
                          frame->length == TF_HEARTBEAT_BYTES + TF_TAIL_BYTES;
    if (begins ? (frame->payload[4] & 64u) != 0
               : receiver->is_tagged || is_early) {
      (void)tf_frame_untag(frame, NULL, &session);
    }
    return true;
  }
  const bool is_own = tf_frame_untag(frame, key, &session);
  const bool is_of_now = begins || session == receiver->session;
  receiver->forged += !is_own;
  receiver->unknown += is_own && !is_of_now;
  return is_own && is_of_now;
}

static bool take_schema(cli_receiver_t *receiver, const tf_frame_t *frame) {
  const uint8_t *at = frame->payload;
  const uint8_t *end = at + frame->length;
  if (frame->length < SCHEMA_DT + 4 || (at[0] != 4 && at[0] != 8) ||
      frame->length < SCHEMA_DT + at[0]) {
    return false;
  }
  const double before = receiver->dt;
  receiver->is_float = at[0] == 4;
  receiver->hash = (uint32_t)tf_wire_get(at + 9, 4);
  receiver->ends = (at[4] & 32u) != 0;
  receiver->is_tagged = (at[4] & 64u) != 0;
  note_run(receiver, (uint32_t)tf_wire_get(at + 25, 4));
  note_session(receiver, (uint32_t)tf_wire_get(at + 13, 4));
  receiver->sequence = (uint32_t)tf_wire_get(at + 17, 4);
  receiver->schemas++;
  at = reals_at(receiver, at + SCHEMA_DT, &receiver->dt, 1);
  at = text_at(at, end, receiver->scene);
  (void)text_at(at, end, receiver->build);
  if (frame->tick == 0 || !receiver->has_schema) {
    receiver->base = 0;
  } else if (before < receiver->dt || before > receiver->dt) {
    receiver->base += (double)frame->tick * (before - receiver->dt);
  }
  receiver->has_schema = true;
  return true;
}

static double time_of(const cli_receiver_t *receiver) {
  const double t = receiver->base + (double)receiver->tick * receiver->dt;
  return receiver->is_float ? (double)(float)t : t;
}

static void fill_row(const cli_receiver_t *receiver, size_t columns,
                     cli_csv_t *row) {
  *row =
      (cli_csv_t){{time_of(receiver), receiver->state[0], receiver->state[1],
                   receiver->state[2], receiver->report[0], receiver->report[1],
                   receiver->report[2], receiver->report[3]},
                  columns,
                  receiver->is_float,
                  receiver->mode,
                  receiver->choices};
}

static void take_state(cli_receiver_t *receiver, const tf_frame_t *frame) {
  receiver->incomplete += receiver->has_state;
  const uint8_t *at = reals_at(receiver, frame->payload, receiver->state, 4);
  receiver->tick = frame->tick;
  receiver->mode = at[4];
  receiver->has_state = true;
}

static bool take_report(cli_receiver_t *receiver, const tf_frame_t *frame,
                        cli_csv_t *row) {
  const uint8_t *at = reals_at(receiver, frame->payload, receiver->report, 6);
  const bool belongs = receiver->has_state && receiver->tick == frame->tick;
  if (!belongs || at[0] >= TF_MODES || at[2] > TF_MODES) {
    receiver->incomplete++;
    receiver->has_state = false;
    return false;
  }
  receiver->mode = at[0];
  receiver->choices = at[2];
  receiver->status = (tf_status_t)(at[3] < 128 ? at[3] : (int)at[3] - 256);
  receiver->has_state = false;
  receiver->rows++;
  fill_row(receiver, CLI_CSV_COLUMNS, row);
  return true;
}

static bool take_compact(cli_receiver_t *receiver, const tf_frame_t *frame,
                         cli_csv_t *row) {
  const uint8_t *at = reals_at(receiver, frame->payload, receiver->state, 3);
  if (at[0] >= TF_MODES || at[1] > TF_MODES) {
    receiver->incomplete++;
    return false;
  }
  receiver->tick = frame->tick;
  receiver->mode = at[0];
  receiver->choices = at[1];
  receiver->rows++;
  fill_row(receiver, 4, row);
  return true;
}

// Bytes of a payload of fixed length; 0 where the length depends on the data.
static unsigned length_of(const cli_receiver_t *receiver, uint8_t type) {
  const unsigned R = real_bytes(receiver);
  switch (type) {
    case TF_DOWN_STATE:
      return 4 * R + 5;
    case TF_DOWN_REPORT:
      return 6 * R + 5;
    case TF_DOWN_COMPACT:
      return 3 * R + 2;
    case TF_DOWN_HEARTBEAT:
      return TF_HEARTBEAT_BYTES;
    case TF_DOWN_EXPIRED:
      return TF_EXPIRED_BYTES;
    default:
      return 0;
  }
}

static bool is_row(uint8_t type) {
  return type == TF_DOWN_STATE || type == TF_DOWN_REPORT ||
         type == TF_DOWN_COMPACT;
}

bool cli_receiver_take(cli_receiver_t *receiver, const tf_frame_t *frame,
                       cli_csv_t *row) {
  if (is_row(frame->type) && !receiver->has_schema) {
    // A report belongs to the state before it, which counts for both.
    receiver->incomplete += frame->type != TF_DOWN_REPORT || !receiver->early;
    receiver->early = frame->type == TF_DOWN_STATE;
    return false;
  }
  const unsigned length = length_of(receiver, frame->type);
  if (length != 0 && length != frame->length) {
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
    case TF_DOWN_COMPACT:
      return take_compact(receiver, frame, row);
    case TF_DOWN_HEARTBEAT:
      tf_read_heartbeat(frame->payload, &receiver->heartbeat);
      note_run(receiver, receiver->heartbeat.run);
      receiver->has_heartbeat = true;
      return false;
    case TF_DOWN_ANSWER:
    case TF_DOWN_EXPIRED:
    case TF_DOWN_LAYOUT:
    case TF_DOWN_PARAMETER:
      return false;
    default:
      receiver->unknown++;
      return false;
  }
}
