// Help pages of the commands that look at a machine without running it.

#include <string.h>

#include "analysis.h"

#define COMMON_OPTIONS                                                        \
  "  --set NAME=VALUE     a parameter or the law, as in 'twofold help run'\n" \
  "  --out FILE           instead of standard output\n"                       \
  "\n"                                                                        \
  "The inputs are those of t = 0. "
#define PLACE_GRID                                         \
  "  --r A:B:N            N values of r from A to B [m]\n" \
  "  --omega A:B:N        N values of omega from A to B [rad/s]\n"

static const char singularities_page[] =
    "usage: twofold singularities SCENE [OPTION]...\n"
    "\n"
    "Every two-fold as JSON: place, K, J1, J2, eigenvalues, type and case; or\n"
    "why there is none.\n"
    "\n" COMMON_OPTIONS
    "K++ .. K-- have the paper's rescaled\n"
    "time tau, dt = clock dtau; those under \"physical\" are in m/s^3. J1, J2\n"
    "and the eigenvalues are the same in both. \"case\" is the paper's, for\n"
    "type invisible; case 3 is J1 J2 < 1. Along a direction that sticks the\n"
    "motion has the velocity [m/s, m/s^2, rad/s^2] and the force lambda [N]\n"
    "given; a negative eigenvalue leads it from sliding to escaping.\n";

static const char regions_page[] =
    "usage: twofold regions SCENE --r A:B:N --omega A:B:N [OPTION]...\n"
    "\n"
    "What h = 0 does at each point of a grid, as CSV:\n"
    "r,omega,region,lambda,delassus. Regions: sliding, escaping, crossing_up\n"
    "(from h < 0 to h > 0), crossing_down, codimension2 (h = g = 0: there the\n"
    "last two columns are empty). lambda [N] is the force that would hold\n"
    "h = 0, beyond mu where it is crossed; delassus is in 1/kg.\n"
    "\n" PLACE_GRID COMMON_OPTIONS "\n";

static const char design_page[] =
    "usage: twofold design SCENE --r R --omega W [OPTION]...\n"
    "\n"
    "kappa and k2 that put a two-fold at (R, W), and what it then is, as "
    "JSON.\n"
    "\n"
    "  --r R                wished r [m]\n"
    "  --omega W            wished omega [rad/s]\n" COMMON_OPTIONS
    "kappa and k2 of the scene do not matter.\n"
    "Exit code 3 where no kappa and k2 in their ranges do it.\n";

static const char atlas_page[] =
    "usage: twofold atlas SCENE --r A:B:N --omega A:B:N [OPTION]...\n"
    "\n"
    "The conditions of the paper's figure 4 for a two-fold wished at each "
    "point\n"
    "of a grid, as CSV. Columns: r,omega,v,g,kappa,k2,K++,K+-,K-+,K--,J1,J2,\n"
    "then 1 or 0 for (b) K--_positive, (c) K++_negative, (d) J1_negative,\n"
    "(e) J2_negative, (f) J1J2_above_1, (g) kappa_positive and k2_positive, "
    "and\n"
    "(a) overlap, which is all of them. K has the paper's rescaled time, J1 "
    "and\n"
    "J2 have sqrt|K++ K--|. kappa is for sign(g); where g < 0 the paper's\n"
    "figure shows it with the other sign. Where no kappa and k2 can do it (r = "
    "0,\n"
    "r = r0, omega = omega0) all but r, omega and overlap are empty.\n"
    "\n" PLACE_GRID COMMON_OPTIONS "\n";

const char *cli_analysis_page(const char *command) {
  static const struct {
    const char *command, *page;
  } pages[] = {{"singularities", singularities_page},
               {"regions", regions_page},
               {"design", design_page},
               {"atlas", atlas_page}};
  for (size_t i = 0; i < sizeof pages / sizeof pages[0]; i++) {
    if (strcmp(pages[i].command, command) == 0) {
      return pages[i].page;
    }
  }
  return NULL;
}
