// The options of all commands, in the order of the help. From a row come the
// reading of the option, help and manual, suggestions and completions. So a new
// option is a row here; a new member of cli_args_t keeps its value. An option
// that means something else in another command has a row for each.

#include "command.h"
#include "diverge/diverge.h"
#include "run/row.h"

#define GRIDS (CLI_REGIONS | CLI_ATLAS)
#define ANALYSES (GRIDS | CLI_DESIGN | CLI_SINGULARITIES | CLI_TYRE)
#define MOTIONS (CLI_RUN | CLI_SWEEP)

// What a value is and where it goes: a member of the arguments, which has to be
// of the type of its kind. Each of these ends before the text for the help.
#define TO(type, name)                    \
  .member = (offsetof(cli_args_t, name) + \
             0 * sizeof(*(1 ? (type *)0 : &((cli_args_t *)0)->name)))
#define IN(least, most, is) .low = (least), .high = (most), .usual = (is)
#define FLAG(name) .kind = CLI_FLAG, TO(bool, name), IN(0, 0, 0)
#define READS(name) .kind = CLI_READS, TO(const char *, name), IN(0, 0, 0)
#define WRITES(name) .kind = CLI_WRITES, TO(const char *, name), IN(0, 0, 0)
#define WORD(name) .kind = CLI_WORD, TO(const char *, name), IN(0, 0, 0)
#define CHOICE(name, is) .kind = CLI_CHOICE, TO(unsigned, name), IN(0, 0, is)
#define WHOLE(name, least, most, is) \
  .kind = CLI_WHOLE, TO(uint64_t, name), IN(least, most, is)
#define REAL(name, least, most, is) \
  .kind = CLI_REAL, TO(double, name), IN(least, most, is)
#define POSITIVE(name, most, is) \
  .kind = CLI_POSITIVE, TO(double, name), IN(0, most, is)
#define NUMBER(name, reach) \
  .kind = CLI_NUMBER, TO(cli_range_t, name), IN(-(reach), reach, 0)
#define RANGE(name, reach) \
  .kind = CLI_RANGE, TO(cli_range_t, name), IN(-(reach), reach, 0)
#define OTHER(reader) .kind = CLI_OTHER, .read = (reader), IN(0, 0, 0)

#define REACH ((double)TF_STATE_LIMIT)
#define MOST 1e15 // exact in a double

// In the order of motion_scheme_t, cli_format_t, ... where there is one.
static const cli_choice_t schemes[] = {
    {"moreau", "Moreau-Jean theta scheme (the default), set by theta"},
    {"located",
     "Taylor series from event to event, of high order, set by tolerance (laws "
     "jump, coulomb, none)"},
    {"compensated",
     "moreau with compensated summation of the state, for small steps in float "
     "(the default of float below 1 ms)"},
    {NULL, NULL}};
static const cli_choice_t rules[] = {
    {"persist", "the present mode, while it is consistent"},
    {"slip+", "an escaping stick ends at once, to this side"},
    {"slip-", "likewise"},
    {"random",
     "it ends at a random time, at the rate `rate` [1/s], to either side; "
     "random:SEED sets the seed"},
    {NULL, NULL}};
static const cli_choice_t between[] = {
    {"held", "each row holds until the next one"},
    {"linear", "inputs change linearly from row to row"},
    {NULL, NULL}};
static const cli_choice_t formats[] = {
    {"csv", COLUMN_HEADER "; for files"},
    {"frames",
     "what a board sends: see docs/PROTOCOL.md; in monitor: all bytes "
     "unchanged"},
    {"json", "one object per line, for PlotJuggler's UDP server"},
    {"plotter", "label:value pairs, for the Arduino IDE's plotter"},
    {"teleplot", "name:ms:value, for Teleplot's UDP port"},
    {NULL, NULL}};
static const cli_choice_t summaries[] = {
    {"text", ""}, {"json", ""}, {NULL, NULL}};
static const cli_choice_t mechanisms[] = {
    {"random",
     "a draw: an escaping stick is left at --rate, to either side with equal "
     "probability (the default)"},
    {"noise", "white noise on h, of --size"},
    {NULL, NULL}};
static const cli_choice_t codim2[] = {
    {"rest",
     "stays pinned, where it may, until an exit is drawn (the default)"},
    {"attracting", "the attracting stick where there is one"},
    {"even", "one of the consistent modes, all equally likely"},
    {"noise",
     "what vanishing noise on v selects: a slip; where slip+ arrives, also "
     "the stick- that leaves"},
    {NULL, NULL}};
