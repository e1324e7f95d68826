#define _POSIX_C_SOURCE 200809L /* open_memstream */
/* A job template of Open Job Description, version jobtemplate-2023-09, in JSON. Section numbers below are of
 * its specification, "Template Schemas [Version: 2023-09]", and "Cc" is Unicode's category of controls. */
#include "farm_schedulers.h"
#include "farm_shell.h"

#include "try.h"

#include <jansson.h>
#include <stdlib.h>
#include <string.h>

enum {
    MOST_CHUNKS = 1024,     /* 3.4.1.3: values of a task parameter */
    MOST_CHARACTERS = 1024, /* 2.5, 3.4.2: of a parameter's value */
    MOST_PARAMETERS = 50    /* 1.1 */
};

/* What is being made of a plan. Objects of jansson that could not be made are NULL, which its own functions
 * pass on: one question at the end finds them. */
typedef struct template
{
    const tl_farm_plan *plan;
    json_t *parameters; /* definitions of job parameters */
    json_t *words;      /* arguments of batch, but for the chunk */
    bool lost;          /* memory ran out */
}
template;

static void append(template *t, json_t *array, json_t *value)
{
    if (json_array_append_new(array, value) != 0)
        t->lost = true;
}

static size_t characters(const char *text)
{
    size_t count = 0;
    for (; *text; text++)
        count += ((unsigned char)*text & 0xC0) != 0x80;
    return count;
}

/* Cc: below U+0020, and U+007F to U+009F, which UTF-8 has as C2 80 to C2 9F. */
static bool has_control(const char *text)
{
    for (const unsigned char *c = (const unsigned char *)text; *c; c++)
        if (*c < 0x20 || *c == 0x7F || (*c == 0xC2 && c[1] >= 0x80 && c[1] < 0xA0))
            return true;
    return false;
}

/* Whether a template can hold the word: it is UTF-8 (1), and arguments have no controls (5.2). */
static tl_status check_word(const char *word, tl_error *err)
{
    json_t *string = json_string(word);
    const bool readable = string && !has_control(word);
    json_decref(string);
    return readable ? TL_OK
                    : tl_fail(err, TL_ERR_ARGUMENT,
                              "\"%s\" has characters that a template of Open Job Description "
                              "cannot hold: it is UTF-8 without control characters",
                              word);
}

static tl_status add_parameter(template *t,
                               json_t *definition,
                               const char *value,
                               tl_error *err)
{
    append(t, t->parameters, definition);
    if (characters(value) > MOST_CHARACTERS)
        return tl_fail(err, TL_ERR_ARGUMENT,
                       "\"%.60s...\" is longer than the %d characters that a value in a "
                       "template of Open Job "
                       "Description has",
                       value, MOST_CHARACTERS);
    if (json_array_size(t->parameters) > MOST_PARAMETERS)
        return tl_fail(
            err, TL_ERR_ARGUMENT,
            "more than %d arguments have \"{{\" or \"}}\" in them, which a template of "
            "Open Job Description cannot hold",
            MOST_PARAMETERS - 2);
    return TL_OK;
}

/* Arguments are format strings (7.3), which know no way to write two braces: those stand in a parameter's
 * value, which is not looked into. */
static tl_status add_word(template *t, const char *word, tl_error *err)
{
    tl_status status = TL_OK;
    char name[32], reference[48];
    TRY(check_word(word, err));
    if (!strstr(word, "{{") && !strstr(word, "}}")) {
        append(t, t->words, json_string(word));
        return TL_OK;
    }
    snprintf(name, sizeof name, "Word%zu", json_array_size(t->parameters));
    snprintf(reference, sizeof reference, "{{Param.%s}}", name);
    append(t, t->words, json_string(reference));
    TRY(add_parameter(
        t, json_pack("{s:s, s:s, s:s}", "name", name, "type", "STRING", "default", word), word,
        err));
done:
    return status;
}

/* The folder is a path, which a render manager may map to where it is on the worker (2.2). */
static tl_status add_parameters(template *t, tl_error *err)
{
    tl_status status = TL_OK;
    TRY(check_word(t->plan->folder, err));
    TRY(check_word(t->plan->program, err));
    TRY(add_parameter(t,
                      json_pack("{s:s, s:s, s:s, s:s, s:s, s:s}", "name", "Folder", "type",
                                "PATH", "objectType", "DIRECTORY", "dataFlow", "INOUT",
                                "description", "Where relative names of files are.", "default",
                                t->plan->folder),
                      t->plan->folder, err));
    TRY(add_parameter(t,
                      json_pack("{s:s, s:s, s:s, s:s}", "name", "Program", "type", "STRING",
                                "description", "The program that workers run.", "default",
                                t->plan->program),
                      t->plan->program, err));
    for (size_t i = 0; i < t->plan->argument_count; i++)
        TRY(add_word(t, t->plan->arguments[i], err));
done:
    return status;
}

/* Arguments of batch, the chunk among them. */
static json_t *batch_words(template *t, const char *chunk)
{
    json_t *words = json_copy(t->words);
    if (json_array_insert_new(words, t->plan->chunk_at, json_string(chunk)) != 0)
        t->lost = true;
    return words;
}

