// The futures of a place, all of them as far as depth and count allow.
//
// A node is a place with more than one future; an edge is one way off it and
// what that leads to. Nodes are the two-fold, h = g = 0 with more than one
// consistent mode, and a start that was typed. Off h = g = 0 leads each mode
// of the set. Off an open stick leads a continuum: slip to either side after
// any time; it is followed at multiples of the grid, as long as the stick
// lasts. Edges that end at the same node merge: every way to the two-fold ends
// at the one two-fold, and two places at h = g = 0 are the same where their r
// agree to `JOIN`. Nodes are visited in the order in which they were found, so
// that depth is the least number of edges from the start.

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "diverge.h"
#include "text.h"

#define JOIN 1e-6 // [m]

typedef struct {
  tf_state_t state;
  unsigned set;
  uint64_t depth;
  bool twofold;
} node_t;

typedef struct {
  const cli_job_t *job;
  cli_output_t *output;
  node_t *nodes; ///< args->count of them at most
  uint64_t used, edges, joined, cut;
  cli_mover_t mover;
  cli_tracker_t tracker;
  bool unwritten;
} search_t;

static const char header[] =
    "node,depth,kind,r,omega,mode,stick_time,exit_r,exit_omega,end,to,time,"
    "end_r,landing_r,windings\n";

// The node of a place: one that is known, or a new one, or UINT64_MAX where
// there is no room.
static uint64_t node_at(search_t *search, const node_t *node) {
  for (uint64_t i = 0; i < search->used; i++) {
    const node_t *known = &search->nodes[i];
    const bool same =
        node->twofold
            ? known->twofold
            : !known->twofold && known->state.mode == node->state.mode &&
                  fabs((double)known->state.r - (double)node->state.r) < JOIN;
    if (same) {
      search->joined++;
      return i;
    }
  }
  if (search->used == search->job->args->count) {
    search->cut++;
    return UINT64_MAX;
  }
  search->nodes[search->used] = *node;
  return search->used++;
}

// One edge, followed from where the mover was put.
static void follow(search_t *search, const node_t *from, uint64_t index,
                   unsigned mode, double stick_time) {
  cli_mover_t *mover = &search->mover;
  char row[CLI_DIVERGE_ROW];
  char to[CLI_REAL_ROOM] = "";
  node_t next = {.depth = from->depth + 1};
  search->tracker = cli_tracker_of(search->job);
  const tf_state_t left = mover->state;
  const cli_branch_t end = cli_random_branch(mover, mode, &next.set);
  const char *name = "unfinished";
  uint64_t found = UINT64_MAX;
  next.state = mover->state;
  if (end == CLI_BRANCH_TWOFOLD) {
    name = "two-fold";
    next.twofold = true;
    found = node_at(search, &next);
  } else if (end == CLI_BRANCH_CORNER) {
    name = "corner";
    found = node_at(search, &next);
  } else if (end == CLI_BRANCH_ESCAPING) {
    name = "escaping";
  } else if (mover->state.mode == TF_PINNED) {
    name = "pinned";
  }
  if (found != UINT64_MAX) {
    (void)snprintf(to, sizeof to, "%" PRIu64, found);
  }
  const cli_cycle_t *cycle = &search->tracker.cycle;
  char landing[CLI_REAL_ROOM] = "";
  if (cycle->landed) {
    (void)snprintf(landing, sizeof landing, "%.12g", cycle->land_r);
  }
  const int length =
      snprintf(row, sizeof row,
               "%" PRIu64 ",%" PRIu64
               ",%s,%.12g,%.12g,%s,%.6g,%.12g,%.12g,%s,%s,%.9g,"
               "%.12g,%s,%" PRIu64 "\n",
               index, from->depth, from->twofold ? "two-fold" : "corner",
               (double)from->state.r, (double)from->state.w, tf_mode_name(mode),
               stick_time, (double)left.r, (double)left.w, name, to, mover->t,
               (double)mover->state.r, landing, cycle->windings);
  search->edges++;
  if (!cli_output_lines(search->output, row, (size_t)length)) {
    search->unwritten = true;
  }
}

// All ways off the stick through the two-fold.
static void off_twofold(search_t *search, const node_t *node, uint64_t index) {
  const cli_job_t *job = search->job;
  double reached = 0;
  for (uint64_t i = 1; !search->unwritten && !cli_stop_asked(); i++) {
    const double t = (double)i * job->args->grid;
    cli_place_t at;
    if (t > job->args->patience ||
        !cli_stick_after(&job->stick, t, &at, &reached)) {
      break;
    }
    for (unsigned mode = TF_SLIP_PLUS; mode <= TF_SLIP_MINUS; mode++) {
      search->mover.state = cli_place_state(&job->stay, at);
      follow(search, node, index, mode, t);
    }
  }
}

static void off_place(search_t *search, const node_t *node, uint64_t index) {
  for (unsigned mode = 0; mode < TF_MODES; mode++) {
    if ((node->set & TF_MODE_BIT(mode)) != 0 && !search->unwritten &&
        !cli_stop_asked()) {
      search->mover.state = node->state;
      follow(search, node, index, mode, 0);
    }
  }
}

static int visit_all(search_t *search) {
  const cli_job_t *job = search->job;
  node_t first = {.set = 0, .twofold = job->at_twofold};
  if (job->at_twofold) {
    first.state = cli_place_state(
        &job->stay, cli_on_surface(&job->stay, job->stick.r, job->stick.z));
  } else {
    first.state = job->setup.state;
    first.set = job->setup.report.set;
  }
  search->mover.job = job;
  search->mover.tracker = &search->tracker;
  search->mover.far = job->stay;
  (void)node_at(search, &first);
  for (uint64_t i = 0; i < search->used; i++) {
    const node_t node = search->nodes[i];
    if (search->unwritten || cli_stop_asked()) {
      break;
    }
    if (node.depth >= job->args->depth) {
      continue;
    }
    if (node.twofold) {
      off_twofold(search, &node, i);
    } else {
      off_place(search, &node, i);
    }
  }
  (void)fprintf(stderr,
                "nodes      %" PRIu64 "\nbranches   %" PRIu64
                ", of which %" PRIu64 " joined a known node, %" PRIu64
                " found no room (--count)\n",
                search->used, search->edges, search->joined, search->cut);
  return CLI_DONE;
}

int cli_diverge_exhaust(const cli_job_t *job) {
  search_t search = {.job = job};
  cli_output_t *output = calloc(1, sizeof *output);
  search.output = output;
  search.nodes = calloc((size_t)job->args->count, sizeof *search.nodes);
  int code = CLI_DONE;
  if (output == NULL || search.nodes == NULL) {
    code = cli_complain(CLI_STOPPED, "out of memory");
  } else if (!cli_output_open(output, job->args->branches)) {
    code = cli_complain(CLI_STOPPED, "--branches %s: cannot be written: %s",
                        job->args->branches, cli_output_reason(output));
  } else {
    cli_catch_signals();
    (void)cli_output_lines(output, header, sizeof header - 1);
    code = visit_all(&search);
    const int closed = cli_output_end(output);
    if (closed != CLI_DONE) {
      code = closed;
    } else if (cli_stop_asked()) {
      code = cli_complain(CLI_STOPPED,
                          "stopped by a signal; the branches that "
                          "have ended are written");
    }
  }
  free(search.nodes);
  free(output);
  return code;
}
