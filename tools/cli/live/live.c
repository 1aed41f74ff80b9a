// The live picture of a terminal. All that is used of it are ANSI codes that
// every emulator of the last decades knows, so there is no table of terminals;
// where TERM says "dumb", or nothing, nothing is drawn.

#define _POSIX_C_SOURCE 200809L

#include "live.h"

#include <errno.h>
#include <stdarg.h>
#include <strings.h>
#include <unistd.h>

#include "../host/host.h"

#define COLUMNS 512 // that are drawn at most, and rows
#define ROWS 144

static struct {
  bool utf8, colour; // that it takes
  int columns, rows; // when it was last looked at
} terminal;

// Another page; no cursor; long lines end at the edge.
#define TAKE "\033[?1049h\033[?25l\033[?7l\033[2J"
#define LINE_END "\033[K\r\n"
#define END "\033[K\033[J" // of a drawing
#define GIVE_BACK "\033[m\033[?7h\033[?25h\033[?1049l"

// Nobody looks at a terminal that takes no more bytes. Once a signal has
// asked for a stop the terminal is no longer ours, and what is left of a
// drawing is not written.
static void put(const char *text, bool drawing) {
  size_t length = strlen(text);
  while (length > 0 && !(drawing && cli_stop_asked())) {
    const ssize_t taken = write(STDOUT_FILENO, text, length);
    if (taken > 0) {
      text += taken;
      length -= (size_t)taken;
    } else if (taken == 0 || errno != EINTR) {
      return;
    }
  }
}

// As the C library finds the character set, which this program does not ask:
// its numbers have to be those of the locale "C".
static bool takes_utf8(void) {
  static const char *const names[] = {"LC_ALL", "LC_CTYPE", "LANG"};
  for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
    const char *value = getenv(names[i]);
    if (value != NULL && value[0] != '\0') {
      const char *set = strchr(value, '.');
      return set != NULL && (strncasecmp(set, ".UTF-8", 6) == 0 ||
                             strncasecmp(set, ".utf8", 5) == 0);
    }
  }
  return false;
}

// Looks how large it is, which needs no signal. Returns: what a drawing has to
// begin with.
static const char *measure_terminal(void) {
  const int columns = terminal.columns, rows = terminal.rows;
  cli_terminal_size(&terminal.columns, &terminal.rows);
  terminal.columns = terminal.columns < COLUMNS ? terminal.columns : COLUMNS;
  return columns != terminal.columns || rows != terminal.rows ? "\033[2J\033[H"
                                                              : "\033[H";
}

// The canvas: all that is drawn is put into its cells. Of a text, what lies
// beyond the edge is left out; all else has its size from that of the terminal.
// An ink has a colour, and a mark where the terminal is not known to take
// UTF-8. A cell of braille has two columns of four dots, so a terminal of 80
// columns shows a plane of 160 dots.

#define BRAILLE 0x2800u // without dots
#define BLOCK 0x2585u   // lower half
#define BORDER 0x2502u  // a vertical line
#define CIRCLE 0x25cfu
#define DRAWING_ROOM (1 << 20) // all cells, each with its colour

// The first inks are those of the modes, and 1; colours of every terminal,
// which for the modes differ in brightness, too.
enum { NO_INK, AMBIGUOUS = TF_MODES + 1, AXIS, NOW, FRAME, INKS };
static const char marks[INKS + 1] = " +-PMo?.@|";
static const char *const colours[INKS] = {
    "",         "\033[33m", "\033[94m", "\033[32m", "\033[95m",
    "\033[31m", "",         "\033[90m", "\033[1m",  ""};

typedef struct {
  uint16_t glyph; // a byte as it is, or a character; 0: blank
  uint8_t ink;
} cell_t;

static cell_t cells[ROWS][COLUMNS];
static char drawing[DRAWING_ROOM];

static void put_cell(int row, int column, unsigned glyph, unsigned ink) {
  cells[row][column] = (cell_t){(uint16_t)glyph, (uint8_t)ink};
}

CLI_PRINTF(3, 4)
static void put_text(int row, int column, const char *format, ...) {
  char text[COLUMNS + 1];
  va_list arguments;
  va_start(arguments, format);
  (void)vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  for (int i = 0; text[i] != '\0' && column + i < terminal.columns; i++)
    put_cell(row, column + i, (unsigned char)text[i], NO_INK);
}

