/* What the index of a pixel leads to: a row of the table of materials (tl_brdf), lane by lane. Where a
 * frame's indices select nothing their plane is idle (needs.h), and nothing of this is compiled. */
#ifndef TL_BRDF_ROW_H
#define TL_BRDF_ROW_H

#include "position.h"
#include "substance.h"

/* A row for each index, 0 to 255; that of 0 has the frame's model and gives nothing. */
typedef TL_GLOBAL const tl_brdf *tl_brdf_rows;

TL_INLINE tl_brdf_rows rows_behind(const tl_frame *frame, TL_GLOBAL const tl_view_light *lights)
{
    return (tl_brdf_rows)((tl_numbers)lights + (size_t)frame->brdfs_at * (TL_SECTION_ROW / 4));
}

/* A row as lanes have it. What no model in use takes is not there. */
typedef struct brdf_lanes {
    integer model, given;
    vec3 diffuse, specular, direction;
    real exponent, roughness, across, k;
} brdf_lanes;

/* Whether a row may give this to a model of the scene. */
TL_INLINE int some_model_takes(tl_needs needs, enum tl_brdf_parameter parameter)
{
#define TL_MODEL_TAKES(name, word, traits, parameters, source)          \
    if ((needs.models >> name & 1u) && ((parameters) & (int)parameter)) \
        return 1;
    TL_MODELS(TL_MODEL_TAKES)
#undef TL_MODEL_TAKES
    return 0;
}

#define ROW_NUMBER(member, i) ((scalar)rows[i].member)
#define ROW_WHOLE(member, i) (rows[i].member)
#define LANES_OF_NUMBER(member) ((real)(EACH_LANE(ROW_NUMBER, member, index)))
#define LANES_OF_WHOLE(member) ((integer)(EACH_LANE(ROW_WHOLE, member, index)))

TL_INLINE brdf_lanes gathered_rows(tl_needs needs, tl_brdf_rows rows, integer index)
{
    const vec3 none = {R(0.0), R(0.0), R(0.0)};
    brdf_lanes r = {LANES_OF_WHOLE(model),
                    LANES_OF_WHOLE(given),
                    none,
                    none,
                    none,
                    R(0.0),
                    R(1.0),
                    R(1.0),
                    R(1.0)};
    if (some_model_takes(needs, TL_TAKES_DIFFUSE)) {
        r.diffuse.x = LANES_OF_NUMBER(diffuse[0]);
        r.diffuse.y = LANES_OF_NUMBER(diffuse[1]);
        r.diffuse.z = LANES_OF_NUMBER(diffuse[2]);
    }
    if (some_model_takes(needs, TL_TAKES_SPECULAR)) {
        r.specular.x = LANES_OF_NUMBER(specular[0]);
        r.specular.y = LANES_OF_NUMBER(specular[1]);
        r.specular.z = LANES_OF_NUMBER(specular[2]);
    }
    if (some_model_takes(needs, TL_TAKES_EXPONENT))
        r.exponent = LANES_OF_NUMBER(exponent);
    if (some_model_takes(needs, TL_TAKES_ROUGHNESS))
        r.roughness = LANES_OF_NUMBER(roughness);
    if (some_model_takes(needs, TL_TAKES_ACROSS))
        r.across = LANES_OF_NUMBER(across);
    if (some_model_takes(needs, TL_TAKES_DIRECTION)) {
        r.direction.x = LANES_OF_NUMBER(direction[0]);
        r.direction.y = LANES_OF_NUMBER(direction[1]);
        r.direction.z = LANES_OF_NUMBER(direction[2]);
    }
    if (some_model_takes(needs, TL_TAKES_K))
        r.k = LANES_OF_NUMBER(k);
    return r;
}

TL_INLINE vec3 in_all_lanes(float x, float y, float z)
{
    const vec3 v = {(real)(scalar)x, (real)(scalar)y, (real)(scalar)z};
    return v;
}

/* The same of one row in all lanes, as most blocks have it: a load a number. */
TL_INLINE brdf_lanes common_row(tl_brdf_rows rows, tl_u32 index)
{
    const tl_brdf row = rows[index];
    const brdf_lanes r = {(integer)row.model,
                          (integer)row.given,
                          in_all_lanes(row.diffuse[0], row.diffuse[1], row.diffuse[2]),
                          in_all_lanes(row.specular[0], row.specular[1], row.specular[2]),
                          in_all_lanes(row.direction[0], row.direction[1], row.direction[2]),
                          (real)(scalar)row.exponent,
                          (real)(scalar)row.roughness,
                          (real)(scalar)row.across,
                          (real)(scalar)row.k};
    return r;
}

TL_INLINE mask is_given(brdf_lanes row, enum tl_brdf_parameter parameter)
{
    return (row.given & (integer)parameter) != (integer)0;
}

/* How wide lobes are, by what the row says of roughness: across its direction as along it, and Minnaert's
 * exponent from it, unless they are given too. */
TL_INLINE substance with_width(substance m, brdf_lanes row)
{
    const mask is_rough = is_given(row, TL_TAKES_ROUGHNESS);
    const mask has_across = is_given(row, TL_TAKES_ACROSS);
    m.alpha2 = pick(is_rough, alpha2_of_roughness(row.roughness), m.alpha2);
    m.across2 =
        pick(has_across, alpha2_of_roughness(row.across), pick(is_rough, m.alpha2, m.across2));
    m.k = pick(is_given(row, TL_TAKES_K), row.k, pick(is_rough, k_of_alpha2(m.alpha2), m.k));
    return m;
}

TL_INLINE substance with_row(const tl_frame *frame, tl_needs needs, substance m, brdf_lanes row)
{
    const mask has_specular = is_given(row, TL_TAKES_SPECULAR);
    m.model = row.model;
    m.diffuse = pick3(is_given(row, TL_TAKES_DIFFUSE), row.diffuse, m.diffuse);
    m.specular = pick3(has_specular, row.specular, m.specular);
    m.below = pick(has_specular, below_specular(row.specular), m.below);
    m.shininess = pick(is_given(row, TL_TAKES_EXPONENT), row.exponent, m.shininess);
    m = with_width(m, row);
    if (some_model_takes(needs, TL_TAKES_DIRECTION))
        m.along = pick3(is_given(row, TL_TAKES_DIRECTION), view_direction(frame, row.direction),
                        m.along);
    return m;
}

/* The tangent of the pixel itself, where it has one, before any direction that is said of its material. */
TL_INLINE substance with_tangent(const tl_frame *frame, tl_needs needs, substance m, pixel of)
{
    if (!reads_planes(needs, TL_GROUP_TANGENT))
        return m;
    const vec3 t = of.tangent;
    const mask has_tangent = dot3(t, t) > R(0.0);
    m.along = pick3(has_tangent, view_direction(frame, t), m.along);
    return m;
}

/* What a pixel's surface is made of, its row's parameters in place of its own. rows: of no matter where no
 * index selects anything. */
TL_INLINE substance substance_at(const tl_frame *frame,
                                 tl_needs needs,
                                 pixel of,
                                 tl_brdf_rows rows)
{
    substance m = substance_of(frame, needs, of);
    if (reads_planes(needs, TL_GROUP_BRDF)) {
        const integer index = TO_INTEGER(of.brdf) & (integer)TL_MAX_MATERIALS;
        if (any_lane(index != (integer)FIRST_LANE(index)))
            m = with_row(frame, needs, m, gathered_rows(needs, rows, index));
        else
            m = with_row(frame, needs, m, common_row(rows, (tl_u32)FIRST_LANE(index)));
    }
    return with_tangent(frame, needs, m, of);
}

#endif
