#include "drawing.h"

#include "blending.h"
#include "interface.h"
#include "try.h"

#include <stdlib.h>

_Static_assert(SLOT_COUNT == (int)TL_GLTF_SLOT_COUNT &&
                   (int)TL_HAS_EMISSIVE == (int)TL_GLTF_EMISSIVE &&
                   (int)SLOT_EMISSIVE == (int)TL_GLTF_EMISSIVE &&
                   (int)SLOT_NORMAL_MAP == (int)TL_GLTF_NORMAL_MAP,
               "texture slots have one order in gltf.h, program.h and interface.h");

/* What passes need to know of a draw, in float as the shaders take it. */
struct tl_placed_draw {
    const tl_part *part;
    const tl_material *material;
    size_t index;  /* of the part */
    GLuint object; /* id: its node, counted from 1 */
    unsigned features;
    bool mirrored;
    uint32_t first_rank; /* among what blends: blending.h */
    float view_from_model[3][4], normal_from_model[3][3], tangent_from_model[3][3];
};
typedef struct tl_placed_draw placed_draw;

/* --- matrices ---------------------------------------------------------------------------------- */

/* Reversed depth: the near plane is 1, the far plane or infinity 0, so that floating-point depth is
 * about as fine, relatively, everywhere. Forward depth is 1 less that: w less z. */
static void find_projection(const tl_camera *camera, bool is_reversed, float out[4][4])
{
    const double l = (double)camera->left, r = (double)camera->right;
    const double b = (double)camera->bottom, t = (double)camera->top;
    const double n = (double)camera->near, f = (double)camera->far;
    const bool flat = camera->projection == TL_ORTHOGRAPHIC;
    const double slope = isinf(f) ? 0.0 : (flat ? 1.0 : n) / (f - n);
    const double offset = isinf(f) ? (flat ? 1.0 : n) : (flat ? 1.0 : n) * f / (f - n);
    double m[4][4] = {
        {2 / (r - l), 0, flat ? 0 : (r + l) / (r - l), flat ? -(r + l) / (r - l) : 0},
        {0, 2 / (t - b), flat ? 0 : (t + b) / (t - b), flat ? -(t + b) / (t - b) : 0},
        {0, 0, slope, offset},
        {0, 0, flat ? 0 : -1, flat ? 1 : 0},
    };
    for (int j = 0; j < 4 && !is_reversed; j++)
        m[2][j] = m[3][j] - m[2][j];
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            out[i][j] = (float)m[i][j];
}

/* The rotation's rows are orthonormal, so its inverse is its transpose. */
static void find_view(tl_drawing *p)
{
    const tl_camera *const camera = p->camera;
    const double origin[3] = {0.0, 0.0, 0.0};
    double eye[3];
    tl_camera_world_point(camera, origin, eye);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            p->world_from_view[i][j] = camera->view_from_world[j][i];
    for (int i = 0; i < 3; i++)
        p->eye[i] = (float)eye[i];
    p->depth_range[0] = camera->near;
    p->depth_range[1] = camera->far;
    p->depth_range[2] = camera->projection == TL_ORTHOGRAPHIC ? 1.0f : 0.0f;
    find_projection(camera, p->is_reversed, p->clip_from_view);
}

/* Directions only matter: brought near 1 in double, they cannot leave float's range. */
static void round_directions(const double from[3][3], float out[3][3])
{
    double largest = 0.0;
    for (int i = 0; i < 9; i++)
        largest = fmax(largest, fabs(from[i / 3][i % 3]));
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            out[i][j] = largest > 0.0 ? (float)(from[i][j] / largest) : 0.0f;
}

/* Model to view in one double-precision product: where the scene is far from the origin the large
 * offsets of both cancel before anything is rounded to float. */
