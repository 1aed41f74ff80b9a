// Laws and rules by their names, and parameters.

#include <stdio.h>
#include <string.h>

#include "../text/message.h"
#include "../text/number.h"
#include "setup.h"

#define NAME_ROOM 16 // longer than any name, with its terminating zero

size_t cli_parameter_index(const char *name) {
  size_t i = 0;
  while (i < TF_PARAMETERS && strcmp(tf_parameter_ranges[i].name, name) != 0) {
    i++;
  }
  return i;
}

tf_real_t cli_parameter(const tf_params_t *params, size_t index) {
  tf_real_t value = 0;
  memcpy(&value,
         (const unsigned char *)params + tf_parameter_ranges[index].offset,
         sizeof value);
  return value;
}

bool cli_parameter_fits(size_t index, tf_real_t value) {
  const bool counts = strcmp(tf_parameter_ranges[index].name, "segments") == 0;
  return !counts || !(value >= 0 && value < TF_R(65536.0)) ||
         (double)(uint32_t)value >= (double)value;
}

void cli_print_range(size_t parameter) {
  const tf_parameter_range_t *range = &tf_parameter_ranges[parameter];
  const bool plain = strcmp(range->unit, "1") == 0;
  (void)printf("  %-9s [%g, %g]%s%s", range->name, (double)range->low,
               (double)range->high, plain ? "" : " ", plain ? "" : range->unit);
  if ((range->laws & (1u << TF_TYRE_COULOMB)) == 0) {
    const char *separator = ", only in law ";
    for (unsigned law = 0; law < TF_TYRE_LAWS; law++) {
      if ((range->laws & (1u << law)) != 0) {
        (void)printf("%s%s", separator, tf_tyre_law_name(law));
        separator = ", ";
      }
    }
  }
  (void)putchar('\n');
}

void cli_print_ranges(void) {
  for (size_t i = 0; i < TF_PARAMETERS; i++) {
    cli_print_range(i);
  }
}

// All names as "a, b and c".
static void list_names(const char *name_of(unsigned), unsigned count,
                       char *list, size_t room) {
  size_t length = 0;
  for (unsigned i = 0; i < count && length < room; i++) {
    const char *before = i == 0 ? "" : i + 1 < count ? ", " : " and ";
    length += (size_t)snprintf(list + length, room - length, "%s%s", before,
                               name_of(i));
  }
}

// Finds the number that has a name. what: for the message, what it names, and
// how a sentence about all of them begins.
static int find_name(const char *name_of(unsigned), unsigned count,
                     const char *option, const char *text, const char *name,
                     const char *const what[2], unsigned *found) {
  char list[256];
  cli_closest_t closest = cli_closest_to(name);
  for (unsigned i = 0; i < count; i++) {
    if (strcmp(name_of(i), name) == 0) {
      *found = i;
      return CLI_DONE;
    }
    cli_closest_offer(&closest, name_of(i));
  }
  list_names(name_of, count, list, sizeof list);
  return cli_message(CLI_USAGE, "%s %s: unknown %s '%s'; %s %s%s", option, text,
                     what[0], name, what[1], list, closest.hint);
}

int cli_find_law(const char *option, const char *text, const char *name,
                 tf_tyre_law_t *law) {
  static const char *const what[] = {"law", "laws are"};
  unsigned found = *law;
  const int code = find_name(tf_tyre_law_name, TF_TYRE_LAWS, option, text, name,
                             what, &found);
  *law = (tf_tyre_law_t)found;
  return code;
}

int cli_find_rest(const char *option, const char *text, const char *name,
                  tf_rest_law_t *rest) {
  static const char *const what[] = {"law of rest", "they are"};
  unsigned found = *rest;
  const int code = find_name(tf_rest_law_name, TF_REST_LAWS, option, text, name,
                             what, &found);
  *rest = (tf_rest_law_t)found;
  return code;
}

int cli_find_rule(const char *option, const char *text, const char *name,
                  tf_rule_t *rule) {
  static const char *const what[] = {"rule", "rules are"};
  if (strchr(name, ':') != NULL) {
    return cli_message(CLI_USAGE,
                       "%s %s: a seed is not part of a scene: give the rule "
                       "alone here, and --select %s to 'run'",
                       option, text, name);
  }
  unsigned found = *rule;
  const int code =
      find_name(tf_rule_name, TF_RULES, option, text, name, what, &found);
  *rule = (tf_rule_t)found;
  return code;
}

int cli_find_scene(const char *place, const char *name, const char *besides,
                   const tf_scene_t **scene) {
  cli_closest_t closest = cli_closest_to(name);
  for (size_t i = 0; i < TF_SCENES; i++) {
    if (strcmp(tf_scenes[i]->name, name) == 0) {
      *scene = tf_scenes[i];
      return CLI_DONE;
    }
    cli_closest_offer(&closest, tf_scenes[i]->name);
  }
  return cli_message(CLI_USAGE,
                     "%sunknown scene '%s'%s ('twofold scenes' lists them%s)",
                     place, name, closest.hint, besides);
}

int cli_read_rule(const char *select, tf_rule_t *rule, uint32_t *seed) {
  char name[NAME_ROOM];
  const size_t length = strcspn(select, ":");
  (void)snprintf(name, sizeof name, "%.*s",
                 (int)(length < sizeof name ? length : sizeof name - 1),
                 select);
  const int code = cli_find_rule("--select", select, name, rule);
  if (code != CLI_DONE) {
    return code;
  }
  if (select[length] == '\0') {
    return CLI_DONE;
  }
  if (*rule != TF_RULE_RANDOM) {
    return cli_message(
        CLI_USAGE, "--select %s: only the rule random takes a seed", select);
  }
  uint64_t value = 0;
  if (!cli_read_whole(select + length + 1, 0, UINT32_MAX, &value)) {
    return cli_message(CLI_USAGE,
                       "--select %s: the seed must be a whole number in "
                       "[0, 4294967295]",
                       select);
  }
  *seed = (uint32_t)value;
  return CLI_DONE;
}
