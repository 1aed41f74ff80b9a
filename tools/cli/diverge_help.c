// Help page of `diverge`. Defaults that go with a kind are printed from the
// table that sets them.

#include <stdio.h>

#include "diverge.h"

static const char page[] =
    "usage: twofold diverge SCENE [OPTION]...\n"
    "\n"
    "Follows futures of a place that has more than one: the two-fold that "
    "stick\n"
    "runs through, or a start typed by --set r=, omega=, h= (or v=). A cycle "
    "goes\n"
    "from one arrival at the two-fold to the next.\n"
    "\n"
    "what decides:\n"
    "  --by random          a draw: an open stick is left at --rate, to "
    "either\n"
    "                       side alike (the default)\n"
    "  --by noise           white noise on h, of --size\n"
    "  --by smoothing       sign(h) smoothed over the width --size\n"
    "  --by hysteresis      friction changes its side at |h| = --size\n"
    "  --by delay           friction has the sign of h of --size ago\n"
    "  --rate R             of --by random [1/s]; default: the scene's rate\n"
    "  --size S             in (0, 1]; unit: see below\n"
    "  --spread Q           each sample's size is drawn from [S/Q, S], evenly "
    "in\n"
    "                       its logarithm; in [1, 1e6]\n"
    "  --corner rest        at h = g = 0, --by random: the wheel rests where "
    "it\n"
    "                       may until its draw (the default);\n"
    "           attracting  it takes the attracting stick where there is one;\n"
    "           even        one of the consistent modes is drawn, each alike\n"
    "how much:\n"
    "  --samples N          in [1, 4294967295], default 100\n"
    "  --cycles N           of a sample at most, default 1\n"
    "  --patience T         longest cycle [s], in (0, 1e9], default 100\n"
    "  --seed N             in [0, 4294967295], default 1\n"
    "  --shard I/N          only the samples of part I of N; the parts, one "
    "behind\n"
    "                       the other, are the bytes of one run\n"
    "  --dt DT              step [s]; near the two-fold (random: in slip) DT / "
    "K\n"
    "  --near K             in [1, 1e6]\n"
    "  --section D          phase is read where r is D past the two-fold [m],\n"
    "                       in (0, 1000], default 0.001\n"
    "  --set NAME=VALUE     as in 'twofold help run'\n"
    "files, CSV:\n"
    "  --exits FILE         sample,cycle,time [s since the arrival],r [m],\n"
    "                       omega [rad/s],g [m/s],side (slip+ or slip-),phase\n"
    "                       [windings, 0 to 1],how (left, or released: "
    "|lambda|\n"
    "                       was mu),section_time [s since the arrival]\n"
    "  --returns FILE       sample,cycle,outcome,time [s from exit to end],\n"
    "                       arrived [s],exit_r [m],landing_time [s from "
    "exit],\n"
    "                       landing_r [m],landings,windings\n"
    "  --header             a header though the shard is not the first\n"
    "Without --exits and --returns the returns go to standard output; FILE - "
    "is\n"
    "standard output. Fields of what did not happen are empty. Outcomes: "
    "returned,\n"
    "small_cycle (lands 3 times or more and never comes back), pinned, "
    "timeout,\n"
    "refused. A landing is the first rest on the sliding region on the other "
    "side\n"
    "of g = 0.\n"
    "\n"
    "every future:\n"
    "  --exhaustive         each future of each place with several; an open "
    "stick\n"
    "                       is left at multiples of --grid, to both sides\n"
    "  --grid T             in [1e-6, 1e3] s, default 0.01\n"
    "  --depth N            in [1, 1000], default 3: places in a row\n"
    "  --count N            in [1, 1e6], default 1000: places in all\n"
    "  --branches FILE      node,depth,kind,r,omega,mode,stick_time,exit_r,\n"
    "                       exit_omega,end,to,time,end_r,landing_r,windings;\n"
    "                       default: standard output. Branches that end at "
    "one\n"
    "                       place (r within 1e-6 m) have the same number in "
    "'to'\n"
    "\n";

void cli_diverge_help(void) {
  (void)fputs(page, stdout);
  (void)puts("kind        unit of S   default DT, K, Q");
  for (int i = 0; i < CLI_BYS; i++) {
    const cli_kind_t *kind = &cli_kinds[i];
    (void)printf("%-11s %-11s %g, %g, %g\n", kind->name,
                 kind->unit[0] != '\0' ? kind->unit : "-", kind->dt, kind->near,
                 kind->spread);
  }
  (void)fputs(
      "\n"
      "exit codes: 0 done, 2 usage, 3 refused: nothing diverges, or out of\n"
      "range, 4 stopped (what has ended is written) or a file not written\n",
      stdout);
}
