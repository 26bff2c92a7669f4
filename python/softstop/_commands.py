"""The commands of the program, in this process."""

from __future__ import annotations

import copy
import functools
import json
import os
import pathlib
import re
import tempfile
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from . import _softstop
from ._checks import checked
from ._machine import Machine, _tables, word_of
from ._progress import shown
from ._result import Attractors, Basin, Branch, Certainty, Design, Kind, Orbit, Result, Sweep, Zone, result_of

Range = tuple[float, float]
Side = Range | tuple[float, float, int]
Point = tuple[Branch, str | int]
NAMES = {"from": "between[0]", "to": "between[1]", "second-from": "second_between[0]", "second-to": "second_between[1]"}
"""Options of the program that are called otherwise here."""


def _words(options: Mapping[str, Any]) -> list[str]:
    """Options that are not None; True is a flag."""
    words: list[str] = []
    for name, value in options.items():
        flag = "--" + name.rstrip("_").replace("_", "-")
        if value is True:
            words.append(flag)
        elif value is not None and value is not False:
            values = value if isinstance(value, (tuple, list)) else [value]
            words.append(f"{flag}={','.join(word_of(name, one) for one in values)}")
    return words


def _said(words: str) -> str:
    """Words of the program with what its options are called here."""
    return re.sub(r"--([a-z-]+)", lambda it: NAMES.get(it[1], it[1].replace("-", "_")), words)


def _run(
    arguments: Callable[[pathlib.Path], list[str]], files: Mapping[str, str], kind: type[Kind], machine: Machine | None,
    progress: bool,
) -> Kind:
    """Runs a command in a folder of its own, gone afterwards, with these files and a folder "out" for the program's."""
    with tempfile.TemporaryDirectory(prefix="softstop-") as folder:
        place = pathlib.Path(folder)
        for name, text in files.items():
            (place / name).write_text(text, encoding="utf-8")
        (place / "out").mkdir()
        try:
            with shown(progress) as teller:
                text, values, arrays = _softstop.run(arguments(place), teller)
        except (_softstop.MachineError, _softstop.SoftstopError) as error:
            error.args = (_said(str(error).replace(f"{place}{os.sep}", "")),)
            raise
        return result_of(text, values, arrays, place / "out", kind, machine)


def _of_machine(
    command: str, machine: Machine, options: Mapping[str, Any], kind: type[Kind], *, output: str | None = "out",
    earlier: Point | None = None, progress: bool = False,
) -> Kind:
    """Runs a command on a machine, its output in this folder or file, if it writes any; from a point of an earlier branch."""
    files = {"machine.toml": machine.to_toml()}
    if earlier is not None:
        files["earlier.json"] = json.dumps(dict(earlier[0]))

    def arguments(place: pathlib.Path) -> list[str]:
        out = {} if output is None else {"output": str(place / output)}
        point = {} if earlier is None else {"from_point": f"{place / 'earlier.json'}:{earlier[1]}"}
        return [command, "--format=json", str(place / "machine.toml"), *_words({**options, **out, **point})]

    return _run(arguments, files, kind, machine, progress)


@checked
def orbit(machine: Machine, *, budget: int | None = None) -> Orbit:
    """The stable motion with one impact per drive period (z = 1), the hardest if there are several.

    Parameters
    ----------
    machine : Machine
        The machine.
    budget : int, optional
        Work that the answer may cost in millions of scan windows; 2000 unless it is stated.

    Returns
    -------
    Orbit
        position and velocity at time 0, before_impact_velocity, max_position (all in the machine's units), trace,
        determinant, multipliers; `gradient` has exact derivatives.

    Raises
    ------
    SoftstopError
        If there is none, or it would cost more.

    Examples
    --------
    >>> import softstop as ss
    >>> orbit = ss.orbit(ss.Machine.unloaded(eta=1.15, clearance=10))
    >>> round(orbit.before_impact_velocity, 9)
    6.494627429
    """
    return _of_machine("orbit", machine, {"budget": budget}, Orbit, output=None)


