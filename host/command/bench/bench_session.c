#include "bench_session.h"

#include "console.h"
#include "output.h"
#include "try.h"

#include <string.h>

static bool is_standard(const char *path)
{
    return path && strcmp(path, "-") == 0;
}

tl_status bench_session_begin(bench_session *s, const bench_options *options, tl_error *err)
{
    tl_status status = TL_OK;
    const bool is_taken = is_standard(options->csv) || is_standard(options->json);
    *s = (bench_session){.options = options,
                         .machine = tl_machine_ask(),
                         .table = is_taken || options->quiet ? NULL : stdout};
    if (options->csv)
        TRY(output_check(options->csv, NULL, err));
    if (options->json)
        TRY(output_check(options->json, NULL, err));
done:
    return status;
}

void bench_session_end(bench_session *s)
{
    tl_bench_frame_clear(&s->frame);
    tl_device_close(s->device);
    tl_bench_cases_clear(&s->cases);
}

tl_status bench_session_device(bench_session *s, const tl_bench_case *of, tl_error *err)
{
    const char *word = of->words[TL_AXIS_DEVICE];
    const bool is_usual = strcmp(word, tl_bench_axes[TL_AXIS_DEVICE].usual) == 0;
    if (s->device && strcmp(s->device_word, word) == 0)
        return TL_OK;
    tl_device_close(s->device);
    s->device = NULL;
    s->peaks = (tl_peaks){0};
    memcpy(s->device_word, word, sizeof s->device_word);
    return tl_device_open(is_usual ? NULL : word, &s->device, err);
}

tl_status bench_session_peaks(bench_session *s, tl_error *err)
{
    if (s->peaks.flops > 0.0)
        return TL_OK;
    console_stage("measuring what the device can do at most");
    return tl_peaks_measure(s->device, &s->peaks, err);
}
