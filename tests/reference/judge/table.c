/// `reference table`: of each class of machines, how many runs of the library
/// end far from the reference with every step OK. The reference follows the
/// inputs of the steps, from event to event; where it is not sure
/// of its own end it says so, and the machine is not counted.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "judge.h"

enum { KNOTS = 4000, DRAWS = 200, SHOWN = 6 };

// What is wrong: row_difference of an end; of the located step in double.
static const double off = 0.02, off_located = 1e-6;

// How far the end of the reference may move when its start moves by `beside`,
// for a judgement in double, in float, and of the located step.
static const double beside = 1e-9, sure = 1e-3, sure_f32 = 5e-5, sharp = 2e-7;

// As the library numbers them.
static const ref_rest_t rest_laws[] = {REF_HEXAGON, REF_SQUARE, REF_BOW_TIE};

// What is counted of a kind of run, and of a row.
enum { TRIED, THROUGH, SILENT, SILENT_THROUGH, TOLD, FLAGGED, REFUSED };
enum { PARTED = REFUSED + 1, KINDS };
enum { JUDGED, DRAWN, SEVERAL, BORDER, STOPPED, CASES };

typedef struct {
  long n[KINDS], shown[SHOWN]; // first machines that are silently wrong
  double log_error, measured;  // sum over the runs that were not refused
} tally_t;

typedef struct {
  long n[CASES];
  tally_t tally[ROW_STEPS][ROW_MODELS];
} row_count_t;

// Largest difference of r [m], v [m/s], w [rad/s], each against its own size or
// that of the machine.
static double row_difference(const ref_machine_t *q, ref_state_t x,
                             const lib_row_t *row) {
  const real_t w = ref_w(q, x), v = ref_v(q, x);
  const real_t scale = ref_speed_scale(q, x);
  const real_t in_r = fabsl(x.r - row->r) / (fabsl(x.r) + q->beta);
  const real_t in_v = fabsl(v - row->v) / (fabsl(v) + scale);
  const real_t in_w = fabsl(w - row->w) / (fabsl(w) + fabsl(q->omega0));
  const real_t e = fmaxl(in_r, fmaxl(in_v, in_w));
  return e >= 0 ? (double)e : HUGE_VAL;
}

static double state_difference(const ref_machine_t *q, ref_state_t a,
                               ref_state_t b) {
  const lib_row_t row = {(double)b.r, (double)ref_v(q, b), (double)ref_w(q, b)};
  return row_difference(q, a, &row);
}

static bool watches_ties(const ref_consistent_t *f, const ref_way_t *taken) {
  for (int i = 0; i < f->count; ++i) {
    const ref_way_t *way = &f->list[i];
    const bool alike =
        (way->mode > REF_SLIP_MINUS) == (taken->mode > REF_SLIP_MINUS) &&
        way->attracting == taken->attracting;
    if (way != taken && alike &&
        fabsl(way->rate - taken->rate) < 0.01L * taken->rate)
      return true;
  }
  return false;
}

static void on_event(const ref_orbit_t *orbit, ref_event_t event) {
  met_t *met = orbit->context;
  const ref_consistent_t *f = &orbit->consistent;
  if (event == REF_ENTERS) met->stick_since = orbit->x.t;
  if (event == REF_CODIM2) {
    const ref_way_t *taken =
        orbit->chosen >= 0 ? &f->list[orbit->chosen] : NULL;
    ++met->through;
    if (orbit->arrived >= REF_STICK_PLUS && met->stick_since >= 0)
      met->stuck = fmin(met->stuck, (double)(orbit->at.t - met->stick_since));
    met->several |= taken && (!taken->attracting || watches_ties(f, taken));
    met->left_rest |= orbit->arrived == REF_PINNED;
  }
  // A wheel along the slot has A = N = 0 on the axis: rounding decides there.
  met->several |= event == REF_LEAVES && fabsl(orbit->x.r) < 1e-6L;
  if (event != REF_ENTERS) met->stick_since = -1;
  met->rested |= orbit->mode == REF_PINNED;
  ++met->events;
}

