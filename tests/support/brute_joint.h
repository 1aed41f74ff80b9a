/* Joint modes against brute force in long double: every branch of every
 * contact (slip with either sign of g or at g = 0, stick, pinned) is a system
 * of as many equations as unknowns, which elimination solves, and Newton's
 * method from many starts where there are products. Of dependent equations a
 * linear program finds the solution that is farthest from every border. */
#ifndef TESTS_SUPPORT_BRUTE_JOINT_H
#define TESTS_SUPPORT_BRUTE_JOINT_H

#include "common.h"
#include "twofold/contacts.h"

#define MOST TF_CONTACTS
#define UNKNOWNS (2 * MOST)
#define ROOM TF_JOINT_ROOM(MOST)
#define CONDITIONS (6 * MOST)
#define ZEROS 64

typedef struct {
  unsigned n;
  tf_contact_t contact[MOST];
  tf_slip_t now[MOST];
  tf_real_t forms[(size_t)2 * MOST * TF_TERMS(MOST)];
  int starts; /* of Newton's method, for each unknown; 0: no products */
  bool by_law[MOST];
} system_t;

/* f(m), its slopes, and what a change of its coefficients by 64 epsilon makes
 * of it. */
typedef struct {
  real value, slope[UNKNOWNS], rounding;
} local_t;

static local_t local(const system_t *k, unsigned f, const real m[]) {
  const tf_real_t *c = k->forms + f * TF_TERMS(k->n);
  const tf_real_t *q = c + 1 + (size_t)2 * k->n;
  local_t at = {wide(c[0]), {0}, fabsl(wide(c[0]))};
  for (unsigned b = 0; b < 2 * k->n; b++) {
    at.value += wide(c[1 + b]) * m[b];
    at.rounding += fabsl(wide(c[1 + b])) * (1 + fabsl(m[b]));
    at.slope[b] += wide(c[1 + b]);
    for (unsigned a = 0; a <= b; a++, q++) {
      if (*q == 0) continue;
      at.value += wide(*q) * m[a] * m[b];
      at.rounding += fabsl(wide(*q)) * (1 + fabsl(m[a] * m[b]));
      at.slope[a] += wide(*q) * m[b];
      at.slope[b] += wide(*q) * m[a];
    }
  }
  at.rounding *= 64 * EPSILON;
  return at;
}

/* sign f(m) >= 0, or constant + x m_x + y m_y >= 0 of contact i. */
typedef struct {
  int form;
  unsigned i;
  real sign, constant, x, y;
} condition_t;

/* m[a] = at[a] + by[a] u[of[a]], the forms that vanish, the conditions. */
typedef struct {
  real at[UNKNOWNS], by[UNKNOWNS], most[UNKNOWNS];
  unsigned of[UNKNOWNS], unknowns, forms[UNKNOWNS], conditions;
  condition_t condition[CONDITIONS];
} branch_t;

static void demand(branch_t *b, unsigned i, real constant, real x, real y) {
  b->condition[b->conditions++] = (condition_t){-1, i, 0, constant, x, y};
}

static void demand_sign(branch_t *b, unsigned f, real sign) {
  b->condition[b->conditions++] = (condition_t){(int)f, 0, sign, 0, 0, 0};
}

static void hold(branch_t *b, unsigned a, real value) {
  b->at[a] = value;
  b->by[a] = 0;
  b->most[a] = fabsl(value);
}

static void free_by(branch_t *b, unsigned a, unsigned form, real most) {
  b->at[a] = 0;
  b->by[a] = 1;
  b->most[a] = most;
  b->of[a] = b->unknowns;
  b->forms[b->unknowns++] = form;
}

/* The branches of a contact by their number: slips with g of either sign and
 * at g = 0, sticks, rest; the bow tie has two halves. */
#define BRANCHES 10
static const uint8_t mode_of[BRANCHES] = {
    TF_SLIP_PLUS,  TF_SLIP_PLUS,  TF_SLIP_PLUS,   TF_SLIP_MINUS, TF_SLIP_MINUS,
    TF_SLIP_MINUS, TF_STICK_PLUS, TF_STICK_MINUS, TF_PINNED,     TF_PINNED};

