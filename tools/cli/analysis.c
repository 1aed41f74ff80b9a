// Command line, grid and output of the commands that look at a machine without
// running it. As in `run`, all is read and checked before a file is opened, and
// rows reach it whole.

#include "analysis.h"

#include <stdio.h>
#include <string.h>

#include "text.h"

#define MOST_VALUES 1000000u // of one range
#define FLUSH_EVERY 0.2      // [s]

static int given_twice(const char *option, const char *value) {
  return cli_complain(CLI_USAGE, "%s %s: %s was already given", option, value,
                      option);
}

static int read_number(const char *option, const char *whole, const char *text,
                       tf_real_t *value) {
  const char *why = "";
  if (!cli_read_real(text, value, &why)) {
    return cli_complain(CLI_USAGE, "%s %s: '%s' %s", option, whole, text, why);
  }
  if (!(*value >= -TF_STATE_LIMIT && *value <= TF_STATE_LIMIT)) {
    return cli_complain(CLI_REFUSED, "%s %s: %s must lie in [%g, %g] %s",
                        option, whole, option + 2, -(double)TF_STATE_LIMIT,
                        (double)TF_STATE_LIMIT,
                        strcmp(option, "--r") == 0 ? "m" : "rad/s");
  }
  return CLI_DONE;
}

// A:B:N into its three parts.
static int read_grid(const char *option, const char *value,
                     cli_range_t *range) {
  char parts[3][CLI_REAL_ROOM];
  const char *rest = value;
  for (int i = 0; i < 3; i++) {
    const size_t length = strcspn(rest, ":");
    if (length >= CLI_REAL_ROOM || (rest[length] == ':') != (i < 2)) {
      return cli_complain(CLI_USAGE, "%s %s: expected A:B:N", option, value);
    }
    memcpy(parts[i], rest, length);
    parts[i][length] = '\0';
    rest += length + (i < 2 ? 1 : 0);
  }
  if (!cli_read_whole(parts[2], 1, MOST_VALUES, &range->count)) {
    return cli_complain(CLI_USAGE, "%s %s: N must be a whole number in [1, %u]",
                        option, value, MOST_VALUES);
  }
  int code = read_number(option, value, parts[0], &range->from);
  if (code == CLI_DONE) {
    code = read_number(option, value, parts[1], &range->to);
  }
  if (code == CLI_DONE && range->count == 1 &&
      (range->to > range->from || range->to < range->from)) {
    code = cli_complain(CLI_USAGE, "%s %s: one value cannot be both %s and %s",
                        option, value, parts[0], parts[1]);
  }
  return code;
}

static int read_range(const cli_analysis_t *a, const char *option,
                      const char *value, cli_range_t *range) {
  if (range->text != NULL) {
    return given_twice(option, value);
  }
  range->text = value;
  if (a->takes == CLI_TAKES_GRID) {
    return read_grid(option, value, range);
  }
  range->count = 1;
  const int code = read_number(option, value, value, &range->from);
  range->to = range->from;
  return code;
}

static int read_out(cli_analysis_t *a, const char *value) {
  if (a->out != NULL) {
    return given_twice("--out", value);
  }
  if (value[0] == '\0') {
    return cli_complain(CLI_USAGE, "--out: the name of the file is empty");
  }
  a->out = value;
  return CLI_DONE;
}

// The options of these commands; those from FIRST_PLACE on are of a place.
static const char *const options[] = {"--set", "--out", "--r", "--omega"};
#define OPTIONS (sizeof options / sizeof options[0])
#define FIRST_PLACE 2

static size_t options_of(const cli_analysis_t *a) {
  return a->takes == CLI_TAKES_NOTHING ? FIRST_PLACE : OPTIONS;
}

static int unknown_option(const cli_analysis_t *a, const char *name) {
  cli_closest_t closest = cli_closest_to(name);
  for (size_t i = 0; i < options_of(a); i++) {
    cli_closest_offer(&closest, options[i]);
  }
  const cli_hint_t hint = cli_closest_hint(&closest);
  return cli_complain(CLI_USAGE,
                      "unknown option %s%s%s%s ('twofold help %s' lists them)",
                      name, hint.before, hint.name, hint.after, a->command);
}

