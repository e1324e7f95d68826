#define _POSIX_C_SOURCE 200809L
#include "study_csv.h"

#include "csv_values.h"
#include "try.h"
#include "whole_file.h"

#include <stdio.h>
#include <stdlib.h>

static void print_names(FILE *out)
{
    fputs("frame", out);
    for (int i = 0; i < TL_STUDY_KNOB_COUNT; i++)
        fprintf(out, ",%s", tl_study_knobs[i].name);
    for (int i = 0; i < TL_STUDY_TIME_COUNT; i++) {
        const char *name = tl_study_time_rows[i].name;
        fprintf(out, ",%s,%s_low,%s_high,%s_samples,%s_unstable", name, name, name, name, name);
    }
    for (int i = 0; i < TL_STUDY_VALUE_COUNT; i++)
        fprintf(out, ",%s", tl_study_value_rows[i].name);
    fputs(",again,again_low,again_high,again_stays,main_cause,worst_cause,worst_detail,map\n",
          out);
}

static void print_record(FILE *out, const char *frame, const tl_study_record *r)
{
    tl_csv_text(out, frame);
    for (int i = 0; i < TL_STUDY_KNOB_COUNT; i++) {
        fputc(',', out);
        tl_csv_text(out, r->config.words[i]);
    }
    for (int i = 0; i < TL_STUDY_TIME_COUNT; i++) {
        const tl_study_time *t = &r->times[i];
        tl_csv_number(out, t->median);
        tl_csv_number(out, t->low);
        tl_csv_number(out, t->high);
        fprintf(out, ",%zu,%d", t->samples, t->is_unstable);
    }
    for (int i = 0; i < TL_STUDY_VALUE_COUNT; i++)
        tl_csv_number(out, r->values[i]);
    tl_csv_number(out, r->again.median);
    tl_csv_number(out, r->again.low);
    tl_csv_number(out, r->again.high);
    fputs(tl_study_stays(r) < 0 ? "," : tl_study_stays(r) ? ",1" : ",0", out);
    const char *const texts[] = {tl_study_main_cause(r), r->worst_cause, r->worst_detail,
                                 r->map};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        fputc(',', out);
        tl_csv_text(out, texts[i]);
    }
    fputc('\n', out);
}

tl_status tl_study_csv_write(const tl_study *study, const char *path, tl_error *err)
{
    char *text = NULL;
    size_t size = 0;
    tl_status status = TL_OK;
    FILE *stream = open_memstream(&text, &size);
    int failed = !stream;
    if (stream) {
        print_names(stream);
        for (size_t i = 0; i < study->count; i++)
            for (size_t k = 0; k < study->results[i].count; k++)
                print_record(stream, study->results[i].name, &study->results[i].records[k]);
        failed = ferror(stream);
        failed = fclose(stream) != 0 || failed;
    }
    if (failed)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for %s", path));
    TRY(tl_whole_file_write(path, text, size, err));
done:
    free(text);
    return status;
}
