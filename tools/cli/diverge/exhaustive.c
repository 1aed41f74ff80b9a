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
#include <stdlib.h>
#include <string.h>

#include "../text/summary.h"
#include "diverge.h"

#define JOIN 1e-6 // [m]

typedef struct {
  tf_state_t state;
  unsigned set;
  uint64_t depth;
  bool two_fold;
} node_t;

typedef struct {
  const cli_job_t *job;
  cli_sheets_t *sheets;
  node_t *nodes; ///< from the heap, args->nodes of them at most
  size_t room;
  uint64_t used, branches, joined, dropped;
  uint64_t visited, open; ///< nodes that are done, and that are to be left
  double part; ///< of the present one, by the times at which it is left
  cli_motion_t motion;
} search_t;

// What is left is that of the known nodes: branches may lead to further ones.
static void show_progress(search_t *search) {
  const double done = (double)search->visited + search->part;
  const double all = (double)search->visited + (double)search->open;
  cli_progress_say(&search->sheets->progress, cli_now(), done / all,
                   "%" PRIu64 " branches, %" PRIu64 " of %" PRIu64
                   " known nodes are done",
                   search->branches, search->visited, search->used);
}

static bool is_one_place(const node_t *a, const node_t *b) {
  return a->two_fold == b->two_fold &&
         (a->two_fold ||
          (a->state.mode == b->state.mode &&
           fabs((double)a->state.r - (double)b->state.r) < JOIN));
}

// Index of a node, which may be known or new; UINT64_MAX if there is no room
// for a new one.
static uint64_t node_at(search_t *search, const node_t *node) {
  for (uint64_t i = 0; i < search->used; i++) {
    if (is_one_place(node, &search->nodes[i])) {
      search->joined++;
      return i;
    }
  }
  node_t *nodes =
      search->used == search->job->args->nodes
          ? NULL
          : cli_grow(search->nodes, search->used, &search->room, sizeof *nodes);
  if (nodes == NULL) {
    search->dropped++;
    return UINT64_MAX;
  }
  search->nodes = nodes;
  search->open += node->depth < search->job->args->depth;
  search->nodes[search->used] = *node;
  return search->used++;
}

static void follow(search_t *search, uint64_t index, unsigned mode,
                   double stick_time) {
  cli_motion_t *motion = &search->motion;
  const cli_cycle_t *cycle = &motion->cycle;
  const node_t from = search->nodes[index];
  const tf_state_t left = motion->state;
  uint64_t to = UINT64_MAX;
  char row[CLI_DIVERGE_ROW];
  cli_buffer_t text = {row, 0, sizeof row, false};
  node_t next = {.depth = from.depth + 1};
  const char *end = cli_random_branch(motion, mode, &next.set);
  next.state = motion->state;
  next.two_fold = cycle->outcome == CLI_CYCLE_RETURNED;
  if (next.two_fold || strcmp(end, "codim2") == 0) to = node_at(search, &next);
  cli_add_form(&text, "%" PRIu64 ",%" PRIu64 ",%s,%g,%g,%s,%g,%g,%g,%s,", index,
               from.depth, from.two_fold ? "two-fold" : "codim2",
               (double)from.state.r, (double)from.state.w, tf_mode_name(mode),
               stick_time, (double)left.r, (double)left.w, end);
  if (to != UINT64_MAX) cli_add_count(&text, to);
  cli_add_form(&text, ",%g,%g,", motion->t, (double)motion->state.r);
  if (cycle->landings > 0) cli_add_real(&text, (tf_real_t)cycle->land_r);
  cli_add_form(&text, ",%" PRIu64 "\n", cycle->windings);
  search->branches++;
  show_progress(search);
  (void)cli_sheet_put(search->sheets->sheet, row, text.used);
}

static bool has_to_stop(const search_t *search) {
  return search->sheets->sheet->output.error != 0 || cli_stop_asked();
}

static void leave_two_fold(search_t *search, uint64_t index) {
  const cli_job_t *job = search->job;
  cli_point_t at;
  double reached = 0;
  for (uint64_t i = 1; !has_to_stop(search); i++) {
    const double t = (double)i * job->args->grid;
    if (t > job->args->patience ||
        !cli_canard_after(&job->canard, t, &at, &reached))
      break;
    search->part = t / job->args->patience;
    for (unsigned mode = TF_SLIP_PLUS; mode <= TF_SLIP_MINUS; mode++) {
      search->motion.state = cli_state_at(&job->wide, at);
      follow(search, index, mode, t);
    }
  }
}

static void visit(search_t *search, uint64_t index) {
  const node_t node = search->nodes[index];
  if (node.depth >= search->job->args->depth) return;
  if (node.two_fold) leave_two_fold(search, index);
  for (unsigned mode = 0; mode < TF_MODES && !node.two_fold; mode++) {
    if ((node.set & TF_MODE_BIT(mode)) != 0 && !has_to_stop(search)) {
      search->motion.state = node.state;
      follow(search, index, mode, 0);
    }
  }
  search->open--;
}

static void visit_all(search_t *search) {
  const cli_job_t *job = search->job;
  cli_motion_begin(&search->motion, job, 0);
  const node_t first = {.state = search->motion.state,
                        .set = job->setup.motion.report.set,
                        .two_fold = job->at_two_fold};
  (void)node_at(search, &first);
  for (; search->visited < search->used && !has_to_stop(search);
       search->visited++) {
    search->part = 0;
    visit(search, search->visited);
  }
}

int cli_exhaustive(const cli_job_t *job, cli_sheets_t *sheets) {
  static search_t search;
  search.job = job;
  search.sheets = sheets;
  visit_all(&search);
  free(search.nodes);
  int code = CLI_DONE;
  if (cli_stop_asked()) {
    code = cli_message(
        CLI_STOPPED,
        "stopped by a signal; the branches that have ended are written");
  }
  code = cli_sheets_close(sheets, code);
  if (job->args->summary != 0) {
    cli_put_begin("diverge --exhaustive");
    cli_put("'scene': %s, 'nodes': %" PRIu64 ", 'branches': %" PRIu64
            ", 'joined': %" PRIu64 ", 'dropped': %" PRIu64 ", ",
            job->setup.scene->name, search.used, search.branches, search.joined,
            search.dropped);
    cli_put_end((double)search.visited, cli_now() - sheets->progress.started,
                code);
  } else {
    cli_say("nodes      %" PRIu64 "\nbranches   %" PRIu64 ", of which %" PRIu64
            " joined a known node, %" PRIu64 " found no room (--count)\n",
            search.used, search.branches, search.joined, search.dropped);
  }
  return code;
}
