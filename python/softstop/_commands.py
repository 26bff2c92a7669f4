"""The commands of the program, in this process."""

from __future__ import annotations

import json
import os
import pathlib
import tempfile
from collections.abc import Callable, Mapping, Sequence
from typing import Any, cast

from . import _softstop
from ._machine import Machine, _tables
from ._result import Design, Result, result_of

Range = tuple[float, float]


def _word(value: Any) -> str:
    """An option's value as on the command line."""
    if isinstance(value, str):
        return value
    if isinstance(value, (tuple, list)):
        return ",".join(_word(inner) for inner in value)
    if isinstance(value, bool) or value is None or not hasattr(value, "__float__"):
        raise _softstop.MachineError(f"{value!r}: must be a number or a word")
    return repr(int(value)) if hasattr(value, "__index__") else repr(float(value))


def _words(options: Mapping[str, Any]) -> list[str]:
    """Options that are not None; True is a flag."""
    words: list[str] = []
    for name, value in options.items():
        flag = "--" + name.rstrip("_").replace("_", "-")
        if value is True:
            words.append(flag)
        elif value is not None and value is not False:
            words.append(f"{flag}={_word(value)}")
    return words


def _run(
    arguments: Callable[[pathlib.Path], list[str]], files: Mapping[str, str], kind: type[Result] = Result
) -> Result:
    """Runs a command in a folder of its own, gone afterwards, with these files and a folder "out" for the program's."""
    with tempfile.TemporaryDirectory(prefix="softstop-") as folder:
        place = pathlib.Path(folder)
        for name, text in files.items():
            (place / name).write_text(text, encoding="utf-8")
        (place / "out").mkdir()
        try:
            text, values = _softstop.run(arguments(place))
        except (_softstop.MachineError, _softstop.SoftstopError) as error:
            error.args = (str(error).replace(f"{place}{os.sep}", ""),)
            raise
        return result_of(text, values, place / "out", kind)


def _of_machine(
    command: str, machine: Machine, options: Mapping[str, Any], *, output: bool = True, kind: type[Result] = Result
) -> Result:
    """Runs a command on a machine; some write no files."""

    def arguments(place: pathlib.Path) -> list[str]:
        out = {"output": str(place / "out")} if output else {}
        return [command, "--format=json", str(place / "machine.toml"), *_words({**options, **out})]

    return _run(arguments, {"machine.toml": machine.to_toml()}, kind)


def _pair(name: str, value: Range) -> str:
    low, high = value
    return f"{_word(low)}:{_word(high)}"


class Orbit(Result):
    """The stable z = 1 motion of a machine."""

    machine_itself: Machine

    def figure(self, name: str) -> float:
        """A figure of the motion in the machine's own units: velocity, impact_energy, impact_power, stroke_work, drive_force,
        drive_power, max_position, stroke, stop_force, stop_deflection, cut_through, rigid_gap, largest_multiplier."""
        return _softstop.figures(self.machine_itself._inner, [name], [])[0][0]

    def gradient(self, name: str, by: Sequence[str] | None = None) -> dict[str, float]:
        """The exact derivatives of a figure by keys of the machine, in its own units; by all its numbers unless some are named.

        The motion is followed by the implicit function theorem through all its crossings.
        """
        keys = [key for key in self.machine_itself.parameters if key != "excitation.phase"] if by is None else list(by)
        _, rows = _softstop.figures(self.machine_itself._inner, [name], keys)
        return dict(zip(keys, rows[0], strict=True))


def orbit(machine: Machine, *, budget: int | None = None) -> Orbit:
    """The stable motion with one impact per drive period (z = 1), the hardest if there are several.

    Parameters
    ----------
    machine : Machine
        The machine.
    budget : int, optional
        Work that the answer may cost in millions of scan windows; 200 unless it is stated.

    Returns
    -------
    Orbit
        Position and velocity at drive angle 0, before_impact_velocity, max_position, trace, determinant, multipliers.

    Raises
    ------
    SoftstopError
        If there is none, or it would cost more.
    """
    found = cast(Orbit, _of_machine("orbit", machine, {"budget": budget}, output=False, kind=Orbit))
    found.machine_itself = machine
    return found


