// Words to the arguments of the command line: the input is split at its zeros
// and the first word is the command. All commands read and check everything
// before they open a file, and only that part is called here, so that no input
// writes anything. What is accepted is in its ranges and ready to run.
#include <stdlib.h>

#include "cli/analysis/analysis.h"
#include "cli/command.h"
#include "cli/monitor/board_command.h"
#include "cli/setup/args.h"
#include "cli/text/message.h"
#include "verify/fuzz/fuzz.h"

#define MAX_WORDS 64

static int is_code(int code) {
  return code == CLI_DONE || code == CLI_USAGE || code == CLI_REFUSED;
}

// Every parameter that the law needs lies in its range.
static int in_ranges(const tf_params_t *params) {
  tf_machine_t machine;
  return tf_prepare(&machine, params, NULL) == TF_OK;
}

static const char *run(const cli_args_t *args) {
  cli_setup_t setup;
  FUZZ_HOLD((args->scheme < CLI_SCHEMES || args->scheme == CLI_NOT_GIVEN) &&
            args->every >= 1);
  FUZZ_HOLD(args->out == NULL || args->out[0] != '\0');
  int code = cli_setup_read(&setup, args->scene, &args->settings, args->select);
  FUZZ_HOLD(code == CLI_DONE || code == CLI_USAGE);
  if (code != CLI_DONE) return NULL;
  code = cli_setup_machine(&setup);
  FUZZ_HOLD(code == CLI_DONE || code == CLI_REFUSED);
  FUZZ_HOLD((code == CLI_DONE) <= in_ranges(&setup.params));
  if (code != CLI_DONE) return NULL;
  code = cli_setup_start(&setup);
  FUZZ_HOLD(is_code(code));
  const cli_scheme_t *scheme = cli_scheme_for(args, setup.params.dt, NULL);
  cli_setup_notes(&setup, scheme->unused, scheme->why);
  if (code != CLI_DONE) return NULL;
  FUZZ_HOLD(fuzz_in_reach(&setup.state) && setup.state.mode < TF_MODES);
  FUZZ_HOLD(fuzz_finite(setup.state.phi) && setup.state.tick == 0);
  return NULL;
}

static const char *monitor(int argc, char *const argv[]) {
  cli_board_commands_t commands;
  cli_receiver_t receiver;
  uint8_t wire[TF_FRAME_SIZE(TF_FRAME_PAYLOAD)];
  memset(&commands, 0, sizeof commands);
  memset(&receiver, 0, sizeof receiver);
  for (int i = 0; i < argc; i++) {
    const int code = cli_board_commands_add(&commands, argv[i]);
    FUZZ_HOLD(code == CLI_DONE || code == CLI_USAGE);
    FUZZ_HOLD(commands.count <= CLI_BOARD_COMMANDS);
    if (code != CLI_DONE) return NULL;
  }
  receiver.has_schema = true;
  receiver.session = 1;
  receiver.schemas = 1;
  for (size_t i = 0; i < commands.count; i++) {
    receiver.is_float = (i & 1u) != 0;
    commands.waiting = false;
    commands.schemas = 0;
    commands.next = i;
    const size_t size = cli_board_commands_next(&commands, &receiver, 0, wire);
    FUZZ_HOLD(size >= TF_FRAME_SIZE(0) && size <= sizeof wire);
  }
  return NULL;
}

static const char *analyse(const cli_command_t *command,
                           const cli_args_t *args) {
  static cli_analysis_t a; // holds an output buffer
  const int code = cli_analysis_begin(
      &a, args, (command->bit & (CLI_DESIGN | CLI_ATLAS)) != 0);
  FUZZ_HOLD(is_code(code));
  if (code != CLI_DONE) return NULL;
  FUZZ_HOLD(in_ranges(&a.setup.params));
  if (command->bit == CLI_SINGULARITIES) return NULL;
  FUZZ_HOLD(args->r.count >= 1 && args->omega.count >= 1);
  FUZZ_HOLD(fuzz_finite(args->r.from) && fuzz_finite(args->r.to));
  FUZZ_HOLD(fuzz_finite(args->omega.from) && fuzz_finite(args->omega.to));
  return NULL;
}

static const char *judge(const cli_command_t *command, int code,
                         const cli_args_t *args) {
  const unsigned analyses =
      CLI_SINGULARITIES | CLI_REGIONS | CLI_DESIGN | CLI_ATLAS;
  FUZZ_HOLD(is_code(code));
  if (code != CLI_DONE) return NULL;
  FUZZ_HOLD(args->settings.count <= CLI_SETTINGS);
  FUZZ_HOLD(args->scene != NULL || command->bit == CLI_MERGE);
  if ((command->bit & analyses) != 0) return analyse(command, args);
  return command->bit == CLI_RUN ? run(args) : NULL;
}

static const char *perform(int argc, char *const argv[]) {
  static cli_args_t args;
  if (argc == 0) return NULL;
  if (strcmp(argv[0], "monitor") == 0) return monitor(argc - 1, argv + 1);
  const cli_command_t *command = cli_find_command(argv[0]);
  if (command == NULL || command->bit == 0) command = cli_find_command("run");
  const int code = cli_read_args(command, &args, argc - 1, argv + 1);
  const char *broken = judge(command, code, &args);
  free((void *)args.files);
  return broken;
}

const char *fuzz_arguments(const uint8_t *data, size_t size) {
  char *argv[MAX_WORDS + 1];
  int argc = 0;
  // A copy of its own size, so that a read behind the last word is seen.
  char *text = malloc(size + 1);
  FUZZ_HOLD(text != NULL);
  if (size > 0) memcpy(text, data, size);
  text[size] = '\0';
  for (size_t at = 0; at < size && argc < MAX_WORDS;
       at += strlen(text + at) + 1)
    argv[argc++] = text + at;
  argv[argc] = NULL;
  const char *broken = perform(argc, argv);
  free(text);
  return broken;
}
