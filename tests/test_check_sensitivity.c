/* Does the check notice when any one number that a kernel works from is off by a ten-thousandth?
 *
 * The float kernels' text, run in C, lights frames in which one number is off; the check knows the
 * right ones. */
#include "frames.h"

#include "check_frames.h"
#include "falloff.h"
#include "reference.h"

#include "tilelight/check.h"

static const double off = 1.0001;

static void scale(float *value)
{
    *value = (float)((double)*value * off);
}

/* Numbers of the frame and of lights: each in every pixel or light alike. */
#define CHANGE_FRAME(name, field)             \
    static void change_##name(tl_prepared *p) \
    {                                         \
        scale(&p->frame.field);               \
    }
#define CHANGE_LIGHTS(name, field)                          \
    static void change_##name(tl_prepared *p)               \
    {                                                       \
        for (uint32_t i = 0; i < p->frame.light_count; i++) \
            scale(&p->lights[i].field);                     \
    }
CHANGE_FRAME(ray_x0, rays.x0)
CHANGE_FRAME(ray_dx, rays.dx)
CHANGE_FRAME(ray_y0, rays.y0)
CHANGE_FRAME(ray_dy, rays.dy)
CHANGE_FRAME(matrix, view_from_world[0][0])
CHANGE_FRAME(ambient, ambient[1])
CHANGE_FRAME(sky, sky[2])
CHANGE_LIGHTS(light_x, position[0])
CHANGE_LIGHTS(light_y, position[1])
CHANGE_LIGHTS(light_z, position[2])
CHANGE_LIGHTS(range2, range2)
CHANGE_LIGHTS(diffuse, diffuse[0])
CHANGE_LIGHTS(specular, specular[1])
CHANGE_LIGHTS(fade, fade)

#define CHANGE_SPOTS(name, field)                           \
    static void change_##name(tl_prepared *p)               \
    {                                                       \
        for (uint32_t i = 0; i < p->frame.light_count; i++) \
            scale(&p->spots[i].field);                      \
    }
CHANGE_SPOTS(spot_axis, axis[1])
CHANGE_SPOTS(spot_cosine, least_cos)
CHANGE_SPOTS(spot_scale, scale)

static void change_offset(tl_prepared *p)
{
    for (uint32_t i = 0; i < p->frame.light_count; i++) {
        float offset;
        memcpy(&offset, &p->lights[i].falloff, sizeof offset);
        scale(&offset);
        if (p->lights[i].falloff >= TL_FADE_COUNT)
            memcpy(&p->lights[i].falloff, &offset, sizeof offset);
    }
}

static const struct {
    const char *name, *frame;
    void (*change)(tl_prepared *prepared);
} changes[] = {
    {"rays.x0", "spheres", change_ray_x0},
    {"rays.dx", "spheres", change_ray_dx},
    {"rays.y0", "orthographic", change_ray_y0},
    {"rays.dy", "orthographic", change_ray_dy},
    {"view_from_world", "mixed", change_matrix},
    {"ambient", "unlit", change_ambient},
    {"sky", "sky", change_sky},
    {"a light's x", "spheres", change_light_x},
    {"a light's y", "wall", change_light_y},
    {"a light's z", "wall", change_light_z},
    {"range2", "cutoff", change_range2},
    {"diffuse", "spheres", change_diffuse},
    {"specular", "spheres", change_specular},
    {"fade, linear", "spheres", change_fade},
    {"fade, both falloffs", "mixed", change_fade},
    {"fade, from a distance", "later", change_fade},
    {"offset, from a distance", "later", change_offset},
    {"specular, normalised", "normalized", change_specular},
    {"a cone's axis", "spots", change_spot_axis},
    {"a cone's cosine", "spots", change_spot_cosine},
    {"a cone's scale", "spots", change_spot_scale},
};

static int frame_named(const char *name)
{
    for (int i = 0; i < tl_check_frame_count; i++)
        if (strcmp(tl_check_frame_name(i), name) == 0)
            return i;
    fail_msg("no frame \"%s\"", name);
    return 0;
}

