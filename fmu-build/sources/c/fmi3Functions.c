/* FMI 3.0 for co-simulation: passes the host's pointers, arrays and texts to the library, and results and messages back. */

#include "fmi3Functions.h"

#include "bd_unit.h"

#define BEGIN BD_BEGIN(c, fmi3Status)
/* calls a function of the library */
#define END(function, ...) return (fmi3Status)bd_ended(u, bd_##function##_0(&u->machine, u->component __VA_ARGS__))
#define M (&u->machine)

static void log_by_fmi3(const bd_host *host, int status, const char *category, const char *text) {
    ((fmi3LogMessageCallback)host->logger)(host->environment, (fmi3Status)status, category, text);
}

/* What the library does not have. */
static fmi3Status refused(fmi3Instance c, const char *why) {
    bd_unit *u = (bd_unit *)c;
    if (u && u->is_used && !u->is_dead) bd_say(&u->host, BD_ERROR, "logStatusError", why);
    return u && u->is_dead ? fmi3Fatal : fmi3Error;
}

static fmi3Instance no_instance(fmi3InstanceEnvironment environment, fmi3LogMessageCallback message) {
    if (message) message(environment, fmi3Error, "logStatusError", "this unit, in C for real time, is for co-simulation alone");
    return 0;
}

const char *fmi3GetVersion(void) { return fmi3Version; }

/* The instance of a machine that was just started; 0 if the library refuses it or stops. */
static u32 begun(bd_unit *u, fmi3String name, fmi3String token, fmi3Boolean logging, fmi3Boolean events, fmi3Boolean early) {
    enum { MOST = 256 };
    int reason = setjmp(u->machine.home);
    u32 room, component;
    if (reason) {
        bd_died(u, reason);
        return 0;
    }
    bd_source_start_0(M);
    room = bd_room(u, 2 * MOST);
    component = bd_source_instantiate_0(M, bd_put_text(u, room, name, MOST), bd_put_text(u, room + MOST, token, MOST), logging, events, early);
    bd_ended(u, BD_OK);
    return component;
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging,
                                         fmi3Boolean events, fmi3Boolean early, const fmi3ValueReference required[], size_t count,
                                         fmi3InstanceEnvironment environment, fmi3LogMessageCallback message,
                                         fmi3IntermediateUpdateCallback update) {
    bd_host host;
    bd_unit *u;
    (void)resources, (void)visible, (void)required, (void)count, (void)update;
    host.logger = (void (*)(void))message;
    host.environment = environment;
    host.log = log_by_fmi3;
    host.name[0] = 0;
    u = bd_take(&host, name);
    if (!u) return 0;
    u->component = begun(u, name, token, logging, events, early);
    if (!u->component) {
        bd_give_back(u);
        return 0;
    }
    return u;
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging,
                                          fmi3InstanceEnvironment environment, fmi3LogMessageCallback message) {
    (void)name, (void)token, (void)resources, (void)visible, (void)logging;
    return no_instance(environment, message);
}

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
                                               fmi3Boolean logging, fmi3InstanceEnvironment environment, fmi3LogMessageCallback message,
                                               fmi3ClockUpdateCallback update, fmi3LockPreemptionCallback lock,
                                               fmi3UnlockPreemptionCallback unlock) {
    (void)name, (void)token, (void)resources, (void)visible, (void)logging, (void)update, (void)lock, (void)unlock;
    return no_instance(environment, message);
}

void fmi3FreeInstance(fmi3Instance c) {
    /* its memory is begun anew for the next one */
    if (c) bd_give_back((bd_unit *)c);
}

fmi3Status fmi3SetDebugLogging(fmi3Instance c, fmi3Boolean on, size_t count, const fmi3String categories[]) {
    BEGIN;
    {
        const u32 list = bd_put_texts(u, categories, count);
        END(fmi3SetDebugLogging, , on, (u32)count, list);
    }
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance c, fmi3Boolean toleranceDefined, fmi3Float64 tolerance, fmi3Float64 start,
                                       fmi3Boolean stopDefined, fmi3Float64 stop) {
    BEGIN;
    END(fmi3EnterInitializationMode, , toleranceDefined, tolerance, start, stopDefined, stop);
}

#define PLAIN(function) \
    fmi3Status function(fmi3Instance c) { \
        BEGIN; \
        END(function, ); \
    }
