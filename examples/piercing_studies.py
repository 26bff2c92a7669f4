"""Studies of piercing-machine.ssp, the paper's machine B with drive and feeder: tables (CSV), and a picture (SVG) of
the latter two.

    python examples/piercing_studies.py strips     strips fail in runs, at every drive angle, and by chance
    python examples/piercing_studies.py run-up     which torque passes the resonance and lands in z = 1; how a motor jumps
    python examples/piercing_studies.py order      error of the coupling over the step of the master

docs/system.md tells what is to be seen. `strips` asks the program softstop for the zone of z = 1 and for its motions.
"""

import argparse
import csv
import functools
import json
import math
import multiprocessing
import pathlib
import subprocess
import tempfile

import piercing_charts
from piercing_machine import COUPLINGS, DERIVATIVES, PLAIN, ROLL_BACK, Package, System

TORQUE = 60.0
"""Torque at rest of the motor in N m, as in the SSP."""
IDEAL, MOTOR = DRIVES = ["ideal drive", "motor"]

# Strips.
MISSING, PROBABILITIES = [0, 1, 2, 4, 8, 16], [0.9, 0.7, 0.5]
"""Strips that fail in a row, and probabilities that a stroke gets one."""
SHARES = 0.7, 1.0
"""Part of the zone that is looked at, as shares of the way from g0 to s_SN."""
STEPS = 24
"""Steps of the master in a drive period."""
BEFORE, AFTER = 5, 80
"""Strokes with a strip before the first that fails, and after the last."""
JUDGED, ALIKE, GAP = 16, 0.02, 1.5
"""Last intervals between impacts that must be a turn, by how much they may differ, and from where on a stroke was missed."""
KEPT, BACK, LOST = FATES = ["no stroke missed", "strokes missed, z = 1 again", "z = 1 lost"]

# Running up.
TORQUES, RISES = (1.1, 30.0), (20.0, 1000.0)
"""Torques at rest in units of what z = 1 takes, and times in s in which the voltage rises."""
STEP, SETTLED, MEASURED, SAME_SPEED = 0.1, 400.0, 150.0, 5e-3
"""Step in s, times in s after which and over which the motion is judged, and share by which its speed may differ."""
SOFT, VOLTAGES = 3.0, (0.6, 2.2)
"""Torque of the motor that goes up and down, and its voltages."""
LANDS, PASSES, OTHER = ENDS = ["lands in z = 1", "no impacts", "another motion"]

# Order of the coupling.
FINEST, LARGEST, END = 0.000_390_625, 0.2, 12.0
"""Step of the reference and largest step of the study, and the time at which both are judged, in s."""

DETAILS = {
    "strips": ({"frequencies": 12, "angles": 6, "seeds": 2}, {"frequencies": 3, "angles": 2, "seeds": 1}),
    "run-up": ({"torques": 18, "rises": 16, "plateaus": 41, "plateau": 300.0},
               {"torques": 2, "rises": 2, "plateaus": 9, "plateau": 150.0}),
    "order": ({"steps": 8}, {"steps": 5}),
}
"""How fine each study looks, and how fine a draft does."""


class Machine:
    """A z = 1 motion of the machine B, or of B at another frequency and start."""

    def __init__(self, package, frequency=None, position=None, velocity=None):
        given = {"excitation.frequency": frequency, "initial.position": position, "initial.velocity": velocity}
        self.package = package
        self.press = {("press", name): value for name, value in given.items() if value is not None}
        with self.begin(IDEAL) as system:
            self.speed, amplitude = (system.get("press", f"excitation.{name}") for name in ("frequency", "amplitude"))
            self.period, self.unbalance = math.tau / self.speed, amplitude / self.speed**2
            system.step(self.period)
            self.torque = system.get("press", "energy.supplied") / math.tau

    def begin(self, drive, values=None):
        """The machine in its motion: on a motor that gives, at this speed, what the motion takes, or on an ideal drive."""
        values = self.press | (values or {})
        if drive == IDEAL:
            takes = {("press", f"drive.takes.{name}"): False for name in ("speed", "amplitude")}
            return System(self.package, "B", values | takes, without=["drive"])
        torque = values.get(("drive", "motor.torque"), TORQUE)
        motor = {"motor.torque": torque, "motor.speed": self.speed / (1.0 - self.torque / torque),
                 "unbalance": self.unbalance, "initial.speed": self.speed}
        return System(self.package, "B", {("drive", name): value for name, value in motor.items()} | values)

    def begin_at_rest(self, torque):
        """The machine at rest on a motor without voltage."""
        rest = {("press", "initial.position"): 0.0, ("press", "initial.velocity"): 0.0, ("drive", "initial.speed"): 0.0}
        return self.begin(MOTOR, rest | {("drive", "motor.torque"): torque, ("drive", "motor.voltage"): 0.0})


