/// @file
/// A contact with friction force F and moment M: the core of tf_step, for use
/// in other mechanisms too (castor, finger tip, clutch). The unknowns of a step
/// are the multipliers x = F/mu and y = M/(kappa mu) of its mean force and
/// moment. The caller gives h and g at the end of the step as forms in x and y,
/// then moves by F and M. The law there: x in Sgn(h), y = s x, s in Sgn(g).
#ifndef TWOFOLD_CONTACT_H
#define TWOFOLD_CONTACT_H

#include "twofold/real.h"
#include "twofold/status.h"
#include "twofold/tyre.h"

TF_BEGIN_C

/// The five modes of contact. + and - are the sign of h in slip, of g in stick.
typedef enum {
  TF_SLIP_PLUS,   ///< h > 0
  TF_SLIP_MINUS,  ///< h < 0
  TF_STICK_PLUS,  ///< h = 0, g > 0
  TF_STICK_MINUS, ///< h = 0, g < 0
  TF_PINNED       ///< h = g = 0
} tf_mode_t;
#define TF_MODES 5
#define TF_NO_MODE TF_MODES ///< none preferred, or none admissible
#define TF_MODE_BIT(mode) (1u << (mode))

/// "slip+" "slip-" "stick+" "stick-" "pinned".
#define tf_mode_name TF_LINK(tf_mode_name)
TF_API const char *tf_mode_name(unsigned mode);

/// Whether the contact slips.
static inline bool tf_mode_is_slip(unsigned mode) {
  return mode <= TF_SLIP_MINUS;
}

/// Which of several consistent modes a step takes. All rules share this:
/// - A slip that is still consistent goes on: off h = 0 the future is unique,
///   and a second consistent mode is an artefact of the finite step.
/// - A slip never enters an escaping stick: on both sides motion leads away.
/// - An attracting stick goes on.
/// - Where the present mode is lost: attracting stick, pinned, slip (the
///   faster one if both), escaping stick, in this order.
/// - At h = g = 0 every mode is lost, and a slip leaves along a limit
///   direction. A direction attracts if neighbouring ones turn to it. Slip
///   along it ranks after the attracting stick, before pinned. Of two modes of
///   one kind the one whose slip grows faster is taken.
/// The rule decides how an escaping stick ends, and what follows when a wheel
/// comes to h = g = 0 and may rest there. RANDOM lets it rest, pinned, until a
/// draw ends that. The others take an attracting stick or slip where one is
/// consistent, because rest is then unstable.
typedef enum {
  TF_RULE_PERSIST,    ///< stay while it is consistent (default)
  TF_RULE_SLIP_PLUS,  ///< slip to h > 0 as soon as that is consistent
  TF_RULE_SLIP_MINUS, ///< slip to h < 0 as soon as that is consistent
  TF_RULE_RANDOM      ///< leave at a constant rate [1/s], with even odds: an
                      ///< escaping stick to a slip, a pinned wheel to any
                      ///< other consistent mode
} tf_rule_t;
#define TF_RULES 4

/// "persist" "slip+" "slip-" "random".
#define tf_rule_name TF_LINK(tf_rule_name)
TF_API const char *tf_rule_name(unsigned rule);

/// The law at h = g = 0: the F and M under which the wheel rests (JUMP only).
typedef enum {
  TF_REST_HULL,   ///< convex hull of the limits of slip, Filippov's law:
                  ///< |M| <= kappa mu, |F| <= 4 mu/3 - |M|/(3 kappa) (default)
  TF_REST_SQUARE, ///< hull of stick: |M| <= kappa mu, |F| <= mu
  TF_REST_BOW_TIE ///< the paper's: |M| <= kappa |F|, |F| <= mu. Not convex; at
                  ///< some points h = g = 0 it leaves no future
} tf_rest_law_t;
#define TF_REST_LAWS 3

/// "hull" "square" "bow_tie".
#define tf_rest_law_name TF_LINK(tf_rest_law_name)
TF_API const char *tf_rest_law_name(unsigned law);

/// Slip speeds of the contact, lateral (h) and rolling (g) [m/s].
typedef struct {
  tf_real_t h, g;
} tf_slip_t;

/// A contact ready to step: constants only, no pointers, may live in flash.
typedef struct {
  tf_tyre_t tyre;
  tf_real_t stick_kappa; ///< kappa where stick carries a moment, else 0 [m]
  tf_real_t kappa_mu;    ///< stick_kappa mu [N m]
  tf_real_t inv_mu, inv_kappa_mu; ///< 1/mu, 1/kappa_mu, 0 where not finite
  uint64_t exit_threshold;        ///< (1 - exp(-rate dt)) 2^63
  tf_rule_t rule;
  tf_rest_law_t rest;
} tf_contact_t;

/// h or g [m/s] at the end of a step as a form in x and y: c0 + cx x + cy y +
/// cxx x^2 + cxy x y + cyy y^2. Without a moment the terms in y are unused.
typedef struct {
  tf_real_t c0, cx, cy, cxx, cxy, cyy;
} tf_form_t;

