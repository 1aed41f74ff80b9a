/// @file
/// An arrow in the middle of an orbit: the way that it points.
#ifndef TWOFOLD_FIGURES_ARROW_H
#define TWOFOLD_FIGURES_ARROW_H

typedef struct {
  double x, y;
} arrow_t;

/// Of point i of a path of which every `every`-th is drawn, from first to last:
/// the way to the next one where the middle lies between them, else 0.
static inline arrow_t arrow_at(double path[][2], int first, int last, int i,
                               int every) {
  const int middle = first + (last - first) / 2;
  const int next = i + every < last ? i + every : last;
  const int here = i <= middle && middle < next;
  const arrow_t none = {0, 0};
  const arrow_t forth = {path[next][0] - path[i][0],
                         path[next][1] - path[i][1]};
  return here ? forth : none;
}

#endif