// The end of the reference from a start moved by a share of its size. One that
// is moved has another tolerance: its distance shows how sure the reference is.
static ref_stop_t follow(const lib_machine_t *machine, const ref_machine_t *q,
                         ref_mode_t mode, double share, double end, met_t *met,
                         ref_state_t *x) {
  ref_orbit_t orbit = {.tolerance = share != 0 ? 1e-12L : 1e-11L,
                       .law = rest_laws[machine->rest],
                       .limit = 3000000,
                       .watch = on_event,
                       .context = met};
  *met = (met_t){.stuck = HUGE_VAL, .stick_since = -1};
  ref_state_t start = draw_start(machine, q);
  start.r *= 1 + (real_t)share;
  if (!machine->on_surface) {
    start.p *= 1 + (real_t)share;
    start.z *= 1 - (real_t)share;
  } else if (share != 0) {
    start = ref_on_surface(q, start);
  }
  ref_begin(&orbit, q, start, mode);
  met->began = orbit.mode;
  met->rested = orbit.mode == REF_PINNED;
  const ref_stop_t stop = ref_run(&orbit, (real_t)end);
  met->passed_r = (orbit.x.r < 0) != (machine->r < 0);
  *x = orbit.x;
  return stop;
}

// A wheel put on the turntable that does not stay there, which is most of them.
static bool slides_off(const lib_machine_t *machine, const ref_machine_t *q) {
  met_t met;
  ref_state_t x;
  follow(machine, q, REF_MODES, 0, 0, &met, &x);
  return machine->v == 0 && machine->omega == machine->omega0 && !met.rested;
}

typedef struct {
  const row_t *row;
  lib_machine_t machine;
  ref_machine_t q;
  ref_state_t end;
  met_t met;
  double moved; // of the end, by a start moved by `beside`
} case_t;

// Draws machine `index` of a row until one belongs to it and the reference is
// sure of it.
static bool draw_case(const row_t *row, uint64_t seed, long index,
                      row_count_t *count, case_t *c) {
  const uint64_t key = (uint64_t)(row - rows + 1) << 48;
  draw_t draw = draw_begin(seed, key + (uint64_t)index);
  for (int i = 0; i < DRAWS; ++i) {
    c->row = row;
    c->machine = row_machine(&draw, row, index % 2 != 0);
    c->q = draw_reference(&c->machine);
    met_t met;
    ref_state_t other;
    ++count->n[DRAWN];
    if (row->rests && slides_off(&c->machine, &c->q)) continue;
    const ref_stop_t stop =
        follow(&c->machine, &c->q, REF_MODES, 0, row->t_end, &c->met, &c->end);
    if (row->takes && !row->takes(&c->met)) continue;
    const bool reached =
        stop == REF_REACHED && follow(&c->machine, &c->q, REF_MODES, beside,
                                      row->t_end, &met, &other) == REF_REACHED;
    c->moved = reached ? state_difference(&c->q, c->end, other) : HUGE_VAL;
    const int is = stop != REF_REACHED ? STOPPED
                   : c->met.several    ? SEVERAL
                   : c->moved < sure   ? JUDGED
                                       : BORDER;
    ++count->n[is];
    if (is == JUDGED) return true;
  }
  return false;
}

// The end under the inputs of steps of machine.dt; false where the reference
// does not come to it, has several, or is not sure of it.
static bool driven_end(const case_t *c, ref_state_t *end) {
  static ref_knot_t table[KNOTS];
  const lib_machine_t *machine = &c->machine;
  lib_machine_t started = *machine;
  const long steps = lround(c->row->t_end / machine->dt);
  const int knots =
      machine->knots > 0 ? moving_table(machine, steps, table, KNOTS) : 0;
  *end = c->end;
  if (knots == 0) return true;
  ref_machine_t q = c->q;
  q.knots = knots;
  q.table = table;
  q.swing = 0;
  // Where the first step begins at another omega0 than the start, h is not 0.
  ref_machine_t begun = c->q;
  begun.knots = 0;
  begun.omega0 = moving_input(machine, 0, 0).omega0;
  if (machine->on_surface && fabsl(table[0].omega0 - begun.omega0) > 1e-12L) {
    const ref_state_t start = draw_start(machine, &begun);
    started.v = (double)ref_v(&begun, start);
    started.on_surface = false;
  }
  met_t met;
  ref_state_t x, other;
  const double time = c->row->t_end;
  const ref_mode_t mode = c->met.began;
  if (follow(&started, &q, mode, beside, time, &met, &other) != REF_REACHED ||
      follow(&started, &q, mode, 0, time, &met, &x) != REF_REACHED)
    return false;
  end->r = x.r;
  end->z += ref_w(&q, x) - ref_w(&c->q, c->end);
  end->p = ref_v(&q, x) - q.d * end->z;
  return !met.several && state_difference(&q, x, other) < sure;
}

