"""The FMU that the importers load, and where they may unpack it."""

import os

import pytest
from machine import TOP, UNITS, package


@pytest.fixture(scope="session")
def path():
    return os.environ.get("SOFTSTOP_FMU", str(TOP / "softstop.fmu"))


@pytest.fixture(params=UNITS)
def each(request, path):
    """The package of each unit."""
    return package(path, request.param)


@pytest.fixture(params=["loaded", "unloaded"])
def orbit(request):
    return request.param
