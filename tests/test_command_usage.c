/* Is each way of calling the program wrongly told apart, by exit status and by words? */
#define _GNU_SOURCE
#include "program.h"

#include <unistd.h>

static const struct {
    const char *command;
    int exit_status;
    const char *out_word, *err_word;
} cases[] = {
    {"$T --help", 0, "render", ""},
    {"$T help", 0, "Exit status", ""},
    {"$T", 2, "capture", ""},
    {"$T --version", 0, "tilelight ", ""},
    {"$T help light", 0, "--light-cutoff", ""},
    {"$T help help", 0, "Exit status", ""},
    {"$T help nothing", 2, "", "no such command \"nothing\""},
    {"$T rendr", 2, "", "did you mean \"render\"?"},
    {"$T frobnicate", 2, "", "`tilelight --help' lists them"},
    {"$T render --help", 0, "--scatter", ""},
    {"$T capture --help", 0, "--lights-out", ""},
    {"$T convert --help", 0, "--layout", ""},
    {"$T scatter --help", 0, "--overlap", ""},
    {"$T bench --help", 0, "--per-tile", ""},
    {"$T compare --help", 0, "--tolerance", ""},
    {"$T compare a.png b.png --flip-map c.exr", 2, "", "end it in .png"},
    {"$T compare a.png b.png --pixels-per-degree 0", 2, "", "is no number from 1 to 1000"},
    {"$T info --help", 0, "--json", ""},
    {"$T devices --help", 0, "--json", ""},
    {"$T layouts --help", 0, "--bandwidth", ""},
    {"$T effects --help", 0, "--json", ""},
    {"$T light --help", 0, "--explain-map", ""},
    {"$T render --help", 0, "--effects", ""},

    {"$T light", 2, "", "G.exr is missing"},
    {"$T light a.exr", 2, "", "-o is missing"},
    {"$T light a.exr b.exr -o c.png", 2, "", "\"b.exr\" is an argument too many"},
    {"$T light a.exr -o c.png --frob", 2, "", "--frob"},
    {"$T light a.exr -o c.jpg", 2, "", "-o: cannot tell what to write from \"c.jpg\""},
    {"$T light a.exr -o .png", 2, "", "cannot tell"},
    {"$T light a.exr -o ''", 2, "", "cannot tell"},
    {"$T light a.exr -o c.json", 2, "",
     "end it in .png, .exr, .pfm, - (standard output), pfm:-"},
    {"$T light a.exr -o - --json", 2, "", "--json"},
    {"$T light a.exr -o c.png --cull foo", 2, "",
     "--cull: no such mode \"foo\"; modes: split, depth, rect, none"},
    {"$T light a.exr -o c.png --path foo", 2, "",
     "--path: no such path \"foo\"; paths: auto, cpu, gpu"},
    {"$T light a.exr -o c.png --precision half", 2, "", "reference, twin"},
    {"$T light a.exr -o c.png --tone filmic", 2, "", "curves: aces, reinhard, none"},
    {"$T light a.exr -o c.png --exr double", 2, "", "float, half"},
    {"$T light a.exr -o c.png --dither floyd", 2, "", "dithers: none, ordered, blue-noise"},
    {"$T light a.exr -o c.png --white 2", 2, "", "--white is for --tone reinhard-extended"},
    {"$T light a.exr -o c.png --tone reinhard-extended --white 0", 2, "", "from 0.01 to 1e+06"},
    {"$T light a.exr -o c.png --max-error 8bit --tone agx", 2, "", "each channel by itself"},
    {"$T light a.exr -o c.png --max-flip 0.1 --dither ordered", 2, "", "leave --dither out"},
    {"$T light a.exr -o c.png --output-size 0x5", 2, "", "--output-size: \"0x5\" is no size"},
    {"$T light a.exr -o c.png --output-size 5x5 --filter cubic", 2, "",
     "filters: mitchell, box"},
    {"$T light a.exr -o c.exr --aov all --output-size 5x5", 2, "", "leave --output-size out"},
    {"$T light a.exr -o c.png --filter box", 2, "", "--filter is for --output-size"},
    {"$T light a.exr -o c.png --max-error 0.1 --output-size 5x5", 2, "",
     "leave --output-size out"},
    {"$T light a.exr -o c.png --png 12", 2, "", "--png: \"12\" is none of 8, 16"},
    {"$T light a.exr -o c.exr --exr-compression lzma", 2, "", "none, rle, zips, zip, piz"},
    {"$T light a.exr -o c.exr --exr-compression dwaa", 2, "", "writes no dwaa; zip and piz"},
    {"$T light a.exr -o exr:-", 2, "", "cannot tell what to write from \"exr:-\""},
    {"$T light a.exr -o pfm:- --json", 2, "", "both want standard output"},
    {"$T light a.exr -o c.png --tile 12", 2, "", "--tile: \"12\" is none of 8, 16, 32, 64"},
    {"$T light a.exr -o c.png --width 0", 2, "", "--width: \"0\" is none of 1, 4, 8, 16"},
    {"$T light a.exr -o c.png --exposure nan", 2, "", "is no number from -64 to 64"},
    {"$T light a.exr -o c.png --exposure inf", 2, "", "--exposure"},
    {"$T light a.exr -o c.png --exposure 1x", 2, "", "\"1x\""},
    {"$T light a.exr -o c.png --exposure ''", 2, "", "--exposure"},
    {"$T light a.exr -o c.png --light-cutoff -1", 2, "", "--light-cutoff"},
    {"$T render s.gltf -o c.png --size 0x1", 2, "", "each from 1 to 16384"},
    {"$T render s.gltf -o c.png --size 16385x1", 2, "", "--size: \"16385x1\""},
    {"$T render s.gltf -o c.png --size 4294967297x1", 2, "", "--size"},
    {"$T render s.gltf -o c.png --size 10", 2, "", "WIDTHxHEIGHT"},
    {"$T render s.gltf -o c.png --size 10x-1", 2, "", "--size"},
    {"$T render s.gltf -o c.png --size 10x1x1", 2, "", "--size"},
    {"$T render s.gltf -o c.png --scatter 0", 2, "", "--scatter"},
    {"$T render s.gltf -o c.png --scatter 8 --lights l.json", 2, "", "exclude each other"},
    {"$T render s.gltf -o c.png --time -1", 2, "",
     "--time: \"-1\" is no number from 0 to 1e+09"},
    {"$T render s.gltf -o c.png --time soon", 2, "", "--time: \"soon\""},
    {"$T capture s.gltf -o g.exr --time", 2, "", "--time"},
    {"$T capture $D/nine-lights.gltf -o g.exr --time 1", 2, "",
     "has no animations, so it can only be shown without a time"},
    {"$T render $D/fair.glb -o c.png --animation flat", 2, "",
     "has no animation \"flat\"; it has: 0 (\"round\")"},
    {"$T capture s.gltf -o g.png", 2, "", "end it in .exr"},
    {"$T capture s.gltf -o -", 2, "", "end it in .exr"},
    {"$T capture s.gltf", 2, "", "-o is missing"},
    {"$T capture s.gltf -o g.exr --lights-out l.txt", 2, "", "--lights-out"},
    {"$T capture s.gltf -o g.exr --lights-out - --json", 2, "", "--json"},
    {"$T convert g.exr --layout merlin", 2, "", "-o is missing"},
    {"$T convert -o h.exr --layout merlin", 2, "", "G.exr is missing"},
    {"$T convert g.exr -o h.png --layout merlin", 2, "", "end it in .exr"},
    {"$T convert g.exr -o h.exr --layout octo", 2, "",
     "--layout: no layout is called \"octo\": there are float, float-forward"},
    {"$T scatter g.exr -o l.json --count 0", 2, "", "--count: \"0\" is no whole number from 1"},
    {"$T scatter g.exr -o l.json --count 1000001", 2, "", "to 1000000"},
    {"$T scatter g.exr -o l.json --seed 4294967296", 2, "", "--seed"},
    {"$T scatter g.exr -o l.json --overlap nan", 2, "", "--overlap"},
    {"$T scatter g.exr -o l.json --falloff lut", 2, "", "inverse-square, linear"},
    {"$T scatter g.exr", 2, "", "-o is missing"},
    {"$T bench x", 2, "", "\"x\" is an argument too many"},
    {"$T bench --scene spheres,attic", 2, "", "--scene: \"attic\" is none of spheres, wall"},
    {"$T bench --size 64x64,64", 2, "", "--size: \"64\" is no size"},
    {"$T bench --lights 0", 2, "", "--lights: \"0\" is no whole number from 1 to 1000000"},
    {"$T bench --lights 64,,128", 2, "", "--lights: \"64,,128\" is no list"},
    {"$T bench --per-tile nan", 2, "", "--per-tile: \"nan\" is no number"},
    {"$T bench --tile 12", 2, "", "--tile: \"12\" is none of 8, 16, 32, 64"},
    {"$T bench --cull all", 2, "", "--cull: \"all\" is none of split, depth, rect, none"},
    {"$T bench --precision half", 2, "", "reference, twin"},
    {"$T bench --path tpu", 2, "", "--path: \"tpu\" is none of auto, cpu, gpu"},
    {"$T bench --width 2", 2, "", "auto, 1, 4, 8, 16"},
    {"$T bench --case scenes,attics", 2, "", "--case: no such set \"attics\"; sets: scenes"},
    {"$T bench --samples 0", 2, "", "--samples"},
    {"$T bench --deviation -1", 2, "", "--deviation"},
    {"$T bench --json - --csv -", 2, "", "both want standard output"},
    {"$T bench --quick", 2, "", "--quick is for --baselines"},
    {"$T bench --baselines --csv a.csv", 2, "", "--csv, --case and --compare are for cases"},
    {"$T bench --baselines --tile 8,16", 2, "", "give each axis one word at most"},
    {"$T bench --baselines --growth", 2, "", "exclude one another"},
    {"$T bench --growth --size 64x64", 2, "", "of the axes it takes --device alone"},
    {"$T bench --list", 0, "hand_relaxed", ""},
    {"$T bench --fail-if-slower", 2, "", "--fail-if-slower is for --compare"},
    {"$T bench --compare missing.json", 3, "", "missing.json"},
    {"$T bench --compare $D/nine-lights.lights.json", 3, "", "no report of `tilelight bench"},
    {"$T bench --compare $D/make_scenes.py", 3, "", "make_scenes.py: line 1"},
    {"$T compare a.exr", 2, "", "B is missing"},
    {"$T compare a b --metric psnr", 2, "", "metrics: max, mean, rms, p999"},
    {"$T compare a b --tolerance -1", 2, "", "--tolerance"},
    {"$T devices x", 2, "", "\"x\" is an argument too many"},
    {"$T layouts float merlin", 2, "", "\"merlin\" is an argument too many"},
    {"$T layouts thin", 2, "", "no layout is called \"thin\": there are float, float-forward"},
    {"$T layouts --size 64x64", 2, "", "--size and --device are for --bandwidth"},
    {"$T layouts --depth --bandwidth", 2, "", "neither NAME nor --bandwidth goes with it"},
    {"$T layouts float --depth", 2, "", "neither NAME nor --bandwidth goes with it"},
    {"$T layouts --depth", 0, "by textbook", ""},
    {"$T layouts --device cpu", 2, "", "--size and --device are for --bandwidth"},
    {"$T layouts --bandwidth --size 64", 2, "", "--size: \"64\" is no size"},
    {"$T layouts --bandwidth --device nowhere", 4, "equation 7", "nowhere"},
    {"OCL_ICD_VENDORS=/nonexistent $T layouts --bandwidth", 0, "equation 7",
     "nothing is measured: "},

    {"$T light missing.exr -o c.png", 3, "", "missing.exr"},
    {"$T render missing.gltf -o c.png", 3, "", "missing.gltf"},
    {"$T capture missing.gltf -o c.exr", 3, "", "missing.gltf"},
    {"$T convert missing.exr -o h.exr --layout merlin", 3, "", "missing.exr"},
    {"$T scatter missing.exr -o l.json", 3, "", "missing.exr"},
    {"$T compare missing.exr b.exr", 3, "", "missing.exr"},
    {"$T info missing", 3, "", "missing"},
    {"$T info $D/make_scenes.py", 3, "", "make_scenes.py"},
    {"$T render $D/nine-lights.gltf -o c.png --camera nowhere", 2, "", "nowhere"},
    {"$T light $D/nine-lights.gltf -o c.png", 3, "", "nine-lights.gltf"},
    {"printf '{\"tilelight\": 1, \"lights\": [{\"type\": \"point\", \"position\": [0,0,0], "
     "\"strength\": 2}]}' | $T render $D/nine-lights.gltf -o c.png --lights -",
     3, "", "strength"},
    {"printf '{\"tilelight\": 1, \"ambient\": [NaN, 0, 0]}' | $T render $D/nine-lights.gltf "
     "-o c.png --lights -",
     3, "", "tilelight: "},

    {"OCL_ICD_VENDORS=/nonexistent $T render $D/nine-lights.gltf -o c.png", 4, "", "device"},
    {"OCL_ICD_VENDORS=/nonexistent $T devices", 0, "", "pocl-opencl-icd"},
    {"$T render $D/nine-lights.gltf -o c.png --device nowhere", 4, "", "nowhere"},
    {"$T render $D/nine-lights.gltf -o c.png --device 99", 4, "", "99"},

    {"$T bench --device nowhere", 4, "", "nowhere"},
    {"$T bench --json nowhere/b.json", 5, "", "nowhere/b.json"},
    {"$T light a.exr -o nowhere/c.png", 5, "", "nowhere/c.png"},
    {"$T devices >/dev/full", 5, "", "standard output"},
    {"$T devices --json >/dev/full", 5, "", "standard output"},
    {"$T --help >/dev/full", 5, "", "standard output"},
};

static void each_case_says_what_it_should(void **state)
{
    (void)state;
    enter_empty_folder("command-usage");
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        const program_run *run = expect_run(cases[i].command, cases[i].exit_status,
                                            cases[i].out_word, cases[i].err_word);
        /* A failure past the options is one sentence. */
        const char *end = strchr(run->err, '\n');
        if (run->exit_status >= 3 &&
            (!end || end[1] || strncmp(run->err, "tilelight: ", 11) != 0))
            fail_msg("%s: not one sentence:\n%s", cases[i].command, run->err);
        if (count_files() != 0)
            fail_msg("%s: left a file behind", cases[i].command);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(each_case_says_what_it_should)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
