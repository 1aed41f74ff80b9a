// Help on single words. What has a table elsewhere (options and what they may
// be, ranges and units of the parameters, scenes) is taken from there. Lines
// are filled when they are printed.

#include <stdio.h>
#include <string.h>

#include "command.h"
#include "run/row.h"
#include "setup/setup.h"
#include "sweep/point.h"
#include "twofold.h"

#define WORD_ROOM 32 // more than any word of a topic has

typedef struct {
  const char *words; ///< separated by blanks
  const char *text;
} topic_t;

static const topic_t topics[] = {
    {"csv columns",
     "The rows of 'run' and 'monitor --format csv': " CLI_CSV_HEADER
     " (" CLI_CSV_UNITS "). "
     "Numbers are the shortest decimals that read back to the same bits. "
     "The start, every Nth step (--every N) and the last step have a row. "
     "--provenance puts four comment lines before the header. With these:\n"
     "  numpy    genfromtxt(FILE, delimiter=',', names=True, dtype=None,\n"
     "           encoding='ascii', skip_header=4)\n"
     "  R        read.csv(FILE, comment.char = '#')\n"
     "  gnuplot  set datafile separator ','; set key autotitle columnhead"},
    {"t time", "Time [s]: number of steps times dt."},
    {"v speed",
     "Speed of the slider [m/s], from r. --set v=VALUE: at the start."},
    {"omega",
     "Speed of the disc [rad/s]. --set omega=VALUE: at the start. That of "
     "the turntable is omega0."},
    {"r", "Displacement of the slider [m]. --set r=VALUE: at the start."},
    {"phi with-angle",
     "Angle of the disc [rad]. Nothing depends on it; it is integrated in "
     "scenes 'with-angle yes', or by --set phi=VALUE. Not a column."},
    {"h slip",
     "Lateral slip speed of the wheel [m/s]; 0 in stick. --set h=VALUE: at "
     "the start, in place of v; its sign selects the mode."},
    {"g",
     "Rolling speed of the wheel [m/s]; its sign distinguishes stick+ and "
     "stick-."},
    {"F force",
     "Friction force [N], positive where it lowers h; the mean over the "
     "step. As a column of --inputs: a force on the slider along r [N]."},
    {"M moment torque",
     "M: friction moment on the disc [N m], the mean over the step. torque, "
     "a column of --inputs: a torque on the disc [N m]."},
    {"mode modes slip+ slip- stick stick+ stick- pinned",
     "The contact: slip+ (h > 0), slip- (h < 0), stick+ (h = 0, g > 0), "
     "stick- (h = 0, g < 0), pinned (h = g = 0, at rest on the turntable)."},
    {"choices futures ambiguous ambiguous_since choices_at_start",
     "How many modes were consistent in a step. Where there are several, the "
     "physics does not decide what follows; --select takes one by a declared "
     "rule, 'diverge' follows all. The summary of 'run' counts such steps, and "
     "tells the time [s] since when there are any: 0 where the start has "
     "several."},
    {"two-fold singularity escaping sliding crossing",
     "Where stick runs from the sliding region (both slips drive h to 0) into "
     "the escaping region (both drive it away), in finite time. What follows "
     "is not unique. 'singularities' lists them, 'regions' maps the regions."},
    {"codimension codim2",
     "Codimension two is h = g = 0, where the contact neither slips nor rolls. "
     "A wheel may rest there (pinned) or leave in any consistent mode: "
     "'twofold help rest'. The summary of 'run' counts the arrivals."},
    {"law laws jump coulomb two_piece string smooth none",
     "--set law=NAME: how friction depends on h and g.\n"
     "  jump       force and moment jump where h changes sign (set-valued)\n"
     "  coulomb    force jumps, no moment\n"
     "  two_piece  the stretched string in two pieces, no jump\n"
     "  string     stretched string with partial slip, no jump\n"
     "  smooth     jump with the sign of h smoothed over epsilon\n"
     "  none       no contact"},
    {"rest hull square bow_tie",
     "--set rest=NAME, the law at h = g = 0, in law jump:\n"
     "  hull     convex hull of the limits of slip (Filippov), the default\n"
     "  square   convex hull of the law of stick\n"
     "  bow_tie  the paper's, not convex: at some points no future"},
    {"rule rules schemes formats event events",
     "Words that --select, --scheme and --format take, what they mean, and "
     "--events: 'twofold help select' and so on."},
    {"frame wire schema layout heartbeat",
     "What a board sends, and 'run --format frames' writes: docs/PROTOCOL.md."},
    {"plotter",
     "Lines of label:value pairs for a serial plotter, from 'run --format "
     "plotter', 'monitor --format plotter' and a board with FORMAT=plotter: "
     "r:0.18 v:-0.03 omega:-1.037 h:0 g:0.009 mode:2 choices:1 in m, m/s, "
     "rad/s, m/s, m/s; the modes are numbered slip+, slip-, stick+, stick-, "
     "pinned from 0."},
    {"input inputs table",
     "--inputs FILE --between held|linear of 'run' and 'sweep': inputs over "
     "time, from a CSV table; FILE - is standard input. The first column is t "
     "[s], which never decreases; any of these follow: omega0 [rad/s], r0 [m], "
     "force [N], torque [N m]. Lines that begin with # are comments. A last "
     "line without a newline gives a warning: it may be cut off.\n"
     "  held    a row holds from the first step that begins at t until the\n"
     "          next row does; its steps have its omega0 and alpha = 0, and\n"
     "          where omega0 changes, the turntable jumps as a step begins\n"
     "  linear  between rows; a step has omega0 at its end, its mean slope\n"
     "          alpha, and the mean of r0, force and torque over the step\n"
     "Two rows of one time are a jump; linear, one within a step acts on its "
     "omega0 at its start. Steps of --scheme located are split at the rows of "
     "a linear table. Before the first row and after the last one it is that "
     "row. What has no column stays that of the scene. For example:\n"
     "\n"
     "  t,omega0,force\n"
     "  0,-1,0\n"
     "  2,-2,0.5"},
    {"exit exits codes",
     CLI_EXIT_CODES " The file --exits of 'diverge' is something else."},
    {"degraded coarse stalled fell_back fell-back reserved_since",
     "Steps that may be wrong; they are counted, and make the exit code 5. "
     "degraded: no mode is consistent, or h and g contradict the mode. coarse: "
     "the step is too long for the motion, or a located step misses its "
     "tolerance; take a smaller dt. stalled: the motion of a step is lost in "
     "rounding; take a larger dt, double, or --scheme compensated. fell_back, "
     "which changes no exit code: tf_step took a located step, to its own "
     "order."},
    {"summary json text message",
     "What 'run', 'sweep', 'diverge' and 'monitor' say on standard error at "
     "their end. --summary json: one line of JSON, the last one there; SI "
     "units, null for what is not known. A command that is refused says why "
     "in 'message'."},
    {"command slip_to_stick stick_to_slip slip_to_slip pinned_to_stick "
     "two_fold to scene_hash first steps asked end final list kinds "
     "largest_h_in_stick largest_residual largest_error largest seconds "
     "output_seconds cost applied passed within jumps rows last "
     "t_first t_last name held changes began_with commands states left source",
     "In the summary of 'run': steps before it (first), up to its end and "
     "asked for; why and where it ended (end, final); its events (list, kinds, "
     "and their counts); how well stick [m/s] and law [N] hold, and what "
     "--accuracy estimates (largest); time on the clock [s] and late steps of "
     "--realtime. Of a table of inputs: rows from t_first to t_last, of which "
     "some passed between two steps or lie within one (as jumps), and the "
     "least and the largest value applied. Of --replay: what commands have "
     "changed, and whose inputs hold."},
    {"bytes broken forged lost missing restarts too_long other_version "
     "other_runs not_finite unmatched unknown sender dropped overruns skipped "
     "expired exec_min_ns exec_mean_ns exec_max_ns",
     "Counts of 'monitor': frames that came damaged, not at all, too long, "
     "forged or of another run (other_runs), and what the board's own "
     "heartbeat counts (docs/PROTOCOL.md)."},
    {"together",
     "Of 'sweep': how many points are followed at once (docs/USE.md)."},
    {"progress",
     "After two seconds, long work says on standard error how far it is and "
     "how much time is left: on a terminal in one line, in a log now and then. "
     "It does not where the rows go to the same terminal."},
    {"tick step",
     "A step of the length dt [s], the parameter; its number is the tick, "
     "and time is tick times dt. Frames, records and --save count ticks."},
    {"crc crc32",
     "CRC-32 as of zlib: of all bytes of a file in its last line, where "
     "readers check it, of a frame, and of a table of --inputs."},
    {"dead-man safe deadman session start stop reset restore clear describe",
     "Of the commands to a board: 'twofold help send'. Inputs by a command "
     "expire after so many ticks; then the safe ones hold, those of a machine "
     "that nothing drives: docs/PROTOCOL.md."},
    {"provenance unit units commit hash parameters number",
     "--provenance of 'run', 'sweep', 'diverge', 'regions', 'atlas', 'tyre' "
     "and 'monitor': four '# ' lines before the header with version, commit "
     "and "
     "checksum of the sources, number type; scene, its hash, that of the "
     "parameters, law, rule, seed; scheme, dt, hash of the inputs; units of "
     "the columns. The JSON of 'singularities' and 'design' has them as "
     "members. All numbers are in SI units."},
    {"region lambda delassus",
     "Columns of 'regions': what becomes of motions at a point of the "
     "surface h = 0; the force [N] that holds h = 0 there; how much a force "
     "changes h [1/kg]. 'twofold help regions' has all."},
    {"K K++ K+- K-+ K-- J1 J2 eigenvalues type case visible invisible "
     "teixeira physical time_scale residual",
     "Numbers of a two-fold: 'twofold help singularities'."},
    {"point points kept status reason done flagged stopped refused resume "
     "outcomes",
     "Columns of 'sweep', what status may be, and what it finds: 'twofold "
     "help sweep'."},
    {"returned small_cycle timeout canard phase side landing landings windings "
     "branch branches node nodes joined",
     "What 'diverge' samples and finds: 'twofold help diverge'."},
    {"alpha",
     "Mean acceleration of the turntable over a step [rad/s^2], by the column "
     "omega0 of --inputs or a profile, where that is linear; else 0."},
    {"bench stability figures statistics page firmware fmu board boards dist",
     "Made by make, not by this program: 'make help' lists the targets."},
    {"save from resume state snapshot carry",
     "run --save FILE writes the state at the end, whatever ends it; run "
     "--from FILE continues bit for bit, with the same machine, scheme and "
     "number type. --t-end, --inputs and the name and start of the scene may "
     "differ. Where the rows could not be written, no state is saved."},
    {"replay record",
     "monitor --record FILE keeps the commands that took effect on a board, "
     "each with its step; run SCENE --replay FILE gives them to the same "
     "functions, and compares the last state bit by bit. Where set:dt changed "
     "the step, the column t differs from that of the board."},
    {"realtime late latest lateness priority",
     "run --realtime takes step n at n dt after the start. A step whose row is "
     "not written when the next one is due counts as late; the steps after it "
     "do not wait until the delay is made up."},
    {"shard shards parallel slurm snakemake map",
     "--shard I/N of 'diverge' and 'sweep': one of N parts of the work, "
     "whose rows one after the other are those of one run. GNU parallel, "
     "Slurm, Snakemake and the map of a sweep: docs/USE.md."},
    {"version float double number",
     "--version prints the version and the number type of this build: "
     "build/double/twofold or build/float/twofold ('make all')."},
    {"name shows leaves-out based-on profile knots",
     "Keys of a scene's file: 'twofold help scene'."},
};
#define TOPICS (sizeof topics / sizeof topics[0])