static void add_cell(const cell_t *cell, cli_buffer_t *text) {
  const unsigned glyph = cell->glyph;
  char bytes[4] = " ";
  if (glyph > 0 && glyph < 256) {
    bytes[0] = (char)glyph;
  } else if (glyph > 0 && !terminal.utf8) {
    bytes[0] = marks[cell->ink];
  } else if (glyph > 0) {
    bytes[0] = (char)(0xe0 | glyph >> 12);
    bytes[1] = (char)(0x80 | (glyph >> 6 & 63u));
    bytes[2] = (char)(0x80 | (glyph & 63u));
  }
  cli_add(text, bytes);
}

static void add_row(const cell_t *row, cli_buffer_t *text) {
  int used = COLUMNS;
  unsigned ink = NO_INK;
  while (used > 0 && row[used - 1].glyph == 0) used--;
  for (int i = 0; i <= used; i++) {
    const unsigned next = i < used ? row[i].ink : (unsigned)NO_INK;
    if (next != ink && terminal.colour) {
      cli_add(text, ink != NO_INK ? "\033[m" : "");
      cli_add(text, colours[next]);
    }
    ink = next;
    if (i < used) add_cell(&row[i], text);
  }
}

typedef struct {
  size_t column; // of a row, whose values it shows
  double low, high;
} axis_t;

// A plane on the canvas, of so many cells from a corner on.
typedef struct {
  axis_t x, y;
  int digits; // of the ends of the axes
  int row, column, rows, columns;
} plane_t;

// Dot of a value among n, -1 outside.
static int place(const axis_t *axis, double value, int n) {
  const double at = (value - axis->low) / (axis->high - axis->low) * n;
  return at >= 0 && at < n ? (int)at : -1;
}

// The row counts from below.
static void put_dot(const plane_t *plane, int column, int row, unsigned ink) {
  static const uint8_t bits[4][2] = {
      {0x40, 0x80}, {0x04, 0x20}, {0x02, 0x10}, {0x01, 0x08}};
  if (column >= 0 && row >= 0) {
    const int at = plane->row + plane->rows - 1 - row / 4;
    const unsigned before = cells[at][plane->column + column / 2].glyph;
    put_cell(at, plane->column + column / 2,
             ink == NOW ? CIRCLE : before | BRAILLE | bits[row % 4][column % 2],
             ink);
  }
}

static void plot(const plane_t *plane, const cli_csv_t *at, unsigned ink) {
  put_dot(plane,
          place(&plane->x, at->column[plane->x.column], 2 * plane->columns),
          place(&plane->y, at->column[plane->y.column], 4 * plane->rows), ink);
}

// What is drawn. The time that is kept is divided into buckets, each with the
// last instant in it and all modes of it: so memory and the time to draw do not
// depend on the number of steps, and no mode that was visited is left out. It
// is drawn ten times a second at most.

#define DRAW_EVERY 0.1 // [s]
#define BUCKETS 8192
#define SAID_ROOM 65536
#define LANES (TF_MODES + 1) // one a mode, and one for several futures
#define LABEL 10             // columns of a lane's name
#define HEAD 3               // lines above the planes
#define FOOT (LANES + 2)     // lines below them
#define MOST_ROWS 128        // of a plane
#define MIN_COLUMNS 40
#define MIN_ROWS (HEAD + 4 + FOOT)

typedef struct {
  uint64_t number; // of the bucket, from 1; 0: empty
  unsigned modes;  // bits TF_MODE_BIT, and bit TF_MODES: several futures
  cli_csv_t last;
} bucket_t;

struct cli_live {
  double span, next;
  uint64_t newest; // number of a bucket, 0: none
  cli_csv_t last;
  char said[SAID_ROOM]; // messages
  bucket_t bucket[BUCKETS];
};

static plane_t planes[] = {
    {.x = {.column = CLI_CSV_g}, .y = {.column = CLI_CSV_h}, .digits = 2},
    {.x = {.column = CLI_CSV_r}, .y = {.column = CLI_CSV_omega}, .digits = 3}};
#define PLANES ((int)(sizeof planes / sizeof planes[0]))

