/// What the files of the page's module share: how a function is exported, and
/// the numbers that go to the page and back. They are doubles in one table,
/// which the page views as a Float64Array: that of the present instant is
/// also a snapshot, because all that the motion goes on from is in it.
#pragma once

#include "cli/setup/scene_file.h"

// The page looks these functions up by their names, and no file of the module
// calls one of another: each is declared where it is defined.
#pragma GCC diagnostic ignored "-Wmissing-prototypes"
#define EXPORT(symbol) __attribute__((export_name(#symbol))) symbol

/// Columns of a row, in the order in which core.mjs names them.
enum {
  ROW_T,
  ROW_R,
  ROW_V,
  ROW_W,
  ROW_H,
  ROW_G,
  ROW_F,
  ROW_M,
  ROW_MODE,
  ROW_CHOICES,
  ROW_SET,
  ROW_STATUS,
  ROW_TICK,
  ROW_PHI,
  ROW_TABLE, ///< angle of the turntable [rad]
  ROW_OMEGA0,
  ROW_R0,
  ROW_FORCE,
  ROW_TORQUE,
  ROW_ENERGY,
  ROW_DELASSUS,
  ROW_RESIDUAL,
  ROW_COLUMNS
};

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
