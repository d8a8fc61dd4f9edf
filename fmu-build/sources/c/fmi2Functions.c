/* FMI 2.0 for co-simulation: passes the host's pointers, arrays and texts to the library, and results and messages back. */

#include "fmi2Functions.h"

#include "bd_unit.h"

#define BEGIN BD_BEGIN(c, fmi2Status)
/* calls a function of the library */
#define END(function, ...) return (fmi2Status)bd_ended(u, bd_##function##_0(&u->machine, u->component __VA_ARGS__))
#define M (&u->machine)

static void log_by_fmi2(const bd_host *host, int status, const char *category, const char *text) {
    /* messages have no conversions: each is a format of printf that prints itself */
    ((fmi2CallbackLogger)host->logger)(host->environment, host->name, (fmi2Status)status, category, text);
}

const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }

const char *fmi2GetVersion(void) { return fmi2Version; }

/* The instance of a machine that was just started; 0 if the library refuses it or stops. */
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
    bd_ended(u, BD_OK);
    return component;
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources, const fmi2CallbackFunctions *functions,
                              fmi2Boolean visible, fmi2Boolean logging) {
    bd_host host;
    bd_unit *u;
    (void)resources;
    (void)visible;
    host.logger = functions ? (void (*)(void))functions->logger : 0;
    host.environment = functions ? functions->componentEnvironment : 0;
    host.log = log_by_fmi2;
    host.name[0] = 0;
    u = bd_take(&host, name);
    if (!u) return 0;
    u->component = begun(u, name, type, guid, logging);
    if (!u->component) {
        bd_give_back(u);
        return 0;
    }
    return u;
}

void fmi2FreeInstance(fmi2Component c) {
    /* its memory is begun anew for the next one */
    if (c) bd_give_back((bd_unit *)c);
}

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t count, const fmi2String categories[]) {
    BEGIN;
    {
        const u32 list = bd_put_texts(u, categories, count);
        END(fmi2SetDebugLogging, , (u32)on, (u32)count, list);
    }
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean toleranceDefined, fmi2Real tolerance, fmi2Real start, fmi2Boolean stopDefined,
                               fmi2Real stop) {
    BEGIN;
    END(fmi2SetupExperiment, , (u32)toleranceDefined, tolerance, start, (u32)stopDefined, stop);
}

#define PLAIN(function) \
    fmi2Status function(fmi2Component c) { \
        BEGIN; \
        END(function, ); \
    }
PLAIN(fmi2EnterInitializationMode)
PLAIN(fmi2ExitInitializationMode)
PLAIN(fmi2Terminate)
PLAIN(fmi2Reset)
PLAIN(fmi2CancelStep)

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real point, fmi2Real size, fmi2Boolean neverBack) {
    BEGIN;
    END(fmi2DoStep, , point, size, (u32)neverBack);
}

/* Values: an array of references and one of values, in the room one behind the other, the values first as they are wider. */
#define VALUES(bytes) \
    const u32 values = bd_room(u, count * ((bytes) + sizeof(u32))), references = values + (u32)(count * (bytes)); \
    bd_put(u, references, vr, count * sizeof(u32))
#define PASSED (vr ? references : 0), (u32)count, (value ? values : 0)

#define GET(function, type) \
    fmi2Status function(fmi2Component c, const fmi2ValueReference vr[], size_t count, type value[]) { \
        BEGIN; \
        { \
            u32 status; \
            VALUES(sizeof(type)); \
            status = bd_##function##_0(M, u->component, PASSED); \
            if (status <= BD_WARNING) bd_get(u, values, value, count * sizeof(type)); \
            return (fmi2Status)bd_ended(u, status); \
        } \
    }
#define SET(function, type) \
    fmi2Status function(fmi2Component c, const fmi2ValueReference vr[], size_t count, const type value[]) { \
        BEGIN; \
        { \
            VALUES(sizeof(type)); \
            bd_put(u, values, value, count * sizeof(type)); \
            END(function, , PASSED); \
        } \
    }
