// Hardware in the loop: a controller on this computer, the simulated machine on
// a board, a serial line between them; and the proof that the closed loop has
// the bits of a run on this computer alone:
//   hil DEVICE [OPTION...]        `hil` alone lists the options
// docs/PORTS.md says why it is deterministic.
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "board/hil/board.h"
#include "cli/host/output.h"
#include "cli/text/text.h"

typedef struct {
  const char *device, *csv, *key;
  uint64_t baud;
  hil_plan_t plan;
} options_t;

static int usage(void) {
  (void)fputs(
      "hil DEVICE: drives the board at the other end of a serial line\n"
      "  --baud B        speed of the line; default: unchanged\n"
      "  --steps N       number of steps (2000)\n"
      "  --every N       steps from input to input (10): without --lockstep a\n"
      "                  multiple of those from state to state (its EVERY)\n"
      "  --delay N       steps from a state to the effect of its input, at\n"
      "                  most twice --every (20)\n"
      "  --lockstep      no delay: the board waits for its input\n"
      "  --deadman N     ticks that an input holds, 0 without end (the "
      "board's)\n"
      "  --silent N      sends no input from step N on, as one that failed\n"
      "  --key FILE      32 hexadecimal digits, for a board that wants tags\n"
      "  --csv FILE      states that were read, inputs that were sent\n"
      "Exit codes: 0 the loop has the bits of a pure host run, 1 it does not,\n"
      "2 usage, 3 the board cannot be driven, 4 the line failed.\n",
      stderr);
  return CLI_USAGE;
}

// Returns: whether the option is known and its value good.
static bool read_option(options_t *options, const char *name,
                        const char *value) {
  hil_plan_t *plan = &options->plan;
  const struct {
    const char *name;
    uint64_t low, high;
    uint64_t *number; // NULL: text
    const char **text;
  } known[] = {{"--baud", 1, 100000000, &options->baud, NULL},
               {"--steps", 1, 10000000, &plan->steps, NULL},
               {"--every", 1, 65536, &plan->every, NULL},
               {"--delay", 0, 65536, &plan->delay, NULL},
               {"--silent", 0, 10000000, &plan->silent, NULL},
               {"--deadman", 0, UINT32_MAX, &plan->deadman, NULL},
               {"--key", 0, 0, NULL, &options->key},
               {"--csv", 0, 0, NULL, &options->csv}};
  for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
    if (strcmp(name, known[i].name) != 0) continue;
    if (known[i].number != NULL)
      return cli_read_whole(value, known[i].low, known[i].high,
                            known[i].number);
    *known[i].text = value;
    return true;
  }
  return false;
}

static int read_options(options_t *options, int argc, char **argv) {
  *options = (options_t){.plan = {.steps = 2000,
                                  .every = 10,
                                  .delay = 20,
                                  .silent = UINT64_MAX,
                                  .deadman = HIL_BOARDS}};
  for (int i = 1; i < argc; i++) {
    if (!strcmp(argv[i], "--lockstep")) {
      options->plan.in_lockstep = true;
    } else if (argv[i][0] != '-') {
      options->device = argv[i];
    } else if (i + 1 == argc || !read_option(options, argv[i], argv[i + 1])) {
      return hil_message(CLI_USAGE, "%s %s: not understood", argv[i],
                         i + 1 < argc ? argv[i + 1] : "");
    } else {
      i++;
    }
  }
  if (options->plan.in_lockstep) options->plan.delay = 0;
  if (options->plan.delay > 2 * options->plan.every)
    return hil_message(CLI_USAGE, "--delay is at most twice --every");
  return options->device == NULL ? usage() : CLI_DONE;
}

#define ROW_ROOM 256

static size_t make_row(const hil_sample_t *sample, char row[ROW_ROOM]) {
  const int digits = TF_REAL_BYTES == 4 ? 9 : 17;
  char input[ROW_ROOM / 2] = ",,";
  tf_state_t x;
  tf_read_state(sample->state, sample->tick, &x);
  if (sample->answered)
    (void)snprintf(input, sizeof input, "%.*g,%.*g,%" PRIu64, digits,
                   (double)sample->input.omega0, digits,
                   (double)sample->input.torque, sample->effect);
  return (size_t)snprintf(row, ROW_ROOM, "%" PRIu64 ",%.*g,%.*g,%.*g,%s,%s\n",
                          sample->tick, digits, (double)x.r, digits,
                          (double)x.v, digits, (double)x.w,
                          tf_mode_name(x.mode), input);
}

// A row for every state that was read, in a file that gets its name when it is
// whole. Returns: CLI_DONE, or CLI_STOPPED after a message.
static int write_csv(const hil_board_t *board, const char *name) {
  static const char header[] = "step,r,v,omega,mode,omega0,torque,effect\n";
  static cli_output_t output; // holds the buffer
  char row[ROW_ROOM];
  if (cli_output_open(&output, name, false)) {
    (void)cli_output_lines(&output, header, sizeof header - 1);
    for (size_t i = 0; i < board->count; i++)
      (void)cli_output_lines(&output, row, make_row(&board->samples[i], row));
    if (cli_output_close(&output, true)) return CLI_DONE;
  }
  return hil_message(CLI_STOPPED, "%s: %s", name, cli_output_reason(&output));
}