/* How many pixels of `frame` the check refuses when its lights are seen through `change` and `changed`
 * is lit in place of its G-buffer. */
static unsigned count_refused(const tl_checked_frame *frame,
                              const tl_gbuffer *changed,
                              void (*change)(tl_prepared *prepared),
                              const char *name)
{
    tl_prepared prepared = {0};
    tl_check *check = NULL;
    tl_check_report report;
    tl_image *image = image_like(frame->gbuffer);
    tl_error err;
    ASSERT_OK(
        tl_prepare(changed, &frame->lights,
                   &(tl_prepare_options){.tile_size = 16, .light_cutoff = frame->light_cutoff},
                   NULL, &prepared, &err),
        err);
    if (change)
        change(&prepared);
    tl_reference_light(&prepared, changed, TL_TWIN_FLOAT, image);
    ASSERT_OK(tl_check_create(frame->gbuffer, &frame->lights, frame->light_cutoff,
                              TL_COSINE_STABLE, &check, &err),
              err);
    ASSERT_OK(tl_check_image(check, image, NULL, &report, &err), err);
    print_message("%-20s %5u of %4u pixels, %.3g times the tolerance\n", name,
                  (unsigned)report.failed_count, (unsigned)report.pixel_count,
                  report.worst.ratio);
    tl_check_destroy(check);
    tl_image_destroy(image);
    tl_prepared_clear(&prepared);
    return (unsigned)report.failed_count;
}

static void every_number_of_frame_and_lights_counts(void **state)
{
    int missed = 0;
    (void)state;
    for (size_t i = 0; i < COUNT_OF(changes); i++) {
        tl_checked_frame frame = {0};
        tl_error err;
        ASSERT_OK(tl_check_frame_make(frame_named(changes[i].frame), &frame, &err), err);
        missed += count_refused(&frame, frame.gbuffer, changes[i].change, changes[i].name) == 0;
        tl_checked_frame_clear(&frame);
    }
    assert_int_equal(missed, 0);
}

static void scale_plane(tl_gbuffer *g, enum tl_plane plane)
{
    float *values = tl_gbuffer_plane(g, plane);
    for (size_t i = 0; i < (size_t)g->pitch * g->rows; i++)
        scale(&values[i]);
}

static void every_plane_counts(void **state)
{
    static const char *const frames[] = {"mixed", "metal"};
    static const char *const names[] = {
#define NAME(name, channel, empty, meaning) channel,
        TL_PLANES(NAME)
#undef NAME
    };
    unsigned seen = 0;
    int missed = 0;
    (void)state;
    for (size_t f = 0; f < COUNT_OF(frames); f++)
        for (int p = 0; p < TL_PLANE_COUNT; p++) {
            tl_checked_frame frame = {0}, changed = {0};
            tl_error err;
            const int index = frame_named(frames[f]);
            ASSERT_OK(tl_check_frame_make(index, &frame, &err), err);
            ASSERT_OK(tl_check_frame_make(index, &changed, &err), err);
            if (frame.gbuffer->present & TL_HAS(p) & ~seen) {
                scale_plane(changed.gbuffer, (enum tl_plane)p);
                missed += count_refused(&frame, changed.gbuffer, NULL, names[p]) == 0;
                seen |= TL_HAS(p);
            }
            tl_checked_frame_clear(&changed);
            tl_checked_frame_clear(&frame);
        }
    assert_int_equal(seen, (1u << TL_BRDF) - 1); /* those behind it are for rows of materials */
    assert_int_equal(missed, 0);
}

static void nothing_off_is_nothing_refused(void **state)
{
    (void)state;
    for (int i = 0; i < tl_check_frame_count; i++) {
        tl_checked_frame frame = {0};
        tl_error err;
        ASSERT_OK(tl_check_frame_make(i, &frame, &err), err);
        assert_int_equal(count_refused(&frame, frame.gbuffer, NULL, tl_check_frame_name(i)), 0);
        tl_checked_frame_clear(&frame);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_off_is_nothing_refused),
        cmocka_unit_test(every_number_of_frame_and_lights_counts),
        cmocka_unit_test(every_plane_counts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
