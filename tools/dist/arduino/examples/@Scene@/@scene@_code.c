/* The code of the prepared scene: one file of a program holds it. */
#define TWOFOLD_@SCENE@_CODE
#include <twofold_@scene@.h>