static void rest(branch_t *b, unsigned i, tf_rest_law_t law, real half) {
  free_by(b, 2 * i, 2 * i, 4.0L / 3);
  free_by(b, 2 * i + 1, 2 * i + 1, 1);
  if (law == TF_REST_BOW_TIE) demand(b, i, 1, -half, 0);
  for (int s = -1; s <= 1; s += 2) {
    if (law == TF_REST_BOW_TIE) demand(b, i, 0, half, s);
    if (law == TF_REST_BOW_TIE) continue;
    demand(b, i, 1, 0, s);
    if (law == TF_REST_SQUARE) demand(b, i, 1, s, 0);
    if (law == TF_REST_SQUARE) continue;
    demand(b, i, 4.0L / 3, s, 1.0L / 3);
    demand(b, i, 4.0L / 3, s, -1.0L / 3);
  }
}

/* Adds a branch of contact i. Returns whether it has it. */
static bool add(const system_t *k, branch_t *b, unsigned i, unsigned branch) {
  const bool moment = k->contact[i].stick_kappa > 0;
  const unsigned mode = mode_of[branch], x = 2 * i, y = 2 * i + 1;
  const real s = mode % 2 ? -1 : 1;
  const unsigned share = branch % 3;
  hold(b, y, 0);
  if (k->by_law[i]) {
    const real side = k->now[i].h < 0 ? -1 : 1;
    const tf_force_t f = tf_tyre_force(&k->contact[i].tyre, (tf_real_t)side,
                                       k->now[i].h, k->now[i].g);
    hold(b, x, wide(f.F) / wide(k->contact[i].tyre.mu));
    if (moment) hold(b, y, wide(f.M) / wide(k->contact[i].kappa_mu));
    return share == 0 && tf_mode_is_slip(mode) && s == side;
  }
  if (tf_mode_is_slip(mode)) {
    hold(b, x, s);
    demand_sign(b, x, s);
    if (!moment) return share == 0;
    if (share == 2) {
      free_by(b, y, y, 1);
      demand(b, i, 1, 0, 1);
      demand(b, i, 1, 0, -1);
    } else {
      const real of_g = share == 0 ? 1 : -1;
      hold(b, y, s * of_g);
      demand_sign(b, y, of_g);
    }
    return true;
  }
  if (mode == TF_PINNED) {
    const tf_rest_law_t law = k->contact[i].rest;
    if (!moment || (branch == 9 && law != TF_REST_BOW_TIE)) return false;
    rest(b, i, law, branch == 9 ? -1 : 1);
    return true;
  }
  free_by(b, x, x, 1);
  demand(b, i, 1, 1, 0);
  demand(b, i, 1, -1, 0);
  demand_sign(b, y, s);
  if (!moment) return true;
  b->by[y] = s;
  b->of[y] = b->of[x];
  b->most[y] = 1;
  return true;
}

/* Whether all forms that must may be 0, or have their sign, wherever the
 * multipliers are; those of the contacts from `known` on are anywhere. */
static bool is_possible(const system_t *k, const branch_t *b, unsigned known) {
  real m[UNKNOWNS] = {0}, off[UNKNOWNS];
  for (unsigned a = 0; a < 2 * k->n; a++) {
    const bool is_known = a < 2 * known;
    const bool held = is_known && b->by[a] == 0;
    m[a] = held ? b->at[a] : 0;
    off[a] = held ? 0 : is_known ? b->most[a] : 4.0L / 3;
  }
  for (unsigned n = 0; n < b->unknowns + b->conditions; n++) {
    const condition_t *c = &b->condition[n < b->unknowns ? 0 : n - b->unknowns];
    if (n >= b->unknowns && c->form < 0) continue;
    const unsigned f = n < b->unknowns ? b->forms[n] : (unsigned)c->form;
    const local_t at = local(k, f, m);
    const tf_real_t *q = k->forms + f * TF_TERMS(k->n) + 1 + (size_t)2 * k->n;
    real reach = at.rounding;
    for (unsigned j = 0; j < 2 * k->n; j++) {
      reach += fabsl(at.slope[j]) * off[j];
      for (unsigned i = 0; k->starts > 0 && i <= j; i++, q++)
        reach += fabsl(wide(*q)) * off[i] * off[j];
    }
    if (n < b->unknowns ? fabsl(at.value) > reach
                        : c->sign * at.value + reach < 0)
      return false;
  }
  return true;
}

/* What a branch has: nothing; what a change of the coefficients by 64 epsilon
 * may add or take away; a solution. */
