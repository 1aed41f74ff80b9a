// The first line of the notes says what the rows follow from; each other line
// is a note: bytes of FILE.part, their CRC, the work that is done, and counts.
// Each line ends with the CRC of all lines so far. A note is written after its
// rows, so a kill loses the rows behind the last note and no others. Where a
// note does not fit the rows, such as after a power failure, the rows behind
// the note before it are made again.

#define _POSIX_C_SOURCE 200809L

#include "sheet.h"

#include <fcntl.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "../text/text.h"

#define LINE (CLI_SHEET_ABOUT + 16)

static const char *notes_of(const cli_sheet_t *sheet) {
  static char name[CLI_PATH_ROOM + 8];
  (void)snprintf(name, sizeof name, "%s.resume", sheet->output.to.path);
  return name;
}

// Where the notes begin. Their CRC begins with what stands before the rows.
static cli_sheet_place_t start_of(const cli_sheet_t *sheet) {
  return (cli_sheet_place_t){
      .chain = cli_crc(0, sheet->begin, strlen(sheet->begin))};
}

// Makes a line of the notes of a text, and goes behind it.
static size_t make_line(cli_sheet_place_t *at, const char *text,
                        char line[LINE]) {
  cli_buffer_t out = {line, 0, LINE, false};
  at->chain = cli_crc(at->chain, text, strlen(text));
  cli_add_form(&out, "%s ", text);
  cli_add_hash(&out, at->chain);
  cli_add(&out, "\n");
  at->notes += out.used;
  return out.used;
}

static bool write_line(cli_sheet_t *sheet, const char *text) {
  static char line[LINE];
  const size_t length = make_line(&sheet->at, text, line);
  return write(sheet->notes, line, length) == (ssize_t)length;
}

static void write_note(const cli_sheet_place_t *at, char text[LINE]) {
  cli_buffer_t out = {text, 0, LINE, false};
  cli_add_form(&out, "%" PRIu64 " ", at->bytes);
  cli_add_hash(&out, at->crc);
  cli_add_form(&out, " %" PRIu64, at->work.done);
  for (size_t i = 0; i < CLI_SHEET_COUNTS; i++) {
    cli_add_form(&out, " %" PRIu64, at->work.count[i]);
  }
}

// Reads the line of a note. Returns: whether it is as it was written.
static bool read_note(const char *line, cli_sheet_place_t *at) {
  static char text[LINE], again[LINE];
  int used = 0;
  bool right = sscanf(line, "%" SCNu64 " %8" SCNx32 " %" SCNu64 "%n",
                      &at->bytes, &at->crc, &at->work.done, &used) == 3;
  const char *next = line + used;
  for (size_t i = 0; i < CLI_SHEET_COUNTS && right; i++) {
    right = sscanf(next, " %" SCNu64 "%n", &at->work.count[i], &used) == 1;
    next += used;
  }
  write_note(at, text);
  (void)make_line(at, text, again);
  return right && strcmp(line, again) == 0;
}

// Whether a file goes on from one place with the bytes up to another.
static bool reaches(FILE *rows, const cli_sheet_place_t *from,
                    const cli_sheet_place_t *to) {
  char part[4096];
  uint64_t bytes = from->bytes;
  uint32_t crc = from->crc;
  while (bytes < to->bytes) {
    const uint64_t left = to->bytes - bytes;
    const size_t some = left < sizeof part ? (size_t)left : sizeof part;
    if (fread(part, 1, some, rows) != some) {
      return false;
    }
    crc = cli_crc(crc, part, some);
    bytes += some;
  }
  return bytes == to->bytes && crc == to->crc;
}

