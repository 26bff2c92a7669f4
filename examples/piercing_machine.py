"""Runs piercing-machine.ssp: a master with roll back for FMI 2.0 units, connected as their SSP says.

    python examples/piercing_machine.py piercing-machine.ssp design

Each step is tried with the inputs as they stand, then repeated from the saved states with the inputs on straight lines
between the outputs at both ends, until these agree. Discrete inputs keep their value over a step.
"""

import pathlib
import sys
import tempfile

import fmpy
from fmpy.fmi2 import FMU2Slave
from fmpy.ssp.ssd import get_connections, read_ssd, read_ssv


class System:
    """The units of an SSP with one of its sets of parameters."""

    def __init__(self, ssp, folder, machine=None):
        folder = pathlib.Path(folder)
        structure = read_ssd(ssp).system
        self.wires = [(a.parent.name, a.name, b.parent.name, b.name) for a, b in get_connections(structure)]
        fmpy.extract(ssp, unzipdir=str(folder))
        self.time, self.units, self.variables = 0.0, {}, {}
        for component in structure.elements:
            unpacked = fmpy.extract(str(folder / component.source), unzipdir=str(folder / component.name))
            description = fmpy.read_model_description(unpacked)
            self.variables[component.name] = {v.name: v for v in description.modelVariables}
            unit = FMU2Slave(guid=description.guid, unzipDirectory=unpacked, instanceName=component.name,
                             modelIdentifier=description.coSimulation.modelIdentifier)
            unit.instantiate()
            unit.setupExperiment()
            self.units[component.name] = unit
            values = f"resources/{machine}-{component.name}.ssv"
            if machine and (folder / values).exists():
                for parameter in read_ssv(ssp, values).parameters:
                    self.set(component.name, parameter.name, float(parameter.value))
        for unit in self.units.values():
            unit.enterInitializationMode()
        for _ in self.units:  # What the first unit tells passes through all others.
            self.connect(self.outputs())
        for unit in self.units.values():
            unit.exitInitializationMode()

    def set(self, unit, name, value):
        self.units[unit].setReal([self.variables[unit][name].valueReference], [value])

    def get(self, unit, name):
        variable = self.variables[unit][name]
        read = self.units[unit].getReal if variable.type == "Real" else self.units[unit].getInteger
        return read([variable.valueReference])[0]

    def outputs(self):
        return [self.get(unit, name) for unit, name, _, _ in self.wires]

    def connect(self, values, slopes=None):
        for number, (_, _, unit, name) in enumerate(self.wires):
            self.set(unit, name, values[number])
            variable = self.variables[unit][name]
            if slopes and variable.variability == "continuous":
                self.units[unit].setRealInputDerivatives([variable.valueReference], [1], [slopes[number]])

    def do_step(self, size):
        for unit in self.units.values():
            unit.doStep(self.time, size)
        return self.outputs()

    def step(self, size, repeats=20, tolerance=1e-12):
        """One step; without repeats the inputs stand still over it."""
        begin = self.outputs()
        self.connect(begin)
        states = {name: unit.getFMUstate() for name, unit in self.units.items()} if repeats else {}
        end = self.do_step(size)
        for _ in range(repeats):
            for name, unit in self.units.items():
                unit.setFMUstate(states[name])
            self.connect(begin, [(b - a) / size for a, b in zip(begin, end)])
            before, end = end, self.do_step(size)
            if all(abs(b - a) <= tolerance * max(1.0, abs(b)) for a, b in zip(before, end)):
                break
        for name, state in states.items():
            self.units[name].freeFMUstate(state)
        self.time += size


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        system = System(sys.argv[1], folder, *sys.argv[2:])
        for number in range(1, 6001):
            system.step(0.01)
            if number % 500 == 0:
                shown = [system.get("drive", "speed"), system.get("press", "impact.velocity")]
                print(f"t {system.time:6.2f} s  speed {shown[0]:.9f} rad/s  impact {shown[1]:.9f} m/s  "
                      f"strips {system.get('press', 'pierce.count')}")
        for unit in system.units.values():
            unit.terminate()
            unit.freeInstance()