@checked
def motions(
    machine: Machine, *, starts: int | None = None, seed: int | None = None, transient: int | None = None,
    longest: int | None = None, patience: int | None = None, budget: int | None = None, progress: bool = True,
) -> Attractors:
    """All motions on which the machine settles: regimes, chaos, shares of starts.

    Parameters
    ----------
    machine : Machine
        The machine.
    starts : int, optional
        Quasi-random starts; 256 unless it is stated.
    seed : int, optional
        Another seed, other starts.
    transient, longest, patience : int, optional
        Drive periods before a motion is looked at, longest period looked for, and for which motions that do not repeat are
        watched.
    budget : int, optional
        As of `orbit`.
    progress : bool
        Whether progress is shown, where tqdm is installed.

    Returns
    -------
    Attractors
        `motions`, a list with kind, z = p/n, order of impacts, share of starts, state at time 0, multipliers, Lyapunov
        exponents.

    Raises
    ------
    SoftstopError
        If it would cost more.

    Examples
    --------
    >>> import softstop as ss
    >>> found = ss.motions(ss.Machine.unloaded(eta=1.15, clearance=10), starts=64)
    >>> sorted(motion["z"] for motion in found.motions)
    ['0', '1']
    """
    options = {"starts": starts, "seed": seed, "transient": transient, "longest": longest, "patience": patience}
    return _of_machine("motions", machine, options | {"budget": budget}, Attractors, progress=progress)


@checked
def zone(machine: Machine, *, budget: int | None = None) -> Zone:
    """The hysteresis zone, from grazing (g0) to the fold (s_SN), and all stretches of stable z = 1.

    Parameters
    ----------
    machine : Machine
        The machine; its own drive frequency plays no part.
    budget : int, optional
        As of `orbit`.

    Returns
    -------
    Zone
        frequency_g0, frequency_sn, velocity_sn in the machine's units, None where there is no zone (`no_zone` says why);
        `stretches`, a table.

    Raises
    ------
    SoftstopError
        If it would cost more.

    Examples
    --------
    >>> import softstop as ss
    >>> round(ss.zone(ss.Machine.unloaded(clearance=10)).frequency_sn, 9)
    1.369035839
    """
    return _of_machine("zone", machine, {"budget": budget}, Zone, output=None)


@checked
def continue_(
    machine: Machine, parameter: str, between: Range, *, orbit: str | None = None, state: Range | None = None,
    from_point: Point | None = None, double: int | None = None, second: str | None = None,
    second_between: Range | None = None, switch: int | None = None, points: int | None = None, budget: int | None = None,
    progress: bool = True,
) -> Branch:
    """Follows a periodic motion along a parameter, through folds, with all its bifurcations.

    Parameters
    ----------
    machine : Machine
        The machine.
    parameter : str
        Key or letter of the parameter; it starts at the machine's own value.
    between : (float, float)
        Lowest and highest value.
    orbit : str, optional
        Motion to start from, "p/n": "1/1" unless it is stated.
    state : (float, float), optional
        Starts from the orbit nearest to this state at time 0, stable or not.
    from_point : (Branch, str or int), optional
        Starts from a point of an earlier branch of the same machine, stable or not: a special point, such as "SN" or "PD2" for
        the second flip, or a row of its `points`, counted from 1. The parameter of that branch takes its value there.
    double : int, optional
        Follows the orbits of twice the period from every flip on, and asymmetric ones from every pitchfork, so many times over.
    second, second_between : str and (float, float), optional
        Follows each special point but pitchforks as a curve in both parameters.
    switch : int, optional
        Follows also the curves that begin in points of codimension two on these, so many times over.
    points : int, optional
        Most points of a branch or curve in each direction.
    budget : int, optional
        As of `orbit`.
    progress : bool
        Whether progress is shown, where tqdm is installed.

    Returns
    -------
    Branch
        Tables `points` and `specials`; `tables["curves"]` with a second parameter.

    Raises
    ------
    MachineError
        If the parameter is unknown, or its range does not hold the machine's value.
    SoftstopError
        If there is no such orbit, or it would cost more.

    Examples
    --------
    >>> import softstop as ss
    >>> branch = ss.continue_(ss.Machine.unloaded(eta=1.15, clearance=10), "frequency", (0.9, 1.5))
    >>> branch.specials.symbol, branch.specials.value.round(6)
    (array(['G', 'PD', 'SN', 'G'], dtype='<U2'), array([0.952652, 0.988907, 1.369036, 1.04444 ]))
    """
    if (second is None) != (second_between is None):
        raise _softstop.MachineError(f"second = {second!r}, second_between = {second_between!r}: one needs the other")
    low, high = between
    second_low, second_high = (None, None) if second_between is None else second_between
    options = {
        "parameter": parameter, "from": low, "to": high, "orbit": orbit, "state": state, "double": double,
        "second": second, "second_from": second_low, "second_to": second_high, "switch": switch, "points": points,
        "budget": budget,
    }
    return _of_machine("continue", machine, options, Branch, earlier=from_point, progress=progress)


