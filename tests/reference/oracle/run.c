// The chain of legs: what each switch leads to.
#include "run.h"

typedef struct {
  const machine_t *p;
  ramp_t ramp;
  int mode; // contact_t
  piece_t piece;
  motion_t x;
  real h, g;
  course_t *out;
  int over; // how the motion goes on is not known
} course_run_t;

const char *const contact_names[5] = {"slip+", "slip-", "stick+", "stick-",
                                      "pinned"};

static state_t state_of(const course_run_t *c) {
  const real w = c->x.z + ramp_omega(&c->ramp, c->x.t);
  return (state_t){c->x.t, c->x.r, c->x.p + c->p->d * c->x.z, w};
}

static void finish(course_run_t *c, const char *why) {
  c->out->ends = why;
  c->over = 1;
}

// A change of the mode, with the event that it is.
static void enter(course_run_t *c, int mode, const char *how) {
  course_t *out = c->out;
  if (out->events == EVENTS) {
    finish(c, "more events than the table holds");
    return;
  }
  out->event[out->events++] = (event_t){state_of(c), c->mode, mode, how};
  if (mode >= 0) c->mode = mode;
}

static int roll_of(real g) { return g < 0 ? -1 : 1; }

// The piece of the law next to h = 0 on a side, or of a stick.
static void take_up(course_run_t *c) {
  if (c->mode <= SLIP_MINUS) {
    c->piece.side = c->mode == SLIP_PLUS ? 1 : -1;
  } else if (c->mode != IS_PINNED) {
    c->piece.roll = c->mode == STICK_PLUS ? 1 : -1;
    const stick_t s = stick_of(c->p, &c->ramp, &c->x, c->piece.roll);
    c->piece.side = s.JA < 0 ? -1 : 1;
  }
}

// On h = 0, off g = 0, set-valued law: h' of slip+ is N - A mu, of slip-
// N + A mu.
static void decide_on_surface(course_run_t *c) {
  const int slipping = c->mode <= SLIP_MINUS;
  const int roll = slipping ? roll_of(c->g) : c->piece.roll;
  const stick_t s = stick_of(c->p, &c->ramp, &c->x, roll);
  const real reach = s.JA * c->p->mu;
  const int plus = s.JN - reach > 0, minus = s.JN + reach < 0;
  const int stick = roll > 0 ? STICK_PLUS : STICK_MINUS;
  if (!slipping) {
    if (plus != minus) enter(c, plus ? SLIP_PLUS : SLIP_MINUS, "leave");
    return;
  }
  if (c->mode == SLIP_PLUS && minus)
    enter(c, SLIP_MINUS, "cross");
  else if (c->mode == SLIP_MINUS && plus)
    enter(c, SLIP_PLUS, "cross");
  else if (s.JA > 0)
    enter(c, stick, "enter");
  else
    finish(c, "a slip touches the border of an escaping region");
}

// A stick ends where h' of one slip turns outward, or, of an escaping stick,
// inward: then the other slip is left.
static void leave_stick(course_run_t *c, end_t end) {
  const int plus = (end == END_PLUS) == (c->piece.side > 0);
  enter(c, plus ? SLIP_PLUS : SLIP_MINUS, "leave");
}

static void go_through_codim2(course_run_t *c) {
  if (fabsq(c->x.r) < (real)1e-9) { // there q = r z is 0 whatever z
    enter(c, -1, "h=g=0");
    finish(c, "stick runs through r = 0");
    return;
  }
  const continuation_t f =
      continuation_at_codim2(c->p, &c->ramp, c->x.r, c->x.t, c->mode);
  c->x.p = c->x.z = c->h = c->g = 0;
  if (f.unknown) {
    enter(c, -1, "h=g=0");
    finish(c, f.unknown);
    return;
  }
  enter(c, f.mode, "h=g=0");
  if (f.mode <= SLIP_MINUS) {
    const real radius = expq(LN_TINY);
    const real s = sinq(f.along.angle), co = cosq(f.along.angle);
    c->h = radius * s;
    c->g = radius * co;
    c->x = motion_of(c->p, c->x.r, c->h, c->g, c->x.t + radius / f.along.speed);
    c->piece.side = s < 0 ? -1 : 1;
    c->piece.roll = roll_of(co);
    c->piece.zone = zone_of(c->p, s, co);
  }
}

// The last 6e-19 m/s of a fall, along a straight line.
static void fall(course_run_t *c, const leg_t *leg, const real y[DIM]) {
  real dy[DIM];
  leg_rates(leg, y, dy);
  c->x.t -= expq(y[2]) / dy[2];
  go_through_codim2(c);
}

// The rest of the way into a two-fold, along a straight line.
static void arrive_at_twofold(course_run_t *c, const leg_t *leg,
                              const real y[DIM]) {
  const real d = (real)1e-6;
  real dy[DIM];
  const stick_t s = stick_of(c->p, &c->ramp, &c->x, c->piece.roll);
  motion_t aside = c->x;
  aside.r += d;
  const real slope =
      (stick_of(c->p, &c->ramp, &aside, c->piece.roll).JA - s.JA) / d;
  const real dr = -s.JA / slope;
  leg_rates(leg, y, dy);
  const real way = dr / dy[0];
  c->g += way * dy[1];
  c->x = motion_of(c->p, c->x.r + dr, 0, c->g, c->x.t + way * dy[AT_T]);
  enter(c, -1, "two-fold");
  finish(c, "two-fold: the future is not unique");
}

