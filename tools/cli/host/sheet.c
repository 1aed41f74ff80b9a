// The first line of the notes says what the rows follow from; each other line
// is a note: bytes of each FILE.part and their CRC, the work that is done, and
// counts. Each line begins with the CRC of all lines so far. A note is written
// after its rows, so a kill loses the rows behind the last note and no others.
// Where a note does not fit the rows, such as after a power failure, the rows
// behind the note before it are made again.

#define _POSIX_C_SOURCE 200809L

#include "sheet.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#define LINE (CLI_SHEET_ABOUT + SUM_ROOM + 1)
#define SAVE_EVERY 0.2 // [s], so at most so much work is lost by a kill
#define SUM_ROOM 10    // the CRC, a blank and zero

static const char *notes_of(const cli_sheets_t *sheets) {
  static char name[CLI_PATH_ROOM + 8];
  (void)snprintf(name, sizeof name, "%s.resume", sheets->sheet[0].output.path);
  return name;
}

static uint64_t size_of(const char *name) {
  struct stat status;
  return stat(name, &status) == 0 ? (uint64_t)status.st_size : 0;
}

// The file that has rows of a sheet, or will have.
static const char *name_of(const cli_sheet_t *sheet) {
  const cli_output_t *to = &sheet->output;
  return size_of(to->part) == 0 && size_of(to->path) > 0 ? to->path : to->part;
}

static bool write_line(cli_sheets_t *sheets, const char *text) {
  sheets->chain = cli_crc(sheets->chain, text, strlen(text));
  return dprintf(sheets->notes, "%08" PRIx32 " %s\n", sheets->chain, text) > 0;
}

// The text of a line. NULL: the CRC before it is wrong.
static const char *text_of(uint32_t *chain, char *line) {
  char sum[SUM_ROOM];
  line[strcspn(line, "\n")] = '\0';
  const size_t before = strnlen(line, SUM_ROOM - 1);
  *chain = cli_crc(*chain, line + before, strlen(line + before));
  (void)snprintf(sum, sizeof sum, "%08" PRIx32 " ", *chain);
  return strncmp(line, sum, SUM_ROOM - 1) == 0 ? line + before : NULL;
}

static uint64_t next_number(const char **at, int base) {
  char *end;
  const uint64_t number = strtoull(*at, &end, base);
  *at = end;
  return number;
}

// Whether the rows of a file go on with the bytes up to a place.
static bool reaches(const cli_sheet_t *sheet, cli_extent_t to) {
  char part[4096];
  size_t some = 1;
  cli_extent_t at = sheet->rows;
  FILE *file = fopen(name_of(sheet), "r");
  if (file == NULL || fseeko(file, (off_t)at.bytes, SEEK_SET) != 0) some = 0;
  while (some > 0 && at.bytes < to.bytes) {
    const uint64_t left = to.bytes - at.bytes;
    some =
        fread(part, 1, left < sizeof part ? (size_t)left : sizeof part, file);
    at.crc = cli_crc(at.crc, part, some);
    at.bytes += some;
  }
  if (file != NULL) (void)fclose(file);
  return at.bytes == to.bytes && at.crc == to.crc;
}

// Goes to a note, if it fits the rows.
static bool go_to(cli_sheets_t *sheets, const char *note) {
  cli_extent_t next[CLI_SHEETS];
  for (int i = 0; i < sheets->count; i++) {
    next[i].bytes = next_number(&note, 10);
    next[i].crc = (uint32_t)next_number(&note, 16);
    if (!reaches(&sheets->sheet[i], next[i])) return false;
  }
  for (int i = 0; i < sheets->count; i++) sheets->sheet[i].rows = next[i];
  sheets->done.done = next_number(&note, 10);
  for (int i = 0; i < CLI_SHEET_COUNTS; i++)
    sheets->done.count[i] = next_number(&note, 10);
  return true;
}

