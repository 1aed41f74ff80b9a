// The scenes that come with the project: data only. No other file of the core
// names one of them. C++ wants members in the order of their struct.
#include "twofold/simulation.h"

// The paper's figure 5: kappa and k2 put the two-fold at r = 0.1859,
// omega = -1.037 (singKappa, singK2).
#define PAPER                                                            \
  .m = 1, .d = 1, .beta = TF_R(0.05), .k2 = TF_R(2.2270992253886014441), \
  .c1 = TF_R(1e-3), .c2 = TF_R(1e-3), .r0 = TF_R(0.1), .omega0 = -1, .mu = 1
#define PAPER_SCHEME \
  .theta = TF_R(0.5), .dt = TF_R(1e-4), .rate = 20, .tolerance = TF_R(1e-8)
#define PAPER_KAPPA .kappa = TF_R(0.27241153714062027818)
#define PAPER_GAMMA .gamma = TF_R(-2.35619449019234492885) // -3 pi/4
#define PAPER_START .r = TF_R(0.18), .omega = TF_R(-1.037), .h = TF_R(1e-10)
#define SLIDING_START \
  .r = TF_R(0.3), .omega = TF_R(-0.8), .v = TF_R(0.1), .v_is_given = true

static const tf_scene_t chaos = {
    .name = "chaos",
    .shows = "the paper's figure 5: into the two-fold, windings, return",
    .leaves_out = "inputs, angle",
    .params = {PAPER, PAPER_KAPPA, PAPER_GAMMA, PAPER_SCHEME,
               .law = TF_TYRE_JUMP},
    PAPER_START,
    .t_end = 10};

static const tf_scene_t gamma_zero = {
    .name = "gamma_zero",
    .shows = "gamma = 0: at its two-fold the force drops out, no choice there",
    .leaves_out = "inputs, angle",
    .params = {PAPER, PAPER_KAPPA, .gamma = 0, PAPER_SCHEME,
               .law = TF_TYRE_JUMP},
    SLIDING_START,
    .t_end = 10};

static const tf_scene_t gamma_right = {
    .name = "gamma_right",
    .shows = "gamma = pi/2: sticking borders never meet, no two-fold",
    .leaves_out = "inputs, angle",
    .params = {PAPER, PAPER_KAPPA, .gamma = TF_R(1.57079632679489661923),
               PAPER_SCHEME, .law = TF_TYRE_JUMP},
    SLIDING_START,
    .t_end = 10};

static const tf_scene_t coulomb = {
    .name = "coulomb",
    .shows = "force without moment: friction is associated, one future",
    .leaves_out = "moment, slip angle, inputs, angle",
    .params = {PAPER, PAPER_GAMMA, PAPER_SCHEME, .law = TF_TYRE_COULOMB},
    .r = TF_R(0.18),
    .omega = TF_R(-0.6),
    .h = TF_R(0.3),
    .t_end = 10};

static const tf_scene_t frictionless = {
    .name = "frictionless",
    .shows = "no contact: two masses, a spring and two dampers",
    .leaves_out = "friction, solution set, selection, inputs",
    .params = {PAPER, PAPER_GAMMA, PAPER_SCHEME, .law = TF_TYRE_NONE,
               .with_angle = true},
    PAPER_START,
    .t_end = 10};

static const tf_scene_t smooth = {
    .name = "smooth",
    .shows = "sign(h) smoothed over 1e-4 m/s: the choice is hidden, not gone",
    .leaves_out = "stick, solution set, selection, inputs, angle",
    .params = {PAPER, PAPER_KAPPA, PAPER_GAMMA, .epsilon = TF_R(1e-4),
               PAPER_SCHEME, .law = TF_TYRE_SMOOTH},
    PAPER_START,
    .t_end = 10};

static const tf_scene_t rolling = {
    .name = "rolling",
    .shows = "starts on the upper sliding region (omega > omega0), never slips",
    .leaves_out = "slip, inputs",
    .params = {PAPER, PAPER_KAPPA, PAPER_GAMMA, PAPER_SCHEME,
               .law = TF_TYRE_JUMP, .with_angle = true},
    .r = TF_R(0.95),
    .omega = TF_R(1.3),
    .h = 0,
    .t_end = 10};

static const tf_scene_t string = {
    .name = "string",
    .shows = "Appendix B: stretched string with partial slip, no jump",
    .leaves_out = "stick, solution set, selection, inputs, angle",
    .params = {PAPER, PAPER_GAMMA, .k = 1, .delta = 1, .sigma = 1,
               .rho = TF_R(0.66666666666666666667), .a = 1, PAPER_SCHEME,
               .law = TF_TYRE_STRING},
    PAPER_START,
    .t_end = 10};

static const tf_scene_t driven = {
    .name = "driven",
    .shows = "turntable ramps up, reverses and stops",
    .leaves_out = "nothing",
    .params = {PAPER, PAPER_KAPPA, PAPER_GAMMA, PAPER_SCHEME,
               .law = TF_TYRE_JUMP, .with_angle = true},
    PAPER_START,
    .t_end = 12,
    .knots = 5,
    .profile = {{0, -1}, {2, -2}, {4, -2}, {8, 1}, {10, 0}}};

// In the order of their numbers. An array drops what it has no room for with a
// warning; this does not compile.
#define EACH_SCENE(x)                                                        \
  x(chaos) x(gamma_zero) x(gamma_right) x(coulomb) x(frictionless) x(smooth) \
      x(rolling) x(string) x(driven)
#define ONE_MORE(scene) +1 // NOLINT(bugprone-macro-parentheses): a sum
#define ADDRESS(scene) &(scene),
typedef char tf_scenes_has_a_place_for_each[0 EACH_SCENE(ONE_MORE) == TF_SCENES
                                                ? 1
                                                : -1];

TF_API const tf_scene_t *const tf_scenes[TF_SCENES] = {EACH_SCENE(ADDRESS)};
