// Each shard is a run of neighbours, so that the rows of all shards, one file
// after the other, are those of the whole.

#include "shard.h"

#include <stdio.h>
#include <string.h>

#include "../../../src/link/parts.h"
#include "message.h"
#include "number.h"

#define MAX_SHARDS 1000000000000000u

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
