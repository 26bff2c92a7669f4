"""The motion against the paper, closed forms and an independent integrator."""

import math

import fmpy
import numpy as np
import pytest
from reference import PERIOD, UNLOADED, simulate

FREE = {"stop.model": 1, "piercing.thickness": 0.0, "piercing.travel": 0.0}


def test_default_unit_is_on_the_loaded_orbit(unit):
    unit.begin()
    start = unit.state()
    for _ in range(50):
        unit.step(PERIOD)
    np.testing.assert_allclose(unit.state(), start, atol=1e-8)
    assert unit.get("impact.count") == 50
    assert unit.get("pierce.count") == 50
    assert abs(unit.get("impact.velocity") - 8.39868) < 1e-5


def test_unloaded_orbit(unit):
    unit.begin(UNLOADED)
    for _ in range(20):
        unit.step(PERIOD)
    np.testing.assert_allclose(
        unit.state(), [UNLOADED["initial.position"], UNLOADED["initial.velocity"]], atol=1e-10
    )
    assert unit.get("impact.count") == 20
    assert unit.get("pierce.count") == 0
    assert abs(unit.get("impact.velocity") - 6.494627) < 1e-6


def test_fmpy_simulates_it_with_defaults(path):
    result = fmpy.simulate_fmu(path, stop_time=5 * PERIOD, output_interval=PERIOD / 5000)
    assert result["impact.count"][-1] == 5
    assert result["position"].max() == pytest.approx(11.15599, abs=2e-5)


@pytest.mark.parametrize("scene", [
    {"s": 0.0, "v": 0.0}, {}, {"force": 0.7}, {"force": 0.2, "rate": 0.05},
], ids=["unloaded", "loaded", "constant force", "force ramp"])
def test_against_an_independent_integrator(make, scene):
    start, end = (3.0, 11.0), 3 * PERIOD
    state, impacts = simulate(start, end, **scene)
    unit = make()
    values = {"initial.position": start[0], "initial.velocity": start[1]}
    if "s" in scene:
        values |= {"piercing.thickness": 0.0, "piercing.travel": 0.0}
    unit.begin(values)
    unit.set({"force": scene.get("force", 0.0)})
    unit.fmu.setRealInputDerivatives([unit.reference("force")], [1], [scene.get("rate", 0.0)])
    unit.step(end)
    np.testing.assert_allclose(unit.state(), state, atol=1e-9)
    assert unit.get("impact.count") == len(impacts) > 0
    np.testing.assert_allclose(unit.get("impact.time", "impact.velocity"), impacts[-1], atol=1e-9)


def test_linear_oscillator_in_closed_form(unit):
    m, k, b, w, phi, f = 2.0, 3.0, 0.5, 1.7, 0.3, 1.4
    unit.begin({
        **FREE, "mass": m, "stiffness": k, "damping": b, "excitation.amplitude": f,
        "excitation.frequency": w, "excitation.phase": phi,
        "initial.position": 0.2, "initial.velocity": -0.1,
    })
    response = f / complex(k - m * w * w, b * w)
    decay = complex(-b / (2 * m), np.sqrt(k / m - (b / (2 * m)) ** 2))
    steady = lambda t: response * np.exp(1j * (w * t + phi))
    gap = 0.2 - steady(0).real
    drift = -0.1 - (1j * w * steady(0)).real
    own = complex(gap, (gap * decay.real - drift) / decay.imag)
    for size in [1e-4, 0.37, 2.0, 31.0]:
        unit.step(size)
        t = unit.time
        free = own * np.exp(decay * t)
        position = (steady(t) + free).real
        velocity = (1j * w * steady(t) + decay * free).real
        np.testing.assert_allclose(unit.state(), [position, velocity], atol=1e-12)
    assert unit.get("impact.count") == 0
    assert unit.get("contact.force") == 0.0


def test_one_step_or_many(make):
    one, many, odd = (make().begin(UNLOADED) for _ in range(3))
    for unit in (one, many, odd):
        unit.set({"force": 0.01})
    end = 200 * PERIOD
    one.step(end)
    for number in range(200_000):
        many.fmu.doStep(number * (PERIOD / 1000), PERIOD / 1000)
    random = np.random.default_rng(7)
    sizes = random.exponential(1.0, 300)
    for size in sizes * end / sizes.sum():
        odd.step(size)
    names = ["position", "velocity", "acceleration", "contact.force", "impact.time",
             "impact.velocity", "impact.count"]
    np.testing.assert_allclose(many.get(*names), one.get(*names), atol=1e-9)
    np.testing.assert_allclose(odd.get(*names), one.get(*names), atol=1e-9)
    energies = ["energy.mechanical", "energy.supplied", "energy.dissipated"]
    np.testing.assert_allclose(many.get(*energies), one.get(*energies), rtol=1e-9)


@pytest.mark.parametrize("values", [{}, UNLOADED], ids=["loaded", "unloaded"])
def test_energy_closes(make, values):
    unit = make().begin({**values, "initial.velocity": 11.0})
    stored = unit.get("energy.mechanical")
    for _ in range(300):
        unit.step(0.917)
        mechanical, supplied, dissipated = unit.get(
            "energy.mechanical", "energy.supplied", "energy.dissipated"
        )
        assert abs(supplied - dissipated - (mechanical - stored)) < 1e-9 * max(supplied, stored)


