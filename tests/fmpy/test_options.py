"""What a unit for FMI 3.0 tells of only if `softstop fmu` is asked to."""

import os
import pathlib
import subprocess
import zipfile

import fmpy
import lxml.etree
import pytest
from fmpy.fmi3 import FMU3Slave
from fmpy.validation import validate_fmu
from packages import TOP
from reference import PERIOD

PROGRAM = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", TOP / "target")) / "release" / "softstop"
SCHEMA = pathlib.Path(fmpy.__file__).parent / "schema" / "fmi3" / "fmi3ModelDescription.xsd"


@pytest.fixture(scope="module")
def units(tmp_path_factory):
    """Makes a unit with these options, once."""
    folder = tmp_path_factory.mktemp("units")

    def make(*options):
        file = folder / f"unit{''.join(options)}.fmu"
        if not file.exists():
            command = [PROGRAM, "fmu", "loaded", "--fmi", "3", *options, "--output", file]
            subprocess.run(command, check=True, capture_output=True)
        return file

    return make


def described(unit):
    with zipfile.ZipFile(unit) as archive:
        return lxml.etree.fromstring(archive.read("modelDescription.xml"))


def lines(unit):
    """Each line of the description but the token's."""
    text = lxml.etree.tostring(described(unit)).decode().splitlines()
    return [line for line in text if "instantiationToken" not in line]


@pytest.mark.parametrize("options", [["--impact-clock"], ["--arrays"], ["--impact-clock", "--arrays"]])
def test_checkers_find_nothing(units, options):
    unit = units(*options)
    assert validate_fmu(unit) == []
    lxml.etree.XMLSchema(lxml.etree.parse(SCHEMA)).assertValid(described(unit).getroottree())
    assert described(unit).get("instantiationToken") != described(units()).get("instantiationToken")


@pytest.mark.parametrize("option", ["--impact-clock", "--arrays"])
def test_options_of_fmi_3_are_refused_for_fmi_2(option, tmp_path):
    command = [PROGRAM, "fmu", "loaded", option, "--output", tmp_path / "unit.fmu"]
    run = subprocess.run(command, capture_output=True, text=True)
    assert run.returncode == 2 and f"{option} needs --fmi 3" in run.stderr


def test_a_clock_adds_three_lines_and_changes_no_result(units):
    clock, plain = units("--impact-clock"), units()
    more = [line.strip() for line in lines(clock) if line not in lines(plain)]
    assert len(more) == 3 and more[0].startswith('<Clock name="impact" ') and len(lines(clock)) == len(lines(plain)) + 3
    one, other = (fmpy.simulate_fmu(of, stop_time=50, output_interval=0.5) for of in (clock, plain))
    assert one.tobytes() == other.tobytes()


def test_arrays_stand_for_their_elements(units):
    arrays, plain = (fmpy.read_model_description(units(*options)) for options in (["--arrays"], []))
    elements = {v.name: v for v in plain.modelVariables}
    whole = [v for v in arrays.modelVariables if v.dimensions]
    expected = {v.name.partition("[")[0] for v in plain.modelVariables if v.causality == "parameter" and "[" in v.name}
    assert {array.name for array in whole} == expected and len(expected) >= 4
    assert len(arrays.modelVariables) == len(plain.modelVariables) - 7 * len(expected)
    for array in whole:
        assert array.shape == (8,)
        parts = [elements[f"{array.name}[{number}]"] for number in range(1, 9)]
        assert array.valueReference == parts[0].valueReference and array.description == parts[0].description
        assert array.start.split() == [part.start for part in parts]


def test_a_stop_of_four_slopes_by_arrays(units):
    froms, stiffnesses = [0.0, 0.2, 0.5, 1.0], [7.0, 9.0, 20.0, 50.0]
    values = {"stop.model": 3, "stop.loading.count": 4, "clearance": 8.0}
    numbers = range(1, 5)
    parts = {**{f"stop.loading.from[{k}]": froms[k - 1] for k in numbers},
             **{f"stop.loading.stiffness[{k}]": stiffnesses[k - 1] for k in numbers}}
    rest = [0.0] * 4
    whole = {"stop.loading.from": froms + rest, "stop.loading.stiffness": stiffnesses + rest}
    results = [fmpy.simulate_fmu(units(*options), stop_time=50, output_interval=0.5, start_values={**values, **more})
               for options, more in ((["--arrays"], whole), ([], parts))]
    assert results[0].tobytes() == results[1].tobytes() and results[0]["impact.count"][-1] > 5


@pytest.fixture
def slave(units):
    file = units("--impact-clock")
    told, folder = fmpy.read_model_description(file), fmpy.extract(file)
    slave = FMU3Slave(guid=told.guid, unzipDirectory=folder, modelIdentifier="softstop", instanceName="unit")
    slave.instantiate(eventModeUsed=True, earlyReturnAllowed=True)
    slave.references = {variable.name: variable.valueReference for variable in told.modelVariables}
    slave.enterInitializationMode()
    slave.exitInitializationMode()
    yield slave
    slave.terminate()
    slave.freeInstance()


def test_the_clock_ticks_at_each_impact(slave):
    clock, count, time = (slave.references[name] for name in ("impact", "impact.count", "impact.time"))
    seen, point, end = [], 0.0, 10 * PERIOD
    slave.updateDiscreteStates()
    slave.enterStepMode()
    while point < end:
        event, _, _, point = slave.doStep(point, end - point)
        assert slave.getClock([clock]) == [False]
        if not event:
            continue
        slave.enterEventMode()
        (ticks,) = slave.getClock([clock])
        slave.updateDiscreteStates()
        assert slave.getClock([clock]) == [False]
        slave.enterStepMode()
        if ticks:
            seen.append(point)
            assert slave.getFloat64([time]) == [point]
        assert slave.getInt32([count]) == [len(seen)]
    assert len(seen) >= 10
