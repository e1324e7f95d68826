/* tilelight batch: many captures to pictures. */
#define _POSIX_C_SOURCE 200809L
#include "batch_options.h"

#include "batch_plan.h"
#include "batch_record.h"
#include "batch_report.h"
#include "batch_run.h"
#include "commands.h"
#include "console.h"
#include "interrupts.h"
#include "job_light.h"
#include "try.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The lights file that all items have; NULL: none, or several. */
static const char *common_lights(const tl_item_list *items)
{
    const char *first = items->of[0].lights;
    for (size_t i = 1; first && i < items->count; i++)
        if (!items->of[i].lights || strcmp(items->of[i].lights, first) != 0)
            return NULL;
    return first;
}

/* What is known without a device. */
static tl_status prepare_records(batch *b, batch_command *command, tl_error *err)
{
    frame_options *frame = &command->batch.frame;
    tl_status status = TL_OK;
    TRY(kernel_choice_read(&frame->kernel, &frame->lighting.options.kernel, err));
    TRY(batch_options_text(&batch_argp, command->argc, command->argv, frame, &b->text, err));
    TRY(tl_record_cache_create(&b->records, err));
done:
    return status;
}

/* What can be refused before a frame is read. */
static tl_status prepare(batch *b, const lighting_choice *lighting, tl_error *err)
{
    tl_status status = TL_OK;
    TRY(job_take_lights(&b->common, lighting, common_lights(b->items), err));
    if (b->common.lights_given)
        TRY(job_settle_lights(&b->common, lighting, err));
    TRY(job_open_device(&b->common, lighting, &b->with.device, err));
    TRY(lighter_lighting(&b->with, &b->with.lighting, &lighting->options, err));
    b->results = calloc(b->items->count, sizeof *b->results);
    if (!b->results)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for %zu frames", b->items->count));
    TRY(batch_queue_begin(&b->queue, b->items->count, err));
done:
    return status;
}

static void begin(batch *b)
{
    pthread_condattr_t clock;
    pthread_condattr_init(&clock);
    pthread_condattr_setclock(&clock, CLOCK_MONOTONIC);
    pthread_cond_init(&b->tally.changed, &clock);
    pthread_condattr_destroy(&clock);
    pthread_mutex_init(&b->tally.lock, NULL);
    pthread_mutex_init(&b->lighting, NULL);
    json_object_seed(0); /* which the library would else do on the first thread that needs it */
    batch_notices_begin(&b->notices);
    batch_cost_begin(&b->cost);
}

static void end(batch *b)
{
    for (size_t i = 0; b->results && i < b->items->count; i++)
        free(b->results[i].sentence);
    free(b->results);
    free(b->text);
    tl_record_cache_destroy(b->records);
    batch_queue_end(&b->queue);
    batch_cost_end_all(&b->cost);
    batch_notices_end(&b->notices);
    lighter_close(&b->with);
    job_release(&b->common);
    pthread_mutex_destroy(&b->lighting);
    pthread_mutex_destroy(&b->tally.lock);
    pthread_cond_destroy(&b->tally.changed);
}

static tl_status run(batch_command *command, const tl_item_list *items, tl_error *err)
{
    batch b = {.options = &command->batch, .items = items};
    batch_progress progress = batch_progress_begin(command->batch.progress);
    tl_status status = TL_OK;
    begin(&b);
    if (command->batch.in_flight == 0)
        command->batch.in_flight = batch_usual_in_flight();
    TRY(prepare_records(&b, command, err));
    if (command->batch.dry_run) {
        TRY(batch_plan(&b, &command->report, err));
        goto done;
    }
    TRY(prepare(&b, &command->batch.frame.lighting, err));
    b.tally.of[BATCH_LEFT] = items->count;
    console_stage(NULL);
    console_lend(&b.notices.taken);
    interrupts_listen();
    TRY(batch_run(&b, &progress, err));
    TRY(batch_report(&b, &progress, &command->report, err));
done:
    console_lend(NULL);
    end(&b);
    return status;
}

int command_batch(int argc, char **argv)
{
    batch_command command = batch_command_default();
    command.argc = argc;
    command.argv = argv;
    tl_item_list items = {.of = NULL};
    tl_error err;
    argp_parse(&batch_argp, argc, argv, 0, NULL, &command);
    tl_status status = batch_list_items(&command, &items, &err);
    if (status == TL_OK)
        status = run(&command, &items, &err);
    tl_items_clear(&items);
    batch_command_release(&command);
    const int exit_status = console_finish(status, &err);
    return interrupts_seen() ? 128 + interrupts_seen() : exit_status;
}
