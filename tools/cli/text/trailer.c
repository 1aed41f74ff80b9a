// A part of a file that was cut off, or lost on the way to where the parts are
// joined, looks like a smaller file that is whole. The last line of each part
// says what it should have been, and which run it is of: a shard that was
// stopped leaves the whole one of an earlier run under its name. It begins with
// # because gnuplot, numpy and R skip such lines. tools/study/table.py checks
// it.

#include "trailer.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "../../../src/link/parts.h"
#include "message.h"
#include "number.h"

#define MAX_SHARDS 1000000000000000u

// Each shard is a run of neighbours, so that the rows of all shards, one file
// after the other, are those of the whole.
const cli_shard_t cli_whole_shard = {1, 1};

int cli_read_shard(const cli_given_t *given, cli_shard_t *shard) {
  char first[CLI_REAL_ROOM];
  const size_t length = strcspn(given->value, "/");
  const char *second = given->value + length;
  (void)snprintf(first, sizeof first, "%.*s", (int)length, given->value);
  if (*second != '/' || !cli_read_whole(first, 0, MAX_SHARDS, &shard->index) ||
      !cli_read_whole(second + 1, 0, MAX_SHARDS, &shard->of)) {
    return cli_message(CLI_USAGE, "%s %s: expected I/N, two whole numbers",
                       given->name, given->value);
  }
  if (shard->index < 1 || shard->index > shard->of) {
    return cli_message(CLI_REFUSED,
                       "%s %s: I must lie in [1, N], N be at least 1",
                       given->name, given->value);
  }
  return CLI_DONE;
}

void cli_shard_range(const cli_shard_t *shard, uint64_t count, uint64_t *first,
                     uint64_t *end) {
  const uint64_t before = shard->index - 1;
  const uint64_t share = count / shard->of;
  const uint64_t longer = count % shard->of; // shards with one more
  *first = share * before + (before < longer ? before : longer);
  *end = *first + share + (before < longer ? 1 : 0);
}

uint32_t cli_crc(uint32_t before, const void *from, size_t length) {
  return tf_crc32(before, from, length);
}

void cli_trailer_add(cli_trailer_t *trailer, const char *lines, size_t length,
                     uint64_t rows) {
  trailer->crc = cli_crc(trailer->crc, lines, length);
  trailer->rows += rows;
}

size_t cli_trailer_line(const cli_trailer_t *trailer, const cli_shard_t *shard,
                        char out[CLI_TRAILER_ROOM]) {
  return (size_t)snprintf(
      out, CLI_TRAILER_ROOM,
      CLI_TRAILER_MARK "%" PRIu64 "/%" PRIu64 ": %" PRIu64
                       " rows, crc32 %08" PRIx32 ", run %08" PRIx32 "\n",
      shard->index, shard->of, trailer->rows, trailer->crc, trailer->run);
}
