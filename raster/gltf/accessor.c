#include "accessor.h"

#include "lookup.h"
#include "try.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- component types -------------------------------------------------------------------------- */

#define READER(name, type)                          \
    static double read_##name(const uint8_t *bytes) \
    {                                               \
        type value;                                 \
        memcpy(&value, bytes, sizeof value);        \
        return (double)value;                       \
    }
READER(int8, int8_t)
READER(uint8, uint8_t)
READER(int16, int16_t)
READER(uint16, uint16_t)
READER(uint32, uint32_t)
READER(float, float)
#undef READER

enum { INT8 = 1, UINT8 = 2, INT16 = 4, UINT16 = 8, UINT32 = 16, FLOAT32 = 32 };

/* glTF 2.0, section 3.6.2.2; doubles and signed 32-bit integers are not among them. */
static const struct component {
    int type;
    unsigned bit;
    size_t size;
    double (*read)(const uint8_t *);
    double largest; /* what a normalised 1 is stored as; section 3.6.2.3 */
} components[] = {
    {5120, INT8, 1, read_int8, 127.0},     {5121, UINT8, 1, read_uint8, 255.0},
    {5122, INT16, 2, read_int16, 32767.0}, {5123, UINT16, 2, read_uint16, 65535.0},
    {5125, UINT32, 4, read_uint32, 0.0},   {5126, FLOAT32, 4, read_float, 0.0},
};

static const struct component *component_of(int type)
{
    for (size_t i = 0; i < sizeof components / sizeof components[0]; i++)
        if (components[i].type == type)
            return &components[i];
    return NULL;
}

/* --- uses -------------------------------------------------------------------------------------- */

static const struct {
    const char *name;
    int least, most; /* components */
} uses[TL_USE_COUNT] = {
#define USE(name, word, least, most) [name] = {word, least, most},
    TL_GLTF_ATTRIBUTES(USE) TL_ACCESSOR_USES(USE)
#undef USE
};

enum { SIGNED = INT8 | INT16, UNSIGNED = UINT8 | UINT16, SMALL = SIGNED | UNSIGNED };

/* How each may be stored, as it is and as parts of 1: glTF 2.0, sections 3.7.2.1 (attributes), 3.7.2.2
 * (morph targets), 3.7.3 (skins) and 3.11 (animations); KHR_mesh_quantization, which adds the integers
 * that are not normalised and the signed ones; and EXT_mesh_gpu_instancing. */
static const struct {
    unsigned plain, normalized;
} stored_as[TL_USE_COUNT] = {[TL_GLTF_POSITION] = {FLOAT32 | SMALL, SMALL},
                             [TL_GLTF_NORMAL] = {FLOAT32, SIGNED},
                             [TL_GLTF_TANGENT] = {FLOAT32, SIGNED},
                             [TL_GLTF_COLOR] = {FLOAT32, UNSIGNED},
                             [TL_USE_MORPH_POSITION] = {FLOAT32 | SIGNED, SIGNED},
                             [TL_USE_MORPH_NORMAL] = {FLOAT32, SIGNED},
                             [TL_USE_MORPH_TANGENT] = {FLOAT32, SIGNED},
                             [TL_USE_JOINTS] = {UNSIGNED, 0},
                             [TL_USE_WEIGHTS] = {FLOAT32, UNSIGNED},
                             [TL_USE_INVERSE_BIND] = {FLOAT32, 0},
                             [TL_USE_KEY_TIMES] = {FLOAT32, 0},
                             [TL_USE_KEY_VECTORS] = {FLOAT32, 0},
                             [TL_USE_KEY_ROTATIONS] = {FLOAT32, SMALL},
                             [TL_USE_KEY_WEIGHTS] = {FLOAT32, SMALL},
                             [TL_USE_INSTANCE_TRANSLATION] = {FLOAT32, 0},
                             [TL_USE_INSTANCE_ROTATION] = {FLOAT32, SIGNED},
                             [TL_USE_INSTANCE_SCALE] = {FLOAT32, 0},
#define TEXCOORD(name, attribute, least, most) [name] = {FLOAT32 | SMALL, SMALL},
                             TL_GLTF_TEXCOORDS(TEXCOORD)
#undef TEXCOORD
};

int tl_accessor_width(int use)
{
    return uses[use].most;
}

/* --- places in buffers ------------------------------------------------------------------------ */

tl_status tl_budget_take(tl_budget *budget,
                         const tl_gltf *gltf,
                         const char *user,
                         size_t count,
                         size_t size,
                         void **out,
                         tl_error *err)
{
    if (count > budget->left / size)
        return tl_fail(err, TL_ERR_UNSUPPORTED,
                       "%s: %s: the scene's geometry comes to more memory than it may take",
                       gltf->path, user);
    budget->left -= count * size;
    *out = calloc(count ? count : 1, size);
    if (!*out)
        return tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for %s", gltf->path, user);
    return TL_OK;
}

