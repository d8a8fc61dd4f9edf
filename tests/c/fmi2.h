/* Support for hosts in C: the FMI 2.0 functions that they use, loaded at run time, a logger, and checks. */

#ifndef FMI2_H
#define FMI2_H

#include <dlfcn.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef enum { OK, WARNING, DISCARD, ERROR, FATAL, PENDING } Status;
enum { MODEL_EXCHANGE, CO_SIMULATION };
enum { STATES = 34, INDICATORS = 29 };

typedef struct {
    void (*logger)(void *, const char *, Status, const char *, const char *, ...);
    void *(*allocate)(size_t, size_t);
    void (*release)(void *);
    void (*finished)(void *, Status);
    void *environment;
} Callbacks;

typedef struct {
    int again, terminate, nominals, states, next_defined;
    double next;
} EventInfo;

/* name, result, arguments */
#define FUNCTIONS(F) \
    F(Instantiate, void *, (const char *, int, const char *, const char *, const Callbacks *, int, int)) \
    F(FreeInstance, void, (void *)) \
    F(SetDebugLogging, Status, (void *, int, size_t, const char *const *)) \
    F(SetupExperiment, Status, (void *, int, double, double, int, double)) \
    F(EnterInitializationMode, Status, (void *)) \
    F(ExitInitializationMode, Status, (void *)) \
    F(Terminate, Status, (void *)) \
    F(Reset, Status, (void *)) \
    F(GetReal, Status, (void *, const unsigned *, size_t, double *)) \
    F(GetInteger, Status, (void *, const unsigned *, size_t, int *)) \
    F(GetBoolean, Status, (void *, const unsigned *, size_t, int *)) \
    F(SetReal, Status, (void *, const unsigned *, size_t, const double *)) \
    F(SetInteger, Status, (void *, const unsigned *, size_t, const int *)) \
    F(SetBoolean, Status, (void *, const unsigned *, size_t, const int *)) \
    F(GetFMUstate, Status, (void *, void **)) \
    F(SetFMUstate, Status, (void *, void *)) \
    F(FreeFMUstate, Status, (void *, void **)) \
    F(SerializedFMUstateSize, Status, (void *, void *, size_t *)) \
    F(SerializeFMUstate, Status, (void *, void *, char *, size_t)) \
    F(DeSerializeFMUstate, Status, (void *, const char *, size_t, void **)) \
    F(GetDirectionalDerivative, Status, (void *, const unsigned *, size_t, const unsigned *, size_t, const double *, double *)) \
    F(EnterEventMode, Status, (void *)) \
    F(NewDiscreteStates, Status, (void *, EventInfo *)) \
    F(EnterContinuousTimeMode, Status, (void *)) \
    F(CompletedIntegratorStep, Status, (void *, int, int *, int *)) \
    F(SetTime, Status, (void *, double)) \
    F(SetContinuousStates, Status, (void *, const double *, size_t)) \
    F(GetDerivatives, Status, (void *, double *, size_t)) \
    F(GetEventIndicators, Status, (void *, double *, size_t)) \
    F(GetContinuousStates, Status, (void *, double *, size_t)) \
    F(GetNominalsOfContinuousStates, Status, (void *, double *, size_t)) \
    F(SetRealInputDerivatives, Status, (void *, const unsigned *, size_t, const int *, const double *)) \
    F(GetRealOutputDerivatives, Status, (void *, const unsigned *, size_t, const int *, double *)) \
    F(DoStep, Status, (void *, double, double, int)) \
    F(CancelStep, Status, (void *)) \
    F(GetStatus, Status, (void *, int, Status *)) \
    F(GetRealStatus, Status, (void *, int, double *))

#define DECLARE(name, result, arguments) static result(*name) arguments;
FUNCTIONS(DECLARE)
#undef DECLARE

/* Opens the library and looks up its functions. */
static void open_library(const char *path)
{
    void *library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!library) {
        fprintf(stderr, "%s\n", dlerror());
        exit(2);
    }
#define FIND(name, result, arguments) \
    if (!(*(void **)&name = dlsym(library, "fmi2" #name))) { \
        fprintf(stderr, "fmi2" #name " is missing\n"); \
        exit(2); \
    }
    FUNCTIONS(FIND)
#undef FIND
}

/* File for reports of failed checks. NULL selects standard error. */
static FILE *reports;

/* Ends the program if `condition` is false. */
#define MUST(condition) \
    do { \
        if (!(condition)) { \
            fprintf(reports ? reports : stderr, "%s:%d: %s\n", __FILE__, __LINE__, #condition); \
            exit(1); \
        } \
    } while (0)

/* Counts messages in the `long` at `environment`. It reads every byte, so that memcheck finds uninitialised bytes. */
static void count_message(void *environment, const char *name, Status status, const char *category, const char *text, ...)
{
    if (strlen(name) && strlen(category) && strlen(text) && status <= ERROR)
        ++*(long *)environment;
}

/* Callbacks whose logger counts its messages in `count`. */
static Callbacks counting(long *count)
{
    return (Callbacks){count_message, NULL, NULL, NULL, count};
}

#endif
