"""piercing-machine.ssp in three engines that know nothing of each other, beside the same coupling driven by hand.

All three set inputs at each communication point and step all units from there (Jacobi). libcosim takes the first set of
parameters, ecos the one that is asked for, FMPy none by itself; FMPy does not connect before the first step either.
"""

import pathlib
import sys

import numpy as np
import pytest

fmpy = pytest.importorskip("fmpy", reason="fmpy, which drives the reference, is not installed")

from machine import TOP  # noqa: E402

sys.path.insert(0, str(TOP / "examples"))

from piercing_machine import PLAIN, ROLL_BACK, Package, System  # noqa: E402

STEP, STEPS = 0.02, 3000
MACHINES = ["B", "A", "design"]
WATCHED = ["press.position", "press.velocity", "drive.speed", "press.drive.work", "press.impact.count",
           "feeder.strip.count", "press.pierce.count", "drive.energy.supplied", "press.energy.dissipated"]


@pytest.fixture(scope="session")
def system(path):
    beside = pathlib.Path(path).with_name("piercing-machine.ssp")
    return str(beside if beside.exists() else TOP / "piercing-machine.ssp")


class Hand(System):
    """The units of the system, stepped without roll back as its description connects them."""

    def __init__(self, system, folder, machine=None, connected_initially=True):
        self.unconnected = not connected_initially
        super().__init__(Package(system, folder), machine)

    def outputs(self):
        return [0.0] * len(self.wires) if self.unconnected else super().outputs()

    def run(self, steps):
        for _ in range(steps):
            self.step(STEP, PLAIN)
            self.unconnected = False
        with self:
            return [self.get(*name.split(".", 1)) for name in WATCHED]


def test_no_parameter_is_wired(system, tmp_path):
    hand = Hand(system, tmp_path)
    for wire in hand.wires:
        output, name = wire.source.variables[wire.output], wire.target.variables[wire.input]
        assert (output.causality, name.causality) == ("output", "input")
        assert output.unit == name.unit
    hand.run(1)


def test_fmpy(system, tmp_path):
    from fmpy.ssp.simulation import simulate_ssp

    result = simulate_ssp(system, start_time=0.0, stop_time=STEP * (STEPS - 0.5), step_size=STEP)
    assert len(result) == STEPS
    ends = [result[-1][name] for name in WATCHED]
    np.testing.assert_allclose(ends, Hand(system, tmp_path, connected_initially=False).run(STEPS), atol=1e-8)


@pytest.mark.parametrize("machine", MACHINES)
def test_ecos(system, machine, tmp_path):
    from test_ecos import EcosSimulation

    with EcosSimulation(STEP, ssp_path=system) as simulation:
        assert simulation.init(parameter_set=machine)
        simulation.step(STEPS)
        names = [name.replace(".", "::", 1) for name in WATCHED]
        ends = [(simulation.get_integer if n.endswith("count") else simulation.get_real)(n) for n in names]
    np.testing.assert_allclose(ends, Hand(system, tmp_path, machine).run(STEPS), atol=1e-8)


def test_libcosim(system, tmp_path):
    from test_libcosim import CosimExecution, CosimObserver

    execution = CosimExecution.from_ssp_file(system, round(STEP * 1e9))
    observer = CosimObserver.create_last_value()
    assert execution.add_observer(observer)
    assert execution.step(STEPS)
    ends = []
    for watched in WATCHED:
        unit, name = watched.split(".", 1)
        unit = execution.slave_index_from_instance_name(unit)
        (reference,) = {v.reference for v in execution.slave_variables(unit) if v.name.decode() == name}
        count = name.endswith("count")
        last = observer.last_integer_values if count else observer.last_real_values
        ends.append(last(unit, [reference])[0])
    np.testing.assert_allclose(ends, Hand(system, tmp_path, "B").run(STEPS), atol=1e-8)


@pytest.mark.parametrize(("coupling", "order"), [(PLAIN, 1), (ROLL_BACK, 2)])
def test_order_of_the_coupling(system, coupling, order, tmp_path):
    """Speed and impact time at three steps: what is left falls by 2^order."""
    package, ends = Package(system, tmp_path), []
    for size in (0.05, 0.025, 0.0125):
        with System(package, "B") as machine:
            machine.go_to(12, size, coupling)
            ends.append([machine.get("drive", "speed"), machine.get("press", "impact.time")])
    coarse, middle, fine = np.array(ends)
    observed = np.log2(abs((coarse - middle) / (middle - fine)))
    np.testing.assert_allclose(observed, order, atol=0.1)
