"""The studies of docs/system.md: the coupling converges as it should, strips that fail leave z = 1 alone, and the fold of
the zone is where a motor jumps."""

import os
import pathlib
import sys

import pytest
from packages import TOP

sys.path.insert(0, str(TOP / "examples"))

from piercing_machine import COUPLINGS, Package  # noqa: E402
from piercing_studies import DETAILS, MOTOR, Machine, study  # noqa: E402

PROGRAM = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", TOP / "target")) / "release" / "softstop"


@pytest.fixture
def ssp(path):
    return str(pathlib.Path(path).with_name("piercing-machine.ssp"))


def draft(name, ssp, folder, **details):
    """The tables of a study that looks coarsely, its files written."""
    tables = study(name, ssp, folder, PROGRAM, DETAILS[name][1] | details)
    for file in folder.iterdir():
        assert len(file.read_text(encoding="utf-8").splitlines()) > 2, file
    assert [file.stem for file in folder.glob("*.svg")] == ([] if name == "strips" else [name])
    assert sorted(file.stem for file in folder.glob("*.csv")) == sorted(tables)
    return tables


def test_plain_steps_are_of_order_one_the_others_of_order_two(ssp, tmp_path):
    orders = draft("order", ssp, tmp_path)["order-seen"]
    assert [it["coupling"] for it in orders] == COUPLINGS
    assert [it["order"] for it in orders] == pytest.approx([1.0, 2.0, 2.0], abs=0.15)


def test_strips_that_fail_cost_no_stroke_away_from_the_fold(ssp, tmp_path):
    """As the paper says of its machine (Peterka 2003, section 5), and on a motor as well: not near the fold."""
    tables = draft("strips", ssp, tmp_path, frequencies=1)
    assert len(tables["strips"]) > 20
    for run in tables["strips"]:
        assert (run["fate"], run["missed"]) == ("no stroke missed", 0), run
    for run in tables["strips-chance"]:
        assert run["strokes missed"] == 0, run


def test_only_a_slow_run_up_lands_in_z_1_and_a_motor_jumps(ssp, tmp_path):
    """A fast rise of the voltage passes the resonance without impacts, a slow one lands in z = 1. A soft motor climbs with
    impacts up to a fold and comes down without (Sommerfeld 1902)."""
    tables = draft("run-up", ssp, tmp_path)
    for run in tables["run-up"]:
        assert run["end"] == ("no impacts" if run["rise (s)"] < 100.0 else "lands in z = 1"), run
    up, down = (it["speed (rad/s)"] for it in tables["run-up-voltage"] if it["voltage"] == pytest.approx(1.0, abs=1e-9))
    assert up == pytest.approx(1.15, abs=5e-3)
    assert down > 1.5


def test_the_energies_of_all_units_balance(ssp, tmp_path):
    """What the motor has supplied over a thousand periods, strips failing by chance, is in the rotor or in the press, or
    dissipated there."""
    machine = Machine(Package(ssp, tmp_path))
    with machine.begin(MOTOR, {("feeder", "supply.model"): 3, ("feeder", "supply.probability"): 0.9}) as system:
        def kept():
            press = [system.get("press", f"energy.{name}") for name in ("mechanical", "dissipated")]
            return sum(press) + system.get("drive", "energy.kinetic")

        begin = kept()
        system.go_to(1000 * machine.period, machine.period / 16)
        supplied = system.get("drive", "energy.supplied")
        assert supplied > 1e4
        assert system.get("press", "impact.count") > 990
        assert abs(supplied - (kept() - begin)) < 1e-6 * supplied
