// SUNDIALS: CVODE (Adams and BDF) and ARKODE (Dormand and Prince, order five)
// with their own root finding, a mode at a time; and CVODE's BDF on the
// smoothed law without any events. Set-up is part of the time.
#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <string.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "model.h"

enum { MAX_SWITCHES = 200, MAX_STEPS = 50000 };

typedef enum { ADAMS, BDF, ERK } method_t;
static const char *const names[] = {"cvode-adams", "cvode-bdf", "arkode-erk5"};

static int right_side(sunrealtype t, N_Vector y, N_Vector dy, void *user) {
  const motion_t *x = user;
  (void)t;
  const point_t at = point_of(N_VGetArrayPointer(y));
  point_to(contact_rates(&x->model, x->contact, at), N_VGetArrayPointer(dy));
  return 0;
}

static int switches(sunrealtype t, N_Vector y, sunrealtype *root, void *user) {
  (void)t;
  margins(user, point_of(N_VGetArrayPointer(y)), root);
  return 0;
}

// One integrator behind the few calls in which they differ.
typedef struct {
  method_t method;
  long most; // steps between switches
  void *memory;
  SUNContext context;
  N_Vector y;
  SUNMatrix matrix;
  SUNLinearSolver linear;
  SUNNonlinearSolver fixed_point;
} integrator_t;

// A function that both have under names of their own.
#define EITHER(s, name) ((s)->method == ERK ? ERKStep##name : CVode##name)

static int begin(integrator_t *s, motion_t *x, double tol) {
  int bad = 0;
  if (s->method == ERK) {
    s->memory = ERKStepCreate(right_side, 0, s->y, s->context);
    bad |= ERKStepSetTableNum(s->memory, ARKODE_DORMAND_PRINCE_7_4_5);
  } else {
    s->memory = CVodeCreate(s->method == BDF ? CV_BDF : CV_ADAMS, s->context);
    bad |= CVodeInit(s->memory, right_side, 0, s->y);
  }
  bad |= EITHER(s, SStolerances)(s->memory, tol, tol);
  bad |= EITHER(s, SetUserData)(s->memory, x);
  bad |= EITHER(s, SetMaxNumSteps)(s->memory, s->most);
  bad |= EITHER(s, SetErrFile)(s->memory, NULL);
  if (x->model.jumps) bad |= EITHER(s, RootInit)(s->memory, ROOTS, switches);
  bad |= EITHER(s, SetNoInactiveRootWarn)(s->memory);
  if (s->method == ADAMS) {
    s->fixed_point = SUNNonlinSol_FixedPoint(s->y, 0, s->context);
    bad |= CVodeSetNonlinearSolver(s->memory, s->fixed_point);
  } else if (s->method == BDF) {
    s->matrix = SUNDenseMatrix(4, 4, s->context);
    s->linear = SUNLinSol_Dense(s->y, s->matrix, s->context);
    bad |= CVodeSetLinearSolver(s->memory, s->linear, s->matrix);
  }
  return bad;
}

static int reopen(integrator_t *s, double t) {
  if (s->method == ERK) return ERKStepReInit(s->memory, right_side, t, s->y);
  return CVodeReInit(s->memory, t, s->y);
}

// Goes to t_end or to the next root: > 0 at a root, < 0 where it failed.
static int advance(integrator_t *s, double t_end, double *t) {
  EITHER(s, SetStopTime)(s->memory, t_end);
  const int flag = s->method == ERK
                       ? ERKStepEvolve(s->memory, t_end, s->y, t, ARK_NORMAL)
                       : CVode(s->memory, t_end, s->y, t, CV_NORMAL);
  // ARK_ROOT_RETURN is the same number.
  return flag == CV_ROOT_RETURN ? 1 : flag < 0 ? -1 : 0;
}

static void shut(integrator_t *s) {
  EITHER(s, Free)(&s->memory);
  if (s->fixed_point) SUNNonlinSolFree(s->fixed_point);
  if (s->linear) SUNLinSolFree(s->linear);
  if (s->matrix) SUNMatDestroy(s->matrix);
  N_VDestroy(s->y);
  SUNContext_Free(&s->context);
}

// The numbers: a tolerance, and the width of the smoothed law, 0 for the
// problem's own law.
static void solve(const problem_t *problem, const char *solver,
                  const double number[NUMBERS], answer_t *answer) {
  const double tol = number[0], epsilon = number[1];
  integrator_t s = {.method = ADAMS};
  while (s.method < ERK && strcmp(solver, names[s.method]) != 0) s.method++;
  motion_t x = motion_of(problem, tol);
  s.most = x.model.jumps ? MAX_STEPS : 10 * MAX_STEPS;
  if (epsilon > 0) {
    x.model.epsilon2 = epsilon * epsilon;
    x.model.jumps = 0;
  }
  double t = 0;
  int switched = 0;
  answer->lost = 1;
  if (SUNContext_Create(NULL, &s.context) != 0) return;
  s.y = N_VNew_Serial(4, s.context);
  double *const y = N_VGetArrayPointer(s.y);
  point_to(model_start(&x.model, problem), y);
  int state = begin(&s, &x, tol);
  if (state == 0) state = advance(&s, problem->length, &t);
  while (state > 0 && ++switched < MAX_SWITCHES) {
    int root[ROOTS] = {0};
    point_t at = point_of(y);
    EITHER(&s, GetRootInfo)(s.memory, root);
    if (!change_at(&x, root[2] ? 2 : root[1] ? 1 : 0, &t, &at)) break;
    point_to(at, y);
    if (reopen(&s, t) != 0) break;
    state = advance(&s, problem->length, &t);
  }
  model_end(&x.model, point_of(y), answer->x);
  answer->lost = state != 0;
  shut(&s);
}

int main(int argc, char **argv) { return harness_main(argc, argv, solve); }
