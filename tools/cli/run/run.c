// The command `run`. The loop steps in short batches; between them it reads the
// clock, flushes the rows and updates the progress line. Whatever ends it, the
// last step that was taken becomes the last row.

#include "run.h"

#include <unistd.h>

#include "../host/host.h"
#include "../text/summary.h"

#define FLUSH_EVERY 0.2 // [s]
#define BATCH 1024      // steps between two readings of the clock
#define IDLE 1e-3       // [s], a wait that is long enough for a flush
#define LIVE_EVERY 0.02 // [s], FLUSH_EVERY of a run in real time

// Returns: whether there is a next step.
static bool next_input(cli_run_t *run, tf_input_t *input) {
  tf_simulation_t *simulation = &run->replay.simulation;
  const tf_scene_t *scene = run->setup->scene;
  if (!run->replays) {
    *input = tf_simulation_input(simulation, scene);
    return true;
  }
  const bool goes_on = cli_replay_next(&run->replay, &run->system, scene,
                                       &run->system.report, input);
  if (run->replay.link.describe && run->args->format == CLI_FORMAT_FRAMES) {
    run->replay.link.describe = false;
    cli_rows_schema(run);
  }
  if (goes_on) return true;
  run->steps = run->done;
  if (run->replay.failed != NULL) run->end = CLI_NOT_REPLAYED;
  return false;
}

cli_setup_t cli_run_setup(const cli_run_t *run) {
  cli_setup_t setup = *run->setup;
  if (run->replays) setup.params = run->replay.link.params;
  setup.seed = run->system.state.seed;
  return setup;
}

static void show(const cli_run_t *run) {
  if (run->live != NULL) {
    const tf_real_t t = (tf_real_t)cli_run_time(run, run->done);
    const cli_csv_t row = cli_row(t, &run->system.state, &run->system.report);
    cli_live_note(run->live, &row);
  }
}

static void note_events(cli_run_t *run, const tf_report_t *before) {
  const motion_changes_t *changes = &run->drive.changes;
  const double t = cli_run_time(run, run->done);
  for (size_t i = 0; i < changes->count; i++) {
    const tf_located_change_t *at = &changes->list[i];
    const tf_report_t from = cli_before_change(before, at);
    cli_events_observe(&run->events, &from, &at->report, &at->state,
                       cli_run_time(run, run->done - 1) + (double)at->time);
    before = &at->report;
  }
  cli_events_observe(&run->events, before, &run->system.report,
                     &run->system.state, t);
}

static void observe(cli_run_t *run, const tf_report_t *before) {
  const tf_report_t *after = &run->system.report;
  if (run->drive.changes.count > 0 || cli_events_between(before, after))
    note_events(run, before);
  if (after->status != TF_OK)
    tf_tally_count(&run->tally, run->done, after->status);
  const double h = fabs((double)after->slip.h);
  const double residual = (double)after->residual;
  if (!tf_mode_is_slip(after->mode) && h > run->largest_h) run->largest_h = h;
  if (residual > run->largest_residual) run->largest_residual = residual;
  show(run);
}

// Returns: whether a step was taken.
static bool take_step(cli_run_t *run) {
  tf_input_t input;
  const bool drives =
      !run->replays && run->replay.simulation.source == TF_INPUT_SCENE;
  if (!drives && !next_input(run, &input)) return false;
  const tf_report_t before = run->system.report;
  run->drive.changes.count = 0;
  run->status =
      drives ? cli_drive_take(&run->drive, run->setup, &run->system, &input)
             : cli_step(&run->drive, run->setup->scheme, &run->system, &input);
  if (run->status < 0) {
    run->system.report = before;
    run->end = CLI_STEP_REFUSED;
    return false;
  }
  run->done++;
  observe(run, &before);
  return true;
}

// Waits for the time of the next step, and uses a long wait to flush the rows.
static void await_step(cli_run_t *run) {
  const double before = cli_now();
  const double time = run->start + cli_run_time(run, run->done + 1);
  run->began = before - time;
  if (before >= time) return;
  if (time - before >= IDLE && !cli_output_flush(&run->output)) {
    run->end = CLI_NOT_WRITTEN;
    return;
  }
  cli_wait_until(time);
  const double now = cli_now();
  run->idle_seconds += now - before;
  run->began = now - time;
}

