"""FMU Manipulation Toolbox: its checker, and its container, a C program that runs the unit."""

import json
import logging
import pathlib
import shutil
import subprocess
import sys

import pytest

pytest.importorskip("fmu_manipulation_toolbox", reason="fmu-manipulation-toolbox is not installed")
fmpy = pytest.importorskip("fmpy", reason="fmpy, which runs the container, is not installed")

from fmu_manipulation_toolbox.checker import (  # noqa: E402
    OperationGenericCheck, OperationSemanticCheck,
)
from fmu_manipulation_toolbox.operations import FMU  # noqa: E402
from machine import OBSERVED, PERIOD, check_orbit, orbit_values  # noqa: E402


@pytest.mark.parametrize("check", [OperationGenericCheck, OperationSemanticCheck])
def test_checker_finds_nothing(each, check, caplog):
    with caplog.at_level(logging.WARNING, logger="fmu_manipulation_toolbox"):
        fmu, operation = FMU(each), check()
        fmu.apply_operation(operation)
        fmu.close()
    assert [record.getMessage() for record in caplog.records] == []
    assert check is OperationSemanticCheck or operation.compliant_with_version == "2.0"


def container(path, folder, step, *options):
    """Packs the unit into a container with this step of its own; returns the new FMU."""
    name = pathlib.Path(path).name
    shutil.copy(path, folder / name)
    plan = {"name": "box.fmu", "fmu": [name], "step_size": step}
    (folder / "box.json").write_text(json.dumps(plan))
    run = [pathlib.Path(sys.executable).with_name("fmucontainer"), "-fmu-directory", folder]
    run += ["-container", "box.json", "-auto-parameter", *options]
    subprocess.run(run, check=True, capture_output=True)
    return folder / "box.fmu"


@pytest.mark.parametrize("options", [(), ("-mt",)], ids=["one thread", "threads"])
def test_container_runs_it(path, orbit, options, tmp_path):
    box = container(path, tmp_path, PERIOD / 50, *options)
    values = {f"softstop.{name}": value for name, value in orbit_values(orbit).items()}
    result = fmpy.simulate_fmu(
        str(box), stop_time=10 * PERIOD, step_size=PERIOD / 50, output_interval=PERIOD / 50,
        start_values=values, output=OBSERVED,
    )
    last = result[-1]
    check_orbit(orbit, 10, last["time"] - 10 * PERIOD, [last[name] for name in OBSERVED])
