// How many operations does a position take? The text of the formulas runs on numbers that count what is done
// to them, and comes to what the table of claims says.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>

enum { ADDED, MULTIPLIED, FUSED, DIVIDED, OPERATIONS };
static int done[OPERATIONS];

struct counted {
    double value;
    counted() = default;
    counted(double of) : value(of)
    {
    }
    counted(float of) : value(static_cast<double>(of))
    {
    }
};

static counted note(int operation, double value)
{
    done[operation]++;
    return counted(value);
}

static counted operator+(counted a, counted b)
{
    return note(ADDED, a.value + b.value);
}
static counted operator-(counted a, counted b)
{
    return note(ADDED, a.value - b.value);
}
static counted operator*(counted a, counted b)
{
    return note(MULTIPLIED, a.value * b.value);
}
static counted operator/(counted a, counted b)
{
    return note(DIVIDED, a.value / b.value);
}
static counted operator-(counted a)
{
    return counted(-a.value);
}
static bool operator>(counted a, counted b)
{
    return a.value > b.value;
}

static counted fused(counted a, counted b, counted c)
{
    return note(FUSED, std::fma(a.value, b.value, c.value));
}

static counted root(counted a)
{
    return counted(std::sqrt(a.value));
}

// In place of kernels/dialect.h, as far as these headers need it.
#define TL_DIALECT_H
#define TL_INLINE static inline
#define TL_STRUCT(name) struct name
#define TL_STATIC_ASSERT(condition, name) static_assert(condition, #name)
#define R(x) counted(x)
#define FMA(a, b, c) fused(a, b, c)
#define SQRT(x) root(x)
#define pick(which, a, b) ((which) ? (real)(a) : (real)(b))
typedef std::uint32_t tl_u32;
typedef counted real;
typedef float scalar;
typedef int mask;
#include "depth_code.h"
#include "position.h"

extern "C" {
#include "claims.h"
}

namespace
{

const struct {
    const char *stored;
    tl_u32 code;
} codes[] = {{"forward", TL_DEPTH_FORWARD},
             {"ndc", TL_DEPTH_NDC},
             {"reversed", TL_DEPTH_REVERSED},
             {"metres", TL_DEPTH_METRES}};

// The words of the first that differs, if any does.
bool is_as_said(const tl_position_operations &said, const char *what, const int *expected)
{
    static const char *const words[OPERATIONS] = {"additions", "multiplications", "multiply-adds",
                                                  "divisions"};
    bool same = true;
    for (int i = 0; i < OPERATIONS; i++) {
        if (done[i] == expected[i])
            continue;
        std::printf("%s stored %s: %d %s, not %d\n", what, said.stored, done[i], words[i],
                    expected[i]);
        same = false;
    }
    return same;
}

bool holds(const tl_position_operations &said)
{
    tl_frame frame = {};
    const tl_needs needs = {};
    frame.rays.dx = frame.rays.dy = frame.rays.x0 = frame.rays.y0 = 1.0f;
    frame.depth_slope = frame.depth_offset = 1.0f;
    for (const auto &row : codes) {
        if (std::strcmp(row.stored, said.stored) != 0)
            continue;
        std::memset(done, 0, sizeof done);
        real number = real(0.5);
        if (TL_IS_NEARNESS(row.code))
            number = nearness_of(row.code, number);
        const real depth = depth_of(&frame, needs, row.code, number);
        bool same = is_as_said(said, "depth", said.of_depth);
        const vec3 p = view_position(frame.rays, needs, real(3.0), real(4.0), depth);
        same = is_as_said(said, "position", said.of_position) && same;
        return same && p.z.value < 0.0;
    }
    std::printf("%s: no such way to store depth\n", said.stored);
    return false;
}

} // namespace

int main()
{
    bool all = true;
    for (const tl_position_operations &said : tl_position_operations_of)
        all = holds(said) && all;
    return all ? 0 : 1;
}