typedef enum { ABSENT, UNSURE, SURE } finding_t;

static finding_t finding_by(real value, real error) {
  return value > error ? SURE : value < -error ? ABSENT : UNSURE;
}

static finding_t least(finding_t a, finding_t b) { return a < b ? a : b; }

static void multipliers(const system_t *k, const branch_t *b, const real u[],
                        real m[]) {
  for (unsigned a = 0; a < 2 * k->n; a++)
    m[a] = b->at[a] + (b->by[a] == 0 ? 0 : b->by[a] * u[b->of[a]]);
}

/* A form by the unknowns. */
static local_t by_unknowns(const system_t *k, const branch_t *b, unsigned f,
                           const real m[]) {
  const local_t at = local(k, f, m);
  local_t of = {at.value, {0}, at.rounding};
  for (unsigned a = 0; a < 2 * k->n; a++)
    if (b->by[a] != 0) of.slope[b->of[a]] += b->by[a] * at.slope[a];
  return of;
}

/* The same of a condition. */
static local_t condition_at(const system_t *k, const branch_t *b,
                            const condition_t *c, const real m[]) {
  if (c->form >= 0) {
    local_t at = by_unknowns(k, b, (unsigned)c->form, m);
    at.value *= c->sign;
    for (unsigned a = 0; a < b->unknowns; a++) at.slope[a] *= c->sign;
    return at;
  }
  const unsigned x = 2 * c->i, y = x + 1;
  local_t at = {c->constant + c->x * m[x] + c->y * m[y], {0}, 64 * EPSILON};
  if (b->by[x] != 0) at.slope[b->of[x]] += b->by[x] * c->x;
  if (b->by[y] != 0) at.slope[b->of[y]] += b->by[y] * c->y;
  return at;
}

/* Equations by elimination with full pivoting: which are independent, what the
 * others miss, the inverse of all, the ways along which none changes. */
typedef struct {
  real row[UNKNOWNS][2 * UNKNOWNS]; /* slopes, then the inverse */
  real least_pivot;
  unsigned rank, column[UNKNOWNS];
} elimination_t;

static void eliminate(elimination_t *e, unsigned n, real cut) {
  bool used[UNKNOWNS] = {0};
  e->least_pivot = 1;
  for (e->rank = 0; e->rank < n; e->rank++) {
    unsigned r = e->rank, c = n;
    real best = cut;
    for (unsigned i = e->rank; i < n; i++)
      for (unsigned j = 0; j < n; j++)
        if (!used[j] && fabsl(e->row[i][j]) > best) {
          best = fabsl(e->row[i][j]);
          r = i;
          c = j;
        }
    if (c == n) return;
    used[c] = true;
    e->column[e->rank] = c;
    if (best < e->least_pivot) e->least_pivot = best;
    for (unsigned j = 0; j < 2 * n; j++) {
      const real swap = e->row[r][j];
      e->row[r][j] = e->row[e->rank][j];
      e->row[e->rank][j] = swap;
    }
    const real pivot = e->row[e->rank][c];
    for (unsigned j = 0; j < 2 * n; j++) e->row[e->rank][j] /= pivot;
    for (unsigned i = 0; i < n; i++) {
      const real by = e->row[i][c];
      if (i == e->rank || by == 0) continue;
      for (unsigned j = 0; j < 2 * n; j++)
        e->row[i][j] -= by * e->row[e->rank][j];
    }
  }
}

/* The largest t for which b_i + G_i z >= t: a simplex method with Bland's rule,
 * z = p - q with p, q >= 0. */
