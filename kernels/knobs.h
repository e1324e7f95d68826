/* What accuracy can be given away for time, and the other way round: knobs that change the picture. One table
 * a knob; its first row is what tilelight does unless told otherwise. A row joins by its line here and the
 * branch of the kernels that it stands for; a knob by a table and a line of TL_KNOBS. Flags of the build, the
 * command's options and words, reports, the axes of the bench and the tests loop over them.
 *
 * X(name, word, traits, off, meaning, source)
 *
 *   traits  bits of tl_knob_trait
 *   off     TL_OFF(log2, exp2, cosine, root, quotient): how far what a row stands for may be off beside what
 *           float is allowed anyway (host/reference/allowance.c). log2 as a share of itself; exp2 as a share
 *           of the power of two above; the square of the specular cosine, 1/sqrt and 1/x as shares of
 *           themselves
 *
 * What they apply to: `power`, `cosine` and the quotient of `root` to cos^e of the models phong,
 * blinn-phong-normalized and phong-reflection; the root of `root` to 1/d of every light with a range and
 * without a shape; `arithmetic` to all of that and to falloffs, cones and sums. What decides whether a light
 * adds anything (reach.h, in_cone, n.l > 0) is the same under all of them, and so culling is exact. Read by
 * the public headers too: constants alone. */
#ifndef TL_KNOBS_H
#define TL_KNOBS_H

enum tl_knob_trait {
    /* On every device, in every width and in C: what the twin computes. */
    TL_KNOB_SAME_BITS = 1,
    TL_KNOB_DOUBLE = 2, /* there in double too */
    TL_KNOB_BOUNDED = 4 /* `off` holds; else nobody says */
};
#define TL_KNOB_OURS (TL_KNOB_SAME_BITS | TL_KNOB_DOUBLE | TL_KNOB_BOUNDED)

/* log2 and exp2 of the specular power. degree-N: m P(m) of power.h has degree N, 1 + r Q(r) the one that is
 * nearest to it in error. The errors are those of P and Q (tests/tools/fit_powers.py). */
#define TL_POWERS(X)                                                                        \
    X(TL_POWER_POLYNOMIAL, "polynomial", TL_KNOB_OURS, TL_OFF(0, 0, 0, 0, 0),               \
      "degrees 8 and 5, as exact as float", "tests/tools/fit_powers.py")                    \
    X(TL_POWER_LIBRARY, "library", TL_KNOB_DOUBLE | TL_KNOB_BOUNDED, TL_OFF(0, 0, 0, 0, 0), \
      "log2, log1p and exp2 of the device, and its atan2 in textures",                      \
      "OpenCL 1.2, section 7.4: 3 ulp")                                                     \
    X(TL_POWER_DEGREE_6, "degree-6", TL_KNOB_OURS, TL_OFF(1.1e-5, 8.0e-6, 0, 0, 0),         \
      "degrees 6 and 4: off by 1.2e-5 of the peak", "tests/tools/fit_powers.py")            \
    X(TL_POWER_DEGREE_5, "degree-5", TL_KNOB_OURS, TL_OFF(7.4e-5, 8.0e-6, 0, 0, 0),         \
      "degrees 5 and 4: 3.1e-5", "tests/tools/fit_powers.py")                               \
    X(TL_POWER_DEGREE_4, "degree-4", TL_KNOB_OURS, TL_OFF(5.2e-4, 2.3e-4, 0, 0, 0),         \
      "degrees 4 and 3: 4.0e-4", "tests/tools/fit_powers.py")                               \
    X(TL_POWER_DEGREE_3, "degree-3", TL_KNOB_OURS, TL_OFF(3.8e-3, 2.3e-4, 0, 0, 0),         \
      "degrees 3 and 3: 1.5e-3", "tests/tools/fit_powers.py")                               \
    X(TL_POWER_DEGREE_2, "degree-2", TL_KNOB_OURS, TL_OFF(2.9e-2, 5.5e-3, 0, 0, 0),         \
      "degrees 2 and 2: 1.5e-2", "tests/tools/fit_powers.py")                               \
    X(TL_POWER_POWR, "powr", TL_KNOB_DOUBLE | TL_KNOB_BOUNDED, TL_OFF(0, 0, 0x1p-24, 0, 0), \
      "powr of the device, of the square of the cosine", "OpenCL 1.2, section 7.4: 16 ulp") \
    X(TL_POWER_NATIVE, "native", 0, TL_OFF(0, 0, 0, 0, 0),                                  \
      "native_log2 and native_exp2 of the device, which nobody bounds",                     \
      "OpenCL 1.2, section 6.12.2")

/* What the specular power is taken of: specular.h. */
#define TL_COSINE_FORMS(X)                                                               \
    X(TL_FORM_STABLE, "stable", TL_KNOB_OURS, TL_OFF(0, 0, 0, 0, 0),                     \
      "by its sine near the peak: the error is that of the angle", "kernels/specular.h") \
    X(TL_FORM_TEXTBOOK, "textbook", TL_KNOB_OURS, TL_OFF(0, 0, 0, 0, 0),                 \
      "pow(n.h, e): what n.h is off by counts e times, 6e-3 of the peak at 10000",       \
      "Blinn 1977")

