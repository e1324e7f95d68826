/* A group of pixels in double. Compiled once per instruction set: TL_TWIN is the name it then has. */
#include "some_pixels.h"
#include "twin_pixel.h"

tl_some_twin TL_TWIN;

static void include(real *low, real *high, real value)
{
    *low = value < *low ? value : *low;
    *high = value > *high ? value : *high;
}

/* Of the positions of surfaces. */
static box box_of(const tl_prepared *prepared,
                  const tl_word_planes *planes,
                  const tl_pixel_at *at,
                  size_t count)
{
    box b = {{(real)INFINITY, (real)INFINITY, (real)INFINITY},
             {-(real)INFINITY, -(real)INFINITY, -(real)INFINITY}};
    for (size_t i = 0; i < count; i++) {
        const tl_words words =
            tl_words_at(planes, (size_t)at[i].y * prepared->frame.pitch + at[i].x);
        const vec3 p = position_of(&prepared->frame, prepared->needs, planes->layout, &words,
                                   (real)at[i].x, (real)at[i].y);
        if (!(-p.z < (real)INFINITY))
            continue;
        include(&b.low.x, &b.high.x, p.x);
        include(&b.low.y, &b.high.y, p.y);
        include(&b.low.z, &b.high.z, p.z);
    }
    return b;
}

/* By the argument of reach.h, in double, no light is left out that reaches a pixel of the box. */
static light_choice lights_of(const tl_prepared *prepared, box of, uint32_t *reaching)
{
    const tl_frame *frame = &prepared->frame;
    uint32_t count = 0;
    if (!reaching)
        return (light_choice){NULL, frame->light_count};
    for (uint32_t i = 0; i < frame->light_count; i++) {
        reaching[count] = i;
        count += i < frame->global_count || reaches_box(prepared->lights[i], of);
    }
    return (light_choice){reaching, count};
}

void TL_TWIN(const tl_prepared *prepared,
             const tl_word_planes *planes,
             const tl_pixel_at *at,
             size_t count,
             uint32_t *reaching,
             float (*radiance)[3])
{
    const light_choice lights =
        lights_of(prepared, box_of(prepared, planes, at, count), reaching);
    for (size_t i = 0; i < count; i++) {
        const vec3 out = twin_pixel(prepared, planes, lights, at[i].x, at[i].y).radiance;
        radiance[i][0] = (float)out.x;
        radiance[i][1] = (float)out.y;
        radiance[i][2] = (float)out.z;
    }
}