/// The consistent modes, and the multipliers of each.
typedef struct {
  uint8_t set;            ///< bits TF_MODE_BIT(mode)
  uint8_t attracting;     ///< sticks with a positive Delassus scalar; at
                          ///< h = g = 0 also the attracting slips
  uint8_t near_stick;     ///< the stick on the present side of g: decides a tie
  tf_real_t x[2];         ///< of stick+, where y = x, and stick-, y = -x
  tf_real_t tau[2];       ///< y/x of slip+, slip- at h -> 0, or as they leave
  tf_real_t departure[2]; ///< how fast slip+ and slip- leave h = 0: h at the
                          ///< end of a step [m/s]; from tf_contact_leave, the
                          ///< slip's growth in the units of its h and g. Only
                          ///< which is larger matters
} tf_contact_modes_t;

/// Derives the constants of a contact.
/// contact: out. law: in, TF_TYRE_JUMP or TF_TYRE_COULOMB. mu: in, 0 to 1e9 N.
/// kappa: in, 1e-9 to 1e6 m; COULOMB ignores it. rest, rule: in. rate_dt: in,
///   exit rate of `random` times dt, 0 to 1e9.
/// Returns: TF_OK; TF_BAD_PARAMETER (contact untouched).
#define tf_contact_prepare TF_LINK(tf_contact_prepare)
TF_API tf_status_t tf_contact_prepare(tf_contact_t *contact, tf_tyre_law_t law,
                                      tf_real_t mu, tf_real_t kappa,
                                      tf_rest_law_t rest, tf_rule_t rule,
                                      tf_real_t rate_dt);

/// Every mode in which a step may end.
/// h, g: in. now, mode: in, before the step, or TF_NO_MODE. modes: out.
/// reaches_codim2: out, or NULL: h = g = 0 is within reach (tf_contact_leave).
/// Returns: TF_OK; TF_BAD_STATE: not finite, not a mode; TF_BAD_PARAMETER:
///   COULOMB with h.cx > 0, or h.cx = 0 != cy: F > 0 must lower h (untouched).
/// Trust: the set may be empty. It is right and complete but for pinned, one of
///   up to four points where h and g vanish together. Pinned is uncertain where
///   64 epsilon in the forms remove that point or move it out of the law of
///   rest, or where h = 0 and g = 0 touch (244 of 16,000, by test_zeros).
/// Cost: 0.3 us (x86-64) where the forms are almost linear, else 5 us, and at
///   most 1.5 ms, where the curves touch or are one.
#define tf_contact_modes TF_LINK(tf_contact_modes)
TF_API tf_status_t tf_contact_modes(const tf_contact_t *contact,
                                    const tf_form_t *h, const tf_form_t *g,
                                    tf_slip_t now, unsigned mode,
                                    tf_contact_modes_t *modes,
                                    bool *reaches_codim2);

/// The mode that the rule takes.
/// modes, mode: in, as above. tick, seed: in, counter and key of the draw.
/// Returns: a mode of the set; TF_NO_MODE where none is admissible.
#define tf_contact_choose TF_LINK(tf_contact_choose)
TF_API unsigned tf_contact_choose(const tf_contact_t *contact,
                                  const tf_contact_modes_t *modes,
                                  unsigned mode, uint64_t tick, uint32_t seed);

/// The mean force of a step that ends in a mode: in slip the law's, or its
/// limit at h -> 0 where that would carry h across 0. Of several pinned
/// points it takes the one with the least |F|, then |M|.
/// h, g, modes: in, as above. mode: in, of the set. force: out. at: in, the
///   slip where the law is read: at the start (order 1), or at mid-step.
/// Returns: TF_OK; TF_DEGRADED: for TF_NO_MODE force is the law's at `at`, but
///   h leaves that side; TF_BAD_STATE (untouched): not finite, not in the set,
///   or no pinned point.
#define tf_contact_force TF_LINK(tf_contact_force)
TF_API tf_status_t tf_contact_force(const tf_contact_t *contact,
                                    const tf_form_t *h, const tf_form_t *g,
                                    const tf_contact_modes_t *modes,
                                    unsigned mode, tf_slip_t at,
                                    tf_force_t *force);

/// What follows h = g = 0: every future, and the one that the rule takes.
/// h, g: in, their change there, in time [m/s^2] or over a step [m/s]; only c0,
///   cx and cy are read. from: in, the mode of the motion, or TF_NO_MODE.
/// arrives: in, false if already there. tick, seed: in. modes, force: out.
/// Returns: the mode; TF_NO_MODE (force 0, set empty): none, or not finite.
#define tf_contact_leave TF_LINK(tf_contact_leave)
TF_API unsigned tf_contact_leave(const tf_contact_t *contact,
                                 const tf_form_t *h, const tf_form_t *g,
                                 unsigned from, bool arrives, uint64_t tick,
                                 uint32_t seed, tf_contact_modes_t *modes,
                                 tf_force_t *force);

/// Philox-2x32-10 (Salmon et al. 2011), a counter-based generator: a state
/// carries no stream position but its tick, and a replay needs no history.
/// counter, key: in, any. out: out, 2 words.
#define tf_philox TF_LINK(tf_philox)
TF_API void tf_philox(uint64_t counter, uint32_t key, uint32_t out[2]);

TF_END_C

#endif
