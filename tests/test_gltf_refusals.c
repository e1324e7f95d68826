#define _POSIX_C_SOURCE 200809L
/* Is a scene that is not what glTF demands refused, by the right status and with a sentence that
 * names what is wrong? Each one is a good scene with one edit. */
#include "gltf_scene.h"
#include "png_bytes.h"

#include <sys/stat.h>
#include <unistd.h>

static const struct {
    const char *name, *old, *new;
    tl_status status;
    const char *words; /* what the sentence must have */
} cases[] = {
    {"no JSON", "{\"asset\"", "{asset", TL_ERR_FORMAT, "not valid glTF"},
    {"cut JSON", "\"buffers\"", "\"buffers\":[", TL_ERR_FORMAT, "not valid glTF"},
    {"no object", "{\"asset\":{\"version\":\"2.0\"},", "[{\"asset\":{\"version\":\"2.0\"},",
     TL_ERR_FORMAT, "not valid glTF"},
    {"no version", "\"version\":\"2.0\"", "\"generator\":\"x\"", TL_ERR_FORMAT, "asset"},
    {"old version", "\"version\":\"2.0\"", "\"version\":\"1.0\"", TL_ERR_UNSUPPORTED,
     "glTF 1.0"},
    {"newer least version", "\"version\":\"2.0\"", "\"version\":\"2.1\",\"minVersion\":\"2.1\"",
     TL_ERR_UNSUPPORTED, "2.1"},
    {"a number too large", "\"znear\":0.1", "\"znear\":1e999", TL_ERR_FORMAT, "not valid glTF"},
    {"a count that is a string", "\"count\":6", "\"count\":\"6\"", TL_ERR_FORMAT, "count"},
    {"a negative count", "\"count\":6", "\"count\":-6", TL_ERR_FORMAT, "count"},
    {"an attribute that is a string", "\"NORMAL\":1", "\"NORMAL\":\"1\"", TL_ERR_FORMAT,
     "attributes"},
    {"a top-level name with a backslash", "\"buffers\"", "\"b\\u0075ffers\"", TL_ERR_FORMAT,
     "backslash"},

    {"unknown required extension", "\"scene\":0",
     "\"extensionsRequired\":[\"X_y\"],\"scene\":0", TL_ERR_UNSUPPORTED, "X_y"},
    {"Draco", "\"scene\":0",
     "\"extensionsRequired\":[\"KHR_draco_mesh_compression\"],\"scene\":0", TL_ERR_UNSUPPORTED,
     "Draco"},
    {"KTX2", "\"scene\":0", "\"extensionsRequired\":[\"KHR_texture_basisu\"],\"scene\":0",
     TL_ERR_UNSUPPORTED, "KHR_texture_basisu"},

    {"missing buffer", "\"uri\":\"data:application/octet-stream;base64,",
     "\"uri\":\"absent.bin\",\"x\":\"", TL_ERR_READ, "absent.bin"},
    {"buffer that is a folder", "\"uri\":\"data:application/octet-stream;base64,",
     "\"uri\":\"..\",\"x\":\"", TL_ERR_READ, "regular file"},
    {"buffer without a uri", "\"uri\":\"data:application/octet-stream;base64,", "\"x\":\"",
     TL_ERR_FORMAT, "uri"},
    {"buffer shorter than it says", "\"byteLength\":140", "\"byteLength\":141", TL_ERR_FORMAT,
     "Buffer"},
    {"view without a buffer", "{\"buffer\":0,\"byteOffset\":48",
     "{\"buffer\":1,\"byteOffset\":48", TL_ERR_FORMAT, "buffer 1"},
    {"view behind its buffer", "\"byteOffset\":128,\"byteLength\":12",
     "\"byteOffset\":129,\"byteLength\":12", TL_ERR_FORMAT, "buffer view 3"},
    {"view whose end wraps", "\"byteOffset\":128,\"byteLength\":12",
     "\"byteOffset\":18446744073709551612,\"byteLength\":12", TL_ERR_FORMAT, "buffer view 3"},
    {"view whose length wraps", "\"byteOffset\":128,\"byteLength\":12",
     "\"byteOffset\":128,\"byteLength\":18446744073709551612", TL_ERR_FORMAT, "buffer view 3"},
    {"stride that is no multiple of 4", "\"byteOffset\":48,\"byteLength\":48",
     "\"byteOffset\":48,\"byteLength\":48,\"byteStride\":13", TL_ERR_FORMAT, "byteStride"},
    {"stride below its elements", "\"byteOffset\":48,\"byteLength\":48",
     "\"byteOffset\":48,\"byteLength\":48,\"byteStride\":8", TL_ERR_FORMAT, "apart"},
    {"stride that leads out", "\"byteOffset\":48,\"byteLength\":48",
     "\"byteOffset\":48,\"byteLength\":48,\"byteStride\":16", TL_ERR_FORMAT, "outside"},

    {"accessor without a view", "{\"bufferView\":1", "{\"bufferView\":4", TL_ERR_FORMAT,
     "buffer view 4"},
    {"accessor with a negative view", "{\"bufferView\":1", "{\"bufferView\":-7", TL_ERR_FORMAT,
     "buffer view -7"},
    {"accessor behind its view", "\"count\":6", "\"count\":7", TL_ERR_FORMAT, "outside"},
    {"accessor whose size wraps", "\"count\":6", "\"count\":9223372036854775809", TL_ERR_FORMAT,
     "outside"},
    {"accessor whose offset wraps", "\"bufferView\":3,",
     "\"bufferView\":3,\"byteOffset\":18446744073709551615,", TL_ERR_FORMAT, "outside"},
    {"accessor without elements", "\"count\":6", "\"count\":0", TL_ERR_FORMAT, "no elements"},
    {"unknown component type", "\"componentType\":5123", "\"componentType\":5124",
     TL_ERR_FORMAT, "5124"},
    {"component type out of range", "\"componentType\":5123", "\"componentType\":6000",
     TL_ERR_FORMAT, "componentType"},
    {"unknown type", "\"SCALAR\"", "\"SCALER\"", TL_ERR_FORMAT, "SCALER"},
    {"positions of two components", "\"count\":4,\"type\":\"VEC3\"",
     "\"count\":4,\"type\":\"VEC2\"", TL_ERR_FORMAT, "POSITION"},
    {"normals as integers", "{\"bufferView\":1,\"componentType\":5126",
     "{\"bufferView\":1,\"componentType\":5121", TL_ERR_FORMAT, "NORMAL"},
    {"float indices", "{\"bufferView\":3,\"componentType\":5123,\"count\":6",
     "{\"bufferView\":3,\"componentType\":5126,\"count\":3", TL_ERR_FORMAT, "indices"},
    {"geometry beyond all memory", "{\"bufferView\":1,\"componentType\":5126,\"count\":4",
     "{\"componentType\":5126,\"count\":4611686018427387904", TL_ERR_UNSUPPORTED, "memory"},
    {"fewer normals than positions", "{\"bufferView\":1,\"componentType\":5126,\"count\":4",
     "{\"bufferView\":1,\"componentType\":5126,\"count\":3", TL_ERR_FORMAT, "4 positions"},

    {"sparse count too large", "{\"bufferView\":1,",
     "{\"sparse\":{\"count\":5,\"indices\":{\"bufferView\":3,\"componentType\":5123},"
     "\"values\":{\"bufferView\":1}},\"bufferView\":1,",
     TL_ERR_FORMAT, "sparse"},
    {"sparse index out of range", "{\"bufferView\":1,",
     "{\"sparse\":{\"count\":3,\"indices\":{\"bufferView\":0,\"componentType\":5123},"
     "\"values\":{\"bufferView\":1}},\"bufferView\":1,",
     TL_ERR_FORMAT, "sparse"},
    {"sparse values outside", "{\"bufferView\":1,",
     "{\"sparse\":{\"count\":2,\"indices\":{\"bufferView\":3,\"componentType\":5123},"
     "\"values\":{\"bufferView\":1,\"byteOffset\":40}},\"bufferView\":1,",
     TL_ERR_FORMAT, "outside"},
    {"sparse with a negative offset", "{\"bufferView\":1,",
     "{\"sparse\":{\"count\":2,\"indices\":{\"bufferView\":3,\"byteOffset\":-2,"
     "\"componentType\":5123},\"values\":{\"bufferView\":1}},\"bufferView\":1,",
     TL_ERR_FORMAT, "negative"},
    {"sparse indices of a float type", "{\"bufferView\":1,",
     "{\"sparse\":{\"count\":2,\"indices\":{\"bufferView\":3,\"componentType\":5126},"
     "\"values\":{\"bufferView\":1}},\"bufferView\":1,",
     TL_ERR_FORMAT, "5126"},

    {"primitive with an unknown accessor", "\"NORMAL\":1", "\"NORMAL\":9", TL_ERR_FORMAT,
     "accessor 9"},
    {"indices in an unknown accessor", "\"indices\":3", "\"indices\":4", TL_ERR_FORMAT,
     "primitive indices"},
    {"unknown mode", "\"indices\":3", "\"mode\":7,\"indices\":3", TL_ERR_FORMAT, "mode 7"},
    {"no whole triangles", "\"count\":6", "\"count\":5", TL_ERR_FORMAT, "whole triangles"},
    {"unknown material", "\"material\":0", "\"material\":1", TL_ERR_FORMAT, "material 1"},
    {"unknown texture", "\"metallicFactor\":0.125",
     "\"baseColorTexture\":{\"index\":0},\"metallicFactor\":0.125", TL_ERR_FORMAT, "texture 0"},
    {"a ninth set of coordinates", "\"roughnessFactor\":0.625}}],",
     "\"baseColorTexture\":{\"index\":0,\"texCoord\":8}}}],\"textures\":[{}],",
     TL_ERR_UNSUPPORTED, "TEXCOORD_8"},
    {"unknown alpha mode", "\"name\":\"paint\"", "\"alphaMode\":\"CUT\",\"name\":\"paint\"",
     TL_ERR_FORMAT, "CUT"},
    {"colour of three factors", "[0.25,0.5,0.75,1]", "[0.25,0.5,0.75]", TL_ERR_FORMAT,
     "baseColorFactor"},
    {"emission beyond float", "\"name\":\"paint\"",
     "\"emissiveFactor\":[1e300,0,0],\"name\":\"paint\"", TL_ERR_FORMAT, "paint"},

    {"unknown scene", "\"scene\":0", "\"scene\":1", TL_ERR_FORMAT, "scene 1"},
    {"scene of an unknown node", "[0,1]}]", "[0,2]}]", TL_ERR_FORMAT, "node 2"},
    {"scene that names a node twice", "[0,1]}]", "[0,1,0]}]", TL_ERR_FORMAT, "twice"},
    {"unknown child", "\"mesh\":0", "\"mesh\":0,\"children\":[5]", TL_ERR_FORMAT, "node 5"},
    {"node below itself", "\"mesh\":0", "\"mesh\":0,\"children\":[0]", TL_ERR_FORMAT,
     "ancestors"},
    {"two nodes below each other", "\"mesh\":0},",
     "\"mesh\":0},{\"children\":[2]},{\"children\":[1]},", TL_ERR_FORMAT, "ancestors"},
    {"two parents", "\"mesh\":0},", "\"mesh\":0,\"children\":[3]},{\"children\":[3]},{},",
     TL_ERR_FORMAT, "node 3 is a child of both"},
    {"root that is a child", "\"mesh\":0", "\"mesh\":0,\"children\":[1]", TL_ERR_FORMAT,
     "root"},
    {"unknown mesh", "\"mesh\":0", "\"mesh\":1", TL_ERR_FORMAT, "mesh 1"},
    {"unknown camera", "\"camera\":0", "\"camera\":1", TL_ERR_FORMAT, "camera 1"},
    {"translation of two", "[0,0,4]", "[0,0]", TL_ERR_FORMAT, "eye"},
    {"transform beyond double", "\"mesh\":0",
     "\"mesh\":0,\"scale\":[1e308,1e308,1e308],\"rotation\":[0.5,0.5,0.5,0.5],\"children\":[2]}"
     ","
     "{\"name\":\"x\",\"camera\":0},{\"scale\":[1e308,1,1]",
     TL_ERR_FORMAT, "finite"},
    {"rotation of length 0", "\"mesh\":0", "\"mesh\":0,\"rotation\":[0,0,0,0]", TL_ERR_FORMAT,
     "rotation"},
    {"matrix that is projective", "\"mesh\":0",
     "\"mesh\":0,\"matrix\":[1,0,0,0.5,0,1,0,0,0,0,1,0,0,0,0,1]", TL_ERR_FORMAT, "matrix"},

    {"camera that sees nothing", "\"yfov\":1.0", "\"yfov\":0", TL_ERR_FORMAT, "yfov"},
    {"camera without a near plane", "\"znear\":0.1", "\"znear\":0", TL_ERR_FORMAT, "wide"},
    {"camera with far before near", "\"zfar\":100", "\"zfar\":0.01", TL_ERR_FORMAT, "wide"},
    {"camera of no kind", "\"type\":\"perspective\"", "\"type\":\"fisheye\"", TL_ERR_FORMAT,
     "fisheye"},
};

