"""Runs piercing-machine.ssp: a master for FMI 2.0 units, connected as their SSP says.

    python examples/piercing_machine.py piercing-machine.ssp design

Three ways of coupling tell the units what their continuous inputs do over a step:

    plain         inputs stand still; what they missed is made up for in the next step
    derivatives   inputs go on with the rates that outputs have at the beginning of the step
    roll back     the step is repeated from saved states with cubics through both ends of it, until these agree

Discrete inputs keep their value over a step.
"""

import math
import pathlib
import sys
import tempfile

import fmpy
from fmpy.fmi2 import FMU2Slave
from fmpy.ssp.ssd import get_connections, read_ssd, read_ssv

PLAIN, DERIVATIVES, ROLL_BACK = COUPLINGS = ["plain", "derivatives", "roll back"]

REPEATS, TOLERANCE = 20, 1e-12
"""Most repeats of a step, and the relative difference of outputs at which they end."""


class Package:
    """An SSP, unpacked: descriptions of its units, connections, sets of parameters."""

    def __init__(self, ssp, folder):
        self.ssp, folder = ssp, pathlib.Path(folder)
        structure = read_ssd(ssp).system
        self.wires = [(a.parent.name, a.name, b.parent.name, b.name) for a, b in get_connections(structure)]
        fmpy.extract(ssp, unzipdir=str(folder))
        self.folder, self.components = folder, {}
        for component in structure.elements:
            unpacked = fmpy.extract(str(folder / component.source), unzipdir=str(folder / component.name))
            self.components[component.name] = unpacked, fmpy.read_model_description(unpacked)

    def parameters(self, machine):
        """The values of a set by unit and name."""
        files = {unit: f"resources/{machine}-{unit}.ssv" for unit in self.components}
        return {(unit, parameter.name): float(parameter.value)
                for unit, file in files.items() if (self.folder / file).exists()
                for parameter in read_ssv(self.ssp, file).parameters}


class Unit:
    """An instance of a unit, its variables by name."""

    def __init__(self, name, folder, description):
        self.variables = {v.name: v for v in description.modelVariables}
        self.fmu = FMU2Slave(guid=description.guid, unzipDirectory=folder, instanceName=name,
                             modelIdentifier=description.coSimulation.modelIdentifier)
        self.fmu.instantiate()
        self.fmu.setupExperiment()

    def reference(self, name):
        return self.variables[name].valueReference

    def set(self, name, value):
        verbs = {"Real": self.fmu.setReal, "Boolean": self.fmu.setBoolean}
        verbs.get(self.variables[name].type, self.fmu.setInteger)([self.reference(name)], [value])

    def get(self, name):
        verbs = {"Real": self.fmu.getReal, "Boolean": self.fmu.getBoolean}
        return verbs.get(self.variables[name].type, self.fmu.getInteger)([self.reference(name)])[0]

    def rate(self, name):
        return self.fmu.getRealOutputDerivatives([self.reference(name)], [1])[0]

    def lead(self, name, polynomial):
        """Lets an input go on from now as a polynomial, given by its coefficients, lowest order first."""
        value, *higher = (math.factorial(k) * coefficient for k, coefficient in enumerate(polynomial))
        self.set(name, value)
        if higher:
            orders = range(1, len(higher) + 1)
            self.fmu.setRealInputDerivatives([self.reference(name)] * len(higher), list(orders), higher)

    def close(self):
        self.fmu.terminate()
        self.fmu.freeInstance()


def cubic(size, first, last):
    """Coefficients of the cubic over a step through two values with their rates."""
    (a, rate_a), (b, rate_b) = first, last
    rise = (b - a) / size
    return a, rate_a, (3 * rise - 2 * rate_a - rate_b) / size, (rate_a + rate_b - 2 * rise) / size**2


class Wire:
    """An output of a unit that leads to an input of another one."""

    def __init__(self, source, output, target, name):
        self.source, self.output, self.target, self.input = source, output, target, name
        self.is_continuous = target.variables[name].variability == "continuous"

    def value(self):
        return self.source.get(self.output)

    def rate(self):
        return self.source.rate(self.output) if self.is_continuous else 0.0

    def lead(self, polynomial):
        self.target.lead(self.input, polynomial if self.is_continuous else polynomial[:1])


class System:
    """The units of a package, but those left out, with one of its sets of parameters and other values beside."""

    def __init__(self, package, machine=None, values=None, without=()):
        self.time = 0.0
        self.units = {name: Unit(name, *of) for name, of in package.components.items() if name not in without}
        self.wires = [Wire(self.units[a], output, self.units[b], name) for a, output, b, name in package.wires
                      if not {a, b} & set(without)]
        for (unit, name), value in (package.parameters(machine) | (values or {})).items():
            if unit not in without:
                self.units[unit].set(name, value)
        for unit in self.units.values():
            unit.fmu.enterInitializationMode()
        for _ in self.units:  # What the first unit tells passes through all others.
            self.connect([value] for value in self.outputs())
        for unit in self.units.values():
            unit.fmu.exitInitializationMode()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for unit in self.units.values():
            unit.close()

    def get(self, unit, name):
        return self.units[unit].get(name)

    def outputs(self):
        """Values of all outputs that lead to inputs."""
        return [wire.value() for wire in self.wires]

    def connect(self, polynomials):
        for wire, polynomial in zip(self.wires, polynomials):
            wire.lead(polynomial)

    def step(self, size, coupling=ROLL_BACK):
        """One step."""
        begin = self.outputs()
        if coupling != PLAIN:
            rates = [wire.rate() for wire in self.wires]
        if coupling == ROLL_BACK:
            self.roll_back(size, list(zip(begin, rates)))
        else:
            self.connect(zip(begin, rates) if coupling == DERIVATIVES else ([value] for value in begin))
            for unit in self.units.values():
                unit.fmu.doStep(self.time, size)
        self.time += size

    def roll_back(self, size, begin):
        """Repeats a step until inputs and outputs agree, unit after unit with what is known of the others."""
        states = {name: unit.fmu.getFMUstate() for name, unit in self.units.items()}
        end = [(value + size * rate, rate) for value, rate in begin]
        for repeat in range(REPEATS):
            before = list(end)
            for name, unit in self.units.items():
                if repeat:
                    unit.fmu.setFMUstate(states[name])
                for wire, first, last in zip(self.wires, begin, end):
                    if wire.target is unit:
                        wire.lead(cubic(size, first, last))
                unit.fmu.doStep(self.time, size)
                end = [(wire.value(), wire.rate()) if wire.source is unit else known for wire, known in zip(self.wires, end)]
            if all(abs(b - a) <= TOLERANCE * max(1.0, abs(b)) for (a, _), (b, _) in zip(before, end)):
                break
        for name, state in states.items():
            self.units[name].fmu.freeFMUstate(state)

    def go_to(self, until, size, coupling=ROLL_BACK):
        """Goes on to a time in even steps of about this size."""
        begin = self.time
        steps = max(1, math.ceil((until - begin) / size))
        for k in range(1, steps + 1):
            self.step(begin + (until - begin) * (k / steps) - self.time, coupling)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        with System(Package(sys.argv[1], folder), *sys.argv[2:3]) as system:
            for number in range(1, 6001):
                system.step(0.01)
                if number % 500 == 0:
                    shown = [system.get("drive", "speed"), system.get("press", "impact.velocity")]
                    print(f"t {system.time:6.2f} s  speed {shown[0]:.9f} rad/s  impact {shown[1]:.9f} m/s  "
                          f"strips {system.get('press', 'pierce.count')}")
