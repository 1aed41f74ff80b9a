// Reading the command line of `diverge`. Everything is read and checked before
// a file is opened; ranges of what goes into the machine are asked of
// tf_prepare, later and once.

#include <stdio.h>
#include <string.h>

#include "diverge.h"
#include "text.h"

#define MOST 1000000000000000u // samples and cycles, exact in a double
#define MOST_SAMPLES 4294967295u

typedef struct {
  const char *name, *value;
} option_t;

const cli_kind_t cli_kinds[CLI_BYS] = {
    {"random", "", 1e-2, 10, 1, &cli_random_motion},
    {"noise", "m/s^1.5", 1e-3, 64, 1, &cli_kicked_motion},
    {"smoothing", "m/s", 1e-4, 16, 2, &cli_kicked_motion},
    {"hysteresis", "m/s", 1e-3, 16, 2, &cli_forced_motion},
    {"delay", "s", 1e-3, 16, 2, &cli_forced_motion},
};

// Reads a real number in [low, high] (low itself out of range if open).
static int read_real(const option_t *option, bool open, double low, double high,
                     const char *unit, double *out) {
  const char *why = "";
  tf_real_t value = 0;
  if (!cli_read_real(option->value, &value, &why)) {
    return cli_complain(CLI_USAGE, "%s %s: '%s' %s", option->name,
                        option->value, option->value, why);
  }
  const double number = (double)value;
  if (!(number >= low && number <= high) || (open && !(number > low))) {
    return cli_complain(CLI_REFUSED, "%s %s: must lie in %s%g, %g]%s%s",
                        option->name, option->value, open ? "(" : "[", low,
                        high, unit[0] != '\0' ? " " : "", unit);
  }
  *out = number;
  return CLI_DONE;
}

static int read_count(const option_t *option, uint64_t low, uint64_t high,
                      uint64_t *out) {
  if (cli_read_whole(option->value, low, high, out)) {
    return CLI_DONE;
  }
  return cli_complain(CLI_USAGE, "%s %s: must be a whole number in [%g, %g]",
                      option->name, option->value, (double)low, (double)high);
}

static int read_path(const option_t *option, const char **out) {
  if (option->value[0] == '\0') {
    return cli_complain(CLI_USAGE, "%s: the name of the file is empty",
                        option->name);
  }
  *out = option->value;
  return CLI_DONE;
}

static int read_exits(cli_diverge_args_t *args, const option_t *option) {
  return read_path(option, &args->exits);
}

static int read_returns(cli_diverge_args_t *args, const option_t *option) {
  return read_path(option, &args->returns);
}

static int read_by(cli_diverge_args_t *args, const option_t *option) {
  for (int i = 0; i < CLI_BYS; i++) {
    if (strcmp(option->value, cli_kinds[i].name) == 0) {
      args->by = (cli_by_t)i;
      return CLI_DONE;
    }
  }
  return cli_complain(CLI_USAGE,
                      "--by %s: unknown kind; kinds are random, noise, "
                      "smoothing, hysteresis and delay",
                      option->value);
}

static int read_corner(cli_diverge_args_t *args, const option_t *option) {
  static const char *const names[CLI_CORNERS] = {"rest", "attracting", "even"};
  for (int i = 0; i < CLI_CORNERS; i++) {
    if (strcmp(option->value, names[i]) == 0) {
      args->corner = (cli_corner_t)i;
      return CLI_DONE;
    }
  }
  return cli_complain(CLI_USAGE,
                      "--corner %s: must be rest, attracting or even",
                      option->value);
}

static int read_size(cli_diverge_args_t *args, const option_t *option) {
  args->size_text = option->value;
  return read_real(option, true, 0, 1, "", &args->size);
}

static int read_spread(cli_diverge_args_t *args, const option_t *option) {
  return read_real(option, false, 1, 1e6, "", &args->spread);
}

static int read_near(cli_diverge_args_t *args, const option_t *option) {
  return read_real(option, false, 1, 1e6, "", &args->near_ratio);
}

static int read_patience(cli_diverge_args_t *args, const option_t *option) {
  return read_real(option, true, 0, 1e9, "s", &args->patience);
}

static int read_section(cli_diverge_args_t *args, const option_t *option) {
  return read_real(option, true, 0, 1e3, "m", &args->section);
}

static int read_samples(cli_diverge_args_t *args, const option_t *option) {
  return read_count(option, 1, MOST_SAMPLES, &args->samples);
}

static int read_cycles(cli_diverge_args_t *args, const option_t *option) {
  return read_count(option, 1, MOST, &args->cycles);
}

static int read_seed(cli_diverge_args_t *args, const option_t *option) {
  uint64_t seed = 0;
  const int code = read_count(option, 0, UINT32_MAX, &seed);
  args->seed = (uint32_t)seed;
  return code;
}

// I/N, both whole numbers, 1 <= I <= N.
static int read_shard(cli_diverge_args_t *args, const option_t *option) {
  char first[CLI_REAL_ROOM];
  const size_t length = strcspn(option->value, "/");
  const char *second = option->value + length;
  (void)snprintf(first, sizeof first, "%.*s",
                 (int)(length < sizeof first ? length : sizeof first - 1),
                 option->value);
  if (*second != '/' || !cli_read_whole(first, 0, MOST, &args->shard) ||
      !cli_read_whole(second + 1, 0, MOST, &args->shards)) {
    return cli_complain(CLI_USAGE,
                        "--shard %s: expected I/N, two whole numbers",
                        option->value);
  }
  if (args->shard < 1 || args->shard > args->shards) {
    return cli_complain(CLI_REFUSED,
                        "--shard %s: I must lie in [1, N], N be at least 1",
                        option->value);
  }
  return CLI_DONE;
}

