/* Captures of the ISPC project's deferred example, made here byte by byte as its README says: nothing is
 * shared with the reader. */
#ifndef TL_ISPC_CAPTURES_H
#define TL_ISPC_CAPTURES_H

#include "file_cases.h"

enum { ISPC_HEADER = 152, ISPC_PLANES = 16, ISPC_LIGHTS = 40 };
enum { ISPC_MOST = ISPC_HEADER + 64 * 64 * 15 + ISPC_LIGHTS * 32 + 1024 }; /* bytes */

typedef struct ispc_pixel {
    float z;
    uint16_t normal[2], amount, power; /* halves */
    uint8_t albedo[3];
} ispc_pixel;

typedef struct ispc_light {
    float position[3], begin, color[3], end; /* view space, +z forward */
} ispc_light;

typedef struct ispc_capture {
    float proj[4][4], near, far;
    int32_t width, height, light_count;
    ispc_pixel pixels[64 * 64];
    ispc_light lights[ISPC_LIGHTS];
} ispc_capture;

/* A finite half in [0, 65504]: nearest, ties away from 0. */
static inline uint16_t half_bits(double value)
{
    int exponent = 0;
    if (value < 0x1p-14)
        return (uint16_t)floor(value * 0x1p24 + 0.5);
    const double mantissa = frexp(value, &exponent); /* [1/2, 1) */
    const double rounded = floor(mantissa * 0x1p11 + 0.5);
    return (uint16_t)((exponent + 14) * 1024 + (int)rounded - 1024);
}

static inline double half_value(uint16_t bits)
{
    const int exponent = bits >> 10;
    return exponent == 0 ? (bits & 1023) * 0x1p-24 : ldexp((bits & 1023) + 1024, exponent - 25);
}

/* D3D's matrix for these planes; with `reversed` the near plane is at z = 1. */
static inline void ispc_project(ispc_capture *c, double near, double far, int reversed)
{
    const double at0 = reversed ? far : near, at1 = reversed ? near : far;
    memset(c->proj, 0, sizeof c->proj);
    c->proj[0][0] = 1.4f;
    c->proj[1][1] = 1.9f;
    c->proj[2][2] = (float)(at1 / (at1 - at0));
    c->proj[2][3] = 1.0f;
    c->proj[3][2] = (float)(-at0 * at1 / (at1 - at0));
    c->near = (float)near;
    c->far = (float)far;
}

static inline double ispc_uniform(uint32_t *random, double low, double high)
{
    return low + (high - low) * (double)(next_random(random) >> 8) * 0x1p-24;
}

/* Random surfaces 3 to 12 m away, of normals within 60 degrees of the view axis, with lights between. */
static inline ispc_capture ispc_example(int32_t width, int32_t height, int reversed)
{
    static ispc_capture c;
    uint32_t random = 20080616;
    c = (ispc_capture){.width = width, .height = height, .light_count = ISPC_LIGHTS};
    ispc_project(&c, 0.5, 100.0, reversed);
    for (int i = 0; i < width * height; i++) {
        ispc_pixel *p = &c.pixels[i];
        const double depth = ispc_uniform(&random, 3.0, 12.0);
        p->z = (float)((double)c.proj[2][2] + (double)c.proj[3][2] / depth);
        p->normal[0] = half_bits(ispc_uniform(&random, 0.3, 0.7));
        p->normal[1] = half_bits(ispc_uniform(&random, 0.3, 0.7));
        p->amount = half_bits(ispc_uniform(&random, 0.0, 1.0));
        p->power = half_bits(ispc_uniform(&random, 1.0, 200.0));
        for (int k = 0; k < 3; k++)
            p->albedo[k] = (uint8_t)(next_random(&random) >> 24);
    }
    for (int i = 0; i < ISPC_LIGHTS; i++) {
        ispc_light *l = &c.lights[i];
        l->position[0] = (float)ispc_uniform(&random, -6.0, 6.0);
        l->position[1] = (float)ispc_uniform(&random, -4.0, 4.0);
        l->position[2] = (float)ispc_uniform(&random, 2.0, 10.0);
        l->end = (float)ispc_uniform(&random, 1.0, 6.0);
        l->begin = l->end * (float)ispc_uniform(&random, 0.1, 0.9);
        for (int k = 0; k < 3; k++)
            l->color[k] = (float)ispc_uniform(&random, 0.0, 1.0);
    }
    return c;
}

static inline size_t ispc_put_pixels(const ispc_capture *c, int plane, unsigned char *to)
{
    static const size_t sizes[] = {4, 2, 2, 2, 2, 1, 1, 1};
    const size_t count = (size_t)c->width * (size_t)c->height;
    for (size_t i = 0; i < count; i++) {
        const ispc_pixel *p = &c->pixels[i];
        const void *const from[] = {&p->z,     &p->normal[0], &p->normal[1], &p->amount,
                                    &p->power, &p->albedo[0], &p->albedo[1], &p->albedo[2]};
        memcpy(to + i * sizes[plane], from[plane], sizes[plane]);
    }
    return count * sizes[plane];
}

static inline size_t ispc_put_lights(const ispc_capture *c, int plane, unsigned char *to)
{
    for (size_t i = 0; i < (size_t)c->light_count; i++) {
        const ispc_light *l = &c->lights[i];
        const float values[] = {l->position[0], l->position[1], l->position[2], l->begin,
                                l->color[0],    l->color[1],    l->color[2],    l->end};
        memcpy(to + 4 * i, &values[plane - 8], 4);
    }
    return 4 * (size_t)c->light_count;
}

/* The file: planes in an order of their own, with odd gaps between, so that nothing is aligned. bytes:
 * [ISPC_MOST]. Returns its size. */
static inline size_t ispc_bytes(const ispc_capture *c, unsigned char *bytes)
{
    static const int order[ISPC_PLANES] = {7,  15, 2, 0, 11, 4, 9,  1,
                                           14, 5,  3, 8, 13, 6, 10, 12};
    int32_t offsets[ISPC_PLANES];
    size_t at = ISPC_HEADER;
    for (int i = 0; i < ISPC_PLANES; i++) {
        const int p = order[i];
        memset(bytes + at, 0xa5, 3);
        at += (size_t)(i % 3) + 1;
        offsets[p] = (int32_t)(at - ISPC_HEADER);
        at += p < 8 ? ispc_put_pixels(c, p, bytes + at) : ispc_put_lights(c, p, bytes + at);
    }
    const int32_t counts[] = {c->width, c->height, c->light_count, (int32_t)(at - ISPC_HEADER)};
    memcpy(bytes, c->proj, 64);
    memcpy(bytes + 64, &c->near, 4);
    memcpy(bytes + 68, &c->far, 4);
    memcpy(bytes + 72, counts, 16);
    memcpy(bytes + 88, offsets, 64);
    return at;
}

#endif
