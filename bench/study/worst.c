#include "worst.h"

#include "tilelight/layouts.h"
#include "try.h"

#include <math.h>
#include <stdlib.h>

/* What is packed and unpacked together. */
static const struct {
    const char *name;
    uint32_t planes; /* bits 1 << plane */
} attributes[] = {
    {"depth", TL_HAS(TL_DEPTH)},           {"normal", TL_THREE(TL_NORMAL_X)},
    {"albedo", TL_THREE(TL_ALBEDO_R)},     {"specular", TL_THREE(TL_SPECULAR_R)},
    {"shininess", TL_HAS(TL_SHININESS)},   {"metallic", TL_HAS(TL_METALLIC)},
    {"roughness", TL_HAS(TL_ROUGHNESS)},   {"occlusion", TL_HAS(TL_OCCLUSION)},
    {"emission", TL_THREE(TL_EMISSIVE_R)}, {"index", TL_HAS(TL_BRDF)},
    {"tangent", TL_THREE(TL_TANGENT_X)},
};
enum { ATTRIBUTE_COUNT = sizeof attributes / sizeof attributes[0] };

/* A frame of that pixel alone, lit again and again. */
typedef struct pixel_frame {
    tl_gbuffer *gbuffer;
    tl_light_set lights; /* borrowed */
    tl_image *image;
    tl_lighting *lighting;
    size_t from; /* of the pixel in planes of the whole frame */
} pixel_frame;

static tl_status begin(
    const tl_study_pictures *p, uint32_t x, uint32_t y, pixel_frame *f, tl_error *err)
{
    const tl_gbuffer *whole = p->frame->gbuffer;
    tl_lighting_options options = tl_lighting_options_default();
    tl_camera camera = whole->camera;
    tl_status status = TL_OK;
    const double column = ((double)camera.right - (double)camera.left) / camera.width;
    const double row = ((double)camera.top - (double)camera.bottom) / camera.height;
    camera.right = (float)((double)whole->camera.left + (x + 1) * column);
    camera.left = (float)((double)whole->camera.left + x * column);
    camera.bottom = (float)((double)whole->camera.top - (y + 1) * row);
    camera.top = (float)((double)whole->camera.top - y * row);
    camera.width = camera.height = 1;
    options.precision = TL_PRECISION_REFERENCE;
    f->lights = p->frame->lights;
    f->from = (size_t)y * whole->pitch + x;
    TRY(tl_gbuffer_create(&camera, whole->present, &f->gbuffer, err));
    TRY(tl_image_create(1, 1, &f->image, err));
    TRY(tl_lighting_create(NULL, &options, &f->lighting, err));
done:
    return status;
}

static void end(pixel_frame *f)
{
    tl_lighting_destroy(f->lighting);
    tl_image_destroy(f->image);
    tl_gbuffer_destroy(f->gbuffer);
}

/* Sets the planes of both that are among `planes`; those that `from` lacks stay empty. */
static void take(pixel_frame *f, const tl_gbuffer *from, uint32_t planes)
{
    for (int plane = 0; plane < TL_PLANE_COUNT; plane++) {
        float *to = tl_gbuffer_plane(f->gbuffer, (enum tl_plane)plane);
        const float *source = tl_gbuffer_plane(from, (enum tl_plane)plane);
        if (to && source && (planes & TL_HAS(plane)))
            to[0] = source[f->from];
    }
}

static tl_status light(pixel_frame *f, uint32_t channel, double *out, tl_error *err)
{
    tl_status status = TL_OK;
    TRY(tl_gbuffer_repair(f->gbuffer, "a pixel", false, NULL, err));
    TRY(tl_lighting_run(f->lighting, f->gbuffer, &f->lights, f->image, NULL, NULL, NULL, err));
    *out = (double)tl_image_plane(f->image, channel)[0];
done:
    return status;
}

/* By lighting it again without any highlight. */
static tl_status find_highlight(
    pixel_frame *f, uint32_t channel, double exact, double *highlight, tl_error *err)
{
    const tl_light_set whole = f->lights;
    double without = 0.0;
    tl_status status = TL_OK;
    tl_light *plain = malloc((whole.count + 1) * sizeof *plain);
    if (!plain)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for the lights of a pixel"));
    for (size_t i = 0; i < whole.count; i++) {
        plain[i] = whole.lights[i];
        plain[i].specular = 0.0f;
    }
    f->lights.lights = plain;
    TRY(light(f, channel, &without, err));
    *highlight = exact > 0.0 ? (exact - without) / exact : 0.0;
done:
    f->lights = whole;
    free(plain);
    return status;
}

static tl_status find_attribute(pixel_frame *f,
                                const tl_gbuffer *whole,
                                const tl_gbuffer *stored,
                                uint32_t channel,
                                double exact,
                                const char **attribute,
                                tl_error *err)
{
    const uint32_t all = (1u << TL_PLANE_COUNT) - 1u;
    double value, least;
    tl_status status = TL_OK;
    take(f, stored, all);
    TRY(light(f, channel, &value, err));
    least = fabs(value - exact);
    for (int i = 0; i < ATTRIBUTE_COUNT; i++) {
        take(f, stored, all);
        take(f, whole, attributes[i].planes);
        TRY(light(f, channel, &value, err));
        if (fabs(value - exact) < least) {
            least = fabs(value - exact);
            *attribute = attributes[i].name;
        }
    }
done:
    return status;
}

tl_status tl_study_worst_find(tl_study_pictures *p,
                              const tl_study_config *config,
                              uint32_t x,
                              uint32_t y,
                              uint32_t channel,
                              const char **attribute,
                              double *highlight,
                              tl_error *err)
{
    const tl_gbuffer *whole = p->frame->gbuffer, *packed = NULL;
    tl_gbuffer *stored = NULL;
    pixel_frame f = {0};
    double exact;
    tl_status status = TL_OK;
    *attribute = "";
    TRY(tl_study_gbuffer(p, config, &packed, err));
    TRY(begin(p, x, y, &f, err));
    take(&f, whole, (1u << TL_PLANE_COUNT) - 1u);
    TRY(light(&f, channel, &exact, err));
    TRY(find_highlight(&f, channel, exact, highlight, err));
    if (packed == whole)
        goto done;
    TRY(tl_gbuffer_unpack(packed, &stored, err));
    TRY(find_attribute(&f, whole, stored, channel, exact, attribute, err));
done:
    tl_gbuffer_destroy(stored);
    end(&f);
    return status;
}
