#include "ramp.h"

#include "srgb.h"

/* Value in [0, 1] to a code: IEC 61966-2-1. */
static uint8_t srgb_code(double linear)
{
    const double v = tl_srgb_from_linear(linear);
    const double cut = v < 0.0 ? 0.0 : v > 1.0 ? 1.0 : v;
    return (uint8_t)lrint(255.0 * cut);
}

/* Oklab to linear Rec. 709: B. Ottosson, "A perceptual color space for image processing" (2020). */
static void code_of_oklab(double lightness, double a, double b, uint8_t code[3])
{
    const double l = pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3.0);
    const double m = pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3.0);
    const double s = pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3.0);
    code[0] = srgb_code(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s);
    code[1] = srgb_code(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s);
    code[2] = srgb_code(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s);
}

void tl_ramp(double at, uint8_t code[3])
{
    const double hue = (280.0 + 185.0 * at) * (3.14159265358979323846 / 180.0);
    const double chroma = 0.15;
    code_of_oklab(0.38 + 0.52 * at, chroma * cos(hue), chroma * sin(hue), code);
}
