/* Tries cases of every family against the oracle: scripts/prove-bounds. */
#define _POSIX_C_SOURCE 200112L

#include "bounds/named_losses.h"
#include "bounds/proof.h"

#include "machine.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { DONE = 0, BROKEN = 1, WRONG_USE = 2, NOT_WRITTEN = 5 };

static const char usage[] =
    "Usage: prove_bounds [--count N] [--seed S] [--jobs J] [--json FILE]\n"
    "\n"
    "Tries random and adversarial cases of bounds of spheres, of rectangles of tiles and of\n"
    "cones of spots against an oracle in 128-bit floats, and prints what each family of cases\n"
    "came to.\n"
    "\n"
    "  --count N    spheres, and a fifth as many tiles and cones (1000000)\n"
    "  --seed S     of the random numbers (1); the same seed and count give the same counts,\n"
    "               whatever J is\n"
    "  --jobs J     threads, at most 256 (as many as there are processors)\n"
    "  --json FILE  writes the counts there, too\n"
    "\n"
    "Ends with status 0 if no case breaks what is claimed, else 1; 2: wrong use; 5: FILE was\n"
    "not written.\n";

typedef struct options {
    uint64_t count, seed;
    const char *jobs, *json;
} options;

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int read_number(const char *text, uint64_t least, uint64_t most, uint64_t *out)
{
    char *end;
    errno = 0;
    const unsigned long long value = strtoull(text, &end, 10);
    if (text[0] < '0' || text[0] > '9' || *end || errno || value < least || value > most)
        return 0;
    *out = value;
    return 1;
}

/* Whether there is such an option with such a value. */
static int read_option(const char *name, const char *value, options *out)
{
    uint64_t jobs;
    if (!*value)
        return 0;
    if (strcmp(name, "--json") == 0)
        out->json = value;
    else if (strcmp(name, "--jobs") == 0 && read_number(value, 1, 256, &jobs))
        out->jobs = value;
    else
        return (strcmp(name, "--count") == 0 &&
                read_number(value, 1, 1000000000000, &out->count)) ||
               (strcmp(name, "--seed") == 0 && read_number(value, 0, UINT64_MAX, &out->seed));
    return 1;
}

/* What a family's name and its counts are in the report. */
static void write_family(FILE *to, const char *name, const tl_tally *t)
{
    fprintf(
        to,
        "{\"name\": \"%s\", \"cases\": %llu, \"hits\": %llu, \"lost\": %llu, \"extra\": %llu, "
        "\"falsely_empty\": %llu, \"falsely_kept\": %llu, \"undecided\": %llu}",
        name, (unsigned long long)t->cases, (unsigned long long)t->hits,
        (unsigned long long)t->lost, (unsigned long long)t->extra,
        (unsigned long long)t->falsely_empty, (unsigned long long)t->falsely_kept,
        (unsigned long long)t->undecided);
}

static void print_family(const char *name, const tl_tally *t)
{
    printf("  %-46s %11llu %11llu %6llu %6llu %6llu %6llu %10llu\n", name,
           (unsigned long long)t->cases, (unsigned long long)t->hits,
           (unsigned long long)t->lost, (unsigned long long)t->extra,
           (unsigned long long)t->falsely_empty, (unsigned long long)t->falsely_kept,
           (unsigned long long)t->undecided);
    fflush(stdout);
}

/* How many violations there were. */
static uint64_t try_group(const tl_bound_group *group, const options *o, FILE *json)
{
    const uint64_t cases = o->count / group->one_of;
    const uint64_t families = (uint64_t)group->family_count;
    tl_tally all = {.cases = 0};
    printf("\n%-48s %11s %11s %6s %6s %6s %6s %10s\n", group->name, "cases", group->hit, "lost",
           "extra", "empty", "kept", "undecided");
    fprintf(json, "  {\"name\": \"%s\", \"families\": [\n", group->name);
    for (int i = 0; i < group->family_count; i++) {
        const uint64_t count = cases / families + ((uint64_t)i < cases % families);
        uint64_t first;
        const tl_tally t = tl_try_family(group, i, o->seed, count, &first);
        print_family(group->family_name(i), &t);
        if (first != UINT64_MAX)
            printf("  ! case %llu is the first that breaks the claim\n",
                   (unsigned long long)first);
        write_family(json, group->family_name(i), &t);
        fprintf(json, i + 1 < group->family_count ? ",\n" : "\n");
        tally_add(&all, &t);
    }
    print_family("all", &all);
    fprintf(json, "  ]}");
    return tally_violations(&all);
}

