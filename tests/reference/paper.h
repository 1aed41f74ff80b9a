/* paper.h - the machine of Szalai & Jeffrey straight from the paper, in long
 * double and with libm: the judge of the simulator. It shares no line with
 * src/ or include/, uses the paper's own expressions (psi, arccot, the
 * rescaled time) and is slow on purpose, so that an error in the simulator
 * and the same error here would be two accidents. Where the paper is misprinted
 * the corrected form is used; tests/law/test_errata.c holds the corrections.
 *
 * A state is x[3] = r [m], v [m/s], w [rad/s]. "Rescaled" means the time tau
 * of (ds1)-(ds3), dt = m (beta^2 + r^2) dtau. s = +1 or -1 is sign(g) where
 * the wheel sticks. Nothing here keeps state or allocates. */
#ifndef TESTS_SUPPORT_PAPER_H
#define TESTS_SUPPORT_PAPER_H

#include <float.h>

#if LDBL_MANT_DIG < 64
#error the reference needs a long double wider than double
#endif

#define PAPER_PI 3.14159265358979323846264338327950288L

typedef long double real;

typedef struct {
  real m;      /* slider mass [kg] > 0 */
  real d;      /* distance of the slot from the axis [m] */
  real beta;   /* sqrt(Theta / m), Theta inertia of the disc [m] */
  real k2;     /* spring [N/m] */
  real c1;     /* damping of the disc against the ground [N m s] */
  real c2;     /* damping of the slider [N s/m] */
  real r0;     /* rest position of the slider [m] */
  real omega0; /* speed of the bottom disc [rad/s] */
  real mu;     /* friction force at the edge of stick [N] */
  real kappa;  /* arm of the moment, M = s kappa F in stick [m] */
  real gamma;  /* angle of the wheel [rad] */
} paper_t;

/* The two-fold of the default machine. */
#define PAPER_R_STAR 0.1859L
#define PAPER_W_STAR (-1.037L)

/* Section 5 of the paper: constants as printed, kappa and k2 computed from
 * (singKappa) and (singK2) at the two-fold above. */
paper_t paper_default(void);

/* (stickV), (singKappa), (singK2): what makes (r, w) a two-fold at g > 0. */
real paper_sing_v(const paper_t *p, real r, real w);
real paper_sing_kappa(const paper_t *p, real r);
real paper_sing_k2(const paper_t *p, real r, real w);

/* (h), (g): lateral slip speed and rolling speed [m/s]; gradient of h. */
real paper_h(const paper_t *p, const real x[3]);
real paper_g(const paper_t *p, const real x[3]);
void paper_h_x(const paper_t *p, const real x[3], real n[3]);

/* The v at which (r, w) has slip speed h; needs sin(gamma) != 0. */
real paper_v_at(const paper_t *p, real r, real w, real h);

/* (force), (moment): the slip law through psi; needs h != 0. */
void paper_friction(const paper_t *p, real h, real g, real *F, real *M);

/* p1, p2 and (ds1)-(ds3) for a given F and M, in rescaled and in physical
 * time. */
real paper_clock_rate(const paper_t *p, real r); /* dt/dtau */
real paper_p1(const paper_t *p, const real x[3]);
real paper_p2(const paper_t *p, real r);
void paper_rhs(const paper_t *p, const real x[3], real F, real M, real dx[3]);
void paper_rhs_time(const paper_t *p, const real x[3], real F, real M,
                    real dx[3]);

/* (VF): f(x, lambda) with F = lambda, M = s kappa lambda, rescaled time,
 * lambda as in (sign);
 * its Lie derivative h_x . f, and the gradient in x of that (analytic). The
 * signs of h_x . f at lambda = +-mu are (slregion) and (esregion), and where
 * both vanish is (2fold). */
void paper_f(const paper_t *p, const real x[3], real lambda, int s, real dx[3]);
real paper_lie(const paper_t *p, const real x[3], real lambda, int s);
void paper_lie_x(const paper_t *p, const real x[3], real lambda, int s,
                 real n[3]);

/* A(r, s) = -h_x . f_lambda in physical time, from the closed form
 * m (beta^2 + r^2) A = r^2 + beta^2 sin^2 gamma + s kappa r cos gamma. */
real paper_delassus(const paper_t *p, real r, int s);
/* (muCalc) and (svf), the latter in physical time; x must be on h = 0. */
real paper_lambda(const paper_t *p, const real x[3], int s);
void paper_stick(const paper_t *p, const real x[3], int s, real dx[3]);

/* Section 4 of the paper at a two-fold x: the K in rescaled time, J1, J2 and
 * the eigenvalues (weak first when both are negative); the direction in x
 * along which sliding orbits arrive, and lambda / mu in that limit. Sliding
 * and escaping there are (SlidCond), (EscCond). */
typedef struct {
  real Kpp, Kpm, Kmp, Kmm;
  real J1, J2, eigen[2];
  real plus[3], minus[3]; /* v+ and v-: the two boundaries */
  real weak[3], lambda;
} paper_twofold_t;
void paper_twofold(const paper_t *p, const real x[3], int s,
                   paper_twofold_t *out);

/* Appendix B: the stretched string, (rollconstr) solved. F and M at slip angle
 * phi in [0, pi/2] by quadrature of the pressure, which finds the border of the
 * two zones by itself. Returns the case, 1 to 3. */
typedef struct {
  real k;     /* lateral stiffness [N/m^2] > 0 */
  real delta; /* largest static pressure [N/m] > 0 */
  real sigma; /* relaxation length [m] >= 0 */
  real rho;   /* dynamic / static pressure, in (0, 1] */
  real a;     /* half length of the contact [m] > 0 */
} paper_string_t;
int paper_string_quadrature(const paper_string_t *q, real phi, real *F,
                            real *M);

#endif
