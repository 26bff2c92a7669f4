"""The search as a user does it today: scipy's differential evolution over simulations of an FMU with FMPy.

    python benches/design/user.py TASK.toml MACHINE.fmu SEED TOL

The user knows the amplitude of the motion without impacts in closed form, thus the frequency g0 at which it touches.
Just below g0 the machine cannot but strike. From there the drive is run up slowly, as in a workshop, to the design's
frequency and on by the margin to the fold. z = 1 is one impact in each drive period, each as fast as the last. What
is lost on the way is punished by its distance from the goal. Prints the best design and what it took as JSON.
"""

import json
import math
import sys
import time
import tomllib
from itertools import pairwise

import fmpy
from fmpy.fmi2 import FMU2Slave
from scipy.optimize import differential_evolution

# Drive periods before each look at a motion, looks until it is given up, strokes that a look compares and how much
# their velocities may differ.
SETTLING, PATIENCE, STROKES, ALIKE = 100, 10, 10, 1e-6
# Where the run-up begins, in units of g0; relative rise of the frequency in a step, and its drive periods.
BEGIN, RISE, STEP = 0.99, 2e-3, 5
# Cost of a design that is lost, and of one too near to g0: above that of any allowed one, which is negative.
LOST, TOO_LOW = 1.0, 1e3


class Lost(Exception):
    """The motion is not z = 1."""


class Machine:
    """One instance of the FMU, reset before each run."""

    def __init__(self, path):
        folder = fmpy.extract(path)
        description = fmpy.read_model_description(folder)
        self.variables = {variable.name: variable for variable in description.modelVariables}
        self.fmu = FMU2Slave(
            guid=description.guid,
            unzipDirectory=folder,
            modelIdentifier=description.coSimulation.modelIdentifier,
        )
        self.fmu.instantiate()
        self.runs = self.periods = 0

    def start(self, *names):
        """Start values."""
        return [float(self.variables[name].start) for name in names]

    def set(self, values):
        self.fmu.setReal([self.variables[name].valueReference for name in values], list(values.values()))

    def begin(self, values, frequency):
        """A new run from rest at an angular frequency."""
        self.fmu.reset()
        self.fmu.setupExperiment()
        self.set(values)
        self.turn(frequency)
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()
        self.time = 0.0
        self.runs += 1

    def turn(self, frequency):
        """Changes the angular frequency; the drive angle goes on."""
        self.set({"excitation.frequency": frequency})
        self.frequency = frequency

    def run(self, periods):
        """Impacts in so many drive periods; none ends the run."""
        reference = [self.variables["impact.count"].valueReference]
        before = self.fmu.getInteger(reference)[0]
        duration = periods * 2 * math.pi / self.frequency
        self.fmu.doStep(self.time, duration)
        self.time += duration
        self.periods += periods
        impacts = self.fmu.getInteger(reference)[0] - before
        if impacts == 0:
            raise Lost
        return impacts

    def run_up(self, frequency):
        """Raises the frequency slowly."""
        for step in range(math.ceil((frequency / self.frequency - 1) / RISE), 0, -1):
            self.turn(self.frequency + (frequency - self.frequency) / step)
            self.run(STEP)

    def stroke(self):
        """Before-impact velocity of a drive period with one impact."""
        if self.run(1) != 1:
            raise Lost
        return self.fmu.getReal([self.variables["impact.velocity"].valueReference])[0]

    def velocity(self):
        """Before-impact velocity of the z = 1 motion on which the machine settles."""
        for _ in range(PATIENCE):
            self.run(SETTLING)
            strokes = [self.stroke() for _ in range(STROKES)]
            if all(abs(one - next) < ALIKE * one for one, next in pairwise(strokes)):
                return strokes[-1]
        raise Lost


class Search:
    """The task, and what a design costs; frequencies in the task's unit, which is worth `unit` rad/s."""

    def __init__(self, task, machine):
        self.machine = machine
        self.margins = task["require"]
        self.bounds = dict(leaves(task["vary"]))
        self.deflection = task.get("ratios", task)["stop"]["preload_deflection"]
        [self.frequency] = [name for name in self.bounds if name.startswith("excitation.frequency")]
        self.unit = 2 * math.pi if self.frequency.endswith("_hz") else 1.0
        self.suspension = machine.start("mass", "stiffness", "damping", "excitation.amplitude")

    def grazing(self, clearance):
        """g0: the higher frequency at which the motion without impacts has the amplitude of the clearance."""
        m, k, b, force = self.suspension
        top = k / m - b**2 / (2 * m**2)
        return math.sqrt(top + math.sqrt(top**2 - (k / m) ** 2 + (force / (m * clearance)) ** 2)) / self.unit

    def cost(self, values):
        """The negative velocity of an allowed design; of another one, how far it is from being allowed."""
        design = dict(zip(self.bounds, values, strict=True))
        frequency = design.pop(self.frequency)
        grazing = self.grazing(design["clearance"])
        least = grazing + self.margins["margin_g0"]
        if frequency < least:
            return TOO_LOW + least - frequency
        if "stop.stiffness" in design:
            design["stop.preload"] = self.deflection * design["stop.stiffness"]
        goal = frequency + self.margins["margin_sn"]
        machine = self.machine
        machine.begin(design, BEGIN * grazing * self.unit)
        try:
            machine.run(SETTLING)
            machine.run_up(frequency * self.unit)
            velocity = machine.velocity()
            machine.run_up(goal * self.unit)
            machine.velocity()
        except Lost:
            return LOST + goal - machine.frequency / self.unit
        return -velocity


def leaves(table, path=""):
    """Values of a table and of those in it, by their dotted names."""
    for key, value in table.items():
        if isinstance(value, dict):
            yield from leaves(value, f"{path}{key}.")
        else:
            yield path + key, value


def main():
    task, unit, seed, tol = sys.argv[1:]
    with open(task, "rb") as file:
        search = Search(tomllib.load(file), Machine(unit))
    begin = time.process_time()
    found = differential_evolution(search.cost, list(search.bounds.values()), rng=int(seed), tol=float(tol))
    report = {
        "design": dict(zip(search.bounds, found.x.tolist(), strict=True)),
        "velocity": -found.fun,
        "converged": bool(found.success),
        "generations": found.nit,
        "evaluations": found.nfev,
        "runs": search.machine.runs,
        "periods": search.machine.periods,
        "search_seconds": time.process_time() - begin,
    }
    print(json.dumps(report, indent=2))


if __name__ == "__main__":
    main()
