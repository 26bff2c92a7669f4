"""Runs a design's own unit on machines within its tolerances: do they all meet what was required?

    python examples/check_design.py softstop-design --machines 200

Reads design.json and design.fmu in the folder that `softstop optimize` has written. The corners of the box of
tolerances and machines drawn evenly from it run in FMPy until their motion repeats, one drive period a step. One more period
in small steps gives before-impact velocity, peak force of contact and stroke. Exits with 1 if no start leads a machine to the
motion, or if it violates a requirement by more than the error of the sampled extremes. The motion of a machine at the very fold
exists, but hardly any start leads there: require certainty, or a tolerance_reserve.
"""

import argparse
import itertools
import json
import math
import pathlib
import sys
import tempfile

import fmpy
import numpy as np
from fmpy.fmi2 import FMU2Slave

STEPS = 400
"""Steps of the measured period; extremes between them are those of parabolas."""

REPEATS, LONGEST, STARTS = 1e-9, 5_000, 20
"""Change in a period, as a share of the largest state, below which a motion repeats; longest run-in in periods; starts tried
for each machine."""


def machines_within(design, drawing, count, seed):
    """The drawing, the corners of the box of tolerances, and `count` machines drawn evenly from it: parameters of the unit.

    A tolerance in the language of the task's file (Hz, ratios) is the same share of the unit's value.
    """
    rows = design["tolerances"]["parameters"]
    follows = "stop.preload_deflection" in design["design"]["machine"]["parameters"]
    corners = itertools.product([-1.0, 1.0], repeat=len(rows))
    drawn = np.random.default_rng(seed).uniform(-1.0, 1.0, (count, len(rows)))
    for place in itertools.chain([[0.0] * len(rows)], corners, drawn):
        machine = dict(drawing)
        for row, share in zip(rows, place):
            name = row["parameter"].removesuffix("_hz")
            factor = 1 + share * row["tolerance"] / row["value"]
            machine[name] *= factor
            if name == "stop.stiffness" and follows:
                machine["stop.preload"] *= factor
        yield machine


class Unit:
    """The design's unit: machines one after the other in one instance."""

    def __init__(self, path, folder):
        description = fmpy.read_model_description(path)
        self.references = {v.name: v.valueReference for v in description.modelVariables}
        self.fmu = FMU2Slave(guid=description.guid, unzipDirectory=fmpy.extract(path, unzipdir=folder),
                             modelIdentifier=description.coSimulation.modelIdentifier, instanceName="design")
        self.fmu.instantiate()
        self.drawing = {v.name: float(v.start) for v in description.modelVariables
                        if v.causality == "parameter" and v.type == "Real"}

    def begin(self, values, position, velocity):
        """From a state at drive angle 0."""
        self.fmu.reset()
        self.fmu.setupExperiment()
        values = values | {"initial.position": position, "initial.velocity": velocity}
        self.fmu.setReal([self.references[name] for name in values], list(values.values()))
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()
        self.time, self.period = 0.0, 2 * math.pi / values["excitation.frequency"]

    def step(self, periods):
        """Goes on and returns position, velocity, impacts, hardest before-impact velocity and peak force of the step."""
        self.fmu.doStep(self.time, periods * self.period)
        self.time += periods * self.period
        names = ["position", "velocity", "impact.step.hardest.velocity", "contact.peak"]
        return self.fmu.getReal([self.references[name] for name in names]) + \
            self.fmu.getInteger([self.references["impact.step.count"]])

    def settle(self):
        """Runs until the motion repeats in each period; returns whether it is z = 1."""
        before = largest = np.array(self.step(1)[:2])
        for _ in range(LONGEST):
            *state, impacts = self.step(1)
            after = np.array(state[:2])
            largest = np.maximum(largest, np.abs(after))
            if np.all(np.abs(after - before) <= REPEATS * largest):
                return impacts == 1
            before = after
        return False

    def figures(self, mass):
        """Figures of the period that follows."""
        rows = np.array([self.step(1 / STEPS) for _ in range(STEPS)])
        velocity, positions = rows[:, 2].max(), rows[:, 0]
        energy = mass * velocity**2 / 2
        return {"velocity": velocity, "stop_force": rows[:, 3].max(), "impact_energy": energy,
                "impact_power": energy / self.period, "stroke": greatest(positions) + greatest(-positions)}


def greatest(samples):
    """Top of the parabola through the greatest of periodic samples and its neighbours."""
    at = samples.argmax()
    left, top, right = samples[at - 1], samples[at], samples[(at + 1) % len(samples)]
    return top + (right - left)**2 / (8 * (2 * top - left - right))


def motion_of(unit, machine, random):
    """Figures of the machine's z = 1 motion; None if no start leads to it.

    Most machines find it from the drawing's own state, others from states scattered about that.
    """
    state = np.array([machine["initial.position"], machine["initial.velocity"]])
    for start in range(STARTS):
        unit.begin(machine, *(state * random.normal(1.0, 0.3, 2) if start else state))
        if unit.settle():
            return unit.figures(machine["mass"])
    return None


def violates(requirement, value):
    """Whether a value lies beyond the requirement's bound, as design.json words it."""
    side, bound = requirement["required"].split()[1:3]
    beyond = value - float(bound) if side == "most" else float(bound) - value
    return beyond > 1e-6 * abs(value)


def check(folder, count, seed):
    """Prints what the drawing and the worst machine do, beside the report; returns how many machines fail."""
    try:
        design = json.loads((folder / "design.json").read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        sys.exit(f"{folder / 'design.json'}: {error}")
    if "tolerances" not in design:
        sys.exit(f"{folder}: the task of this design had no [tolerance]")
    random = np.random.default_rng(seed)
    with tempfile.TemporaryDirectory() as unpacked:
        unit = Unit(str(folder / "design.fmu"), unpacked)
        found = [motion_of(unit, machine, random) for machine in machines_within(design, unit.drawing, count, seed)]
        unit.fmu.freeInstance()
    motions = [motion for motion in found if motion]
    print(f"{len(found)} machines: the drawing, the corners of the tolerances and {count} drawn from them")
    print(f"{len(found) - len(motions)} find no motion from {STARTS} starts")
    bad = {index for index, motion in enumerate(found) if not motion}
    rows = [("velocity", "", design["tolerances"]["machines"]["nominal"], design["tolerances"]["machines"]["worst"], min)]
    for requirement in design["requirements"]:
        name = requirement["name"]
        if name in motions[0]:
            side = max if " most " in requirement["required"] else min
            rows.append((name, requirement["required"], requirement["value"], requirement["worst"], side))
            bad |= {index for index, motion in enumerate(found) if motion and violates(requirement, motion[name])}
    print(f"{'figure':<14}{'required':<22}{'drawing':>14}{'as reported':>14}{'worst seen':>14}{'as reported':>14}")
    for name, required, nominal, worst, side in rows:
        seen = side(motion[name] for motion in motions)
        print(f"{name:<14}{required:<22}{motions[0][name]:>14.8g}{nominal:>14.8g}{seen:>14.8g}{worst:>14.8g}")
    print(f"{len(bad)} of {len(found)} machines find no motion or violate a requirement")
    return len(bad)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder", type=pathlib.Path, help="written by softstop optimize for a task with [tolerance]")
    parser.add_argument("--machines", type=int, default=200, help="drawn from the tolerances [default: 200]")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    sys.exit(check(arguments.folder, arguments.machines, arguments.seed) > 0)
