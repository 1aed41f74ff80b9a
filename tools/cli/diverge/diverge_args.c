// The command line of `diverge`. Ranges of the machine's parameters are checked
// later, by tf_prepare.

#include "diverge_args.h"

#include <stdio.h>
#include <string.h>

#include "../setup/scene.h"
#include "../text/message.h"
#include "../text/number.h"
#include "../text/options.h"
#include "counts.h"

#define MOST 1000000000000000u // samples and cycles, exact in a double
#define MAX_SAMPLES 4294967295u

// Reads a real number in [low, high], or in (low, high] if open.
static int read_real(const cli_given_t *option, bool open, double low,
                     double high, const char *unit, double *out) {
  const char *why = "";
  tf_real_t value = 0;
  if (!cli_read_real(option->value, &value, &why)) {
    return cli_message(CLI_USAGE, "%s %s: '%s' %s", option->name, option->value,
                       option->value, why);
  }
  const double number = (double)value;
  if (!(number >= low && number <= high) || (open && !(number > low))) {
    return cli_message(CLI_REFUSED, "%s %s: must lie in %s%g, %g]%s%s",
                       option->name, option->value, open ? "(" : "[", low, high,
                       unit[0] != '\0' ? " " : "", unit);
  }
  *out = number;
  return CLI_DONE;
}

static int read_exits(void *to, const cli_given_t *option) {
  cli_diverge_args_t *args = to;
  return cli_read_path(option, &args->exits);
}

static int read_returns(void *to, const cli_given_t *option) {
  cli_diverge_args_t *args = to;
  return cli_read_path(option, &args->returns);
}

static int read_counts(void *to, const cli_given_t *option) {
  cli_diverge_args_t *args = to;
  return cli_read_path(option, &args->counts);
}

static int read_by(void *to, const cli_given_t *option) {
  cli_diverge_args_t *args = to;
  for (int i = 0; i < CLI_MECHANISMS; i++) {
    if (strcmp(option->value, cli_mechanisms[i].name) == 0) {
      args->mechanism = (cli_mechanism_t)i;
      return CLI_DONE;
    }
  }
  return cli_message(CLI_USAGE,
                     "--by %s: unknown kind; kinds are random, noise, "
                     "smoothing, hysteresis and delay",
                     option->value);
}

// Under both of its names; given once under each is given twice.
static int read_codim2(void *to, const cli_given_t *option) {
  cli_diverge_args_t *args = to;
  static const char *const names[CLI_CODIM2_CHOICES] = {"rest", "attracting",
                                                        "even"};
  if (args->codim2_name != NULL) {
    return cli_message(CLI_USAGE, "%s %s: %s was already given", option->name,
                       option->value, args->codim2_name);
  }
  args->codim2_name = option->name;
  for (int i = 0; i < CLI_CODIM2_CHOICES; i++) {
    if (strcmp(option->value, names[i]) == 0) {
      args->codim2 = (cli_codim2_choice_t)i;
      return CLI_DONE;
    }
  }
  return cli_message(CLI_USAGE, "%s %s: must be rest, attracting or even",
                     option->name, option->value);
}

static int read_size(void *to, const cli_given_t *option) {
  cli_diverge_args_t *args = to;
  args->size_text = option->value;
  return read_real(option, true, 0, 1, "", &args->size);
}

static int read_spread(void *to, const cli_given_t *option) {
  cli_diverge_args_t *args = to;
  return read_real(option, false, 1, 1e6, "", &args->spread);
}

static int read_near(void *to, const cli_given_t *option) {
  cli_diverge_args_t *args = to;
  return read_real(option, false, 1, 1e6, "", &args->refinement);
}

static int read_patience(void *to, const cli_given_t *option) {
  cli_diverge_args_t *args = to;
  return read_real(option, true, 0, 1e9, "s", &args->patience);
}

static int read_section(void *to, const cli_given_t *option) {
  cli_diverge_args_t *args = to;
  return read_real(option, true, 0, 1e3, "m", &args->section);
}

