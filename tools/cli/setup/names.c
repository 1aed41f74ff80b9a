// Laws, rules and sets of modes by their names, parameters and starts.

#include "setup.h"

#define AT(member) \
  offsetof(motion_start_t, member), UINT16_MAX, -TF_STATE_LIMIT, TF_STATE_LIMIT
static const tf_parameter_range_t starts[] = {{"r", "m", AT(state.r)},
                                              {"v", "m/s", AT(state.v)},
                                              {"omega", "rad/s", AT(state.w)},
                                              {"h", "m/s", AT(h)},
                                              {"phi", "rad", AT(state.phi)}};

// In the order of tf_parameter_ranges.
const char *const cli_parameter_about[TF_PARAMETERS] = {
    "mass of the slider",
    "distance of the slider's line from the axis",
    "radius of gyration: the inertia of the disc is beta^2 m",
    "spring of the slider",
    "damping of the disc against ground",
    "damping of the slider",
    "rest position of the spring",
    "speed of the turntable",
    "friction force (not a coefficient) at h -> 0",
    "moment per force in stick (laws jump, two_piece, smooth)",
    "angle of the wheel to the slider",
    "width of the smoothed sign (law smooth)",
    "string stiffness / mu (laws string, two_piece)",
    "static pressure limit / mu (law string)",
    "relaxation length (law string)",
    "dynamic / static pressure (law string)",
    "half contact length (law string)",
    "of scheme moreau: 1/2 for second order, 1 for implicit Euler",
    "step",
    "rate at which the rule random leaves a mode",
    "of scheme located: relative error of a segment of its series",
    "of scheme located: how many segments a step may take; 0: the default"};

const tf_parameter_range_t *cli_number(size_t index) {
  return index < TF_PARAMETERS ? &tf_parameter_ranges[index]
                               : &starts[index - TF_PARAMETERS];
}

size_t cli_number_index(const char *name) {
  size_t i = 0;
  while (i < CLI_NUMBERS && strcmp(cli_number(i)->name, name) != 0) i++;
  return i;
}

tf_real_t cli_parameter(const tf_params_t *params, size_t index) {
  tf_real_t value = 0;
  memcpy(&value,
         (const unsigned char *)params + tf_parameter_ranges[index].offset,
         sizeof value);
  return value;
}

const char *cli_must(const tf_parameter_range_t *range) {
  static char text[96];
  const bool plain = strcmp(range->unit, "1") == 0;
  (void)snprintf(text, sizeof text, "must lie in [%g, %g]%s%s",
                 (double)range->low, (double)range->high, plain ? "" : " ",
                 plain ? "" : range->unit);
  return text;
}

size_t cli_parameter_out(const tf_params_t *params) {
  for (size_t i = 0; i < TF_PARAMETERS; i++) {
    const tf_parameter_range_t *range = &tf_parameter_ranges[i];
    const tf_real_t value = cli_parameter(params, i);
    const bool used = (range->laws >> (unsigned)params->law & 1u) != 0;
    if (!cli_is_in(range, value) && (used || !(value >= 0 && value <= 0)))
      return i;
  }
  return TF_PARAMETERS;
}

bool cli_parameter_fits(size_t index, tf_real_t value) {
  const bool counts = strcmp(cli_number(index)->name, "segments") == 0;
  return !counts || !(value >= 0 && value < TF_R(65536.0)) ||
         (double)(uint32_t)value >= (double)value;
}

static const struct {
  const char *name, *what, *all; // the last two in a message: one, and all
  const char *(*name_of)(unsigned);
  unsigned count;
} kinds[] = {
    {"law", "law", "laws are", tf_tyre_law_name, TF_TYRE_LAWS},
    {"rest", "law of rest", "they are", tf_rest_law_name, TF_REST_LAWS},
    {"rule", "rule", "rules are", tf_rule_name, TF_RULES}};

int cli_set_word(tf_params_t *params, const char *what,
                 const cli_given_t *given, const char *name) {
  char list[256] = ""; // as "a, b and c"
  cli_buffer_t all = {list, 0, sizeof list, false};
  cli_closest_t closest = cli_closest_to(name);
  unsigned kind = 0, i = 0;
  while (strcmp(kinds[kind].name, what) != 0) kind++;
  if (kind == 2 && strchr(name, ':') != NULL) {
    return cli_blame(CLI_USAGE, given,
                     "a seed is not part of a scene: give the rule alone here, "
                     "and --select %s to 'run'",
                     name);
  }
  const unsigned count = kinds[kind].count;
  for (; i < count && strcmp(kinds[kind].name_of(i), name) != 0; i++) {
    cli_closest_offer(&closest, kinds[kind].name_of(i));
    cli_add_form(&all, "%s%s",
                 i == 0          ? ""
                 : i + 1 < count ? ", "
                                 : " and ",
                 kinds[kind].name_of(i));
  }
  if (i == count) {
    return cli_blame(CLI_USAGE, given, "unknown %s '%s'; %s %s%s",
                     kinds[kind].what, name, kinds[kind].all, list,
                     closest.hint);
  }
  if (kind == 0)
    params->law = (tf_tyre_law_t)i;
  else if (kind == 1)
    params->rest = (tf_rest_law_t)i;
  else
    params->rule = (tf_rule_t)i;
  return CLI_DONE;
}

const char *cli_write_set(char out[CLI_SET_ROOM], unsigned set) {
  cli_buffer_t text = {out, 0, CLI_SET_ROOM, false};
  out[0] = '\0';
  for (unsigned mode = 0; mode < TF_MODES; mode++) {
    if ((set & TF_MODE_BIT(mode)) == 0) continue;
    cli_add(&text, text.used > 0 ? "|" : "");
    cli_add(&text, tf_mode_name(mode));
  }
  return out;
}
