/* Several contacts: one as contact.h has it, redundant ones, rest, the choice,
 * bounds of the room. Their modes and forces: test_joint.c. */
#include "common.h"
#include "twofold/contacts.h"

#define ROOM TF_JOINT_ROOM(TF_CONTACTS)
#define NUMBERS ((size_t)2 * TF_CONTACTS * TF_TERMS(TF_CONTACTS))

/* Forms of n contacts; slips before the step, modes before it. */
typedef struct {
  unsigned n;
  tf_contact_t contact[TF_CONTACTS];
  tf_real_t forms[NUMBERS];
  tf_slip_t now[TF_CONTACTS];
  uint8_t before[TF_CONTACTS];
} mechanism_t;

static tf_real_t *form(mechanism_t *k, unsigned f) {
  return k->forms + (size_t)f * TF_TERMS(k->n);
}

/* The number of the product m_i m_j in a form. */
static size_t product(unsigned n, unsigned i, unsigned j) {
  return i < j ? TF_PRODUCT(n, i, j) : TF_PRODUCT(n, j, i);
}

static mechanism_t any_mechanism(unsigned n, double products, double far) {
  mechanism_t k = {.n = n};
  for (unsigned i = 0; i < n; i++) {
    const tf_tyre_law_t law =
        uniform(0, 1) < 0.8 ? TF_TYRE_JUMP : TF_TYRE_COULOMB;
    const tf_real_t of_rule = uniform(0, TF_RULES);
    const tf_real_t mode = uniform(0, TF_MODES + 1);
    CHECK(tf_contact_prepare(&k.contact[i], law, uniform(0.5, 1.5),
                             uniform(0.05, 1), TF_REST_HULL, (tf_rule_t)of_rule,
                             1) == TF_OK);
    k.now[i] = (tf_slip_t){uniform(-far, far), uniform(-1, 1)};
    k.before[i] = (uint8_t)mode;
  }
  for (unsigned f = 0; f < 2 * n; f++) {
    for (unsigned t = 0; t < TF_TERMS(n); t++)
      form(&k, f)[t] = uniform(-2, 2) * (tf_real_t)(t > 2 * n ? products : 1);
    if (f % 2 == 0) form(&k, f)[0] += k.now[f / 2].h;
    if (f % 2 == 0) form(&k, f)[1 + f] -= 2;
  }
  return k;
}

static unsigned modes_of(const mechanism_t *k, tf_joint_mode_t found[]) {
  unsigned count = 0;
  const tf_status_t status = tf_contacts_modes(k->n, k->contact, k->forms,
                                               k->now, found, ROOM, &count);
  CHECK(status == TF_OK || status == TF_COARSE);
  CHECK(count <= ROOM);
  return count;
}

/* n that do not act on each other: h_i = -x_i, g_i = 1. */
static mechanism_t apart(unsigned n, tf_tyre_law_t law) {
  mechanism_t k = any_mechanism(n, 0, 0);
  memset(k.forms, 0, sizeof k.forms);
  for (unsigned i = 0; i < n; i++) {
    CHECK(tf_contact_prepare(&k.contact[i], law, 1, 1, TF_REST_HULL,
                             TF_RULE_PERSIST, 0) == TF_OK);
    form(&k, 2 * i)[1 + 2 * i] = -1;
    form(&k, 2 * i + 1)[0] = 1;
  }
  return k;
}

