// The command line of `run`. No option may be given twice, nor may a name of
// --set: which of two values is meant cannot be known.

#include "run_args.h"

#include <string.h>

#include "../setup/scene.h"
#include "../text/message.h"
#include "../text/number.h"
#include "../text/options.h"

static int read_t_end(void *to, const cli_given_t *option) {
  cli_run_args_t *args = to;
  const char *why = "";
  if (!cli_read_real(option->value, &args->t_end, &why)) {
    return cli_message(CLI_USAGE, "--t-end %s: '%s' %s", option->value,
                       option->value, why);
  }
  args->t_end_text = option->value;
  return CLI_DONE;
}

static int read_dt(void *to, const cli_given_t *option) {
  cli_run_args_t *args = to;
  return cli_settings_add_named(&args->settings, option->name, "dt",
                                option->value);
}

static int read_set(void *to, const cli_given_t *option) {
  cli_run_args_t *args = to;
  return cli_settings_add(&args->settings, option->name, option->value);
}

static int read_scheme(void *to, const cli_given_t *option) {
  cli_run_args_t *args = to;
  return cli_find_scheme(option->name, option->value, &args->scheme);
}

static int read_select(void *to, const cli_given_t *option) {
  cli_run_args_t *args = to;
  args->select = option->value;
  return CLI_DONE;
}

static int read_every(void *to, const cli_given_t *option) {
  cli_run_args_t *args = to;
  return cli_read_count(option, 1, CLI_MAX_STEPS, &args->every);
}

static int read_format(void *to, const cli_given_t *option) {
  cli_run_args_t *args = to;
  if (strcmp(option->value, "csv") == 0) {
    args->format = CLI_FORMAT_CSV;
  } else if (strcmp(option->value, "plotter") == 0) {
    args->format = CLI_FORMAT_PLOTTER;
  } else if (strcmp(option->value, "frames") == 0) {
    args->format = CLI_FORMAT_FRAMES;
  } else {
    return cli_message(CLI_USAGE,
                       "--format %s: unknown format; formats are csv, plotter "
                       "and frames",
                       option->value);
  }
  return CLI_DONE;
}

static int read_out(void *to, const cli_given_t *option) {
  cli_run_args_t *args = to;
  return cli_read_path(option, &args->out);
}

static int read_from(void *to, const cli_given_t *option) {
  cli_run_args_t *args = to;
  return cli_read_path(option, &args->from);
}

static int read_save(void *to, const cli_given_t *option) {
  cli_run_args_t *args = to;
  return cli_read_path(option, &args->save);
}

static int read_replay(void *to, const cli_given_t *option) {
  cli_run_args_t *args = to;
  return cli_read_path(option, &args->replay);
}

static int read_inputs(void *to, const cli_given_t *option) {
  cli_run_args_t *args = to;
  return cli_read_path(option, &args->drive.inputs);
}

static int read_between(void *to, const cli_given_t *option) {
  cli_run_args_t *args = to;
  args->drive.between = option->value;
  return CLI_DONE;
}

static int read_events(void *to, const cli_given_t *option) {
  cli_run_args_t *args = to;
  if (strcmp(option->value, "all") == 0) {
    args->listed = UINT64_MAX;
    return CLI_DONE;
  }
  if (cli_read_whole(option->value, 0, CLI_MAX_STEPS, &args->listed)) {
    return CLI_DONE;
  }
  return cli_message(CLI_USAGE,
                     "--events %s: must be a whole number in [0, 1e15], or "
                     "all",
                     option->value);
}

static int read_summary(void *to, const cli_given_t *option) {
  cli_run_args_t *args = to;
  return cli_read_summary(option, &args->json);
}

static int read_provenance(void *to, const cli_given_t *option) {
  cli_run_args_t *args = to;
  (void)option;
  args->provenance = true;
  return CLI_DONE;
}

static int read_real_time(void *to, const cli_given_t *option) {
  cli_run_args_t *args = to;
  (void)option;
  args->real_time = true;
  return CLI_DONE;
}

static int read_priority(void *to, const cli_given_t *option) {
  cli_run_args_t *args = to;
  (void)option;
  args->priority = true;
  return CLI_DONE;
}

static int read_lateness(void *to, const cli_given_t *option) {
  cli_run_args_t *args = to;
  return cli_read_path(option, &args->lateness);
}

static int read_live(void *to, const cli_given_t *option) {
  cli_run_args_t *args = to;
  (void)option;
  args->live = true;
  return CLI_DONE;
}

static int take(void *to, const char *word) {
  cli_run_args_t *args = to;
  return cli_take_scene(&args->scene, word);
}

// --dt and --set may be repeated: cli_settings_t refuses a repeated name.
static const cli_option_t options[] = {
    {"--t-end", read_t_end, CLI_ONCE},
    {"--dt", read_dt, CLI_REPEATABLE},
    {"--scheme", read_scheme, CLI_ONCE},
    {"--select", read_select, CLI_ONCE},
    {"--set", read_set, CLI_REPEATABLE},
    {"--every", read_every, CLI_ONCE},
    {"--format", read_format, CLI_ONCE},
    {"--out", read_out, CLI_WRITES},
    {"--from", read_from, CLI_READS},
    {"--save", read_save, CLI_WRITES},
    {"--replay", read_replay, CLI_READS},
    {"--inputs", read_inputs, CLI_READS},
    {"--between", read_between, CLI_ONCE},
    {"--events", read_events, CLI_ONCE},
    {"--summary", read_summary, CLI_ONCE},
    {"--provenance", read_provenance, CLI_FLAG},
    {"--realtime", read_real_time, CLI_FLAG},
    {"--priority", read_priority, CLI_FLAG},
    {"--lateness", read_lateness, CLI_WRITES},
    {"--live", read_live, CLI_FLAG},
};

// A record has its own inputs, start and end.
static int check_replay(const cli_run_args_t *args) {
  const char *other = args->drive.inputs != NULL ? "--inputs"
                      : args->from != NULL       ? "--from"
                      : args->t_end_text != NULL ? "--t-end"
                                                 : NULL;
  return other == NULL ? CLI_DONE
                       : cli_message(CLI_USAGE,
                                     "--replay %s: not with %s: a record has "
                                     "its own inputs, start and end",
                                     args->replay, other);
}

int cli_run_args(cli_run_args_t *args, int argc, char *const argv[]) {
  static const cli_syntax_t syntax = {"run", options,
                                      sizeof options / sizeof options[0], take};
  memset(args, 0, sizeof *args);
  args->scheme = &cli_schemes[0];
  args->every = 1;
  args->listed = 20;
  int code = cli_read_words(&syntax, args, argc, argv);
  if (code == CLI_DONE) {
    code = cli_need_scene(args->scene, "run");
  }
  if (code == CLI_DONE && args->provenance && args->format != CLI_FORMAT_CSV) {
    code = cli_message(CLI_USAGE, "--provenance: only with --format csv");
  }
  if (code == CLI_DONE && !args->real_time &&
      (args->priority || args->lateness != NULL)) {
    code = cli_message(CLI_USAGE, "%s: only with --realtime",
                       args->priority ? "--priority" : "--lateness");
  }
  if (code == CLI_DONE && args->replay != NULL) {
    code = check_replay(args);
  }
  if (code == CLI_DONE && args->t_end_text == NULL) {
    args->t_end = args->scene->t_end;
  }
  return code;
}