// next: the word behind, NULL at the end; *at moves on where it is the value.
static int read_option(cli_analysis_t *a, const char *word, const char *next,
                       int *at) {
  const size_t length = strcspn(word, "=");
  size_t i = 0;
  while (i < options_of(a) && (strlen(options[i]) != length ||
                               strncmp(options[i], word, length) != 0)) {
    i++;
  }
  if (i == options_of(a)) {
    return unknown_option(a, word);
  }
  const char *value = NULL;
  if (word[length] == '=') {
    value = word + length + 1;
  } else if (next != NULL) {
    value = next;
    ++*at;
  } else {
    return cli_complain(CLI_USAGE, "%s: expected a value", options[i]);
  }
  switch (i) {
    case 0:
      return cli_settings_add(&a->settings, options[i], value);
    case 1:
      return read_out(a, value);
    case 2:
      return read_range(a, options[i], value, &a->r);
    default:
      return read_range(a, options[i], value, &a->omega);
  }
}

static int read_words(cli_analysis_t *a, int argc, char *const argv[]) {
  for (int at = 0; at < argc; at++) {
    int code = CLI_DONE;
    if (argv[at][0] == '-') {
      code = read_option(a, argv[at], at + 1 < argc ? argv[at + 1] : NULL, &at);
    } else if (a->scene != NULL) {
      code = cli_complain(CLI_USAGE, "%s: one scene at a time (%s was given)",
                          argv[at], a->scene->name);
    } else {
      a->scene = cli_find_scene(argv[at]);
      code = a->scene != NULL ? CLI_DONE : CLI_USAGE;
    }
    if (code != CLI_DONE) {
      return code;
    }
  }
  if (a->scene == NULL) {
    return cli_complain(CLI_USAGE,
                        "%s: which scene? ('twofold scenes' lists them)",
                        a->command);
  }
  if (a->takes != CLI_TAKES_NOTHING &&
      (a->r.text == NULL || a->omega.text == NULL)) {
    const bool grid = a->takes == CLI_TAKES_GRID;
    return cli_complain(CLI_USAGE, "%s: %s %s is missing", a->command,
                        a->r.text == NULL ? "--r" : "--omega",
                        grid                ? "A:B:N"
                        : a->r.text == NULL ? "R"
                                            : "W");
  }
  return CLI_DONE;
}

static bool has_kappa(const cli_setup_t *setup) {
  for (size_t i = 0; i < TF_PARAMETERS; i++) {
    if (strcmp(tf_parameter_ranges[i].name, "kappa") == 0) {
      return setup->set_param[i] != NULL || setup->params.kappa > 0;
    }
  }
  return false;
}

static const cli_setting_t *setting_of(const cli_analysis_t *a,
                                       const char *name) {
  for (size_t i = 0; i < a->settings.count; i++) {
    if (strcmp(a->settings.list[i].name, name) == 0) {
      return &a->settings.list[i];
    }
  }
  return NULL;
}

// Settings that are of a run alone, or that the command is to find.
static void notes(const cli_analysis_t *a, bool finds_kappa) {
  static const char *const idle[] = {
      "kappa", "k2", "dt", "theta", "tolerance", "r", "v", "omega", "h", "phi"};
  cli_setup_notes(&a->setup, "", "");
  for (size_t i = finds_kappa ? 0 : 2; i < sizeof idle / sizeof idle[0]; i++) {
    const cli_setting_t *setting = setting_of(a, idle[i]);
    if (setting != NULL) {
      (void)cli_complain(CLI_DONE, "note: %s %s has no effect: %s %s",
                         setting->option, setting->text, a->command,
                         i < 2 ? "finds it" : "does not run");
    }
  }
}

