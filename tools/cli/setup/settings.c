// The list of settings. Names are only compared with each other here; what they
// mean is decided when the settings are applied to a scene.

#include "settings.h"

#include <stdio.h>
#include <string.h>

#include "../text/message.h"

const cli_setting_t *cli_settings_find(const cli_settings_t *settings,
                                       const char *name) {
  for (size_t i = 0; i < settings->count; i++) {
    if (strcmp(settings->list[i].name, name) == 0) {
      return &settings->list[i];
    }
  }
  return NULL;
}

static int append(cli_settings_t *settings, const char *option,
                  const char *text, const char *name, const char *value) {
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

int cli_settings_add_named(cli_settings_t *settings, const char *option,
                           const char *name, const char *value) {
  return append(settings, option, value, name, value);
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
  memcpy(name, text, length);
  name[length] = '\0';
  return append(settings, option, text, name, equals + 1);
}
