// The help page of `diverge`. Defaults that depend on the mechanism are printed
// from the table that sets them.

#include "diverge_help.h"

#include <stdio.h>

#include "mechanism.h"

static const char page[] =
    "usage: twofold diverge SCENE [OPTION]...\n"
    "\n"
    "Follows motions from a state with several consistent modes: the two-fold\n"
    "that stick passes through, or a start given by --set r=, omega=, h= (or\n"
    "v=). A cycle goes from one arrival at the two-fold to the next.\n"
    "\n"
    "what selects the exit:\n"
    "  --by random          a draw: an escaping stick is left at --rate, to\n"
    "                       either side with equal probability (the default)\n"
    "  --by noise           white noise on h, of --size\n"
    "  --by smoothing       sign(h) smoothed over the width --size\n"
    "  --by hysteresis      friction changes its side at |h| = --size\n"
    "  --by delay           friction has the sign that h had --size ago\n"
    "  --rate R             of --by random [1/s]; default: the scene's rate\n"
    "  --size S             in (0, 1]; unit: see below\n"
    "  --spread Q           the size of each sample is drawn from [S/Q, S],\n"
    "                       log-uniformly; in [1, 1e6]\n"
    "  --codim2 rest        --by random at h = g = 0: pinned, where that is\n"
    "                       consistent, until a draw (the default);\n"
    "           attracting  the attracting stick where there is one;\n"
    "           even        one of the consistent modes, all equally likely.\n"
    "how much:\n"
    "  --samples N          in [1, 4294967295], default 100\n"
    "  --cycles N           per sample, at most; default 1\n"
    "  --patience T         longest cycle [s], in (0, 1e9], default 100\n"
    "  --seed N             in [0, 4294967295], default 1\n"
    "  --shard I/N          only part I of N of the samples; the rows of the\n"
    "                       parts, one after the other, are those of one run\n"
    "  --dt DT              step [s]; near the two-fold (random: in slip)\n"
    "                       DT / K\n"
    "  --near K             in [1, 1e6]\n"
    "  --section D          the phase is read where r is D past the two-fold\n"
    "                       [m], in (0, 1000], default 0.001\n"
    "  --set NAME=VALUE     as in 'twofold help run'\n";

static const char files[] =
    "files, CSV:\n"
    "  --exits FILE         sample,cycle,time [s since the arrival],r [m],\n"
    "                       omega [rad/s],g [m/s],side (slip+ or slip-),phase\n"
    "                       [windings, 0 to 1],how (left, or released: the\n"
    "                       escaping region ended),section_time [s since the\n"
    "                       arrival]\n"
    "  --returns FILE       sample,cycle,outcome,time [s from exit to end],\n"
    "                       arrived [s],exit_r [m],landing_time [s since the\n"
    "                       exit],landing_r [m],landings,windings\n"
    "  --counts FILE        cycles counted in integers: what,key,count, with\n"
    "                       what outcome; begun, returned (by the number of\n"
    "                       the cycle in its sample); side; phase, time (of\n"
    "                       return), landing (bins: see the comments in the\n"
    "                       file). Shards are added by 'twofold merge'\n"
    "  --resume             goes on after a kill; FILE.resume says where\n"
    "                       (of the first of --counts, --returns, --exits)\n"
    "  --header             writes a header even if the shard is not the "
    "first\n"
    "  --provenance         comment lines before the header: 'twofold help\n"
    "                       provenance'; of --branches, too\n"
    "  --summary json       the summary as JSON, in the last line of standard\n"
    "                       error; or text\n"
    "Each ends with '# shard I/N: ROWS rows, crc32 CRC, run RUN' (CRC of\n"
    "zlib, header and rows; RUN is the same in all shards of a run); it\n"
    "appears when it is complete, and is FILE.part until then.\n"
    "Without --exits and --returns the returns go to standard output; FILE -\n"
    "is standard output. Fields of what did not happen are empty. Outcomes:\n"
    "returned, small_cycle (lands 3 times or more and never comes back),\n"
    "pinned, timeout, refused. A landing is an arrival in the sliding region\n"
    "on the other side of g = 0.\n"
    "\n"
    "all branches:\n"
    "  --exhaustive         every mode of every state with several consistent\n"
    "                       ones; an escaping stick is left at multiples of\n"
    "                       --grid, to both sides\n"
    "  --grid T             in [1e-6, 1e3] s, default 0.01\n"
    "  --depth N            in [1, 1000], default 3: states in a row\n"
    "  --count N            in [1, 1e6], default 1000: states in all\n"
    "  --branches FILE      node,depth,kind,r,omega,mode,stick_time,exit_r,\n"
    "                       exit_omega,end,to,time,end_r,landing_r,windings;\n"
    "                       default: standard output. Branches that end at "
    "the\n"
    "                       same state (r within 1e-6 m) have the same number\n"
    "                       in 'to'\n"
    "\n";

void cli_diverge_help(void) {
  (void)fputs(page, stdout);
  (void)fputs(files, stdout);
  (void)puts("kind        unit of S   default DT, K, Q");
  for (int i = 0; i < CLI_MECHANISMS; i++) {
    const cli_mechanism_info_t *mechanism = &cli_mechanisms[i];
    (void)printf("%-11s %-11s %g, %g, %g\n", mechanism->name,
                 mechanism->unit[0] != '\0' ? mechanism->unit : "-",
                 mechanism->dt, mechanism->refinement, mechanism->spread);
  }
  (void)fputs(
      "\n"
      "exit codes: 0 done, 2 usage, 3 refused: only one mode is consistent, "
      "or\n"
      "out of range, 4 stopped (what has ended is in FILE.part) or a file\n"
      "could not be written\n",
      stdout);
}

void cli_merge_help(void) {
  (void)fputs(
      "usage: twofold merge FILE... [--out FILE]\n"
      "\n"
      "Adds files of 'twofold diverge --counts', each of other shards of one\n"
      "run, in any order, to one file of the same form. The sum of all shards\n"
      "has the same rows as the run without --shard. Standard error says how\n"
      "many shards of the run are in it.\n"
      "\n"
      "exit codes: 0 done, 2 usage, or a file is damaged, 3 refused: files of\n"
      "different runs, or a shard twice, 4 the sum could not be written\n",
      stdout);
}