TEST(one_contact_is_that_of_contact_h) {
  for (unsigned draw = 0; draw < 20000; draw++) {
    mechanism_t k = any_mechanism(1, 0.1, draw % 2 ? 1 : 8);
    tf_joint_mode_t found[ROOM];
    tf_contact_modes_t modes;
    tf_form_t h, g;
    const unsigned count = modes_of(&k, found);
    unsigned set = 0;
    memcpy(&h, k.forms, sizeof h);
    memcpy(&g, k.forms + 6, sizeof g);
    CHECK(tf_contact_modes(k.contact, &h, &g, k.now[0], k.before[0], &modes,
                           NULL) == TF_OK);
    for (unsigned j = 0; j < count; j++) {
      const unsigned mode = found[j].mode[0];
      tf_force_t one = {1, 1}, joint = {2, 2};
      set |= TF_MODE_BIT(mode);
      CHECK(tf_contact_force(k.contact, &h, &g, &modes, mode, k.now[0], &one) ==
            TF_OK);
      CHECK(tf_contacts_force(1, k.contact, k.forms, &found[j], k.now,
                              &joint) == TF_OK);
      CHECK(memcmp(&one, &joint, sizeof one) == 0);
      if (!tf_mode_is_slip(mode) && mode != TF_PINNED)
        CHECK(found[j].x[0] == modes.x[mode - TF_STICK_PLUS]);
    }
    CHECK(set == modes.set);
    const unsigned one =
        tf_contact_choose(k.contact, &modes, k.before[0], draw, 5);
    const unsigned joint =
        tf_contacts_choose(1, k.contact, found, count, k.before, draw, 5);
    CHECK(one == (joint < count ? found[joint].mode[0] : TF_NO_MODE));
  }
}

/* Three wheels of a rigid body that share two degrees of freedom: the motion is
 * unique, the forces are not. Those of the least sum of squares are equal. */
TEST(redundant_contacts_share_the_force) {
  mechanism_t k = apart(3, TF_TYRE_COULOMB);
  for (unsigned i = 0; i < 3; i++) {
    form(&k, 2 * i)[0] = TF_R(1.5);
    for (unsigned j = 0; j < 3; j++) form(&k, 2 * i)[1 + 2 * j] = -1;
  }
  tf_joint_mode_t found[ROOM];
  const unsigned count = modes_of(&k, found);
  unsigned sticks = 0;
  for (unsigned j = 0; j < count; j++)
    for (unsigned i = 0; i < 3; i++) {
      if (found[j].mode[0] != TF_STICK_PLUS ||
          found[j].mode[1] != TF_STICK_PLUS ||
          found[j].mode[2] != TF_STICK_PLUS)
        continue;
      sticks++;
      CHECK(fabsl(wide(found[j].x[i]) - 0.5L) < 0x1p14L * EPSILON);
    }
  CHECK(sticks == 3);
}

/* A plate on three wheels that rests under a small push does so in one mode,
 * though others hold but for rounding. With the products of its turn it does
 * not: contacts.h has their shares. */
TEST(plate_at_rest_has_one_future) {
  static const double masses[3] = {2, 2, 0.05};
  static const double place[3][3] = {
      {0.3, 0, 0.4}, {-0.2, 0.25, 1.7}, {-0.15, -0.22, 2.9}};
  unsigned none = 0, several = 0, coarse = 0, count;
  for (unsigned draw = 0; draw < 600; draw++) {
    mechanism_t k = any_mechanism(3, 0, 0);
    const double most = draw % 3 ? 0.4 : 40;
    const bool turns = draw % 3 == 2;
    const double push[3] = {uniform(-most, most), uniform(-0.4, 0.4), 0.02};
    double rows[6][3], u[3][7]; /* speeds by 1 and m */
    memset(k.forms, 0, sizeof k.forms);
    for (unsigned i = 0; i < 3; i++) {
      const double c = cos(place[i][2]), s = sin(place[i][2]);
      const double x = place[i][0], y = place[i][1];
      const double of[2][3] = {{-s, c, c * x + s * y}, {c, s, s * x - c * y}};
      memcpy(rows[(size_t)2 * i], of, sizeof of);
      CHECK(tf_contact_prepare(&k.contact[i], TF_TYRE_JUMP, 2, TF_R(0.05),
                               TF_REST_HULL, TF_RULE_RANDOM, 0) == TF_OK);
    }
    for (unsigned e = 0; e < 3; e++)
      for (unsigned a = 0; a < 7; a++)
        u[e][a] = 1e-3 / masses[e] *
                  (a == 0  ? push[e]
                   : a % 2 ? -2 * rows[a - 1][e]
                           : (e == 2) * 0.1);
    for (unsigned t = 0; t < 6 * 3 * 7 * 7; t++) {
      const unsigned f = t / 147, e = t / 49 % 3, a = t / 7 % 7, b = t % 7;
      const double turn = e == 2 ? 0 : f % 2 ? rows[f - 1][e] : -rows[f + 1][e];
      const double by = (b == 0) * rows[f][e] + turns * 1e-3 * turn * u[2][b];
      form(&k, f)[a && b ? product(3, a - 1, b - 1) : a + b] +=
          (tf_real_t)(by * u[e][a]);
    }
    tf_joint_mode_t found[ROOM];
    coarse += tf_contacts_modes(3, k.contact, k.forms, k.now, found, ROOM,
                                &count) == TF_COARSE;
    none += count == 0;
    several += turns && count > 1;
    CHECK(turns || count == 1 || (count > 0 && draw % 3 == 0));
    for (unsigned i = 0; i < 3 && draw % 3 == 1; i++)
      CHECK(found[0].mode[i] == TF_PINNED);
  }
  printf("# of 200 with products: %u coarse, %u in no mode, %u in several\n",
         coarse, none, several);
  CHECK(coarse > 0 && several > 0);
}

