// The table of the commands. The command line is made of these folders; each
// line includes only folders below it (check `arrows` has the same table):
//
//   .          command (performs a command line), commands (this table), table
//              (of the options), options (reads them), help, topics (help on
//              words), completions, the commands `scenes` and `scene`
//   monitor/   the command `monitor`; takes only row.h of run/
//   run/       the command `run`: loop, rows, frames, events, summary
//   analysis/  singularities, regions, design, atlas and tyre
//   diverge/   the command `diverge`. Bottom up: canard, tracker, motion (with
//              noise), random, exhaustive, diverge
//   sweep/     the command `sweep`; takes only events.h of run/
//   setup/     a scene, by its name or from a file, with --set and --select
//              becomes a machine with its initial state; schemes, names; what a
//              command line gives (args.h)
//   live/      --live of run and monitor: planes and modes in a terminal
//   host/      what POSIX provides: clock, signals, files, lines, progress;
//              files that are gone on with after a kill (sheet)
//   text/      messages, numbers, options, text in buffers
//
// run, analysis, diverge and sweep do not include each other otherwise.

#include <stdio.h>
#include <stdlib.h>

#include "command.h"
#include "setup/setup.h"
#include "sweep/point.h"
#include "text/text.h"

static void print_names(void) {
  cli_print_ranges();
  for (size_t i = CLI_R; i < CLI_NUMBERS; i++) {
    const tf_parameter_range_t *range = cli_number(i);
    (void)printf("  %-9s [%g, %g] %s, at the start\n", range->name,
                 (double)range->low, (double)range->high, range->unit);
  }
  (void)printf("  %-9s ", "law");
  for (unsigned law = 0; law < TF_TYRE_LAWS; law++) {
    (void)printf("%s%s", law > 0 ? ", " : "", tf_tyre_law_name(law));
  }
  (void)printf("\n  %-9s ", "rest");
  for (unsigned rest = 0; rest < TF_REST_LAWS; rest++) {
    (void)printf("%s%s", rest > 0 ? ", " : "", tf_rest_law_name(rest));
  }
  (void)fputs(
      ", the law at h = g = 0, only in law jump\n"
      "h is an alternative to v; its sign selects the initial mode. With phi\n"
      "the angle is integrated, too; nothing else depends on it.\n",
      stdout);
}

static void print_outcomes(void) {
  for (size_t i = 0; i < CLI_MEASURES; i++) {
    const cli_measure_info_t *info = &cli_measures[i];
    (void)printf("  %-16s %-6s %s\n", info->name, info->unit, info->what);
  }
}

#define AT_START "The inputs are those at t = 0."

