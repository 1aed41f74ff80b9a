// The file of a sweep. A row depends on the command and its own number alone,
// so a sweep that was stopped, even by SIGKILL, goes on with FILE.part and ends
// with the bytes of one that was not. That the part is of the same command, its
// second line says. Each time that rows are handed to the system, the trailer
// of a file that ends there stands behind them; rows behind the last one that
// is right are computed again. FILE has the last trailer alone.
//
// The comments stand behind the header, not before it: numpy.genfromtxt takes
// the names of columns from the first line even where it is a comment.

#define _POSIX_C_SOURCE 200809L

#include "sheet.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "../setup/setup.h"
#include "../text/message.h"

#define COLUMNS_BEFORE 4 // point, status, reason, t

static const char *unit_of(const char *name) {
  const size_t parameter = cli_parameter_index(name);
  if (parameter < TF_PARAMETERS) {
    return tf_parameter_ranges[parameter].unit;
  }
  const size_t start = cli_start_index(name);
  return start < CLI_STARTS ? cli_starts[start].unit : "1";
}

static void add_header(const cli_args_t *args, cli_buffer_t *text) {
  cli_add(text, "point");
  for (size_t i = 0; i < args->axes; i++) {
    cli_add_form(text, ",%s", args->axis[i].name);
  }
  cli_add(text, ",status,reason,t");
  for (size_t i = 0; i < args->measures; i++) {
    cli_add_form(text, ",%s", cli_measures[args->measure[i]].name);
  }
  cli_add(text, "\n");
}

// The command that makes the rows of all shards.
static void add_command(const cli_sheet_t *sheet, cli_buffer_t *text) {
  const cli_args_t *args = sheet->args;
  cli_add_form(text,
               "# twofold %s, commit %s, numbers are %s: sweep %s --scheme %s "
               "--t-end %g",
               TF_VERSION, cli_commit, CLI_NUMBER_TYPE, args->scene->name,
               sheet->scheme->name, (double)cli_end_of(args));
  if (args->select != NULL) {
    cli_add_form(text, " --select %s", args->select);
  }
  if (args->drive.inputs != NULL) {
    cli_add_form(text, " --inputs %s --between %s (", args->drive.inputs,
                 args->drive.between == 1 ? "linear" : "held");
    cli_add_hash(text, sheet->inputs);
    cli_add(text, ")");
  }
  for (size_t i = 0; i < args->settings.count; i++) {
    const cli_setting_t *setting = &args->settings.list[i];
    if (strcmp(setting->option, "--over") != 0) {
      cli_add_form(text, " %s %s", setting->option, setting->text);
    }
  }
  for (size_t i = 0; i < args->axes; i++) {
    cli_add_form(text, " --over %s", args->axis[i].range.text);
  }
  for (size_t i = 0; i < args->measures; i++) {
    cli_add_form(text, " --outcome %s", cli_measures[args->measure[i]].name);
  }
}

static void add_unit(cli_buffer_t *text, const char *name, const char *unit) {
  if (unit[0] != '\0') {
    cli_add_form(text, " %s %s,", name, unit);
  }
}

static void add_units(const cli_args_t *args, cli_buffer_t *text) {
  cli_add(text, "# units:");
  for (size_t i = 0; i < args->axes; i++) {
    add_unit(text, args->axis[i].name, unit_of(args->axis[i].name));
  }
  for (size_t i = 0; i < args->measures; i++) {
    const cli_measure_info_t *info = &cli_measures[args->measure[i]];
    add_unit(text, info->name, info->unit);
  }
  cli_add(text, " t s\n");
}

static bool make_prologue(cli_sheet_t *sheet, uint32_t hash) {
  cli_buffer_t text = {sheet->prologue, 0, CLI_PROLOGUE_ROOM, false};
  if (sheet->args->shard.index == 1) {
    add_header(sheet->args, &text);
  }
  sheet->header = text.used;
  add_command(sheet, &text);
  const size_t command = text.used;
  cli_add_form(&text, " --shard %" PRIu64 "/%" PRIu64, sheet->args->shard.index,
               sheet->args->shard.of);
  const size_t scene = text.used;
  cli_add(&text, " (scene ");
  cli_add_hash(&text, hash);
  cli_add(&text, ")\n");
  // The shards of a run have command and scene in common.
  sheet->trailer.run = cli_crc(
      cli_crc(0, sheet->prologue + sheet->header, command - sheet->header),
      sheet->prologue + scene, text.used - scene);
  add_units(sheet->args, &text);
  sheet->length = text.used;
  cli_trailer_add(&sheet->trailer, sheet->prologue, sheet->header, 0);
  return !text.truncated;
}

// Whether a line is the row of a point, as far as one can tell.
static bool is_row(const cli_args_t *args, uint64_t index, const char *line) {
  char name[CLI_SWEEP_ROW];
  cli_buffer_t text = {name, 0, sizeof name, false};
  size_t commas = 0;
  cli_point_name(args, index, &text);
  cli_add(&text, ",");
  for (const char *at = line; *at != '\0'; at++) {
    commas += *at == ',';
  }
  return strncmp(line, name, text.used) == 0 &&
         line[strlen(line) - 1] == '\n' &&
         commas + 1 == COLUMNS_BEFORE + args->axes + args->measures;
}

