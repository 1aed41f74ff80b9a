// The motion of one sample: its random numbers, where it starts, how it is
// stepped under noise, and what happens between one arrival at the two-fold and
// the next, in the same way for random exits and under noise.
//
// "On the surface" means stick if the stepper has modes, otherwise |h| within a
// band for the dwell time. The phase of the outgoing spiral is the fraction of
// a winding, from one change from slip- to slip+ to the next, that is completed
// when r passes the section. It says where on the spiral the motion is, and
// does not depend on how the exit is defined.
//
// Noise is added to the set-valued law, stepped by tf_step_located. After every
// step a normally distributed number of standard deviation size sqrt(dt) is
// added to h: the Euler-Maruyama method for the stochastic differential
// inclusion. In the sliding region the next step returns to the surface for any
// dt. Near the two-fold dt has to resolve the time (size / (dA/dt mu))^(2/3) in
// which the noise is stronger than the weak attraction. Next to h = g = 0 it
// goes on in units of the noise (corner.h), which no rounding limits.

#include <math.h>

#include "../../../src/model/mechanics.h"
#include "diverge.h"

// A wheel rests on the turntable where it is pinned, and in a stick that tends
// to g = 0 without an end, from |g| <= REST_SPEED on; under noise, where stick
// is a band around h = 0, from |g| <= REST_BANDS band on.
#define REST_SPEED 1e-9 // [m/s]
#define REST_BANDS 4

#define BEFORE 4e-3 // [m], distance of a start before the two-fold
#define NEAR 0.011  // steps are short where r differs by less than this part
#define SEVERAL_STEPS 4 // whose rounding slip_rounding is

// Next to h = g = 0: squares of the parts of the way there that the noise and
// the motion of a step come to; |h/g| of stick under noise; of the |g| at which
// stick- has left, the part to which it does not come back.
#define SMALL 1e-4
#define SHARE 0.015625
#define ON 0.1
#define RETURN 0.25

// A motion that lands this often without coming back is in a small cycle.
#define SMALL_LANDINGS 3
#define SECTION 1e-3 // [m], behind the two-fold

bool cli_find_two_fold(const tf_machine_t *k, cli_two_fold_t *out) {
  const tf_input_t input = tf_input_default(k);
  tf_surface_point_t points[TF_TWO_FOLDS];
  tf_two_fold_t form;
  int count = 0;
  if (tf_two_folds(k, &input, points, &count, NULL) != TF_OK) return false;
  for (int i = 0; i < count; i++) {
    // Stick has to arrive and to leave along the weak direction.
    if (tf_normal_form(k, &input, &points[i], &form) == TF_OK &&
        form.through.sticks && form.through.value < 0 &&
        form.across.value < form.through.value) {
      *out = (cli_two_fold_t){
          (double)form.point.r,
          (double)form.point.w,
          (double)form.point.g,
          (double)form.point.v,
          (double)form.through.velocity.w / (double)form.through.velocity.r,
          (double)form.across.value / (double)form.through.value};
      return true;
    }
  }
  return false;
}

cli_corner_t cli_motion_corner(const cli_motion_t *motion) {
  const cli_wide_t *k = &motion->job->wide;
  const double on_v[2] = {k->cos_gamma / k->sin_gamma, 0};
  return cli_corner_at(k, (double)motion->state.r, on_v,
                       1 / motion->job->args->fine);
}

bool cli_step_of(cli_motion_t *motion, double dt) {
  tf_machine_t k = motion->job->machine;
  const tf_input_t input = tf_input_default(&k);
  set_step_length(&k, (tf_real_t)dt);
  return tf_step_located(&k, &motion->state, &input, &motion->report) >= 0;
}

cli_instant_t cli_instant(const cli_motion_t *motion) {
  const cli_wide_t *k = &motion->job->wide;
  const tf_state_t *x = &motion->state;
  const double z = (double)x->w - k->omega0;
  const cli_point_t at = {(double)x->r, (double)x->v - k->d * z, z};
  const cli_field_t f = cli_field_at(k, at);
  const double h = (double)(tf_real_t)f.h, g = (double)(tf_real_t)f.g;
  const bool noisy = motion->band > 0;
  const bool stays =
      noisy ? fabs(h) <= motion->band : !tf_mode_is_slip(x->mode);
  const double speed = noisy ? REST_BANDS * motion->band : REST_SPEED;
  const bool rests =
      (!noisy && x->mode == TF_PINNED) || (stays && fabs(g) <= speed);
  return (cli_instant_t){.t = motion->t,
                         .at = at,
                         .h = h,
                         .g = g,
                         .A = f.A[motion->job->two_fold.g < 0],
                         .on = stays,
                         .rests = rests};
}

