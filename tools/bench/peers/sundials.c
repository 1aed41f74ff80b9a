// SUNDIALS: CVODE (Adams and BDF) and ARKODE (Dormand and Prince, order five)
// with their own root finding, a mode at a time; and CVODE's BDF on the
// smoothed law without any events. Set-up is part of the time.
#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "bench/harness.h"
#include "model.h"

enum { MAX_SWITCHES = 200, MAX_STEPS = 50000, ROOTS = 3 };

typedef enum { ADAMS, BDF, ERK } method_t;

typedef struct {
  model_t model;
  contact_t contact;
  real_t near; // [m/s] of h = g = 0: the rest is a straight line
} motion_t;

static point_t point_of(N_Vector y) {
  const sunrealtype *data = N_VGetArrayPointer(y);
  return (point_t){data[0], data[1], data[2], data[3]};
}

static void point_to(point_t x, N_Vector y) {
  sunrealtype *data = N_VGetArrayPointer(y);
  data[0] = x.r;
  data[1] = x.h;
  data[2] = x.z;
  data[3] = x.t;
}

static int right_side(sunrealtype t, N_Vector y, N_Vector dy, void *user) {
  const motion_t *x = user;
  (void)t;
  point_to(x->model.epsilon2 > 0
               ? smooth_rates(&x->model, point_of(y))
               : contact_rates(&x->model, x->contact, point_of(y)),
           dy);
  return 0;
}

// Slip ends at h = 0 or near h = g = 0, stick at |lambda| = mu; g = 0 is a
// kink of F in slip.
static int switches(sunrealtype t, N_Vector y, sunrealtype *root, void *user) {
  const motion_t *x = user;
  const point_t at = point_of(y);
  (void)t;
  root[0] = rolling(&x->model, at);
  if (x->contact.side) {
    root[1] = at.h;
    root[2] = hypot(at.h, root[0]) - x->near;
  } else {
    root[1] =
        x->model.mu - fabs(stick_at(&x->model, x->contact.roll, at).lambda);
    root[2] = 1;
  }
  return 0;
}

// One integrator behind the few calls in which they differ.
typedef struct {
  method_t method;
  void *memory;
  SUNContext context;
  N_Vector y;
  SUNMatrix matrix;
  SUNLinearSolver linear;
  SUNNonlinearSolver fixed_point;
} integrator_t;

static int open_cvode(integrator_t *s, motion_t *x, double tol) {
  s->memory = CVodeCreate(s->method == BDF ? CV_BDF : CV_ADAMS, s->context);
  int bad = CVodeInit(s->memory, right_side, 0, s->y);
  bad |= CVodeSStolerances(s->memory, tol, tol);
  bad |= CVodeSetUserData(s->memory, x);
  bad |= CVodeSetMaxNumSteps(s->memory, MAX_STEPS);
  bad |= CVodeSetErrFile(s->memory, NULL);
  bad |= CVodeSetNoInactiveRootWarn(s->memory);
  if (x->model.epsilon2 <= 0) bad |= CVodeRootInit(s->memory, ROOTS, switches);
  if (s->method == ADAMS) {
    s->fixed_point = SUNNonlinSol_FixedPoint(s->y, 0, s->context);
    return bad | CVodeSetNonlinearSolver(s->memory, s->fixed_point);
  }
  s->matrix = SUNDenseMatrix(4, 4, s->context);
  s->linear = SUNLinSol_Dense(s->y, s->matrix, s->context);
  return bad | CVodeSetLinearSolver(s->memory, s->linear, s->matrix);
}

static int open_erk(integrator_t *s, motion_t *x, double tol) {
  s->memory = ERKStepCreate(right_side, 0, s->y, s->context);
  int bad = ERKStepSStolerances(s->memory, tol, tol);
  bad |= ERKStepSetUserData(s->memory, x);
  bad |= ERKStepSetTableNum(s->memory, ARKODE_DORMAND_PRINCE_7_4_5);
  bad |= ERKStepSetMaxNumSteps(s->memory, MAX_STEPS);
  bad |= ERKStepSetErrFile(s->memory, NULL);
  bad |= ERKStepRootInit(s->memory, ROOTS, switches);
  return bad | ERKStepSetNoInactiveRootWarn(s->memory);
}

static int reopen(integrator_t *s, double t) {
  if (s->method == ERK) return ERKStepReInit(s->memory, right_side, t, s->y);
  return CVodeReInit(s->memory, t, s->y);
}

