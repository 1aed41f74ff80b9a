// The live picture of a terminal. All that is used of it are ANSI codes that
// every emulator of the last decades knows, so there is no table of terminals;
// where TERM says "dumb", or nothing, nothing is drawn.

#define _POSIX_C_SOURCE 200809L

#include "live.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "../host/host.h"
#include "../text/buffer.h"
#include "../text/message.h"
#include "twofold.h"

#define CANVAS_COLUMNS 256
#define CANVAS_ROWS 128

// What a cell shows: a dot of a mode (tf_mode_t), or one of these. Its number
// and 1 is kept, 0 where it shows nothing.
enum { INK_AXIS = 14, INK_NOW = 15 };

typedef struct {
  double low, high;
} extent_t;

typedef struct {
  int columns, rows; // cells
  extent_t x, y;
  uint8_t dots[CANVAS_ROWS][CANVAS_COLUMNS]; // of braille
  uint8_t ink[CANVAS_ROWS][CANVAS_COLUMNS];  // of the last dot
} canvas_t;

static struct {
  bool utf8, colour; // that it takes
  int columns, rows; // when it was last looked at
} terminal;

// A cell of braille has two columns of four dots, so a terminal of 80 columns
// shows a plane of 160 dots. Where the terminal is not known to take UTF-8 a
// cell is one mark, that of the mode of its last dot.

// Dot of a value among n, -1 outside.
static int place(const extent_t *extent, double value, int n) {
  const double at = (value - extent->low) / (extent->high - extent->low) * n;
  return at >= 0 && at < n ? (int)at : -1;
}

static void set_dot(canvas_t *canvas, int column, int row, unsigned ink) {
  static const uint8_t bits[4][2] = {
      {0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}};
  uint8_t *there = &canvas->ink[row / 4][column / 2];
  if (ink == INK_AXIS && *there != 0 && *there != INK_AXIS + 1) {
    return; // what moves hides the axes
  }
  canvas->dots[row / 4][column / 2] |= bits[row % 4][column % 2];
  *there = (uint8_t)(ink + 1);
}

// Empties it but for the lines x = 0 and y = 0, where they are within the
// extents.
static void canvas_clear(canvas_t *canvas, int columns, int rows, extent_t x,
                         extent_t y) {
  memset(canvas, 0, sizeof *canvas);
  canvas->columns = columns < CANVAS_COLUMNS ? columns : CANVAS_COLUMNS;
  canvas->rows = rows < CANVAS_ROWS ? rows : CANVAS_ROWS;
  canvas->x = x;
  canvas->y = y;
  const int column = place(&canvas->x, 0, 2 * canvas->columns);
  const int row = place(&canvas->y, 0, 4 * canvas->rows);
  for (int i = 0; row >= 0 && i < 2 * canvas->columns; i += 2) {
    set_dot(canvas, i, 4 * canvas->rows - 1 - row, INK_AXIS);
  }
  for (int i = 0; column >= 0 && i < 4 * canvas->rows; i += 2) {
    set_dot(canvas, column, i, INK_AXIS);
  }
}

static void canvas_dot(canvas_t *canvas, double x, double y, unsigned ink) {
  const int column = place(&canvas->x, x, 2 * canvas->columns);
  const int row = place(&canvas->y, y, 4 * canvas->rows);
  if (column >= 0 && row >= 0) {
    set_dot(canvas, column, 4 * canvas->rows - 1 - row, ink);
  }
}

// From TF_MODES on the mark of several futures.
static char mark_of(unsigned mode) {
  static const char marks[TF_MODES + 2] = "+-PMo?";
  return marks[mode < TF_MODES ? mode : TF_MODES];
}

// Colours of every terminal; those of the modes differ in brightness, too.
static void add_colour(unsigned ink, cli_buffer_t *text) {
  static const char *const codes[TF_MODES] = {
      "\033[33m", "\033[94m", "\033[32m", "\033[95m", "\033[31m"};
  if (!terminal.colour) {
    return;
  }
  if (ink > 0 && ink <= TF_MODES) {
    cli_add(text, codes[ink - 1]);
  } else if (ink == INK_AXIS + 1) {
    cli_add(text, "\033[90m");
  } else if (ink == INK_NOW + 1) {
    cli_add(text, "\033[1m");
  } else {
    cli_add(text, "\033[m");
  }
}

