"""Every stop against an independent integrator and closed forms."""

import numpy as np
import pytest
from reference import PERIOD
from stops import Chain, Hertz, Rigid, Spring, simulate

START = (0.5, 4.0)
COMMON = {
    "clearance": 2.0, "piercing.thickness": 0.0, "piercing.travel": 0.0, "rigid.present": False,
    "initial.position": START[0], "initial.velocity": START[1],
}
LOADING = [(0.0, 5.0), (0.2, 12.0), (0.5, 40.0)]
UNLOADING = [(0.0, 2.0), (0.3, 10.0)]


def slopes(way, values):
    count = {f"stop.{way}.count": len(values)}
    starts = {f"stop.{way}.from[{n}]": start for n, (start, _) in enumerate(values, 1)}
    return count | starts | {f"stop.{way}.stiffness[{n}]": k for n, (_, k) in enumerate(values, 1)}


PIECEWISE = {"stop.model": 3} | slopes("loading", LOADING)
TWO_WAYS = PIECEWISE | slopes("unloading", UNLOADING)
CASES = {
    "kelvinVoigt": ({"stop.model": 2}, Spring(7.0), {}),
    "kelvinVoigt, zero force": (
        {"stop.model": 2, "stop.release": 2, "contact.damping": 1.5},
        Spring(7.0, zero_force=True), {"b": 1.5},
    ),
    "kelvinVoigt before a rigid stop": (
        {"stop.model": 2, "rigid.present": True, "rigid.travel": 0.3, "stop.restitution": 0.7},
        Spring(7.0), {"travel": 0.3, "restitution": 0.7},
    ),
    "piecewiseLinear": (PIECEWISE, Chain(LOADING), {}),
    "piecewiseLinear, two ways": (TWO_WAYS, Chain(LOADING, UNLOADING), {}),
    "piecewiseLinear before a rigid stop": (
        PIECEWISE | {"rigid.present": True, "rigid.travel": 0.4},
        Chain(LOADING), {"travel": 0.4},
    ),
    "hertz": ({"stop.model": 4, "stop.stiffness": 30.0}, Hertz(30.0), {}),
    "hertz, exponent 2.5": (
        {"stop.model": 4, "stop.stiffness": 30.0, "stop.exponent": 2.5}, Hertz(30.0, 2.5), {},
    ),
    "hertz, dissipation": (
        {"stop.model": 4, "stop.stiffness": 30.0, "stop.dissipation": 0.2},
        Hertz(30.0, dissipation=0.2), {},
    ),
    "hertz before a rigid stop": (
        {"stop.model": 4, "stop.stiffness": 30.0, "rigid.present": True, "rigid.travel": 0.3},
        Hertz(30.0), {"travel": 0.3},
    ),
    "preloaded before a rigid stop": (
        {"stop.preload": 1.5, "rigid.present": True, "rigid.travel": 0.3},
        Spring(7.0, preload=1.5), {"travel": 0.3},
    ),
    "rigid": ({"stop.model": 6}, Rigid(), {"travel": 0.0}),
    "rigid, restitution 0.9": (
        {"stop.model": 6, "stop.restitution": 0.9}, Rigid(), {"travel": 0.0, "restitution": 0.9},
    ),
}
ENERGIES = ["energy.mechanical", "energy.supplied", "energy.dissipated"]
FREE, STOP, RESTING, CHATTER = 1, 5, 7, 9


@pytest.fixture(params=CASES.values(), ids=CASES.keys())
def case(request):
    values, stop, law = request.param
    return COMMON | values, stop, law


def test_against_an_independent_integrator(unit, case):
    values, stop, law = case
    end = 3 * PERIOD
    state, impacts = simulate(stop, START, end, **law)
    unit.begin(values)
    unit.step(end)
    np.testing.assert_allclose(unit.state(), state, atol=1e-9)
    assert unit.get("impact.count") == len(impacts) > 2
    np.testing.assert_allclose(unit.get("impact.time", "impact.velocity"), impacts[-1], atol=1e-9)


def test_one_step_or_a_thousand(make, case):
    values, _, _ = case
    one, many = make().begin(values), make().begin(values)
    end = 20 * PERIOD
    one.step(end)
    for number in range(1000):
        many.fmu.doStep(number * end / 1000, end / 1000)
    names = ["position", "velocity", "acceleration", "contact.force", "impact.time",
             "impact.velocity", "impact.count", "phase"]
    np.testing.assert_allclose(many.get(*names), one.get(*names), atol=1e-9)
    np.testing.assert_allclose(many.get(*ENERGIES), one.get(*ENERGIES), rtol=1e-9)


