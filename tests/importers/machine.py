"""Facts about the machine that every importer has to reproduce."""

import pathlib
import sys

import numpy as np

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "fmpy"))

from packages import TOP, UNITS, package, package_3, package_exchange  # noqa: E402, F401
from reference import PERIOD, UNLOADED, simulate  # noqa: E402

LOADED = {"initial.position": 4.818747634046, "initial.velocity": 11.908301592746}
"""Start of the loaded machine's orbit, the unit's own default."""

IMPACT_VELOCITY = {"loaded": 8.39868, "unloaded": 6.49463}
"""Velocity of the impacts on the two orbits, in m/s and to five decimals."""

OBSERVED = ["position", "velocity", "impact.velocity", "impact.count", "pierce.count"]
"""Outputs that `check_orbit` wants."""

PUSHED = {"initial.position": 3.0, "initial.velocity": 11.0}
"""Start of the run with a steady force, three drive periods long."""
PUSH = 0.2


def orbit_values(name):
    """Parameters to set for this orbit: none are needed for the loaded machine."""
    return UNLOADED if name == "unloaded" else {}


def check_orbit(name, periods, late, values):
    """Checks outputs after whole drive periods; `late` is what the clock was off by, in s."""
    start = UNLOADED if name == "unloaded" else LOADED
    position, velocity = start["initial.position"], start["initial.velocity"]
    acceleration = 1.0 - 0.04 * velocity - position
    expected = [
        position + velocity * late + acceleration * late**2 / 2,
        velocity + acceleration * late,
    ]
    np.testing.assert_allclose(values[:2], expected, atol=1e-9, rtol=0)
    assert abs(values[2] - IMPACT_VELOCITY[name]) < 1e-5
    assert values[3] == periods
    assert values[4] == (periods if name == "loaded" else 0)


def check_pushed(end, values):
    """Checks position, velocity and number of impacts of the run with a steady force."""
    start = (PUSHED["initial.position"], PUSHED["initial.velocity"])
    state, impacts = simulate(start, end, force=PUSH)
    np.testing.assert_allclose(values[:2], state, atol=1e-9, rtol=0)
    assert values[2] == len(impacts) > 0
