// The rows and the summary of a closed loop.
#include "hil/report.h"

#include <inttypes.h>
#include <stdio.h>

hil_code_t hil_write_csv(const hil_board_t *board, const char *name) {
  const int digits = TF_REAL_BYTES == 4 ? 9 : 17;
  FILE *file = fopen(name, "w");
  if (file == NULL) return hil_message(HIL_STOPPED, "%s: cannot write", name);
  (void)fputs("step,r,v,omega,mode,omega0,torque,effect\n", file);
  for (size_t i = 0; i < board->count; i++) {
    const hil_sample_t *sample = &board->samples[i];
    tf_state_t x;
    tf_read_state(sample->state, sample->tick, &x);
    (void)fprintf(file, "%" PRIu64 ",%.*g,%.*g,%.*g,%s", sample->tick, digits,
                  (double)x.r, digits, (double)x.v, digits, (double)x.w,
                  tf_mode_name(x.mode));
    if (sample->sent && sample->answered)
      (void)fprintf(file, ",%.*g,%.*g,%" PRIu64 "\n", digits,
                    (double)sample->input.omega0, digits,
                    (double)sample->input.torque, sample->effect);
    else
      (void)fputs(",,,\n", file);
  }
  const bool bad = ferror(file) != 0;
  if (fclose(file) != 0 || bad)
    return hil_message(HIL_STOPPED, "%s: cannot write", name);
  return HIL_EQUAL;
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
