// Reading the settings: NAME=VALUE pairs and RULE[:SEED] into a setup. Here a
// text becomes a number and a name finds its member; whether the number is in
// its range is asked later and once, of tf_prepare, because ranges depend on
// the law and the law may be set after the parameter.

#include <stdio.h>
#include <string.h>

#include "setup.h"
#include "text.h"

static const char *const law_names[TF_TYRE_LAWS] = {
    "jump", "coulomb", "two_piece", "string", "smooth", "none"};
static const char *const rule_names[TF_RULES] = {"persist", "slip+", "slip-",
                                                 "random"};

const cli_start_t cli_starts[CLI_STARTS] = {
    {"r", "m"}, {"v", "m/s"}, {"omega", "rad/s"}, {"h", "m/s"}, {"phi", "rad"}};

const char *cli_law_name(tf_tyre_law_t law) { return law_names[law]; }

const char *cli_rule_name(tf_rule_t rule) { return rule_names[rule]; }

// Index of a name in a table, or count where it is not in it.
static size_t find_name(const char *const *names, size_t count,
                        const char *name) {
  size_t i = 0;
  while (i < count && strcmp(names[i], name) != 0) {
    i++;
  }
  return i;
}

static int append(cli_settings_t *settings, const char *option,
                  const char *text, const char *name, const char *value) {
  if (settings->count == CLI_SETTINGS) {
    return cli_complain(CLI_USAGE, "%s %s: more than %d settings", option, text,
                        CLI_SETTINGS);
  }
  for (size_t i = 0; i < settings->count; i++) {
    const cli_setting_t *first = &settings->list[i];
    if (strcmp(first->name, name) == 0) {
      return cli_complain(CLI_USAGE, "%s %s: %s was already given by %s %s",
                          option, text, name, first->option, first->text);
    }
  }
  cli_setting_t *setting = &settings->list[settings->count++];
  setting->option = option;
  setting->text = text;
  setting->value = value;
  (void)snprintf(setting->name, sizeof setting->name, "%s", name);
  return CLI_DONE;
}

int cli_settings_add_named(cli_settings_t *settings, const char *option,
                           const char *name, const char *value) {
  return append(settings, option, value, name, value);
}

int cli_settings_add(cli_settings_t *settings, const char *option,
                     const char *text) {
  char name[CLI_NAME_ROOM];
  const char *equals = strchr(text, '=');
  if (equals == NULL || equals == text) {
    return cli_complain(CLI_USAGE, "%s %s: expected NAME=VALUE", option, text);
  }
  const size_t length = (size_t)(equals - text);
  if (length >= sizeof name) {
    return cli_complain(CLI_USAGE,
                        "%s %s: unknown name ('twofold help run' lists them)",
                        option, text);
  }
  memcpy(name, text, length);
  name[length] = '\0';
  return append(settings, option, text, name, equals + 1);
}

static int unknown_setting(const cli_setting_t *setting) {
  cli_closest_t closest = cli_closest_to(setting->name);
  for (size_t i = 0; i < TF_PARAMETERS; i++) {
    cli_closest_offer(&closest, tf_parameter_ranges[i].name);
  }
  for (size_t i = 0; i < CLI_STARTS; i++) {
    cli_closest_offer(&closest, cli_starts[i].name);
  }
  cli_closest_offer(&closest, "law");
  const cli_hint_t hint = cli_closest_hint(&closest);
  return cli_complain(CLI_USAGE, "%s %s: unknown name '%s'%s%s%s",
                      setting->option, setting->text, setting->name,
                      hint.before, hint.name, hint.after);
}

static int read_law(cli_setup_t *setup, const cli_setting_t *setting) {
  const size_t law = find_name(law_names, TF_TYRE_LAWS, setting->value);
  if (law == TF_TYRE_LAWS) {
    cli_closest_t closest = cli_closest_to(setting->value);
    for (size_t i = 0; i < TF_TYRE_LAWS; i++) {
      cli_closest_offer(&closest, law_names[i]);
    }
    const cli_hint_t hint = cli_closest_hint(&closest);
    return cli_complain(CLI_USAGE,
                        "%s %s: unknown law '%s'; laws are jump, coulomb, "
                        "two_piece, string, smooth and none%s%s%s",
                        setting->option, setting->text, setting->value,
                        hint.before, hint.name, hint.after);
  }
  setup->params.law = (tf_tyre_law_t)law;
  return CLI_DONE;
}

static int read_setting(cli_setup_t *setup, const cli_setting_t *setting) {
  const char *why = "";
  tf_real_t value = 0;
  size_t parameter = 0;
  size_t start = 0;
  if (strcmp(setting->name, "law") == 0) {
    return read_law(setup, setting);
  }
  while (parameter < TF_PARAMETERS &&
         strcmp(tf_parameter_ranges[parameter].name, setting->name) != 0) {
    parameter++;
  }
  while (start < CLI_STARTS &&
         strcmp(cli_starts[start].name, setting->name) != 0) {
    start++;
  }
  if (parameter == TF_PARAMETERS && start == CLI_STARTS) {
    return unknown_setting(setting);
  }
  if (!cli_read_real(setting->value, &value, &why)) {
    return cli_complain(CLI_USAGE, "%s %s: '%s' %s", setting->option,
                        setting->text, setting->value, why);
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

static int unknown_rule(const char *select, const char *name) {
  cli_closest_t closest = cli_closest_to(name);
  for (size_t i = 0; i < TF_RULES; i++) {
    cli_closest_offer(&closest, rule_names[i]);
  }
  const cli_hint_t hint = cli_closest_hint(&closest);
  return cli_complain(CLI_USAGE,
                      "--select %s: unknown rule '%s'; rules are persist, "
                      "slip+, slip- and random[:SEED]%s%s%s",
                      select, name, hint.before, hint.name, hint.after);
}

static int read_rule(cli_setup_t *setup, const char *select) {
  char name[CLI_NAME_ROOM];
  const size_t length = strcspn(select, ":");
  (void)snprintf(name, sizeof name, "%.*s",
                 (int)(length < sizeof name ? length : sizeof name - 1),
                 select);
  const size_t rule = find_name(rule_names, TF_RULES, name);
  if (rule == TF_RULES) {
    return unknown_rule(select, name);
  }
  setup->params.rule = (tf_rule_t)rule;
  if (select[length] == '\0') {
    return CLI_DONE;
  }
  if (setup->params.rule != TF_RULE_RANDOM) {
    return cli_complain(
        CLI_USAGE, "--select %s: only the rule random takes a seed", select);
  }
  uint64_t seed = 0;
  if (!cli_read_whole(select + length + 1, 0, UINT32_MAX, &seed)) {
    return cli_complain(CLI_USAGE,
                        "--select %s: the seed must be a whole number in "
                        "[0, 4294967295]",
                        select);
  }
  setup->seed = (uint32_t)seed;
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
    const int code = read_setting(setup, &settings->list[i]);
    if (code != CLI_DONE) {
      return code;
    }
  }
  return select != NULL ? read_rule(setup, select) : CLI_DONE;
}
