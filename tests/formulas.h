/* Formulas of kernels/, for tests: each compiled in float, as kernels have it, and in double with the
 * library's powers, as the reference has it. Numbers go in and out as double, which holds floats as they are.
 * Kernels give the bits of the former: tests/test_same_bits.c. */
#ifndef TL_FORMULAS_H
#define TL_FORMULAS_H

#include <stdint.h>

/* A surface in view space, in floats, as a pixel's planes give it. */
typedef struct formula_surface {
    float position[3]; /* m */
    float normal[3];   /* of any length */
    float exponent, alpha2, across2, k;
    float f0;       /* the specular colour, grey */
    float along[3]; /* of any length */
} formula_surface;

typedef struct formula_reflection {
    double diffuse, specular, grazing;
} formula_reflection;

/* What a light at a distance is: numbers of tl_view_light. */
typedef struct formula_falloff {
    uint32_t row; /* of kernels/falloff.h */
    float fade, offset;
    const float *table; /* [last + 1] */
    uint32_t last;
} formula_falloff;

/* A cone: numbers of tl_view_spot. */
typedef struct formula_cone {
    float axis[3], least_cos, least_cos2, scale;
} formula_cone;

/* A picture as frames hold it, of grey. */
typedef struct formula_map {
    int is_projected;
    float right[3], up[3], ahead[3];
    uint32_t width, height;
    const float *texels; /* [1 + height * width][4], the first row of no meaning */
} formula_map;

typedef struct formula_sky {
    float up[3], horizon, zenith, ground;
} formula_sky;

typedef struct formulas {
    const char *name;
    double u; /* half an ulp of 1 */

    void (*unit)(const float v[3], double out[3]);
    double (*specular_power)(const double normal[3], const double half[3], double exponent);
    /* Of a light of weight 1 at `light`, by a model: a row of kernels/models.h. */
    formula_reflection (*reflection)(uint32_t model,
                                     const formula_surface *s,
                                     const float light[3]);
    /* At a distance, m; inverse square: at the square of it. */
    double (*fade)(const formula_falloff *f, double at);
    /* Of the way l to the light. *is_in: whether it is in the cone at all. */
    double (*cone_share)(const formula_cone *cone, const double l[3], int *is_in);

    /* Of what is stored, by rows of kernels/depth_code.h. */
    double (*depth)(uint32_t code, int orthographic, float slope, float offset, double stored);
    void (*position)(const float rays[4],
                     int orthographic,
                     double column,
                     double row,
                     double depth,
                     double out[3]);

    /* By rows of kernels/number.h and normal_code.h. */
    double (*number)(uint32_t number, uint32_t word, uint32_t shift, uint32_t bits);
    void (*octahedron)(const double e[2], double out[3]);
    void (*spheremap)(const double e[2], double out[3]);
    double (*exponent)(double stored); /* of a logarithm */
    void (*shared)(uint32_t word, double out[3]);

    double (*longitude)(double y, double x); /* turns */
    /* What a picture shows in a direction: kernels/texture.h. */
    double (*shown)(const formula_map *map, const float direction[3]);
    /* Of a sky that is a gradient: kernels/sky.h. */
    double (*gradient)(const formula_sky *sky, const float ray[3]);
} formulas;

extern const formulas tl_formulas_float, tl_formulas_double;

#endif
