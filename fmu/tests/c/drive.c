/* Drives the unit through its whole interface and checks known results.
 *
 *     drive LIBRARY DESCRIPTION            all calls
 *     drive LIBRARY DESCRIPTION long N     N steps of 1e-3 s against a single one
 */
#include "unit.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void versions(void)
{
    CHECK(!strcmp(fmi2.GetVersion(), "2.0"));
    CHECK(!strcmp(fmi2.GetTypesPlatform(), "default"));
}

static void refused_instances(void)
{
    CHECK(!fmi2.Instantiate("unit", fmi2CoSimulation, "{other}", NULL, NULL, fmi2False, fmi2True));
    CHECK(!fmi2.Instantiate("unit", fmi2ModelExchange, own_guid(), NULL, NULL, fmi2False, fmi2True));
    CHECK(!fmi2.Instantiate(NULL, fmi2CoSimulation, own_guid(), NULL, NULL, fmi2False, fmi2True));
    fmi2Component silent =
        fmi2.Instantiate("unit", fmi2CoSimulation, own_guid(), "file:///", NULL, fmi2False, fmi2True);
    CHECK(silent != NULL);
    CHECK(fmi2.DoStep(silent, 0.0, 1.0, fmi2True) == fmi2Error);
    fmi2.FreeInstance(silent);
    fmi2.FreeInstance(NULL);
    CHECK(fmi2.Reset(NULL) == fmi2Error);
}

static void values(void)
{
    Unit *unit = make("unit");
    fmi2ValueReference mass = reference("mass"), material = reference("material");
    double real = NAN;
    fmi2Boolean fed = -1;
    fmi2String text = "text";
    set(unit, "mass", 2.0);
    CHECK(get(unit, "mass") == 2.0);
    set_integer(unit, "stop.model", 2);
    CHECK(get_integer(unit, "stop.model") == 2);
    OK(fmi2.GetBoolean(unit->component, &material, 1, &fed));
    CHECK(fed == fmi2True);
    fed = fmi2False;
    OK(fmi2.SetBoolean(unit->component, &material, 1, &fed));
    fed = -1;
    OK(fmi2.GetBoolean(unit->component, &material, 1, &fed));
    CHECK(fed == fmi2False);
    OK(fmi2.GetString(unit->component, NULL, 0, NULL));
    OK(fmi2.SetString(unit->component, NULL, 0, NULL));
    refused(unit, fmi2.GetString(unit->component, &mass, 1, &text), "fmi2GetString", "mass");
    refused(unit, fmi2.SetString(unit->component, &mass, 1, &text), "fmi2SetString", "mass");
    refused(unit, fmi2.SetReal(unit->component, &mass, 1, &real), "fmi2SetReal", "mass = NaN");
    refused(unit, fmi2.GetReal(unit->component, NULL, 1, &real), "fmi2GetReal", "vr is NULL");
    refused(unit, fmi2.GetBoolean(unit->component, &mass, 1, &fed), "fmi2GetBoolean", "Real");
    begin(unit);
    refused(unit, fmi2.SetReal(unit->component, &mass, 1, &real), "fmi2SetReal", "fixed");
    CHECK(get(unit, "mass") == 2.0);
    dispose(unit);
}

static void periodic_motion(void)
{
    Unit *unit = make_unloaded();
    double energy = get(unit, "energy.mechanical");
    step(unit, 0.0, PERIOD);
    CLOSE(get(unit, "position"), 6.901267951548, 1e-10);
    CLOSE(get(unit, "velocity"), 9.516655745459, 1e-10);
    CHECK(get_integer(unit, "impact.count") == 1);
    CHECK(get(unit, "impact.time") > 0.0 && get(unit, "impact.time") < PERIOD);
    CLOSE(get(unit, "impact.velocity"), 6.49462742936, 1e-10);
    double supplied = get(unit, "energy.supplied"), dissipated = get(unit, "energy.dissipated");
    CHECK(supplied > 1.0);
    CLOSE(supplied - dissipated, get(unit, "energy.mechanical") - energy, 1e-9 * supplied);
    step(unit, PERIOD, 200.0 * PERIOD);
    CLOSE(get(unit, "position"), 6.901267951548, 1e-10);
    CHECK(get_integer(unit, "impact.count") == 201);
    OK(fmi2.Terminate(unit->component));
    CLOSE(get(unit, "velocity"), 9.516655745459, 1e-10);
    dispose(unit);
}