/* `count` elements of `size` bytes, `stride` apart, all inside a view. */
typedef struct elements {
    const uint8_t *first; /* NULL: all zero */
    size_t stride;
} elements;

static tl_status find_elements(const tl_gltf *gltf,
                               const char *user,
                               int view,
                               size_t offset,
                               size_t count,
                               size_t size,
                               elements *out,
                               tl_error *err)
{
    tl_gltf_bytes bytes;
    const tl_status status = tl_gltf_view_bytes(gltf, user, view, &bytes, err);
    if (status != TL_OK)
        return status;
    const size_t stride = gltf->views[view].stride ? gltf->views[view].stride : size;
    if (stride < size)
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: %s: elements of %zu bytes are %zu bytes apart in buffer view %d",
                       gltf->path, user, size, stride, view);
    if (offset > bytes.size || bytes.size - offset < size ||
        (bytes.size - offset - size) / stride < count - 1)
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: %s reaches outside buffer view %d: %zu elements of %zu bytes, %zu "
                       "apart, from %zu on, of %zu",
                       gltf->path, user, view, count, size, stride, offset, bytes.size);
    *out = (elements){bytes.data + offset, stride};
    return TL_OK;
}

/* What is known of an accessor once it has been checked. */
typedef struct opened {
    const tl_gltf_accessor *from;
    const struct component *component;
    tl_label label; /* "mesh 2, primitive 0: accessor 5", cut to fit */
    elements dense;
} opened;

static tl_status open_accessor(
    const tl_gltf *gltf, const char *user, int accessor, opened *out, tl_error *err)
{
    tl_status status =
        tl_gltf_check_index(gltf, user, "accessor", accessor, gltf->accessor_count, err);
    if (status != TL_OK)
        return status;
    const tl_gltf_accessor *const from = &gltf->accessors[accessor];
    opened made = {.from = from, .component = component_of(from->component_type)};
    made.label = tl_label_of("accessor", (size_t)accessor, "");
    if (!made.component)
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: %s: accessor %d has the component type %d, which no accessor has",
                       gltf->path, user, accessor, from->component_type);
    if (from->count == 0)
        return tl_fail(err, TL_ERR_FORMAT, "%s: %s: accessor %d has no elements", gltf->path,
                       user, accessor);
    if (from->view != -1)
        status = find_elements(gltf, made.label.text, from->view, from->offset, from->count,
                               made.component->size * (size_t)from->component_count,
                               &made.dense, err);
    if (status == TL_OK)
        *out = made;
    return status;
}

/* --- sparse accessors ------------------------------------------------------------------------- */

/* Where the changed elements lie, and which they are. */
typedef struct changes {
    size_t count;
    elements indices, values;
    const struct component *index_component;
} changes;

static tl_status open_changes(const tl_gltf *gltf, const opened *a, changes *out, tl_error *err)
{
    const tl_gltf_accessor *const from = a->from;
    changes made = {.count = (size_t)from->sparse_count,
                    .index_component = component_of(from->sparse_index_type)};
    tl_status status = TL_OK;

    if (from->sparse_count < 1 || (size_t)from->sparse_count > from->count)
        return tl_fail(err, TL_ERR_FORMAT, "%s: sparse %s changes %d of its %zu elements",
                       gltf->path, a->label.text, from->sparse_count, from->count);
    if (from->sparse_index_offset < 0 || from->sparse_value_offset < 0)
        return tl_fail(err, TL_ERR_FORMAT, "%s: sparse %s has a negative byte offset",
                       gltf->path, a->label.text);
    if (!made.index_component || !(made.index_component->bit & (UINT8 | UINT16 | UINT32)))
        return tl_fail(err, TL_ERR_FORMAT, "%s: sparse %s has indices of the component type %d",
                       gltf->path, a->label.text, from->sparse_index_type);
    TRY(find_elements(gltf, a->label.text, from->sparse_index_view,
                      (size_t)from->sparse_index_offset, made.count, made.index_component->size,
                      &made.indices, err));
    TRY(find_elements(gltf, a->label.text, from->sparse_value_view,
                      (size_t)from->sparse_value_offset, made.count,
                      a->component->size * (size_t)from->component_count, &made.values, err));
    *out = made;
done:
    return status;
}

/* Calls `convert` for every element in turn, with the changed ones last, so that they win. */
static tl_status for_each_element(
    const tl_gltf *gltf,
    const opened *a,
    tl_status (*convert)(void *context, size_t i, const uint8_t *bytes, tl_error *err),
    void *context,
    tl_error *err)
{
    tl_status status = TL_OK;
    changes sparse = {0};
    if (a->dense.first)
        for (size_t i = 0; i < a->from->count; i++)
            TRY(convert(context, i, a->dense.first + i * a->dense.stride, err));
    if (!a->from->sparse)
        goto done;
    TRY(open_changes(gltf, a, &sparse, err));
    for (size_t k = 0; k < sparse.count; k++) {
        const size_t i = (size_t)sparse.index_component->read(sparse.indices.first +
                                                              k * sparse.indices.stride);
        if (i >= a->from->count) {
            status = tl_fail(err, TL_ERR_FORMAT, "%s: sparse %s changes element %zu of %zu",
                             gltf->path, a->label.text, i, a->from->count);
            goto done;
        }
        TRY(convert(context, i, sparse.values.first + k * sparse.values.stride, err));
    }
done:
    return status;
}