// What is early, by the rounding of the clock, is on time.
static unsigned lateness_bin(double late) {
  const double us = late * 1e6;
  if (us >= CLI_LATENESS_BINS) return CLI_LATENESS_BINS;
  return us > 0 ? (unsigned)us : 0;
}

// A step and its row have to be done before the time of the next step. Lost
// time is made up for: the steps after a late one do not wait.
static void check_time(cli_run_t *run) {
  const double ended = cli_now() - run->start;
  const double late = ended - cli_run_time(run, run->done + 1);
  run->began_late[lateness_bin(run->began)]++;
  run->ended_late[lateness_bin(ended - cli_run_time(run, run->done))]++;
  if (late > 0) {
    run->late++;
    run->latest = fmax(run->latest, late);
  }
}

static void take_batch(cli_run_t *run) {
  const bool real_time = run->args->real_time;
  for (unsigned left = real_time ? 1 : BATCH;
       left > 0 && run->done < run->steps && run->end == CLI_ENDED; left--) {
    if (real_time) await_step(run);
    if (run->end == CLI_ENDED && cli_stop_asked()) run->end = CLI_INTERRUPTED;
    if (run->end == CLI_ENDED && take_step(run) &&
        run->system.state.tick % run->args->every == 0)
      cli_rows_add(run);
    if (real_time && run->end == CLI_ENDED) check_time(run);
  }
}

static void step_through(cli_run_t *run) {
  const double started = cli_now();
  const double flush_every = run->args->real_time ? LIVE_EVERY : FLUSH_EVERY;
  cli_progress_t progress =
      cli_progress_start(started, run->glance ? -1 : run->output.descriptor);
  progress.silent = progress.silent || run->live != NULL;
  run->start = started - cli_run_time(run, run->first);
  show(run);
  cli_rows_add(run);
  while (run->done < run->steps && run->end == CLI_ENDED) {
    take_batch(run);
    const double now = cli_now();
    if (now - run->output.flushed >= flush_every) {
      run->end = cli_output_flush(&run->output) ? run->end : CLI_NOT_WRITTEN;
      run->output_seconds += cli_now() - now;
    }
    const double done = (double)(run->done - run->first);
    const double speed = done / (now - started);
    cli_progress_say(&progress, now, done / (double)(run->steps - run->first),
                     "t = %.6g s of %.6g s, %.3g steps/s, %.3g x real time",
                     cli_run_time(run, run->done),
                     cli_run_time(run, run->steps), speed,
                     speed * (double)run->setup->machine.dt);
    cli_live_draw(run->live, run->setup->scene->name, now);
  }
  run->seconds = cli_now() - started - run->output_seconds - run->idle_seconds;
  cli_progress_clear(&progress);
  if (run->written != run->done) cli_rows_add(run);
}

// What a run leaves to another one. Inputs of a table are no part of it: the
// table is there to be given again. Those by a command are nowhere else.

static bool save(cli_run_t *run, const char *path) {
  char text[CLI_STATE_BYTES];
  if (path == NULL) return true;
  const cli_setup_t setup = cli_run_setup(run);
  const cli_stand_t stand = {
      run->system.state,      run->system.low,
      run->system.report,     cli_inputs_hash(&run->drive.table),
      run->replay.simulation, 0};
  const size_t length = cli_state_print(&stand, &setup, text);
  if (run->output.error != 0) {
    (void)cli_stop(
        "--save %s: not written: the rows up to this state did not reach %s",
        path, run->output.name);
    return cli_output_end(&run->saved, CLI_STOPPED) == CLI_DONE;
  }
  (void)cli_output_lines(&run->saved, text, length);
  if (run->replays && run->replay.next < run->replay.session.count) {
    cli_note("--save %s: %zu rows of the record were not reached", path,
             run->replay.session.count - run->replay.next);
  }
  return cli_output_end(&run->saved, CLI_DONE) == CLI_DONE;
}

