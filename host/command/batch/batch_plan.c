#include "batch_plan.h"

#include "batch_record.h"
#include "console.h"
#include "json_values.h"
#include "printable.h"
#include "try.h"

#include <stdio.h>

typedef struct plan {
    json_t *items;
    size_t made, up_to_date, failed;
} plan;

static void print_line(const char *first, const char *second)
{
    for (; *first; first++)
        putchar(tl_printable(*first));
    putchar(' ');
    for (; *second; second++)
        putchar(tl_printable(*second));
    putchar('\n');
}

/* Of an item that is there. */
static void tell(const batch *b, const tl_item *item, const char *record, bool json, plan *p)
{
    const char *output = NULL;
    const batch_reason reason = batch_reason_of(b, item, record, &output);
    const bool is_made = reason != BATCH_UP_TO_DATE_IS;
    p->made += is_made;
    p->up_to_date += !is_made;
    if (!json)
        print_line(output, batch_reasons[reason]);
    json_array_append_new(p->items, json_pack("{ss ss sb ss ss}", "name", item->name, "input",
                                              item->input, "made", (int)is_made, "output",
                                              output, "reason", batch_reasons[reason]));
}

static void tell_failure(const tl_item *item, const char *sentence, bool json, plan *p)
{
    p->failed++;
    if (!json)
        print_line(item->input, "cannot be used:");
    console_complain(sentence);
    json_array_append_new(p->items, json_pack("{ss ss sb ss}", "name", item->name, "input",
                                              item->input, "made", 0, "reason", sentence));
}

tl_status batch_plan(const batch *b, const report_options *report, tl_error *err)
{
    char record[TL_RECORD_SIZE];
    tl_status status = TL_OK;
    plan p = {.items = json_array()};
    tl_error of_item;
    for (size_t i = 0; i < b->items->count; i++) {
        const tl_item *item = &b->items->of[i];
        if (batch_record_of(b, item, record, &of_item) == TL_OK)
            tell(b, item, record, report->json, &p);
        else
            tell_failure(item, of_item.message, report->json, &p);
    }
    if (report->json)
        TRY(tl_json_write("-",
                          json_pack("{sI sI sI sI sO}", "frames", (json_int_t)b->items->count,
                                    "would_be_made", (json_int_t)p.made, "up_to_date",
                                    (json_int_t)p.up_to_date, "failed", (json_int_t)p.failed,
                                    "items", p.items),
                          err));
    else
        printf("%zu of %zu frames would be lit, %zu are up to date\n", p.made, b->items->count,
               p.up_to_date);
    if (p.failed > 0)
        status = tl_fail(err, TL_ERR_DIFFERENT, "%zu of %zu frames cannot be used", p.failed,
                         b->items->count);
done:
    json_decref(p.items);
    return status;
}
