"""What holds of every unit, whatever it does: states, reset, refusals, divisions into steps, dependencies, derivatives."""

import numpy as np
from fmpy.fmi1 import FMICallException
from kinds import MODELS, RATES, STEP, bits, excite, kind, make  # noqa: F401


def test_states_go_on_bit_by_bit_here_and_elsewhere(make, kind):
    unit, other = make().begin(kind.start), make()
    for seed in range(20):
        excite(unit, kind, np.random.default_rng(seed))
        time, state = unit.time, unit.fmu.getFMUstate()
        blob = unit.fmu.serializeFMUstate(state)
        ends = []
        for here in (unit, unit, other):
            if here is other:
                copy = other.fmu.deSerializeFMUstate(blob)
                other.fmu.setFMUstate(copy)
                other.fmu.freeFMUstate(copy)
            else:
                here.fmu.setFMUstate(state)
            here.time = time
            random = np.random.default_rng(1000 + seed)
            for _ in range(10):
                excite(here, kind, random)
            ends.append(bits(here, kind.names))
        assert ends[0] == ends[1] == ends[2]
        unit.fmu.freeFMUstate(state)


def test_damaged_states_are_refused(make, kind):
    unit = make().begin(kind.start)
    unit.step(1.0)
    state = unit.fmu.getFMUstate()
    blob = unit.fmu.serializeFMUstate(state)
    for at in np.random.default_rng(2).integers(0, len(blob), 50):
        damaged = bytearray(blob)
        damaged[at] ^= 1 << at % 8
        unit.refused(lambda: unit.fmu.deSerializeFMUstate(bytes(damaged)))
    unit.fmu.freeFMUstate(state)


def test_reset_equals_fresh(make, kind):
    used, fresh = make(), make()
    used.begin(kind.start)
    for seed in range(30):
        excite(used, kind, np.random.default_rng(seed))
    used.fmu.reset()
    assert bits(used, [v.name for v in kind.inputs]) == bits(fresh, [v.name for v in kind.inputs])
    for unit in (used, fresh):
        unit.begin()
        unit.step(7.0)
    assert bits(used, kind.names) == bits(fresh, kind.names)


def wrong_calls(unit, kind):
    fmu, variables = unit.fmu, kind.description.modelVariables
    yield lambda: fmu.getReal([4711])
    yield lambda: unit.step(-1.0)
    yield lambda: unit.step(0.0)
    yield lambda: fmu.doStep(unit.time + 5.0, 1.0)
    yield lambda: fmu.doStep(float("nan"), 1.0)
    yield fmu.enterInitializationMode
    yield fmu.exitInitializationMode
    for variable in variables:
        reference = [variable.valueReference]
        if variable.type == "Real":
            yield lambda: fmu.getBoolean(reference)
            if variable.causality == "input":
                yield lambda: fmu.setReal(reference, [float("nan")])
                yield lambda: fmu.setReal(reference, [1e300])
        else:
            yield lambda: fmu.getReal(reference)
        if variable.causality == "output" or variable.variability == "fixed":
            setter = {"Real": fmu.setReal, "Boolean": fmu.setBoolean}.get(variable.type, fmu.setInteger)
            yield lambda: setter(reference, [1])


def test_wrong_calls_leave_one_line_and_no_trace(make, kind):
    unit = make().begin(kind.start)
    unit.step(1.0)
    before, time = bits(unit, kind.names), unit.time
    for call in wrong_calls(unit, kind):
        unit.refused(call)
        unit.time = time
        assert bits(unit, kind.names) == before


def test_division_into_steps(make, kind):
    """Inputs that go on as polynomials, without jumps that a unit takes over a step: the same however it is reached."""
    ends, free = [], [n for n in kind.names if ".step." not in n and not n.startswith("contact.")]
    for seed in (None, 1, 2):
        unit = make().begin(kind.start)
        for variable in kind.inputs:
            if variable.variability == "continuous":
                unit.set({variable.name: 0.0 if variable.name in ("angle", "load.work") else 0.1})
                slopes = [RATES.get(variable.name, 0.05), 0.002]
                unit.fmu.setRealInputDerivatives([unit.reference(variable.name)] * 2, [1, 2], slopes)
        steps = np.array([20.0])
        if seed:
            steps = np.random.default_rng(seed).exponential(size=100)
            steps *= 20.0 / steps.sum()
        for step in steps:
            unit.step(step)
        ends.append(unit.get(*free))
    np.testing.assert_allclose(ends[1], ends[0], rtol=1e-8, atol=1e-8)
    np.testing.assert_allclose(ends[2], ends[0], rtol=1e-8, atol=1e-8)