static void refuses_with_the_word(void **state)
{
    const tl_capture_options options = {.width = 8, .height = 8};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        char *const text = edited(square_scene(&square), cases[i].old, cases[i].new);
        shot taken;
        const tl_status status = shoot_text("refused", text, &options, &taken);
        if (status != cases[i].status || taken.err.status != status)
            fail_msg("%s: status %d, want %d: %s", cases[i].name, (int)status,
                     (int)cases[i].status, taken.err.message);
        if (status != TL_OK && (!strstr(taken.err.message, cases[i].words) ||
                                !strstr(taken.err.message, "refused.gltf")))
            fail_msg("%s: says \"%s\", where \"%s\" and the file were to be named",
                     cases[i].name, taken.err.message, cases[i].words);
        if (strchr(taken.err.message, '\n'))
            fail_msg("%s: more than a sentence: %s", cases[i].name, taken.err.message);
        shot_clear(&taken);
        free(text);
    }
}

/* Values that JSON cannot hold come in buffers. */
static void refuses_data(void **state)
{
    static const struct {
        const char *name, *words;
        float position, normal;
        uint16_t index;
    } bad[] = {
        {"NaN in a position", "accessor 0", NAN, 0, 2},
        {"infinity in a position", "accessor 0", INFINITY, 0, 2},
        {"NaN in a normal", "accessor 1", 1, NAN, 2},
        {"index out of range", "index 2 is vertex 4", 1, 0, 4},
        {"largest index", "index 2 is vertex 65535", 1, 0, 65535},
    };
    const tl_capture_options options = {.width = 8, .height = 8};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        square_data data = square;
        shot taken;
        data.positions[2][1] = bad[i].position;
        data.normals[2][1] = bad[i].normal;
        data.indices[2] = bad[i].index;
        char *const text = square_scene(&data);
        if (shoot_text("refused", text, &options, &taken) != TL_ERR_FORMAT ||
            !strstr(taken.err.message, bad[i].words))
            fail_msg("%s: says \"%s\"", bad[i].name, taken.err.message);
        shot_clear(&taken);
        free(text);
    }
}

