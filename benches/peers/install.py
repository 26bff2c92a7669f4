"""Installs the peers under the target directory: with pip into a virtual environment, with cargo."""

import os
import re
import subprocess
import sys
import venv
from pathlib import Path

from catalogue import REQUIREMENTS

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
TARGET = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")).resolve()
PLACE = TARGET / "peers"
CRATE = HERE / "rust"


class InstallError(Exception):
    """Something could not be installed."""


def python_worker(worker):
    """The command that starts a Python worker, its package installed."""
    python = _environment()
    requirement = REQUIREMENTS[worker]
    pip = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    _run([*pip, "--only-binary", ":all:", requirement], f"pip install {requirement}")
    return [str(python), str(HERE / "workers" / f"by_{worker}.py")]


def rust_worker():
    """The command that starts the Rust worker, built."""
    _build(["--manifest-path", CRATE / "Cargo.toml", "--locked"], PLACE / "rust")
    return [str(PLACE / "rust" / "release" / _program("peers"))]


def laboratory():
    """The program softstop-lab, built."""
    manifest = ["--manifest-path", ROOT / "Cargo.toml", "--locked"]
    _build([*manifest, "--package", "softstop-lab"], TARGET)
    return TARGET / "release" / _program("softstop-lab")


def crate_versions():
    """Crate and version, as the lock file has them."""
    lock = (CRATE / "Cargo.lock").read_text()
    return dict(re.findall(r'name = "([^"]+)"\nversion = "([^"]+)"', lock))


def _environment():
    place = PLACE / "venv"
    python = place / ("Scripts" if os.name == "nt" else "bin") / "python"
    if not python.exists():
        print(f"environment {place}", file=sys.stderr)
        venv.create(place, with_pip=True)
    return python


def _build(arguments, target):
    command = ["cargo", "build", "--release", "--quiet", *arguments, "--target-dir", target]
    _run(command, "cargo build")


def _run(command, what):
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    except FileNotFoundError as error:
        raise InstallError(f"{what}: {error}") from None
    if done.returncode:
        lines = done.stderr.strip().splitlines() or ["no message"]
        errors = [line for line in lines if line.lower().startswith("error")]
        raise InstallError(f"{what}: {(errors or lines)[-1]}")


def _program(name):
    return f"{name}.exe" if os.name == "nt" else name
