"""Runs `softstop` on random machines, and on damaged files, under limits of processor time and memory.

    python3 tests/ends/run.py machines --count 10000 --seed 1
    python3 tests/ends/run.py files --count 10000 --seed 1

`machines` changes numbers of the scenes and studies in docs and gives each machine that the program accepts to `orbit`,
`simulate`, `motions` and a study of 9 points. `files` changes bytes of all TOML files in docs and tests. A run is well if
it ends by itself within the limits: with an answer, or with a message that says why there is none.
"""

import argparse
import functools
import json
import math
import os
import random
import resource
import shutil
import subprocess
import sys
import tempfile
import time
import tomllib
from collections import Counter
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
SECONDS, MEGABYTES = 10, 500
# What the program says where the budget is spent, and where a panic happens.
OVER, PANIC = "not settled within", "panicked"


class Tally:
    """What became of runs."""

    def __init__(self):
        self.ends, self.slowest, self.largest, self.bad = Counter(), {}, {}, []

    def run(self, command, words, keep):
        """Runs the program; its exit code. `keep` is told of a run that is not well."""
        with tempfile.TemporaryFile() as said:
            child = subprocess.Popen(
                [*PROGRAM, command, *words], stdout=said, stderr=said, preexec_fn=limit, env=ENVIRONMENT
            )
            _, status, used = os.wait4(child.pid, 0)
            child.returncode = os.waitstatus_to_exitcode(status)
            said.seek(0)
            text = said.read().decode(errors="replace")
        seconds, megabytes = used.ru_utime + used.ru_stime, used.ru_maxrss / 1024
        code = child.returncode
        over = OVER in text
        end = {0: "answered", 1: "said why", 2: "refused"}.get(code, f"ended by {code}")
        end = "said why" if over else end
        if PANIC in text:
            end = "panicked"
        self.ends[command, end] += 1
        self.ends[command, "over budget"] += over
        if code != 2:
            self.slowest[command] = max(self.slowest.get(command, (0, "")), (seconds, " ".join(words)))
            self.largest[command] = max(self.largest.get(command, 0), megabytes)
        if code not in (0, 1, 2) or PANIC in text or seconds > SECONDS or megabytes > MEGABYTES:
            self.bad.append(f"{command} {' '.join(map(str, words))}: {end}, {seconds:.1f} s, {megabytes:.0f} MB")
            print(self.bad[-1], keep(), text[-300:], flush=True)
        return code

    def report(self):
        for (command, end), count in sorted(self.ends.items()):
            if count:
                print(f"{command:>9} {end:<12} {count}")
        for command, (seconds, _) in sorted(self.slowest.items()):
            print(f"{command:>9} slowest {seconds:.2f} s, largest {self.largest[command]:.0f} MB")
        print(f"{len(self.bad)} runs are not well")


def limit():
    """One worker process: what goes beyond twice the limits is ended from outside."""
    resource.setrlimit(resource.RLIMIT_CPU, (2 * SECONDS, 2 * SECONDS + 1))
    resource.setrlimit(resource.RLIMIT_AS, (4 * MEGABYTES << 20,) * 2)


def changed(value, draw):
    """Another number: near, far, or special."""
    kind = draw.random()
    if kind < 0.35:
        return value * 10 ** draw.uniform(-1, 1)
    if kind < 0.75:
        return (value or 1.0) * 10 ** draw.uniform(-8, 8)
    if kind < 0.85:
        return 0.0
    if kind < 0.92:
        return -value
    return draw.choice([1e-300, 1e-12, 1e-3, 0.5, 1.0, 2.0, 1e3, 1e12, 1e300])


def numbers(table, path=()):
    """Places of all numbers in a table."""
    items = table.items() if isinstance(table, dict) else enumerate(table)
    for key, value in items:
        if isinstance(value, (dict, list)):
            yield from numbers(value, (*path, key))
        elif isinstance(value, (int, float)) and not isinstance(value, bool):
            yield (*path, key)


def at(table, path):
    for key in path:
        table = table[key]
    return table


def mutate(table, draw):
    """Changes some of the numbers of a table."""
    places = list(numbers(table))
    for path in draw.sample(places, min(len(places), draw.choice([1, 1, 2, 2, 3, 4]))):
        at(table, path[:-1])[path[-1]] = changed(float(at(table, path)), draw)


