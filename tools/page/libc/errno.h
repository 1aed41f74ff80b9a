/// What libc.mjs reports of a number that is too small for its type; page.mk
/// exports the variable.
#pragma once

extern int errno;
#define ERANGE 34
