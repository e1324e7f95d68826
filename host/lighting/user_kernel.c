#include "user_kernel.h"

#include "embedded_kernels.h"
#include "frame.h"
#include "try.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What shade_tiles takes, in order. A pointer may be to a type of the user's own with the same
 * layout, so only where it points is checked. */
static const struct {
    cl_kernel_arg_address_qualifier address;
    const char *declaration;
} arguments[] = {
    {CL_KERNEL_ARG_ADDRESS_PRIVATE, "const tl_frame"},
    {CL_KERNEL_ARG_ADDRESS_GLOBAL, "__global const float *planes"},
    {CL_KERNEL_ARG_ADDRESS_GLOBAL, "__global const tl_view_light *lights"},
    {CL_KERNEL_ARG_ADDRESS_GLOBAL, "__global const uint *starts"},
    {CL_KERNEL_ARG_ADDRESS_GLOBAL, "__global const uint *ends"},
    {CL_KERNEL_ARG_ADDRESS_GLOBAL, "__global const uint *list"},
    {CL_KERNEL_ARG_ADDRESS_GLOBAL, "__global float *radiance"},
};
enum { ARGUMENT_COUNT = sizeof arguments / sizeof arguments[0] };

const char *tl_user_kernel_name(const tl_user_kernel *user)
{
    return user->file ? user->file : "the kernel's text";
}

tl_status tl_user_kernel_copy(tl_user_kernel *user, char **memory, tl_error *err)
{
    const char *file = tl_user_kernel_name(user);
    const size_t text_size = strlen(user->text) + 1, entry_size = strlen(user->entry) + 1,
                 file_size = strlen(file) + 1;
    char *copy = malloc(text_size + entry_size + file_size);
    if (!copy)
        return tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for its text", file);
    user->text = memcpy(copy, user->text, text_size);
    user->entry = memcpy(copy + text_size, user->entry, entry_size);
    user->file = memcpy(copy + text_size + entry_size, file, file_size);
    *memory = copy;
    return TL_OK;
}

typedef enum line_kind { LINE_PLAIN, LINE_INCLUDES_OURS, LINE_INCLUDES_OTHER } line_kind;

static const char *skip_blanks(const char *text)
{
    return text + strspn(text, " \t");
}

/* Of the line at `line`: whether it includes a file of kernels/, which the text follows already. */
static line_kind kind_of(const char *line)
{
    static const char include[] = "include";
    char name[64] = "", marker[80];
    line = skip_blanks(line);
    if (*line != '#')
        return LINE_PLAIN;
    line = skip_blanks(line + 1);
    if (strncmp(line, include, sizeof include - 1) != 0)
        return LINE_PLAIN;
    line = skip_blanks(line + sizeof include - 1);
    if (sscanf(line, "\"%63[^\"\n]\"", name) != 1)
        return LINE_INCLUDES_OTHER;
    snprintf(marker, sizeof marker, "#line 1 \"%s\"\n", name);
    return strstr(tl_kernel_headers, marker) ? LINE_INCLUDES_OURS : LINE_INCLUDES_OTHER;
}

/* As in a C string. */
static char *append_quoted(char *to, const char *text)
{
    for (; *text; text++) {
        if (*text == '"' || *text == '\\')
            *to++ = '\\';
        *to++ = *text;
    }
    return to;
}

/* Compiled kernels are kept by their text: what a file includes could change behind it. */
static tl_status check_includes(const char *file, const char *source, tl_error *err)
{
    unsigned number = 1;
    for (const char *line = source; *line; number++) {
        const size_t length = strcspn(line, "\n");
        if (kind_of(line) == LINE_INCLUDES_OTHER)
            return tl_fail(err, TL_ERR_FORMAT,
                           "%s:%u: `%.*s': only headers of kernels/ can be included, as "
                           "\"light.h\"; put the rest into the file itself",
                           file, number, (int)(length < 200 ? length : 200), line);
        line += length + (line[length] == '\n');
    }
    return TL_OK;
}

tl_status tl_user_kernel_text(const char *file, const char *source, char **out, tl_error *err)
{
    static const char begin[] = "\n#line 1 \"", end[] = "\"\n";
    const tl_status status = check_includes(file, source, err);
    if (status != TL_OK)
        return status;
    char *text = malloc(sizeof begin + 2 * strlen(file) + sizeof end + strlen(source));
    if (!text)
        return tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for its text", file);
    char *to = text;
    to += sprintf(to, "%s", begin);
    to = append_quoted(to, file);
    to += sprintf(to, "%s", end);
    while (*source) {
        const size_t length = strcspn(source, "\n");
        if (kind_of(source) != LINE_INCLUDES_OURS) {
            memcpy(to, source, length);
            to += length;
        }
        source += length;
        if (*source)
            *to++ = *source++;
    }
    *to = '\0';
    *out = text;
    return TL_OK;
}

