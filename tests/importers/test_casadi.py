"""Model exchange in CasADi, by both standards: Jacobians of the state derivatives and of the outputs."""

import zipfile

import numpy as np
import pytest
from machine import package_3, package_exchange

casadi = pytest.importorskip("casadi", reason="CasADi is not installed")

HERTZ = {"stop.model": 4, "stop.exponent": 1.5, "stop.dissipation": 0.05}
RIGID = {"stop.model": 6, "piercing.thickness": 0.0, "piercing.travel": 0.0}
PLACES = {
    "free": (3.0, 2.0, {}),
    "pierce": (10.2, 3.0, {}),
    "cut": (10.6, 3.0, {}),
    "stop": (11.1, 2.0, {}),
    "hertz": (11.1, 2.0, HERTZ),
    "before a rigid stop": (9.9, 4.0, RIGID),
}
"""A state of each law, and the parameters of the machine."""
INPUTS = [0.1, 0.2, 0.0, 1.0]


@pytest.fixture(params=PLACES)
def place(request):
    return PLACES[request.param]


@pytest.fixture(params=[2, 3], ids=["FMI 2.0", "FMI 3.0"])
def folder(request, path, tmp_path, place):
    if request.param == 3 and "stop.model" in place[2]:
        pytest.skip("CasADi 3.8.2 sets enumerations of FMI 3.0 as Int32")
    file = package_exchange(path) if request.param == 2 else package_3(path, "softstop")
    with zipfile.ZipFile(file) as archive:
        archive.extractall(tmp_path)
    return str(tmp_path)


def function(folder, place, outputs):
    """State derivatives and outputs of a machine that begins in this state, and so under its law; with the arguments."""
    position, velocity, parameters = place
    unit = casadi.DaeBuilder("press", folder)
    start = {"initial.position": position, "initial.velocity": velocity, **parameters}
    for name, value in start.items():
        unit.set(name, value)
    unit.set_y(outputs)
    return unit.create("f", ["x", "u"], ["ode", "y"]), ([position, velocity], INPUTS)


def test_jacobian_is_that_of_differences(folder, place):
    f, at = function(folder, place, ["contact.force", "frame.force", "drive.power"])

    def values(x, u):
        return np.concatenate([np.array(of).ravel() for of in f(x, u)])

    def column(argument, k, width=1e-5):
        moved = [np.array(of, dtype=float) for of in at]
        moved[argument][k] += width
        high = values(*moved)
        moved[argument][k] -= 2 * width
        return (high - values(*moved)) / (2 * width)

    for argument, name in enumerate("xu"):
        blocks = f.factory("J", ["x", "u"], [f"jac:ode:{name}", f"jac:y:{name}"])(*at)
        exact = np.concatenate([np.array(of.full()) for of in blocks])
        expected = np.array([column(argument, k) for k in range(exact.shape[1])]).T
        np.testing.assert_allclose(exact, expected, atol=1e-6, rtol=1e-6)


def test_reverse_mode_is_forward_mode_transposed(folder, place):
    # Others are differences, with nine digits.
    f, at = function(folder, place, ["contact.force", "energy.mechanical"])
    forward, reverse = f.forward(1), f.reverse(1)

    def along(k):
        return np.concatenate([np.array(of).ravel() for of in forward(*at, 0, 0, *np.split(np.eye(6)[k], [2]))])

    def gradient(k):
        return np.concatenate([np.array(of).ravel() for of in reverse(*at, 0, 0, *np.split(np.eye(4)[k], [2]))])

    jacobian = np.array([along(k) for k in range(6)]).T
    np.testing.assert_allclose(np.array([gradient(k) for k in range(4)]), jacobian, atol=1e-13, rtol=1e-13)
