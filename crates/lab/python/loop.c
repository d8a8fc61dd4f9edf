/* The unit as sources in C in a loop of 1 ms, as in a real-time system: sets the inputs of a recorded drive, executes a step, and reads
   outputs. Compiled together with the sources of the unit.

   loop GUID SET DRIVE OUTPUT...
   SET: start values, lines "Real|Integer|Boolean REFERENCE VALUE". DRIVE: a line with the references of inputs; then a line for each
   step: 1 if its instructions are counted, and the values of the inputs. OUTPUT: value references of Reals. Prints memory and stack
   in bytes, and a sum over the bits of all outputs; fails if a step allocates. */

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmi2Functions.h"

#include "bd_unit.h"

#define STEP 1e-3
enum { MOST = 64, STEPS = 10000, STACK = 1 << 20 };
/* fill value of unused stack */
enum { FILLED = 0xa5 };

static fmi2ValueReference inputs[MOST], outputs[MOST];
static fmi2Real drive[STEPS][4];
static char counted[STEPS];
static size_t n_inputs, n_outputs, n_steps;
static fmi2Component unit;
static const char *guid, *start;
static fmi2Real values[MOST];
static unsigned char stack[STACK];

static void check(fmi2Status status, const char *what) {
    if (status > fmi2Warning) {
        fprintf(stderr, "%s: status %d\n", what, status);
        exit(1);
    }
}

static void say(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status, fmi2String category, fmi2String text, ...) {
    (void)environment;
    fprintf(stderr, "%s: %s %d: %s\n", name, category, (int)status, text);
}

static void read_drive(const char *name) {
    char line[1024], *part;
    FILE *file = fopen(name, "r");
    if (!file || !fgets(line, sizeof line, file)) {
        perror(name);
        exit(1);
    }
    for (part = strtok(line, " \n"); part && n_inputs < 4; part = strtok(NULL, " \n")) inputs[n_inputs++] = (fmi2ValueReference)atoi(part);
    while (n_steps < STEPS && fgets(line, sizeof line, file)) {
        size_t k = 0;
        counted[n_steps] = line[0] == '1';
        for (part = strtok(line + 1, " \n"); part && k < n_inputs; part = strtok(NULL, " \n")) drive[n_steps][k++] = atof(part);
        ++n_steps;
    }
    fclose(file);
}

static void begin(void) {
    static const fmi2CallbackFunctions callbacks = {say, NULL, NULL, NULL, NULL};
    char kind[16];
    unsigned reference;
    double value;
    FILE *file = fopen(start, "r");
    unit = fmi2Instantiate("loop", fmi2CoSimulation, guid, "", &callbacks, fmi2False, fmi2False);
    if (!unit || !file) {
        fprintf(stderr, "no instance, or no start values\n");
        exit(1);
    }
    check(fmi2SetupExperiment(unit, fmi2False, 0.0, 0.0, fmi2False, 0.0), "setup");
    while (fscanf(file, "%15s %u %lf", kind, &reference, &value) == 3) {
        const fmi2Integer whole = (fmi2Integer)value;
        if (!strcmp(kind, "Real")) check(fmi2SetReal(unit, &reference, 1, &value), "a real");
        else if (!strcmp(kind, "Integer")) check(fmi2SetInteger(unit, &reference, 1, &whole), "an integer");
        else check(fmi2SetBoolean(unit, &reference, 1, &whole), "a boolean");
    }
    fclose(file);
    check(fmi2EnterInitializationMode(unit), "enter");
    check(fmi2ExitInitializationMode(unit), "exit");
}

static void take_step(size_t k) {
    if (n_inputs) check(fmi2SetReal(unit, inputs, n_inputs, drive[k]), "inputs");
    check(fmi2DoStep(unit, (double)k * STEP, STEP, fmi2True), "step");
    check(fmi2GetReal(unit, outputs, n_outputs, values), "outputs");
}

/* A separate function, so that its instructions can be counted. */
#if defined(__GNUC__)
__attribute__((noinline))
#endif
void one_communication_step(size_t k) { take_step(k); }

static void *run(void *nothing) {
    unsigned long long sum = 0xcbf29ce484222325ull;
    bd *machine;
    u32 pages, calls;
    size_t k, i;
    begin();
    machine = &((bd_unit *)unit)->machine;
    pages = machine->pages;
    calls = bd_source_allocator_calls_0(machine);
    for (k = 0; k < n_steps; ++k) {
        if (counted[k]) one_communication_step(k);
        else take_step(k);
        for (i = 0; i < n_outputs; ++i) sum = (sum ^ i64_reinterpret_f64(values[i])) * 0x100000001b3ull;
    }
    printf("%016llx\n", sum);
    calls = bd_source_allocator_calls_0(machine) - calls;
    if (machine->pages != pages || calls) {
        fprintf(stderr, "steps took memory: %u pages, then %u, and %u calls of the allocator\n", pages, machine->pages, calls);
        exit(1);
    }
    return nothing;
}

/* Number of bytes up to the first that is not `filled`. */
static size_t untouched(const unsigned char *bytes, size_t most, unsigned char filled) {
    size_t k = 0;
    while (k < most && bytes[k] == filled) ++k;
    return k;
}

int main(int count, char **given) {
    pthread_attr_t attributes;
    pthread_t thread;
    const bd *machine;
    int k;
    if (count < 4) return fprintf(stderr, "loop GUID SET DRIVE OUTPUT...\n"), 2;
    guid = given[1];
    start = given[2];
    read_drive(given[3]);
    for (k = 4; k < count && n_outputs < MOST; ++k) outputs[n_outputs++] = (fmi2ValueReference)atoi(given[k]);
    memset(stack, FILLED, sizeof stack);
    pthread_attr_init(&attributes);
    pthread_attr_setstack(&attributes, stack, sizeof stack);
    if (pthread_create(&thread, &attributes, run, NULL) || pthread_join(thread, NULL)) return fprintf(stderr, "no thread\n"), 1;
    machine = &((bd_unit *)unit)->machine;
    printf("instance %zu\nused %zu\nstack %zu\nstack within %zu\n", sizeof(bd_unit), (size_t)machine->pages * BD_PAGE,
           sizeof stack - untouched(stack, sizeof stack, FILLED),
           /* the stack is at the start of memory and grows towards it */
           BD_STACK - untouched(machine->memory.bytes, BD_STACK, 0));
    fmi2FreeInstance(unit);
    return 0;
}
