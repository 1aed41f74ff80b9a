// The two files are opened together, after everything that could be refused has
// been checked, and get their names together: of a run that was stopped neither
// passes for a whole one. Each ends with a trailer, by which the readers find
// out that one of several shards is missing or cut off.

#include "files.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "../text/buffer.h"
#include "../text/message.h"

#define ROW_ROOM 512

// A field of something that did not happen is empty; no number stands for
// "none".
static cli_buffer_t empty(char out[ROW_ROOM]) {
  out[0] = '\0';
  return (cli_buffer_t){out, 0, ROW_ROOM, false};
}

// A comma, and the number if there is one.
static void add_field(cli_buffer_t *text, bool exists, double value) {
  cli_add(text, ",");
  if (exists) {
    cli_add_real(text, (tf_real_t)value);
  }
}

static const struct {
  const char *option, *units, *header;
} kinds[CLI_FILES] = {
    {"--exits", "time s, r m, omega rad/s, g m/s, phase 1, section_time s",
     "sample,cycle,time,r,omega,g,side,phase,how,section_time\n"},
    {"--returns", "time s, arrived s, exit_r m, landing_time s, landing_r m",
     "sample,cycle,outcome,time,arrived,exit_r,landing_time,landing_r,landings,"
     "windings\n"}};

static const char *path_of(const cli_files_t *files, int i) {
  const cli_args_t *args = files->job->args;
  return i == CLI_EXITS ? args->exits : args->returns;
}

// Rows of one cycle. Returns: the length, 0 for a cycle without an exit.
static size_t exit_row(char out[ROW_ROOM], uint64_t sample, uint64_t cycle,
                       const cli_cycle_t *what) {
  cli_buffer_t text = empty(out);
  if (!what->left) {
    return 0;
  }
  cli_add_form(&text, "%" PRIu64 ",%" PRIu64 ",%g,%g,%g,%g,%s", sample, cycle,
               what->exit_t - what->arrived, what->exit_r, what->exit_omega,
               what->exit_g, what->side < 0 ? "slip-" : "slip+");
  add_field(&text, what->phase >= 0, what->phase);
  cli_add(&text, what->released ? ",released" : ",left");
  add_field(&text, what->phase >= 0, what->section_t - what->arrived);
  cli_add(&text, "\n");
  return text.used;
}

static size_t return_row(char out[ROW_ROOM], uint64_t sample, uint64_t cycle,
                         const cli_cycle_t *what) {
  cli_buffer_t text = empty(out);
  cli_add_form(&text, "%" PRIu64 ",%" PRIu64 ",%s,%g,%g", sample, cycle,
               cli_outcome_name(what->outcome),
               what->ended - (what->left ? what->exit_t : what->arrived),
               what->arrived);
  add_field(&text, what->left, what->exit_r);
  add_field(&text, what->landed, what->land_t - what->exit_t);
  add_field(&text, what->landed, what->land_r);
  cli_add_form(&text, ",%" PRIu64 ",%" PRIu64 "\n", what->landings,
               what->windings);
  return text.used;
}

static bool put(cli_diverge_file_t *file, const char *text, size_t length,
                uint64_t rows) {
  if (!file->is_open) {
    return true;
  }
  cli_trailer_add(&file->trailer, text, length, rows);
  file->bytes += length;
  return cli_output_lines(&file->output, text, length);
}

static int open_file(cli_files_t *files, int i, const cli_file_place_t *at) {
  cli_diverge_file_t *file = &files->file[i];
  const char *path = path_of(files, i);
  file->trailer = (cli_trailer_t){at->rows, at->crc, files->run};
  file->about = at->about;
  file->bytes = at->bytes;
  if (path == NULL || file->is_whole) {
    return CLI_DONE;
  }
  CLI_TRY(cli_output_begin(&file->output, kinds[i].option, path, true));
  file->is_open = true;
  cli_output_go_on(&file->output, (size_t)at->bytes);
  return CLI_DONE;
}

