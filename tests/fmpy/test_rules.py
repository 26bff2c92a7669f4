"""The model description against the rules of FMI 2.0.4 that its schema cannot express."""

import math
import re
import xml.etree.ElementTree as ElementTree
import zipfile

import pytest

NAME = r"[A-Za-z_][A-Za-z0-9_]*(\[[1-9][0-9]*(,[1-9][0-9]*)*\])?"
COMBINATIONS = {  # table in section 2.2.7: causality, variability -> allowed values of initial
    ("parameter", "fixed"): {"exact"},
    ("parameter", "tunable"): {"exact"},
    ("calculatedParameter", "fixed"): {"calculated", "approx"},
    ("calculatedParameter", "tunable"): {"calculated", "approx"},
    ("input", "discrete"): {None},
    ("input", "continuous"): {None},
    ("output", "constant"): {"exact"},
    ("output", "discrete"): {"calculated", "exact", "approx"},
    ("output", "continuous"): {"calculated", "exact", "approx"},
    ("local", "constant"): {"exact"},
    ("local", "fixed"): {"calculated", "approx"},
    ("local", "tunable"): {"calculated", "approx"},
    ("local", "discrete"): {"calculated", "exact", "approx"},
    ("local", "continuous"): {"calculated", "exact", "approx"},
    ("independent", "continuous"): {None},
}
DIMENSIONS = {  # powers of kg, m, s, rad
    "kg": (1, 0, 0, 0), "m": (0, 1, 0, 0), "s": (0, 0, 1, 0), "rad": (0, 0, 0, 1),
    "N": (1, 1, -2, 0), "J": (1, 2, -2, 0), "s2": (0, 0, 2, 0), "W": (1, 2, -3, 0),
    "m2": (0, 2, 0, 0),
}
SCALES = {
    "kN": 1e-3, "mm": 1e3, "Hz": 1 / math.tau, "deg": 180 / math.pi,
}


@pytest.fixture(scope="module")
def root(each):
    with zipfile.ZipFile(each) as archive:
        return ElementTree.fromstring(archive.read("modelDescription.xml"))


@pytest.fixture(scope="module")
def variables(root):
    return root.findall("ModelVariables/ScalarVariable")


def kind(variable):
    """The element with the type's attributes."""
    return next(e for e in variable if e.tag in ("Real", "Integer", "Boolean", "Enumeration"))


def unique(values):
    values = list(values)
    return len(values) == len(set(values)) > 0


def test_head(root):
    assert root.get("fmiVersion") == "2.0"
    assert re.fullmatch(r"\{[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}\}", root.get("guid"))
    assert root.get("variableNamingConvention") == "structured"
    slave = root.find("CoSimulation")
    assert re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", slave.get("modelIdentifier"))
    flags = slave.attrib
    assert flags["canSerializeFMUstate"] == "false" or flags["canGetAndSetFMUstate"] == "true"
    assert unique(c.get("name") for c in root.findall("LogCategories/Category"))
    assert unique(t.get("name") for t in root.findall("VendorAnnotations/Tool"))
    experiment = root.find("DefaultExperiment")
    start, stop = float(experiment.get("startTime")), float(experiment.get("stopTime"))
    assert 0 < float(experiment.get("stepSize")) < stop - start


def test_archive(each, root):
    identifier = root.find("CoSimulation").get("modelIdentifier")
    with zipfile.ZipFile(each) as archive:
        assert archive.testzip() is None
        names = archive.namelist()
    assert unique(names)
    assert all(re.fullmatch(r"[A-Za-z0-9_.\-]+(/[A-Za-z0-9_.\-]+)*/?", n) for n in names)
    assert not any(".." in n.split("/") for n in names)
    libraries = [n for n in names if n.startswith("binaries/") and not n.endswith("/")]
    suffixes = {"linux64": "so", "win64": "dll", "darwin64": "dylib"}
    assert libraries
    for library in libraries:
        _, platform, file = library.split("/")
        suffix = suffixes.get(platform, "so" if "linux" in platform else "dylib")
        assert file == f"{identifier}.{suffix}"
    tops = {"modelDescription.xml", "model.png", "binaries", "documentation", "resources",
            "sources", "extra"}
    assert {n.split("/")[0] for n in names} <= tops


def test_names_and_references(root, variables):
    names = [v.get("name") for v in variables]
    assert unique(names)
    for name in names:
        assert re.fullmatch(rf"{NAME}(\.{NAME})*", name), name
    types = [t.get("name") for t in root.findall("TypeDefinitions/SimpleType")]
    assert unique(types)
    assert not set(types) & set(names)
    base = {"Enumeration": "Integer"}
    assert unique((base.get(kind(v).tag, kind(v).tag), v.get("valueReference")) for v in variables)


def test_causality_variability_and_initial(variables):
    for variable in variables:
        name, initial = variable.get("name"), variable.get("initial")
        pair = variable.get("causality", "local"), variable.get("variability", "continuous")
        assert initial in COMBINATIONS[pair], name
        assert kind(variable).tag == "Real" or pair[1] != "continuous", name
        started = kind(variable).get("start") is not None
        wanted = initial in ("exact", "approx") or pair[0] == "input"
        assert started == wanted, name