static void tally(tally_t *t, const case_t *c, long index, int outcome,
                  bool wrong, bool parts, double error) {
  const bool through = c->met.through > 0, silent = outcome == 0 && wrong;
  const bool is[KINDS] = {true,
                          through,
                          silent,
                          silent && through,
                          outcome > 0 && wrong,
                          outcome > 0 && !wrong,
                          outcome < 0,
                          parts};
  if (silent && t->n[SILENT] < SHOWN) t->shown[t->n[SILENT]] = index;
  for (int i = 0; i < KINDS; ++i) t->n[i] += is[i];
  if (error < HUGE_VAL) {
    t->log_error += log10(fmax(error, 1e-16));
    ++t->measured;
  }
}

static void show(const case_t *c, const model_t *model, double dt, int outcome,
                 double error, const ref_state_t *end, const lib_row_t *at) {
  const ref_machine_t *q = &c->q;
  printf(
      "  %-11s %-6s %-7.1g %-7s off by %.2e: r %.9g v %.9g w %.9g, "
      "reference %.9Lg %.9Lg %.9Lg\n",
      lib_scheme_names[model->scheme], model->real->name, dt,
      outcome < 0    ? "refused"
      : outcome == 0 ? "OK"
                     : "flagged",
      error, at->r, at->v, at->w, end->r, ref_v(q, *end), ref_w(q, *end));
}

// The reference's end for steps of machine.dt.
typedef struct {
  double dt;
  bool known;
  ref_state_t end;
} driven_t;

static const driven_t *driven_by(const case_t *c, driven_t *driven) {
  while (driven->dt != 0 && driven->dt != c->machine.dt) ++driven;
  if (driven->dt == 0) {
    driven->dt = c->machine.dt;
    driven->known = driven_end(c, &driven->end);
  }
  return driven;
}

static double dt_of(const row_t *row, const model_t *model, double step) {
  return model->scheme == LIB_LOCATED ? step * row->located : step;
}

// Whether a run belongs to the row, and the reference is sure enough for it.
static bool judges(const case_t *c, const model_t *model, double step) {
  const bool located = model->scheme == LIB_LOCATED;
  const bool f64 = model->real == &lib_f64;
  if (step == 0 || (c->row->plain && model->scheme != LIB_STEP && f64) ||
      ((located || model->scheme == LIB_LANES) && step < c->row->least))
    return false;
  return c->moved < (!f64 ? sure_f32 : located ? sharp : sure);
}

