// A few lines that stay in place. They are drawn at most ten times a second,
// which is enough for a person, so a fast stream costs no more than a slow one.

#include "view.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#define DRAW_EVERY 0.1 // [s]
#define LINES 9

void cli_view_note(cli_view_t *view, uint8_t mode) {
  if (view->used > 0 && view->history[view->used - 1] == mode) {
    return;
  }
  if (view->used == CLI_VIEW_HISTORY) {
    memmove(view->history, view->history + 1, CLI_VIEW_HISTORY - 1);
    view->used--;
  }
  view->history[view->used++] = mode;
}

static const char *source_name(uint8_t source) {
  static const char *const names[] = {"of the scene", "from outside", "safe"};
  return source < sizeof names / sizeof names[0] ? names[source] : "unknown";
}

static void draw(const cli_view_t *view, const cli_receiver_t *receiver,
                 const tf_decoder_t *decoder, const char *name) {
  static const char marks[TF_MODES + 1] = "+-PMo";
  const tf_heartbeat_t *beat = &receiver->heartbeat;
  char history[CLI_VIEW_HISTORY + 1];
  for (size_t i = 0; i < view->used; i++) {
    history[i] = marks[view->history[i] < TF_MODES ? view->history[i] : 0];
  }
  history[view->used] = '\0';
  if (view->drawn) {
    (void)printf("\033[%dA", LINES);
  }
  (void)printf("\033[K%s: scene %s, %s, %s, dt = %g s, parameters %08" PRIx32
               "\n",
               name, receiver->has_schema ? receiver->scene : "not known yet",
               receiver->is_float ? "float" : "double", receiver->build,
               receiver->dt, receiver->hash);
  (void)printf("\033[Kstep %" PRIu64 ", t = %.6g s, mode %s, %u possible\n",
               receiver->tick,
               receiver->base + (double)receiver->tick * receiver->dt,
               tf_mode_name(receiver->mode), (unsigned)receiver->choices);
  (void)printf("\033[Kr = %-12.6g v = %-12.6g omega = %-12.6g\n",
               receiver->state[0], receiver->state[1], receiver->state[2]);
  (void)printf("\033[Kh = %-12.6g g = %-12.6g F = %-12.6g M = %-12.6g\n",
               receiver->report[0], receiver->report[1], receiver->report[2],
               receiver->report[3]);
  (void)printf("\033[Kmodes %s  (+ - slip, P M stick, o pinned)\n", history);
  (void)printf("\033[Kline  %.0f frames/s; %" PRIu32 " frames, %" PRIu32
               " broken, %" PRIu32 " lost\n",
               view->rate, decoder->frames,
               decoder->bad + decoder->too_long + decoder->bad_version,
               decoder->lost);
  (void)printf("\033[Kinputs %s; expired %" PRIu32 " times\n",
               source_name(receiver->source), beat->expired);
  if (!receiver->has_heartbeat) {
    (void)printf("\033[Kboard has not sent its counters\n\n");
    (void)fflush(stdout);
    return;
  }
  (void)printf("\033[Kboard %" PRIu32 " steps, %" PRIu32 " overruns, %" PRIu32
               " dropped, %" PRIu32 " refused; step %" PRIu32 "/%" PRIu32
               "/%" PRIu32 " ns of %" PRIu32 "\n",
               beat->steps, beat->overruns, beat->dropped, beat->refused,
               beat->exec_min, beat->exec_mean, beat->exec_max, beat->period);
  (void)printf("\033[Ksteps %" PRIu32 " degraded, %" PRIu32
               " missed the tolerance, %" PRIu32 " fell back on moreau\n",
               beat->degraded, beat->coarse, beat->fell_back);
  (void)fflush(stdout);
}

void cli_view_poll(cli_view_t *view, const cli_receiver_t *receiver,
                   const tf_decoder_t *decoder, const char *name, double now) {
  if (now < view->next) {
    return;
  }
  if (view->drawn && now > view->since) {
    view->rate = (double)(uint32_t)(decoder->frames - view->frames) /
                 (now - view->since);
  }
  view->since = now;
  view->frames = decoder->frames;
  view->next = now + DRAW_EVERY;
  draw(view, receiver, decoder, name);
  view->drawn = true;
}
