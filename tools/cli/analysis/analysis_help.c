// Help pages of the commands that examine a machine without running it.

#include "analysis_help.h"

#include <stdio.h>

#define COMMON_OPTIONS                                                        \
  "  --set NAME=VALUE     a parameter or the law, as in 'twofold help run'\n" \
  "  --out FILE           instead of standard output\n"                       \
  "\n"                                                                        \
  "The inputs are those at t = 0.\n"
#define GRID_OPTIONS                                                        \
  "  --r A:B:N            N values of r from A to B [m]\n"                  \
  "  --omega A:B:N        N values of omega from A to B [rad/s]\n"          \
  "  --provenance         comment lines before the header: 'twofold help\n" \
  "                       provenance'\n"

void cli_singularities_help(void) {
  (void)fputs(
      "usage: twofold singularities SCENE [OPTION]...\n"
      "\n"
      "All two-folds as JSON: point, K, J1, J2, eigenvalues, type and case; "
      "or\n"
      "why there is none.\n"
      "\n" COMMON_OPTIONS
      "K++ .. K-- are in the paper's rescaled time tau, dt = time_scale dtau;\n"
      "those\n"
      "under \"physical\" are in m/s^3. J1, J2 and the eigenvalues are the "
      "same\n"
      "in both. \"case\" is the paper's, for type invisible; case 3 is\n"
      "J1 J2 < 1. Along a direction in which the wheel sticks the motion has\n"
      "the given velocity [m/s, m/s^2, rad/s^2] and force lambda [N]; a\n"
      "negative eigenvalue leads from sliding to escaping.\n",
      stdout);
}

void cli_regions_help(void) {
  (void)fputs(
      "usage: twofold regions SCENE --r A:B:N --omega A:B:N [OPTION]...\n"
      "\n"
      "The region of the surface h = 0 at each point of a grid, as CSV:\n"
      "r,omega,region,lambda,delassus. Regions: sliding, escaping,\n"
      "crossing_up (from h < 0 to h > 0), crossing_down, and codim2\n"
      "(h = g = 0, where the last two columns are empty). lambda [N] is the\n"
      "force that would hold h = 0; where the surface is crossed it exceeds\n"
      "mu. delassus is in 1/kg.\n"
      "\n" GRID_OPTIONS COMMON_OPTIONS,
      stdout);
}

void cli_design_help(void) {
  (void)fputs(
      "usage: twofold design SCENE --r R --omega W [OPTION]...\n"
      "\n"
      "kappa and k2 that put a two-fold at (R, W), and its normal form, as\n"
      "JSON.\n"
      "\n"
      "  --r R                r of the two-fold [m]\n"
      "  --omega W            omega of the two-fold [rad/s]\n" COMMON_OPTIONS
      "kappa and k2 of the scene are not used. Exit code 3 where no kappa and\n"
      "k2 in their ranges exist.\n",
      stdout);
}

void cli_atlas_help(void) {
  (void)fputs(
      "usage: twofold atlas SCENE --r A:B:N --omega A:B:N [OPTION]...\n"
      "\n"
      "The conditions of the paper's figure 4 for a two-fold at each point of\n"
      "a grid, as CSV. Columns: r,omega,v,g,kappa,k2,K++,K+-,K-+,K--,J1,J2,\n"
      "then 1 or 0 for (b) K--_positive, (c) K++_negative, (d) J1_negative,\n"
      "(e) J2_negative, (f) J1J2_above_1, (g) kappa_positive and k2_positive,\n"
      "and (a) overlap: all of them hold. K is in the paper's rescaled time,\n"
      "J1 and J2 include sqrt|K++ K--|. kappa is for sign(g); where g < 0 the\n"
      "paper's figure shows it with the other sign. Where no kappa and k2\n"
      "exist (r = 0, r = r0, omega = omega0) all columns but r, omega and\n"
      "overlap are empty.\n"
      "\n" GRID_OPTIONS COMMON_OPTIONS,
      stdout);
}
