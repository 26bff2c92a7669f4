"""Every number is that of the program, to the last digit."""

import json

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
}


@pytest.mark.parametrize("name", ["unloaded", "loaded"])
@pytest.mark.parametrize("command", CALLS)
def test_numbers_are_those_of_the_program(program, tmp_path, name, command):
    call, options = CALLS[command]
    machine = getattr(ss.Machine, name)(**A)
    result = call(machine)
    machine.save(tmp_path / "machine.toml")
    output = [] if command in ("orbit", "zone") else ["--output=out"]
    printed = json.loads(program(command, "machine.toml", *options, *output, "--format=json"))
    files = printed.pop("files", {})
    assert dict(result) == printed
    assert set(result.files) >= {path.split("/")[-1] for path in files.values()}
    for file, content in result.files.items():
        if file.endswith(".csv"):
            assert content == (tmp_path / "out" / file).read_bytes()


def test_a_machine_of_a_file_is_the_machine_of_the_program(program):
    for file in sorted((TOP / "docs/scenes").glob("*.toml")):
        machine = ss.read(file)
        assert ss.Machine.from_toml(machine.to_toml()) == machine
    press = ss.read(TOP / "docs/press/press.toml")
    printed = json.loads(program("orbit", TOP / "docs/press/press.toml", "--format=json"))
    assert dict(ss.orbit(press)) == printed


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
    assert (tmp_path / "design.fmu").read_bytes()[:2] == b"PK"
    with pytest.raises(ss.MachineError, match="report=True"):
        design.report(tmp_path / "report.html")


def test_study_of_a_machine(program):
    axis = {"parameter": "eta", "from": 0.9, "to": 1.3, "count": 9}
    result = ss.study({"outputs": ["velocity"], "axis": [axis]}, machine=ss.Machine.unloaded(clearance=10))
    table = result.tables["study"]
    assert len(table) == 9
    alone = ss.orbit(ss.Machine.unloaded(eta=1.15, clearance=10)).before_impact_velocity
    assert table["velocity"][5] == pytest.approx(alone, rel=1e-9)
