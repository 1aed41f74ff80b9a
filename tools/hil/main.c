// Hardware in the loop: a controller on this machine, the simulated machine on
// a board, a serial line between them; and the proof that the closed loop is
// what a pure run on this machine computes, bit for bit:
//   hil DEVICE [OPTION...]        `hil` alone lists the options
// docs/HIL.md says why it is deterministic.
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/host.h"
#include "hil/board.h"
#include "hil/control.h"
#include "hil/twin.h"

#define PATIENCE 5.0  // without a state [s]
#define TRIES 8       // of an input to a board that stands
#define OUTSTANDING 3 // inputs that the board may hold; its queue has four

typedef struct {
  const char *device, *csv;
  uint64_t baud;
  hil_plan_t plan;
  hil_control_t control;
} options_t;

static hil_code_t usage(void) {
  (void)fputs(
      "hil DEVICE: drives the board at the other end of a serial line\n"
      "  --baud B        speed of the line; else as it is\n"
      "  --steps N       to take (2000)\n"
      "  --every N       steps from input to input (10): a multiple of what\n"
      "                  lies between two states of the board (its EVERY)\n"
      "  --delay N       steps from a state to the effect of its input, at\n"
      "                  most twice --every (20)\n"
      "  --lockstep      no delay: the board stands until its input is there\n"
      "  --speed W       wished of the disc [rad/s] (-0.9)\n"
      "  --gain G        of the turntable's speed (0.1)\n"
      "  --brake B       torque over speed where too fast [N m s] (0.2)\n"
      "  --csv FILE      what was read and sent\n"
      "Exit codes: 0 the loop has the bits of a pure host run, 1 it has not,\n"
      "2 usage, 3 not a board for this, 4 the line failed.\n",
      stderr);
  return HIL_USAGE;
}

static bool whole(const char *text, uint64_t least, uint64_t most,
                  uint64_t *value) {
  char *end = NULL;
  *value = strtoull(text, &end, 10);
  return text[0] >= '0' && text[0] <= '9' && *end == '\0' && *value >= least &&
         *value <= most;
}

static bool number(const char *text, tf_real_t *value) {
  char *end = NULL;
  const double read = strtod(text, &end);
  *value = (tf_real_t)read;
  return end != text && *end == '\0' && read > -1e6 && read < 1e6;
}

// Returns: whether the option is known and its value good.
static bool read_option(options_t *options, const char *name,
                        const char *value) {
  uint64_t n = 0;
  if (!strcmp(name, "--baud"))
    return whole(value, 1, 100000000, &options->baud);
  if (!strcmp(name, "--steps"))
    return whole(value, 1, 10000000, &options->plan.steps);
  if (!strcmp(name, "--every") || !strcmp(name, "--delay")) {
    const bool every = name[2] == 'e';
    const bool good = whole(value, every, 65536, &n);
    *(every ? &options->plan.every : &options->plan.delay) = (uint32_t)n;
    return good;
  }
  if (!strcmp(name, "--speed")) return number(value, &options->control.speed);
  if (!strcmp(name, "--gain")) return number(value, &options->control.gain);
  if (!strcmp(name, "--brake")) return number(value, &options->control.brake);
  if (!strcmp(name, "--csv")) options->csv = value;
  return !strcmp(name, "--csv");
}

static hil_code_t read_options(options_t *options, int argc, char **argv) {
  *options = (options_t){.plan = {2000, 10, 20, false},
                         .control = {TF_R(-0.9), TF_R(0.1), TF_R(0.2)}};
  for (int i = 1; i < argc; i++) {
    if (!strcmp(argv[i], "--lockstep")) {
      options->plan.in_lockstep = true;
    } else if (argv[i][0] != '-') {
      options->device = argv[i];
    } else if (i + 1 == argc || !read_option(options, argv[i], argv[i + 1])) {
      return hil_complain(HIL_USAGE, "%s %s: not understood", argv[i],
                          i + 1 < argc ? argv[i + 1] : "");
    } else {
      i++;
    }
  }
  if (options->plan.in_lockstep) options->plan.delay = 0;
  if (options->plan.delay > 2 * options->plan.every)
    return hil_complain(HIL_USAGE, "--delay is at most twice --every");
  return options->device == NULL ? usage() : HIL_EQUAL;
}