static const cli_choice_t commands[] = {
    {"start", ""},   {"stop", ""},     {"reset", ""},  {"snapshot", ""},
    {"restore", ""}, {"describe", ""}, {"clear", ""},  {"input", ""},
    {"set:", ""},    {"select:", ""},  {"input:", ""}, {"deadman:", ""},
    {"every:", ""},  {NULL, NULL}};

static int read_set(cli_args_t *args, const cli_given_t *given) {
  return cli_settings_add(&args->settings, given);
}

// An option that is the name of a setting.
static int read_named(cli_args_t *args, const cli_given_t *given) {
  return cli_settings_add_named(&args->settings, given, given->name + 2,
                                given->value);
}

static int read_shard(cli_args_t *args, const cli_given_t *given) {
  cli_shard_t *shard = &args->shard;
  char first[CLI_REAL_ROOM];
  const size_t length = strcspn(given->value, "/");
  const char *second = given->value + length;
  (void)snprintf(first, sizeof first, "%.*s", (int)length, given->value);
  if (*second != '/' ||
      !cli_read_whole(first, 0, CLI_MAX_STEPS, &shard->index) ||
      !cli_read_whole(second + 1, 0, CLI_MAX_STEPS, &shard->of)) {
    return cli_blame(CLI_USAGE, given, "expected I/N, two whole numbers");
  }
  if (shard->index < 1 || shard->index > shard->of) {
    return cli_blame(CLI_REFUSED, given,
                     "I must lie in [1, N], N be at least 1");
  }
  return CLI_DONE;
}

static int read_events(cli_args_t *args, const cli_given_t *given) {
  args->listed = UINT64_MAX;
  if (strcmp(given->value, "all") == 0) return CLI_DONE;
  if (cli_read_whole(given->value, 0, CLI_MAX_STEPS, &args->listed))
    return CLI_DONE;
  return cli_usage("--events %s: must be a whole number in [0, 1e15], or all",
                   given->value);
}

