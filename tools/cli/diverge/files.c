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

static const char *path_of(const cli_args_t *args, int i) {
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

static int open_file(cli_diverge_file_t *file, const char *option,
                     const char *path, const cli_file_place_t *at) {
  if (path == NULL) {
    return CLI_DONE;
  }
  const int code = cli_output_begin(&file->output, option, path, true);
  file->is_open = code == CLI_DONE;
  if (file->is_open && file->output.to.beside) {
    (void)cli_output_go_on(&file->output, (size_t)at->bytes);
  }
  file->bytes = at->bytes;
  file->trailer.rows = at->rows;
  file->trailer.crc = at->crc;
  return code;
}

// What stands before the first row: the comments of --provenance, which the
// trailer does not count, and the header.
static void begin(cli_diverge_file_t *file, const cli_job_t *job,
                  const char *units, const char *header) {
  const cli_args_t *args = job->args;
  if (file->bytes != 0 || !file->is_open ||
      !(args->header || args->shard.index == 1)) {
    return;
  }
  if (args->provenance) {
    char lines[CLI_PROVENANCE_ROOM];
    file->bytes = cli_job_provenance(job, units, lines);
    (void)cli_output_lines(&file->output, lines, (size_t)file->bytes);
  }
  (void)put(file, header, strlen(header), 0);
}

int cli_files_open(cli_files_t *files, const cli_job_t *job,
                   const cli_buffer_t *run,
                   const cli_file_place_t at[CLI_FILES]) {
  int code = CLI_DONE;
  files->shard = job->args->shard;
  for (int i = 0; i < CLI_FILES && code == CLI_DONE; i++) {
    cli_trailer_name(&files->file[i].trailer, run->text, run->used);
    code = open_file(&files->file[i], kinds[i].option, path_of(job->args, i),
                     &at[i]);
  }
  if (code != CLI_DONE) {
    return cli_files_close(files, code);
  }
  for (int i = 0; i < CLI_FILES; i++) {
    begin(&files->file[i], job, kinds[i].units, kinds[i].header);
  }
  return CLI_DONE;
}

bool cli_files_put(cli_files_t *files, uint64_t sample, uint64_t cycle,
                   const cli_cycle_t *what) {
  char text[ROW_ROOM];
  const size_t exits = exit_row(text, sample, cycle, what);
  const bool written = put(&files->file[CLI_EXITS], text, exits, exits > 0);
  const size_t returns = return_row(text, sample, cycle, what);
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

static void finish(const cli_files_t *files, cli_diverge_file_t *file) {
  char text[CLI_TRAILER_ROOM];
  const size_t length = cli_trailer_line(&file->trailer, &files->shard, text);
  if (file->is_open) {
    (void)cli_output_lines(&file->output, text, length);
  }
}

int cli_files_close(cli_files_t *files, int code) {
  for (int i = 0; i < CLI_FILES && code == CLI_DONE; i++) {
    finish(files, &files->file[i]);
  }
  // Neither gets its name where the other's rows could not be written; the
  // message is that of cli_output_end.
  code = cli_files_flush(files) ? code : CLI_STOPPED;
  for (int i = 0; i < CLI_FILES; i++) {
    cli_diverge_file_t *file = &files->file[i];
    code = file->is_open ? cli_output_end(&file->output, code) : code;
    file->is_open = false;
  }
  return code;
}

// A sample is the least that can be done again: its cycles follow from one
// another. Rows are kept up to the end of the last sample of the checkpoint,
// whose bytes and checksum it knows; counts are in it. It is written under
// another name and renamed, so that it is whole or the one before; rows are
// handed to the system first, so there are never fewer than it says. Where a
// machine lost power and there are, or they were changed, the shard begins
// anew.

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

bool cli_checkpoint_put(const cli_args_t *args, const cli_files_t *files,
                        cli_checkpoint_t *at, const cli_counts_t *counts) {
  for (int i = 0; i < CLI_FILES; i++) {
    const cli_diverge_file_t *file = &files->file[i];
    at->at[i] =
        (cli_file_place_t){file->bytes, file->trailer.rows, file->trailer.crc};
  }
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
  for (int i = 0; i < CLI_FILES; i++) {
    if (!holds(path_of(args, i), &at->at[i])) {
      return CLI_RESUME_NEW;
    }
  }
  return CLI_RESUME_GO_ON;
}