@checked
def sweep(
    machine: Machine, between: Range, *, parameter: str | None = None, steps: int | None = None,
    periods: int | None = None, direction: str | None = None, clearances: Sequence[float] | None = None,
    tolerance: float | None = None, budget: int | None = None, progress: bool = True,
) -> Sweep:
    """A parameter up and down: bifurcation diagram, jumps, hysteresis.

    Parameters
    ----------
    machine : Machine
        The machine.
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
    tolerance : float, optional
        How near a motion has to return for it to count as periodic.
    budget : int, optional
        As of `orbit`, for each thousand steps.
    progress : bool
        Whether progress is shown, where tqdm is installed.

    Returns
    -------
    Sweep
        `sweeps` with their jumps, `hysteresis`; the table `points`.

    Raises
    ------
    MachineError
        If the parameter is unknown or a value out of range.
    SoftstopError
        If it would cost more.

    Examples
    --------
    >>> import softstop as ss
    >>> sweep = ss.sweep(ss.Machine.unloaded(clearance=10), (0.9, 1.5), steps=50)
    >>> [(it["direction"], len(it["jumps"])) for it in sweep.sweeps]
    [('up', 3), ('down', 3)]
    """
    low, high = between
    options = {
        "parameter": parameter, "from": low, "to": high, "steps": steps, "periods": periods,
        "direction": direction, "clearances": None if clearances is None else list(clearances), "tolerance": tolerance,
        "budget": budget,
    }
    return _of_machine("sweep", machine, options, Sweep, progress=progress)


def _plane(
    x: Side | None, v: Side | None, phi: Side | None, plane: str | None, size: int | None, **others: Any
) -> dict[str, Any]:
    """Options of a plane of initial states, and others."""
    sides = {name: side for name, side in [("x", x), ("v", v), ("phi", phi)] if side is not None}
    options: dict[str, Any] = {name: f"{word_of(name, side[0])}:{word_of(name, side[1])}" for name, side in sides.items()}

    def cells(name: str) -> int:
        side = sides.get(name)
        return side[2] if side is not None and len(side) == 3 else 400 if size is None else size

    return options | {"plane": plane, "size": [cells(name) for name in (plane or "x,v").split(",")]} | others


