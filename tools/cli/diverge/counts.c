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
#include "../text/summary.h"
#include "../text/trailer.h"
#include "files.h"

#define LINE 256
#define HEADER "what,key,count\n"

// The keys of a kind are its numbers from `low` on, or names. Its cells stand
// behind those of the kinds before it.
typedef struct {
  const char *what;
  long low, size;
  const char *(*name)(size_t i);
} kind_t;

static const char *outcome_at(size_t i) {
  return cli_outcome_name((cli_outcome_t)i);
}

static const char *side_at(size_t i) { return i > 0 ? "slip+" : "slip-"; }

enum { OUTCOME, BEGUN, RETURNED, SIDE, PHASE, TIME, LANDING, KINDS };
static const kind_t kinds[KINDS] = {
    [OUTCOME] = {"outcome", 0, CLI_OUTCOMES, outcome_at},
    [BEGUN] = {"begun", 1, CLI_COUNT_CYCLES, NULL},
    [RETURNED] = {"returned", 1, CLI_COUNT_CYCLES, NULL},
    [SIDE] = {"side", 0, 2, side_at},
    [PHASE] = {"phase", 0, CLI_COUNT_PHASES, NULL},
    [TIME] = {"time", 0, CLI_COUNT_TIMES, NULL},
    [LANDING] = {"landing", -CLI_COUNT_PLACES, 2 * CLI_COUNT_PLACES + 1, NULL}};

static const uint64_t *cells_of(const cli_counts_t *counts, int kind) {
  const uint64_t *cell = counts->cell;
  for (int i = 0; i < kind; i++) {
    cell += kinds[i].size;
  }
  return cell;
}

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
static void add_one(cli_counts_t *counts, int kind, double key) {
  const double bin = key - (double)kinds[kind].low;
  const double last = (double)(kinds[kind].size - 1);
  const size_t at = bin > 0 ? (size_t)(bin < last ? bin : last) : 0;
  counts->cell[(size_t)(cells_of(counts, kind) - counts->cell) + at]++;
}

void cli_counts_cycle(cli_counts_t *counts, uint64_t cycle,
                      const cli_cycle_t *what, double patience) {
  const bool returned = what->outcome == CLI_CYCLE_RETURNED;
  add_one(counts, OUTCOME, what->outcome);
  add_one(counts, BEGUN, (double)cycle);
  if (what->left) {
    add_one(counts, SIDE, what->side > 0);
  }
  if (what->left && what->phase >= 0) {
    add_one(counts, PHASE, floor(what->phase / (1.0 / CLI_COUNT_PHASES)));
  }
  if (returned) {
    const double time =
        what->ended - (what->left ? what->exit_t : what->arrived);
    add_one(counts, RETURNED, (double)cycle);
    add_one(counts, TIME, floor(time / (patience / CLI_COUNT_TIMES)));
  }
  if (what->landed) {
    add_one(counts, LANDING, floor(what->land_r / CLI_COUNT_PLACE));
  }
}

static void put(cli_output_t *output, cli_trailer_t *trailer, const char *line,
                uint64_t rows) {
  cli_trailer_add(trailer, line, strlen(line), rows);
  (void)cli_output_lines(output, line, strlen(line));
}

static void write_shards(uint64_t first, uint64_t last, uint64_t of,
                         char line[LINE]) {
  (void)snprintf(line, LINE,
                 "# shards %" PRIu64 " to %" PRIu64 " of %" PRIu64 "\n", first,
                 last, of);
}

static void write_end(const cli_trailer_t *trailer, char line[LINE]) {
  (void)snprintf(line, LINE,
                 "# counts: %" PRIu64 " rows, crc32 %08" PRIx32
                 ", run %08" PRIx32 "\n",
                 trailer->rows, trailer->crc, trailer->run);
}

// Which shards are counted, a line for neighbours. All of them together are the
// one shard of the whole run.
static void put_shards(const cli_counts_t *counts, cli_output_t *output,
                       cli_trailer_t *trailer) {
  char line[LINE];
  const bool whole = cli_counts_shards(counts) == counts->of;
  const uint64_t of = whole ? 1 : counts->of;
  for (uint64_t i = 1; i <= of; i++) {
    const uint64_t first = i;
    while (i <= of && has_shard(counts, i)) {
      i++;
    }
    if (i > first) {
      write_shards(first, i - 1, of, line);
      put(output, trailer, line, 0);
    }
  }
}

