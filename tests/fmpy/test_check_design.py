"""A design holds in its own unit, within all its tolerances; a requirement that it does not meet is told."""

import json
import os
import pathlib
import subprocess
import sys

import pytest
from packages import TOP

PROGRAM = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", TOP / "target")) / "release" / "softstop"

TASK = """
[vary]
stop.stiffness = [5e6, 8e7]
clearance = 0.01
excitation.frequency_hz = [10, 40]

[tolerance]
clearance = 2e-4
damping = "10 %"
excitation.frequency_hz = 0.1

[require]
tolerance_reserve = 1.1
stop_force = 5e5
stroke = 0.08
"""


@pytest.fixture(scope="module")
def design(tmp_path_factory):
    """The folder of a design of the guide's press, with another task."""
    folder = tmp_path_factory.mktemp("design")
    machine = (TOP / "docs/press/press.toml").read_text(encoding="utf-8").split("[vary]")[0]
    (folder / "task.toml").write_text(machine + TASK, encoding="utf-8")
    subprocess.run([PROGRAM, "optimize", "task.toml", "--no-report", "--samples", "1024", "--output", "."],
                   cwd=folder, check=True, capture_output=True)
    return folder


def check(folder):
    return subprocess.run([sys.executable, TOP / "examples/check_design.py", folder, "--machines", "20"],
                          capture_output=True, text=True)


def test_all_machines_meet_what_was_required(design):
    run = check(design)
    assert run.returncode == 0, run.stdout + run.stderr
    assert "0 of 29 machines find no motion or violate a requirement" in run.stdout
    rows = {words[0]: words for words in map(str.split, run.stdout.splitlines()) if words}
    for figure in ["velocity", "stop_force", "stroke"]:
        drawing, reported, worst, worst_reported = map(float, rows[figure][-4:])
        assert drawing == pytest.approx(reported, rel=1e-7)
        beyond = worst_reported - worst if figure == "velocity" else worst - worst_reported
        assert -0.1 * worst_reported < beyond < 1e-6 * worst_reported, "the report has the worst of a box 1.1 times as wide"


def test_a_bound_that_the_worst_machine_exceeds_is_told(design, tmp_path):
    for file in design.glob("design.*"):
        (tmp_path / file.name).write_bytes(file.read_bytes())
    report = json.loads((tmp_path / "design.json").read_text(encoding="utf-8"))
    force = next(row for row in report["requirements"] if row["name"] == "stop_force")
    force["required"] = f"at most {force['worst'] * 0.99} N"
    (tmp_path / "design.json").write_text(json.dumps(report), encoding="utf-8")
    run = check(tmp_path)
    assert run.returncode == 1
    assert "0 of 29 machines" not in run.stdout
