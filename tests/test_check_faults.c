/* Does the check find a kernel that is wrong, and pass one that is right in another way?
 *
 * What is wrong by little: tests/test_check_sensitivity.c. */
#include "frames.h"
#include "golden_scenes.h"

#include "check_frames.h"

#include "tilelight/check.h"

/* The kernel of docs/kernels/plain.cl with one passage replaced, on the frame that has to show it. */
typedef struct kernel_case {
    const char *name, *frame, *passage, *replacement;
} kernel_case;

#define STABLE_POWER \
    "sin2 < 0.25f ? exp(0.5f * exponent * log1p(-sin2)) : pow(cos2, 0.5f * exponent)"
#define TEXTBOOK_POWER "pow(n_dot_h / sqrt(length2), exponent)"

static const kernel_case faults[] = {
    {"specular where n.l <= 0", "mixed",
     "if (!(n_dot_l > 0.0f))\n                    continue;",
     "diffuse = n_dot_l > 0.0f ? diffuse : (float3)(0.0f);"},
    {"half vector of l as long as it is", "spheres", "l / d + eye", "l + eye"},
    {"half vector with the eye turned round", "spheres", "l / d + eye", "l / d - eye"},
    {"range left to the falloff", "cutoff", "(!global_light && !(d2 < light.range2))", "false"},
    {"range a little too long", "cutoff", "d2 < light.range2", "d2 < light.range2 * 1.001f"},
    {"red and blue swapped", "spheres", "radiance[at] = out.x", "radiance[at] = out.z"},
    {"last row of tiles not written", "sky", "const uint listed",
     "if (tile / frame.tiles_x + 1 == frame.tiles_y)\n        return;\n    const uint listed"},
    {"sky lit as a surface", "sky", "if (depth < INFINITY)", "if (depth > 0.0f)"},
    {"normal not made unit", "normals", "n / sqrt(length2)", "n"},
    {"off by one column", "spheres", "(float)column)", "(float)(column + 1))"},
    {"lights without a range left out", "mixed", "uint k = 0;", "uint k = frame.global_count;"},
    {"last light of every list left out", "wall", "k < frame.global_count + listed",
     "k + 1 < frame.global_count + listed"},
    {"pow(n.h, e)", "peaks", STABLE_POWER, TEXTBOOK_POWER},
    {"a falloff that begins later not cut at 1", "later",
     "clamp(as_float(light.falloff) - distance * light.fade, 0.0f, 1.0f)",
     "fmax(as_float(light.falloff) - distance * light.fade, 0.0f)"},
    {"normalised, without its cosine", "normalized", "lobe *= n_dot_l", "lobe *= 1.0f"},
    {"normalised, (e + 8)/8", "normalized", "(exponent + 2.0f) / 8.0f",
     "(exponent + 8.0f) / 8.0f"},
    {"spots lit as points", "spots", "if (TL_SPOTS)", "if (false)"},
    {"a cone the wrong way round", "spots", "l) / d;\n    const float share",
     "-l) / d;\n    const float share"},
    {"a cone's share not squared", "spots", "return share * share", "return share"},
    {"a cone's share not cut at 1", "spots-parallel", "spot.scale, 0.0f, 1.0f)",
     "spot.scale, 0.0f, 2.0f)"},
    {"cones of other lights", "spots", "cone_at(spots[index]", "cone_at(spots[index / 2]"},
    {"normalised, not tinted", "normalized-metal", "specular *= diffuse *", "specular *="},
};

/* Right, though not what ours do. */
static const kernel_case variations[] = {
    {"as it is", "mixed", "", ""},
    {"lights in another order", "wall", "list[starts[tile] + k -", "list[ends[tile] - 1 - k +"},
    {"rows of a tile from below", "wall", "row0 + i / size;", "row0 + size - 1 - i / size;"},
    {"rsqrt", "mixed", "n / sqrt(length2)", "n * rsqrt(length2)"},
    {"h made unit", "peaks", "n, l / d + eye,", "n, normalize(l / d + eye),"},
    {"material first", "peaks", "diffuse * vector_of(light.diffuse)",
     "(weight * n_dot_l) / (weight * n_dot_l) * diffuse * vector_of(light.diffuse)"},
};

static const kernel_case textbook[] = {
    {"pow(n.h, e)", "peaks", STABLE_POWER, TEXTBOOK_POWER},
};

static char plain[16384];