@checked
def basin(
    machine: Machine, *, x: Side | None = None, v: Side | None = None, phi: Side | None = None, size: int | None = None,
    plane: str | None = None, at: float | None = None, transient: int | None = None, longest: int | None = None,
    budget: int | None = None, progress: bool = True,
) -> Basin:
    """Which initial states lead to which motion.

    Parameters
    ----------
    machine : Machine
        The machine.
    x, v, phi : (low, high) or (low, high, cells), optional
        Ranges of initial position in m, velocity in m/s and drive angle in rad, and cells along them; those of the box of
        starts unless they are stated.
    size : int, optional
        Cells along a side that states none; 400 unless it is stated.
    plane : str, optional
        Two of x, v and phi, what goes across first: "x,v" unless it is stated.
    at : float, optional
        The third quantity; 0 unless it is stated.
    transient, longest : int, optional
        Drive periods after which what has not arrived is looked at; longest period looked for.
    budget : int, optional
        As of `orbit`, for each thousand cells.
    progress : bool
        Whether progress is shown, where tqdm is installed.

    Returns
    -------
    Basin
        `labels` of shape (cells of v, cells of x), which index `motions` and `shares`; `coords`; `to_xarray()`.

    Raises
    ------
    MachineError
        If a range or size cannot be.
    SoftstopError
        If it would cost more.

    Examples
    --------
    >>> import softstop as ss
    >>> basin = ss.basin(ss.Machine.unloaded(eta=1.15, clearance=10), x=(-20, 20, 30), v=(-20, 20, 40))
    >>> basin.labels.shape, basin.dims, basin.motions
    ((40, 30), ('v', 'x'), ['z = 0', 'z = 1'])
    """
    options = _plane(x, v, phi, plane, size, at=at, transient=transient, longest=longest, budget=budget)
    return _of_machine("basin", machine, options, Basin, progress=progress)


@checked
def certainty(
    machine: Machine, places: int = 21, *, x: Side | None = None, v: Side | None = None, phi: Side | None = None,
    size: int | None = None, plane: str | None = None, at: float | None = None, transient: int | None = None,
    longest: int | None = None, budget: int | None = None, progress: bool = True,
) -> Certainty:
    """The establishing certainty of z = 1 along the hysteresis zone: the share of initial states that lead to the zone's motion.

    Where two motions coexist in the zone, it is that of the harder one.

    Parameters
    ----------
    machine : Machine
        The machine.
    places : int
        Places from g0 to s_SN, 2 to 1000.
    x, v, phi, size, plane, at, transient, longest, budget, progress
        As of `basin`; the plane is the same at all places.

    Returns
    -------
    Certainty
        `places`, a list; `tables["certainty"]`: place, frequency, certainty with its 95 % interval, integrity, motions.

    Raises
    ------
    SoftstopError
        If there is no hysteresis zone.

    Examples
    --------
    >>> import softstop as ss
    >>> found = ss.certainty(ss.Machine.unloaded(clearance=10), 3, size=20)
    >>> [place["place"] for place in found.places]
    [0.0, 0.5, 1.0]
    """
    options = _plane(x, v, phi, plane, size, at=at, transient=transient, longest=longest, budget=budget)
    return _of_machine("basin", machine, options | {"along_zone": places}, Certainty, progress=progress)


@checked
def basins(
    machine: Machine, parameter: str, between: Range, *, steps: int | None = None, x: Side | None = None,
    v: Side | None = None, phi: Side | None = None, size: int | None = None, plane: str | None = None,
    at: float | None = None, transient: int | None = None, longest: int | None = None, budget: int | None = None,
    progress: bool = True,
) -> Result:
    """All attractors and their basins along a parameter.

    Parameters
    ----------
    machine : Machine
        The machine.
    parameter : str
        Key or letter of the parameter.
    between : (float, float)
        First and last value.
    steps : int, optional
        Number of values, 2 to 1000; 41 unless it is stated.
    x, v, phi, size, plane, at, transient, longest, budget, progress
        As of `basin`; the plane is the same at all values.

    Returns
    -------
    Result
        `tables["attractors"]` has a row for each attractor at each value: its number, motion, share of the starts with its 95 %
        interval, integrity.

    Raises
    ------
    MachineError
        If the parameter is unknown or a value out of range.
    SoftstopError
        If it would cost more.

    Examples
    --------
    >>> import softstop as ss
    >>> found = ss.basins(ss.Machine.unloaded(clearance=10), "eta", (1.15, 1.25), steps=2, size=20)
    >>> found.tables["attractors"].value, found.tables["attractors"].z
    (array([1.15, 1.15, 1.25, 1.25]), array(['0', '1', '0', '1'], dtype='<U1'))
    """
    low, high = between
    options = _plane(x, v, phi, plane, size, at=at, transient=transient, longest=longest, budget=budget)
    along = {"parameter": parameter, "from": low, "to": high, "steps": steps}
    return _of_machine("basin", machine, options | along, Result, progress=progress)


