/// What the files of the page's module share: how a function is exported, the
/// text that goes to the page and back, and the set-up of the next motion.
#pragma once

#include "cli/setup/scene_file.h"

// The page looks these functions up by their names, and no file of the module
// calls one of another: each is declared where it is defined.
#pragma GCC diagnostic ignored "-Wmissing-prototypes"
#define EXPORT(symbol) __attribute__((export_name(#symbol))) symbol

/// Where the page puts what it hands over, and takes it: the text of a file or
/// of a number, bytes of a board's line.
#define TEXT_ROOM (CLI_SCENE_BYTES + 1)
extern char page_text[TEXT_ROOM];

/// The scene that the numbers of the set-up make. seed: out, of its rule.
tf_scene_t page_setup(uint32_t *seed);