/* A free mass of 2 kg: the motion is a polynomial of time. */
static Unit *make_free(void)
{
    Unit *unit = make("unit");
    set(unit, "mass", 2.0);
    set(unit, "stiffness", 0.0);
    set(unit, "damping", 0.0);
    set(unit, "excitation.amplitude", 0.0);
    set(unit, "clearance", 1e6);
    set_integer(unit, "stop.model", 1);
    set(unit, "initial.position", 1.0);
    set(unit, "initial.velocity", 3.0);
    begin(unit);
    return unit;
}

static void derivatives_of_input_and_outputs(void)
{
    Unit *unit = make_free();
    fmi2ValueReference force = reference("force"), outputs[4];
    fmi2Integer order = 1, orders[4] = {1, 2, 2, 1};
    double rate = 0.6, derivatives[4];
    outputs[0] = outputs[1] = reference("position");
    outputs[2] = reference("velocity");
    outputs[3] = reference("acceleration");
    set(unit, "force", 1.0);
    OK(fmi2.SetRealInputDerivatives(unit->component, &force, 1, &order, &rate));
    step(unit, 0.0, 2.0);
    CLOSE(get(unit, "force"), 2.2, 1e-15);
    CLOSE(get(unit, "position"), 1.0 + 6.0 + 1.0 + 0.4, 1e-14);
    CLOSE(get(unit, "velocity"), 3.0 + 1.0 + 0.6, 1e-14);
    OK(fmi2.GetRealOutputDerivatives(unit->component, outputs, 4, orders, derivatives));
    CLOSE(derivatives[0], 4.6, 1e-14);
    CLOSE(derivatives[1], 1.1, 1e-14);
    CLOSE(derivatives[2], 0.3, 1e-15);
    CLOSE(derivatives[3], 0.3, 1e-15);
    order = 8;
    refused(unit, fmi2.SetRealInputDerivatives(unit->component, &force, 1, &order, &rate),
            "fmi2SetRealInputDerivatives", "order 8");
    order = 3;
    refused(unit,
            fmi2.GetRealOutputDerivatives(unit->component, outputs, 1, &order, derivatives),
            "fmi2GetRealOutputDerivatives", "order 3");
    dispose(unit);
}

static double derivative(Unit *unit, const char *unknown, const char *known)
{
    fmi2ValueReference of = reference(unknown), by = reference(known);
    double seed = 1.0, value = NAN;
    OK(fmi2.GetDirectionalDerivative(unit->component, &of, 1, &by, 1, &seed, &value));
    return value;
}

static void directional_derivatives(void)
{
    Unit *unit = make_free();
    step(unit, 0.0, 3.0);
    CLOSE(derivative(unit, "position", "force"), 9.0 / 4.0, 1e-13);
    CLOSE(derivative(unit, "velocity", "force"), 3.0 / 2.0, 1e-13);
    CLOSE(derivative(unit, "position", "initial.position"), 1.0, 1e-13);
    CLOSE(derivative(unit, "position", "initial.velocity"), 3.0, 1e-13);
    CLOSE(derivative(unit, "velocity", "initial.velocity"), 1.0, 1e-13);
    fmi2ValueReference of = reference("position"), by = reference("mass");
    double seed = 1.0, value;
    refused(unit, fmi2.GetDirectionalDerivative(unit->component, &of, 1, &by, 1, &seed, &value),
            "fmi2GetDirectionalDerivative", "mass");
    dispose(unit);
}

/* The end of one period of the unloaded machine from another velocity. */
static double end_position(double velocity)
{
    Unit *unit = make("unit");
    set_unloaded(unit);
    set(unit, "initial.velocity", velocity);
    begin(unit);
    step(unit, 0.0, PERIOD);
    double position = get(unit, "position");
    dispose(unit);
    return position;
}

static void derivative_across_an_impact(void)
{
    const double width = 1e-3, velocity = 9.516655745459;
    Unit *unit = make_unloaded();
    step(unit, 0.0, PERIOD);
    CHECK(get_integer(unit, "impact.count") == 1);
    double inner = (end_position(velocity + width) - end_position(velocity - width)) / (2 * width);
    double outer = (end_position(velocity + 2 * width) - end_position(velocity - 2 * width)) /
                   (4 * width);
    CLOSE(derivative(unit, "position", "initial.velocity"), (4 * inner - outer) / 3, 1e-9);
    dispose(unit);
}

