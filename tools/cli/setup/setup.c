// Preparing a machine and its initial state, with messages that tell what to
// do. The core reports only which parameter is out of range; where the value
// came from and what would be allowed is reported here. A range may also be
// violated by a value that nobody typed: a scene does not give the parameters
// of laws that it does not use, so `--set law=string` may require them.

#include "setup.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "../text/message.h"
#include "../text/number.h"
#include "../text/shard.h"

const cli_setting_t *cli_settings_find(const cli_settings_t *settings,
                                       const char *name) {
  for (size_t i = 0; i < settings->count; i++) {
    if (strcmp(settings->list[i].name, name) == 0) {
      return &settings->list[i];
    }
  }
  return NULL;
}

int cli_settings_add_named(cli_settings_t *settings, const char *option,
                           const char *text, const char *name,
                           const char *value) {
  if (settings->count == CLI_SETTINGS) {
    return cli_message(CLI_USAGE, "%s %s: more than %d settings", option, text,
                       CLI_SETTINGS);
  }
  const cli_setting_t *first = cli_settings_find(settings, name);
  if (first != NULL) {
    return cli_message(CLI_USAGE, "%s %s: %s was already given by %s %s",
                       option, text, name, first->option, first->text);
  }
  cli_setting_t *setting = &settings->list[settings->count++];
  setting->option = option;
  setting->text = text;
  setting->value = value;
  (void)snprintf(setting->name, sizeof setting->name, "%s", name);
  return CLI_DONE;
}

int cli_settings_add(cli_settings_t *settings, const char *option,
                     const char *text) {
  char name[CLI_NAME_ROOM];
  const char *equals = strchr(text, '=');
  if (equals == NULL || equals == text) {
    return cli_message(CLI_USAGE, "%s %s: expected NAME=VALUE", option, text);
  }
  const size_t length = (size_t)(equals - text);
  if (length >= sizeof name) {
    return cli_message(CLI_USAGE,
                       "%s %s: unknown name ('twofold help run' lists them)",
                       option, text);
  }
  (void)snprintf(name, sizeof name, "%.*s", (int)length, text);
  return cli_settings_add_named(settings, option, text, name, equals + 1);
}

// Here a text becomes a number and a name finds its member. Whether the number
// is in its range is checked later and in a single place, by tf_prepare,
// because ranges depend on the law and the law may be set after the parameter.
static int read_setting(cli_setup_t *setup, const cli_setting_t *setting) {
  tf_real_t value = 0;
  if (strcmp(setting->name, "law") == 0 || strcmp(setting->name, "rest") == 0) {
    return cli_set_word(&setup->params, setting->name, setting->option,
                        setting->text, setting->value);
  }
  cli_closest_t closest = cli_closest_to(setting->name);
  const size_t parameter =
      cli_closest_find(&closest, tf_parameter_ranges, TF_PARAMETERS,
                       sizeof tf_parameter_ranges[0]);
  const size_t start =
      cli_closest_find(&closest, cli_starts, CLI_STARTS, sizeof cli_starts[0]);
  if (parameter == TF_PARAMETERS && start == CLI_STARTS) {
    cli_closest_offer(&closest, "law");
    cli_closest_offer(&closest, "rest");
    return cli_message(CLI_USAGE, "%s %s: unknown name '%s'%s", setting->option,
                       setting->text, setting->name, closest.hint);
  }
  CLI_TRY(
      cli_read_number(setting->option, setting->text, setting->value, &value));
  if (parameter < TF_PARAMETERS && !cli_parameter_fits(parameter, value)) {
    return cli_message(CLI_REFUSED, "%s %s: %s must be a whole number",
                       setting->option, setting->text, setting->name);
  }
  if (parameter < TF_PARAMETERS) {
    unsigned char *params = (unsigned char *)&setup->params;
    memcpy(params + tf_parameter_ranges[parameter].offset, &value,
           sizeof value);
    setup->set_param[parameter] = setting;
  } else {
    setup->start[start] = value;
    setup->set_start[start] = setting;
  }
  return CLI_DONE;
}

