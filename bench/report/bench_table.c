#include "bench_table.h"

#include "tilelight/layouts.h"

#include <math.h>
#include <string.h>

enum { TITLE_WIDTH = 34 };

void tl_bench_case_title(const tl_bench_case *of, char *text, size_t size)
{
    size_t used = (size_t)snprintf(text, size, "%s", of->words[TL_AXIS_SCENE]);
    for (int axis = 0; axis < TL_AXIS_COUNT && used < size; axis++)
        if (axis != TL_AXIS_SCENE && strcmp(of->words[axis], tl_bench_axes[axis].usual) != 0)
            used += (size_t)snprintf(text + used, size - used, " %s=%s",
                                     tl_bench_axes[axis].name, of->words[axis]);
}

void tl_bench_table_heading(FILE *out)
{
    fprintf(out, "%-*s %4s %9s %7s %9s %8s %8s %8s %8s %7s %7s %6s %6s\n", TITLE_WIDTH, "case",
            "B/px", "frame ms", "+-", "p90", "cull", "shade", "build", "post", "Mpair",
            "ns/pair", "% flop", "% byte");
}

static double figure(const char *name, const tl_bench_record *r)
{
    for (int i = 0; i < tl_figure_count; i++)
        if (strcmp(tl_figures[i].name, name) == 0)
            return tl_figures[i].of(r);
    return (double)NAN;
}

static void print_turns(FILE *out, const tl_bench_record *r)
{
    const tl_bench_turns *t = &r->turns;
    const int is_layout = r->of.against != r->of.layout;
    fprintf(out, "    %.3f of the frame's time %s%s", t->frame.median,
            is_layout ? "in " : "without layers",
            is_layout ? tl_layout_word(r->of.against) : "");
    if (t->frame.count > 1)
        fprintf(out, " (%.3f to %.3f)", t->frame.interval.low, t->frame.interval.high);
    if (t->shade.count > 0)
        fprintf(out, ", culling %.3f, shading %.3f", t->cull.median, t->shade.median);
    fputc('\n', out);
}

static void print_error(FILE *out, const tl_storage_error *e)
{
    fprintf(out, "    storage error of the picture over its mean: RMS %.1e, most %.1e%s\n",
            e->of.relative_rms, e->of.relative_max,
            e->lost ? "; it has no place for all of the material" : "");
}

void tl_bench_table_line(FILE *out, const tl_bench_record *r)
{
    char title[512];
    char per_pair[16] = "-"; /* where no tile lists a light */
    tl_bench_case_title(&r->of, title, sizeof title);
    if (r->counts.pair_count > 0)
        snprintf(per_pair, sizeof per_pair, "%.3f", figure("ns_per_pair", r));
    fprintf(out, "%-*s %4u %9.2f %6.1f%% %9.2f %8.2f %8.2f %8.1f %8.2f %7.1f %7s %6.1f %6.1f\n",
            TITLE_WIDTH, title, r->pixel_bytes, r->frame_ms.median,
            100.0 * tl_relative_deviation(&r->frame_ms), r->frame_ms.p90,
            r->kernel_cull_ms.median, r->kernel_shade_ms.median, r->build_ms, r->post_ms.median,
            1e-6 * (double)r->counts.pair_count, per_pair,
            100.0 * figure("share_of_peak_flops", r), 100.0 * figure("share_of_peak_bytes", r));
    if (r->turns.frame.count > 0)
        print_turns(out, r);
    if (r->error.is_known)
        print_error(out, &r->error);
    for (int i = 0; i < tl_figure_count; i++) {
        const double value = tl_figures[i].of(r);
        if (!tl_figure_is_possible(&tl_figures[i], value))
            fprintf(out, "    %s is %.2f: above the roof, so a unit is wrong\n",
                    tl_figures[i].name, value);
    }
    fflush(out);
}
