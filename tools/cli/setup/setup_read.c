// Settings into a setup. Here a text becomes a number and a name finds its
// member. Whether the number is in its range is checked later and in a single
// place, by tf_prepare, because ranges depend on the law and the law may be set
// after the parameter.

#include <string.h>

#include "../text/closest.h"
#include "../text/message.h"
#include "../text/number.h"
#include "names.h"
#include "setup.h"

const cli_start_t cli_starts[CLI_STARTS] = {
    {"r", "m"}, {"v", "m/s"}, {"omega", "rad/s"}, {"h", "m/s"}, {"phi", "rad"}};

static int unknown_setting(const cli_setting_t *setting) {
  cli_closest_t closest = cli_closest_to(setting->name);
  for (size_t i = 0; i < TF_PARAMETERS; i++) {
    cli_closest_offer(&closest, tf_parameter_ranges[i].name);
  }
  for (size_t i = 0; i < CLI_STARTS; i++) {
    cli_closest_offer(&closest, cli_starts[i].name);
  }
  cli_closest_offer(&closest, "law");
  cli_closest_offer(&closest, "rest");
  const cli_hint_t hint = cli_closest_hint(&closest);
  return cli_message(CLI_USAGE, "%s %s: unknown name '%s'%s%s%s",
                     setting->option, setting->text, setting->name, hint.before,
                     hint.name, hint.after);
}

static int read_setting(cli_setup_t *setup, const cli_setting_t *setting) {
  const char *why = "";
  tf_real_t value = 0;
  const size_t parameter = cli_parameter_index(setting->name);
  size_t start = 0;
  if (strcmp(setting->name, "law") == 0) {
    return cli_find_law(setting->option, setting->text, setting->value,
                        &setup->params.law);
  }
  if (strcmp(setting->name, "rest") == 0) {
    return cli_find_rest(setting->option, setting->text, setting->value,
                         &setup->params.rest);
  }
  while (start < CLI_STARTS &&
         strcmp(cli_starts[start].name, setting->name) != 0) {
    start++;
  }
  if (parameter == TF_PARAMETERS && start == CLI_STARTS) {
    return unknown_setting(setting);
  }
  if (!cli_read_real(setting->value, &value, &why)) {
    return cli_message(CLI_USAGE, "%s %s: '%s' %s", setting->option,
                       setting->text, setting->value, why);
  }
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

const cli_setting_t *cli_setup_setting(const cli_setup_t *setup,
                                       const char *parameter) {
  const size_t i = cli_parameter_index(parameter);
  return i < TF_PARAMETERS ? setup->set_param[i] : NULL;
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
  return select != NULL
             ? cli_read_rule(select, &setup->params.rule, &setup->seed)
             : CLI_DONE;
}
