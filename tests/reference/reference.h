/// The reference: the motion of the machine from event to event, from the
/// paper's equations alone. Nothing here is shared with the simulator, so that
/// the two can disagree. It needs gcc and libm; see number.h for its number.
///
///   ref_machine_t q = {.m = 1, ...};      parameters
///   ref_prepare(&q);
///   ref_rate(&q, x, ref_slip_force(...))   the field
///   ref_orbit_t orbit = {.tolerance = 1e-13L};
///   ref_begin(&orbit, &q, ref_state(&q, r, v, w), REF_MODES);
///   ref_run(&orbit, 2);                    to t = 2 s, or orbit.stop says why
///
/// The state is (r, p, z) with z = w - omega0(t), the speed of the disc against
/// the turntable, and p = v - d z. Both vanish at h = g = 0, so that h and g
/// keep all their digits however near that point the motion comes. SI units.
#ifndef REFERENCE_H
#define REFERENCE_H

#include <stdbool.h>

#include "number.h"

typedef enum {
  REF_JUMP,    ///< the paper's law
  REF_COULOMB, ///< F = mu sign(h), no moment
  REF_STRING,  ///< appendix B
  REF_SMOOTH,  ///< the paper's, sign(h) as h / sqrt(h^2 + epsilon^2)
  REF_FREE     ///< no force
} ref_law_t;

/// What drives the machine at a time; alpha is omega0'.
typedef struct {
  ref_real_t omega0, alpha, force, torque;
} ref_input_t;

/// Inputs that move: linear between knots, constant before the first and after
/// the last. Two knots of one time are a jump; one of omega0 is a new state: v
/// and w stay, h and g do not. On top of that omega0 swings as a sine.
enum { REF_KNOTS = 16 };
typedef struct {
  ref_real_t t, omega0, force, torque;
} ref_knot_t;

/// Parameters, and what follows from them.
typedef struct {
  ref_real_t m, d, beta, k2, c1, c2, r0, omega0, mu, kappa, gamma;
  ref_real_t epsilon;                 ///< of REF_SMOOTH
  ref_real_t k, delta, sigma, rho, a; ///< of REF_STRING
  ref_law_t law;
  int knots; ///< 0: omega0 constant, no loads
  ref_knot_t knot[REF_KNOTS];
  const ref_knot_t *table;      ///< instead of `knot`, of any length; or NULL
  ref_real_t swing, swing_rate; ///< [rad/s], [rad/s]; needs a knot
  ref_real_t sine, cosine;      ///< of gamma
  ref_real_t share;             ///< 1 - (2/pi) arccot(6 kappa)
} ref_machine_t;

/// The parameters that the reference, the paper, the library and the judge name
/// alike, as numbers of a type, for an initialiser.
#define PARAMETERS_OF(type, q)                                           \
  .m = (type)(q)->m, .d = (type)(q)->d, .beta = (type)(q)->beta,         \
  .k2 = (type)(q)->k2, .c1 = (type)(q)->c1, .c2 = (type)(q)->c2,         \
  .r0 = (type)(q)->r0, .omega0 = (type)(q)->omega0, .mu = (type)(q)->mu, \
  .kappa = (type)(q)->kappa, .gamma = (type)(q)->gamma

typedef struct {
  ref_real_t r, p, z, t;
  int piece; ///< knots that have passed
} ref_state_t;

/// Numbered as the simulator's modes.
typedef enum {
  REF_SLIP_PLUS,
  REF_SLIP_MINUS,
  REF_STICK_PLUS,
  REF_STICK_MINUS,
  REF_PINNED,
  REF_MODES
} ref_mode_t;

typedef struct {
  ref_real_t h, g;
} ref_slip_t;

/// How the state and the slip change, in a second.
typedef struct {
  ref_real_t r, p, z, h, g;
} ref_rate_t;

typedef struct {
  ref_real_t F, M;
} ref_force_t;

/// A smooth piece of a law: signs of h and g, and of REF_STRING the zone: no,
/// partial, full slip. It goes on smoothly beyond its borders, so that a step
/// may pass them.
typedef struct {
  int side, roll, zone;
} ref_piece_t;

/// h' = free + F h_F + M h_M, and g' alike: the slip is affine in the force.
typedef struct {
  ref_real_t h, h_F, h_M, g, g_F, g_M;
} ref_affine_t;

/// The surface h = 0 on the side s of g: h' = N - A lambda.
typedef struct {
  ref_real_t N, A;
  ref_real_t plus, minus; ///< h' at lambda = mu, -mu
} ref_edge_t;

