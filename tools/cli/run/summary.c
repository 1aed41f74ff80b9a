// The summary of a run, for a person. It repeats the request, because a log
// often outlives its command line, and it says how often more than one mode
// was consistent, because that is what the simulator is about. All of it goes
// to standard error, so that standard output has nothing but the rows.

#include "../text/summary.h"

#include "run.h"

static void print_request(const cli_run_t *run) {
  const cli_setup_t setup = cli_run_setup(run);
  cli_say("scene      %s, law %s\n", setup.scene->name,
          tf_tyre_law_name(setup.params.law));
  cli_say("scheme     %s, rule %s", motion_scheme_name(run->setup->scheme),
          tf_rule_name(setup.params.rule));
  if (setup.params.rule == TF_RULE_RANDOM) {
    cli_say(":%" PRIu32 ", exit rate %g /s", setup.seed,
            (double)setup.params.rate);
  }
  cli_say("\nsteps      %" PRIu64 " of %" PRIu64 ", dt = %g s, t = %g s",
          run->done, run->steps, (double)setup.machine.dt,
          cli_run_time(run, run->done));
  if (run->first > 0)
    cli_say(", %" PRIu64 " of them by another run", run->first);
  cli_say("\n");
}

// The rows of a table that the steps came to see, and what was applied to them.
static void print_table(const cli_inputs_t *table) {
  if (table->count == 0) return;
  cli_say("inputs     %s, %s: %zu of %zu rows, t = %g to %g s%s", table->name,
          table->linear ? "linear" : "held",
          table->last - table->first + 1 - table->passed, table->count,
          (double)table->rows[table->first].t,
          (double)table->rows[table->last].t,
          table->applied ? "; applied" : "");
  const char *comma = " ";
  for (size_t i = 0; i < CLI_INPUTS; i++) {
    if (table->given[i] && table->applied) {
      cli_say("%s%s in [%.6g, %.6g] %s", comma, cli_input_columns[i].name,
              (double)table->low[i], (double)table->high[i],
              cli_input_columns[i].unit);
      comma = ", ";
    }
  }
  cli_say("\n");
  if (table->passed > 0) {
    cli_say("           %zu other rows lie between two steps and never held\n",
            table->passed);
  }
  if (table->within > 0) {
    cli_say(
        "           %zu times of rows lie within a step, %zu of them jumps\n",
        table->within, table->jumps);
  }
}

// Inputs that a board got by a command, as they stand at the end.
static void print_held(const tf_simulation_t *simulation) {
  const tf_input_t *input = &simulation->input;
  if (simulation->source == TF_INPUT_SAFE) {
    cli_say("inputs     safe ones: those of a command have expired\n");
  } else if (simulation->source == TF_INPUT_SET) {
    cli_say(
        "inputs     by a command: omega0 = %.6g rad/s, r0 = %.6g m, force = "
        "%.6g N,\n           torque = %.6g N m, alpha = %.6g rad/s^2",
        (double)input->omega0, (double)input->r0, (double)input->force,
        (double)input->torque, (double)input->alpha);
    if (simulation->deadman > 0)
      cli_say(", for %" PRIu32 " more steps", simulation->left);
    cli_say("\n");
  }
}

// Room for an option of each parameter, the rule, and the terminating zero.
#define CHANGES_ROOM 1024

// What commands of a replay have changed, as the options, each behind a space,
// by which another run is of the same machine.
static size_t changes_of(const cli_run_t *run, char out[CHANGES_ROOM]) {
  cli_buffer_t text = {out, 0, CHANGES_ROOM, false};
  const cli_setup_t now = cli_run_setup(run);
  const tf_params_t *was = &run->setup->params;
  out[0] = '\0';
  for (size_t i = 0; i < TF_PARAMETERS; i++) {
    const tf_real_t value = cli_parameter(&now.params, i);
    const tf_real_t before = cli_parameter(was, i);
    if (memcmp(&value, &before, sizeof value) != 0) {
      cli_add_form(&text, " --set %s=%g", tf_parameter_ranges[i].name,
                   (double)value);
    }
  }
  const bool draws = now.params.rule == TF_RULE_RANDOM;
  if (was->rule != now.params.rule || (draws && run->setup->seed != now.seed)) {
    cli_add_form(&text, " --select %s", tf_rule_name(now.params.rule));
    if (draws) cli_add_form(&text, ":%u", now.seed);
  }
  return text.used;
}

