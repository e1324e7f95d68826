/* Does every pixel arrive where it belongs, from files of every storage, compression and window, from
 * several parts, and from several files? */
#include "testing.h"

#include "foreign_exr.h"
#include "foreign_frame.h"
#include "frames.h"
#include "tilelight/gbuffer_file.h"
#include "tilelight/image.h"

static const struct {
    const char *name;
    foreign_part part; /* but for its channels */
    int origin[2];
    int colors_beside; /* in a second part, with windows of their own */
} files[] = {
    {"scanlines", {.name = NULL}, {0, 0}, 0},
    {"rle", {.compression = EXR_COMPRESSION_RLE}, {0, 0}, 0},
    {"zips", {.compression = EXR_COMPRESSION_ZIPS}, {0, 0}, 0},
    {"zip", {.compression = EXR_COMPRESSION_ZIP}, {0, 0}, 0},
    {"piz", {.compression = EXR_COMPRESSION_PIZ}, {0, 0}, 0},
    {"pxr24", {.compression = EXR_COMPRESSION_PXR24}, {0, 0}, 0},
    {"one tile", {.storage = EXR_STORAGE_TILED}, {0, 0}, 0},
    {"small tiles",
     {.storage = EXR_STORAGE_TILED, .tile_width = 4, .tile_height = 3},
     {0, 0},
     0},
    {"small tiles, zip, cropped, elsewhere",
     {.storage = EXR_STORAGE_TILED,
      .compression = EXR_COMPRESSION_ZIP,
      .tile_width = 2,
      .tile_height = 2,
      .crop = {1, 2, 3, 1}},
     {-100, 50},
     0},
    {"mipmaps",
     {.storage = EXR_STORAGE_TILED,
      .levels = EXR_TILE_MIPMAP_LEVELS,
      .tile_width = 4,
      .tile_height = 4},
     {0, 0},
     0},
    {"not at the origin", {.name = NULL}, {7, -9}, 0},
    {"cropped", {.crop = {2, 1, 3, 2}}, {0, 0}, 0},
    {"cropped to a pixel, zip",
     {.crop = {4, 3, 4, 3}, .compression = EXR_COMPRESSION_ZIP},
     {3, 4},
     0},
    {"larger than the frame", {.crop = {-2, -3, -1, -4}}, {0, 0}, 0},
    {"over two edges, piz",
     {.crop = {-2, 3, 4, -1}, .compression = EXR_COMPRESSION_PIZ},
     {-5, -5},
     0},
    {"two parts, one cropped", {.name = "depth", .crop = {1, 1, 1, 1}}, {2, 2}, 1},
    {"two parts, one tiled",
     {.name = "depth", .storage = EXR_STORAGE_TILED, .tile_width = 5, .tile_height = 5},
     {0, 0},
     1},
};