static int read_rate(cli_diverge_args_t *args, const option_t *option) {
  return cli_settings_add_named(&args->settings, option->name, "rate",
                                option->value);
}

static int read_dt(cli_diverge_args_t *args, const option_t *option) {
  return cli_settings_add_named(&args->settings, option->name, "dt",
                                option->value);
}

static int read_set(cli_diverge_args_t *args, const option_t *option) {
  return cli_settings_add(&args->settings, option->name, option->value);
}

static int read_branches(cli_diverge_args_t *args, const option_t *option) {
  return read_path(option, &args->branches);
}

static int read_depth(cli_diverge_args_t *args, const option_t *option) {
  return read_count(option, 1, 1000, &args->depth);
}

static int read_nodes(cli_diverge_args_t *args, const option_t *option) {
  return read_count(option, 1, 1000000, &args->count);
}

static int read_grid(cli_diverge_args_t *args, const option_t *option) {
  return read_real(option, false, 1e-6, 1e3, "s", &args->grid);
}

static const struct {
  const char *name;
  int (*read)(cli_diverge_args_t *args, const option_t *option);
} options[] = {
    {"--by", read_by},           {"--rate", read_rate},
    {"--size", read_size},       {"--spread", read_spread},
    {"--corner", read_corner},   {"--samples", read_samples},
    {"--cycles", read_cycles},   {"--seed", read_seed},
    {"--shard", read_shard},     {"--patience", read_patience},
    {"--section", read_section}, {"--dt", read_dt},
    {"--near", read_near},       {"--set", read_set},
    {"--exits", read_exits},     {"--returns", read_returns},
    {"--depth", read_depth},     {"--count", read_nodes},
    {"--grid", read_grid},       {"--branches", read_branches},
};
#define OPTIONS (sizeof options / sizeof options[0])

static int unknown_option(const char *name) {
  cli_closest_t closest = cli_closest_to(name);
  for (size_t i = 0; i < OPTIONS; i++) {
    cli_closest_offer(&closest, options[i].name);
  }
  cli_closest_offer(&closest, "--header");
  cli_closest_offer(&closest, "--exhaustive");
  const cli_hint_t hint = cli_closest_hint(&closest);
  return cli_complain(
      CLI_USAGE, "unknown option %s%s%s%s ('twofold help diverge' lists them)",
      name, hint.before, hint.name, hint.after);
}

// Reads one option that starts at argv[*at] and moves *at to its last word.
static int read_option(cli_diverge_args_t *args, int argc, char *const *argv,
                       int *at) {
  const char *word = argv[*at];
  const size_t length = strcspn(word, "=");
  size_t i = 0;
  if (strcmp(word, "--header") == 0) {
    args->header = true;
    return CLI_DONE;
  }
  if (strcmp(word, "--exhaustive") == 0) {
    args->exhaustive = true;
    return CLI_DONE;
  }
  while (i < OPTIONS && (strlen(options[i].name) != length ||
                         strncmp(options[i].name, word, length) != 0)) {
    i++;
  }
  if (i == OPTIONS) {
    return unknown_option(word);
  }
  option_t option = {options[i].name, NULL};
  if (word[length] == '=') {
    option.value = word + length + 1;
  } else if (*at + 1 < argc) {
    option.value = argv[++*at];
  } else {
    return cli_complain(CLI_USAGE, "%s: expected a value", option.name);
  }
  return options[i].read(args, &option);
}

// What goes together, once all is read.
static int check_together(cli_diverge_args_t *args) {
  const cli_kind_t *kind = &cli_kinds[args->by];
  const bool sized = args->by != CLI_BY_RANDOM;
  if (args->scene == NULL) {
    return cli_complain(CLI_USAGE,
                        "diverge: which scene? ('twofold scenes' lists them)");
  }
  if (args->exhaustive && (sized || args->exits != NULL ||
                           args->returns != NULL || args->shards > 1)) {
    return cli_complain(CLI_USAGE,
                        "--exhaustive: writes --branches FILE; it takes no "
                        "--by, --exits, --returns and --shard");
  }
  if (sized && args->size_text == NULL) {
    return cli_complain(CLI_USAGE, "--by %s: give --size VALUE in %s",
                        kind->name, kind->unit);
  }
  if (!sized && args->size_text != NULL) {
    return cli_complain(CLI_USAGE,
                        "--size %s: --by random has a --rate and no size",
                        args->size_text);
  }
  if (args->exits == NULL && args->returns == NULL) {
    args->returns = "-";
  }
  if (args->exits != NULL && args->returns != NULL &&
      strcmp(args->exits, args->returns) == 0) {
    return cli_complain(CLI_USAGE,
                        "--exits %s, --returns %s: two files are needed",
                        args->exits, args->returns);
  }
  args->spread = args->spread > 0 ? args->spread : kind->spread;
  args->near_ratio = args->near_ratio > 0 ? args->near_ratio : kind->near;
  return CLI_DONE;
}

int cli_diverge_args(cli_diverge_args_t *args, int argc, char *const argv[]) {
  memset(args, 0, sizeof *args);
  args->samples = 100;
  args->cycles = 1;
  args->shard = args->shards = 1;
  args->patience = 100;
  args->section = 1e-3;
  args->seed = 1;
  args->depth = 3;
  args->count = 1000;
  args->grid = 1e-2;
  for (int at = 0; at < argc; at++) {
    int code = CLI_DONE;
    if (argv[at][0] == '-') {
      code = read_option(args, argc, argv, &at);
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
  return check_together(args);
}