static void states(void)
{
    Unit *one = make_unloaded(), *other = make("unit");
    fmi2FMUstate kept = NULL, copy = NULL;
    size_t size = 0;
    step(one, 0.0, 3.0);
    OK(fmi2.GetFMUstate(one->component, &kept));
    fmi2FMUstate first = kept;
    OK(fmi2.GetFMUstate(one->component, &kept));
    CHECK(kept == first);
    step(one, 3.0, 10.0);
    double position = get(one, "position"), supplied = get(one, "energy.supplied");

    OK(fmi2.SetFMUstate(one->component, kept));
    step(one, 3.0, 10.0);
    CHECK(get(one, "position") == position);

    OK(fmi2.SerializedFMUstateSize(one->component, kept, &size));
    char *bytes = malloc(size);
    OK(fmi2.SerializeFMUstate(one->component, kept, bytes, size));
    refused(one, fmi2.SerializeFMUstate(one->component, kept, bytes, size - 1),
            "fmi2SerializeFMUstate", "size");
    OK(fmi2.DeSerializeFMUstate(other->component, bytes, size, &copy));
    OK(fmi2.SetFMUstate(other->component, copy));
    step(other, 3.0, 10.0);
    CHECK(get(other, "position") == position);
    CHECK(get(other, "energy.supplied") == supplied);

    refused(other, fmi2.DeSerializeFMUstate(other->component, bytes, size - 1, &copy),
            "fmi2DeSerializeFMUstate", "cut off");
    bytes[size / 2] ^= 1;
    refused(other, fmi2.DeSerializeFMUstate(other->component, bytes, size, &copy),
            "fmi2DeSerializeFMUstate", "altered");
    free(bytes);
    OK(fmi2.FreeFMUstate(one->component, &kept));
    OK(fmi2.FreeFMUstate(other->component, &copy));
    CHECK(!kept && !copy);
    OK(fmi2.FreeFMUstate(one->component, &kept));
    dispose(one);
    dispose(other);
}

static void statuses(void)
{
    Unit *unit = make_unloaded();
    fmi2Status status = fmi2Fatal;
    double time = NAN;
    fmi2Boolean ended = -1;
    fmi2Integer number = -1;
    fmi2String text = NULL;
    step(unit, 0.0, 2.5);
    OK(fmi2.GetStatus(unit->component, fmi2DoStepStatus, &status));
    CHECK(status == fmi2OK);
    OK(fmi2.GetRealStatus(unit->component, fmi2LastSuccessfulTime, &time));
    CHECK(time == 2.5);
    OK(fmi2.GetBooleanStatus(unit->component, fmi2Terminated, &ended));
    CHECK(ended == fmi2False);
    refused(unit, fmi2.GetIntegerStatus(unit->component, fmi2DoStepStatus, &number),
            "fmi2GetIntegerStatus", "kind 0");
    refused(unit, fmi2.GetStringStatus(unit->component, fmi2PendingStatus, &text),
            "fmi2GetStringStatus", "fmi2Pending");
    refused(unit, fmi2.CancelStep(unit->component), "fmi2CancelStep", "no step is under way");
    refused(unit, fmi2.GetStatus(unit->component, fmi2Terminated, &status), "fmi2GetStatus",
            "kind 3");
    dispose(unit);
}

/* More impacts than one step may cost: it is carried out in part, and can be gone on with. */
static void discarded_step(void)
{
    Unit *unit = make_unloaded();
    double time = NAN, end;
    fmi2Status status = fmi2OK;
    step(unit, 0.0, 1.0);
    CHECK(fmi2.DoStep(unit->component, 1.0, 1e9, fmi2True) == fmi2Discard);
    CHECK(unit->log.lines == 1 && unit->log.status == fmi2Discard);
    CHECK(strstr(unit->log.text, "fmi2DoStep") != NULL);
    unit->log.lines = 0;
    OK(fmi2.GetStatus(unit->component, fmi2DoStepStatus, &status));
    CHECK(status == fmi2Discard);
    OK(fmi2.GetRealStatus(unit->component, fmi2LastSuccessfulTime, &time));
    CHECK(time > 1e6 && time < 1e9);
    end = PERIOD * ceil(time / PERIOD);
    step(unit, time, end - time);
    CLOSE(get(unit, "position"), 6.901267951548, 1e-6);
    OK(fmi2.GetStatus(unit->component, fmi2DoStepStatus, &status));
    CHECK(status == fmi2OK);
    dispose(unit);
}