static int refuse_other(const cli_sheets_t *sheets, const char *path) {
  return cli_refuse(
      "--resume: %s is of another %s, or of another build of twofold; remove "
      "it, or give another file",
      path, sheets->what);
}

// Goes to the last note that fits the rows; without notes they are of something
// else. name: in, one of the files.
static int read_notes(cli_sheets_t *sheets, FILE *notes, const char *name) {
  static char line[LINE];
  uint32_t chain = sheets->chain;
  if (notes == NULL) {
    return cli_refuse(
        "--resume: %s has no notes in %s: it was not begun with --resume; "
        "remove it, or give another file",
        name, notes_of(sheets));
  }
  const char *text =
      fgets(line, sizeof line, notes) == NULL ? NULL : text_of(&chain, line);
  if (text == NULL || strcmp(text, sheets->about) != 0)
    return refuse_other(sheets, name);
  do {
    sheets->chain = chain;
    sheets->noted_end = ftell(notes);
    if (fgets(line, sizeof line, notes) == NULL || strchr(line, '\n') == NULL)
      return CLI_DONE;
    text = text_of(&chain, line);
    if (text == NULL) {
      return cli_refuse(
          "--resume: %s is damaged; remove it and %s, or give another file",
          notes_of(sheets), name);
    }
  } while (go_to(sheets, text));
  return CLI_DONE;
}

