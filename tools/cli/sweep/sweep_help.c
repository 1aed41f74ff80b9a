// The help page of `sweep`. The outcomes are printed from their own table.

#include "sweep_help.h"

#include <stdio.h>

#include "measure.h"

static const char page[] =
    "usage: twofold sweep SCENE --over NAME=A:B:N [OPTION]...\n"
    "\n"
    "One motion at each point of a grid, one row a point, as CSV.\n"
    "\n"
    "  --over NAME=A:B:N    N values from A to B of a name of --set, or of "
    "seed\n"
    "                       (with --select random); may be repeated: the last\n"
    "                       one is the inner loop\n"
    "  --outcome NAME,...   columns, from the list below; default: modes, "
    "rest,\n"
    "                       recurrence, energy, ambiguous\n"
    "  --t-end S, --dt S, --scheme NAME, --select RULE, --set NAME=VALUE\n"
    "                       as in 'twofold help run'\n"
    "  --inputs FILE, --between held|linear\n"
    "                       inputs over time, the same at every point:\n"
    "                       'twofold help inputs'\n"
    "  --out FILE           instead of standard output\n"
    "  --shard I/N          only part I of N of the points; the rows of the\n"
    "                       shards, one file after the other, are those of "
    "all\n"
    "  --resume             goes on behind the last whole row of FILE.part; "
    "does\n"
    "                       nothing where FILE is whole\n"
    "  --summary json       the summary as JSON, in the last line of standard\n"
    "                       error; or text\n"
    "\n"
    "Columns: point (from 0), one for each axis, status, reason, t (the time\n"
    "that was reached), one for each outcome. status is `done`; `flagged` "
    "where\n"
    "some steps were degraded or missed their tolerance; `stopped` where a "
    "step\n"
    "was refused, and outcomes are those until then; `refused` where the\n"
    "machine or its start was, and t and outcomes are empty. reason has the\n"
    "message, with semicolons for commas. An outcome that did not happen is\n"
    "empty. Lines that begin with # tell the command, the units and, at the\n"
    "end, '# shard I/N: ROWS rows, crc32 CRC, run RUN' (CRC of zlib, header\n"
    "and rows; RUN is the same in all shards of a run).\n"
    "\n"
    "A row is what `run` would find: --set NAME=VALUE of its fields repeats "
    "it\n"
    "to the bit. Each program takes one core. tools/study/shards runs the "
    "shards on\n"
    "all cores, under GNU parallel, Slurm or Snakemake, and draws the map.\n"
    "\n"
    "exit codes: 0 done, whatever the rows say; 2 usage, 3 refused: an axis\n"
    "leaves the range of its name, or FILE is of another sweep, 4 stopped\n"
    "\n"
    "outcomes:\n";

void cli_sweep_help(void) {
  (void)fputs(page, stdout);
  for (size_t i = 0; i < CLI_MEASURES; i++) {
    const cli_measure_info_t *info = &cli_measures[i];
    (void)printf("  %-16s %-6s %s\n", info->name, info->unit, info->what);
  }
}
