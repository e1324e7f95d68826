/* Compiled once per arithmetic and instruction set: TL_TWIN is the name it then has. */
#include "tilelight/approximations.h"

/* What is a constant of a build on devices is a variable here, of the thread that lights. */
#ifdef TL_TWIN_CHOOSES
static _Thread_local tl_approximations chosen;
#    define TL_POWER (chosen.of[TL_KNOB_POWER])
#    define TL_FORM (chosen.of[TL_KNOB_FORM])
#    define TL_ROOT (chosen.of[TL_KNOB_ROOT])
#endif

#include "blend.h"
#include "twin_pixel.h"

tl_twin_rows TL_TWIN;

/* What the image gets; of a layer, which lies between as floats, what is seen through it. */
static float seen(real lit, const float *opacity, size_t at, float behind)
{
    return opacity ? (float)blended((real)opacity[at], (real)(float)lit, (real)behind)
                   : (float)lit;
}

/* Three planes of plane_size numbers. */
static void put(vec3 color, const float *opacity, float *planes, size_t plane_size, size_t at)
{
    const real of[3] = {color.x, color.y, color.z};
    for (size_t i = 0; i < 3; i++)
        planes[i * plane_size + at] = seen(of[i], opacity, at, planes[i * plane_size + at]);
}

void TL_TWIN(const tl_prepared *prepared,
             const tl_word_planes *planes,
             const float *opacity,
             float *radiance,
             size_t begin,
             size_t end)
{
    const light_choice all = {NULL, prepared->frame.light_count};
    const uint32_t tile = prepared->frame.tile_size;
    const uint32_t width = prepared->frame.tiles_x * tile;
    const size_t plane_size = (size_t)prepared->frame.rows * prepared->frame.pitch;
    const tl_u32 split = prepared->needs.split;
#ifdef TL_TWIN_CHOOSES
    chosen = prepared->approximations;
#endif
    for (uint32_t row = (uint32_t)begin; row < end; row++) {
        for (uint32_t column = 0; column < width; column++) {
            const size_t at = (size_t)row * prepared->frame.pitch + column;
            if (opacity && !(opacity[at] > 0.0f))
                continue;
            const seen_pixel out = twin_pixel(prepared, planes, all, column, row);
            put(out.radiance, opacity, radiance, plane_size, at);
            for (tl_u32 term = 0; term < TL_AOV_COUNT; term++)
                if (split >> term & 1u)
                    put(out.terms[term], opacity,
                        radiance + TL_AOV_PLANE(split, term) * plane_size, plane_size, at);
        }
    }
}
