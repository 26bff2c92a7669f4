"""The unit beside one of the same machine with a fixed step inside: time and error over 200 periods.

    python tests/fmpy/speed.py softstop.fmu [halvings]

Prints a table in Markdown. Both run through FMPy's simulate_fmu at 50 communication steps per period. The
unit for comparison (fmu/tests/c/fixed_step.c) is compiled here and needs a C compiler.
"""

import math
import pathlib
import subprocess
import sys
import tempfile
import time
import zipfile

import fmpy
import numpy as np
from reference import PERIOD, UNLOADED

SOURCES = pathlib.Path(__file__).resolve().parents[2] / "fmu/tests/c"
PERIODS = 200
COMMUNICATION_STEP = PERIOD / 50
TARGET = 1e-9


def pack_fixed_step(folder):
    """Compiles and packs the unit for comparison; returns its path."""
    library = pathlib.Path(folder) / ("fixed_step" + fmpy.sharedLibraryExtension)
    source = str(SOURCES / "fixed_step.c")
    subprocess.run(
        ["cc", "-std=c99", "-O2", "-shared", "-fPIC", source, "-o", str(library), "-lm"], check=True
    )
    path = pathlib.Path(folder) / "fixed_step.fmu"
    with zipfile.ZipFile(path, "w") as archive:
        archive.write(SOURCES / "fixed_step.xml", "modelDescription.xml")
        archive.write(library, f"binaries/{fmpy.platform}/{library.name}")
    return str(path)


class Case:
    """One unit, unpacked once."""

    def __init__(self, path, folder):
        self.folder = fmpy.extract(path, unzipdir=folder)
        self.description = fmpy.read_model_description(self.folder)

    def run(self, values, repeats=1, step=COMMUNICATION_STEP):
        """Position and velocity at the end, and the median time of a simulation in s."""
        times = []
        for _ in range(repeats):
            begin = time.perf_counter()
            result = fmpy.simulate_fmu(
                self.folder,
                model_description=self.description,
                fmi_type="CoSimulation",
                stop_time=PERIODS * PERIOD,
                output_interval=step,
                start_values=values,
                output=["position", "velocity"],
            )
            times.append(time.perf_counter() - begin)
        assert math.isclose(result["time"][-1], PERIODS * PERIOD)
        return np.array([result["position"][-1], result["velocity"][-1]]), np.median(times)


def table(path, halvings, folder):
    exact = Case(path, folder + "/exact")
    fixed = Case(pack_fixed_step(folder), folder + "/fixed")
    orbit = np.array([UNLOADED["initial.position"], UNLOADED["initial.velocity"]])
    end, seconds = exact.run(UNLOADED, repeats=5)
    single, at_once = exact.run(UNLOADED, repeats=5, step=PERIODS * PERIOD)
    print("| unit | inner step | time | error at the end |")
    print("|---|---|---|---|")
    print(f"| softstop, 10,000 steps | none | {seconds:.3f} s | {abs(end - orbit).max():.1e} (to the orbit) |")
    print(f"| softstop, one step | none | {at_once:.4f} s | {abs(single - end).max():.1e} |")
    points = []
    for halving in range(halvings + 1):
        inner = COMMUNICATION_STEP / 2**halving
        state, seconds = fixed.run({"h": inner}, repeats=3 if halving < 8 else 1)
        points.append((inner, seconds, abs(state - end).max()))
        print(f"| fixed step | {inner:.2e} s | {seconds:.3f} s | {points[-1][2]:.1e} |", flush=True)
    extrapolate(points)


def extrapolate(points):
    """What the error and the time of the finest runs let one expect at the target."""
    inner, seconds, errors = np.array(points[-min(6, len(points)):]).T
    order, level = np.polyfit(np.log(inner), np.log(errors), 1)
    needed = math.exp((math.log(TARGET) - level) / order)
    print(f"\nOrder seen over the last {len(inner)} rows: {order:.2f}. ", end="")
    if min(error for _, _, error in points) <= TARGET:
        print(f"{TARGET:g} is reached.")
    else:
        print(
            f"Extrapolated, not measured: {TARGET:g} would need an inner step of {needed:.1e} s "
            f"and {seconds[-1] * inner[-1] / needed:.1e} s of time."
        )


def main():
    halvings = int(sys.argv[2]) if len(sys.argv) > 2 else 12
    with tempfile.TemporaryDirectory() as folder:
        table(sys.argv[1], halvings, folder)


if __name__ == "__main__":
    main()
