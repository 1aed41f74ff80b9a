// The live picture. The time that is kept is divided into buckets, each with
// the last instant in it and all modes of it: so memory and the time to draw do
// not depend on the number of steps, and no mode that was visited is left out.
// It is drawn ten times a second at most.

#include "live.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../text/message.h"
#include "screen.h"
#include "twofold.h"

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
  uint64_t number; ///< of the bucket, from 1; 0: empty
  unsigned modes;  ///< bits TF_MODE_BIT, and bit TF_MODES: several futures
  cli_live_point_t last;
} bucket_t;

struct cli_live {
  cli_screen_t screen;
  double span, next;
  uint64_t newest; ///< number of a bucket, 0: none
  cli_live_point_t last;
  cli_extent_t r, omega, h, g;
  cli_canvas_t left, right;
  char said[SAID_ROOM]; ///< messages
  char drawing[DRAWING_ROOM];
  bucket_t bucket[BUCKETS];
};

cli_live_t *cli_live_open(double span) {
  static cli_live_t live;
  live.span = span > 0 ? span : 1;
  if (!cli_screen_open(&live.screen)) {
    return NULL;
  }
  cli_message_divert(live.said, sizeof live.said);
  return &live;
}

void cli_live_note(cli_live_t *live, const cli_live_point_t *point) {
  if (live == NULL || !(point->t >= 0) || point->mode >= TF_MODES) {
    return;
  }
  const uint64_t number = 1 + (uint64_t)(point->t / live->span * (BUCKETS - 1));
  if (number < live->newest) {
    memset(live->bucket, 0, sizeof live->bucket); // it began anew
  }
  bucket_t *bucket = &live->bucket[number % BUCKETS];
  if (bucket->number != number) {
    bucket->number = number;
    bucket->modes = 0;
  }
  bucket->modes |=
      TF_MODE_BIT(point->mode) | (point->choices > 1 ? 1u << TF_MODES : 0u);
  bucket->last = *point;
  live->newest = number;
  live->last = *point;
}

// The bucket that is `back` before the newest one, NULL where it is empty.
static const bucket_t *bucket_at(const cli_live_t *live, uint64_t back) {
  const uint64_t number = live->newest - back;
  const bucket_t *bucket = &live->bucket[number % BUCKETS];
  return back < live->newest && bucket->number == number ? bucket : NULL;
}

// Lets an extent hold [low, high] with a margin. It changes only where it has
// to, so that the picture stands still.
static void fit(cli_extent_t *extent, double low, double high) {
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
  cli_extent_t *const extents[4] = {&live->r, &live->omega, &live->h, &live->g};
  for (int i = 0; i < 4; i++) {
    double low = (double)INFINITY, high = -(double)INFINITY;
    for (uint64_t back = 0; back < BUCKETS; back++) {
      const bucket_t *bucket = bucket_at(live, back);
      if (bucket != NULL) {
        const cli_live_point_t *at = &bucket->last;
        const double values[4] = {at->r, at->omega, at->h, at->g};
        low = fmin(low, values[i]);
        high = fmax(high, values[i]);
      }
    }
    fit(extents[i], low, high);
  }
}

static void plot_dot(cli_live_t *live, const cli_live_point_t *at,
                     unsigned ink) {
  cli_canvas_dot(&live->left, at->g, at->h, ink);
  cli_canvas_dot(&live->right, at->r, at->omega, ink);
}