def test_energy_closes(unit, case):
    values, _, _ = case
    unit.begin(values)
    stored = unit.get("energy.mechanical")
    for _ in range(600):
        unit.step(0.0917)
        mechanical, supplied, dissipated = unit.get(*ENERGIES)
        assert abs(supplied - dissipated - (mechanical - stored)) < 1e-9 * max(supplied, stored)


def test_forces_balance(unit, case):
    values, _, _ = case
    unit.begin(values)
    for _ in range(300):
        unit.step(0.0917)
        x, v, a, contact = unit.get("position", "velocity", "acceleration", "contact.force")
        drive = np.cos(1.15 * unit.time)
        assert a + 0.04 * v + x + contact == pytest.approx(drive, abs=1e-9)


def test_snapshot_in_contact(make, case):
    values, _, _ = case
    one, other = make().begin(values), make()
    rigid = values.get("stop.model") == 6
    while rigid and one.get("impact.count") < 3 or not rigid and one.get("phase") != STOP:
        one.step(0.01)
    continues_bit_by_bit(one, other)


def continues_bit_by_bit(one, other):
    """Goes on from a snapshot three times: as it is, taken back, and in another instance."""
    time, state = one.time, one.fmu.getFMUstate()
    runs = []
    for unit in (one, one, other):
        unit.fmu.setFMUstate(state)
        unit.time = time
        steps = []
        for _ in range(40):
            unit.step(0.0731)
            steps.append(unit.get("position", "velocity", "phase", "impact.count", *ENERGIES))
        runs.append(np.array(steps))
    one.fmu.freeFMUstate(state)
    assert (runs[0] == runs[1]).all()
    assert (runs[0] == runs[2]).all()


@pytest.mark.parametrize("model, law", [
    (2, lambda d: (9.0 * d, 4.5 * d**2)),
    (4, lambda d: (9.0 * d**1.5, 3.6 * d**2.5)),
    (5, lambda d: (2.0 + 9.0 * d, 2.0 * d + 4.5 * d**2)),
], ids=["kelvinVoigt", "hertz", "preloaded"])
def test_force_and_energy_at_a_deflection(unit, model, law):
    unit.begin(COMMON | {
        "stop.model": model, "stop.stiffness": 9.0, "stop.preload": 2.0,
        "initial.position": 2.25, "initial.velocity": 0.5,
    })
    force, energy = law(0.25)
    assert unit.get("phase") == STOP
    assert unit.get("contact.force") == pytest.approx(force + 0.14 * 0.5, rel=1e-14)
    stored = 0.5 * 2.25**2 + 0.5 * 0.5**2 + energy
    assert unit.get("energy.mechanical") == pytest.approx(stored, rel=1e-14)


def test_stiffness_is_tunable_and_counts_as_supplied(make):
    for model in (2, 4, 5):
        unit = make().begin(COMMON | {"stop.model": model})
        while unit.get("phase") != STOP:
            unit.step(0.01)
        before, force = unit.get(*ENERGIES), unit.get("contact.force")
        unit.set({"stop.stiffness": 20.0})
        after = unit.get(*ENERGIES)
        assert unit.get("contact.force") > force
        assert after[0] > before[0]
        assert after[1] - before[1] == pytest.approx(after[0] - before[0], rel=1e-12)
        unit.step(5.0)


def test_contact_never_pulls_with_zero_force(make):
    lowest, phases = {}, {}
    for release in (1, 2):
        values = COMMON | {"stop.model": 2, "stop.release": release, "contact.damping": 1.5}
        unit = make().begin(values)
        forces = []
        phases[release] = set()
        for _ in range(2000):
            unit.step(0.005)
            forces.append(unit.get("contact.force"))
            phases[release].add(unit.get("phase"))
        lowest[release] = min(forces)
    assert lowest[1] < -0.1
    assert lowest[2] > -1e-12
    assert phases == {1: {FREE, STOP}, 2: {FREE, STOP, 8}}


BALL = COMMON | {
    "stop.model": 6, "stiffness": 0.0, "damping": 0.0, "excitation.amplitude": 0.0,
    "initial.position": 1.0, "initial.velocity": 0.0,
}
"""A ball thrown at the stop by a constant force, with the mass and the way 1."""


