// One row for each file and cycle. A field of something that did not happen is
// empty; no number stands for "none".

#include "rows.h"

#include "../text/buffer.h"

static cli_buffer_t empty(char out[CLI_DIVERGE_ROW]) {
  out[0] = '\0';
  const cli_buffer_t text = {out, 0, CLI_DIVERGE_ROW, false};
  return text;
}

// A comma, and the number if there is one.
static void add_field(cli_buffer_t *text, bool exists, double value) {
  cli_add(text, ",");
  if (exists) {
    cli_add_real(text, (tf_real_t)value);
  }
}

static void add_name(cli_buffer_t *text, uint64_t sample, uint64_t cycle) {
  cli_add_count(text, sample);
  cli_add(text, ",");
  cli_add_count(text, cycle);
}

size_t cli_exit_header(char out[CLI_DIVERGE_ROW]) {
  cli_buffer_t text = empty(out);
  cli_add(&text, "sample,cycle,time,r,omega,g,side,phase,how,section_time\n");
  return text.used;
}

size_t cli_return_header(char out[CLI_DIVERGE_ROW]) {
  cli_buffer_t text = empty(out);
  cli_add(&text,
          "sample,cycle,outcome,time,arrived,exit_r,landing_time,"
          "landing_r,landings,windings\n");
  return text.used;
}

size_t cli_exit_row(char out[CLI_DIVERGE_ROW], uint64_t sample, uint64_t cycle,
                    const cli_cycle_t *what) {
  cli_buffer_t text = empty(out);
  if (!what->left) {
    return 0;
  }
  add_name(&text, sample, cycle);
  add_field(&text, true, what->exit_t - what->arrived);
  add_field(&text, true, what->exit_r);
  add_field(&text, true, what->exit_omega);
  add_field(&text, true, what->exit_g);
  cli_add(&text, what->side < 0 ? ",slip-" : ",slip+");
  add_field(&text, what->phase >= 0, what->phase);
  cli_add(&text, what->released ? ",released" : ",left");
  add_field(&text, what->phase >= 0, what->section_t - what->arrived);
  cli_add(&text, "\n");
  return text.used;
}

size_t cli_return_row(char out[CLI_DIVERGE_ROW], uint64_t sample,
                      uint64_t cycle, const cli_cycle_t *what) {
  cli_buffer_t text = empty(out);
  add_name(&text, sample, cycle);
  cli_add(&text, ",");
  cli_add(&text, cli_outcome_name(what->outcome));
  add_field(&text, true,
            what->ended - (what->left ? what->exit_t : what->arrived));
  add_field(&text, true, what->arrived);
  add_field(&text, what->left, what->exit_r);
  add_field(&text, what->landed, what->land_t - what->exit_t);
  add_field(&text, what->landed, what->land_r);
  cli_add(&text, ",");
  cli_add_count(&text, what->landings);
  cli_add(&text, ",");
  cli_add_count(&text, what->windings);
  cli_add(&text, "\n");
  return text.used;
}