static void pixels_arrive(void **state)
{
    static foreign_file file;
    static foreign_frame frame;
    (void)state;
    char path[512];
    const int whole[4] = {0, 0, 0, 0};
    scratch_path(path, sizeof path, "import-file.exr");
    foreign_fill(&frame);
    for (size_t i = 0; i < COUNT_OF(files); i++)
        for (int is_half = 0; is_half < 2; is_half++) {
            const exr_pixel_type_t type = is_half ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT;
            const tl_import_options options = foreign_options();
            const int *crop = files[i].part.crop;
            tl_error err;
            tl_gbuffer *g = NULL;
            tl_import_counts counts;
            foreign_describe(&file, &frame, type);
            foreign_part described = file.parts[0];
            file.parts[0] = files[i].part;
            memcpy(file.parts[0].channels, described.channels, sizeof described.channels);
            file.parts[0].channel_count = described.channel_count;
            memcpy(file.origin, files[i].origin, sizeof file.origin);
            if (files[i].colors_beside) {
                file.part_count = 2;
                file.parts[0].channel_count -= 3;
                file.parts[1] = (foreign_part){.name = "albedo", .channel_count = 3};
                memcpy(file.parts[1].channels, described.channels + 5,
                       3 * sizeof described.channels[0]);
            }
            foreign_write(&file, path);
            if (tl_import_read(path, &options, NULL, &g, &counts, &err) != TL_OK)
                fail_msg("%s: %s", files[i].name, err.message);
            assert_int_equal(g->camera.width, FRAME_WIDTH);
            assert_int_equal(g->camera.height, FRAME_HEIGHT);
            foreign_assert(files[i].name, g, TL_DEPTH, frame.depth, crop);
            for (unsigned c = 0; c < 3; c++) {
                foreign_assert(files[i].name, g, (enum tl_plane)(TL_NORMAL_X + c),
                               frame.normal[c], crop);
                foreign_assert(files[i].name, g, (enum tl_plane)(TL_ALBEDO_R + c),
                               frame.albedo[c], files[i].colors_beside ? whole : crop);
            }
            int inside = FRAME_WIDTH * FRAME_HEIGHT;
            if (crop[0] + crop[1] + crop[2] + crop[3] != 0) {
                const int left = crop[0] > 0 ? crop[0] : 0, top = crop[1] > 0 ? crop[1] : 0;
                const int right = crop[2] > 0 ? crop[2] : 0, low = crop[3] > 0 ? crop[3] : 0;
                inside = (FRAME_WIDTH - left - right) * (FRAME_HEIGHT - top - low);
            }
            assert_int_equal(counts.outside, FRAME_WIDTH * FRAME_HEIGHT - inside);
            assert_int_equal(counts.sky, FRAME_WIDTH * FRAME_HEIGHT - inside);
            tl_gbuffer_destroy(g);
            remove(path);
        }
}

/* Rows from the bottom up, bytes in either order. */
static void write_pfm(const char *path, const float *const *planes, int count, int is_little)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fprintf(file, "%s\n%d %d\n%s\n", count == 3 ? "PF" : "Pf", FRAME_WIDTH, FRAME_HEIGHT,
            is_little ? "-1.0" : "1.0");
    for (int y = FRAME_HEIGHT - 1; y >= 0; y--)
        for (int x = 0; x < FRAME_WIDTH; x++)
            for (int c = 0; c < count; c++) {
                uint32_t bits;
                memcpy(&bits, &planes[c][y * FRAME_WIDTH + x], sizeof bits);
                for (int b = 0; b < 4; b++)
                    fputc((int)(bits >> (is_little ? 8 * b : 24 - 8 * b) & 0xff), file);
            }
    assert_int_equal(fclose(file), 0);
}

static void add_map(tl_import_options *options,
                    const char *before,
                    const char *path,
                    const char *after)
{
    char text[1024];
    tl_error err;
    snprintf(text, sizeof text, "%s%s%s", before, path, after);
    ASSERT_OK(tl_import_map_parse(text, &options->maps[options->map_count++], &err), err);
}

