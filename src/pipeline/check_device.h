/* The one way from a device's error to a caller's. */
#ifndef LOM_PIPELINE_CHECK_DEVICE_H
#define LOM_PIPELINE_CHECK_DEVICE_H

#include <lom/pipeline.h>

/* True while the device has not failed. Else false, and error holds the device's first failure unless it holds one
 * already. A NULL device is one that there was no memory for. */
bool lom_check_device(const lom_device *device, lom_error *error);

/* The device fails with LOM_ERROR_ABANDONED, so passes, draws and textures do nothing from now on, until that failure is
 * forgotten. A device that has failed otherwise keeps that failure. */
void lom_abandon_passes(lom_device *device);
void lom_resume_passes(lom_device *device);

/* Forgets a failure outside of passes, such as that of a texture for which there was no memory. */
void lom_forget_failure(lom_device *device);

/* Textures that are made from now on are filtered so (lom_device_desc.filtering). */
void lom_set_device_filtering(lom_device *device, lom_filtering filtering);

#endif
