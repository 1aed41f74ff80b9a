/// @file
/// The machine as the reference sees it: the equations of motion of the paper
/// in long double, written down from them alone. Nothing here is shared with
/// the simulator, so that the two can disagree.
///
/// The state is (r, p, z) with z = w - omega0, the speed of the disc against
/// the turntable, and p = v - d z. Both vanish at h = g = 0, so that h and g
/// keep all their digits however near that point the motion comes.
#ifndef REFERENCE_MODEL_H
#define REFERENCE_MODEL_H

#include <stdbool.h>

typedef long double real_t;

/// Parameters, and what follows from them.
typedef struct {
  real_t m, d, beta, k2, c1, c2, r0, omega0, mu, kappa, gamma;
  bool coulomb;        ///< F = mu sign(h), no moment
  real_t sine, cosine; ///< of gamma
  real_t a;            ///< 1 - (2/pi) arccot(6 kappa)
} ref_machine_t;

typedef struct {
  real_t r, p, z;
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
  real_t h, g;
} ref_slip_t;

/// How the state and the slip change.
typedef struct {
  real_t r, p, z, h, g;
} ref_rate_t;

typedef struct {
  real_t F, M;
} ref_force_t;

/// h' = free + F h_F + M h_M, and g' alike: the slip is affine in the force.
typedef struct {
  real_t h, h_F, h_M, g, g_F, g_M;
} ref_affine_t;

/// The surface h = 0 on the side s of g: h' = N - A lambda.
typedef struct {
  real_t N, A;
  real_t plus, minus; ///< h' at lambda = mu, -mu
} ref_edge_t;

/// Fills what follows from the parameters.
void ref_prepare(ref_machine_t *machine);
ref_state_t ref_state(const ref_machine_t *machine, real_t r, real_t v,
                      real_t w);
real_t ref_v(const ref_machine_t *machine, ref_state_t x);
real_t ref_w(const ref_machine_t *machine, ref_state_t x);
/// Equations (h), (g).
ref_slip_t ref_slip(const ref_machine_t *machine, ref_state_t x);
/// The state at (r, z near zero) whose slip is (h, g); r must not be 0.
ref_state_t ref_from_slip(const ref_machine_t *machine, real_t r,
                          ref_slip_t slip);
/// The nearest state with h = 0.
ref_state_t ref_on_surface(const ref_machine_t *machine, ref_state_t x);
/// Equations (ds1)-(ds3) in physical time.
ref_rate_t ref_rate(const ref_machine_t *machine, ref_state_t x,
                    ref_force_t force);
ref_affine_t ref_affine(const ref_machine_t *machine, ref_state_t x);
/// (force), (moment) on the side `side` of h = 0 and the side `sign_g` of
/// g = 0, smoothly continued a little beyond either.
ref_force_t ref_slip_force(const ref_machine_t *machine, ref_slip_t slip,
                           int side, int sign_g);
ref_edge_t ref_edge(const ref_machine_t *machine, ref_state_t x, int s);
/// F = lambda, M = s kappa lambda.
ref_force_t ref_stick_force(const ref_machine_t *machine, int s, real_t lambda);
/// Speed by which the size of h and g is judged [m/s].
real_t ref_speed_scale(const ref_machine_t *machine, real_t r);

#endif