static int write_lateness(cli_run_t *run) {
  static const char header[] = "us,began,ended\n";
  cli_output_t *output = &run->late_rows;
  char text[CLI_PROVENANCE_ROOM];
  size_t length = 0;
  if (run->args->provenance)
    length = cli_run_provenance(run, "us us, began and ended 1 (steps)", text);
  (void)cli_output_lines(output, text, length);
  (void)cli_output_lines(output, header, sizeof header - 1);
  for (unsigned us = 0; us <= CLI_LATENESS_BINS; us++) {
    const uint64_t began = run->began_late[us];
    const uint64_t ended = run->ended_late[us];
    if (began != 0 || ended != 0) {
      length = (size_t)snprintf(
          text, sizeof text, "%u,%" PRIu64 ",%" PRIu64 "\n", us, began, ended);
      (void)cli_output_lines(output, text, length);
    }
  }
  return cli_output_end(output, CLI_DONE);
}

static int open_files(cli_run_t *run, const cli_args_t *args) {
  if (args->save != NULL) {
    CLI_TRY(
        cli_output_begin(&run->saved, "--save", args->save, CLI_WRITE_OVER));
    if (!cli_is_regular(run->output.descriptor)) {
      cli_say(
          "twofold: note: --save %s: rows go to %s, not a file: only its "
          "reader knows if they are kept\n",
          args->save, run->output.name);
    }
  }
  if (args->lateness == NULL) return CLI_DONE;
  return cli_output_begin(&run->late_rows, "--lateness", args->lateness,
                          CLI_WRITE_OVER);
}

static int perform(cli_run_t *run, const cli_args_t *args) {
  CLI_TRY(cli_output_begin(&run->output, "--out", args->out, CLI_WRITE_OVER));
  int code = open_files(run, args);
  if (code != CLI_DONE) return cli_output_end(&run->output, code);
  run->live = args->live ? cli_live_open(cli_run_time(run, run->steps)) : NULL;
  run->rowless = run->live != NULL && run->output.descriptor == STDOUT_FILENO;
  // A person who named neither a file nor a form of the rows; those of a run in
  // real time are looked at as they come.
  run->glance = args->out == NULL && args->glance && !args->provenance &&
                !args->real_time && !run->rowless &&
                cli_is_terminal(STDOUT_FILENO);
  const char *why = args->priority ? cli_take_priority() : NULL;
  if (why != NULL) cli_say("twofold: --priority: refused: %s\n", why);
  cli_rows_begin(run);
  step_through(run);
  cli_rows_end(run);
  cli_live_close(run->live, run->setup->scene->name);
  if (!cli_output_close(&run->output, run->end == CLI_ENDED))
    run->end = CLI_NOT_WRITTEN;
  const bool saved = save(run, args->save);
  code = cli_tally_code(&run->tally);
  if (run->end != CLI_ENDED || !saved) code = CLI_STOPPED;
  cli_summary(run, args->summary != 0, code);
  const int written = args->lateness != NULL ? write_lateness(run) : CLI_DONE;
  return written == CLI_DONE ? code : written;
}

static int check_start(const cli_args_t *args, const cli_setup_t *setup,
                       const char *option, const char *path, uint32_t seed) {
  const cli_setting_t *setting = cli_setup_start_set(setup);
  if (setting != NULL) {
    return cli_blame(CLI_USAGE, &setting->given, "%s %s gives the state",
                     option, path);
  }
  if (args->select != NULL && strchr(args->select, ':') != NULL &&
      seed != setup->seed) {
    return cli_refuse("%s %s: the seed is %" PRIu32 " there and %" PRIu32
                      " here",
                      option, path, seed, setup->seed);
  }
  return CLI_DONE;
}

static void note(const cli_args_t *args, const char *what) {
  cli_note("--from %s: it was saved %s", args->from, what);
}

// Inputs are no part of the machine, so it may go on under others; but not
// without a word.
static void take_inputs(cli_run_t *run, const cli_args_t *args,
                        const cli_stand_t *stand) {
  const bool has_table = run->drive.table.count > 0;
  if (stand->inputs != cli_inputs_hash(&run->drive.table)) {
    note(args, stand->inputs == 0 ? "without --inputs"
               : has_table        ? "with another table of --inputs"
                                  : "with --inputs, and continues without");
  }
  if (stand->held.source == TF_INPUT_SCENE) return;
  if (has_table) {
    note(args, "with inputs by a command, and continues with --inputs");
    return;
  }
  tf_simulation_t *simulation = &run->replay.simulation;
  *simulation = stand->held;
  simulation->machine = run->system.machine.machine;
  simulation->stepped = simulation->source;
}

