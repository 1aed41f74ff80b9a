/// @file
/// The states (r, v, w) at the end of the problems, from reference.c: long
/// double, order five, every switch located, equal to 16 digits when the step
/// is halved. tests/support/orbit.c gives the first one too, in other
/// variables, and tests/data the third one, in quadruple precision.
#ifndef TWOFOLD_PEERS_SOLUTIONS_H
#define TWOFOLD_PEERS_SOLUTIONS_H

// clang-format off
#define REFERENCE_CHAOS \
  {0.1856763572578378, 0.0102983648529212, -0.9873534743284104}
#define REFERENCE_CROSSINGS \
  {0.1886808815782359, -7.495738287217176, -6.698365300524031}
#define REFERENCE_STICKSLIP \
  {0.1579390330387785, 0.3466910898699133, -0.5882826737343841}
#define REFERENCE_DRIVEN \
  {0.01923285892412156, 1.822891319352441, 2.524400963576163}
// clang-format on

#endif
