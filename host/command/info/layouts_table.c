/* The layouts side by side. */
#include "json_values.h"
#include "layout.h"
#include "layouts.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#define ERROR(name, heading, meaning, planes)                             \
    {                                                                     \
#        name, heading, meaning, planes, offsetof(tl_layout_errors, name) \
    }
const error_row error_rows[ERROR_ROW_COUNT] = {
    ERROR(depth_near, "depth, near", "of depth on the near plane, relative", TL_HAS(TL_DEPTH)),
    ERROR(depth_far, "far", "of depth on the far plane, relative", TL_HAS(TL_DEPTH)),
    ERROR(normal, "normal", "of normals towards the camera, rad", TL_THREE(TL_NORMAL_X)),
    ERROR(any_normal, "any", "of normals of any direction, rad", TL_THREE(TL_NORMAL_X)),
    ERROR(albedo, "albedo", "of albedo in [0, 1]", TL_THREE(TL_ALBEDO_R)),
    ERROR(specular, "specular", "of specular colour in [0, 1]", TL_THREE(TL_SPECULAR_R)),
    ERROR(shininess, "exponent", "of 1 + exponent, relative", TL_HAS(TL_SHININESS)),
    ERROR(metallic, "metallic", "of metallic", TL_HAS(TL_METALLIC)),
    ERROR(roughness, "rough", "of roughness", TL_HAS(TL_ROUGHNESS)),
    ERROR(occlusion, "ao", "of occlusion", TL_GROUP_OCCLUSION),
    ERROR(emissive, "emission", "of emission of 1 in each channel", TL_GROUP_EMISSIVE),
};
#undef ERROR

tl_camera layouts_camera(void)
{
    static const double eye[3] = {0, 0, 0}, target[3] = {0, 0, -1}, up[3] = {0, 1, 0};
    static const double sixty_degrees = 1.0471975511965976;
    return tl_camera_look_at(eye, target, up, sixty_degrees, 1920, 1080, 0.1, 1000.0);
}

uint32_t layout_content(enum tl_layout_name layout, uint32_t more)
{
    const uint32_t can_hold = tl_layout_planes(layout);
    const uint32_t material =
        can_hold & TL_GROUP_METAL_ROUGH ? TL_GROUP_METAL_ROUGH : TL_GROUP_PHONG;
    return tl_layout_planes_of(layout, can_hold & (TL_GROUP_BASE | material | more));
}

uint32_t layout_pixel_size(enum tl_layout_name layout, uint32_t present)
{
    const tl_layout *row = &tl_layouts[layout];
    uint32_t size = 0;
    for (uint32_t i = 0; i < row->word_count; i++)
        size += word_bytes(row, present, i);
    return size;
}

/* What a frame may have beside depth, normal and albedo. */
static const struct {
    const char *key, *word;
    uint32_t planes;
} groups[] = {
    {"phong", "Phong", TL_GROUP_PHONG},
    {"metal_rough", "metal-rough", TL_GROUP_METAL_ROUGH},
    {"occlusion", "occlusion", TL_GROUP_OCCLUSION},
    {"emission", "emission", TL_GROUP_EMISSIVE},
    {"brdf", "index", TL_GROUP_BRDF},
    {"tangent", "tangent", TL_GROUP_TANGENT},
};
enum { GROUP_COUNT = sizeof groups / sizeof groups[0] };

static uint32_t size_added(enum tl_layout_name layout, uint32_t by)
{
    return layout_pixel_size(layout, layout_content(layout, by)) -
           layout_pixel_size(layout, layout_content(layout, 0));
}

static void print_contents(enum tl_layout_name layout)
{
    const uint32_t can_hold = tl_layout_planes(layout);
    const uint32_t none = TL_GROUP_BASE;
    const char *between = "";
    printf("%-18s %5u %4u %4u  ", tl_layout_word(layout),
           layout_pixel_size(layout, layout_content(layout, 0)),
           size_added(layout, TL_GROUP_OCCLUSION), size_added(layout, TL_GROUP_EMISSIVE));
    char list[128] = "";
    for (int i = 0; i < GROUP_COUNT; i++)
        if (can_hold & groups[i].planes) {
            snprintf(list + strlen(list), sizeof list - strlen(list), "%s%s", between,
                     groups[i].word);
            between = ", ";
        }
    printf("%-62s  %s\n", can_hold == none ? "no material" : list,
           tl_layout_describe(layout)->summary);
}

