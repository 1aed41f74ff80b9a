// The overview of the commands, and the version.

#include "help.h"

#include <stdio.h>

#include "text/message.h"
#include "twofold.h"

#ifdef TF_REAL_FLOAT
#define NUMBER_TYPE "float"
#else
#define NUMBER_TYPE "double"
#endif

static const char overview[] =
    "usage: twofold COMMAND\n"
    "\n"
    "  scenes             list the scenes\n"
    "  scene SCENE [...]  print a scene as a file that can be changed\n"
    "  run SCENE [...]    simulate a scene, one row per instant\n"
    "  monitor FILE [...] decode frames from a board, a file or a pipe\n"
    "  singularities SCENE  all two-folds, as JSON\n"
    "  regions SCENE ...  sliding, escaping, crossing: a grid of (r, omega)\n"
    "  design SCENE ...   kappa and k2 that put a two-fold at (r, omega)\n"
    "  atlas SCENE ...    for which (r, omega) it is a Teixeira singularity\n"
    "  diverge SCENE ...  what can follow a two-fold: exits, returns, samples\n"
    "  merge FILE...      adds the counts of shards of diverge\n"
    "  sweep SCENE ...    a grid of settings: what becomes of each point\n"
    "  help [COMMAND]     this text, or the options of a command\n"
    "  help WORD          a parameter, column, mode, law, option, scene, or: "
    "csv,\n"
    "                     inputs, exit, save, replay, summary, provenance\n"
    "  --version          version and number type\n"
    "\n"
    "exit codes: 0 done, 2 usage, 3 parameter refused, 4 stopped, 5 done, but\n"
    "some steps were degraded or missed their tolerance, 6 done, but frames\n"
    "of a stream were lost or broken, or a value in it is not finite\n";

void cli_overview(void) { (void)fputs(overview, stdout); }

int cli_version(void) {
  (void)puts("twofold " TF_VERSION ", tf_real_t is " NUMBER_TYPE);
  return cli_finish_stdout();
}