def moved(unit, names, before):
    return {n for n, now, then in zip(names, unit.get(*names), before)
            if abs(now - then) > 1e-12 * max(1.0, abs(then))}


def test_dependencies_at_communication_points(make, kind):
    listed = {u.variable.name: {d.name for d in u.dependencies} for u in kind.description.outputs}
    unit = make().begin(kind.start)
    for seed in range(100):
        excite(unit, kind, np.random.default_rng(seed))
        for variable in kind.inputs:
            state, before = unit.fmu.getFMUstate(), unit.get(*kind.outputs)
            other = not unit.get(variable.name)
            other = other if variable.type == "Boolean" else float(other) * 0.7
            unit.set({variable.name: other})
            for name in moved(unit, kind.outputs, before):
                assert variable.name in listed[name], (variable.name, name)
            unit.fmu.setFMUstate(state)
            unit.fmu.freeFMUstate(state)


def initial(make, values, names):
    unit = make()
    unit.fmu.setupExperiment()
    try:
        unit.set(values)
        unit.fmu.enterInitializationMode()
        unit.fmu.exitInitializationMode()
    except FMICallException:  # values that make no unit
        return None
    return unit.get(*names)


def test_initial_dependencies(make, kind):
    listed = {u.variable.name: {d.name for d in u.dependencies} for u in kind.description.initialUnknowns}
    names, random = list(listed), np.random.default_rng(3)
    change = {"Real": lambda old: 0.9 * old + 0.07, "Boolean": lambda old: not old}
    for model in MODELS.get(kind.name, [{}]):
        base = kind.start | model
        before = initial(make, base, names)
        for known in kind.description.modelVariables:
            if known.causality == "output":
                continue
            old = base.get(known.name, make().get(known.name))
            for _ in range(3 if known.type == "Integer" else 1):
                other = change.get(known.type, lambda old: old % 2 + int(random.integers(1, 9)))
                after = initial(make, base | {known.name: other(old)}, names)
                if after is not None:
                    changed = {n for n, a, b in zip(names, after, before) if a != b}
                    assert all(known.name in listed[n] for n in changed), (known.name, changed)


def test_directional_derivatives(make, kind):
    """Of the outputs after a step by the inputs as they were set for it, beside differences of such steps."""
    known = [v.name for v in kind.inputs if v.variability == "continuous"]
    values = {"angle": 2.0, "load.work": 0.4, "voltage": 0.1, "drive.speed": 1.1, "drive.amplitude": 0.9}
    size = 1.7

    def end(name, change):
        unit = make().begin(kind.start | {n: values.get(n, 0.0) for n in known})
        unit.step(0.2)
        unit.set({n: values.get(n, 0.0) + change * (n == name) for n in known})
        unit.step(size)
        return unit

    for name in known:
        unit = end(name, 0.0)
        found = unit.fmu.getDirectionalDerivative(
            [unit.reference(n) for n in kind.reals], [unit.reference(name)], [1.0])
        width = 1e-4
        low, high = (end(name, sign * width).get(*kind.reals) for sign in (-1, 1))
        np.testing.assert_allclose(found, (high - low) / (2 * width), rtol=2e-4, atol=2e-5, err_msg=name)


def test_output_derivatives(make, kind):
    continuous = [v.name for v in kind.description.modelVariables
                  if v.causality == "output" and v.variability == "continuous"]
    unit, width = make().begin(kind.start), 1e-6
    for name in ("torque", "power"):  # these have none
        continuous = [n for n in continuous if n != name]
    if not continuous:
        return
    for _ in range(10):
        unit.step(STEP)
        rates = unit.fmu.getRealOutputDerivatives([unit.reference(n) for n in continuous], [1] * len(continuous))
        before = unit.get(*continuous)
        unit.step(width)
        np.testing.assert_allclose((unit.get(*continuous) - before) / width, rates, rtol=1e-3, atol=1e-3)
