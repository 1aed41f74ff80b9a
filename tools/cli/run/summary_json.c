// The summary of a run as JSON: what the summary for a person says, in SI units
// and with all digits. It is one line, and the last one on standard error, so
// that notes and messages before it do no harm.

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../setup/names.h"
#include "../setup/setup.h"
#include "../text/number.h"
#include "../text/summary.h"
#include "record.h"

static void put_request(const cli_run_t *run) {
  const cli_setup_t now = cli_run_setup(run), *setup = &now;
  cli_put_begin("run");
  cli_put_word("scene", setup->scene->name);
  cli_put_hash("scene_hash", cli_scene_hash(run->setup));
  cli_put_hash("parameters", tf_params_hash(&setup->params));
  cli_put_word("law", tf_tyre_law_name(setup->params.law));
  cli_put_word("rule", tf_rule_name(setup->params.rule));
  cli_put_count("seed", setup->seed);
  cli_put_word("scheme", run->scheme->name);
  cli_put_real("dt", setup->machine.dt);
  cli_put_count("first", run->first);
  cli_put_count("steps", run->done);
  cli_put_count("asked", run->steps);
  cli_put_double("t", cli_run_time(run, run->done));
}

static void put_replay(const cli_run_t *run) {
  char changes[CLI_CHANGES_ROOM];
  if (!run->replays) {
    return;
  }
  (void)cli_run_changes(run, changes);
  (void)fputs("\"replay\": {", stderr);
  cli_put_text("name", run->replay.name);
  cli_put_count("commands", run->replay.commands);
  cli_put_count("states", run->replay.states);
  cli_put_hash("began_with", tf_params_hash(&run->setup->params));
  (void)fprintf(stderr, "\"changes\": \"%s\"}, ",
                changes + strspn(changes, " "));
}

// Inputs that a board got by a command, as they stand at the end.
static void put_held(const tf_simulation_t *simulation) {
  const tf_input_t *input = &simulation->input;
  if (simulation->source == TF_INPUT_SCENE) {
    return;
  }
  (void)fputs("\"held\": {", stderr);
  cli_put_word("source",
               simulation->source == TF_INPUT_SAFE ? "safe" : "outside");
  cli_put_count("deadman", simulation->deadman);
  cli_put_count("left", simulation->left);
  cli_put_real("omega0", input->omega0);
  cli_put_real("r0", input->r0);
  cli_put_real("force", input->force);
  cli_put_real("torque", input->torque);
  cli_put_number("alpha", (double)input->alpha,
                 sizeof input->alpha == sizeof(float));
  (void)fputs("}, ", stderr);
}

static void put_table(const char *key, const cli_inputs_t *table) {
  if (table->count == 0) {
    return;
  }
  (void)fprintf(stderr, "\"%s\": {", key);
  cli_put_text("name", table->name);
  cli_put_word("between", table->linear ? "linear" : "held");
  cli_put_count("rows", table->count);
  cli_put_count("first", table->first);
  cli_put_count("last", table->last);
  cli_put_count("passed", table->passed);
  cli_put_count("within", table->within);
  cli_put_count("jumps", table->jumps);
  cli_put_real("t_first", table->rows[table->first].t);
  cli_put_real("t_last", table->rows[table->last].t);
  cli_put_hash("crc32", cli_inputs_hash(table));
  (void)fputs("\"applied\": {", stderr);
  const char *comma = "";
  for (size_t i = 0; i < CLI_INPUTS; i++) {
    if (table->given[i] && table->applied) {
      char low[CLI_REAL_ROOM], high[CLI_REAL_ROOM];
      (void)cli_write_real(low, table->low[i]);
      (void)cli_write_real(high, table->high[i]);
      (void)fprintf(stderr, "%s\"%s\": [%s, %s]", comma,
                    cli_input_columns[i].name, low, high);
      comma = ", ";
    }
  }
  (void)fputs("}}, ", stderr);
}

static void put_quality(const cli_run_t *run) {
  const tf_tally_t *tally = &run->tally;
  cli_put_count("ambiguous", run->ambiguity.steps);
  cli_put_double("ambiguous_since", run->ambiguity.since);
  if (run->ambiguity.start > 0) {
    cli_put_count("choices_at_start", run->ambiguity.start);
  } else {
    cli_put_null("choices_at_start");
  }
  cli_tally_put(tally);
  cli_put_double("reserved_since", cli_tally_reserved(tally) > 0
                                       ? cli_run_time(run, tally->first)
                                       : (double)NAN);
  cli_put_double("largest_h_in_stick", run->largest_h);
  cli_put_double("largest_residual", run->largest_residual);
  cli_put_double("largest_error", run->args->accuracy > 0
                                      ? (double)run->system.error
                                      : (double)NAN);
}

static void put_events(const cli_events_t *events) {
  static const char *const names[CLI_EVENT_KINDS] = {
      "slip_to_stick", "stick_to_slip", "slip_to_slip", "pinned_to_stick",
      "codim2",        "two_fold",      "returned"};
  (void)fputs("\"events\": {", stderr);
  for (size_t i = 0; i < CLI_EVENT_KINDS; i++) {
    cli_put_count(names[i], events->counts[i]);
  }
  (void)fputs("\"list\": [", stderr);
  for (size_t i = 0; i < events->used; i++) {
    const cli_event_t *event = &events->list[i];
    (void)fputs(i > 0 ? ", {" : "{", stderr);
    cli_put_double("t", event->t);
    cli_put_double("r", event->r);
    cli_put_double("omega", event->omega);
    cli_put_double("g", event->g);
    cli_put_double("lambda", event->has_lambda ? event->lambda : (double)NAN);
    cli_put_word("from", tf_mode_name(event->from));
    cli_put_word("to", tf_mode_name(event->to));
    (void)fputs("\"kinds\": [", stderr);
    const char *comma = "";
    for (size_t kind = 0; kind < CLI_EVENT_KINDS; kind++) {
      if (((event->kinds >> kind) & 1u) != 0) {
        (void)fprintf(stderr, "%s\"%s\"", comma, names[kind]);
        comma = ", ";
      }
    }
    (void)fputs("]}", stderr);
  }
  (void)fputs("]}, ", stderr);
}

static void put_final(const cli_run_t *run) {
  const tf_state_t *state = &run->system.state;
  (void)fputs("\"final\": {", stderr);
  cli_put_real("r", state->r);
  cli_put_real("v", state->v);
  cli_put_real("omega", state->w);
  cli_put_real("phi", state->phi);
  cli_put_real("h", run->report.slip.h);
  cli_put_real("g", run->report.slip.g);
  (void)fprintf(stderr, "\"mode\": \"%s\"}, ", tf_mode_name(state->mode));
}

void cli_summary_json(const cli_run_t *run, int code) {
  static const char *const ends[] = {[CLI_ENDED] = "done",
                                     [CLI_INTERRUPTED] = "interrupted",
                                     [CLI_STEP_REFUSED] = "refused",
                                     [CLI_NOT_REPLAYED] = "not replayed",
                                     [CLI_NOT_WRITTEN] = "not written"};
  put_request(run);
  put_table("profile", &run->drive.profile);
  put_table("inputs", &run->drive.table);
  put_replay(run);
  put_held(&run->replay.simulation);
  put_events(&run->events);
  put_quality(run);
  put_final(run);
  cli_put_double("seconds", run->seconds);
  cli_put_double("output_seconds", run->output_seconds);
  cli_put_count("late", run->late);
  cli_put_double("latest", run->latest);
  cli_put_word("end", ends[run->end]);
  cli_put_exit(code);
}
