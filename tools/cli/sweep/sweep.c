// The command `sweep`. Processes take chunks of points in turn, whose rows this
// one writes in their order: so their number does not show. A point whose
// machine is refused is an answer and no failure: its row says so, and the
// program ends with code 0.

#include "../text/summary.h"
#include "point.h"

// Points with a row that this call has made.
static double done_of(const cli_sheets_t *sheets) {
  return (double)(sheets->done.done - sheets->kept.done);
}

static cli_chunk_t chunk;

// Points of the chunk that begins behind so many of the shard.
static size_t size_at(const cli_sweep_t *sweep, uint64_t at) {
  const uint64_t left = sweep->sheets.total - at;
  return left < sweep->together ? (size_t)left : sweep->together;
}

// What a process does: every so many chunks one.
static void work(void *with, unsigned worker, int to) {
  cli_sweep_t *sweep = with;
  const uint64_t total = sweep->sheets.total, together = sweep->together;
  uint64_t at = sweep->sheets.done.done + worker * together;
  for (; at < total &&
         cli_points_follow(sweep, sweep->sheets.first + at, size_at(sweep, at),
                           &chunk) &&
         cli_pipe_write(to, &chunk, offsetof(cli_chunk_t, rows) + chunk.used);
       at += sweep->jobs * together) {
  }
}

// Returns: whether the chunk at a place is there.
static bool take_chunk(cli_sweep_t *sweep, uint64_t at) {
  const uint64_t next = (at - sweep->sheets.kept.done) / sweep->together;
  const unsigned worker = (unsigned)(next % sweep->jobs);
  if (sweep->jobs == 1)
    return cli_points_follow(sweep, sweep->sheets.first + at,
                             size_at(sweep, at), &chunk);
  return cli_workers_read(&sweep->workers, worker, &chunk,
                          offsetof(cli_chunk_t, rows)) &&
         cli_workers_read(&sweep->workers, worker, chunk.rows, chunk.used);
}

static int do_points(cli_sweep_t *sweep) {
  cli_sheets_t *sheets = &sweep->sheets;
  const uint64_t left = sheets->total - sheets->done.done;
  const uint64_t chunks = (left + sweep->together - 1) / sweep->together;
  uint64_t jobs = sweep->args->jobs > 0 ? sweep->args->jobs : cli_processors();
  jobs = jobs < CLI_JOBS ? jobs : CLI_JOBS;
  sweep->jobs = (unsigned)(jobs < chunks ? jobs : chunks);
  if (sweep->jobs > 1)
    CLI_TRY(cli_workers_start(&sweep->workers, sweep->jobs, work, sweep));
  while (sheets->done.done < sheets->total && !cli_stop_asked() &&
         take_chunk(sweep, sheets->done.done)) {
    sheets->done.done += size_at(sweep, sheets->done.done);
    for (int i = 0; i < CLI_POINT_ENDS; i++) sweep->ends[i] += chunk.ends[i];
    if (!cli_sheet_put(sheets->sheet, chunk.rows, chunk.used) ||
        !cli_sheets_save(sheets, true))
      break;
    const double now = cli_now();
    cli_progress_say(
        &sheets->progress, now,
        done_of(sheets) / (double)(sheets->total - sheets->kept.done),
        "%" PRIu64 " of %" PRIu64 " points, %.3g points/s", sheets->done.done,
        sheets->total, done_of(sheets) / (now - sheets->progress.started));
  }
  cli_workers_end(&sweep->workers);
  if (sheets->done.done == sheets->total) return CLI_DONE;
  if (sheets->sheet->output.error != 0)
    return CLI_STOPPED; // cli_sheets_close has the message
  return cli_stop("%s at point %" PRIu64,
                  cli_stop_asked() ? "interrupted" : "a process ended",
                  sheets->first + sheets->done.done);
}

static void summarise(const cli_sweep_t *sweep, double seconds) {
  const char *separator = "\nstatus     ";
  const cli_sheets_t *sheets = &sweep->sheets;
  cli_say("points     %" PRIu64 " of %" PRIu64, sheets->done.done,
          sheets->total);
  if (sheets->kept.done > 0)
    cli_say(", %" PRIu64 " of them kept", sheets->kept.done);
  for (int i = 0; i < CLI_POINT_ENDS; i++) {
    if (sweep->ends[i] > 0) {
      cli_say("%s%s %" PRIu64, separator, cli_point_ends[i], sweep->ends[i]);
      separator = ", ";
    }
  }
  cli_say("\ncost       %.3g s, %.3g points/s, %s, %u jobs\n", seconds,
          seconds > 0 ? done_of(sheets) / seconds : 0.0,
          sweep->together > 1 ? "in lanes of an ensemble" : "one by one",
          sweep->jobs);
}

