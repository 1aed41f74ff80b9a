// All motions that can follow a state, as a graph bounded by depth and count.
//
// A node is a state with several consistent modes: the two-fold, a point with
// h = g = 0, or a start that was typed. A branch leaves a node and ends at
// another one, or elsewhere. From h = g = 0 one branch leaves in each mode of
// the set. An escaping stick can be left at any time and to either side; it is
// left at multiples of the grid, as long as the stick lasts. Branches that end
// at the same node join: there is only one two-fold, and two points with
// h = g = 0 are the same if their r agree to within JOIN. Nodes are visited in
// the order in which they were found (breadth first), so depth is the least
// number of branches from the start.

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "../host/host.h"
#include "../host/output.h"
#include "../text/summary.h"
#include "../text/text.h"
#include "diverge.h"

#define JOIN 1e-6 // [m]
#define ROW_ROOM 512

typedef struct {
  tf_state_t state;
  unsigned set;
  uint64_t depth;
  bool two_fold;
} node_t;

typedef struct {
  const cli_job_t *job;
  cli_output_t output;
  node_t *nodes; ///< args->nodes of them at most
  uint64_t used, branches, joined, dropped;
  cli_motion_t motion;
  uint64_t visited; ///< nodes whose branches have all been followed
  double part;      ///< of the present one, by the times at which it is left
  cli_progress_t progress;
} search_t;

// What is left is that of the known nodes: branches may lead to further ones.
static void show_progress(search_t *search) {
  const double now = cli_now();
  uint64_t open = 0;
  if (!cli_progress_due(&search->progress, now)) {
    return;
  }
  for (uint64_t i = search->visited; i < search->used; i++) {
    open += search->nodes[i].depth < search->job->args->depth;
  }
  const double done = (double)search->visited + search->part;
  cli_progress_say(
      &search->progress, now, done / ((double)search->visited + (double)open),
      "%" PRIu64 " branches, %" PRIu64 " of %" PRIu64 " known nodes are done",
      search->branches, search->visited, search->used);
}

static const char header[] =
    "node,depth,kind,r,omega,mode,stick_time,exit_r,exit_omega,end,to,time,"
    "end_r,landing_r,windings\n";

// Index of a node, which may be known or new; UINT64_MAX if there is no room
// for a new one.
static uint64_t node_at(search_t *search, const node_t *node) {
  for (uint64_t i = 0; i < search->used; i++) {
    const node_t *known = &search->nodes[i];
    const bool same =
        node->two_fold
            ? known->two_fold
            : !known->two_fold && known->state.mode == node->state.mode &&
                  fabs((double)known->state.r - (double)node->state.r) < JOIN;
    if (same) {
      search->joined++;
      return i;
    }
  }
  if (search->used == search->job->args->nodes) {
    search->dropped++;
    return UINT64_MAX;
  }
  search->nodes[search->used] = *node;
  return search->used++;
}

// Follows one branch from the state that the motion was put into.
static void follow(search_t *search, const node_t *from, uint64_t index,
                   unsigned mode, double stick_time) {
  cli_motion_t *motion = &search->motion;
  char row[ROW_ROOM];
  char to[CLI_REAL_ROOM] = "";
  node_t next = {.depth = from->depth + 1};
  const tf_state_t left = motion->state;
  const cli_branch_t end = cli_random_branch(motion, mode, &next.set);
  static const char *const names[] = {"two-fold", "codim2", "escaping",
                                      "unfinished"};
  const bool rests = end == CLI_BRANCH_TIME && motion->tracker.last.rests;
  uint64_t found = UINT64_MAX;
  next.state = motion->state;
  next.two_fold = end == CLI_BRANCH_TWO_FOLD;
  if (next.two_fold || end == CLI_BRANCH_CODIM2) {
    found = node_at(search, &next);
  }
  if (found != UINT64_MAX) {
    (void)snprintf(to, sizeof to, "%" PRIu64, found);
  }
  const cli_cycle_t *cycle = &motion->tracker.cycle;
  char landing[CLI_REAL_ROOM] = "";
  if (cycle->landed) {
    (void)snprintf(landing, sizeof landing, "%.12g", cycle->land_r);
  }
  const int length = snprintf(
      row, sizeof row,
      "%" PRIu64 ",%" PRIu64
      ",%s,%.12g,%.12g,%s,%.6g,%.12g,%.12g,%s,%s,%.9g,"
      "%.12g,%s,%" PRIu64 "\n",
      index, from->depth, from->two_fold ? "two-fold" : "codim2",
      (double)from->state.r, (double)from->state.w, tf_mode_name(mode),
      stick_time, (double)left.r, (double)left.w, rests ? "rest" : names[end],
      to, motion->t, (double)motion->state.r, landing, cycle->windings);
  search->branches++;
  show_progress(search);
  (void)cli_output_lines(&search->output, row, (size_t)length);
}