def motions(
    machine: Machine, *, starts: int | None = None, seed: int | None = None, transient: int | None = None,
    longest: int | None = None, patience: int | None = None, budget: int | None = None,
) -> Result:
    """All motions on which the machine settles: regimes, chaos, shares of starts.

    Parameters
    ----------
    starts : int, optional
        Quasi-random starts; 256 unless it is stated.
    seed : int, optional
        Another seed, other starts.
    transient, longest, patience : int, optional
        Drive periods before a motion is looked at, longest period looked for, and for which motions that do not repeat are
        watched.
    """
    options = {"starts": starts, "seed": seed, "transient": transient, "longest": longest, "patience": patience}
    return _of_machine("motions", machine, options | {"budget": budget})


def zone(machine: Machine, *, budget: int | None = None) -> Result:
    """The hysteresis zone, from grazing (g0) to the fold (s_SN), and all stretches of stable z = 1."""
    return _of_machine("zone", machine, {"budget": budget}, output=False)


def continue_(
    machine: Machine, parameter: str, between: Range, *, orbit: str | None = None, state: Range | None = None,
    double: int | None = None, second: str | None = None, second_between: Range | None = None,
    points: int | None = None, budget: int | None = None,
) -> Result:
    """Follows a periodic motion along a parameter, through folds, with all its bifurcations.

    Parameters
    ----------
    parameter : str
        Key or letter of the parameter; it starts at the machine's own value.
    between : (float, float)
        Lowest and highest value.
    orbit : str, optional
        Motion to start from, "p/n": "1/1" unless it is stated.
    state : (float, float), optional
        Starts from the orbit nearest to this state at drive angle 0, stable or not.
    double : int, optional
        Follows the orbits of twice the period from every flip on, so many times over.
    second, second_between : str and (float, float), optional
        Follows each special point as a curve in both parameters.
    points : int, optional
        Most points of a branch or curve in each direction.

    Returns
    -------
    Result
        `tables["branches"]` has the points, the JSON the special ones.
    """
    low, high = second_between or (None, None)
    options = {
        "parameter": parameter, "from": between[0], "to": between[1], "orbit": orbit, "state": state,
        "double": double, "second": second, "second_from": low, "second_to": high, "points": points, "budget": budget,
    }
    return _of_machine("continue", machine, options)


def sweep(
    machine: Machine, between: Range, *, parameter: str | None = None, steps: int | None = None,
    periods: int | None = None, direction: str | None = None, clearances: Sequence[float] | None = None,
    tolerance: float | None = None, budget: int | None = None,
) -> Result:
    """A parameter up and down: bifurcation diagram, jumps, hysteresis.

    Parameters
    ----------
    between : (float, float)
        First and last value.
    parameter : str, optional
        Key or letter; the drive frequency unless it is stated.
    steps, periods : int, optional
        Number of values (1000) and drive periods at each (200).
    direction : {"up", "down", "both"}, optional
        Which way.
    clearances : sequence of float, optional
        A sweep for each.
    """
    options = {
        "parameter": parameter, "from": between[0], "to": between[1], "steps": steps, "periods": periods,
        "direction": direction, "clearances": clearances and list(clearances), "tolerance": tolerance, "budget": budget,
    }
    return _of_machine("sweep", machine, options)


def basin(
    machine: Machine, *, size: int | None = None, plane: str | None = None, at: float | None = None,
    x: Range | None = None, v: Range | None = None, phi: Range | None = None, transient: int | None = None,
    longest: int | None = None, along_zone: int | None = None, budget: int | None = None,
) -> Result:
    """Which initial states lead to which motion.

    Parameters
    ----------
    size : int, optional
        Cells on each side of the plane; 400 unless it is stated.
    plane : str, optional
        Two of x, v and phi: "x,v" unless it is stated.
    at : float, optional
        The third quantity.
    x, v, phi : (float, float), optional
        Ranges in m, m/s and rad.
    along_zone : int, optional
        Instead, the certainty of z = 1 at so many places of the hysteresis zone.
    """
    ranges = {name: pair and _pair(name, pair) for name, pair in [("x", x), ("v", v), ("phi", phi)]}
    options = {"size": size, "plane": plane, "at": at, "transient": transient, "longest": longest}
    return _of_machine("basin", machine, options | ranges | {"along_zone": along_zone, "budget": budget})


