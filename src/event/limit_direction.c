// Slip near h = g = 0. The field depends there on the angle of the slip alone,
// which may turn to a limit direction (Antali and Stepan 2018) much faster than
// the slip moves along it: that is stiff, and the series of the slip is short.
// But soon the slip cannot be told from the one solution that begins or ends in
// h = g = 0 along the limit direction, whose series from there is long.
#include "limit_direction.h"

// The solution along a limit direction.
typedef struct {
  taylor_t motion; // of its own: a try that fails leaves that of the slip
  segment_t segment;
  tf_real_t r;        // where it has h = g = 0 [m]
  tf_real_t time;     // since then; negative before [s]
  tf_real_t friction; // at most, as acceleration of p and q [m/s^2]
} limit_solution_t;

// The motion to h = g = 0 takes about speed/acceleration. The search is worth
// its cost where that is much longer than the series reaches, but not many
// steps, and where the slip goes straight to or from there, but for what a
// curved limit solution turns: where (p, q) and (p', q') are at most atan(1/2)
// apart.
TF_API bool tf_may_be_stiff(const trajectory_t *path, tf_real_t length) {
  const taylor_t *motion = &path->motion;
  const tf_real_t speed = magnitude(motion->p.c[0]) + magnitude(motion->q.c[0]);
  const tf_real_t acceleration =
      magnitude(motion->p.c[1]) + magnitude(motion->q.c[1]);
  const tf_real_t p0 = motion->p.c[0], q0 = motion->q.c[0];
  const tf_real_t p1 = motion->p.c[1], q1 = motion->q.c[1];
  const bool is_straight =
      2 * magnitude(p0 * q1 - q0 * p1) <= magnitude(p0 * p1 + q0 * q1);
  return path->segment.contact == CONTACT_SLIP && is_straight &&
         motion->machine->contact.stick_kappa > 0 &&
         speed > 8 * acceleration * length &&
         speed < 16 * acceleration * motion->machine->dt;
}

// Expands the solution that has h = g = 0 at limit->r, limit->time ago; false
// where no limit direction attracts the slip.
static bool series_of_limit_solution(const trajectory_t *path,
                                     limit_solution_t *limit) {
  const tf_machine_t *k = path->motion.machine;
  const tf_input_t *input = path->motion.input;
  segment_t *segment = &limit->segment;
  const tf_real_t omega = path->omega - input->alpha * limit->time;
  const rates_t rates = rates_at(k, input, limit->r, 0, 0, omega);
  const codim2_field_t field = tf_codim2_field_of(k, &rates);
  if (!tf_codim2_attractor(&k->contact, &field, segment->sign_g,
                           segment->sign_h, &segment->T))
    return false;
  begin_taylor(&limit->motion, k, input, omega,
               (phase_point_t){limit->r, 0, 0});
  // This contact always has a series.
  (void)tf_taylor_coefficients(&limit->motion, segment, 0);
  limit->friction =
      k->contact.tyre.mu * (magnitude(rates.Fp) + magnitude(rates.Fq));
  return true;
}

// The time at which the solution is as far along its direction (p1, q1) as
// (p, q), by three steps of a simplified Newton iteration.
static tf_real_t time_along(const taylor_t *motion, tf_real_t p, tf_real_t q) {
  const tf_real_t p1 = motion->p.c[1], q1 = motion->q.c[1];
  const tf_real_t a2 = p1 * p1 + q1 * q1;
  const tf_real_t ahead = p * p1 + q * q1;
  tf_real_t t = ahead / a2;
  for (int i = 0; i < 3; i++)
    t -= (value_at(&motion->p, motion->order, t) * p1 +
          value_at(&motion->q, motion->order, t) * q1 - ahead) /
         a2;
  return t;
}

// Finds the limit solution next to the slip and returns whether it is near
// enough to take its place. Its r and time are exact to second order in the
// slip after the first expansion and to fourth after the second.
static bool is_on_limit_solution(const trajectory_t *path, tf_real_t allowed,
                                 limit_solution_t *limit) {
  const taylor_t *motion = &limit->motion;
  const phase_point_t now = path->now;
  const tf_real_t q = now.r * now.z;
  tf_real_t missed = 0, growth = 0;
  for (int i = 0; i < 2; i++) {
    if (!series_of_limit_solution(path, limit)) return false;
    const tf_real_t t = time_along(motion, now.p, q);
    // A distance from the solution changes as t^exponent: it has to decay.
    if (!(t * motion->exponent < 0)) return false;
    limit->time = t;
    limit->r += now.r - value_at(&motion->r, motion->order, t);
    missed = magnitude(value_at(&motion->p, motion->order, t) - now.p) +
             magnitude(value_at(&motion->q, motion->order, t) - q);
    const tf_real_t p1 = motion->p.c[1], q1 = motion->q.c[1];
    growth = 1 + limit->friction / (square_root(p1 * p1 + q1 * q1) *
                                    (1 + magnitude(motion->exponent)));
  }
  return missed * growth <= allowed &&
         tf_segment_length(motion, limit->time, (error_t){allowed, 0}) ==
             limit->time;
}

TF_API bool tf_follow_limit_direction(trajectory_t *path, tf_real_t allowed) {
  limit_solution_t limit = {.segment = path->segment, .r = path->now.r};
  limit.motion.speed = path->motion.speed;
  limit.segment.contact = CONTACT_CODIM2_SLIP;
  limit.segment.h_zero_order = 1;
  limit.segment.g_starts_at_zero = true;
  if (!is_on_limit_solution(path, allowed, &limit)) return false;
  const taylor_t *motion = &limit.motion;
  tf_real_t end = limit.time + path->remaining, event_time;
  if (limit.time < 0 && end > 0) end = 0;
  if (limit.time > 0) {
    end = tf_segment_length(motion, end, (error_t){allowed, 0});
    if (!(end > limit.time) ||
        tf_next_event(motion, &limit.segment, end, &event_time))
      return false;
  }
  path->motion = *motion;
  tf_advance(path, limit.time, end);
  tf_take_force(path, end);
  return true;
}
