"""What importers do in practice: resource locations, absent callbacks, threads, hard ends.

Here the library is called with ctypes alone, without FMPy in between.
"""

import ctypes
import pathlib
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor

import pytest
from reference import PERIOD

START = [4.818747634046, 11.908301592746]


class Callbacks(ctypes.Structure):
    """fmi2CallbackFunctions; here all of them are NULL."""

    _fields_ = [(name, ctypes.c_void_p) for name in (
        "logger", "allocateMemory", "freeMemory", "stepFinished", "componentEnvironment",
    )]


class Library:
    """The unit's shared library and its GUID."""

    def __init__(self, folder, description):
        (self.file,) = pathlib.Path(folder).glob("binaries/linux64/*.so")
        self.c = ctypes.CDLL(str(self.file))
        self.c.fmi2Instantiate.restype = ctypes.c_void_p
        self.c.fmi2GetVersion.restype = ctypes.c_char_p
        self.c.fmi2GetTypesPlatform.restype = ctypes.c_char_p
        self.guid = description.guid.encode()
        self.callbacks = Callbacks()
        self.references = {v.name: v.valueReference for v in description.modelVariables}

    def instantiate(self, name=b"unit", kind=1, guid=None, place=None, callbacks=True, **flags):
        functions = ctypes.byref(self.callbacks) if callbacks else None
        guid = self.guid if guid is None else guid
        return ctypes.c_void_p(self.c.fmi2Instantiate(
            name, kind, guid or None, place, functions, 0, flags.get("logging", 1)
        ))

    def begin(self, unit):
        zero = ctypes.c_double(0.0)
        assert self.c.fmi2SetupExperiment(unit, 0, zero, zero, 0, zero) == 0
        assert self.c.fmi2EnterInitializationMode(unit) == 0
        assert self.c.fmi2ExitInitializationMode(unit) == 0

    def step(self, unit, time, size):
        return self.c.fmi2DoStep(unit, ctypes.c_double(time), ctypes.c_double(size), 1)

    def get(self, unit, *names):
        references = (ctypes.c_uint * len(names))(*(self.references[n] for n in names))
        values = (ctypes.c_double * len(names))()
        assert self.c.fmi2GetReal(unit, references, len(names), values) == 0
        return list(values)

    def run(self, unit, steps):
        for number in range(steps):
            assert self.step(unit, number * 10 * PERIOD / steps, 10 * PERIOD / steps) == 0
        return self.get(unit, "position", "velocity", "impact.time")


@pytest.fixture(scope="module")
def library(folder, description):
    return Library(folder, description)


@pytest.mark.parametrize("place", [
    None, b"", b"file:/tmp/r", b"file:///tmp/r", b"file:////tmp/r", b"file://localhost/tmp/r",
    b"file:///C:/r", b"/tmp/r", b"resources", b"http://nowhere/r", b"file:///tmp/%zz%C3%A4",
    b"\xff\xfe",
])
def test_any_resource_location(library, place):
    unit = library.instantiate(place=place)
    assert unit
    library.begin(unit)
    assert library.run(unit, 100)[:2] == pytest.approx(START, abs=1e-9)
    library.c.fmi2FreeInstance(unit)


def test_version_and_platform_come_first(library):
    assert library.c.fmi2GetVersion() == b"2.0"
    assert library.c.fmi2GetTypesPlatform() == b"default"


def test_errors_without_a_logger(library):
    unit = library.instantiate()
    assert library.step(unit, 0.0, 1.0) == 3
    unknown, value = (ctypes.c_uint * 1)(4711), (ctypes.c_double * 1)(1.0)
    assert library.c.fmi2SetReal(unit, unknown, 1, value) == 3
    library.begin(unit)
    assert library.step(unit, 0.0, -1.0) == 3
    assert library.run(unit, 10)[:2] == pytest.approx(START, abs=1e-9)
    library.c.fmi2FreeInstance(unit)


def test_no_callbacks_at_all(library):
    """The standard wants the structure; without it the unit may be refused, but nothing falls."""
    unit = library.instantiate(callbacks=False)
    if unit:
        library.begin(unit)
        assert library.run(unit, 10)[:2] == pytest.approx(START, abs=1e-9)
        library.c.fmi2FreeInstance(unit)


