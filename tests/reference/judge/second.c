/// A second integration of the same motion, to judge the reference: the paper's
/// equations as they are printed, in (r, v, w), stepped and its events found by
/// CVODE of SUNDIALS, which others wrote. Of the reference it uses the
/// parameters and the inputs only. It ends where h = g = 0 comes near or A = 0,
/// so that it needs no theory of either, and after 500 events, which wind round
/// a two-fold. Every machine is driven, by a shape of moving.c.
#include <math.h>
#include <stdio.h>

#include "judge.h"
#include "paper.h"

// cppcheck cannot ask for headers in brackets; it looks at both ways.
#if defined(__has_include) && !defined(__cppcheck__)
#if __has_include(<cvode/cvode.h>)
#define HAS_SUNDIALS
#endif
#endif

#ifdef HAS_SUNDIALS
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

enum { ROOTS = 4, TOO_MANY = 500 };

// Slip [m/s] at which h = g = 0 is near, and difference of h' over the law at
// which A = 0 is [m/s^2]: there the motion ends.
static const real_t nearby = 1e-7L, flat = 1e-4L;

typedef struct {
  const ref_machine_t *q;
  int piece;  // of the inputs
  int mode;   // +1, -1: slip by the sign of h; 0: stick
  int sign_g; // sign of g
} phase_t;

static paper_t paper_at(const phase_t *phase, real_t t) {
  paper_t p = {PARAMETERS_OF(real_t, phase->q)};
  p.omega0 = ref_input(phase->q, t, phase->piece).omega0;
  return p;
}

// (ds1)-(ds3), with loads by the inverse mass matrix.
static void field(const phase_t *phase, real_t t, const real_t x[3], real_t F,
                  real_t M, real_t out[3]) {
  const ref_input_t u = ref_input(phase->q, t, phase->piece);
  const paper_t p = paper_at(phase, t);
  const real_t b2 = p.beta * p.beta + x[0] * x[0], D = p.m * b2;
  paper_rhs_time(&p, x, F, M, out);
  out[1] += ((b2 + p.d * p.d) * u.force + p.d * u.torque) / D;
  out[2] += (p.d * u.force + u.torque) / D;
}

// h moves with the turntable as well.
static real_t h_rate(const phase_t *phase, real_t t, const real_t x[3],
                     real_t F, real_t M) {
  const paper_t p = paper_at(phase, t);
  real_t f[3], h_x[3];
  field(phase, t, x, F, M, f);
  f[2] -= ref_input(phase->q, t, phase->piece).alpha;
  paper_h_x(&p, x, h_x);
  return h_x[0] * f[0] + h_x[1] * f[1] + h_x[2] * f[2];
}

static real_t arm(const phase_t *phase) {
  return phase->q->law == REF_COULOMB ? 0 : phase->sign_g * phase->q->kappa;
}

// h' under the force at the edge of stick on one side.
static real_t edge_rate(const phase_t *phase, real_t t, const real_t x[3],
                        int side) {
  const real_t F = side * phase->q->mu;
  return h_rate(phase, t, x, F, arm(phase) * F);
}

static void slope(const phase_t *phase, real_t t, const real_t x[3],
                  real_t out[3]) {
  const ref_machine_t *q = phase->q;
  real_t F = phase->mode * q->mu, M = 0;
  if (phase->mode == 0) {
    const real_t none = h_rate(phase, t, x, 0, 0);
    F = none / (none - h_rate(phase, t, x, 1, arm(phase)));
    M = arm(phase) * F;
  } else if (q->law != REF_COULOMB) {
    const paper_t p = paper_at(phase, t);
    const real_t h = paper_h(&p, x), g = paper_g(&p, x);
    // Behind h = 0 the force of the edge goes on, so that a trial step over it
    // has no jump in it.
    const real_t edge = phase->mode * 1e-300L;
    paper_friction(&p, phase->mode * h > 0 ? h : edge, g, &F, &M);
  }
  field(phase, t, x, F, M, out);
}

// What has to stay positive in the phase.
static void margins(const phase_t *phase, real_t t, const real_t x[3],
                    double out[ROOTS]) {
  const paper_t p = paper_at(phase, t);
  out[0] = (double)(phase->sign_g * paper_g(&p, x));
  out[1] = (double)(phase->mode * paper_h(&p, x));
  out[2] = (double)(fabsl(paper_g(&p, x)) + fabsl(paper_h(&p, x)) - nearby);
  out[3] = 1;
  if (phase->mode == 0) {
    const real_t up = edge_rate(phase, t, x, 1);
    const real_t down = edge_rate(phase, t, x, -1);
    out[3] = (double)(fabsl(down - up) - flat);
    out[1] = (double)(up < down ? -up : up);
    out[2] = (double)(up < down ? down : -down);
  }
}

// The phase after an event at x; false where h = g = 0 or A = 0 is near.
static bool next(phase_t *phase, real_t t, const real_t x[3]) {
  const paper_t p = paper_at(phase, t);
  const real_t h = paper_h(&p, x), g = paper_g(&p, x);
  if (fabsl(h) + fabsl(g) < 2 * nearby) return false;
  if (phase->mode != 0 && fabsl(g) < fabsl(h)) {
    phase->sign_g = -phase->sign_g;
    return true;
  }
  const real_t up = edge_rate(phase, t, x, 1);
  const real_t down = edge_rate(phase, t, x, -1);
  if (phase->mode == 0) {
    phase->mode = fabsl(up) < fabsl(down) ? 1 : -1;
    return down - up > 2 * flat;
  }
  phase->mode = up > 0 ? 1 : down < 0 ? -1 : 0;
  return true;
}

