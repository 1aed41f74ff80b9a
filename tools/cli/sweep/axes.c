// What is swept and what is found. An axis is a setting whose value changes from
// point to point, so it stands among the settings: a name that is both swept
// and set is refused like one that is set twice.

#include "axes.h"

#include <math.h>
#include <string.h>

#include "../text/closest.h"
#include "../text/message.h"
#include "../text/number.h"
#include "../text/options.h"

#define MAX_VALUES 1000000u            // of one axis
#define MAX_POINTS 1000000000000000ull // exact in a double

static bool is_seed(double value) {
  return value >= 0 && value <= UINT32_MAX && floor(value) >= value;
}

// The seed is a number of rule random, not a real parameter of the machine.
static int add_seed(const cli_args_t *args, cli_axis_t *axis) {
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

int cli_read_over(void *to, const cli_given_t *option) {
  cli_args_t *args = to;
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

static int add_measure(cli_args_t *args, const char *name, const char *text) {
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
    if (args->measure[i] == found) {
      return cli_message(CLI_USAGE, "--outcome %s: %s was already given", text,
                         name);
    }
  }
  args->measure[args->measures++] = found;
  return CLI_DONE;
}

int cli_read_outcome(void *to, const cli_given_t *option) {
  cli_args_t *args = to;
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

int cli_sweep_check(cli_args_t *args) {
  static const unsigned usual[] = {CLI_MODES, CLI_REST, CLI_RECURRENCE,
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
  return CLI_DONE;
}
