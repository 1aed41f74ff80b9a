/// What the files of the page's module share: how a function is exported, the
/// text that goes to the page and back, the motion and the scene from a file.
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

/// The machine of the motion, NULL before the first, and its last input.
const tf_machine_t *machine_begun(void);
tf_input_t input_applied(void);

/// The scene that was read last, NULL before the first; it is kept.
const tf_scene_t *own_scene(void);

/// A scene as the text of a file, until the next file is put in its place.
const char *scene_as_file(const tf_scene_t *scene);
