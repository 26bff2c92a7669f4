"""Builds the importing half of FMI++ (PyPI: fmipp 2.1.0) from its source package.

Run it once as `python tests/importers/build_fmipp.py`; it takes two minutes. It needs a C++
compiler, swig and Boost (Debian: swig, libboost-filesystem-dev, libboost-system-dev,
libboost-date-time-dev). The package's own build wants a Sundials of 2015, which only its
integrators for model exchange use: here it is left out.
"""

import os
import pathlib
import subprocess
import sys
import sysconfig
import tarfile

from machine import TOP

FOLDER = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", TOP / "target")) / "importers" / "fmipp"
SOURCE = FOLDER / "fmipp-2.1.0"
LIBRARY = SOURCE / "fmipp" / "lib" / "_fmippim.so"
DEFINES = ['-DFMU_BIN_DIR="linux64"', '-DFMU_BIN_EXT=".so"']


def run(*command):
    subprocess.run(command, check=True, cwd=SOURCE if SOURCE.exists() else FOLDER)


def build():
    FOLDER.mkdir(parents=True, exist_ok=True)
    pip = [sys.executable, "-m", "pip", "download", "--quiet", "--no-deps"]
    run(*pip, "--no-binary", "fmipp", "--dest", FOLDER, "fmipp==2.1.0")
    with tarfile.open(FOLDER / "fmipp-2.1.0.tar.gz") as archive:
        archive.extractall(FOLDER)
    wrapper = "source/fmipp/import/swig/wrapper.cpp"
    interface = "source/fmipp/import/swig/libfmippim.i"
    run("swig", "-python", "-c++", "-Isource/fmipp", "-outdir", "fmipp", "-o", wrapper, interface)
    parts = ("base", "integrators", "utility")
    sources = [p for part in parts for p in SOURCE.glob(f"source/fmipp/import/{part}/src/*.cpp")]
    objects = []
    for source in [SOURCE / wrapper, *sources]:
        objects.append(source.with_suffix(".o"))
        include = ["-Isource/fmipp", f"-I{sysconfig.get_paths()['include']}"]
        compiler = ["c++", "-O1", "-w", "-fPIC", "-std=c++14", *include, *DEFINES]
        run(*compiler, "-c", source, "-o", objects[-1])
    run("c++", "-shared", *objects, "-o", LIBRARY, "-lboost_filesystem", "-lboost_system", "-ldl")


if __name__ == "__main__":
    build()
