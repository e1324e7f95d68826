/* What is in a glTF scene, and what `capture' and `render' can choose of it. */
#include "info_scene.h"

#include "info.h"
#include "json_values.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>

static const struct {
    const char *word, *key;
} traits[] = {
#define TRAIT(name, word, key) [name] = {word, key},
    TL_MATERIAL_TRAITS(TRAIT)
#undef TRAIT
};

static const char *const fate_words[] = {
#define FATE_WORD(name, word) [name] = word,
    TL_EXTENSION_FATES(FATE_WORD)
#undef FATE_WORD
};

static double degrees(double radians)
{
    return radians * 57.29577951308232;
}

/* --- text -------------------------------------------------------------------------------------- */

/* A name of the file in quotes; nothing for none. */
static void print_name(const char *before, const char *name)
{
    if (!name[0])
        return;
    printf("%s\"", before);
    info_print_text(name, 0);
    putchar('"');
}

/* "1 image", "2 images", for words whose plural has an s. */
static void print_count(const char *before, uint64_t count, const char *noun)
{
    printf("%s%" PRIu64 " %s%s", before, count, noun, count == 1 ? "" : "s");
}

static void print_scene(const tl_scene_info *of)
{
    if (of->scene_count == 0)
        fputs("scene       none is named: all nodes are shown", stdout);
    else
        printf("scene       %zu", of->scene_index);
    print_name(" ", of->scene_name);
    if (of->scene_count > 1)
        printf(", the default one of %zu", of->scene_count);
    putchar('\n');
    if (of->has_bounds)
        printf("bounds      (%.6g, %.6g, %.6g) to (%.6g, %.6g, %.6g) m, at rest\n", of->low[0],
               of->low[1], of->low[2], of->high[0], of->high[1], of->high[2]);
    else
        puts("bounds      none: nothing is drawn");
}

static void print_meshes(const tl_scene_meshes *m)
{
    printf("meshes      %zu of %zu are shown", m->shown_count, m->count);
    print_count(": ", m->primitive_count, "primitive");
    print_count(", ", m->triangle_count, "triangle");
    printf(", %" PRIu64 " %s\n", m->vertex_count, m->vertex_count == 1 ? "vertex" : "vertices");
    print_count("drawn       at ", m->place_count, "place");
    print_count(": ", m->drawn_triangle_count, "triangle");
    putchar('\n');
    if (m->instance_count > 0) {
        print_count("instances   ", m->instance_count, "place");
        print_count(", of ", m->instanced_node_count, "node");
        putchar('\n');
    }
    if (m->target_count > 0) {
        print_count("morphing    ", m->target_count, "target");
        printf(", of %zu %s\n", m->morphed_count, m->morphed_count == 1 ? "mesh" : "meshes");
    }
    if (m->skin_count > 0) {
        print_count("skins       ", m->skin_count, "skin");
        print_count(", ", m->joint_count, "joint");
        putchar('\n');
    }
}

static void print_materials(const tl_scene_materials *m)
{
    const char *before = ": ";
    printf("materials   %zu of %zu are shown%s", m->shown_count, m->count,
           m->shows_default ? ", and glTF's default one" : "");
    for (int i = 0; i < TL_MATERIAL_TRAIT_COUNT; i++)
        if (m->trait_counts[i] > 0) {
            printf("%s%zu %s", before, m->trait_counts[i], traits[i].word);
            before = ", ";
        }
    putchar('\n');
}

static void print_images(const tl_scene_images *i)
{
    if (i->count == 0) {
        puts("images      none");
        return;
    }
    printf("images      %zu of %zu are shown", i->shown_count, i->count);
    if (i->shown_count > 0)
        printf(": %" PRIu64 " pixels, the largest has %u x %u", i->pixel_count,
               i->largest_width, i->largest_height);
    putchar('\n');
}

static void print_camera(const tl_scene_camera *c, bool is_default)
{
    printf("camera %-4zu", c->index);
    print_name(" ", c->name);
    printf("%snode %zu", c->name[0] ? ", at " : " at ", c->node);
    print_name(" ", c->node_name);
    if (c->projection == TL_PERSPECTIVE)
        printf(": perspective, %.6g degrees high", degrees(c->extent));
    else
        printf(": orthographic, %.6g m high", c->extent);
    printf(", near %.6g m, far %.6g m%s\n", c->near, c->far, is_default ? " (default)" : "");
    if (c->refusal)
        printf("            cannot be used: %s\n", c->refusal);
}

static void print_cameras(const tl_scene_info *of)
{
    for (size_t i = 0; i < of->camera_count; i++)
        print_camera(&of->cameras[i], i == 0);
    if (of->camera_count == 0)
        puts("camera      none in the scene: a view of all of it is used");
    if (of->unplaced_camera_count > 0) {
        print_count("            ", of->unplaced_camera_count, "camera");
        puts(" of the file at no node of the scene");
    }
}

static void print_animations(const tl_scene_info *of)
{
    for (size_t i = 0; i < of->animation_count; i++) {
        const tl_scene_animation *const a = &of->animations[i];
        printf("animation %zu", i);
        print_name(" ", a->name);
        if (a->refusal)
            printf(": cannot be used: %s", a->refusal);
        else
            printf(": %.6g s", a->seconds);
        if (!a->refusal)
            print_count(", ", a->curve_count, "curve");
        putchar('\n');
    }
}

static void print_extension(const tl_scene_extension *e)
{
    fputs("extension   ", stdout);
    info_print_text(e->name, 0);
    printf("%s, %s: %s\n", e->is_required ? ", required" : "", fate_words[e->fate], e->effect);
}

