"""Certificates of `softstop prove` are proven again by a checker that shares no code, and falsified ones are refused."""

import copy
import json
import os
import pathlib
import random
import re
import subprocess
import sys

import pytest
from packages import TOP

PROGRAM = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", TOP / "target")) / "release" / "softstop"

PROOFS = {
    "A": ("A", "orbit", 1.15),
    "B": ("B", "orbit", 1.15),
    "s_SN": ("unloaded --at fold", "fold", 1.369035838588),
    "s_SN, loaded": ("loaded --at fold", "fold", 1.293033923644),
    "s_PD, loaded": ("loaded --set eta=1.05 --at flip", "flip", 1.003035060306),
    "row 2": ("--set eta=0.9526 --orbit 0/1 --at grazing", "grazing", 0.9526515600),
    "row 3": ("--set eta=0.95266 --orbit 2/21 --at fold", "fold", 0.9526554606),
    "row 4, flip": ("--set eta=0.95267 --orbit 1/10 --at flip", "flip", 0.9526586515),
    "row 5": ("--set eta=0.952663 --orbit 2/21 --at grazing", "grazing", 0.9526654103),
    "row 7": ("--set eta=0.9537 --orbit 1/10 --at grazing", "grazing", 0.9538025122),
    "row 8": ("--set eta=0.9545 --orbit 1/9 --at flip", "flip", 0.9540678329),
    "row 10": ("--set eta=0.956 --orbit 1/9 --at grazing", "grazing", 0.9561146515),
    "row 11": ("--set eta=0.984 --orbit 2/4 --at grazing", "grazing", 0.9830551379),
    "row 12": ("--set eta=0.9875 --orbit 2/3 --at grazing", "grazing", 0.9867788668),
    "row 13": ("--set eta=0.9885 --orbit 1/2 --at flip", "flip", 0.9884970438),
    "row 14": ("--set eta=1 --at flip", "flip", 0.9889070749),
    "row 15": ("--set eta=0.9889 --orbit 1/2 --at grazing", "grazing", 0.9889511313),
    "row 16": ("--set eta=0.99 --orbit 2/4 --at flip", "flip", 0.9927044886),
    "row 17": ("--set eta=1 --orbit 2/3 --at flip", "flip", 1.0054496515),
    "row 18": ("--at grazing", "grazing", 1.0444400439),
    "row 19": ("--at fold", "fold", 1.3690358386),
}
"""Rows are those of the paper's Table 1 that a motion's own bifurcation ends; docs/proof.md has the others."""

SCENES = ["kelvin-voigt", "kelvin-voigt-zero-force", "piecewise-linear", "piecewise-linear-unloading", "piercing", "rigid", "stiff"]


def prove(line, file):
    run = subprocess.run([PROGRAM, "prove", *line.split(), "--output", file], cwd=TOP, capture_output=True, text=True)
    assert run.returncode == 0, line + run.stderr
    return json.loads(file.read_text(encoding="utf-8"))


def check(file):
    return subprocess.run([sys.executable, TOP / "examples/check_certificate.py", file], capture_output=True, text=True)


def refuses(file, other, told):
    """Checks a falsified certificate: it has to be refused for this reason, not by an error of the checker."""
    file.write_text(json.dumps(other), encoding="utf-8")
    run = check(file)
    assert run.returncode == 1 and run.stderr.startswith("not proven: ") and told in run.stderr, run.stdout + run.stderr


@pytest.mark.parametrize("name", PROOFS)
def test_the_checker_agrees(name, tmp_path):
    line, claim, frequency = PROOFS[name]
    proof = prove(line, tmp_path / "proof.json")
    low, high = proof["frequency"]
    assert proof["claim"] == claim
    assert high - low < 1e-12 and low - 1e-10 < frequency < high + 1e-10
    run = check(tmp_path / "proof.json")
    assert run.returncode == 0, run.stdout + run.stderr


@pytest.mark.parametrize("scene", SCENES)
def test_every_linear_law_is_checked(scene, tmp_path):
    prove(f"docs/scenes/{scene}.toml", tmp_path / "proof.json")
    run = check(tmp_path / "proof.json")
    assert run.returncode == 0, run.stdout + run.stderr


def test_ten_random_designs(tmp_path):
    draw, proven = random.Random(2003), 0
    while proven < 10:
        values = {"clearance": draw.uniform(2, 18), "stop.stiffness": draw.uniform(3, 30), "damping": draw.uniform(0.01, 0.05),
                  "stop.preload": draw.uniform(0, 100), "contact.damping": draw.uniform(0.05, 0.3), "eta": draw.uniform(1.05, 1.3)}
        line = draw.choice(["unloaded", "loaded"]) + "".join(f" --set {key}={value}" for key, value in values.items())
        if subprocess.run([PROGRAM, "orbit", *line.split()], capture_output=True).returncode == 0:
            proof = prove(line, tmp_path / "proof.json")
            assert proof["stability"] == "stable"
            run = check(tmp_path / "proof.json")
            assert run.returncode == 0, line + run.stdout + run.stderr
            proven += 1


