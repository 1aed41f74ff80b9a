// Four lines, no more and no fewer: readers that cannot skip comments skip a
// number of lines. The hash of the parameters is that of the schema frame, so
// that rows of a board and of a run are known to be of the same machine.

#include "provenance.h"

#include <inttypes.h>
#include <stdio.h>

#include "../text/commit.h"
#include "../text/trailer.h"
#include "names.h"

uint32_t cli_scene_hash(const cli_setup_t *setup) {
  const tf_scene_t *scene = setup->scene;
  char text[64];
  cli_trailer_t sum = {0};
  const bool v_is_given =
      setup->set_start[CLI_START_V] != NULL ||
      (scene->v_is_given && setup->set_start[CLI_START_H] == NULL);
  int length = snprintf(text, sizeof text, "%08" PRIx32 " %d",
                        tf_params_hash(&setup->params), (int)v_is_given);
  cli_trailer_add(&sum, text, (size_t)length, 0);
  for (unsigned i = 0; i < CLI_STARTS; i++) {
    if (i != (v_is_given ? CLI_START_H : CLI_START_V)) {
      length = snprintf(text, sizeof text, " %a", (double)setup->start[i]);
      cli_trailer_add(&sum, text, (size_t)length, 0);
    }
  }
  for (unsigned i = 0; i < scene->knots; i++) {
    length = snprintf(text, sizeof text, " %a %a", (double)scene->profile[i].t,
                      (double)scene->profile[i].omega0);
    cli_trailer_add(&sum, text, (size_t)length, 0);
  }
  return sum.crc;
}

size_t cli_provenance(const cli_setup_t *setup, const char *how,
                      const char *units, char out[CLI_PROVENANCE_ROOM]) {
  return (size_t)snprintf(
      out, CLI_PROVENANCE_ROOM,
      "# twofold %s, commit %s, numbers are %s\n"
      "# scene %s, hash %08" PRIx32 ", parameters %08" PRIx32
      ", law %s, rule %s, seed %" PRIu32
      "\n"
      "# %s\n"
      "# units: %s\n",
      TF_VERSION, cli_commit,
      sizeof(tf_real_t) == sizeof(float) ? "float" : "double",
      setup->scene->name, cli_scene_hash(setup), tf_params_hash(&setup->params),
      tf_tyre_law_name(setup->params.law), tf_rule_name(setup->params.rule),
      setup->seed, how, units);
}
