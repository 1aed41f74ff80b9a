// The rows and the summary of a closed loop.
#include "board/hil/report.h"

#include <inttypes.h>
#include <stdio.h>

#include "cli/host/output.h"

#define ROW_ROOM 256

static size_t make_row(const hil_sample_t *sample, char row[ROW_ROOM]) {
  const int digits = TF_REAL_BYTES == 4 ? 9 : 17;
  tf_state_t x;
  tf_read_state(sample->state, sample->tick, &x);
  size_t used =
      (size_t)snprintf(row, ROW_ROOM, "%" PRIu64 ",%.*g,%.*g,%.*g,%s",
                       sample->tick, digits, (double)x.r, digits, (double)x.v,
                       digits, (double)x.w, tf_mode_name(x.mode));
  if (sample->sent && sample->answered)
    used += (size_t)snprintf(row + used, ROW_ROOM - used,
                             ",%.*g,%.*g,%" PRIu64 "\n", digits,
                             (double)sample->input.omega0, digits,
                             (double)sample->input.torque, sample->effect);
  else
    used += (size_t)snprintf(row + used, ROW_ROOM - used, ",,,\n");
  return used;
}

hil_code_t hil_write_csv(const hil_board_t *board, const char *name) {
  static const char header[] = "step,r,v,omega,mode,omega0,torque,effect\n";
  static cli_output_t output; // holds the buffer
  char row[ROW_ROOM];
  if (cli_output_open(&output, name)) {
    (void)cli_output_lines(&output, header, sizeof header - 1);
    for (size_t i = 0; i < board->count; i++)
      (void)cli_output_lines(&output, row, make_row(&board->samples[i], row));
    if (cli_output_close(&output, true)) return HIL_EQUAL;
  }
  return hil_message(HIL_STOPPED, "%s: %s", name, cli_output_reason(&output));
}

void hil_report(const hil_board_t *board, const hil_plan_t *plan,
                const hil_verdict_t *v) {
  const tf_state_t *end = &v->end;
  printf("board     scene %s, %s, dt = %g s, parameters %08" PRIx32 "\n",
         board->scene->name, TF_REAL_BYTES == 4 ? "float" : "double",
         (double)board->params.dt, tf_params_hash(&board->params));
  printf("loop      %" PRIu64 " steps, an input every %" PRIu32 " steps, ",
         plan->steps, plan->every);
  if (plan->in_lockstep)
    printf("in lockstep\n");
  else
    printf("in effect %" PRIu32 " steps later\n", plan->delay);
  printf("inputs    %zu: %zu late, %zu without an answer; %zu states missed; ",
         v->inputs, v->late, v->unanswered, v->missing);
  if (board->deadman == 0)
    printf("held without end");
  else
    printf("held for %" PRIu32 " steps", board->deadman);
  printf(", expired %" PRIu32 " times\n", v->expired);
  printf("line      %" PRIu32 " frames, %" PRIu32 " broken, %" PRIu32 " lost",
         board->decoder.frames, board->decoder.bad, board->decoder.lost);
  if (board->has_heartbeat)
    printf("; the board: %" PRIu32 " overruns, %" PRIu32 " dropped, %" PRIu32
           " broken or lost, %" PRIu32 " ignored; steps %" PRIu32
           " refused, %" PRIu32 " degraded, %" PRIu32 " coarse, %" PRIu32
           " fell back",
           board->heartbeat.overruns, board->heartbeat.dropped,
           board->heartbeat.bad, board->heartbeat.ignored,
           board->heartbeat.refused, board->heartbeat.degraded,
           board->heartbeat.coarse, board->heartbeat.fell_back);
  printf(
      "\ncontrol   omega off its set point by %.3g rad/s (rms); end: r = %.9g "
      "m, "
      "omega = %.9g rad/s, %s\n",
      v->rms_error, (double)end->r, (double)end->w, tf_mode_name(end->mode));
  if (v->differ + v->wrong > 0)
    printf(
        "host run  DIFFERS: %zu of %zu states, %zu of %zu inputs, first at "
        "step %" PRIu64 "\n",
        v->differ, v->compared, v->wrong, v->inputs, v->first);
  else
    printf("host run  %zu states and %zu inputs: the same bits%s\n",
           v->compared, v->inputs,
           v->late + v->missing > 0 ? ", late inputs as answered" : "");
}
