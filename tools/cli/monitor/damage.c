// A file of frames and a pipe begin where the sender began: everything in them
// that is not a frame is damage. A line does not: whoever starts to listen
// hears half a frame first, and states that mean nothing before the schema.

#include <math.h>

#include "monitor_summary.h"

// The decoder counts modulo 2^32: so does this sum, and a frame adds far less.
static uint32_t counted(const tf_decoder_t *decoder) {
  return decoder->lost + decoder->bad + decoder->too_long +
         decoder->bad_version;
}

static uint64_t missing_so_far(const cli_damage_t *damage,
                               const cli_receiver_t *receiver,
                               const tf_decoder_t *decoder) {
  return damage->missed + (uint32_t)(counted(decoder) - damage->last_counted) +
         receiver->incomplete;
}

// A count that went back is that of a board that was started again, and counts
// from 0; one that went on may have passed 2^32.
static void note_dropped(cli_damage_t *damage, uint32_t told) {
  const uint32_t more = told - damage->last_told;
  if (damage->has_told) {
    damage->dropped += more <= UINT32_MAX / 2 ? more : told;
  }
  damage->has_told = true;
  damage->last_told = told;
}

void cli_damage_frame(cli_damage_t *damage, bool is_device, uint8_t type,
                      const cli_receiver_t *receiver,
                      const tf_decoder_t *decoder) {
  damage->missed += (uint32_t)(counted(decoder) - damage->last_counted);
  damage->last_counted = counted(decoder);
  if (receiver->has_schema && !damage->heard) {
    damage->heard = true;
    damage->before = is_device ? missing_so_far(damage, receiver, decoder) : 0;
  }
  damage->is_open = receiver->ends && type != TF_DOWN_HEARTBEAT;
  if (receiver->has_heartbeat) {
    note_dropped(damage, receiver->heartbeat.dropped);
  }
}

void cli_damage_row(cli_damage_t *damage, const cli_csv_t *row, uint64_t tick) {
  bool finite = true;
  for (size_t i = 0; i < row->columns; i++) {
    finite = finite && isfinite(row->column[i]);
  }
  if (!finite && damage->not_finite++ == 0) {
    damage->first_tick = tick;
  }
}

uint64_t cli_damage_missing(const cli_damage_t *damage,
                            const cli_receiver_t *receiver,
                            const tf_decoder_t *decoder) {
  return missing_so_far(damage, receiver, decoder) + receiver->has_state -
         damage->before + damage->dropped;
}
