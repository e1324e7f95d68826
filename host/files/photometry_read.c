/* Files of LM-63: lines of words up to TILT=, numbers behind it. */
#define _POSIX_C_SOURCE 200809L
#include "tilelight/photometry.h"

#include "largest.h"
#include "printable.h"
#include "try.h"

#include <locale.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_TILTS = 1000, LONGEST_NUMBER = 40 };

/* Where reading stands. */
typedef struct ies_reader {
    const char *source, *at, *end;
    unsigned long line; /* that `at` is on, from 1 */
    tl_photometry made;
} ies_reader;

#define REFUSE(r, ...) refuse(r, TL_ERR_FORMAT, err, __VA_ARGS__)

static tl_status TL_PRINTF_LIKE(4, 5)
    refuse(const ies_reader *r, tl_status status, tl_error *err, const char *format, ...)
{
    char reason[512];
    va_list args;
    va_start(args, format);
    vsnprintf(reason, sizeof reason, format, args);
    va_end(args);
    return tl_fail(err, status, "%s: line %lu: %s", r->source, r->line, reason);
}

/* The rest of the line, which reading goes on behind; 0 where there is none. Lines end by LF, CR LF or CR. */
static int next_line(ies_reader *r, const char **text, size_t *length)
{
    if (r->at == r->end)
        return 0;
    *text = r->at;
    while (r->at < r->end && *r->at != '\n' && *r->at != '\r')
        r->at++;
    *length = (size_t)(r->at - *text);
    if (r->end - r->at > 1 && r->at[0] == '\r' && r->at[1] == '\n')
        r->at++;
    r->at += r->at < r->end;
    r->line++;
    return 1;
}

/* What a line is shown as in a sentence. */
static void show(const char *text, size_t length, char out[48])
{
    const size_t shown = length < 40 ? length : 40;
    for (size_t i = 0; i < shown; i++)
        out[i] = tl_printable(text[i]);
    out[shown] = '\0';
    while (shown > 0 && out[strlen(out) - 1] == ' ')
        out[strlen(out) - 1] = '\0';
}

static int begins(const char *text, size_t length, const char *with)
{
    const size_t size = strlen(with);
    return length >= size && memcmp(text, with, size) == 0;
}

/* The first line says which edition it is, but of the first, which began with a label. */
static tl_status read_edition(ies_reader *r, const char *text, size_t length, tl_error *err)
{
    static const char *const lines[TL_IES_EDITION_COUNT] = {
#define LINE(name, line, word) [name] = line,
        TL_IES_EDITIONS(LINE)
#undef LINE
    };
    char shown[48];
    for (int i = 1; i < TL_IES_EDITION_COUNT; i++)
        if (begins(text, length, lines[i])) {
            r->made.edition = (tl_ies_edition)i;
            return TL_OK;
        }
    show(text, length, shown);
    r->line--;
    if (begins(text, length, "IESNA") || begins(text, length, "IES:"))
        return refuse(r, TL_ERR_UNSUPPORTED, err,
                      "is of an edition \"%s\" that is not known; the last that is is %s",
                      shown, lines[TL_IES_2019]);
    r->line++;
    r->made.edition = TL_IES_1986;
    return TL_OK;
}