/* A texture a file, as debuggers of graphics save them; none is "the capture". */
static void planes_come_from_several_files(void **state)
{
    static foreign_file file;
    static foreign_frame frame;
    (void)state;
    char depth[512], normal[512], color[512];
    scratch_path(depth, sizeof depth, "depth.pfm");
    scratch_path(normal, sizeof normal, "normal:1.pfm");
    scratch_path(color, sizeof color, "color.exr");
    foreign_fill(&frame);
    const float *depths[1] = {frame.depth};
    const float *normals[3] = {frame.normal[0], frame.normal[1], frame.normal[2]};
    const float *colors[3] = {frame.albedo[0], frame.albedo[1], frame.albedo[2]};
    file = (foreign_file){.width = FRAME_WIDTH,
                          .height = FRAME_HEIGHT,
                          .pitch = FRAME_WIDTH,
                          .part_count = 1,
                          .parts = {{.name = "texture 7"}}};
    foreign_add_three(&file.parts[0], "", "RGB", EXR_PIXEL_FLOAT, colors);
    foreign_write(&file, color);
    for (int is_little = 0; is_little < 2; is_little++) {
        const int whole[4] = {0, 0, 0, 0};
        tl_error err;
        tl_gbuffer *g = NULL;
        tl_import_options options = foreign_options();
        write_pfm(depth, depths, 1, is_little);
        write_pfm(normal, normals, 3, !is_little);
        add_map(&options, "depth=", depth, is_little ? "" : ":Y");
        add_map(&options, "normal=", normal, is_little ? ":RGB" : ":R,G,B");
        add_map(&options, "albedo=", color, is_little ? ":texture 7/RGB" : "");
        ASSERT_OK(tl_import_read(NULL, &options, NULL, &g, NULL, &err), err);
        foreign_assert("maps", g, TL_DEPTH, frame.depth, whole);
        for (unsigned c = 0; c < 3; c++) {
            foreign_assert("maps", g, (enum tl_plane)(TL_NORMAL_X + c), frame.normal[c], whole);
            foreign_assert("maps", g, (enum tl_plane)(TL_ALBEDO_R + c), frame.albedo[c], whole);
        }
        tl_gbuffer_destroy(g);
    }
    remove(depth);
    remove(normal);
    remove(color);
}

/* 188 of 255 is 0.5028864580325687 when decoded by IEC 61966-2-1, 10 of 255 lies on the straight part:
 * 10/255/12.92. Numbers that are no colours stay. */
static void png_colors_are_decoded(void **state)
{
    static foreign_file file;
    static foreign_frame frame;
    (void)state;
    char exr[512], png[512];
    uint8_t rgb[FRAME_HEIGHT * FRAME_WIDTH * 3];
    tl_error err;
    tl_gbuffer *g = NULL;
    foreign_notices said = {""};
    const tl_notices notices = {foreign_say, &said};
    tl_import_options options = foreign_options();
    scratch_path(exr, sizeof exr, "beside.exr");
    scratch_path(png, sizeof png, "color.png");
    foreign_fill(&frame);
    foreign_describe(&file, &frame, EXR_PIXEL_FLOAT);
    foreign_write(&file, exr);
    for (size_t i = 0; i < sizeof rgb; i++)
        rgb[i] = i % 3 == 0 ? 188 : i % 3 == 1 ? 10 : 255;
    ASSERT_OK(tl_png_write(png, rgb, FRAME_WIDTH, FRAME_HEIGHT, TL_CURVE_SRGB, &err), err);
    add_map(&options, "albedo=", png, "");
    add_map(&options, "roughness=", png, ":R");
    ASSERT_OK(tl_import_read(exr, &options, &notices, &g, NULL, &err), err);
    assert_true(fabs((double)tl_gbuffer_plane(g, TL_ALBEDO_R)[3] - 0.5028864580325687) < 1e-7);
    assert_true(fabs((double)tl_gbuffer_plane(g, TL_ALBEDO_G)[3] - 10.0 / 255.0 / 12.92) <
                1e-9);
    assert_true(same_bits(tl_gbuffer_plane(g, TL_ALBEDO_B)[3], 1.0f));
    assert_true(same_bits(tl_gbuffer_plane(g, TL_ROUGHNESS)[3], 188.0f / 255.0f));
    assert_true(same_bits(tl_gbuffer_plane(g, TL_METALLIC)[3], 0.0f));
    assert_non_null(strstr(said.text, "albedo is decoded from sRGB"));
    assert_non_null(strstr(said.text, "no metallic"));
    assert_null(strstr(said.text, "roughness is decoded"));
    tl_gbuffer_destroy(g);
    remove(exr);
    remove(png);
}

/* Coverage: 0 is sky whatever the depth; in part is counted, and dropped on request; 0 everywhere is
 * ignored. */
