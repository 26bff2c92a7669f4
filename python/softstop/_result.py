"""What commands return: figures, tables, files and pictures."""

from __future__ import annotations

import json
import os
import pathlib
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np
import numpy.typing as npt

from . import _softstop, plot
from ._checks import checked
from ._machine import Machine
from ._table import WORDS, Table

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from xarray import DataArray

Floats = npt.NDArray[np.float64]


class Result(Mapping[str, Any]):
    """What a command has found: the fields of its JSON as keys and attributes, its tables and files.

    A notebook shows the picture that the program draws.

    Attributes
    ----------
    text : str
        The report as the program prints it.
    tables : dict of Table
        The program's CSV files, by name.
    files : dict of bytes
        All files that the program writes, by name.

    Examples
    --------
    >>> import softstop as ss
    >>> zone = ss.zone(ss.Machine.unloaded(clearance=10))
    >>> zone.frequency_sn == zone["frequency_sn"]
    True
    """

    def __init__(
        self, text: str, values: Mapping[str, Any], files: Mapping[str, bytes], arrays: Mapping[str, Any],
        machine: Machine | None,
    ) -> None:
        self.text = text
        self.files = dict(files)
        self._values = dict(values)
        self._values.pop("files", None)
        self._arrays = dict(arrays)
        self._machine = machine
        self.tables = {
            name.removesuffix(".csv"): Table.of_csv(content.decode())
            for name, content in self.files.items()
            if name.endswith(".csv")
        }

    @property
    def machine(self) -> Machine:
        """The machine that was looked at; `result["machine"]` is what the JSON has of it."""
        if self._machine is None:
            raise AttributeError("machine: there is more than one")
        return self._machine

    def __getitem__(self, key: str) -> Any:
        return self._values[key]

    def __getattr__(self, key: str) -> Any:
        if key.startswith("_"):
            raise AttributeError(key)
        if key in self._values:
            return self._values[key]
        raise AttributeError(f"{key}: no such field; there are {', '.join(self._values)}")

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._values]

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def __repr__(self) -> str:
        return self.text

    def save(self, folder: str | os.PathLike[str]) -> None:
        """Writes all files into a folder."""
        place = pathlib.Path(folder)
        place.mkdir(parents=True, exist_ok=True)
        for name, content in self.files.items():
            (place / name).write_bytes(content)

    def _repr_mimebundle_(self, include: object = None, exclude: object = None) -> dict[str, Any]:
        pictures = [name for name in self.files if name.endswith((".svg", ".png"))]
        if not pictures:
            return {"text/plain": self.text}
        shown = self.files["design.svg" if "design.svg" in pictures else pictures[0]]
        is_svg = not shown.startswith(b"\x89PNG")
        picture = {"image/svg+xml": shown.decode()} if is_svg else {"image/png": shown}
        return {"text/plain": self.text} | picture


