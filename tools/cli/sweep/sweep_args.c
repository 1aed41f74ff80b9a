// The command line of `sweep`. An axis is a setting whose value changes from
// point to point, so it stands among the settings: a name that is both swept
// and set is refused like one that is set twice.

#include "sweep_args.h"

#include <math.h>
#include <string.h>

#include "../setup/scene.h"
#include "../text/closest.h"
#include "../text/message.h"
#include "../text/number.h"
#include "../text/options.h"

#define MAX_VALUES 1000000u            // of one axis
#define MAX_POINTS 1000000000000000ull // exact in a double

static int read_t_end(void *to, const cli_given_t *option) {
  cli_sweep_args_t *args = to;
  const char *why = "";
  args->t_end_text = option->value;
  return cli_read_real(option->value, &args->t_end, &why)
             ? CLI_DONE
             : cli_message(CLI_USAGE, "--t-end %s: '%s' %s", option->value,
                           option->value, why);
}

static int read_dt(void *to, const cli_given_t *option) {
  cli_sweep_args_t *args = to;
  return cli_settings_add_named(&args->settings, option->name, "dt",
                                option->value);
}

static int read_set(void *to, const cli_given_t *option) {
  cli_sweep_args_t *args = to;
  return cli_settings_add(&args->settings, option->name, option->value);
}

static int read_scheme(void *to, const cli_given_t *option) {
  cli_sweep_args_t *args = to;
  return cli_find_scheme(option->name, option->value, &args->scheme);
}

static int read_select(void *to, const cli_given_t *option) {
  cli_sweep_args_t *args = to;
  args->select = option->value;
  return CLI_DONE;
}

static int read_inputs(void *to, const cli_given_t *option) {
  cli_sweep_args_t *args = to;
  return cli_read_path(option, &args->drive_args.inputs);
}

static int read_between(void *to, const cli_given_t *option) {
  cli_sweep_args_t *args = to;
  args->drive_args.between = option->value;
  return CLI_DONE;
}

static int read_shard(void *to, const cli_given_t *option) {
  cli_sweep_args_t *args = to;
  return cli_read_shard(option, &args->shard);
}

static int read_out(void *to, const cli_given_t *option) {
  cli_sweep_args_t *args = to;
  return cli_read_path(option, &args->out);
}

static int read_resume(void *to, const cli_given_t *option) {
  cli_sweep_args_t *args = to;
  (void)option;
  args->resume = true;
  return CLI_DONE;
}

static int read_summary(void *to, const cli_given_t *option) {
  cli_sweep_args_t *args = to;
  return cli_read_summary(option, &args->json);
}

static bool is_seed(double value) {
  return value >= 0 && value <= UINT32_MAX && floor(value) >= value;
}

// The seed is a number of rule random, not a real parameter of the machine.
static int add_seed(const cli_sweep_args_t *args, cli_axis_t *axis) {
  const char *text = axis->range.text;
  axis->is_seed = true;
  for (size_t i = 0; i < args->axes; i++) {
    if (args->axis[i].is_seed) {
      return cli_message(CLI_USAGE,
                         "--over %s: seed was already given by "
                         "--over %s",
                         text, args->axis[i].range.text);
    }
  }
  for (uint64_t i = 0; i < axis->range.count; i++) {
    if (!is_seed((double)cli_range_at(&axis->range, i))) {
      return cli_message(CLI_REFUSED,
                         "--over %s: seed must be whole numbers in "
                         "[0, 4294967295]; value %llu is %.9g",
                         text, (unsigned long long)i + 1,
                         (double)cli_range_at(&axis->range, i));
    }
  }
  return CLI_DONE;
}

static int read_over(void *to, const cli_given_t *option) {
  cli_sweep_args_t *args = to;
  const char *text = option->value;
  const char *equals = strchr(text, '=');
  if (equals == NULL || equals == text) {
    return cli_message(CLI_USAGE, "--over %s: expected NAME=A:B:N", text);
  }
  if (args->axes == CLI_AXES) {
    return cli_message(CLI_USAGE, "--over %s: more than %d axes", text,
                       CLI_AXES);
  }
  cli_axis_t *axis = &args->axis[args->axes];
  const size_t length = (size_t)(equals - text);
  int code =
      cli_read_range(option->name, text, equals + 1, MAX_VALUES, &axis->range);
  if (code == CLI_DONE && length == 4 && strncmp(text, "seed", 4) == 0) {
    memcpy(axis->name, "seed", 5);
    code = add_seed(args, axis);
  } else if (code == CLI_DONE) {
    axis->setting = args->settings.count;
    code = cli_settings_add(&args->settings, option->name, text);
    memcpy(axis->name, args->settings.list[axis->setting].name,
           sizeof axis->name);
  }
  if (code == CLI_DONE && args->points > MAX_POINTS / axis->range.count) {
    code = cli_message(CLI_REFUSED, "--over %s: more than %llu points", text,
                       MAX_POINTS);
  }
  if (code == CLI_DONE) {
    args->points *= axis->range.count;
    args->axes++;
  }
  return code;
}

