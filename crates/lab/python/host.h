/* What hosts in C share: the functions of an FMU's library, start values from a file, the clock. */

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define MOST 256

typedef void *Component;
typedef unsigned Reference;

static struct {
    Component (*instantiate)(const char *, int, const char *, const char *, const void *, int, int);
    int (*reset)(Component), (*enter)(Component), (*leave)(Component);
    int (*setup)(Component, int, double, double, int, double);
    int (*set_real)(Component, const Reference *, size_t, const double *);
    int (*set_integer)(Component, const Reference *, size_t, const int *);
    int (*set_boolean)(Component, const Reference *, size_t, const int *);
    int (*get_real)(Component, const Reference *, size_t, double *);
    int (*get_integer)(Component, const Reference *, size_t, int *);
    int (*get_boolean)(Component, const Reference *, size_t, int *);
    int (*slopes)(Component, const Reference *, size_t, const int *, const double *);
    int (*step)(Component, double, double, int);
} fmi;

/* Start values: Reals, those that are set after initialisation, Integers, Booleans. */
static struct {
    Reference reals[MOST], laters[MOST], integers[MOST], booleans[MOST];
    double numbers[MOST], late[MOST];
    int wholes[MOST], truths[MOST];
    size_t n_reals, n_laters, n_integers, n_booleans;
} start;

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

/* Reads start values: lines "Real|Integer|Boolean|Later REFERENCE VALUE". */
static void read_start(const char *name) {
    char kind[16];
    Reference reference;
    double value;
    FILE *file = fopen(name, "r");
    if (!file) { perror(name); exit(1); }
    while (fscanf(file, "%15s %u %lf", kind, &reference, &value) == 3
           && start.n_reals + start.n_laters + start.n_integers + start.n_booleans < MOST) {
        if (!strcmp(kind, "Real")) { start.reals[start.n_reals] = reference; start.numbers[start.n_reals++] = value; }
        else if (!strcmp(kind, "Later")) { start.laters[start.n_laters] = reference; start.late[start.n_laters++] = value; }
        else if (!strcmp(kind, "Integer")) {
            start.integers[start.n_integers] = reference;
            start.wholes[start.n_integers++] = (int)value;
        } else { start.booleans[start.n_booleans] = reference; start.truths[start.n_booleans++] = (int)value; }
    }
    fclose(file);
}

/* An instance of the library for co-simulation. */
static Component made(const char *path, const char *guid) {
    void *library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!library) { fprintf(stderr, "%s\n", dlerror()); exit(1); }
#define LOAD(field, name) fmi.field = find(library, "fmi2" name)
    LOAD(instantiate, "Instantiate"); LOAD(reset, "Reset"); LOAD(setup, "SetupExperiment"); LOAD(enter, "EnterInitializationMode");
    LOAD(leave, "ExitInitializationMode"); LOAD(set_real, "SetReal"); LOAD(set_integer, "SetInteger"); LOAD(set_boolean, "SetBoolean");
    LOAD(get_real, "GetReal"); LOAD(get_integer, "GetInteger"); LOAD(get_boolean, "GetBoolean"); LOAD(slopes, "SetRealInputDerivatives"); LOAD(step, "DoStep");
#undef LOAD
    Component it = fmi.instantiate("host", 1, guid, "", NULL, 0, 0);
    if (!it) { fprintf(stderr, "no instance\n"); exit(1); }
    return it;
}

/* Sets the start values, and initialises for a run to `stop`. */
static void initialise(Component it, double stop) {
    check(fmi.setup(it, 0, 0.0, 0.0, 1, stop), "setup");
    if (start.n_reals) check(fmi.set_real(it, start.reals, start.n_reals, start.numbers), "reals");
    if (start.n_integers) check(fmi.set_integer(it, start.integers, start.n_integers, start.wholes), "integers");
    if (start.n_booleans) check(fmi.set_boolean(it, start.booleans, start.n_booleans, start.truths), "booleans");
    check(fmi.enter(it), "enter");
    check(fmi.leave(it), "leave");
    if (start.n_laters) check(fmi.set_real(it, start.laters, start.n_laters, start.late), "later reals");
}