static void print_drive(const cli_run_t *run) {
  if (run->replays) {
    cli_say("replay     %s: %" PRIu64 " commands took effect, %" PRIu64
            " states were compared\n",
            run->replay.session.name, run->replay.commands, run->replay.states);
    char changes[CHANGES_ROOM];
    if (changes_of(run, changes) > 0)
      cli_say("           which now needs%s\n", changes);
  } else {
    print_table(&run->drive.profile);
    print_table(&run->drive.table);
  }
  print_held(&run->replay.simulation);
}

// The events in words: their counts, then one line each.

#define EVENT_ROOM 96

static void describe(const cli_event_t *event, char out[EVENT_ROOM]) {
  static const char *const endings[] = {"th", "st", "nd", "rd"};
  cli_buffer_t text = {out, 0, EVENT_ROOM, false};
  out[0] = '\0';
  if (event->from != event->to) {
    cli_add_form(&text, "%s to %s", tf_mode_name(event->from),
                 tf_mode_name(event->to));
  }
  const char *comma = text.used > 0 ? ", " : "";
  if (((event->kinds >> CLI_TWO_FOLD) & 1u) != 0) {
    const uint64_t n = event->arrival - 1; // 1st, 2nd, 3rd, 4th, 11th, ...
    const bool plain = n % 10 > 3 || (n / 10) % 10 == 1;
    if (n == 0) {
      cli_add_form(&text, "%stwo-fold reached", comma);
    } else {
      cli_add_form(&text, "%sreturned to the two-fold (%" PRIu64 "%s time)",
                   comma, n, endings[plain ? 0 : n % 10]);
    }
  } else if (((event->kinds >> CLI_RETURNED) & 1u) != 0) {
    cli_add_form(&text, "%sreturned after %" PRIu64 " changes of slip", comma,
                 event->windings);
  } else if (((event->kinds >> CLI_CODIMENSION_TWO) & 1u) != 0) {
    cli_add_form(&text, "%scodimension two", comma);
  }
}

static void print_merged(uint64_t merged) {
  if (merged > 0)
    cli_say("  ... %" PRIu64 " x slip to slip (--events all)\n", merged);
}

static void print_list(const cli_events_t *events) {
  uint64_t left = events->steps; // without those that the list accounts for
  if (events->used > 0) {
    cli_say("  %-11s%11s%15s%12s%12s  %s\n", "t [s]", "r [m]", "omega [rad/s]",
            "g [m/s]", "lambda [N]", "event");
  }
  for (size_t i = 0; i < events->used; i++) {
    const cli_event_t *event = &events->list[i];
    char text[EVENT_ROOM];
    char lambda[16] = "-";
    print_merged(event->merged);
    left -= event->merged + 1;
    describe(event, text);
    if (!isnan(event->lambda))
      (void)snprintf(lambda, sizeof lambda, "%.5g", event->lambda);
    cli_say("  %-11.7g%11.5g%15.5g%12.5g%12s  %s\n", event->t, event->r,
            event->omega, event->g, lambda, text);
  }
  if (events->used < events->limit) {
    print_merged(events->merged);
    left -= events->merged;
  }
  if (left > 0) cli_say("  ... %" PRIu64 " more events (--events all)\n", left);
}

static void print_events(const cli_events_t *events) {
  static const char *const names[CLI_EVENT_KINDS] = {
      "slip to stick",   "stick to slip",    "slip to slip", "pinned to stick",
      "codimension two", "two-fold reached", "returned"};
  const char *separator = "";
  cli_say("events     ");
  for (size_t i = 0; i < CLI_EVENT_KINDS; i++) {
    if (events->counts[i] > 0) {
      cli_say("%s%s %" PRIu64, separator, names[i], events->counts[i]);
      separator = ", ";
    }
  }
  cli_say("%s\n", events->steps > 0 ? "" : "none");
  print_list(events);
}

static void print_quality(const cli_run_t *run) {
  const cli_events_t *events = &run->events;
  const double steps = (double)(run->done - run->first);
  cli_say("ambiguous  several modes %sin %" PRIu64 " steps",
          events->choices_at_start > 1 ? "at the start and " : "",
          events->ambiguous);
  if (events->ambiguous > 0)
    cli_say(" (%.3g %%)", 100 * (double)events->ambiguous / steps);
  if (events->set != 0) {
    char set[CLI_SET_ROOM];
    cli_say(", first at t = %g s: %s", events->ambiguous_since,
            cli_write_set(set, events->set));
  }
  cli_say("\n");
  cli_tally_print(&run->tally, "first", cli_run_time(run, run->tally.first));
  cli_say("largest    |h| in stick %.3g m/s, residual %.3g N\n", run->largest_h,
          run->largest_residual);
  if (run->args->accuracy > 0) {
    cli_say("estimate   a step is off by %.3g at most\n",
            (double)run->drive.error);
  }
}

