#include "farm_needs.h"

#include <stddef.h>
#include <string.h>

/* Decimal digits at *text, which moves behind them; at most a billion, so that products fit. */
static bool read_number(const char **text, uint64_t *number)
{
    const char *start = *text;
    *number = 0;
    for (; **text >= '0' && **text <= '9'; ++*text) {
        *number = *number * 10 + (uint64_t)(**text - '0');
        if (*number > 1000000000)
            return false;
    }
    return *text > start;
}

bool tl_farm_memory(const char *text, uint64_t *mib)
{
    static const struct {
        char letter;
        uint64_t kib;
    } units[] = {
        {'K', 1}, {'M', 1024}, {'G', 1024 * 1024}, {'T', 1024 * 1024 * 1024}, {'\0', 1024}};
    const uint64_t most = 1024 * 1024;
    uint64_t number;
    if (!read_number(&text, &number) || (text[0] && text[1]))
        return false;
    for (size_t i = 0; i < sizeof units / sizeof units[0]; i++) {
        const uint64_t whole = (number * units[i].kib + 1023) / 1024;
        if (units[i].letter == text[0] && whole > 0 && whole <= most) {
            *mib = whole;
            return true;
        }
    }
    return false;
}

bool tl_farm_time(const char *text, uint64_t *seconds)
{
    /* Of the fields, without days before them and with, by how many there are. */
    static const uint64_t units[2][3][3] = {{{60}, {60, 1}, {3600, 60, 1}},
                                            {{3600}, {3600, 60}, {3600, 60, 1}}};
    const uint64_t most = 365 * 86400;
    const bool days = strchr(text, '-') != NULL;
    uint64_t fields[3], total = 0;
    size_t count = 0;
    if (days && (!read_number(&text, &total) || *text++ != '-'))
        return false;
    do {
        if (count == 3 || !read_number(&text, &fields[count++]))
            return false;
    } while (*text == ':' && *++text);
    total *= 86400;
    for (size_t i = 0; i < count; i++)
        total += fields[i] * units[days][count - 1][i];
    if (*text || text[-1] == ':' || total == 0 || total > most)
        return false;
    *seconds = total;
    return true;
}

bool tl_farm_partition(const char *text)
{
    static const char allowed[] =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.,_+-";
    return text[0] && text[strspn(text, allowed)] == '\0';
}