static void wrong_calls(void)
{
    Unit *unit = make("unit");
    fmi2Component component = unit->component;
    refused(unit, fmi2.DoStep(component, 0.0, 1.0, fmi2True), "fmi2DoStep", "before init");
    refused(unit, fmi2.ExitInitializationMode(component), "fmi2ExitInitializationMode", "before");
    refused(unit, fmi2.EnterInitializationMode(component), "fmi2EnterInitializationMode",
            "fmi2SetupExperiment");
    refused(unit, fmi2.SetupExperiment(component, fmi2False, 0.0, NAN, fmi2False, 0.0),
            "fmi2SetupExperiment", "startTime");
    refused(unit, fmi2.Terminate(component), "fmi2Terminate", "before");
    begin(unit);
    refused(unit, fmi2.DoStep(component, 0.0, -1.0, fmi2True), "fmi2DoStep",
            "communicationStepSize = -1");
    refused(unit, fmi2.DoStep(component, 1.0, 1.0, fmi2True), "fmi2DoStep",
            "currentCommunicationPoint = 1");
    step(unit, 0.0, 1.0);
    dispose(unit);
}

static void logging(void)
{
    Unit *unit = make_unloaded();
    const fmi2String names[2] = {"events", "nonsense"};
    OK(fmi2.SetDebugLogging(unit->component, fmi2True, 1, names));
    step(unit, 0.0, PERIOD);
    CHECK(unit->log.lines == 1 && unit->log.status == fmi2OK);
    CHECK(!strcmp(unit->log.category, "events"));
    unit->log.lines = 0;
    refused(unit, fmi2.SetDebugLogging(unit->component, fmi2True, 2, names),
            "fmi2SetDebugLogging", "nonsense");
    OK(fmi2.SetDebugLogging(unit->component, fmi2False, 0, NULL));
    step(unit, PERIOD, PERIOD);
    dispose(unit);
}

static void reset_equals_fresh(void)
{
    Unit *used = make_unloaded(), *fresh = make("unit");
    set(used, "force", 1.0);
    step(used, 0.0, 7.0);
    OK(fmi2.Reset(used->component));
    begin(used);
    begin(fresh);
    for (int k = 0; k < 3; k++) {
        step(used, 5.0 * k, 5.0);
        step(fresh, 5.0 * k, 5.0);
        CHECK(get(used, "position") == get(fresh, "position"));
        CHECK(get(used, "energy.supplied") == get(fresh, "energy.supplied"));
    }
    dispose(used);
    dispose(fresh);
}

static void all_but_discarded(void)
{
    versions();
    refused_instances();
    values();
    periodic_motion();
    derivatives_of_input_and_outputs();
    directional_derivatives();
    derivative_across_an_impact();
    states();
    statuses();
    wrong_calls();
    logging();
    reset_equals_fresh();
}

static void long_run(long steps)
{
    Unit *many = make_unloaded(), *one = make_unloaded();
    double time = 0.0;
    long not_ok = 0;
    for (long k = 0; k < steps; k++) {
        not_ok += fmi2.DoStep(many->component, time, 1e-3, fmi2True) != fmi2OK;
        time += 1e-3;
    }
    CHECK(not_ok == 0);
    step(one, 0.0, time);
    double position = get(many, "position") - get(one, "position");
    double velocity = get(many, "velocity") - get(one, "velocity");
    printf("%ld steps to t = %.17g s: position differs by %g m, velocity by %g m/s\n", steps, time,
           position, velocity);
    CLOSE(position, 0.0, 1e-9);
    CLOSE(velocity, 0.0, 1e-9);
    CHECK(get_integer(many, "impact.count") == get_integer(one, "impact.count"));
    dispose(many);
    dispose(one);
}

int main(int count, char **arguments)
{
    int is_long = count == 5 && !strcmp(arguments[3], "long");
    int is_brief = count == 4 && !strcmp(arguments[3], "brief");
    if (count != 3 && !is_long && !is_brief) {
        fprintf(stderr, "usage: drive LIBRARY DESCRIPTION [long STEPS | brief]\n");
        return 2;
    }
    load(arguments[1], arguments[2]);
    if (is_long)
        long_run(strtol(arguments[4], NULL, 10));
    else {
        all_but_discarded();
        if (!is_brief)
            discarded_step();
    }
    unload();
    printf("%d failures\n", failures());
    return failures() != 0;
}