static void coverage_counts(void **state)
{
    static foreign_file file;
    static foreign_frame frame;
    (void)state;
    char path[512];
    tl_error err;
    scratch_path(path, sizeof path, "coverage.exr");
    for (int round = 0; round < 3; round++) {
        foreign_notices said = {""};
        const tl_notices notices = {foreign_say, &said};
        tl_gbuffer *g = NULL;
        tl_import_counts counts;
        tl_import_options options = foreign_options();
        foreign_fill(&frame);
        frame.alpha[0] = 0.0f;
        frame.alpha[1] = 0.25f;
        frame.alpha[2] = 0.999f;
        frame.depth[3] = 1e10f;
        frame.depth[4] = 0.0f;
        frame.depth[5] = -1.0f;
        frame.depth[6] = INFINITY;
        frame.depth[7] = NAN;
        if (round == 2)
            memset(frame.alpha, 0, sizeof frame.alpha);
        options.edges = round == 1 ? TL_EDGES_DROP : TL_EDGES_KEEP;
        foreign_describe(&file, &frame, EXR_PIXEL_FLOAT);
        foreign_write(&file, path);
        ASSERT_OK(tl_import_read(path, &options, &notices, &g, &counts, &err), err);
        const float *depth = tl_gbuffer_plane(g, TL_DEPTH);
        assert_int_equal(counts.partial, round == 2 ? 0 : 2);
        assert_int_equal(counts.sky, round == 0 ? 5 : round == 1 ? 7 : 4);
        assert_true(isinf(depth[0]) == (round < 2));
        assert_true(isinf(depth[1]) == (round == 1));
        assert_true(isinf(depth[2]) == (round == 1));
        for (int i = 3; i < 7; i++)
            assert_true(isinf(depth[i]));
        assert_true(isnan(depth[7])); /* for tl_gbuffer_repair to count, or to refuse */
        assert_true((strstr(said.text, "2 pixels are covered in part") != NULL) == (round < 2));
        assert_true((strstr(said.text, "alpha is 0 everywhere") != NULL) == (round == 2));
        tl_gbuffer_destroy(g);
    }
    remove(path);
}

/* A pixel that is twice as wide as high sees twice as far to the side. */
static void pixels_may_be_wide(void **state)
{
    static foreign_file file;
    static foreign_frame frame;
    (void)state;
    char path[512];
    tl_error err;
    tl_gbuffer *g = NULL;
    const tl_import_options options = foreign_options();
    scratch_path(path, sizeof path, "wide.exr");
    foreign_fill(&frame);
    foreign_describe(&file, &frame, EXR_PIXEL_FLOAT);
    file.pixel_aspect = 2.0f;
    foreign_write(&file, path);
    ASSERT_OK(tl_import_read(path, &options, NULL, &g, NULL, &err), err);
    assert_true(fabs((double)g->camera.top - 0.5773502691896257) < 1e-7);
    assert_true(fabs((double)g->camera.right - 0.5773502691896257 * 2.0 * 9.0 / 7.0) < 2e-7);
    tl_gbuffer_destroy(g);
    remove(path);
}