static void add_cell(const canvas_t *canvas, int row, int column,
                     cli_buffer_t *text) {
  const unsigned dots = canvas->dots[row][column];
  const unsigned ink = canvas->ink[row][column];
  char cell[4] = " ";
  if (ink == INK_NOW + 1) {
    cli_add(text, terminal.utf8 ? "\xe2\x97\x8f" : "@"); // a black circle
    return;
  }
  if (ink != 0 && terminal.utf8) {
    cell[0] = (char)0xe2; // U+2800 and the dots
    cell[1] = (char)(0xa0 + (dots >> 6));
    cell[2] = (char)(0x80 + (dots & 63u));
  } else if (ink == INK_AXIS + 1) {
    cell[0] = '.';
  } else if (ink != 0) {
    cell[0] = mark_of(ink - 1);
  }
  cli_add(text, cell);
}

static void canvas_row(const canvas_t *canvas, int row, cli_buffer_t *text) {
  unsigned before = 0;
  for (int column = 0; column < canvas->columns; column++) {
    const unsigned ink = canvas->ink[row][column];
    if (ink != before) {
      add_colour(0, text);
      add_colour(ink, text);
      before = ink;
    }
    add_cell(canvas, row, column, text);
  }
  if (before != 0) {
    add_colour(0, text);
  }
}

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

// Takes the terminal over. A signal that asks for a stop gives it back at once.
// Returns: whether there is one; otherwise a message says what is missing, and
// not one byte goes to standard output.
static bool take_terminal(void) {
  const char *term = getenv("TERM");
  const char *plain = getenv("NO_COLOR");
  if (!cli_is_terminal(STDOUT_FILENO)) {
    (void)cli_message(CLI_DONE,
                      "--live needs a terminal: standard output is none");
    return false;
  }
  if (term == NULL || term[0] == '\0' || strcmp(term, "dumb") == 0) {
    (void)cli_message(CLI_DONE,
                      "--live needs a terminal that is drawn on: TERM is '%s'",
                      term != NULL ? term : "");
    return false;
  }
  terminal.utf8 = takes_utf8();
  terminal.colour = plain == NULL || plain[0] == '\0';
  terminal.columns = terminal.rows = 0;
  cli_catch_signals();
  cli_restore_on_stop(GIVE_BACK);
  cli_keys_begin();
  put(TAKE, false);
  return true;
}

// Looks how large it is, which needs no signal. Returns: what a drawing has to
// begin with.
static const char *measure_terminal(void) {
  const int columns = terminal.columns, rows = terminal.rows;
  cli_terminal_size(&terminal.columns, &terminal.rows);
  return columns != terminal.columns || rows != terminal.rows ? "\033[2J\033[H"
                                                              : "\033[H";
}

// What is drawn. The time that is kept is divided into buckets, each with the
// last instant in it and all modes of it: so memory and the time to draw do not
// depend on the number of steps, and no mode that was visited is left out. It
// is drawn ten times a second at most.

#define DRAW_EVERY 0.1 // [s]
#define BUCKETS 8192
#define DRAWING_ROOM (1 << 20) // all cells, each with its colour
#define SAID_ROOM 65536
#define LANES (TF_MODES + 1) // one a mode, and one for several futures
#define LABEL 10             // columns of a lane's name
#define HEAD 2               // lines above the planes
#define FOOT 2               // lines below the lanes
#define MIN_COLUMNS 40
#define MIN_ROWS (HEAD + 1 + 4 + LANES + FOOT)

typedef struct {
  double t, r, v, omega, h, g;
  unsigned mode, choices;
} point_t;

typedef struct {
  uint64_t number; // of the bucket, from 1; 0: empty
  unsigned modes;  // bits TF_MODE_BIT, and bit TF_MODES: several futures
  point_t last;
} bucket_t;

struct cli_live {
  double span, next;
  uint64_t newest; // number of a bucket, 0: none
  point_t last;
  extent_t r, omega, h, g;
  canvas_t left, right;
  char said[SAID_ROOM]; // messages
  char drawing[DRAWING_ROOM];
  bucket_t bucket[BUCKETS];
};

cli_live_t *cli_live_open(double span) {
  static cli_live_t live;
  live.span = span > 0 ? span : 1;
  if (!take_terminal()) {
    return NULL;
  }
  cli_message_divert(live.said, sizeof live.said);
  return &live;
}

