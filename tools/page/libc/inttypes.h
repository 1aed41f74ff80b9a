/// Formats of the fixed types that the page's sources print.
#pragma once

#include <stdint.h>

#define PRIu64 "llu"