// Whether g has the sign that it has at the two-fold.
static bool two_fold_side(const cli_motion_t *motion, double g) {
  return motion->job->two_fold.g < 0 ? g < 0 : g > 0;
}

// Begins a cycle where the one before ended.
static void begin_cycle(cli_motion_t *motion) {
  const double none = (double)NAN;
  motion->cycle = (cli_cycle_t){.arrived = motion->cycle.ended,
                                .phase = none,
                                .section_t = none,
                                .up_last = none};
}

void cli_track_start(cli_motion_t *motion) {
  motion->before = motion->last = cli_instant(motion);
  motion->on_since = motion->cycle.ended = motion->t;
  motion->on_r = motion->last.at.r;
  begin_cycle(motion);
}

// When r passes a value between two instants: bisection of the cubic that has r
// and v of both.
static double passage(const cli_motion_t *motion, const cli_instant_t *a,
                      const cli_instant_t *b, double r) {
  const double d = motion->job->wide.d;
  const double dt = b->t - a->t;
  const double va = (a->at.p + d * a->at.z) * dt;
  const double vb = (b->at.p + d * b->at.z) * dt;
  const double rise = b->at.r - a->at.r;
  const bool down = a->at.r > r;
  double low = 0, high = 1;
  for (int i = 0; i < 50; i++) {
    const double x = (low + high) / 2, y = 1 - x;
    const double at =
        a->at.r + rise * x * x * (3 - 2 * x) + x * y * (va * y - vb * x);
    *((at > r) == down ? &low : &high) = x;
  }
  return a->t + dt * (low + high) / 2;
}

static bool has_arrived(cli_motion_t *motion, const cli_instant_t *at) {
  const cli_instant_t *last = &motion->last;
  if (!isfinite(motion->job->two_fold.r) || !last->on || !at->on ||
      !two_fold_side(motion, last->g) || !two_fold_side(motion, at->g) ||
      at->t - motion->on_since < motion->job->dwell || last->A <= 0 ||
      at->A > 0)
    return false;
  motion->cycle.ended = passage(motion, last, at, motion->job->two_fold.r);
  motion->cycle.outcome = CLI_CYCLE_RETURNED;
  return true;
}

static void watch_exit(cli_motion_t *motion, const cli_instant_t *at) {
  cli_cycle_t *cycle = &motion->cycle;
  const cli_instant_t *last = &motion->last;
  if (cycle->left || !last->on || at->on) return;
  cycle->left = true;
  cycle->exit_t = last->t;
  cycle->exit_r = last->at.r;
  cycle->exit_omega = last->at.z + motion->job->wide.omega0;
  cycle->exit_g = last->g;
  cycle->side = at->h < 0 ? -1 : 1;
  motion->slip_side = cycle->side;
}

static void watch_windings(cli_motion_t *motion, const cli_instant_t *at) {
  cli_cycle_t *cycle = &motion->cycle;
  const cli_instant_t *last = &motion->last;
  const double section =
      motion->job->two_fold.r + copysign(SECTION, motion->job->two_fold.v);
  if (!cycle->left || cycle->landings > 0) return;
  if ((last->at.r > section) != (at->at.r > section) && isnan(cycle->section_t))
    cycle->section_t = passage(motion, last, at, section);
  const int side = at->h < 0 ? -1 : 1;
  if (at->on || side == motion->slip_side) return;
  cycle->windings++;
  motion->slip_side = side;
  if (side < 0) return;
  double up = last->t; // when h changed its sign, by linear interpolation
  if (last->h < 0) up -= (at->t - last->t) * last->h / (at->h - last->h);
  if (cycle->up_last <= cycle->section_t && cycle->section_t <= up)
    cycle->phase = (cycle->section_t - cycle->up_last) / (up - cycle->up_last);
  cycle->up_last = up;
}

// When and where h became 0 between two instants, the first of which is in
// slip, by extrapolation of h from before them.
static void reach_surface(cli_motion_t *motion, const cli_instant_t *at) {
  const cli_instant_t *last = &motion->last, *before = &motion->before;
  const double v = last->at.p + motion->job->wide.d * last->at.z;
  const double fall = (before->h - last->h) / (last->t - before->t);
  double dt = at->t - last->t;
  motion->on_since = at->t;
  motion->on_r = at->at.r;
  if (!before->on && before->t < last->t && before->h * last->h > 0 &&
      last->h / fall > 0) {
    dt = fmin(dt, last->h / fall);
    motion->on_since = last->t + dt;
    motion->on_r = last->at.r + v * dt;
  }
}

