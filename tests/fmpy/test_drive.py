"""The drive led by its inputs, against an independent integration and against the parameters."""

import numpy as np
import pytest
from reference import PERIOD
from scipy.integrate import solve_ivp
from test_dependencies import LED

START = {"initial.position": 2.0, "initial.velocity": 9.0}
NEW = ["drive.angle", "drive.force", "drive.power", "drive.work", "frame.force", "contact.peak",
       "contact.impulse", "impact.step.count", "impact.step.hardest.velocity", "pierce.step.count"]


def slopes(unit, name, *derivatives):
    orders = list(range(1, len(derivatives) + 1))
    unit.fmu.setRealInputDerivatives([unit.reference(name)] * len(orders), orders, derivatives)


def swept(end, speed, rate, amplitude, swelling, base):
    """State, impulse and work of the unloaded machine with a stop of stiffness 7, preload 0."""

    def right(pressed):
        def rates(t, y):
            drive = (amplitude + swelling * t) * np.cos(speed * t + rate * t**2 / 2)
            contact = 7.0 * (y[0] - 10.0) + 0.14 * y[1] if pressed else 0.0
            force = drive - base - contact
            return [y[1], force - 0.04 * y[1] - y[0], contact, drive * y[1]]
        return rates

    t, y, pressed, impacts = 0.0, np.array([2.0, 9.0, 0.0, 0.0]), False, []
    while t < end:
        def crossing(t, y):
            return y[0] - 10.0
        crossing.terminal, crossing.direction = True, -1 if pressed else 1
        run = solve_ivp(right(pressed), (t, min(end, t + 0.4)), y, method="DOP853", rtol=1e-13,
                        atol=1e-13, events=crossing, max_step=0.05)
        t, y = run.t[-1], run.y[:, -1]
        if run.status == 1:
            if not pressed:
                impacts.append((t, y[1]))
            pressed = not pressed
            y[0] = np.nextafter(10.0, np.inf if pressed else -np.inf)
    return y, impacts


@pytest.mark.parametrize("steps", [1, 13, 500])
def test_a_sweep_against_scipy(make, steps):
    end, speed, rate, amplitude, swelling, base = 25.0, 0.9, 0.02, 1.2, 0.03, 0.15
    unloaded = {"piercing.thickness": 0.0, "piercing.travel": 0.0, "stop.preload": 0.0}
    unit = make().begin(LED | START | unloaded | {
        "drive.speed": speed, "drive.amplitude": amplitude, "base.acceleration": base,
    })
    slopes(unit, "drive.speed", rate)
    slopes(unit, "drive.amplitude", swelling)
    impulse = count = 0
    for number in range(steps):
        unit.step(end * (number + 1) / steps - unit.time)
        impulse += unit.get("contact.impulse")
        count += unit.get("impact.step.count")
    (position, velocity, pressed, work), impacts = swept(
        end, speed, rate, amplitude, swelling, base)
    assert count == unit.get("impact.count") == len(impacts) > 1
    np.testing.assert_allclose(unit.state(), [position, velocity], atol=2e-9)
    np.testing.assert_allclose([impulse, unit.get("drive.work")], [pressed, work], atol=2e-8)
    np.testing.assert_allclose(unit.get("impact.time", "impact.velocity"), impacts[-1], atol=2e-9)
    assert abs(unit.get("drive.angle") - (speed * end + rate * end**2 / 2)) < 1e-11


def test_balance_over_a_thousand_periods(make):
    """The drive's work is what is dissipated and stored, in the largest step there is."""
    unit = make().begin(LED | {"drive.speed": 1.15, "drive.amplitude": 1.0})
    before = unit.get("energy.mechanical")
    unit.step(1000 * PERIOD)
    work = unit.get("drive.work")
    balance = unit.get("energy.dissipated") + unit.get("energy.mechanical") - before
    assert work > 1000.0 and abs(work - balance) < 1e-9 * work
    assert unit.get("impact.step.count") == unit.get("pierce.step.count") == 1000


def test_what_a_master_sets_anyway_changes_nothing(make, description):
    """Masters set all inputs to their start values, before and on the way."""
    plain, told = make().begin(), make()
    starts = {v.name: v.start == "true" if v.type == "Boolean" else float(v.start)
              for v in description.modelVariables if v.causality == "input"}
    told.begin(starts)
    for _ in range(40):
        told.set(starts)
        for unit in (plain, told):
            unit.step(PERIOD / 7)
    names = [u.variable.name for u in description.outputs]
    np.testing.assert_array_equal(plain.get(*names), told.get(*names))


def test_roll_back_over_a_ramp(make):
    unit = make().begin(LED | START | {"drive.speed": 0.2, "drive.amplitude": 3.0})
    slopes(unit, "drive.speed", 0.05, 0.001)
    unit.step(5.0)
    state = unit.fmu.getFMUstate()
    unit.step(20.0)
    there = unit.get(*NEW)
    unit.fmu.setFMUstate(state)
    unit.time = 5.0
    unit.step(20.0)
    np.testing.assert_array_equal(unit.get(*NEW), there)
    unit.fmu.freeFMUstate(state)


def test_derivatives_of_outputs(make):
    """Orders 1 and 2 of what is new, against differences."""
    unit = make().begin(LED | START | {"drive.speed": 1.0, "drive.amplitude": 2.0})
    slopes(unit, "drive.speed", 0.05)
    slopes(unit, "drive.amplitude", -0.1)
    names = ["drive.angle", "drive.force", "drive.power", "drive.work", "frame.force"]
    references = [unit.reference(name) for name in names]
    unit.step(2.0)
    width = 1e-3
    values = []
    for _ in range(3):
        values.append(unit.get(*names))
        if len(values) == 2:
            first = unit.fmu.getRealOutputDerivatives(references, [1] * len(names))
            second = unit.fmu.getRealOutputDerivatives(references, [2] * len(names))
        unit.step(width)
    np.testing.assert_allclose(first, (values[2] - values[0]) / (2 * width), rtol=1e-5, atol=1e-5)
    curvature = (values[2] - 2 * values[1] + values[0]) / width**2
    np.testing.assert_allclose(second, curvature, rtol=1e-4, atol=1e-3)
