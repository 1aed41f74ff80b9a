/// @file
/// The numbers of a row, for whoever writes or holds one: name, unit and value,
/// of a time t, a state and its report. A column more is a line more, here.
#ifndef TWOFOLD_COLUMNS_H
#define TWOFOLD_COLUMNS_H

/// TIME, NUMBER: of CSV. OTHER: only of rows that hold all.
#define EACH_COLUMN(TIME, NUMBER, OTHER) \
  TIME(t, "s", t)                        \
  NUMBER(r, "m", state->r)               \
  NUMBER(v, "m/s", state->v)             \
  NUMBER(omega, "rad/s", state->w)       \
  OTHER(phi, "rad", state->phi)          \
  NUMBER(h, "m/s", report->slip.h)       \
  NUMBER(g, "m/s", report->slip.g)       \
  NUMBER(F, "N", report->force.F)        \
  NUMBER(M, "N m", report->force.M)      \
  OTHER(delassus, "1/kg", report->delassus)

#define COLUMN_NAME(name, unit, value) #name ","
#define COLUMN_NONE(name, unit, value)

/// The first line of CSV, without its newline.
#define COLUMN_HEADER \
  EACH_COLUMN(COLUMN_NAME, COLUMN_NAME, COLUMN_NONE) "mode,choices,set"

#endif
