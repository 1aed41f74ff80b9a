// From payloads to numbers. The real type is the sender's: it is read off the
// schema, and every length is checked against it.

#include "picture.h"

#include <string.h>

static unsigned real_bytes(const cli_picture_t *picture) {
  return picture->is_float ? 4 : 8;
}

double cli_picture_real(const cli_picture_t *picture, const uint8_t *at) {
  if (picture->is_float) {
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

static const uint8_t *reals_at(const cli_picture_t *picture, const uint8_t *at,
                               double *values, size_t count) {
  for (size_t i = 0; i < count; i++, at += real_bytes(picture)) {
    values[i] = cli_picture_real(picture, at);
  }
  return at;
}

// Text up to its zero or the end, of which only what can be shown.
static const uint8_t *text_at(const uint8_t *at, const uint8_t *end,
                              char out[CLI_PICTURE_TEXT]) {
  size_t length = 0;
  for (; at < end && *at != 0; at++) {
    if (length + 1 < CLI_PICTURE_TEXT && *at >= ' ' && *at <= '~') {
      out[length++] = (char)*at;
    }
  }
  out[length] = '\0';
  return at < end ? at + 1 : end;
}

static bool take_schema(cli_picture_t *picture, const tf_frame_t *frame) {
  const uint8_t *at = frame->payload;
  const uint8_t *end = at + frame->length;
  if (frame->length < 17 || (at[0] != 4 && at[0] != 8) ||
      frame->length < 13u + at[0]) {
    return false;
  }
  const double before = picture->dt;
  picture->is_float = at[0] == 4;
  picture->hash = (uint32_t)tf_wire_get(at + 9, 4);
  at = reals_at(picture, at + 13, &picture->dt, 1);
  at = text_at(at, end, picture->scene);
  (void)text_at(at, end, picture->build);
  if (frame->tick == 0 || !picture->has_schema) {
    picture->base = 0;
  } else if (before < picture->dt || before > picture->dt) {
    picture->base += (double)frame->tick * (before - picture->dt);
  }
  picture->has_schema = true;
  return true;
}

static double time_of(const cli_picture_t *picture) {
  const double t = picture->base + (double)picture->tick * picture->dt;
  return picture->is_float ? (double)(float)t : t;
}

static void fill_row(const cli_picture_t *picture, size_t columns,
                     cli_csv_t *row) {
  *row = (cli_csv_t){{time_of(picture), picture->state[0], picture->state[1],
                      picture->state[2], picture->report[0], picture->report[1],
                      picture->report[2], picture->report[3]},
                     columns,
                     picture->is_float,
                     picture->mode,
                     picture->choices};
}

static void take_state(cli_picture_t *picture, const tf_frame_t *frame) {
  picture->incomplete += picture->has_state;
  const uint8_t *at = reals_at(picture, frame->payload, picture->state, 4);
  picture->tick = frame->tick;
  picture->mode = at[4];
  picture->has_state = true;
}

static bool take_report(cli_picture_t *picture, const tf_frame_t *frame,
                        cli_csv_t *row) {
  const uint8_t *at = reals_at(picture, frame->payload, picture->report, 6);
  const bool belongs = picture->has_state && picture->tick == frame->tick;
  if (!belongs || at[0] >= TF_MODES || at[2] > TF_MODES) {
    picture->incomplete++;
    picture->has_state = false;
    return false;
  }
  picture->mode = at[0];
  picture->choices = at[2];
  picture->has_state = false;
  picture->rows++;
  fill_row(picture, CLI_CSV_COLUMNS, row);
  return true;
}

static bool take_compact(cli_picture_t *picture, const tf_frame_t *frame,
                         cli_csv_t *row) {
  const uint8_t *at = reals_at(picture, frame->payload, picture->state, 3);
  if (at[0] >= TF_MODES || at[1] > TF_MODES) {
    picture->incomplete++;
    return false;
  }
  picture->tick = frame->tick;
  picture->mode = at[0];
  picture->choices = at[1];
  picture->rows++;
  fill_row(picture, 4, row);
  return true;
}

static void take_heartbeat(cli_picture_t *picture, const tf_frame_t *frame) {
  tf_heartbeat_t *beat = &picture->heartbeat;
  uint32_t *const counters[10] = {
      &beat->steps,    &beat->refused, &beat->overruns, &beat->dropped,
      &beat->bad,      &beat->ignored, &beat->exec_min, &beat->exec_mean,
      &beat->exec_max, &beat->period};
  for (size_t i = 0; i < 10; i++) {
    *counters[i] = (uint32_t)tf_wire_get(frame->payload + 4 * i, 4);
  }
  picture->has_heartbeat = true;
}

// Bytes of a payload of fixed length; 0 where that hangs on its content.
static unsigned length_of(const cli_picture_t *picture, uint8_t type) {
  const unsigned R = real_bytes(picture);
  switch (type) {
    case TF_DOWN_STATE:
      return 4 * R + 5;
    case TF_DOWN_REPORT:
      return 6 * R + 4;
    case TF_DOWN_COMPACT:
      return 3 * R + 2;
    case TF_DOWN_HEARTBEAT:
      return TF_HEARTBEAT_BYTES;
    default:
      return 0;
  }
}

static bool is_row(uint8_t type) {
  return type == TF_DOWN_STATE || type == TF_DOWN_REPORT ||
         type == TF_DOWN_COMPACT;
}

bool cli_picture_take(cli_picture_t *picture, const tf_frame_t *frame,
                      cli_csv_t *row) {
  if (is_row(frame->type) && !picture->has_schema) {
    picture->incomplete += frame->type != TF_DOWN_REPORT;
    return false;
  }
  const unsigned length = length_of(picture, frame->type);
  if (length != 0 && length != frame->length) {
    picture->unknown++;
    return false;
  }
  switch (frame->type) {
    case TF_DOWN_SCHEMA:
      picture->unknown += !take_schema(picture, frame);
      return false;
    case TF_DOWN_STATE:
      take_state(picture, frame);
      return false;
    case TF_DOWN_REPORT:
      return take_report(picture, frame, row);
    case TF_DOWN_COMPACT:
      return take_compact(picture, frame, row);
    case TF_DOWN_HEARTBEAT:
      take_heartbeat(picture, frame);
      return false;
    case TF_DOWN_ANSWER:
    case TF_DOWN_LAYOUT:
    case TF_DOWN_PARAMETER:
      return false;
    default:
      picture->unknown++;
      return false;
  }
}
