// The options of all commands, in the order of the help. From a row come the
// reading of the option, help and manual, suggestions and completions. So a new
// option is a row here; a new member of cli_args_t keeps its value. An option
// that means something else in another command has a row for each.

#include <string.h>

#include "command.h"
#include "diverge/diverge.h"
#include "run/row.h"
#include "setup/args.h"
#include "text/text.h"

#define GRIDS (CLI_REGIONS | CLI_ATLAS)
#define ANALYSES (GRIDS | CLI_DESIGN | CLI_SINGULARITIES | CLI_TYRE)
#define MOTIONS (CLI_RUN | CLI_SWEEP)

// A member of the arguments, which has to be of the type of its kind.
#define MEMBER(type, name)     \
  offsetof(cli_args_t, name) + \
      0 * sizeof(*(1 ? (type *)0 : &((cli_args_t *)0)->name))
#define FLAG(name) CLI_FLAG, MEMBER(bool, name)
#define TEXT(name) CLI_TEXT, MEMBER(const char *, name)
#define PATH(name) CLI_PATH, MEMBER(const char *, name)
#define WHOLE(name) CLI_WHOLE, MEMBER(uint64_t, name)
#define REAL(name) CLI_REAL, MEMBER(double, name)
#define NUMBER(name) CLI_NUMBER, MEMBER(cli_range_t, name)
#define RANGE(name) CLI_RANGE, MEMBER(cli_range_t, name)
#define CHOICE(name) CLI_CHOICE, MEMBER(unsigned, name)
#define OTHER CLI_OTHER, 0

#define REACH ((double)TF_STATE_LIMIT)
#define MOST 1e15 // exact in a double

static const cli_choice_t schemes[] = {
    {"moreau", "Moreau-Jean theta scheme (the default), set by theta"},
    {"located",
     "Taylor series from event to event, of high order, set by "
     "tolerance (laws jump, coulomb, none)"},
    {"compensated",
     "moreau with compensated summation of the state, for small "
     "steps in float (the default of float below 1 ms)"},
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
    [CLI_FORMAT_CSV] = {"csv", CLI_CSV_HEADER "; for files"},
    [CLI_FORMAT_FRAMES] = {"frames",
                           "what a board sends: see docs/PROTOCOL.md; of "
                           "monitor all bytes as they come"},
    [CLI_FORMAT_JSON] = {"json",
                         "an object a line, for PlotJuggler's UDP server"},
    [CLI_FORMAT_PLOTTER] = {"plotter",
                            "label:value pairs, for the Arduino IDE's "
                            "plotter"},
    [CLI_FORMAT_TELEPLOT] = {"teleplot",
                             "name:ms:value, for Teleplot's UDP port"},
    [CLI_FORMATS] = {NULL, NULL}};
static const cli_choice_t summaries[] = {
    {"text", ""}, {"json", ""}, {NULL, NULL}};
static const cli_choice_t mechanisms[] = {
    [CLI_BY_RANDOM] = {"random",
                       "a draw: an escaping stick is left at --rate, to either "
                       "side with equal probability (the default)"},
    [CLI_BY_NOISE] = {"noise", "white noise on h, of --size"},
    {NULL, NULL}};
static const cli_choice_t codim2[] = {
    [CLI_CODIM2_REST] =
        {"rest",
         "stays pinned, where it may, until an exit is drawn (the default)"},
    [CLI_CODIM2_ATTRACTING] = {"attracting",
                               "the attracting stick where there is one"},
    [CLI_CODIM2_EVEN] = {"even",
                         "one of the consistent modes, all equally likely"},
    {NULL, NULL}};
static const cli_choice_t commands[] = {
    {"start", ""},   {"stop", ""},     {"reset", ""},  {"snapshot", ""},
    {"restore", ""}, {"describe", ""}, {"clear", ""},  {"input", ""},
    {"set:", ""},    {"select:", ""},  {"input:", ""}, {"deadman:", ""},
    {"every:", ""},  {NULL, NULL}};

static int read_set(void *to, const cli_given_t *given) {
  cli_args_t *args = to;
  return cli_settings_add(&args->settings, given->name, given->value);
}

// An option that is the name of a setting.
static int read_named(void *to, const cli_given_t *given) {
  cli_args_t *args = to;
  return cli_settings_add_named(&args->settings, given->name, given->value,
                                given->name + 2, given->value);
}

static int read_shard(void *to, const cli_given_t *given) {
  cli_args_t *args = to;
  return cli_read_shard(given, &args->shard);
}