// Goes to the last note that fits the rows, of no more work than `most`.
static int read_notes(const cli_sheets_t *sheets, cli_sheet_t *sheet,
                      FILE *notes, FILE *rows, const char *name,
                      uint64_t most) {
  static char line[LINE], right[LINE];
  cli_sheet_place_t next = start_of(sheet);
  (void)make_line(&next, sheets->about, right);
  if (fgets(line, sizeof line, notes) == NULL || strcmp(line, right) != 0) {
    return cli_output_refuse_other(name, sheets->what);
  }
  sheet->at = next;
  while (fgets(line, sizeof line, notes) != NULL &&
         strchr(line, '\n') != NULL) {
    if (!read_note(line, &next)) {
      return cli_message(CLI_REFUSED,
                         "--resume: %s is damaged; remove it and %s, or give "
                         "another file",
                         notes_of(sheet), name);
    }
    if (next.work.done > most || !reaches(rows, &sheet->at, &next)) {
      break;
    }
    sheet->at = next;
  }
  return CLI_DONE;
}

// Looks how far a file of rows is right; a file without notes is of something
// else.
static int look_at(const cli_sheets_t *sheets, cli_sheet_t *sheet,
                   const char *name, uint64_t most) {
  FILE *rows = fopen(name, "r"), *notes = fopen(notes_of(sheet), "r");
  const int code = rows != NULL && notes != NULL
                       ? read_notes(sheets, sheet, notes, rows, name, most)
                       : cli_output_refuse_other(name, sheets->what);
  if (rows != NULL) {
    (void)fclose(rows);
  }
  if (notes != NULL) {
    (void)fclose(notes);
  }
  return code;
}

static uint64_t size_of(const char *name) {
  struct stat status;
  return stat(name, &status) == 0 ? (uint64_t)status.st_size : 0;
}

// Opens the part, which may have rows; otherwise FILE may be whole.
static int open_sheet(const cli_sheets_t *sheets, cli_sheet_t *sheet,
                      uint64_t total) {
  const cli_destination_t *to = &sheet->output.to;
  CLI_TRY(cli_output_begin(&sheet->output, sheet->option, sheet->path, true));
  sheet->is_open = true;
  sheet->at = start_of(sheet);
  if (!sheets->noted || !to->beside) {
    return CLI_DONE;
  }
  if (size_of(to->part) > 0) {
    return sheets->resume
               ? look_at(sheets, sheet, to->part, total)
               : cli_message(CLI_REFUSED,
                             "%s has rows of a %s that was stopped: --resume "
                             "goes on with them, or remove it",
                             to->part, sheets->what);
  }
  const uint64_t size = size_of(to->path);
  if (!sheets->resume || size == 0) {
    return CLI_DONE;
  }
  CLI_TRY(look_at(sheets, sheet, to->path, total));
  sheet->is_whole = sheet->at.work.done == total && sheet->at.bytes == size;
  return sheet->is_whole ? CLI_DONE
                         : cli_output_refuse_other(to->path, sheets->what);
}

