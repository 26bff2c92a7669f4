"""The Python package beside the Rust lanes on the same motions, by turns: `python benches/python.py` in the top folder, after
`cargo build --release -p softstop-lanes --example rate`, with the wheel installed. Lowering the machines is part of both. Prints
the rates of medians, their ratio, and the ratio of first deciles, which other programs that run meanwhile hardly change."""

import statistics
import subprocess
import time

import numpy as np

import softstop as ss

CASES = [(1_000, 200, 100), (100_000, 200, 2)]
"""Motions, drive periods, repeats in each round."""
ROUNDS = 11


def rust(motions, periods, repeats):
    """Seconds of each repeat, and impacts."""
    words = ["target/release/examples/rate", *map(str, (motions, periods, repeats))]
    rows = [line.split() for line in subprocess.run(words, capture_output=True, text=True, check=True).stdout.splitlines()]
    return [float(seconds) for seconds, _ in rows], int(rows[0][1])


def python(motions, periods, repeats):
    """The same."""
    machine, eta = ss.Machine.unloaded(clearance=10), np.linspace(0.95, 1.4, motions)
    seconds = []
    for _ in range(repeats + 1):
        begin = time.perf_counter()
        batch = ss.simulate(machine, eta=eta, start=(0, 14), periods=periods, progress=False)
        seconds.append(time.perf_counter() - begin)
    return seconds[1:], int(batch.counts.sum())


for motions, periods, repeats in CASES:
    times, impacts = ([], []), [0, 0]
    for _ in range(ROUNDS):
        for index, run in enumerate((rust, python)):
            seconds, impacts[index] = run(motions, periods, repeats)
            times[index].extend(seconds)
    assert abs(impacts[0] - impacts[1]) <= 1e-4 * impacts[0], impacts
    lanes, package = map(statistics.median, times)
    fastest = [statistics.quantiles(each, n=10)[0] for each in times]
    print(f"{motions} motions x {periods} periods: lanes {motions * periods / lanes / 1e6:.1f}, "
          f"Python {motions * periods / package / 1e6:.1f} million periods a second; ratio of medians {lanes / package:.3f}, "
          f"of first deciles {fastest[0] / fastest[1]:.3f}")