bool cli_counts_put(const cli_counts_t *counts, cli_output_t *output) {
  cli_trailer_t trailer = {0, 0, counts->run};
  char line[LINE];
  put(output, &trailer, counts->about, 0);
  put_shards(counts, output, &trailer);
  put(output, &trailer, HEADER, 0);
  for (int k = 0; k < KINDS; k++) {
    const kind_t *kind = &kinds[k];
    const uint64_t *cell = cells_of(counts, k);
    for (long i = 0; i < kind->size; i++) {
      char key[32];
      if (cell[i] == 0) {
        continue;
      }
      (void)snprintf(key, sizeof key, "%ld", kind->low + i);
      (void)snprintf(line, sizeof line, "%s,%s,%" PRIu64 "\n", kind->what,
                     kind->name != NULL ? kind->name((size_t)i) : key, cell[i]);
      put(output, &trailer, line, 1);
    }
  }
  write_end(&trailer, line);
  return cli_output_lines(output, line, strlen(line));
}

// The cell of a key, or NULL.
static uint64_t *cell_of(cli_counts_t *counts, const char *what,
                         const char *key) {
  uint64_t *cell = counts->cell;
  for (const kind_t *kind = kinds; kind < kinds + KINDS; kind++) {
    char *end = NULL;
    const long number = strtol(key, &end, 10) - kind->low;
    if (strcmp(what, kind->what) == 0 && kind->name == NULL) {
      const bool good = end != key && *end == '\0' && number >= 0;
      return good && number < kind->size ? cell + number : NULL;
    }
    for (long i = 0; strcmp(what, kind->what) == 0 && i < kind->size; i++) {
      if (strcmp(key, kind->name((size_t)i)) == 0) {
        return cell + i;
      }
    }
    cell += kind->size;
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
  write_shards(first, last, of, again);
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
  const char *at = strstr(line, ", run ");
  reader->at_end = true;
  if (at == NULL || sscanf(at, ", run %8" SCNx32, &reader->trailer.run) != 1) {
    return false;
  }
  counts->run = reader->trailer.run;
  write_end(&reader->trailer, again);
  return strcmp(again, line) == 0;
}

// One line, with its newline.
static bool take_line(cli_counts_t *counts, reader_t *reader, char *line) {
  const size_t length = strlen(line), used = strlen(counts->about);
  if (reader->at_end || line[length - 1] != '\n') {
    return false;
  }
  if (strncmp(line, "# counts:", 9) == 0) {
    return reader->in_rows && counts->of > 0 && read_end(counts, reader, line);
  }
  cli_trailer_add(&reader->trailer, line, length, reader->in_rows);
  if (reader->in_rows) {
    line[length - 1] = '\0';
    return read_row(counts, line);
  }
  if (strncmp(line, "# shards ", 9) == 0) {
    return read_shards(counts, line);
  }
  if (line[0] == '#' && used + length < sizeof counts->about) {
    memcpy(counts->about + used, line, length + 1);
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
  for (; right && fgets(line, sizeof line, file) != NULL; number++) {
    right = line[0] != '\0' && take_line(counts, &reader, line);
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
  CLI_TRY(cli_counts_read(&merge->sum, args->files[0]));
  for (size_t i = 1; i < args->count; i++) {
    memset(&merge->next, 0, sizeof merge->next);
    CLI_TRY(cli_counts_read(&merge->next, args->files[i]));
    CLI_TRY(add_counts(&merge->sum, &merge->next, args->files[i]));
  }
  return CLI_DONE;
}

int cli_merge(const cli_args_t *args) {
  static merge_t merge;
  CLI_TRY(read_all(args, &merge));
  CLI_TRY(cli_output_begin(&merge.output, "--out", args->out, false));
  (void)cli_counts_put(&merge.sum, &merge.output);
  CLI_TRY(cli_output_end(&merge.output, CLI_DONE));
  cli_say("shards     %" PRIu64 " of %" PRIu64 "\n",
          cli_counts_shards(&merge.sum), merge.sum.of);
  return CLI_DONE;
}

int cli_merge_check(cli_args_t *args) {
  return args->count > 0
             ? CLI_DONE
             : cli_message(CLI_USAGE,
                           "merge: which files? ('twofold diverge --counts' "
                           "writes them)");
}
