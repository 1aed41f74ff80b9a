/// A motion as it goes on, in a terminal: the planes (g, h) and (r, omega), and
/// the modes over time. Every function takes NULL for "not asked for".
#pragma once

#include "../run/row.h"

typedef struct cli_live cli_live_t;

/// Takes the terminal at standard output over; messages are shown in it from
/// then on, and printed at the end. span: in, the time that is kept [s]: all of
/// a run that ends, or the last seconds of one that does not.
/// Returns: NULL after a message where there is no such terminal.
cli_live_t *cli_live_open(double span);

/// Shows an instant. Its time does not decrease, except where a new motion
/// begins.
void cli_live_note(cli_live_t *live, const cli_csv_t *at);

/// Draws, ten times a second at most. title: in, the first line. now: in,
/// cli_now().
void cli_live_draw(cli_live_t *live, const char *title, double now);

/// Gives the terminal back, leaves the last picture in it.
void cli_live_close(cli_live_t *live, const char *title);