static double error_of(const tl_layout_errors *errors, const error_row *row)
{
    double value = 0.0;
    memcpy(&value, (const char *)errors + row->offset, sizeof value);
    return value;
}

static void print_errors(enum tl_layout_name layout)
{
    const tl_camera camera = layouts_camera();
    const tl_layout_errors errors = tl_layout_errors_of(&camera, layout);
    const uint32_t can_hold = tl_layout_planes(layout);
    printf("%-18s", tl_layout_word(layout));
    for (int i = 0; i < ERROR_ROW_COUNT; i++) {
        const double value = error_of(&errors, &error_rows[i]);
        if (!(can_hold & error_rows[i].planes))
            printf(" %9s", "-");
        else if (value <= 0.0)
            printf(" %9s", "exact");
        else
            printf(" %9.1e", value);
    }
    putchar('\n');
}

static void print_error_heading(void)
{
    printf("\n%-18s", "errors at most");
    for (int i = 0; i < ERROR_ROW_COUNT; i++)
        printf(" %*s", i == 0 ? 11 : i == 1 ? 7 : 9, error_rows[i].heading);
    putchar('\n');
}

static void print_footing(void)
{
    const tl_camera camera = layouts_camera();
    printf(
        "\nBytes are those of a pixel: of depth, normal, albedo and the material (metal-rough "
        "where the layout\ncan hold it, else Phong); occlusion and emission add \"ao\" and "
        "\"em\" to it. Errors are derived from\nthe rows of kernels/layout.h, for a camera of "
        "60 degrees, near %g m, far %g m: depth relative, in a\ncorner of the picture; normals "
        "in rad, those that face the camera and any; exponents relative to\n1 + exponent; all "
        "else absolute. `tilelight layouts NAME' says where each bit is.\n",
        (double)camera.near, (double)camera.far);
}

void layouts_print(void)
{
    printf("%-18s %5s %4s %4s  %-62s  %s\n", "layout", "bytes", "ao", "em",
           "holds, beside depth, normal, albedo", "what it is");
    for (int i = 0; i < TL_LAYOUT_COUNT; i++)
        print_contents((enum tl_layout_name)i);
    print_error_heading();
    for (int i = 0; i < TL_LAYOUT_COUNT; i++)
        print_errors((enum tl_layout_name)i);
    print_footing();
}

static json_t *errors_json(enum tl_layout_name layout)
{
    const tl_camera camera = layouts_camera();
    const tl_layout_errors errors = tl_layout_errors_of(&camera, layout);
    const uint32_t can_hold = tl_layout_planes(layout);
    json_t *object = json_object();
    for (int i = 0; i < ERROR_ROW_COUNT; i++)
        if (can_hold & error_rows[i].planes)
            json_object_set_new(object, error_rows[i].key,
                                tl_json_number(error_of(&errors, &error_rows[i])));
    return object;
}

static json_t *targets_json(const tl_layout_info *info)
{
    json_t *array = json_array();
    for (uint32_t i = 0; i < info->target_count; i++) {
        const tl_target *target = &info->targets[i];
        const tl_format_row *format = tl_format_describe(target->format);
        json_array_append_new(
            array, json_pack("{ss si si si ss}", "format", format->word, "bytes",
                             (int)format->bytes, "first_word", (int)target->first_word, "words",
                             (int)target->word_count, "holds", target->holds));
    }
    return array;
}

json_t *layout_json(enum tl_layout_name layout)
{
    const tl_layout_info *info = tl_layout_describe(layout);
    const uint32_t can_hold = tl_layout_planes(layout);
    json_t *holds = json_array();
    for (int i = 0; i < GROUP_COUNT; i++)
        if (can_hold & groups[i].planes)
            json_array_append_new(holds, json_string(groups[i].key));
    return json_pack("{ss ss ss si si si so so so so}", "name", tl_layout_word(layout),
                     "summary", info->summary, "source", info->source, "bytes",
                     (int)layout_pixel_size(layout, layout_content(layout, 0)),
                     "occlusion_adds", (int)size_added(layout, TL_GROUP_OCCLUSION),
                     "emission_adds", (int)size_added(layout, TL_GROUP_EMISSIVE), "holds",
                     holds, "targets", targets_json(info), "words", layout_words_json(layout),
                     "errors", errors_json(layout));
}