// Where a terminal is missing not one byte goes to standard output.
cli_live_t *cli_live_open(double span) {
  static cli_live_t live;
  const char *term = getenv("TERM"), *plain = getenv("NO_COLOR");
  if (!cli_is_terminal(STDOUT_FILENO)) {
    (void)cli_message(CLI_DONE,
                      "--live needs a terminal: standard output is not one");
    return NULL;
  }
  if (term == NULL || term[0] == '\0' || strcmp(term, "dumb") == 0) {
    (void)cli_message(CLI_DONE,
                      "--live needs a terminal that can be drawn on: TERM is "
                      "'%s'",
                      term != NULL ? term : "");
    return NULL;
  }
  terminal.utf8 = takes_utf8();
  terminal.colour = plain == NULL || plain[0] == '\0';
  live.span = span > 0 ? span : 1;
  cli_catch_signals();
  cli_screen_begin(GIVE_BACK);
  put(TAKE, false);
  cli_message_divert(live.said, sizeof live.said);
  return &live;
}

void cli_live_note(cli_live_t *live, const cli_csv_t *at) {
  if (live == NULL || !(at->column[CLI_CSV_t] >= 0) || at->mode >= TF_MODES)
    return;
  const uint64_t number =
      1 + (uint64_t)(at->column[CLI_CSV_t] / live->span * (BUCKETS - 1));
  if (number < live->newest)
    memset(live->bucket, 0, sizeof live->bucket); // it began anew
  bucket_t *bucket = &live->bucket[number % BUCKETS];
  if (bucket->number != number) {
    bucket->number = number;
    bucket->modes = 0;
  }
  bucket->modes |=
      TF_MODE_BIT(at->mode) | (at->choices > 1 ? 1u << TF_MODES : 0u);
  live->newest = number;
  live->last = bucket->last = *at;
}

// The bucket that is `back` before the newest one, NULL where it is empty.
static const bucket_t *bucket_at(const cli_live_t *live, uint64_t back) {
  const uint64_t number = live->newest - back;
  const bucket_t *bucket = &live->bucket[number % BUCKETS];
  return back < live->newest && bucket->number == number ? bucket : NULL;
}

// Lets an axis hold all values, with a margin. It changes only where it has to,
// so that the picture stands still.
static void fit(const cli_live_t *live, axis_t *axis) {
  double low = (double)INFINITY, high = -(double)INFINITY;
  for (uint64_t back = 0; back < BUCKETS; back++) {
    const bucket_t *bucket = bucket_at(live, back);
    if (bucket != NULL) {
      low = fmin(low, bucket->last.column[axis->column]);
      high = fmax(high, bucket->last.column[axis->column]);
    }
  }
  const double size = axis->high - axis->low;
  if (low >= axis->low && high <= axis->high && high - low > 0.3 * size) return;
  double margin = 0.08 * (high - low);
  if (!(margin > 0)) margin = low < 0 || low > 0 ? 0.1 * fabs(low) : 1;
  axis->low = low - margin;
  axis->high = high + margin;
}

static void draw_plane(const cli_live_t *live, plane_t *plane) {
  axis_t *x = &plane->x, *y = &plane->y;
  fit(live, x);
  fit(live, y);
  put_text(HEAD - 1, plane->column - 1, " %s %.*g..%.*g, %s %.*g..%.*g",
           cli_csv_columns[y->column].name, plane->digits, y->low,
           plane->digits, y->high, cli_csv_columns[x->column].name,
           plane->digits, x->low, plane->digits, x->high);
  for (int row = HEAD; row < HEAD + plane->rows; row++)
    put_cell(row, plane->column - 1, BORDER, FRAME);
  // The lines x = 0 and y = 0, where they are within the axes.
  const int column = place(&plane->x, 0, 2 * plane->columns);
  const int line = place(&plane->y, 0, 4 * plane->rows);
  for (int i = 0; i < 2 * plane->columns; i += 2) put_dot(plane, i, line, AXIS);
  for (int i = 1; i < 4 * plane->rows; i += 2) put_dot(plane, column, i, AXIS);
  for (uint64_t back = BUCKETS; back > 0; back--) {
    const bucket_t *bucket = bucket_at(live, back - 1);
    if (bucket != NULL) plot(plane, &bucket->last, bucket->last.mode + 1);
  }
  plot(plane, &live->last, NOW);
}

