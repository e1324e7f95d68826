/* The colours in which numbers are shown as pictures. */
#ifndef TL_RAMP_H
#define TL_RAMP_H

#include <stdint.h>

/* at in [0, 1]: lightness rises evenly, so that it reads without colour too, and the hue goes from
 * blue by way of purple and red to yellow. Within Rec. 709, so that nothing is cut. code: sRGB. */
void tl_ramp(double at, uint8_t code[3]);

#endif
