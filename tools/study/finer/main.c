// finer - follows motions of the wheel under a law of friction without a jump,
// in one precision of arithmetic; see tools/study/finer/study.
//
// usage: finer [NAME=VALUE]...
//
// Names: form (law.h) and width; the machine's parameters, by default those of
// scene `chaos`; r, w, x: the start [m, rad/s, h in widths], by default where
// `chaos` lands in the sliding region before the two-fold; until, fold, exit,
// kick, step, columns (follow.h); tolerance of a step. samples, seed, delta:
// that many motions, in which kick is multiplied and w changed (by the share
// delta) by draws from (-1, 1).
//
// Writes a line for each motion, with the columns of `head`.
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "follow.h"

typedef struct {
  machine_t machine;
  course_t course;
  double r, w, x, tolerance, delta, samples, seed, columns;
} options_t;

static const char head[] =
    "form,bits,width,delta,kick,side,fold_t,exit_t,exit_r,zero_t,zero_r,"
    "before,behind,windings,steps,error,t,r,v,w";

#define OF_MACHINE(name) \
  { #name, offsetof(options_t, machine.name) }
#define OF_COURSE(name) \
  { #name, offsetof(options_t, course.name) }
#define OWN(name) \
  { #name, offsetof(options_t, name) }
static const struct {
  const char *name;
  size_t offset;
} names[] = {OF_MACHINE(m),
             OF_MACHINE(d),
             OF_MACHINE(beta),
             OF_MACHINE(k2),
             OF_MACHINE(c1),
             OF_MACHINE(c2),
             OF_MACHINE(r0),
             OF_MACHINE(omega0),
             OF_MACHINE(mu),
             OF_MACHINE(kappa),
             OF_MACHINE(gamma),
             OF_MACHINE(width),
             OF_COURSE(until),
             OF_COURSE(fold),
             OF_COURSE(exit),
             OF_COURSE(kick),
             OF_COURSE(step),
             OWN(r),
             OWN(w),
             OWN(x),
             OWN(tolerance),
             OWN(delta),
             OWN(samples),
             OWN(seed),
             OWN(columns)};

static bool set_form(options_t *o, const char *word) {
  for (int f = 0; f < FORMS; f++)
    if (strncmp(word, "form=", 5) == 0 &&
        strcmp(word + 5, form_names[f]) == 0) {
      o->machine.form = (form_t)f;
      return true;
    }
  return false;
}

static bool set_number(options_t *o, const char *word) {
  for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
    const size_t length = strlen(names[n].name);
    if (strncmp(word, names[n].name, length) != 0 || word[length] != '=')
      continue;
    char *end;
    const double value = strtod(word + length + 1, &end);
    memcpy((char *)o + names[n].offset, &value, sizeof value);
    return *end == 0 && end != word + length + 1;
  }
  return false;
}

// splitmix64, in (-1, 1)
static double draw(uint64_t *seed) {
  uint64_t z = (*seed += UINT64_C(0x9e3779b97f4a7c15));
  z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
  z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
  return (double)((z ^ (z >> 31)) >> 11) / 0x1p52 - 1;
}

static void sample(const options_t *o, motion_t *k, double delta,
                   course_t course) {
  point_t p = {.t = 0};
  p.x[0] = (real_t)o->r;
  p.x[2] = (real_t)o->w * (1 + (real_t)delta);
  const real_t g = slip_at(k, (real_t[]){p.x[0], 0, p.x[2]}).g;
  p.x[1] = speed_for(k, p.x[0], p.x[2], (real_t)o->x * layer_width(k, g));
  k->steps = 0;
  k->error = 0;
  const outcome_t out = follow(k, &course, p);
  printf(
      "%s,%d,%.6g,%.6g,%.6g,%d,%.12g,%.12g,%.12g,%.12g,%.12g,%.9g,%.9g,"
      "%d,%ld,%.3g,%.12g,%.17g,%.17g,%.17g\n",
      form_names[o->machine.form], FINER_BITS, o->machine.width, delta,
      course.kick, out.side, out.fold_t, out.exit_t, out.exit_r, out.zero_t,
      out.zero_r, out.before, out.behind, out.windings, k->steps,
      (double)k->error, (double)out.end.t, (double)out.end.x[0],
      (double)out.end.x[1], (double)out.end.x[2]);
}

int main(int argc, char **argv) {
  options_t o = {.machine = {.m = 1,
                             .d = 1,
                             .beta = 0.05,
                             .k2 = 2.2270992253886014441,
                             .c1 = 1e-3,
                             .c2 = 1e-3,
                             .r0 = 0.1,
                             .omega0 = -1,
                             .mu = 1,
                             .kappa = 0.27241153714062027818,
                             .gamma = -2.35619449019234492885,
                             .width = 1e-4},
                 .course = {.until = 3, .fold = 0.1859, .exit = 3},
                 .r = 0.191960972,
                 .w = -1.053244828,
                 .samples = 1,
                 .columns = COLUMNS};
  for (int n = 1; n < argc; n++)
    if (!set_form(&o, argv[n]) && !set_number(&o, argv[n])) {
      fprintf(stderr, "finer: %s: not NAME=VALUE, or not a name\n", argv[n]);
      return 2;
    }
  if (!(o.columns >= 2 && o.columns <= COLUMNS) || !(o.machine.width > 0)) {
    fprintf(stderr, "finer: columns is 2 to %d, width > 0\n", COLUMNS);
    return 2;
  }
  o.course.columns = (int)o.columns;
  motion_t k = motion_of(&o.machine, o.tolerance);
  uint64_t seed = (uint64_t)o.seed;
  puts(head);
  for (int n = 0; n < o.samples; n++) {
    course_t course = o.course;
    const double of_start = o.samples > 1 ? draw(&seed) : 1;
    course.kick *= o.samples > 1 ? draw(&seed) : 1;
    sample(&o, &k, o.delta * of_start, course);
  }
  return 0;
}