static void print_summary(const hil_board_t *board, const hil_verdict_t *v) {
  const hil_plan_t *plan = &board->plan;
  const tf_state_t *end = &v->end;
  printf("board     scene %s, %s, dt = %g s, parameters %08" PRIx32 "\n",
         board->scene->name, TF_REAL_BYTES == 4 ? "float" : "double",
         (double)board->params.dt, tf_params_hash(&board->params));
  printf("loop      %" PRIu64 " steps, an input every %" PRIu64 " steps, ",
         plan->steps, plan->every);
  if (plan->in_lockstep)
    printf("in lockstep\n");
  else
    printf("in effect %" PRIu64 " steps later\n", plan->delay);
  printf("inputs    %zu: %zu late, %zu without an answer; %zu states missed; ",
         v->inputs, v->late, v->unanswered, v->missing);
  if (plan->deadman == 0)
    printf("held without end");
  else
    printf("held for %" PRIu64 " ticks", plan->deadman);
  printf(", expired %" PRIu32 " times\n", v->expired);
  printf("line      %" PRIu32 " frames, %" PRIu32 " broken, %" PRIu32 " lost",
         board->decoder.frames, board->decoder.bad, board->decoder.lost);
  if (board->has_heartbeat)
    printf("; the board: %" PRIu32 " overruns, %" PRIu32
           " ticks without a step, %" PRIu32 " dropped, %" PRIu32
           " broken, %" PRIu32 " lost, %" PRIu32 " ignored; steps %" PRIu32
           " refused, %" PRIu32 " degraded, %" PRIu32 " coarse, %" PRIu32
           " stalled, %" PRIu32 " fell back",
           board->heartbeat.overruns, board->heartbeat.skipped,
           board->heartbeat.dropped, board->heartbeat.bad,
           board->heartbeat.lost, board->heartbeat.ignored,
           board->heartbeat.refused, board->heartbeat.degraded,
           board->heartbeat.coarse, board->heartbeat.stalled,
           board->heartbeat.fell_back);
  printf(
      "\ncontrol   omega off its set point by %.3g rad/s (rms); "
      "end: r = %.9g m, omega = %.9g rad/s, %s\n",
      v->rms_error, (double)end->r, (double)end->w, tf_mode_name(end->mode));
  if (v->differ + v->wrong > 0)
    printf(
        "host run  DIFFERS: %zu of %zu states, %zu of %zu inputs, "
        "first at step %" PRIu64 "%s%s\n",
        v->differ, v->compared, v->wrong, v->inputs, v->first,
        v->unanswered > 0 ? "; an input without an answer may have acted" : "",
        board->decoder.lost > 0
            ? "; a lost frame may have reported that inputs expired"
            : "");
  else
    printf("host run  %zu states and %zu inputs: the same bits%s\n",
           v->compared, v->inputs,
           v->late + v->missing > 0 ? ", late inputs as answered" : "");
}

static int perform(hil_board_t *board, const options_t *options) {
  hil_verdict_t verdict;
  tf_decoder_init(&board->decoder, board->buffer, sizeof board->buffer);
  if (!cli_source_open(&board->source, options->device, options->baud, true))
    return hil_message(CLI_STOPPED, "%s: %s", options->device,
                       strerror(board->source.error));
  int code = hil_drive(board);
  cli_source_close(&board->source);
  CLI_TRY(code);
  if (options->csv != NULL) CLI_TRY(write_csv(board, options->csv));
  code = hil_twin_compare(board, &verdict);
  if (code == CLI_DONE || code == HIL_DIFFERS) print_summary(board, &verdict);
  return code;
}

int main(int argc, char **argv) {
  static hil_board_t board;
  static uint8_t key[TF_KEY_BYTES];
  options_t options;
  cli_guard_descriptors();
  CLI_TRY(read_options(&options, argc, argv));
  if (options.key != NULL) {
    const char *wrong = cli_read_key(options.key, key);
    if (wrong != NULL)
      return hil_message(CLI_USAGE, "%s: %s", options.key, wrong);
    board.key = key;
  }
  board.plan = options.plan;
  board.room = (size_t)(board.plan.steps / board.plan.every) + 64;
  board.samples = calloc(board.room, sizeof *board.samples);
  board.expired = calloc(board.room, sizeof *board.expired);
  if (board.samples == NULL || board.expired == NULL)
    return hil_message(CLI_STOPPED, "out of memory");
  cli_catch_signals();
  const int code = perform(&board, &options);
  return ferror(stdout) || fflush(stdout) || ferror(stderr) ? CLI_STOPPED
                                                            : code;
}
