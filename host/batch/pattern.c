#define _POSIX_C_SOURCE 200809L
#include "pattern.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char name_field[] = "{name}";

/* Of a run of one sign. */
static size_t run_of_sign(const char *at)
{
    return *at == '#' ? strspn(at, "#") : strspn(at, "@");
}

/* Of printf's "%d", or one with a width that has zeros in front; 0 where it is none. */
static size_t run_of_format(const char *at, unsigned long *digits)
{
    if (*at != '%')
        return 0;
    const size_t width = at[1] == '0' ? strspn(at + 1, "0123456789") : 0;
    *digits = width > 0 ? strtoul(at + 1, NULL, 10) : 0;
    if (*digits == 0)
        *digits = 1;
    return at[1 + width] == 'd' ? width + 2 : 0;
}

tl_status tl_pattern_read(const char *text, tl_pattern *out, tl_error *err)
{
    tl_pattern found = {.text = text, .before = strlen(text), .behind = strlen(text)};
    unsigned long digits = 0;
    for (const char *at = text; *at;) {
        unsigned long width;
        size_t length = run_of_format(at, &width);
        if (length == 0)
            width = length = run_of_sign(at);
        if (length == 0) {
            at++;
            continue;
        }
        found.before = (size_t)(at - text);
        found.behind = found.before + length;
        digits = width;
        at += length;
    }
    if (digits > TL_MOST_DIGITS)
        return tl_fail(err, TL_ERR_ARGUMENT, "%s: a number of %lu digits: %d at most", text,
                       digits, TL_MOST_DIGITS);
    found.digits = (unsigned)digits;
    *out = found;
    return TL_OK;
}

bool tl_pattern_has_name(const tl_pattern *pattern)
{
    return strstr(pattern->text, name_field) != NULL;
}

/* Text as it is, but for what stands for a name. */
static void put_text(FILE *to, const char *text, size_t length, const char *name)
{
    const size_t field = sizeof name_field - 1;
    for (size_t i = 0; i < length;) {
        if (name && length - i >= field && strncmp(text + i, name_field, field) == 0) {
            fputs(name, to);
            i += field;
        } else {
            fputc(text[i++], to);
        }
    }
}

tl_status tl_pattern_fill(
    const tl_pattern *pattern, int32_t frame, const char *name, char **out, tl_error *err)
{
    char *made = NULL;
    size_t size = 0;
    FILE *to = open_memstream(&made, &size);
    if (!to)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for a name");
    put_text(to, pattern->text, pattern->before, name);
    if (pattern->digits)
        fprintf(to, "%0*d", (int)pattern->digits, (int)frame);
    put_text(to, pattern->text + pattern->behind, strlen(pattern->text + pattern->behind),
             name);
    if (fclose(to) != 0 || !made) {
        free(made);
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for a name");
    }
    *out = made;
    return TL_OK;
}