class Orbit(Result):
    """The stable z = 1 motion of a machine, as `orbit` finds it."""

    @property
    def multipliers(self) -> npt.NDArray[np.complex128]:
        """Both multipliers; `orbit["multipliers"]` is what the JSON has of them."""
        return np.array([complex(it["re"], it["im"]) for it in self["multipliers"]])

    @checked
    def figure(self, name: str) -> float:
        """A figure of the motion in the machine's own units.

        Parameters
        ----------
        name : str
            velocity, impact_energy, impact_power, stroke_work, drive_force, drive_power, max_position, stroke, stop_force,
            stop_deflection, cut_through, rigid_gap or largest_multiplier.

        Returns
        -------
        float
            Its value; NaN where the motion has none.

        Raises
        ------
        MachineError
            If there is no such figure.

        Examples
        --------
        >>> import softstop as ss
        >>> round(ss.orbit(ss.Machine.unloaded(eta=1.15, clearance=10)).figure("drive_power"), 6)
        3.053836
        """
        return _softstop.figures(self.machine._inner, [name], [])[0][0]

    @checked
    def gradient(self, name: str, by: Sequence[str] | None = None) -> dict[str, float]:
        """The exact derivatives of a figure, by the implicit function theorem through all crossings of the motion.

        Parameters
        ----------
        name : str
            A figure, as of `figure`.
        by : sequence of str, optional
            Keys of the machine; all its numbers but the phase of the drive unless some are named.

        Returns
        -------
        dict
            The derivatives by key, in the machine's own units.

        Raises
        ------
        MachineError
            If there is no such figure or key.
        SoftstopError
            If the figure has no exact derivative there.

        Examples
        --------
        >>> import softstop as ss
        >>> orbit = ss.orbit(ss.Machine.unloaded(eta=1.15, clearance=10))
        >>> {key: round(slope, 6) for key, slope in orbit.gradient("velocity", ["clearance", "eta"]).items()}
        {'clearance': 0.57012, 'eta': 34.577743}
        """
        keys = [key for key in self.machine.parameters if key != "excitation.phase"] if by is None else list(by)
        _, rows = _softstop.figures(self.machine._inner, [name], keys)
        return dict(zip(keys, rows[0], strict=True))


class Attractors(Result):
    """All motions on which a machine settles, as `motions` finds them."""

    def plot(self, axes: Axes | None = None) -> Axes:
        """Draws those that repeat in the phase plane: velocity over position; returns the Matplotlib axes."""
        return plot.attractors(self, axes)


class Zone(Result):
    """The hysteresis zone of a machine, as `zone` finds it."""

    @property
    def stretches(self) -> Table:
        """All stretches of stable z = 1: from and to (frequencies), what ends them, hardest impact and where."""
        return _records(self["stretches"], "from from_by to to_by hardest hardest_at in_zone")

    def plot(self, axes: Axes | None = None) -> Axes:
        """Draws the zone and the stretches of stable z = 1 over the drive frequency; returns the Matplotlib axes."""
        return plot.zone(self, axes)


class Branch(Result):
    """Branches of periodic motions along a parameter, as `continue_` follows them."""

    @property
    def points(self) -> Table:
        """All points, those of one branch after those of another, in the order of the branch."""
        return self.tables["branches"]

    @property
    def specials(self) -> Table:
        """The special points: branch, periods, symbol (SN, PD, NS, G), name, value, position, velocity,
        before_impact_velocity (the highest; 0 without impacts), trace, determinant."""
        rows = []
        for number, branch in enumerate(self["branches"]):
            for special in branch["specials"]:
                hardest = max(special["before_impact_velocities"], default=0.0)
                row = {"branch": number, "periods": branch["periods"]} | special | {"before_impact_velocity": hardest}
                del row["before_impact_velocities"]
                rows.append(row)
        return _records(
            rows, "branch periods symbol name value position velocity trace determinant before_impact_velocity"
        )

    def plot(self, axes: Axes | None = None) -> Axes:
        """Draws before-impact velocities over the parameter, stable solid, unstable dashed, with the special points; returns the
        Matplotlib axes."""
        return plot.branch(self, axes)


class Sweep(Result):
    """A parameter up and down, as `sweep` steps it."""

    @property
    def points(self) -> Table:
        """All steps, one sweep after another."""
        return self.tables["sweep"]

    def plot(self, axes: Axes | None = None) -> Axes:
        """Draws the bifurcation diagram, before-impact velocities over the parameter; returns the Matplotlib axes."""
        return plot.sweep(self, axes)