int cli_analysis_read(cli_analysis_t *a, const char *command, cli_takes_t takes,
                      bool finds_kappa, int argc, char *const argv[]) {
  memset(a, 0, sizeof *a);
  a->command = command;
  a->takes = takes;
  int code = read_words(a, argc, argv);
  if (code == CLI_DONE) {
    code = cli_setup_read(&a->setup, a->scene, &a->settings, NULL);
  }
  if (code == CLI_DONE && finds_kappa && !has_kappa(&a->setup)) {
    a->setup.params.kappa = 1;
  }
  if (code == CLI_DONE) {
    code = cli_setup_machine(&a->setup);
  }
  if (code == CLI_DONE) {
    notes(a, finds_kappa);
  }
  return code;
}

cli_culprit_t cli_analysis_culprit(const cli_analysis_t *a, const char *name) {
  const cli_setting_t *setting = setting_of(a, name);
  const cli_culprit_t scene = {"scene", a->scene->name};
  const cli_culprit_t typed = {setting != NULL ? setting->option : "",
                               setting != NULL ? setting->text : ""};
  return setting != NULL ? typed : scene;
}

int cli_analysis_needs_jump(const cli_analysis_t *a, bool needs_moment) {
  const tf_tyre_law_t law = a->setup.params.law;
  const cli_culprit_t culprit = cli_analysis_culprit(a, "law");
  if (needs_moment ? law == TF_TYRE_JUMP : tf_tyre_is_set_valued(law)) {
    return CLI_DONE;
  }
  return cli_complain(
      CLI_REFUSED, "%s %s: %s needs law %s, not %s: %s", culprit.option,
      culprit.text, a->command, needs_moment ? "jump" : "jump or coulomb",
      cli_law_name(law),
      tf_tyre_is_set_valued(law) ? "stick has no moment under it"
                                 : "it does not jump at h = 0");
}

static int open_output(cli_analysis_t *a) {
  cli_catch_signals();
  if (cli_output_open(&a->output, a->out)) {
    return CLI_DONE;
  }
  return cli_complain(CLI_STOPPED, "--out %s: %s", a->out,
                      strerror(a->output.error));
}

static int close_output(cli_analysis_t *a) {
  if (cli_output_close(&a->output)) {
    return CLI_DONE;
  }
  return cli_complain(CLI_STOPPED, "%s: %s", a->output.name,
                      strerror(a->output.error));
}

int cli_analysis_write(cli_analysis_t *a, const char *text, size_t length) {
  const int code = open_output(a);
  if (code != CLI_DONE) {
    return code;
  }
  (void)cli_output_lines(&a->output, text, length);
  return close_output(a);
}

static tf_real_t value_at(const cli_range_t *range, uint64_t i) {
  if (i + 1 == range->count) {
    return range->to;
  }
  const double share = (double)i / (double)(range->count - 1);
  return (tf_real_t)((double)range->from +
                     ((double)range->to - (double)range->from) * share);
}

// The rows of one r.
static int write_line(cli_analysis_t *a, tf_real_t r, cli_grid_row_t row) {
  char text[CLI_GRID_ROOM];
  for (uint64_t j = 0; j < a->omega.count; j++) {
    size_t length = 0;
    if (cli_stop_asked()) {
      return cli_complain(CLI_STOPPED, "interrupted at r = %g m", (double)r);
    }
    const int code = row(a, r, value_at(&a->omega, j), text, &length);
    if (code != CLI_DONE) {
      return code;
    }
    if (!cli_output_lines(&a->output, text, length)) {
      return CLI_STOPPED; // close_output complains
    }
    if (cli_now() - a->output.flushed >= FLUSH_EVERY) {
      (void)cli_output_flush(&a->output);
    }
  }
  return CLI_DONE;
}

int cli_analysis_grid(cli_analysis_t *a, const char *header,
                      cli_grid_row_t row) {
  int code = open_output(a);
  if (code != CLI_DONE) {
    return code;
  }
  (void)cli_output_lines(&a->output, header, strlen(header));
  for (uint64_t i = 0; i < a->r.count && code == CLI_DONE; i++) {
    code = write_line(a, value_at(&a->r, i), row);
  }
  const int closed = close_output(a);
  return code != CLI_DONE ? code : closed;
}
