/* The changes of the contact within a located step: they are those that short
 * steps find one by one, whatever dt is, and asking for them does not change
 * the step. */
#include "same_state.h"
#include "sim.h"

#define MOST 64

typedef struct {
  int count;
  double time[MOST];
  unsigned mode[MOST];
} found_t;

static void add(found_t *found, double time, unsigned mode) {
  if (!CHECK(found->count < MOST)) return;
  found->time[found->count] = time;
  found->mode[found->count++] = mode;
}

static sim_t start(const tf_scene_t *scene, double dt) {
  tf_params_t params = scene->params;
  params.dt = (tf_real_t)dt;
  return sim_at_start(scene, &params, 0);
}

/* A place that a change names lies on h = 0, and the report fits it. */
static void judge(const sim_t *s, const tf_located_change_t *change) {
  const tf_state_t *at = &change->state;
  const tf_slip_t slip = tf_slip(&s->k, at->r, at->v, at->w, s->u.omega0);
  CHECK_NEAR((double)slip.h, 0, IS_DOUBLE ? 1e-9 : 1e-4);
  CHECK_NEAR((double)slip.g, (double)change->report.slip.g,
             IS_DOUBLE ? 1e-9 : 1e-4);
  CHECK(change->state.mode == change->report.mode);
  CHECK(change->report.set >> change->report.mode & 1u);
  CHECK(change->time >= 0 && change->time <= s->k.dt);
}

/* Without a moment g names the stick at the end of a step. */
static unsigned name(const sim_t *s, unsigned mode) {
  return s->params.kappa > 0 || tf_mode_is_slip(mode) ? mode : TF_STICK_PLUS;
}

static found_t changes_of(const tf_scene_t *scene, double dt, int steps) {
  found_t found = {.count = 0};
  sim_t s = start(scene, dt);
  for (int n = 0; n < steps; n++) {
    tf_located_change_t list[MOST];
    size_t count = 0;
    unsigned mode = s.x.mode;
    CHECK(tf_step_located_changes(&s.k, &s.x, &s.u, &s.report, list, MOST,
                                  &count) >= TF_OK);
    for (size_t i = 0; i < count; i++) {
      judge(&s, &list[i]);
      const unsigned next = list[i].report.mode;
      if (name(&s, next) != name(&s, mode))
        add(&found, n * dt + (double)list[i].time, name(&s, next));
      mode = next;
    }
    if (name(&s, s.report.mode) != name(&s, mode)) {
      CHECK(s.report.status != TF_OK); /* tf_step came to the end */
      add(&found, (n + 1) * dt, name(&s, s.report.mode));
    }
  }
  return found;
}

/* Of steps so short that each has one change at most. */
static found_t modes_of(const tf_scene_t *scene, double dt, int steps) {
  found_t found = {.count = 0};
  sim_t s = start(scene, dt);
  for (int n = 1; n <= steps; n++) {
    const unsigned mode = s.x.mode;
    CHECK(tf_step_located(&s.k, &s.x, &s.u, &s.report) >= TF_OK);
    if (name(&s, s.x.mode) != name(&s, mode))
      add(&found, n * dt, name(&s, s.x.mode));
  }
  return found;
}

static void compare(const found_t *got, const found_t *want, double before,
                    double after) {
  CHECK(got->count == want->count);
  for (int i = 0; i < got->count && i < want->count; i++) {
    CHECK(got->mode[i] == want->mode[i]);
    CHECK(got->time[i] >= want->time[i] - before);
    CHECK(got->time[i] <= want->time[i] + after);
  }
}

/* Up to the two-fold, behind which a motion hangs on its last digits. */
TEST(located_changes_are_those_of_short_steps) {
  static const char *const names[] = {"coulomb", "chaos"};
  for (int i = 0; i < 2; i++) {
    const tf_scene_t *scene = scene_named(names[i]);
    const found_t want = modes_of(scene, 1e-3, 2000);
    CHECK_ABOVE(want.count, 2);
    for (int parts = 3; parts <= 43; parts += 20) {
      const found_t got = changes_of(scene, 2.0 / parts, parts);
      compare(&got, &want, 1e-3 + 1e-4, IS_DOUBLE ? 1e-6 : 1e-3);
    }
  }
}

TEST(located_changes_leave_the_step_as_it_is) {
  int several = 0;
  for (int i = 0; i < 300; i++) {
    sim_t s = {.params = moderate_params()};
    s.params.dt = TF_R(0.5);
    s.params.with_angle = true;
    if (sim_place(&s, tap_uniform(0.1, 0.8), tap_uniform(-1.5, 1.5),
                  tap_uniform(-0.3, 0.3), TF_NO_MODE) != TF_OK)
      continue;
    for (int n = 0; n < 4; n++) {
      sim_t other = s;
      tf_located_change_t list[2];
      size_t count = 0;
      const tf_status_t status = tf_step_located(&s.k, &s.x, &s.u, &s.report);
      CHECK(tf_step_located_changes(&other.k, &other.x, &other.u, &other.report,
                                    list, 1, &count) == status);
      CHECK(same_state(&s.x, &other.x));
      CHECK(same_report(&s.report, &other.report));
      several += count > 1;
    }
  }
  CHECK_ABOVE(several, 20);
}

/* A stick through the two-fold, a motion without contact, a step that tf_step
 * takes, and a state that is refused. */
TEST(located_changes_of_every_end) {
  tf_located_change_t list[MOST];
  size_t count = 7;
  int passes = 0;
  sim_t s = start(scene_named("chaos"), 1e-3);
  for (int n = 0; n < 2200; n++) {
    const unsigned before = s.x.mode;
    CHECK(tf_step_located_changes(&s.k, &s.x, &s.u, &s.report, list, MOST,
                                  &count) >= TF_OK);
    for (size_t i = 0; i < count; i++)
      passes += list[i].report.delassus == 0 && before == TF_STICK_PLUS;
  }
  CHECK_ABOVE(passes, 0);
  s = start(scene_named("frictionless"), 1e-3);
  s.x.mode = TF_STICK_PLUS;
  CHECK(tf_step_located_changes(&s.k, &s.x, &s.u, &s.report, list, MOST,
                                &count) == TF_OK);
  CHECK(count == 1 && list[0].report.force.F == 0);
  s.x.v = (tf_real_t)NAN;
  CHECK(tf_step_located_changes(&s.k, &s.x, &s.u, &s.report, list, MOST,
                                &count) == TF_BAD_STATE);
  CHECK(count == 0);
  int fell_back = 0;
  for (int i = 0; i < 100; i++) {
    tf_params_t along = tf_scenes[0]->params;
    along.gamma = 0;
    s = sim_of(&along);
    s.x = (tf_state_t){.v = uniform(-1, 1), .w = s.params.omega0};
    s.x.mode = s.x.v < 0 ? TF_STICK_PLUS : TF_STICK_MINUS;
    const tf_status_t status = tf_step_located_changes(
        &s.k, &s.x, &s.u, &s.report, list, MOST, &count);
    fell_back += status == TF_FELL_BACK && count == 0;
  }
  CHECK_ABOVE(fell_back, 0);
}
