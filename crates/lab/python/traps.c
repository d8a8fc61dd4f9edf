/* Tests of instances of the sources in C: the maximum number of instances, one of which stops with a trap; their allocations; and
   processors with unusual arithmetic. Compiled with the sources; with ARITHMETIC=1 the runtime fuses, and no instance can be created. */

#include <fenv.h>
#include <stdio.h>
#include <string.h>
#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#include "fmi2Functions.h"

#include "bd_unit.h"

static char last[1024];
static int failures;

static void keep(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status, fmi2String category, fmi2String text, ...) {
    (void)environment;
    (void)name;
    (void)status;
    (void)category;
    strncpy(last, text, sizeof last - 1);
}

static void expect(int is_so, const char *what) {
    if (is_so) return;
    printf("not so: %s (last message: %s)\n", what, last);
    ++failures;
}

static fmi2Component made(const char *guid) {
    static const fmi2CallbackFunctions callbacks = {keep, NULL, NULL, NULL, NULL};
    last[0] = 0;
    return fmi2Instantiate("one", fmi2CoSimulation, guid, "", &callbacks, fmi2False, fmi2False);
}

/* The GUID that the library requires, from its own message. */
static const char *guid(void) {
    static char found[64];
    if (!found[0]) {
        const char *said, *end;
        made("none");
        said = strrchr(last, '{');
        end = said ? strchr(said, '}') : NULL;
        if (end) memcpy(found, said, (size_t)(end - said) + 1);
    }
    return found;
}

static fmi2Real stepped(fmi2Component c, int steps) {
    const fmi2ValueReference reference = 200;
    fmi2Real value = 0.0;
    int k;
    fmi2SetupExperiment(c, fmi2False, 0.0, 0.0, fmi2False, 0.0);
    fmi2EnterInitializationMode(c);
    expect(fmi2ExitInitializationMode(c) == fmi2OK, "an instance starts");
    for (k = 0; k < steps; ++k) expect(fmi2DoStep(c, k * 1e-3, 1e-3, fmi2True) == fmi2OK, "an instance steps");
    expect(fmi2GetReal(c, &reference, 1, &value) == fmi2OK, "an instance is read");
    return value;
}

static u32 allocator_calls(fmi2Component c) { return bd_source_allocator_calls_0(&((bd_unit *)c)->machine); }

/* Nothing is allocated after the initialisation. The test would notice it, as it does for more values than any host reads in one call. */
static void with_allocation(void) {
    enum { MANY = 2000 };
    static fmi2ValueReference references[MANY];
    static fmi2Real values[MANY];
    fmi2Component c = made(guid());
    u32 before;
    int k;
    for (k = 0; k < MANY; ++k) references[k] = 200;
    stepped(c, 1);
    before = allocator_calls(c);
    expect(before > 0, "an instance allocates at its start");
    expect(fmi2DoStep(c, 1e-3, 1e-3, fmi2True) == fmi2OK && fmi2GetReal(c, references, 100, values) == fmi2OK, "an instance continues");
    expect(allocator_calls(c) == before, "steps allocate nothing");
    expect(fmi2GetReal(c, references, MANY, values) == fmi2OK && allocator_calls(c) > before, "an allocation is noticed");
    fmi2FreeInstance(c);
}

static void with_traps(void) {
    fmi2Component all[BD_INSTANCES];
    fmi2FMUstate state = NULL;
    fmi2Real before, after = 0.0;
    const fmi2ValueReference reference = 200;
    int k;
    for (k = 0; k < BD_INSTANCES; ++k) expect((all[k] = made(guid())) != NULL, "all instances are created");
    expect(!made(guid()) && strstr(last, "BD_INSTANCES"), "one more is refused, and the message names the limit");
    before = stepped(all[0], 3);
    stepped(all[1], 3);
    /* states */
    expect(fmi2GetFMUstate(all[0], &state) == fmi2OK && state, "a state is saved");
    expect(fmi2SetFMUstate(all[1], state) == fmi2Error, "a state of another instance is refused");
    expect(fmi2DoStep(all[0], 3e-3, 1e-3, fmi2False) == fmi2OK && fmi2SetFMUstate(all[0], state) == fmi2OK, "a state is restored");
    expect(fmi2GetReal(all[0], &reference, 1, &after) == fmi2OK && after == before, "it is the saved state");
    expect(fmi2FreeFMUstate(all[0], &state) == fmi2OK && !state, "a state is freed");
    /* a stack at its end: the next call accesses an address outside memory */
    ((bd_unit *)all[1])->machine.g0 = 64;
    expect(fmi2DoStep(all[1], 3e-3, 1e-3, fmi2True) == fmi2Fatal && strstr(last, "access outside"), "a trap is fatal and reported");
    expect(fmi2DoStep(all[1], 3e-3, 1e-3, fmi2True) == fmi2Fatal, "the instance is lost");
    expect(fmi2DoStep(all[0], 3e-3, 1e-3, fmi2True) == fmi2OK, "another instance still works");
    fmi2FreeInstance(all[1]);
    expect((all[1] = made(guid())) != NULL && stepped(all[1], 3) == before, "its memory works for a new instance");
    for (k = 0; k < BD_INSTANCES; ++k) fmi2FreeInstance(all[k]);
}

static void with_other_arithmetic(void) {
#if defined(__SSE__)
    const unsigned usual = _mm_getcsr();
    _mm_setcsr(usual | 0x8000);
    expect(!made(guid()) && strstr(last, "near zero"), "flushing to zero is refused");
    _mm_setcsr(usual | 0x0040);
    expect(!made(guid()) && strstr(last, "near zero"), "small numbers as zero are refused");
    _mm_setcsr(usual);
#endif
    fesetround(FE_UPWARD);
    expect(!made(guid()) && strstr(last, "nearest"), "another rounding is refused");
    fesetround(FE_TONEAREST);
}

int main(void) {
#if ARITHMETIC
    expect(!made("") && strstr(last, "fused"), "fused operations are refused");
#else
    guid();
    with_allocation();
    with_traps();
    with_other_arithmetic();
#endif
    return failures != 0;
}
