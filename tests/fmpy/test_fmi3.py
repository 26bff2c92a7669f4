"""The units for FMI 3.0: description, library and simulation in FMPy."""

import pathlib
import re
import zipfile

import fmpy
import lxml.etree
import numpy as np
import pytest
from fmpy.util import read_csv
from fmpy.validation import validate_fmu
from packages import TOP, UNITS, package, package_3, package_exchange
from reference import PERIOD, UNLOADED

FMPY = pathlib.Path(fmpy.__file__).parent
NAMES = ["position", "velocity", "acceleration", "contact.force", "impact.time", "impact.velocity",
         "impact.count", "pierce.count", "phase", "energy.mechanical", "energy.supplied", "energy.dissipated"]
HANDLINGS = [(events, early) for events in (False, True) for early in (False, True)]


@pytest.fixture(params=UNITS)
def each_3(request, path):
    return package_3(path, request.param)


@pytest.fixture
def path_3(path):
    return package_3(path, "softstop")


def test_validation_finds_nothing(each_3):
    assert validate_fmu(each_3) == []


@pytest.mark.parametrize("file, schema", [
    ("modelDescription.xml", "fmi3ModelDescription.xsd"),
    ("terminalsAndIcons/terminalsAndIcons.xml", "fmi3TerminalsAndIcons.xsd"),
])
def test_schema(each_3, file, schema):
    judge = lxml.etree.XMLSchema(lxml.etree.parse(str(FMPY / "schema" / "fmi3" / schema)))
    with zipfile.ZipFile(each_3) as archive:
        judge.assertValid(lxml.etree.fromstring(archive.read(file)).getroottree())


def members(package):
    """The member of a terminal that a variable is, by the variable's name."""
    with zipfile.ZipFile(package) as archive:
        root = lxml.etree.fromstring(archive.read("terminalsAndIcons/terminalsAndIcons.xml"))
    return {member.get("variableName"): (terminal.get("name"), member.get("memberName"))
            for terminal in root.iter("Terminal") for member in terminal.iter("TerminalMemberVariable")}


def test_terminals_connect_the_units_as_the_machine_does(path):
    units = {"press": "softstop", "drive": "drive", "feeder": "feeder"}
    terminals = {name: members(package_3(path, unit)) for name, unit in units.items()}
    for name, unit in units.items():
        variables = fmpy.read_model_description(package_3(path, unit)).modelVariables
        assert set(terminals[name]) <= {v.name for v in variables}
    structure = lxml.etree.parse(TOP / "xtask" / "assets" / "SystemStructure.ssd")
    connections = list(structure.iter("{*}Connection"))
    assert len(connections) == 5
    for one in connections:
        start, end = (terminals[one.get(side + "Element")][one.get(side + "Connector")] for side in ("start", "end"))
        assert start == end


def test_reference_results_inside(each_3, tmp_path):
    folder = tmp_path / "extra" / "org.fmi-standard.fmi-ls-ref"
    fmpy.extract(each_3, unzipdir=tmp_path)
    manifest = lxml.etree.parse(folder / "fmi-ls-manifest.xml").getroot()
    assert "org.fmi-standard.fmi-ls-ref" in manifest.attrib.values()
    sources = {file.get("role"): folder / file.get("source") for file in manifest.iter("Related")}
    experiment = lxml.etree.parse(sources["experiment/smoke-test"]).find("Experiment")
    times = {name: float(value) for name, value in experiment.find("TransientSimulation").attrib.items()}
    assert folder / experiment.find("References").get("source") == sources["result"]
    expected = read_csv(sources["result"])
    rows = fmpy.simulate_fmu(each_3, start_time=times["startTime"], stop_time=times["stopTime"],
                             output_interval=times["stepSize"], use_event_mode=False, early_return_allowed=False)
    assert set(expected.dtype.names) == set(rows.dtype.names)
    assert len(rows) == len(expected) == 101
    for name in rows.dtype.names:
        np.testing.assert_allclose(rows[name].astype(float), expected[name], rtol=1e-9, atol=1e-9)