int cli_setup_read(cli_setup_t *setup, const tf_scene_t *scene,
                   const cli_settings_t *settings, const char *select) {
  memset(setup, 0, sizeof *setup);
  setup->scene = scene;
  setup->params = scene->params;
  setup->start[CLI_START_R] = scene->r;
  setup->start[CLI_START_V] = scene->v;
  setup->start[CLI_START_OMEGA] = scene->omega;
  setup->start[CLI_START_H] = scene->h;
  for (size_t i = 0; i < settings->count; i++) {
    CLI_TRY(read_setting(setup, &settings->list[i]));
  }
  return select != NULL ? cli_read_rule(select, &setup->params, &setup->seed)
                        : CLI_DONE;
}

static bool is_used(const cli_setup_t *setup, int i) {
  return ((tf_parameter_ranges[i].laws >> (unsigned)setup->params.law) & 1u) !=
         0;
}

static int refuse_parameter(const cli_setup_t *setup, size_t offender) {
  const char *name = tf_parameter_ranges[offender].name;
  const cli_setting_t *setting = setup->set_param[offender];
  if (setting != NULL) {
    return cli_message(CLI_REFUSED, "%s %s: %s %s", setting->option,
                       setting->text, name, cli_parameter_must(offender));
  }
  char text[CLI_REAL_ROOM];
  (void)cli_write_real(text, cli_parameter(&setup->params, offender));
  return cli_message(CLI_REFUSED,
                     "scene %s with law %s: %s = %s %s; give --set %s=VALUE",
                     setup->scene->name, tf_tyre_law_name(setup->params.law),
                     name, text, cli_parameter_must(offender), name);
}

int cli_setup_machine(cli_setup_t *setup) {
  setup->params.with_angle =
      setup->params.with_angle || setup->set_start[CLI_START_PHI] != NULL;
  const size_t offender = cli_parameter_out(&setup->params);
  if (offender < TF_PARAMETERS) {
    return refuse_parameter(setup, offender);
  }
  if (tf_prepare(&setup->machine, &setup->params, NULL) != TF_OK) {
    return cli_message(CLI_REFUSED, "scene %s: law, rule or rest is unknown",
                       setup->scene->name);
  }
  setup->input = tf_scene_input(setup->scene, &setup->machine, 0);
  return CLI_DONE;
}

int cli_setup_check_starts(const cli_setup_t *setup) {
  const cli_setting_t *v = setup->set_start[CLI_START_V];
  const cli_setting_t *h = setup->set_start[CLI_START_H];
  if (v != NULL && h != NULL) {
    return cli_message(CLI_USAGE,
                       "%s %s, %s %s: give h or v, each follows from the other",
                       v->option, v->text, h->option, h->text);
  }
  for (size_t i = 0; i < CLI_STARTS; i++) {
    const cli_setting_t *setting = setup->set_start[i];
    const tf_real_t value = setup->start[i];
    if (setting != NULL &&
        !(value >= -TF_STATE_LIMIT && value <= TF_STATE_LIMIT)) {
      return cli_message(
          CLI_REFUSED, "%s %s: %s %s", setting->option, setting->text,
          cli_starts[i].name,
          cli_must_lie(-(double)TF_STATE_LIMIT, (double)TF_STATE_LIMIT,
                       cli_starts[i].unit));
    }
  }
  return CLI_DONE;
}

// The start is refused: says why. The speed that belongs to h is a part of it.
static int refuse_start(cli_setup_t *setup, tf_status_t status) {
  const tf_real_t h = setup->start[CLI_START_H];
  const cli_setting_t *setting = setup->set_start[CLI_START_H];
  tf_state_t *state = &setup->state;
  if (setup->v_from_h &&
      tf_speed_for_slip(&setup->machine, state->r, state->w,
                        setup->input.omega0, h, &state->v) != TF_OK) {
    return cli_message(CLI_REFUSED,
                       "%s %s: no speed v gives the slip speed h = %g m/s, "
                       "because sin(gamma) = %g; give --set v=VALUE",
                       setting != NULL ? setting->option : "scene",
                       setting != NULL ? setting->text : setup->scene->name,
                       (double)h, (double)setup->machine.sin_gamma);
  }
  const tf_slip_t slip = tf_slip(&setup->machine, state->r, state->v, state->w,
                                 setup->input.omega0);
  return cli_message(CLI_REFUSED,
                     "scene %s: the start r = %g m, v = %g m/s, omega = %g "
                     "rad/s, h = %g m/s is refused: %s",
                     setup->scene->name, (double)state->r, (double)state->v,
                     (double)state->w, (double)slip.h, tf_status_name(status));
}

