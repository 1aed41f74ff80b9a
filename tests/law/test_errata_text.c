/* test_errata_text.c - statements of the paper's text that do not hold beside
 * those of test_errata.c: each is shown false, and what holds instead true. */
#include "../tap.h"
#include "paper.h"

static long double any(double lo, double hi) {
  return (long double)tap_uniform(lo, hi);
}

/* "When h != 0, F and M are smooth functions of h and g": M is, F is continuous
 * with a kink at g = 0. One-sided slopes in g by extrapolated differences. */
TEST(erratum_force_has_a_kink) {
  paper_t p;
  paper_default(&p);
  const long double a = 2.0L / PAPER_PI * atanl(6.0L * p.kappa);
  for (int i = 0; i < 100; i++) {
    const long double h = any(0.01, 1) * (i % 2 ? 1.0L : -1.0L);
    const long double step = 1e-5L * fabsl(h);
    long double F[2][3], M[2][3], slope[2], arm[2];
    for (int side = 0; side < 2; side++) {
      const long double to = side ? step : -step;
      for (int j = 0; j < 3; j++)
        paper_friction(&p, h, (long double)j * to, &F[side][j], &M[side][j]);
      slope[side] =
          (4.0L * F[side][1] - 3.0L * F[side][0] - F[side][2]) / (2.0L * to);
      arm[side] =
          (4.0L * M[side][1] - 3.0L * M[side][0] - M[side][2]) / (2.0L * to);
    }
    const long double kink = p.mu * a / (18.0L * p.kappa * h);
    CHECK_NEAR(slope[1], -kink, 1e-8L * fabsl(kink));
    CHECK_NEAR(slope[0], kink, 1e-8L * fabsl(kink));
    CHECK_NEAR(arm[1], arm[0], 1e-8L * fabsl(arm[0]));
    CHECK_NEAR(F[0][0], F[1][0], 1e-18L);
  }
}

/* Figure 5: its regions lie on h = 0, where v follows from r and omega; the
 * caption puts them on v = 0, which is off h = 0 wherever the discs differ. */
TEST(erratum_regions_lie_on_h_zero) {
  paper_t p;
  paper_default(&p);
  for (int i = 0; i < 100; i++) {
    const long double r = any(0.17, 0.2), w = any(-1.06, -1.005);
    const long double on[3] = {r, paper_sing_v(&p, r, w), w};
    const long double caption[3] = {r, 0.0L, w};
    CHECK_NEAR(paper_h(&p, on), 0.0L, 1e-18L);
    CHECK(fabsl(on[1]) > 0.003L);
    CHECK(fabsl(paper_h(&p, caption)) > 0.002L);
  }
}