TYPES = {"Real": "Float64", "Integer": "Int32", "Boolean": "Boolean", "Enumeration": "Enumeration"}


@pytest.mark.parametrize("unit", UNITS)
def test_variables_are_those_of_the_unit_for_fmi_2(path, unit):
    two = fmpy.read_model_description(package_exchange(path) if unit == "softstop" else package(path, unit))
    three = fmpy.read_model_description(package_3(path, unit))
    plain = fmpy.read_model_description(package(path, unit))
    assert (plain.guid, plain.modelName, plain.description) == (three.guid, three.modelName, three.description)
    time, *variables = three.modelVariables
    assert (time.name, time.causality, time.unit) == ("time", "independent", "s")

    def fields(variable, kind):
        declared = variable.declaredType and variable.declaredType.name
        return (variable.name, variable.valueReference, variable.causality, variable.variability, kind,
                variable.start, variable.min, variable.max, variable.nominal, variable.unit,
                variable.displayUnit, declared, variable.description)

    for before, after in zip(two.modelVariables, variables, strict=True):
        assert fields(before, TYPES[before.type]) == fields(after, after.type)
    for kind in ("outputs", "derivatives", "initialUnknowns"):
        listed = [[(u.variable.name, [d.name for d in u.dependencies]) for u in getattr(of, kind)]
                  for of in (two, three)]
        assert listed[0] == listed[1]


C_TYPES = {
    "fmi3Status": "c_int", "fmi3Instance": "*mut c_void", "fmi3InstanceEnvironment": "*mut c_void",
    "fmi3FMUState": "*mut c_void", "fmi3ValueReference": "c_uint", "fmi3Boolean": "u8", "fmi3Clock": "u8",
    "fmi3Byte": "u8", "fmi3Char": "c_char", "char": "c_char", "fmi3String": "*const c_char",
    "fmi3Binary": "*const u8", "size_t": "usize", "fmi3Float32": "f32", "fmi3Float64": "f64",
    "fmi3Int8": "i8", "fmi3UInt8": "u8", "fmi3Int16": "i16", "fmi3UInt16": "u16", "fmi3Int32": "i32",
    "fmi3UInt32": "u32", "fmi3Int64": "i64", "fmi3UInt64": "u64", "fmi3DependencyKind": "c_int",
    "fmi3IntervalQualifier": "c_int", "void": "()", "fmi3LogMessageCallback": "LogMessageCallback",
    "fmi3IntermediateUpdateCallback": "IntermediateUpdateCallback",
    "fmi3ClockUpdateCallback": "ClockUpdateCallback", "fmi3LockPreemptionCallback": "PreemptionCallback",
    "fmi3UnlockPreemptionCallback": "PreemptionCallback",
}


def rust_type(text):
    """A C declaration, with the argument's name, as its type in Rust."""
    text = text.strip()
    pointer = "[]" in text or "*" in text
    words = re.findall(r"\w+", text)
    kind = next(C_TYPES[word] for word in words if word in C_TYPES)
    if not pointer:
        return kind
    return f"*{'const' if 'const' in words else 'mut'} {kind}"


def standard_functions():
    """The standard's own header: result and argument types of each function."""
    header = (FMPY / "c-code" / "fmi3FunctionTypes.h").read_text()
    header = re.sub(r"/\*.*?\*/", "", header, flags=re.S)
    found = re.findall(r"typedef\s+([\w\s*]+?)\s+(fmi3\w+)TYPE\s*\(([^;]*)\);", header)
    split = {name: (rust_type(result), [rust_type(one) for one in arguments.split(",") if one.strip() != "void"])
             for result, name, arguments in found}
    assert len(split) == 75
    return split


