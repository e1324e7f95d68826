/* What `tilelight batch` takes, for `tilelight farm` too. */
#ifndef TL_BATCH_OPTIONS_H
#define TL_BATCH_OPTIONS_H

#include "batch_state.h"
#include "report_options.h"

#include <argp.h>

typedef struct batch_command {
    batch_options batch;
    report_options report;
    int argc;
    char **argv;         /* of `batch`; NULL: of another command, whose frames are never lit */
    const char **inputs; /* [input_count], owned */
    size_t input_count;
} batch_command;

batch_command batch_command_default(void);

/* Its input is a batch_command, the default to begin with. */
extern const struct argp batch_argp;

/* What is asked for, item by item. Fails as tl_items_list and batch_items_check do; *items is the caller's to
 * clear either way. */
tl_status batch_list_items(const batch_command *command, tl_item_list *items, tl_error *err);

void batch_command_release(batch_command *command);

#endif
