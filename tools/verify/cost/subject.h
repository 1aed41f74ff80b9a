// What functions are called with: a machine, a state, inputs and a few numbers,
// all of them spelled by genes, so that a search can vary any of it and the
// worst that it finds can be called again.
#ifndef COST_SUBJECT_H
#define COST_SUBJECT_H

#include <stdbool.h>
#include <stdint.h>

#include "twofold.h"

#define GENES 64
typedef struct {
  uint32_t gene[GENES];
} genes_t;

// Parameters that have a gene: all but the budget of segments, the last.
#define DRAWN_PARAMETERS (TF_PARAMETERS - 1)
// Genes from here on are the functions' own.
#define OWN_GENES 44

typedef struct {
  const genes_t *genes;
  tf_params_t params;
  tf_compensated_t machine;
  tf_state_t state;
  tf_compensation_t compensation;
  tf_input_t input;
  unsigned units; // bytes, states or segments that it gets
  bool valid;     // false: tf_prepare or tf_begin refused
} subject_t;

// The subject that the genes spell.
subject_t subject_of(const genes_t *genes);

// A real of any size and sign, 0, subnormals and simple numbers among them.
tf_real_t real_of(uint32_t gene);
// One with a magnitude between two powers of two, or 0.
tf_real_t sized_of(uint32_t gene, int low, int high);

// The public functions whose cost depends on what they are given, with inputs
// that a subject's genes choose: calls.c.

// Counts one call, or the most expensive of a few; 0 where the subject is none
// for it.
typedef uint32_t (*counted_t)(const subject_t *s);

typedef struct {
  const char *name; // without the suffix of the real type
  counted_t count;
  long weight;    // how many of the trials it gets, 1 the usual
  unsigned kinds; // how many `units` are looked at; of steps alone several
  uint16_t units[4];
} call_t;

extern const call_t calls[];
extern const unsigned call_count;

#endif