static void place_draw(const tl_drawing *p, const tl_draw *draw, placed_draw *out)
{
    tl_affine view;
    double normal[3][3], linear[3][3];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            view.m[i][j] = (double)p->camera->view_from_world[i][j];
    const tl_affine product = tl_affine_product(&view, &draw->world);
    tl_affine_normal_matrix(&draw->world, normal, &out->mirrored);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            out->view_from_model[i][j] = (float)product.m[i][j];
    for (int i = 0; i < 9; i++)
        linear[i / 3][i % 3] = draw->world.m[i / 3][i % 3];
    round_directions((const double(*)[3])normal, out->normal_from_model);
    round_directions((const double(*)[3])linear, out->tangent_from_model);
}

/* --- what a draw needs ------------------------------------------------------------------------- */

static unsigned features_of(const tl_model *model, const tl_part *part)
{
    const tl_material *const material = &model->materials[part->material];
    unsigned features = 0;
    for (unsigned i = 0; i < TL_GLTF_SLOT_COUNT; i++) {
        const tl_texture_slot *const slot = &material->slots[i];
        features |= (unsigned)(slot->texture != -1) << i;
        if (slot->texture != -1 && slot->coordinates >= FEW_SETS)
            features |= 1u << TL_MANY_SETS;
    }
    /* Without coordinates for its map a part has no tangents either, and the map nothing to say. */
    if (!model->vertices[part->vertices].attributes[TL_GLTF_TANGENT])
        features &= ~(1u << TL_HAS_NORMAL_MAP);
    if (material->alpha_cutoff > 0.0f)
        features |= 1u << TL_ALPHA_TEST;
    if (material->unlit)
        features |= 1u << TL_UNLIT;
    return features;
}

static void prepare_draws(tl_drawing *p)
{
    for (size_t i = 0; i < p->model->draw_count; i++) {
        placed_draw *const to = &p->draws[i];
        to->index = p->model->draws[i].part;
        to->object = (GLuint)p->model->draws[i].node + 1;
        to->part = &p->model->parts[to->index];
        to->material = &p->model->materials[to->part->material];
        to->features = features_of(p->model, to->part);
    }
}

/* --- uniforms ---------------------------------------------------------------------------------- */

/* Only where there are mipmaps to choose from: without, a file asks for texels as they are. */
static float anisotropy_of(const tl_drawing *p, const tl_texture *texture)
{
    return texture->sampler.min_filter >= GL_NEAREST_MIPMAP_NEAREST ? p->anisotropy : 1.0f;
}

static void set_lookup(const tl_drawing *p, const placed_draw *draw)
{
    const tl_gl *const gl = p->gl;
    GLint coordinates[SLOT_COUNT];
    GLfloat rows[2 * SLOT_COUNT][3], anisotropy[SLOT_COUNT];
    for (GLuint i = 0; i < SLOT_COUNT; i++) {
        const tl_texture_slot *const slot = &draw->material->slots[i];
        coordinates[i] = slot->coordinates;
        for (int k = 0; k < 6; k++)
            rows[2 * i + (GLuint)k / 3][k % 3] = slot->uv_from_coordinates[k / 3][k % 3];
        anisotropy[i] = 1.0f;
        if (slot->texture == -1)
            continue;
        gl->BindTextureUnit(i, p->objects->textures[p->model->textures[slot->texture].pixels]);
        gl->BindSampler(i, p->objects->samplers[slot->texture]);
        anisotropy[i] = anisotropy_of(p, &p->model->textures[slot->texture]);
    }
    gl->Uniform4fv(UNIFORM_BASE_COLOR, 1, draw->material->base_color);
    gl->Uniform1f(UNIFORM_ALPHA_CUTOFF, draw->material->alpha_cutoff);
    gl->Uniform1iv(UNIFORM_COORDINATES, SLOT_COUNT, coordinates);
    gl->Uniform3fv(UNIFORM_UV, 2 * SLOT_COUNT, &rows[0][0]);
    gl->Uniform1fv(UNIFORM_ANISOTROPY, SLOT_COUNT, anisotropy);
}