static void print_final(const cli_run_t *run) {
  const tf_state_t *state = &run->system.state;
  const tf_compensation_t *compensation = &run->system.low;
  cli_say("final      r = %.9g m, v = %.9g m/s, omega = %.9g rad/s",
          (double)state->r + (double)compensation->r,
          (double)state->v + (double)compensation->v,
          (double)state->w + (double)compensation->w);
  if (run->setup->machine.with_angle)
    cli_say(", phi = %.9g rad", (double)state->phi + (double)compensation->phi);
  cli_say("\n           h = %.9g m/s, g = %.9g m/s, %s\n",
          (double)run->system.report.slip.h, (double)run->system.report.slip.g,
          tf_mode_name(state->mode));
}

// The reason of an early end is a message like any other.
static void print_end(const cli_run_t *run) {
  const double t = cli_run_time(run, run->done);
  const tf_state_t *state = &run->system.state;
  switch (run->end) {
    case CLI_ENDED:
      break;
    case CLI_INTERRUPTED:
      (void)cli_stop("stopped at t = %.9g s: interrupted", t);
      break;
    case CLI_STEP_REFUSED:
      (void)cli_stop("stopped at t = %.9g s: step %" PRIu64
                     " was refused: %s; r = %g m, v = %g m/s, omega = %g rad/s",
                     t, run->done + 1, tf_status_name(run->status),
                     (double)state->r, (double)state->v, (double)state->w);
      break;
    case CLI_NOT_REPLAYED:
      (void)cli_stop("%s: row %zu, at step %" PRIu64 ": %s; r = %.17g m",
                     run->replay.session.name, run->replay.next, state->tick,
                     run->replay.failed, (double)state->r);
      break;
    case CLI_NOT_WRITTEN:
      (void)cli_stop("stopped at t = %.9g s: %s: %s", t, run->output.name,
                     cli_output_reason(&run->output));
      break;
  }
}

// The same as JSON, in SI units and with all digits. It is one line, and the
// last one on standard error, so that notes and messages before it do no harm.

static void put_table(const char *key, const cli_inputs_t *table) {
  if (table->count == 0) return;
  cli_put(
      "%s: {'name': %s, 'between': %s, 'rows': %zu, 'first': %zu, 'last': %zu, "
      "'passed': %zu, 'within': %zu, 'jumps': %zu, 't_first': %g, 't_last': "
      "%g, 'crc32': %x, 'applied': {",
      key, table->name, table->linear ? "linear" : "held", table->count,
      table->first, table->last, table->passed, table->within, table->jumps,
      (double)table->rows[table->first].t, (double)table->rows[table->last].t,
      cli_inputs_hash(table));
  const char *comma = "";
  for (size_t i = 0; i < CLI_INPUTS; i++) {
    if (table->given[i] && table->applied) {
      cli_say("%s", comma);
      cli_put("%s: [%g, %g]", cli_input_columns[i].name, (double)table->low[i],
              (double)table->high[i]);
      comma = ", ";
    }
  }
  cli_put("}}, ");
}

static void put_quality(const cli_run_t *run) {
  const cli_events_t *events = &run->events;
  const double none = (double)NAN, since = cli_run_time(run, run->tally.first);
  char set[CLI_SET_ROOM];
  cli_put(
      "'ambiguous': %" PRIu64
      ", 'ambiguous_since': %f, 'ambiguous_set': %s, 'choices_at_start': %f, ",
      events->ambiguous, events->ambiguous_since,
      cli_write_set(set, events->set), events->choices_at_start);
  cli_tally_put(&run->tally);
  cli_put(
      "'reserved_since': %f, 'largest_h_in_stick': %f, 'largest_residual': %f, "
      "'largest_error': %f, ",
      cli_tally_reserved(&run->tally) > 0 ? since : none, run->largest_h,
      run->largest_residual,
      run->args->accuracy > 0 ? (double)run->drive.error : none);
}

