"""FMI++ by the Austrian Institute of Technology, built from source by build_fmipp.py.

It sets all parameters before the experiment is set up.
"""

import sys
import zipfile

import pytest
from build_fmipp import LIBRARY, SOURCE
from machine import OBSERVED, PERIOD, PUSH, PUSHED, check_orbit, check_pushed, orbit_values

if not LIBRARY.exists():
    pytest.skip(
        "FMI++ is not built: run python tests/importers/build_fmipp.py", allow_module_level=True
    )

sys.path.append(str(SOURCE))

import fmipp  # noqa: E402


@pytest.fixture(scope="module")
def place(path, tmp_path_factory):
    folder = tmp_path_factory.mktemp("fmipp")
    with zipfile.ZipFile(path) as archive:
        archive.extractall(folder)
    return f"file://{folder}"


def start(place, values, stop=None, identifier="softstop"):
    unit = fmipp.FMUCoSimulationV2(place, identifier, False, 1e-9)
    assert unit.instantiate("unit", 0.0, False, False) == 0
    for name, value in values.items():
        assert unit.setRealValue(name, value) == 0
    assert unit.initialize(0.0, stop is not None, stop or 0.0) == 0
    return unit


def get(unit, names):
    read = {True: unit.getIntegerValue, False: unit.getRealValue}
    return [read[name.endswith(".count")](name) for name in names]


@pytest.mark.parametrize("per_period", [0.1, 1, 100, 1000])
def test_orbit(place, orbit, per_period):
    unit = start(place, orbit_values(orbit), 10 * PERIOD)
    for number in range(round(10 * per_period)):
        assert unit.doStep(number * PERIOD / per_period, PERIOD / per_period, True) == 0
    check_orbit(orbit, 10, 0.0, get(unit, OBSERVED))


@pytest.mark.parametrize("steps", [1, 30])
def test_force(place, steps):
    unit = start(place, PUSHED)
    assert unit.setRealValue("force", PUSH) == 0
    for number in range(steps):
        assert unit.doStep(number * 3 * PERIOD / steps, 3 * PERIOD / steps, True) == 0
    check_pushed(3 * PERIOD, get(unit, ["position", "velocity", "impact.count"]))


def test_material_and_capabilities(place):
    unit = start(place, {})
    assert unit.canInterpolateInputs() and unit.canHandleVariableCommunicationStepSize()
    assert unit.maxOutputDerivativeOrder() == 2
    assert unit.setBooleanValue("material", False) == 0
    assert unit.doStep(0.0, 10 * PERIOD, True) == 0
    assert unit.getIntegerValue("pierce.count") == 0 < unit.getIntegerValue("impact.count")


def test_refused_value(place):
    unit = start(place, {})
    assert unit.setRealValue("mass", 2.0) == 3
    assert unit.doStep(0.0, 10 * PERIOD, True) == 0
    check_orbit("loaded", 10, 0.0, get(unit, OBSERVED))
