// A part of a file that was cut off, or lost on the way to where the parts are
// joined, looks like a smaller file that is whole. The last line of each part
// says what it should have been, and which run it is of: a shard that was
// stopped leaves the whole one of an earlier run under its name. It begins with
// # because gnuplot, numpy and R skip such lines. tools/tables/read.py checks
// it.

#include "trailer.h"

#include <inttypes.h>
#include <stdio.h>

static uint32_t crc_of(uint32_t before, const char *bytes, size_t length) {
  uint32_t crc = ~before;
  for (size_t i = 0; i < length; i++) {
    crc ^= (unsigned char)bytes[i];
    for (int bit = 0; bit < 8; bit++) {
      crc = crc >> 1 ^ (0xedb88320u & (0u - (crc & 1u)));
    }
  }
  return ~crc;
}

void cli_trailer_add(cli_trailer_t *trailer, const char *lines, size_t length,
                     uint64_t rows) {
  trailer->crc = crc_of(trailer->crc, lines, length);
  trailer->rows += rows;
}

void cli_trailer_name(cli_trailer_t *trailer, const char *text, size_t length) {
  trailer->run = crc_of(0, text, length);
}

size_t cli_trailer_line(const cli_trailer_t *trailer, const cli_shard_t *shard,
                        char out[CLI_TRAILER_ROOM]) {
  return (size_t)snprintf(out, CLI_TRAILER_ROOM,
                          "# shard %" PRIu64 "/%" PRIu64 ": %" PRIu64
                          " rows, crc32 %08" PRIx32 ", run %08" PRIx32 "\n",
                          shard->index, shard->of, trailer->rows, trailer->crc,
                          trailer->run);
}