/* there are no texts among the variables: what the library needs to say so is the references alone */
#define TEXTS(function, type) \
    fmi2Status function(fmi2Component c, const fmi2ValueReference vr[], size_t count, type value[]) { \
        BEGIN; \
        { \
            VALUES(0); \
            END(function, , PASSED); \
        } \
    }
GET(fmi2GetReal, fmi2Real)
GET(fmi2GetInteger, fmi2Integer)
GET(fmi2GetBoolean, fmi2Boolean)
TEXTS(fmi2GetString, fmi2String)
SET(fmi2SetReal, fmi2Real)
SET(fmi2SetInteger, fmi2Integer)
SET(fmi2SetBoolean, fmi2Boolean)
TEXTS(fmi2SetString, const fmi2String)

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t count, const fmi2Integer order[],
                                       const fmi2Real value[]) {
    BEGIN;
    {
        u32 orders;
        VALUES(sizeof(fmi2Real) + sizeof(fmi2Integer));
        orders = values + (u32)(count * sizeof(fmi2Real));
        bd_put(u, values, value, count * sizeof(fmi2Real));
        bd_put(u, orders, order, count * sizeof(fmi2Integer));
        END(fmi2SetRealInputDerivatives, , vr ? references : 0, (u32)count, order ? orders : 0, value ? values : 0);
    }
}

/* what real-time targets do without is refused by the library, with a message */
fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t count, const fmi2Integer order[], fmi2Real value[]) {
    (void)vr, (void)count, (void)order, (void)value;
    BEGIN;
    END(fmi2GetRealOutputDerivatives, , 0, 0, 0, 0);
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknown[], size_t unknowns, const fmi2ValueReference known[],
                                        size_t knowns, const fmi2Real change[], fmi2Real value[]) {
    (void)unknown, (void)unknowns, (void)known, (void)knowns, (void)change, (void)value;
    BEGIN;
    END(fmi2GetDirectionalDerivative, , 0, 0, 0, 0, 0, 0);
}

#define STATUS(function, type) \
    fmi2Status function(fmi2Component c, const fmi2StatusKind kind, type *value) { \
        BEGIN; \
        { \
            const u32 room = bd_room(u, sizeof(fmi2Real)), status = bd_##function##_0(M, u->component, (u32)kind, value ? room : 0); \
            if (status <= BD_WARNING) bd_get(u, room, value, sizeof(type)); \
            return (fmi2Status)bd_ended(u, status); \
        } \
    }
STATUS(fmi2GetStatus, fmi2Status)
STATUS(fmi2GetRealStatus, fmi2Real)
STATUS(fmi2GetIntegerStatus, fmi2Integer)
STATUS(fmi2GetBooleanStatus, fmi2Boolean)

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind kind, fmi2String *value) {
    BEGIN;
    {
        const u32 room = bd_room(u, sizeof(u32)), status = bd_fmi2GetStringStatus_0(M, u->component, (u32)kind, value ? room : 0);
        if (value && status <= BD_WARNING) *value = (fmi2String)bd_to_host(u, i32_load(M, room, 0));
        return (fmi2Status)bd_ended(u, status);
    }
}

/* states */
fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state) {
    BEGIN;
    return (fmi2Status)bd_get_or_free_state(u, bd_fmi2GetFMUstate_0, state);
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state) {
    BEGIN;
    return (fmi2Status)bd_get_or_free_state(u, bd_fmi2FreeFMUstate_0, state);
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state) {
    BEGIN;
    END(fmi2SetFMUstate, , bd_from_host(u, state));
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size) {
    BEGIN;
    return (fmi2Status)bd_size_of_state(u, bd_fmi2SerializedFMUstateSize_0, state, size);
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size) {
    BEGIN;
    return (fmi2Status)bd_serialize_state(u, bd_fmi2SerializeFMUstate_0, state, bytes, size);
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *state) {
    BEGIN;
    return (fmi2Status)bd_deserialize_state(u, bd_fmi2DeSerializeFMUstate_0, bytes, size, state);
}