void cli_live_note(cli_live_t *live, const double at[6], unsigned mode,
                   unsigned choices) {
  if (live == NULL || !(at[0] >= 0) || mode >= TF_MODES) {
    return;
  }
  const uint64_t number = 1 + (uint64_t)(at[0] / live->span * (BUCKETS - 1));
  if (number < live->newest) {
    memset(live->bucket, 0, sizeof live->bucket); // it began anew
  }
  bucket_t *bucket = &live->bucket[number % BUCKETS];
  if (bucket->number != number) {
    bucket->number = number;
    bucket->modes = 0;
  }
  bucket->modes |= TF_MODE_BIT(mode) | (choices > 1 ? 1u << TF_MODES : 0u);
  live->newest = number;
  live->last = bucket->last =
      (point_t){at[0], at[1], at[2], at[3], at[4], at[5], mode, choices};
}

// The bucket that is `back` before the newest one, NULL where it is empty.
static const bucket_t *bucket_at(const cli_live_t *live, uint64_t back) {
  const uint64_t number = live->newest - back;
  const bucket_t *bucket = &live->bucket[number % BUCKETS];
  return back < live->newest && bucket->number == number ? bucket : NULL;
}

// Lets an extent hold [low, high] with a margin. It changes only where it has
// to, so that the picture stands still.
static void fit(extent_t *extent, double low, double high) {
  const double size = extent->high - extent->low;
  if (low >= extent->low && high <= extent->high && high - low > 0.3 * size) {
    return;
  }
  double margin = 0.08 * (high - low);
  if (!(margin > 0)) {
    margin = low < 0 || low > 0 ? 0.1 * fabs(low) : 1;
  }
  extent->low = low - margin;
  extent->high = high + margin;
}

static void fit_all(cli_live_t *live) {
  extent_t *const extents[4] = {&live->r, &live->omega, &live->h, &live->g};
  for (int i = 0; i < 4; i++) {
    double low = (double)INFINITY, high = -(double)INFINITY;
    for (uint64_t back = 0; back < BUCKETS; back++) {
      const bucket_t *bucket = bucket_at(live, back);
      if (bucket != NULL) {
        const double values[4] = {bucket->last.r, bucket->last.omega,
                                  bucket->last.h, bucket->last.g};
        low = fmin(low, values[i]);
        high = fmax(high, values[i]);
      }
    }
    fit(extents[i], low, high);
  }
}

static void plot_dot(cli_live_t *live, const point_t *at, unsigned ink) {
  canvas_dot(&live->left, at->g, at->h, ink);
  canvas_dot(&live->right, at->r, at->omega, ink);
}

static void plot(cli_live_t *live, int columns, int rows) {
  canvas_clear(&live->left, columns, rows, live->g, live->h);
  canvas_clear(&live->right, columns, rows, live->r, live->omega);
  for (uint64_t back = BUCKETS; back > 0; back--) {
    const bucket_t *bucket = bucket_at(live, back - 1);
    if (bucket != NULL) {
      plot_dot(live, &bucket->last, bucket->last.mode);
    }
  }
  plot_dot(live, &live->last, INK_NOW);
}

// The modes within a column of the lanes, of so many columns.
static unsigned modes_in(const cli_live_t *live, int column, int columns) {
  const uint64_t first =
      live->newest < BUCKETS ? 1 : live->newest - BUCKETS + 1;
  const uint64_t from = first + (uint64_t)column * BUCKETS / (uint64_t)columns;
  const uint64_t to =
      first + (uint64_t)(column + 1) * BUCKETS / (uint64_t)columns;
  unsigned modes = 0;
  for (uint64_t i = from; i < to && i <= live->newest; i++) {
    const bucket_t *bucket = bucket_at(live, live->newest - i);
    modes |= bucket != NULL ? bucket->modes : 0;
  }
  return modes;
}

// As printf does, and cut off at so many columns.
CLI_PRINTF(3, 4)
static void add_cut(cli_buffer_t *text, int columns, const char *format, ...) {
  char cut[CANVAS_COLUMNS + 1];
  const int room = columns < CANVAS_COLUMNS ? columns : CANVAS_COLUMNS;
  va_list arguments;
  va_start(arguments, format);
  (void)vsnprintf(cut, (size_t)room + 1, format, arguments);
  va_end(arguments);
  cli_add(text, cut);
}

static void add_lane(const cli_live_t *live, unsigned lane, int columns,
                     cli_buffer_t *text) {
  char mark[2] = {mark_of(lane), '\0'};
  add_cut(text, LABEL, "%-*s", LABEL,
          lane < TF_MODES ? tf_mode_name(lane) : "ambiguous");
  add_colour(lane < TF_MODES ? lane + 1 : 0, text);
  for (int i = 0; i < columns; i++) {
    const bool there = (modes_in(live, i, columns) >> lane & 1u) != 0;
    cli_add(text, !there          ? " "
                  : terminal.utf8 ? "\xe2\x96\x85" // a lower block
                                  : mark);
  }
  add_colour(0, text);
}