// Puts a run, which is at its start, where the file of --from says that another
// one stands; the setup takes the seed.
static int go_on(cli_run_t *run, const cli_args_t *args, cli_setup_t *setup) {
  const cli_stand_t *stand = &run->from;
  CLI_TRY(check_start(args, setup, "--from", args->from, stand->state.seed));
  if (stand->state.tick > run->steps) {
    return cli_refuse(
        "--from %s: it stands at t = %.9g s, after the end at %.9g s",
        args->from, cli_run_time(run, stand->state.tick),
        cli_run_time(run, run->steps));
  }
  take_inputs(run, args, stand);
  setup->seed = stand->state.seed;
  run->system.state = stand->state;
  run->system.low = stand->compensation;
  run->system.report = stand->report;
  run->first = run->done = stand->state.tick;
  (void)cli_drive_begin(&run->drive, &setup->machine, run->first);
  return CLI_DONE;
}

static int prepare(cli_run_t *run, cli_setup_t *setup) {
  const cli_args_t *args = run->args;
  CLI_TRY(cli_setup_read(setup, args->scene, &args->settings, args->select));
  setup->scheme = (motion_scheme_t)args->scheme;
  if (args->from != NULL)
    CLI_TRY(cli_state_read(&run->from, args->from, setup));
  else if (args->replay != NULL)
    CLI_TRY(cli_replay_read(&run->replay, args->replay, setup));
  const char *file = args->from != NULL ? args->from : args->replay;
  CLI_TRY(
      cli_setup_scheme(setup, args->scheme == MOTION_SCHEMES ? file : NULL));
  if (args->accuracy > 0 && setup->scheme != MOTION_MOREAU) {
    return cli_refuse(
        "--accuracy: not with --scheme %s: only the steps of moreau are taken "
        "in halves",
        motion_scheme_name(setup->scheme));
  }
  CLI_TRY(cli_setup_machine(setup));
  CLI_TRY(
      cli_drive_read(&run->drive, args->scene, args->inputs, args->between));
  setup->input = cli_drive_begin(&run->drive, &setup->machine, 0);
  CLI_TRY(cli_setup_start(setup));
  CLI_TRY(cli_count_steps(setup, &args->t_end, &run->steps));
  // The step after the last one of a record is never taken; what stands at the
  // end of the record is looked at before it.
  if (args->replay != NULL) {
    const cli_setup_t asked = *setup;
    run->replays = true;
    CLI_TRY(cli_replay_begin(&run->replay, setup, &run->steps));
    CLI_TRY(cli_setup_start(setup)); // with the seed of the board
    run->steps++;
    CLI_TRY(check_start(args, &asked, "--replay", args->replay, setup->seed));
  }
  run->system = setup->motion;
  run->drive.accuracy = (tf_real_t)args->accuracy;
  if (args->from != NULL) CLI_TRY(go_on(run, args, setup));
  cli_events_begin(&run->events, args->listed,
                   run->first == 0 ? &run->system.report : NULL);
  cli_setup_notes(setup);
  cli_drive_notes(&run->drive, setup, cli_run_time(run, run->first),
                  cli_run_time(run, run->steps));
  return CLI_DONE;
}

int cli_run_check(cli_args_t *args) {
  const char *other = args->inputs != NULL       ? "--inputs"
                      : args->from != NULL       ? "--from"
                      : args->t_end.text != NULL ? "--t-end"
                                                 : NULL;
  args->glance = args->format == CLI_NOT_GIVEN;
  if (args->glance) args->format = CLI_FORMAT_CSV;
  if (args->provenance && args->format != CLI_FORMAT_CSV)
    return cli_usage("--provenance: only with --format csv");
  if (args->replay != NULL && other != NULL) {
    return cli_usage(
        "--replay %s: not with %s: a record has its own inputs, start and end",
        args->replay, other);
  }
  return CLI_DONE;
}

int cli_run(const cli_args_t *args) {
  static cli_run_t run; // CLI_ENDED
  static cli_setup_t setup;
  run.setup = &setup;
  run.args = args;
  int code = prepare(&run, &setup);
  if (code == CLI_DONE) code = perform(&run, args);
  cli_drive_free(&run.drive);
  free(run.replay.session.rows);
  free(run.events.list);
  return code;
}
