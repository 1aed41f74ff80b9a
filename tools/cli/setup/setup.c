// Preparing a machine and its initial state, with messages that tell what to
// do. The core reports only which parameter is out of range; where the value
// came from and what would be allowed is reported here. A range may also be
// violated by a value that nobody typed: a scene does not give the parameters
// of laws that it does not use, so `--set law=string` may require them.

#include "setup.h"

#include <stdarg.h>

const cli_setting_t *cli_settings_find(const cli_settings_t *settings,
                                       const char *name) {
  for (size_t i = 0; i < settings->count; i++)
    if (strcmp(settings->list[i].name, name) == 0) return &settings->list[i];
  return NULL;
}

int cli_settings_add_named(cli_settings_t *settings, const cli_given_t *given,
                           const char *name, const char *value) {
  if (settings->count == CLI_SETTINGS)
    return cli_blame(CLI_USAGE, given, "more than %d settings", CLI_SETTINGS);
  const cli_setting_t *first = cli_settings_find(settings, name);
  if (first != NULL) {
    return cli_blame(CLI_USAGE, given, "%s was already given by %s %s", name,
                     first->given.name, first->given.value);
  }
  cli_setting_t *setting = &settings->list[settings->count++];
  setting->given = *given;
  setting->value = value;
  (void)snprintf(setting->name, sizeof setting->name, "%s", name);
  return CLI_DONE;
}

int cli_settings_add(cli_settings_t *settings, const cli_given_t *given) {
  const char *text = given->value;
  char name[CLI_NAME_ROOM];
  const size_t length = strcspn(text, "=");
  if (length == 0 || text[length] == '\0')
    return cli_blame(CLI_USAGE, given, "expected NAME=VALUE");
  if (length >= sizeof name) {
    return cli_blame(CLI_USAGE, given,
                     "unknown name ('twofold help run' lists them)");
  }
  (void)snprintf(name, sizeof name, "%.*s", (int)length, text);
  return cli_settings_add_named(settings, given, name, text + length + 1);
}

static tf_real_t value_of(const cli_setup_t *setup, size_t number) {
  const char *from = number < TF_PARAMETERS ? (const char *)&setup->params
                                            : (const char *)&setup->start;
  tf_real_t value;
  memcpy(&value, from + cli_number(number)->offset, sizeof value);
  return value;
}

// Whether the number is in its range is checked later and in a single place,
// because ranges depend on the law and the law may be set after the parameter.
static int read_setting(cli_setup_t *setup, const cli_setting_t *setting) {
  const char *name = setting->name;
  const size_t number = cli_number_index(name);
  tf_real_t value = 0;
  if (strcmp(name, "law") == 0 || strcmp(name, "rest") == 0)
    return cli_set_word(&setup->params, name, &setting->given, setting->value);
  if (number == CLI_NUMBERS) {
    cli_closest_t closest = cli_closest_to(name);
    for (size_t i = 0; i < CLI_NUMBERS; i++)
      cli_closest_offer(&closest, cli_number(i)->name);
    cli_closest_offer(&closest, "law");
    cli_closest_offer(&closest, "rest");
    return cli_blame(CLI_USAGE, &setting->given, "unknown name '%s'%s", name,
                     closest.hint);
  }
  CLI_TRY(cli_read_number(&setting->given, setting->value, &value));
  if (!cli_parameter_fits(number, value)) {
    return cli_blame(CLI_REFUSED, &setting->given, "%s must be a whole number",
                     name);
  }
  char *to =
      number < TF_PARAMETERS ? (char *)&setup->params : (char *)&setup->start;
  memcpy(to + cli_number(number)->offset, &value, sizeof value);
  setup->set[number] = setting;
  return CLI_DONE;
}

// Reads RULE[:SEED] of --select. Without SEED, seed is left as it is.
static int read_rule(const char *select, tf_params_t *params, uint32_t *seed) {
  const cli_given_t given = {"--select", select};
  char name[CLI_NAME_ROOM];
  const size_t length = strcspn(select, ":");
  (void)snprintf(name, sizeof name, "%.*s", (int)length, select);
  CLI_TRY(cli_set_word(params, "rule", &given, name));
  if (select[length] == '\0') return CLI_DONE;
  if (params->rule != TF_RULE_RANDOM)
    return cli_blame(CLI_USAGE, &given, "only the rule random takes a seed");
  uint64_t value = 0;
  if (!cli_read_whole(select + length + 1, 0, UINT32_MAX, &value)) {
    return cli_blame(CLI_USAGE, &given,
                     "the seed must be a whole number in [0, 4294967295]");
  }
  *seed = (uint32_t)value;
  return CLI_DONE;
}

