/* FMI 2.0 for co-simulation: passes the host's pointers, arrays and texts to the library, and results and messages back. */

#include "bd_unit.h"

#define M (&u->machine)
/* Start of every call: `u` is the instance of the component `c`. After a trap, the function that contains this returns. */
#define BEGIN \
    bd_unit *const u = (bd_unit *)c; \
    int reason; \
    if (!u || !u->is_used) return fmi2Error; \
    if (u->is_dead) return fmi2Fatal; \
    reason = setjmp(u->machine.home); \
    if (reason) return bd_died(u, reason)
/* Calls the library's function fmi2`name`. */
#define CALL(name, ...) bd_fmi2##name##_0(M, u->component __VA_ARGS__)
#define END(name, ...) return bd_ended(u, CALL(name, __VA_ARGS__))

const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }

const char *fmi2GetVersion(void) { return fmi2Version; }

/* Creates the instance of a machine that was just started; 0 if the library refuses it or stops. */
static u32 begun(bd_unit *u, fmi2String name, fmi2Type type, fmi2String guid, fmi2Boolean logging) {
    enum { MOST = 256 };
    int reason = setjmp(u->machine.home);
    u32 room, component;
    if (reason) {
        bd_died(u, reason);
        return 0;
    }
    bd_source_start_0(M);
    room = bd_room(u, 2 * MOST);
    component = bd_source_instantiate_0(M, bd_put_text(u, room, name, MOST), (u32)type, bd_put_text(u, room + MOST, guid, MOST), (u32)logging);
    bd_ended(u, fmi2OK);
    return component;
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources, const fmi2CallbackFunctions *functions,
                              fmi2Boolean visible, fmi2Boolean logging) {
    bd_unit *u;
    (void)resources;
    (void)visible;
    u = bd_take(functions, name);
    if (!u) return 0;
    u->component = begun(u, name, type, guid, logging);
    u->is_used = u->component != 0;
    return u->is_used ? u : 0;
}

void fmi2FreeInstance(fmi2Component c) {
    /* its memory is initialised again for the next instance */
    if (c) ((bd_unit *)c)->is_used = 0;
}

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t count, const fmi2String categories[]) {
    BEGIN;
    {
        const u32 list = bd_put_texts(u, categories, count);
        END(SetDebugLogging, , (u32)on, (u32)count, list);
    }
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean toleranceDefined, fmi2Real tolerance, fmi2Real start, fmi2Boolean stopDefined,
                               fmi2Real stop) {
    BEGIN;
    END(SetupExperiment, , (u32)toleranceDefined, tolerance, start, (u32)stopDefined, stop);
}

#define PLAIN(name) \
    fmi2Status fmi2##name(fmi2Component c) { \
        BEGIN; \
        END(name, ); \
    }
PLAIN(EnterInitializationMode)
PLAIN(ExitInitializationMode)
PLAIN(Terminate)
PLAIN(Reset)
PLAIN(CancelStep)

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real point, fmi2Real size, fmi2Boolean neverBack) {
    BEGIN;
    END(DoStep, , point, size, (u32)neverBack);
}

/* Values: an array of values followed by an array of references in the room; the values are first because they are wider. */
#define VALUES(bytes) \
    const u32 values = bd_room(u, count * ((bytes) + sizeof(u32))), references = values + (u32)(count * (bytes)); \
    bd_put(u, references, vr, count * sizeof(u32))
#define PASSED (vr ? references : 0), (u32)count, (value ? values : 0)

#define GET(name, type) \
    fmi2Status fmi2##name(fmi2Component c, const fmi2ValueReference vr[], size_t count, type value[]) { \
        BEGIN; \
        { \
            u32 status; \
            VALUES(sizeof(type)); \
            status = CALL(name, , PASSED); \
            if (status <= fmi2Warning) bd_get(u, values, value, count * sizeof(type)); \
            return bd_ended(u, status); \
        } \
    }
#define SET(name, type) \
    fmi2Status fmi2##name(fmi2Component c, const fmi2ValueReference vr[], size_t count, const type value[]) { \
        BEGIN; \
        { \
            VALUES(sizeof(type)); \
            bd_put(u, values, value, count * sizeof(type)); \
            END(name, , PASSED); \
        } \
    }
/* no variable is a text: the library needs only the references to refuse the call */
#define TEXTS(name, type) \
    fmi2Status fmi2##name(fmi2Component c, const fmi2ValueReference vr[], size_t count, type value[]) { \
        BEGIN; \
        { \
            VALUES(0); \
            END(name, , PASSED); \
        } \
    }