def fidelity(machine: Machine, *, tolerance: float | None = None) -> Result:
    """The simplest model of the machine that will do: error and cost of ever simpler stops."""
    return _of_machine("fidelity", machine, {"tolerance": tolerance})


def study(task: Mapping[str, Any] | str | os.PathLike[str], *, machine: Machine | None = None) -> Result:
    """Many machines from a study: grids and samples of any parameters.

    Parameters
    ----------
    task : mapping or path
        The content of a study file, or the file.
    machine : Machine, optional
        The machine, in place of the study's.

    Returns
    -------
    Result
        `tables["study"]` has a row for each point.
    """
    files = {}
    if machine is not None:
        files["machine.toml"] = machine.to_toml()
        files["study.toml"] = _toml(_content(task) | {"machine": "machine.toml"})
    elif isinstance(task, Mapping):
        files["study.toml"] = _toml(task)

    def arguments(place: pathlib.Path) -> list[str]:
        file = place / "study.toml" if files else pathlib.Path(cast("os.PathLike[str]", task))
        return ["study", "--format=json", "--csv", f"--output={place / 'out'}", str(file)]

    return _run(arguments, files)


def optimize(
    task: Mapping[str, Any] | str | os.PathLike[str] | None = None, *, machine: Machine | None = None,
    margin: float | None = None, vary: Sequence[str] = (), evaluations: int | None = None,
    samples: int | None = None, report: bool = False, budget: int | None = None,
) -> Design:
    """Searches stiffness, clearance and frequency for the hardest impact that every machine within the tolerances holds.

    Parameters
    ----------
    task : mapping or path, optional
        The content of a task's file, with tables vary, tolerance, objective, require, search; or the file, which may hold
        the machine, too.
    machine : Machine, optional
        The machine, unless the task has it.
    margin : float, optional
        Least distance from both ends of the zone as a share of its width.
    vary : sequence of str, optional
        Searched ranges as on the command line: "clearance=2:22".
    evaluations, samples : int, optional
        Zones to compute at most; machines looked at within the tolerances.
    report : bool
        Whether there is to be a report, which takes longer.
    """
    options: dict[str, Any] = {"margin": margin, "evaluations": evaluations, "samples": samples, "budget": budget}
    options["no_report"] = not report
    files = {}
    if machine is not None:
        files["machine.toml"] = machine.to_toml()
    if isinstance(task, Mapping):
        files["task.toml"] = _toml(task)

    def arguments(place: pathlib.Path) -> list[str]:
        words = ["optimize", "--format=json", f"--output={place / 'out'}", *_words(options)]
        words += [f"--vary={one}" for one in vary]
        words += [str(place / "machine.toml")] if machine is not None else []
        if isinstance(task, Mapping):
            words.append(f"--config={place / 'task.toml'}")
        elif task is not None:
            words.append(os.fspath(task) if machine is None else f"--config={os.fspath(task)}")
        return words

    return cast(Design, _run(arguments, files, Design))


def picture_of(machine: Machine, start: Range, periods: int) -> str:
    """The last periods of a motion as an SVG, as `softstop simulate` draws them."""
    options = {"periods": periods, "samples_per_period": 1, "position": start[0], "velocity": start[1]}
    return _of_machine("simulate", machine, options).files["motion.svg"].decode()


def _content(task: Mapping[str, Any] | str | os.PathLike[str]) -> dict[str, Any]:
    """The content of a file."""
    if isinstance(task, Mapping):
        return dict(task)
    return cast("dict[str, Any]", json.loads(_softstop.toml_to_json(pathlib.Path(task).read_text(encoding="utf-8"))))


def _toml(table: Mapping[str, Any]) -> str:
    """The text of a file."""
    return _softstop.json_to_toml(json.dumps(_tables(table)))