def intervals(system, machine, turns):
    """Intervals between impacts over some turns, in turns of the z = 1 motion."""
    found, last = [], None
    for _ in range(turns * STEPS):
        system.step(machine.period / STEPS)
        if system.get("press", "impact.step.count"):
            first = system.get("press", "impact.step.first.time")
            found += [] if last is None else [(first - last) / machine.period]
            last = system.get("press", "impact.time")
    # An impact that does not come any more.
    since = 0.0 if last is None else (system.time - last) / machine.period
    return found + ([since] if since > GAP else [])


def missed(found):
    return sum(interval > GAP for interval in found)


def strips_in_a_row(package, drive, motion, missing, angle):
    """Strips fail in a row, and what becomes of the motion."""
    machine = Machine(package, **motion)
    supply = {"feed.angle": math.radians(angle), "supply.model": 2, "supply.pattern.count": 3,
              "supply.pattern.strokes[1]": BEFORE, "supply.pattern.strokes[2]": missing, "supply.pattern.strokes[3]": 10**6}
    with machine.begin(drive, {("feeder", name): value for name, value in supply.items()}) as system:
        found = intervals(system, machine, BEFORE + missing + AFTER)
    last = found[-JUDGED:]
    is_single = len(last) == JUDGED and all(abs(interval - 1.0) < ALIKE for interval in last)
    return {"drive": drive, "frequency (rad/s)": motion["frequency"], "missing strips": missing,
            "drive angle (deg)": angle, "missed": missed(found),
            "fate": (BACK if missed(found) else KEPT) if is_single else LOST}


def strips_by_chance(package, drive, motion, probability, seeds):
    """Strips fail by chance, and how many strokes are missed."""
    machine, gaps = Machine(package, **motion), 0
    for seed in range(seeds):
        supply = {"supply.model": 3, "supply.probability": probability, "supply.seed": seed}
        with machine.begin(drive, {("feeder", name): value for name, value in supply.items()}) as system:
            gaps += missed(intervals(system, machine, AFTER))
    return {"drive": drive, "frequency (rad/s)": motion["frequency"], "probability of a strip": probability,
            "strokes missed": gaps / (seeds * AFTER)}


def strips(run, ask, frequencies, angles, seeds):
    zone = ask("zone", "B")
    first, width = zone["frequency_g0"], zone["frequency_sn"] - zone["frequency_g0"]
    low, high = (first + width * share for share in SHARES)
    motions = []
    for k in range(frequencies):
        frequency = low + (high - low) * (k + 0.5) / frequencies
        orbit = ask("orbit", "B", "--set", f"frequency={frequency!r}")
        motions.append({"frequency": frequency, "position": orbit["position"], "velocity": orbit["velocity"]})
    cases = [(drive, motion) for motion in motions for drive in DRIVES]
    rows = run(strips_in_a_row, [(*case, missing, 360.0 * k / angles)
                                 for case in cases for missing in MISSING for k in range(angles)])
    chances = run(strips_by_chance, [(*case, chance, seeds) for case in cases for chance in PROBABILITIES])
    counts = [{"drive": drive} | {fate: sum(it["drive"] == drive and it["fate"] == fate for it in rows) for fate in FATES}
              for drive in DRIVES]
    return {"strips": rows, "strips-chance": chances, "strips-drives": counts}, None


def lead_voltage(system, *polynomial):
    """Lets the voltage of the motor go on from now as a polynomial."""
    system.units["drive"].lead("voltage", polynomial)


def means(system, time):
    """Mean speed in rad/s over a time in s, and impacts in a turn."""
    def seen():
        return system.get("press", "drive.angle"), system.get("press", "impact.count")

    angle, impacts = seen()
    system.go_to(system.time + time, STEP)
    turned = seen()[0] - angle
    return turned / time, (seen()[1] - impacts) / (turned / math.tau)


def from_rest(package, share, rise):
    """The voltage rises to the rated one in this time, the torque is this share of what z = 1 takes."""
    machine = Machine(package)
    torque = machine.torque * share
    with machine.begin_at_rest(torque) as system:
        lead_voltage(system, 0.0, 1.0 / rise)
        system.go_to(rise, STEP)
        lead_voltage(system, 1.0, 0.0)
        system.go_to(rise + SETTLED, STEP)
        speed, impacts = means(system, MEASURED)
    is_single = abs(impacts - 1.0) * speed * MEASURED / math.tau <= 1.0
    landed = is_single and abs(speed / machine.speed - 1.0) < SAME_SPEED
    return {"torque (N m)": torque, "torque / mean torque": share, "rise (s)": rise, "speed (rad/s)": speed, "impacts per turn": impacts,
            "end": PASSES if impacts == 0.0 else LANDS if landed else OTHER}