GET(GetReal, fmi2Real)
GET(GetInteger, fmi2Integer)
GET(GetBoolean, fmi2Boolean)
TEXTS(GetString, fmi2String)
SET(SetReal, fmi2Real)
SET(SetInteger, fmi2Integer)
SET(SetBoolean, fmi2Boolean)
TEXTS(SetString, const fmi2String)

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t count, const fmi2Integer order[],
                                       const fmi2Real value[]) {
    BEGIN;
    {
        u32 orders;
        VALUES(sizeof(fmi2Real) + sizeof(fmi2Integer));
        orders = values + (u32)(count * sizeof(fmi2Real));
        bd_put(u, values, value, count * sizeof(fmi2Real));
        bd_put(u, orders, order, count * sizeof(fmi2Integer));
        END(SetRealInputDerivatives, , vr ? references : 0, (u32)count, order ? orders : 0, value ? values : 0);
    }
}

/* features that real-time targets do not need are refused by the library, with a message */
fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t count, const fmi2Integer order[], fmi2Real value[]) {
    (void)vr, (void)count, (void)order, (void)value;
    BEGIN;
    END(GetRealOutputDerivatives, , 0, 0, 0, 0);
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknown[], size_t unknowns, const fmi2ValueReference known[],
                                        size_t knowns, const fmi2Real change[], fmi2Real value[]) {
    (void)unknown, (void)unknowns, (void)known, (void)knowns, (void)change, (void)value;
    BEGIN;
    END(GetDirectionalDerivative, , 0, 0, 0, 0, 0, 0);
}

#define STATUS(name, type) \
    fmi2Status fmi2##name(fmi2Component c, const fmi2StatusKind kind, type *value) { \
        BEGIN; \
        { \
            const u32 room = bd_room(u, sizeof(fmi2Real)), status = CALL(name, , (u32)kind, value ? room : 0); \
            if (status <= fmi2Warning) bd_get(u, room, value, sizeof(type)); \
            return bd_ended(u, status); \
        } \
    }
STATUS(GetStatus, fmi2Status)
STATUS(GetRealStatus, fmi2Real)
STATUS(GetIntegerStatus, fmi2Integer)
STATUS(GetBooleanStatus, fmi2Boolean)

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind kind, fmi2String *value) {
    BEGIN;
    {
        const u32 room = bd_room(u, sizeof(u32)), status = CALL(GetStringStatus, , (u32)kind, value ? room : 0);
        if (value && status <= fmi2Warning) *value = (fmi2String)bd_to_host(u, i32_load(M, room, 0));
        return bd_ended(u, status);
    }
}

/* States are in the memory of their instance, and the host's pointers point there. */
static void put_state(bd_unit *u, u32 place, void *const *state) {
    if (state) i32_store(M, place, 0, bd_from_host(u, *state));
}
static void get_state(bd_unit *u, u32 place, u32 status, void **state) {
    if (state && status <= fmi2Warning) *state = bd_to_host(u, i32_load(M, place, 0));
}

#define STATE(name) \
    fmi2Status fmi2##name(fmi2Component c, fmi2FMUstate *state) { \
        BEGIN; \
        { \
            const u32 room = bd_room(u, sizeof(u32)); \
            u32 status; \
            put_state(u, room, state); \
            status = CALL(name, , state ? room : 0); \
            get_state(u, room, status, state); \
            return bd_ended(u, status); \
        } \
    }
STATE(GetFMUstate)
STATE(FreeFMUstate)

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state) {
    BEGIN;
    END(SetFMUstate, , bd_from_host(u, state));
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size) {
    BEGIN;
    {
        const u32 room = bd_room(u, sizeof(u32)), status = CALL(SerializedFMUstateSize, , bd_from_host(u, state), size ? room : 0);
        if (size && status <= fmi2Warning) *size = i32_load(M, room, 0);
        return bd_ended(u, status);
    }
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size) {
    BEGIN;
    {
        const u32 room = bd_room(u, size), status = CALL(SerializeFMUstate, , bd_from_host(u, state), bytes ? room : 0, (u32)size);
        if (status <= fmi2Warning) bd_get(u, room, bytes, size);
        return bd_ended(u, status);
    }
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *state) {
    BEGIN;
    {
        const u32 room = bd_room(u, sizeof(u64) + size);
        u32 status;
        bd_put(u, room + 8, bytes, size);
        put_state(u, room, state);
        status = CALL(DeSerializeFMUstate, , bytes ? room + 8 : 0, (u32)size, state ? room : 0);
        get_state(u, room, status, state);
        return bd_ended(u, status);
    }
}
