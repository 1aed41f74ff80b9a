// Reading the command line of `run`. Everything is read and checked here,
// before a file is opened, so that a mistyped command never costs the result
// of an earlier one. Options may stand on either side of the scene, as
// `--name value` or `--name=value`. None may be given twice, nor may a name of
// --set: which of two values is meant cannot be known.

#include <stdio.h>
#include <string.h>

#include "run.h"
#include "text.h"

// Most steps between two rows, and of a run: counted exactly by a double.
#define MOST_STEPS 1000000000000000u

typedef struct {
  const char *name, *value;
} option_t;

static int read_t_end(cli_run_args_t *args, const option_t *option) {
  const char *why = "";
  if (!cli_read_real(option->value, &args->t_end, &why)) {
    return cli_complain(CLI_USAGE, "--t-end %s: '%s' %s", option->value,
                        option->value, why);
  }
  args->t_end_text = option->value;
  return CLI_DONE;
}

static int read_dt(cli_run_args_t *args, const option_t *option) {
  return cli_settings_add_named(&args->settings, option->name, "dt",
                                option->value);
}

static int read_set(cli_run_args_t *args, const option_t *option) {
  return cli_settings_add(&args->settings, option->name, option->value);
}

static int read_scheme(cli_run_args_t *args, const option_t *option) {
  for (size_t i = 0; i < CLI_SCHEMES; i++) {
    if (strcmp(option->value, cli_schemes[i].name) == 0) {
      args->scheme = &cli_schemes[i];
      return CLI_DONE;
    }
  }
  cli_closest_t closest = cli_closest_to(option->value);
  for (size_t i = 0; i < CLI_SCHEMES; i++) {
    cli_closest_offer(&closest, cli_schemes[i].name);
  }
  const cli_hint_t hint = cli_closest_hint(&closest);
  return cli_complain(CLI_USAGE,
                      "--scheme %s: unknown scheme; this version has moreau, "
                      "located and compensated%s%s%s",
                      option->value, hint.before, hint.name, hint.after);
}

static int read_select(cli_run_args_t *args, const option_t *option) {
  args->select = option->value;
  return CLI_DONE;
}

static int read_every(cli_run_args_t *args, const option_t *option) {
  if (cli_read_whole(option->value, 1, MOST_STEPS, &args->every)) {
    return CLI_DONE;
  }
  return cli_complain(CLI_USAGE,
                      "--every %s: must be a whole number in [1, 1e15]",
                      option->value);
}

static int read_format(cli_run_args_t *args, const option_t *option) {
  if (strcmp(option->value, "csv") == 0) {
    args->format = CLI_FORMAT_CSV;
  } else if (strcmp(option->value, "plotter") == 0) {
    args->format = CLI_FORMAT_PLOTTER;
  } else if (strcmp(option->value, "frames") == 0) {
    args->format = CLI_FORMAT_FRAMES;
  } else {
    return cli_complain(CLI_USAGE,
                        "--format %s: unknown format; this version has csv, "
                        "plotter and frames",
                        option->value);
  }
  return CLI_DONE;
}

static int read_out(cli_run_args_t *args, const option_t *option) {
  if (option->value[0] == '\0') {
    return cli_complain(CLI_USAGE, "--out: the name of the file is empty");
  }
  args->out = option->value;
  return CLI_DONE;
}

static int read_events(cli_run_args_t *args, const option_t *option) {
  if (strcmp(option->value, "all") == 0) {
    args->listed = UINT64_MAX;
    return CLI_DONE;
  }
  if (cli_read_whole(option->value, 0, MOST_STEPS, &args->listed)) {
    return CLI_DONE;
  }
  return cli_complain(CLI_USAGE,
                      "--events %s: must be a whole number in [0, 1e15], or "
                      "all",
                      option->value);
}

static int read_real_time(cli_run_args_t *args, const option_t *option) {
  (void)option;
  args->real_time = true;
  return CLI_DONE;
}

static const struct {
  const char *name;
  int (*read)(cli_run_args_t *args, const option_t *option);
} options[] = {
    {"--t-end", read_t_end},   {"--dt", read_dt},
    {"--scheme", read_scheme}, {"--select", read_select},
    {"--set", read_set},       {"--every", read_every},
    {"--format", read_format}, {"--out", read_out},
    {"--events", read_events}, {"--realtime", read_real_time},
};
#define OPTIONS (sizeof options / sizeof options[0])

static int unknown_option(const char *name) {
  cli_closest_t closest = cli_closest_to(name);
  for (size_t i = 0; i < OPTIONS; i++) {
    cli_closest_offer(&closest, options[i].name);
  }
  const cli_hint_t hint = cli_closest_hint(&closest);
  return cli_complain(CLI_USAGE,
                      "unknown option %s%s%s%s ('twofold help run' lists them)",
                      name, hint.before, hint.name, hint.after);
}

// Reads one option that starts at argv[*at] and moves *at to its last word.
// seen: in/out, bits of the options before.
static int read_option(cli_run_args_t *args, int argc, char *const argv[],
                       int *at, unsigned *seen) {
  char name[CLI_NAME_ROOM];
  const char *word = argv[*at];
  const size_t length = strcspn(word, "=");
  size_t i = 0;
  (void)snprintf(name, sizeof name, "%.*s",
                 (int)(length < sizeof name ? length : sizeof name - 1), word);
  while (i < OPTIONS && strcmp(options[i].name, name) != 0) {
    i++;
  }
  if (i == OPTIONS || length >= sizeof name) {
    return unknown_option(word);
  }
  option_t option = {options[i].name, NULL};
  if (options[i].read == read_real_time) {
    option.value = "";
    if (word[length] == '=') {
      return cli_complain(CLI_USAGE, "%s: takes no value", word);
    }
  } else if (word[length] == '=') {
    option.value = word + length + 1;
  } else if (*at + 1 < argc) {
    option.value = argv[++*at];
  } else {
    return cli_complain(CLI_USAGE, "%s: expected a value", option.name);
  }
  const int code = options[i].read(args, &option);
  if (code == CLI_DONE && ((*seen >> i) & 1u) != 0 &&
      options[i].read != read_set) {
    return cli_complain(CLI_USAGE, "%s%s%s: %s was already given", option.name,
                        option.value[0] != '\0' ? " " : "", option.value,
                        option.name);
  }
  *seen |= 1u << i;
  return code;
}

int cli_run_args(cli_run_args_t *args, int argc, char *const argv[]) {
  memset(args, 0, sizeof *args);
  args->scheme = &cli_schemes[0];
  args->every = 1;
  args->listed = 20;
  unsigned seen = 0;
  for (int at = 0; at < argc; at++) {
    int code = CLI_DONE;
    if (argv[at][0] == '-') {
      code = read_option(args, argc, argv, &at, &seen);
    } else if (args->scene != NULL) {
      code = cli_complain(CLI_USAGE, "%s: one scene at a time (%s was given)",
                          argv[at], args->scene->name);
    } else {
      args->scene = cli_find_scene(argv[at]);
      code = args->scene != NULL ? CLI_DONE : CLI_USAGE;
    }
    if (code != CLI_DONE) {
      return code;
    }
  }
  if (args->scene == NULL) {
    return cli_complain(CLI_USAGE,
                        "run: which scene? ('twofold scenes' lists "
                        "them)");
  }
  if (args->t_end_text == NULL) {
    args->t_end = args->scene->t_end;
  }
  return CLI_DONE;
}
