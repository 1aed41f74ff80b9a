// The twin responds to its own states, never to those of the board. From the
// board it takes only the ticks: of the samples, at which each input took
// effect, and at which inputs expired, since that is by the board's clock.
#include <math.h>
#include <string.h>

#include "board/hil/board.h"

typedef struct {
  hil_board_t *board;
  hil_verdict_t *verdict;
  tf_simulation_t simulation;
  size_t next;   // sample to compare next
  size_t effect; // sample whose input takes effect next
  size_t expiry; // to come
  double squares;
} twin_t;

// Whether a frame carries the given payload, by the frame that this one makes.
static bool carries(const uint8_t *wire, size_t size, uint64_t tick,
                    tf_type_t type, const uint8_t *payload, size_t length) {
  uint8_t again[TF_FRAME_SIZE(TF_REPORT_BYTES)];
  uint32_t sequence = 0;
  memcpy(again + TF_FRAME_AT, payload, length);
  return tf_frame_seal(again, (uint8_t)type, length, &sequence, tick) == size &&
         memcmp(again, wire, size) == 0;
}

static bool same(const tf_simulation_t *simulation,
                 const hil_sample_t *sample) {
  uint8_t wire[TF_FRAME_SIZE(TF_REPORT_BYTES)];
  const uint64_t tick = simulation->state.tick;
  uint32_t sequence = 0;
  size_t size = tf_send_state(wire, &sequence, &simulation->state);
  if (!carries(wire, size, tick, TF_DOWN_STATE, sample->state, TF_STATE_BYTES))
    return false;
  if (!sample->has_report) return true;
  sequence = 0;
  size = tf_send_report(wire, &sequence, tick, &simulation->report,
                        simulation->stepped);
  return carries(wire, size, tick, TF_DOWN_REPORT, sample->report,
                 TF_REPORT_BYTES);
}

static void note_difference(hil_verdict_t *verdict, uint64_t tick) {
  if (verdict->differ == 0 && verdict->wrong == 0) verdict->first = tick;
}

// Compares the twin with the sample of this tick: state, report and input.
static void compare(twin_t *twin) {
  hil_verdict_t *verdict = twin->verdict;
  hil_sample_t *sample = &twin->board->samples[twin->next];
  const tf_simulation_t *simulation = &twin->simulation;
  const tf_real_t error = HIL_SPEED - simulation->state.w;
  twin->squares += (double)error * (double)error;
  verdict->compared++;
  if (!same(simulation, sample)) {
    note_difference(verdict, sample->tick);
    verdict->differ++;
  }
  if (sample->sent) {
    sample->own = hil_control(&simulation->machine, &simulation->state);
    verdict->inputs++;
    // Five numbers, and nothing between them.
    if (memcmp(&sample->own, &sample->input, sizeof sample->own) != 0) {
      note_difference(verdict, sample->tick);
      verdict->wrong++;
    }
  }
  twin->next++;
}

// Applies the inputs that take effect at this tick.
static void apply(twin_t *twin) {
  const hil_board_t *board = twin->board;
  for (; twin->effect < twin->next; twin->effect++) {
    const hil_sample_t *sample = &board->samples[twin->effect];
    if (!sample->answered || sample->code != 0) continue;
    if (sample->effect > twin->simulation.state.tick) return;
    tf_simulation_set_input(&twin->simulation, &sample->own);
  }
}

// Inputs that expire before this step: the simulation finds none of their ticks
// left.
static void expire(twin_t *twin) {
  const hil_board_t *board = twin->board;
  while (twin->expiry < board->expired_count &&
         board->expired[twin->expiry] == twin->simulation.state.tick) {
    twin->simulation.left = 0;
    twin->expiry++;
  }
}

// Counts late, unanswered and missing inputs. Those that could not take effect
// within the run are not sent.
static void count_times(const hil_board_t *board, hil_verdict_t *verdict) {
  const hil_plan_t *plan = &board->plan;
  size_t met = 0;
  for (size_t i = 0; i < board->count; i++) {
    const hil_sample_t *sample = &board->samples[i];
    met += sample->sent;
    if (!sample->sent) continue;
    verdict->unanswered += !sample->answered;
    verdict->late +=
        sample->answered && sample->effect != sample->tick + plan->delay;
  }
  uint64_t end = plan->steps > plan->delay ? plan->steps - plan->delay : 0;
  if (end > plan->silent) end = plan->silent;
  if (end > 0) verdict->missing = (size_t)((end - 1) / plan->every + 1) - met;
}

int hil_twin_compare(hil_board_t *board, hil_verdict_t *verdict) {
  const uint64_t steps = board->plan.steps;
  static twin_t twin;
  twin = (twin_t){.board = board, .verdict = verdict};
  *verdict = (hil_verdict_t){0};
  count_times(board, verdict);
  if (tf_simulation_open(&twin.simulation, board->scene, &board->params,
                         board->seed) != TF_OK)
    return hil_message(CLI_REFUSED, "the scene cannot be started here");
  tf_simulation_t *simulation = &twin.simulation;
  simulation->deadman = (uint32_t)board->plan.deadman;
  while (simulation->state.tick <= steps) {
    const uint64_t tick = simulation->state.tick;
    while (twin.next < board->count && board->samples[twin.next].tick == tick)
      compare(&twin);
    apply(&twin);
    if (tick == steps) break;
    expire(&twin);
    const tf_input_t input = tf_simulation_input(simulation, board->scene);
    if (tf_step(&simulation->machine, &simulation->state, &input,
                &simulation->report) < 0)
      return hil_message(CLI_REFUSED, "step %lu is refused",
                         (unsigned long)tick);
  }
  verdict->end = simulation->state;
  verdict->expired = simulation->expired;
  if (verdict->compared > 0)
    verdict->rms_error = sqrt(twin.squares / (double)verdict->compared);
  // An input without an answer counts as one that never arrived.
  return verdict->differ || verdict->wrong || verdict->compared < 2
             ? HIL_DIFFERS
             : CLI_DONE;
}
