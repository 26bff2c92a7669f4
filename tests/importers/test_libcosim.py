"""libcosim, the engine of the Open Simulation Platform; it loads units with FMI Library."""

import pytest

pytest.importorskip("libcosimpy", reason="libcosimpy is not installed")

from libcosimpy.CosimExecution import CosimExecution  # noqa: E402
from libcosimpy.CosimLogging import CosimLogLevel, log_output_level  # noqa: E402
from libcosimpy.CosimManipulator import CosimManipulator  # noqa: E402
from libcosimpy.CosimObserver import CosimObserver  # noqa: E402
from libcosimpy.CosimSlave import CosimLocalSlave  # noqa: E402
from machine import (  # noqa: E402
    OBSERVED, PERIOD, PUSH, PUSHED, check_orbit, check_pushed, orbit_values,
)


log_output_level(CosimLogLevel.ERROR)


class Cosim:
    """One unit in an execution with a fixed step of whole nanoseconds."""

    def __init__(self, path, step, values=None, name="unit"):
        self.step = round(step * 1e9)
        self.execution = CosimExecution.from_step_size(self.step)
        self.unit = self.execution.add_local_slave(CosimLocalSlave(path, name))
        described = self.execution.slave_variables(self.unit)
        self.references = {v.name.decode(): v.reference for v in described}
        for variable, value in (values or {}).items():
            reference = self.references[variable]
            assert self.execution.real_initial_value(self.unit, reference, value)
        self.observer = CosimObserver.create_last_value()
        assert self.execution.add_observer(self.observer)
        self.manipulator = CosimManipulator.create_override()
        assert self.execution.add_manipulator(self.manipulator)
        self.time = 0.0

    def run(self, steps):
        assert self.execution.step(steps)
        self.time += steps * self.step * 1e-9

    def get(self, *names):
        values = []
        for name in names:
            count = name.endswith(".count")
            last = self.observer.last_integer_values if count else self.observer.last_real_values
            values += last(self.unit, [self.references[name]])
        return values


@pytest.mark.parametrize("per_period", [1, 100, 1000])
def test_orbit(path, orbit, per_period):
    cosim = Cosim(path, PERIOD / per_period, orbit_values(orbit))
    cosim.run(10 * per_period)
    check_orbit(orbit, 10, cosim.time - 10 * PERIOD, cosim.get(*OBSERVED))


@pytest.mark.parametrize("per_period", [1, 37])
def test_force_from_the_start(path, per_period):
    cosim = Cosim(path, PERIOD / per_period, PUSHED | {"force": PUSH})
    cosim.run(3 * per_period)
    check_pushed(cosim.time, cosim.get("position", "velocity", "impact.count"))


def test_inputs_overridden_while_it_runs(path):
    cosim = Cosim(path, PERIOD / 10)
    cosim.run(50)
    assert cosim.get("pierce.count") == [5]
    material = cosim.references["material"]
    assert cosim.manipulator.slave_boolean_values(cosim.unit, [material], [False])
    cosim.run(50)
    pierced, impacts = cosim.get("pierce.count", "impact.count")
    assert (pierced, impacts > 5) == (5, True)
    force = cosim.references["force"]
    before = cosim.get("position")
    assert cosim.manipulator.slave_real_values(cosim.unit, [force], [1.0])
    cosim.run(1)
    assert cosim.get("force") == [1.0]
    assert cosim.get("position") != before


def test_drive_led_by_its_input(path):
    """The drive turns as the input says; what is not connected is not felt."""
    cosim = Cosim(path, PERIOD / 20)
    takes = cosim.references["drive.takes.speed"]
    assert cosim.execution.boolean_initial_value(cosim.unit, takes, True)
    speed = cosim.references["drive.speed"]
    assert cosim.execution.real_initial_value(cosim.unit, speed, 1.15)
    cosim.run(200)
    check_orbit("loaded", 10, cosim.time - 10 * PERIOD, cosim.get(*OBSERVED))
    assert cosim.manipulator.slave_real_values(cosim.unit, [speed], [0.0])
    cosim.run(1)
    standing = cosim.get("drive.angle", "drive.force")
    cosim.run(200)
    assert cosim.get("drive.angle", "drive.force") == standing


def test_several_units_in_one_execution(path):
    cosim = Cosim(path, PERIOD / 20, name="first")
    second = cosim.execution.add_local_slave(CosimLocalSlave(path, "second"))
    position, force = cosim.references["position"], cosim.references["force"]
    contact = cosim.references["contact.force"]
    failed = cosim.execution.connect_real_variables(cosim.unit, contact, second, force)
    assert failed == 0
    cosim.run(200)
    check_orbit("loaded", 10, cosim.time - 10 * PERIOD, cosim.get(*OBSERVED))
    first, pushed = (cosim.observer.last_real_values(u, [position]) for u in (cosim.unit, second))
    assert first != pushed
