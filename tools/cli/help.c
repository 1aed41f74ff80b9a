// The help texts and the list of scenes. Names, units and ranges are printed
// from the tables that validate them, so the help cannot fall behind.

#include "help.h"

#include <stdio.h>
#include <string.h>

#include "analysis.h"
#include "diverge.h"
#include "setup.h"
#include "text.h"

#ifdef TF_REAL_FLOAT
#define NUMBER_TYPE "float"
#else
#define NUMBER_TYPE "double"
#endif

static const char usage[] =
    "usage: twofold COMMAND\n"
    "\n"
    "  scenes             list the scenes\n"
    "  run SCENE [...]    simulate a scene, one row an instant\n"
    "  monitor FILE [...] decode frames from a board, a file or a pipe\n"
    "  singularities SCENE  every two-fold, as JSON\n"
    "  regions SCENE ...  sliding, escaping, crossing: a grid of (r, omega)\n"
    "  design SCENE ...   kappa and k2 that put a two-fold at (r, omega)\n"
    "  atlas SCENE ...    which wished (r, omega) make a Teixeira singularity\n"
    "  diverge SCENE ...  futures of a two-fold: exits, returns, statistics\n"
    "  help [COMMAND]     this text, or the options of a command\n"
    "  --version          version and number type\n"
    "\n"
    "exit codes: 0 done, 2 usage, 3 parameter refused, 4 stopped\n";

static const char run_usage[] =
    "usage: twofold run SCENE [OPTION]...\n"
    "\n"
    "  --t-end S            length [s]; default: the scene's own\n"
    "  --dt S               step [s]; the same as --set dt=S\n"
    "  --scheme NAME        moreau: Moreau-Jean theta scheme (the default),\n"
    "                       set by theta; located: Taylor series from switch\n"
    "                       to switch, of high order, set by tolerance (laws\n"
    "                       jump, coulomb, none)\n"
    "                       compensated: moreau that carries its rounding\n"
    "                       along, for small steps in float\n"
    "  --realtime           a step waits for its time on the wall clock; the\n"
    "                       summary counts those that were late\n"
    "  --select RULE        where the future is open: persist, slip+, slip-,\n"
    "                       random[:SEED]; default: the scene's own\n"
    "  --set NAME=VALUE     a parameter, the start or the law; each NAME once\n"
    "  --every N            a row every N steps (default 1); the first and "
    "the\n"
    "                       last instant are always written\n"
    "  --format csv         t,r,v,omega,h,g,F,M,mode,choices (the default)\n"
    "  --format plotter     label:value pairs for a serial plotter\n"
    "  --format frames      what a board sends: see docs/PROTOCOL.md\n"
    "  --out FILE           instead of standard output\n"
    "  --events N|all       events that the summary lists (default 20)\n"
    "\n"
    "No other option may be given twice. Numbers are decimal, or hexadecimal "
    "as\n"
    "in C: 0x1.8p-3 is 0.1875 to the bit, 0x10 is 16.\n"
    "\n"
    "SIGINT and SIGTERM finish the step, write its row and stop; a second one\n"
    "kills. The summary goes to standard error.\n"
    "\n"
    "names of --set, with their ranges:\n";

static const char monitor_usage[] =
    "usage: twofold monitor FILE|DEVICE|- [OPTION]...\n"
    "\n"
    "  --csv                rows as `run` writes them, in the digits of the\n"
    "                       sender's number type; without it a terminal shows\n"
    "                       the state live\n"
    "  --out FILE           of --csv, instead of standard output\n"
    "  --baud N             speed of a serial device; default: as it is\n"
    "  --send COMMAND       sends it to the board and tells the answer; may "
    "be\n"
    "                       repeated: start, stop, reset, snapshot, restore,\n"
    "                       describe, clear, set:NAME=VALUE,\n"
    "                       select:RULE[:SEED], input (back to the scene's),\n"
    "                       input:OMEGA0,R0,FORCE,TORQUE; ends after the last\n"
    "                       answer unless rows or the live view go on\n"
    "  --follow             wait for a device that went away, or for more of "
    "a\n"
    "                       file\n"
    "\n"
    "What was lost and what was broken is told on standard error at the end.\n"
    "exit codes: 0 done, 2 usage, 3 a command was refused, 4 no frame, no\n"
    "answer, or the device went away\n";

