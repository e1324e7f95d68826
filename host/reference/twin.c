/* Compiled once per arithmetic and instruction set: TL_TWIN is the name it then has. */
#include "tilelight/approximations.h"

/* What is a constant of a build on devices is a variable here, of the thread that lights. */
#ifdef TL_TWIN_CHOOSES
static _Thread_local tl_approximations chosen;
#    define TL_POWER (chosen.of[TL_KNOB_POWER])
#    define TL_FORM (chosen.of[TL_KNOB_FORM])
#    define TL_ROOT (chosen.of[TL_KNOB_ROOT])
#endif

#include "lit_pixel.h"
#include "twin.h"

tl_twin_rows TL_TWIN;

void TL_TWIN(const tl_prepared *prepared,
             const tl_word_planes *planes,
             float *const radiance[3],
             size_t begin,
             size_t end)
{
    const uint32_t tile = prepared->frame.tile_size;
    const uint32_t width = prepared->frame.tiles_x * tile;
#ifdef TL_TWIN_CHOOSES
    chosen = prepared->approximations;
#endif
    for (uint32_t row = (uint32_t)begin; row < end; row++) {
        for (uint32_t column = 0; column < width; column++) {
            const size_t at = (size_t)row * prepared->frame.pitch + column;
            const tl_words words = tl_words_at(planes, at);
            const surface s =
                unpacked_surface(&prepared->frame, prepared->needs, planes->layout, &words,
                                 prepared->rows, (real)column, (real)row);
            const pixel in = pixel_of(prepared->needs, planes->layout, &words, -s.position.z);
            const vec3 out =
                seen_radiance(&prepared->frame, prepared->needs, prepared->lights, in.depth,
                              light_surface(prepared, in, s), (real)column, (real)row);
            radiance[0][at] = (float)out.x;
            radiance[1][at] = (float)out.y;
            radiance[2][at] = (float)out.z;
        }
    }
}
