"""Model exchange: FMPy's CVODE integrates position and velocity, beside co-simulation of the same unit."""

import fmpy
import numpy as np
import pytest
from conftest import Unit
from fmpy.fmi2 import FMU2Model
from fmpy.validation import validate_fmu
from grazing import missed
from packages import package_3, package_exchange
from reference import UNLOADED

GEOMETRY = {"piercing.thickness": 0.0, "piercing.travel": 0.0}
MACHINES = {  # values, and how far CVODE may be off at a tolerance of 1e-8
    "loaded": {},
    "free": GEOMETRY | {"stop.model": 1},
    "soft": UNLOADED | {"stop.model": 2},
    "hertz": UNLOADED | {"stop.model": 4, "stop.stiffness": 70.0},
    "preloaded": UNLOADED,
    "rigid": UNLOADED | {"stop.model": 6, "stop.restitution": 0.6},
    "preloaded, resting": GEOMETRY | {"clearance": 0.0, "stop.preload": 0.5, "initial.position": -0.6},
    "rigid, resting": GEOMETRY | {"stop.model": 6, "stop.restitution": 0.5, "clearance": -0.5,
                                  "initial.position": -0.6, "initial.velocity": 0.0},
    "stuck in the strip": {"clearance": 0.3, "excitation.amplitude": 0.6, "damping": 0.6, "piercing.friction": 40.0,
                           "initial.position": 0.0, "initial.velocity": 1.5},
}
NAMES = ["position", "velocity", "phase", "impact.count", "pierce.count", "impact.time", "impact.velocity",
         "energy.supplied", "energy.dissipated", "energy.mechanical"]
EXACT = ["impact.count", "pierce.count", "impact.time", "impact.velocity"]


@pytest.fixture(params=["2.0", "3.0"])
def unit(request, path):
    return package_exchange(path) if request.param == "2.0" else package_3(path, "softstop")


def simulated(unit, values, fmi_type, **options):
    options = {"stop_time": 60.0, "output_interval": 0.05, "output": NAMES} | options
    return fmpy.simulate_fmu(unit, start_values=values, fmi_type=fmi_type, **options)


def at_the_same_times(rows, others):
    """The last rows of both at each time that both have but for rounding."""
    last = {round(time, 9): number for number, time in enumerate(rows["time"])}
    pairs = [(last[round(time, 9)], number) for number, time in enumerate(others["time"]) if round(time, 9) in last]
    return rows[[one for one, _ in pairs]], others[[other for _, other in pairs]]


def test_validation_finds_nothing(unit):
    assert validate_fmu(unit) == []


def test_states_are_told_in_both_standards(path):
    two, three = (fmpy.read_model_description(of) for of in (package_exchange(path), package_3(path, "softstop")))
    assert two.guid != three.guid == fmpy.read_model_description(path).guid
    assert two.numberOfEventIndicators == three.numberOfEventIndicators == 3

    def listed(of):
        return [(u.variable.name, u.variable.derivative.name, {d.name for d in u.dependencies})
                for u in of.derivatives]

    forces = {"force", "base.acceleration", "drive.amplitude"}
    assert listed(two) == listed(three) == [
        ("velocity", "position", {"velocity"}), ("acceleration", "velocity", forces | {"position", "velocity"})]


@pytest.mark.parametrize("machine", MACHINES)
@pytest.mark.parametrize("tolerance, off", [(1e-5, 0.05), (1e-8, 1e-4)])
def test_motion_is_that_of_co_simulation(unit, machine, tolerance, off):
    exchanged = simulated(unit, MACHINES[machine], "ModelExchange", relative_tolerance=tolerance)
    expected = simulated(unit, MACHINES[machine], "CoSimulation")
    rows, others = at_the_same_times(exchanged, expected)
    assert len(rows) > 1000
    for name in ("position", "velocity"):
        np.testing.assert_allclose(rows[name], others[name], rtol=0, atol=off)
    for name in EXACT:
        np.testing.assert_array_equal(rows[name], others[name])
    for name in ("energy.supplied", "energy.dissipated"):
        np.testing.assert_allclose(rows[name], others[name], rtol=1e-12, atol=1e-12)


def test_no_graze_is_missed(unit):
    none, without, other = missed(unit, 40, 1e-5)
    print(f"of 40 machines by indicators alone {without} are missed")
    assert (none, other) == (0, 0) and without > 20


def test_step_of_an_input(unit):
    """FMPy takes a jump for an event, so the motion stays exact but for the rounding of its interpolation."""
    force = np.array([(0.0, 0.0), (7.31, 0.0), (7.31, 1.5), (21.93, 1.5), (21.93, -0.7), (60.0, -0.7)],
                     dtype=[("time", float), ("force", float)])
    exchanged = simulated(unit, {}, "ModelExchange", relative_tolerance=1e-8, input=force)
    expected = simulated(unit, {}, "CoSimulation", input=force)
    rows, others = at_the_same_times(exchanged, expected)
    for name in EXACT:
        np.testing.assert_allclose(rows[name], others[name], rtol=1e-13)
    np.testing.assert_allclose(rows["position"], others["position"], rtol=0, atol=1e-4)


def test_input_that_varies(unit):
    """A sine as a polygon of many corners: events by what the integrator solves for."""
    time = np.linspace(0.0, 40.0, 4001)
    force = np.array(list(zip(time, 0.4 * np.sin(0.7 * time))), dtype=[("time", float), ("force", float)])
    exchanged = simulated(unit, UNLOADED, "ModelExchange", relative_tolerance=1e-8, input=force, stop_time=40.0,
                          output_interval=0.01)
    expected = simulated(unit, UNLOADED, "CoSimulation", input=force, stop_time=40.0, output_interval=0.01)
    assert exchanged["impact.count"][-1] == expected["impact.count"][-1] > 5
    assert exchanged["impact.time"][-1] == pytest.approx(expected["impact.time"][-1], abs=0.02)


def test_parameters_change_at_events_alone(path, tmp_path):
    archive = package_exchange(path)
    description = fmpy.read_model_description(archive)
    unit = Unit(fmpy.extract(archive, unzipdir=tmp_path), description, kind=FMU2Model)
    unit.begin()
    unit.fmu.newDiscreteStates()
    unit.fmu.enterContinuousTimeMode()
    before = unit.get("clearance")
    unit.set({"clearance": before})
    unit.refused(lambda: unit.set({"clearance": before + 0.5}), "clearance", "continuous-time mode")
    assert unit.get("clearance") == before
    unit.fmu.enterEventMode()
    unit.set({"clearance": before + 0.5})
    unit.fmu.newDiscreteStates()
    unit.fmu.enterContinuousTimeMode()
    assert unit.get("clearance") == before + 0.5
    unit.fmu.terminate()
    unit.fmu.freeInstance()
