/// @file
/// reference COMMAND [OPTION VALUE]...: counts steps that say OK and are wrong.
/// Here are the options, the loop over machines and the report.
#include <assert.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "judge.h"

static const command_t *const commands[] = {&command_validate, &command_second,
                                            &command_branch, &command_energy,
                                            &command_table};
enum { COMMANDS = sizeof commands / sizeof commands[0] };

static count_t counts[64];
static int count_of_counts;

count_t *count_add(const char *scheme, const char *format, ...) {
  assert(count_of_counts < (int)(sizeof counts / sizeof *counts));
  count_t *count = &counts[count_of_counts++];
  va_list values;
  va_start(values, format);
  vsnprintf(count->what, sizeof count->what, format, values);
  va_end(values);
  count->scheme = scheme;
  return count;
}

void count_try(count_t *count, const trial_t *trial, bool hit) {
  ++count->tries;
  count->hits += hit;
  if (hit && count->scheme && count->hits <= trial->options->show) {
    printf("# %s, machine %ld:\n  ", count->what, trial->index);
    draw_print(&trial->machine, trial->t_end, count->scheme);
  }
}

// One line: hits, tries, rate and its 95 % interval (Wilson).
static void count_print(const count_t *count) {
  const double n = (double)count->tries, z = 1.959964, z2 = z * z;
  printf("%-50s %9ld of %9ld", count->what, count->hits, count->tries);
  if (count->tries > 0) {
    const double p = (double)count->hits / n;
    const double mid = (p + z2 / (2 * n)) / (1 + z2 / n);
    const double half =
        z * sqrt(p * (1 - p) / n + z2 / (4 * n * n)) / (1 + z2 / n);
    printf("  %9.3g %%  [%.3g, %.3g]", 100 * p, 100 * fmax(0, mid - half),
           100 * (mid + half));
  }
  printf("\n");
}

void judge_machines(const options_t *options, void (*judge)(trial_t *trial)) {
  for (long i = 0; i < options->machines; ++i) {
    trial_t trial = {.options = options,
                     .index = options->first + i,
                     .t_end = options->t_end};
    trial.draw = draw_begin(options->seed, (uint64_t)trial.index);
    trial.machine = draw_machine(&trial.draw, false);
    judge(&trial);
  }
  for (int i = 0; i < count_of_counts; ++i) count_print(&counts[i]);
}

double row_difference(const ref_machine_t *q, ref_state_t x,
                      const lib_row_t *row) {
  const real_t w = ref_w(q, x), v = ref_v(q, x);
  const real_t scale = ref_speed_scale(q, x);
  const real_t in_r = fabsl(x.r - row->r) / (fabsl(x.r) + q->beta);
  const real_t in_v = fabsl(v - row->v) / (fabsl(v) + scale);
  const real_t in_w = fabsl(w - row->w) / (fabsl(w) + fabsl(q->omega0));
  const real_t e = fmaxl(in_r, fmaxl(in_v, in_w));
  return e >= 0 ? (double)e : HUGE_VAL;
}

double state_difference(const ref_machine_t *q, ref_state_t a, ref_state_t b) {
  const lib_row_t row = {(double)b.r, (double)ref_v(q, b), (double)ref_w(q, b)};
  return row_difference(q, a, &row);
}

static int usage(void) {
  printf(
      "usage: reference COMMAND [--machines N] [--seed S] [--first I]\n"
      "  [--t-end T] [--show N]\n"
      "       reference table [--class A|A8|A'|B|...|K|all] [--dt LIST]\n"
      "  [--machines N] [--seed S] [--show N]; --first I --machines 1 shows "
      "one "
      "case\n");
  for (int i = 0; i < COMMANDS; ++i)
    printf("  %-12s %s\n", commands[i]->name, commands[i]->about);
  return 2;
}

static bool take(options_t *options, const char *name, const char *value) {
  if (strcmp(name, "--machines") == 0)
    options->machines = atol(value);
  else if (strcmp(name, "--seed") == 0)
    options->seed = strtoull(value, NULL, 10);
  else if (strcmp(name, "--first") == 0)
    options->first = atol(value);
  else if (strcmp(name, "--t-end") == 0)
    options->t_end = atof(value);
  else if (strcmp(name, "--show") == 0)
    options->show = atol(value);
  else if (strcmp(name, "--class") == 0)
    options->row = value;
  else if (strcmp(name, "--dt") == 0)
    options->dts = value;
  else
    return false;
  return true;
}

int main(int argc, char **argv) {
  options_t options = {.seed = 1, .show = 2, .row = "all"};
  setvbuf(stdout, NULL, _IOLBF, BUFSIZ);
  const command_t *command = NULL;
  for (int i = 0; argc >= 2 && i < COMMANDS; ++i) {
    if (strcmp(argv[1], commands[i]->name) == 0) {
      command = commands[i];
      options.machines = command->machines;
      options.t_end = command->t_end;
    }
  }
  bool good = command && argc % 2 == 0;
  for (int i = 2; good && i < argc; i += 2) {
    good = take(&options, argv[i], argv[i + 1]);
    if (!good) printf("unknown: %s %s\n", argv[i], argv[i + 1]);
  }
  if (!good) return usage();
  if (command->machines > 0)
    printf("reference %s --machines %ld --seed %llu --first %ld\n", argv[1],
           options.machines, (unsigned long long)options.seed, options.first);
  return command->run(&options);
}