static void add_planes(cli_live_t *live, int columns, int rows,
                       const char *newline, cli_buffer_t *text) {
  const char *border = terminal.utf8 ? "\xe2\x94\x82" : "|"; // a vertical line
  const int width = columns / 2 - 1;
  char left[128], right[128], line[256];
  plot(live, width, rows);
  (void)snprintf(left, sizeof left, "h %.2g..%.2g, g %.2g..%.2g", live->h.low,
                 live->h.high, live->g.low, live->g.high);
  (void)snprintf(right, sizeof right, "omega %.3g..%.3g, r %.3g..%.3g",
                 live->omega.low, live->omega.high, live->r.low, live->r.high);
  (void)snprintf(line, sizeof line, " %-*.*s %s", width, width, left, right);
  add_cut(text, columns, "%s", line);
  for (int row = 0; row < live->left.rows; row++) {
    cli_add(text, newline);
    cli_add(text, border);
    canvas_row(&live->left, row, text);
    cli_add(text, border);
    canvas_row(&live->right, row, text);
  }
}

static void add_scale(const cli_live_t *live, int columns, cli_buffer_t *text) {
  const double end = fmax(live->span, live->last.t);
  char low[32], high[32];
  (void)snprintf(low, sizeof low, "%.4g", end - live->span);
  (void)snprintf(high, sizeof high, "%.4g s", end);
  add_cut(text, columns, "%-*s%-*s%s", LABEL, "t",
          columns - LABEL - (int)strlen(high), low, high);
}

static void add_state(const cli_live_t *live, int columns, cli_buffer_t *text) {
  const point_t *at = &live->last;
  add_cut(text, columns,
          "t = %.4f s  %-6s  %u possible  r=%.3g omega=%.3g h=%.3g g=%.3g "
          "v=%.3g",
          at->t, tf_mode_name(at->mode), at->choices, at->r, at->omega, at->h,
          at->g, at->v);
}

static void compose(cli_live_t *live, const char *title, const char *newline,
                    cli_buffer_t *text) {
  const int columns = terminal.columns < 2 * CANVAS_COLUMNS
                          ? terminal.columns
                          : 2 * CANVAS_COLUMNS;
  const char *last = strrchr(live->said, '\n');
  add_cut(text, columns, "%s", title);
  cli_add(text, newline);
  add_state(live, columns, text);
  cli_add(text, newline);
  if (live->newest == 0) {
    add_cut(text, columns, "(nothing yet)");
    return;
  }
  if (columns < MIN_COLUMNS || terminal.rows < MIN_ROWS) {
    add_cut(text, columns, "(the planes need %d x %d)", MIN_COLUMNS, MIN_ROWS);
    return;
  }
  fit_all(live);
  add_planes(live, columns, terminal.rows - HEAD - 1 - (int)LANES - FOOT,
             newline, text);
  cli_add(text, newline);
  for (unsigned lane = 0; lane < LANES; lane++) {
    add_lane(live, lane, columns - LABEL, text);
    cli_add(text, newline);
  }
  add_scale(live, columns, text);
  if (live->said[0] != '\0') {
    cli_add(text, newline);
  }
  add_cut(text, columns, "%s", last != NULL ? last + 1 : live->said);
}

bool cli_live_due(const cli_live_t *live, double now) {
  return live != NULL && now >= live->next;
}

void cli_live_draw(cli_live_t *live, const char *title, double now) {
  cli_buffer_t text = {live->drawing, 0, sizeof live->drawing, false};
  live->next = now + DRAW_EVERY;
  cli_add(&text, measure_terminal());
  compose(live, title, LINE_END, &text);
  cli_add(&text, END);
  put(live->drawing, true);
  if (cli_key_pressed('q')) {
    cli_ask_for_stop();
  }
}

void cli_live_close(cli_live_t *live, const char *title) {
  if (live == NULL) {
    return;
  }
  cli_buffer_t text = {live->drawing, 0, sizeof live->drawing, false};
  cli_message_divert(NULL, 0);
  (void)measure_terminal();
  terminal.rows--; // the line of the prompt that follows
  compose(live, title, "\n", &text);
  cli_add(&text, "\n");
  put(GIVE_BACK, false);
  cli_keys_end();
  cli_restore_on_stop(NULL);
  put(live->drawing, false);
  for (char *line = strtok(live->said, "\n"); line != NULL;
       line = strtok(NULL, "\n")) {
    (void)cli_message(CLI_DONE, "%s", line);
  }
}
