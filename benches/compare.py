#!/usr/bin/env python3
"""Speed of this checkout beside an older build and a prototype, by turns, with ratios.

Each round runs `softstop-lab throughput` of this checkout, then the prototype's `sweep`, then `throughput` of the
older build, and `softstop optimize` of both for its processor time; figures are medians of all rounds. Nothing
of softstop is built here: `cargo build --profile dist -p softstop -p softstop-lab` does that.

The prototype counts processor time, softstop time on the wall: ratios to the prototype hold on an idle machine alone.
Both run the unloaded machine at 1,000 frequencies eta in 0.95..1.4, 200 periods each from (0, 14): the prototype, which
starts from (6.9, 9.5), is compiled with that start instead."""

import argparse
import json
import os
import resource
import shutil
import subprocess
import sys
import tempfile
from collections import defaultdict
from pathlib import Path
from statistics import median

EXAMPLES = """examples:
  python3 benches/compare.py
  python3 benches/compare.py --against ../softstop-0.1.0/target/release/softstop --prototype ../shared/bench
  python3 benches/compare.py --program target/dist/softstop-lab --rounds 11 --no-optimize"""
TOP = Path(__file__).resolve().parent.parent
COMPILE = "g++ -O3 -march=native -Wno-psabi -ffp-contract=fast".split()
# The prototype's start, and that of `throughput`.
STARTS = {"6.9": "0.0", "9.5": "14.0"}
OPTIMIZE = "optimize, processor s"
# Each rate with the prototype's method that it is measured by.
RATES = {
    "lanes, widest": "exact-simd24",
    "lanes, each impact": "exact-simd24",
    "lanes, AVX2": "exact-simd24",
    "one lane": "exact-fast-scalar",
    "safe engine": "exact-libm",
}


def arguments():
    parser = argparse.ArgumentParser(
        description=__doc__, epilog=EXAMPLES, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--program", type=Path, metavar="PATH", help="this checkout's softstop-lab or softstop, or their folder [default: the newest in target/dist and target/release]")
    parser.add_argument("--against", type=Path, metavar="PATH", help="the same of an older build; of 0.1.0, softstop alone")
    parser.add_argument("--prototype", type=Path, metavar="DIR", help="folder of prototype.cpp; left out where there is no g++")
    parser.add_argument("--rounds", type=int, default=5, metavar="N", help="rounds that the medians are of [default: 5]")
    parser.add_argument("--no-optimize", action="store_true", help="leave out the optimiser, the longest part with 0.1.0")
    given = parser.parse_args()
    if given.rounds < 1:
        parser.error("--rounds: at least 1")
    return given


def output(command, **options):
    """What a command prints; ends with its own words if it fails."""
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, command))}: exit code {done.returncode}\n{done.stderr}")
    return done.stdout


def newest(name):
    """The newest program of this name that cargo has built here."""
    target = Path(os.environ.get("CARGO_TARGET_DIR", TOP / "target"))
    built = [program for profile in ("dist", "release") if (program := find(target / profile, name))]
    if not built:
        sys.exit(f"no {name} in {target}: build it (see --help), or name one by --program")
    return max(built, key=lambda program: program.stat().st_mtime)


def find(place, name):
    """A program in a folder, or beside another one."""
    folder = place if place.is_dir() else place.parent
    path = shutil.which(folder.resolve() / name)
    return Path(path) if path else None


def programs(place):
    """What measures and what optimises: until 0.1.0 one program did both."""
    softstop = find(place, "softstop")
    lab = find(place, "softstop-lab") or softstop
    if not lab:
        sys.exit(f"{place}: neither softstop-lab nor softstop is there")
    return lab, softstop


def throughput(program):
    """Forcing periods per second and core of each engine."""
    said = json.loads(output([program, "throughput", "--repeats", "3", "--format", "json"]))
    widest = said["batch"]
    avx2 = widest if widest["instructions"] == "AVX2" else said.get("avx2")
    engines = zip(RATES, (widest, said.get("each_impact"), avx2, said["scalar"], said["safe"]))
    return {name: engine["periods_per_second_per_core"] for name, engine in engines if engine}


def sweep(program):
    """The same of the prototype's methods."""
    lines = [json.loads(line) for line in output([program, "sweep"]).splitlines()]
    rates = {line["method"]: line["periods_per_s"] for line in lines}
    return {name: rates[method] for name, method in RATES.items()}


def spent():
    """Processor seconds of the commands run so far."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def optimize(program):
    """Processor seconds of one design, files included, without the report that 0.1.0 did not write."""
    alone = ["--no-report"] if "--no-report" in output([program, "optimize", "--help"]) else []
    before = spent()
    with tempfile.TemporaryDirectory() as folder:
        output([program, "optimize", *alone, "--output", f"{folder}/design"])
    return {OPTIMIZE: spent() - before}


def compile_prototype(source, folder):
    """The prototype's program, if it can be had."""
    if not shutil.which("g++"):
        return print("prototype left out: no g++", file=sys.stderr)
    code = (source / "prototype.cpp").read_text()
    for given, same in STARTS.items():
        code = code.replace(given, same)
    Path(folder, "prototype.cpp").write_text(code)
    include = f"-I{source.resolve()}"
    output([*COMPILE, include, f"{folder}/prototype.cpp", "-o", f"{folder}/prototype"])
    return f"{folder}/prototype"


def measure(given, folder):
    """All measurements: by who was measured, then by figure."""
    builds = {"this": programs(given.program or newest("softstop-lab"))}
    runs = [("this", throughput, builds["this"][0])]
    if prototype := given.prototype and compile_prototype(given.prototype, folder):
        runs.append(("prototype", sweep, prototype))
    if given.against:
        builds["older"] = programs(given.against)
        runs.append(("older", throughput, builds["older"][0]))
    if not given.no_optimize:
        runs += [(name, optimize, softstop) for name, (_, softstop) in builds.items() if softstop]
    found = defaultdict(lambda: defaultdict(list))
    for number in range(given.rounds):
        print(f"round {number + 1} of {given.rounds}", file=sys.stderr)
        for name, run, program in runs:
            for figure, value in run(program).items():
                found[name][figure].append(value)
    return found


def main():
    given = arguments()
    with tempfile.TemporaryDirectory() as folder:
        found = measure(given, folder)
    others = [name for name in ("older", "prototype") if name in found]
    titles = ["this", *others, *(f"this/{name}" for name in others)]
    print(f"{'million periods per s':24}" + "".join(f"{title:>16}" for title in titles))
    for figure, scale in [*((rate, 1e-6) for rate in RATES), (OPTIMIZE, 1.0)]:
        medians = {name: median(figures[figure]) * scale for name, figures in found.items() if figure in figures}
        if "this" not in medians:
            continue
        values = [medians.get(name) for name in ("this", *others)]
        ratios = [medians["this"] / value if value else None for value in values[1:]]
        cells = (f"{value:16.3f}" if value is not None else f"{'-':>16}" for value in values + ratios)
        print(f"{figure:24}" + "".join(cells))


if __name__ == "__main__":
    main()