PLAIN(fmi3ExitInitializationMode)
PLAIN(fmi3EnterConfigurationMode)
PLAIN(fmi3ExitConfigurationMode)
PLAIN(fmi3EnterEventMode)
PLAIN(fmi3EnterStepMode)
PLAIN(fmi3EvaluateDiscreteStates)
PLAIN(fmi3Terminate)
PLAIN(fmi3Reset)

/* Writes a truth, which the library keeps as a byte. */
static void get_truth(bd_unit *u, u32 place, fmi3Boolean *to) {
    if (to) *to = i32_load8_u(M, place, 0) != 0;
}

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance c, fmi3Boolean *again, fmi3Boolean *terminate, fmi3Boolean *nominals, fmi3Boolean *states,
                                    fmi3Boolean *defined, fmi3Float64 *next) {
    BEGIN;
    {
        const u32 room = bd_room(u, 2 * sizeof(fmi3Float64)), at = room + 8;
        const u32 status = bd_fmi3UpdateDiscreteStates_0(M, u->component, again ? at : 0, terminate ? at + 1 : 0, nominals ? at + 2 : 0,
                                                         states ? at + 3 : 0, defined ? at + 4 : 0, next ? room : 0);
        if (status <= BD_WARNING) {
            get_truth(u, at, again);
            get_truth(u, at + 1, terminate);
            get_truth(u, at + 2, nominals);
            get_truth(u, at + 3, states);
            get_truth(u, at + 4, defined);
            bd_get(u, room, next, sizeof *next);
        }
        return (fmi3Status)bd_ended(u, status);
    }
}

fmi3Status fmi3DoStep(fmi3Instance c, fmi3Float64 point, fmi3Float64 size, fmi3Boolean neverBack, fmi3Boolean *event, fmi3Boolean *terminate,
                      fmi3Boolean *early, fmi3Float64 *last) {
    BEGIN;
    {
        const u32 room = bd_room(u, 2 * sizeof(fmi3Float64)), at = room + 8;
        u32 status;
        /* what the library does not write stays the host's */
        i32_store8(M, at, 0, event && *event);
        i32_store8(M, at, 1, terminate && *terminate);
        i32_store8(M, at, 2, early && *early);
        bd_put(u, room, last, sizeof *last);
        status = bd_fmi3DoStep_0(M, u->component, point, size, neverBack, event ? at : 0, terminate ? at + 1 : 0, early ? at + 2 : 0, last ? room : 0);
        get_truth(u, at, event);
        get_truth(u, at + 1, terminate);
        get_truth(u, at + 2, early);
        bd_get(u, room, last, sizeof *last);
        return (fmi3Status)bd_ended(u, status);
    }
}

/* References and values in the room one behind the other, the values first as they are wider. */
#define VALUES(bytes) \
    const u32 at = bd_room(u, n * (bytes) + count * sizeof(u32)), references = at + (u32)(n * (bytes)); \
    bd_put(u, references, vr, count * sizeof(u32))
#define PASSED (vr ? references : 0), (u32)count, (values ? at : 0), (u32)n

/* `width`: bytes of a value; those of less than a reference come in whole references */
#define WIDE(type) (sizeof(type) < sizeof(u32) ? sizeof(u32) : sizeof(type))
#define GET(function, type) \
    fmi3Status function(fmi3Instance c, const fmi3ValueReference vr[], size_t count, type values[], size_t n) { \
        BEGIN; \
        { \
            u32 status; \
            VALUES(WIDE(type)); \
            status = bd_##function##_0(M, u->component, PASSED); \
            if (status <= BD_WARNING) bd_get(u, at, values, n * sizeof(type)); \
            return (fmi3Status)bd_ended(u, status); \
        } \
    }
#define SET(function, type) \
    fmi3Status function(fmi3Instance c, const fmi3ValueReference vr[], size_t count, const type values[], size_t n) { \
        BEGIN; \
        { \
            VALUES(WIDE(type)); \
            bd_put(u, at, values, n * sizeof(type)); \
            END(function, , PASSED); \
        } \
    }