static int read_plain(void **state)
{
    char path[4096];
    FILE *file = fopen(source_path(path, sizeof path, "docs/kernels", "plain", ".cl"), "rb");
    assert_non_null(file);
    plain[fread(plain, 1, sizeof plain - 1, file)] = '\0';
    fclose(file);
    return open_device(state);
}

/* The kernel with every `passage` replaced; there has to be one. The caller frees it. */
static char *replaced(const char *passage, const char *replacement)
{
    const char *from = plain;
    char *text = malloc(2 * sizeof plain), *to = text;
    assert_non_null(text);
    if (*passage && !strstr(plain, passage))
        fail_msg("docs/kernels/plain.cl has no \"%s\"", passage);
    while (*from)
        if (*passage && strncmp(from, passage, strlen(passage)) == 0) {
            to += sprintf(to, "%s", replacement);
            from += strlen(passage);
        } else {
            *to++ = *from++;
        }
    *to = '\0';
    return text;
}

static tl_check_report light_and_check(tl_device *device,
                                       const tl_checked_frame *frame,
                                       const tl_user_kernel *kernel,
                                       tl_cosine cosine)
{
    tl_lighting_options options = tl_lighting_options_default();
    tl_check_report report;
    tl_check *check = NULL;
    tl_error err;
    tl_image *image = image_like(frame->gbuffer);
    for (size_t i = 0; i < 3 * (size_t)image->pitch * image->rows; i++)
        image->planes[i] = NAN;
    options.kernel = *kernel;
    options.light_cutoff = frame->light_cutoff;
    options.vector_width = 1; /* compiles faster; what culls is not asked */
    options.cull = TL_CULL_NONE;
    light_frame(device, &options, frame->gbuffer, &frame->lights, image);
    ASSERT_OK(tl_check_create(frame->gbuffer, &frame->lights, frame->light_cutoff, cosine,
                              &check, &err),
              err);
    ASSERT_OK(tl_check_image(check, image, NULL, &report, &err), err);
    tl_check_destroy(check);
    tl_image_destroy(image);
    return report;
}

static int frame_named(const char *name)
{
    for (int i = 0; i < tl_check_frame_count; i++)
        if (strcmp(tl_check_frame_name(i), name) == 0)
            return i;
    fail_msg("no frame \"%s\"", name);
    return 0;
}

static tl_check_report check_case(tl_device *device, const kernel_case *of, tl_cosine cosine)
{
    tl_checked_frame frame = {0};
    tl_error err;
    char *text = replaced(of->passage, of->replacement);
    const tl_user_kernel kernel = {.text = text, .entry = "plain"};
    ASSERT_OK(tl_check_frame_make(frame_named(of->frame), &frame, &err), err);
    const tl_check_report report = light_and_check(device, &frame, &kernel, cosine);
    tl_checked_frame_clear(&frame);
    free(text);
    return report;
}

static void every_fault_is_found(void **state)
{
    int missed = 0;
    for (size_t i = 0; i < COUNT_OF(faults); i++) {
        const tl_check_report r = check_case(*state, &faults[i], TL_COSINE_STABLE);
        print_message("%-38s %-9s %5u of %4u pixels, %.3g times the tolerance\n",
                      faults[i].name, faults[i].frame, (unsigned)r.failed_count,
                      (unsigned)r.pixel_count, r.worst.ratio);
        missed += r.failed_count == 0;
    }
    assert_int_equal(missed, 0);
}

static void pass(tl_device *device, const kernel_case *cases, size_t count, tl_cosine cosine)
{
    for (size_t i = 0; i < count; i++) {
        const tl_check_report r = check_case(device, &cases[i], cosine);
        print_message("%-38s %-9s %.3g of the tolerance\n", cases[i].name, cases[i].frame,
                      r.rounding_ratio);
        if (r.failed_count > 0)
            fail_msg("%s: %u pixels outside, %.3g times the tolerance", cases[i].name,
                     (unsigned)r.failed_count, r.worst.ratio);
    }
}

static void what_is_right_passes(void **state)
{
    pass(*state, variations, COUNT_OF(variations), TL_COSINE_STABLE);
}

static void the_textbook_cosine_passes_where_it_is_allowed(void **state)
{
    pass(*state, textbook, COUNT_OF(textbook), TL_COSINE_TEXTBOOK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_fault_is_found),
        cmocka_unit_test(what_is_right_passes),
        cmocka_unit_test(the_textbook_cosine_passes_where_it_is_allowed),
    };
    return cmocka_run_group_tests(tests, read_plain, close_device);
}