// At rest, at the start of its scene, and known. What another host left in the
// queue is cleared; frames on their way are let pass until an answer comes.
static hil_code_t prepare(hil_board_t *board) {
  static const tf_type_t orders[] = {TF_UP_STOP, TF_UP_RESET, TF_UP_DESCRIBE};
  hil_code_t code = hil_board_send(board, TF_UP_CLEAR, 0, NULL, 0);
  for (size_t i = 0; i < 3 && code == HIL_EQUAL; i++)
    code = hil_board_order(board, orders[i]);
  const double until = cli_now() + PATIENCE;
  board->listens = true;
  while (code == HIL_EQUAL && !(board->has_schema && board->count > 0)) {
    code = hil_board_listen(board, 100);
    if (code == HIL_EQUAL && cli_now() > until)
      code = hil_complain(HIL_STOPPED, "the board tells no state");
  }
  if (code == HIL_EQUAL && board->samples[0].tick != 0)
    code = hil_complain(HIL_STOPPED, "the board did not go to its start");
  return code;
}

static uint64_t last_tick(const hil_board_t *board) {
  return board->samples[board->count - 1].tick;
}

static hil_code_t wait_for_state(hil_board_t *board) {
  const double until = cli_now() + PATIENCE;
  while (!board->has_new) {
    const hil_code_t code = hil_board_listen(board, 100);
    if (code != HIL_EQUAL) return code;
    if (!board->has_new && cli_now() > until)
      return hil_complain(HIL_STOPPED, "no state after step %" PRIu64,
                          last_tick(board));
  }
  return HIL_EQUAL;
}

// What stays without one is told at the end.
static hil_code_t wait_for_answers(hil_board_t *board, double patience) {
  const double until = cli_now() + patience;
  hil_code_t code = HIL_EQUAL;
  while (code == HIL_EQUAL && hil_board_waiting(board) > 0 && cli_now() < until)
    code = hil_board_listen(board, 100);
  return code;
}

// The input for the newest state, if the board has room for it.
static hil_code_t respond(hil_board_t *board, const options_t *options) {
  const hil_plan_t *plan = &options->plan;
  hil_sample_t *sample = &board->samples[board->count - 1];
  tf_machine_t machine;
  tf_state_t state;
  board->has_new = false;
  if (sample->tick + plan->delay >= plan->steps ||
      hil_board_waiting(board) >= OUTSTANDING)
    return HIL_EQUAL;
  (void)tf_prepare(&machine, &board->params, NULL);
  tf_read_state(sample->state, sample->tick, &state);
  sample->input = hil_control(&options->control, &machine, &state);
  return hil_board_drive(board, sample, sample->tick + plan->delay);
}

// The stop comes first: from the start on the board does not wait for us.
static hil_code_t respond_in_lockstep(hil_board_t *board,
                                      const options_t *options) {
  const uint64_t tick = last_tick(board);
  if (tick != (board->count - 1) * options->plan.every)
    return hil_complain(HIL_STOPPED, "step %" PRIu64 ": a command was lost",
                        tick);
  hil_code_t code =
      hil_board_send(board, TF_UP_STOP, tick + options->plan.every, NULL, 0);
  // The board stands: an input that is said twice takes effect once.
  for (int tries = 0; code == HIL_EQUAL && tries < TRIES; tries++) {
    code = respond(board, options);
    if (code == HIL_EQUAL) code = wait_for_answers(board, 0.5);
    if (hil_board_waiting(board) == 0) break;
  }
  return code == HIL_EQUAL ? hil_board_order(board, TF_UP_START) : code;
}

