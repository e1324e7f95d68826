/* Do the cases come out right that bounds, lists, shading, shadows and ambient occlusion have been wrong in
 * elsewhere?
 *
 *     test_hard_cases [--list] [--json FILE] [NAME|NUMBER]...
 *
 * All, or those named; --json writes the figures, --list prints the texts and runs none. */
#include "hard_case.h"

static hard_result results[64];

typedef struct chosen {
    const hard_case *of;
    hard_result *result;
    tl_device *device;
} chosen;

static void run_case(void **state)
{
    const chosen *c = *state;
    hard_bench bench = {.device = c->device};
    c->of->run(&bench);
    *c->result = bench.result;
    const hard_result *r = c->result;
    print_message(
        "%d %s: %llu tried, %llu wrong, %llu by the usual form; %llu pixels, %llu lost, "
        "%llu beyond what is allowed, %.3f of it at most\n",
        c->of->number, c->of->name, (unsigned long long)r->tried, (unsigned long long)r->wrong,
        (unsigned long long)r->usual_wrong, (unsigned long long)r->pixels,
        (unsigned long long)r->lost, (unsigned long long)r->beyond, r->error);
    assert_true(hard_passes(c->of, r));
}

static const char *or_none(const char *text)
{
    return text ? text : "";
}

static void write_texts(FILE *file, const hard_case *of)
{
    fprintf(file,
            "{\"number\": %d, \"name\": \"%s\", \"about\": \"%s\", \"ours\": \"%s\", "
            "\"seen_in\": \"%s\",\n  \"counted\": \"%s\", \"usual\": \"%s\"",
            of->number, of->name, of->about, of->ours, of->seen_in, or_none(of->counted),
            or_none(of->usual));
}

static void write_figures(FILE *file, const hard_case *of, const hard_result *r)
{
    fprintf(file,
            ",\n  \"passed\": %s, \"tried\": %llu, \"wrong\": %llu, \"usual_wrong\": %llu, "
            "\"pixels\": %llu, \"lost\": %llu, \"beyond\": %llu, \"error\": %.3f",
            hard_passes(of, r) ? "true" : "false", (unsigned long long)r->tried,
            (unsigned long long)r->wrong, (unsigned long long)r->usual_wrong,
            (unsigned long long)r->pixels, (unsigned long long)r->lost,
            (unsigned long long)r->beyond, isfinite(r->error) ? r->error : -1.0);
}

static void write_cases(FILE *file, const chosen *cases, size_t count, int with_figures)
{
    fprintf(file, "[");
    for (size_t i = 0; i < count; i++) {
        fprintf(file, i ? ",\n" : "\n");
        write_texts(file, cases[i].of);
        if (with_figures)
            write_figures(file, cases[i].of, cases[i].result);
        fprintf(file, "}");
    }
    fprintf(file, "\n]\n");
}

static void write_json(const char *path, const chosen *cases, size_t count)
{
    FILE *file = fopen(path, "w");
    if (!file) {
        fprintf(stderr, "%s cannot be written\n", path);
        exit(1);
    }
    write_cases(file, cases, count, 1);
    fclose(file);
}

static const hard_case *case_of(const char *word)
{
    char *end;
    const long number = strtol(word, &end, 10);
    for (size_t i = 0; i < hard_case_count; i++)
        if (strcmp(hard_cases[i].name, word) == 0 ||
            (*end == '\0' && hard_cases[i].number == number))
            return &hard_cases[i];
    fprintf(stderr, "no hard case is called \"%s\"; there are:", word);
    for (size_t i = 0; i < hard_case_count; i++)
        fprintf(stderr, " %s", hard_cases[i].name);
    fprintf(stderr, "\n");
    exit(2);
}

/* Of the words of a command line; their number. */
static size_t choose(int argc, char **argv, chosen *cases, const char **json, int *lists)
{
    size_t count = 0;
    for (int i = 1; i < argc; i++)
        if (strcmp(argv[i], "--json") == 0 && i + 1 < argc)
            *json = argv[++i];
        else if (strcmp(argv[i], "--list") == 0)
            *lists = 1;
        else if (count < COUNT_OF(results))
            cases[count++].of = case_of(argv[i]);
    for (size_t i = 0; count == 0 && i < hard_case_count; i++)
        cases[i].of = &hard_cases[i];
    return count ? count : hard_case_count;
}

int main(int argc, char **argv)
{
    struct CMUnitTest tests[COUNT_OF(results)];
    chosen cases[COUNT_OF(results)];
    const char *json = NULL;
    int lists = 0;
    void *device = NULL;
    const size_t count = choose(argc, argv, cases, &json, &lists);
    if (lists) {
        write_cases(stdout, cases, count, 0);
        return 0;
    }
    open_device(&device);
    for (size_t i = 0; i < count; i++) {
        cases[i].device = device;
        cases[i].result = &results[i];
        tests[i] = (struct CMUnitTest){
            .name = cases[i].of->name, .test_func = run_case, .initial_state = &cases[i]};
    }
    const int failed = _cmocka_run_group_tests("hard cases", tests, count, NULL, NULL);
    if (json)
        write_json(json, cases, count);
    close_device(&device);
    return failed;
}