/* How many pixels our bounds lose. */
static uint64_t show_named(FILE *json)
{
    uint64_t ours = 0;
    printf("\n%-48s %11s %11s %13s %11s\n", "named spheres, pixels lost", "seen", "listing 16",
           "Mara, McGuire", "ours");
    fprintf(json, "\"named\": [\n");
    for (int i = 0; i < TL_NAMED_SPHERES; i++) {
        const char *name = tl_named_spheres[i].name;
        const tl_named_loss loss = tl_lose_named(&tl_named_spheres[i]);
        printf("  %-46s %11llu %11llu %13llu %11llu\n", name, (unsigned long long)loss.seen,
               (unsigned long long)loss.listing_16, (unsigned long long)loss.mara_mcguire,
               (unsigned long long)loss.ours);
        fprintf(json,
                "  {\"name\": \"%s\", \"seen\": %llu, \"listing_16\": %llu, "
                "\"mara_mcguire\": %llu, \"ours\": %llu}%s\n",
                name, (unsigned long long)loss.seen, (unsigned long long)loss.listing_16,
                (unsigned long long)loss.mara_mcguire, (unsigned long long)loss.ours,
                i + 1 < TL_NAMED_SPHERES ? "," : "");
        ours += loss.ours;
    }
    fprintf(json, "]");
    return ours;
}

/* How many violations there were. */
static uint64_t prove(const options *o, FILE *json)
{
    const tl_machine machine = tl_machine_ask();
    const double started = now();
    uint64_t violations = 0;
    printf("%llu spheres, seed %llu, %u threads\n", (unsigned long long)o->count,
           (unsigned long long)o->seed, machine.threads);
    fprintf(json,
            "{\"tilelight_bounds_proof\": 1,\n\"count\": %llu, \"seed\": %llu,\n"
            "\"processor\": \"%s\",\n\"groups\": [\n",
            (unsigned long long)o->count, (unsigned long long)o->seed, machine.processor);
    for (int i = 0; i < TL_BOUND_GROUPS; i++) {
        violations += try_group(&tl_bound_groups[i], o, json);
        fprintf(json, i + 1 < TL_BOUND_GROUPS ? ",\n" : "\n");
    }
    fprintf(json, "],\n");
    violations += show_named(json);
    fprintf(json, "}\n");
    printf("\nseed %llu, %llu spheres, %.0f s: %llu violations\n", (unsigned long long)o->seed,
           (unsigned long long)o->count, now() - started, (unsigned long long)violations);
    return violations;
}

int main(int argc, char **argv)
{
    options o = {.count = 1000000, .seed = 1};
    for (int i = 1; i < argc; i += 2) {
        if (strcmp(argv[i], "--help") == 0) {
            fputs(usage, stdout);
            return DONE;
        }
        const char *value = i + 1 < argc ? argv[i + 1] : "";
        if (!read_option(argv[i], value, &o)) {
            fprintf(
                stderr,
                "prove_bounds: \"%s%s%s\" is no option, or not a value in its range: --help "
                "tells which there are.\n",
                argv[i], *value ? " " : "", value);
            return WRONG_USE;
        }
    }
    if (o.jobs)
        setenv("TILELIGHT_THREADS", o.jobs, 1);
    FILE *json = fopen(o.json ? o.json : "/dev/null", "w");
    if (!json) {
        fprintf(stderr, "prove_bounds: %s cannot be written: %s\n", o.json, strerror(errno));
        return NOT_WRITTEN;
    }
    const uint64_t violations = prove(&o, json);
    const int is_broken = ferror(json);
    if (fclose(json) != 0 || is_broken) {
        fprintf(stderr, "prove_bounds: %s was not written whole: is the disk full?\n", o.json);
        return NOT_WRITTEN;
    }
    return violations ? BROKEN : DONE;
}
