// Which scene a firmware that contains all of them runs: in a file of its own,
// so that the compiler cannot use it when it compiles the others.
#include <stdint.h>

extern const uint8_t chosen_scene;
const uint8_t chosen_scene = CHOSEN_SCENE;
