// A file is text, so that any tool reads it, and depends on the cycles alone:
// not on the order in which shards were merged, nor on how often a merged file
// was merged again. Bins are half open, [i w, (i + 1) w).

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../text/message.h"
#include "../text/number.h"
#include "../text/trailer.h"
#include "files.h"

#define LINE 256
#define HEADER "what,key,count"

// The keys of a kind are its numbers from `low` on, or names.
typedef struct {
  const char *what;
  size_t first, size;
  long low;
  const char *(*name)(size_t i);
} kind_t;

static const char *outcome_at(size_t i) {
  return cli_outcome_name((cli_outcome_t)i);
}

static const char *side_at(size_t i) { return i > 0 ? "slip+" : "slip-"; }

static const kind_t kinds[] = {
    {"outcome", CLI_COUNT_OUTCOME, CLI_OUTCOMES, 0, outcome_at},
    {"begun", CLI_COUNT_BEGUN, CLI_COUNT_CYCLES, 1, NULL},
    {"returned", CLI_COUNT_RETURNED, CLI_COUNT_CYCLES, 1, NULL},
    {"side", CLI_COUNT_SIDE, 2, 0, side_at},
    {"phase", CLI_COUNT_PHASE, CLI_COUNT_PHASES, 0, NULL},
    {"time", CLI_COUNT_TIME, CLI_COUNT_TIMES, 0, NULL},
    {"landing", CLI_COUNT_LANDING, 2 * CLI_COUNT_PLACES + 1, -CLI_COUNT_PLACES,
     NULL}};
#define KINDS (sizeof kinds / sizeof kinds[0])

bool cli_counts_shard(cli_counts_t *counts, uint64_t index) {
  uint8_t *byte = &counts->has[(index - 1) / 8];
  const uint8_t bit = (uint8_t)(1u << ((index - 1) % 8));
  const bool is_new = (*byte & bit) == 0;
  *byte |= bit;
  return is_new;
}

static bool has_shard(const cli_counts_t *counts, uint64_t index) {
  return (counts->has[(index - 1) / 8] >> ((index - 1) % 8) & 1) != 0;
}

uint64_t cli_counts_shards(const cli_counts_t *counts) {
  uint64_t found = 0;
  for (uint64_t i = 1; i <= counts->of; i++) {
    found += has_shard(counts, i);
  }
  return found;
}

// What lies beyond the last bin is in it: bins lose nothing.
static size_t bin_of(double value, double width, long low, size_t size) {
  const double bin = floor(value / width) - (double)low;
  const double last = (double)(size - 1);
  return bin > 0 ? (size_t)(bin < last ? bin : last) : 0;
}

void cli_counts_cycle(cli_counts_t *counts, uint64_t cycle,
                      const cli_cycle_t *what, double patience) {
  uint64_t *cell = counts->cell;
  const bool returned = what->outcome == CLI_CYCLE_RETURNED;
  cell[CLI_COUNT_OUTCOME + (size_t)what->outcome]++;
  cell[CLI_COUNT_BEGUN + cycle - 1]++;
  cell[CLI_COUNT_RETURNED + cycle - 1] += returned;
  if (what->left) {
    cell[CLI_COUNT_SIDE + (what->side > 0)]++;
  }
  if (what->left && what->phase >= 0) {
    cell[CLI_COUNT_PHASE +
         bin_of(what->phase, 1.0 / CLI_COUNT_PHASES, 0, CLI_COUNT_PHASES)]++;
  }
  if (returned) {
    const double time =
        what->ended - (what->left ? what->exit_t : what->arrived);
    cell[CLI_COUNT_TIME +
         bin_of(time, patience / CLI_COUNT_TIMES, 0, CLI_COUNT_TIMES)]++;
  }
  if (what->landed) {
    cell[CLI_COUNT_LANDING + bin_of(what->land_r, CLI_COUNT_PLACE,
                                    -CLI_COUNT_PLACES,
                                    2 * CLI_COUNT_PLACES + 1)]++;
  }
}

static void put(cli_output_t *output, cli_trailer_t *trailer, const char *line,
                int length, uint64_t rows) {
  cli_trailer_add(trailer, line, (size_t)length, rows);
  (void)cli_output_lines(output, line, (size_t)length);
}

// Which shards are counted, a line for neighbours. All of them together are the
// one shard of the whole run.
static void put_shards(const cli_counts_t *counts, cli_output_t *output,
                       cli_trailer_t *trailer) {
  static const char whole[] = "# shards 1 to 1 of 1\n";
  char line[LINE];
  if (cli_counts_shards(counts) == counts->of) {
    put(output, trailer, whole, (int)sizeof whole - 1, 0);
    return;
  }
  for (uint64_t i = 1; i <= counts->of; i++) {
    const uint64_t first = i;
    while (i <= counts->of && has_shard(counts, i)) {
      i++;
    }
    if (i > first) {
      put(output, trailer, line,
          snprintf(line, sizeof line,
                   "# shards %" PRIu64 " to %" PRIu64 " of %" PRIu64 "\n",
                   first, i - 1, counts->of),
          0);
    }
  }
}

