/// @file
/// Bytes from an interrupt to the main program: one writer, one reader, no
/// lock. Each index is written by one side only, and is one byte, which every
/// target reads and writes atomically. A full ring drops the newest byte. What
/// is lost is counted; a program has one ring.
#ifndef TWOFOLD_PORT_RING_H
#define TWOFOLD_PORT_RING_H

#include "port.h"

/// Room for RING_SIZE - 1 bytes; a power of two, at most 256. With an uplink it
/// has room for three of the longest commands, or five inputs in float.
#ifdef UPLINK
#define RING_SIZE 256u
#else
#define RING_SIZE 64u
#endif

typedef struct {
  volatile uint8_t written, read;
  volatile uint8_t byte[RING_SIZE];
} ring_t;

static volatile uint32_t ring_lost;

uint32_t port_unread(void) { return ring_lost; }

/// For the interrupt: the hardware has lost a byte, or says that one is broken.
static inline void ring_lose(void) { ring_lost = ring_lost + 1u; }

static inline void ring_put(ring_t *ring, uint8_t byte) {
  const uint8_t here = ring->written;
  const uint8_t next = (uint8_t)((here + 1u) % RING_SIZE);
  if (next == ring->read) {
    ring_lose();
    return;
  }
  ring->byte[here] = byte;
  ring->written = next;
}

/// Returns: the oldest byte, or -1.
static inline int ring_get(ring_t *ring) {
  const uint8_t here = ring->read;
  if (here == ring->written) return -1;
  const int byte = ring->byte[here];
  ring->read = (uint8_t)((here + 1u) % RING_SIZE);
  return byte;
}

#endif
