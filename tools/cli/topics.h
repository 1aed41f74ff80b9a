/// @file
/// Help on single words: parameters, columns, modes, laws, rules, schemes,
/// formats, options, scenes, files.
#ifndef TWOFOLD_CLI_TOPICS_H
#define TWOFOLD_CLI_TOPICS_H

#include <stdbool.h>

#include "text/closest.h"

/// Prints what there is to say about a word.
/// Returns: whether there is something.
bool cli_topic(const char *word);

/// Offers all words to a search for the closest one.
void cli_topics_offer(cli_closest_t *closest);

#endif
