#!/usr/bin/env python3
"""The optimiser beside what a user does today: FMPy and scipy's differential evolution on the FMU of the same machine.

Each task (benches/design/*.toml) is one file for both. For each seed, `benches/design/user.py` searches by
simulations and `softstop optimize`, which needs no seed, by zones; then `softstop orbit` and `softstop zone` of each design say whether
it is what was claimed: a stable z = 1 motion as fast as that (to 1e-4), with the margins that the task requires
(to 1e-6 of them). Seconds are processor time of the whole command, user and system, start of Python included. The
optimiser uses all cores, the user's script one. Some two minutes of processor time.

Nothing of softstop is built here: `cargo build --release -p softstop` does that. The Python that runs this needs
FMPy and scipy: `pip install -r tests/fmpy/requirements.txt`, or the environment of `cargo xtask test`, target/python."""

import argparse
import importlib.util
import json
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

from compare import TOP, find, newest, output, spent

EXAMPLES = """examples:
  target/python/bin/python benches/design.py
  target/python/bin/python benches/design.py press --seeds 1 --json design.json
  target/python/bin/python benches/design.py --program target/dist/softstop"""
TASKS = TOP / "benches/design"
VELOCITY, MARGIN = 1e-4, 1e-6
FREQUENCY = "excitation.frequency"
USER, SOFTSTOP = "FMPy + scipy", "softstop"


