/// What every race needs: a clock, and the order of times. A file that includes
/// this defines _POSIX_C_SOURCE first.
#pragma once

#include <stdlib.h>
#include <time.h>

static inline double timing_read(clockid_t clock) {
  struct timespec now;
  clock_gettime(clock, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/// Seconds that have passed.
static inline double timing_wall(void) { return timing_read(CLOCK_MONOTONIC); }

/// Seconds of the processor that this process took.
static inline double timing_process(void) {
  return timing_read(CLOCK_PROCESS_CPUTIME_ID);
}

/// Of doubles, for qsort.
static inline int timing_ascending(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/// Puts times in order: the median is time[n / 2].
static inline void timing_sort(double *time, size_t n) {
  qsort(time, n, sizeof *time, timing_ascending);
}
