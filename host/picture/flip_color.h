/* The colours of FLIP: Andersson et al. 2020, sections 4.1.1 and 4.1.2. D65 everywhere; matrices
 * are those of Rec. 709 with the authors' integers, so that figures agree with theirs. */
#ifndef TL_FLIP_COLOR_H
#define TL_FLIP_COLOR_H

#include <math.h>

typedef struct flip_color {
    float of[3];
} flip_color;

static inline float flip_clamp(float v)
{
    return v > 0.0f ? (v < 1.0f ? v : 1.0f) : 0.0f; /* NaN is 0 */
}

static const float flip_white[3] = {0.950428545f, 1.0f, 1.088900371f}; /* XYZ of D65 */

/* Linear Rec. 709 to XYZ over the white point. */
static inline flip_color flip_white_xyz(flip_color rgb)
{
    static const float m[3][3] = {
        {(float)(10135552 / 24577794.0), (float)(8788810 / 24577794.0),
         (float)(4435075 / 24577794.0)},
        {(float)(2613072 / 12288897.0), (float)(8788810 / 12288897.0),
         (float)(887015 / 12288897.0)},
        {(float)(1425312 / 73733382.0), (float)(8788810 / 73733382.0),
         (float)(70074185 / 73733382.0)},
    };
    flip_color xyz;
    for (int i = 0; i < 3; i++)
        xyz.of[i] =
            (m[i][0] * rgb.of[0] + m[i][1] * rgb.of[1] + m[i][2] * rgb.of[2]) / flip_white[i];
    return xyz;
}

/* And back: the inverse of the two. */
static inline flip_color flip_rgb_of_white_xyz(flip_color xyz)
{
    static const float m[3][3] = {
        {3.241003275f, -1.537398934f, -0.498615861f},
        {-0.969224334f, 1.875930071f, 0.041554224f},
        {0.055639423f, -0.204011202f, 1.057148933f},
    };
    flip_color rgb;
    for (int i = 0; i < 3; i++)
        rgb.of[i] = m[i][0] * flip_white[0] * xyz.of[0] + m[i][1] * flip_white[1] * xyz.of[1] +
                    m[i][2] * flip_white[2] * xyz.of[2];
    return rgb;
}

/* YCxCz: linear in XYZ, so that it may be filtered. */
static inline flip_color flip_opponent(flip_color rgb)
{
    const flip_color w = flip_white_xyz(rgb);
    const flip_color out = {
        {116.0f * w.of[1] - 16.0f, 500.0f * (w.of[0] - w.of[1]), 200.0f * (w.of[1] - w.of[2])}};
    return out;
}

static inline flip_color flip_rgb_of_opponent(flip_color c)
{
    const float y = (c.of[0] + 16.0f) / 116.0f;
    const flip_color w = {{y + c.of[1] / 500.0f, y, y - c.of[2] / 200.0f}};
    return flip_rgb_of_white_xyz(w);
}

/* L*a*b*, its two colours dimmed with the lightness: Hunt's effect. */
static inline flip_color flip_hunt_lab(flip_color rgb)
{
    const flip_color w = flip_white_xyz(rgb);
    float f[3];
    for (int i = 0; i < 3; i++)
        f[i] = w.of[i] > 216.0f / 24389.0f ? cbrtf(w.of[i])
                                           : w.of[i] * (841.0f / 108.0f) + 4.0f / 29.0f;
    const float lightness = 116.0f * f[1] - 16.0f, dimmed = 0.01f * lightness;
    const flip_color out = {
        {lightness, dimmed * 500.0f * (f[0] - f[1]), dimmed * 200.0f * (f[1] - f[2])}};
    return out;
}

/* HyAB: Abasi et al. 2020. */
static inline float flip_hyab(flip_color a, flip_color b)
{
    const float da = a.of[1] - b.of[1], db = a.of[2] - b.of[2];
    return fabsf(a.of[0] - b.of[0]) + sqrtf(da * da + db * db);
}

#endif