// A line for each mode, and below them the times at their ends.
static void draw_lanes(const cli_live_t *live, int row) {
  const uint64_t columns = (uint64_t)(terminal.columns - LABEL);
  uint64_t kept = live->newest;
  if (kept > BUCKETS) kept = BUCKETS;
  const double end = fmax(live->span, live->last.column[CLI_CSV_t]);
  for (unsigned lane = 0; lane < LANES; lane++) {
    put_text(row + (int)lane, 0, "%s",
             lane < TF_MODES ? tf_mode_name(lane) : "ambiguous");
    for (uint64_t back = 0; back < kept; back++) {
      const bucket_t *bucket = bucket_at(live, back);
      if (bucket != NULL && (bucket->modes >> lane & 1u) != 0) {
        const uint64_t column = ((kept - back) * columns - 1) / BUCKETS;
        put_cell(row + (int)lane, LABEL + (int)column, BLOCK, lane + 1);
      }
    }
  }
  put_text(row + (int)LANES, 0, "%-*s%-12.4g%*.4g s", LABEL, "t",
           end - live->span, (int)columns - 14, end);
}

// Draws all of it on the canvas. Returns: how many rows.
static int compose(cli_live_t *live, const char *title) {
  const cli_csv_t *at = &live->last;
  const char *said = strrchr(live->said, '\n');
  const bool several = at->choices > 1;
  char set[CLI_SET_ROOM];
  memset(cells, 0, sizeof cells);
  put_text(0, 0, "%s", title);
  put_text(1, 0, "t = %.4f s  %-6s%s%s  r=%.3g omega=%.3g h=%.3g g=%.3g v=%.3g",
           at->column[CLI_CSV_t], tf_mode_name(at->mode), several ? " of " : "",
           several ? cli_write_set(set, at->set) : "", at->column[CLI_CSV_r],
           at->column[CLI_CSV_omega], at->column[CLI_CSV_h],
           at->column[CLI_CSV_g], at->column[CLI_CSV_v]);
  if (live->newest == 0) {
    put_text(2, 0, "(nothing yet)");
    return HEAD;
  }
  if (terminal.columns < MIN_COLUMNS || terminal.rows < (int)MIN_ROWS) {
    put_text(2, 0, "(the planes need %d x %d)", MIN_COLUMNS, (int)MIN_ROWS);
    return HEAD;
  }
  const int rows = terminal.rows - HEAD - (int)FOOT;
  const int row = HEAD + (rows < MOST_ROWS ? rows : MOST_ROWS);
  for (int i = 0; i < PLANES; i++) {
    planes[i].row = HEAD;
    planes[i].rows = row - HEAD;
    planes[i].column = 1 + i * (terminal.columns / PLANES);
    planes[i].columns = terminal.columns / PLANES - 1;
    draw_plane(live, &planes[i]);
  }
  draw_lanes(live, row);
  put_text(row + (int)LANES + 1, 0, "%s", said != NULL ? said + 1 : live->said);
  return row + (int)LANES + 1 + (live->said[0] != '\0');
}

static void write_rows(int rows, const char *newline, cli_buffer_t *text) {
  for (int row = 0; row < rows; row++) {
    cli_add(text, row > 0 ? newline : "");
    add_row(cells[row], text);
  }
}

void cli_live_draw(cli_live_t *live, const char *title, double now) {
  cli_buffer_t text = {drawing, 0, sizeof drawing, false};
  if (live == NULL || now < live->next) return;
  live->next = now + DRAW_EVERY;
  cli_add(&text, measure_terminal());
  write_rows(compose(live, title), LINE_END, &text);
  cli_add(&text, END);
  put(drawing, true);
  cli_stop_on_key('q');
}

void cli_live_close(cli_live_t *live, const char *title) {
  if (live == NULL) return;
  cli_buffer_t text = {drawing, 0, sizeof drawing, false};
  cli_message_divert(NULL, 0);
  (void)measure_terminal();
  terminal.rows--; // the line of the prompt that follows
  write_rows(compose(live, title), "\n", &text);
  cli_add(&text, "\n");
  put(GIVE_BACK, false);
  cli_screen_end();
  put(drawing, false);
  for (char *line = strtok(live->said, "\n"); line != NULL;
       line = strtok(NULL, "\n"))
    (void)cli_message(CLI_DONE, "%s", line);
}