// Goes to t_end or to the next root: > 0 at a root, < 0 where it failed.
static int advance(integrator_t *s, double t_end, double *t) {
  if (s->method == ERK) {
    ERKStepSetStopTime(s->memory, t_end);
    const int flag = ERKStepEvolve(s->memory, t_end, s->y, t, ARK_NORMAL);
    return flag == ARK_ROOT_RETURN ? 1 : flag < 0 ? -1 : 0;
  }
  CVodeSetStopTime(s->memory, t_end);
  const int flag = CVode(s->memory, t_end, s->y, t, CV_NORMAL);
  return flag == CV_ROOT_RETURN ? 1 : flag < 0 ? -1 : 0;
}

static void roots_of(integrator_t *s, int root[ROOTS]) {
  (s->method == ERK ? ERKStepGetRootInfo : CVodeGetRootInfo)(s->memory, root);
}

static long steps_of(integrator_t *s) {
  long steps = 0;
  (s->method == ERK ? ERKStepGetNumSteps : CVodeGetNumSteps)(s->memory, &steps);
  return steps;
}

static void shut(integrator_t *s) {
  (s->method == ERK ? ERKStepFree : CVodeFree)(&s->memory);
  if (s->fixed_point) SUNNonlinSolFree(s->fixed_point);
  if (s->linear) SUNLinSolFree(s->linear);
  if (s->matrix) SUNMatDestroy(s->matrix);
  N_VDestroy(s->y);
  SUNContext_Free(&s->context);
}

// What becomes of the motion at a root. Returns 0 where nothing is possible.
static int change(motion_t *x, const int root[ROOTS], double *t, N_Vector y) {
  const model_t *k = &x->model;
  contact_t *c = &x->contact;
  point_t at = point_of(y);
  int found = 1;
  if (c->side && root[2]) {
    const point_t dy = slip_rates(k, *c, at);
    const real_t fall = time_to_fall(k, at, dy);
    if (fall > 0) found = capture(k, dy, fall, &at, c), *t += fall;
  } else if (c->side && root[1]) {
    at.h = 0;
    *c = after_h(k, *c, at);
  } else if (c->side) {
    // g is 0 to rounding, so that the root may be found twice.
    const point_t dy = slip_rates(k, *c, at);
    c->roll = rolling_rate(k, at, dy) < 0 ? -1 : 1;
    at.z = -at.h * k->cos / at.r;
  } else if (root[1]) {
    c->side = stick_at(k, c->roll, at).lambda > 0 ? 1 : -1;
  } else {
    at.z = 0;
    found = capture(k, (point_t){0, 0, 0, 1}, 0, &at, c);
  }
  point_to(at, y);
  return found;
}

static void run(const problem_t *problem, const solver_t *solver, double tol,
                answer_t *answer) {
  integrator_t s = {.method = (method_t)solver->method};
  motion_t x = {.model = model_of(problem), .near = 0.1 * sqrt(tol)};
  x.model.epsilon2 = solver->second * solver->second;
  const point_t start = model_start(&x.model, problem);
  double t = 0;
  long steps = 0;
  int switched = 0;
  x.contact.side = problem_side(problem);
  x.contact.roll = rolling(&x.model, start) < 0 ? -1 : 1;
  answer->lost = 1;
  if (SUNContext_Create(NULL, &s.context) != 0) return;
  s.y = N_VNew_Serial(4, s.context);
  point_to(start, s.y);
  int state = s.method == ERK ? open_erk(&s, &x, tol) : open_cvode(&s, &x, tol);
  if (state == 0) state = advance(&s, problem->length, &t);
  while (state > 0 && ++switched < MAX_SWITCHES) {
    int root[ROOTS];
    steps += steps_of(&s);
    roots_of(&s, root);
    if (!change(&x, root, &t, s.y) || reopen(&s, t) != 0) break;
    state = advance(&s, problem->length, &t);
  }
  model_end(&x.model, point_of(s.y), answer->x);
  answer->steps = steps + steps_of(&s);
  answer->lost = state != 0;
  shut(&s);
}

#define EVENTS(name, method) \
  { name, "tol", 1e-3, 1e-13, 1.8, 0, PEER_PROBLEMS, method, run }
#define SMOOTH(epsilon)                                           \
  {                                                               \
    "cvode-smooth eps=" #epsilon, "tol", 1e-3, 1e-12, 3, epsilon, \
        PEER_PROBLEMS, BDF, run                                   \
  }

int main(int argc, char **argv) {
  const solver_t solvers[] = {EVENTS("cvode-adams", ADAMS),
                              EVENTS("cvode-bdf", BDF),
                              EVENTS("arkode-erk5", ERK),
                              SMOOTH(1e-3),
                              SMOOTH(1e-4),
                              SMOOTH(1e-5),
                              SMOOTH(1e-6),
                              SMOOTH(1e-7),
                              SMOOTH(1e-8),
                              SMOOTH(1e-9),
                              SMOOTH(1e-10)};
  return harness_main(argc, argv, solvers,
                      (int)(sizeof solvers / sizeof *solvers));
}
