// The rows of `diverge`: one of each file for every cycle. What did not happen
// in a cycle is an empty field, never a number that means none.

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "diverge.h"
#include "text.h"

static size_t put(char *out, size_t at, const char *text) {
  const size_t length = strlen(text);
  memcpy(out + at, text, length + 1);
  return at + length;
}

// A comma and a number, or a comma alone.
static size_t put_real(char *out, size_t at, bool is, double value) {
  char text[CLI_REAL_ROOM] = "";
  if (is) {
    (void)cli_write_real(text, (tf_real_t)value);
  }
  return put(out, put(out, at, ","), text);
}

static size_t put_count(char *out, size_t at, uint64_t value) {
  char text[CLI_REAL_ROOM];
  (void)snprintf(text, sizeof text, "%" PRIu64, value);
  return put(out, at, text);
}

static size_t put_name(char *out, uint64_t sample, uint64_t cycle) {
  return put_count(out, put(out, put_count(out, 0, sample), ","), cycle);
}

size_t cli_exit_header(char out[CLI_DIVERGE_ROW]) {
  return put(out, 0,
             "sample,cycle,time,r,omega,g,side,phase,how,"
             "section_time\n");
}

size_t cli_return_header(char out[CLI_DIVERGE_ROW]) {
  return put(out, 0,
             "sample,cycle,outcome,time,arrived,exit_r,landing_time,"
             "landing_r,landings,windings\n");
}

size_t cli_exit_row(char out[CLI_DIVERGE_ROW], uint64_t sample, uint64_t cycle,
                    const cli_cycle_t *what) {
  if (!what->left) {
    out[0] = '\0';
    return 0;
  }
  size_t at = put_name(out, sample, cycle);
  at = put_real(out, at, true, what->exit_t - what->arrived);
  at = put_real(out, at, true, what->exit_r);
  at = put_real(out, at, true, what->exit_omega);
  at = put_real(out, at, true, what->exit_g);
  at = put(out, at, what->side < 0 ? ",slip-" : ",slip+");
  at = put_real(out, at, what->phase >= 0, what->phase);
  at = put(out, at, what->released ? ",released" : ",left");
  at = put_real(out, at, what->phase >= 0, what->section_t - what->arrived);
  return put(out, at, "\n");
}

size_t cli_return_row(char out[CLI_DIVERGE_ROW], uint64_t sample,
                      uint64_t cycle, const cli_cycle_t *what) {
  size_t at = put_name(out, sample, cycle);
  at = put(out, put(out, at, ","), cli_outcome_name(what->outcome));
  at = put_real(out, at, true,
                what->ended - (what->left ? what->exit_t : what->arrived));
  at = put_real(out, at, true, what->arrived);
  at = put_real(out, at, what->left, what->exit_r);
  at = put_real(out, at, what->landed, what->land_t - what->exit_t);
  at = put_real(out, at, what->landed, what->land_r);
  at = put_count(out, put(out, at, ","), what->landings);
  at = put_count(out, put(out, at, ","), what->windings);
  return put(out, at, "\n");
}
