#define _GNU_SOURCE
#include "asset_view.h"

#include "testing.h"

#include <dirent.h>
#include <jansson.h>
#include <libgen.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

/* The array of this name, made where there is none. */
static json_t *array_in(json_t *of, const char *name)
{
    if (!json_is_array(json_object_get(of, name)))
        assert_int_equal(json_object_set_new(of, name, json_array()), 0);
    return json_object_get(of, name);
}

/* As a node of the first scene. */
static void add_camera(json_t *root, const asset_view *view)
{
    json_t *const cameras = array_in(root, "cameras"), *const nodes = array_in(root, "nodes");
    json_t *const scene = json_array_get(json_object_get(root, "scenes"), 0);
    json_t *const camera = json_pack("{s:s, s:{s:f, s:f}}", "type", "perspective",
                                     "perspective", "yfov", view->vertical_fov, "znear", 0.05);
    json_t *const node =
        json_pack("{s:i, s:[fff], s:[ffff]}", "camera", (int)json_array_size(cameras),
                  "translation", view->eye[0], view->eye[1], view->eye[2], "rotation",
                  view->rotation[0], view->rotation[1], view->rotation[2], view->rotation[3]);
    const json_int_t index = (json_int_t)json_array_size(nodes);
    assert_int_equal(json_array_append_new(cameras, camera), 0);
    assert_int_equal(json_array_append_new(nodes, node), 0);
    assert_int_equal(json_array_append_new(array_in(scene, "nodes"), json_integer(index)), 0);
}

static void link_files(const char *from, const char *to)
{
    DIR *const folder = opendir(from);
    assert_non_null(folder);
    for (const struct dirent *entry = readdir(folder); entry; entry = readdir(folder)) {
        char target[PATH_MAX], place[PATH_MAX];
        if (entry->d_name[0] == '.')
            continue;
        snprintf(target, sizeof target, "%s/%s", from, entry->d_name);
        snprintf(place, sizeof place, "%s/%s", to, entry->d_name);
        assert_int_equal(symlink(target, place), 0);
    }
    closedir(folder);
}

char *asset_view_make(const char *scene, const asset_view *view)
{
    char whole[PATH_MAX], folder[PATH_MAX], made[] = "/tmp/asset-view-XXXXXX", *path = NULL;
    json_error_t where;
    assert_non_null(realpath(scene, whole));
    json_t *const root = json_load_file(whole, 0, &where);
    assert_non_null(root);
    add_camera(root, view);
    snprintf(folder, sizeof folder, "%s", whole);
    assert_non_null(mkdtemp(made));
    link_files(dirname(folder), made);
    assert_true(asprintf(&path, "%s/seen-from-within.gltf", made) > 0);
    assert_int_equal(json_dump_file(root, path, 0), 0);
    json_decref(root);
    return path;
}

void asset_view_remove(char *path)
{
    char *command = NULL;
    if (!path)
        return;
    assert_true(asprintf(&command, "rm -r \"%s\"", dirname(path)) > 0);
    assert_int_equal(system(command), 0);
    free(command);
    free(path);
}
