// Forms and equations of joint modes about the middle of a box, and their
// inverse: what joint.c looks at.
#ifndef TF_OUTLOOK_H
#define TF_OUTLOOK_H

#include "inclusion.h"
#include "mode_set.h"
#include "twofold/contacts.h"
#include "tyre_law.h"

#define MULTIPLIERS TF_MULTIPLIERS(TF_CONTACTS)

typedef struct {
  unsigned count, terms; // multipliers, numbers of a form
  const tf_contact_t *contacts;
  const tf_real_t *forms;
  unsigned slips;                 // bit i: contact i slips by `law`
  unsigned near_plus;             // bit i: g_i > 0 is the present side
  bool is_affine;                 // no form has products
  tf_real_t bend[MULTIPLIERS];    // what products and rounding add to a form
  multipliers_t law[TF_CONTACTS]; // of those that slip
} mechanism_t;

// Where the multipliers of a contact are, and a form: h_0, g_0, h_1, ...
#define X_OF(i) ((size_t)2 * (i))
#define Y_OF(i) ((size_t)2 * (i) + 1)

TF_INLINE const tf_real_t *numbers_of_form(const mechanism_t *k, unsigned f) {
  return k->forms + (size_t)f * k->terms;
}

#define JOINT_ROUNDING (16 * TF_REAL_EPSILON)

// Share of its slopes that is added to the own one of an equation, so that
// those of redundant contacts have an inverse. Newton's method then ends next
// to the solution of the least sum of squares.
#define SOFTNESS (TF_R(0x1p10) * TF_REAL_EPSILON)

// The equation for a multiplier: its form (h for x, g for y) is 0, or it is
// held, or y = +-x.
typedef enum { FORM, HELD, RAY_PLUS, RAY_MINUS } equation_t;

// The sign that a form ends with; FROM_0 and TO_0: or 0.
typedef enum { ABOVE, BELOW, FROM_0, TO_0, ANY } sought_t;

typedef struct {
  tf_real_t middle[MULTIPLIERS], half[MULTIPLIERS];
} joint_box_t;

typedef struct {
  equation_t equation[MULTIPLIERS];
  sought_t sought[MULTIPLIERS];
  joint_box_t box;
} problem_t;

// Forms and equations about the middle of a box: values and their rounding,
// slopes by the multipliers, what products and the softness of an equation add
// in the box, and the inverse of the slopes.
typedef struct {
  tf_real_t value[MULTIPLIERS], missed[MULTIPLIERS], rounding[MULTIPLIERS],
      slope[MULTIPLIERS][MULTIPLIERS];
  tf_real_t bend[MULTIPLIERS], softness[MULTIPLIERS],
      inverse[MULTIPLIERS][MULTIPLIERS];
} outlook_t;

// A form about the middle of a box, in the order of form_value: value and
// slopes. Returns what its products add in the box.
TF_INLINE tf_real_t form_at(const mechanism_t *k, unsigned f,
                            const joint_box_t *box, tf_real_t *value,
                            tf_real_t slope[]) {
  const tf_real_t *form = numbers_of_form(k, f), *m = box->middle;
  const tf_real_t *product = form + 1 + k->count;
  tf_real_t bend = 0;
  *value = form[0];
  for (unsigned j = 0; j < k->count; j++) {
    tf_real_t column = form[1 + j];
    slope[j] = column;
    for (unsigned i = 0; i <= j && !k->is_affine; i++, product++) {
      column += m[i] * *product;
      slope[i] += *product * m[j];
      slope[j] += *product * m[i];
      bend += magnitude(*product) * box->half[i] * box->half[j];
    }
    *value += m[j] * column;
  }
  return bend;
}

TF_INLINE bool may_end(sought_t sought, tf_real_t value, tf_real_t reach) {
  const bool is_above = sought == ABOVE || sought == FROM_0;
  const tf_real_t most = (is_above ? value : -value) + reach;
  return sought == ANY || most > 0 || (most == 0 && sought >= FROM_0);
}

// The law lets no multipliers out of this box.
TF_INLINE tf_real_t most_of(unsigned a) {
  return a % 2 == 0 ? MAX_SLIP_FORCE(TF_R(1.0)) : TF_R(1.0);
}

// Whether all forms may hold in the box of a problem, whatever products add.
TF_INLINE bool may_hold(const mechanism_t *k, const problem_t *p) {
  for (unsigned f = 0; f < k->count; f++) {
    const tf_real_t *by = numbers_of_form(k, f) + 1;
    tf_real_t value = by[-1], reach = k->bend[f];
    if (p->sought[f] == ANY && p->equation[f] != FORM) continue;
    for (unsigned a = 0; a < k->count; a++) {
      value += by[a] * p->box.middle[a];
      reach += magnitude(by[a]) * p->box.half[a];
    }
    if (!may_end(p->sought[f], value, reach) ||
        (p->equation[f] == FORM && !within(value, reach)))
      return false;
  }
  return true;
}

// Looks at forms and equations about the middle of a box.
TF_INLINE void look(const mechanism_t *k, const problem_t *p,
                    const joint_box_t *box, outlook_t *out) {
  for (unsigned f = 0; f < k->count; f++) {
    const tf_real_t ray = p->equation[f] == RAY_PLUS ? -1 : 1;
    tf_real_t *slope = out->slope[f], size = 0, sum = 0;
    out->bend[f] = form_at(k, f, box, &out->value[f], slope);
    out->missed[f] = out->value[f];
    for (unsigned a = 0; a < k->count; a++) {
      const tf_real_t by = magnitude(slope[a]);
      sum += by;
      if (by > size) size = by;
    }
    out->rounding[f] =
        JOINT_ROUNDING * (magnitude(numbers_of_form(k, f)[0]) + sum);
    out->softness[f] = SOFTNESS * size;
    if (p->equation[f] == FORM) continue;
    for (unsigned a = 0; a < k->count; a++) slope[a] = a == f ? 1 : 0;
    out->missed[f] = out->bend[f] = out->softness[f] = out->rounding[f] = 0;
    if (p->equation[f] == HELD) continue;
    out->rounding[f] = JOINT_ROUNDING;
    slope[f - 1] = ray;
    out->missed[f] = box->middle[f] + ray * box->middle[f - 1];
  }
}

// Room for the conditions of a middle: multipliers, distance, equations.
#define ROWS (2 * MULTIPLIERS + 1)

// Solves for the columns behind the square ones, by Gauss and Jordan with
// partial pivoting.
TF_INLINE void eliminate(unsigned rows, unsigned columns,
                         tf_real_t w[ROWS][ROWS + 1]) {
  for (unsigned c = 0; c < rows; c++) {
    unsigned best = c;
    for (unsigned e = c + 1; e < rows; e++)
      if (magnitude(w[e][c]) > magnitude(w[best][c])) best = e;
    const tf_real_t pivot = w[best][c];
    for (unsigned a = c; a < columns; a++) {
      const tf_real_t was = w[best][a];
      w[best][a] = w[c][a];
      w[c][a] = was / pivot;
    }
    for (unsigned e = 0; e < rows; e++) {
      const tf_real_t by = w[e][c];
      for (unsigned a = c; a < columns && e != c && by != 0; a++)
        w[e][a] -= by * w[c][a];
    }
  }
}

#endif
