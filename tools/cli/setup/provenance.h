/// @file
/// What rows are of, as comment lines before their header.
#ifndef TWOFOLD_CLI_PROVENANCE_H
#define TWOFOLD_CLI_PROVENANCE_H

#include "setup.h"

#define CLI_PROVENANCE_ROOM 1024

/// CRC-32 of all of a scene that a motion depends on, with what the command
/// line has changed: parameters, law, rule, start, profile.
uint32_t cli_scene_hash(const cli_setup_t *setup);

/// Writes four lines that begin with #: version, commit and number type; scene,
/// its hash, that of the parameters, law, rule and seed; how the rows were
/// computed; units.
/// how: in, scheme and step of a run. units: in, the columns with their units.
/// Returns: the length.
size_t cli_provenance(const cli_setup_t *setup, const char *how,
                      const char *units, char out[CLI_PROVENANCE_ROOM]);

#endif
