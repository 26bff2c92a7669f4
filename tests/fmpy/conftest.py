"""Fixtures: the packaged unit, and a driver that speaks to it by variable names."""

import contextlib
import os

import fmpy
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import (
    FMU2Slave,
    calloc,
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
    free,
)
from fmpy.logging import addLoggerProxy
from packages import TOP, UNITS, package


class Unit:
    """One instance, driven through FMPy's low-level interface."""

    def __init__(self, folder, description, name="unit", guid=None, logging_on=False, kind=FMU2Slave):
        self.variables = {v.name: v for v in description.modelVariables}
        self.lines = []
        self.fmu = kind(
            guid=guid or description.guid,
            unzipDirectory=folder,
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName=name,
        )
        self.callbacks = fmi2CallbackFunctions()
        self.callbacks.logger = fmi2CallbackLoggerTYPE(self._log)
        self.callbacks.allocateMemory = fmi2CallbackAllocateMemoryTYPE(calloc)
        self.callbacks.freeMemory = fmi2CallbackFreeMemoryTYPE(free)
        addLoggerProxy(fmpy.fmi2.byref(self.callbacks))
        self.fmu.instantiate(callbacks=self.callbacks, loggingOn=logging_on)
        self.time = 0.0

    def _log(self, environment, name, status, category, message):
        self.lines.append((status, category.decode(), message.decode()))

    def reference(self, name):
        return self.variables[name].valueReference

    def set(self, values):
        for name, value in values.items():
            kind = self.variables[name].type
            call = {
                "Real": self.fmu.setReal,
                "Boolean": self.fmu.setBoolean,
            }.get(kind, self.fmu.setInteger)
            call([self.reference(name)], [value])

    def get(self, *names):
        values = []
        for name in names:
            kind = self.variables[name].type
            call = {
                "Real": self.fmu.getReal,
                "Boolean": self.fmu.getBoolean,
            }.get(kind, self.fmu.getInteger)
            values += call([self.reference(name)])
        return values[0] if len(names) == 1 else np.array(values)

    def begin(self, values=None, start=0.0, stop=None):
        self.fmu.setupExperiment(startTime=start, stopTime=stop)
        self.set(values or {})
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()
        self.time = start
        return self

    def step(self, size):
        self.fmu.doStep(self.time, size)
        self.time += size

    def state(self):
        return self.get("position", "velocity")

    def refused(self, call, *words):
        """Makes a call that must fail with one line in the log; returns that line."""
        before = len(self.lines)
        with pytest.raises(FMICallException) as caught:
            call()
        assert caught.value.status == 3
        new = self.lines[before:]
        assert len(new) == 1, new
        status, category, message = new[0]
        assert (status, category) == (3, "errors")
        for word in words:
            assert word in message, message
        return message


@pytest.fixture(scope="session")
def path():
    return os.environ.get("SOFTSTOP_FMU", str(TOP / "softstop.fmu"))


@pytest.fixture(scope="session", params=UNITS)
def each(request, path):
    """The package of each unit."""
    return package(path, request.param)


@pytest.fixture(scope="session")
def folder(path, tmp_path_factory):
    return fmpy.extract(path, unzipdir=str(tmp_path_factory.mktemp("unit")))


@pytest.fixture(scope="session")
def description(folder):
    return fmpy.read_model_description(folder)


@contextlib.contextmanager
def maker(folder, description):
    """Makes instances and frees them in the end."""
    units = []

    def make_one(**arguments):
        units.append(Unit(folder, description, **arguments))
        return units[-1]

    yield make_one
    for unit in units:
        unit.fmu.fmi2FreeInstance(unit.fmu.component)


@pytest.fixture
def make(folder, description):
    with maker(folder, description) as make_one:
        yield make_one


@pytest.fixture
def unit(make):
    return make()
