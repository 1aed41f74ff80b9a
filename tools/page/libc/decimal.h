/// @file
/// The decimal digits of a double.
#ifndef TWOFOLD_PAGE_DECIMAL_H
#define TWOFOLD_PAGE_DECIMAL_H

#define DECIMAL_ROOM 800 ///< a double has at most 767 digits that are not 0

/// All digits of a finite value, without its sign: 0.d1 d2 d3... times ten to
/// the power of the result.
/// digits: out, as characters, zero-terminated, neither the first nor the last
/// one 0; of 0 there is none.
/// Returns: the power of ten.
int decimal_digits(double value, char digits[DECIMAL_ROOM]);

#endif
