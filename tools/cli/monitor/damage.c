// A file of frames and a pipe begin where the sender began: everything in them
// that is no frame is damage. A line does not: whoever starts to listen hears
// half a frame first, and states that mean nothing before the schema.

#include "damage.h"

#include <math.h>

static uint64_t missing_so_far(const cli_receiver_t *receiver,
                               const tf_decoder_t *decoder) {
  return (uint64_t)decoder->lost + decoder->bad + decoder->too_long +
         decoder->bad_version + receiver->incomplete;
}

void cli_damage_frame(cli_damage_t *damage, bool is_device,
                      const cli_receiver_t *receiver,
                      const tf_decoder_t *decoder) {
  if (receiver->has_schema && !damage->heard) {
    damage->heard = true;
    damage->before = is_device ? missing_so_far(receiver, decoder) : 0;
  }
  if (receiver->has_heartbeat) {
    // The board counts from its own start on, and again after a restart.
    const uint64_t told = receiver->heartbeat.dropped;
    if (damage->has_told && told > damage->last_told) {
      damage->dropped += told - damage->last_told;
    }
    damage->has_told = true;
    damage->last_told = told;
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
  return missing_so_far(receiver, decoder) + receiver->has_state -
         damage->before + damage->dropped;
}