def test_ranges_and_types(root, variables):
    types = {t.get("name"): t for t in root.findall("TypeDefinitions/SimpleType")}
    for variable in variables:
        own = kind(variable)
        attributes = dict(own.attrib)
        if declared := own.get("declaredType"):
            assert next(e.tag for e in types[declared]) == own.tag, variable.get("name")
            attributes = dict(next(iter(types[declared])).attrib) | attributes
        if own.tag in ("Real", "Integer"):
            low = float(attributes.get("min", -math.inf))
            high = float(attributes.get("max", math.inf))
            assert low < high, variable.get("name")
            start = float(attributes.get("start", low if low > -math.inf else high))
            assert low <= start <= high, variable.get("name")
            assert float(attributes.get("nominal", 1.0)) > 0.0
        if own.tag == "Enumeration":
            items = types[own.get("declaredType")].findall("Enumeration/Item")
            assert unique(i.get("name") for i in items) and unique(i.get("value") for i in items)
            assert own.get("start") in {None} | {i.get("value") for i in items}


def dimension(name):
    """Powers of kg, m, s and rad in a unit such as N.s/m."""
    above, *below = name.split("/")
    powers = [0, 0, 0, 0]
    for sign, part in [(1, above)] + [(-1, p) for p in below]:
        for symbol in part.split("."):
            powers = [p + sign * d for p, d in zip(powers, DIMENSIONS[symbol])]
    return tuple(powers)


def test_units(root, variables):
    units = {u.get("name"): u for u in root.findall("UnitDefinitions/Unit")}
    assert unique(u.get("name") for u in root.findall("UnitDefinitions/Unit"))
    for name, unit in units.items():
        base = unit.find("BaseUnit")
        assert float(base.get("factor", 1)) == 1.0 and float(base.get("offset", 0)) == 0.0
        assert tuple(int(base.get(k, 0)) for k in ("kg", "m", "s", "rad")) == dimension(name)
        for shown in unit.findall("DisplayUnit"):
            assert math.isclose(float(shown.get("factor")), SCALES[shown.get("name")])
    used = set()
    for real in [kind(v) for v in variables] + root.findall("TypeDefinitions/SimpleType/Real"):
        unit, shown = real.get("unit"), real.get("displayUnit")
        used.add(unit)
        assert unit is None or unit in units
        if shown:
            assert shown in {d.get("name") for d in units[unit].findall("DisplayUnit")}
    assert set(units) == used - {None}
    shown = {kind(v).get("displayUnit") for v in variables} - {None}
    assert shown == {d.get("name") for d in root.iter("DisplayUnit")}


def test_no_name_is_a_leaf_and_a_record(variables):
    names = {v.get("name") for v in variables}
    records = {name[:at] for name in names for at, letter in enumerate(name) if letter == "."}
    assert not names & records


def test_log_categories(root, variables):
    names = [c.get("name") for c in root.findall("LogCategories/Category")]
    events = any(v.get("name").endswith("count") for v in variables)
    assert unique(names) and ("events" in names) == ("logEvents" in names) == events
    assert {"logStatusWarning", "logStatusDiscard", "logStatusError", "logAll"} < set(names)


def indices(unknown):
    return [int(i) for i in unknown.get("dependencies", "").split()]


def states(variables):
    """Indices of the continuous states, and of their derivatives."""
    derivatives = [(int(real.get("derivative")), i) for i, v in enumerate(variables, 1)
                   for real in v.findall("Real") if real.get("derivative")]
    return [state for state, _ in derivatives], [i for _, i in derivatives]


def test_derivatives_are_listed_with_the_states_that_may_change_at_events(root, variables):
    listed = [int(u.get("index")) for u in root.findall("ModelStructure/Derivatives/Unknown")]
    own, derivatives = states(variables)
    assert listed == derivatives
    assert (root.find("ModelExchange") is not None) == bool(listed)
    reinit = [i for i, v in enumerate(variables, 1) for real in v.findall("Real") if real.get("reinit") == "true"]
    assert reinit == own


@pytest.mark.parametrize("part", ["Outputs", "Derivatives", "InitialUnknowns"])
def test_model_structure(root, variables, part):
    unknowns = root.findall(f"ModelStructure/{part}/Unknown")
    listed = [int(u.get("index")) for u in unknowns]
    outputs = [i for i, v in enumerate(variables, 1) if v.get("causality") == "output"]
    if part == "InitialUnknowns":
        outputs = [i for i in outputs if variables[i - 1].get("initial") != "exact"]
    assert listed == (states(variables)[1] if part == "Derivatives" else outputs)
    kinds = {"dependent", "constant"}
    if part != "InitialUnknowns":
        kinds |= {"fixed", "tunable", "discrete"}
    for unknown in unknowns:
        dependencies = indices(unknown)
        assert dependencies == sorted(set(dependencies))
        given = unknown.get("dependenciesKind", "").split()
        assert len(given) == len(dependencies) and set(given) <= kinds
        for index in dependencies:
            known = variables[index - 1]
            allowed = known.get("causality") in ("input", "independent") or index in states(variables)[0]
            if part == "InitialUnknowns":
                allowed |= known.get("initial") == "exact"
            assert 1 <= index <= len(variables) and allowed, known.get("name")
