/// @file
/// Registers of the hardware.
#ifndef TWOFOLD_PORT_REGISTER_H
#define TWOFOLD_PORT_REGISTER_H

#include <stdint.h>

/// The register of 32 bits at an address.
#define REGISTER(address) (*(volatile uint32_t *)(address))

#endif