int cli_setup_read(cli_setup_t *setup, const tf_scene_t *scene,
                   const cli_settings_t *settings, const char *select) {
  memset(setup, 0, sizeof *setup);
  setup->scene = scene;
  setup->scheme = MOTION_SCHEMES;
  setup->params = scene->params;
  setup->start = motion_start(scene, 0);
  for (size_t i = 0; i < settings->count; i++)
    CLI_TRY(read_setting(setup, &settings->list[i]));
  setup->start.from_h = setup->set[CLI_V] == NULL &&
                        (setup->set[CLI_H] != NULL || !scene->v_is_given);
  return select != NULL ? read_rule(select, &setup->params, &setup->seed)
                        : CLI_DONE;
}

const cli_setting_t *cli_setup_start_set(const cli_setup_t *setup) {
  size_t i = CLI_R;
  while (i + 1 < CLI_NUMBERS && setup->set[i] == NULL) i++;
  return setup->set[i];
}

int cli_setup_machine(cli_setup_t *setup) {
  setup->params.with_angle =
      setup->params.with_angle || setup->set[CLI_PHI] != NULL;
  const size_t out = cli_parameter_out(&setup->params);
  if (out < TF_PARAMETERS) {
    const tf_parameter_range_t *range = cli_number(out);
    const cli_setting_t *setting = setup->set[out];
    char text[CLI_REAL_ROOM];
    (void)cli_write_real(text, value_of(setup, out));
    return setting != NULL
               ? cli_blame(CLI_REFUSED, &setting->given, "%s %s", range->name,
                           cli_must(range))
               : cli_refuse(
                     "scene %s with law %s: %s = %s %s; give --set %s=VALUE",
                     setup->scene->name, tf_tyre_law_name(setup->params.law),
                     range->name, text, cli_must(range), range->name);
  }
  (void)tf_prepare(&setup->machine, &setup->params, NULL);
  setup->input = tf_scene_input(setup->scene, &setup->machine, 0);
  return CLI_DONE;
}

int cli_setup_check_starts(const cli_setup_t *setup) {
  const cli_setting_t *v = setup->set[CLI_V], *h = setup->set[CLI_H];
  if (v != NULL && h != NULL) {
    return cli_usage("%s %s, %s %s: give h or v, each follows from the other",
                     v->given.name, v->given.value, h->given.name,
                     h->given.value);
  }
  for (size_t i = CLI_R; i < CLI_NUMBERS; i++) {
    const cli_setting_t *setting = setup->set[i];
    const tf_parameter_range_t *range = cli_number(i);
    const tf_real_t value = value_of(setup, i);
    if (setting != NULL && !cli_is_in(range, value)) {
      return cli_blame(CLI_REFUSED, &setting->given, "%s %s", range->name,
                       cli_must(range));
    }
  }
  return CLI_DONE;
}

int cli_setup_start(cli_setup_t *setup) {
  CLI_TRY(cli_setup_check_starts(setup));
  setup->start.state.seed = setup->seed;
  setup->motion = (motion_t){.state = {.r = 0}};
  (void)motion_prepare(&setup->motion, setup->scheme, &setup->params, NULL);
  const tf_status_t status =
      motion_begin(&setup->motion, setup->scheme, &setup->start, &setup->input);
  if (status == TF_OK) return CLI_DONE;
  // It is refused: says why. The speed that belongs to h is a part of it.
  const tf_machine_t *k = &setup->machine;
  const cli_setting_t *setting = setup->set[CLI_H];
  const tf_real_t h = setup->start.h, omega0 = setup->input.omega0;
  tf_state_t x = setup->start.state;
  if (setup->start.from_h &&
      tf_speed_for_slip(k, x.r, x.w, omega0, h, &x.v) != TF_OK) {
    const cli_given_t scene = {"scene", setup->scene->name};
    return cli_blame(CLI_REFUSED, setting != NULL ? &setting->given : &scene,
                     "no speed v gives the slip speed h = %g m/s, because "
                     "sin(gamma) = %g; give --set v=VALUE",
                     (double)h, (double)k->sin_gamma);
  }
  return cli_refuse(
      "scene %s: the start r = %g m, v = %g m/s, omega = %g rad/s, h = %g m/s "
      "is refused: %s",
      setup->scene->name, (double)x.r, (double)x.v, (double)x.w,
      (double)tf_slip(k, x.r, x.v, x.w, omega0).h, tf_status_name(status));
}

