// JSON has no infinities; the core only returns two-folds whose numbers are all
// finite.

#include "two_fold.h"

// "name": value
static void add_pair(cli_buffer_t *text, const char *name, tf_real_t value) {
  cli_add(text, "\"");
  cli_add(text, name);
  cli_add(text, "\": ");
  cli_add_real(text, value);
}

// A line of pairs, with a comma after the last one.
static void add_pairs(cli_buffer_t *text, const char *margin,
                      const char *const *names, const tf_real_t *values,
                      int count) {
  cli_add(text, margin);
  cli_add(text, "  ");
  for (int i = 0; i < count; i++) {
    add_pair(text, names[i], values[i]);
    cli_add(text, i + 1 < count ? ", " : ",\n");
  }
}

static void add_K(cli_buffer_t *text, const tf_two_fold_t *at,
                  tf_real_t scale) {
  static const char *const names[] = {"K++", "K+-", "K-+", "K--"};
  const tf_real_t values[] = {at->Kpp, at->Kpm, at->Kmp, at->Kmm};
  for (int i = 0; i < 4; i++) {
    add_pair(text, names[i], scale * values[i]);
    cli_add(text, i < 3 ? ", " : "");
  }
}

static void add_direction(cli_buffer_t *text, const tf_direction_t *direction) {
  cli_add(text, "{");
  add_pair(text, "eigenvalue", direction->value);
  cli_add(text, ", \"velocity\": [");
  cli_add_real(text, direction->velocity.r);
  cli_add(text, ", ");
  cli_add_real(text, direction->velocity.v);
  cli_add(text, ", ");
  cli_add_real(text, direction->velocity.w);
  cli_add(text, "], \"lambda\": ");
  if (direction->sticks) {
    cli_add_real(text, direction->lambda);
  } else {
    cli_add(text, "null");
  }
  cli_add(text,
          direction->sticks ? ", \"sticks\": true}" : ", \"sticks\": false}");
}

void cli_add_two_fold(cli_buffer_t *text, const tf_two_fold_t *at,
                      const char *margin) {
  static const char *const point_names[] = {"r", "v", "omega", "g"};
  static const char *const form_names[] = {"J1", "J2"};
  static const char *const cases[] = {"null", "1", "2", "3"};
  const tf_real_t point[] = {at->point.r, at->point.v, at->point.w,
                             at->point.g};
  const tf_real_t form[] = {at->J1, at->J2};
  const bool through_first = at->through.value > at->across.value;
  const tf_direction_t *first = through_first ? &at->through : &at->across;
  const tf_direction_t *second = through_first ? &at->across : &at->through;
  cli_add(text, margin);
  cli_add(text, "{\n");
  add_pairs(text, margin, point_names, point, 4);
  cli_add(text, margin);
  cli_add(text, "  ");
  add_K(text, at, at->time_scale * at->time_scale);
  cli_add(text, ",\n");
  add_pairs(text, margin, form_names, form, 2);
  cli_add(text, margin);
  cli_add(text, "  \"eigenvalues\": [");
  cli_add_real(text, first->value);
  cli_add(text, ", ");
  cli_add_real(text, second->value);
  cli_add(text, "],\n");
  cli_add(text, margin);
  cli_add(text, "  \"directions\": [\n    ");
  cli_add(text, margin);
  add_direction(text, first);
  cli_add(text, ",\n    ");
  cli_add(text, margin);
  add_direction(text, second);
  cli_add(text, "],\n");
  cli_add(text, margin);
  cli_add(text, "  \"type\": \"");
  cli_add(text, tf_folds_name(at->type));
  cli_add(text, "\", \"case\": ");
  cli_add(text, cases[at->paper_case]);
  cli_add(text, ",\n");
  cli_add(text, margin);
  cli_add(text, "  ");
  add_pair(text, "time_scale", at->time_scale);
  cli_add(text, ", ");
  add_pair(text, "residual", at->residual);
  cli_add(text, ",\n");
  cli_add(text, margin);
  cli_add(text, "  \"physical\": {");
  add_K(text, at, 1);
  cli_add(text, "}\n");
  cli_add(text, margin);
  cli_add(text, "}");
}