// Lines of text are filled when they are printed, but those that begin with a
// blank.
const cli_command_t cli_commands[] = {
    {"scenes", "", "list the scenes", .raw = cli_scenes},
    {"scene", "SCENE [OPTION]...",
     "print a scene as a file that can be changed",
     .about = "Prints a scene as text. All commands, and 'make firmware' and "
              "'make fmu', take a file of such text as SCENE; it reads back to "
              "the same bits. A word with a . or a / in it names a file, any "
              "other one a scene of 'twofold scenes'.",
     .notes =
         "A line is KEY VALUE or KEY = VALUE; # begins a comment. No key may "
         "be given twice. A last line without a newline is told: it may be cut "
         "off. A file may begin with 'based-on SCENE', one of "
         "'twofold scenes', and then gives only what differs. For example:\n"
         "\n"
         "  based-on chaos\n"
         "  kappa 0.3        # m\n"
         "  h 0              # starts in stick\n"
         "\n"
         "keys:\n"
         "  name, shows, leaves-out   text; name: that of the file if not "
         "given\n"
         "  law, rest, rule           words as in 'twofold help run'\n"
         "  with-angle                yes: the angle phi is integrated; or no\n"
         "  r, omega, v or h          the start [m, rad/s, m/s, m/s]\n"
         "  t-end                     how long it runs by default [s]\n"
         "  profile                   speed of the turntable, linear between "
         "up to\n"
         "                            8 knots TIME:SPEED [s:rad/s]; or none\n"
         "and the parameters:",
     .tail = cli_print_ranges, .bit = CLI_SCENE, .perform = cli_scene},
    {"run", "SCENE [OPTION]...", "simulate a scene, one row per instant",
     .notes =
         "Each option but --set may be given once. Numbers are decimal, or "
         "hexadecimal as in C: 0x1.8p-3 is 0.1875 exactly, 0x10 is 16.\n"
         "\n"
         "Rows go to FILE.part, which becomes FILE when it is complete. It is "
         "kept where the run is stopped, and only one program at a time can "
         "write it. Pipes and devices are written as they are. On a terminal, "
         "where neither --out nor --format is given, the first and the last "
         "rows are shown, with fewer digits.\n"
         "After SIGINT, SIGTERM or SIGHUP the program finishes the step, "
         "writes its row and stops; a second signal kills it. The summary goes "
         "to standard error.\n"
         "exit codes: see 'twofold help exit'\n"
         "\n"
         "names of --set, with their ranges:",
     .tail = print_names, .bit = CLI_RUN, .check = cli_run_check,
     .perform = cli_run},
    {"monitor", "FILE|DEVICE|- [OPTION]...",
     "decode frames from a board, a file or a pipe",
     .about =
         "Decodes the frames of a board, a file or a pipe (-), and tells at "
         "the end, on standard error, who sent them, what was lost or broken "
         "and the last state. Rows are written with --format; without it a "
         "terminal shows the live view, and anything else gets no rows.",
     .notes =
         "FILE is written as FILE.part and gets its name at the end ('twofold "
         "help run'), but not where frames are missing or come from more than "
         "one run. Lost and broken frames, and rows with a value that is not "
         "finite, are counted at the end on standard error; on a device the "
         "count begins at the first schema. A stream of `run` ends with a "
         "heartbeat; without it the stream is incomplete.\n"
         "exit codes: 0 done, 2 usage, 3 a command was refused, 4 no frame, no "
         "answer, interrupted within a file, or the device was unplugged, 5 "
         "done, but some steps were degraded, coarse or stalled, or the board "
         "reports that it skipped steps, 6 done, but frames were lost or "
         "broken, the stream ends before its run, the sender was started again "
         "(unless there is --follow), or a value is not finite",
     .bit = CLI_MONITOR, .take = cli_take_source, .check = cli_monitor_check,
     .perform = cli_monitor},
    {"singularities", "SCENE [OPTION]...", "all two-folds, as JSON",
     .about = "All two-folds as JSON: point, K, J1, J2, eigenvalues, type and "
              "case; or why there is none.",
     .notes = AT_START
     "\n"
     "K++ .. K-- are in the paper's rescaled time tau, dt = time_scale dtau; "
     "those under \"physical\" are in m/s^3. J1, J2 and the eigenvalues are "
     "the same in both. \"case\" is the paper's, for type invisible; case 3 is "
     "J1 J2 < 1. Along a direction in which the wheel sticks the motion has "
     "the given velocity [m/s, m/s^2, rad/s^2] and force lambda [N]; a "
     "negative eigenvalue leads from sliding to escaping.",
     .bit = CLI_SINGULARITIES, .perform = cli_singularities},
    {"regions", "SCENE --r A:B:N --omega A:B:N [OPTION]...",
     "sliding, escaping, crossing: a grid of (r, omega)",
     .about =
         "The region of the surface h = 0 at each point of a grid, as CSV: "
         "r,omega,region,lambda,delassus. Regions: sliding, escaping, "
         "crossing_up (from h < 0 to h > 0), crossing_down, and codim2 (h = g "
         "= 0, where the last two columns are empty). lambda [N] is the force "
         "that would hold h = 0; where the surface is crossed it exceeds mu. "
         "delassus is in 1/kg.",
     .notes = AT_START, .bit = CLI_REGIONS, .check = cli_analysis_check,
     .perform = cli_regions},
    {"design", "SCENE --r R --omega W [OPTION]...",
     "kappa and k2 that put a two-fold at (r, omega)",
     .about =
         "kappa and k2 that put a two-fold at (R, W), and its normal form, "
         "as JSON.",
     .notes = AT_START
     "\n"
     "kappa and k2 of the scene are not used. Exit code 3 where no kappa and "
     "k2 in their ranges exist.",
     .bit = CLI_DESIGN, .check = cli_analysis_check, .perform = cli_design},
    {"atlas", "SCENE --r A:B:N --omega A:B:N [OPTION]...",
     "for which (r, omega) it is a Teixeira singularity",
     .about =
         "The conditions of the paper's figure 4 for a two-fold at each point "
         "of a grid, as CSV. Columns: r,omega,v,g,kappa,k2,K++,K+-,K-+,K--,J1,"
         "J2, then 1 or 0 for (b) K--_positive, (c) K++_negative, (d) "
         "J1_negative, (e) J2_negative, (f) J1J2_above_1, (g) kappa_positive "
         "and k2_positive, and (a) overlap: all of them hold. K is in the "
         "paper's rescaled time, J1 and J2 include sqrt|K++ K--|. kappa is for "
         "sign(g); where g < 0 the paper's figure shows it with the other "
         "sign. Where no kappa and k2 exist (r = 0, r = r0, omega = omega0) "
         "all columns but r, omega and overlap are empty.",
     .notes = AT_START, .bit = CLI_ATLAS, .check = cli_analysis_check,
     .perform = cli_atlas},
    {"tyre", "SCENE [OPTION]...", "force and moment over the slip angle",
     .about =
         "Friction force and moment over the slip angle atan2(h, g), as "
         "CSV: angle,F,M in degrees, N, N m. At 0 they are the limits from "
         "h > 0. The slip is 1 m/s; only law smooth asks for it.",
     .bit = CLI_TYRE, .perform = cli_tyre},
    {"diverge", "SCENE [OPTION]...",
     "what can follow a two-fold: exits, returns, samples",
     .about =
         "Follows motions from a state with several consistent modes: the "
         "two-fold that stick passes through, or a start given by --set r=, "
         "omega=, h= (or v=). A cycle goes from one arrival at the two-fold to "
         "the next.",
     .notes = "A file is FILE.part until it is complete. Without --exits and "
              "--returns the returns go to standard output; FILE - is standard "
              "output. A "
              "field is empty where its event did not happen. Outcomes: "
              "returned, small_cycle (lands 3 times or more and never comes "
              "back), rest (pinned, or a stick with |g| <= 1e-9 m/s), timeout, "
              "refused. A landing is an arrival in the "
              "sliding region on the other side of g = 0.\n"
              "\n"
              "exit codes: 0 done, 2 usage, 3 refused: only one mode is "
              "consistent, or out of range, 4 stopped (finished samples are in "
              "FILE.part) or a file could not be written",
     .bit = CLI_DIVERGE, .check = cli_diverge_check, .perform = cli_diverge},
    {"sweep", "SCENE --over NAME=A:B:N [OPTION]...",
     "a grid of settings: what becomes of each point",
     .about = "Follows one motion from each point of a grid and writes one row "
              "for each, as CSV.",
     .notes =
         "Columns: point (from 0), one for each axis, status, reason, t (the "
         "time that was reached), one for each outcome. status is `done`; "
         "`flagged` where some steps were degraded, coarse or stalled; "
         "`stopped` where a step was refused (the outcomes are those up to "
         "it); `refused` where the machine or its start was refused (t and "
         "outcomes are empty). reason is the message, with semicolons in place "
         "of commas. An outcome that did not happen is empty.\n"
         "\n"
         "`run` with the values of a row as --set NAME=VALUE repeats it to the "
         "bit. Each program takes one core. tools/study/shards runs the shards "
         "on all cores, under GNU parallel, Slurm or Snakemake, and draws the "
         "map.\n"
         "\n"
         "exit codes: 0 done, whatever the rows say; 2 usage, 3 refused: an "
         "axis leaves the range of its name, or FILE is of another sweep, 4 "
         "stopped\n"
         "\n"
         "outcomes:",
     .tail = print_outcomes, .bit = CLI_SWEEP, .check = cli_sweep_check,
     .perform = cli_sweep},
    {"completions", "SHELL", "a script by which a shell completes all this",
     .about = "Prints a script. SHELL is bash, zsh or fish. In bash: 'source "
              "<(twofold completions bash)', "
              "in ~/.bashrc; of zsh, into a file _twofold of the $fpath; of "
              "fish, into ~/.config/fish/completions/twofold.fish.",
     .raw = cli_completions},
    {"help", "[COMMAND]", "this text, or the options of a command",
     .raw = cli_help},
};
const size_t cli_command_count = sizeof cli_commands / sizeof cli_commands[0];
