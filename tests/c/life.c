/* Life cycle of instances for co-simulation and model exchange in a C host: refused calls, steps, states, serialisation.
   Usage under memcheck: life LIBRARY GUID INPUT OUTPUT. INPUT and OUTPUT are value references. */

#include <math.h>

#include "fmi2.h"

static const char *guid;
static unsigned input, output;
static long lines;

static void *make(int kind)
{
    Callbacks callbacks = counting(&lines);
    void *c = Instantiate("life", kind, guid, "file:///nowhere", &callbacks, 0, 1);
    MUST(c);
    return c;
}

static void begin(void *c)
{
    MUST(SetupExperiment(c, 0, 0.0, 0.0, 0, 0.0) == OK);
    MUST(EnterInitializationMode(c) == OK);
    MUST(ExitInitializationMode(c) == OK);
}

/* Stores, serialises, damages, deserialises and restores a state. */
static void store_and_restore(void *c)
{
    void *state = NULL, *copy = NULL;
    size_t size;
    MUST(GetFMUstate(c, &state) == OK && GetFMUstate(c, &state) == OK);
    MUST(SerializedFMUstateSize(c, state, &size) == OK);
    char *bytes = malloc(size);
    MUST(SerializeFMUstate(c, state, bytes, size - 1) == ERROR);
    MUST(SerializeFMUstate(c, state, bytes, size) == OK);
    MUST(DeSerializeFMUstate(c, bytes, size - 1, &copy) == ERROR && !copy);
    bytes[size / 2] ^= 1;
    MUST(DeSerializeFMUstate(c, bytes, size, &copy) == ERROR && !copy);
    bytes[size / 2] ^= 1;
    MUST(DeSerializeFMUstate(c, bytes, size, &copy) == OK && copy);
    MUST(SetFMUstate(c, copy) == OK && SetFMUstate(c, NULL) == ERROR);
    MUST(FreeFMUstate(c, &state) == OK && !state && FreeFMUstate(c, &copy) == OK && FreeFMUstate(c, &copy) == OK);
    free(bytes);
}

static void refusals(void)
{
    Callbacks callbacks = counting(&lines);
    long before = lines;
    MUST(!Instantiate("life", CO_SIMULATION, "{wrong}", NULL, &callbacks, 0, 0));
    MUST(!Instantiate(NULL, CO_SIMULATION, guid, NULL, &callbacks, 0, 0));
    MUST(!Instantiate("life", 7, guid, NULL, &callbacks, 0, 0));
    MUST(lines == before + 3);
    FreeInstance(NULL);
    MUST(Reset(NULL) == ERROR);
    void *c = make(CO_SIMULATION);
    double number = 0.0;
    int absurd = 1000000000;
    unsigned none = 4000000000u;
    MUST(GetReal(c, &none, 1, &number) == ERROR && GetReal(c, NULL, 3, &number) == ERROR);
    MUST(GetReal(c, &output, 1, NULL) == ERROR && GetReal(c, NULL, 0, NULL) == OK);
    MUST(SetInteger(c, &output, 1, &absurd) == ERROR && DoStep(c, 0.0, 1e-3, 0) == ERROR && CancelStep(c) == ERROR);
    number = NAN;
    MUST(SetReal(c, &input, 1, &number) == DISCARD);
    FreeInstance(c);
}

/* Multiplies all settable real variables by 1000, so that the initialisation fails. The instance must start after a reset. */
static void failed_initialisation(int kind)
{
    void *c = make(kind);
    for (unsigned r = 0; r < 400; ++r) {
        double value;
        if (GetReal(c, &r, 1, &value) == OK) {
            value *= 1e3;
            SetReal(c, &r, 1, &value);
        }
    }
    MUST(EnterInitializationMode(c) == OK && ExitInitializationMode(c) == ERROR);
    MUST(GetReal(c, &output, 1, &(double){0.0}) == ERROR);
    MUST(Reset(c) == OK);
    begin(c);
    FreeInstance(c);
}

static void steps(void)
{
    void *c = make(CO_SIMULATION);
    begin(c);
    double load = 800.0, speed, slope;
    int order = 1;
    for (int i = 0; i < 20; ++i) {
        MUST(SetReal(c, &input, 1, &load) == OK);
        MUST(SetRealInputDerivatives(c, &input, 1, &order, &(double){10.0}) == OK);
        MUST(DoStep(c, i * 1e-4, 1e-4, 1) == OK);
        MUST(GetReal(c, &output, 1, &speed) == OK && isfinite(speed));
        MUST(GetRealOutputDerivatives(c, &output, 1, &order, &slope) == OK && isfinite(slope));
    }
    MUST(GetDirectionalDerivative(c, &output, 1, &input, 1, &(double){1.0}, &slope) == OK && isfinite(slope));
    store_and_restore(c);
    load = 1e7;
    MUST(SetReal(c, &input, 1, &load) == OK && DoStep(c, 20e-4, 1e-2, 0) == DISCARD);
    MUST(Terminate(c) == OK && Reset(c) == OK);
    begin(c);
    FreeInstance(c);
}

static void exchange(void)
{
    void *c = make(MODEL_EXCHANGE);
    double x[STATES], rates[STATES], indicators[INDICATORS], nominals[STATES];
    int event, end;
    EventInfo info;
    begin(c);
    MUST(NewDiscreteStates(c, &info) == OK && EnterContinuousTimeMode(c) == OK);
    MUST(GetNominalsOfContinuousStates(c, nominals, STATES) == OK);
    MUST(GetDerivatives(c, rates, STATES - 1) == ERROR);
    for (int i = 1; i <= 20; ++i) {
        MUST(GetContinuousStates(c, x, STATES) == OK && GetDerivatives(c, rates, STATES) == OK);
        for (int k = 0; k < STATES; ++k) {
            MUST(isfinite(rates[k]));
            x[k] += 1e-7 * rates[k];
        }
        MUST(SetTime(c, i * 1e-7) == OK && SetContinuousStates(c, x, STATES) == OK);
        MUST(GetEventIndicators(c, indicators, INDICATORS) == OK);
        MUST(CompletedIntegratorStep(c, 1, &event, &end) == OK);
        if (event || i % 7 == 0) {
            MUST(EnterEventMode(c) == OK && NewDiscreteStates(c, &info) == OK && EnterContinuousTimeMode(c) == OK);
        }
    }
    for (int k = 0; k < INDICATORS; ++k)
        MUST(isfinite(indicators[k]));
    store_and_restore(c);
    FreeInstance(c);
}

int main(int count, char **arguments)
{
    if (count != 5) {
        fprintf(stderr, "usage: life LIBRARY GUID INPUT OUTPUT\n");
        return 2;
    }
    open_library(arguments[1]);
    guid = arguments[2];
    input = (unsigned)atoi(arguments[3]);
    output = (unsigned)atoi(arguments[4]);
    refusals();
    for (int kind = MODEL_EXCHANGE; kind <= CO_SIMULATION; ++kind)
        failed_initialisation(kind);
    steps();
    exchange();
    printf("%ld messages\n", lines);
    return 0;
}