static void set_geometry(const tl_drawing *p, const placed_draw *draw)
{
    const tl_gl *const gl = p->gl;
    gl->UniformMatrix4fv(UNIFORM_CLIP_FROM_VIEW, 1, GL_TRUE, &p->clip_from_view[0][0]);
    gl->UniformMatrix4x3fv(UNIFORM_VIEW_FROM_MODEL, 1, GL_TRUE, &draw->view_from_model[0][0]);
    gl->UniformMatrix3fv(UNIFORM_NORMAL_FROM_MODEL, 1, GL_TRUE, &draw->normal_from_model[0][0]);
    gl->UniformMatrix3fv(UNIFORM_TANGENT_FROM_MODEL, 1, GL_TRUE,
                         &draw->tangent_from_model[0][0]);
    /* A mirrored normal and tangent have a cross product that points the other way. */
    gl->Uniform1f(UNIFORM_BITANGENT_SIGN, draw->mirrored ? -1.0f : 1.0f);
}

/* That of the file's material, from 1; 0 of the default one. */
static float brdf_index(const tl_model *model, const tl_part *part)
{
    return part->material < model->gltf->material_count ? (float)(part->material + 1) : 0.0f;
}

static void set_surface(const tl_drawing *p, const placed_draw *draw)
{
    const tl_material *const material = draw->material;
    const GLfloat factors[4] = {material->metallic, material->roughness, material->normal_scale,
                                material->occlusion_strength};
    p->gl->UniformMatrix3fv(UNIFORM_WORLD_FROM_VIEW, 1, GL_TRUE, &p->world_from_view[0][0]);
    p->gl->Uniform3fv(UNIFORM_EYE, 1, p->eye);
    p->gl->Uniform3fv(UNIFORM_DEPTH_RANGE, 1, p->depth_range);
    p->gl->Uniform3fv(UNIFORM_EMISSIVE, 1, material->emissive);
    p->gl->Uniform4fv(UNIFORM_FACTORS, 1, factors);
    p->gl->Uniform1f(UNIFORM_BRDF, brdf_index(p->model, draw->part));
    if (p->has_ids)
        p->gl->Uniform1ui(UNIFORM_OBJECT, draw->object);
}

/* --- drawing ----------------------------------------------------------------------------------- */

/* What is on the far plane, which the buffer is wiped to, is equal to it in the material pass. Peeling is
 * drawn reversed always. */
static const struct {
    bool colors, depth;       /* that it writes */
    bool of_layers;           /* of surfaces that blend, where there are layers */
    bool of_both;             /* of all surfaces all the same */
    GLenum reversed, forward; /* the comparison of depths */
} passes[TL_PASS_COUNT] = {
    [TL_DEPTH_PASS] = {false, true, false, false, GL_GREATER, GL_LESS},
    [TL_SURFACE_PASS] = {true, false, false, false, GL_EQUAL, GL_EQUAL},
    [TL_SHADOW_PASS] = {true, true, false, true, GL_GREATER, GL_LESS},
    [TL_BACK_PASS] = {true, true, false, false, GL_GEQUAL, GL_LEQUAL},
    [TL_FRONT_PASS] = {true, true, true, false, GL_GEQUAL, GL_LEQUAL},
    [TL_CHOICE_PASS] = {true, true, true, false, GL_LESS, GL_LESS}, /* of ranks */
    [TL_LAYER_PASS] = {true, true, true, false, GL_ALWAYS, GL_ALWAYS},
};

static tl_status draw_one(const tl_drawing *p,
                          tl_pass which,
                          const placed_draw *draw,
                          tl_error *err)
{
    const tl_gl *const gl = p->gl;
    GLuint program = 0;
    const tl_status status =
        tl_program_for(gl, p->programs, which, draw->features, &program, err);
    if (status != TL_OK)
        return status;
    gl->UseProgram(program);
    set_geometry(p, draw);
    set_lookup(p, draw);
    if (which == TL_SURFACE_PASS || which == TL_LAYER_PASS)
        set_surface(p, draw);
    if (passes[which].of_layers)
        gl->Uniform1f(UNIFORM_RANK, (GLfloat)draw->first_rank);
    if (which == TL_SHADOW_PASS)
        gl->Uniform3fv(UNIFORM_DEPTH_RANGE, 1, p->depth_range);
    /* glTF 2.0, section 3.7.4: a negative determinant turns the front around. */
    gl->FrontFace(draw->mirrored ? GL_CW : GL_CCW);
    /* Light does not ask which side of a surface it meets. */
    (draw->material->double_sided || which == TL_SHADOW_PASS ? gl->Disable
                                                             : gl->Enable)(GL_CULL_FACE);
    const GLuint array = p->objects->vertex_arrays[draw->part->vertices];
    gl->BindVertexArray(array);
    gl->VertexArrayElementBuffer(array, p->objects->index_buffers[draw->index]);
    gl->DrawElements(GL_TRIANGLES, (GLsizei)draw->part->index_count, GL_UNSIGNED_INT, NULL);
    return TL_OK;
}