def library_functions():
    """The functions as the rows of fmu/tests/abi.rs have them, to which the compiler holds those of the library."""
    text = (TOP / "fmu" / "tests" / "abi.rs").read_text()
    rows = re.search(r"types_of_fmi_3\(\) \{\s*let typed = functions! \{(.*?)\n    \};", text, re.S)[1]
    aliases = dict(re.findall(r"^type (\w+) = ([^;]+);", text, re.M))
    rows = re.sub(r"\w+", lambda word: aliases.get(word[0], word[0]), rows)
    functions = {}
    for row in rows.split(";")[:-1]:
        arguments, result, names = re.fullmatch(r"\s*\((.*?)\)\s*->\s*(.*?):\s*(.*?)\s*", row, re.S).groups()
        types = [one.strip() for one in arguments.split(",") if one.strip()]
        for name in names.split():
            assert name not in functions
            functions[name] = (result, types)
    return functions


def test_functions_have_the_types_of_the_standard():
    assert library_functions() == standard_functions()


def simulated(path, values, size, handling=None, end=10 * PERIOD):
    """What FMPy records."""
    events = {} if handling is None else {"use_event_mode": handling[0], "early_return_allowed": handling[1]}
    return fmpy.simulate_fmu(path, start_values=values, stop_time=end, output_interval=size, output=NAMES, **events)


def bits(rows):
    return [tuple(float(row[name]).hex() for name in sorted(rows.dtype.names)) for row in rows]


@pytest.mark.parametrize("size", [1e-4, 1e-2, PERIOD / 100, 0.7, PERIOD, 10 * PERIOD])
@pytest.mark.parametrize("values", [{}, UNLOADED], ids=["loaded", "unloaded"])
def test_every_importer_sees_the_same_to_the_bit(path, path_3, values, size):
    end = PERIOD if size == 1e-4 else 10 * PERIOD
    two = simulated(path, values, size, end=end)
    known = dict(zip((time.hex() for time in two["time"]), bits(two)))
    impacts = []
    for handling in HANDLINGS:
        rows = simulated(path_3, values, size, handling, end)
        assert rows["time"][-1] == two["time"][-1]
        # The last row of each time, whoever asks.
        at = dict(zip((time.hex() for time in rows["time"]), bits(rows)))
        assert all(at[time] == row for time, row in known.items())
        if handling[1]:
            struck = np.flatnonzero(np.diff(rows["impact.count"])) + 1
            impacts.append(bits(rows[struck]))
            assert list(rows["time"][struck]) == list(rows["impact.time"][struck])
    assert impacts[0] == impacts[1] and len(impacts[0]) == round(end / PERIOD)


@pytest.mark.parametrize("size", [0.01, 0.7, PERIOD])
def test_two_rows_for_each_impact(path_3, size):
    values = UNLOADED | {"stop.model": 6, "stop.restitution": 0.6}
    rows = simulated(path_3, values, size, (True, True), 100.0)
    struck = np.flatnonzero(np.diff(rows["impact.count"])) + 1
    assert len(struck) > 10
    before, after = rows[struck - 1], rows[struck]
    assert list(before["time"]) == list(after["time"]) == list(after["impact.time"])
    np.testing.assert_allclose(before["position"], 10.0, rtol=0, atol=4e-15)
    np.testing.assert_allclose(before["velocity"], after["impact.velocity"], rtol=1e-14)
    np.testing.assert_allclose(after["velocity"], -0.6 * before["velocity"], rtol=1e-14)
    assert list(after["impact.count"]) == list(before["impact.count"] + 1)


@pytest.mark.parametrize("unit", ["drive", "feeder"])
def test_drive_and_feeder_run_as_for_fmi_2(path, unit):
    rows = [fmpy.simulate_fmu(of(path, unit), stop_time=30.0, output_interval=0.1) for of in (package, package_3)]
    assert bits(rows[0]) == bits(rows[1])
