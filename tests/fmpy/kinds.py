"""A unit of whatever kind: what can be read and set of it, and fixtures for tests of all kinds."""

import pathlib

import fmpy
import numpy as np
import pytest
from conftest import maker

STEP = 0.3
STARTS = {  # parameters under which the unit's inputs are felt
    "softstop": {"drive.takes.speed": True, "drive.takes.amplitude": True},
    "drive": {},
    "feeder": {"feed.takes.angle": True, "supply.model": 3, "jam.probability": 0.1},
}
MODELS = {
    "drive": [{"motor.model": model} for model in (1, 2)],
    "feeder": [{"supply.model": model} for model in (1, 2, 3)],
}
RATES = {"angle": 1.1, "drive.speed": 0.0, "load.work": 2.0}
"""How fast an input grows, if it does."""


class Kind:
    """A unit with what can be read and set of it."""

    def __init__(self, path, folder):
        self.name = pathlib.Path(path).stem
        self.folder = fmpy.extract(path, unzipdir=str(folder))
        self.description = fmpy.read_model_description(self.folder)
        variables = self.description.modelVariables
        self.names = [v.name for v in variables]
        self.outputs = [v.name for v in variables if v.causality == "output"]
        self.inputs = [v for v in variables if v.causality == "input"]
        self.reals = [v.name for v in variables if v.causality == "output" and v.type == "Real"]
        self.start = STARTS[self.name]


@pytest.fixture(scope="module")
def kind(each, tmp_path_factory):
    return Kind(each, tmp_path_factory.mktemp("each"))


@pytest.fixture
def make(kind):
    with maker(kind.folder, kind.description) as make_one:
        yield make_one


def bits(unit, names):
    return [float(unit.get(name)).hex() for name in names]


def excite(unit, kind, random):
    """Sets some of the inputs, now and then with slopes, and takes a step."""
    for variable in kind.inputs:
        if random.random() < 0.5:
            continue
        if variable.type == "Boolean":
            unit.set({variable.name: random.random() < 0.8})
            continue
        low, high = (float(of) if of else np.nan for of in (variable.min, variable.max))
        growth = RATES.get(variable.name, 0.0)
        value = growth * unit.time + random.normal(scale=0.3)
        unit.set({variable.name: float(np.clip(value, low, high))})
        if variable.variability == "continuous" and random.random() < 0.5:
            reference = [unit.reference(variable.name)] * 2
            unit.fmu.setRealInputDerivatives(reference, [1, 2], [growth, random.normal(scale=0.05)])
    unit.step(STEP * random.exponential())
