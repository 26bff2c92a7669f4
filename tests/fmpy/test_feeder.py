"""feeder.fmu: patterns, chance, jams, its shaft, and the press behind it."""

import fmpy
import numpy as np
import pytest
from conftest import maker
from packages import package
from reference import PERIOD

RANDOM = {"supply.model": 3, "supply.probability": 0.7, "supply.seed": 20}


@pytest.fixture(scope="module")
def feeder_folder(path, tmp_path_factory):
    folder = fmpy.extract(package(path, "feeder"), unzipdir=str(tmp_path_factory.mktemp("feeder")))
    return folder, fmpy.read_model_description(folder)


@pytest.fixture
def feeder(feeder_folder):
    with maker(*feeder_folder) as make_one:
        yield make_one


def strokes(unit, count, size=PERIOD):
    """Whether each stroke got a strip, the one at the start first."""
    seen = [unit.get("material")]
    while len(seen) < count:
        unit.step(size)
        seen.append(unit.get("material"))
    return [bool(one) for one in seen]


def numbers(seed, count):
    """SplitMix64 as its authors wrote it, as shares of 1."""
    mask, state = 2**64 - 1, seed
    for _ in range(count):
        state = (state + 0x9E3779B97F4A7C15) & mask
        z = ((state ^ (state >> 30)) * 0xBF58476D1CE4E5B9) & mask
        z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & mask
        yield ((z ^ (z >> 31)) >> 11) / 2**53


def test_always(feeder):
    assert all(strokes(feeder().begin(), 50))


@pytest.mark.parametrize("runs", [[9, 1], [0, 1, 2], [1, 0, 1, 3], [3], [2, 1, 4, 2, 1, 5]])
def test_pattern(feeder, runs):
    pattern = [k % 2 == 0 for k, run in enumerate(runs) for _ in range(run)]
    values = {f"supply.pattern.strokes[{k + 1}]": run for k, run in enumerate(runs)}
    unit = feeder().begin(values | {"supply.model": 2, "supply.pattern.count": len(runs)})
    expected = [pattern[k % len(pattern)] for k in range(60)]
    assert strokes(unit, 60) == expected
    assert unit.get("strip.count") == sum(expected)
    assert unit.get("missing.count") == 60 - sum(expected)
    assert unit.get("stroke.count") == 60


def test_a_pattern_without_strokes_is_refused(feeder):
    unit = feeder()
    unit.fmu.setupExperiment()
    unit.set({"supply.model": 2, "supply.pattern.count": 1, "supply.pattern.strokes[1]": 0})
    unit.fmu.enterInitializationMode()
    unit.refused(unit.fmu.exitInitializationMode, "supply.pattern.strokes")


def test_chance_and_jams_stroke_by_stroke(feeder):
    unit = feeder().begin(RANDOM | {"jam.probability": 0.05, "jam.strokes": 4})
    drawn, jammed, expected, jams = numbers(20, 2000), 0, [], 0
    for _ in range(1000):
        comes, jam = next(drawn) < 0.7, next(drawn) < 0.05
        if jammed == 0 and jam:
            jammed, jams = 4, jams + 1
        expected.append(comes and jammed == 0)
        jammed = max(0, jammed - 1)
    assert strokes(unit, 1000) == expected
    assert unit.get("jam.count") == jams > 10


def test_shares_and_seeds(feeder):
    shares = []
    for seed in range(20):
        unit = feeder().begin(RANDOM | {"supply.seed": seed})
        unit.step(9999 * PERIOD)
        assert unit.get("stroke.count") == 10000
        shares.append(unit.get("strip.count") / 10000)
    assert len(set(shares)) > 15
    deviation = np.sqrt(0.7 * 0.3 / 10000)
    assert np.abs(np.array(shares) - 0.7).max() < 4 * deviation
    assert abs(np.mean(shares) - 0.7) < 4 * deviation / np.sqrt(20)


def test_steps_of_any_size_see_the_same_strokes(feeder):
    names = ["strip.count", "jam.count", "stroke.count", "material"]
    ends = []
    for per_period in (0.01, 0.3, 1, 7, 50):
        unit = feeder().begin(RANDOM | {"jam.probability": 0.1})
        for _ in range(round(100 * per_period)):
            unit.step(PERIOD / per_period)
        ends.append(list(unit.get(*names)))
        assert abs(unit.get("fed.time") - 99.5 * PERIOD) < 1e-9
    assert all(end == ends[0] for end in ends)


def test_the_angle_at_which_it_feeds(feeder):
    for angle in (-1.0, 0.5, 5.0):
        unit = feeder().begin({"feed.angle": angle, "feed.speed": 2.0, "initial.angle": 0.3})
        unit.step(10.0)
        turns = np.floor((20.3 - angle) / (2 * np.pi))
        assert abs(unit.get("fed.time") - (angle + 2 * np.pi * turns - 0.3) / 2.0) < 1e-12


def test_a_shaft_that_runs_up(feeder):
    """With derivatives the angle is a polynomial, and the time of a stroke that at which it is reached."""
    unit = feeder().begin({"feed.takes.angle": True})
    unit.set({"angle": 0.0})
    unit.fmu.setRealInputDerivatives([unit.reference("angle")] * 2, [1, 2], [0.0, 0.5])
    unit.step(20.0)  # 100 rad: fifteen full turns beyond pi
    assert unit.get("stroke.count") == 17
    assert abs(unit.get("fed.time") - np.sqrt(31 * np.pi / 0.25)) < 1e-12


def test_turning_back_begins_no_stroke(feeder):
    unit = feeder().begin({"feed.speed": 1.0})
    unit.step(4.0)
    for speed, size, strokes in ((-1.0, 5.0, 2), (1.0, 5.0, 2), (1.0, 6.0, 3)):
        unit.set({"feed.speed": speed})
        unit.step(size)
        assert unit.get("stroke.count") == strokes


def test_held_by_hand(feeder):
    unit = feeder().begin()
    assert all(strokes(unit, 5))
    for name, value, free in (("held", True, False), ("held_real", 1.0, 0.0)):
        unit.set({name: value})
        assert strokes(unit, 4) == [True, False, False, False]
        unit.set({name: free})
        assert strokes(unit, 2) == [False, True]


def test_too_many_strokes_are_discarded(feeder):
    unit = feeder().begin({"feed.speed": 1e12})
    with pytest.raises(fmpy.fmi1.FMICallException) as caught:
        unit.step(100.0)
    assert caught.value.status == 2
    unit.set({"feed.speed": 1.0})
    unit.step(10.0)
    assert unit.get("stroke.count") == 3


def test_the_press_behind_it(feeder, make):
    """Each strip that the feeder has put in is pierced, and none that it has not; its shaft is that of the press."""
    unit, press = feeder().begin(RANDOM | {"feed.takes.angle": True}), make().begin()
    for _ in range(200):
        for _ in range(50):
            unit.set({"angle": press.get("drive.angle")})
            press.set({"material": bool(unit.get("material"))})
            press.step(PERIOD / 50)
            unit.step(PERIOD / 50)
    # The strip of the stroke that began last is still to come.
    assert press.get("pierce.count") == unit.get("strip.count") - unit.get("material")
    assert press.get("impact.count") == 200