/* One number, behind white space or commas. `what` is what is expected. */
static tl_status read_number(
    ies_reader *r, const char *what, double least, double most, double *out, tl_error *err)
{
    char text[LONGEST_NUMBER + 1], *end = NULL;
    size_t length = 0;
    while (r->at < r->end && strchr(" \t\v\f,\n\r", *r->at) && *r->at) {
        r->line +=
            *r->at == '\n' || (*r->at == '\r' && (r->at + 1 == r->end || r->at[1] != '\n'));
        r->at++;
    }
    while (r->at + length < r->end && length <= LONGEST_NUMBER && r->at[length] &&
           strchr("0123456789+-.eE", r->at[length]))
        length++;
    memcpy(text, r->at, length < sizeof text ? length : sizeof text - 1);
    text[length < sizeof text ? length : sizeof text - 1] = '\0';
    *out = strtod(text, &end);
    const int is_last =
        r->at + length == r->end || !r->at[length] || strchr(" \t\v\f,\n\r\x1a", r->at[length]);
    if (r->at == r->end)
        return REFUSE(r, "the file ends where %s is expected", what);
    if (length == 0 || end == text || *end || !is_last) {
        char shown[48];
        size_t word = 0;
        while (r->at + word < r->end && (unsigned char)r->at[word] > ' ')
            word++;
        show(r->at, word, shown);
        return REFUSE(r, "%s is expected, a number, in place of \"%s\"", what, shown);
    }
    if (!(*out >= least && *out <= most))
        return REFUSE(r, "%s is %s, it must be from %g to %g", what, text, least, most);
    r->at += length;
    return TL_OK;
}

static tl_status read_count(
    ies_reader *r, const char *what, size_t least, size_t most, size_t *out, tl_error *err)
{
    double number = 0.0;
    const tl_status status = read_number(r, what, (double)least, (double)most, &number, err);
    if (status != TL_OK)
        return status;
    if (number < floor(number) || number > floor(number))
        return REFUSE(r, "%s is %g, it must be a whole number", what, number);
    *out = (size_t)number;
    return TL_OK;
}

/* How lamps dim as they are tilted: read, and of no effect, for a luminaire is measured as it hangs. */
static tl_status read_tilt(ies_reader *r, tl_error *err)
{
    tl_status status = TL_OK;
    size_t geometry = 0, count = 0;
    double ignored = 0.0;
    TRY(read_count(r, "the lamp-to-luminaire geometry", 1, 3, &geometry, err));
    TRY(read_count(r, "the number of tilt angles", 1, MOST_TILTS, &count, err));
    for (size_t i = 0; i < count; i++)
        TRY(read_number(r, "a tilt angle", -180.0, 180.0, &ignored, err));
    for (size_t i = 0; i < count; i++)
        TRY(read_number(r, "a tilt factor", 0.0, 1e6, &ignored, err));
done:
    return status;
}

/* Up to TILT=, and what that says. */
static tl_status read_words(ies_reader *r, tl_error *err)
{
    const char *text = NULL;
    size_t length = 0;
    char shown[48];
    tl_status status = TL_OK;
    if (!next_line(r, &text, &length))
        return REFUSE(r, "the file is empty");
    TRY(read_edition(r, text, length, err));
    while (!begins(text, length, "TILT="))
        if (!next_line(r, &text, &length))
            return REFUSE(r, "the file ends without a line TILT=");
    show(text + 5, length - 5, shown);
    if (strcmp(shown, "INCLUDE") == 0)
        return read_tilt(r, err);
    if (strcmp(shown, "NONE") == 0)
        return TL_OK;
    r->line--;
    return refuse(r, TL_ERR_UNSUPPORTED, err,
                  "TILT=%s is another file; NONE and INCLUDE are taken", shown);
done:
    return status;
}

static tl_status check_type(ies_reader *r, size_t type, tl_error *err)
{
    static const char *const types[] = {"", "C", "B", "A"};
    if (type == 1)
        return TL_OK;
    return refuse(r, TL_ERR_UNSUPPORTED, err,
                  "photometric type %zu, type %s, has other angles; type C (1) alone is taken",
                  type, types[type]);
}