def falsified(proof):
    """Certificates in each of which one thing is wrong, with what the checker says of it."""
    def wrong(change, told):
        other = copy.deepcopy(proof)
        change(other)
        return other, told

    def move(box, index, share):
        def change(it):
            low, high = it[box][index]
            away = share * (high - low)
            it[box][index] = [low + away, high + away]
        return change

    yield wrong(lambda it: it.update(format="softstop certificate 2"), "format 'softstop certificate 2' is unknown")
    yield wrong(move("enclosure", 2, 1.5), "one motion in the box")
    yield wrong(move("unique", 0, 3.0), "the motion is the one in the box")
    yield wrong(lambda it: it.update(unique=it["enclosure"], enclosure=it["unique"]), "the motion is the one in the box")
    yield wrong(lambda it: it.update(trace=[x + 1e-6 for x in it["trace"]]), "trace")
    yield wrong(lambda it: it.update(determinant=[x - 1e-6 for x in it["determinant"]]), "determinant")
    yield wrong(lambda it: it.update(stability="unstable"), "stability")
    yield wrong(lambda it: it.update(impacts=2), "impacts")
    yield wrong(lambda it: it.update(frequency=[1.15000001, 1.15000001]), "one motion in the box")
    yield wrong(lambda it: it["laws"]["phases"][1]["law"].update(stiffness=8.001), "one motion in the box")
    yield wrong(lambda it: it["events"][0].update(phase=0), "one motion in the box")
    yield wrong(lambda it: it["laws"]["phases"][0]["guards"][0].update(to=[0]), "followed by its phase")
    yield wrong(lambda it: it["events"][1].update(division=[0.0, 5.303085917358474]), "nothing else happens on arc 1")
    yield wrong(lambda it: it["events"][1].update(division=it["events"][1]["division"][:-1]), "arc 1 is divided whole")

    def drop(it):
        """The motion without its contact, as if it passed the stop."""
        it["events"] = it["events"][1:]
        for box in ("unique", "enclosure"):
            it[box] = it[box][3:]
        it["impacts"] = 0
    yield wrong(drop, "one motion in the box")
    yield wrong(lambda it: it["events"][0].update(event="touch"), "a grazing touches once, all else never")
    yield wrong(lambda it: it.update(claim="grazing"), "a grazing touches once, all else never")
    yield wrong(lambda it: it.update(events=[]), "the motion is the one in the box")


def test_falsified_certificates_are_refused(tmp_path):
    proof = prove("A", tmp_path / "proof.json")
    for index, (other, told) in enumerate(falsified(proof)):
        refuses(tmp_path / f"{index}.json", other, told)


def test_numbers_may_have_no_point(tmp_path):
    """JSON does not tell 1.0 from 1."""
    proof = prove("--set stop.stiffness=8", tmp_path / "proof.json")
    text = re.sub(r"(\d)\.0\b", r"\1", json.dumps(proof))
    assert '"mass": 1,' in text
    (tmp_path / "whole.json").write_text(text, encoding="utf-8")
    run = check(tmp_path / "whole.json")
    assert run.returncode == 0, run.stdout + run.stderr


def test_a_shorter_period_is_found(tmp_path):
    """A motion z = 0 is called one of two drive periods."""
    proof = prove("--set eta=1.05 --orbit 0/1", tmp_path / "proof.json")
    division = proof["events"][0]["division"]
    proof["events"][0]["division"] = division + [division[-1] + it for it in division[1:]]
    proof["periods"] = 2
    refuses(tmp_path / "other.json", proof, "no shorter period")


def test_what_is_touched_is_a_surface(tmp_path):
    """A guard of position and velocity that is zero at a graze is not touched, but crossed."""
    proof = prove("--at grazing", tmp_path / "proof.json")
    proof["laws"]["phases"][0]["guards"][0]["velocity"] = 0.1
    refuses(tmp_path / "other.json", proof, "from a guard at zero")


def test_a_crossing_on_an_arc_is_found(tmp_path):
    """The stop of a motion z = 0 is moved into its way."""
    proof = prove("--set eta=1.05 --orbit 0/1", tmp_path / "proof.json")
    proof["laws"]["phases"][0]["guards"][0]["level"] = 9.0
    refuses(tmp_path / "other.json", proof, "nothing else happens on arc 0")


def test_a_crossing_left_out_is_found(tmp_path):
    """Of a motion with two impacts one is left out, and the arcs around it are joined."""
    proof = prove("--set eta=0.9875 --orbit 2/3", tmp_path / "proof.json")
    for first in range(0, 4):
        other = copy.deepcopy(proof)
        keep = [it for it in range(4) if it not in (first, (first + 1) % 4)]
        other["events"] = [other["events"][it] for it in keep]
        for box in ("unique", "enclosure"):
            other[box] = [it for at in keep for it in other[box][3 * at:3 * at + 3]]
        other["impacts"] = 1
        refuses(tmp_path / "other.json", other, "one motion in the box")