def toml(value):
    """A value in one line of TOML."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {toml(one)}" for key, one in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'
    return repr(value)


def document(table):
    return "".join(f"{key} = {toml(value)}\n" for key, value in table.items())


def key(path):
    return ".".join(map(str, path))


def axis(machine, path, draw):
    """An axis about a number of a machine, over decades or a narrow range."""
    middle = abs(float(at(machine, path))) or 1.0
    low = middle * 10 ** draw.choice([-5.0, -1.0, -0.1, draw.uniform(-12, 0)])
    high = middle * 10 ** draw.choice([0.1, 1.0, draw.uniform(0, 6)])
    return {"parameter": key(path), "from": low, "to": high, "count": 3, "scale": draw.choice(["linear", "log"])}


@functools.cache
def all_outputs():
    """The names of what a study can have."""
    said = subprocess.run([*PROGRAM, "schema", "study"], capture_output=True, check=True).stdout
    return json.loads(said)["properties"]["outputs"]["items"]["enum"]


def study(machine, draw):
    """A study of 9 points of a machine beside it."""
    places = [path for path in numbers(machine) if not any(isinstance(part, int) for part in path)]
    if len(places) < 2:
        return None
    axes = [axis(machine, path, draw) for path in draw.sample(places, 2)]
    outputs = ["z", "velocity"] if draw.random() < 0.5 else draw.sample(all_outputs(), draw.randint(1, 5))
    return {"machine": "machine.toml", "outputs": outputs, "axis": axes}


def machines(count, draw, folder, tally, until):
    scenes = [tomllib.loads(path.read_text()) for path in sorted(TOP.glob("docs/scenes/*.toml"))]
    studies = [tomllib.loads(path.read_text()) for path in sorted(TOP.glob("docs/studies/*.toml"))]
    accepted = 0
    file, plan = folder / "machine.toml", folder / "study.toml"

    def keep():
        kept = Path(tempfile.mkdtemp(prefix="ends-"))
        for one in (file, plan):
            if one.exists():
                shutil.copy(one, kept)
        return kept

    while accepted < count and time.time() < until:
        machine = tomllib.loads(document(draw.choice(scenes)))
        mutate(machine, draw)
        file.write_text(document(machine))
        simulate = ["--periods", "100", "--samples-per-period", "10", "--output", str(folder / "motion")]
        if tally.run("simulate", [str(file), *simulate], keep) == 2:
            continue
        accepted += 1
        start = machine.pop("initial", None)
        tally.run("orbit", [str(file)], keep)
        tally.run("motions", [str(file)], keep)
        if start:
            machine["initial"] = start
        nine = study(machine, draw)
        if draw.random() < 0.2:
            nine = tomllib.loads(document(draw.choice(studies)))
            for one in nine["axis"]:
                one.pop("values", None)
                one.pop("sample", None)
                one.update({"from": one.get("from", 0.5), "to": one.get("to", 2.0), "count": 3})
            nine["axis"] = nine["axis"][:2]
            nine.pop("samples", None)
            nine["machine"] = draw.choice(["unloaded", "loaded"])
            for one in nine["axis"]:
                one["from"] = changed(one["from"], draw)
                one["to"] = max(one["from"], changed(one["to"], draw))
        if nine:
            plan.write_text(document(nine))
            tally.run("study", [str(plan), "--output", str(folder / "study")], keep)
    return accepted


def files(count, draw, folder, tally, until):
    sources = [path.read_bytes() for path in sorted([*TOP.glob("docs/**/*.toml"), *TOP.glob("tests/**/*.toml")])]
    digits = b"0123456789.-e+[]{}\"'=#\n, _aN"
    done, file = 0, folder / "file.toml"

    def keep():
        return shutil.copy(file, tempfile.mkdtemp(prefix="ends-"))

    while done < count and time.time() < until:
        text = bytearray(draw.choice(sources))
        for _ in range(draw.choice([1, 1, 2, 4, 16])):
            place, kind = draw.randrange(len(text) + 1), draw.random()
            if kind < 0.3 and place < len(text):
                text[place] = draw.choice(digits) if draw.random() < 0.8 else draw.randrange(256)
            elif kind < 0.5:
                del text[place : place + draw.choice([1, 1, 4, 64])]
            elif kind < 0.8:
                text[place:place] = bytes(draw.choice(digits) for _ in range(draw.choice([1, 1, 3, 40])))
            else:
                text[place:place] = text[: draw.randrange(len(text) + 1)]
            if not text:
                text = bytearray(b"=")
        file.write_bytes(text)
        command = draw.choice(["orbit", "simulate", "study", "optimize"])
        words = {
            "orbit": [str(file)],
            "simulate": [str(file), "--periods", "5", "--samples-per-period", "10", "--output", str(folder / "m")],
            "study": [str(file), "--output", str(folder / "s")],
            "optimize": ["--config", str(file), "--output", str(folder / "o")],
        }[command]
        if command in ("study", "optimize") and tally_skips(command, text):
            command, words = "orbit", [str(file)]
        tally.run(command, words, keep)
        done += 1
    return done


def tally_skips(command, text):
    """True for what may be asked to compute for long: a study of many points, or a good task of a design."""
    try:
        table = tomllib.loads(text.decode())
    except (ValueError, RecursionError):
        return False
    if command == "optimize":
        return "axis" not in table and "mass" not in table and "ratios" not in table
    axes = table.get("axis", [])
    if not isinstance(axes, list):
        return False
    counts = [one.get("count", 1) for one in axes if isinstance(one, dict)]
    counts = [one for one in [*counts, table.get("samples", 1)] if isinstance(one, (int, float))]
    return not math.prod(counts) < 100


def main():
    global PROGRAM, ENVIRONMENT
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["machines", "files"])
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--minutes", type=float, default=math.inf, help="end after this time")
    parser.add_argument("--program", default=str(TOP / "target/release/softstop"))
    arguments = parser.parse_args()
    PROGRAM = [arguments.program]
    ENVIRONMENT = os.environ | {"RAYON_NUM_THREADS": "1"}
    draw, tally = random.Random(arguments.seed), Tally()
    until = time.time() + 60 * arguments.minutes
    with tempfile.TemporaryDirectory() as folder:
        run = {"machines": machines, "files": files}[arguments.what]
        done = run(arguments.count, draw, Path(folder), tally, until)
    print(f"{done} {arguments.what}, seed {arguments.seed}")
    tally.report()
    sys.exit(bool(tally.bad))


if __name__ == "__main__":
    main()
