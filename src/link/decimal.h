// A real as text, in up to six digits: without a C library and without a table
// of powers.
#ifndef TF_DECIMAL_H
#define TF_DECIMAL_H

#include <stddef.h>

#include "../num/rounding.h"
#include "twofold/real.h"

// The longest: "-1.23456e-308".
#define DECIMAL_SIZE 13

// Writes value without a terminating zero, in e notation below 1e-5 and from
// 1e6 on; "nan", "inf", "-inf" too. It is scaled by powers of ten in tf_real_t,
// which may cost one unit of the last digit. Returns: the length.
#define tf_decimal TF_LINK(tf_decimal)
TF_API size_t tf_decimal(char *out, tf_real_t value);

#endif
