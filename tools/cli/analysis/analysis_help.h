/// @file
/// The help pages of the commands that examine a machine without running it.
#ifndef TWOFOLD_CLI_ANALYSIS_HELP_H
#define TWOFOLD_CLI_ANALYSIS_HELP_H

void cli_singularities_help(void);
void cli_regions_help(void);
void cli_design_help(void);
void cli_atlas_help(void);

#endif
