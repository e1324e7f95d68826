/* Manifests of batches: does any text do more than be refused? What is listed has what it is read from and
 * written to, and no output twice. */
#include "fuzz.h"

#include "item_list.h"

#include <string.h>

static void must_be_whole(const tl_item_list *list)
{
    fuzz_must(list->count > 0 && list->count == list->all_count, "%zu items of %zu",
              list->count, list->all_count);
    for (size_t i = 0; i < list->count; i++) {
        const tl_item *item = &list->of[i];
        fuzz_must(item->input[0] && item->output_count > 0, "item %zu lacks something", i);
        fuzz_must(!strchr(item->name, '/'), "a name with a folder: %s", item->name);
        for (size_t k = 0; k < item->output_count; k++)
            fuzz_must(item->outputs[k][0] && strcmp(item->outputs[k], item->input) != 0,
                      "%s is written over", item->input);
        if (i > 0 && i < 100)
            fuzz_must(strcmp(item->outputs[0], list->of[i - 1].outputs[0]) != 0, "%s twice",
                      item->outputs[0]);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char *const pattern = "o/{name}.####.png";
    for (size_t given = 0; given <= 1; given++) {
        const tl_batch_request request = {.manifest = fuzz_file(data, size),
                                          .outputs = &pattern,
                                          .output_count = given,
                                          .lights = "l.json"};
        tl_error err = {.status = TL_OK};
        tl_item_list list = {.of = NULL};
        const tl_status status = tl_items_list(&request, &list, &err);
        if (status == TL_OK)
            must_be_whole(&list);
        else if (status == TL_ERR_FORMAT)
            fuzz_must_tell(status, &err, request.manifest);
        else
            fuzz_must(status == TL_ERR_ARGUMENT && err.message[0], "status %d: %s", (int)status,
                      err.message);
        tl_items_clear(&list);
    }
    return 0;
}