static int read_samples(void *to, const cli_given_t *option) {
  cli_diverge_args_t *args = to;
  return cli_read_count(option, 1, MAX_SAMPLES, &args->samples);
}

static int read_cycles(void *to, const cli_given_t *option) {
  cli_diverge_args_t *args = to;
  return cli_read_count(option, 1, MOST, &args->cycles);
}

static int read_seed(void *to, const cli_given_t *option) {
  cli_diverge_args_t *args = to;
  uint64_t seed = 0;
  const int code = cli_read_count(option, 0, UINT32_MAX, &seed);
  args->seed = (uint32_t)seed;
  return code;
}

static int read_shard(void *to, const cli_given_t *option) {
  cli_diverge_args_t *args = to;
  return cli_read_shard(option, &args->shard);
}

static int read_rate(void *to, const cli_given_t *option) {
  cli_diverge_args_t *args = to;
  return cli_settings_add_named(&args->settings, option->name, "rate",
                                option->value);
}

static int read_dt(void *to, const cli_given_t *option) {
  cli_diverge_args_t *args = to;
  return cli_settings_add_named(&args->settings, option->name, "dt",
                                option->value);
}

static int read_set(void *to, const cli_given_t *option) {
  cli_diverge_args_t *args = to;
  return cli_settings_add(&args->settings, option->name, option->value);
}

static int read_branches(void *to, const cli_given_t *option) {
  cli_diverge_args_t *args = to;
  args->only_exhaustive = option->name;
  return cli_read_path(option, &args->branches);
}

static int read_depth(void *to, const cli_given_t *option) {
  cli_diverge_args_t *args = to;
  args->only_exhaustive = option->name;
  return cli_read_count(option, 1, 1000, &args->depth);
}

static int read_nodes(void *to, const cli_given_t *option) {
  cli_diverge_args_t *args = to;
  args->only_exhaustive = option->name;
  return cli_read_count(option, 1, 1000000, &args->count);
}

static int read_grid(void *to, const cli_given_t *option) {
  cli_diverge_args_t *args = to;
  args->only_exhaustive = option->name;
  return read_real(option, false, 1e-6, 1e3, "s", &args->grid);
}

static int read_resume(void *to, const cli_given_t *option) {
  cli_diverge_args_t *args = to;
  (void)option;
  args->resume = true;
  return CLI_DONE;
}

static int read_header(void *to, const cli_given_t *option) {
  cli_diverge_args_t *args = to;
  (void)option;
  args->header = true;
  return CLI_DONE;
}

static int read_provenance(void *to, const cli_given_t *option) {
  cli_diverge_args_t *args = to;
  (void)option;
  args->provenance = true;
  return CLI_DONE;
}

static int read_summary(void *to, const cli_given_t *option) {
  cli_diverge_args_t *args = to;
  return cli_read_summary(option, &args->json);
}

static int read_exhaustive(void *to, const cli_given_t *option) {
  cli_diverge_args_t *args = to;
  (void)option;
  args->exhaustive = true;
  return CLI_DONE;
}

static int take(void *to, const char *word) {
  cli_diverge_args_t *args = to;
  return cli_take_scene(&args->scene, word);
}

