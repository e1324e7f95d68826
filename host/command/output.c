#define _POSIX_C_SOURCE 200809L
#include "output.h"

#include "atomic_file.h"
#include "try.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

/* By the end of a name, or by the whole of it. */
static const struct {
    int kind;
    const char *suffix, *name, *says;
} kinds[] = {
    {OUTPUT_PNG, ".png", NULL, ".png"},
    {OUTPUT_EXR, ".exr", NULL, ".exr"},
    {OUTPUT_PFM, ".pfm", NULL, ".pfm"},
    {OUTPUT_JSON, ".json", NULL, ".json"},
    {OUTPUT_STANDARD, NULL, "-", "- (standard output)"},
    {OUTPUT_STANDARD_PFM, NULL, "pfm:-", "pfm:- (the same as PFM)"},
};
enum { KIND_COUNT = sizeof kinds / sizeof kinds[0] };

static bool has_suffix(const char *path, const char *suffix)
{
    const size_t length = strlen(path), end = strlen(suffix);
    return length > end && strcasecmp(path + length - end, suffix) == 0 &&
           path[length - end - 1] != '/';
}

int output_kind_of(const char *path, int accepted)
{
    for (size_t i = 0; i < KIND_COUNT; i++)
        if ((kinds[i].kind & accepted) && (kinds[i].name ? strcmp(path, kinds[i].name) == 0
                                                         : has_suffix(path, kinds[i].suffix)))
            return kinds[i].kind;
    return 0;
}

int output_kind(struct argp_state *state, const char *option, const char *path, int accepted)
{
    char list[128] = "";
    const int kind = output_kind_of(path, accepted);
    if (kind)
        return kind;
    for (size_t i = 0, used = 0; i < KIND_COUNT; i++)
        if (kinds[i].kind & accepted)
            used += (size_t)snprintf(list + used, sizeof list - used, "%s%s", used ? ", " : "",
                                     kinds[i].says);
    argp_error(state, "%s: cannot tell what to write from \"%s\"; end it in %s", option, path,
               list);
    return 0;
}

tl_status output_check(const char *path, const char *input, tl_error *err)
{
    tl_status status = TL_OK;
    struct stat in, out;
    tl_atomic_file trial = {0};

    if (strcmp(path, "-") == 0)
        goto done;
    if (input && stat(input, &in) == 0 && stat(path, &out) == 0 && in.st_dev == out.st_dev &&
        in.st_ino == out.st_ino)
        TRY(tl_fail(err, TL_ERR_ARGUMENT, "%s: the output is the input; choose another name",
                    path));
    TRY(tl_atomic_file_begin(&trial, path, err));
done:
    tl_atomic_file_abandon(&trial);
    return status;
}
