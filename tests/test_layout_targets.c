/* Are the render targets of each layout the memory that its words are read from? */
#include "testing.h"

#include "layout.h"

#include "tilelight/layouts.h"

/* What the channels of a format are; `bits` of one, 0: any, the shader packs them. */
static const struct {
    enum tl_number number;
    uint32_t bits, first_alpha; /* bits of the channels before the one of another size */
} channels[TL_FORMAT_COUNT] = {
    [TL_FORMAT_RGBA32F] = {TL_NUMBER_FLOAT, 32, 0},
    [TL_FORMAT_R32F] = {TL_NUMBER_FLOAT, 32, 0},
    [TL_FORMAT_RGBA16F] = {TL_NUMBER_HALF, 16, 0},
    [TL_FORMAT_RG16F] = {TL_NUMBER_HALF, 16, 0},
    [TL_FORMAT_R16F] = {TL_NUMBER_HALF, 16, 0},
    [TL_FORMAT_RGBA8] = {TL_NUMBER_UNORM, 8, 0},
    [TL_FORMAT_RGBA8_SNORM] = {TL_NUMBER_SNORM, 8, 0},
    [TL_FORMAT_RGB10_A2] = {TL_NUMBER_UNORM, 10, 30},
    [TL_FORMAT_RG8] = {TL_NUMBER_UNORM, 8, 0},
    [TL_FORMAT_R32UI] = {TL_NUMBER_COUNT, 0, 0},
    [TL_FORMAT_D24] = {TL_NUMBER_UNORM, 24, 0},
    [TL_FORMAT_D32F] = {TL_NUMBER_FLOAT, 32, 0},
};

static uint32_t bytes_of(const tl_layout *layout, const tl_target *target)
{
    uint32_t bytes = 0;
    for (uint32_t i = 0; i < target->word_count; i++)
        bytes += layout->words[target->first_word + i].bytes;
    return bytes;
}

/* Each word in one target, in order; a texel is its words and at most one channel beyond. */
static void words_are_covered_once(void **state)
{
    (void)state;
    for (int i = 0; i < TL_LAYOUT_COUNT; i++) {
        const tl_layout *layout = &tl_layouts[i];
        const tl_layout_info *info = tl_layout_describe((enum tl_layout_name)i);
        uint32_t next = 0;
        assert_in_range(info->target_count, 1, TL_MAX_TARGETS);
        assert_true(strlen(info->source) > 0 && strlen(info->summary) > 0);
        for (uint32_t t = 0; t < info->target_count; t++) {
            const tl_target *target = &info->targets[t];
            const tl_format_row *format = tl_format_describe(target->format);
            const uint32_t bytes = bytes_of(layout, target);
            const uint32_t channel =
                format->channels > 1 ? format->bytes / format->channels : 0;
            if (target->first_word != next || bytes > format->bytes ||
                bytes + channel < format->bytes)
                fail_msg("%s: target %u (%s): words %u to %u, %u bytes",
                         tl_layout_word((enum tl_layout_name)i), t, format->word,
                         target->first_word, target->first_word + target->word_count, bytes);
            next += target->word_count;
        }
        assert_int_equal(next, layout->word_count);
    }
}

/* Where a channel stands in the texel of its target, in bits. */
static uint32_t place_of(const tl_layout *layout, const tl_target *target, tl_channel c)
{
    uint32_t place = c.shift;
    for (uint32_t i = target->first_word; i < c.word; i++)
        place += 8 * layout->words[i].bytes;
    return place;
}

static void check_channel(enum tl_layout_name name, tl_channel c)
{
    const tl_layout_info *info = tl_layout_describe(name);
    const tl_target *target = info->targets;
    while (c.word >= target->first_word + target->word_count)
        target++;
    const enum tl_format format = target->format;
    const uint32_t place = place_of(&tl_layouts[name], target, c);
    if (format == TL_FORMAT_R32UI)
        return;
    if (format == TL_FORMAT_RGBA8 && c.number == TL_NUMBER_BYTES24) {
        assert_int_equal(place, 0); /* red, green, blue */
        return;
    }
    if (c.number != channels[format].number || c.bits != channels[format].bits ||
        place % c.bits != 0 ||
        (channels[format].first_alpha && place >= channels[format].first_alpha))
        fail_msg("%s: bits %u to %u of word %u do not suit %s", tl_layout_word(name), c.shift,
                 c.shift + c.bits, c.word, tl_format_describe(format)->word);
}

static void numbers_are_the_formats(void **state)
{
    (void)state;
    for (int i = 0; i < TL_LAYOUT_COUNT; i++) {
        const tl_layout *l = &tl_layouts[i];
        const tl_attribute attributes[] = {l->depth,     l->normal,    l->albedo,
                                           l->specular,  l->shininess, l->metallic,
                                           l->roughness, l->occlusion, l->emissive};
        for (size_t a = 0; a < COUNT_OF(attributes); a++)
            for (int c = 0; attributes[a].code && c < 3; c++)
                if (attributes[a].channels[c].bits)
                    check_channel((enum tl_layout_name)i, attributes[a].channels[c]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(words_are_covered_once),
        cmocka_unit_test(numbers_are_the_formats),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
