"""FMPy's command line, as an engineer would type it."""

import pathlib
import subprocess
import sys

import numpy as np
import pytest
from reference import PERIOD, UNLOADED


def fmpy(*arguments):
    program = pathlib.Path(sys.executable).with_name("fmpy")
    run = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    return run.stdout


def test_info(path):
    text = fmpy("info", path)
    for word in ("softstop", "Co-Simulation", "impact.velocity", "linux64"):
        assert word in text


def test_validate(path):
    assert "No problems found" in fmpy("validate", path)


@pytest.mark.parametrize("interval", [PERIOD / 200, PERIOD])
def test_simulate(path, interval, tmp_path):
    out = tmp_path / "out.csv"
    values = [str(item) for pair in UNLOADED.items() for item in pair]
    fmpy(
        "simulate", path, "--validate", "--stop-time", 10 * PERIOD, "--output-interval", interval,
        "--output-file", out, "--start-values", *values,
        "--output-variables", "position", "velocity", "impact.count",
    )
    last = np.genfromtxt(out, delimiter=",", names=True, deletechars="")[-1]
    start = [UNLOADED["initial.position"], UNLOADED["initial.velocity"]]
    assert last["time"] == pytest.approx(10 * PERIOD)
    np.testing.assert_allclose([last["position"], last["velocity"]], start, atol=1e-9)
    assert last["impact.count"] == 10


def test_simulate_with_an_input_file(path, tmp_path):
    table, out = tmp_path / "in.csv", tmp_path / "out.csv"
    table.write_text('"time","force","material"\n0,0.2,1\n9,0.2,1\n9,0.2,0\n60,0.2,0\n')
    fmpy(
        "simulate", path, "--stop-time", 50, "--output-interval", 0.5, "--input-file", table,
        "--output-file", out, "--output-variables", "force", "impact.count", "pierce.count",
    )
    last = np.genfromtxt(out, delimiter=",", names=True, deletechars="")[-1]
    assert last["force"] == 0.2
    assert 0 < last["pierce.count"] < last["impact.count"]
