"""Motions, one and many."""

import math

import numpy as np
import pytest

import softstop as ss

A = ss.Machine.unloaded(eta=1.15, clearance=10)


def test_point_a_of_the_paper():
    """Peterka (2003), point A: 6.494627429363 (docs/results.md)."""
    motion = ss.simulate(A, start=(0, 14), periods=400)
    assert motion.impacts["velocity"][-1] == pytest.approx(6.494627429363037, abs=1e-12)
    energies = motion.energies
    defect = energies["supplied"] - energies["dissipated"] - energies["stored"]
    assert abs(defect) < 1e-11 * energies["supplied"]


def test_samples_lie_on_the_motion():
    motion = ss.simulate(A, start=(0, 14), periods=3)
    times = np.linspace(0, motion.duration, 60).reshape(3, 20)
    position, velocity = motion.sample(times)
    assert position.shape == (3, 20)
    assert (position[0, 0], velocity[0, 0]) == (0, 14)
    assert (position[-1, -1], velocity[-1, -1]) == pytest.approx(motion.end, abs=1e-12)
    step = 1e-6
    inside = times.ravel()[5:-5]
    slope = (motion.position(inside + step) - motion.position(inside - step)) / (2 * step)
    np.testing.assert_allclose(slope, motion.velocity(inside), atol=1e-5)
    with pytest.raises(ss.SoftstopError, match="must be in"):
        motion.position(motion.duration + 1)


def test_a_batch_is_its_motions_one_by_one():
    eta = np.linspace(0.95, 1.4, 40)
    batch = ss.simulate(A, eta=eta, start=(0, 14), periods=50, keep=50)
    assert batch.errors == {}
    for row, value in enumerate(eta):
        alone = ss.simulate(A, eta=value, start=(0, 14), periods=50)
        rows = slice(batch.offsets[row], batch.offsets[row + 1])
        assert batch.counts[row] == len(alone.impacts) == rows.stop - rows.start
        np.testing.assert_allclose(batch.impacts["time"][rows], alone.impacts["time"], rtol=1e-9)
        if not math.isclose(value, 0.98, abs_tol=0.04):  # chaos there
            np.testing.assert_allclose([batch.position[row], batch.velocity[row]], alone.end, atol=1e-6)


def test_arrays_broadcast():
    batch = ss.simulate(A, eta=np.linspace(1.0, 1.3, 4)[:, None], clearance=[9.0, 10.0, 11.0], start=(0, 14), periods=100)
    assert batch.position.shape == batch.counts.shape == (4, 3)
    alone = ss.simulate(A, eta=1.1, clearance=11.0, start=(0, 14), periods=100)
    assert batch.counts[1, 2] == len(alone.impacts)
    assert ss.simulate(A, start=[0, 14], periods=3).end == ss.simulate(A, start=np.array([0, 14]), periods=3).end
    starts = ss.simulate(A, start=(np.zeros(5), np.linspace(0, 14, 5)), periods=10)
    assert starts.velocity.shape == (5,)
    assert len(ss.simulate(A, start=(np.zeros(0), np.zeros(0))).counts) == 0


def test_only_the_last_periods_are_kept():
    eta = np.linspace(1.05, 1.3, 7)
    all_of_them = ss.simulate(A, eta=eta, start=(0, 14), periods=60, keep=60)
    last = ss.simulate(A, eta=eta, start=(0, 14), periods=60, keep=4)
    for row in range(len(eta)):
        times = all_of_them.impacts["time"][all_of_them.offsets[row]:all_of_them.offsets[row + 1]]
        kept = last.impacts["time"][last.offsets[row]:last.offsets[row + 1]]
        np.testing.assert_array_equal(kept, times[times >= 56 * 2 * np.pi / eta[row]])


def test_a_machine_by_keywords():
    press = ss.Machine(
        mass=120, stiffness=2.4e6, damping=680, clearance=0.02, contact_damping=3060,
        drive=ss.Drive(9e3, frequency_hz=24), stop=ss.Preloaded(1.7e7, preload_deflection=0.02), name="press",
    )
    assert press["excitation.frequency_hz"] == 24.0
    assert press["frequency"] == press["excitation.frequency"] == pytest.approx(2 * np.pi * 24)
    assert dict(press) == press.parameters
    assert "rho" not in press
    assert A["eta"] == A["frequency"] == 1.15
    with pytest.raises(KeyError, match="did you mean clearance"):
        A["clearence"]
    assert press.replace({"stop.stiffness": 2e7})["stop.stiffness"] == 2e7
    assert press.replace(stop__stiffness=2e7) == press.replace({"stop.stiffness": 2e7})
    assert press["stop.stiffness"] == 1.7e7
    assert "24" in press._repr_html_()
    assert ss.Machine.from_dict({"ratios": {
        "damping": 0.02, "clearance": 10.0, "contact.damping": 0.09, "excitation": {"frequency": 1.15},
        "stop": {"model": "preloaded", "stiffness": 7, "preload": 70},
    }}).parameters == A.parameters


@pytest.mark.parametrize("stop", [
    ss.KelvinVoigt(7.0), ss.Hertz(20.0, 1.5, 0.1), ss.Rigid(0.6), None, ss.PiecewiseLinear([(0, 3), (0.5, 9)], [(0, 2)]),
])
def test_every_stop_by_keywords(stop):
    machine = ss.Machine(mass=1, stiffness=1, damping=0.04, clearance=2, contact_damping=0.18, drive=ss.Drive(1, 1.15), stop=stop)
    other = machine.replace(stop=ss.Preloaded(7, 70), drive=ss.Drive(2, frequency_hz=3), start=[0, 5], strip=ss.Strip(1, 1, 0.1, 0.1))
    assert other.replace(stop=stop, drive=ss.Drive(1, 1.15), strip=None, start=None) == machine
    assert ss.Machine.unloaded(stop=stop, clearance=3)["clearance"] == 3
    assert ss.Machine.from_toml(machine.to_toml()) == machine
    assert ss.simulate(machine, start=(0, 5), periods=5).duration == pytest.approx(5 * 2 * np.pi / 1.15)
