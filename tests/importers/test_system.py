"""piercing-machine.ssp in three engines that know nothing of each other, beside the same coupling driven by hand.

All three set inputs at each communication point and step all units from there (Jacobi). libcosim takes the first set of
parameters, ecos the one that is asked for, FMPy none by itself; FMPy does not connect before the first step either.
"""

import pathlib
import sys
import zipfile

import numpy as np
import pytest

fmpy = pytest.importorskip("fmpy", reason="fmpy, which drives the reference, is not installed")

from fmpy.fmi2 import FMU2Slave  # noqa: E402
from fmpy.ssp.ssd import get_connections, read_ssd, read_ssv  # noqa: E402
from machine import PERIOD, TOP  # noqa: E402

STEP, STEPS = 0.02, 3000
MACHINES = ["B", "A", "design"]
WATCHED = ["press.position", "press.velocity", "drive.speed", "press.drive.work", "press.impact.count",
           "feeder.strip.count", "press.pierce.count", "drive.energy.supplied", "press.energy.dissipated"]


@pytest.fixture(scope="session")
def system(path):
    beside = pathlib.Path(path).with_name("piercing-machine.ssp")
    return str(beside if beside.exists() else TOP / "piercing-machine.ssp")


class Hand:
    """The units of the system, stepped by hand as its description connects them."""

    def __init__(self, system, folder, machine=None, connected_initially=True):
        structure = read_ssd(system)
        self.wires = [(a.parent.name, a.name, b.parent.name, b.name) for a, b in get_connections(structure.system)]
        fmpy.extract(system, unzipdir=str(folder))
        self.units, self.references = {}, {}
        for component in structure.system.elements:
            name = component.name
            unpacked = fmpy.extract(str(folder / component.source), unzipdir=str(folder / name))
            description = fmpy.read_model_description(unpacked)
            self.references[name] = {v.name: v for v in description.modelVariables}
            unit = FMU2Slave(guid=description.guid, unzipDirectory=unpacked, instanceName=name,
                             modelIdentifier=description.coSimulation.modelIdentifier)
            unit.instantiate()
            unit.setupExperiment()
            self.units[name] = unit
            if machine and name != "feeder":
                for parameter in read_ssv(system, f"resources/{machine}-{name}.ssv").parameters:
                    self.set(name, parameter.name, float(parameter.value))
        for unit in self.units.values():
            unit.enterInitializationMode()
        if connected_initially:
            # What the drive tells first the feeder and the press need, and so on.
            for _ in self.units:
                self.connect()
        else:
            for _, _, unit, name in self.wires:
                self.set(unit, name, 0.0)
        for unit in self.units.values():
            unit.exitInitializationMode()

    def set(self, unit, name, value):
        self.units[unit].setReal([self.references[unit][name].valueReference], [value])

    def get(self, name):
        unit, name = name.split(".", 1)
        variable = self.references[unit][name]
        read = self.units[unit].getReal if variable.type == "Real" else self.units[unit].getInteger
        return read([variable.valueReference])[0]

    def connect(self):
        values = [self.get(f"{unit}.{name}") for unit, name, _, _ in self.wires]
        for (_, _, unit, name), value in zip(self.wires, values):
            self.set(unit, name, value)

    def run(self, steps):
        for number in range(steps):
            if number:
                self.connect()
            for unit in self.units.values():
                unit.doStep(number * STEP, STEP)
        ends = [self.get(name) for name in WATCHED]
        for unit in self.units.values():
            unit.terminate()
            unit.freeInstance()
        return ends


def test_no_parameter_is_wired(system, tmp_path):
    hand = Hand(system, tmp_path)
    for begin, output, end, name in hand.wires:
        assert hand.references[begin][output].causality == "output"
        assert hand.references[end][name].causality == "input"
        assert hand.references[begin][output].unit == hand.references[end][name].unit
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
