/// @file
/// The rows of `reference table`: the classes of machines.
#ifndef REFERENCE_ROWS_H
#define REFERENCE_ROWS_H

#include "judge.h"

/// What the reference met on the way.
typedef struct {
  int through;        ///< times at h = g = 0
  int events;         ///< all of them
  double stuck;       ///< shortest stick that came to h = g = 0 from a slip [s]
  bool rested;        ///< stood on the turntable
  bool left_rest;     ///< and did not stay there
  bool several;       ///< a choice that the rule does not make sharply
  bool passed_r;      ///< r changed its sign
  real_t stick_since; ///< -1: not in stick, or not from a slip
} met_t;

enum { ROW_STEPS = 3, ROW_MODELS = 7 };

/// One kind of run of the library.
typedef struct {
  lib_scheme_t scheme;
  const lib_real_t *real;
} model_t;
extern const model_t row_models[ROW_MODELS];

/// Which inputs move: of every other machine any shape, or of all.
typedef enum { MOVE_HALF, MOVE_ALL, MOVE_RAMP, MOVE_THROUGH_ZERO } move_t;

typedef struct {
  const char *name, *about;
  double t_end;
  double dt[ROW_STEPS]; ///< 0: no more
  double located;       ///< of dt, in located steps
  double least;         ///< dt of the shortest steps of `located` and lanes
  bool plain;           ///< without compensated double, located and lanes
  bool order; ///< counts errors that do not fall as dt^1.5, not those above 2 %
  bool rests; ///< takes a wheel that stands on the turntable if it stays
  move_t moves;
  /// Changes a random machine; NULL: not.
  void (*place)(draw_t *draw, lib_machine_t *machine);
  bool (*takes)(const met_t *met); ///< NULL: all
} row_t;

/// A machine of a row; inputs that move by half do where `moves`.
lib_machine_t row_machine(draw_t *draw, const row_t *row, bool moves);

enum { ROWS = 13 };
extern const row_t rows[ROWS];

#endif