bool cli_counts_put(const cli_counts_t *counts, cli_output_t *output) {
  cli_trailer_t trailer = {0, 0, counts->run};
  char line[LINE];
  put(output, &trailer, counts->about, (int)strlen(counts->about), 0);
  put_shards(counts, output, &trailer);
  put(output, &trailer, HEADER "\n", (int)sizeof HEADER, 0);
  for (size_t k = 0; k < KINDS; k++) {
    const kind_t *kind = &kinds[k];
    for (size_t i = 0; i < kind->size; i++) {
      const uint64_t count = counts->cell[kind->first + i];
      char key[32];
      if (count == 0) {
        continue;
      }
      (void)snprintf(key, sizeof key, "%ld", kind->low + (long)i);
      put(output, &trailer, line,
          snprintf(line, sizeof line, "%s,%s,%" PRIu64 "\n", kind->what,
                   kind->name != NULL ? kind->name(i) : key, count),
          1);
    }
  }
  return cli_output_lines(
      output, line,
      (size_t)snprintf(line, sizeof line,
                       "# counts: %" PRIu64 " rows, crc32 %08" PRIx32
                       ", run %08" PRIx32 "\n",
                       trailer.rows, trailer.crc, trailer.run));
}

// The cell of a key, or NULL.
static uint64_t *cell_of(cli_counts_t *counts, const char *what,
                         const char *key) {
  for (size_t k = 0; k < KINDS; k++) {
    const kind_t *kind = &kinds[k];
    char *end = NULL;
    const long number = strtol(key, &end, 10) - kind->low;
    if (strcmp(what, kind->what) != 0) {
      continue;
    }
    if (kind->name == NULL && end != key && *end == '\0' && number >= 0 &&
        number < (long)kind->size) {
      return &counts->cell[kind->first + (size_t)number];
    }
    for (size_t i = 0; kind->name != NULL && i < kind->size; i++) {
      if (strcmp(key, kind->name(i)) == 0) {
        return &counts->cell[kind->first + i];
      }
    }
  }
  return NULL;
}

// A row `what,key,count`. Returns: whether it is one, of a cell without a count
// so far.
static bool read_row(cli_counts_t *counts, char *line) {
  char *key = strchr(line, ',');
  char *count = key != NULL ? strchr(key + 1, ',') : NULL;
  if (count == NULL) {
    return false;
  }
  *key++ = '\0';
  *count++ = '\0';
  uint64_t *cell = cell_of(counts, line, key);
  return cell != NULL && *cell == 0 &&
         cli_read_whole(count, 1, UINT64_MAX, cell);
}

// `# shards A to B of N`. Returns: whether it is such a line, and right.
static bool read_shards(cli_counts_t *counts, const char *line) {
  uint64_t first = 0, last = 0, of = 0;
  char again[LINE];
  if (sscanf(line, "# shards %" SCNu64 " to %" SCNu64 " of %" SCNu64, &first,
             &last, &of) != 3 ||
      of > CLI_COUNT_SHARDS || first < 1 || last < first || last > of ||
      (counts->of != 0 && counts->of != of)) {
    return false;
  }
  (void)snprintf(again, sizeof again,
                 "# shards %" PRIu64 " to %" PRIu64 " of %" PRIu64, first, last,
                 of);
  counts->of = of;
  bool is_new = strcmp(again, line) == 0;
  for (uint64_t i = first; i <= last; i++) {
    is_new = cli_counts_shard(counts, i) && is_new;
  }
  return is_new;
}

// What has been read of a file.
typedef struct {
  cli_trailer_t trailer;
  bool in_rows, at_end;
} reader_t;

// The last line, which says what the others should have been.
static bool read_end(cli_counts_t *counts, reader_t *reader, const char *line) {
  char again[LINE];
  uint32_t run = 0;
  const char *at = strstr(line, ", run ");
  reader->at_end = true;
  if (at == NULL || sscanf(at, ", run %8" SCNx32, &run) != 1) {
    return false;
  }
  counts->run = run;
  (void)snprintf(again, sizeof again,
                 "# counts: %" PRIu64 " rows, crc32 %08" PRIx32
                 ", run %08" PRIx32,
                 reader->trailer.rows, reader->trailer.crc, run);
  return strcmp(again, line) == 0;
}