def ball_at_rest(push, restitution):
    """Time of the first impact, its velocity, and the time of rest."""
    first = np.sqrt(2.0 / push)
    speed = push * first
    return first, speed, first + 2.0 * restitution * speed / (push * (1.0 - restitution))


@pytest.mark.parametrize("restitution", [0.0, 0.3, 0.6, 0.95])
def test_bouncing_ball_in_closed_form(unit, restitution):
    push = 3.0
    first, speed, rest = ball_at_rest(push, restitution)
    unit.set({"force": push})
    unit.begin(BALL | {"stop.restitution": restitution})
    at, velocity, count = first, speed, 1
    while count < 12 and restitution > 0.0:
        duration = 2.0 * restitution * velocity / push
        unit.step(at + 0.25 * duration - unit.time)
        since = unit.time - at
        leaves = restitution * velocity
        expected = [2.0 - leaves * since + 0.5 * push * since**2, push * since - leaves]
        np.testing.assert_allclose(unit.state(), expected, atol=1e-12)
        np.testing.assert_allclose(
            unit.get("impact.time", "impact.velocity"), [at, velocity], atol=1e-12
        )
        assert unit.get("impact.count") == count
        at, velocity, count = at + duration, leaves, count + 1
    unit.step(rest + 1e-9 - unit.time)
    assert unit.get("phase") == RESTING
    assert list(unit.get("position", "velocity", "acceleration")) == [2.0, 0.0, 0.0]
    assert unit.get("contact.force") == push
    np.testing.assert_allclose(unit.get(*ENERGIES), [0.0, push, push], atol=1e-12)
    counted = unit.get("impact.count")
    unit.step(10.0)
    assert (unit.get("phase"), unit.get("impact.count")) == (RESTING, counted)


def chattering(unit):
    """Brings a ball into the last bounces before its rest."""
    _, _, rest = ball_at_rest(3.0, 0.6)
    unit.set({"force": 3.0})
    unit.begin(BALL)
    unit.step(rest - 2e-8)
    assert unit.get("phase") == CHATTER
    return unit


def test_chatter_shows_means(make):
    unit = chattering(make())
    assert unit.get("acceleration") == 0.0
    assert unit.get("contact.force") == 3.0
    assert 2.0 - 1e-15 < unit.get("position") <= 2.0
    assert abs(unit.get("velocity")) < 1e-7
    unit.step(4e-8)
    assert unit.get("phase") == RESTING


def test_snapshot_in_chatter_and_at_rest(make):
    unit = chattering(make())
    continues_bit_by_bit(unit, make())
    resting = chattering(make())
    resting.step(1.0)
    assert resting.get("phase") == RESTING
    continues_bit_by_bit(resting, make())


@pytest.mark.parametrize("change", [{"force": -1.0}, {"clearance": 2.5}, {"stop.preload": 80.0}])
def test_energy_closes_when_chatter_is_disturbed(make, change):
    unit = chattering(make())
    unit.set(change)
    unit.step(0.5)
    mechanical, supplied, dissipated = unit.get(*ENERGIES)
    assert abs(supplied - dissipated - mechanical) < 1e-9 * supplied


def test_a_resting_mass_leaves_when_the_force_turns(unit):
    _, _, rest = ball_at_rest(3.0, 0.6)
    unit.set({"force": 3.0})
    unit.begin(BALL)
    unit.step(rest + 1.0)
    unit.set({"force": 3.0})
    unit.fmu.setRealInputDerivatives([unit.reference("force")], [1], [-2.0])
    start = unit.time
    unit.step(1.5 + 0.8)
    lifted = unit.time - start - 1.5
    np.testing.assert_allclose(
        unit.state(), [2.0 - lifted**3 / 3.0, -(lifted**2)], atol=1e-12
    )
    assert unit.get("phase") == FREE


def test_a_rigid_stop_holds_behind_a_strip(unit):
    unit.begin({"stop.model": 6})
    for _ in range(3000):
        unit.step(0.01)
        assert unit.get("position") <= 10.9
    assert unit.get("impact.count") > 0
    assert unit.get("pierce.count") > 0
    mechanical, supplied, dissipated = unit.get(*ENERGIES)
    assert dissipated > 0.0


@pytest.mark.parametrize("model", [1, 6])
def test_rigid_parameters_are_ignored(make, model):
    one = make().begin(COMMON | {"stop.model": model, "rigid.present": True, "rigid.travel": 0.0})
    other = make().begin(COMMON | {"stop.model": model})
    one.step(20.0)
    other.step(20.0)
    assert (one.state() == other.state()).all()
