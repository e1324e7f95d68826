/* What a test saw of a formula beside the bound that is derived for it: a line for the reader, and one of
 * JSON for docs/accuracy.md (scripts/make-accuracy-page), appended to the file that TILELIGHT_FIGURES names.
 *
 *     figure f = {.section = "falloffs", .formula = "linear", .file = "kernels/falloff.h",
 *                 .quantity = "weight", .arithmetic = "float", .unit = "u", .parts = "product and sum"};
 *     figure_sees(&f, error, bound, "distance %g", d);     of every case
 *     figure_report(&f);                                    once
 *
 * A case beyond its bound, or whose error is no number, fails the test where it is seen. */
#ifndef TL_FIGURES_H
#define TL_FIGURES_H

#include "testing.h"

typedef struct figure {
    const char *section;  /* of docs/accuracy.md */
    const char *formula;  /* what is computed */
    const char *file;     /* where the formula stands, and its bound with the derivation */
    const char *quantity; /* what the error is of */
    /* that computes it: "float", "double"; NULL: none, or of no matter */
    const char *arithmetic;
    /* "u": half an ulp of 1 in that arithmetic; "u of float": 2^-24; else numbers are as they are */
    const char *unit;
    const char *parts;   /* what the bound is composed of, in short */
    double bound, worst; /* of the case that comes nearest to its bound */
    char where[160];     /* that case */
    unsigned long cases;
} figure;

static inline double figure_scale(const figure *f)
{
    const int is_double = f->arithmetic && strcmp(f->arithmetic, "double") == 0;
    if (strcmp(f->unit, "u of float") == 0)
        return 0x1p24;
    if (strcmp(f->unit, "u") != 0)
        return 1.0;
    return is_double ? 0x1p53 : 0x1p24;
}

static inline void figure_keep(
    figure *f, double error, double bound, const char *form, va_list arguments)
{
    f->bound = bound;
    f->worst = error;
    vsnprintf(f->where, sizeof f->where, form, arguments);
}

/* error, bound: 0 and above, not yet in f->unit. */
__attribute__((format(printf, 4, 5))) static inline void figure_sees(
    figure *f, double error, double bound, const char *form, ...)
{
    va_list arguments;
    const int is_within = error <= bound;
    const int is_first = f->cases == 0;
    f->cases++;
    if (is_within && !is_first && error * f->bound <= f->worst * bound)
        return;
    va_start(arguments, form);
    figure_keep(f, error, bound, form, arguments);
    va_end(arguments);
    if (!is_within)
        fail_msg("%s, %s, %s: off by %.9g %s where %.9g is derived: %s", f->formula,
                 f->quantity, f->arithmetic ? f->arithmetic : "", error * figure_scale(f),
                 f->unit, bound * figure_scale(f), f->where);
}

static inline void figure_text(FILE *to, const char *key, const char *text)
{
    fprintf(to, "\"%s\": \"", key);
    for (; *text; text++)
        if (*text == '"' || *text == '\\')
            fprintf(to, "\\%c", *text);
        else
            fputc((unsigned char)*text < 0x20 ? ' ' : *text, to);
    fputs("\", ", to);
}

/* In one write, so that lines of tests that run side by side stay whole. */
static inline void figure_append(const figure *f, const char *path)
{
    FILE *to = fopen(path, "a");
    if (!to)
        fail_msg("cannot append to %s, which TILELIGHT_FIGURES names", path);
    setvbuf(to, NULL, _IOFBF, 4096);
    fputc('{', to);
    figure_text(to, "section", f->section);
    figure_text(to, "formula", f->formula);
    figure_text(to, "file", f->file);
    figure_text(to, "quantity", f->quantity);
    figure_text(to, "arithmetic", f->arithmetic ? f->arithmetic : "");
    figure_text(to, "unit", f->unit);
    figure_text(to, "parts", f->parts);
    figure_text(to, "where", f->where);
    fprintf(to, "\"bound\": %.4g, \"worst\": %.4g, \"cases\": %lu}\n",
            f->bound * figure_scale(f), f->worst * figure_scale(f), f->cases);
    if (fclose(to) != 0)
        fail_msg("cannot append to %s, which TILELIGHT_FIGURES names", path);
}

static inline void figure_report(const figure *f)
{
    const char *path = getenv("TILELIGHT_FIGURES");
    if (f->cases == 0)
        fail_msg("%s, %s: no case was seen", f->formula, f->quantity);
    print_message("%s, %s, %s: %.4g of %.4g %s in %lu cases: %s\n", f->formula, f->quantity,
                  f->arithmetic ? f->arithmetic : "", f->worst * figure_scale(f),
                  f->bound * figure_scale(f), f->unit, f->cases, f->where);
    if (path && *path)
        figure_append(f, path);
}

#endif
