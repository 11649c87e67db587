/** \file
 * OpenCL devices: the one that a diagram runs on.
 */
#ifndef POWERCELL_C_DEVICE_H
#define POWERCELL_C_DEVICE_H

#include <powercell/c/base.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct pc_device pc_device; /**< an OpenCL device with its context, queue and programs */

/** Opens the device that `selector` names ("P:D", part of a name, "cpu", "gpu"); NULL or "" for the default.
 */
POWERCELL_API pc_status pc_device_create(const char* selector, pc_device** device);
POWERCELL_API void pc_device_destroy(pc_device* device);
/** The device's name; owned by the handle. NULL for a NULL handle. */
POWERCELL_API const char* pc_device_name(const pc_device* device);

#ifdef __cplusplus
}
#endif
#endif