static bool is_drawn(const tl_drawing *p, tl_pass which, const placed_draw *draw)
{
    return passes[which].of_both ||
           passes[which].of_layers == (p->is_layered && draw->material->blends);
}

tl_status tl_drawing_run(const tl_drawing *p, tl_pass which, tl_error *err)
{
    const GLboolean colors = passes[which].colors;
    p->gl->ColorMask(colors, colors, colors, colors);
    p->gl->DepthMask(passes[which].depth);
    p->gl->DepthFunc(p->is_reversed ? passes[which].reversed : passes[which].forward);
    for (size_t i = 0; i < p->model->draw_count; i++) {
        if (!is_drawn(p, which, &p->draws[i]))
            continue;
        const tl_status status = draw_one(p, which, &p->draws[i], err);
        if (status != TL_OK)
            return status;
    }
    return TL_OK;
}

/* Row 0 on top, as in the G-buffer; depth in [0, 1], or reversing it would gain nothing. */
void tl_drawing_set_state(const tl_gl *gl)
{
    gl->ClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
    gl->Enable(GL_DEPTH_TEST);
    gl->Enable(GL_STENCIL_TEST); /* where there is a stencil buffer: 1 is a surface */
    gl->StencilFunc(GL_ALWAYS, 1, 0xff);
    gl->StencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    gl->Disable(GL_DITHER);
    gl->CullFace(GL_BACK);
    gl->VertexAttrib4f(ATTRIBUTE_COLOR, 1.0f, 1.0f, 1.0f, 1.0f); /* where a part has none */
}

void tl_drawing_look(tl_drawing *p, const tl_camera *camera, bool is_reversed)
{
    p->camera = camera;
    p->is_reversed = is_reversed;
    find_view(p);
    for (size_t i = 0; i < p->model->draw_count; i++)
        place_draw(p, &p->model->draws[i], &p->draws[i]);
}

tl_status tl_drawing_begin(tl_drawing *p,
                           const tl_gl *gl,
                           const tl_model *model,
                           const tl_scene_objects *objects,
                           uint32_t anisotropy,
                           tl_error *err)
{
    *p = (tl_drawing){
        .gl = gl, .model = model, .objects = objects, .anisotropy = (float)anisotropy};
    p->programs = calloc(1, sizeof *p->programs);
    p->draws = calloc(model->draw_count + 1, sizeof *p->draws);
    if (!p->programs || !p->draws) {
        tl_drawing_clear(p);
        return tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for drawing it",
                       model->gltf->path);
    }
    prepare_draws(p);
    return TL_OK;
}

tl_status tl_drawing_part_layers(tl_drawing *p, tl_error *err)
{
    tl_status status = TL_OK;
    uint32_t *ranks = calloc(p->model->draw_count + 1, sizeof *ranks);
    if (!ranks)
        TRY(tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for what blends",
                    p->model->gltf->path));
    TRY(tl_blending_ranks(p->model, ranks, err));
    for (size_t i = 0; i < p->model->draw_count; i++)
        p->draws[i].first_rank = ranks[i];
    p->is_layered = true;
done:
    free(ranks);
    return status;
}

void tl_drawing_clear(tl_drawing *p)
{
    free(p->programs);
    free(p->draws);
    *p = (tl_drawing){0};
}
