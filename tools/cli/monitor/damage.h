/// @file
/// What of a stream is missing or is not a number: the exit code of `monitor`.
#ifndef TWOFOLD_CLI_DAMAGE_H
#define TWOFOLD_CLI_DAMAGE_H

#include "receiver.h"

typedef struct {
  uint64_t missed;       ///< of what the decoder counts, without end
  uint32_t last_counted; ///< by the decoder, modulo 2^32
  uint64_t before;     ///< missing before a device was heard from its start on
  bool heard;          ///< the first schema has come
  uint64_t dropped;    ///< frames that the board itself dropped meanwhile
  uint32_t last_told;  ///< dropped frames as the last heartbeat has them
  bool has_told;       ///< there was one
  bool is_open;        ///< the stream has an end, which has not come yet
  uint64_t not_finite; ///< rows with a value that is not finite
  uint64_t first_tick; ///< of the first of these
} cli_damage_t;

/// Takes note of a frame of a type that the receiver has taken. is_device: the
/// stream began before it was read, so what came before the first schema is not
/// a loss.
void cli_damage_frame(cli_damage_t *damage, bool is_device, uint8_t type,
                      const cli_receiver_t *receiver,
                      const tf_decoder_t *decoder);

/// Takes note of a row.
void cli_damage_row(cli_damage_t *damage, const cli_csv_t *row, uint64_t tick);

/// Frames that were lost, broken or dropped, and states without their report.
uint64_t cli_damage_missing(const cli_damage_t *damage,
                            const cli_receiver_t *receiver,
                            const tf_decoder_t *decoder);

#endif
