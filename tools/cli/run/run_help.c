// The help page of `run`. Names, units and ranges are printed from the tables
// that validate them, so the page always agrees with the program.

#include "run_help.h"

#include <stdio.h>

#include "../setup/names.h"
#include "../setup/setup.h"

static const char page[] =
    "usage: twofold run SCENE [OPTION]...\n"
    "\n"
    "  --t-end S            length [s]; default: the scene's own\n"
    "  --dt S               step [s]; the same as --set dt=S\n"
    "  --scheme moreau      Moreau-Jean theta scheme (the default), set by\n"
    "                       theta\n"
    "           located     Taylor series from event to event, of high order,\n"
    "                       set by tolerance (laws jump, coulomb, none)\n"
    "           compensated  moreau with compensated summation of the state,\n"
    "                       for small steps in float\n"
    "  --realtime           every step waits for its time on the wall clock;\n"
    "                       the summary counts the late ones\n"
    "  --priority           with --realtime: before all other programs, with\n"
    "                       memory locked (SCHED_FIFO, which needs the "
    "right)\n"
    "  --lateness FILE      with --realtime: a histogram of how long after\n"
    "                       their time steps began and ended, "
    "us,began,ended\n"
    "  --live               draws the planes (g, h) and (r, omega) and the "
    "modes\n"
    "                       over time in the terminal, with --realtime at the\n"
    "                       pace of the machine; rows go to --out only\n"
    "  --select RULE        selects one of several consistent modes: persist,\n"
    "                       slip+, slip-, random[:SEED]; default: the scene's\n"
    "                       own\n"
    "  --set NAME=VALUE     a parameter, an initial value or the law; each\n"
    "                       NAME once\n"
    "  --inputs FILE        inputs over time, a CSV table: 'twofold help "
    "inputs'\n"
    "  --between held       a row of it holds until the next one\n"
    "  --between linear     between two rows inputs are linear\n"
    "  --every N            a row every N steps (default 1); the first and\n"
    "                       the last instant are always written\n"
    "  --format csv         t,r,v,omega,h,g,F,M,mode,choices (the default)\n"
    "  --format plotter     label:value pairs for a serial plotter\n"
    "  --format frames      what a board sends: see docs/PROTOCOL.md\n"
    "  --out FILE           instead of standard output\n"
    "  --save FILE          the state at the end of the run, whatever ends it\n"
    "  --from FILE          continues from there, bit for bit: t-end is that\n"
    "                       of the whole, and the first row is the last one\n"
    "                       of the run before\n"
    "  --replay FILE        repeats, to the bit, what a board did while\n"
    "                       'twofold monitor --record FILE' sent it commands;\n"
    "                       with --dt 1/RATE of its firmware, in its number\n"
    "                       type; --save then keeps what commands have left\n"
    "                       in effect, and the summary names the options by\n"
    "                       which --from goes on with it\n"
    "  --provenance         four comment lines before the header: version,\n"
    "                       commit, scene, scheme, units ('twofold help csv')\n"
    "  --summary json       the summary as JSON, in the last line of standard\n"
    "                       error; or text\n"
    "  --events N|all       events that the summary lists (default 20)\n"
    "\n"
    "Every other option may be given once. Numbers are decimal, or "
    "hexadecimal\n"
    "as in C: 0x1.8p-3 is 0.1875 exactly, 0x10 is 16.\n"
    "\n"
    "FILE appears when it is complete. Until then its rows are in FILE.part, "
    "which\n"
    "stays where the run is stopped, and which one program at a time can "
    "write.\n"
    "Pipes and devices are written as they are.\n"
    "After SIGINT, SIGTERM or SIGHUP the program finishes the step, writes "
    "its\n"
    "row and stops; a second signal kills it. The summary goes to standard\n"
    "error.\n"
    "\n"
    "exit codes: 0 done, 2 usage, 3 refused, 4 stopped, 5 done, but some "
    "steps\n"
    "were degraded or missed their tolerance: the summary counts them\n"
    "\n"
    "names of --set, with their ranges:\n";

static void print_names(void) {
  cli_print_ranges();
  for (size_t i = 0; i < CLI_STARTS; i++) {
    (void)printf("  %-9s [%g, %g] %s, at the start\n", cli_starts[i].name,
                 -(double)TF_STATE_LIMIT, (double)TF_STATE_LIMIT,
                 cli_starts[i].unit);
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

void cli_run_help(void) {
  (void)fputs(page, stdout);
  print_names();
}