/* Lamps, multiplier, counts, and both lines of what else there is. */
static tl_status read_head(ies_reader *r, tl_error *err)
{
    tl_photometry *const p = &r->made;
    double lamps = 0.0, lumens = 0.0, multiplier = 0.0, ballast = 0.0, lamp_factor = 0.0;
    double ignored = 0.0;
    size_t type = 0, units = 0;
    tl_status status = TL_OK;
    TRY(read_number(r, "the number of lamps", 1.0, 1e6, &lamps, err));
    TRY(read_number(r, "the lumens of a lamp", -1.0, 1e12, &lumens, err));
    TRY(read_number(r, "the candela multiplier", 1e-12, 1e12, &multiplier, err));
    TRY(read_count(r, "the number of vertical angles", 2, TL_MOST_PHOTOMETRY_ANGLES,
                   &p->vertical_count, err));
    TRY(read_count(r, "the number of horizontal angles", 1, TL_MOST_PHOTOMETRY_ANGLES,
                   &p->horizontal_count, err));
    TRY(read_count(r, "the photometric type", 1, 3, &type, err));
    TRY(check_type(r, type, err));
    TRY(read_count(r, "the type of units", 1, 2, &units, err));
    TRY(read_number(r, "the width of the opening", -1e6, 1e6, &ignored, err));
    TRY(read_number(r, "the length of the opening", -1e6, 1e6, &ignored, err));
    TRY(read_number(r, "the height of the opening", -1e6, 1e6, &ignored, err));
    TRY(read_number(r, "the ballast factor", 1e-12, 1e12, &ballast, err));
    TRY(read_number(r, "the ballast-lamp factor", -1e12, 1e12, &lamp_factor, err));
    TRY(read_number(r, "the input watts", 0.0, 1e12, &ignored, err));
    /* The editions of 1986 and 1991 multiply with it; later ones keep the place for other things. */
    p->factor = multiplier * ballast * (p->edition <= TL_IES_1991 ? lamp_factor : 1.0);
    if (!(p->factor > 0.0))
        TRY(REFUSE(r, "the ballast-lamp factor is %g, it must be above 0", lamp_factor));
    p->lamp_lumens = lumens < 0.0 ? -1.0 : lamps * lumens;
done:
    return status;
}

