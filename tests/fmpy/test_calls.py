"""Wrong calls and what is left after them; resets and snapshots."""

import math

import numpy as np
import pytest
from reference import PERIOD, UNLOADED


def test_fixed_parameter_after_initialisation(unit):
    unit.begin()
    unit.refused(lambda: unit.set({"mass": 2.0}), "mass", "fixed")
    unit.step(1.0)
    assert unit.get("mass") == 1.0


def test_unknown_reference(unit):
    unit.begin()
    unit.refused(lambda: unit.fmu.getReal([4711]), "4711")
    unit.refused(lambda: unit.fmu.setReal([4711], [1.0]), "4711")
    unit.refused(lambda: unit.fmu.getReal([unit.reference("phase")]), "phase", "Enumeration")
    unit.refused(lambda: unit.fmu.getString([unit.reference("mass")]), "mass", "String")
    unit.step(1.0)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_values_that_are_not_finite(unit, value):
    unit.refused(lambda: unit.set({"mass": value}), "mass")
    unit.begin()
    unit.refused(lambda: unit.set({"force": value}), "force")
    unit.refused(lambda: unit.fmu.doStep(0.0, value), "communicationStepSize")
    unit.refused(lambda: unit.fmu.doStep(value, 1.0), "currentCommunicationPoint")
    unit.step(1.0)
    assert np.isfinite(unit.state()).all()


def test_step_sizes_and_points(unit):
    unit.begin(stop=10.0)
    unit.refused(lambda: unit.fmu.doStep(0.0, 0.0), "communicationStepSize")
    unit.refused(lambda: unit.fmu.doStep(0.0, -1.0), "communicationStepSize")
    unit.step(1.0)
    unit.refused(lambda: unit.fmu.doStep(0.0, 1.0), "currentCommunicationPoint")
    unit.refused(lambda: unit.fmu.doStep(1.001, 1.0), "currentCommunicationPoint")
    unit.refused(lambda: unit.fmu.doStep(1.0, 9.5), "stop time")
    unit.step(9.0)


def test_wrong_states(unit):
    unit.refused(lambda: unit.fmu.doStep(0.0, 1.0), "before initialisation")
    unit.refused(unit.fmu.enterInitializationMode, "fmi2SetupExperiment")
    unit.refused(unit.fmu.exitInitializationMode, "before initialisation")
    unit.refused(unit.fmu.terminate, "before initialisation")
    unit.refused(lambda: unit.get("position"), "before initialisation")
    unit.begin()
    unit.refused(unit.fmu.enterInitializationMode, "after initialisation")
    unit.refused(unit.fmu.cancelStep, "fmi2Pending")
    unit.fmu.terminate()
    unit.refused(lambda: unit.fmu.doStep(0.0, 1.0), "after fmi2Terminate")
    assert unit.get("position") == unit.get("initial.position")
    unit.fmu.reset()
    unit.begin()
    unit.step(1.0)


def test_wrong_guid_is_refused(make):
    with pytest.raises(Exception, match="instantiate"):
        make(guid="{00000000-0000-0000-0000-000000000000}")


@pytest.mark.parametrize("name, value, word", [
    ("stop.restitution", 1.2, "0.0 and 1.0"),
    ("stop.restitution", -0.1, "0.0 and 1.0"),
    ("stop.exponent", 0.5, "1.0"),
    ("stop.dissipation", -1.0, "0.0"),
    ("stop.stiffness", -1.0, "0.0"),
    ("stop.loading.from[2]", -1.0, "0.0"),
    ("stop.unloading.stiffness[8]", math.nan, "0.0"),
    ("stop.loading.count", 0, "1 and 8"),
    ("stop.loading.count", 9, "1 and 8"),
    ("stop.unloading.count", -1, "0 and 8"),
    ("stop.release", 3, "zeroForce"),
    ("stop.model", 7, "rigid"),
    ("stop.model", 0, "kelvinVoigt"),
    ("rigid.travel", -1.0, "0.0"),
])
def test_stop_parameters_out_of_range(unit, name, value, word):
    before = unit.get(name)
    unit.refused(lambda: unit.set({name: value}), f"{name} = ", word)
    assert unit.get(name) == before
    unit.begin()
    unit.step(1.0)