// The phase of a state behind a break of the inputs.
static void begin(phase_t *phase, real_t t, const real_t x[3]) {
  const paper_t p = paper_at(phase, t);
  const real_t h = paper_h(&p, x);
  phase->sign_g = paper_g(&p, x) < 0 ? -1 : 1;
  if (fabsl(h) > 1e-9L) {
    phase->mode = h > 0 ? 1 : -1;
  } else if (phase->mode == 0) {
    const real_t up = edge_rate(phase, t, x, 1);
    const real_t down = edge_rate(phase, t, x, -1);
    phase->mode = (up > 0) == (down > 0) ? (up > 0 ? 1 : -1) : 0;
  }
}

static int rhs(sunrealtype t, N_Vector y, N_Vector dy, void *phase) {
  const double *at = N_VGetArrayPointer(y);
  const real_t x[3] = {at[0], at[1], at[2]};
  real_t out[3];
  slope(phase, t, x, out);
  for (int i = 0; i < 3; ++i) N_VGetArrayPointer(dy)[i] = (double)out[i];
  return 0;
}

static int roots(sunrealtype t, N_Vector y, sunrealtype *out, void *phase) {
  const double *at = N_VGetArrayPointer(y);
  const real_t x[3] = {at[0], at[1], at[2]};
  margins(phase, t, x, out);
  return 0;
}

// Integrates from x = (r, v, w), in place, to `end` or as far as it may;
// returns the time reached and sets the number of events.
static double integrate(const ref_machine_t *q, real_t x[3], double end,
                        int *events) {
  phase_t phase = {.q = q, .mode = 1};
  double t = 0;
  SUNContext context;
  SUNContext_Create(NULL, &context);
  N_Vector y = N_VNew_Serial(3, context);
  double *at = N_VGetArrayPointer(y);
  void *cvode = CVodeCreate(CV_ADAMS, context);
  SUNNonlinearSolver solver = SUNNonlinSol_FixedPoint(y, 0, context);
  for (int i = 0; i < 3; ++i) at[i] = (double)x[i];
  CVodeInit(cvode, rhs, 0, y);
  CVodeSStolerances(cvode, 1e-13, 1e-15);
  CVodeSetNonlinearSolver(cvode, solver);
  CVodeSetUserData(cvode, &phase);
  CVodeSetMaxNumSteps(cvode, 200000);
  CVodeSetMaxHnilWarns(cvode, -1);
  CVodeRootInit(cvode, ROOTS, roots);
  begin(&phase, 0, x);
  bool goes_on = true;
  for (*events = 0; goes_on && t < end;) {
    const bool breaks = phase.piece < q->knots && q->knot[phase.piece].t < end;
    const double until = breaks ? (double)q->knot[phase.piece].t : end;
    int status = CV_TSTOP_RETURN;
    if (until > t) {
      CVodeReInit(cvode, t, y);
      CVodeSetStopTime(cvode, until);
      status = CVode(cvode, until, y, &t, CV_NORMAL);
    }
    for (int i = 0; i < 3; ++i) x[i] = at[i];
    if (status == CV_ROOT_RETURN) {
      goes_on = ++*events < TOO_MANY && next(&phase, t, x);
    } else if (status >= 0 && breaks) {
      while (phase.piece < q->knots &&
             (double)ref_knot(q, phase.piece)->t <= until)
        ++phase.piece;
      begin(&phase, t, x);
    } else {
      goes_on = false;
    }
  }
  N_VDestroy(y);
  SUNNonlinSolFree(solver);
  CVodeFree(&cvode);
  SUNContext_Free(&context);
  return t;
}

static real_t worst;

static real_t apart(const ref_orbit_t *orbit, const real_t x[3]) {
  const real_t in_v = ref_v(orbit->machine, orbit->x) - x[1];
  const real_t in_w = ref_w(orbit->machine, orbit->x) - x[2];
  return fmaxl(fabsl(orbit->x.r - x[0]), fmaxl(fabsl(in_v), fabsl(in_w)));
}

// Ends where the second integration has to: at h = g = 0.
static void judge(const options_t *options, long index) {
  draw_t draw = draw_begin(options->seed, (uint64_t)index);
  lib_machine_t machine = draw_machine(&draw, false);
  machine.on_surface = false;
  const double shape = draw_uniform(&draw, 0, MOVING_SHAPES);
  moving_draw(&draw, &machine, (moving_shape_t)(int)shape, options->t_end,
              options->t_end / 90);
  const ref_machine_t q = draw_reference(&machine);
  const ref_state_t start = draw_start(&machine, &q);
  ref_orbit_t orbit = {.tolerance = 1e-13L, .law = REF_HEXAGON};
  ref_begin(&orbit, &q, start, REF_MODES);
  real_t x[3] = {orbit.x.r, ref_v(&q, orbit.x), ref_w(&q, orbit.x)};
  int events = 0;
  const double t = integrate(&q, x, options->t_end, &events);
  ref_run(&orbit, t);
  const real_t e = apart(&orbit, x);
  printf("%7ld %11.6f %8d %5d %8d %12.2Le  %s\n", index, t, events,
         orbit.events, orbit.codim2_count, e, ref_stop_name(orbit.stop));
  worst = fmaxl(worst, e);
}

static int run(const options_t *options) {
  printf("machine   t reached  events (both)  codim2_count  difference\n");
  for (long i = 0; i < options->machines; ++i)
    judge(options, options->first + i);
  printf("worst %.2Le\n", worst);
  return 0;
}

#else

static int run(const options_t *options) {
  (void)options;
  printf("missing: cvode/cvode.h (apt-get install libsundials-dev)\n");
  return 3;
}

#endif

const command_t command_second = {"second", "machines by a second integration",
                                  10, 2, run};
