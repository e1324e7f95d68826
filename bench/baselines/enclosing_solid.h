/* A solid of triangles that holds a sphere: what stands for a light's reach where triangles are
 * drawn. */
#ifndef TL_ENCLOSING_SOLID_H
#define TL_ENCLOSING_SOLID_H

#include <stdint.h>

enum { SOLID_CORNER_COUNT = 42, SOLID_FACE_COUNT = 80 };

/* An icosahedron with every face parted in four, its corners on a sphere and then moved out until
 * all faces are outside the unit sphere. */
typedef struct enclosing_solid {
    float corners[SOLID_CORNER_COUNT][3];
    uint32_t faces[SOLID_FACE_COUNT][3]; /* counterclockwise from outside */
} enclosing_solid;

/* Cannot fail. */
void tl_enclosing_solid(enclosing_solid *out);

#endif
