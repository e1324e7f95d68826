/* What a compiled program depends on, as one text: two programs may share a binary exactly when
 * their keys are the same bytes. */
#ifndef TL_PROGRAM_KEY_H
#define TL_PROGRAM_KEY_H

#include "device.h"

/* The texts themselves, the build flags, the device and its driver, the processor where code is for
 * it (a home folder may serve machines of several kinds), and the settings that PoCL takes from the
 * environment. The caller frees it, [*size]; NULL if memory ran out. */
char *tl_program_key(const tl_device *device,
                     const char *const *texts,
                     size_t text_count,
                     const char *flags,
                     size_t *size);

#endif
