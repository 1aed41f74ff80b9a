// A sample is the least that can be done again: its cycles follow from one
// another. Rows are kept up to the end of the last sample of the checkpoint,
// whose bytes and checksum it knows; counts are in it. It is written under
// another name and renamed, so that it is whole or the one before; rows are
// handed to the system first, so there are never fewer than it says. Where a
// machine lost power and there are, or they were changed, the shard begins
// anew.

#include "checkpoint.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "../text/message.h"

#define LINE 4096

static const char *file_of(const cli_args_t *args) {
  const char *rows = args->returns != NULL ? args->returns : args->exits;
  return args->counts != NULL ? args->counts : rows;
}

static void name_of(const cli_args_t *args, const char *end,
                    char out[CLI_PATH_ROOM]) {
  (void)snprintf(out, CLI_PATH_ROOM, "%s.resume%s", file_of(args), end);
}

static uint32_t crc_of(const cli_checkpoint_t *at, const cli_counts_t *counts) {
  cli_trailer_t sum = {0, 0, 0};
  cli_trailer_add(&sum, (const char *)at, sizeof *at, 0);
  if (counts != NULL) {
    cli_trailer_add(&sum, (const char *)counts->cell, sizeof counts->cell, 0);
  }
  return sum.crc;
}

bool cli_checkpoint_put(const cli_args_t *args, const cli_checkpoint_t *at,
                        const cli_counts_t *counts) {
  char beside[CLI_PATH_ROOM], path[CLI_PATH_ROOM];
  name_of(args, ".new", beside);
  name_of(args, "", path);
  const uint32_t crc = crc_of(at, counts);
  FILE *file = fopen(beside, "wb");
  if (file == NULL) {
    return false;
  }
  bool written = fwrite(at, sizeof *at, 1, file) == 1;
  if (counts != NULL) {
    written =
        fwrite(counts->cell, sizeof counts->cell, 1, file) == 1 && written;
  }
  written = fwrite(&crc, sizeof crc, 1, file) == 1 && written;
  written = fclose(file) == 0 && written;
  return written && rename(beside, path) == 0;
}

void cli_checkpoint_remove(const cli_args_t *args) {
  char path[CLI_PATH_ROOM];
  name_of(args, "", path);
  (void)remove(path);
}

// Returns: whether there is one that was not changed.
static bool get(const cli_args_t *args, cli_checkpoint_t *at,
                cli_counts_t *counts) {
  char path[CLI_PATH_ROOM];
  uint32_t crc = 0;
  name_of(args, "", path);
  FILE *file = fopen(path, "rb");
  if (file == NULL) {
    return false;
  }
  bool read = fread(at, sizeof *at, 1, file) == 1;
  if (read && counts != NULL) {
    read = fread(counts->cell, sizeof counts->cell, 1, file) == 1;
  }
  read = read && fread(&crc, sizeof crc, 1, file) == 1 && fgetc(file) == EOF &&
         crc == crc_of(at, counts);
  (void)fclose(file);
  return read;
}

// Whether a part begins with the rows that a checkpoint says.
static bool holds(const char *path, const cli_file_place_t *place) {
  char part[CLI_PATH_ROOM], line[LINE];
  cli_trailer_t sum = {0, 0, 0};
  uint64_t bytes = 0;
  bool comment = false, begins = true;
  if (path == NULL) {
    return true;
  }
  (void)snprintf(part, sizeof part, "%s.part", path);
  FILE *file = fopen(part, "r");
  if (file == NULL) {
    return false;
  }
  while (bytes < place->bytes && fgets(line, sizeof line, file) != NULL) {
    const size_t length = strlen(line);
    comment = begins ? line[0] == '#' : comment;
    begins = length > 0 && line[length - 1] == '\n';
    bytes += length;
    if (length == 0) {
      break;
    }
    if (!comment) {
      cli_trailer_add(&sum, line, length, 0);
    }
  }
  (void)fclose(file);
  return bytes == place->bytes && sum.crc == place->crc;
}

static cli_resume_t other(const char *path) {
  (void)cli_output_refuse_other(path, "run");
  return CLI_RESUME_OTHER;
}

// Whether the last line of a file is the trailer of this shard and counts what
// is before it.
static bool ends_whole(FILE *file, const cli_shard_t *shard, uint32_t run) {
  char line[LINE] = "", last[CLI_TRAILER_ROOM] = "";
  cli_trailer_t sum = {0, 0, run};
  while (fgets(line, sizeof line, file) != NULL) {
    if (line[0] != '#') {
      cli_trailer_add(&sum, line, strlen(line),
                      strncmp(line, "sample,", 7) != 0);
    }
  }
  (void)cli_trailer_line(&sum, shard, last);
  return strcmp(line, last) == 0;
}

// NULL where there is none. What is not a regular file keeps no rows, and
// opening it could wait for a writer.
static FILE *open_regular(const char *path) {
  struct stat status;
  const bool regular =
      path != NULL && stat(path, &status) == 0 && S_ISREG(status.st_mode);
  return regular ? fopen(path, "r") : NULL;
}

// A file of rows: not there, whole, or another one.
static cli_resume_t look_at_rows(const char *path, const cli_shard_t *shard,
                                 uint32_t run) {
  FILE *file = open_regular(path);
  if (file == NULL) {
    return path == NULL ? CLI_RESUME_WHOLE : CLI_RESUME_NEW;
  }
  const bool whole = ends_whole(file, shard, run);
  (void)fclose(file);
  return whole ? CLI_RESUME_WHOLE : other(path);
}

static cli_resume_t look_at_counts(const char *path, const cli_shard_t *shard,
                                   uint32_t run, cli_counts_t *counts) {
  FILE *file = open_regular(path);
  if (file == NULL) {
    return path == NULL ? CLI_RESUME_WHOLE : CLI_RESUME_NEW;
  }
  (void)fclose(file);
  memset(counts, 0, sizeof *counts);
  if (cli_counts_read(counts, path) != CLI_DONE) {
    return CLI_RESUME_OTHER;
  }
  const bool same = counts->run == run && counts->of == shard->of &&
                    cli_counts_shards(counts) == 1 &&
                    !cli_counts_shard(counts, shard->index);
  memset(counts, 0, sizeof *counts);
  return same ? CLI_RESUME_WHOLE : other(path);
}

cli_resume_t cli_checkpoint_find(const cli_args_t *args, uint32_t run,
                                 cli_checkpoint_t *at, cli_counts_t *counts) {
  const cli_shard_t *shard = &args->shard;
  const cli_resume_t found[] = {
      look_at_rows(args->exits, shard, run),
      look_at_rows(args->returns, shard, run),
      look_at_counts(args->counts, shard, run, counts)};
  int whole = 0;
  for (size_t i = 0; i < sizeof found / sizeof found[0]; i++) {
    if (found[i] == CLI_RESUME_OTHER) {
      return CLI_RESUME_OTHER;
    }
    whole += found[i] == CLI_RESUME_WHOLE;
  }
  if (whole == 3) {
    return CLI_RESUME_WHOLE;
  }
  if (!get(args, at, counts)) {
    return CLI_RESUME_NEW;
  }
  if (at->run != run || at->number != sizeof(tf_real_t) ||
      at->shard.index != shard->index || at->shard.of != shard->of) {
    char path[CLI_PATH_ROOM];
    name_of(args, "", path);
    return other(path);
  }
  return holds(args->exits, &at->exits) && holds(args->returns, &at->returns)
             ? CLI_RESUME_GO_ON
             : CLI_RESUME_NEW;
}