@checked
def prove(
    machine: Machine, *, orbit: str | None = None, state: Range | None = None, at: str | None = None,
    budget: int | None = None,
) -> Result:
    """Proves a periodic motion, or its fold, flip or grazing, by interval arithmetic.

    Parameters
    ----------
    machine : Machine
        The machine.
    orbit : str, optional
        Motion to prove, "p/n": "1/1" unless it is stated.
    state : (float, float), optional
        Proves the orbit nearest to this state at time 0, stable or not.
    at : {"fold", "flip", "grazing"}, optional
        Proves a bifurcation of the motion: the one at the nearest frequency of the drive on its branch.
    budget : int, optional
        As of `orbit`.

    Returns
    -------
    Result
        The certificate: intervals that hold the motion, and what is proven of it; `text` says it in words.

    Raises
    ------
    SoftstopError
        If it is not proven.

    Examples
    --------
    >>> import softstop as ss
    >>> proof = ss.prove(ss.Machine.unloaded(eta=1.15, clearance=10))
    >>> "proof.json" in proof.files
    True
    """
    options = {"orbit": orbit, "state": state, "at": at, "budget": budget}
    return _of_machine("prove", machine, options, Result, output="out/proof.json")


@checked
def fidelity(machine: Machine, *, tolerance: float | None = None, progress: bool = True) -> Result:
    """The simplest model of the machine that will do: error and cost of ever simpler stops.

    Parameters
    ----------
    machine : Machine
        The machine.
    tolerance : float, optional
        Relative error that is allowed.
    progress : bool
        Whether progress is shown, where tqdm is installed.

    Returns
    -------
    Result
        The models with their errors and costs, and the one that will do.

    Raises
    ------
    SoftstopError
        If the machine has no stable z = 1 motion.

    Examples
    --------
    >>> import softstop as ss
    >>> found = ss.fidelity(ss.Machine.unloaded(eta=1.15, clearance=10))
    >>> "fidelity.svg" in found.files
    True
    """
    return _of_machine("fidelity", machine, {"tolerance": tolerance}, Result, progress=progress)


@checked
def study(
    task: Mapping[str, Any] | str | os.PathLike[str], *, machine: Machine | None = None, progress: bool = True
) -> Result:
    """Many machines from a study: grids and samples of any parameters.

    Parameters
    ----------
    task : mapping or path
        The content of a study file, or the file (`softstop schema study`).
    machine : Machine, optional
        The machine, in place of the study's.
    progress : bool
        Whether progress is shown, where tqdm is installed.

    Returns
    -------
    Result
        `tables["study"]` has a row for each point.

    Raises
    ------
    MachineError
        With the place in the study that cannot be.

    Examples
    --------
    >>> import softstop as ss
    >>> axis = {"parameter": "eta", "from": 1.1, "to": 1.3, "count": 3}
    >>> found = ss.study({"outputs": ["velocity"], "axis": [axis]}, machine=ss.Machine.unloaded(clearance=10))
    >>> found.tables["study"].velocity.round(6)
    array([ 4.83028 ,  8.320189, 12.95379 ])
    """
    files = {}
    if machine is not None:
        files["machine.toml"] = machine.to_toml()
        files["study.toml"] = _toml(_content(task) | {"machine": "machine.toml"})
    elif isinstance(task, Mapping):
        files["study.toml"] = _toml(task)

    def arguments(place: pathlib.Path) -> list[str]:
        file = pathlib.Path(task) if isinstance(task, (str, os.PathLike)) and not files else place / "study.toml"
        return ["study", "--format=json", "--csv", f"--output={place / 'out'}", "--", str(file)]

    return _run(arguments, files, Result, machine, progress)


