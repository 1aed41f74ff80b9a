/// Files of rows that take long: a program that was stopped, even by SIGKILL,
/// goes on with them and ends with the bytes of one that was not. FILE is plain
/// CSV. While it is FILE.part, notes say how far it is right; one FILE.resume,
/// beside the first file, holds those of all files of one work.
#pragma once

#include "host.h"
#include "output.h"

#define CLI_SHEETS 2
#define CLI_SHEET_COUNTS 8
#define CLI_SHEET_ABOUT 16384 ///< room for what the rows follow from
#define CLI_SHEET_BEGIN 20480 ///< room for comments and header

/// What has been done when a note is made: pieces of work, whose rows are
/// there, and what their owner counts.
typedef struct {
  uint64_t done, count[CLI_SHEET_COUNTS];
} cli_done_t;

/// Rows of a file, and their CRC.
typedef struct {
  uint64_t bytes;
  uint32_t crc;
} cli_extent_t;

typedef struct {
  const char *option, *path;
  char begin[CLI_SHEET_BEGIN]; ///< comments and header, may be empty
  cli_output_t output;
  cli_extent_t rows;
} cli_sheet_t;

/// Files of one work, which go on and get their names together.
typedef struct {
  const char *what;              ///< a sweep or a run, for messages
  bool resume, noted;            ///< goes on with what is there; makes notes
  char about[CLI_SHEET_ABOUT];   ///< one line: what the rows follow from
  cli_sheet_t sheet[CLI_SHEETS]; ///< those without a path come last
  int count;                     ///< of those that are open
  uint64_t first, total;         ///< pieces of work: those of the shard
  cli_done_t done, kept;         ///< so far; and when the files were opened
  bool whole; ///< when opened, all had name and rows: none is open
  cli_progress_t progress;
  double saved;   ///< cli_now() of the last note
  int notes;      ///< descriptor, 0: none are made
  long noted_end; ///< bytes of the notes
  uint32_t chain; ///< CRC of their lines
} cli_sheets_t;

/// Opens the files behind the rows that are there: under resume those of the
/// work that is done in all files, otherwise none. Rows of another command or
/// build are refused.
/// count: in, pieces of the work in all shards.
int cli_sheets_open(cli_sheets_t *sheets, const cli_shard_t *shard,
                    uint64_t count);

/// Appends whole rows to a file.
/// Returns: whether everything so far could be written.
bool cli_sheet_put(cli_sheet_t *sheet, const char *rows, size_t length);

/// Now and then hands all rows to the operating system; between two pieces of
/// work it notes what is done, too. Returns: likewise.
bool cli_sheets_save(cli_sheets_t *sheets, bool between);

/// Closes the files; under CLI_DONE they get their names. Ends the progress.
/// Returns: the code, or CLI_STOPPED in place of CLI_DONE.
int cli_sheets_close(cli_sheets_t *sheets, int code);
