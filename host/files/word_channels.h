/* The channels of a G-buffer's file: the words of its layout, by what they hold. */
#ifndef TL_WORD_CHANNELS_H
#define TL_WORD_CHANNELS_H

#include "layout.h"

#include <stddef.h>
#include <stdint.h>

/* As OpenEXR counts them (exr_pixel_type_t). */
enum tl_word_type { TL_WORD_UINT, TL_WORD_HALF, TL_WORD_FLOAT };
extern const char *const tl_word_types[]; /* "uint", ... */

/* One word; or several of less than 32 bits, which share a number, the first in its lowest bits: a channel
 * has four bytes, or two where it is a half. */
typedef struct tl_word_channel {
    char name[64];
    enum tl_word_type type; /* in the file */
    enum tl_word_type held; /* in memory: the same; of an index float */
    uint32_t first_word, word_count;
    uint32_t bits; /* of the number that are words */
} tl_word_channel;

/* Of a frame that has the planes `present`, in the order of its words; returns how many. In full float they
 * are the planes' own (planes.h); else wordNN.WHAT, NN being the first word and WHAT what is in it. */
size_t tl_word_channels(enum tl_layout_name layout,
                        uint32_t present,
                        tl_word_channel out[TL_MAX_WORDS]);

/* Whether a channel's numbers stand in memory as they stand in the file. */
int tl_word_is_whole(const tl_word_channel *channel);

#endif
