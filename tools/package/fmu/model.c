// Instances: their pool, their phases, their messages, and the access to their
// variables.

#include "model.h"

#include <string.h>

#include "claim.h"
#include "fmu_scene.h"

const char *const fmu_categories[FMU_CATEGORIES] = {
    "logEvents", "logStatusDiscard", "logStatusError"};

static fmu_t instances[FMU_INSTANCES];
static fmu_claim_t instance_claims[FMU_INSTANCES];

// In the order of their bits.
static const char *phase_name(unsigned phase) {
  static const char *const names[] = {"before Initialization Mode",
                                      "in Initialization Mode", "in Event Mode",
                                      "in Step Mode", "after the end"};
  size_t i = 0;
  while ((phase >> i) > 1) i++;
  return names[i];
}

fmu_message_t *fmu_begin_message(fmu_t *fmu) {
  fmu->message.length = 0;
  fmu->message.text[0] = '\0';
  fmu_say(&fmu->message, "%s: ", fmu->call);
  return &fmu->message;
}

fmu_status_t fmu_refuse_so(fmu_t *fmu, fmu_status_t status) {
  const bool discards = status == FMU_DISCARD;
  if (fmu->emit != NULL && (!discards || (fmu->logs & FMU_LOG_DISCARD) != 0))
    fmu->emit(fmu, status, fmu_categories[discards ? 1 : 2], fmu->message.text);
  return status;
}

fmu_status_t fmu_refuse(fmu_t *fmu, fmu_status_t status, const char *format,
                        ...) {
  va_list arguments;
  va_start(arguments, format);
  fmu_say_all(fmu_begin_message(fmu), format, arguments);
  va_end(arguments);
  return fmu_refuse_so(fmu, status);
}

fmu_status_t fmu_go_to(fmu_t *fmu, unsigned phase) {
  fmu->motion.phase = (uint8_t)phase;
  return FMU_OK;
}

fmu_status_t fmu_reset(fmu_t *fmu) {
  memset(&fmu->motion, 0, sizeof fmu->motion);
  fmu_defaults(&fmu->motion.values, FMU_SCENE);
  return fmu_go_to(fmu, FMU_INSTANTIATED);
}

fmu_t fmu_teller(const char *call, const char *name, bool logging) {
  fmu_t teller;
  memset(&teller, 0, sizeof teller);
  teller.call = call;
  if (name != NULL) strncpy(teller.name, name, sizeof teller.name - 1);
  teller.logs = FMU_LOG_DISCARD | (logging ? FMU_LOG_EVENTS : 0u);
  return teller;
}

fmu_t *fmu_new(fmu_t *teller, const char *token) {
  if (token == NULL || strcmp(token, FMU_TOKEN) != 0) {
    (void)fmu_error(teller, "the token is %s, but that of this FMU is %s",
                    token == NULL ? "missing" : token, FMU_TOKEN);
    return NULL;
  }
  size_t i = 0;
  while (i < FMU_INSTANCES && !fmu_claim(&instance_claims[i])) i++;
  if (i == FMU_INSTANCES) {
    (void)fmu_error(teller,
                    "%u instances are in use, which is the limit; compile with"
                    " a larger FMU_INSTANCES",
                    (unsigned)FMU_INSTANCES);
    return NULL;
  }
  instances[i] = *teller;
  (void)fmu_reset(&instances[i]);
  return &instances[i];
}

// The index of an instance in use, FMU_INSTANCES for any other address.
static size_t index_of(const void *fmu) {
  size_t i = 0;
  while (i < FMU_INSTANCES && fmu != &instances[i]) i++;
  return i < FMU_INSTANCES && fmu_claimed(&instance_claims[i]) ? i
                                                               : FMU_INSTANCES;
}

void fmu_free(void *fmu) {
  const size_t i = index_of(fmu);
  if (i < FMU_INSTANCES) fmu_release(&instance_claims[i]);
}

fmu_t *fmu_enter(void *instance, const char *call, unsigned phases) {
  const size_t i = index_of(instance);
  if (i == FMU_INSTANCES) return NULL;
  fmu_t *fmu = &instances[i];
  fmu->call = call;
  if ((fmu->motion.phase & phases) != 0) return fmu;
  fmu_message_t *message = fmu_begin_message(fmu);
  fmu_say(message,
          phases == 0 ? "this FMU is for co-simulation, without clocks, arrays,"
                        " derivatives or structural parameters"
                      : "not allowed %s; allowed ",
          phase_name(fmu->motion.phase));
  const char *comma = "";
  for (unsigned phase = 1; phase <= FMU_TERMINATED; phase *= 2) {
    if ((phases & phase) == 0) continue;
    fmu_say(message, "%s%s", comma, phase_name(phase));
    comma = ", ";
  }
  (void)fmu_refuse_so(fmu, FMU_ERROR);
  return NULL;
}

fmu_status_t fmu_set_logging(fmu_t *fmu, bool on, size_t count,
                             const char *const categories[]) {
  unsigned chosen = count == 0 ? (1u << FMU_CATEGORIES) - 1 : 0;
  for (size_t i = 0; i < count; i++) {
    size_t k = 0;
    while (k < FMU_CATEGORIES && categories != NULL && categories[i] != NULL &&
           strcmp(categories[i], fmu_categories[k]) != 0)
      k++;
    if (categories == NULL || categories[i] == NULL || k == FMU_CATEGORIES)
      return fmu_error(fmu, "no log category is called %s",
                       categories == NULL ? "NULL" : categories[i]);
    chosen |= 1u << k;
  }
  fmu->logs = on ? fmu->logs | chosen : fmu->logs & ~chosen;
  return FMU_OK;
}

fmu_status_t fmu_initialize(fmu_t *fmu, double start_time, bool stops,
                            double stop_time) {
  const double limit = 1e300;
  if (!(start_time >= -limit && start_time <= limit))
    return fmu_error(fmu, "startTime is not a finite number");
  if (stops && !(stop_time > start_time))
    return fmu_error(fmu, "stopTime is not after startTime");
  fmu->motion.start_time = start_time;
  fmu->motion.stops = stops;
  fmu->motion.stop_time = stops ? stop_time : 0;
  fmu->motion.begun = false;
  return FMU_OK;
}