/* --- conversion ------------------------------------------------------------------------------- */

typedef struct float_target {
    const tl_gltf *gltf;
    const opened *accessor;
    int width;
    float *out; /* [count][width] */
} float_target;

static tl_status convert_floats(void *context, size_t i, const uint8_t *bytes, tl_error *err)
{
    const float_target *const to = context;
    const struct component *const component = to->accessor->component;
    const int count = to->accessor->from->component_count;
    float *const element = to->out + i * (size_t)to->width;
    for (int c = 0; c < count; c++) {
        double value = component->read(bytes + (size_t)c * component->size);
        if (to->accessor->from->normalized && component->largest > 0.0)
            value = fmax(value / component->largest, -1.0);
        if (!isfinite(value))
            return tl_fail(err, TL_ERR_FORMAT, "%s: %s: element %zu is not finite",
                           to->gltf->path, to->accessor->label.text, i);
        element[c] = (float)value;
    }
    return TL_OK;
}

tl_status tl_accessor_read(const tl_gltf *gltf,
                           const char *user,
                           int accessor,
                           int use,
                           tl_budget *budget,
                           float **out,
                           size_t *count,
                           tl_error *err)
{
    const int width = uses[use].most;
    tl_status status = TL_OK;
    opened a;
    void *data = NULL;

    TRY(open_accessor(gltf, user, accessor, &a, err));
    const unsigned types = a.from->normalized && a.component->bit != FLOAT32
                               ? stored_as[use].normalized
                               : stored_as[use].plain;
    if (!(types & a.component->bit) || a.from->component_count < uses[use].least ||
        a.from->component_count > width) {
        status = tl_fail(err, TL_ERR_FORMAT,
                         "%s: %s: %s cannot be accessor %d with %d components of type %d%s",
                         gltf->path, user, uses[use].name, accessor, a.from->component_count,
                         a.from->component_type, a.from->normalized ? ", normalised" : "");
        goto done;
    }
    TRY(tl_budget_take(budget, gltf, user, a.from->count, (size_t)width * sizeof(float), &data,
                       err));
    float_target to = {gltf, &a, width, data};
    if (a.from->component_count < width) /* a colour without alpha is opaque */
        for (size_t i = 0; i < a.from->count; i++)
            to.out[i * (size_t)width + (size_t)width - 1] = 1.0f;
    TRY(for_each_element(gltf, &a, convert_floats, &to, err));

    *count = a.from->count;
    *out = data;
    data = NULL;
done:
    free(data);
    return status;
}

typedef struct index_target {
    const tl_gltf *gltf;
    const opened *accessor;
    size_t vertex_count;
    uint32_t *out; /* [count] */
} index_target;

static tl_status convert_index(void *context, size_t i, const uint8_t *bytes, tl_error *err)
{
    const index_target *const to = context;
    const uint32_t index = (uint32_t)to->accessor->component->read(bytes);
    if (index >= to->vertex_count)
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: %s: index %zu is vertex %u, but there are %zu vertices",
                       to->gltf->path, to->accessor->label.text, i, index, to->vertex_count);
    to->out[i] = index;
    return TL_OK;
}

tl_status tl_accessor_read_indices(const tl_gltf *gltf,
                                   const char *user,
                                   int accessor,
                                   size_t vertex_count,
                                   tl_budget *budget,
                                   uint32_t **out,
                                   size_t *count,
                                   tl_error *err)
{
    tl_status status = TL_OK;
    opened a;
    void *data = NULL;

    TRY(open_accessor(gltf, user, accessor, &a, err));
    if (!(a.component->bit & (UINT8 | UINT16 | UINT32)) || a.from->component_count != 1 ||
        a.from->normalized) {
        status =
            tl_fail(err, TL_ERR_FORMAT,
                    "%s: %s: indices cannot be accessor %d with %d components of type %d%s",
                    gltf->path, user, accessor, a.from->component_count, a.from->component_type,
                    a.from->normalized ? ", normalised" : "");
        goto done;
    }
    TRY(tl_budget_take(budget, gltf, user, a.from->count, sizeof(uint32_t), &data, err));
    index_target to = {gltf, &a, vertex_count, data};
    TRY(for_each_element(gltf, &a, convert_index, &to, err));

    *count = a.from->count;
    *out = data;
    data = NULL;
done:
    free(data);
    return status;
}