FIXED = {
    "stop.model": 2, "stop.restitution": 0.5, "stop.release": 2, "stop.exponent": 2.0,
    "stop.dissipation": 0.1, "stop.loading.count": 2, "stop.loading.from[2]": 0.1,
    "stop.loading.stiffness[1]": 1.0, "stop.unloading.count": 1, "stop.unloading.from[1]": 0.1,
    "stop.unloading.stiffness[1]": 1.0, "rigid.travel": 1.0, "rigid.present": False,
}


@pytest.mark.parametrize("name, value", FIXED.items())
def test_stop_parameters_are_fixed(unit, name, value):
    unit.begin()
    unit.refused(lambda: unit.set({name: value}), name, "fixed")
    unit.fmu.reset()
    unit.set({name: value})
    assert unit.get(name) == value


PIECEWISE = {"stop.model": 3, "piercing.thickness": 0.0, "piercing.travel": 0.0}


@pytest.mark.parametrize("values, words", [
    ({"stop.loading.count": 2}, ["stop.loading.from[2] = 0", "stop.loading.stiffness[2]"]),
    ({"stop.loading.from[1]": 0.5}, ["stop.loading.from[1] = 0.5", "begin at 0"]),
    (
        {"stop.loading.count": 3, "stop.loading.from[2]": 0.5, "stop.loading.from[3]": 0.4},
        ["stop.loading.from[3] = 0.4"],
    ),
    (
        {"stop.unloading.count": 2, "stop.unloading.from[2]": 0.0},
        ["stop.unloading.from[2] = 0"],
    ),
    (
        {"stop.unloading.count": 1, "stop.unloading.stiffness[1]": 8.0},
        ["stop.unloading", "must not exceed", "stop.loading"],
    ),
], ids=["no start", "not from 0", "not rising", "way back not rising", "gives energy"])
def test_slopes_that_make_no_chain(unit, values, words):
    unit.fmu.setupExperiment()
    unit.set(PIECEWISE | values)
    unit.fmu.enterInitializationMode()
    unit.refused(unit.fmu.exitInitializationMode, "fmi2ExitInitializationMode", *words)
    unit.fmu.reset()
    unit.begin(PIECEWISE)
    unit.step(10.0)


BEYOND = [
    ({"stop.model": 6, "initial.position": 11.0}, "10.9 m"),
    ({"stop.model": 2, "initial.position": 16.0}, "15.9 m"),
    ({"rigid.travel": 0.25, "initial.position": 11.5}, "11.15 m"),
]


@pytest.mark.parametrize("values, wall", BEYOND, ids=["rigid", "kelvinVoigt", "preloaded"])
def test_start_beyond_a_rigid_stop(unit, values, wall):
    unit.fmu.setupExperiment()
    unit.set(values)
    unit.fmu.enterInitializationMode()
    position = f"position = {values['initial.position']:g} m"
    unit.refused(unit.fmu.exitInitializationMode, position, wall, "rigid stop")
    unit.refused(lambda: unit.fmu.doStep(0.0, 1.0), "during initialisation")
    unit.set({"initial.position": 3.0})
    unit.fmu.exitInitializationMode()
    unit.step(1.0)
    unit.fmu.reset()
    unit.begin()
    unit.step(1.0)


