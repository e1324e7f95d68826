/* Edges of surfaces, smoothed (kernels/edges.h). */
#include "stage.h"

#include "bands.h"
#include "place_slack.h"
#include "try.h"
#include "view.h"

#include <math.h>

static int is_on(const tl_post *post, const tl_gbuffer *gbuffer)
{
    (void)gbuffer;
    return post->options.edges.normals || post->options.edges.depth;
}

static uint32_t halo(const tl_post *post)
{
    (void)post;
    return 1;
}

static uint64_t row_size(const tl_post_work *work)
{
    const tl_gbuffer *g = work->gbuffer;
    const uint64_t words = work->context.device->shares_memory ? 0 : tl_gbuffer_pixel_size(g);
    return g->pitch * (TL_EDGE_PLANE_COUNT * sizeof(float) + words);
}

/* Of the rows of the view and those around them. */
static tl_view_edges view_of(const tl_post_work *work)
{
    const tl_edge_options *o = &work->post->options.edges;
    const double angle = (double)(o->angle > 0.0f ? o->angle : TL_DEFAULT_EDGE_ANGLE),
                 step = (double)(o->step > 0.0f ? o->step : TL_DEFAULT_EDGE_STEP);
    const double turn = 2.0 * sin(0.5 * angle);
    const tl_post_rows_span rows =
        tl_post_rows_around(work->from, work->view.first_row, work->view.end_row, 1);
    float slack[3];
    tl_place_slack(work->gbuffer, 0.0, slack);
    return (tl_view_edges){.which = (o->normals ? TL_EDGE_NORMALS : 0) |
                                    (o->depth ? TL_EDGE_DEPTH : 0),
                           .per_normals = (float)(1.0 / (TL_EDGE_NEIGHBOURS * turn * turn)),
                           .per_depth = (float)(1.0 / (2 * TL_EDGE_NEIGHBOURS * step * step)),
                           .orthographic = work->gbuffer->camera.projection == TL_ORTHOGRAPHIC,
                           .slack = slack[0],
                           .slack_per_depth = slack[1],
                           .slack_per_depth2 = slack[2],
                           .first_row = rows.first,
                           .rows = rows.count};
}

/* frame.rows are those of the word planes, of which plane_row is the picture's row that comes first. */
static tl_view_gather gather_of(const tl_post_work *work, uint32_t rows, uint32_t plane_row)
{
    const tl_gbuffer *g = work->gbuffer;
    tl_view_gather of = {.edges = view_of(work)};
    tl_view_set(&g->camera, g->layout, &of.frame);
    of.frame.pitch = g->pitch;
    of.frame.rows = rows;
    of.frame.buffer_row = of.edges.first_row - plane_row;
    return of;
}

static tl_status upload_words(tl_post_work *work, tl_error *err)
{
    const tl_gbuffer *g = work->gbuffer;
    tl_pass_context *c = &work->context;
    if (c->device->shares_memory)
        return tl_buffers_share(c->buffers, c->device, TL_BUFFER_PLANES, g->planes,
                                (size_t)g->pitch * g->rows * tl_gbuffer_pixel_size(g), err);
    c->frame.rows = work->view.plane_rows;
    c->frame.first_row = work->view.plane_row;
    c->frame.buffer_row = 0;
    return tl_bands_upload_words(c, g, err);
}

/* What gathering is built for beside the rest. */
static tl_kernel_options kernels_for(const tl_gbuffer *g)
{
    return (tl_kernel_options){.layout = g->layout,
                               .present = g->present,
                               .orthographic = g->camera.projection == TL_ORTHOGRAPHIC};
}

static tl_status on_device(tl_post_work *work, int *wrote, tl_error *err)
{
    const tl_kernel_options kernels = kernels_for(work->gbuffer);
    const tl_view_gather of = gather_of(work, work->view.plane_rows, work->view.plane_row);
    const tl_view_edge_stage stage = {work->view, of.edges};
    const size_t rows = work->view.end_row - work->view.first_row;
    const uint32_t pitch = work->view.pitch;
    double *const ms = &work->counts.device_ms[TL_POST_EDGES];
    tl_pass_context *c = &work->context;
    tl_status status = TL_OK;
    TRY(tl_post_find_program(work, TL_PART_EDGES, &kernels, err));
    TRY(upload_words(work, err));
    TRY(tl_buffers_reserve(c->buffers, c->device, TL_BUFFER_POST_EDGES,
                           (size_t)TL_EDGE_PLANE_COUNT * of.edges.rows * pitch * sizeof(float),
                           err));
    TRY(TL_POST_LAUNCH(work, TL_PART_EDGES, gather_edges, &of, of.edges.rows, pitch, ms, err,
                       TL_BUFFER_PLANES, TL_BUFFER_POST_EDGES));
    TRY(TL_POST_LAUNCH(work, TL_PART_EDGES, smooth_edges, &stage, rows, pitch, ms, err,
                       TL_BUFFER_POST_EDGES, TL_BUFFER_POST_FROM, TL_BUFFER_POST_TO));
    *wrote = 1;
done:
    return status;
}

static tl_status on_host(tl_post_work *work, int *wrote, tl_error *err)
{
    const tl_gbuffer *g = work->gbuffer;
    const tl_view_gather of = gather_of(work, g->rows, 0);
    const tl_view_edge_stage stage = {work->view, of.edges};
    const tl_word_planes planes = tl_word_planes_of(g);
    const tl_needs needs = {
        .layout = g->layout, .present = g->present, .orthographic = of.edges.orthographic};
    tl_post_rows_job job = {.view = work->view,
                            .from = work->from->planes,
                            .gather = &of,
                            .needs = &needs,
                            .planes = &planes,
                            .edges = &stage};
    tl_status status = TL_OK;
    TRY(tl_post_reserve_to(work, err));
    TRY(tl_post_reserve_numbers(work->post,
                                (size_t)TL_EDGE_PLANE_COUNT * of.edges.rows * g->pitch, err));
    job.to = work->to->planes;
    job.numbers = work->post->numbers;
    tl_post_rows(work, TL_POST_STEP_GATHER_EDGES, &job, work->view.height);
    tl_post_rows(work, TL_POST_STEP_SMOOTH_EDGES, &job, work->view.height);
    *wrote = 1;
done:
    return status;
}

const tl_stage tl_stage_edges = {
    .name = TL_POST_EDGES,
    .is_on = is_on,
    .halo = halo,
    .row_size = row_size,
    .on_device = on_device,
    .on_host = on_host,
};