// The first line is on disk before the rows: rows without it would be refused.
static bool open_notes(cli_sheets_t *sheets) {
  sheets->notes =
      open(notes_of(sheets), O_WRONLY | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
  return sheets->notes >= 0 &&
         ftruncate(sheets->notes, sheets->noted_end) == 0 &&
         lseek(sheets->notes, 0, SEEK_END) >= 0 &&
         (sheets->noted_end > 0 || write_line(sheets, sheets->about)) &&
         fsync(sheets->notes) == 0;
}

// Goes on behind the rows that are right. A FILE that is whole stays.
static int go_on(cli_sheets_t *sheets) {
  const bool all = sheets->done.done == sheets->total;
  sheets->whole = true;
  for (int i = 0; i < sheets->count; i++) {
    cli_sheet_t *sheet = &sheets->sheet[i];
    const cli_output_t *to = &sheet->output;
    if (!sheets->noted || !sheets->resume || name_of(sheet) == to->part) {
      sheets->whole = false;
      cli_output_go_on(&sheet->output, (size_t)sheet->rows.bytes);
    } else if (all && sheet->rows.bytes == size_of(to->path)) {
      (void)cli_output_close(&sheet->output, false);
    } else {
      return refuse_other(sheets, to->path);
    }
  }
  if (sheets->noted && !sheets->whole && !open_notes(sheets))
    return cli_stop("%s: cannot be written", notes_of(sheets));
  for (int i = 0; i < sheets->count; i++) {
    cli_sheet_t *sheet = &sheets->sheet[i];
    if (sheet->rows.bytes == 0)
      (void)cli_sheet_put(sheet, sheet->begin, strlen(sheet->begin));
  }
  return CLI_DONE;
}

static int open_all(cli_sheets_t *sheets) {
  const char *found = NULL; // rows, better those of a part
  bool in_part = false;
  for (; sheets->count < CLI_SHEETS; sheets->count++) {
    cli_sheet_t *sheet = &sheets->sheet[sheets->count];
    const cli_output_t *to = &sheet->output;
    if (sheet->path == NULL) break;
    CLI_TRY(cli_output_begin(&sheet->output, sheet->option, sheet->path,
                             CLI_GO_ON));
    if (to->there > 0 && !sheets->noted) (void)cli_output_note_over(to);
    sheets->noted = sheets->noted && to->beside;
    sheets->chain = cli_crc(sheets->chain, sheet->begin, strlen(sheet->begin));
    if (to->beside && !in_part && size_of(name_of(sheet)) > 0) {
      found = name_of(sheet);
      in_part = found == to->part;
    }
  }
  if (sheets->noted && in_part && !sheets->resume) {
    return cli_refuse(
        "%s has rows of a %s that was stopped: use --resume to continue, or "
        "remove it",
        found, sheets->what);
  }
  if (sheets->noted && found != NULL && sheets->resume) {
    FILE *notes = fopen(notes_of(sheets), "r");
    const int code = read_notes(sheets, notes, found);
    if (notes != NULL) (void)fclose(notes);
    CLI_TRY(code);
  }
  return go_on(sheets);
}

// Shards differ by one piece of work at most. Each is a run of neighbours, so
// that the rows of all shards, file after file, are those of the whole.
int cli_sheets_open(cli_sheets_t *sheets, const cli_shard_t *shard,
                    uint64_t count) {
  const uint64_t before = shard->index - 1;
  const uint64_t share = count / shard->of;
  const uint64_t longer = count % shard->of; // shards with one more
  sheets->first = share * before + (before < longer ? before : longer);
  sheets->total = share + (before < longer ? 1 : 0);
  for (char *at = sheets->about; (at = strchr(at, '\n')) != NULL;) *at = ' ';
  const int code = open_all(sheets);
  sheets->kept = sheets->done;
  sheets->saved = cli_now();
  sheets->progress =
      cli_progress_start(sheets->saved, sheets->sheet->output.descriptor);
  for (int i = 0; i < sheets->count && code != CLI_DONE; i++)
    (void)cli_output_close(&sheets->sheet[i].output, false);
  return code;
}

bool cli_sheet_put(cli_sheet_t *sheet, const char *rows, size_t length) {
  sheet->rows.crc = cli_crc(sheet->rows.crc, rows, length);
  sheet->rows.bytes += length;
  return cli_output_lines(&sheet->output, rows, length);
}

static bool flush(cli_sheets_t *sheets) {
  bool written = true;
  for (int i = 0; i < sheets->count; i++)
    written = cli_output_flush(&sheets->sheet[i].output) && written;
  return written;
}

static bool note(cli_sheets_t *sheets) {
  char text[512];
  cli_buffer_t line = {text, 0, sizeof text, false};
  for (int i = 0; i < sheets->count; i++) {
    cli_add_form(&line, "%" PRIu64 " %08x ", sheets->sheet[i].rows.bytes,
                 sheets->sheet[i].rows.crc);
  }
  cli_add_count(&line, sheets->done.done);
  for (int i = 0; i < CLI_SHEET_COUNTS; i++)
    cli_add_form(&line, " %" PRIu64, sheets->done.count[i]);
  if (!flush(sheets)) return false;
  if (sheets->noted && !write_line(sheets, text)) {
    (void)cli_stop("%s: cannot be written", notes_of(sheets));
    return false;
  }
  return true;
}

bool cli_sheets_save(cli_sheets_t *sheets, bool between) {
  const double now = cli_now();
  if (now - sheets->saved < SAVE_EVERY) return true;
  sheets->saved = between ? now : sheets->saved;
  return between ? note(sheets) : flush(sheets);
}

int cli_sheets_close(cli_sheets_t *sheets, int code) {
  bool left = false;
  cli_progress_clear(&sheets->progress);
  // None gets its name where the rows of another could not be written.
  const bool all = sheets->done.done == sheets->total;
  code = (all ? note(sheets) : flush(sheets)) ? code : CLI_STOPPED;
  if (sheets->noted) {
    (void)fsync(sheets->notes);
    (void)close(sheets->notes);
  }
  for (int i = 0; i < sheets->count; i++) {
    code = cli_output_end(&sheets->sheet[i].output, code);
    left = left || sheets->sheet[i].output.left;
  }
  if (sheets->noted && !left && (code != CLI_DONE || !sheets->resume))
    (void)unlink(notes_of(sheets));
  return code;
}
