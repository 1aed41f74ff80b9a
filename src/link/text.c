// A row of label:value pairs.
#include "twofold/text.h"

#include "decimal.h"

static char *put_pair(char *at, const char *label, tf_real_t value) {
  while (*label != '\0') *at++ = *label++;
  return at + tf_decimal(at, value);
}

TF_API size_t tf_text_row(char *out, const tf_state_t *state,
                          const tf_report_t *report) {
  char *at = out;
  at = put_pair(at, "r:", state->r);
  at = put_pair(at, " v:", state->v);
  at = put_pair(at, " omega:", state->w);
  at = put_pair(at, " h:", report->slip.h);
  at = put_pair(at, " g:", report->slip.g);
  *at++ = '\n';
  return (size_t)(at - out);
}
