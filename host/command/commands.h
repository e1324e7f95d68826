/* The subcommands; main.c has the table of them. */
#ifndef TL_COMMANDS_H
#define TL_COMMANDS_H

/* Each takes its own arguments, argv[0] being what messages call it ("tilelight render"), and
 * returns the exit status. A usage error ends the program with status 2. */
int command_render(int argc, char **argv);
int command_capture(int argc, char **argv);
int command_light(int argc, char **argv);
int command_batch(int argc, char **argv);
int command_farm(int argc, char **argv);
int command_check(int argc, char **argv);
int command_convert(int argc, char **argv);
int command_scatter(int argc, char **argv);
int command_bench(int argc, char **argv);
int command_study(int argc, char **argv);
int command_compare(int argc, char **argv);
int command_info(int argc, char **argv);
int command_devices(int argc, char **argv);
int command_layouts(int argc, char **argv);
int command_effects(int argc, char **argv);

#endif