def up_and_down(package, plateaus, plateau):
    """The voltage of a soft motor goes up and down again in steps, from rest."""
    machine, rows = Machine(package), []
    up = [("up", VOLTAGES[0] + (VOLTAGES[1] - VOLTAGES[0]) * k / (plateaus - 1)) for k in range(plateaus)]
    with machine.begin_at_rest(SOFT * machine.torque) as system:
        for way, voltage in up + [("down", voltage) for _, voltage in reversed(up)]:
            lead_voltage(system, voltage, 0.0)
            system.go_to(system.time + 0.6 * plateau, STEP)
            speed, impacts = means(system, 0.4 * plateau)
            rows.append({"way": way, "voltage": voltage, "speed (rad/s)": speed, "impacts per turn": impacts})
    return rows


def run_up(run, _, torques, rises, plateaus, plateau):
    def between(range_, count):
        return [range_[0] * (range_[1] / range_[0]) ** (k / (count - 1)) for k in range(count)]

    rows = run(from_rest, [(share, rise) for share in between(TORQUES, torques) for rise in between(RISES, rises)])
    (levels,) = run(up_and_down, [(plateaus, plateau)])
    return {"run-up": rows, "run-up-voltage": levels}, piercing_charts.run_up(rows, levels)


def end_of_run(package, coupling, step):
    """Speed at the end, and time of the last impact."""
    with Machine(package).begin(MOTOR) as system:
        system.go_to(END, step, coupling)
        return system.get("drive", "speed"), system.get("press", "impact.time")


def order(run, _, steps):
    cases = [(coupling, LARGEST / 2**k) for coupling in COUPLINGS for k in range(steps)]
    *ends, (speed, impact) = run(end_of_run, [*cases, (ROLL_BACK, FINEST)])
    rows = [{"coupling": coupling, "step (s)": step, "error of the speed (rad/s)": abs(end[0] - speed),
             "error of the last impact (s)": abs(end[1] - impact)} for (coupling, step), end in zip(cases, ends)]
    orders = []
    for coupling in COUPLINGS:
        # Between the second step and the last.
        (step, first, _), (finest, last, _) = (
            list(it.values())[1:] for it in [it for it in rows if it["coupling"] == coupling][1::steps - 2])
        orders.append({"coupling": coupling, "order": math.log(first / last) / math.log(step / finest)})
    return {"order": rows, "order-seen": orders}, piercing_charts.order(rows, orders, FINEST)


STUDIES = {"strips": strips, "run-up": run_up, "order": order}


def call(case):
    function, package, *arguments = case
    return function(package, *arguments)


def study(name, ssp, folder, softstop, details):
    """Runs a study on all processors, writes its files and returns its tables."""
    def ask(*arguments):
        """What the program softstop answers."""
        return json.loads(subprocess.check_output([softstop, *arguments, "--format", "json"]))

    with tempfile.TemporaryDirectory() as unpacked, multiprocessing.get_context("spawn").Pool() as pool:
        package = Package(ssp, unpacked)
        tables, picture = STUDIES[name](
            lambda function, cases: pool.map(call, [(function, package, *case) for case in cases], chunksize=1),
            ask, **details)
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    if picture:
        (folder / f"{name}.svg").write_text(picture, encoding="utf-8")
    for table, rows in tables.items():
        with open(folder / f"{table}.csv", "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, rows[0], lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)
    return tables


def text(rows):
    """A table for people."""
    cells = [list(rows[0])] + [[f"{it:.6g}" if isinstance(it, float) else str(it) for it in row.values()] for row in rows]
    widths = [max(map(len, column)) for column in zip(*cells)]
    return "\n".join("  ".join(cell.rjust(width) for cell, width in zip(line, widths)) for line in cells)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study", choices=STUDIES)
    parser.add_argument("--draft", action="store_true", help="few points, for a first look")
    parser.add_argument("--output", default="softstop-system", help="folder for pictures and tables")
    parser.add_argument("--ssp", default="piercing-machine.ssp", help="the machine")
    parser.add_argument("--softstop", default="softstop", help="the program")
    arguments = parser.parse_args()
    details = DETAILS[arguments.study][arguments.draft]
    tables = study(arguments.study, arguments.ssp, arguments.output, arguments.softstop, details)
    for name, rows in tables.items():
        print(f"{name}.csv\n{text(rows)}\n")


if __name__ == "__main__":
    main()
