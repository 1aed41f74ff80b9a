// The public functions whose cost depends on what they are given, with inputs
// that a subject's genes choose.
#ifndef COST_CALLS_H
#define COST_CALLS_H

#include "verify/cost/subject.h"

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