def test_force_ramp_is_honoured_however_divided(make):
    one, many = make().begin(), make().begin()
    for unit in (one, many):
        unit.set({"force": 0.3})
        unit.fmu.setRealInputDerivatives([unit.reference("force")], [1], [0.02])
    one.step(40.0)
    for _ in range(1000):
        many.step(0.04)
    np.testing.assert_allclose(many.state(), one.state(), atol=1e-10)
    assert one.get("force") == pytest.approx(0.3 + 0.02 * 40.0)
    again = make().begin()
    for _ in range(1000):  # as importers with an input table do
        again.set({"force": 0.3 + 0.02 * again.time})
        again.fmu.setRealInputDerivatives([again.reference("force")], [1], [0.02])
        again.step(0.04)
    np.testing.assert_allclose(again.state(), one.state(), atol=1e-9)


def test_force_derivatives_of_order_one_to_three(make):
    m, k, b = 2.0, 3.0, 0.5
    derivatives = [0.3, -0.2, 0.15, -0.04]
    values = {
        **FREE, "mass": m, "stiffness": k, "damping": b, "clearance": 1e3,
        "excitation.amplitude": 0.0, "initial.position": 0.2, "initial.velocity": -0.1,
    }

    def push(unit, derivatives):
        unit.set({"force": derivatives[0]})
        reference = unit.reference("force")
        unit.fmu.setRealInputDerivatives([reference] * 3, [1, 2, 3], derivatives[1:])

    # The polynomial q with m q'' + b q' + k q = f by its derivatives at 0, from the highest on.
    answer = [0.0] * 6
    for order in (3, 2, 1, 0):
        inertia = m * answer[order + 2] + b * answer[order + 1]
        answer[order] = (derivatives[order] - inertia) / k
    series = lambda d, t: sum(c * t**n / math.factorial(n) for n, c in enumerate(d))
    root = complex(-b / (2 * m), math.sqrt(k / m - (b / (2 * m)) ** 2))
    gap, drift = 0.2 - answer[0], -0.1 - answer[1]
    own = complex(gap, (gap * root.real - drift) / root.imag)

    one, many = make().begin(values), make().begin(values)
    push(one, derivatives)
    one.step(12.0)
    for _ in range(300):  # as importers with an input table do
        push(many, [series(derivatives[n:], many.time) for n in range(4)])
        many.step(0.04)
    free = own * np.exp(root * 12.0)
    expected = [
        series(answer, 12.0) + free.real,
        series(answer[1:], 12.0) + (root * free).real,
    ]
    np.testing.assert_allclose(one.state(), expected, rtol=1e-12)
    np.testing.assert_allclose(many.state(), expected, rtol=1e-11)
    assert one.get("force") == pytest.approx(series(derivatives, 12.0), rel=1e-14)
    reference = many.reference("force")
    many.refused(lambda: many.fmu.setRealInputDerivatives([reference], [8], [1.0]), "force", "order 8")
    one.set({"force": 0.25})
    one.step(5.0)
    assert one.get("force") == 0.25


def test_output_derivatives(unit):
    unit.begin()
    unit.step(1.0)
    position, velocity = unit.reference("position"), unit.reference("velocity")
    acceleration = unit.reference("acceleration")
    get = unit.fmu.getRealOutputDerivatives
    first = get([position, velocity, position], [1, 1, 2])
    assert first == [unit.get("velocity"), unit.get("acceleration"), unit.get("acceleration")]
    jerk = get([velocity, acceleration], [2, 1])
    assert jerk[0] == jerk[1]
    outputs = ["acceleration", "contact.force", "energy.mechanical", "energy.supplied",
               "energy.dissipated"]
    while unit.get("contact.force") == 0.0:
        unit.step(0.1)
    references = [unit.reference(name) for name in outputs]
    rates = np.array([get(references, [order] * 5) for order in (1, 2)])
    here = unit.get(*outputs)
    unit.step(1e-4)
    middle = unit.get(*outputs)
    unit.step(1e-4)
    there = unit.get(*outputs)
    np.testing.assert_allclose((4 * middle - 3 * here - there) / 2e-4, rates[0], rtol=1e-4, atol=1e-4)
    np.testing.assert_allclose((here - 2 * middle + there) / 1e-8, rates[1], rtol=0.01, atol=0.01)
    unit.refused(lambda: get([position], [3]), "position", "order 3")


@pytest.mark.parametrize("name, no, yes", [("material", False, True), ("material_real", 0.0, 1.0)])
def test_without_material_nothing_is_pierced(unit, name, no, yes):
    unit.begin()
    unit.step(10 * PERIOD)
    unit.set({name: no})
    pierced, impacts = unit.get("pierce.count"), unit.get("impact.count")
    phases = set()
    for _ in range(3000):
        unit.step(PERIOD / 100)
        phases.add(unit.get("phase"))
    assert unit.get("pierce.count") == pierced
    assert unit.get("impact.count") > impacts
    assert phases <= {1, 4, 5, 6, 7}
    unit.set({name: yes})
    unit.step(10 * PERIOD)
    assert unit.get("pierce.count") > pierced


def test_tuning_leaves_the_drive_angle_continuous(unit):
    unit.begin({**FREE, "excitation.phase": 0.4})
    unit.step(3.0)
    before = unit.get("acceleration")
    unit.set({"excitation.frequency": 2.0})
    assert unit.get("acceleration") == pytest.approx(before, abs=1e-12)
    unit.set({"excitation.amplitude": 3.0})
    drive = np.cos(1.15 * 3.0 + 0.4)
    assert unit.get("acceleration") - before == pytest.approx(2.0 * drive, abs=1e-12)
    balance = lambda: unit.get("energy.mechanical") - unit.get("energy.supplied") + unit.get(
        "energy.dissipated"
    )
    stored = balance()
    unit.set({"clearance": 5.0, "stop.stiffness": 9.0})
    unit.step(1.0)
    assert balance() == pytest.approx(stored, abs=1e-9)