/* A slip with h = 8 epsilon ends where a stick attracts, and is another future
 * where it does not. */
TEST(slip_beside_a_stick_is_a_future) {
  for (int sign = -1; sign <= 1; sign += 2) {
    mechanism_t k = apart(2, TF_TYRE_JUMP);
    tf_joint_mode_t found[ROOM];
    form(&k, 0)[0] = 8 * TF_REAL_EPSILON - (tf_real_t)sign;
    form(&k, 0)[1] = (tf_real_t)sign;
    unsigned slips = 0, sticks = 0;
    for (unsigned j = modes_of(&k, found); j-- > 0;) {
      slips += found[j].mode[0] == TF_SLIP_PLUS;
      sticks += found[j].mode[0] == TF_STICK_PLUS;
    }
    CHECK(slips == (sign > 0) && sticks == 1);
  }
}

TEST(what_is_out_of_range_is_refused) {
  mechanism_t k = any_mechanism(2, 0, 1);
  tf_joint_mode_t found[ROOM], few[1];
  tf_force_t force[TF_CONTACTS] = {{3, 3}};
  unsigned count = 77, all;
  for (unsigned n = 0; n <= TF_CONTACTS + 1; n += TF_CONTACTS + 1) {
    CHECK(tf_contacts_modes(n, k.contact, k.forms, k.now, found, ROOM,
                            &count) == TF_BAD_PARAMETER);
    CHECK(tf_contacts_force(n, k.contact, k.forms, NULL, k.now, force) ==
          TF_BAD_PARAMETER);
    CHECK(tf_contacts_choose(n, k.contact, found, 3, k.before, 1, 1) == 3);
  }
  CHECK(tf_contacts_force(2, k.contact, k.forms, NULL, k.now, force) ==
        TF_DEGRADED);
  const tf_force_t law = tf_tyre_force(
      &k.contact[1].tyre, k.now[1].h < 0 ? -1 : 1, k.now[1].h, k.now[1].g);
  CHECK(fabsl(wide(force[1].F - law.F)) < 16 * EPSILON);
  for (unsigned draw = 0; draw < 50; draw++) {
    const mechanism_t many = any_mechanism(3, 0, 1);
    all = modes_of(&many, found);
    CHECK(tf_contacts_modes(3, many.contact, many.forms, many.now, few, 1,
                            &count) >= TF_OK);
    CHECK(count == all);
    const mechanism_t one = any_mechanism(1, 0, 1);
    CHECK(tf_contacts_modes(1, one.contact, one.forms, one.now, few, 0,
                            &count) == TF_OK);
    CHECK(count == modes_of(&one, found));
    (void)modes_of(&many, found);
    CHECK(memcmp(few[0].mode, found[0].mode, sizeof few[0].mode) == 0);
  }
  count = 77;
  for (unsigned wrong = 0; wrong < 2; wrong++) {
    mechanism_t other = any_mechanism(2, 0, 1);
    CHECK(tf_contact_prepare(&other.contact[1], TF_TYRE_COULOMB, 1, 1,
                             TF_REST_HULL, TF_RULE_PERSIST, 0) == TF_OK);
    form(&other, 2)[3] = wrong ? 0 : TF_R(0.1);
    form(&other, 2)[4] = -1;
    CHECK(tf_contacts_modes(2, other.contact, other.forms, other.now, found,
                            ROOM, &count) == TF_BAD_PARAMETER);
  }
  for (unsigned wrong = 0; wrong < 4; wrong++) {
    CHECK(modes_of(&k, found) >= 1);
    if (wrong == 0) found[0].x[1] = (tf_real_t)NAN;
    if (wrong == 1) found[0].y[0] = -3;
    if (wrong >= 2) found[0].mode[1] = wrong == 2 ? TF_MODES : 200;
    CHECK(tf_contacts_force(2, k.contact, k.forms, found, k.now, force) ==
          TF_BAD_STATE);
  }
  k.before[1] = TF_NO_MODE + 1;
  count = modes_of(&k, found);
  CHECK(tf_contacts_choose(2, k.contact, found, count, k.before, 1, 1) ==
        count);
  count = 77;
  k.forms[7] = (tf_real_t)NAN;
  CHECK(tf_contacts_modes(2, k.contact, k.forms, k.now, found, ROOM, &count) ==
        TF_BAD_STATE);
  CHECK(tf_contacts_force(2, k.contact, k.forms, found, k.now, force) ==
        TF_BAD_STATE);
  CHECK(count == 77);
}