GET(fmi3GetFloat64, fmi3Float64)
GET(fmi3GetInt32, fmi3Int32)
GET(fmi3GetInt64, fmi3Int64)
GET(fmi3GetUInt64, fmi3UInt64)
GET(fmi3GetBoolean, fmi3Boolean)
SET(fmi3SetFloat64, fmi3Float64)
SET(fmi3SetInt32, fmi3Int32)
SET(fmi3SetInt64, fmi3Int64)
SET(fmi3SetUInt64, fmi3UInt64)
SET(fmi3SetBoolean, fmi3Boolean)

fmi3Status fmi3GetString(fmi3Instance c, const fmi3ValueReference vr[], size_t count, fmi3String values[], size_t n) {
    BEGIN;
    {
        u32 status;
        size_t k;
        VALUES(sizeof(u32));
        status = bd_fmi3GetString_0(M, u->component, PASSED);
        for (k = 0; values && k < n && status <= BD_WARNING; ++k) values[k] = (fmi3String)bd_to_host(u, i32_load(M, at, (u32)(k * sizeof(u32))));
        return (fmi3Status)bd_ended(u, status);
    }
}

/* states */
fmi3Status fmi3GetFMUState(fmi3Instance c, fmi3FMUState *state) {
    BEGIN;
    return (fmi3Status)bd_get_or_free_state(u, bd_fmi3GetFMUState_0, state);
}

fmi3Status fmi3FreeFMUState(fmi3Instance c, fmi3FMUState *state) {
    BEGIN;
    return (fmi3Status)bd_get_or_free_state(u, bd_fmi3FreeFMUState_0, state);
}

fmi3Status fmi3SetFMUState(fmi3Instance c, fmi3FMUState state) {
    BEGIN;
    END(fmi3SetFMUState, , bd_from_host(u, state));
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance c, fmi3FMUState state, size_t *size) {
    BEGIN;
    return (fmi3Status)bd_size_of_state(u, bd_fmi3SerializedFMUStateSize_0, state, size);
}

fmi3Status fmi3SerializeFMUState(fmi3Instance c, fmi3FMUState state, fmi3Byte bytes[], size_t size) {
    BEGIN;
    return (fmi3Status)bd_serialize_state(u, bd_fmi3SerializeFMUState_0, state, bytes, size);
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance c, const fmi3Byte bytes[], size_t size, fmi3FMUState *state) {
    BEGIN;
    return (fmi3Status)bd_deserialize_state(u, bd_fmi3DeserializeFMUState_0, bytes, size, state);
}

/* All the rest of FMI 3.0: there are no such variables, no clocks, no solver of the host's, no derivatives. */
#define NONE(what) return count ? refused(c, what) : fmi3OK
#define NO_VARIABLES(type) \
    fmi3Status fmi3Get##type(fmi3Instance c, const fmi3ValueReference vr[], size_t count, fmi3##type values[], size_t n) { \
        (void)vr, (void)values, (void)n; \
        NONE("fmi3Get" #type ": there are no such variables"); \
    } \
    fmi3Status fmi3Set##type(fmi3Instance c, const fmi3ValueReference vr[], size_t count, const fmi3##type values[], size_t n) { \
        (void)vr, (void)values, (void)n; \
        NONE("fmi3Set" #type ": there are no such variables"); \
    }
NO_VARIABLES(Float32)
NO_VARIABLES(Int8)
NO_VARIABLES(UInt8)
NO_VARIABLES(Int16)
NO_VARIABLES(UInt16)
NO_VARIABLES(UInt32)

