/* The calls of runs without anything around them: reset, set, initialise, step, get, as a host in C makes them.
   calls LIBRARY GUID SET STOP STEP RUNS [OUTPUT...]
   SET: a file of lines "Real|Integer|Boolean|Later REFERENCE VALUE", Later: a Real that is set after initialisation; OUTPUT: value
   references of Reals; STEP 0: one long step.
   Prints a line for each run: its seconds, and the seconds of the processor that its steps took. */

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define MOST 256

typedef void *Component;
typedef unsigned Reference;

static void *find(void *library, const char *name) {
    void *found = dlsym(library, name);
    if (!found) { fprintf(stderr, "%s is missing\n", name); exit(1); }
    return found;
}

static void check(int status, const char *what) {
    if (status > 1) { fprintf(stderr, "%s: status %d\n", what, status); exit(1); }
}

static double now(clockid_t clock) {
    struct timespec time;
    clock_gettime(clock, &time);
    return time.tv_sec + 1e-9 * time.tv_nsec;
}

int main(int count, char **given) {
    if (count < 7) { fprintf(stderr, "calls LIBRARY GUID SET STOP STEP RUNS [OUTPUT...]\n"); return 2; }
    void *library = dlopen(given[1], RTLD_NOW | RTLD_LOCAL);
    if (!library) { fprintf(stderr, "%s\n", dlerror()); return 1; }
    Component (*instantiate)(const char *, int, const char *, const char *, const void *, int, int) = find(library, "fmi2Instantiate");
    int (*reset)(Component) = find(library, "fmi2Reset");
    int (*setup)(Component, int, double, double, int, double) = find(library, "fmi2SetupExperiment");
    int (*enter)(Component) = find(library, "fmi2EnterInitializationMode");
    int (*leave)(Component) = find(library, "fmi2ExitInitializationMode");
    int (*set_real)(Component, const Reference *, size_t, const double *) = find(library, "fmi2SetReal");
    int (*set_integer)(Component, const Reference *, size_t, const int *) = find(library, "fmi2SetInteger");
    int (*set_boolean)(Component, const Reference *, size_t, const int *) = find(library, "fmi2SetBoolean");
    int (*get_real)(Component, const Reference *, size_t, double *) = find(library, "fmi2GetReal");
    int (*step)(Component, double, double, int) = find(library, "fmi2DoStep");

    Reference reals[MOST], laters[MOST], integers[MOST], booleans[MOST], outputs[MOST], reference;
    double numbers[MOST], late[MOST], values[MOST], value;
    int wholes[MOST], truths[MOST];
    size_t n_reals = 0, n_laters = 0, n_integers = 0, n_booleans = 0, n_outputs = 0;
    char kind[16];
    FILE *file = fopen(given[3], "r");
    if (!file) { perror(given[3]); return 1; }
    while (fscanf(file, "%15s %u %lf", kind, &reference, &value) == 3 && n_reals + n_laters + n_integers + n_booleans < MOST) {
        if (!strcmp(kind, "Real")) { reals[n_reals] = reference; numbers[n_reals++] = value; }
        else if (!strcmp(kind, "Later")) { laters[n_laters] = reference; late[n_laters++] = value; }
        else if (!strcmp(kind, "Integer")) { integers[n_integers] = reference; wholes[n_integers++] = (int)value; }
        else { booleans[n_booleans] = reference; truths[n_booleans++] = (int)value; }
    }
    fclose(file);
    double stop = atof(given[4]), size = atof(given[5]);
    int runs = atoi(given[6]);
    for (int k = 7; k < count && n_outputs < MOST; ++k) outputs[n_outputs++] = (Reference)atoi(given[k]);
    long steps = size > 0.0 ? (long)(stop / size + 0.5) : 1;

    Component it = instantiate("calls", 1, given[2], "", NULL, 0, 0);
    if (!it) { fprintf(stderr, "no instance\n"); return 1; }
    for (int run = 0; run < runs; ++run) {
        double begin = now(CLOCK_MONOTONIC);
        if (run) check(reset(it), "reset");
        check(setup(it, 0, 0.0, 0.0, 1, stop), "setup");
        if (n_reals) check(set_real(it, reals, n_reals, numbers), "reals");
        if (n_integers) check(set_integer(it, integers, n_integers, wholes), "integers");
        if (n_booleans) check(set_boolean(it, booleans, n_booleans, truths), "booleans");
        check(enter(it), "enter");
        check(leave(it), "leave");
        if (n_laters) check(set_real(it, laters, n_laters, late), "later reals");
        check(get_real(it, outputs, n_outputs, values), "get");
        double stepping = now(CLOCK_PROCESS_CPUTIME_ID);
        for (long k = 0; k < steps; ++k) {
            double from = k * stop / steps, to = (k + 1) * stop / steps;
            check(step(it, from, to - from, 1), "step");
            if (n_outputs) check(get_real(it, outputs, n_outputs, values), "get");
        }
        stepping = now(CLOCK_PROCESS_CPUTIME_ID) - stepping;
        printf("%.9f %.9f\n", now(CLOCK_MONOTONIC) - begin, stepping);
    }
    return 0;
}