def test_what_is_no_instance(library):
    assert not library.instantiate(kind=0), "model exchange"
    assert not library.instantiate(guid=b"{f678dcc0}")
    assert not library.instantiate(guid=b"")
    for name in (None, b""):
        unit = library.instantiate(name=name)
        if unit:
            library.c.fmi2FreeInstance(unit)
    library.c.fmi2FreeInstance(None)
    assert library.step(None, 0.0, 1.0) == 3
    assert library.c.fmi2Reset(None) == 3
    assert library.c.fmi2GetReal(None, (ctypes.c_uint * 1)(200), 1, (ctypes.c_double * 1)()) == 3


@pytest.mark.parametrize("call", ["GetReal", "SetReal", "GetInteger", "SetInteger", "GetBoolean",
                                  "SetBoolean", "GetString", "SetString"])
def test_arrays_of_length_zero_and_absent_ones(library, call):
    unit = library.instantiate()
    function = getattr(library.c, f"fmi2{call}")
    assert function(unit, None, 0, None) == 0
    assert function(unit, None, 1, None) == 3
    assert function(unit, (ctypes.c_uint * 1)(0), 1, None) == 3
    library.begin(unit)
    library.c.fmi2FreeInstance(unit)


def test_parameters_before_the_experiment_is_set_up(library):
    unit = library.instantiate()
    reference = (ctypes.c_uint * 1)(library.references["initial.velocity"])
    assert library.c.fmi2SetReal(unit, reference, 1, (ctypes.c_double * 1)(3.0)) == 0
    library.begin(unit)
    assert library.get(unit, "velocity") == [3.0]
    library.c.fmi2FreeInstance(unit)


def test_made_in_one_thread_and_called_from_others(library):
    alone, passed_on = library.instantiate(), library.instantiate()
    library.begin(alone)
    calls = [lambda: library.begin(passed_on)]
    calls += [
        lambda t=number: library.step(passed_on, t * PERIOD / 10, PERIOD / 10)
        for number in range(100)
    ]
    for call in calls:
        thread = threading.Thread(target=call)
        thread.start()
        thread.join()
    assert library.get(passed_on, "position", "velocity", "impact.time") == library.run(alone, 100)
    thread = threading.Thread(target=library.c.fmi2FreeInstance, args=(passed_on,))
    thread.start()
    thread.join()
    library.c.fmi2FreeInstance(alone)


def test_parallel_instances(library):
    def whole_life(steps):
        unit = library.instantiate()
        library.begin(unit)
        values = library.run(unit, steps)
        library.c.fmi2FreeInstance(unit)
        return values

    counts = [10, 100, 1000, 5000] * 8
    one_by_one = [whole_life(steps) for steps in counts]
    with ThreadPoolExecutor(8) as pool:
        assert list(pool.map(whole_life, counts)) == one_by_one


ENDS = {
    "neither Terminate nor FreeInstance": "",
    "Terminate only": "assert c.fmi2Terminate(unit) == 0",
    "FreeInstance without Terminate": "c.fmi2FreeInstance(unit)",
    "error, then FreeInstance": "assert c.fmi2DoStep(unit, d(-5), d(1), 1) == 3\n"
                                "c.fmi2FreeInstance(unit)",
    "unloaded while alive": "import _ctypes; _ctypes.dlclose(c._handle)",
    "ended from another thread": "import threading; threading.Thread(target=c.fmi2FreeInstance, "
                                 "args=(unit,)).start()",
}


@pytest.mark.parametrize("end", ENDS)
def test_ends_of_a_process(library, end):
    program = f"""
import ctypes
c, d = ctypes.CDLL({str(library.file)!r}), ctypes.c_double
c.fmi2Instantiate.restype = ctypes.c_void_p
functions = (ctypes.c_void_p * 5)()
unit = ctypes.c_void_p(c.fmi2Instantiate(b"u", 1, {library.guid!r}, None, functions, 0, 0))
assert c.fmi2SetupExperiment(unit, 0, d(0), d(0), 0, d(0)) == 0
assert c.fmi2EnterInitializationMode(unit) == 0
assert c.fmi2ExitInitializationMode(unit) == 0
assert c.fmi2DoStep(unit, d(0), d(20), 1) == 0
{ENDS[end]}
"""
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert (ended.returncode, ended.stdout, ended.stderr) == (0, "", "")
