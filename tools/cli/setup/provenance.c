// Four lines, no more and no fewer: readers that cannot skip comments skip a
// number of lines. The hash is that of the schema frame, so that rows of a
// board and of a run are known to be of the same machine.

#include "provenance.h"

#include <inttypes.h>
#include <stdio.h>

#include "../text/commit.h"
#include "names.h"

size_t cli_provenance(const cli_setup_t *setup, const char *how,
                      const char *units, char out[CLI_PROVENANCE_ROOM]) {
  return (size_t)snprintf(
      out, CLI_PROVENANCE_ROOM,
      "# twofold %s, commit %s, numbers are %s\n"
      "# scene %s, parameters %08" PRIx32 ", law %s, rule %s, seed %" PRIu32
      "\n"
      "# %s\n"
      "# units: %s\n",
      TF_VERSION, cli_commit,
      sizeof(tf_real_t) == sizeof(float) ? "float" : "double",
      setup->scene->name, tf_params_hash(&setup->params),
      tf_tyre_law_name(setup->params.law), tf_rule_name(setup->params.rule),
      setup->seed, how, units);
}