void cli_setup_notes(const cli_setup_t *setup) {
  const bool located = setup->scheme == MOTION_LOCATED;
  for (size_t i = 0; i < TF_PARAMETERS; i++) {
    const cli_setting_t *setting = setup->set[i];
    const char *name = cli_number(i)->name;
    char text[128] = "";
    cli_buffer_t reason = {text, 0, sizeof text, false};
    if (setting == NULL) continue;
    if ((tf_parameter_ranges[i].laws >> setup->params.law & 1u) == 0) {
      cli_add_form(&reason, ": law %s does not use %s",
                   tf_tyre_law_name(setup->params.law), name);
    } else if (setup->scene->knots > 0 && strcmp(name, "omega0") == 0) {
      cli_add_form(&reason, ": scene %s drives omega0", setup->scene->name);
    } else if (setup->params.rule != TF_RULE_RANDOM &&
               strcmp(name, "rate") == 0) {
      cli_add(&reason, ": it belongs to --select random");
    } else if (setup->scheme < MOTION_SCHEMES &&
               strcmp(name, located ? "theta" : "tolerance") == 0) {
      cli_add_form(&reason, " under --scheme %s%s",
                   motion_scheme_name(setup->scheme),
                   located ? " except where a step falls back on moreau"
                           : ": it belongs to --scheme located");
    }
    if (reason.used > 0)
      cli_note("%s %s has no effect%s", setting->given.name,
               setting->given.value, text);
  }
}

// Float loses a motion in the rounding of its state at shorter steps [s].
#define SHORT_STEP TF_R(1e-3)

int cli_setup_scheme(cli_setup_t *setup, const char *file) {
  const tf_real_t dt = setup->params.dt;
  const bool rounds = dt < SHORT_STEP && sizeof dt == sizeof(float);
  const motion_scheme_t usual = rounds ? MOTION_COMPENSATED : MOTION_MOREAU;
  if (setup->scheme == MOTION_SCHEMES) {
    setup->scheme = usual;
    if (rounds) {
      cli_note(
          "float at dt = %g s: --scheme compensated; moreau would lose slow "
          "motions in the rounding of the state",
          (double)dt);
    }
  } else if (file != NULL && setup->scheme != usual) {
    cli_note("--scheme %s, set by %s", motion_scheme_name(setup->scheme), file);
  }
  if (motion_takes_law(setup->scheme, setup->params.law)) return CLI_DONE;
  return cli_refuse("--scheme %s: law must be " MOTION_LOCATED_LAWS
                    ", not %s; --scheme moreau takes every law",
                    motion_scheme_name(setup->scheme),
                    tf_tyre_law_name(setup->params.law));
}

tf_real_t cli_end_of(const tf_scene_t *scene, const cli_range_t *t_end) {
  return t_end->text != NULL ? (tf_real_t)t_end->from : scene->t_end;
}

int cli_count_steps(const cli_setup_t *setup, const cli_range_t *t_end,
                    uint64_t *steps) {
  const double dt = (double)setup->machine.dt;
  const double end = (double)cli_end_of(setup->scene, t_end);
  const double count = round(end / dt);
  const double most = (double)CLI_MAX_STEPS;
  if (!(end >= 0 && count <= most)) {
    return cli_refuse(
        "--t-end %s: t-end must lie in [0, %g] s (at most 1e15 steps of dt = "
        "%g s)",
        t_end->text != NULL ? t_end->text : "", most * dt, dt);
  }
  *steps = (uint64_t)count;
  return CLI_DONE;
}

uint32_t cli_crc_of(uint32_t before, const char *format, ...) {
  char text[64];
  va_list arguments;
  va_start(arguments, format);
  const int length = vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  return cli_crc(before, text, (size_t)length);
}

// The hash of the parameters is that of the schema frame, so that rows of a
// board and of a run are known to be of the same machine.
uint32_t cli_scene_hash(const cli_setup_t *setup) {
  const tf_scene_t *scene = setup->scene;
  const motion_start_t *start = &setup->start;
  uint32_t sum = cli_crc_of(0, "%08" PRIx32 " %d",
                            tf_params_hash(&setup->params), !start->from_h);
  for (size_t i = CLI_R; i < CLI_NUMBERS; i++)
    if (i != (start->from_h ? CLI_V : CLI_H))
      sum = cli_crc_of(sum, " %a", (double)value_of(setup, i));
  for (unsigned i = 0; i < scene->knots; i++) {
    sum = cli_crc_of(sum, " %a %a", (double)scene->profile[i].t,
                     (double)scene->profile[i].omega0);
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
