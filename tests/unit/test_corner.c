/* Slips that leave h = g = 0, against a search through all angles with the
 * paper's law and field. */
#include "corner.h"
#include "sample.h"

/* The machine at rest on the turntable. */
typedef struct {
  paper_t paper;
  real x[3];
} rest_t;

/* Slip of 1 m/s at an angle from the h axis of one side: how fast it turns to
 * larger angles, and grows. */
typedef struct {
  real turns, grows;
} rate_t;

static rate_t rate_at(const rest_t *at, int side, real angle) {
  const real h = (real)side * cosl(angle), g = sinl(angle);
  real F, M, dx[3], h_x[3], g_x[3], dh = 0, dg = 0;
  paper_friction(&at->paper, h, g, &F, &M);
  paper_rhs_time(&at->paper, at->x, F, M, dx);
  paper_h_x(&at->paper, at->x, h_x);
  paper_g_x(&at->paper, at->x, g_x);
  for (int i = 0; i < 3; i++) {
    dh += h_x[i] * dx[i];
    dg += g_x[i] * dx[i];
  }
  return (rate_t){(real)side * (dg * h - dh * g), dh * h + dg * g};
}

static real bisected(const rest_t *at, int side, real low, real high) {
  const bool up = rate_at(at, side, low).turns > 0;
  for (int i = 0; i < 80; i++) {
    const real middle = (low + high) / 2;
    if ((rate_at(at, side, middle).turns > 0) == up)
      low = middle;
    else
      high = middle;
  }
  return (low + high) / 2;
}

/* The way out on one side: of those that their neighbours turn to, or else of
 * all, the fastest. grows = 0: there is none. */
typedef struct {
  real grows, next; /* of the best, of the second of its kind */
  bool attracts;
  int roll;
} exit_t;

/* False where two ways out, or one and none, are too near to each other. */
static bool search(const rest_t *at, int side, exit_t *best) {
  enum { ANGLES = 160 };
  const real quarter = PAPER_PI / 2, edge = 1e-7L;
  *best = (exit_t){0, 0, false, 0};
  for (int roll = -1; roll <= 1; roll += 2) {
    real low = 0, turns = 0;
    for (int i = 0; i <= ANGLES; i++) {
      const real share = fminl(fmaxl((real)i / ANGLES, edge), 1 - edge);
      const real angle = (real)roll * quarter * share;
      const real before = turns;
      turns = rate_at(at, side, angle).turns;
      if (fabsl(turns) < 1e-4L) return false;
      if (i > 0 && (before > 0) != (turns > 0)) {
        const real way = bisected(at, side, low, angle);
        const real grows = rate_at(at, side, way).grows;
        const bool attracts = (before > 0) == (roll > 0);
        if (fabsl(grows) < 1e-3L) return false;
        if (grows > 0 && (best->grows == 0 || attracts > best->attracts)) {
          *best = (exit_t){grows, 0, attracts, roll};
        } else if (grows > 0 && attracts == best->attracts) {
          best->next = fminl(grows, best->grows);
          if (grows > best->grows) {
            best->grows = grows;
            best->roll = roll;
          }
        }
      }
      low = angle;
    }
  }
  return best->grows - best->next > 1e-3L * best->grows || best->grows == 0;
}

TEST(slip_leaves_rest_as_a_search_finds) {
  int found[2][2] = {{0}}, none = 0;
  for (int n = 0; n < 500; n++) {
    tf_params_t params = random_params();
    params.omega0 = uniform(-2, 2);
    const tf_machine_t k = prepared(&params);
    const tf_input_t u = tf_input_default(&k);
    const tf_real_t r = uniform(-0.6, 0.6);
    const rest_t at = {paper_of(&params), {wide(r), 0, wide(u.omega0)}};
    const tf_rates_t rates = rates_at(&k, &u, r, 0, 0, u.omega0);
    tf_futures_t out;
    tf_corner_futures(&k, &rates, &out);
    for (int slip = 0; slip < 2; slip++) {
      const int side = slip == 0 ? 1 : -1;
      exit_t want;
      if (!search(&at, side, &want)) continue;
      const bool is = out.solutions.set & TF_MODE_BIT(TF_SLIP_PLUS + slip);
      if (!CHECK(is == (want.grows > 0))) continue;
      none += !is;
      if (!is) continue;
      CHECK(out.roll[slip] == want.roll);
      CHECK_NEAR((real)side * wide(out.solutions.h_limit[slip]), want.grows,
                 4000 * EPSILON * (1 + want.grows));
      found[slip][want.attracts]++;
    }
  }
  printf(
      "# ways out that neighbours turn from, to: %d %d with h > 0, %d %d with "
      "h < 0; %d times none\n",
      found[0][0], found[0][1], found[1][0], found[1][1], none);
  CHECK(found[0][1] > 50 && found[1][1] > 50 && none > 50);
}

int main(int argc, char **argv) {
  tap_begin(argc, argv);
  RUN(slip_leaves_rest_as_a_search_finds);
  return tap_end();
}
