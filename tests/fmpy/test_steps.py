"""The same motion for every division into communication steps."""

import numpy as np
import pytest
from reference import PERIOD, UNLOADED

NAMES = ["position", "velocity", "acceleration", "contact.force", "impact.time",
         "impact.velocity", "impact.count", "pierce.count", "energy.mechanical",
         "energy.supplied", "energy.dissipated"]
END = 10 * PERIOD
SCENES = {"loaded": {}, "unloaded": UNLOADED, "off the orbit": {"initial.velocity": 3.3}}


def equal_steps(size):
    return np.diff(np.append(np.arange(0.0, END - size / 2, size), END))


def random_steps(seed, count):
    """From some 1e-9 s to longer than a period."""
    shares = 10.0 ** np.random.default_rng(seed).uniform(-9, 0.8, count)
    return np.diff(np.concatenate([[0.0], np.minimum(np.cumsum(shares), END), [END]]))


DIVISIONS = {
    "0.1 ms": equal_steps(1e-4), "1 ms": equal_steps(1e-3), "10 ms": equal_steps(1e-2),
    "a hundredth": equal_steps(PERIOD / 100), "0.7 s": equal_steps(0.7),
    "a period": equal_steps(PERIOD), "random": random_steps(3, 400),
    "short and long": np.tile([1e-9, PERIOD - 1e-9], 10),
}


def run(unit, steps):
    for size in steps[steps > 0.0]:
        unit.step(size)
    return unit.get(*NAMES)


@pytest.mark.parametrize("division", DIVISIONS)
@pytest.mark.parametrize("scene", SCENES)
def test_every_division(make, scene, division):
    whole = run(make().begin(SCENES[scene]), np.array([END]))
    steps = DIVISIONS[division]
    assert abs(steps.sum() - END) < 1e-9
    unit = make().begin(SCENES[scene])
    values = run(unit, steps)
    late = make().begin(SCENES[scene])  # the sum of the steps is END but for rounding
    np.testing.assert_allclose(values, run(late, np.array([unit.time])), atol=1e-10, rtol=1e-10)
    assert list(values[6:8]) == list(whole[6:8])


def test_communication_points_rounded_to_nanoseconds(make):
    """As engines with an integer clock call it: each point is rounded on its own."""
    unit, whole = make().begin(UNLOADED), make().begin(UNLOADED)
    points = np.round(np.arange(0, END, PERIOD / 1000) * 1e9) * 1e-9
    for now, later in zip(points, points[1:]):
        unit.fmu.doStep(now, later - now)
    whole.step(points[-1])
    np.testing.assert_allclose(unit.get(*NAMES), whole.get(*NAMES), atol=1e-10, rtol=1e-10)


def test_roll_back_at_every_division(make):
    """Tries a long step, goes back, and takes the way in short ones."""
    unit, straight = make().begin(), make().begin()
    for size in random_steps(8, 60):
        if size > 0.0:
            time, state = unit.time, unit.fmu.getFMUstate()
            unit.set({"force": 3.0})
            unit.step(2.0 * size)
            unit.fmu.setFMUstate(state)
            unit.time = time
            unit.step(size / 2)
            unit.step(size / 2)
            unit.fmu.freeFMUstate(state)
    straight.step(unit.time)
    np.testing.assert_allclose(unit.get(*NAMES), straight.get(*NAMES), atol=1e-10, rtol=1e-10)


def test_states_kept_and_set_in_any_order(make):
    unit, kept, after = make().begin(), [], []
    for _ in range(30):
        kept.append((unit.time, unit.fmu.getFMUstate()))
        unit.step(0.9)
        after.append(unit.get(*NAMES))
    for number in np.random.default_rng(4).permutation(30):
        unit.time, state = kept[number]
        unit.fmu.setFMUstate(state)
        unit.step(0.9)
        assert (unit.get(*NAMES) == after[number]).all()
    for _, state in kept:
        unit.fmu.freeFMUstate(state)