int cli_setup_start(cli_setup_t *setup) {
  const bool v_typed = setup->set_start[CLI_START_V] != NULL;
  const bool h_typed = setup->set_start[CLI_START_H] != NULL;
  tf_state_t *state = &setup->state;
  CLI_TRY(cli_setup_check_starts(setup));
  state->r = setup->start[CLI_START_R];
  state->v = setup->start[CLI_START_V];
  state->w = setup->start[CLI_START_OMEGA];
  state->phi = setup->start[CLI_START_PHI];
  state->seed = setup->seed;
  state->mode = TF_NO_MODE;
  setup->v_from_h = !v_typed && (h_typed || !setup->scene->v_is_given);
  const tf_status_t status =
      setup->v_from_h
          ? tf_begin_with_slip(&setup->machine, state, &setup->input,
                               setup->start[CLI_START_H], &setup->report)
          : tf_begin(&setup->machine, state, &setup->input, &setup->report);
  return status == TF_OK ? CLI_DONE : refuse_start(setup, status);
}

void cli_setup_notes(const cli_setup_t *setup, const char *unused,
                     const char *why) {
  for (int i = 0; i < TF_PARAMETERS; i++) {
    const cli_setting_t *setting = setup->set_param[i];
    const char *name = tf_parameter_ranges[i].name;
    if (setting == NULL) {
      continue;
    }
    if (!is_used(setup, i)) {
      (void)cli_message(CLI_DONE,
                        "note: %s %s has no effect: law %s does not use %s",
                        setting->option, setting->text,
                        tf_tyre_law_name(setup->params.law), name);
    } else if (setup->scene->knots > 0 && strcmp(name, "omega0") == 0) {
      (void)cli_message(CLI_DONE,
                        "note: %s %s has no effect: scene %s drives omega0",
                        setting->option, setting->text, setup->scene->name);
    } else if (setup->params.rule != TF_RULE_RANDOM &&
               strcmp(name, "rate") == 0) {
      (void)cli_message(CLI_DONE,
                        "note: %s %s has no effect: it belongs to --select "
                        "random",
                        setting->option, setting->text);
    } else if (strcmp(name, unused) == 0) {
      (void)cli_message(CLI_DONE, "note: %s %s has no effect %s",
                        setting->option, setting->text, why);
    }
  }
}

// The hash of the parameters is that of the schema frame, so that rows of a
// board and of a run are known to be of the same machine.

uint32_t cli_scene_hash(const cli_setup_t *setup) {
  const tf_scene_t *scene = setup->scene;
  char text[64];
  uint32_t sum = 0;
  const bool v_is_given =
      setup->set_start[CLI_START_V] != NULL ||
      (scene->v_is_given && setup->set_start[CLI_START_H] == NULL);
  int length = snprintf(text, sizeof text, "%08" PRIx32 " %d",
                        tf_params_hash(&setup->params), (int)v_is_given);
  sum = cli_crc(sum, text, (size_t)length);
  for (unsigned i = 0; i < CLI_STARTS; i++) {
    if (i != (v_is_given ? CLI_START_H : CLI_START_V)) {
      length = snprintf(text, sizeof text, " %a", (double)setup->start[i]);
      sum = cli_crc(sum, text, (size_t)length);
    }
  }
  for (unsigned i = 0; i < scene->knots; i++) {
    length = snprintf(text, sizeof text, " %a %a", (double)scene->profile[i].t,
                      (double)scene->profile[i].omega0);
    sum = cli_crc(sum, text, (size_t)length);
  }
  return sum;
}

// No more and no fewer than four lines: readers that cannot skip comments skip
// a number of them.
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
      TF_VERSION, cli_commit, CLI_NUMBER_TYPE, setup->scene->name,
      cli_scene_hash(setup), tf_params_hash(&setup->params),
      tf_tyre_law_name(setup->params.law), tf_rule_name(setup->params.rule),
      setup->seed, how, units);
}
