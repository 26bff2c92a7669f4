"""Every number is that of the program, to the last digit."""

import json
import re
import shlex

import numpy as np
import pytest
from conftest import TOP

import softstop as ss

A = {"eta": 1.15, "clearance": 10}
CALLS = {
    "orbit": (lambda m: ss.orbit(m), []),
    "zone": (lambda m: ss.zone(m), []),
    "motions": (lambda m: ss.motions(m, starts=64), ["--starts=64"]),
    "continue": (
        lambda m: ss.continue_(m, "clearance", (8, 12), double=1),
        ["--parameter=clearance", "--from=8", "--to=12", "--double=1"],
    ),
    "sweep": (lambda m: ss.sweep(m, (1.1, 1.2), steps=20), ["--from=1.1", "--to=1.2", "--steps=20"]),
    "basin": (
        lambda m: ss.basin(m, size=40, x=(0, 15), v=(-20, 20)),
        ["--size=40", "--x=0:15", "--v=-20:20"],
    ),
    "basin along eta": (
        lambda m: ss.basins(m, "eta", (1.1, 1.2), steps=3, size=20),
        ["--parameter=eta", "--from=1.1", "--to=1.2", "--steps=3", "--size=20"],
    ),
    "prove a motion": (lambda m: ss.prove(m), []),
    "prove a fold": (lambda m: ss.prove(m, at="fold"), ["--at=fold"]),
}


@pytest.mark.parametrize("name", ["unloaded", "loaded"])
@pytest.mark.parametrize("command", CALLS)
def test_numbers_are_those_of_the_program(program, tmp_path, name, command):
    call, options = CALLS[command]
    command = command.split()[0]
    machine = getattr(ss.Machine, name)(**A)
    result = call(machine)
    machine.save(tmp_path / "machine.toml")
    output = [] if command in ("orbit", "zone", "prove") else ["--output=out"]
    printed = json.loads(program(command, "machine.toml", *options, *output, "--format=json"))
    files = printed.pop("files", {})
    assert dict(result) == printed
    assert set(result.files) >= {path.split("/")[-1] for path in files.values()}
    for file, content in result.files.items():
        if file.endswith(".csv"):
            assert content == (tmp_path / "out" / file).read_bytes()


def test_a_branch_begins_at_a_point_of_an_earlier_one(program, tmp_path):
    machine = ss.Machine.unloaded(**A)
    machine.save(tmp_path / "machine.toml")
    earlier = ss.continue_(machine, "eta", (0.9, 1.5))
    words = ["continue", "machine.toml", "--format=json"]
    printed = program(*words, "--parameter=eta", "--from=0.9", "--to=1.5")
    (tmp_path / "earlier.json").write_text(printed, encoding="utf-8")
    for point in ["PD", "SN", np.int64(7)]:
        branch = ss.continue_(machine, "rho", (5, 15), from_point=(earlier, point))
        line = ["--parameter=rho", "--from=5", "--to=15", f"--from-point=earlier.json:{point}"]
        printed = json.loads(program(*words, *line))
        printed.pop("files")
        assert dict(branch) == printed
    with pytest.raises(ss.MachineError, match="clearance"):
        ss.continue_(machine.replace(clearance=11), "rho", (5, 15), from_point=(earlier, "PD"))
    for wrong in [("SN", earlier), (earlier, True), (earlier, 1.5), earlier]:
        with pytest.raises(ss.MachineError, match="from_point"):
            ss.continue_(machine, "rho", (5, 15), from_point=wrong)


def test_a_machine_of_a_file_is_the_machine_of_the_program(program):
    for file in sorted((TOP / "docs/scenes").glob("*.toml")):
        machine = ss.read(file)
        assert machine.name == file.stem
        assert ss.Machine.from_toml(machine.to_toml()) == machine
    for file in ["docs/press/press.toml", "docs/scenes/hertz.toml"]:
        printed = json.loads(program("orbit", TOP / file, "--format=json"))
        assert dict(ss.orbit(ss.read(TOP / file))) == printed


