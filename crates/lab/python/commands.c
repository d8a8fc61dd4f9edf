/* Executes the calls of FMI listed in a file, and writes the bits of the values that it reads. Compiled together with the sources of the
   unit.

   commands FILE > BITS
   n GUID                  a new instance; the previous one is freed
   r|i|b REFERENCE VALUE   sets a Real, an Integer, a Boolean; a Real in C's hexadecimal notation
   o REFERENCE             another output to read
   x                       initialises
   d TIME SIZE             a step
   g                       reads all outputs, 8 bytes each
   A failed call ends the program. With MEMORY, in the sources, the program prints two numbers at its end: the memory of the instances in
   bytes, and the allocator calls after the initialisation. Calls that log a message are not counted. */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmi2Functions.h"

#ifdef MEMORY
#include "bd_unit.h"
static unsigned long most;
static void look(const void *unit) {
    const unsigned long taken = (unsigned long)((const bd_unit *)unit)->machine.pages * BD_PAGE;
    if (taken > most) most = taken;
}
static unsigned long allocator_calls(void *unit) { return bd_source_allocator_calls_0(&((bd_unit *)unit)->machine); }
#else
#define look(unit) (void)0
#define allocator_calls(unit) 0ul
#endif

enum { MOST = 1024 };

static fmi2Component unit;
static fmi2ValueReference outputs[MOST];
static fmi2Real values[MOST];
static size_t n_outputs;
static int is_running, has_spoken;
static unsigned long allocated;

static void say(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status, fmi2String category, fmi2String text, ...) {
    (void)environment;
    (void)name;
    has_spoken = 1;
    fprintf(stderr, "%s %d: %s\n", category, (int)status, text);
}

static void check(fmi2Status status, const char *line) {
    if (status > fmi2Warning) {
        fprintf(stderr, "status %d: %s\n", (int)status, line);
        exit(1);
    }
}

static void carry_out(const char *line, const char *first, const char *second) {
    static const fmi2CallbackFunctions callbacks = {say, NULL, NULL, NULL, NULL};
    const fmi2ValueReference reference = (fmi2ValueReference)atol(first);
    const fmi2Real number = strtod(second, NULL);
    const fmi2Integer whole = (fmi2Integer)atoi(second);
    switch (line[0]) {
    case 'n':
        if (unit) {
            look(unit);
            fmi2FreeInstance(unit);
        }
        n_outputs = 0;
        is_running = 0;
        unit = fmi2Instantiate("commands", fmi2CoSimulation, first, "", &callbacks, fmi2False, fmi2False);
        if (!unit) exit(1);
        check(fmi2SetupExperiment(unit, fmi2False, 0.0, 0.0, fmi2False, 0.0), line);
        break;
    case 'r': check(fmi2SetReal(unit, &reference, 1, &number), line); break;
    case 'i': check(fmi2SetInteger(unit, &reference, 1, &whole), line); break;
    case 'b': check(fmi2SetBoolean(unit, &reference, 1, &whole), line); break;
    case 'o': if (n_outputs < MOST) outputs[n_outputs++] = reference; break;
    case 'x':
        check(fmi2EnterInitializationMode(unit), line);
        check(fmi2ExitInitializationMode(unit), line);
        break;
    case 'd': check(fmi2DoStep(unit, strtod(first, NULL), number, fmi2True), line); break;
    default:
        check(fmi2GetReal(unit, outputs, n_outputs, values), line);
        fwrite(values, sizeof *values, n_outputs, stdout);
    }
}

static void call(const char *line, const char *first, const char *second) {
    const unsigned long before = is_running ? allocator_calls(unit) : 0;
    has_spoken = 0;
    carry_out(line, first, second);
    if (is_running && !has_spoken) allocated += allocator_calls(unit) - before;
    is_running |= line[0] == 'x';
}

int main(int count, char **given) {
    char line[256], first[128], second[128];
    FILE *file = count == 2 ? fopen(given[1], "r") : NULL;
    if (!file) return fprintf(stderr, "commands FILE\n"), 2;
    while (fgets(line, sizeof line, file)) {
        first[0] = second[0] = 0;
        if (sscanf(line, "%*c %127s %127s", first, second) < 0 && line[0] != 'x' && line[0] != 'g') continue;
        call(line, first, second);
    }
    fclose(file);
    look(unit);
#ifdef MEMORY
    fprintf(stderr, "memory %lu\nallocated %lu\n", most, allocated);
#endif
    return 0;
}