static real widest(unsigned rows, unsigned free, const real b[],
                   real G[][UNKNOWNS]) {
  real T[CONDITIONS + 1][2 * UNKNOWNS + 2] = {{0}}, low = b[0];
  unsigned basis[CONDITIONS], other[2 * UNKNOWNS + 1];
  const unsigned columns = 2 * free + 1, last = columns;
  for (unsigned i = 0; i < rows; i++) low = fminl(low, b[i]);
  for (unsigned i = 0; i < rows; i++) {
    for (unsigned j = 0; j < free; j++) {
      T[i][(size_t)2 * j] = G[i][j];
      T[i][(size_t)2 * j + 1] = -G[i][j];
    }
    T[i][columns - 1] = -1;
    T[i][last] = b[i] - low;
    basis[i] = columns + i;
  }
  for (unsigned j = 0; j < columns; j++) other[j] = j;
  T[rows][columns - 1] = 1;
  for (int turn = 0; turn < 1000; turn++) {
    unsigned in = columns, out = rows;
    for (unsigned j = 0; j < columns; j++)
      if (T[rows][j] > 1e-14L && (in == columns || other[j] < other[in]))
        in = j;
    if (in == columns) break;
    for (unsigned i = 0; i < rows; i++) {
      if (!(T[i][in] < -1e-14L)) continue;
      const real now =
          out == rows ? 0 : T[out][last] * T[i][in] - T[i][last] * T[out][in];
      if (out == rows || now < 0 || (now == 0 && basis[i] < basis[out]))
        out = i;
    }
    if (out == rows) break;
    const real pivot = T[out][in];
    for (unsigned j = 0; j <= last; j++)
      T[out][j] = j == in ? 1 / pivot : -T[out][j] / pivot;
    for (unsigned i = 0; i <= rows; i++) {
      const real by = T[i][in];
      if (i == out || by == 0) continue;
      for (unsigned j = 0; j <= last; j++)
        T[i][j] = (j == in ? 0 : T[i][j]) + by * T[out][j];
    }
    const unsigned swap = basis[out];
    basis[out] = other[in];
    other[in] = swap;
  }
  return low + T[rows][last];
}

/* A solution of a branch, and whether contact i attracts there. */
typedef struct {
  real m[UNKNOWNS], off[UNKNOWNS], size;
  finding_t finding, attracts[MOST];
} zero_t;

/* What a joint mode has. */
typedef struct {
  zero_t zero[ZEROS];
  unsigned count;
  finding_t finding;
} record_t;

static void slopes_at(const system_t *k, const branch_t *b, const real m[],
                      elimination_t *e, real value[], real rounding[]) {
  for (unsigned r = 0; r < b->unknowns; r++) {
    const local_t at = by_unknowns(k, b, b->forms[r], m);
    value[r] = at.value;
    rounding[r] = at.rounding;
    for (unsigned c = 0; c < b->unknowns; c++) {
      e->row[r][c] = at.slope[c];
      e->row[r][b->unknowns + c] = c == r;
    }
  }
}

/* Judges a zero by what rounding makes of it. */
static void judge_zero(const system_t *k, const branch_t *b, const real m[],
                       const elimination_t *e, const real rounding[],
                       record_t *to) {
  zero_t z = {.finding = SURE};
  real off[UNKNOWNS] = {0};
  const unsigned n = b->unknowns;
  for (unsigned r = 0; r < n; r++)
    for (unsigned j = 0; j < n; j++)
      off[e->column[r]] += fabsl(e->row[r][n + j]) * rounding[j];
  for (unsigned c = 0; c < b->conditions; c++) {
    const local_t at = condition_at(k, b, &b->condition[c], m);
    real error = at.rounding;
    for (unsigned a = 0; a < n; a++) error += fabsl(at.slope[a]) * off[a];
    z.finding = least(z.finding, finding_by(at.value, error));
  }
  for (unsigned a = 0; a < 2 * k->n; a++) {
    z.m[a] = m[a];
    z.off[a] = b->by[a] == 0 ? 0 : off[b->of[a]];
    z.size += fabsl(m[a]);
  }
  for (unsigned r = 0; r < n; r++) { /* of dx_i / dh_i */
    const unsigned c = e->column[r];
    if (z.finding == ABSENT || b->forms[c] % 2) continue;
    real turn = 0, most = 0;
    for (unsigned j = 0; j < n; j++) {
      turn += off[j];
      for (unsigned q = 0; q < n; q++)
        most = fmaxl(most, fabsl(e->row[q][n + j]));
    }
    z.attracts[b->forms[c] / 2] =
        finding_by(-e->row[r][n + c], 8 * turn * most);
  }
  for (unsigned i = 0; i < to->count; i++) {
    real apart = 0;
    for (unsigned a = 0; a < 2 * k->n; a++)
      apart += fabsl(to->zero[i].m[a] - m[a]);
    if (apart < 1e-13L) return;
  }
  if (z.finding == ABSENT) return;
  if (z.finding > to->finding) to->finding = z.finding;
  if (to->count < ZEROS) to->zero[to->count++] = z;
}