// Takes up what a file has, up to its last trailer that is right. kept: out,
// bytes of that. Returns: whether it begins as a file of this sweep does.
static bool take_up(cli_sheet_t *sheet, FILE *file, size_t *kept) {
  char line[CLI_PROLOGUE_ROOM];
  const cli_args_t *args = sheet->args;
  const size_t begun = fread(line, 1, sheet->length, file);
  if (memcmp(line, sheet->prologue, begun) != 0) {
    return false;
  }
  if (begun < sheet->length) {
    return true; // cut off before the first row
  }
  size_t used = begun, trailers = 0;
  cli_trailer_t sum = sheet->trailer;
  *kept = begun;
  while (fgets(line, sizeof line, file) != NULL) {
    char last[CLI_TRAILER_ROOM];
    const uint64_t index = sheet->first + sum.rows;
    used += strlen(line);
    (void)cli_trailer_line(&sum, &args->shard, last);
    if (strcmp(line, last) == 0) {
      sheet->trailer = sum;
      *kept = used;
      trailers++;
    } else if (index < sheet->end && is_row(args, index, line)) {
      cli_trailer_add(&sum, line, strlen(line), 1);
    } else {
      used = 0;
      break;
    }
  }
  sheet->kept = sheet->trailer.rows;
  sheet->whole = trailers == 1 && *kept == used &&
                 sheet->first + sheet->kept == sheet->end;
  return true;
}

// FILE, if it is there, is whole or of another sweep. What is not a regular
// file keeps no rows, and opening it could wait for a writer.
static int look_at_file(cli_sheet_t *sheet) {
  size_t kept = 0;
  struct stat status;
  if (stat(sheet->args->out, &status) == 0 && !S_ISREG(status.st_mode)) {
    return CLI_DONE;
  }
  FILE *file = fopen(sheet->args->out, "r");
  if (file == NULL) {
    return errno == ENOENT ? CLI_DONE
                           : cli_message(CLI_STOPPED, "--out %s: %s",
                                         sheet->args->out, strerror(errno));
  }
  const bool same = take_up(sheet, file, &kept);
  (void)fclose(file);
  return same && sheet->whole
             ? CLI_DONE
             : cli_output_refuse_other(sheet->args->out, "sweep");
}

// The part, which is open and locked, may have rows.
static int look_at_part(cli_sheet_t *sheet, size_t *kept) {
  const char *path = sheet->output.to.part;
  FILE *file = fopen(path, "r");
  if (file == NULL) {
    return cli_message(CLI_STOPPED, "%s: %s", path, strerror(errno));
  }
  const bool empty = fgetc(file) == EOF;
  rewind(file);
  const bool same = empty || !sheet->args->resume || take_up(sheet, file, kept);
  (void)fclose(file);
  if (!empty && !sheet->args->resume) {
    return cli_message(CLI_REFUSED,
                       "%s has rows of a sweep that was stopped: --resume goes "
                       "on with them, or remove it",
                       path);
  }
  return same ? CLI_DONE : cli_output_refuse_other(path, "sweep");
}

int cli_sheet_open(cli_sheet_t *sheet, const cli_sweep_t *sweep,
                   uint32_t hash) {
  const cli_args_t *args = sweep->args;
  size_t kept = 0;
  memset(sheet, 0, sizeof *sheet);
  sheet->args = args;
  sheet->scheme = sweep->scheme;
  sheet->inputs = cli_inputs_hash(&sweep->drive.table);
  cli_shard_range(&args->shard, args->points, &sheet->first, &sheet->end);
  if (!make_prologue(sheet, hash)) {
    return cli_message(CLI_USAGE, "sweep: the command line is too long");
  }
  CLI_TRY(args->resume ? look_at_file(sheet) : CLI_DONE);
  if (sheet->whole) {
    return CLI_DONE;
  }
  CLI_TRY(cli_output_begin(&sheet->output, "--out", args->out, true));
  const int code =
      sheet->output.to.beside ? look_at_part(sheet, &kept) : CLI_DONE;
  if (code != CLI_DONE) {
    (void)cli_output_close(&sheet->output, false);
    return code;
  }
  sheet->output.checked = sheet->output.to.beside;
  sheet->whole = false; // it lacks its name
  cli_output_go_on(&sheet->output, kept);
  if (kept == 0) {
    (void)cli_output_lines(&sheet->output, sheet->prologue, sheet->length);
  }
  return CLI_DONE;
}

bool cli_sheet_flush(cli_sheet_t *sheet) {
  if (sheet->output.checked) {
    cli_output_trailer(&sheet->output, &sheet->trailer, &sheet->args->shard);
  }
  return cli_output_flush(&sheet->output);
}

int cli_sheet_close(cli_sheet_t *sheet, int code) {
  if (code == CLI_DONE || sheet->output.checked) {
    cli_output_trailer(&sheet->output, &sheet->trailer, &sheet->args->shard);
  }
  return cli_output_end(&sheet->output, code);
}