/// Fills what follows from the parameters.
void ref_prepare(ref_machine_t *machine);
const ref_knot_t *ref_knot(const ref_machine_t *machine, int i);
ref_input_t ref_input(const ref_machine_t *machine, ref_real_t t, int piece);
/// The state at t = 0 [m, m/s, rad/s], behind a jump there, and its v and w.
ref_state_t ref_state(const ref_machine_t *machine, ref_real_t r, ref_real_t v,
                      ref_real_t w);
ref_real_t ref_v(const ref_machine_t *machine, ref_state_t x);
ref_real_t ref_w(const ref_machine_t *machine, ref_state_t x);
/// Equations (h), (g).
ref_slip_t ref_slip(const ref_machine_t *machine, ref_state_t x);
/// The state at x.r and x.t whose slip is (h, g); r must not be 0.
ref_state_t ref_from_slip(const ref_machine_t *machine, ref_state_t x,
                          ref_slip_t slip);
/// The state at x.r and x.z with this h; sin(gamma) must not be 0.
ref_state_t ref_with_h(const ref_machine_t *machine, ref_state_t x,
                       ref_real_t h);
/// The nearest state with h = 0.
ref_state_t ref_on_surface(const ref_machine_t *machine, ref_state_t x);
/// Equations (ds1)-(ds3) in physical time.
ref_rate_t ref_rate(const ref_machine_t *machine, ref_state_t x,
                    ref_force_t force);
ref_affine_t ref_affine(const ref_machine_t *machine, ref_state_t x);
/// Kinetic and spring energy: m (P^2 + (beta^2 + r^2) w^2)/2 + k2 stretch^2/2
/// with P = v - d w, stretch = r - r0.
ref_real_t ref_energy(const ref_machine_t *machine, ref_real_t r, ref_real_t P,
                      ref_real_t w, ref_real_t stretch);
ref_piece_t ref_piece_at(const ref_machine_t *machine, ref_slip_t slip,
                         int side);
/// The law of slip: (force), (moment), or appendix B.
ref_force_t ref_slip_force(const ref_machine_t *machine, ref_slip_t slip,
                           ref_piece_t piece);
/// Whether the force of slip depends on the direction of the slip alone, has a
/// kink at g = 0, and jumps at h = 0.
bool ref_by_angle(const ref_machine_t *machine);
bool ref_has_kink(const ref_machine_t *machine);
bool ref_sticks(const ref_machine_t *machine);
ref_edge_t ref_edge(const ref_machine_t *machine, ref_state_t x, int s);
ref_edge_t ref_edge_of(const ref_machine_t *machine, const ref_affine_t *field,
                       int s);
/// F = lambda, M = s kappa lambda; the moment of REF_COULOMB is 0.
ref_force_t ref_stick_force(const ref_machine_t *machine, int s,
                            ref_real_t lambda);
/// Speed by which the size of h and g is judged [m/s].
ref_real_t ref_speed_scale(const ref_machine_t *machine, ref_state_t x);

/// The laws of rest at h = g = 0.
typedef enum {
  REF_BOW_TIE, ///< |M| <= kappa |F|, |F| <= mu
  REF_SQUARE,  ///< |M| <= kappa mu, |F| <= mu
  REF_HEXAGON, ///< |M| <= kappa mu, |F| <= 4 mu/3 - |M|/(3 kappa)
  REF_RESTS
} ref_rest_t;

/// The force that keeps h = g = 0 in a field; 0 where none does.
ref_force_t ref_rest_force(const ref_affine_t *field);
/// How far a force of rest is within a law; < 0 beyond.
ref_real_t ref_rest_margin(const ref_machine_t *machine, ref_force_t force,
                           ref_rest_t law);

/// One way in which the motion goes on. At h = g = 0 a slip that does not
/// attract is one of a family of motions that share its direction.
typedef struct {
  ref_mode_t mode;
  bool attracting;  ///< stick: A > 0. Slip at h = g = 0: angle is attracting
  ref_real_t rate;  ///< at h = g = 0: d rho/dt of leaving, > 0
  ref_real_t angle; ///< slip at h = g = 0: atan2(h, g) [rad], 0 to 2 pi
} ref_way_t;

#define REF_MAX_WAYS 24
typedef struct {
  ref_way_t list[REF_MAX_WAYS];
  int count;
  ref_force_t resting;   ///< h = g = 0: force that rest takes
  bool rests[REF_RESTS]; ///< h = g = 0: rest is possible under the law
  bool spiral;           ///< winds out, with no limit direction
} ref_consistent_t;

