"""fmusim of the Reference-FMUs, where it is on the path, with the units for both standards."""

import csv
import shutil
import subprocess

import pytest
from machine import PERIOD, UNITS, package, package_3, package_exchange

FMUSIM = shutil.which("fmusim")
pytestmark = pytest.mark.skipif(FMUSIM is None, reason="fmusim is not on the path")

NAMES = ["position", "velocity", "impact.count", "impact.time", "impact.velocity", "pierce.count", "energy.dissipated"]
HANDLINGS = [[], ["--early-return-allowed"], ["--event-mode-used"], ["--early-return-allowed", "--event-mode-used"]]


def simulated(unit, folder, step, stop, *options, interface="cs"):
    """What it records, by the time as it is written."""
    file = folder / "out.csv"
    steps = ["--interface-type", interface, "--output-interval", str(step), "--stop-time", str(stop)]
    subprocess.run([FMUSIM, *steps, *options, "--output-file", file, unit], check=True)
    with open(file) as lines:
        return {row["time"]: row for row in csv.DictReader(lines)}


@pytest.mark.parametrize("handling", HANDLINGS, ids=" ".join)
@pytest.mark.parametrize("step", [1e-2, 0.7, PERIOD, 10 * PERIOD])
def test_both_standards_agree_to_the_bit(path, tmp_path, step, handling):
    stop = 10 * PERIOD
    two = simulated(path, tmp_path, step, stop)
    three = simulated(package_3(path, "softstop"), tmp_path, step, stop, *handling)
    common = two.keys() & three.keys()
    # Near an event it takes a step for the end of the one before.
    assert len(common) >= 0.999 * len(two)
    for time in common:
        assert [two[time][name] for name in NAMES] == [three[time][name] for name in NAMES]


@pytest.mark.parametrize("unit", UNITS)
def test_each_unit_runs(path, tmp_path, unit):
    for file in (package(path, unit), package_3(path, unit)):
        assert len(simulated(file, tmp_path, 0.5, 50)) == 101


@pytest.mark.parametrize("standard", [2, 3])
@pytest.mark.parametrize("solver, miss", [("euler", 0.5), ("cvode", 1e-4)])
def test_impacts_of_model_exchange_are_those_of_co_simulation_to_the_bit(path, tmp_path, standard, solver, miss):
    unit = package_exchange(path) if standard == 2 else package_3(path, "softstop")
    stop = 10 * PERIOD
    solving = ["--solver", solver, "--tolerance", "1e-8"]
    runs = [simulated(unit, tmp_path, 0.01, stop)]
    try:
        runs.append(simulated(unit, tmp_path, 0.01, stop, *solving, interface="me"))
    except subprocess.CalledProcessError:
        if solver == "euler":
            raise
        pytest.skip("fmusim is built without CVode")
    impacts = [list(dict.fromkeys((row["impact.time"], row["impact.velocity"]) for row in run.values())) for run in runs]
    assert impacts[0] == impacts[1] and len(impacts[0]) == 11
    last = [list(run.values())[-1] for run in runs]
    assert all(abs(float(last[0][name]) - float(last[1][name])) < miss for name in ("position", "velocity"))
