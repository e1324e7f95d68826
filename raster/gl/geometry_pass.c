#include "geometry_pass.h"

#include "drawing.h"
#include "targets.h"
#include "try.h"

static tl_status draw_band(const tl_drawing *drawing,
                           const tl_targets *targets,
                           enum tl_layout_name layout,
                           uint32_t first,
                           tl_error *err)
{
    tl_status status = TL_OK;
    const tl_gl *const gl = drawing->gl;
    const tl_camera *const camera = drawing->camera;
    gl->BindFramebuffer(GL_FRAMEBUFFER, targets->framebuffer);
    gl->Viewport(0, -(GLint)first, (GLsizei)camera->width, (GLsizei)camera->height);
    gl->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl->DepthMask(GL_TRUE);
    tl_targets_wipe(gl, targets, layout);
    TRY(tl_drawing_run(drawing, TL_DEPTH_PASS, err));
    TRY(tl_drawing_run(drawing, TL_SURFACE_PASS, err));
    gl->Finish(); /* so that the stages' times are their own */
    TRY(tl_gl_check(gl, "rendering the scene", err));
done:
    return status;
}

tl_status tl_geometry_pass(const tl_gl *gl,
                           const tl_model *model,
                           const tl_scene_objects *objects,
                           uint32_t anisotropy,
                           tl_gbuffer *gbuffer,
                           tl_timings *timings,
                           tl_error *err)
{
    tl_status status = TL_OK;
    tl_targets targets = {0};
    tl_drawing drawing = {0};
    const uint32_t height = gbuffer->camera.height;
    double clock = tl_seconds();

    TRY(tl_drawing_begin(&drawing, gl, model, objects, anisotropy, err));
    tl_output_stage(gbuffer->layout, gbuffer->present, drawing.programs->output);
    tl_drawing_look(&drawing, &gbuffer->camera,
                    tl_depth_buffer_of(gbuffer->layout).is_reversed);
    tl_drawing_set_state(gl);
    TRY(tl_targets_create(gl, gbuffer, &targets, err));
    for (uint32_t first = 0; first < height; first += targets.rows) {
        const uint32_t left = height - first;
        TRY(draw_band(&drawing, &targets, gbuffer->layout, first, err));
        clock = tl_timings_end(timings, "raster", clock);
        tl_targets_read(gl, &targets, gbuffer, first,
                        left < targets.rows ? left : targets.rows);
        TRY(tl_gl_check(gl, "reading the targets back", err));
        clock = tl_timings_end(timings, "readback", clock);
    }
done:
    tl_targets_clear(&targets);
    tl_drawing_clear(&drawing);
    return status;
}
