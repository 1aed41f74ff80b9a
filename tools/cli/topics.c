// Help on single words. What has a table elsewhere (ranges and units of the
// parameters, scenes) is taken from there.

#include "topics.h"

#include <stdio.h>
#include <string.h>

#include "setup/names.h"
#include "setup/setup.h"
#include "sweep/measure.h"
#include "twofold.h"

#define WORD_ROOM 32 // more than any word of a topic has

typedef struct {
  const char *words; ///< separated by blanks
  const char *text;
} topic_t;

static const topic_t topics[] = {
    {"csv columns",
     "The rows of 'run' and 'monitor --csv':\n"
     "t,r,v,omega,h,g,F,M,mode,choices in s, m, m/s, rad/s, m/s, m/s, N, N m.\n"
     "Numbers are the shortest decimals that read back to the same bits. The\n"
     "start, every Nth step (--every N) and the last step have a row.\n"
     "--provenance puts four comment lines before the header. With these:\n"
     "  numpy    genfromtxt(FILE, delimiter=',', names=True, dtype=None,\n"
     "           encoding='ascii', skip_header=4)\n"
     "  R        read.csv(FILE, comment.char = '#')\n"
     "  gnuplot  set datafile separator ','; set key autotitle columnhead\n"},
    {"t time", "Time [s]: number of steps times dt.\n"},
    {"v speed",
     "Speed of the slider [m/s], from r. --set v=VALUE: at the\n"
     "start.\n"},
    {"omega",
     "Speed of the disc [rad/s]. --set omega=VALUE: at the start.\n"
     "That of the turntable is omega0.\n"},
    {"r", "Displacement of the slider [m]. --set r=VALUE: at the start.\n"},
    {"phi with-angle",
     "Angle of the disc [rad]. Nothing depends on it; it is integrated in\n"
     "scenes 'with-angle yes', or by --set phi=VALUE. Not a column.\n"},
    {"h slip",
     "Lateral slip speed of the wheel [m/s]; 0 in stick. --set\n"
     "h=VALUE: at the start, in place of v; its sign selects the\n"
     "mode.\n"},
    {"g",
     "Rolling speed of the wheel [m/s]; its sign distinguishes stick+ and\n"
     "stick-.\n"},
    {"F force",
     "Friction force [N], positive where it lowers h; the mean over\n"
     "the step. As a column of --inputs: a force on the slider along\n"
     "r [N].\n"},
    {"M moment torque",
     "M: friction moment on the disc [N m], the mean over the step. torque, a\n"
     "column of --inputs: a torque on the disc [N m].\n"},
    {"mode modes slip+ slip- stick stick+ stick- pinned",
     "The contact: slip+ (h > 0), slip- (h < 0), stick+ (h = 0, g > 0), "
     "stick-\n"
     "(h = 0, g < 0), pinned (h = g = 0, at rest on the turntable).\n"},
    {"choices futures ambiguous ambiguous_since choices_at_start",
     "How many modes were consistent in a step. Where it is more than one the\n"
     "physics leaves open what follows; --select takes one by a declared "
     "rule,\n"
     "'diverge' follows all. The summary of 'run' counts such steps, and "
     "tells\n"
     "the time [s] since when there are any: 0 where the start has several.\n"},
    {"two-fold singularity escaping sliding crossing",
     "Where stick runs from the sliding region (both slips drive h to 0) into\n"
     "the escaping region (both drive it away), in finite time. What follows "
     "is\n"
     "not unique. 'singularities' lists them, 'regions' maps the regions.\n"},
    {"law laws jump coulomb two_piece string smooth none",
     "--set law=NAME: how friction depends on h and g.\n"
     "  jump       force and moment jump where h changes sign (set-valued)\n"
     "  coulomb    force jumps, no moment\n"
     "  two_piece  the stretched string in two pieces, no jump\n"
     "  string     stretched string with partial slip, no jump\n"
     "  smooth     jump with the sign of h smoothed over epsilon\n"
     "  none       no contact\n"},
    {"rest hull square bow_tie",
     "--set rest=NAME, the law at h = g = 0, in law jump:\n"
     "  hull     convex hull of the limits of slip (Filippov), the default\n"
     "  square   convex hull of the law of stick\n"
     "  bow_tie  the paper's, not convex: at some points no future\n"},
    {"select rule rules persist random seed",
     "--select RULE: which of several consistent modes a step takes.\n"
     "  persist        the present mode, while it is consistent\n"
     "  slip+, slip-   an escaping stick ends at once, to this side\n"
     "  random[:SEED]  it ends at the rate `rate` [1/s], to either side\n"},
    {"scheme schemes moreau located compensated",
     "--scheme NAME of 'run':\n"
     "  moreau       Moreau-Jean theta scheme, fixed steps, every law\n"
     "  located      Taylor series from event to event, of high order; laws\n"
     "               jump, coulomb, none\n"
     "  compensated  moreau with compensated summation, for small steps in\n"
     "               float\n"},
    {"format formats frames frame wire schema layout heartbeat",
     "--format NAME of 'run': csv ('twofold help csv'); frames, what a board\n"
     "sends (docs/PROTOCOL.md); plotter ('twofold help plotter').\n"},
    {"plotter",
     "Lines of label:value pairs for a serial plotter, from 'run --format\n"
     "plotter', 'monitor --as plotter' and a board with FORMAT=plotter:\n"
     "r:0.18 v:-0.03 omega:-1.037 h:0 g:0.009 mode:2 choices:1\n"
     "in m, m/s, rad/s, m/s, m/s; the modes are numbered slip+, slip-, "
     "stick+,\n"
     "stick-, pinned from 0.\n"},
    {"input inputs held linear between table",
     "--inputs FILE --between held|linear of 'run' and 'sweep': inputs over\n"
     "time, from a CSV table; FILE - is standard input. The first column is "
     "t\n"
     "[s], rising; any of these follow: omega0 [rad/s], r0 [m], force [N],\n"
     "torque [N m]. Lines that begin with # are comments.\n"
     "  held    a row holds from the first step that begins at t until the\n"
     "          next row does\n"
     "  linear  between rows; r0, force and torque are the mean over each "
     "step\n"
     "Before the first row and after the last one it is that row. What has no\n"
     "column stays that of the scene. For example:\n"
     "\n"
     "  t,omega0,force\n"
     "  0,-1,0\n"
     "  2,-2,0.5\n"},
    {"exit exits codes",
     "Exit codes: 0 done, 2 usage, 3 parameter refused, 4 stopped, 5 done, "
     "but\n"
     "some steps were degraded or missed their tolerance, 6 done, but frames "
     "of\n"
     "a stream were lost or broken, or a value in it is not finite.\n"
     "The file --exits of 'diverge' is something else: 'twofold help "
     "diverge'.\n"},
    {"degraded coarse fell_back fell-back tolerance-missed reserved_since",
     "A step is degraded where no mode is consistent, or h and g contradict "
     "the\n"
     "mode, and coarse where it does not resolve the motion or misses its\n"
     "tolerance: a smaller dt helps. Both are counted, and make exit code "
     "5.\n"
     "fell_back: a located step that tf_step took, to its own order.\n"},
    {"summary json text message",
     "What 'run', 'sweep', 'diverge' and 'monitor' say on standard error at\n"
     "their end.\n"
     "--summary json: one line of JSON, the last one there; SI units, null\n"
     "for what is not known. A command that is refused says why in "
     "'message'.\n"},
    {"command scene_hash first steps asked end final list kinds "
     "largest_h_in_stick largest_residual largest seconds output_seconds cost "
     "late latest applied passed rows last t_first t_last name held changes "
     "began_with commands states left source",
     "In the summary of 'run':\n"
     "  first, steps, asked    steps before this run, up to its end, asked "
     "for\n"
     "  end, final             why it ended, and where: 'twofold help exit'\n"
     "  list, kinds            of events; 'slip_to_stick' and so on count "
     "them\n"
     "  largest_h_in_stick [m/s], largest_residual [N]: how well stick and "
     "law\n"
     "                         hold\n"
     "  seconds, output_seconds, late, latest: time on the clock [s], and how\n"
     "                         many steps of --realtime were late\n"
     "  profile, inputs        tables: rows that were seen, t_first to t_last, "
     "of\n"
     "                         which some passed between two steps; applied: "
     "the\n"
     "                         least and the largest value of a step\n"
     "  replay, held           what the commands of a record have changed, "
     "and\n"
     "                         whose inputs hold: 'twofold help replay'\n"},
    {"slip_to_stick stick_to_slip slip_to_slip pinned_to_stick two_fold to",
     "Events in the summary of 'run': changes of mode from one to another, "
     "and\n"
     "arrivals at the two-fold.\n"},
    {"bytes broken lost missing restarts too_long other_version not_finite "
     "unmatched unknown sender dropped overruns expired exec_min_ns "
     "exec_mean_ns exec_max_ns",
     "Counts of 'monitor': frames that came damaged, not at all or too long,\n"
     "and what the board's own heartbeat counts (docs/PROTOCOL.md).\n"},
    {"points kept nodes joined",
     "In the summary of 'sweep': points, and rows that --resume has kept; of\n"
     "'diverge --exhaustive': its tree.\n"},
    {"progress",
     "Work of more than two seconds tells on standard error how far it is and\n"
     "how long it still takes: one line on a terminal, a line now and then in "
     "a\n"
     "log; not where the rows go to the same terminal.\n"},
    {"tick step",
     "A step of the length dt [s], the parameter; its number is the tick, and\n"
     "time is tick times dt. Frames, records and --save count ticks.\n"},
    {"crc crc32 trailer",
     "CRC-32 as of zlib: of all bytes of a file in its last line ('sweep',\n"
     "'diverge', --save), where readers check it, of a frame, and of a table "
     "of\n"
     "--inputs.\n"},
    {"dead-man safe",
     "Inputs that a board got by a command expire after so many ticks; then "
     "the\n"
     "safe ones hold, those of a machine that nothing drives: 'twofold help\n"
     "monitor', docs/PROTOCOL.md.\n"},
    {"provenance unit units commit hash parameters number",
     "--provenance of 'run', 'diverge', 'regions', 'atlas' and 'monitor': "
     "four\n"
     "'# ' lines before the header with version, commit, number type; scene,\n"
     "its hash, that of the parameters, law, rule, seed; scheme, dt, hash of "
     "the\n"
     "inputs; units of the columns. The file of 'sweep' always has such lines, "
     "and the JSON of\n"
     "'singularities' and 'design' has them as members. All numbers are in SI\n"
     "units.\n"},
    {"version", "--version prints version and number type of this build.\n"},
    {"region lambda delassus",
     "Columns of 'regions': what becomes of motions at a point of the surface\n"
     "h = 0; the force [N] that holds h = 0 there; how much a force changes h\n"
     "[1/kg]. 'twofold help regions' has all.\n"},
    {"K K++ K+- K-+ K-- J1 J2 eigenvalues type case visible invisible "
     "teixeira physical time_scale residual",
     "Numbers of a two-fold: 'twofold help singularities'.\n"},
    {"point status reason done flagged stopped refused resume",
     "Columns of 'sweep', and what status may be: 'twofold help sweep'.\n"},
    {"noise smoothing hysteresis delay returned small_cycle timeout canard "
     "phase side landing landings windings branch branches node counts begun",
     "What 'diverge' samples and finds: 'twofold help diverge'.\n"},
    {"alpha",
     "Acceleration of the turntable [rad/s^2]: it follows from the column\n"
     "omega0 of --inputs, or from a profile, where that is linear.\n"},
    {"bench stability figures statistics page firmware fmu board boards dist",
     "Made by make, not by this program: 'make help' lists the targets.\n"},
    {"save from resume state snapshot carry",
     "run --save FILE writes the state at the end, whatever ends it; run "
     "--from\n"
     "FILE continues bit for bit, with the same machine, scheme and number "
     "type.\n"},
    {"replay record",
     "monitor DEVICE --send ... --record FILE keeps which commands a board "
     "got\n"
     "and when; run SCENE --dt 1/RATE --replay FILE repeats that to the "
     "bit,\n"
     "and with --save FILE another run goes on from its end.\n"},
    {"shard shards merge parallel slurm snakemake map",
     "--shard I/N of 'diverge' and 'sweep': one of N parts of the work, whose\n"
     "rows one after the other are those of one run; 'twofold help merge' "
     "adds\n"
     "counts. GNU parallel, Slurm, Snakemake and the map of a sweep:\n"
     "docs/SWEEPS.md.\n"},
    {"t-end", "Length of a run [s]: --t-end S, or of a scene.\n"},
    {"profile knots",
     "Speed of the turntable in a scene, linear between up to 8 knots\n"
     "TIME:SPEED; 'run --inputs' takes a table of any length.\n"},
    {"float double number",
     "The number type of a build: build/double/twofold, build/float/twofold\n"
     "('make all'). --version prints it.\n"},
    {"set every out events realtime",
     "An option of 'run', and some of other commands: 'twofold help run'.\n"},
    {"lateness priority",
     "Options of 'run --realtime': a histogram of how late steps began and\n"
     "ended, and SCHED_FIFO with locked memory.\n"},
    {"live",
     "--live of 'run' and 'monitor': the planes (g, h) and (r, omega) and the\n"
     "modes over time, drawn in the terminal.\n"},
    {"over outcome outcomes",
     "What 'sweep' varies, and what it finds: 'twofold help sweep'.\n"},
    {"as teleplot",
     "--as FORM of 'monitor': csv, plotter, teleplot or json, for the tools\n"
     "that 'twofold help monitor' names.\n"},
    {"baud send key follow deadman session start stop reset restore clear "
     "describe",
     "An option of 'monitor', or a command to a board: 'twofold help "
     "monitor'.\n"},
    {"by size spread codim2 samples cycles patience section near "
     "returns depth count grid branches header exhaustive",
     "An option of 'diverge': 'twofold help diverge'.\n"},
    {"name shows leaves-out based-on",
     "Keys of a scene's file: 'twofold help scene'.\n"},
};
#define TOPICS (sizeof topics / sizeof topics[0])