// What stands before the first row: the comments of --provenance, which the
// trailer does not count, and the header.
static void begin(cli_files_t *files, int i) {
  const cli_args_t *args = files->job->args;
  cli_diverge_file_t *file = &files->file[i];
  if (file->bytes != 0 || !file->is_open ||
      !(args->header || args->shard.index == 1)) {
    return;
  }
  if (args->provenance) {
    char lines[CLI_PROVENANCE_ROOM];
    file->bytes = cli_job_provenance(files->job, kinds[i].units, lines);
    file->about = cli_crc(0, lines, (size_t)file->bytes);
    (void)cli_output_lines(&file->output, lines, (size_t)file->bytes);
  }
  (void)put(file, kinds[i].header, strlen(kinds[i].header), 0);
}

// What the counts of all shards are of, and which shard this one is.
static int begin_counts(cli_files_t *files) {
  const cli_args_t *args = files->job->args;
  cli_counts_t *counts = &files->counts;
  if (args->counts == NULL) {
    return CLI_DONE;
  }
  const size_t used = cli_job_provenance(
      files->job, "time s, landing m, phase windings", counts->about);
  (void)snprintf(counts->about + used, sizeof counts->about - used,
                 "# %" PRIu64 " samples of %" PRIu64
                 " cycles; bins: time %.17g s, phase %g, landing %g m\n",
                 args->samples, args->cycles, args->patience / CLI_COUNT_TIMES,
                 1.0 / CLI_COUNT_PHASES, CLI_COUNT_PLACE);
  counts->run = files->run;
  counts->of = args->shard.of;
  (void)cli_counts_shard(counts, args->shard.index);
  CLI_TRY(cli_output_begin(&files->counted, "--counts", args->counts, false));
  files->counts_are_open = true;
  return CLI_DONE;
}

int cli_files_open(cli_files_t *files, const cli_file_place_t at[CLI_FILES]) {
  int code = CLI_DONE;
  for (int i = 0; i < CLI_FILES && code == CLI_DONE; i++) {
    code = open_file(files, i, &at[i]);
  }
  for (int i = 0; i < CLI_FILES && code == CLI_DONE; i++) {
    begin(files, i);
  }
  code = code == CLI_DONE ? begin_counts(files) : code;
  return code == CLI_DONE ? code : cli_files_close(files, code);
}

bool cli_files_put(cli_files_t *files, uint64_t sample, uint64_t cycle,
                   const cli_cycle_t *what) {
  char text[ROW_ROOM];
  const size_t exits = exit_row(text, sample, cycle, what);
  const bool written = put(&files->file[CLI_EXITS], text, exits, exits > 0);
  const size_t returns = return_row(text, sample, cycle, what);
  if (files->counts_are_open) {
    cli_counts_cycle(&files->counts, cycle, what, files->job->args->patience);
  }
  return put(&files->file[CLI_RETURNS], text, returns, 1) && written;
}

bool cli_files_flush(cli_files_t *files) {
  bool written = true;
  for (int i = 0; i < CLI_FILES; i++) {
    cli_diverge_file_t *file = &files->file[i];
    written = (!file->is_open || cli_output_flush(&file->output)) && written;
  }
  return written;
}

int cli_files_close(cli_files_t *files, int code) {
  for (int i = 0; i < CLI_FILES && code == CLI_DONE; i++) {
    cli_diverge_file_t *file = &files->file[i];
    if (file->is_open) {
      cli_output_trailer(&file->output, &file->trailer,
                         &files->job->args->shard);
    }
  }
  // None gets its name where the other's rows could not be written; the
  // message is that of cli_output_end.
  code = cli_files_flush(files) ? code : CLI_STOPPED;
  for (int i = 0; i < CLI_FILES; i++) {
    cli_diverge_file_t *file = &files->file[i];
    code = file->is_open ? cli_output_end(&file->output, code) : code;
    file->is_open = false;
  }
  if (files->counts_are_open && code == CLI_DONE) {
    (void)cli_counts_put(&files->counts, &files->counted);
  }
  return files->counts_are_open ? cli_output_end(&files->counted, code) : code;
}

