"""Input tables, as FMPy's simulate_fmu feeds them, against the unit driven by hand."""

import fmpy
import numpy as np
import pytest
from reference import PERIOD

NAMES = ["position", "velocity", "impact.count", "pierce.count"]
END = 8 * PERIOD


def table(rows, *columns):
    types = {"force": float, "clearance": float, "material": bool}
    return np.array(rows, dtype=[("time", float)] + [(c, types[c]) for c in columns])


def simulate(path, signals, interval=0.05, **options):
    result = fmpy.simulate_fmu(
        path, stop_time=END, output_interval=interval, input=signals, output=NAMES, **options
    )
    return np.array([result[-1][name] for name in NAMES])


def by_hand(unit, *pieces):
    """Sets values at times and steps in between, in as few steps as there are times."""
    unit.begin(pieces[0][1])
    for (_, values), (end, _) in zip(pieces, [*pieces[1:], (END, None)]):
        unit.set(values)
        unit.step(end - unit.time)
    return unit.get(*NAMES)


@pytest.mark.parametrize("interval", [0.01, 0.5, 3.0])
def test_force_that_jumps(path, unit, interval):
    rows = [(0, 0.0), (7.3, 0.0), (7.3, 0.7), (20.05, 0.7), (20.05, -0.4), (END, -0.4)]
    run = simulate(path, table(rows, "force"), interval)
    hand = by_hand(unit, (0.0, {"force": 0.0}), (7.3, {"force": 0.7}), (20.05, {"force": -0.4}))
    np.testing.assert_allclose(run, hand, atol=1e-10)


@pytest.mark.parametrize("interval", [0.01, 0.5, 3.0])
def test_material_that_comes_and_goes(path, unit, interval):
    rows = [(0, True), (8.0, True), (8.0, False), (24.0, False), (24.0, True), (END, True)]
    run = simulate(path, table(rows, "material"), interval)
    hand = by_hand(
        unit, (0.0, {"material": True}), (8.0, {"material": False}), (24.0, {"material": True})
    )
    np.testing.assert_allclose(run, hand, atol=1e-10)
    impacts, pierced = run[2:]
    assert 0 < pierced < impacts


def test_force_and_material_together_from_the_start(path, unit):
    rows = [(0, 0.3, False), (END, 0.3, False)]
    run = simulate(path, table(rows, "force", "material"))
    hand = by_hand(unit, (0.0, {"force": 0.3, "material": False}))
    np.testing.assert_allclose(run, hand, atol=1e-10)
    assert run[3] <= 1


def test_parameter_tuned_from_a_table(path, unit):
    rows = [(0, 10.0), (15.0, 10.0), (15.0, 9.5), (END, 9.5)]
    run = simulate(path, table(rows, "clearance"))
    hand = by_hand(unit, (0.0, {"clearance": 10.0}), (15.0, {"clearance": 9.5}))
    np.testing.assert_allclose(run, hand, atol=1e-10)


def test_ramp_held_over_each_step_converges(path, unit):
    """FMPy holds a continuous input over a step: the error falls with the step, not faster."""
    unit.begin({"force": 0.1})
    unit.fmu.setRealInputDerivatives([unit.reference("force")], [1], [0.01])
    unit.step(END)
    exact = unit.get(*NAMES)[:2]
    signals = table([(-1.0, 0.09), (END + 1.0, 0.1 + 0.01 * (END + 1.0))], "force")
    errors = [abs(simulate(path, signals, size)[:2] - exact).max() for size in (0.04, 0.02, 0.01)]
    ratios = [errors[0] / errors[1], errors[1] / errors[2]]
    np.testing.assert_allclose(ratios, 2.0, rtol=0.1)


def test_polygon_with_derivatives(make):
    """A chain of ramps: one step from corner to corner, or many with the values in between."""
    times, forces = [0.0, 5.0, 12.0, 12.0, 30.0, END], [0.0, 0.4, -0.2, 0.5, 0.5, 1.0]
    coarse, fine = make().begin(), make().begin()
    force = coarse.reference("force")
    for t0, t1, f0, f1 in zip(times, times[1:], forces, forces[1:]):
        if t1 > t0:
            rate = (f1 - f0) / (t1 - t0)
            for unit, count in ((coarse, 1), (fine, 57)):
                for number in range(count):
                    unit.set({"force": f0 + rate * (t1 - t0) * number / count})
                    unit.fmu.setRealInputDerivatives([force], [1], [rate])
                    unit.step(t0 + (t1 - t0) * (number + 1) / count - unit.time)
    np.testing.assert_allclose(fine.get(*NAMES), coarse.get(*NAMES), atol=1e-9)


def test_recorder_reads_every_output(path, description):
    every = [v.name for v in description.modelVariables]
    result = fmpy.simulate_fmu(path, stop_time=PERIOD, output=every, record_events=True)
    assert set(every) <= set(result.dtype.names)
    assert all(np.isfinite(result[name]).all() for name in every)