static int add_measure(cli_sweep_args_t *args, const char *name,
                       const char *text) {
  cli_closest_t closest = cli_closest_to(name);
  unsigned found = 0;
  while (found < CLI_MEASURES && strcmp(cli_measures[found].name, name) != 0) {
    cli_closest_offer(&closest, cli_measures[found].name);
    found++;
  }
  if (found == CLI_MEASURES) {
    const cli_hint_t hint = cli_closest_hint(&closest);
    return cli_message(CLI_USAGE,
                       "--outcome %s: unknown outcome '%s'%s%s%s ('twofold "
                       "help sweep' lists them)",
                       text, name, hint.before, hint.name, hint.after);
  }
  for (size_t i = 0; i < args->measures; i++) {
    if (args->measure[i] == (cli_measure_t)found) {
      return cli_message(CLI_USAGE, "--outcome %s: %s was already given", text,
                         name);
    }
  }
  args->measure[args->measures++] = (cli_measure_t)found;
  return CLI_DONE;
}

static int read_outcome(void *to, const cli_given_t *option) {
  cli_sweep_args_t *args = to;
  const char *at = option->value;
  for (;;) {
    char name[32];
    const size_t length = strcspn(at, ",");
    const size_t kept = length < sizeof name ? length : sizeof name - 1;
    memcpy(name, at, kept);
    name[kept] = '\0';
    const int code = add_measure(args, name, option->value);
    if (code != CLI_DONE || at[length] == '\0') {
      return code;
    }
    at += length + 1;
  }
}

static int take(void *to, const char *word) {
  cli_sweep_args_t *args = to;
  return cli_take_scene(&args->scene, word);
}

static const cli_option_t options[] = {
    {"--over", read_over, CLI_REPEATABLE},
    {"--outcome", read_outcome, CLI_REPEATABLE},
    {"--t-end", read_t_end, CLI_ONCE},
    {"--dt", read_dt, CLI_REPEATABLE},
    {"--scheme", read_scheme, CLI_ONCE},
    {"--select", read_select, CLI_ONCE},
    {"--set", read_set, CLI_REPEATABLE},
    {"--inputs", read_inputs, CLI_READS},
    {"--between", read_between, CLI_ONCE},
    {"--shard", read_shard, CLI_ONCE},
    {"--out", read_out, CLI_WRITES},
    {"--resume", read_resume, CLI_FLAG},
    {"--summary", read_summary, CLI_ONCE},
};

// Options that need each other, and defaults.
static int check_together(cli_sweep_args_t *args) {
  static const cli_measure_t usual[] = {CLI_MODES, CLI_REST, CLI_RECURRENCE,
                                        CLI_ENERGY, CLI_AMBIGUOUS};
  if (args->axes == 0) {
    return cli_message(CLI_USAGE, "sweep: --over NAME=A:B:N is missing");
  }
  if (args->resume && (args->out == NULL || strcmp(args->out, "-") == 0)) {
    return cli_message(CLI_USAGE, "--resume: only with --out FILE");
  }
  for (size_t i = 0; i < args->axes; i++) {
    if (args->axis[i].is_seed &&
        (args->select == NULL || strcmp(args->select, "random") != 0)) {
      return cli_message(CLI_USAGE, "--over %s: only with --select random",
                         args->axis[i].range.text);
    }
  }
  if (args->measures == 0) {
    args->measures = sizeof usual / sizeof usual[0];
    memcpy(args->measure, usual, sizeof usual);
  }
  if (args->t_end_text == NULL) {
    args->t_end = args->scene->t_end;
  }
  return CLI_DONE;
}

int cli_sweep_args(cli_sweep_args_t *args, int argc, char *const argv[]) {
  static const cli_syntax_t syntax = {"sweep", options,
                                      sizeof options / sizeof options[0], take};
  memset(args, 0, sizeof *args);
  args->scheme = &cli_schemes[0];
  args->points = 1;
  args->shard.index = args->shard.of = 1;
  int code = cli_read_words(&syntax, args, argc, argv);
  if (code == CLI_DONE) {
    code = cli_need_scene(args->scene, "sweep");
  }
  code = code == CLI_DONE ? check_together(args) : code;
  return code == CLI_DONE
             ? cli_drive_read(&args->drive, args->scene, &args->drive_args)
             : code;
}