/* Tasks run in a folder of their session: the shell goes to ours first. */
static json_t *script_of(template *t, const char *chunk)
{
    json_t *words = json_pack(
        "[s, s, s, s, s, s, s, s]", "-c", "cd -- \"$1\" && shift && exec \"$@\"", "tilelight",
        "{{Param.Folder}}", "{{Param.Program}}", "batch", "--progress", "openjd");
    json_t *more = batch_words(t, chunk);
    if (json_array_extend(words, more) != 0)
        t->lost = true;
    json_decref(more);
    /* A worker that is told finishes the frames that it is at. */
    json_t *run = json_pack("{s:s, s:o, s:{s:s}}", "command", "sh", "args", words,
                            "cancelation", "mode", "NOTIFY_THEN_TERMINATE");
    if (t->plan->needs.seconds > 0 &&
        json_object_set_new(run, "timeout", json_integer((json_int_t)t->plan->needs.seconds)) !=
            0)
        t->lost = true;
    return json_pack("{s:{s:o}}", "actions", "onRun", run);
}

/* 3.3.1.1, its table of capabilities. */
static void add_requirements(template *t, json_t *step)
{
    const tl_farm_needs *needs = &t->plan->needs;
    const struct {
        const char *name;
        uint64_t least;
    } amounts[] = {{"amount.worker.vcpu", needs->processors},
                   {"amount.worker.memory", needs->memory_mib}};
    json_t *array = json_array();
    for (size_t i = 0; i < sizeof amounts / sizeof amounts[0]; i++)
        if (amounts[i].least > 0)
            append(t, array,
                   json_pack("{s:s, s:I}", "name", amounts[i].name, "min",
                             (json_int_t)amounts[i].least));
    if (json_array_size(array) == 0)
        json_decref(array);
    else if (json_object_set_new(step, "hostRequirements",
                                 json_pack("{s:o}", "amounts", array)) != 0)
        t->lost = true;
}

static json_t *light_step(template *t)
{
    json_t *chunks = json_array();
    for (size_t i = 0; i < t->plan->chunk_count; i++)
        append(t, chunks, json_string(t->plan->chunks[i]));
    json_t *step =
        json_pack("{s:s, s:{s:[{s:s, s:s, s:o}]}, s:o}", "name", "Light", "parameterSpace",
                  "taskParameterDefinitions", "name", "Chunk", "type", "STRING", "range",
                  chunks, "script", script_of(t, "{{Task.Param.Chunk}}"));
    add_requirements(t, step);
    return step;
}

static json_t *gather_step(template *t)
{
    json_t *step =
        json_pack("{s:s, s:s, s:[{s:s}], s:o}", "name", "Gather", "description",
                  "Does what is missing, and ends with the list of failures.", "dependencies",
                  "dependsOn", "Light", "script", script_of(t, t->plan->gather));
    add_requirements(t, step);
    return step;
}

static char *description_of(const tl_farm_plan *plan)
{
    char *text = NULL;
    size_t size = 0;
    char counts[48];
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    tl_farm_size(plan, counts);
    fprintf(
        out,
        "%s, and a gather that does what is missing. It starts once every worker has succeeded "
        "(3.2 of the specification): where one cannot, start it by hand.\n",
        counts);
    tl_farm_print_advice(out, "");
    if (fclose(out) == 0)
        return text;
    free(text);
    return NULL;
}

static tl_status check_chunks(const tl_farm_plan *plan, tl_error *err)
{
    if (plan->chunk_count > MOST_CHUNKS)
        return tl_fail(err, TL_ERR_ARGUMENT,
                       "%zu chunks are more than the %d tasks that a template of Open Job "
                       "Description lists: "
                       "with --chunk %zu they fit",
                       plan->chunk_count, MOST_CHUNKS,
                       (plan->frame_count - 1) / MOST_CHUNKS + 1);
    for (size_t i = 0; i < plan->chunk_count; i++)
        if (strlen(plan->chunks[i]) > MOST_CHARACTERS)
            return tl_fail(
                err, TL_ERR_ARGUMENT,
                "a chunk's frames, \"%.60s...\", take more than the %d characters that a value "
                "in a template of Open Job Description has: make --chunk smaller",
                plan->chunks[i], MOST_CHARACTERS);
    return TL_OK;
}

tl_status tl_farm_print_openjd(const tl_farm_plan *plan, FILE *out, tl_error *err)
{
    tl_status status = TL_OK;
    template t = {plan, json_array(), json_array(), false};
    char *description = description_of(plan), *text = NULL;
    json_t *root = NULL;
    TRY(check_chunks(plan, err));
    TRY(add_parameters(&t, err));
    root = json_pack("{s:s, s:s, s:s, s:O, s:[o, o]}", "specificationVersion",
                     "jobtemplate-2023-09", "name", "tilelight", "description",
                     description ? description : "", "parameterDefinitions", t.parameters,
                     "steps", light_step(&t), gather_step(&t));
    text = root && description && !t.lost ? json_dumps(root, JSON_INDENT(2)) : NULL;
    if (!text) {
        status = tl_fail(err, TL_ERR_MEMORY, "host memory ran out while a template was made");
        goto done;
    }
    fprintf(out, "%s\n", text);
done:
    json_decref(root);
    free(text);
    free(description);
    json_decref(t.words);
    json_decref(t.parameters);
    return status;
}