class Basin(Result):
    """Basins of attraction on a plane of initial states, as `basin` finds them."""

    @property
    def dims(self) -> tuple[str, str]:
        """What goes upwards and across: two of x, v and phi. The rows of `labels` go upwards."""
        names = {"position": "x", "velocity": "v", "angle": "phi"}
        return names[self["grid"]["up"]["quantity"]], names[self["grid"]["across"]["quantity"]]

    @property
    def coords(self) -> dict[str, Floats]:
        """Middles of the cells along both dims: x in m, v in m/s (or the machine's units), phi in rad."""
        up, across = self.dims
        return {up: self._arrays["up"], across: self._arrays["across"]}

    @property
    def labels(self) -> npt.NDArray[np.uint16]:
        """Which of `motions` each cell leads to, in the shape of the coords."""
        labels: npt.NDArray[np.uint16] = self._arrays["labels"]
        return labels.reshape([len(axis) for axis in self.coords.values()])

    @property
    def motions(self) -> list[str]:
        """The motions in the order of the labels: z = p/n, or what they are."""
        return [f"z = {basin['z']}" if basin["z"] else basin["kind"] for basin in self["basins"]]

    @property
    def shares(self) -> Floats:
        """Shares of the cells that lead to each of the motions."""
        return np.array([basin["share"] for basin in self["basins"]])

    def to_xarray(self) -> DataArray:
        """The labels as an `xarray.DataArray` with its coordinates; the motions are its attribute.

        Raises
        ------
        ImportError
            If xarray is not installed.
        """
        try:
            from xarray import DataArray
        except ImportError as error:
            raise ImportError("to_xarray() needs xarray: pip install xarray") from error
        return DataArray(self.labels, self.coords, self.dims, name="basin", attrs={"motions": self.motions})

    def plot(self, axes: Axes | None = None) -> Axes:
        """Draws the basins; returns the Matplotlib axes."""
        return plot.basin(self, axes)


class Certainty(Result):
    """How certainly z = 1 establishes itself along the hysteresis zone, as `certainty` finds it."""

    def plot(self, axes: Axes | None = None) -> Axes:
        """Draws the certainty with its 95 % interval over the place in the zone; returns the Matplotlib axes."""
        return plot.certainty(self, axes)


class Design(Result):
    """The best design of a task, as `optimize` finds it."""

    _with_report: Callable[[], Design] | None = None

    @property
    def machine(self) -> Machine:
        """The machine, starting in the design's motion."""
        return Machine.from_toml(self.files["design.toml"].decode())

    def fmu(self, path: str | os.PathLike[str]) -> None:
        """Writes the design as an FMU 2.0 for co-simulation."""
        pathlib.Path(path).write_bytes(self.files["design.fmu"])

    def report(self, path: str | os.PathLike[str]) -> None:
        """Writes the report, one HTML page. Unless the task was solved with `report=True`, it is solved again for that."""
        if "report.html" not in self.files and self._with_report is not None:
            made = self._with_report().files
            if made["design.toml"] != self.files["design.toml"]:
                raise _softstop.SoftstopError("the task or its machine has changed since: the design is another one now")
            self.files["report.html"] = made["report.html"]
        pathlib.Path(path).write_bytes(self.files["report.html"])

    def plot(self, axes: Axes | None = None) -> Axes:
        """Draws the before-impact velocity of the design's branch over the drive frequency, and the design; returns the
        Matplotlib axes."""
        return plot.design(self, axes)


def _records(rows: Sequence[Mapping[str, Any]], names: str) -> Table:
    """The table of rows of numbers, truth values and words; these are its columns where it has no row."""

    def column(name: str) -> Any:
        cells = [row[name] for row in rows]
        if name in WORDS or any(isinstance(cell, str) for cell in cells):
            return cells
        kind = np.bool_ if cells and all(isinstance(cell, bool) for cell in cells) else np.float64
        return np.array([np.nan if cell is None else cell for cell in cells], dtype=kind)

    return Table({name: column(name) for name in (rows[0] if rows else names.split())})


Kind = TypeVar("Kind", bound=Result)


def result_of(
    text: str, values: str, arrays: Mapping[str, Any], folder: pathlib.Path, kind: type[Kind], machine: Machine | None
) -> Kind:
    """A result with the files of a folder."""
    files = {path.name: path.read_bytes() for path in sorted(folder.iterdir()) if path.is_file()}
    return kind(text, json.loads(values), files, arrays, machine)