static void put_events(const cli_events_t *events) {
  static const char *const names[CLI_EVENT_KINDS] = {
      "slip_to_stick", "stick_to_slip", "slip_to_slip", "pinned_to_stick",
      "codim2",        "two_fold",      "returned"};
  cli_put("'events': {");
  for (size_t i = 0; i < CLI_EVENT_KINDS; i++)
    cli_put("%s: %" PRIu64 ", ", names[i], events->counts[i]);
  cli_put("'list': [");
  for (size_t i = 0; i < events->used; i++) {
    const cli_event_t *event = &events->list[i];
    cli_say("%s", i > 0 ? ", " : "");
    cli_put(
        "{'t': %f, 'r': %f, 'omega': %f, 'g': %f, 'lambda': %f, 'from': %s, "
        "'to': %s, 'kinds': [",
        event->t, event->r, event->omega, event->g, event->lambda,
        tf_mode_name(event->from), tf_mode_name(event->to));
    const char *comma = "";
    for (size_t kind = 0; kind < CLI_EVENT_KINDS; kind++) {
      if (((event->kinds >> kind) & 1u) != 0) {
        cli_say("%s\"%s\"", comma, names[kind]);
        comma = ", ";
      }
    }
    cli_put("]}");
  }
  cli_put("]}, ");
}

static void put_all(const cli_run_t *run, int code) {
  static const char *const ends[] = {[CLI_ENDED] = "done",
                                     [CLI_INTERRUPTED] = "interrupted",
                                     [CLI_STEP_REFUSED] = "refused",
                                     [CLI_NOT_REPLAYED] = "not replayed",
                                     [CLI_NOT_WRITTEN] = "not written"};
  const tf_simulation_t *simulation = &run->replay.simulation;
  const tf_input_t *input = &simulation->input;
  const tf_state_t *state = &run->system.state;
  const tf_slip_t slip = run->system.report.slip;
  const cli_setup_t setup = cli_run_setup(run);
  cli_put_begin("run");
  cli_put(
      "'scene': %s, 'scene_hash': %x, 'parameters': %x, 'law': %s, 'rule': %s, "
      "'seed': %u, 'scheme': %s, 'dt': %g, 'first': %" PRIu64
      ", 'steps': %" PRIu64 ", 'asked': %" PRIu64 ", 't': %f, ",
      setup.scene->name, cli_scene_hash(run->setup),
      tf_params_hash(&setup.params), tf_tyre_law_name(setup.params.law),
      tf_rule_name(setup.params.rule), setup.seed,
      motion_scheme_name(run->setup->scheme), (double)setup.machine.dt,
      run->first, run->done, run->steps, cli_run_time(run, run->done));
  put_table("profile", &run->drive.profile);
  put_table("inputs", &run->drive.table);
  if (run->replays) {
    char changes[CHANGES_ROOM];
    (void)changes_of(run, changes);
    cli_put("'replay': {'name': %s, 'commands': %" PRIu64 ", 'states': %" PRIu64
            ", 'began_with': %x, 'changes': %s}, ",
            run->replay.session.name, run->replay.commands, run->replay.states,
            tf_params_hash(&run->setup->params),
            changes + strspn(changes, " "));
  }
  if (simulation->source != TF_INPUT_SCENE) {
    cli_put(
        "'held': {'source': %s, 'deadman': %u, 'left': %u, 'omega0': %g, 'r0': "
        "%g, 'force': %g, 'torque': %g, 'alpha': %g}, ",
        simulation->source == TF_INPUT_SAFE ? "safe" : "outside",
        simulation->deadman, simulation->left, (double)input->omega0,
        (double)input->r0, (double)input->force, (double)input->torque,
        (double)input->alpha);
  }
  put_events(&run->events);
  put_quality(run);
  cli_put(
      "'final': {'r': %g, 'v': %g, 'omega': %g, 'phi': %g, 'h': %g, 'g': %g, "
      "'mode': %s}, 'output_seconds': %f, 'late': %" PRIu64
      ", 'latest': %f, 'end': %s, ",
      (double)state->r, (double)state->v, (double)state->w, (double)state->phi,
      (double)slip.h, (double)slip.g, tf_mode_name(state->mode),
      run->output_seconds, run->late, run->latest, ends[run->end]);
  cli_put_end((double)(run->done - run->first), run->seconds, code);
}

void cli_summary(const cli_run_t *run, bool json, int code) {
  if (!json) {
    print_request(run);
    print_drive(run);
    print_events(&run->events);
    print_quality(run);
    print_final(run);
    if (run->done > run->first && run->seconds > 0) {
      const double rate = (double)(run->done - run->first) / run->seconds;
      cli_say(
          "cost       %.0f ns a step, %.3g steps/s, %.3g x real time (and %.3g "
          "s of output)\n",
          1e9 / rate, rate, rate * (double)run->setup->machine.dt,
          run->output_seconds);
    }
    if (run->args->real_time) {
      cli_say("real time  %" PRIu64 " of %" PRIu64
              " steps late, by %.3g s at most\n",
              run->late, run->done - run->first, run->latest);
    }
  }
  print_end(run);
  cli_output_tell_part(&run->output);
  if (json) put_all(run, code);
  (void)fflush(stderr);
}
