#define _DEFAULT_SOURCE
#include "machine.h"

#include "parallel.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void read_processor(char *name, size_t size)
{
    char line[512];
    FILE *file = fopen("/proc/cpuinfo", "r");
    snprintf(name, size, "unknown");
    while (file && fgets(line, sizeof line, file)) {
        const char *value = strchr(line, ':');
        if (strncmp(line, "model name", 10) != 0 || !value)
            continue;
        line[strcspn(line, "\n")] = '\0';
        snprintf(name, size, "%s", value[1] == ' ' ? value + 2 : value + 1);
        break;
    }
    if (file)
        fclose(file);
}

tl_machine tl_machine_ask(void)
{
    tl_machine machine = {.threads = tl_thread_count(), .load = (double)NAN};
    double load;
    read_processor(machine.processor, sizeof machine.processor);
    if (getloadavg(&load, 1) == 1)
        machine.load = load;
    return machine;
}
