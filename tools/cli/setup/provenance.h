/// @file
/// What rows are of, as comment lines before their header.
#ifndef TWOFOLD_CLI_PROVENANCE_H
#define TWOFOLD_CLI_PROVENANCE_H

#include "setup.h"

#define CLI_PROVENANCE_ROOM 1024

/// Writes four lines that begin with #: version, commit and number type; scene,
/// hash of the parameters, law, rule and seed; how the rows were computed;
/// units.
/// how: in, scheme and step of a run. units: in, the columns with their units.
/// Returns: the length.
size_t cli_provenance(const cli_setup_t *setup, const char *how,
                      const char *units, char out[CLI_PROVENANCE_ROOM]);

#endif
