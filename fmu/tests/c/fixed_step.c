/* The unloaded machine as a unit with a fixed step inside, for comparison: classical Runge-Kutta of
 * fourth order, the law of each stage by its position, no event located (Peterka 2003, eq. 8, point A).
 */
#include "fmi2.h"

#include <math.h>
#include <stdlib.h>

enum { POSITION, VELOCITY, INNER_STEP, INITIAL_POSITION, INITIAL_VELOCITY, VALUES };

typedef struct {
    double time;
    double values[VALUES];
} Machine;

static const double frequency = 1.15, clearance = 10.0, damping = 0.04, contact_damping = 0.18;
static const double stiffness = 7.0, preload = 70.0;

static double acceleration(double time, double x, double v)
{
    double push = cos(frequency * time) - x;
    if (x > clearance)
        return push - contact_damping * v - preload - stiffness * (x - clearance);
    return push - damping * v;
}

static void inner_step(Machine *machine, double h)
{
    double t = machine->time, x = machine->values[POSITION], v = machine->values[VELOCITY];
    double a1 = acceleration(t, x, v);
    double v2 = v + h / 2 * a1, a2 = acceleration(t + h / 2, x + h / 2 * v, v2);
    double v3 = v + h / 2 * a2, a3 = acceleration(t + h / 2, x + h / 2 * v2, v3);
    double v4 = v + h * a3, a4 = acceleration(t + h, x + h * v3, v4);
    machine->values[POSITION] = x + h / 6 * (v + 2 * v2 + 2 * v3 + v4);
    machine->values[VELOCITY] = v + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    machine->time = t + h;
}

/* The standard's types hold these definitions to its signatures. */
#define DECLARE(name) fmi2##name##TYPE fmi2##name;
FMI2_FUNCTIONS(DECLARE)
#undef DECLARE

const char *fmi2GetTypesPlatform(void)
{
    return "default";
}

const char *fmi2GetVersion(void)
{
    return "2.0";
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String folder,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible,
                              fmi2Boolean logging_on)
{
    Machine *machine = calloc(1, sizeof *machine);
    (void)name, (void)type, (void)guid, (void)folder, (void)functions, (void)visible;
    (void)logging_on;
    if (machine)
        fmi2Reset(machine);
    return machine;
}

void fmi2FreeInstance(fmi2Component component)
{
    free(component);
}

fmi2Status fmi2Reset(fmi2Component component)
{
    Machine *machine = component;
    machine->time = 0.0;
    machine->values[INNER_STEP] = 1e-3;
    machine->values[INITIAL_POSITION] = 6.901267951548;
    machine->values[INITIAL_VELOCITY] = 9.516655745459;
    return fmi2OK;
}

fmi2Status fmi2SetupExperiment(fmi2Component component, fmi2Boolean with_tolerance,
                               fmi2Real tolerance, fmi2Real start, fmi2Boolean with_stop,
                               fmi2Real stop)
{
    (void)with_tolerance, (void)tolerance, (void)with_stop, (void)stop;
    ((Machine *)component)->time = start;
    return fmi2OK;
}

fmi2Status fmi2EnterInitializationMode(fmi2Component component)
{
    (void)component;
    return fmi2OK;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component component)
{
    Machine *machine = component;
    machine->values[POSITION] = machine->values[INITIAL_POSITION];
    machine->values[VELOCITY] = machine->values[INITIAL_VELOCITY];
    return fmi2OK;
}

fmi2Status fmi2Terminate(fmi2Component component)
{
    (void)component;
    return fmi2OK;
}

fmi2Status fmi2GetReal(fmi2Component component, const fmi2ValueReference vr[], size_t count,
                       fmi2Real value[])
{
    for (size_t k = 0; k < count; k++) {
        if (vr[k] >= VALUES)
            return fmi2Error;
        value[k] = ((Machine *)component)->values[vr[k]];
    }
    return fmi2OK;
}

fmi2Status fmi2SetReal(fmi2Component component, const fmi2ValueReference vr[], size_t count,
                       const fmi2Real value[])
{
    for (size_t k = 0; k < count; k++) {
        if (vr[k] < INNER_STEP || vr[k] >= VALUES)
            return fmi2Error;
        ((Machine *)component)->values[vr[k]] = value[k];
    }
    return fmi2OK;
}

fmi2Status fmi2DoStep(fmi2Component component, fmi2Real point, fmi2Real size, fmi2Boolean final)
{
    Machine *machine = component;
    long count = lround(ceil(size / machine->values[INNER_STEP] - 1e-6));
    (void)final;
    for (long k = 0; k < count; k++) {
        machine->time = point + (double)k * (size / (double)count);
        inner_step(machine, size / (double)count);
    }
    machine->time = point + size;
    return fmi2OK;
}

/* What this unit does not offer. */
#define REFUSED(name, arguments) fmi2Status fmi2##name arguments { return fmi2Error; }
#if defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wunused-parameter"
#endif
REFUSED(SetDebugLogging, (fmi2Component c, fmi2Boolean on, size_t n, const fmi2String names[]))
REFUSED(GetInteger, (fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Integer v[]))
REFUSED(GetBoolean, (fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Boolean v[]))
REFUSED(GetString, (fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2String v[]))
REFUSED(SetInteger,
        (fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Integer v[]))
REFUSED(SetBoolean,
        (fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Boolean v[]))
REFUSED(SetString, (fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2String v[]))
REFUSED(GetFMUstate, (fmi2Component c, fmi2FMUstate *state))
REFUSED(SetFMUstate, (fmi2Component c, fmi2FMUstate state))
REFUSED(FreeFMUstate, (fmi2Component c, fmi2FMUstate *state))
REFUSED(SerializedFMUstateSize, (fmi2Component c, fmi2FMUstate state, size_t *size))
REFUSED(SerializeFMUstate, (fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size))
REFUSED(DeSerializeFMUstate,
        (fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *state))
REFUSED(GetDirectionalDerivative,
        (fmi2Component c, const fmi2ValueReference of[], size_t rows, const fmi2ValueReference by[],
         size_t columns, const fmi2Real seed[], fmi2Real value[]))
REFUSED(SetRealInputDerivatives, (fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                  const fmi2Integer order[], const fmi2Real v[]))
REFUSED(GetRealOutputDerivatives, (fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                   const fmi2Integer order[], fmi2Real v[]))
REFUSED(CancelStep, (fmi2Component c))
REFUSED(GetStatus, (fmi2Component c, const fmi2StatusKind kind, fmi2Status *value))
REFUSED(GetRealStatus, (fmi2Component c, const fmi2StatusKind kind, fmi2Real *value))
REFUSED(GetIntegerStatus, (fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value))
REFUSED(GetBooleanStatus, (fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value))
REFUSED(GetStringStatus, (fmi2Component c, const fmi2StatusKind kind, fmi2String *value))
