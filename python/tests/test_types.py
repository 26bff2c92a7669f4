"""Types: mypy has nothing to say, and the stubs are those of the module."""

import subprocess
import sys

from conftest import TOP


def tool(folder, *arguments):
    run = subprocess.run([sys.executable, "-m", *arguments], capture_output=True, text=True, cwd=folder)
    assert run.returncode == 0, run.stdout + run.stderr


def test_package_is_typed():
    tool(TOP / "python", "mypy", "--strict", "-p", "softstop")


def test_stubs_are_those_of_the_module(tmp_path):
    tool(tmp_path, "mypy.stubtest", "softstop._softstop", "--ignore-missing-stub")
