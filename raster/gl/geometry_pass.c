#include "geometry_pass.h"

#include "blending.h"
#include "peeling.h"
#include "try.h"

static tl_status draw_band(tl_drawing *drawing,
                           const tl_targets *targets,
                           const tl_gbuffer *gbuffer,
                           uint32_t first,
                           tl_error *err)
{
    tl_status status = TL_OK;
    const tl_gl *const gl = drawing->gl;
    const tl_camera *const camera = &gbuffer->camera;
    tl_drawing_look(drawing, camera, tl_depth_buffer_of(gbuffer->layout).is_reversed);
    gl->BindFramebuffer(GL_FRAMEBUFFER, targets->framebuffer);
    gl->Viewport(0, -(GLint)first, (GLsizei)camera->width, (GLsizei)camera->height);
    gl->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl->DepthMask(GL_TRUE);
    tl_targets_wipe(gl, targets, gbuffer->layout);
    TRY(tl_drawing_run(drawing, TL_DEPTH_PASS, err));
    TRY(tl_drawing_run(drawing, TL_SURFACE_PASS, err));
    gl->Finish(); /* so that the stages' times are their own */
    TRY(tl_gl_check(gl, "rendering the scene", err));
done:
    return status;
}

/* Peeling, where there is anything to peel. */
static tl_status begin_layers(tl_drawing *drawing,
                              const tl_targets *targets,
                              const tl_gbuffer *gbuffer,
                              uint32_t most,
                              tl_peeling *out,
                              tl_error *err)
{
    tl_status status = TL_OK;
    if (most == 0 || !tl_model_blends(drawing->model))
        return TL_OK;
    TRY(tl_drawing_part_layers(drawing, err));
    drawing->programs->forward_layers = !tl_depth_buffer_of(gbuffer->layout).is_reversed;
    TRY(tl_peeling_create(drawing->gl, targets, most, out, err));
done:
    return status;
}

tl_status tl_geometry_pass(const tl_gl *gl,
                           const tl_model *model,
                           const tl_scene_objects *objects,
                           uint32_t anisotropy,
                           uint32_t most_layers,
                           tl_gbuffer *gbuffer,
                           tl_timings *timings,
                           tl_error *err)
{
    tl_status status = TL_OK;
    tl_targets targets = {0};
    tl_peeling peeling = {0};
    tl_drawing drawing = {0};
    const uint32_t height = gbuffer->camera.height;
    double clock = tl_seconds();

    TRY(tl_drawing_begin(&drawing, gl, model, objects, anisotropy, err));
    tl_drawing_set_state(gl);
    TRY(tl_targets_create(gl, gbuffer, &targets, err));
    tl_output_stage(gbuffer->layout, gbuffer->present, targets.id_target,
                    drawing.programs->output);
    drawing.has_ids = targets.ids != 0;
    TRY(begin_layers(&drawing, &targets, gbuffer, most_layers, &peeling, err));
    for (uint32_t first = 0; first < height; first += targets.rows) {
        const uint32_t left = height - first;
        const uint32_t rows = left < targets.rows ? left : targets.rows;
        TRY(draw_band(&drawing, &targets, gbuffer, first, err));
        clock = tl_timings_end(timings, "raster", clock);
        tl_targets_read(gl, &targets, gbuffer, first, rows);
        TRY(tl_gl_check(gl, "reading the targets back", err));
        clock = tl_timings_end(timings, "readback", clock);
        if (!drawing.is_layered)
            continue;
        tl_drawing_look(&drawing, &gbuffer->camera, true);
        TRY(tl_peel_band(&peeling, &drawing, &targets, gbuffer, first, rows, err));
        clock = tl_timings_end(timings, "layers", clock);
    }
done:
    tl_peeling_clear(&peeling);
    tl_targets_clear(&targets);
    tl_drawing_clear(&drawing);
    return status;
}
