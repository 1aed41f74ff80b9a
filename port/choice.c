// Which scene a firmware that has all of them runs: in a file of its own, so
// that the compiler of the others cannot know.
#include <stdint.h>

extern const uint8_t chosen_scene;
const uint8_t chosen_scene = CHOSEN_SCENE;