const cli_option_t cli_options[] = {
    {"--over", "NAME=A:B:N", CLI_SWEEP, OTHER(cli_read_over),
     "N values from A to B of a name of --set, or of seed (with --select "
     "random); may be repeated: the last one is the inner loop",
     .is_repeatable = true},
    {"--outcome", "NAME,...", CLI_SWEEP, OTHER(cli_read_outcome),
     "columns, from the list below; default: modes, rest, recurrence, energy, "
     "ambiguous",
     .is_repeatable = true},
    {"--jobs", "N", CLI_SWEEP, WHOLE(jobs, 1, 1024, 0),
     "processes that share the points; default: one per processor",
     .letter = 'j'},
    {"--by", "KIND", CLI_DIVERGE, CHOICE(mechanism, 0),
     "what selects the exit:", .choices = mechanisms, .noun = "kind"},
    {"--rate", "R", CLI_DIVERGE, OTHER(read_named),
     "of --by random [1/s]; default: the scene's rate"},
    {"--size", "S", CLI_DIVERGE, POSITIVE(size, 1, 0),
     "of --by noise: h then has the standard deviation S sqrt(t) [m/s^1.5]"},
    {"--spread", "Q", CLI_DIVERGE, REAL(spread, 1, 1e6, 1),
     "the size of each sample is drawn from [S/Q, S], log-uniformly"},
    {"--codim2", "MODE", CLI_DIVERGE, CHOICE(codim2, 0),
     "--by random at h = g = 0:", .choices = codim2},
    {"--samples", "N", CLI_DIVERGE, WHOLE(samples, 1, UINT32_MAX, 100),
     "motions"},
    {"--cycles", "N", CLI_DIVERGE, WHOLE(cycles, 1, MOST, 1),
     "per sample, at most"},
    {"--patience", "T", CLI_DIVERGE, POSITIVE(patience, 1e9, 100),
     "longest cycle", .unit = "s"},
    {"--seed", "N", CLI_DIVERGE, WHOLE(seed, 0, UINT32_MAX, 1), "of the draws"},
    {"--dt", "DT", CLI_DIVERGE, OTHER(read_named),
     "step [s]; noise near the two-fold: DT / K; default: 0.05 (random), 0.001 "
     "(noise)"},
    {"--near", "K", CLI_DIVERGE, REAL(refinement, 1, 1e6, 64),
     "noise near the two-fold: takes K times shorter steps"},
    {"--fine", "N", CLI_DIVERGE, REAL(fine, 3, 1e6, 10),
     "noise at h = g = 0: steps have an error of about 1/N"},
    {"--r", "R", CLI_DESIGN, NUMBER(r, REACH), "r of the two-fold [m]",
     .unit = "m"},
    {"--omega", "W", CLI_DESIGN, NUMBER(omega, REACH),
     "omega of the two-fold [rad/s]", .unit = "rad/s"},
    {"--r", "A:B:N", GRIDS, RANGE(r, REACH),
     "N values of r from A to B [m]; default: 41, around the two-fold",
     .unit = "m"},
    {"--omega", "A:B:N", GRIDS, RANGE(omega, REACH),
     "N values of omega from A to B [rad/s]; default: 41, around the two-fold",
     .unit = "rad/s"},
    {"--angle", "A:B:N", CLI_TYRE, RANGE(r, 180),
     "N angles from A to B; default 0:90:91", .unit = "degrees"},
    {"--t-end", "S", MOTIONS, NUMBER(t_end, 0),
     "length [s]; default: the scene's own"},
    {"--dt", "S", MOTIONS | CLI_SCENE, OTHER(read_named),
     "step [s]; the same as --set dt=S", .is_repeatable = true},
    {"--scheme", "NAME", MOTIONS, CHOICE(scheme, MOTION_SCHEMES),
     "of the steps:", .choices = schemes, .noun = "scheme"},
    {"--accuracy", "E", CLI_RUN, POSITIVE(accuracy, 1, 0),
     "of --scheme moreau: takes each step also as two halves, at three times "
     "the cost, and calls it coarse where they differ by more than E, as a "
     "share of the velocities"},
    {"--realtime", NULL, CLI_RUN, FLAG(real_time),
     "takes step n at n dt after the start, on the wall clock. A step whose "
     "row is not written when the next one is due counts as late; later "
     "steps run without waiting until it has caught up"},
    {"--priority", NULL, CLI_RUN, FLAG(priority),
     "with --realtime: runs at real-time priority (SCHED_FIFO), memory locked; "
     "needs permission",
     .needs = "--realtime"},
    {"--lateness", "FILE", CLI_RUN, WRITES(lateness),
     "with --realtime: a histogram of how late steps began and ended; columns "
     "us,began,ended",
     .needs = "--realtime"},
    {"--select", "RULE", MOTIONS | CLI_SCENE, WORD(select),
     "selects one of several consistent modes; default: the scene's own",
     .choices = rules, .noun = "rule"},
    {"--set", "NAME=VALUE", MOTIONS | CLI_SCENE | ANALYSES | CLI_DIVERGE,
     OTHER(read_set),
     "a parameter, an initial value or the law; each NAME once; names: at the "
     "end of 'twofold help run'",
     .is_repeatable = true},
    {"--inputs", "FILE", MOTIONS, READS(inputs),
     "inputs over time, a CSV table, the same at every point of a sweep: "
     "'twofold help inputs'"},
    {"--between", "WORD", MOTIONS, CHOICE(between, CLI_NOT_GIVEN),
     "with --inputs:", .choices = between, .needs = "--inputs"},
    {"--every", "N", CLI_RUN, WHOLE(every, 1, CLI_MAX_STEPS, 1),
     "a row every N steps; the first and the last instant are always written"},
    {"--format", "NAME", CLI_RUN | CLI_MONITOR, CHOICE(format, CLI_NOT_GIVEN),
     "of the rows (default of run: csv; of monitor: no rows, but --live on a "
     "terminal):",
     .choices = formats, .noun = "format"},
    {"--shard", "I/N", CLI_DIVERGE | CLI_SWEEP, OTHER(read_shard),
     "only part I of N of the samples or points; the files of all parts, "
     "concatenated, are the whole"},
    {"--exits", "FILE", CLI_DIVERGE, WRITES(exits),
     "CSV: sample,cycle,time [s since the arrival],r [m],omega [rad/s],g "
     "[m/s],side (slip+ or slip-),phase [windings, 0 to 1],how (left, or "
     "released: the escaping region ended),section_time [s since the arrival]"},
    {"--returns", "FILE", CLI_DIVERGE, WRITES(returns),
     "CSV: sample,cycle,outcome,time [s from exit to end],arrived [s],exit_r "
     "[m],landing_time [s since the exit],landing_r [m],landings,windings"},
    {"--resume", NULL, CLI_DIVERGE, FLAG(resume),
     "continues after a kill, from FILE.resume beside the first file"},
    {"--header", NULL, CLI_DIVERGE, FLAG(header),
     "writes a header even if the shard is not the first"},
    {"--live", NULL, CLI_RUN | CLI_MONITOR, FLAG(live),
     "draws the planes (g, h) and (r, omega) and the modes over time in the "
     "terminal (run: with --realtime at the pace of the machine; monitor: the "
     "last ten seconds), until it ends or q is pressed; rows go to --out only"},
    {"--out", "FILE", MOTIONS | CLI_SCENE | ANALYSES | CLI_MONITOR, WRITES(out),
     "instead of standard output; monitor: with --format", .letter = 'o'},
    {"--quiet", NULL,
     MOTIONS | CLI_SCENE | ANALYSES | CLI_DIVERGE | CLI_MONITOR, FLAG(quiet),
     "no summary, notes, answers or progress: errors only, and --summary json",
     .letter = 'q'},
    {"--save", "FILE", CLI_RUN, WRITES(save),
     "the state at the end of the run, whatever ends it, unless its rows could "
     "not be written"},
    {"--from", "FILE", CLI_RUN, READS(from),
     "continues from a --save FILE, bit for bit, with the same machine, scheme "
     "and number type; --t-end (of the whole run), --inputs, and the scene's "
     "name and start may differ. The first row is that run's last"},
    {"--replay", "FILE", CLI_RUN, READS(replay),
     "repeats, to the bit, what a board did under the commands that 'twofold "
     "monitor --record FILE' sent it, and compares the last state. Needs --dt "
     "1/RATE of the firmware and the board's number type. Where set:dt changed "
     "the step, the column t differs from that of the board. --save keeps the "
     "settings that the commands left, and the summary names the options with "
     "which --from continues"},
    {"--record", "FILE", CLI_MONITOR, WRITES(record),
     "the commands that took effect, each with its step, for 'twofold run "
     "SCENE --replay FILE'"},
    {"--resume", NULL, CLI_SWEEP, FLAG(resume),
     "continues FILE.part of a sweep that was stopped, with the notes in "
     "FILE.resume; does nothing where FILE was completed by --resume"},
    {"--provenance", NULL,
     MOTIONS | GRIDS | CLI_TYRE | CLI_DIVERGE | CLI_MONITOR, FLAG(provenance),
     "four comment lines before the header of CSV (diverge: of --branches, "
     "too): version, commit, scene, scheme, units: 'twofold help provenance'"},
    {"--summary", "text|json", MOTIONS | CLI_DIVERGE | CLI_MONITOR,
     CHOICE(summary, 0),
     "the summary as text, or as JSON in the last line of standard error",
     .choices = summaries},
    {"--events", "N|all", CLI_RUN, OTHER(read_events),
     "events that the summary lists; default 20"},
    {"--exhaustive", NULL, CLI_DIVERGE, FLAG(exhaustive),
     "follows every mode wherever several are consistent, and leaves an "
     "escaping stick at multiples of --grid, to both sides"},
    {"--grid", "T", CLI_DIVERGE, REAL(grid, 1e-6, 1e3, 1e-2),
     "from one exit to the next", .unit = "s", .needs = "--exhaustive"},
    {"--depth", "N", CLI_DIVERGE, WHOLE(depth, 1, 1000, 3),
     "choices one after the other", .needs = "--exhaustive"},
    {"--count", "N", CLI_DIVERGE, WHOLE(nodes, 1, 1e6, 1000), "choices in all",
     .needs = "--exhaustive"},
    {"--branches", "FILE", CLI_DIVERGE, WRITES(branches),
     "CSV: "
     "node,depth,kind,r,omega,mode,stick_time,exit_r,exit_omega,end,to,time,"
     "end_r,landing_r,windings; default: standard output. Branches that end at "
     "the same state (r within 1e-6 m) have the same number in 'to'",
     .needs = "--exhaustive"},
    {"--baud", "N", CLI_MONITOR, WHOLE(baud, 1, 1e8, 0),
     "speed of a serial device; default: unchanged"},
    {"--send", "COMMAND", CLI_MONITOR, OTHER(cli_read_send),
     "sends a command to the board and prints the answer; may be repeated. "
     "Commands: start, stop, reset, snapshot, restore, describe, clear, "
     "set:NAME=VALUE, select:RULE[:SEED], input (the scene's own), "
     "input:OMEGA0,R0,FORCE,TORQUE, deadman:TICKS for which inputs hold (0: "
     "for ever), every:STEPS from record to record. Ends after the last answer "
     "unless there is --format or a live view",
     .choices = commands, .is_repeatable = true},
    {"--key", "FILE", CLI_MONITOR, READS(key),
     "the key of a board: a file of 32 hexadecimal digits that only its owner "
     "may read. Tags the commands; ends with 4 if answers, schemas and "
     "heartbeats are not tagged for this monitor"},
    {"--follow", NULL, CLI_MONITOR, FLAG(follow),
     "waits until an unplugged device is back, or until a file grows"},
};
const size_t cli_option_count = sizeof cli_options / sizeof cli_options[0];