/* The kernels of the program, ", " between. */
static void list_kernels(cl_program program, char *list, size_t size)
{
    char names[2048] = "";
    size_t used = 0;
    list[0] = '\0';
    if (clGetProgramInfo(program, CL_PROGRAM_KERNEL_NAMES, sizeof names, names, NULL) !=
        CL_SUCCESS)
        return;
    for (const char *name = names; *name;) {
        const size_t length = strcspn(name, ";");
        if (used + length + 3 < size)
            used += (size_t)snprintf(list + used, size - used, "%s%.*s", used ? ", " : "",
                                     (int)length, name);
        name += length + (name[length] == ';');
    }
}

tl_status tl_user_kernel_missing(cl_program program, const tl_user_kernel *user, tl_error *err)
{
    char list[1024];
    list_kernels(program, list, sizeof list);
    return tl_fail(err, TL_ERR_FORMAT, "%s: has no kernel \"%s\"; %s%s",
                   tl_user_kernel_name(user), user->entry,
                   list[0] ? "its kernels: " : "it has none at all", list);
}

static tl_status check_argument(cl_kernel kernel,
                                cl_uint index,
                                const tl_user_kernel *user,
                                tl_error *err)
{
    cl_kernel_arg_address_qualifier address = 0;
    char name[128] = "", type[128] = "";
    /* A driver need not know; then the kernel is taken at its word. */
    if (clGetKernelArgInfo(kernel, index, CL_KERNEL_ARG_ADDRESS_QUALIFIER, sizeof address,
                           &address, NULL) != CL_SUCCESS ||
        clGetKernelArgInfo(kernel, index, CL_KERNEL_ARG_TYPE_NAME, sizeof type, type, NULL) !=
            CL_SUCCESS)
        return TL_OK;
    clGetKernelArgInfo(kernel, index, CL_KERNEL_ARG_NAME, sizeof name, name, NULL);
    const bool wants_pointer = arguments[index].address == CL_KERNEL_ARG_ADDRESS_GLOBAL;
    if (address == arguments[index].address && (strchr(type, '*') != NULL) == wants_pointer)
        return TL_OK;
    return tl_fail(err, TL_ERR_FORMAT,
                   "%s: kernel \"%s\": argument %u, %s %s, must be `%s'; docs/your-kernel.md "
                   "describes them all",
                   tl_user_kernel_name(user), user->entry, index + 1, type, name,
                   arguments[index].declaration);
}

tl_status tl_user_kernel_check_arguments(cl_kernel kernel,
                                         const tl_user_kernel *user,
                                         tl_error *err)
{
    tl_status status = TL_OK;
    const tl_frame frame = {0};
    cl_uint count = 0;
    clGetKernelInfo(kernel, CL_KERNEL_NUM_ARGS, sizeof count, &count, NULL);
    if (count != ARGUMENT_COUNT)
        TRY(tl_fail(err, TL_ERR_FORMAT,
                    "%s: kernel \"%s\" takes %u argument%s; a shading kernel takes %d, which "
                    "docs/your-kernel.md describes",
                    tl_user_kernel_name(user), user->entry, count, count == 1 ? "" : "s",
                    ARGUMENT_COUNT));
    for (cl_uint i = 0; i < ARGUMENT_COUNT; i++)
        TRY(check_argument(kernel, i, user, err));
    if (clSetKernelArg(kernel, 0, sizeof frame, &frame) != CL_SUCCESS)
        TRY(tl_fail(err, TL_ERR_FORMAT,
                    "%s: kernel \"%s\": argument 1 must be `%s', a structure of %zu bytes",
                    tl_user_kernel_name(user), user->entry, arguments[0].declaration,
                    sizeof frame));
done:
    return status;
}

tl_status tl_user_kernel_check_group(const tl_device *device,
                                     cl_kernel kernel,
                                     const tl_user_kernel *user,
                                     size_t items,
                                     tl_error *err)
{
    size_t most = items, fixed[3] = {0, 0, 0};
    clGetKernelWorkGroupInfo(kernel, device->id, CL_KERNEL_WORK_GROUP_SIZE, sizeof most, &most,
                             NULL);
    clGetKernelWorkGroupInfo(kernel, device->id, CL_KERNEL_COMPILE_WORK_GROUP_SIZE,
                             sizeof fixed, fixed, NULL);
    if (fixed[0] != 0 && (fixed[0] != items || fixed[1] != 1 || fixed[2] != 1))
        return tl_fail(err, TL_ERR_ARGUMENT,
                       "%s: kernel \"%s\" asks for work-groups of %zu x %zu x %zu; it is run "
                       "in groups of %zu x 1 x 1",
                       tl_user_kernel_name(user), user->entry, fixed[0], fixed[1], fixed[2],
                       items);
    if (items > most)
        return tl_fail(err, TL_ERR_ARGUMENT,
                       "%s: kernel \"%s\" runs in work-groups of at most %zu on %s, and a tile "
                       "has %zu pixels: use smaller tiles (--tile)",
                       tl_user_kernel_name(user), user->entry, most, device->info.name, items);
    return TL_OK;
}
