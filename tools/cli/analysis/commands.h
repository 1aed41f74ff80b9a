/// @file
/// The commands that examine a machine without running it. argv[0] is the first
/// argument after the name. Each returns the exit code.
#ifndef TWOFOLD_CLI_ANALYSIS_COMMANDS_H
#define TWOFOLD_CLI_ANALYSIS_COMMANDS_H

int cli_singularities(int argc, char *const argv[]);
int cli_regions(int argc, char *const argv[]);
int cli_design(int argc, char *const argv[]);
int cli_atlas(int argc, char *const argv[]);

#endif