@checked
def optimize(
    task: Mapping[str, Any] | str | os.PathLike[str] | None = None, *, machine: Machine | None = None,
    margin: float | None = None, vary: Sequence[str] = (), evaluations: int | None = None,
    samples: int | None = None, report: bool = False, budget: int | None = None, progress: bool = True,
) -> Design:
    """Searches stiffness, clearance and frequency for the hardest impact that every machine within the tolerances holds.

    Parameters
    ----------
    task : mapping or path, optional
        The content of a task's file, with tables vary, tolerance, objective, require, search (`softstop schema task`); or
        the file, which may hold the machine, too.
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
    budget : int, optional
        Work that each zone may cost in millions of scan windows.
    progress : bool
        Whether progress is shown, where tqdm is installed.

    Returns
    -------
    Design
        `design` with its figures, `limits`, `requirements`; `machine`, `fmu(path)`, `report(path)`.

    Raises
    ------
    MachineError
        With the key of the task that cannot be.
    SoftstopError
        If no machine meets the task; it says which constraint is in the way.

    Examples
    --------
    >>> import softstop as ss
    >>> task = {"machine": "loaded", "vary": {"stop.stiffness": 7, "clearance": [2, 22]}, "require": {"margin": 0.1}}
    >>> round(ss.optimize(task).design["before_impact_velocity"], 3)
    12.861
    """
    options: dict[str, Any] = {"margin": margin, "evaluations": evaluations, "samples": samples, "budget": budget}
    files = {}
    if machine is not None:
        files["machine.toml"] = machine.to_toml()
    if isinstance(task, Mapping):
        if machine is not None and "machine" in task:
            raise _softstop.MachineError("machine: the task has one, too")
        task = copy.deepcopy(task)
        files["task.toml"] = _toml(task)

    def arguments(place: pathlib.Path) -> list[str]:
        words = ["optimize", "--format=json", f"--output={place / 'out'}", *_words(options | {"no_report": not report})]
        words += [f"--vary={one}" for one in vary]
        words += [str(place / "machine.toml")] if machine is not None else []
        if isinstance(task, Mapping):
            words.append(f"--config={place / 'task.toml'}")
        elif task is not None:
            words += ["--", os.fspath(task)] if machine is None else [f"--config={os.fspath(task)}"]
        return words

    design = _run(arguments, files, Design, None, progress)
    design._with_report = functools.partial(
        optimize, task, machine=machine, vary=vary, report=True, progress=progress, **options
    )
    return design


def picture_of(machine: Machine, start: Range, periods: int) -> str:
    """The last periods of a motion as an SVG, as `softstop simulate` draws them."""
    options = {"periods": periods, "samples_per_period": 1, "position": start[0], "velocity": start[1]}
    return _of_machine("simulate", machine, options, Result).files["motion.svg"].decode()


def _content(task: Mapping[str, Any] | str | os.PathLike[str]) -> dict[str, Any]:
    """The content of a file."""
    if isinstance(task, Mapping):
        return dict(task)
    content: dict[str, Any] = json.loads(_softstop.toml_to_json(pathlib.Path(task).read_text(encoding="utf-8")))
    return content


def _toml(table: Mapping[str, Any]) -> str:
    """The text of a file."""
    return _softstop.json_to_toml(json.dumps(_tables(table)))
