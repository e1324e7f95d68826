#include "kernel_program.h"

#include "embedded_kernels.h"
#include "layout.h"
#include "try.h"
#include "user_kernel.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_FLAGS = 2048, MAX_PROGRAMS = 32 };

struct tl_programs {
    tl_program of[MAX_PROGRAMS];
    uint64_t asked_at[MAX_PROGRAMS]; /* which of all askings was the last for it */
    uint64_t askings;
    int count;
};

void tl_kernel_flags(const tl_kernel_options *options, char *text, size_t size)
{
    size_t length = 0;
#define FLAG(macro, field)                                                            \
    if (length < size)                                                                \
        length += (size_t)snprintf(text + length, size - length, " -D " #macro "=%u", \
                                   options->field);
    TL_KERNEL_OPTIONS(FLAG)
#undef FLAG
#define FLAG(name, flag, word, usual, rows, kind, kinds, meaning)                    \
    if (length < size)                                                               \
        length += (size_t)snprintf(text + length, size - length, " -D " #flag "=%u", \
                                   options->approximations.of[name]);
    TL_KNOBS(FLAG)
#undef FLAG
}

/* No -cl-fast-relaxed-math: the error bounds in kernels/ assume IEEE arithmetic, and culling hangs on it;
 * what may be loosened, dialect.h encloses. */
static void format_flags(const tl_device *device, const tl_program *made, char flags[MAX_FLAGS])
{
    const int length =
        snprintf(flags, MAX_FLAGS, "-cl-std=CL1.2 -w%s%s",
                 device->rounds_divide ? " -cl-fp32-correctly-rounded-divide-sqrt" : "",
                 made->user.text ? " -cl-kernel-arg-info" : ""); /* to check them */
    tl_kernel_flags(&made->options, flags + length, (size_t)(MAX_FLAGS - length));
}

/* Of what ends a log. */
static void cut_end(char *log)
{
    size_t length = strlen(log);
    while (length > 0 && log[length - 1] == '\n')
        log[--length] = '\0';
}

static tl_status fail_with_log(const tl_device *device, const tl_program *made, tl_error *err)
{
    static const char unavailable[] = "(no log)";
    size_t size = 0;
    clGetProgramBuildInfo(made->program, device->id, CL_PROGRAM_BUILD_LOG, 0, NULL, &size);
    char *log = size ? malloc(size) : NULL;
    if (log)
        clGetProgramBuildInfo(made->program, device->id, CL_PROGRAM_BUILD_LOG, size, log, NULL);
    if (log)
        cut_end(log);
    const char *file = tl_user_kernel_name(&made->user);
    const tl_status status =
        made->user.text ? tl_fail(err, TL_ERR_FORMAT, "%s: does not compile on %s:\n%s", file,
                                  device->info.name, log ? log : unavailable)
                        : tl_fail(err, TL_ERR_DEVICE, "the kernels do not compile on %s:\n%s",
                                  device->info.name, log ? log : unavailable);
    free(log);
    return status;
}

/* Ours, or for shading the user's. */
static const char *text_of(const tl_program *made)
{
    /* clang-format off */
    static const char *const texts[TL_PART_COUNT] = {
        [TL_PART_CULL] = tl_cull_kernels,
        [TL_PART_OCCLUDE] = tl_occlude_kernels,
        [TL_PART_SHADE] = tl_shade_kernels,
        [TL_PART_BLEND] = tl_blend_kernel,
        [TL_PART_MEND] = tl_mend_kernels,
        [TL_PART_EDGES] = tl_edge_kernels,
        [TL_PART_BLOOM] = tl_bloom_kernels,
        [TL_PART_FINAL] = tl_final_kernels,
    };
    /* clang-format on */
    return made->user.text ? made->user.text : texts[made->part];
}

/* What a kernel is called in the text. */
static const char *name_of(const tl_program *made, const char *name)
{
    return made->user.text && strcmp(name, "shade_tiles") == 0 ? made->user.entry : name;
}

static tl_status check_kernel(cl_int code,
                              const tl_program *made,
                              const char *name,
                              tl_error *err)
{
    if (code == CL_INVALID_KERNEL_NAME && made->user.text)
        return tl_user_kernel_missing(made->program, &made->user, err);
    return tl_cl(code, name, err);
}

