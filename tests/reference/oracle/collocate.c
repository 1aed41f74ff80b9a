// Gauss-Legendre collocation: the polynomial whose slope is right at the
// points of Gauss. Nodes and matrix are computed, not copied from a table.
#include "flow.h"

enum { POINTS = 14, ROUNDS = 80 };

static struct {
  int ready;
  real weight[POINTS], inner[POINTS][POINTS]; // of Butcher's table
  real tail[2][POINTS]; // the last two Legendre coefficients of the slope
} table;

// P_0 ... P_(POINTS+1) at x.
static void legendre(real x, real P[POINTS + 2]) {
  P[0] = 1;
  P[1] = x;
  for (int n = 1; n <= POINTS; n++)
    P[n + 1] = ((2 * n + 1) * x * P[n] - n * P[n - 1]) / (n + 1);
}

// Roots of P_n by Newton's method from cos(pi (i + 3/4) / (n + 1/2)).
static real root(int i) {
  const real pi = strtoflt128(PI_TEXT, NULL);
  const int n = POINTS;
  real P[POINTS + 2];
  real x = -cosq(pi * (4 * i + 3) / (4 * n + 2));
  for (int round = 0; round < 12; round++) {
    legendre(x, P);
    x -= P[n] * (x * x - 1) / (n * (x * P[n] - P[n - 1]));
  }
  return x;
}

// b_j = 1 / ((1 - x^2) P_n'^2);  a_ij = b_j sum_l (2 l + 1) P_l(x_j) I_l(c_i)
// with I_l(c) the integral of P_l(2 t - 1) from 0 to c.
static void prepare(void) {
  const int n = POINTS;
  real P[POINTS][POINTS + 2];
  for (int i = 0; i < n; i++) {
    const real x = root(i);
    legendre(x, P[i]);
    const real slope = n * (x * P[i][n] - P[i][n - 1]) / (x * x - 1);
    table.weight[i] = 1 / ((1 - x * x) * slope * slope);
  }
  for (int j = 0; j < n; j++) {
    for (int i = 0; i < n; i++) {
      real sum = (P[i][1] + 1) / 2;
      for (int l = 1; l < n; l++)
        sum += P[j][l] * (P[i][l + 1] - P[i][l - 1]) / 2;
      table.inner[i][j] = table.weight[j] * sum;
    }
    for (int l = 0; l < 2; l++)
      table.tail[l][j] =
          (2 * (n - 1 - l) + 1) * table.weight[j] * P[j][n - 1 - l];
  }
  table.ready = 1;
}

// One round of the fixed-point iteration; returns how far it moved.
static real improve(const leg_t *leg, const real y[DIM], real length,
                    real slope[POINTS][DIM]) {
  real next[POINTS][DIM], moved = 0;
  for (int i = 0; i < POINTS; i++) {
    real at[DIM];
    for (int k = 0; k < DIM; k++) {
      real sum = 0;
      for (int j = 0; j < POINTS; j++) sum += table.inner[i][j] * slope[j][k];
      at[k] = y[k] + length * sum;
    }
    leg_rates(leg, at, next[i]);
  }
  for (int i = 0; i < POINTS; i++) {
    for (int k = 0; k < DIM; k++) {
      const real change = length * fabsq(next[i][k] - slope[i][k]);
      if (!(change <= moved)) moved = change;
      slope[i][k] = next[i][k];
    }
  }
  return moved;
}

real step_collocated(const leg_t *leg, const real y[DIM], real length,
                     real end[DIM]) {
  real slope[POINTS][DIM], error = 0, moved = 1;
  if (!table.ready) prepare();
  leg_rates(leg, y, slope[0]);
  for (int i = 1; i < POINTS; i++)
    for (int k = 0; k < DIM; k++) slope[i][k] = slope[0][k];
  for (int round = 0; round < ROUNDS && !(moved < (real)1e-34); round++) {
    moved = improve(leg, y, length, slope);
    if (!(moved < 10)) return 1;
  }
  if (!(moved < (real)1e-32)) return 1;
  for (int k = 0; k < DIM; k++) {
    real sum = 0, tail[2] = {0, 0};
    for (int j = 0; j < POINTS; j++) {
      sum += table.weight[j] * slope[j][k];
      for (int l = 0; l < 2; l++) tail[l] += table.tail[l][j] * slope[j][k];
    }
    end[k] = y[k] + length * sum;
    const real worst = bigger(fabsq(tail[0]), fabsq(tail[1]));
    error = bigger(error, length * worst / (1 + fabsq(y[k])));
  }
  return error;
}
