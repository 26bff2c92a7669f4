"""The units' packages."""

import pathlib

TOP = pathlib.Path(__file__).resolve().parents[2]
UNITS = ["softstop", "drive", "feeder"]


def package(path, name):
    """The unit of this name: softstop.fmu is at `path`, the others stand beside it or at the top."""
    beside = pathlib.Path(path).parent / f"{name}.fmu"
    if name == "softstop":
        return path
    return str(beside if beside.exists() else TOP / f"{name}.fmu")


def package_exchange(path):
    """The press for FMI 2.0 that tells of model exchange, too."""
    beside = pathlib.Path(path).parent / "softstop-exchange.fmu"
    return str(beside if beside.exists() else TOP / "softstop-exchange.fmu")


def package_3(path, name):
    """The unit for FMI 3.0, beside the one for FMI 2.0 or at the top."""
    beside = pathlib.Path(path).parent / f"{name}-fmi3.fmu"
    return str(beside if beside.exists() else TOP / f"{name}-fmi3.fmu")
