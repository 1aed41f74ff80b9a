/// @file
/// Of which commit this program is.
#ifndef TWOFOLD_CLI_COMMIT_H
#define TWOFOLD_CLI_COMMIT_H

/// Its short hash, with "-dirty" behind it where files had been changed;
/// "unknown" where it was not compiled in a git work tree.
extern const char *const cli_commit;

#endif