// A slip meets h = 0.
static void meet(course_run_t *c) {
  c->h = 0;
  c->x = motion_of(c->p, c->x.r, 0, c->g, c->x.t);
  if (c->p->law == JUMP || c->p->law == COULOMB)
    decide_on_surface(c);
  else
    enter(c, c->mode == SLIP_PLUS ? SLIP_MINUS : SLIP_PLUS, "cross");
}

static void roll_over(course_run_t *c) {
  const int stuck = c->mode > SLIP_MINUS;
  c->g = 0;
  if (stuck && c->p->law == JUMP) {
    go_through_codim2(c);
    return;
  }
  if (stuck) enter(c, c->mode == STICK_PLUS ? STICK_MINUS : STICK_PLUS, "roll");
  c->piece.roll = -c->piece.roll;
}

static void react(course_run_t *c, const leg_t *leg, const real y[DIM],
                  end_t end) {
  const int deeper = leg->piece.zone == 0 ||
                     c->p->delta * fabsq(c->g) <
                         c->p->k * fabsq(c->h) * (c->p->a + c->p->sigma);
  switch (end) {
    case END_H:
      meet(c);
      break;
    case END_G:
      roll_over(c);
      break;
    case END_ZONE:
      c->piece.zone = leg->piece.zone == 1 ? (deeper ? 2 : 0) : 1;
      break;
    case END_PLUS:
    case END_MINUS:
      leave_stick(c, end);
      break;
    case END_FALL:
      fall(c, leg, y);
      break;
    case END_TWOFOLD:
      arrive_at_twofold(c, leg, y);
      break;
    case END_CHART:
    case END_TIME:
      break;
  }
}

// What the mode is at the start.
static void begin(course_run_t *c, const problem_t *problem) {
  const machine_t *p = c->p;
  const real w = strtoflt128(problem->omega, NULL);
  c->ramp = ramp_at(p, 0);
  c->x.r = strtoflt128(problem->r, NULL);
  c->x.z = w - ramp_omega(&c->ramp, 0);
  c->x.t = 0;
  if (problem->v) {
    c->x.p = strtoflt128(problem->v, NULL) - p->d * c->x.z;
    slip_of(p, &c->x, &c->h, &c->g);
  } else {
    real ignored;
    c->h = strtoflt128(problem->h, NULL);
    c->x.p = -(c->h + c->x.r * c->x.z * p->c) / p->s;
    slip_of(p, &c->x, &ignored, &c->g);
  }
  c->mode = c->h < 0 ? SLIP_MINUS : SLIP_PLUS;
  c->piece = (piece_t){c->h < 0 ? -1 : 1, roll_of(c->g), 0};
  c->piece.zone = zone_of(p, c->h, c->g);
  if (c->h == 0 && (p->law == JUMP || p->law == COULOMB)) {
    c->mode = c->g < 0 ? STICK_MINUS : STICK_PLUS;
    const stick_t s = stick_of(p, &c->ramp, &c->x, c->piece.roll);
    const real reach = s.JA * p->mu;
    if ((s.JN > reach) != (s.JN < -reach))
      c->mode = s.JN > reach ? SLIP_PLUS : SLIP_MINUS;
  }
  c->out->begins = c->mode;
  c->out->start = state_of(c);
}

static end_t one_leg(course_run_t *c, const method_t *method, real until) {
  leg_t leg = {c->p, c->ramp, PINNED, c->piece};
  real y[DIM];
  take_up(c);
  leg.piece = c->piece;
  if (c->mode == STICK_PLUS || c->mode == STICK_MINUS)
    leg.kind = STICK;
  else if (c->mode != IS_PINNED)
    leg.kind = leg_is_near(c->p, c->x.r, c->h, c->g) ? POLAR : SLIP;
  leg_start(&leg, &c->x, c->h, c->g, y);
  const end_t end = follow(method, &leg, y, lesser(until, c->ramp.until));
  c->x = leg_motion(&leg, y, &c->h, &c->g);
  react(c, &leg, y, end);
  return end;
}

// A bend of the turntable's speed: stick may not survive it.
static void bend(course_run_t *c) {
  c->x.t = c->ramp.until;
  c->ramp = ramp_at(c->p, c->x.t);
  if (c->mode == IS_PINNED)
    go_through_codim2(c);
  else if (c->mode > SLIP_MINUS)
    decide_on_surface(c);
}

void run(const problem_t *problem, const method_t *method, course_t *out) {
  machine_t p;
  course_run_t c = {.p = &p, .out = out};
  const real t_end = strtoflt128(problem->t_end, NULL);
  const real t_grid = strtoflt128(problem->t_grid, NULL);
  problem_machine(problem, &p);
  out->events = out->states = 0;
  out->ends = "its length is over";
  begin(&c, problem);
  while (!c.over) {
    const int more = out->states < GRID;
    const real next = more ? t_grid * (out->states + 1) / GRID : t_end;
    if (more && next > t_end) break;
    if (!(next > c.x.t)) break;
    if (one_leg(&c, method, next) != END_TIME || c.over) continue;
    if (fabsq(c.x.t - next) < (real)1e-25) {
      c.x.t = next;
      if (more) out->grid[out->states++] = state_of(&c);
    }
    if (fabsq(c.x.t - c.ramp.until) < (real)1e-25) bend(&c);
  }
  out->last = state_of(&c);
}