static void refuses_images(void **state)
{
    static const uint8_t grey[4] = {128, 128, 128, 255};
    png_bytes good = png_encode(grey, 1, 1);
    uint8_t wide[64], damaged[128];
    assert_in_range(good.size, 50, sizeof damaged);
    memcpy(wide, good.data, 33);
    memcpy(wide + 16, "\0\0\x40\x01", 4); /* 16385 pixels wide: read before the checksum is */
    memcpy(damaged, good.data, good.size);
    damaged[45] ^= 0x55; /* in the stored pixels */
    damaged[43] ^= 0x55;
    const struct {
        const char *name, *words;
        const void *data;
        size_t size;
        tl_status status;
    } bad[] = {
        {"KTX2", "KTX2", "\xabKTX 20\xbb\r\n\x1a\n", 12, TL_ERR_UNSUPPORTED},
        {"WebP", "WebP", "RIFF\x04\0\0\0WEBPVP8 ", 16, TL_ERR_UNSUPPORTED},
        {"text", "neither PNG nor JPEG", "hello", 5, TL_ERR_FORMAT},
        {"too wide", "16384", wide, 33, TL_ERR_FORMAT},
        {"cut off", "damaged", good.data, 44, TL_ERR_FORMAT},
        {"damaged", "damaged", damaged, good.size, TL_ERR_FORMAT},
    };
    const tl_capture_options options = {.width = 8, .height = 8};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        char *const bytes = base64(bad[i].data, bad[i].size);
        char image[512];
        shot taken;
        snprintf(image, sizeof image,
                 "\"textures\":[{\"source\":0}],\"images\":[{\"name\":\"the picture\","
                 "\"uri\":\"data:image/png;base64,%s\"}],\n\"materials\"",
                 bytes);
        char *text = edited(square_scene(&square), "\"materials\"", image);
        text = edited(text, "\"metallicFactor\"",
                      "\"baseColorTexture\":{\"index\":0},\"metallicFactor\"");
        const tl_status status = shoot_text("refused", text, &options, &taken);
        if (status != bad[i].status || !strstr(taken.err.message, bad[i].words) ||
            !strstr(taken.err.message, "the picture"))
            fail_msg("%s: status %d, \"%s\"", bad[i].name, (int)status, taken.err.message);
        shot_clear(&taken);
        free(bytes);
        free(text);
    }
    free(good.data);
}