// Cuts the next word off a list. Returns: whether there is one.
static bool next_word(const char **words, char word[WORD_ROOM]) {
  const size_t span = strcspn(*words, " ");
  (void)snprintf(word, WORD_ROOM, "%.*s", (int)span, *words);
  *words += span + ((*words)[span] == ' ' ? 1 : 0);
  return span > 0;
}

static bool is_in(const char *words, const char *word) {
  char one[WORD_ROOM];
  bool found = false;
  while (!found && next_word(&words, one)) {
    found = strcmp(one, word) == 0;
  }
  return found;
}

static bool print_parameter(const char *word) {
  const size_t i = cli_number_index(word);
  if (i >= TF_PARAMETERS) {
    return false;
  }
  (void)printf("Parameter %s: %s. --set %s=VALUE; name, range, unit:\n", word,
               cli_parameter_about[i], word);
  cli_print_range(i);
  return true;
}

static bool print_scene(const char *word) {
  for (size_t i = 0; i < TF_SCENES; i++) {
    if (strcmp(tf_scenes[i]->name, word) == 0) {
      (void)printf(
          "Scene %s: %s.\nIt leaves out: %s. 'twofold scene %s' "
          "prints it.\n",
          word, tf_scenes[i]->shows, tf_scenes[i]->leaves_out, word);
      return true;
    }
  }
  return false;
}