static const cli_option_t options[] = {
    {"--by", read_by, CLI_ONCE},
    {"--rate", read_rate, CLI_ONCE},
    {"--size", read_size, CLI_ONCE},
    {"--spread", read_spread, CLI_ONCE},
    {"--codim2", read_codim2, CLI_ONCE},
    {"--samples", read_samples, CLI_ONCE},
    {"--cycles", read_cycles, CLI_ONCE},
    {"--seed", read_seed, CLI_ONCE},
    {"--shard", read_shard, CLI_ONCE},
    {"--patience", read_patience, CLI_ONCE},
    {"--section", read_section, CLI_ONCE},
    {"--dt", read_dt, CLI_ONCE},
    {"--near", read_near, CLI_ONCE},
    {"--set", read_set, CLI_REPEATABLE},
    {"--exits", read_exits, CLI_WRITES},
    {"--returns", read_returns, CLI_WRITES},
    {"--counts", read_counts, CLI_WRITES},
    {"--depth", read_depth, CLI_ONCE},
    {"--count", read_nodes, CLI_ONCE},
    {"--grid", read_grid, CLI_ONCE},
    {"--branches", read_branches, CLI_WRITES},
    {"--resume", read_resume, CLI_FLAG},
    {"--header", read_header, CLI_FLAG},
    {"--provenance", read_provenance, CLI_FLAG},
    {"--summary", read_summary, CLI_ONCE},
    {"--exhaustive", read_exhaustive, CLI_FLAG},
};

static bool is_standard(const char *path) {
  return path != NULL && strcmp(path, "-") == 0;
}

static int check_files(cli_diverge_args_t *args) {
  if (args->exits == NULL && args->returns == NULL && args->counts == NULL) {
    args->returns = "-";
  }
  if (args->resume &&
      (args->exhaustive || is_standard(args->exits) ||
       is_standard(args->returns) || is_standard(args->counts))) {
    return cli_message(CLI_USAGE,
                       "--resume: only with --exits, --returns or "
                       "--counts to files");
  }
  if (args->counts != NULL && args->cycles > CLI_COUNT_CYCLES) {
    return cli_message(CLI_REFUSED, "--counts: at most --cycles %d",
                       CLI_COUNT_CYCLES);
  }
  if (args->counts != NULL && args->shard.of > CLI_COUNT_SHARDS) {
    return cli_message(CLI_REFUSED, "--counts: at most %d shards",
                       CLI_COUNT_SHARDS);
  }
  return CLI_DONE;
}

// Options that need or exclude each other, and defaults that depend on others.
static int check_together(cli_diverge_args_t *args) {
  const cli_mechanism_info_t *mechanism = &cli_mechanisms[args->mechanism];
  const bool sized = args->mechanism != CLI_BY_RANDOM;
  if (args->exhaustive &&
      (sized || args->exits != NULL || args->returns != NULL ||
       args->counts != NULL || args->shard.of > 1)) {
    return cli_message(CLI_USAGE,
                       "--exhaustive: writes --branches FILE; it takes no "
                       "--by, --exits, --returns, --counts or --shard");
  }
  if (!args->exhaustive && args->only_exhaustive != NULL) {
    return cli_message(CLI_USAGE, "%s: only with --exhaustive",
                       args->only_exhaustive);
  }
  if (sized && args->size_text == NULL) {
    return cli_message(CLI_USAGE, "--by %s: give --size VALUE in %s",
                       mechanism->name, mechanism->unit);
  }
  if (!sized && args->size_text != NULL) {
    return cli_message(CLI_USAGE,
                       "--size %s: --by random has a --rate and no size",
                       args->size_text);
  }
  args->spread = args->spread > 0 ? args->spread : mechanism->spread;
  args->refinement =
      args->refinement > 0 ? args->refinement : mechanism->refinement;
  return check_files(args);
}

int cli_diverge_args(cli_diverge_args_t *args, int argc, char *const argv[]) {
  static const cli_syntax_t syntax = {"diverge", options,
                                      sizeof options / sizeof options[0], take};
  memset(args, 0, sizeof *args);
  args->samples = 100;
  args->cycles = 1;
  args->shard.index = args->shard.of = 1;
  args->patience = 100;
  args->section = 1e-3;
  args->seed = 1;
  args->depth = 3;
  args->count = 1000;
  args->grid = 1e-2;
  int code = cli_read_words(&syntax, args, argc, argv);
  if (code == CLI_DONE) {
    code = cli_need_scene(args->scene, "diverge");
  }
  return code == CLI_DONE ? check_together(args) : code;
}
