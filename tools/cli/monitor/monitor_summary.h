/// @file
/// What `monitor` says of a stream at its end, and of the rows before them.
#ifndef TWOFOLD_CLI_MONITOR_SUMMARY_H
#define TWOFOLD_CLI_MONITOR_SUMMARY_H

#include "damage.h"
#include "flagged.h"
#include "receiver.h"

typedef struct {
  const char *source; ///< name of the file or device
  const cli_receiver_t *receiver;
  const tf_decoder_t *decoder;
  const cli_damage_t *damage;
  const cli_flagged_t *flagged;
  uint64_t bytes;
} cli_seen_t;

/// The summary for a person, on standard error.
void cli_seen_print(const cli_seen_t *seen);

/// The same as one line of JSON, with the exit code.
void cli_seen_put(const cli_seen_t *seen, int code);

#define CLI_RECEIVED_ROOM 1024

/// Four lines that begin with #, as cli_provenance() writes them: this program;
/// scene, hash of the parameters and number type of the sender; its step and
/// its build; units.
/// Returns: the length.
size_t cli_received_provenance(const cli_receiver_t *receiver,
                               char out[CLI_RECEIVED_ROOM]);

#endif
