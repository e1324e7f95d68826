/* A scene of others, seen from a place of our own: its .gltf with a camera more, in a folder of its own that
 * links to the files beside the scene. */
#ifndef TL_ASSET_VIEW_H
#define TL_ASSET_VIEW_H

typedef struct asset_view {
    double eye[3];       /* m, world space */
    double rotation[4];  /* a unit quaternion x, y, z, w: the camera looks along -z of it */
    double vertical_fov; /* rad */
} asset_view;

/* The path of the new .gltf, in a new folder of the temporary ones, with the view as its first camera; the
 * caller hands it to asset_view_remove. Asserts that all went well. */
char *asset_view_make(const char *scene, const asset_view *view);

/* Removes the folder, and frees the path. Accepts NULL. */
void asset_view_remove(char *path);

#endif