/// The consistent modes at h = 0, g != 0.
void ref_consistent_edge(const ref_machine_t *machine, ref_state_t x,
                         ref_consistent_t *out);
/// The consistent modes at h = g = 0: limit directions, sticks that leave,
/// rest; and those of a field, on a wheel that does not move on in r.
void ref_consistent_codim2(const ref_machine_t *machine, ref_state_t x,
                           ref_consistent_t *out);
void ref_consistent_field(const ref_machine_t *machine,
                          const ref_affine_t *field, ref_consistent_t *out);
/// Near h = g = 0 the slip is (h, g) = rho (sin angle, cos angle), and its rate
/// depends on the angle alone: rho' = growth, rho angle' = turn. side names the
/// half plane of h: angles 0 and pi are limits from there.
typedef struct {
  ref_real_t growth, turn;
} ref_polar_t;
ref_polar_t ref_polar(const ref_machine_t *machine, const ref_affine_t *field,
                      ref_real_t angle, int side);
/// How fast the stick on the side s of g leaves h = g = 0 [m/s^2]; 0 where it
/// does not, or has no force within the law.
ref_real_t ref_stick_growth(const ref_machine_t *machine,
                            const ref_affine_t *field, int s);
/// The declared rule where the mode is lost: attracting stick, slip along an
/// attracting direction, rest, other slip, escaping stick; of one kind the one
/// that leaves faster. A stick that arrives is held by the bow tie before it
/// slips, a wheel at rest by any law. Returns an index of the list, or:
#define REF_REST (-1)
#define REF_NONE (-2)
int ref_choose(const ref_consistent_t *consistent, ref_rest_t law,
               ref_mode_t from);

typedef enum {
  REF_REACHED,     ///< the end of the time asked for
  REF_TWO_FOLD,    ///< the two-fold: what follows is not unique
  REF_NO_MODE,     ///< h = g = 0, and no mode under the law
  REF_SPIRALS_OUT, ///< h = g = 0, left by a spiral of no definite phase
  REF_TOO_LONG     ///< more events or evaluations than allowed
} ref_stop_t;

/// What happened at an event.
typedef enum {
  REF_CROSSES, ///< slip crosses h = 0
  REF_ENTERS,  ///< slip becomes stick
  REF_LEAVES,  ///< stick becomes slip
  REF_TURNS,   ///< stick passes to the other side of g without rest
  REF_CODIM2,  ///< h = g = 0 reached, or rest given up
  REF_ARRIVES  ///< two-fold reached
} ref_event_t;

typedef struct ref_orbit ref_orbit_t;
/// Called at each event, after the next mode was taken; may be NULL.
typedef void (*ref_watch_t)(const ref_orbit_t *orbit, ref_event_t event);

/// A motion under way. Set tolerance, law, watch, context and limit; ref_begin
/// finds the mode.
struct ref_orbit {
  ref_state_t x;
  ref_state_t at;              ///< where h = g = 0 was last reached
  ref_consistent_t consistent; ///< at the last event at h = 0
  ref_real_t tolerance;        ///< of a step, relative
  ref_real_t step;             ///< next step to try, in stretched time
  const ref_machine_t *machine;
  ref_watch_t watch;
  void *context;
  long evaluations, limit; ///< of the right-hand side; limit 0: 20 million
  ref_rest_t law;
  ref_mode_t mode;
  ref_mode_t arrived; ///< mode in which h = g = 0 was last reached
  ref_piece_t piece;  ///< of the law; in stick, side is the sign of A
  ref_stop_t stop;
  int events, codim2_count;
  int chosen;                   ///< of consistent.list
  ref_real_t pace_slip, pace_A; ///< scales of the step's time
};

/// Starts at x. At h = 0 in `mode` where that is consistent; REF_MODES: in
/// stick where that is, as the simulator begins. At h = g = 0 by the rule.
void ref_begin(ref_orbit_t *orbit, const ref_machine_t *machine, ref_state_t x,
               ref_mode_t mode);
/// Goes on to time `end`.
ref_stop_t ref_run(ref_orbit_t *orbit, ref_real_t end);
/// Force of the present mode at x.
ref_force_t ref_force(const ref_orbit_t *orbit, ref_state_t x);
/// Reason of an end, in words.
const char *ref_stop_name(ref_stop_t stop);

#endif
