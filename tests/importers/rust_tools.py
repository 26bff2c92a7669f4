"""Builds the importers from crates.io: fmi-sim, and a small program on fmu-runner.

Run it once as `python tests/importers/rust_tools.py`; it takes about ten minutes on one core.
The tests use what it leaves in the target folder.
"""

import importlib.util
import os
import pathlib
import shutil
import subprocess

from machine import TOP

FMI_SIM = "0.7.0"
TARGET = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", TOP / "target")) / "importers"


def program(name):
    """Where the program is, or would be."""
    return TARGET / "bin" / name


def environment():
    """Both crates make bindings with libclang, which comes from PyPI without C headers."""
    variables = dict(os.environ, CARGO_TARGET_DIR=str(TARGET))
    clang = importlib.util.find_spec("clang")
    if clang and "LIBCLANG_PATH" not in variables:
        headers = subprocess.run(["cc", "-print-file-name=include"], capture_output=True, text=True)
        folder = pathlib.Path(clang.submodule_search_locations[0]) / "native"
        variables["LIBCLANG_PATH"] = str(folder)
        variables["BINDGEN_EXTRA_CLANG_ARGS"] = f"-I{headers.stdout.strip()}"
    return variables


def build():
    install = ["cargo", "install", "--locked", "--root", TARGET]
    for what in (
        ["fmi-sim", "--version", FMI_SIM],
        ["--path", TOP / "tests" / "importers" / "fmu-runner"],
    ):
        subprocess.run([*install, *what], check=True, env=environment())
    shutil.rmtree(TARGET / "release")  # a gigabyte that is of no further use


if __name__ == "__main__":
    build()