// One line, without its newline.
static bool take_line(cli_counts_t *counts, reader_t *reader, char *line) {
  const size_t length = strlen(line), used = strlen(counts->about);
  if (reader->at_end) {
    return false;
  }
  if (strncmp(line, "# counts:", 9) == 0) {
    return reader->in_rows && counts->of > 0 && read_end(counts, reader, line);
  }
  const bool is_row = reader->in_rows;
  cli_trailer_add(&reader->trailer, line, length, is_row);
  cli_trailer_add(&reader->trailer, "\n", 1, 0);
  if (is_row) {
    return read_row(counts, line);
  }
  if (strncmp(line, "# shards ", 9) == 0) {
    return read_shards(counts, line);
  }
  if (line[0] == '#' && used + length + 2 <= sizeof counts->about) {
    memcpy(counts->about + used, line, length);
    memcpy(counts->about + used + length, "\n", 2);
    return true;
  }
  reader->in_rows = strcmp(line, HEADER) == 0;
  return reader->in_rows;
}

int cli_counts_read(cli_counts_t *counts, const char *name) {
  char line[CLI_COUNT_ABOUT];
  unsigned long number = 0;
  reader_t reader = {{0, 0, 0}, false, false};
  FILE *file = fopen(name, "r");
  if (file == NULL) {
    return cli_message(CLI_USAGE, "%s: cannot be read", name);
  }
  bool right = true;
  while (right && fgets(line, sizeof line, file) != NULL) {
    char *end = strchr(line, '\n');
    number++;
    right = end != NULL;
    if (right) {
      *end = '\0';
      right = take_line(counts, &reader, line);
    }
  }
  (void)fclose(file);
  if (!right) {
    return cli_message(CLI_USAGE,
                       "%s:%lu: no line of counts, or they were changed", name,
                       number);
  }
  return reader.at_end ? CLI_DONE
                       : cli_message(CLI_USAGE, "%s: cut off after line %lu",
                                     name, number);
}

// Adds the counts of other shards of the same run, read from a file `name`.
static int add_counts(cli_counts_t *counts, const cli_counts_t *more,
                      const char *name) {
  if (counts->run != more->run || strcmp(counts->about, more->about) != 0) {
    return cli_message(CLI_REFUSED, "%s: of another run than the first file",
                       name);
  }
  if (counts->of != more->of) {
    return cli_message(CLI_REFUSED,
                       "%s: of the same run, cut into %" PRIu64
                       " shards and not %" PRIu64 "; a merged run is whole, 1",
                       name, more->of, counts->of);
  }
  for (uint64_t i = 1; i <= more->of; i++) {
    if (has_shard(more, i) && !cli_counts_shard(counts, i)) {
      return cli_message(CLI_REFUSED,
                         "%s: shard %" PRIu64 " is in another file, too", name,
                         i);
    }
  }
  for (size_t i = 0; i < CLI_COUNT_CELLS; i++) {
    if (more->cell[i] > UINT64_MAX - counts->cell[i]) {
      return cli_message(CLI_REFUSED, "%s: a count passes 2^64", name);
    }
    counts->cell[i] += more->cell[i];
  }
  return CLI_DONE;
}

// The command `merge`. What is missing of the run is told, and not an error: a
// merged file can be merged again.
typedef struct {
  cli_counts_t sum, next;
  cli_output_t output;
} merge_t;

static int read_all(const cli_args_t *args, merge_t *merge) {
  int code = cli_counts_read(&merge->sum, args->files[0]);
  for (size_t i = 1; i < args->count && code == CLI_DONE; i++) {
    memset(&merge->next, 0, sizeof merge->next);
    code = cli_counts_read(&merge->next, args->files[i]);
    if (code == CLI_DONE) {
      code = add_counts(&merge->sum, &merge->next, args->files[i]);
    }
  }
  return code;
}

int cli_merge(const cli_args_t *args) {
  static merge_t merge;
  int code = read_all(args, &merge);
  if (code == CLI_DONE) {
    code = cli_output_begin(&merge.output, "--out", args->out, false);
  }
  if (code == CLI_DONE) {
    (void)cli_counts_put(&merge.sum, &merge.output);
    code = cli_output_end(&merge.output, code);
  }
  if (code == CLI_DONE) {
    (void)fprintf(stderr, "shards     %" PRIu64 " of %" PRIu64 "\n",
                  cli_counts_shards(&merge.sum), merge.sum.of);
  }
  return code;
}

int cli_merge_check(cli_args_t *args) {
  return args->count > 0
             ? CLI_DONE
             : cli_message(CLI_USAGE,
                           "merge: which files? ('twofold diverge --counts' "
                           "writes them)");
}