/* A whole number of quarters, up to most of them on either side. */
static tf_real_t quarters(int most) {
  return (tf_real_t)((int)(tap_bits() % (2u * (unsigned)most + 1)) - most) / 4;
}

/* Bodies of three freedoms, whose numbers tie at corners of the law. */
TEST(no_set_is_empty_under_the_hull) {
  unsigned empty = 0;
  for (unsigned draw = 0; draw < 20000; draw++) {
    mechanism_t k = any_mechanism(2, 0, 0);
    tf_joint_mode_t found[ROOM];
    tf_real_t row[4][3], force[4][3];
    unsigned count = 0;
    const tf_rest_law_t rest = draw % 2 ? TF_REST_HULL : TF_REST_BOW_TIE;
    memset(k.forms, 0, sizeof k.forms);
    for (unsigned i = 0; i < 2; i++)
      CHECK(tf_contact_prepare(&k.contact[i], TF_TYRE_JUMP, 1, TF_R(0.5), rest,
                               TF_RULE_PERSIST, 0) == TF_OK);
    for (unsigned f = 0; f < 4; f++)
      for (unsigned d = 0; d < 3; d++) {
        row[f][d] = quarters(4);
        force[f][d] = f % 2 ? quarters(2) : -row[f][d];
      }
    for (unsigned d = 0; d < 3; d++) {
      const tf_real_t speed = quarters(4);
      for (unsigned f = 0; f < 4; f++) {
        form(&k, f)[0] += row[f][d] * speed;
        for (unsigned b = 0; b < 4; b++)
          form(&k, f)[1 + b] += row[f][d] * force[b][d];
      }
    }
    const tf_status_t status =
        tf_contacts_modes(2, k.contact, k.forms, k.now, found, ROOM, &count);
    empty += count == 0 && rest == TF_REST_HULL;
    CHECK(status == TF_COARSE || count > 0 || rest != TF_REST_HULL);
  }
  printf("# empty under the hull, TF_COARSE: %u\n", empty);
}

/* Contacts choose one after another; no slip enters a stick that does not
 * attract, and what is consistent for all goes on. */