void info_print_scene(const tl_scene_info *of)
{
    print_scene(of);
    print_meshes(&of->meshes);
    print_materials(&of->materials);
    print_images(&of->images);
    print_cameras(of);
    print_animations(of);
    for (size_t i = 0; i < of->variant_count; i++) {
        printf("variant %zu  ", i);
        print_name(" ", of->variants[i]);
        putchar('\n');
    }
    if (of->lights.count > 0)
        info_print_lights(&of->lights);
    else
        puts("lights      none: the scene is lit by a rig, or by a lights file");
    for (size_t i = 0; i < of->extension_count; i++)
        print_extension(&of->extensions[i]);
}

/* --- JSON -------------------------------------------------------------------------------------- */

static json_t *optional(const char *text)
{
    return text ? json_string(text) : json_null();
}

static json_t *corner(const double at[3])
{
    return json_pack("[fff]", at[0], at[1], at[2]);
}

static json_t *scene_json(const tl_scene_info *of)
{
    if (of->scene_count == 0)
        return json_null();
    return json_pack("{sI ss sI}", "index", (json_int_t)of->scene_index, "name", of->scene_name,
                     "count", (json_int_t)of->scene_count);
}

static json_t *meshes_json(const tl_scene_meshes *m)
{
    return json_pack(
        "{sI sI sI sI sI sI sI s{sI sI} s{sI sI} s{sI sI}}", "count", (json_int_t)m->count,
        "shown", (json_int_t)m->shown_count, "primitives", (json_int_t)m->primitive_count,
        "triangles", (json_int_t)m->triangle_count, "vertices", (json_int_t)m->vertex_count,
        "places", (json_int_t)m->place_count, "drawn_triangles",
        (json_int_t)m->drawn_triangle_count, "instances", "nodes",
        (json_int_t)m->instanced_node_count, "places", (json_int_t)m->instance_count,
        "morphing", "meshes", (json_int_t)m->morphed_count, "targets",
        (json_int_t)m->target_count, "skinning", "skins", (json_int_t)m->skin_count, "joints",
        (json_int_t)m->joint_count);
}

static json_t *materials_json(const tl_scene_materials *m)
{
    json_t *out = json_pack("{sI sI sb}", "count", (json_int_t)m->count, "shown",
                            (json_int_t)m->shown_count, "default", (int)m->shows_default);
    for (int i = 0; i < TL_MATERIAL_TRAIT_COUNT; i++)
        json_object_set_new(out, traits[i].key, json_integer((json_int_t)m->trait_counts[i]));
    return out;
}

static json_t *images_json(const tl_scene_images *i)
{
    return json_pack("{sI sI sI s[ii]}", "count", (json_int_t)i->count, "shown",
                     (json_int_t)i->shown_count, "pixels", (json_int_t)i->pixel_count,
                     "largest", (int)i->largest_width, (int)i->largest_height);
}

/* An infinite far plane is null, as JSON has no infinity. */
static json_t *camera_json(const tl_scene_camera *c, bool is_default)
{
    const bool is_perspective = c->projection == TL_PERSPECTIVE;
    return json_pack("{sI ss sI ss ss so so so so sb so}", "index", (json_int_t)c->index,
                     "name", c->name, "node", (json_int_t)c->node, "node_name", c->node_name,
                     "projection", is_perspective ? "perspective" : "orthographic",
                     "degrees_high",
                     is_perspective ? tl_json_number(degrees(c->extent)) : json_null(),
                     "metres_high", is_perspective ? json_null() : tl_json_number(c->extent),
                     "near", tl_json_number(c->near), "far", tl_json_number(c->far), "default",
                     (int)is_default, "refusal", optional(c->refusal));
}

static json_t *animation_json(const tl_scene_animation *a, size_t index)
{
    return json_pack("{sI ss so sI so}", "index", (json_int_t)index, "name", a->name, "seconds",
                     a->refusal ? json_null() : json_real(a->seconds), "curves",
                     (json_int_t)a->curve_count, "refusal", optional(a->refusal));
}

static json_t *extension_json(const tl_scene_extension *e)
{
    return json_pack("{ss sb ss ss}", "name", e->name, "required", (int)e->is_required,
                     "becomes", fate_words[e->fate], "effect", e->effect);
}

json_t *info_scene_json(const tl_scene_info *of)
{
    json_t *cameras = json_array(), *animations = json_array(), *variants = json_array(),
           *extensions = json_array();
    for (size_t i = 0; i < of->camera_count; i++)
        json_array_append_new(cameras, camera_json(&of->cameras[i], i == 0));
    for (size_t i = 0; i < of->animation_count; i++)
        json_array_append_new(animations, animation_json(&of->animations[i], i));
    for (size_t i = 0; i < of->variant_count; i++)
        json_array_append_new(
            variants, json_pack("{sI ss}", "index", (json_int_t)i, "name", of->variants[i]));
    for (size_t i = 0; i < of->extension_count; i++)
        json_array_append_new(extensions, extension_json(&of->extensions[i]));
    return json_pack(
        "{ss so so so so so so sI so so so so}", "kind", "scene", "scene", scene_json(of),
        "bounds",
        of->has_bounds ? json_pack("{so so}", "min", corner(of->low), "max", corner(of->high))
                       : json_null(),
        "meshes", meshes_json(&of->meshes), "materials", materials_json(&of->materials),
        "images", images_json(&of->images), "cameras", cameras, "unplaced_cameras",
        (json_int_t)of->unplaced_camera_count, "animations", animations, "variants", variants,
        "lights", info_lights_json(&of->lights), "extensions", extensions);
}