// A sample is the least that can be done again: its cycles follow from one
// another. Rows are kept up to the end of the last sample of the checkpoint,
// whose bytes and checksums it knows; counts are in it. It is a file like any
// other, so it is whole or the one before; rows are handed to the system first,
// so there are never fewer than it says. Where a machine lost power and there
// are, or they were changed, the shard begins anew. A file that already has its
// name, because the program was killed before the next one got its own, stays.

#define LINE 4096

static void name_of(const cli_files_t *files, char out[CLI_PATH_ROOM]) {
  const cli_args_t *args = files->job->args;
  const char *rows = args->returns != NULL ? args->returns : args->exits;
  (void)snprintf(out, CLI_PATH_ROOM, "%s.resume",
                 args->counts != NULL ? args->counts : rows);
}

// Bytes of the counts in a checkpoint.
static size_t counted_bytes(const cli_files_t *files) {
  return files->job->args->counts != NULL ? sizeof files->counts.cell : 0;
}

static uint32_t crc_of(const cli_files_t *files, const cli_checkpoint_t *at) {
  return cli_crc(cli_crc(0, at, sizeof *at), files->counts.cell,
                 counted_bytes(files));
}

bool cli_checkpoint_put(const cli_files_t *files, cli_checkpoint_t *at) {
  static cli_output_t note;
  for (int i = 0; i < CLI_FILES; i++) {
    const cli_diverge_file_t *file = &files->file[i];
    at->at[i] = (cli_file_place_t){file->bytes, file->trailer.rows,
                                   file->trailer.crc, file->about};
  }
  char path[CLI_PATH_ROOM];
  name_of(files, path);
  const uint32_t crc = crc_of(files, at);
  if (cli_output_begin(&note, "--resume", path, false) != CLI_DONE) {
    return false;
  }
  (void)cli_output_lines(&note, at, sizeof *at);
  (void)cli_output_lines(&note, files->counts.cell, counted_bytes(files));
  (void)cli_output_lines(&note, &crc, sizeof crc);
  return cli_output_end(&note, CLI_DONE) == CLI_DONE;
}

void cli_checkpoint_remove(const cli_files_t *files) {
  char path[CLI_PATH_ROOM], part[CLI_PATH_ROOM + 5];
  name_of(files, path);
  (void)snprintf(part, sizeof part, "%s.part", path);
  (void)remove(path);
  (void)remove(part); // of a program that was killed
}

// Returns: whether there is one that was not changed.
static bool get(cli_files_t *files, cli_checkpoint_t *at) {
  char path[CLI_PATH_ROOM];
  uint32_t crc = 0;
  const size_t counted = counted_bytes(files);
  name_of(files, path);
  FILE *file = fopen(path, "rb");
  if (file == NULL) {
    return false;
  }
  const bool read = fread(at, sizeof *at, 1, file) == 1 &&
                    fread(files->counts.cell, 1, counted, file) == counted &&
                    fread(&crc, sizeof crc, 1, file) == 1 &&
                    fgetc(file) == EOF && crc == crc_of(files, at);
  (void)fclose(file);
  return read;
}

// Sums the lines of a file up to so many bytes and closes it: those that a
// trailer counts, and comments. last: out, the last line. Returns: the bytes
// that were read.
static uint64_t sum_lines(FILE *file, uint64_t end, cli_trailer_t *sum,
                          uint32_t *about, char last[LINE]) {
  uint64_t bytes = 0;
  bool comment = false, begins = true;
  last[0] = '\0';
  while (bytes < end && fgets(last, LINE, file) != NULL) {
    const size_t length = strlen(last);
    comment = begins ? last[0] == '#' : comment;
    begins = length > 0 && last[length - 1] == '\n';
    bytes += length;
    if (length == 0) {
      break;
    }
    if (comment) {
      *about = cli_crc(*about, last, length);
    } else {
      cli_trailer_add(sum, last, length, strncmp(last, "sample,", 7) != 0);
    }
  }
  (void)fclose(file);
  return bytes;
}

