"""A parameter study: thousands of runs in one process, one instance reset again and again."""

import fmpy
import numpy as np
import pytest
from conftest import Unit
from reference import PERIOD

RUNS = 3000
NAMES = ["position", "velocity", "impact.count", "impact.time", "energy.supplied"]


def machine(number):
    """A machine of its own for each number; every sixth is the default one."""
    random = np.random.default_rng(number)
    if number % 6 == 0:
        return {}
    return {
        "clearance": random.uniform(-1.0, 10.0), "stop.model": number % 6 + 1,
        "stop.stiffness": random.uniform(1.0, 50.0), "contact.damping": random.uniform(0.0, 0.5),
        "piercing.thickness": random.uniform(0.0, 0.5), "initial.position": -2.0,
        "initial.velocity": random.uniform(-5.0, 5.0), "material": bool(number % 4),
        "excitation.frequency": random.uniform(0.5, 1.5), "excitation.phase": random.uniform(0, 6),
    }


def run(unit, number):
    unit.begin(machine(number))
    unit.step(3.7)
    if number % 3 == 0:  # what a reset has to undo as well
        unit.set({"force": 0.5, "clearance": 12.0})
        unit.fmu.setRealInputDerivatives([unit.reference("force")], [1], [0.1])
    unit.step(11.0)
    return unit.get(*NAMES)


def test_reset_equals_fresh_in_every_run(make, folder, description):
    used = make()
    for number in range(RUNS):
        if number:
            used.fmu.reset()
        values = run(used, number)
        if number % 10 == 0:
            fresh = Unit(folder, description)
            assert (run(fresh, number) == values).all(), number
            fresh.fmu.fmi2FreeInstance(fresh.fmu.component)


def test_reset_restores_every_start_value(make, description):
    unit = make()
    known = [v.name for v in description.modelVariables if v.causality != "output"]
    before = [unit.get(name) for name in known]
    run(unit, 3)
    unit.fmu.reset()
    assert [unit.get(name) for name in known] == before


@pytest.mark.parametrize("terminate", [True, False])
def test_one_instance_through_simulate_fmu(folder, description, terminate):
    """As FMPy's example of a parameter variation: instantiated once, reset between the runs."""
    instance = fmpy.instantiate_fmu(folder, description, fmi_type="CoSimulation")
    for velocity in np.linspace(9.0, 12.0, 20):
        values = {"initial.velocity": velocity, "piercing.travel": 0.45}
        settings = dict(stop_time=4 * PERIOD, start_values=values, output=NAMES[:4])
        used = fmpy.simulate_fmu(
            folder, fmu_instance=instance, model_description=description, terminate=terminate,
            **settings,
        )
        assert (used == fmpy.simulate_fmu(folder, **settings)).all()
        instance.reset()
    instance.freeInstance()


@pytest.mark.parametrize("name, value", [("mass", -1.0), ("stop.restitution", 2.0)])
def test_a_run_that_fails_spoils_none_after_it(make, name, value):
    fresh, used = make(), make()
    used.fmu.setupExperiment()
    used.refused(lambda: used.set({name: value}), name)
    used.fmu.reset()
    assert (run(used, 7) == run(fresh, 7)).all()