/* functions of an instance and up to three further arguments */
#define REFUSED(function, why, A, B, C) \
    fmi3Status function(fmi3Instance c, const fmi3ValueReference vr[], size_t count, A, B, C) { \
        (void)vr, (void)x, (void)y, (void)z; \
        NONE(#function ": there are no " why); \
    }
#define REFUSED2(function, why, A, B) \
    fmi3Status function(fmi3Instance c, const fmi3ValueReference vr[], size_t count, A, B) { \
        (void)vr, (void)x, (void)y; \
        NONE(#function ": there are no " why); \
    }
#define REFUSED1(function, why, A) \
    fmi3Status function(fmi3Instance c, const fmi3ValueReference vr[], size_t count, A) { \
        (void)vr, (void)x; \
        NONE(#function ": there are no " why); \
    }
REFUSED2(fmi3SetString, "Strings that can be set", const fmi3String x[], size_t y)
REFUSED(fmi3GetBinary, "binary variables", size_t x[], fmi3Binary y[], size_t z)
REFUSED(fmi3SetBinary, "binary variables", const size_t x[], const fmi3Binary y[], size_t z)
REFUSED1(fmi3GetClock, "clocks", fmi3Clock x[])
REFUSED1(fmi3SetClock, "clocks", const fmi3Clock x[])
REFUSED2(fmi3GetIntervalDecimal, "clocks", fmi3Float64 x[], fmi3IntervalQualifier y[])
REFUSED(fmi3GetIntervalFraction, "clocks", fmi3UInt64 x[], fmi3UInt64 y[], fmi3IntervalQualifier z[])
REFUSED1(fmi3GetShiftDecimal, "clocks", fmi3Float64 x[])
REFUSED2(fmi3GetShiftFraction, "clocks", fmi3UInt64 x[], fmi3UInt64 y[])
REFUSED1(fmi3SetIntervalDecimal, "clocks", const fmi3Float64 x[])
REFUSED2(fmi3SetIntervalFraction, "clocks", const fmi3UInt64 x[], const fmi3UInt64 y[])
REFUSED1(fmi3SetShiftDecimal, "clocks", const fmi3Float64 x[])
REFUSED2(fmi3SetShiftFraction, "clocks", const fmi3UInt64 x[], const fmi3UInt64 y[])
REFUSED(fmi3GetOutputDerivatives, "derivatives of outputs", const fmi3Int32 x[], fmi3Float64 y[], size_t z)

fmi3Status fmi3ActivateModelPartition(fmi3Instance c, fmi3ValueReference clock, fmi3Float64 time) {
    (void)clock, (void)time;
    return refused(c, "fmi3ActivateModelPartition: there are no clocks");
}

fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance c, fmi3ValueReference vr, size_t *count) {
    (void)vr, (void)count;
    return refused(c, "fmi3GetNumberOfVariableDependencies: see the model description");
}

fmi3Status fmi3GetVariableDependencies(fmi3Instance c, fmi3ValueReference vr, size_t of[], fmi3ValueReference others[], size_t by[],
                                       fmi3DependencyKind kinds[], size_t count) {
    (void)vr, (void)of, (void)others, (void)by, (void)kinds, (void)count;
    return refused(c, "fmi3GetVariableDependencies: see the model description");
}

#define SENSITIVITY(function) \
    fmi3Status function(fmi3Instance c, const fmi3ValueReference unknown[], size_t unknowns, const fmi3ValueReference known[], size_t knowns, \
                        const fmi3Float64 seed[], size_t seeds, fmi3Float64 values[], size_t n) { \
        (void)unknown, (void)unknowns, (void)known, (void)knowns, (void)seed, (void)seeds, (void)values, (void)n; \
        return refused(c, #function ": this unit, in C for real time, has no derivatives of variables"); \
    }
SENSITIVITY(fmi3GetDirectionalDerivative)
SENSITIVITY(fmi3GetAdjointDerivative)

/* of model exchange */
#define EXCHANGE refused(c, "this call is for model exchange, but the instance is for co-simulation")
fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance c) { return EXCHANGE; }
fmi3Status fmi3SetTime(fmi3Instance c, fmi3Float64 time) { return (void)time, EXCHANGE; }
fmi3Status fmi3CompletedIntegratorStep(fmi3Instance c, fmi3Boolean neverBack, fmi3Boolean *event, fmi3Boolean *terminate) {
    return (void)neverBack, (void)event, (void)terminate, EXCHANGE;
}
fmi3Status fmi3SetContinuousStates(fmi3Instance c, const fmi3Float64 x[], size_t n) { return (void)x, (void)n, EXCHANGE; }
fmi3Status fmi3GetContinuousStates(fmi3Instance c, fmi3Float64 x[], size_t n) { return (void)x, (void)n, EXCHANGE; }
fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance c, fmi3Float64 x[], size_t n) { return (void)x, (void)n, EXCHANGE; }
fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance c, fmi3Float64 x[], size_t n) { return (void)x, (void)n, EXCHANGE; }
fmi3Status fmi3GetEventIndicators(fmi3Instance c, fmi3Float64 x[], size_t n) { return (void)x, (void)n, EXCHANGE; }
fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance c, size_t *n) { return (void)n, EXCHANGE; }
fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance c, size_t *n) { return (void)n, EXCHANGE; }
