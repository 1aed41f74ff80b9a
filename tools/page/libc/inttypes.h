/// @file
/// Formats of the fixed types that the page's sources print.
#ifndef TWOFOLD_PAGE_INTTYPES_H
#define TWOFOLD_PAGE_INTTYPES_H

#include <stdint.h>

#define PRIu64 "llu"

#endif