TEST(choice_is_admissible) {
  unsigned none = 0, goes_on = 0;
  for (unsigned draw = 0; draw < 4000; draw++) {
    const mechanism_t k = any_mechanism(2 + draw % 2, 0, 1);
    tf_joint_mode_t found[ROOM];
    uint8_t before[TF_CONTACTS];
    const unsigned count = modes_of(&k, found);
    for (unsigned j = 0; j <= count; j++) { /* from each, and from any */
      memcpy(before, j < count ? found[j].mode : k.before, sizeof before);
      const unsigned choice =
          tf_contacts_choose(k.n, k.contact, found, count, before, draw, 5);
      CHECK(choice <= count);
      none += choice == count;
      unsigned slips = 0;
      for (unsigned i = 0; i < k.n; i++) {
        slips += tf_mode_is_slip(before[i]);
        if (choice == count || !tf_mode_is_slip(before[i])) continue;
        CHECK(tf_mode_is_slip(found[choice].mode[i]) ||
              found[choice].mode[i] == TF_PINNED ||
              (found[choice].attracting >> i) & 1u);
      }
      if (j == count || slips < k.n) continue;
      CHECK(choice == j);
      goes_on++;
    }
  }
  CHECK(none > 0 && goes_on > 100);
}

/* h touches 0 next to the border of the law: no box of double shows how often,
 * and one of float is as small as rounding. */
TEST(form_that_touches_zero_is_found) {
  mechanism_t k = apart(2, TF_TYRE_COULOMB);
  tf_joint_mode_t found[ROOM];
  unsigned count = 0;
  const tf_real_t at = -1 + 64 * TF_REAL_EPSILON;
  form(&k, 0)[0] = -at * at;
  form(&k, 0)[1] = 2 * at;
  form(&k, 0)[product(2, 0, 0)] = -1;
  CHECK(tf_contacts_modes(2, k.contact, k.forms, k.now, found, ROOM, &count) ==
        (IS_DOUBLE ? TF_COARSE : TF_OK));
  CHECK(count == 1);
}

/* h = 0 exactly at the end of a slip is the stick with that force. */
TEST(slip_that_ends_at_zero_is_a_stick) {
  mechanism_t k = apart(2, TF_TYRE_COULOMB);
  tf_joint_mode_t found[ROOM];
  form(&k, 0)[0] = 1;
  form(&k, 2)[0] = -1;
  form(&k, 3)[0] = 0;
  for (int side = -1; side <= 1; side += 2) { /* and g = 0 has that before */
    k.now[1].g = (tf_real_t)side;
    CHECK(modes_of(&k, found) == 1);
    CHECK(found[0].mode[1] == (side > 0 ? TF_STICK_PLUS : TF_STICK_MINUS));
  }
  CHECK(found[0].mode[0] == TF_STICK_PLUS && found[0].x[0] == 1);
  CHECK(found[0].mode[1] == TF_STICK_PLUS && found[0].x[1] == -1);
}

/* Redundant contacts whose products do not cancel, or are of x_0 + x_1. */
TEST(redundant_contacts_that_turn_end) {
  unsigned found_some = 0, coarse = 0, count = 0;
  for (unsigned draw = 0; draw < 300; draw++) {
    mechanism_t k = any_mechanism(2, 1e-3, 1);
    tf_joint_mode_t found[ROOM];
    for (unsigned t = 0; t <= 4; t++) {
      form(&k, 2)[t] = form(&k, 0)[t];
      form(&k, 3)[t] = form(&k, 1)[t];
    }
    for (unsigned f = 0; f < 4; f++)
      for (unsigned t = 1; t <= 2; t++) form(&k, f)[2 + t] = form(&k, f)[t];
    for (unsigned f = 0; f < 4; f += 2) form(&k, f)[1] = form(&k, f)[3] = -1;
    for (unsigned f = 0; f < 4 && draw % 2; f++) {
      tf_real_t *q = form(&k, f);
      const tf_real_t by = form(&k, f % 2)[product(2, 0, 0)];
      for (unsigned t = 5; t < TF_TERMS(2); t++) q[t] = 0;
      q[product(2, 0, 0)] = q[product(2, 2, 2)] = by;
      q[product(2, 0, 2)] = 2 * by;
    }
    coarse += tf_contacts_modes(2, k.contact, k.forms, k.now, found, ROOM,
                                &count) == TF_COARSE;
    found_some += count > 0;
  }
  CHECK(found_some > 0 && coarse > 0);
}
