// Those by hand on laws without a jump, one field as a whole.
#define PEER_JUMPS 0
#include "hand.c" // NOLINT(bugprone-suspicious-include)