static tl_status read_angles(
    ies_reader *r, const char *what, double most, size_t count, double **out, tl_error *err)
{
    tl_status status = TL_OK;
    double *const angles = *out = malloc(count * sizeof *angles);
    if (!angles)
        TRY(tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for its angles", r->source));
    for (size_t i = 0; i < count; i++) {
        TRY(read_number(r, what, 0.0, most, &angles[i], err));
        if (i > 0 && !(angles[i] > angles[i - 1]))
            TRY(REFUSE(r, "%s is %g behind %g; they must ascend", what, angles[i],
                       angles[i - 1]));
    }
done:
    return status;
}

static int is(double a, double b)
{
    return a >= b && a <= b;
}

static tl_status check_vertical(ies_reader *r, tl_error *err)
{
    const double first = r->made.vertical[0],
                 last = r->made.vertical[r->made.vertical_count - 1];
    if ((is(first, 0.0) && (is(last, 90.0) || is(last, 180.0))) ||
        (is(first, 90.0) && is(last, 180.0)))
        return TL_OK;
    return REFUSE(r,
                  "vertical angles are from %g to %g; of type C they are from 0 to 90, from 90 "
                  "to 180 or from 0 to 180",
                  first, last);
}

static tl_status find_symmetry(ies_reader *r, tl_error *err)
{
    const double first = r->made.horizontal[0],
                 last = r->made.horizontal[r->made.horizontal_count - 1];
    tl_photometry_symmetry *const out = &r->made.symmetry;
    if (r->made.horizontal_count == 1 && is(first, 0.0))
        *out = TL_SYMMETRY_AXIAL;
    else if (is(first, 0.0) && is(last, 90.0))
        *out = TL_SYMMETRY_QUADRANT;
    else if (is(first, 0.0) && is(last, 180.0))
        *out = TL_SYMMETRY_ALONG;
    else if (is(first, 90.0) && is(last, 270.0))
        *out = TL_SYMMETRY_ACROSS;
    else if (is(first, 0.0) && last > 180.0)
        *out = TL_SYMMETRY_NONE;
    else
        return REFUSE(
            r,
            "horizontal angles are from %g to %g; of type C they are 0 alone, or from "
            "0 to 90, to 180 or to 360, or from 90 to 270",
            first, last);
    return TL_OK;
}

/* The plane at 360 degrees is that at 0. */
static void close_circle(tl_photometry *p)
{
    const size_t last = p->horizontal_count - 1;
    if (p->symmetry != TL_SYMMETRY_NONE || p->horizontal[last] < 360.0)
        return;
    for (size_t i = 0; i < p->vertical_count; i++)
        p->seam = fmax(p->seam, fabs(p->candela[last * p->vertical_count + i] - p->candela[i]));
    p->horizontal_count--;
}

static tl_status read_candela(ies_reader *r, tl_error *err)
{
    tl_photometry *const p = &r->made;
    const size_t count = p->vertical_count * p->horizontal_count;
    tl_status status = TL_OK;
    /* Each takes two bytes of the file at least. */
    if (count > (size_t)(r->end - r->at) / 2 + 1)
        return REFUSE(
            r, "%zu candela values are expected, of %zu x %zu angles; the file ends before",
            count, p->vertical_count, p->horizontal_count);
    p->candela = malloc(count * sizeof *p->candela);
    if (!p->candela)
        TRY(tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for its candela", r->source));
    for (size_t i = 0; i < count; i++) {
        TRY(read_number(r, "a candela value", 0.0, (double)TL_BRIGHTEST, &p->candela[i], err));
        p->candela[i] *= p->factor;
        if (!(p->candela[i] <= (double)TL_BRIGHTEST))
            TRY(REFUSE(r, "a candela value is %g with the factors, it must be up to %g",
                       p->candela[i], (double)TL_BRIGHTEST));
    }
    close_circle(p);
done:
    return status;
}

/* White space, and what ended texts once. */
static tl_status check_end(ies_reader *r, tl_error *err)
{
    char shown[48];
    while (r->at < r->end && strchr(" \t\v\f,\n\r", *r->at) && *r->at) {
        r->line += *r->at == '\n';
        r->at++;
    }
    if (r->at == r->end || *r->at == '\x1a')
        return TL_OK;
    show(r->at, (size_t)(r->end - r->at), shown);
    return REFUSE(r, "the file goes on behind the last candela value with \"%.12s\"", shown);
}

static tl_status read_numbers(ies_reader *r, tl_error *err)
{
    tl_photometry *const p = &r->made;
    tl_status status = TL_OK;
    TRY(read_head(r, err));
    TRY(read_angles(r, "a vertical angle", 180.0, p->vertical_count, &p->vertical, err));
    TRY(check_vertical(r, err));
    TRY(read_angles(r, "a horizontal angle", 360.0, p->horizontal_count, &p->horizontal, err));
    TRY(find_symmetry(r, err));
    TRY(read_candela(r, err));
    TRY(check_end(r, err));
done:
    return status;
}

tl_status tl_photometry_parse(
    const char *text, size_t size, const char *source, tl_photometry *out, tl_error *err)
{
    ies_reader r = {.source = source, .at = text, .end = text + size, .line = 1};
    /* A host program may have set a locale in which numbers have commas. */
    const locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    tl_status status = TL_OK;
    if (!plain)
        return tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for its numbers", source);
    const locale_t before = uselocale(plain);
    if (size > TL_IES_TEXT_LIMIT)
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s: is larger than the %zu MiB that are read", source,
                    TL_IES_TEXT_LIMIT >> 20));
    TRY(read_words(&r, err));
    TRY(read_numbers(&r, err));
    tl_photometry_clear(out);
    *out = r.made;
    r.made = (tl_photometry){0};
done:
    uselocale(before);
    freelocale(plain);
    tl_photometry_clear(&r.made);
    return status;
}