static void print_names(void) {
  for (size_t i = 0; i < TF_PARAMETERS; i++) {
    const tf_parameter_range_t *range = &tf_parameter_ranges[i];
    (void)printf("  %-9s [%g, %g]%s%s", range->name, (double)range->low,
                 (double)range->high, strcmp(range->unit, "1") == 0 ? "" : " ",
                 strcmp(range->unit, "1") == 0 ? "" : range->unit);
    if ((range->laws & (1u << TF_TYRE_COULOMB)) == 0) {
      const char *separator = ", only in law ";
      for (unsigned law = 0; law < TF_TYRE_LAWS; law++) {
        if ((range->laws & (1u << law)) != 0) {
          (void)printf("%s%s", separator, cli_law_name((tf_tyre_law_t)law));
          separator = ", ";
        }
      }
    }
    (void)putchar('\n');
  }
  for (size_t i = 0; i < CLI_STARTS; i++) {
    (void)printf("  %-9s [%g, %g] %s, at the start\n", cli_starts[i].name,
                 -(double)TF_STATE_LIMIT, (double)TF_STATE_LIMIT,
                 cli_starts[i].unit);
  }
  (void)printf("  %-9s ", "law");
  for (unsigned law = 0; law < TF_TYRE_LAWS; law++) {
    (void)printf("%s%s", law > 0 ? ", " : "", cli_law_name((tf_tyre_law_t)law));
  }
  (void)fputs(
      "\n"
      "h is given instead of v; its sign wishes the mode. phi has the\n"
      "angle integrated, which nothing else depends on.\n",
      stdout);
}

static void print_run(void) {
  (void)fputs(run_usage, stdout);
  print_names();
}

static void print_monitor(void) { (void)fputs(monitor_usage, stdout); }

// Pages that are more than a text, or have no file of their own.
static const struct {
  const char *command;
  void (*print)(void);
} pages[] = {{"run", print_run},
             {"monitor", print_monitor},
             {"diverge", cli_diverge_help}};
#define PAGES (sizeof pages / sizeof pages[0])

static size_t page_of(const char *command) {
  size_t i = 0;
  while (i < PAGES && strcmp(pages[i].command, command) != 0) {
    i++;
  }
  return i;
}

bool cli_has_page(const char *command) {
  return page_of(command) < PAGES || cli_analysis_page(command) != NULL;
}

int cli_help(int argc, char *const argv[]) {
  if (argc == 0) {
    (void)fputs(usage, stdout);
  } else if (argc == 1 && page_of(argv[0]) < PAGES) {
    pages[page_of(argv[0])].print();
  } else if (argc == 1 && cli_analysis_page(argv[0]) != NULL) {
    (void)fputs(cli_analysis_page(argv[0]), stdout);
  } else {
    return cli_complain(CLI_USAGE,
                        "help: no help on '%s'; try 'twofold help' or "
                        "'twofold help run'",
                        argv[argc - 1]);
  }
  return cli_finish_stdout();
}

int cli_version(void) {
  (void)puts("twofold " TF_VERSION ", tf_real_t is " NUMBER_TYPE);
  return cli_finish_stdout();
}

int cli_scenes(int argc, char *const argv[]) {
  int width = 0;
  if (argc > 0) {
    return cli_complain(CLI_USAGE, "scenes: unexpected argument '%s'", argv[0]);
  }
  for (size_t i = 0; i < TF_SCENES; i++) {
    const int length = (int)strlen(tf_scenes[i]->name);
    width = length > width ? length : width;
  }
  for (size_t i = 0; i < TF_SCENES; i++) {
    (void)printf("%-*s  %s (leaves out: %s)\n", width, tf_scenes[i]->name,
                 tf_scenes[i]->shows, tf_scenes[i]->leaves_out);
  }
  return cli_finish_stdout();
}