// Whether a part begins with the rows that a checkpoint says, or is whole.
static bool holds(const cli_files_t *files, int i,
                  const cli_file_place_t *place) {
  const char *path = path_of(files, i);
  char part[CLI_PATH_ROOM], line[LINE];
  cli_trailer_t sum = {0, 0, 0};
  uint32_t about = 0;
  if (path == NULL || files->file[i].is_whole) {
    return true;
  }
  (void)snprintf(part, sizeof part, "%s.part", path);
  FILE *file = fopen(part, "r");
  if (file == NULL) {
    return false;
  }
  return sum_lines(file, place->bytes, &sum, &about, line) == place->bytes &&
         sum.crc == place->crc && about == place->about;
}

static cli_resume_t other(const char *path) {
  (void)cli_output_refuse_other(path, "run");
  return CLI_RESUME_OTHER;
}

// NULL where there is none. What is not a regular file keeps no rows, and
// opening it could wait for a writer.
static FILE *open_regular(const char *path) {
  struct stat status;
  const bool regular =
      path != NULL && stat(path, &status) == 0 && S_ISREG(status.st_mode);
  return regular ? fopen(path, "r") : NULL;
}

// A file of rows: not there, whole, or another one. Its last line has to be the
// trailer of this shard, and count what is before it.
static cli_resume_t look_at_rows(const char *path, const cli_checkpoint_t *at) {
  char line[LINE], last[CLI_TRAILER_ROOM];
  cli_trailer_t sum = {0, 0, at->run};
  uint32_t about = 0;
  FILE *file = open_regular(path);
  if (file == NULL) {
    return path == NULL ? CLI_RESUME_WHOLE : CLI_RESUME_NEW;
  }
  (void)sum_lines(file, UINT64_MAX, &sum, &about, line);
  (void)cli_trailer_line(&sum, &at->shard, last);
  return strcmp(line, last) == 0 ? CLI_RESUME_WHOLE : other(path);
}

static cli_resume_t look_at_counts(const char *path, const cli_checkpoint_t *at,
                                   cli_counts_t *counts) {
  FILE *file = open_regular(path);
  if (file == NULL) {
    return path == NULL ? CLI_RESUME_WHOLE : CLI_RESUME_NEW;
  }
  (void)fclose(file);
  if (cli_counts_read(counts, path) != CLI_DONE) {
    return CLI_RESUME_OTHER;
  }
  const bool same = counts->run == at->run && counts->of == at->shard.of &&
                    cli_counts_shards(counts) == 1 &&
                    !cli_counts_shard(counts, at->shard.index);
  memset(counts, 0, sizeof *counts);
  return same ? CLI_RESUME_WHOLE : other(path);
}

// Whether a checkpoint is there, and the rows that it says. fresh: in, what it
// has to be of.
static cli_resume_t look_at_checkpoint(cli_files_t *files,
                                       const cli_checkpoint_t *fresh,
                                       cli_checkpoint_t *at) {
  if (!get(files, at)) {
    return CLI_RESUME_NEW;
  }
  if (at->run != fresh->run || at->build != fresh->build ||
      at->shard.index != fresh->shard.index ||
      at->shard.of != fresh->shard.of) {
    char path[CLI_PATH_ROOM];
    name_of(files, path);
    return other(path);
  }
  bool held = true;
  for (int i = 0; i < CLI_FILES; i++) {
    held = held && holds(files, i, &at->at[i]);
  }
  return held ? CLI_RESUME_GO_ON : CLI_RESUME_NEW;
}

cli_resume_t cli_checkpoint_find(cli_files_t *files, cli_checkpoint_t *at) {
  const cli_checkpoint_t fresh = *at;
  const cli_resume_t found[] = {
      look_at_rows(path_of(files, CLI_EXITS), at),
      look_at_rows(path_of(files, CLI_RETURNS), at),
      look_at_counts(files->job->args->counts, at, &files->counts)};
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
  for (int i = 0; i < CLI_FILES; i++) {
    files->file[i].is_whole = found[i] == CLI_RESUME_WHOLE;
  }
  const cli_resume_t state = look_at_checkpoint(files, &fresh, at);
  if (state == CLI_RESUME_NEW) {
    *at = fresh;
    memset(&files->counts, 0, sizeof files->counts);
    files->file[CLI_EXITS].is_whole = files->file[CLI_RETURNS].is_whole = false;
  }
  return state;
}
