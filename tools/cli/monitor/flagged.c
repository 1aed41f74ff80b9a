// Heartbeats and reports are about the same steps, so their counts are not
// added: of each count the larger one is what is known at least.

#include "flagged.h"

#include <math.h>

#include "../text/tally.h"

static uint64_t larger(uint64_t a, uint64_t b) { return a > b ? a : b; }

// A board that was started again counts from 0, and what it reported before
// holds.
static void note_heartbeat(tf_tally_t *counted, const tf_heartbeat_t *beat) {
  counted->degraded = larger(counted->degraded, beat->degraded);
  counted->fell_back = larger(counted->fell_back, beat->fell_back);
  counted->coarse = larger(counted->coarse, beat->coarse);
}

static void note_report(cli_flagged_t *flagged, const cli_receiver_t *receiver,
                        const cli_csv_t *row) {
  const bool repeats = flagged->has_report && flagged->tick == receiver->tick;
  flagged->has_report = true;
  flagged->tick = receiver->tick;
  if (repeats) {
    return;
  }
  const uint64_t none = flagged->reported.degraded +
                        flagged->reported.fell_back + flagged->reported.coarse;
  tf_tally_count(&flagged->reported, receiver->tick, receiver->status);
  if (none == 0) {
    flagged->first = row->column[0];
  }
}

void cli_flagged_frame(cli_flagged_t *flagged, const tf_frame_t *frame,
                       const cli_receiver_t *receiver, const cli_csv_t *row) {
  if (frame->type == TF_DOWN_HEARTBEAT && receiver->has_heartbeat) {
    note_heartbeat(&flagged->counted, &receiver->heartbeat);
  } else if (frame->type == TF_DOWN_REPORT && row != NULL) {
    note_report(flagged, receiver, row);
  }
}

tf_tally_t cli_flagged_tally(const cli_flagged_t *flagged) {
  tf_tally_t tally = flagged->counted;
  tally.degraded = larger(tally.degraded, flagged->reported.degraded);
  tally.fell_back = larger(tally.fell_back, flagged->reported.fell_back);
  tally.coarse = larger(tally.coarse, flagged->reported.coarse);
  return tally;
}

void cli_flagged_print(const cli_flagged_t *flagged,
                       const cli_receiver_t *receiver) {
  const tf_tally_t tally = cli_flagged_tally(flagged),
                   *reported = &flagged->reported;
  const bool is_reported =
      reported->degraded + reported->fell_back + reported->coarse > 0;
  if (flagged->has_report || receiver->has_heartbeat) {
    cli_tally_print(&tally, "first reported",
                    is_reported ? flagged->first : (double)NAN);
  }
}

int cli_flagged_code(const cli_flagged_t *flagged) {
  const tf_tally_t tally = cli_flagged_tally(flagged);
  return cli_tally_code(&tally);
}