static int read_events(void *to, const cli_given_t *given) {
  cli_args_t *args = to;
  if (strcmp(given->value, "all") == 0) {
    args->listed = UINT64_MAX;
    return CLI_DONE;
  }
  return cli_read_whole(given->value, 0, CLI_MAX_STEPS, &args->listed)
             ? CLI_DONE
             : cli_message(CLI_USAGE,
                           "--events %s: must be a whole number in [0, 1e15], "
                           "or all",
                           given->value);
}

const cli_option_t cli_options[] = {
    {"--over", "NAME=A:B:N", CLI_SWEEP, OTHER, .read = cli_read_over,
     .how = CLI_REPEATABLE,
     .what = "N values from A to B of a name of --set, or of seed (with "
             "--select random); may be repeated: the last one is the inner "
             "loop"},
    {"--outcome", "NAME,...", CLI_SWEEP, OTHER, .read = cli_read_outcome,
     .how = CLI_REPEATABLE,
     .what = "columns, from the list below; default: modes, rest, recurrence, "
             "energy, ambiguous"},
    {.commands = CLI_DIVERGE, .what = "what selects the exit:"},
    {"--by", "KIND", CLI_DIVERGE, CHOICE(mechanism), .choices = mechanisms,
     .noun = "kind", .what = "one of:"},
    {"--rate", "R", CLI_DIVERGE, OTHER, .read = read_named,
     .what = "of --by random [1/s]; default: the scene's rate"},
    {"--size", "S", CLI_DIVERGE, REAL(size), .how = CLI_OPEN, .high = 1,
     .what = "of --by noise: h then has the standard deviation S sqrt(t) "
             "[m/s^1.5]"},
    {"--spread", "Q", CLI_DIVERGE, REAL(spread), .low = 1, .high = 1e6,
     .usual = 1,
     .what = "the size of each sample is drawn from [S/Q, S], log-uniformly"},
    {"--codim2", "MODE", CLI_DIVERGE, CHOICE(codim2), .choices = codim2,
     .what = "--by random at h = g = 0:"},
    {.commands = CLI_DIVERGE, .what = "how much:"},
    {"--samples", "N", CLI_DIVERGE, WHOLE(samples), .low = 1,
     .high = UINT32_MAX, .usual = 100, .what = "motions"},
    {"--cycles", "N", CLI_DIVERGE, WHOLE(cycles), .low = 1, .high = MOST,
     .usual = 1, .what = "per sample, at most"},
    {"--patience", "T", CLI_DIVERGE, REAL(patience), .how = CLI_OPEN,
     .high = 1e9, .unit = "s", .usual = 100, .what = "longest cycle"},
    {"--seed", "N", CLI_DIVERGE, WHOLE(seed), .high = UINT32_MAX, .usual = 1,
     .what = "of the draws"},
    {"--dt", "DT", CLI_DIVERGE, OTHER, .read = read_named,
     .what = "step [s]; near the two-fold (random: in slip, <= 1 ms) DT / K; "
             "default: 0.01 (random), 0.001 (noise)"},
    {"--near", "K", CLI_DIVERGE, REAL(refinement), .low = 1, .high = 1e6,
     .what = "steps near the two-fold are K times shorter; default: 10 "
             "(random), 64 (noise)"},
    {"--fine", "N", CLI_DIVERGE, REAL(fine), .low = 1, .high = 1e6, .usual = 16,
     .what = "noise next to h = g = 0: takes N steps to bring it there"},
    {"--r", "R", CLI_DESIGN, NUMBER(r), .low = -REACH, .high = REACH,
     .unit = "m", .what = "r of the two-fold [m]"},
    {"--omega", "W", CLI_DESIGN, NUMBER(omega), .low = -REACH, .high = REACH,
     .unit = "rad/s", .what = "omega of the two-fold [rad/s]"},
    {"--r", "A:B:N", GRIDS, RANGE(r), .low = -REACH, .high = REACH, .unit = "m",
     .what = "N values of r from A to B [m]"},
    {"--omega", "A:B:N", GRIDS, RANGE(omega), .low = -REACH, .high = REACH,
     .unit = "rad/s", .what = "N values of omega from A to B [rad/s]"},
    {"--angle", "A:B:N", CLI_TYRE, RANGE(r), .low = -180, .high = 180,
     .unit = "degrees", .what = "N angles from A to B; default 0:90:91"},
    {"--t-end", "S", MOTIONS, NUMBER(t_end),
     .what = "length [s]; default: the scene's own"},
    {"--dt", "S", MOTIONS | CLI_SCENE, OTHER, .read = read_named,
     .how = CLI_REPEATABLE, .what = "step [s]; the same as --set dt=S"},
    {"--scheme", "NAME", MOTIONS, CHOICE(scheme), .choices = schemes,
     .usual = CLI_NOT_GIVEN, .noun = "scheme", .what = "of the steps:"},
    {"--accuracy", "E", CLI_RUN, REAL(accuracy), .how = CLI_OPEN, .high = 1,
     .what = "of --scheme moreau: takes each step also as two halves, at three "
             "times the cost, and calls it coarse where they differ by more "
             "than E, as a share of the velocities"},
    {"--realtime", NULL, CLI_RUN, FLAG(real_time),
     .what = "every step waits for its time on the wall clock; the summary "
             "counts the late ones"},
    {"--priority", NULL, CLI_RUN, FLAG(priority), .needs = "--realtime",
     .what = "with --realtime: runs before all other programs (SCHED_FIFO), "
             "with its memory locked; needs the permission"},
    {"--lateness", "FILE", CLI_RUN, PATH(lateness), .how = CLI_WRITES,
     .needs = "--realtime",
     .what = "with --realtime: a histogram of how late steps began and ended; "
             "columns us,began,ended"},
    {"--select", "RULE", MOTIONS | CLI_SCENE, TEXT(select), .choices = rules,
     .noun = "rule",
     .what = "selects one of several consistent modes; default: the scene's "
             "own"},
    {"--set", "NAME=VALUE", MOTIONS | CLI_SCENE | ANALYSES | CLI_DIVERGE, OTHER,
     .read = read_set, .how = CLI_REPEATABLE,
     .what = "a parameter, an initial value or the law; each NAME once; names: "
             "'twofold help run'"},
    {"--inputs", "FILE", MOTIONS, PATH(drive.inputs), .how = CLI_READS,
     .what = "inputs over time, a CSV table, the same at every point of a "
             "sweep: 'twofold help inputs'"},
    {"--between", "WORD", MOTIONS, CHOICE(drive.between), .choices = between,
     .usual = CLI_NOT_GIVEN, .needs = "--inputs", .what = "with --inputs:"},
    {"--every", "N", CLI_RUN, WHOLE(every), .low = 1, .high = CLI_MAX_STEPS,
     .usual = 1,
     .what = "a row every N steps; the first and the last instant are always "
             "written"},
    {"--format", "NAME", CLI_RUN | CLI_MONITOR, CHOICE(format),
     .choices = formats, .usual = CLI_NOT_GIVEN, .noun = "format",
     .what = "of the rows (run: csv unless another is given; monitor: without "
             "it no rows, and a terminal shows --live):"},
    {"--shard", "I/N", CLI_DIVERGE | CLI_SWEEP, OTHER, .read = read_shard,
     .what = "only part I of N of the samples or points; the files of all "
             "parts, one after the other, have the rows of the whole"},
    {.commands = CLI_DIVERGE, .what = "files, CSV:"},
    {"--exits", "FILE", CLI_DIVERGE, PATH(exits), .how = CLI_WRITES,
     .what = "sample,cycle,time [s since the arrival],r [m],omega [rad/s],g "
             "[m/s],side (slip+ or slip-),phase [windings, 0 to 1],how (left, "
             "or released: the escaping region ended),section_time [s since "
             "the arrival]"},
    {"--returns", "FILE", CLI_DIVERGE, PATH(returns), .how = CLI_WRITES,
     .what = "sample,cycle,outcome,time [s from exit to end],arrived "
             "[s],exit_r [m],landing_time [s since the exit],landing_r "
             "[m],landings,windings"},
    {"--resume", NULL, CLI_DIVERGE, FLAG(resume),
     .what = "goes on after a kill; FILE.resume, beside each file, says where"},
    {"--header", NULL, CLI_DIVERGE, FLAG(header),
     .what = "writes a header even if the shard is not the first"},
    {"--live", NULL, CLI_RUN | CLI_MONITOR, FLAG(live),
     .what = "draws the planes (g, h) and (r, omega) and the modes over time "
             "in the terminal (run: with --realtime at the pace of the "
             "machine; monitor: the last ten seconds), until it ends or q is "
             "pressed; rows go to --out only"},
    {"--out", "FILE", MOTIONS | CLI_SCENE | ANALYSES | CLI_MONITOR, PATH(out),
     .how = CLI_WRITES,
     .what = "instead of standard output; monitor: with --format"},
    {"--save", "FILE", CLI_RUN, PATH(save), .how = CLI_WRITES,
     .what = "the state at the end of the run, whatever ends it"},
    {"--from", "FILE", CLI_RUN, PATH(from), .how = CLI_READS,
     .what = "continues from there, bit for bit: t-end is that of the whole, "
             "and the first row is the last one of the run before"},
    {"--replay", "FILE", CLI_RUN, PATH(replay), .how = CLI_READS,
     .what = "repeats, to the bit, what a board did under the commands that "
             "'twofold monitor --record FILE' sent it. Needs --dt 1/RATE of "
             "the firmware and the board's number type. --save keeps the "
             "settings that the commands left, and the summary names the "
             "options with which --from continues"},
    {"--record", "FILE", CLI_MONITOR, PATH(record), .how = CLI_WRITES,
     .what = "the commands that took effect, each with its step, for 'twofold "
             "run SCENE --replay FILE'"},
    {"--resume", NULL, CLI_SWEEP, FLAG(resume),
     .what = "continues FILE.part of a sweep that was stopped, with the notes "
             "in FILE.resume; does nothing where FILE is complete"},
    {"--provenance", NULL,
     MOTIONS | GRIDS | CLI_TYRE | CLI_DIVERGE | CLI_MONITOR, FLAG(provenance),
     .what = "four comment lines before the header of CSV (diverge: of "
             "--branches, too): version, commit, scene, scheme, units: "
             "'twofold help provenance'"},
    {"--summary", "text|json", MOTIONS | CLI_DIVERGE | CLI_MONITOR,
     CHOICE(summary), .choices = summaries,
     .what =
         "the summary as text, or as JSON in the last line of standard error"},
    {"--events", "N|all", CLI_RUN, OTHER, .read = read_events,
     .what = "events that the summary lists; default 20"},
    {.commands = CLI_DIVERGE, .what = "all branches:"},
    {"--exhaustive", NULL, CLI_DIVERGE, FLAG(exhaustive),
     .what = "follows every mode wherever several are consistent, and leaves "
             "an escaping stick at multiples of --grid, to both sides"},
    {"--grid", "T", CLI_DIVERGE, REAL(grid), .low = 1e-6, .high = 1e3,
     .unit = "s", .usual = 1e-2, .needs = "--exhaustive",
     .what = "from one exit to the next"},
    {"--depth", "N", CLI_DIVERGE, WHOLE(depth), .low = 1, .high = 1000,
     .usual = 3, .needs = "--exhaustive",
     .what = "choices one after the other"},
    {"--count", "N", CLI_DIVERGE, WHOLE(nodes), .low = 1, .high = 1e6,
     .usual = 1000, .needs = "--exhaustive", .what = "choices in all"},
    {"--branches", "FILE", CLI_DIVERGE, PATH(branches), .how = CLI_WRITES,
     .needs = "--exhaustive",
     .what = "node,depth,kind,r,omega,mode,stick_time,exit_r,exit_omega,end,"
             "to,time,end_r,landing_r,windings; default: standard output. "
             "Branches that end at the same state (r within 1e-6 m) have the "
             "same number in 'to'"},
    {"--baud", "N", CLI_MONITOR, WHOLE(baud), .low = 1, .high = 1e8,
     .what = "speed of a serial device; default: unchanged"},
    {"--send", "COMMAND", CLI_MONITOR, OTHER, .read = cli_read_send,
     .how = CLI_REPEATABLE, .choices = commands,
     .what =
         "sends a command to the board and prints the answer; may be repeated. "
         "Commands: start, stop, reset, snapshot, restore, describe, clear, "
         "set:NAME=VALUE, select:RULE[:SEED], input (the scene's own), "
         "input:OMEGA0,R0,FORCE,TORQUE, deadman:TICKS for which inputs hold "
         "(0: for ever), every:STEPS from record to record. Ends after the "
         "last answer unless there is --format or a live view"},
    {"--key", "FILE", CLI_MONITOR, TEXT(key), .how = CLI_READS,
     .what = "the key of a board that takes only tagged commands: a file of 32 "
             "hexadecimal digits that only its owner may read"},
    {"--follow", NULL, CLI_MONITOR, FLAG(follow),
     .what = "waits until an unplugged device is back, or until a file grows"},
};
const size_t cli_option_count = sizeof cli_options / sizeof cli_options[0];
