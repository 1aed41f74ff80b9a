// A part of a file that was cut off, or lost on the way to where the parts are
// joined, looks like a smaller file that is whole. The last line of each part
// tells what it should have been; it begins with # because gnuplot, numpy and R
// skip such lines. tools/tables/read.py checks it.

#include "trailer.h"

#include <inttypes.h>
#include <stdio.h>

void cli_trailer_add(cli_trailer_t *trailer, const char *lines, size_t length,
                     uint64_t rows) {
  uint32_t crc = ~trailer->crc;
  for (size_t i = 0; i < length; i++) {
    crc ^= (unsigned char)lines[i];
    for (int bit = 0; bit < 8; bit++) {
      crc = crc >> 1 ^ (0xedb88320u & (0u - (crc & 1u)));
    }
  }
  trailer->crc = ~crc;
  trailer->rows += rows;
}

size_t cli_trailer_line(const cli_trailer_t *trailer, const cli_shard_t *shard,
                        char out[CLI_TRAILER_ROOM]) {
  return (size_t)snprintf(out, CLI_TRAILER_ROOM,
                          "# shard %" PRIu64 "/%" PRIu64 ": %" PRIu64
                          " rows, crc32 %08" PRIx32 "\n",
                          shard->index, shard->of, trailer->rows, trailer->crc);
}