// What each parameter is, in the order of tf_parameter_ranges.
static const char *const about[TF_PARAMETERS] = {
    "mass of the slider",
    "distance of the slider's line from the axis",
    "radius of gyration: the inertia of the disc is beta^2 m",
    "spring of the slider",
    "damping of the disc against ground",
    "damping of the slider",
    "rest position of the spring",
    "speed of the turntable",
    "friction force (not a coefficient) at h -> 0",
    "moment per force in stick",
    "angle of the wheel to the slider",
    "width of the smoothed sign",
    "string stiffness / mu",
    "static pressure limit / mu",
    "relaxation length",
    "dynamic / static pressure",
    "half contact length",
    "that of the scheme: 1/2 for second order, 1 for implicit Euler",
    "step",
    "exit rate of --select random",
    "of --scheme located: relative error of a segment of its series",
    "of --scheme located: how many segments a step may take"};

// Whether a word is in a list.
static bool is_in(const char *words, const char *word) {
  const size_t length = strlen(word);
  for (const char *at = words; *at != '\0' && length > 0;) {
    const size_t span = strcspn(at, " ");
    if (span == length && strncmp(at, word, length) == 0) {
      return true;
    }
    at += span + (at[span] == ' ' ? 1 : 0);
  }
  return false;
}

static bool print_parameter(const char *word) {
  const size_t i = cli_parameter_index(word);
  if (i == TF_PARAMETERS) {
    return false;
  }
  (void)printf("Parameter %s: %s. --set %s=VALUE; name, range, unit:\n", word,
               about[i], word);
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
  for (size_t i = 0; i < CLI_MEASURES; i++) {
    const cli_measure_info_t *info = &cli_measures[i];
    if (strcmp(info->name, word) == 0) {
      (void)printf("Outcome %s of 'sweep': %s%s%s.\n", word,
                   info->what[0] != '\0' ? info->what : "state at the end",
                   info->unit[0] != '\0' ? ", unit " : "", info->unit);
      return true;
    }
  }
  return false;
}

