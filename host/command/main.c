/* The program: finds the subcommand and runs it. */
#include "commands.h"
#include "console.h"
#include "suggest.h"

#include <argp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A half that was left out of the build leaves its commands in the table, so that they can say
 * what they lack. */
#ifdef TILELIGHT_LIGHTING
#    define LIGHTING(function) function
#else
#    define LIGHTING(function) NULL
#endif
#ifdef TILELIGHT_RASTER
#    define RASTER(function) function
#else
#    define RASTER(function) NULL
#endif
#if defined TILELIGHT_LIGHTING && defined TILELIGHT_RASTER
#    define BOTH(function) function
#else
#    define BOTH(function) NULL
#endif

/* In the order of the data flow. */
static const struct {
    const char *name, *arguments, *summary;
    int (*run)(int argc, char **argv); /* NULL: left out of this build */
    const char *build_options;         /* what brings it in */
} commands[] = {
    {"render", "SCENE -o OUT", "capture a glTF scene and light it, in one go",
     BOTH(command_render), "-DTILELIGHT_RASTER=ON -DTILELIGHT_LIGHTING=ON"},
    {"capture", "SCENE -o G.exr", "geometry pass only: a scene to a G-buffer",
     RASTER(command_capture), "-DTILELIGHT_RASTER=ON"},
    {"convert", "G.exr -o H.exr", "a G-buffer from one layout of its pixels to another",
     command_convert, ""},
    {"scatter", "G.exr -o L.json", "lights placed on the visible surfaces of a G-buffer",
     command_scatter, ""},
    {"light", "G.exr -o OUT", "light a G-buffer", LIGHTING(command_light),
     "-DTILELIGHT_LIGHTING=ON"},
    {"batch", "G.####.exr -o OUT", "light many G-buffers", LIGHTING(command_batch),
     "-DTILELIGHT_LIGHTING=ON"},
    {"farm", "SCHEDULER IN...", "a batch as a job of Slurm, Open Job Description, GNU parallel",
     LIGHTING(command_farm), "-DTILELIGHT_LIGHTING=ON"},
    {"check", "[--kernel FILE.cl]",
     "hold a shading kernel, yours or ours, against the reference", LIGHTING(command_check),
     "-DTILELIGHT_LIGHTING=ON"},
    {"bench", "", "how fast frames are lit, and how near to what the device can do",
     LIGHTING(command_bench), "-DTILELIGHT_LIGHTING=ON"},
    {"study", "[SCENE ...] -o DIR",
     "what accuracy costs in time, configuration by configuration", LIGHTING(command_study),
     "-DTILELIGHT_LIGHTING=ON"},
    {"compare", "A B", "how far two pictures are apart", command_compare, ""},
    {"info", "FILE", "what is in a scene, a G-buffer, a picture or a lights file", command_info,
     ""},
    {"devices", "", "what can run: OpenCL devices, the OpenGL renderer", command_devices, ""},
    {"layouts", "[NAME]", "how pixels are packed, and what their bytes buy", command_layouts,
     ""},
    {"effects", "", "what lighting computes, and what calls for it", LIGHTING(command_effects),
     "-DTILELIGHT_LIGHTING=ON"},
};
enum { COMMAND_COUNT = sizeof commands / sizeof commands[0] };

static void print_exit_statuses(void)
{
    static const struct {
        int status;
        const char *meaning;
    } rows[] = {
#define ROW(name, exit_status, meaning) {exit_status, meaning},
        TL_STATUSES(ROW)
#undef ROW
    };
    int last = -1;
    puts("\nExit status:");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        if (rows[i].status != last)
            printf("  %d  %s\n", rows[i].status, rows[i].meaning);
        else
            printf("     %s\n", rows[i].meaning);
        last = rows[i].status;
    }
}

/* Columns as wide as what stands in them, two blanks apart: the list is read by programs too
 * (packaging/read-help). */
static void print_commands(void)
{
    size_t names = 0, arguments = 0;
    for (size_t i = 0; i < COMMAND_COUNT; i++) {
        const size_t name = strlen(commands[i].name), argument = strlen(commands[i].arguments);
        names = name > names ? name : names;
        arguments = argument > arguments ? argument : arguments;
    }
    for (size_t i = 0; i < COMMAND_COUNT; i++)
        printf("  %-*s  %-*s  %s%s\n", (int)names, commands[i].name, (int)arguments,
               commands[i].arguments, commands[i].summary,
               commands[i].run ? "" : " (not in this build)");
}

static void print_help(void)
{
    puts("Usage: tilelight COMMAND [OPTION...]\n"
         "Captures glTF scenes into G-buffers and lights them with OpenCL.\n\n"
         "Commands, in the order of the data flow:");
    print_commands();
    puts("\n`tilelight COMMAND --help' lists the options of a command, `tilelight --version' "
         "the\n"
         "version. In the environment, TILELIGHT_THREADS limits the threads of the host, and\n"
         "TILELIGHT_CACHE names the folder for compiled kernels and skies (default: tilelight "
         "in\n"
         "$XDG_CACHE_HOME or ~/.cache); if it is empty, none are kept.");
    print_exit_statuses();
}

static int usage_error(const char *name)
{
    const char *names[COMMAND_COUNT];
    for (size_t i = 0; i < COMMAND_COUNT; i++)
        names[i] = commands[i].name;
    const char *near = tl_suggest(name, names, COMMAND_COUNT);
    fprintf(stderr, "tilelight: no such command \"%s\"%s%s%s; `tilelight --help' lists them\n",
            name, near ? ": did you mean \"" : "", near ? near : "", near ? "\"?" : "");
    return tl_exit_status(TL_ERR_ARGUMENT);
}

/* The subcommand of argv[0], under the name that its messages have. */
static int run_command(int argc, char **argv)
{
    char name[64];
    size_t i = 0;
    while (i < COMMAND_COUNT && strcmp(commands[i].name, argv[0]) != 0)
        i++;
    if (i == COMMAND_COUNT)
        return usage_error(argv[0]);
    if (!commands[i].run) {
        fprintf(stderr, "tilelight: %s is not in this build; configure it with %s\n", argv[0],
                commands[i].build_options);
        return tl_exit_status(TL_ERR_ARGUMENT);
    }
    snprintf(name, sizeof name, "tilelight %s", commands[i].name);
    argv[0] = name;
    return commands[i].run(argc, argv);
}

/* `tilelight help X` is `tilelight X --help`. */
static int run_help(int argc, char **argv)
{
    static char help[] = "--help";
    char *arguments[] = {argc > 1 ? argv[1] : NULL, help, NULL};
    if (argc > 1 && strcmp(argv[1], "help") != 0)
        return run_command(2, arguments);
    print_help();
    return 0;
}

static int run_main(int argc, char **argv)
{
    if (argc < 2) {
        print_help();
        return tl_exit_status(TL_ERR_ARGUMENT);
    }
    if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-?") == 0 ||
        strcmp(argv[1], "-h") == 0 || strcmp(argv[1], "help") == 0)
        return run_help(argc - 1, argv + 1);
    if (strcmp(argv[1], "--version") == 0 || strcmp(argv[1], "-V") == 0) {
        puts(argp_program_version);
        return 0;
    }
    return run_command(argc - 1, argv + 1);
}

int main(int argc, char **argv)
{
    tl_error err;
    argp_program_version = "tilelight " TILELIGHT_VERSION;
    argp_err_exit_status = tl_exit_status(TL_ERR_ARGUMENT);
    const int exit_status = run_main(argc, argv);
    const tl_status flushed = console_flush(&err);
    return exit_status ? exit_status : console_finish(flushed, &err);
}