// What the rows of all shards follow from: program, scene, options; and units.
static void add_provenance(const cli_sweep_t *sweep, cli_buffer_t *text) {
  const cli_args_t *args = sweep->args;
  cli_add_form(text,
               "# twofold %s, commit %s, numbers are %s\n# scene %s, hash "
               "%08x\n# sweep %s --scheme %s --t-end %g",
               TF_VERSION, cli_commit, CLI_NUMBER_TYPE, args->scene->name,
               sweep->hash, args->scene->name,
               motion_scheme_name(sweep->scheme),
               (double)cli_end_of(args->scene, &args->t_end));
  if (args->select != NULL) cli_add_form(text, " --select %s", args->select);
  if (args->inputs != NULL) {
    cli_add_form(text, " --inputs %s --between %s (%08x)", args->inputs,
                 args->between == 1 ? "linear" : "held",
                 cli_inputs_hash(&sweep->drive.table));
  }
  for (size_t i = 0; i < args->settings.count; i++) {
    const cli_setting_t *setting = &args->settings.list[i];
    if (strcmp(setting->given.name, "--over") != 0)
      cli_add_form(text, " %s %s", setting->given.name, setting->given.value);
  }
  for (size_t i = 0; i < args->axes; i++)
    cli_add_form(text, " --over %s", args->axis[i].range.text);
  for (size_t i = 0; i < args->measures; i++)
    cli_add_form(text, " --outcome %s", cli_measures[args->measure[i]].name);
  cli_add(text, "\n# units:");
  for (size_t i = 0; i < args->axes; i++) {
    const size_t number = cli_number_index(args->axis[i].name);
    cli_add_form(text, " %s %s,", args->axis[i].name,
                 number < CLI_NUMBERS ? cli_number(number)->unit : "1");
  }
  for (size_t i = 0; i < args->measures; i++) {
    const cli_measure_info_t *info = &cli_measures[args->measure[i]];
    if (info->unit[0] != '\0')
      cli_add_form(text, " %s %s,", info->name, info->unit);
  }
  cli_add(text, " t s\n");
}

// The shards of a sweep have header and comments once, so that their files, one
// after the other, are the file of the whole.
static int open_sheet(cli_sweep_t *sweep) {
  const cli_args_t *args = sweep->args;
  cli_sheets_t *sheets = &sweep->sheets;
  cli_buffer_t begin = {sheets->sheet->begin, 0, CLI_SHEET_BEGIN, false};
  cli_buffer_t about = {sheets->about, 0, CLI_SHEET_ABOUT, false};
  add_provenance(sweep, &about);
  if (args->shard.index == 1) {
    cli_add(&begin, args->provenance ? sheets->about : "");
    cli_add(&begin, "point");
    for (size_t i = 0; i < args->axes; i++)
      cli_add_form(&begin, ",%s", args->axis[i].name);
    cli_add(&begin, ",status,reason,t");
    for (size_t i = 0; i < args->measures; i++)
      cli_add_form(&begin, ",%s", cli_measures[args->measure[i]].name);
    cli_add(&begin, "\n");
  }
  cli_add_form(&about, "shard %" PRIu64 "/%" PRIu64, args->shard.index,
               args->shard.of);
  if (begin.truncated || about.truncated)
    return cli_usage("sweep: the command line is too long");
  sheets->what = "sweep";
  sheets->resume = args->resume;
  sheets->noted = true;
  sheets->sheet->option = "--out";
  sheets->sheet->path = args->out != NULL ? args->out : "-";
  return cli_sheets_open(sheets, &args->shard, args->points);
}

static int perform(cli_sweep_t *sweep) {
  const cli_args_t *args = sweep->args;
  cli_sheets_t *sheets = &sweep->sheets;
  int code = CLI_DONE;
  double seconds = 0;
  CLI_TRY(open_sheet(sweep));
  if (sheets->whole) {
    (void)cli_message(CLI_DONE, "%s has all of its %" PRIu64 " points",
                      args->out, sheets->total);
  } else {
    code = cli_sheets_close(sheets, do_points(sweep));
    seconds = cli_now() - sheets->progress.started;
  }
  if (args->summary == 0 && !sheets->whole) summarise(sweep, seconds);
  if (code != CLI_DONE && sheets->sheet->output.left)
    (void)cli_message(code, "repeat it with --resume to continue");
  if (args->summary == 0) return code;
  cli_put_begin("sweep");
  cli_put("'scene': %s, 'scheme': %s, 'points': %" PRIu64 ", 'kept': %" PRIu64
          ", ",
          args->scene->name, motion_scheme_name(sweep->scheme), sheets->total,
          sheets->kept.done);
  for (int i = 0; i < CLI_POINT_ENDS; i++)
    cli_put("%s: %" PRIu64 ", ", cli_point_ends[i], sweep->ends[i]);
  cli_put("'together': %zu, 'jobs': %u, ", sweep->together, sweep->jobs);
  cli_put_end(done_of(sheets), seconds, code);
  return code;
}

