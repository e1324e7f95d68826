/* What is in a capture of another program: what it would be imported as, and what it lacks. */
#include "import/plan.h"
#include "info.h"

#include <inttypes.h>
#include <stdio.h>

/* Not where no plane was found: parts may differ. */
static bool has_size(const tl_import_plan *plan)
{
    return plan->width > 0;
}

static bool is_cropped(const tl_source_part *part)
{
    return part->exr.stream && part->width > 0 && !tl_exr_part_is_uncropped(&part->exr);
}

static void print_part(const tl_source_part *part, uint32_t index)
{
    printf("part %-6u \"", index);
    info_print_text(part->name, 0);
    printf("\", %u x %u pixels", part->width, part->height);
    if (part->storage[0])
        printf(", %s, %s", part->storage, part->compression);
    if (is_cropped(part))
        printf(", data window (%d, %d) to (%d, %d) of (%d, %d) to (%d, %d)",
               part->exr.data.min.x, part->exr.data.min.y, part->exr.data.max.x,
               part->exr.data.max.y, part->exr.display.min.x, part->exr.display.min.y,
               part->exr.display.max.x, part->exr.display.max.y);
    if (part->refusal[0]) {
        fputs("\n            not read: ", stdout);
        info_print_text(part->refusal, 0);
    }
    putchar('\n');
}

/* The plane and the component that a channel of the capture becomes; false for none. */
static bool use_of(const tl_import_plan *plan, uint32_t channel, tl_import_plane *plane)
{
    for (tl_import_plane p = 0; p < TL_IMPORT_COUNT; p++) {
        const tl_binding *b = &plan->bindings[p];
        for (unsigned i = 0; b->is_bound && b->source == 0 && i < tl_import_kinds[p].numbers;
             i++)
            if (b->channels[i] == channel) {
                *plane = p;
                return true;
            }
    }
    return false;
}

void info_print_import(const tl_import_plan *plan)
{
    const tl_source *source = &plan->sources[0];
    tl_import_plane plane;
    printf("capture     %s of another program", source->format->name);
    if (has_size(plan))
        printf(", %u x %u pixels", plan->width, plan->height);
    putchar('\n');
    for (uint32_t i = 0; i < source->part_count; i++)
        print_part(&source->parts[i], i);
    printf("%-40s %-5s %4s  %s\n", "channel", "type", "part", "taken as");
    for (uint32_t i = 0; i < source->channel_count; i++) {
        const tl_source_channel *c = &source->channels[i];
        info_print_text(c->name, 40);
        printf(" %-5s %4u  %s\n", c->type, c->part,
               use_of(plan, i, &plane) ? tl_import_kinds[plane].word : "-");
    }
    for (tl_import_plane p = 0; p < TL_IMPORT_COUNT; p++) {
        const tl_alias *alias = plan->bindings[p].alias;
        if (plan->bindings[p].is_bound && alias && alias->space != TL_SPACE_AUTO)
            printf("%-11s of the space \"%s\", as %s writes \"%s\"\n", tl_import_kinds[p].word,
                   tl_import_space_words[alias->space], alias->program, alias->name);
    }
    if (!plan->camera.missing[0] && has_size(plan))
        printf("camera      lens by %s; %s%s\n", plan->camera.lens,
               plan->camera.is_placed ? "place by " : "its place is not said",
               plan->camera.place);
    fputs("missing     ", stdout);
    info_print_text(plan->missing[0] ? plan->missing : "nothing that lighting needs", 0);
    putchar('\n');
}

static json_t *part_json(const tl_source_part *part)
{
    json_t *out = json_pack("{ss s[ii] ss ss}", "name", part->name, "size", (int)part->width,
                            (int)part->height, "storage", part->storage, "compression",
                            part->compression);
    if (is_cropped(part))
        json_object_set_new(out, "data_window",
                            json_pack("[iiii]", part->exr.data.min.x, part->exr.data.min.y,
                                      part->exr.data.max.x, part->exr.data.max.y));
    if (part->refusal[0])
        json_object_set_new(out, "not_read", json_string(part->refusal));
    return out;
}

json_t *info_import_json(const tl_import_plan *plan)
{
    const tl_source *source = &plan->sources[0];
    json_t *parts = json_array(), *channels = json_array();
    tl_import_plane plane;
    for (uint32_t i = 0; i < source->part_count; i++)
        json_array_append_new(parts, part_json(&source->parts[i]));
    for (uint32_t i = 0; i < source->channel_count; i++) {
        const tl_source_channel *c = &source->channels[i];
        json_t *channel =
            json_pack("{ss ss si}", "name", c->name, "type", c->type, "part", (int)c->part);
        if (use_of(plan, i, &plane))
            json_object_set_new(channel, "plane", json_string(tl_import_kinds[plane].word));
        json_array_append_new(channels, channel);
    }
    json_t *size =
        has_size(plan) ? json_pack("[ii]", (int)plan->width, (int)plan->height) : json_null();
    return json_pack("{ss ss so so so so so}", "kind", "capture", "format",
                     source->format->name, "size", size, "parts", parts, "channels", channels,
                     "camera",
                     plan->camera.missing[0] || !has_size(plan)
                         ? json_null()
                         : json_pack("{ss sb ss}", "lens", plan->camera.lens, "is_placed",
                                     (int)plan->camera.is_placed, "place", plan->camera.place),
                     "missing", plan->missing[0] ? json_string(plan->missing) : json_null());
}