/* Parsers recurse; a megabyte of brackets must not reach one. */
static void refuses_depth(void **state)
{
    enum { DEPTH = 1000000 };
    const tl_capture_options options = {.width = 8, .height = 8};
    char *const brackets = malloc(DEPTH + 32);
    shot taken;
    (void)state;
    assert_non_null(brackets);
    const int start = sprintf(brackets, "\"extras\":");
    memset(brackets + start, '[', DEPTH);
    strcpy(brackets + start + DEPTH, ",\"scene\"");
    char *const text = edited(square_scene(&square), "\"scene\"", brackets);
    assert_int_equal(shoot_text("refused", text, &options, &taken), TL_ERR_FORMAT);
    assert_non_null(strstr(taken.err.message, "nested"));
    free(brackets);
    free(text);
}

static void refuses_what_is_no_file(void **state)
{
    const tl_capture_options good = {.width = 8, .height = 8},
                             wide = {.width = TL_MAX_EXTENT + 1, .height = 8};
    const tl_capture_options lopsided = {.width = 0, .height = 8},
                             other = {.width = 8, .height = 8, .camera = "no such camera"};
    char path[512], *text = square_scene(&square);
    shot taken;
    (void)state;
    scratch_path(path, sizeof path, "absent.gltf");
    assert_int_equal(shoot(path, &good, &taken), TL_ERR_READ);
    scratch_path(path, sizeof path, "");
    assert_int_equal(shoot(path, &good, &taken), TL_ERR_READ);
    scratch_path(path, sizeof path, "pipe.gltf"); /* opening one must not wait for a writer */
    unlink(path);
    assert_int_equal(mkfifo(path, 0600), 0);
    assert_int_equal(shoot(path, &good, &taken), TL_ERR_READ);
    unlink(path);
    scratch_path(path, sizeof path, "empty.gltf");
    write_file(path, "", 0);
    assert_int_equal(shoot(path, &good, &taken), TL_ERR_READ);
    assert_int_equal(shoot_text("sizes", text, &wide, &taken), TL_ERR_ARGUMENT);
    assert_int_equal(shoot_text("sizes", text, &lopsided, &taken), TL_ERR_ARGUMENT);
    assert_int_equal(shoot_text("sizes", text, &other, &taken), TL_ERR_ARGUMENT);
    assert_non_null(strstr(taken.err.message, "wide")); /* which there are */
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(refuses_with_the_word),   cmocka_unit_test(refuses_data),
        cmocka_unit_test(refuses_images),          cmocka_unit_test(refuses_depth),
        cmocka_unit_test(refuses_what_is_no_file),
    };
    if (!can_capture())
        return TL_SKIPPED;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
