/* Pictures that lights shine through or that are compared, OpenEXR, PFM or PNG: does any file do more than
 * be refused? */
#include "fuzz.h"

#include "tilelight/image.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const char *const path = fuzz_file(data, size);
    tl_error err = {.status = TL_OK};
    tl_image *image = NULL;
    char record[TL_IMAGE_RECORD_SIZE];
    fuzz_must(tl_image_record(path, record) || !record[0], "a record where there is none");
    fuzz_must(memchr(record, '\0', sizeof record) != NULL, "a record without an end");
    const tl_status status = tl_image_read(path, &image, NULL, &err);
    fuzz_must_tell(status, &err, path);
    if (status == TL_OK) {
        uint8_t *const rgb = malloc((size_t)3 * image->width * image->height);
        fuzz_must(rgb != NULL, "out of memory for %u x %u pixels", image->width, image->height);
        const float exposure = tl_image_auto_exposure(image);
        for (int tone = 0; tone < TL_TONE_COUNT; tone++)
            tl_image_to_rgb8(image, exposure,
                             (tl_look){.tone = (tl_tone)tone, .dither = tone % TL_DITHER_COUNT},
                             rgb);
        free(rgb);
    }
    tl_image_destroy(image);
    return 0;
}