int cli_sweep(const cli_args_t *args) {
  static cli_sweep_t sweep;
  sweep.args = args;
  sweep.scheme = (motion_scheme_t)args->scheme;
  int code =
      cli_drive_read(&sweep.drive, args->scene, args->inputs, args->between);
  code = code == CLI_DONE ? cli_point_check(&sweep) : code;
  code = code == CLI_DONE ? perform(&sweep) : code;
  cli_drive_free(&sweep.drive);
  return code;
}

// What is swept and what is found. An axis is a setting whose value changes
// from point to point, so it stands among the settings: a name that is both
// swept and set is refused like one that is set twice.

#define MAX_VALUES 1000000u            // of one axis
#define MAX_POINTS 1000000000000000ull // exact in a double

// The seed is a number of rule random, not a real parameter of the machine.
static int check_seed(const cli_args_t *args, const cli_given_t *given,
                      const cli_range_t *range) {
  for (size_t i = 0; i < args->axes; i++) {
    if (args->axis[i].is_seed) {
      return cli_blame(CLI_USAGE, given, "seed was already given by --over %s",
                       args->axis[i].range.text);
    }
  }
  for (uint64_t i = 0; i < range->count; i++) {
    const double value = cli_range_at(range, i);
    if (!(value >= 0 && value <= UINT32_MAX && floor(value) >= value)) {
      return cli_blame(
          CLI_REFUSED, given,
          "seed must be whole numbers in [0, 4294967295]; value %" PRIu64
          " is %.10g",
          i + 1, value);
    }
  }
  return CLI_DONE;
}

int cli_read_over(cli_args_t *args, const cli_given_t *given) {
  const char *text = given->value, *equals = strchr(text, '=');
  cli_axis_t *axis = &args->axis[args->axes];
  if (equals == NULL || equals == text)
    return cli_blame(CLI_USAGE, given, "expected NAME=A:B:N");
  if (args->axes == CLI_AXES)
    return cli_blame(CLI_USAGE, given, "more than %d axes", CLI_AXES);
  axis->is_seed = strncmp(text, "seed=", 5) == 0;
  CLI_TRY(cli_read_range(given, equals + 1, MAX_VALUES, axis->is_seed,
                         &axis->range));
  if (axis->is_seed) {
    axis->name = "seed";
    CLI_TRY(check_seed(args, given, &axis->range));
  } else {
    axis->setting = args->settings.count;
    axis->name = args->settings.list[axis->setting].name;
    CLI_TRY(cli_settings_add(&args->settings, given));
  }
  if (args->points > MAX_POINTS / axis->range.count)
    return cli_blame(CLI_REFUSED, given, "more than %llu points", MAX_POINTS);
  args->points *= axis->range.count;
  args->axes++;
  return CLI_DONE;
}

static int add_measure(cli_args_t *args, const char *name,
                       const cli_given_t *given) {
  cli_closest_t closest = cli_closest_to(name);
  const unsigned found = (unsigned)cli_closest_find(
      &closest, cli_measures, CLI_MEASURES, sizeof cli_measures[0]);
  if (found == CLI_MEASURES) {
    return cli_blame(CLI_USAGE, given,
                     "unknown outcome '%s'%s ('twofold help sweep' lists them)",
                     name, closest.hint);
  }
  for (size_t i = 0; i < args->measures; i++) {
    if (args->measure[i] == found)
      return cli_blame(CLI_USAGE, given, "%s was already given", name);
  }
  args->measure[args->measures++] = found;
  return CLI_DONE;
}

int cli_read_outcome(cli_args_t *args, const cli_given_t *given) {
  const char *at = given->value;
  do {
    char name[32];
    const size_t length = strcspn(at, ",");
    (void)snprintf(name, sizeof name, "%.*s", (int)length, at);
    CLI_TRY(add_measure(args, name, given));
    at += length;
  } while (*at++ == ',');
  return CLI_DONE;
}

int cli_sweep_check(cli_args_t *args) {
  static const cli_given_t usual = {"--outcome",
                                    "modes,rest,recurrence,energy,ambiguous"};
  if (args->axes == 0) return cli_usage("sweep: --over NAME=A:B:N is missing");
  if (args->resume && (args->out == NULL || strcmp(args->out, "-") == 0))
    return cli_usage("--resume: only with --out FILE");
  for (size_t i = 0; i < args->axes; i++) {
    if (args->axis[i].is_seed &&
        (args->select == NULL || strcmp(args->select, "random") != 0)) {
      return cli_usage("--over %s: only with --select random",
                       args->axis[i].range.text);
    }
  }
  return args->measures > 0 ? CLI_DONE : cli_read_outcome(args, &usual);
}
