"""The package as importers see it before they load it."""

import re
import zipfile

import numpy as np
import pytest
from conftest import TOP
from fmpy.fmi1 import FMICallException
from fmpy.validation import validate_fmu


def test_validation_finds_nothing(each):
    assert validate_fmu(each) == []


def test_top_level_description_is_the_packaged_one(path):
    with zipfile.ZipFile(path) as archive:
        packaged = archive.read("modelDescription.xml").decode()
        names = archive.namelist()
    assert packaged == (TOP / "modelDescription.xml").read_text()
    assert "documentation/index.html" in names
    assert any(name.startswith("documentation/licenses/") for name in names)


def test_contract(description):
    variables = {v.name: v for v in description.modelVariables}
    expected = {
        "mass": ("fixed", "kg", 1), "stiffness": ("fixed", "N/m", 1),
        "damping": ("fixed", "N.s/m", 0.04),
        "excitation.amplitude": ("tunable", "N", 1),
        "excitation.frequency": ("tunable", "rad/s", 1.15),
        "excitation.phase": ("fixed", "rad", 0),
        "clearance": ("tunable", "m", 10), "contact.damping": ("fixed", "N.s/m", 0.18),
        "stop.stiffness": ("tunable", "N/m", 7), "stop.preload": ("tunable", "N", 70),
        "piercing.stiffness": ("fixed", "N/m", 21), "piercing.friction": ("fixed", "N/m", 23),
        "piercing.thickness": ("fixed", "m", 0.4), "piercing.travel": ("fixed", "m", 0.5),
        "stop.restitution": ("fixed", None, 0.6), "stop.exponent": ("fixed", None, 1.5),
        "stop.dissipation": ("fixed", "s/m", 0), "rigid.travel": ("fixed", "m", 5),
        "stop.loading.from[1]": ("fixed", "m", 0), "stop.unloading.from[8]": ("fixed", "m", 0),
        "stop.loading.stiffness[1]": ("fixed", "N/m", 7),
        "stop.loading.count": ("fixed", None, 1), "stop.unloading.count": ("fixed", None, 0),
    }
    for name, (variability, unit, start) in expected.items():
        variable = variables[name]
        assert variable.causality == "parameter", name
        assert variable.variability == variability, name
        assert variable.unit == unit, name
        assert np.isclose(float(variable.start), start, rtol=1e-15), name
    assert (variables["stop.model"].start, variables["stop.release"].start) == ("5", "1")
    assert (variables["rigid.present"].type, variables["rigid.present"].start) == ("Boolean", "true")
    items = lambda name: {i.name: int(i.value) for i in variables[name].declaredType.items}
    assert items("stop.model") == {
        "none": 1, "kelvinVoigt": 2, "piecewiseLinear": 3, "hertz": 4, "preloaded": 5, "rigid": 6,
    }
    assert items("stop.release") == {"clearance": 1, "zeroForce": 2}
    assert items("phase") == {
        "free": 1, "pierce": 2, "cut": 3, "gap": 4, "stop": 5, "stuck": 6, "resting": 7,
        "released": 8, "chatter": 9,
    }
    assert (variables["force"].causality, variables["force"].variability) == ("input", "continuous")
    assert (variables["material"].causality, variables["material"].start) == ("input", "true")
    for name in ("base.acceleration", "drive.speed", "drive.amplitude"):
        assert (variables[name].causality, variables[name].variability) == ("input", "continuous")
        assert float(variables[name].start) == 0.0
    for name in ("drive.takes.speed", "drive.takes.amplitude"):
        assert (variables[name].causality, variables[name].start) == ("parameter", "false")
    outputs = {v.name: v.variability for v in description.modelVariables if v.causality == "output"}
    assert outputs == {
        "position": "continuous", "velocity": "continuous", "acceleration": "continuous",
        "contact.force": "continuous", "phase": "discrete", "impact.count": "discrete", "impact.below.count": "discrete",
        "pierce.count": "discrete", "impact.time": "discrete", "impact.velocity": "discrete",
        "energy.mechanical": "continuous", "energy.supplied": "continuous",
        "energy.dissipated": "continuous",
        "drive.angle": "continuous", "drive.force": "continuous", "drive.power": "continuous",
        "drive.work": "continuous", "frame.force": "continuous",
        "contact.peak": "discrete", "contact.impulse": "discrete", "impact.step.count": "discrete",
        "impact.step.first.time": "discrete", "impact.step.first.velocity": "discrete",
        "impact.step.hardest.time": "discrete", "impact.step.hardest.velocity": "discrete",
        "pierce.step.count": "discrete",
    }


def test_names_stand_depth_first(description):
    left, present = set(), []
    for variable in description.modelVariables:
        parts = re.split(r"[.\[]", variable.name)[:-1]
        branches = [tuple(parts[:depth]) for depth in range(1, len(parts) + 1)]
        left |= set(present) - set(branches)
        assert not left & set(branches), variable.name
        present = branches
    for name in ("loading.from", "loading.stiffness", "unloading.from", "unloading.stiffness"):
        elements = [v.name for v in description.modelVariables if v.name.startswith(f"stop.{name}")]
        assert elements == [f"stop.{name}[{number}]" for number in range(1, 9)]


CHANGES = {"Real": lambda old: 0.9 * old + 0.07, "Boolean": lambda old: not old}
CHAIN = {
    "stop.loading.count": 2, "stop.loading.from[2]": 0.3, "stop.loading.stiffness[2]": 20.0,
    "stop.unloading.count": 2, "stop.unloading.from[2]": 0.4, "stop.unloading.stiffness[1]": 5.0,
    "stop.unloading.stiffness[2]": 10.0,
}
STATES = [(9.0, 1.0), (10.2, 1.0), (10.7, -1.0), (11.3, 1.0), (11.3, -1.0), (11.4, 0.0)]


def initial_values(make, values, names):
    unit = make()
    unit.fmu.setupExperiment()
    try:
        unit.set(values)
        unit.fmu.enterInitializationMode()
        unit.fmu.exitInitializationMode()
    except FMICallException:  # a change that makes no machine
        return None
    return unit.get(*names)


@pytest.mark.parametrize("model", range(1, 7))
def test_initial_unknowns_depend_on_nothing_else(make, description, model):
    unknowns = {u.variable.name: {d.name for d in u.dependencies}
                for u in description.initialUnknowns}
    names = list(unknowns)
    knowns = [v for v in description.modelVariables if v.causality in ("input", "parameter")]
    for position, velocity in STATES:
        base = CHAIN | {
            "stop.model": model, "rigid.travel": 0.5,
            "initial.position": min(position, 10.9) if model == 6 else position,
            "initial.velocity": velocity,
        }
        before = initial_values(make, base, names)
        for known in knowns:
            old = make().get(known.name) if known.name not in base else base[known.name]
            change = CHANGES.get(known.type, lambda old: old % 2 + 1)
            after = initial_values(make, base | {known.name: change(old)}, names)
            if after is not None:
                moved = {name for name, a, b in zip(names, after, before) if a != b}
                assert all(known.name in unknowns[name] for name in moved), (known.name, moved)
