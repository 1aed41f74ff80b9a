/* What the steps of a run said is counted by status, and the first that was not
 * TF_OK is remembered. */
#include <string.h>

#include "tap.h"
#include "twofold.h"

TEST(tally_counts_every_status) {
  tf_tally_t tally;
  memset(&tally, 0, sizeof tally);
  uint64_t tick = UINT64_C(1) << 33;
  tf_tally_count(&tally, tick++, TF_OK);
  CHECK(tally.degraded + tally.fell_back + tally.coarse + tally.refused == 0);
  for (int status = TF_STEP_TOO_LONG; status <= TF_COARSE; status++)
    for (int n = 0; n < 10 + status; n++)
      tf_tally_count(&tally, tick++, (tf_status_t)status);
  CHECK(tally.degraded == 11 && tally.fell_back == 12 && tally.coarse == 13);
  CHECK(tally.refused == 6 + 7 + 8 + 9);
  CHECK(tally.first == (UINT64_C(1) << 33) + 1);
}

/* A simulation counts from its opening, whatever it ran before. */
TEST(simulation_opens_with_an_empty_tally) {
  tf_simulation_t simulation;
  memset(&simulation, 0xff, sizeof simulation);
  const tf_scene_t *scene = tf_scenes[0];
  CHECK(tf_simulation_open(&simulation, scene, &scene->params, 0) == TF_OK);
  const tf_tally_t *t = &simulation.tally;
  CHECK(t->degraded + t->fell_back + t->coarse + t->refused == 0);
}