static tl_status create_kernels(const tl_device *device, tl_program *made, tl_error *err)
{
    const tl_kernel_options *options = &made->options;
    const int has_double = device->info.has_double;
    tl_status status = TL_OK;
    cl_int code;
#define CREATE(name, its_part, is_there)                                         \
    if (made->part == its_part && (is_there)) {                                  \
        made->name = clCreateKernel(made->program, name_of(made, #name), &code); \
        TRY(check_kernel(code, made, #name, err));                               \
    }
    TL_KERNELS(CREATE)
#undef CREATE
    if (made->user.text)
        TRY(tl_user_kernel_check_arguments(made->shade_tiles, &made->user, err));
done:
    return status;
}

/* Of the driver's objects. Accepts one that is all zero. */
static void release_program(tl_program *program)
{
#define RELEASE(name, its_part, is_there) \
    if (program->name)                    \
        clReleaseKernel(program->name);   \
    program->name = NULL;
    TL_KERNELS(RELEASE)
#undef RELEASE
    if (program->program)
        clReleaseProgram(program->program);
    program->program = NULL;
}

/* Accepts one that is all zero, and leaves it so. */
static void release(tl_program *program)
{
    release_program(program);
    if (program->keeper)
        tl_keeper_release(program->keeper);
    free(program->keeper);
    free(program->user_memory);
    *program = (tl_program){0};
}

typedef struct program_source {
    const char *texts[2];
    char flags[MAX_FLAGS];
} program_source;

static program_source source_of(const tl_device *device, const tl_program *made)
{
    program_source source = {.texts = {tl_kernel_headers, text_of(made)}};
    format_flags(device, made, source.flags);
    return source;
}

static tl_status compile(const tl_device *device,
                         const program_source *source,
                         tl_program *made,
                         tl_error *err)
{
    const char *texts[] = {source->texts[0], source->texts[1]};
    cl_int code;
    made->program = clCreateProgramWithSource(device->context, 2, texts, NULL, &code);
    if (code != CL_SUCCESS)
        return tl_cl(code, "clCreateProgramWithSource", err);
    if (clBuildProgram(made->program, 1, &device->id, source->flags, NULL, NULL) != CL_SUCCESS)
        return fail_with_log(device, made, err);
    return TL_OK;
}

static tl_status build(const tl_device *device, tl_program *made, tl_error *err)
{
    const program_source source = source_of(device, made);
    tl_status status = TL_OK;

    made->keeper = calloc(1, sizeof *made->keeper);
    if (!made->keeper)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for a kernel program"));
    tl_keeper_begin(made->keeper, device, source.texts, 2, source.flags);
    made->program = tl_keeper_load(made->keeper, device, source.flags);
    if (made->program && create_kernels(device, made, err) == TL_OK)
        goto done;
    release_program(made);
    tl_keeper_reject(made->keeper); /* for want of a kernel; or there was none */
    TRY(compile(device, &source, made, err));
    TRY(create_kernels(device, made, err));
done:
    if (status != TL_OK)
        release(made);
    return status;
}

void tl_program_note_launch(const tl_program *program,
                            cl_kernel kernel,
                            size_t items,
                            size_t group)
{
#define HANDLE(name, its_part, is_there) program->name,
    const cl_kernel kernels[] = {TL_KERNELS(HANDLE)};
#undef HANDLE
    for (uint32_t i = 0; i < sizeof kernels / sizeof kernels[0]; i++)
        if (kernels[i] == kernel)
            tl_keeper_note_launch(program->keeper, i, items, group);
}

int tl_program_keep(const tl_device *device, const tl_program *program)
{
    tl_program anew = {
        .part = program->part, .options = program->options, .user = program->user};
    if (!tl_keeper_has_news(program->keeper)) {
        tl_keeper_keep(program->keeper, NULL);
        return 0;
    }
    if (!program->keeper->is_loaded) {
        tl_keeper_keep(program->keeper, program->program);
        return 1;
    }
    /* A program that came from a binary gives that binary back, without what was compiled since.
     * Built from source it finds all of that in the driver's folder: little is left to compile. */
    const program_source source = source_of(device, program);
    if (compile(device, &source, &anew, NULL) == TL_OK)
        tl_keeper_keep(program->keeper, anew.program);
    release(&anew);
    return 1;
}

/* Where the next program goes; the one that was asked for longest ago gives way. */
static int free_slot(struct tl_programs *programs)
{
    int slot = 0;
    if (programs->count < MAX_PROGRAMS)
        return programs->count++;
    for (int i = 1; i < MAX_PROGRAMS; i++)
        if (programs->asked_at[i] < programs->asked_at[slot])
            slot = i;
    release(&programs->of[slot]);
    return slot;
}

static int is_same(const tl_program *a, const tl_program *b)
{
    if (a->part != b->part || memcmp(&a->options, &b->options, sizeof a->options) != 0)
        return 0;
    if (!a->user.text || !b->user.text)
        return a->user.text == b->user.text;
    return strcmp(a->user.text, b->user.text) == 0 &&
           strcmp(a->user.entry, b->user.entry) == 0 && a->user.items == b->user.items;
}

/* Culling reads where surfaces are, and nothing else of them: planes that move no word of that may as
 * well be absent. */
static uint32_t present_to_cull(uint32_t layout, uint32_t present)
{
    const tl_layout *row = &tl_layouts[layout];
    uint32_t before = 0;
    for (tl_u32 i = 0; i < TL_MAX_WORDS; i++)
        if (row->words[i].planes & (1u << TL_DEPTH))
            before = i + 1;
    uint32_t needed = TL_GROUP_BASE & present;
    for (tl_u32 i = 0; i < before; i++)
        if (word_bytes(row, present, i) != word_bytes(row, needed, i))
            needed = present;
    return needed;
}

/* Surroundings and edges are made of depths and normals. */
static tl_kernel_options options_to_occlude(const tl_kernel_options *o)
{
    return (tl_kernel_options){.width = o->width,
                               .by_pixel = o->by_pixel,
                               .real_double = o->real_double,
                               .orthographic = o->orthographic,
                               .layout = o->layout,
                               .present = o->present,
                               .surroundings = o->surroundings,
                               .window = o->window};
}

static tl_kernel_options options_of(tl_program_part part, const tl_kernel_options *o)
{
    if (part == TL_PART_SHADE)
        return *o;
    if (part == TL_PART_OCCLUDE || part == TL_PART_EDGES)
        return options_to_occlude(o);
    if (part >= TL_PART_BLEND) /* what knows nothing of a G-buffer */
        return (tl_kernel_options){.width = o->width,
                                   .by_pixel = o->by_pixel,
                                   .real_double = o->real_double,
                                   .split = part == TL_PART_BLEND ? o->split : 0};
    return (tl_kernel_options){.width = o->width,
                               .by_pixel = o->by_pixel,
                               .real_double = o->real_double,
                               .orthographic = o->orthographic,
                               .layout = o->layout,
                               .present = present_to_cull(o->layout, o->present),
                               .spots = o->spots,
                               .window = o->window};
}

tl_status tl_program_find(tl_device *device,
                          tl_program_part part,
                          const tl_kernel_options *options,
                          const tl_user_kernel *user,
                          const tl_program **out,
                          tl_error *err)
{
    tl_program built = {.part = part, .options = options_of(part, options)};
    if (user && part == TL_PART_SHADE)
        built.user = *user;
    if (!device->programs)
        device->programs = calloc(1, sizeof *device->programs);
    struct tl_programs *programs = device->programs;
    if (!programs)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for kernel programs");
    for (int i = 0; i < programs->count; i++)
        if (is_same(&programs->of[i], &built)) {
            programs->asked_at[i] = ++programs->askings;
            *out = &programs->of[i];
            return TL_OK;
        }
    tl_status status = build(device, &built, err);
    if (status == TL_OK && built.user.text)
        status = tl_user_kernel_copy(&built.user, &built.user_memory, err);
    if (status != TL_OK) {
        release(&built);
        return status;
    }
    const int slot = free_slot(programs);
    programs->of[slot] = built;
    programs->asked_at[slot] = ++programs->askings;
    *out = &programs->of[slot];
    return TL_OK;
}

void tl_programs_release(struct tl_programs *programs)
{
    if (!programs)
        return;
    for (int i = 0; i < programs->count; i++)
        release(&programs->of[i]);
    free(programs);
}