def arguments():
    parser = argparse.ArgumentParser(
        description=__doc__, epilog=EXAMPLES, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    known = sorted(path.stem for path in TASKS.glob("*.toml"))
    parser.add_argument("tasks", nargs="*", metavar="TASK", help=f"of {', '.join(known)} [default: all]")
    parser.add_argument("--program", type=Path, metavar="PATH", help="softstop, or its folder [default: the newest in target/dist and target/release]")
    parser.add_argument("--seeds", type=int, default=3, metavar="N", help="searches with seeds 0 to N - 1 [default: 3]")
    parser.add_argument("--tol", type=float, default=0.01, metavar="T", help="tolerance of scipy's search [default: 0.01, scipy's]")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write all results there")
    given = parser.parse_args()
    if given.seeds < 1:
        parser.error("--seeds: at least 1")
    if unknown := set(given.tasks) - set(known):
        parser.error(f"TASK {', '.join(sorted(unknown))}: must be of {', '.join(known)}")
    if missing := [name for name in ("fmpy", "scipy") if not importlib.util.find_spec(name)]:
        parser.error(f"no {' and no '.join(missing)} here: pip install -r tests/fmpy/requirements.txt")
    given.tasks = given.tasks or known
    given.program = find(given.program, "softstop") if given.program else newest("softstop")
    if not given.program:
        parser.error("--program: no softstop there")
    return given


def timed(command):
    """What a command says in JSON, and its processor seconds."""
    before = spent()
    said = json.loads(output(command))
    return said, spent() - before


def by_user(task, unit, seed, tol):
    """A design of the user's script."""
    said, seconds = timed([sys.executable, TASKS / "user.py", task, unit, str(seed), str(tol)])
    return {**said, "way": USER, "seconds": seconds}


def by_softstop(program, task, folder, varied):
    """A design of the optimiser."""
    said, seconds = timed(
        [program, "optimize", task, "--no-report", "--format", "json", "--output", folder]
    )
    design = said["design"]
    return {
        "design": {name: design["machine"]["parameters"][name] for name in varied},
        "velocity": design["before_impact_velocity"],
        "zones": said["search"]["evaluations_used"],
        "way": SOFTSTOP,
        "seconds": seconds,
    }


def verified(program, task, required, found):
    """What the exact engine says of a design, and what of the claim it does not confirm."""
    def say(command, design):
        values = [word for name, value in design.items() for word in ("--set", f"{name}={value!r}")]
        done = subprocess.run([program, command, task, *values, "--format", "json"], capture_output=True, text=True)
        return json.loads(done.stdout) if done.returncode == 0 else {}

    orbit = say("orbit", found["design"])
    # A zone is a range of frequencies: it takes none.
    zone = say("zone", {name: value for name, value in found["design"].items() if not name.startswith(FREQUENCY)})
    exact = {
        "stability": orbit.get("stability"),
        "velocity": orbit.get("before_impact_velocity"),
        "margin_g0": difference(orbit.get("frequency"), zone.get("frequency_g0")),
        "margin_sn": difference(zone.get("frequency_sn"), orbit.get("frequency")),
    }
    wrong = [name for name, least in required.items() if exact[name] is None or exact[name] < least * (1 - MARGIN)]
    if exact["stability"] != "stable":
        wrong.append("stability")
    elif abs(found["velocity"] - exact["velocity"]) > VELOCITY * exact["velocity"]:
        wrong.append("velocity")
    return {**found, "exact": exact, "wrong": wrong}


def difference(one, other):
    """Of two numbers that may be missing."""
    return None if one is None or other is None else one - other


def searches(given, name, folder):
    """All designs of a task."""
    path = TASKS / f"{name}.toml"
    task = tomllib.loads(path.read_text())
    unit = f"{folder}/{name}.fmu"
    output([given.program, "fmu", path, "--output", unit])
    for seed in range(given.seeds):
        print(f"{name}, seed {seed}", file=sys.stderr)
        user = by_user(path, unit, seed, given.tol)
        for found in (user, by_softstop(given.program, path, f"{folder}/{name}-{seed}", user["design"])):
            yield {"task": name, "seed": seed, **verified(given.program, path, task["require"], found)}


def effort(found):
    """What a search took."""
    if found["way"] == USER:
        return f"{found['periods']:,} periods"
    return f"{found['zones']:,} zones"


def table(results):
    """One line for each design."""
    yield f"{'task':8}{'seed':>5}  {'way':14}{'seconds':>9}{'effort':>20}{'claimed':>11}{'exact':>11}{'g0':>11}{'s_SN':>11}  claim"
    for found in results:
        figures = [found["velocity"], *(found["exact"][name] for name in ("velocity", "margin_g0", "margin_sn"))]
        cells = (f"{'-':>11}" if figure is None else f"{figure:11.6f}" for figure in figures)
        claim = f"wrong: {', '.join(found['wrong'])}" if found["wrong"] else "holds"
        line = f"{found['task']:8}{found['seed']:5}  {found['way']:14}{found['seconds']:9.2f}{effort(found):>20}"
        yield f"{line}{''.join(cells)}  {claim}"


def ratios(results):
    """Processor time and best velocity of both ways, task by task."""
    for name in dict.fromkeys(found["task"] for found in results):
        seconds, best = {}, {}
        for way in (USER, SOFTSTOP):
            own = [found for found in results if (found["task"], found["way"]) == (name, way)]
            seconds[way] = min(found["seconds"] for found in own)
            best[way] = max((found["exact"]["velocity"] for found in own if not found["wrong"]), default=None)
        yield {"task": name, "seconds": seconds, "ratio": seconds[USER] / seconds[SOFTSTOP], "best": best}


def main():
    given = arguments()
    with tempfile.TemporaryDirectory() as folder:
        results = [found for name in given.tasks for found in searches(given, name, folder)]
    print("\n".join(table(results)), end="\n\n")
    compared = list(ratios(results))
    for line in compared:
        best = ", ".join(f"{way} {velocity:.6f}" if velocity else f"{way} none" for way, velocity in line["best"].items())
        print(f"{line['task']}: {line['ratio']:.1f} times the processor time (least of all seeds); best that holds: {best}")
    if given.json:
        given.json.write_text(json.dumps({"designs": results, "compared": compared}, indent=2) + "\n")


if __name__ == "__main__":
    main()