// Puts the motion on both planes, oldest first.
static void plot(cli_live_t *live, int columns, int rows) {
  cli_canvas_clear(&live->left, columns, rows, live->g, live->h);
  cli_canvas_clear(&live->right, columns, rows, live->r, live->omega);
  for (uint64_t back = BUCKETS; back > 0; back--) {
    const bucket_t *bucket = bucket_at(live, back - 1);
    if (bucket != NULL) {
      plot_dot(live, &bucket->last, bucket->last.mode);
    }
  }
  plot_dot(live, &live->last, CLI_INK_NOW);
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

static void add_lane(const cli_live_t *live, unsigned lane, int columns,
                     cli_buffer_t *text) {
  const cli_pen_t *pen = &live->screen.pen;
  char mark[2] = {cli_pen_mark(lane), '\0'};
  char label[LABEL + 1];
  (void)snprintf(label, sizeof label, "%-*s", LABEL,
                 lane < TF_MODES ? tf_mode_name(lane) : "ambiguous");
  cli_add(text, label);
  cli_pen_colour(pen, lane < TF_MODES ? lane + 1 : 0, text);
  for (int i = 0; i < columns; i++) {
    const bool there = (modes_in(live, i, columns) >> lane & 1u) != 0;
    cli_add(text, !there      ? " "
                  : pen->utf8 ? "\xe2\x96\x85" // a lower block
                              : mark);
  }
  cli_pen_colour(pen, 0, text);
}

// A line of plain text, cut off at the edge.
static void add_cut(const char *line, int columns, cli_buffer_t *text) {
  char cut[CLI_CANVAS_COLUMNS + 1];
  const int room = columns < CLI_CANVAS_COLUMNS ? columns : CLI_CANVAS_COLUMNS;
  (void)snprintf(cut, (size_t)room + 1, "%s", line);
  cli_add(text, cut);
}

static void add_planes(cli_live_t *live, int columns, int rows,
                       const char *newline, cli_buffer_t *text) {
  const cli_pen_t *pen = &live->screen.pen;
  const char *border = pen->utf8 ? "\xe2\x94\x82" : "|"; // a vertical line
  const int width = columns / 2 - 1;
  char left[128], right[128], line[256];
  plot(live, width, rows);
  (void)snprintf(left, sizeof left, "h %.2g..%.2g, g %.2g..%.2g", live->h.low,
                 live->h.high, live->g.low, live->g.high);
  (void)snprintf(right, sizeof right, "omega %.3g..%.3g, r %.3g..%.3g",
                 live->omega.low, live->omega.high, live->r.low, live->r.high);
  (void)snprintf(line, sizeof line, " %-*.*s %s", width, width, left, right);
  add_cut(line, columns, text);
  for (int row = 0; row < live->left.rows; row++) {
    cli_add(text, newline);
    cli_add(text, border);
    cli_canvas_row(&live->left, row, pen, text);
    cli_add(text, border);
    cli_canvas_row(&live->right, row, pen, text);
  }
}

static void add_scale(const cli_live_t *live, int columns, cli_buffer_t *text) {
  const double end = fmax(live->span, live->last.t);
  char low[32], high[32], line[512];
  (void)snprintf(low, sizeof low, "%.4g", end - live->span);
  (void)snprintf(high, sizeof high, "%.4g s", end);
  (void)snprintf(line, sizeof line, "%-*s%-*s%s", LABEL, "t",
                 columns - LABEL - (int)strlen(high), low, high);
  add_cut(line, columns, text);
}

static void add_state(const cli_live_t *live, int columns, cli_buffer_t *text) {
  const cli_live_point_t *at = &live->last;
  char line[256];
  (void)snprintf(line, sizeof line,
                 "t = %.4f s  %-6s  %u possible  r=%.3g omega=%.3g h=%.3g "
                 "g=%.3g v=%.3g",
                 at->t, tf_mode_name(at->mode), at->choices, at->r, at->omega,
                 at->h, at->g, at->v);
  add_cut(line, columns, text);
}

// Everything, line by line.
static void compose(cli_live_t *live, const char *title, const char *newline,
                    cli_buffer_t *text) {
  const int columns = live->screen.columns < 2 * CLI_CANVAS_COLUMNS
                          ? live->screen.columns
                          : 2 * CLI_CANVAS_COLUMNS;
  const int rows = live->screen.rows;
  const char *last = strrchr(live->said, '\n');
  add_cut(title, columns, text);
  cli_add(text, newline);
  add_state(live, columns, text);
  cli_add(text, newline);
  if (columns < MIN_COLUMNS || rows < MIN_ROWS || live->newest == 0) {
    char line[64];
    (void)snprintf(line, sizeof line, "(the planes need %d x %d)", MIN_COLUMNS,
                   MIN_ROWS);
    add_cut(live->newest == 0 ? "(nothing yet)" : line, columns, text);
    return;
  }
  fit_all(live);
  add_planes(live, columns, rows - HEAD - 1 - (int)LANES - FOOT, newline, text);
  cli_add(text, newline);
  for (unsigned lane = 0; lane < LANES; lane++) {
    add_lane(live, lane, columns - LABEL, text);
    cli_add(text, newline);
  }
  add_scale(live, columns, text);
  if (live->said[0] != '\0') {
    cli_add(text, newline);
  }
  add_cut(last != NULL ? last + 1 : live->said, columns, text);
}

bool cli_live_due(const cli_live_t *live, double now) {
  return live != NULL && now >= live->next;
}

void cli_live_draw(cli_live_t *live, const char *title, double now) {
  cli_buffer_t text = {live->drawing, 0, sizeof live->drawing, false};
  live->next = now + DRAW_EVERY;
  cli_screen_measure(&live->screen);
  cli_add(&text, cli_screen_start(&live->screen));
  compose(live, title, CLI_SCREEN_LINE, &text);
  cli_add(&text, CLI_SCREEN_END);
  cli_screen_show(live->drawing);
}

void cli_live_close(cli_live_t *live, const char *title) {
  if (live == NULL) {
    return;
  }
  cli_buffer_t text = {live->drawing, 0, sizeof live->drawing, false};
  cli_message_divert(NULL, 0);
  cli_screen_measure(&live->screen);
  live->screen.rows--; // the line of the prompt that follows
  compose(live, title, "\n", &text);
  cli_add(&text, "\n");
  cli_screen_close(live->drawing);
  for (char *line = strtok(live->said, "\n"); line != NULL;
       line = strtok(NULL, "\n")) {
    (void)cli_message(CLI_DONE, "%s", line);
  }
}
