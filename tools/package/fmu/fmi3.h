/// @file
/// FMI 3.0 for co-simulation: the types of the C interface, written from the
/// text of the standard (fmi-standard.org). Its own headers belong to the
/// importer and are not part of an FMU.
#ifndef TWOFOLD_FMU_FMI3_H
#define TWOFOLD_FMU_FMI3_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifndef FMI3_FUNCTION_PREFIX
#define FMI3_FUNCTION_PREFIX
#endif
#define FMI_PREFIX FMI3_FUNCTION_PREFIX
#define FMI_WORD fmi3
#define FMI_VALUES(type_t) type_t values[], size_t n_values
#define FMI_COUNT n_values
#define FMI_MOVING ((unsigned)(FMU_EVENT | FMU_STEP))
#include "faces.h"

typedef const char *fmi3_string_t;
typedef int fmi3_kind_t; ///< enumerations of which no value is used here

typedef void fmi3_log_t(void *environment, fmu_status_t status,
                        const char *category, const char *message);
typedef void fmi3_update_t(void *environment, double time, bool may_set,
                           bool may_get, bool finished, bool may_return,
                           bool *wants_return, double *return_time);
typedef void fmi3_clock_update_t(void *environment);
typedef void fmi3_lock_t(void);

#endif