// Drops what is behind the place of a file, and goes on there. The first line
// of the notes is on disk before the rows: rows without it would be refused.
static int go_on(const cli_sheets_t *sheets, cli_sheet_t *sheet) {
  const off_t end = (off_t)sheet->at.notes;
  cli_output_go_on(&sheet->output, (size_t)sheet->at.bytes);
  if (sheets->noted && sheet->output.to.beside) {
    const char *name = notes_of(sheet);
    sheet->notes =
        open(name, O_WRONLY | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (sheet->notes < 0 || ftruncate(sheet->notes, end) != 0 ||
        lseek(sheet->notes, end, SEEK_SET) != end ||
        (end == 0 && !write_line(sheet, sheets->about)) ||
        fsync(sheet->notes) != 0) {
      return cli_message(CLI_STOPPED, "%s: cannot be written", name);
    }
  }
  if (sheet->at.bytes == 0) {
    (void)cli_sheet_put(sheet, sheet->begin, strlen(sheet->begin));
  }
  return CLI_DONE;
}

// Goes back to the work that is done in all files. One that is whole cannot go
// back, so where it has to, all begin anew.
static int agree(cli_sheets_t *sheets, uint64_t total, cli_done_t *work) {
  bool anew = false;
  work->done = total;
  for (int i = 0; i < CLI_SHEETS; i++) {
    const cli_sheet_t *sheet = &sheets->sheet[i];
    if (sheet->is_open && sheet->at.work.done < work->done) {
      work->done = sheet->at.work.done;
    }
    anew = anew || sheet->is_whole;
  }
  anew = anew && work->done < total;
  for (int i = 0; i < CLI_SHEETS; i++) {
    cli_sheet_t *sheet = &sheets->sheet[i];
    if (!sheet->is_open) {
      continue;
    }
    if (anew) {
      sheet->at = start_of(sheet);
      sheet->is_whole = false;
    } else if (sheet->at.work.done > work->done) {
      CLI_TRY(look_at(sheets, sheet, sheet->output.to.part, work->done));
    }
    *work = sheet->at.work;
    if (sheet->is_whole) {
      (void)cli_output_close(&sheet->output, false);
      sheet->is_open = false;
    }
  }
  return CLI_DONE;
}

static int open_all(cli_sheets_t *sheets, uint64_t total, cli_done_t *work,
                    bool *whole) {
  for (int i = 0; i < CLI_SHEETS; i++) {
    if (sheets->sheet[i].path != NULL) {
      CLI_TRY(open_sheet(sheets, &sheets->sheet[i], total));
    }
  }
  CLI_TRY(agree(sheets, total, work));
  *whole = true;
  for (int i = 0; i < CLI_SHEETS; i++) {
    if (sheets->sheet[i].is_open) {
      *whole = false;
      CLI_TRY(go_on(sheets, &sheets->sheet[i]));
    }
  }
  return CLI_DONE;
}

int cli_sheets_open(cli_sheets_t *sheets, uint64_t total, cli_done_t *work,
                    bool *whole) {
  const int code = open_all(sheets, total, work, whole);
  for (int i = 0; i < CLI_SHEETS && code != CLI_DONE; i++) {
    if (sheets->sheet[i].is_open) {
      (void)cli_output_close(&sheets->sheet[i].output, false);
    }
  }
  return code;
}

bool cli_sheet_put(cli_sheet_t *sheet, const char *rows, size_t length) {
  if (!sheet->is_open) {
    return true;
  }
  sheet->at.crc = cli_crc(sheet->at.crc, rows, length);
  sheet->at.bytes += length;
  return cli_output_lines(&sheet->output, rows, length);
}

bool cli_sheets_flush(cli_sheets_t *sheets) {
  bool written = true;
  for (int i = 0; i < CLI_SHEETS; i++) {
    cli_sheet_t *sheet = &sheets->sheet[i];
    written = (!sheet->is_open || cli_output_flush(&sheet->output)) && written;
  }
  return written;
}

bool cli_sheets_note(cli_sheets_t *sheets, const cli_done_t *work) {
  static char text[LINE];
  bool written = cli_sheets_flush(sheets);
  for (int i = 0; i < CLI_SHEETS && written; i++) {
    cli_sheet_t *sheet = &sheets->sheet[i];
    if (sheet->is_open && sheet->notes > 0) {
      sheet->at.work = *work;
      write_note(&sheet->at, text);
      written = write_line(sheet, text);
      if (!written) {
        (void)cli_message(CLI_STOPPED, "%s: cannot be written",
                          notes_of(sheet));
      }
    }
  }
  return written;
}

int cli_sheets_close(cli_sheets_t *sheets, int code) {
  // None gets its name where the rows of another could not be written.
  code = cli_sheets_flush(sheets) ? code : CLI_STOPPED;
  for (int i = 0; i < CLI_SHEETS; i++) {
    cli_sheet_t *sheet = &sheets->sheet[i];
    if (!sheet->is_open) {
      continue;
    }
    if (sheet->notes > 0) {
      (void)fsync(sheet->notes);
      (void)close(sheet->notes);
    }
    code = cli_output_end(&sheet->output, code);
    if (sheet->notes > 0 && !sheet->output.to.left &&
        (code != CLI_DONE || !sheets->resume)) {
      (void)unlink(notes_of(sheet));
    }
    sheet->is_open = false;
  }
  return code;
}
