// The summary of a run as JSON: what the summary for a person says, in SI units
// and with all digits. It is one line, and the last one on standard error, so
// that notes and messages before it do no harm.

#include "summary_json.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>

#include "../setup/names.h"
#include "../text/commit.h"
#include "../text/number.h"

// Numbers: of a double as a double, of the state in the type of the program. A
// number that is none is null.
static void put_number(const char *key, double value, bool is_real) {
  char text[CLI_REAL_ROOM] = "null";
  if (isfinite(value)) {
    (void)cli_write_number(text, value,
                           is_real && sizeof(tf_real_t) == sizeof(float));
  }
  (void)fprintf(stderr, "\"%s\": %s", key, text);
}

static void put_real(const char *key, tf_real_t value) {
  put_number(key, (double)value, true);
  (void)fputs(", ", stderr);
}

static void put_double(const char *key, double value) {
  put_number(key, value, false);
  (void)fputs(", ", stderr);
}

static void put_count(const char *key, uint64_t value) {
  (void)fprintf(stderr, "\"%s\": %" PRIu64 ", ", key, value);
}

static void put_word(const char *key, const char *word) {
  (void)fprintf(stderr, "\"%s\": \"%s\", ", key, word);
}

// Text from outside: the path of a file.
static void put_text(const char *key, const char *text) {
  (void)fprintf(stderr, "\"%s\": \"", key);
  for (; *text != '\0'; text++) {
    const unsigned char byte = (unsigned char)*text;
    if (byte == '"' || byte == '\\') {
      (void)fprintf(stderr, "\\%c", byte);
    } else if (byte < ' ') {
      (void)fprintf(stderr, "\\u%04x", (unsigned)byte);
    } else {
      (void)fputc(byte, stderr);
    }
  }
  (void)fputs("\", ", stderr);
}

static void put_request(const cli_run_t *run) {
  const cli_setup_t *setup = run->setup;
  (void)fputs("{", stderr);
  put_word("version", TF_VERSION);
  put_word("commit", cli_commit);
  put_word("number", sizeof(tf_real_t) == sizeof(float) ? "float" : "double");
  put_word("scene", setup->scene->name);
  (void)fprintf(stderr, "\"parameters\": \"%08" PRIx32 "\", ",
                tf_params_hash(&setup->params));
  put_word("law", cli_law_name(setup->params.law));
  put_word("rule", cli_rule_name(setup->params.rule));
  put_count("seed", setup->seed);
  put_word("scheme", run->scheme->name);
  put_real("dt", setup->machine.dt);
  put_count("first", run->first);
  put_count("steps", run->done);
  put_count("asked", run->steps);
  put_double("t", cli_run_time(run, run->done));
}

static void put_table(const char *key, const cli_inputs_t *table) {
  if (table->count == 0) {
    return;
  }
  (void)fprintf(stderr, "\"%s\": {", key);
  put_text("name", table->name);
  put_word("between", table->linear ? "linear" : "held");
  put_count("rows", table->count);
  put_count("first", table->first);
  put_count("last", table->at);
  put_real("t_first", table->rows[table->first].t);
  put_number("t_last", (double)table->rows[table->at].t, true);
  (void)fputs("}, ", stderr);
}

static void put_quality(const cli_run_t *run) {
  const tf_tally_t *tally = &run->tally;
  const uint64_t reserved = tally->degraded + tally->coarse + tally->fell_back;
  put_count("ambiguous", run->ambiguous_steps);
  put_double("ambiguous_since",
             run->ambiguous_steps > 0 ? run->ambiguous_since : (double)NAN);
  put_count("degraded", tally->degraded);
  put_count("coarse", tally->coarse);
  put_count("fell_back", tally->fell_back);
  put_double("reserved_since",
             reserved > 0 ? cli_run_time(run, tally->first) : (double)NAN);
  put_double("largest_h_in_stick", run->largest_h);
  put_double("largest_residual", run->largest_residual);
}

static void put_events(const cli_events_t *events) {
  static const char *const names[CLI_EVENT_KINDS] = {
      "slip_to_stick",   "stick_to_slip", "slip_to_slip", "pinned_to_stick",
      "codimension_two", "two_fold",      "returned"};
  (void)fputs("\"events\": {", stderr);
  for (size_t i = 0; i < CLI_EVENT_KINDS; i++) {
    put_count(names[i], events->counts[i]);
  }
  (void)fputs("\"list\": [", stderr);
  for (size_t i = 0; i < events->used; i++) {
    const cli_event_t *event = &events->list[i];
    (void)fputs(i > 0 ? ", {" : "{", stderr);
    put_double("t", event->t);
    put_double("r", event->r);
    put_double("omega", event->omega);
    put_double("g", event->g);
    put_double("lambda", event->has_lambda ? event->lambda : (double)NAN);
    put_word("from", tf_mode_name(event->from));
    put_word("to", tf_mode_name(event->to));
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
  put_real("r", state->r);
  put_real("v", state->v);
  put_real("omega", state->w);
  put_real("phi", state->phi);
  put_real("h", run->report.slip.h);
  put_real("g", run->report.slip.g);
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
  put_events(&run->events);
  put_quality(run);
  put_final(run);
  put_double("seconds", run->seconds);
  put_double("output_seconds", run->output_seconds);
  put_count("late", run->late);
  put_double("latest", run->latest);
  put_word("end", ends[run->end]);
  (void)fprintf(stderr, "\"exit\": %d}\n", code);
  (void)fflush(stderr);
}
