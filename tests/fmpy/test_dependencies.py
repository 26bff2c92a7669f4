"""The declared dependencies against what really changes, at communication points and initially."""

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from reference import PERIOD
from test_description import initial_values
from test_stops import chattering

FORCES = [-30.0, -1.0, 1e-6, 0.5, 20.0, 200.0]
PRESSED = {
    "piercing.thickness": 0.0, "piercing.travel": 0.0, "clearance": -1.0,
    "excitation.amplitude": 0.5, "initial.position": -1.5, "initial.velocity": 0.0,
}
"""The suspension presses the mass against the stop, so that it comes to rest there."""
SCENES = {  # stop model: parameters that bring up its phases within a few periods
    "none": {"stop.model": 1},
    "kelvinVoigt": {"stop.model": 2},
    "kelvinVoigt, pulled away": {"stop.model": 2, "stop.release": 2, "contact.damping": 3.0},
    "piecewiseLinear": {
        "stop.model": 3, "stop.loading.count": 2, "stop.loading.from[2]": 0.2,
        "stop.loading.stiffness[2]": 20.0, "stop.unloading.count": 1,
    },
    "hertz": {"stop.model": 4, "stop.dissipation": 0.3},
    "preloaded": {"stop.model": 5},
    "rigid": {"stop.model": 6},
    "rigid, resting": PRESSED | {"stop.model": 6, "stop.restitution": 0.5},
    "preloaded, resting": PRESSED | {"stop.model": 5, "contact.damping": 2.0},
    "stuck in the strip": {
        "stop.model": 5, "clearance": 0.3, "excitation.amplitude": 0.6, "damping": 0.6,
        "piercing.friction": 40.0, "initial.position": 0.0, "initial.velocity": 1.5,
    },
}


INPUTS = {
    "force": FORCES, "material": [False], "material_real": [0.0],
    "base.acceleration": [-200.0, 20.0],
    "drive.speed": [0.7], "drive.amplitude": [-20.0, 200.0],
}
LED = {"drive.takes.speed": True, "drive.takes.amplitude": True}


def lead(unit, values):
    """Begins with a drive that its inputs lead as the parameters would."""
    amplitude = values.get("excitation.amplitude", 1.0)
    return unit.begin(values | LED | {"drive.speed": 1.15, "drive.amplitude": amplitude})


def changed(unit, names, before):
    """What is other than it was, by more than the rounding of the drive angle."""
    pairs = zip(names, unit.get(*names), before)
    return {n for n, a, b in pairs if abs(a - b) > 1e-12 * max(1.0, abs(a))}


def excite(unit, description, known, value):
    """Sets a value at a communication point; returns the outputs that change, and sets back."""
    names = [u.variable.name for u in description.outputs]
    state, before = unit.fmu.getFMUstate(), unit.get(*names)
    unit.set({known: value})
    moved = changed(unit, names, before)
    unit.fmu.setFMUstate(state)
    assert changed(unit, names, before) == set()
    unit.fmu.freeFMUstate(state)
    return moved


@pytest.fixture(scope="module")
def listed(description):
    """The inputs that outputs depend on; states are of model exchange."""
    inputs = {v.name for v in description.modelVariables if v.causality == "input"}
    return {u.variable.name: {d.name for d in u.dependencies} & inputs for u in description.outputs}


@pytest.mark.parametrize("scene", SCENES)
def test_at_communication_points(make, description, listed, scene):
    unit = lead(make(), SCENES[scene])
    for step in np.random.default_rng(5).exponential(PERIOD / 40, 400):
        unit.step(step)
        for known, values in INPUTS.items():
            for value in values:
                for name in excite(unit, description, known, value):
                    assert known in listed[name], (known, name, unit.get("phase"))


def test_in_chatter(make, listed):
    """The last bounces go on under a force that presses, and begin a flight under one that pulls."""
    free = [name for name, knowns in listed.items() if "force" not in knowns]
    for value in FORCES:
        unit = chattering(make())
        before = unit.get(*free)
        unit.set({"force": value})
        np.testing.assert_array_equal(unit.get(*free), before)


def test_no_dependency_is_made_up(make, description, listed):
    """Every listed dependency of an output shows in one of the scenes."""
    seen = set()
    for values in SCENES.values():
        unit = lead(make(), values)
        for _ in range(300):
            unit.step(PERIOD / 41)
            for known, tried in INPUTS.items():
                for value in tried:
                    seen |= {(name, known) for name in excite(unit, description, known, value)}
    wanted = {(name, known) for name, knowns in listed.items() for known in knowns}
    assert seen == wanted


def test_scenes_reach_every_phase(make, description):
    phases = {i.value for v in description.modelVariables if v.name == "phase"
              for i in v.declaredType.items}
    reached = {str(chattering(make()).get("phase"))}  # lasts some 1e-8 s
    for values in SCENES.values():
        unit = make().begin(values)
        for _ in range(2000):
            unit.step(PERIOD / 97)
            reached.add(str(unit.get("phase")))
    assert reached == {str(p) for p in phases}


def test_initial_unknowns_follow_inputs_set_in_initialisation(make, description):
    """Inputs set between entering and leaving initialisation count like those set before."""
    unknowns = {u.variable.name: {d.name for d in u.dependencies}
                for u in description.initialUnknowns}
    names = list(unknowns)
    for values in SCENES.values():
        unit = make()
        unit.fmu.setupExperiment()
        unit.set(values | LED)
        unit.fmu.enterInitializationMode()
        try:
            before = unit.get(*names)
        except FMICallException:
            pytest.fail(f"no outputs in initialisation mode: {values}")
        for known, value in (("force", 3.0), ("material", False), ("base.acceleration", 2.0),
                             ("drive.speed", 0.7), ("drive.amplitude", 3.0)):
            unit.set({known: value})
            for name in changed(unit, names, before):
                assert known in unknowns[name], (known, name)
            before = unit.get(*names)


@pytest.mark.parametrize("model", range(1, 7))
def test_initial_unknowns_and_the_ways_between_the_stops(make, description, model):
    """Both distances, moved either way, with the mass on either side of each place."""
    unknowns = {u.variable.name: {d.name for d in u.dependencies}
                for u in description.initialUnknowns}
    names = list(unknowns)
    distances = ["piercing.thickness", "piercing.travel", "rigid.travel"]
    for position in (10.2, 10.6, 10.88, 11.2, 12.1):
        base = {"stop.model": model, "rigid.travel": 1.5, "initial.position": position}
        before = initial_values(make, base, names)
        for known in distances if before is not None else []:
            for share in (0.3, 0.9, 1.1, 2.0):
                value = share * (base | {"piercing.thickness": 0.4, "piercing.travel": 0.5})[known]
                after = initial_values(make, base | {known: value}, names)
                if after is not None:
                    same = after == before
                    moved = {name for name, still in zip(names, same) if not still}
                    assert all(known in unknowns[name] for name in moved), (known, moved)
