/// @file
/// The simulator behind one table of functions in double, so that a driver can
/// hold its float and its double build side by side. library.c is compiled
/// twice, once for each.
#ifndef REFERENCE_LIBRARY_H
#define REFERENCE_LIBRARY_H

#include "machine.h"

typedef enum {
  LIB_STEP,
  LIB_LOCATED,
  LIB_COMPENSATED,
  LIB_SCHEMES,
  LIB_LANES = LIB_SCHEMES ///< tf_ensemble_step, the same state in each lane
} lib_scheme_t;

/// What one step reports, and the state at its end.
typedef struct {
  int status, mode;
  double F, M, h, g;
  double r, v, w;
} lib_row_t;

/// A machine and its state; the bytes belong to library.c.
typedef union {
  long double align;
  unsigned char bytes[4096];
} lib_t;

typedef struct {
  const char *name;
  /// Prepares and starts; returns the status of the library.
  int (*open)(lib_t *lib, const lib_machine_t *machine, lib_scheme_t scheme,
              lib_row_t *row);
  int (*step)(lib_t *lib, lib_row_t *row);
  double epsilon;
} lib_table_t;

extern const lib_table_t lib_f64, lib_f32;
extern const char *const lib_scheme_names[LIB_SCHEMES + 1];

/// Ends of the range of a parameter, by its name.
void lib_range(const char *name, double *low, double *high);

#endif
