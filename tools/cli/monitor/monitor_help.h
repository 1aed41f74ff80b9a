/// @file
/// The help page of `monitor`.
#ifndef TWOFOLD_CLI_MONITOR_HELP_H
#define TWOFOLD_CLI_MONITOR_HELP_H

void cli_monitor_help(void);

#endif