/* 1/sqrt and 1/x: root.h. newton-N: a guess from the bits of the number, and N steps of Newton. */
#define TL_ROOTS(X)                                                                    \
    X(TL_ROOT_EXACT, "exact", TL_KNOB_OURS, TL_OFF(0, 0, 0, 0, 0),                     \
      "roots and quotients as IEEE 754 rounds them", "IEEE 754")                       \
    X(TL_ROOT_RSQRT, "rsqrt", TL_KNOB_DOUBLE | TL_KNOB_BOUNDED, TL_OFF(0, 0, 0, 0, 0), \
      "rsqrt of the device", "OpenCL 1.2, section 7.4: 2 ulp")                         \
    X(TL_ROOT_NATIVE, "native", 0, TL_OFF(0, 0, 0, 0, 0),                              \
      "native_rsqrt and native_recip of the device, which nobody bounds",              \
      "OpenCL 1.2, section 6.12.2")                                                    \
    X(TL_ROOT_NEWTON_2, "newton-2", TL_KNOB_SAME_BITS | TL_KNOB_BOUNDED,               \
      TL_OFF(0, 0, 0, 4.8e-6, 6.7e-6), "off by 4.8e-6 and 6.7e-6 of themselves",       \
      "Lomont 2003")                                                                   \
    X(TL_ROOT_NEWTON_1, "newton-1", TL_KNOB_SAME_BITS | TL_KNOB_BOUNDED,               \
      TL_OFF(0, 0, 0, 1.8e-3, 2.6e-3), "1.8e-3 and 2.6e-3", "Lomont 2003")             \
    X(TL_ROOT_NEWTON_0, "newton-0", TL_KNOB_SAME_BITS | TL_KNOB_BOUNDED,               \
      TL_OFF(0, 0, 0, 3.5e-2, 5.1e-2), "3.5e-2 and 5.1e-2", "Lomont 2003")

/* What the compiler may make of the formulas: dialect.h. */
#define TL_ARITHMETIC_KINDS(X)                                                    \
    X(TL_ARITHMETIC_STRICT, "strict", TL_KNOB_OURS, TL_OFF(0, 0, 0, 0, 0),        \
      "each operation as written", "IEEE 754")                                    \
    X(TL_ARITHMETIC_CONTRACT, "contract", TL_KNOB_DOUBLE | TL_KNOB_BOUNDED,       \
      TL_OFF(0, 0, 0, 0, 0), "a * b + c may round once, as under -cl-mad-enable", \
      "OpenCL 1.2, section 6.12.14")                                              \
    X(TL_ARITHMETIC_RELAXED, "relaxed", TL_KNOB_DOUBLE, TL_OFF(0, 0, 0, 0, 0),    \
      "in any order, quotients by estimates, nothing infinite, as under "         \
      "-cl-fast-relaxed-math",                                                    \
      "OpenCL 1.2, section 5.6.4.3")

/* X(name, -D flag, word: of the option, of reports, of the axis of the bench; its first row's word, the
 * table, kind and kinds of a row, meaning) */
#define TL_KNOBS(X)                                                                           \
    X(TL_KNOB_POWER, TL_POWER, "power", "polynomial", TL_POWERS, "power", "powers",           \
      "How the power of highlights is computed")                                              \
    X(TL_KNOB_FORM, TL_FORM, "specular", "stable", TL_COSINE_FORMS, "form", "forms",          \
      "What that is a power of")                                                              \
    X(TL_KNOB_ROOT, TL_ROOT, "root", "exact", TL_ROOTS, "kind of root", "kinds",              \
      "How 1/d of lights and 1/|h|^2 of highlights are computed")                             \
    X(TL_KNOB_ARITHMETIC, TL_ARITHMETIC, "math", "strict", TL_ARITHMETIC_KINDS, "arithmetic", \
      "kinds", "What the compiler may make of what a light adds")

/* Whether a knob, which is a constant of a build, has one of these rows, bits 1 << row. */
#define TL_IS_ONE_OF(knob, these) ((1u << (knob) & (these)) != 0)

#define TL_KNOB_NAME(name, flag, word, usual, rows, kind, kinds, meaning) name,
enum tl_knob_name { TL_KNOBS(TL_KNOB_NAME) TL_KNOB_COUNT };
#undef TL_KNOB_NAME

#define TL_KNOB_ROW_NAME(name, word, traits, off, meaning, source) name,
enum tl_power { TL_POWERS(TL_KNOB_ROW_NAME) TL_POWER_COUNT };
enum tl_form { TL_COSINE_FORMS(TL_KNOB_ROW_NAME) TL_FORM_COUNT };
enum tl_root { TL_ROOTS(TL_KNOB_ROW_NAME) TL_ROOT_COUNT };
enum tl_arithmetic_kind { TL_ARITHMETIC_KINDS(TL_KNOB_ROW_NAME) TL_ARITHMETIC_KIND_COUNT };
#undef TL_KNOB_ROW_NAME

#endif