static bool print_outcome(const char *word) {
  cli_closest_t closest = cli_closest_to(word);
  const size_t i = cli_closest_find(&closest, cli_measures, CLI_MEASURES,
                                    sizeof cli_measures[0]);
  if (i == CLI_MEASURES) {
    return false;
  }
  const cli_measure_info_t *info = &cli_measures[i];
  (void)printf("Outcome %s of 'sweep': %s%s%s.\n", word,
               info->what[0] != '\0' ? info->what : "state at the end",
               info->unit[0] != '\0' ? ", unit " : "", info->unit);
  return true;
}

// A word may be several things: `string` is a law and a scene.
bool cli_topic(const char *word) {
  bool found = print_parameter(word);
  found = cli_print_option(word) || found;
  found = print_scene(word) || found;
  found = print_outcome(word) || found;
  for (size_t i = 0; i < TOPICS; i++) {
    if (is_in(topics[i].words, word)) {
      cli_print_filled(topics[i].text, 0, 0);
      found = true;
    }
  }
  return found;
}

void cli_topics_offer(cli_closest_t *closest) {
  (void)cli_closest_find(closest, tf_parameter_ranges, TF_PARAMETERS,
                         sizeof tf_parameter_ranges[0]);
  for (size_t i = 0; i < TF_SCENES; i++) {
    cli_closest_offer(closest, tf_scenes[i]->name);
  }
  (void)cli_closest_find(closest, cli_measures, CLI_MEASURES,
                         sizeof cli_measures[0]);
  for (size_t i = 0; i < cli_option_count; i++) {
    if (cli_options[i].name != NULL) {
      cli_closest_offer(closest, cli_options[i].name + 2);
    }
  }
  for (size_t i = 0; i < TOPICS; i++) {
    const char *words = topics[i].words;
    for (char word[WORD_ROOM]; next_word(&words, word);) {
      cli_closest_offer(closest, word);
    }
  }
}
