/* Text of files on its way to a terminal, which it must not steer. */
#ifndef TL_PRINTABLE_H
#define TL_PRINTABLE_H

#ifdef __cplusplus
extern "C" {
#endif

/* '?' for a control character of ASCII; UTF-8 passes. */
static inline char tl_printable(char c)
{
    return (unsigned char)c < 0x20 || c == 0x7f ? '?' : c;
}

#ifdef __cplusplus
}
#endif

#endif
