"""Types: mypy and pyright have nothing to say, and the stubs are those of the module."""

import subprocess
import sys

from conftest import TOP
from test_guide import BLOCK, NOTEBOOKS


def tool(folder, *arguments):
    run = subprocess.run([sys.executable, "-m", *arguments], capture_output=True, text=True, cwd=folder)
    assert run.returncode == 0, run.stdout + run.stderr


def test_package_is_typed():
    tool(TOP / "python", "mypy", "--strict", "-p", "softstop")
    tool(TOP / "python", "pyright", "--pythonpath", sys.executable)


def test_notebooks_are_typed(tmp_path):
    for number, page in enumerate(NOTEBOOKS):
        code = "\n".join(code for code, _ in BLOCK.findall(page.read_text(encoding="utf-8")))
        (tmp_path / f"notebook_{number}.py").write_text(code, encoding="utf-8")
    tool(tmp_path, "mypy", "--strict", ".")
    tool(tmp_path, "pyright", "--pythonpath", sys.executable)


def test_stubs_are_those_of_the_module(tmp_path):
    tool(tmp_path, "mypy.stubtest", "softstop._softstop", "--ignore-missing-stub")
