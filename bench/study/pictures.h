/* The pictures of a study: a frame lit by configurations, each once. */
#ifndef TL_STUDY_PICTURES_H
#define TL_STUDY_PICTURES_H

#include "study_frame.h"
#include "study_knobs.h"
#include "tilelight/image.h"
#include "tilelight/lighting.h"

/* Of one configuration's chain of causes all are there at once, and those of its layout again for the
 * next. */
enum { TL_STUDY_LEAST_KEPT = 8, TL_STUDY_MOST_KEPT = 48, TL_STUDY_GBUFFERS_KEPT = 3 };

typedef struct tl_study_kept_picture {
    tl_study_config of;
    tl_image *image; /* NULL: none */
    uint64_t used;   /* when, by count of uses */
} tl_study_kept_picture;

typedef struct tl_study_kept_gbuffer {
    tl_study_config of; /* its layout and compression */
    tl_gbuffer *gbuffer;
    uint64_t used;
} tl_study_kept_gbuffer;

/* Begun with tl_study_pictures_begin, released with tl_study_pictures_end. */
typedef struct tl_study_pictures {
    tl_device *device; /* borrowed, as the frame is */
    const tl_study_frame *frame;
    char file[4096]; /* that G-buffers go through which their compression changes */
    tl_study_needs needs;
    const char *exact[TL_STUDY_KNOB_COUNT]; /* words of the reference */
    tl_image *
        reference; /* in double from full float, all exact, every light for every pixel; owned */
    double mean;   /* of its values */
    float exposure; /* of a screen, stops: its own automatic one */
    size_t room;    /* of `kept` */
    uint64_t uses;
    tl_study_kept_picture kept[TL_STUDY_MOST_KEPT];
    tl_study_kept_gbuffer gbuffers[TL_STUDY_GBUFFERS_KEPT];
} tl_study_pictures;

/* What the frame has, and the device can. */
tl_study_needs tl_study_needs_of(const tl_study_frame *frame, const tl_device *device);

/* Lights the reference. folder: for a temporary file. Fails as tl_lighting_run does, with TL_ERR_ARGUMENT
 * where nothing is lit, or TL_ERR_MEMORY. */
tl_status tl_study_pictures_begin(tl_study_pictures *pictures,
                                  tl_device *device,
                                  const tl_study_frame *frame,
                                  const char *folder,
                                  tl_error *err);

/* Accepts all zero. */
void tl_study_pictures_end(tl_study_pictures *pictures);

/* The configuration with all knobs of causes after `cause` exact; with -1 all knobs: the reference's. */
tl_study_config tl_study_config_up_to(const tl_study_pictures *pictures,
                                      const tl_study_config *config,
                                      int cause);

/* The G-buffer that a configuration lights: packed, and with what its compression changes. *out is kept
 * until the third call after this one that asks for another. Fails as tl_gbuffer_pack, tl_gbuffer_write and
 * tl_gbuffer_read do. */
tl_status tl_study_gbuffer(tl_study_pictures *pictures,
                           const tl_study_config *config,
                           const tl_gbuffer **out,
                           tl_error *err);

/* How it is lit. */
tl_lighting_options tl_study_lighting(const tl_study_pictures *pictures,
                                      const tl_study_config *config);

/* The radiance, before the output's numbers. *out is kept until TL_STUDY_LEAST_KEPT others were asked for.
 * Fails as above and as tl_lighting_run does. */
tl_status tl_study_picture(tl_study_pictures *pictures,
                           const tl_study_config *config,
                           const tl_image **out,
                           tl_error *err);

#endif