@pytest.mark.parametrize("model", [2, 3, 4, 5, 6])
def test_rigid_stop_tuned_to_before_the_mass(make, model):
    values = {"stop.model": model, "rigid.travel": 0.0}
    untouched, unit = make().begin(values), make().begin(values)
    unit.step(0.3)
    untouched.step(0.3)
    position = unit.get("position")
    unit.refused(lambda: unit.set({"clearance": position - 1.0}), "fmi2SetReal", "rigid stop")
    both = lambda: unit.fmu.setReal(
        [unit.reference("excitation.amplitude"), unit.reference("clearance")], [2.0, 1.0]
    )
    unit.refused(both, "position", "rigid stop")
    assert list(unit.get("clearance", "excitation.amplitude")) == [10.0, 1.0]
    unit.step(20.0)
    untouched.step(20.0)
    assert (unit.state() == untouched.state()).all()


def test_negative_mass_and_frequency_zero_then_reset(unit):
    unit.refused(lambda: unit.set({"mass": -1.0}), "mass = -1")
    unit.refused(lambda: unit.set({"excitation.frequency": 0.0}), "excitation.frequency = 0")
    unit.fmu.reset()
    unit.begin()
    unit.step(1.0)


def test_outputs_cannot_be_set(unit):
    unit.refused(lambda: unit.set({"position": 1.0}), "position", "output")


def run(unit):
    values = []
    for _ in range(40):
        unit.step(0.731)
        values.append([*unit.state(), *unit.get("energy.supplied", "impact.time")])
    return np.array(values)


def test_reset_equals_fresh(make):
    used, fresh = make().begin(UNLOADED), make()
    used.set({"force": 1.0, "clearance": 9.0, "material": False})
    run(used)
    used.fmu.reset()
    assert used.get("initial.position") != UNLOADED["initial.position"]
    used.begin()
    fresh.begin()
    assert (run(used) == run(fresh)).all()


def test_snapshot_continues_bit_by_bit(make):
    one, other = make().begin(), make().begin(UNLOADED)
    one.set({"force": 0.1, "clearance": 9.9})
    run(one)
    time, state = one.time, one.fmu.getFMUstate()
    first = run(one)
    one.fmu.setFMUstate(state)
    one.time = time
    assert (run(one) == first).all()
    other.fmu.setFMUstate(state)
    other.time = time
    assert (run(other) == first).all()
    one.fmu.freeFMUstate(state)
    assert state.value is None


def test_start_time_and_communication_points_from_elsewhere(make):
    late = make().begin(UNLOADED | {"excitation.phase": 0.0}, start=4 * PERIOD)
    late.step(PERIOD)
    np.testing.assert_allclose(
        late.state(), [UNLOADED["initial.position"], UNLOADED["initial.velocity"]], atol=1e-10
    )
    assert late.get("impact.time") > 4 * PERIOD


def test_a_million_small_steps(make):
    many, one = make().begin(UNLOADED), make().begin(UNLOADED)
    vr = many.fmu.component
    step, time = many.fmu.dll.fmi2DoStep, 0.0
    for _ in range(1_000_000):
        assert step(vr, time, 1e-3, 0) == 0
        time += 1e-3
    one.step(time)
    np.testing.assert_allclose(many.state(), one.state(), atol=1e-9)


def test_many_instances_are_independent(make):
    units = [make(name=f"unit {number}") for number in range(50)]
    for number, unit in enumerate(units):
        unit.begin(UNLOADED | {"initial.velocity": 9.0 + 0.01 * number})
    for _ in range(3):
        for unit in units:
            unit.step(1.7)
    alone = make().begin(UNLOADED | {"initial.velocity": 9.49})
    for _ in range(3):
        alone.step(1.7)
    assert (units[49].state() == alone.state()).all()


def test_events_are_logged_on_demand(make):
    unit = make(logging_on=True).begin()
    unit.step(2 * PERIOD)
    assert [(status, category) for status, category, _ in unit.lines] == [(0, "events")]
    unit.fmu.setDebugLogging(False, ["events"])
    unit.step(PERIOD)
    assert len(unit.lines) == 1
    unit.refused(lambda: unit.fmu.setDebugLogging(True, ["nonsense"]), "nonsense")
