"""The program beside which the package is tested."""

import os
import pathlib
import subprocess

import pytest

TOP = pathlib.Path(__file__).parents[2]
PROGRAM = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", TOP / "target")) / "release" / "softstop"


@pytest.fixture
def program(tmp_path):
    """Runs the program in a folder of its own and returns what it prints."""

    def run(*arguments):
        done = subprocess.run([PROGRAM, *map(str, arguments)], cwd=tmp_path, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        return done.stdout

    return run