static bool has_to_stop(const search_t *search) {
  return search->output.error != 0 || cli_stop_asked();
}

// All branches that leave the canard.
static void leave_two_fold(search_t *search, const node_t *node,
                           uint64_t index) {
  const cli_job_t *job = search->job;
  double reached = 0;
  for (uint64_t i = 1; !has_to_stop(search); i++) {
    const double t = (double)i * job->args->grid;
    cli_point_t at;
    if (t > job->args->patience ||
        !cli_canard_after(&job->canard, t, &at, &reached)) {
      break;
    }
    search->part = t / job->args->patience;
    for (unsigned mode = TF_SLIP_PLUS; mode <= TF_SLIP_MINUS; mode++) {
      search->motion.state = cli_state_at(&job->wide, at);
      follow(search, node, index, mode, t);
    }
  }
}

static void leave_codim2(search_t *search, const node_t *node, uint64_t index) {
  for (unsigned mode = 0; mode < TF_MODES; mode++) {
    if ((node->set & TF_MODE_BIT(mode)) != 0 && !has_to_stop(search)) {
      search->motion.state = node->state;
      follow(search, node, index, mode, 0);
    }
  }
}

static void visit_all(search_t *search) {
  const cli_job_t *job = search->job;
  cli_motion_begin(&search->motion, job, 0);
  const node_t first = {.state = search->motion.state,
                        .set = job->setup.report.set,
                        .two_fold = job->at_two_fold};
  (void)node_at(search, &first);
  search->progress =
      cli_progress_start(cli_now(), search->output.to.descriptor);
  for (uint64_t i = 0; i < search->used && !has_to_stop(search); i++) {
    search->visited = i;
    search->part = 0;
    const node_t node = search->nodes[i];
    if (node.depth >= job->args->depth) {
      continue;
    }
    if (node.two_fold) {
      leave_two_fold(search, &node, i);
    } else {
      leave_codim2(search, &node, i);
    }
  }
  cli_progress_clear(&search->progress);
}

static void summarise(const search_t *search, int code) {
  if (search->job->args->summary != 0) {
    cli_put_begin("diverge --exhaustive");
    cli_put_word("scene", search->job->setup.scene->name);
    cli_put_count("nodes", search->used);
    cli_put_count("branches", search->branches);
    cli_put_count("joined", search->joined);
    cli_put_count("dropped", search->dropped);
    cli_put_end(cli_now() - search->progress.started, code);
    return;
  }
  cli_say("nodes      %" PRIu64 "\nbranches   %" PRIu64 ", of which %" PRIu64
          " joined a known node, %" PRIu64 " found no room (--count)\n",
          search->used, search->branches, search->joined, search->dropped);
}

int cli_exhaustive(const cli_job_t *job) {
  static search_t search;
  search.job = job;
  search.nodes = calloc((size_t)job->args->nodes, sizeof *search.nodes);
  if (search.nodes == NULL) {
    return cli_message(CLI_STOPPED, "out of memory");
  }
  int code = cli_output_begin(&search.output, "--branches", job->args->branches,
                              false);
  if (code == CLI_DONE) {
    if (job->args->provenance) {
      char lines[CLI_PROVENANCE_ROOM];
      const size_t length = cli_job_provenance(
          job,
          "r m, omega rad/s, stick_time s, exit_r m, exit_omega rad/s, time s, "
          "end_r m, landing_r m",
          lines);
      (void)cli_output_lines(&search.output, lines, length);
    }
    (void)cli_output_lines(&search.output, header, sizeof header - 1);
    visit_all(&search);
    if (cli_stop_asked()) {
      code = cli_message(CLI_STOPPED,
                         "stopped by a signal; the branches that "
                         "have ended are written");
    }
    code = cli_output_end(&search.output, code);
    summarise(&search, code);
  }
  free(search.nodes);
  return code;
}