/* Roughness 0.5 is alpha 0.25: 2/alpha^2 - 2 = 30. */
static void materials_are_told_apart(void **state)
{
    static foreign_file file;
    static foreign_frame frame;
    static const struct {
        const char *maps[5];
        uint32_t groups;
        const char *says;
    } cases[] = {
        {{NULL}, 0, ""},
        {{"specular=albedo.RGB"}, 0, "specular is ignored"},
        {{"metallic=A"}, 0, "metallic is ignored"},
        {{"roughness=A"}, TL_GROUP_METAL_ROUGH, "no metallic"},
        {{"roughness=A", "metallic=A"}, TL_GROUP_METAL_ROUGH, ""},
        {{"roughness=A", "specular=albedo"}, TL_GROUP_PHONG, "shininess is 2/alpha^2"},
        {{"shininess=A", "specular=albedo"}, TL_GROUP_PHONG, ""},
        {{"roughness=A", "metallic=A", "specular=albedo"},
         TL_GROUP_METAL_ROUGH,
         "specular is ignored"},
        {{"ao=A", "emissive=albedo"}, TL_GROUP_OCCLUSION | TL_GROUP_EMISSIVE, ""},
        {{"brdf=A", "tangent=albedo"}, TL_GROUP_BRDF | TL_GROUP_TANGENT, ""},
    };
    (void)state;
    char path[512];
    tl_error err;
    scratch_path(path, sizeof path, "material.exr");
    foreign_fill(&frame);
    for (int i = 0; i < FRAME_WIDTH * FRAME_HEIGHT; i++)
        frame.alpha[i] = 0.5f;
    foreign_describe(&file, &frame, EXR_PIXEL_FLOAT);
    foreign_write(&file, path);
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        foreign_notices said = {""};
        const tl_notices notices = {foreign_say, &said};
        tl_gbuffer *g = NULL;
        tl_import_options options = foreign_options();
        for (int m = 0; cases[i].maps[m]; m++)
            add_map(&options, cases[i].maps[m], "", "");
        ASSERT_OK(tl_import_read(path, &options, &notices, &g, NULL, &err), err);
        if (g->present != (TL_GROUP_BASE | cases[i].groups))
            fail_msg("case %zu: planes %x, not %x", i, g->present,
                     TL_GROUP_BASE | cases[i].groups);
        if (!strstr(said.text, cases[i].says))
            fail_msg("case %zu: \"%s\" does not say \"%s\"", i, said.text, cases[i].says);
        if (strstr(cases[i].says, "alpha^2"))
            assert_true(same_bits(tl_gbuffer_plane(g, TL_SHININESS)[5], 30.0f));
        if (cases[i].groups == 0 || cases[i].groups == TL_GROUP_PHONG)
            assert_true(same_bits(tl_gbuffer_plane(g, TL_ALBEDO_G)[5], frame.albedo[1][5]));
        tl_gbuffer_destroy(g);
    }
    remove(path);
}

/* By its name, and as whole numbers or others; a file of ours that brings its camera is mapped. */
static void indices_of_any_type_are_read(void **state)
{
    static const char *const maps[] = {"normal=N.XYZ", "brdf=brdf", "brdf=ao"};
    char path[512];
    const tl_camera camera = camera_of(4, 3, TL_PERSPECTIVE);
    tl_gbuffer *made = random_gbuffer(
        &camera, TL_GROUP_BASE | TL_GROUP_OCCLUSION | TL_GROUP_BRDF | TL_GROUP_TANGENT, 5);
    tl_error err;
    (void)state;
    scratch_path(path, sizeof path, "indices.exr");
    tl_gbuffer_plane(made, TL_BRDF)[0] = 200.0f;
    tl_gbuffer_plane(made, TL_OCCLUSION)[0] = 7.0f;
    ASSERT_OK(tl_gbuffer_write(path, made, NULL, &err), err);
    for (size_t i = 0; i < COUNT_OF(maps); i++) {
        tl_import_options options = tl_import_options_default();
        tl_gbuffer *read = NULL;
        ASSERT_OK(tl_import_map_parse(maps[i], &options.maps[options.map_count++], &err), err);
        ASSERT_OK(tl_import_read(path, &options, NULL, &read, NULL, &err), err);
        assert_int_equal(read->present, made->present);
        assert_true(same_bits(tl_gbuffer_plane(read, TL_BRDF)[0], i < 2 ? 200.0f : 7.0f));
        assert_true(same_bits(tl_gbuffer_plane(read, TL_TANGENT_X)[0],
                              tl_gbuffer_plane(made, TL_TANGENT_X)[0]));
        tl_gbuffer_destroy(read);
    }
    tl_gbuffer_destroy(made);
    remove(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pixels_arrive),
        cmocka_unit_test(planes_come_from_several_files),
        cmocka_unit_test(png_colors_are_decoded),
        cmocka_unit_test(coverage_counts),
        cmocka_unit_test(pixels_may_be_wide),
        cmocka_unit_test(materials_are_told_apart),
        cmocka_unit_test(indices_of_any_type_are_read),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