// A word may be several things: `string` is a law and a scene.
bool cli_topic(const char *word) {
  bool found = print_parameter(word);
  found = print_scene(word) || found;
  found = print_outcome(word) || found;
  for (size_t i = 0; i < TOPICS; i++) {
    if (is_in(topics[i].words, word)) {
      (void)fputs(topics[i].text, stdout);
      found = true;
    }
  }
  return found;
}

// Offers each word of a list; the closest one is kept here.
static void offer_words(cli_closest_t *closest, const char *words) {
  static char kept[WORD_ROOM];
  while (*words != '\0') {
    char word[WORD_ROOM];
    const size_t span = strcspn(words, " ");
    (void)snprintf(word, sizeof word, "%.*s", (int)span, words);
    cli_closest_offer(closest, word);
    if (closest->name == word) {
      memcpy(kept, word, sizeof kept);
      closest->name = kept;
    }
    words += span + (words[span] == ' ' ? 1 : 0);
  }
}

void cli_topics_offer(cli_closest_t *closest) {
  for (size_t i = 0; i < TF_PARAMETERS; i++) {
    cli_closest_offer(closest, tf_parameter_ranges[i].name);
  }
  for (size_t i = 0; i < TF_SCENES; i++) {
    cli_closest_offer(closest, tf_scenes[i]->name);
  }
  for (size_t i = 0; i < CLI_MEASURES; i++) {
    cli_closest_offer(closest, cli_measures[i].name);
  }
  for (size_t i = 0; i < TOPICS; i++) {
    offer_words(closest, topics[i].words);
  }
}