/* Equations of which some depend on others: all that they leave free. */
static void judge_free(const system_t *k, const branch_t *b,
                       const elimination_t *e, const real value[],
                       const real rounding[], record_t *to) {
  const unsigned n = b->unknowns, free = n - e->rank;
  const real error = 256 * EPSILON * (1 + 1 / e->least_pivot);
  real u[UNKNOWNS] = {0}, way[UNKNOWNS][UNKNOWNS] = {{0}}, m[UNKNOWNS];
  bool is_led[UNKNOWNS] = {0};
  finding_t finding = SURE;
  for (unsigned r = 0; r < n; r++) {
    real missed = 0, most = 0;
    for (unsigned j = 0; j < n; j++) {
      missed += e->row[r][n + j] * value[j];
      most += fabsl(e->row[r][n + j]) * rounding[j];
    }
    if (r >= e->rank && fabsl(missed) > error) return;
    if (r >= e->rank && fabsl(missed) > most / 8) finding = UNSURE;
    if (r < e->rank) u[e->column[r]] = -missed;
    if (r < e->rank) is_led[e->column[r]] = true;
  }
  for (unsigned c = 0, w = 0; c < n; c++) {
    if (is_led[c]) continue;
    way[w][c] = 1;
    for (unsigned r = 0; r < e->rank; r++) way[w][e->column[r]] = -e->row[r][c];
    w++;
  }
  multipliers(k, b, u, m);
  real distance[CONDITIONS] = {0}, G[CONDITIONS][UNKNOWNS] = {{0}};
  for (unsigned c = 0; c < b->conditions; c++) {
    const local_t at = condition_at(k, b, &b->condition[c], m);
    distance[c] = at.value;
    for (unsigned w = 0; w < free; w++)
      for (unsigned a = 0; a < n; a++) G[c][w] += at.slope[a] * way[w][a];
  }
  finding = least(finding,
                  finding_by(widest(b->conditions, free, distance, G), error));
  if (finding > to->finding) to->finding = finding;
  to->count = ZEROS; /* not told apart */
}

/* All that a branch of every contact has. */
static void solve(const system_t *k, const branch_t *b, record_t *to) {
  const unsigned n = b->unknowns;
  const int starts = 1 + k->starts * (int)n;
  const int turns = k->starts > 1 ? 40 : 12;
  for (int start = 0; start < starts; start++) {
    real u[UNKNOWNS] = {0}, m[UNKNOWNS], value[UNKNOWNS], rounding[UNKNOWNS];
    elimination_t e;
    real step = 1, size = 1;
    for (unsigned a = 0; a < n && start > 0; a++)
      u[a] = (real)tap_uniform(-1.4, 1.4);
    for (int turn = 0; turn < turns && step > 1e-17L; turn++) {
      multipliers(k, b, u, m);
      slopes_at(k, b, m, &e, value, rounding);
      size = 0;
      for (unsigned r = 0; r < n; r++) size = fmaxl(size, rounding[r]);
      eliminate(&e, n, size);
      if (e.rank < n && k->starts == 0)
        judge_free(k, b, &e, value, rounding, to);
      step = 1;
      if (e.rank < n) break;
      step = 0;
      for (unsigned r = 0; r < n; r++) {
        real by = 0;
        for (unsigned j = 0; j < n; j++) by += e.row[r][n + j] * value[j];
        u[e.column[r]] -= by;
        step += fabsl(by);
      }
      if (k->starts == 0) step = 0;
      if (!(step < 1e6L)) break;
    }
    if (!(step < 1e-15L)) continue;
    multipliers(k, b, u, m);
    judge_zero(k, b, m, &e, rounding, to);
  }
}

/* Branches of the contacts from i on. */
static void search(const system_t *k, const branch_t *before, unsigned i,
                   unsigned set, record_t all[]) {
  if (i == k->n) {
    solve(k, before, &all[set]);
    return;
  }
  unsigned by = 1;
  for (unsigned j = 0; j < i; j++) by *= TF_MODES;
  for (unsigned branch = 0; branch < BRANCHES; branch++) {
    branch_t b = *before;
    if (add(k, &b, i, branch) && is_possible(k, &b, i + 1))
      search(k, &b, i + 1, set + by * mode_of[branch], all);
  }
}

#endif
