// The command line of `monitor`.

#include "monitor_args.h"

#include <string.h>

#include "../host/key.h"
#include "../text/message.h"
#include "../text/options.h"

#define MAX_BAUD 100000000u

static int choose_stream(cli_monitor_args_t *args, const char *name) {
  const cli_stream_t *as = cli_stream_named(name);
  if (as == NULL) {
    return cli_message(CLI_USAGE,
                       "--as %s: unknown form; forms are csv, plotter, "
                       "teleplot and json",
                       name);
  }
  if (args->as != NULL && args->as != as) {
    return cli_message(CLI_USAGE, "--as %s: one form at a time (%s was given)",
                       name, args->as->name);
  }
  args->as = as;
  return CLI_DONE;
}

static int read_as(void *to, const cli_given_t *option) {
  return choose_stream(to, option->value);
}

static int read_csv(void *to, const cli_given_t *option) {
  (void)option;
  return choose_stream(to, "csv");
}

static int read_follow(void *to, const cli_given_t *option) {
  cli_monitor_args_t *args = to;
  (void)option;
  args->follow = true;
  return CLI_DONE;
}

static int read_live(void *to, const cli_given_t *option) {
  cli_monitor_args_t *args = to;
  (void)option;
  args->live = true;
  return CLI_DONE;
}

static int read_baud(void *to, const cli_given_t *option) {
  cli_monitor_args_t *args = to;
  return cli_read_count(option, 1, MAX_BAUD, &args->baud);
}

static int read_out(void *to, const cli_given_t *option) {
  cli_monitor_args_t *args = to;
  return cli_read_path(option, &args->out);
}

static int read_record(void *to, const cli_given_t *option) {
  cli_monitor_args_t *args = to;
  return cli_read_path(option, &args->record);
}

static int read_send(void *to, const cli_given_t *option) {
  cli_monitor_args_t *args = to;
  return cli_board_commands_add(&args->commands, option->value);
}

static int read_key(void *to, const cli_given_t *option) {
  cli_monitor_args_t *args = to;
  args->commands.has_key = cli_read_key(option->value, args->commands.key);
  return args->commands.has_key
             ? CLI_DONE
             : cli_message(CLI_USAGE, "--key %s: no 32 hexadecimal digits",
                           option->value);
}

static int read_provenance(void *to, const cli_given_t *option) {
  cli_monitor_args_t *args = to;
  (void)option;
  args->provenance = true;
  return CLI_DONE;
}

static int read_summary(void *to, const cli_given_t *option) {
  cli_monitor_args_t *args = to;
  return cli_read_summary(option, &args->json);
}

static int take_source(void *to, const char *word) {
  cli_monitor_args_t *args = to;
  if (args->path != NULL) {
    return cli_message(CLI_USAGE, "%s: one source at a time (%s was given)",
                       word, args->path);
  }
  args->path = word;
  return CLI_DONE;
}

static const cli_option_t options[] = {
    {"--as", read_as, CLI_ONCE},
    {"--csv", read_csv, CLI_FLAG},
    {"--follow", read_follow, CLI_FLAG},
    {"--live", read_live, CLI_FLAG},
    {"--baud", read_baud, CLI_ONCE},
    {"--out", read_out, CLI_WRITES},
    {"--send", read_send, CLI_REPEATABLE},
    {"--key", read_key, CLI_READS},
    {"--record", read_record, CLI_WRITES},
    {"--provenance", read_provenance, CLI_FLAG},
    {"--summary", read_summary, CLI_ONCE},
};

int cli_monitor_args(cli_monitor_args_t *args, int argc, char *const argv[]) {
  static const cli_syntax_t syntax = {
      "monitor", options, sizeof options / sizeof options[0], take_source};
  memset(args, 0, sizeof *args);
  // The schema has to be known before any other command can be sent.
  (void)cli_board_commands_add(&args->commands, "describe");
  const int code = cli_read_words(&syntax, args, argc, argv);
  if (code != CLI_DONE) {
    return code;
  }
  if (args->path == NULL) {
    return cli_message(CLI_USAGE,
                       "monitor: which file or device? (- is "
                       "standard input)");
  }
  if (args->commands.count == 1) {
    args->commands.count = 0;
  }
  if (args->live && args->as != NULL && args->out == NULL) {
    return cli_message(CLI_USAGE, "--live --as: rows go to --out FILE only");
  }
  if (args->out != NULL && args->as == NULL) {
    return cli_message(CLI_USAGE, "--out %s: only with --as", args->out);
  }
  if (args->provenance && args->as != cli_stream_named("csv")) {
    return cli_message(CLI_USAGE, "--provenance: only with --as csv");
  }
  return CLI_DONE;
}
