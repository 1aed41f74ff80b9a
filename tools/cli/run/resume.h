/// @file
/// A run that goes on where another one stands: --save and --from.
#ifndef TWOFOLD_CLI_RESUME_H
#define TWOFOLD_CLI_RESUME_H

#include "record.h"

/// Saves where a run stands in the open file of --save, with the parameters,
/// the rule and the inputs that commands of a replay have left in effect.
/// path: in, of --save, NULL: it is not asked for.
/// Returns: whether that is written, or not asked for.
bool cli_run_save(cli_run_t *run, const char *path);

/// Checks that a command line does not give the start or the seed, which a file
/// does.
/// option, path: in, of the file. seed: in, that of the file.
/// Returns: CLI_DONE; after a message CLI_USAGE or CLI_REFUSED.
int cli_run_check_start(const cli_args_t *args, const cli_setup_t *setup,
                        const char *option, const char *path, uint32_t seed);

/// Puts a run where the file of --from says that another one stands.
/// run: in/out, at its start. setup: in/out, takes the seed.
/// Returns: CLI_DONE; after a message CLI_USAGE or CLI_REFUSED.
int cli_run_go_on(cli_run_t *run, const cli_args_t *args, cli_setup_t *setup);

#endif