def test_optimize_finds_the_design_of_the_program(program, tmp_path):
    task = {"machine": "loaded", "vary": {"stop.stiffness": 7.0, "clearance": [2, 22]}, "require": {"margin": 0.1}}
    design = ss.optimize(task)
    (tmp_path / "task.toml").write_text(
        'machine = "loaded"\n[vary]\nstop.stiffness = 7.0\nclearance = [2, 22]\n[require]\nmargin = 0.1\n'
    )
    printed = json.loads(program("optimize", "--config=task.toml", "--no-report", "--format=json"))
    printed.pop("files")
    assert dict(design) == printed
    motion = ss.simulate(design.machine, periods=10)
    assert motion.impacts["velocity"] == pytest.approx(printed["design"]["before_impact_velocity"], rel=1e-11)
    design.fmu(tmp_path / "design.fmu")
    design.machine.fmu(tmp_path / "machine.fmu")
    assert (tmp_path / "design.fmu").read_bytes() == (tmp_path / "machine.fmu").read_bytes()


def test_study_of_a_machine(program):
    axis = {"parameter": "eta", "from": 0.9, "to": 1.3, "count": 9}
    result = ss.study({"outputs": ["velocity"], "axis": [axis]}, machine=ss.Machine.unloaded(clearance=10))
    table = result.tables["study"]
    assert len(table) == 9
    alone = ss.orbit(ss.Machine.unloaded(eta=1.15, clearance=10)).before_impact_velocity
    assert table["velocity"][5] == pytest.approx(alone, rel=1e-9)


def lines():
    """The commands of the tutorials, page after page."""
    pages = sorted((TOP / "docs/tutorials").glob("*.md"))
    found = [re.findall(r"^    softstop (.+)$", page.read_text(encoding="utf-8"), re.MULTILINE) for page in pages]
    return [line for page in found for line in page if line.split()[0] in CALLED]


def number(word):
    """A word of a command line as Python has it."""
    try:
        return float(word)
    except ValueError:
        return word


def asked(words):
    """Machine and options of a command's words."""
    words = [part for word in words for part in (word.split("=", 1) if word.startswith("--") else [word])]
    machine, options, changes = ss.Machine.unloaded(), {}, {}
    while words:
        word = words.pop(0)
        if word == "--set":
            key, value = words.pop(0).split("=")
            changes[key] = number(value)
        elif word.startswith("--"):
            options[word[2:].replace("-", "_")] = words.pop(0)
        else:
            machine = ss.read(word)
    return machine.replace(changes), options


def between(options):
    return float(options["from"]), float(options["to"])


def plane(options):
    return {name: tuple(map(float, options[name].split(":"))) for name in ("x", "v") if name in options}


CALLED = {
    "orbit": lambda machine, options: ss.orbit(machine),
    "continue": lambda machine, options: ss.continue_(
        machine, options["parameter"], between(options), orbit=options.get("orbit")
    ),
    "sweep": lambda machine, options: ss.sweep(machine, between(options)),
    "motions": lambda machine, options: ss.motions(machine),
    "basin": lambda machine, options: ss.basin(machine, size=int(options["size"]), **plane(options)),
    "simulate": lambda machine, options: ss.simulate(machine, periods=int(options["periods"])),
    "optimize": None,
}


def test_commands_of_the_tutorials(program, tmp_path, monkeypatch):
    """In the order of the pages, since one command reads what another has written."""
    (tmp_path / "docs").symlink_to(TOP / "docs")
    monkeypatch.chdir(tmp_path)
    assert {line.split()[0] for line in lines()} == set(CALLED)
    for line in lines():
        command, *words = shlex.split(line)
        # A shorter search takes less time, and its numbers have as many digits.
        extra = ["--no-report", "--evaluations=100", "--samples=4096"] if command == "optimize" else []
        printed = json.loads(program(command, *words, *extra, "--format=json"))
        printed.pop("files", None)
        if command == "optimize":
            assert dict(ss.optimize(words[0], evaluations=100, samples=4096)) == printed, line
            continue
        result = CALLED[command](*asked(words))
        if command != "simulate":
            assert dict(result) == printed, line
            continue
        table = ss.Table.of_csv((tmp_path / "softstop-motion/crossings.csv").read_text(encoding="utf-8"))
        for own, theirs in [("time", "time"), ("position", "position"), ("velocity", "velocity_before"), ("velocity_after",) * 2]:
            np.testing.assert_array_equal(result.crossings[own], table[theirs], line)
        assert result.end == (printed["end"]["position"], printed["end"]["velocity"])
        assert len(result.impacts) == printed["impacts"]["count"]
        assert result.impacts.velocity.max() == printed["impacts"]["before_impact_velocity"]
        for name, energy in result.energies.items():
            assert energy == printed["energy"][name], name
