"""fmi-sim and fmu-runner, importers in Rust from crates.io, built by rust_tools.py."""

import csv
import re
import subprocess
import zipfile

import numpy as np
import pytest
from machine import OBSERVED, PERIOD, PUSH, PUSHED, check_orbit, check_pushed, orbit_values, package_3
from rust_tools import program


def need(name):
    if not program(name).exists():
        pytest.skip(f"{name} is not built: run python tests/importers/rust_tools.py")
    return program(name)


def fmi_sim(path, folder, step, end, values, rows=None):
    """Runs fmi-sim; returns what it writes at the end, by name."""
    out, table = folder / "out.csv", folder / "in.csv"
    command = [need("fmi-sim"), "--model", path, "--output-file", out]
    if rows:
        table.write_text("\n".join(rows) + "\n")
        command += ["--input-file", table]
    command += ["co-simulation", "--output-interval", repr(step), "-f", repr(end)]
    for name, value in values.items():
        command += ["--init-values", f"{name}={value}"]
    subprocess.run(command, check=True, capture_output=True)
    return dict(zip(*np.genfromtxt(out, delimiter=",", dtype=str)[[0, -1]]))


def numbers(last, names):
    return [float(last[name]) for name in names]


@pytest.mark.parametrize("per_period", [1, 100, 1000])
def test_fmi_sim_orbit(path, orbit, per_period, tmp_path):
    step = float(PERIOD / per_period)
    last = fmi_sim(path, tmp_path, step, 10 * per_period * step, orbit_values(orbit))
    late = float(last["time"]) - 10 * PERIOD
    check_orbit(orbit, 10, late, numbers(last, OBSERVED))


@pytest.mark.parametrize("per_period", [1, 10])
def test_fmi_sim_input_table(path, per_period, tmp_path):
    step = float(PERIOD / per_period)
    rows = ["time,force,material", f"0,{PUSH},1", f"30,{PUSH},1"]
    last = fmi_sim(path, tmp_path, step, 3 * per_period * step, PUSHED, rows)
    check_pushed(float(last["time"]), numbers(last, ["position", "velocity", "impact.count"]))


def test_fmi_sim_chooses_a_stop_and_no_material(path, tmp_path):
    rows = ["time,force,material", "0,0,0", "60,0,0"]
    last = fmi_sim(path, tmp_path, float(PERIOD), 10 * float(PERIOD), {"stop.model": 2}, rows)
    assert float(last["pierce.count"]) <= 1  # the strip that lay there at the start
    assert float(last["impact.count"]) > 2


@pytest.fixture(scope="module")
def readable_3(path, tmp_path_factory):
    """The unit for FMI 3.0 without what fmi-sim 0.7.0 cannot read of its description."""
    copy = tmp_path_factory.mktemp("fmi-sim") / "softstop-fmi3.fmu"
    with zipfile.ZipFile(package_3(path, "softstop")) as whole, zipfile.ZipFile(copy, "w") as archive:
        for name in whole.namelist():
            content = whole.read(name)
            if name == "modelDescription.xml":
                content = re.sub(rb"<Annotations>.*</Annotations>", b"", content, flags=re.DOTALL)
                for attribute in (b"quantity", b"unit", b"nominal", b"displayUnit"):
                    content = re.sub(rb'(<Float64 [^>]*) %s="[^"]*"' % attribute, rb"\1", content)
            archive.writestr(name, content)
    return copy


def test_fmi_sim_has_the_same_impacts_in_both_interface_types(readable_3, tmp_path):
    def impacts(interface, *options):
        out = tmp_path / "out.csv"
        command = [need("fmi-sim"), "--model", readable_3, "--output-file", out, interface, "-f", "20"]
        subprocess.run([*command, *options], check=True, capture_output=True)
        with open(out) as lines:
            return list(dict.fromkeys((row["impact.time"], row["impact.velocity"]) for row in csv.DictReader(lines)))

    solved = impacts("co-simulation", "--output-interval", "0.05")
    # It integrates by Euler's method.
    assert impacts("model-exchange", "--step", "0.01", "-n", "0", "--output-interval", "0.01") == solved
    assert len(solved) == 5


@pytest.fixture(scope="module")
def without_derivative_order(path, tmp_path_factory):
    """fmu-runner 0.4.4 takes maxOutputDerivativeOrder for a Boolean and refuses 2."""
    copy = tmp_path_factory.mktemp("fmu-runner") / "softstop.fmu"
    with zipfile.ZipFile(path) as whole, zipfile.ZipFile(copy, "w") as archive:
        for name in whole.namelist():
            content = whole.read(name)
            if name == "modelDescription.xml":
                content = content.replace(b'maxOutputDerivativeOrder="2" ', b"")
            archive.writestr(name, content)
    return copy


@pytest.fixture
def fmu_runner(without_derivative_order):
    def run(step, steps, values):
        settings = [f"{name}={value}" for name, value in values.items()]
        command = [need("run-by-fmu-runner"), without_derivative_order, repr(step), str(steps)]
        output = subprocess.run([*command, *settings], check=True, capture_output=True, text=True)
        return [float(line) for line in output.stdout.split()]

    return run


@pytest.mark.parametrize("per_period", [0.1, 1, 1000])
def test_fmu_runner_orbit(fmu_runner, orbit, per_period):
    step = float(PERIOD / per_period)
    values = fmu_runner(step, round(10 * per_period), orbit_values(orbit))
    check_orbit(orbit, 10, 0.0, values)


def test_fmu_runner_force(fmu_runner):
    values = fmu_runner(float(3 * PERIOD), 1, PUSHED | {"force": PUSH})
    check_pushed(3 * PERIOD, values[:2] + values[3:4])