static void watch_landing(cli_motion_t *motion, const cli_instant_t *at) {
  cli_cycle_t *cycle = &motion->cycle;
  if (at->on && !motion->last.on) reach_surface(motion, at);
  cycle->upper = cycle->upper && at->on;
  if (!at->on || cycle->upper || at->g == 0 || two_fold_side(motion, at->g) ||
      at->rests || at->t - motion->on_since < motion->job->dwell)
    return;
  cycle->upper = true;
  if (cycle->landings++ == 0) {
    cycle->land_t = motion->on_since;
    cycle->land_r = motion->on_r;
  }
}

bool cli_track(cli_motion_t *motion, const cli_instant_t *at) {
  cli_cycle_t *cycle = &motion->cycle;
  if (!has_arrived(motion, at)) {
    watch_exit(motion, at);
    watch_windings(motion, at);
    watch_landing(motion, at);
    if (at->t - cycle->arrived > motion->job->args->patience) {
      cycle->ended = at->t;
      cycle->outcome = at->rests                           ? CLI_CYCLE_REST
                       : cycle->landings >= SMALL_LANDINGS ? CLI_CYCLE_SMALL
                                                           : CLI_CYCLE_TIMEOUT;
    }
  }
  motion->before = motion->last;
  motion->last = *at;
  return cycle->outcome != CLI_CYCLE_OPEN;
}

bool cli_refuse_cycle(cli_motion_t *motion) {
  motion->cycle.ended = motion->t;
  motion->cycle.outcome = CLI_CYCLE_REFUSED;
  return true;
}

// Rate of change of A mu where stick passes through the two-fold.
static double weakening(const cli_job_t *job) {
  const double e = 1e-6;
  const cli_two_fold_t *at = &job->two_fold;
  const double rise = cli_delassus(&job->wide, at->r + e, at->g) -
                      cli_delassus(&job->wide, at->r - e, at->g);
  return fabs(rise / (2 * e) * at->v) * job->wide.mu;
}

static void put_into_stick(cli_motion_t *motion, double r, double z) {
  const cli_job_t *job = motion->job;
  const cli_wide_t *k = &job->wide;
  motion->state = cli_state_at(k, cli_point_on_surface(k, r, z));
  motion->state.mode = (uint8_t)cli_stick_mode(job->canard.s);
}

// Stick on the weak direction, before the two-fold.
static void start_before_two_fold(cli_motion_t *motion) {
  const cli_wide_t *k = &motion->job->wide;
  const cli_two_fold_t *at = &motion->job->two_fold;
  const bool slides = cli_delassus(k, at->r + BEFORE, at->g) > 0;
  const double e = slides ? BEFORE : -BEFORE;
  put_into_stick(motion, at->r + e, at->omega - k->omega0 + at->slope * e);
}

static void begin_noise(cli_motion_t *motion) {
  const cli_job_t *job = motion->job;
  const tf_machine_t *k = &job->machine;
  const tf_input_t input = tf_input_default(k);
  const cli_args_t *args = job->args;
  motion->size = args->size;
  if (args->spread > 1)
    motion->size *= pow(args->spread, -cli_uniform(&motion->random));
  const double time = pow(2 * motion->size / weakening(job), 2.0 / 3.0);
  const double resolved = isfinite(time) ? time : 1; // [s], at the two-fold
  if (job->at_two_fold) start_before_two_fold(motion);
  motion->band = 4 * motion->size * sqrt(resolved);
  motion->length = (double)k->dt;
  motion->near =
      (double)(tf_real_t)fmin(job->near, resolved / args->refinement);
  (void)tf_begin(k, &motion->state, &input, &motion->report);
}

void cli_motion_begin(cli_motion_t *motion, const cli_job_t *job,
                      uint64_t sample) {
  const bool random = job->args->mechanism == CLI_BY_RANDOM;
  *motion = (cli_motion_t){
      .job = job,
      .random = {.number = sample << 32, .key = (uint32_t)job->args->seed},
      .state = job->setup.motion.state,
      .passes = random && job->at_two_fold,
      .wait = -1};
  if (!random)
    begin_noise(motion);
  else if (job->at_two_fold)
    put_into_stick(motion, job->canard.r, job->canard.z);
  cli_track_start(motion);
}

