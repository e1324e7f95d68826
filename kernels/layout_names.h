/* The layouts of a pixel, by name; layout.h has what each is. */
#ifndef TL_LAYOUT_NAMES_H
#define TL_LAYOUT_NAMES_H

/* X(name, row, word on the command line) */
#define TL_LAYOUTS(X)                                                       \
    X(TL_LAYOUT_FLOAT, ROW_FLOAT, "float")                                  \
    X(TL_LAYOUT_FLOAT_FORWARD, ROW_FLOAT_FORWARD, "float-forward")          \
    X(TL_LAYOUT_FLOAT_NDC, ROW_FLOAT_NDC, "float-ndc")                      \
    X(TL_LAYOUT_FLOAT_REVERSED, ROW_FLOAT_REVERSED, "float-reversed")       \
    X(TL_LAYOUT_FLOAT_FRACTION, ROW_FLOAT_FRACTION, "float-fraction")       \
    X(TL_LAYOUT_FLOAT_POSITION, ROW_FLOAT_POSITION, "float-position")       \
    X(TL_LAYOUT_SHADERX2_128, ROW_SHADERX2_128, "shaderx2-128")             \
    X(TL_LAYOUT_SHADERX2_128_S10, ROW_SHADERX2_128_S10, "shaderx2-128-s10") \
    X(TL_LAYOUT_SHADERX2_128_U8, ROW_SHADERX2_128_U8, "shaderx2-128-u8")    \
    X(TL_LAYOUT_SHADERX2_128_S8, ROW_SHADERX2_128_S8, "shaderx2-128-s8")    \
    X(TL_LAYOUT_SHADERX2_160, ROW_SHADERX2_160, "shaderx2-160")             \
    X(TL_LAYOUT_SHADERX2_96, ROW_SHADERX2_96, "shaderx2-96")                \
    X(TL_LAYOUT_TUTORIAL, ROW_TUTORIAL, "tutorial")                         \
    X(TL_LAYOUT_TUTORIAL_U24, ROW_TUTORIAL_U24, "tutorial-u24")             \
    X(TL_LAYOUT_TUTORIAL_3X8, ROW_TUTORIAL_3X8, "tutorial-3x8")             \
    X(TL_LAYOUT_MERLIN, ROW_MERLIN, "merlin")                               \
    X(TL_LAYOUT_MERLIN_POSITION, ROW_MERLIN_POSITION, "merlin-position")    \
    X(TL_LAYOUT_DXR, ROW_DXR, "dxr")                                        \
    X(TL_LAYOUT_ISPC, ROW_ISPC, "ispc")                                     \
    X(TL_LAYOUT_COMPACT_16, ROW_COMPACT_16, "compact-16")                   \
    X(TL_LAYOUT_COMPACT_12, ROW_COMPACT_12, "compact-12")                   \
    X(TL_LAYOUT_ISPC_REVERSED, ROW_ISPC_REVERSED, "ispc-reversed")

#define TL_LAYOUT_NAME(name, row, word) name,
enum tl_layout_name { TL_LAYOUTS(TL_LAYOUT_NAME) TL_LAYOUT_COUNT };
#undef TL_LAYOUT_NAME

#endif
