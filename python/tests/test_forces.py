"""Forces in time are followed exactly, as they are stated."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import BPoly, CubicSpline, PPoly

import softstop as ss

A = ss.Machine.unloaded(eta=1.15, clearance=10)
TIMES = np.linspace(0, 20, 41)
VALUES = 30 * np.sin(TIMES)
KINDS = {"lines": (TIMES, VALUES), "steps": (TIMES, VALUES[:-1]), "spline": CubicSpline(TIMES, VALUES)}


def force_at(kind, time):
    """The force as NumPy and SciPy have it."""
    if kind == "lines":
        return np.interp(time, TIMES, VALUES)
    if kind == "steps":
        return VALUES[min(np.searchsorted(TIMES, time, "right") - 1, len(VALUES) - 2)]
    return KINDS[kind](time)


@pytest.mark.parametrize("kind", KINDS)
def test_a_free_mass_moves_as_by_scipy(kind):
    machine = ss.Machine(mass=1, stiffness=1, damping=0.04, clearance=1e3, contact_damping=0.18, drive=ss.Drive(1, 1.15), stop=None)
    motion = ss.simulate(machine, start=(1, 2), periods=5, forces=KINDS[kind])

    def law(time, state, piece):
        x, v = state
        # At its end a step's value is still that of the piece.
        force = VALUES[piece] if kind == "steps" else force_at(kind, time)
        return [v, np.cos(1.15 * time) - 0.04 * v - x + force]

    state = np.array([1.0, 2.0])
    for piece in range(len(TIMES) - 1):
        ends = TIMES[piece], TIMES[piece + 1]
        state = solve_ivp(law, ends, state, args=(piece,), method="DOP853", rtol=1e-12, atol=1e-12).y[:, -1]
        position, velocity = motion.sample(ends[1])
        assert (position, velocity) == pytest.approx(tuple(state), abs=1e-9)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("machine", [A, ss.Machine.loaded(eta=1.2), A.replace({"stop.model": "rigid", "stop.restitution": 0.6})])
def test_energies_balance_and_crossings_lie_where_they_are(machine, kind):
    motion = ss.simulate(machine, start=(0, 14), periods=30, forces=KINDS[kind])
    energies = motion.energies
    assert abs(energies["supplied"] - energies["dissipated"] - energies["stored"]) < 1e-10 * abs(energies["supplied"])
    assert len(motion.impacts) > 3
    np.testing.assert_allclose(motion.position(motion.impacts.time), machine["clearance"], atol=1e-9)


def test_it_does_not_matter_how_a_force_is_written():
    lines = ss.simulate(A, start=(0, 14), periods=6, forces=(TIMES, VALUES))
    pieces = PPoly([np.diff(VALUES) / np.diff(TIMES), VALUES[:-1]], TIMES)
    finer = np.union1d(TIMES, np.linspace(0, 20, 33))
    for forces in (pieces, (finer, np.interp(finer, TIMES, VALUES))):
        other = ss.simulate(A, start=(0, 14), periods=6, forces=forces)
        assert len(other.impacts) == len(lines.impacts)
        assert other.end == pytest.approx(lines.end, abs=1e-10)


def test_there_is_no_force_before_and_after():
    alone = ss.simulate(A, start=(0, 14), periods=20)
    for forces in (([30, 30], [5, 5]), ([1e6, 2e6], [5.0]), ([0, 10], [0])):
        assert ss.simulate(A, start=(0, 14), periods=20, forces=forces).end == pytest.approx(alone.end, abs=1e-11)
    pushed = ss.simulate(A, start=(0, 14), periods=20, forces=([30, 31], [5.0]))
    np.testing.assert_array_equal(pushed.position([10, 29]), alone.position([10, 29]))
    assert pushed.position(31) > alone.position(31)


@pytest.mark.parametrize(("forces", "words"), [
    (([0, 1], [1, 2, 3]), r"forces: shapes \(2,\) and \(1, 3\)"),
    (([1, 0], [1, 2]), "forces: times must be finite, >= 0 and rise"),
    (([-1, 0], [1, 2]), "forces: times must be finite, >= 0 and rise"),
    (([0, 1], [1, np.nan]), "force"),
    ((0, 1), "forces: shapes"),
    ("push", "forces = 'push'"),
    (([0, 1], ["a", "b"]), r"forces\[1\]"),
    (PPoly(np.ones((9, 1)), [0, 1]), "order"),
])
def test_what_is_no_force(forces, words):
    with pytest.raises(ss.MachineError, match=words):
        ss.simulate(A, forces=forces)


def test_many_motions_have_no_forces():
    with pytest.raises(ss.MachineError, match="forces: for one motion"):
        ss.simulate(A, eta=[1.1, 1.2], forces=(TIMES, VALUES))


def test_bernstein_coefficients_are_no_powers():
    forces = BPoly([[0], [0], [30]], [0, 10])
    with pytest.raises(ss.MachineError, match="forces = "):
        ss.simulate(ss.Machine.unloaded(), start=(0, 0), periods=2, forces=forces)