static hil_code_t drive(hil_board_t *board, const options_t *options) {
  const hil_plan_t *plan = &options->plan;
  hil_code_t code = HIL_EQUAL;
  board->has_new = true; // the start
  while (code == HIL_EQUAL && last_tick(board) < plan->steps &&
         board->count < board->room) {
    if (board->has_new)
      code = plan->in_lockstep ? respond_in_lockstep(board, options)
                               : respond(board, options);
    if (code == HIL_EQUAL && last_tick(board) == 0 && !plan->in_lockstep)
      code = hil_board_order(board, TF_UP_START);
    if (code == HIL_EQUAL) code = wait_for_state(board);
  }
  if (code != HIL_EQUAL) return code;
  code = hil_board_order(board, TF_UP_STOP);
  return code == HIL_EQUAL ? wait_for_answers(board, 1) : code;
}

static hil_code_t write_csv(const hil_board_t *board, const char *name) {
  const int digits = TF_REAL_BYTES == 4 ? 9 : 17;
  FILE *file = fopen(name, "w");
  if (file == NULL) return hil_complain(HIL_STOPPED, "%s: cannot write", name);
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
    return hil_complain(HIL_STOPPED, "%s: cannot write", name);
  return HIL_EQUAL;
}

static void report(const hil_board_t *board, const options_t *options,
                   const hil_verdict_t *v) {
  const hil_plan_t *plan = &options->plan;
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
  printf("inputs    %zu: %zu late, %zu without an answer; %zu states missed\n",
         v->inputs, v->late, v->unanswered, v->missing);
  printf("line      %" PRIu32 " frames, %" PRIu32 " broken, %" PRIu32 " lost",
         board->decoder.frames, board->decoder.bad, board->decoder.lost);
  if (board->has_heartbeat)
    printf("; the board: %" PRIu32 " overruns, %" PRIu32 " dropped, %" PRIu32
           " broken or lost, %" PRIu32 " ignored",
           board->heartbeat.overruns, board->heartbeat.dropped,
           board->heartbeat.bad, board->heartbeat.ignored);
  printf(
      "\ncontrol   omega off its wish by %.3g rad/s (rms); end: r = %.9g m, "
      "omega = %.9g rad/s, %s\n",
      v->lacks, (double)end->r, (double)end->w, tf_mode_name(end->mode));
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

static hil_code_t perform(hil_board_t *board, const options_t *options) {
  hil_verdict_t verdict;
  tf_decoder_init(&board->decoder, board->buffer, sizeof board->buffer);
  if (!cli_source_open(&board->source, options->device, options->baud, true))
    return hil_complain(HIL_STOPPED, "%s: %s", options->device,
                        strerror(board->source.error));
  hil_code_t code = prepare(board);
  if (code == HIL_EQUAL) code = drive(board, options);
  cli_source_close(&board->source);
  if (code == HIL_EQUAL && options->csv != NULL)
    code = write_csv(board, options->csv);
  if (code != HIL_EQUAL) return code;
  code = hil_twin_compare(board, &options->plan, &options->control, &verdict);
  if (code == HIL_EQUAL || code == HIL_DIFFERS)
    report(board, options, &verdict);
  return code;
}

int main(int argc, char **argv) {
  options_t options;
  hil_code_t code = read_options(&options, argc, argv);
  if (code != HIL_EQUAL) return (int)code;
  hil_board_t *board = calloc(1, sizeof *board);
  if (board == NULL) return HIL_STOPPED;
  board->every = options.plan.every;
  board->room = (size_t)(options.plan.steps / options.plan.every) + 64;
  board->samples = calloc(board->room, sizeof *board->samples);
  if (board->samples != NULL) {
    cli_catch_signals();
    code = perform(board, &options);
    if (ferror(stdout) || fflush(stdout)) code = HIL_STOPPED;
  } else {
    code = hil_complain(HIL_STOPPED, "out of memory");
  }
  free(board->samples);
  free(board);
  return (int)code;
}