// One machine through all runs of its row.
static void judge_case(case_t *c, const double *steps, const options_t *options,
                       long index, row_count_t *count) {
  const row_t *row = c->row;
  double before[ROW_MODELS] = {0};
  driven_t driven[2 * ROW_STEPS + 1] = {{.dt = 0}};
  for (int i = 0; i < ROW_STEPS * ROW_MODELS; ++i) {
    const int k = i / ROW_MODELS, m = i % ROW_MODELS;
    const model_t *model = &row_models[m];
    if (!judges(c, model, steps[k])) continue;
    c->machine.dt = dt_of(row, model, steps[k]);
    const driven_t *ref = driven_by(c, driven);
    if (!ref->known) continue;
    lib_row_t at = {0, 0, 0};
    bool parts;
    const int outcome =
        model->real->run(&c->machine, model->scheme, row->t_end, &at, &parts);
    const double error =
        outcome < 0 ? HUGE_VAL : row_difference(&c->q, ref->end, &at);
    const bool sharply =
        model->scheme == LIB_LOCATED && model->real == &lib_f64;
    bool wrong = error > (sharply ? off_located : off);
    if (row->order && model->scheme != LIB_LOCATED) {
      const double fall = k > 0 ? pow(steps[k] / steps[k - 1], 1.5) : 1;
      wrong = k > 0 && error > 256 * model->real->epsilon &&
              error > fall * before[m];
      before[m] = error;
    }
    tally(&count->tally[k][m], c, index, outcome, wrong, parts, error);
    if (options->machines == 1)
      show(c, model, c->machine.dt, outcome, error, &ref->end, &at);
  }
}

static void judge_row(const row_t *row, const double *steps,
                      const options_t *options, row_count_t *count) {
  for (long i = 0; i < options->machines; ++i) {
    const long index = options->first + i;
    case_t c;
    if (!draw_case(row, options->seed, index, count, &c)) continue;
    if (options->machines == 1) {
      draw_print(&c.machine, row->t_end, "SCHEME");
      printf(
          "  sine %.9g rad/s, %.9g rad/s; law of rest %d; a start moved by "
          "%.0e ends %.1e apart; h = g = 0 %d times\n",
          c.machine.swing, c.machine.swing_rate, c.machine.rest, beside,
          c.moved, c.met.through);
    }
    judge_case(&c, steps, options, index, count);
  }
}

static void print_row(const row_t *row, const double *steps,
                      const options_t *options, const row_count_t *count) {
  const long *n = count->n;
  printf("%s. %s: %ld judged of %ld drawn; not judged: %ld several futures, ",
         row->name, row->about, n[JUDGED], n[DRAWN], n[SEVERAL]);
  printf("%ld near a border, %ld without an end\n", n[BORDER], n[STOPPED]);
  for (int i = 0; i < ROW_STEPS * ROW_MODELS; ++i) {
    const int k = i % ROW_STEPS, m = i / ROW_STEPS;
    const model_t *model = &row_models[m];
    const tally_t *t = &count->tally[k][m];
    if (t->n[TRIED] == 0) continue;
    printf("  %-3s %-11s %-6s %6.0e", row->name,
           lib_scheme_names[model->scheme], model->real->name,
           dt_of(row, model, steps[k]));
    for (int j = 0; j < KINDS; ++j) printf(" %7ld", t->n[j]);
    printf(" %8.1e", pow(10, t->log_error / fmax(1, t->measured)));
    for (long j = 0; j < t->n[SILENT] && j < SHOWN && j < options->show; ++j)
      printf("%s%ld", j ? "," : "  first ", t->shown[j]);
    printf("\n");
  }
}

static int run(const options_t *options) {
  bool known = false;
  printf(
      "silent: all steps OK and more than 2 %% off (located in double 1e-6; "
      "A': "
      "order below 1.5)\n"
      "  row scheme      real       dt   tried through  silent through "
      "flagged flagged refused  parted  mean of\n%62s wrong   right %23s\n",
      "", "error");
  for (int i = 0; i < ROWS; ++i) {
    if (strcmp(options->row, "all") == 0 ||
        strcmp(options->row, rows[i].name) == 0) {
      row_count_t count = {.n = {0}};
      double steps[ROW_STEPS];
      memcpy(steps, rows[i].dt, sizeof steps);
      const char *text = options->dts;
      for (int k = 0; text && k < ROW_STEPS; ++k) {
        char *rest;
        steps[k] = strtod(text, &rest);
        text = *rest == ',' ? rest + 1 : rest;
      }
      known = true;
      judge_row(&rows[i], steps, options, &count);
      print_row(&rows[i], steps, options, &count);
    }
  }
  if (!known) printf("no class %s\n", options->row);
  return known ? 0 : 2;
}

const command_t command_table = {
    "table",
    "classes of machines by each scheme: silently wrong, flagged, refused", 200,
    0, run};