static void add_noise(cli_motion_t *motion, double dt) {
  const tf_machine_t *k = &motion->job->machine;
  const double noise = motion->size * sqrt(dt) * cli_normal(&motion->random);
  motion->state.v -= (tf_real_t)(noise / (double)k->sin_gamma);
  const tf_slip_t slip =
      tf_slip(k, motion->state.r, motion->state.v, motion->state.w, k->omega0);
  motion->state.mode = slip.h < 0 ? TF_SLIP_MINUS : TF_SLIP_PLUS;
}

static double square(double x) { return x * x; }

// Near h = g = 0, in units of the noise; in stick- nearer. A stick- that has
// left is to be turned back by noise before it is there again.
static bool is_at_corner(const cli_motion_t *motion, const cli_instant_t *at,
                         cli_corner_t *corner) {
  const double scale = square(motion->size);
  if (hypot(at->h, at->g) > CLI_CORNER_REACH * scale) return false;
  *corner = cli_motion_corner(motion);
  const bool sticks = at->g < 0 && fabs(at->h) < ON * fabs(at->g);
  const double there = (corner->b > 0 ? RETURN : 1) * cli_corner_away(corner);
  return !(sticks && cli_corner_attracts(corner) && -at->g > there * scale);
}

// r stays as it is. What does not leave rests for longer than the patience.
static bool advance_corner(cli_motion_t *motion, const cli_instant_t *at,
                           const cli_corner_t *corner) {
  const cli_wide_t *k = &motion->job->wide;
  const double scale = square(motion->size), r = at->at.r;
  cli_slip_t x = {.h = at->h / scale, .g = at->g / scale};
  const bool leaves =
      cli_corner_walk(corner, &motion->random, CLI_CORNER_REACH, &x);
  const double h = x.h * scale, g = x.g * scale;
  const cli_point_t to = {r, -h * k->sin_gamma - g * k->cos_gamma,
                          (g * k->sin_gamma - h * k->cos_gamma) / r};
  motion->state = cli_state_at(k, to);
  motion->state.mode = (uint8_t)(h > 0   ? TF_SLIP_PLUS
                                 : h < 0 ? TF_SLIP_MINUS
                                         : TF_STICK_MINUS);
  motion->t += leaves ? x.t * scale : 2 * motion->job->args->patience;
  const cli_instant_t now = cli_instant(motion);
  return cli_track(motion, &now);
}

// A step of the scene; nearer to h = g = 0 one whose noise is a small part of
// the way there, and whose motion a share of it. One that went further is taken
// again before its noise is drawn, so the noise does not depend on it.
static bool advance_noise(cli_motion_t *motion) {
  const tf_state_t from = motion->state;
  const cli_instant_t at = cli_instant(motion);
  const double way = square(at.h) + square(at.g);
  const tf_machine_t *k = &motion->job->machine;
  const double rounding =
      (double)slip_rounding(k, from.r, from.v, from.w, k->omega0);
  const double least = square(rounding / SEVERAL_STEPS / motion->size);
  cli_corner_t corner;
  if (is_at_corner(motion, &at, &corner))
    return advance_corner(motion, &at, &corner);
  const cli_two_fold_t *two_fold = &motion->job->two_fold;
  const bool is_near = at.g * two_fold->g > 0 &&
                       fabs(at.at.r - two_fold->r) < NEAR * fabs(two_fold->r);
  double dt = fmin(2 * motion->length, SMALL * way / square(motion->size));
  dt = fmin(fmax(dt, least), is_near ? motion->near : (double)k->dt);
  cli_instant_t now = at;
  for (bool near = false; !near; dt = near ? dt : fmax(dt / 2, least)) {
    motion->state = from;
    if (!cli_step_of(motion, dt)) return cli_refuse_cycle(motion);
    now = cli_instant(motion);
    near = dt <= least ||
           square(now.h - at.h) + square(now.g - at.g) <= SHARE * way;
  }
  motion->length = dt;
  now.t = motion->t += dt;
  add_noise(motion, dt);
  return cli_track(motion, &now);
}

bool cli_motion_advance(cli_motion_t *motion) {
  const bool random = motion->job->args->mechanism == CLI_BY_RANDOM;
  if (motion->cycle.outcome == CLI_CYCLE_RETURNED) {
    begin_cycle(motion);
    motion->passes = random;
  }
  return random ? cli_random_advance(motion) : advance_noise(motion);
}
