// How far perturbed runs are from what the set-valued law allows.
//
// From the two-fold the law without a perturbation allows a family of runs:
// stick along one curve for any time, then slip to either side. Where such a
// run passes a section r = const, in the plane of (time since the two-fold,
// phase of the winding), is a curve. A perturbed run that passes there on the
// curve cannot be distinguished from one of the family; one that is not of the
// family has no reason to, for it is a curve in a plane. So the distance from
// it is measured, in units of the spread of the family (standard deviations of
// time and of phase).
//
//   nearest FAMILY RUNS
//
// Both files are of tools/study/statistics/passages.py. The curve is the chords
// between members that follow one another in the time of exit, to the same
// side; a gap of more than a tenth of the spread is none. Prints one distance a
// run.

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define GAP 0.1

typedef struct {
  double side, exit, time, phase;
} run_t;

typedef struct {
  run_t *runs;
  size_t count, room;
} runs_t;

static int fail(const char *what, const char *name) {
  (void)fprintf(stderr, "nearest: %s: %s\n", name, what);
  return 3;
}

static int read_runs(runs_t *all, const char *name) {
  FILE *file = fopen(name, "r");
  char line[256];
  if (file == NULL) {
    return fail("cannot be read", name);
  }
  int code = 0;
  while (code == 0 && fgets(line, sizeof line, file) != NULL) {
    if (all->count == all->room) {
      const size_t room = all->room > 0 ? 2 * all->room : 1024;
      run_t *more = realloc(all->runs, room * sizeof *more);
      if (more == NULL) {
        code = fail("out of memory", name);
        break;
      }
      all->runs = more;
      all->room = room;
    }
    double value[4];
    char *at = line;
    for (int i = 0; i < 4; i++) {
      char *end = at;
      value[i] = strtod(at, &end);
      code = end == at ? fail("a line without four numbers", name) : code;
      at = end;
    }
    const run_t run = {value[0], value[1], value[2], value[3]};
    all->runs[all->count++] = run;
  }
  (void)fclose(file);
  return code;
}

static int by_exit(const void *left, const void *right) {
  const run_t *a = left, *b = right;
  if (a->side != b->side) {
    return a->side < b->side ? -1 : 1;
  }
  return (a->exit > b->exit) - (a->exit < b->exit);
}

// Standard deviations of time and phase, which become 1.
static void scale_of(const runs_t *all, double *time, double *phase) {
  double n = (double)all->count, t1 = 0, p1 = 0, t2 = 0, p2 = 0;
  for (size_t i = 0; i < all->count; i++) {
    t1 += all->runs[i].time / n;
    p1 += all->runs[i].phase / n;
  }
  for (size_t i = 0; i < all->count; i++) {
    t2 += (all->runs[i].time - t1) * (all->runs[i].time - t1) / n;
    p2 += (all->runs[i].phase - p1) * (all->runs[i].phase - p1) / n;
  }
  *time = sqrt(t2);
  *phase = sqrt(p2);
}

static double distance(const run_t *at, const run_t *a, const run_t *b) {
  const double x = b->time - a->time, y = b->phase - a->phase;
  const double p = at->time - a->time, q = at->phase - a->phase;
  const double length = x * x + y * y;
  const double part =
      length > 0 ? fmin(fmax((p * x + q * y) / length, 0), 1) : 0;
  return hypot(p - part * x, q - part * y);
}

static double nearest(const runs_t *family, const run_t *at) {
  double least = DBL_MAX;
  for (size_t i = 0; i + 1 < family->count; i++) {
    const run_t *a = &family->runs[i], *b = a + 1;
    const int one_curve = a->side == b->side &&
                          hypot(b->time - a->time, b->phase - a->phase) < GAP;
    // A member that ends a curve is a curve of its own.
    least = fmin(least, distance(at, a, one_curve ? b : a));
  }
  return least;
}

static void rescale(runs_t *all, double time, double phase) {
  for (size_t i = 0; i < all->count; i++) {
    all->runs[i].time /= time;
    all->runs[i].phase /= phase;
  }
}

int main(int argc, char *argv[]) {
  runs_t family = {NULL, 0, 0}, runs = {NULL, 0, 0};
  if (argc != 3) {
    (void)fputs("usage: nearest FAMILY RUNS\n", stderr);
    return 2;
  }
  int code = read_runs(&family, argv[1]);
  code = code == 0 ? read_runs(&runs, argv[2]) : code;
  if (code == 0 && family.count < 2) {
    code = fail("fewer than two runs", argv[1]);
  }
  if (code == 0) {
    double time = 0, phase = 0;
    qsort(family.runs, family.count, sizeof *family.runs, by_exit);
    scale_of(&family, &time, &phase);
    rescale(&family, time, phase);
    rescale(&runs, time, phase);
    for (size_t i = 0; i < runs.count; i++) {
      (void)printf("%.6g\n", nearest(&family, &runs.runs[i]));
    }
  }
  free(family.runs);
  free(runs.runs);
  return code;
}
