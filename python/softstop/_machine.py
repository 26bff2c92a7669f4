"""Machines: immutable, in the units and by the keys of their files."""

from __future__ import annotations

import json
import numbers
import os
import pathlib
import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Any, ClassVar

import numpy as np

from . import _softstop
from ._checks import checked, is_number, pair

Value = float | str
PARTS = {"drive": "excitation", "stop": "stop", "strip": "piercing", "rigid": "rigid", "start": "initial"}
"""Tables of a machine's file, by what `Machine` calls them."""


class _Part:
    """A table of a machine's file."""

    model: ClassVar[str | None] = None

    def table(self) -> dict[str, Any]:
        """The table."""
        return {"model": self.model} | {field.name: getattr(self, field.name) for field in fields(self)}  # type: ignore[arg-type]


@dataclass(frozen=True)
class Drive(_Part):
    """The drive F0 cos(w t + phi): amplitude in N, frequency in rad/s or frequency_hz in Hz, phase in rad."""

    amplitude: float
    frequency: float | None = None
    frequency_hz: float | None = None
    phase: float | None = None


@dataclass(frozen=True)
class KelvinVoigt(_Part):
    """A linear stop: stiffness in N/m; it lets go at the "clearance", or at "zeroForce"."""

    stiffness: float
    release: str | None = None
    model: ClassVar[str | None] = "kelvinVoigt"


@dataclass(frozen=True)
class PiecewiseLinear(_Part):
    """A chain of slopes: pairs (from in m, stiffness in N/m), for loading and, with a loss, for unloading."""

    loading: Sequence[tuple[float, float]]
    unloading: Sequence[tuple[float, float]] = ()
    model: ClassVar[str | None] = "piecewiseLinear"

    def table(self) -> dict[str, Any]:
        def slopes(pairs: Sequence[tuple[float, float]]) -> list[dict[str, float]]:
            return [{"from": start, "stiffness": stiffness} for start, stiffness in pairs]

        return {"model": self.model, "loading": slopes(self.loading), "unloading": slopes(self.unloading)}


@dataclass(frozen=True)
class Hertz(_Part):
    """Hertz, or Hunt and Crossley: stiffness in N/m^exponent, dissipation in s/m."""

    stiffness: float
    exponent: float | None = None
    dissipation: float | None = None
    model: ClassVar[str | None] = "hertz"


@dataclass(frozen=True)
class Preloaded(_Part):
    """A stop that is pressed before it is touched: stiffness in N/m, preload in N or preload_deflection in m."""

    stiffness: float
    preload: float | None = None
    preload_deflection: float | None = None
    model: ClassVar[str | None] = "preloaded"


@dataclass(frozen=True)
class Rigid(_Part):
    """A rigid stop: Newton's coefficient of restitution, 0 to 1."""

    restitution: float
    model: ClassVar[str | None] = "rigid"


@dataclass(frozen=True)
class Strip(_Part):
    """A strip to pierce: stiffness k2 and friction k3 in N/m, thickness and travel behind it in m."""

    stiffness: float
    friction: float
    thickness: float
    travel: float


def _tables(value: Any, name: str = "") -> Any:
    """Parts as tables, keys with dots as tables in tables, numbers of NumPy as Python's; what has this name, if it has one. What
    is None in a table is left out."""
    if isinstance(value, _Part):
        value = value.table()
    if isinstance(value, Mapping):
        table: dict[str, Any] = {}
        for key, inner in value.items():
            if inner is None:
                continue
            *path, last = str(key).split(".")
            place = table
            for name in path:
                place = place.setdefault(name, {})
                if not isinstance(place, dict):
                    raise _softstop.MachineError(f"{key}: {name} is a value, not a table")
            inner = _tables(inner, f"{name}.{key}" if name else str(key))
            known = place.get(last)
            place[last] = known | inner if isinstance(known, dict) and isinstance(inner, dict) else inner
        return table
    if isinstance(value, np.generic) or (isinstance(value, np.ndarray) and value.ndim == 0):
        value = value.item()
    if isinstance(value, (int, float)) and not abs(value) <= sys.float_info.max:
        raise _softstop.MachineError(f"{name} = {value!r}: must be finite")
    if isinstance(value, (str, bool, int, float)):
        return value
    if isinstance(value, Sequence) and not isinstance(value, bytes):
        return [_tables(inner, name) for inner in value]
    raise _softstop.MachineError(f"{name} = {value!r}: must be a number, a word, or a table of them")


def _part(name: str, part: Any) -> Any:
    """What a file has in the table of a part."""
    if name == "stop" and part is None:
        return {"model": "none"}
    if name == "start" and part is not None:
        return dict(zip(("position", "velocity"), pair(name, part), strict=True))
    return part


def word_of(name: str, value: Any) -> str:
    """A value of this name as on the command line."""
    if isinstance(value, str):
        return value
    if not is_number(value):
        raise _softstop.MachineError(f"{name} = {value!r}: must be a number or a word")
    return repr(int(value)) if isinstance(value, numbers.Integral) else repr(float(value))


Change = Value | _Part | Mapping[str, float] | Sequence[float] | None


class Machine(Mapping[str, float]):
    """A machine: mass on a suspension, drive, stop, strip; a mapping of the numbers that it has, by key, in its own units.

    Parameters
    ----------
    mass : float
        In kg. All keys are those of a machine's file (`softstop schema`), in SI units.
    stiffness, damping : float
        Of the suspension in N/m and N s/m.
    clearance : float
        Position in m at which bodies touch.
    contact_damping : float
        All damping while bodies touch in N s/m.
    drive : Drive
        The force.
    stop : KelvinVoigt, PiecewiseLinear, Hertz, Preloaded, Rigid or None
        The law of the stop.
    strip : Strip, optional
        What is pierced.
    rigid : mapping, optional
        A rigid stop behind the other: travel in m and restitution.
    start : (float, float), optional
        Position in m and velocity in m/s at time 0.
    name : str, optional
        Its name.

    Raises
    ------
    MachineError
        With the parameter (`key`), its value and the allowed range.

    Examples
    --------
    >>> press = Machine(mass=120, stiffness=2.4e6, damping=680, clearance=0.02, contact_damping=3060,
    ...                 drive=Drive(9e3, frequency_hz=24), stop=Preloaded(1.7e7, preload_deflection=0.02))
    >>> press["excitation.frequency_hz"]
    24.0
    >>> round(press["excitation.frequency"], 3)
    150.796
    >>> press.replace(clearance=0.01, stop=Rigid(0.8))["stop.restitution"]
    0.8
    """

    __slots__ = ("_inner",)
    _inner: _softstop.Machine

    def __init__(
        self,
        *,
        mass: float,
        stiffness: float,
        damping: float,
        clearance: float,
        contact_damping: float,
        drive: Drive,
        stop: KelvinVoigt | PiecewiseLinear | Hertz | Preloaded | Rigid | None,
        strip: Strip | None = None,
        rigid: Mapping[str, float] | None = None,
        start: Sequence[float] | None = None,
        name: str | None = None,
    ) -> None:
        table = {
            "name": name,
            "mass": mass,
            "stiffness": stiffness,
            "damping": damping,
            "clearance": clearance,
            "contact": {"damping": contact_damping},
        }
        parts = {"drive": drive, "stop": stop, "strip": strip, "rigid": rigid, "start": start}
        self._inner = _of_table(table | {PARTS[name]: _part(name, part) for name, part in parts.items()})

    @classmethod
    def _of(cls, inner: _softstop.Machine) -> Machine:
        machine = object.__new__(cls)
        machine._inner = inner
        return machine

    @classmethod
    def unloaded(cls, **changes: Change) -> Machine:
        """The paper's machine without a strip (Peterka 2003), in ratios, with changes as of `replace`.

        Examples
        --------
        >>> Machine.unloaded(eta=1.15, rho=10)["clearance"]
        10.0
        """
        return cls._of(_softstop.Machine.named("unloaded")).replace(**changes)

    @classmethod
    def loaded(cls, **changes: Change) -> Machine:
        """The paper's machine that pierces, in ratios, with changes as of `replace`.

        Examples
        --------
        >>> Machine.loaded(eta=1.2)["excitation.frequency"]
        1.2
        """
        return cls._of(_softstop.Machine.named("loaded")).replace(**changes)

    @classmethod
    @checked
    def from_toml(cls, text: str) -> Machine:
        """The machine of a file's text; tables of a task in it play no part.

        Raises
        ------
        MachineError
            With line and key of what cannot be.

        Examples
        --------
        >>> Machine.from_toml(Machine.unloaded().to_toml()) == Machine.unloaded()
        True
        """
        return cls._of(_softstop.Machine.from_toml(text, None))

    @classmethod
    @checked
    def from_dict(cls, table: Mapping[str, Any]) -> Machine:
        """The machine of a file's content.

        Parameters
        ----------
        table : mapping
            Keys and values as in the file, in tables or with dots.

        Raises
        ------
        MachineError
            With the key of what cannot be.

        Examples
        --------
        >>> stop = {"model": "preloaded", "stiffness": 7, "preload": 70}
        >>> drive = {"amplitude": 1, "frequency": 1.15}
        >>> Machine.from_dict({"mass": 1, "stiffness": 1, "damping": 0.04, "clearance": 10, "contact.damping": 0.18,
        ...                    "excitation": drive, "stop": stop})["stop.preload"]
        70.0
        """
        return cls._of(_of_table(table))

    @checked
    def replace(self, changes: Mapping[str, Change] | None = None, /, **named: Change) -> Machine:
        """Another machine with other values and parts.

        Parameters
        ----------
        changes : mapping, optional
            Values by keys, older names or letters, in the machine's own units; parts by the names of the class's parameters:
            drive, stop, strip, rigid, start.
        **named : float, str or part
            The same; keys with dots have two underscores: `stop__stiffness=7` is `stop.stiffness`.

        Returns
        -------
        Machine
            The other machine; this one stays as it is.

        Raises
        ------
        MachineError
            With the parameter (`key`), its value and the allowed range.

        Examples
        --------
        >>> machine = Machine.unloaded()
        >>> machine.replace({"stop.stiffness": 8}) == machine.replace(stop__stiffness=8)
        True
        >>> machine.replace(stop=None, start=(0, 5)).start
        (0.0, 5.0)
        """
        pairs = dict(changes or {}) | {key.replace("__", "."): value for key, value in named.items()}
        parts = {key: pairs.pop(key) for key in list(pairs) if key in PARTS}
        inner = self._inner
        if parts:
            table = json.loads(_softstop.toml_to_json(inner.to_toml()))
            for name, part in parts.items():
                place = table if name == "start" else table.get("ratios", table)
                place[PARTS[name]] = _part(name, part)
            inner = _of_table(table)
        return Machine._of(inner.replaced([(str(key), word_of(str(key), value)) for key, value in pairs.items()]))

    @property
    def parameters(self) -> dict[str, float]:
        """The numbers that it has, by key, in its own units."""
        return {key: value for key, value, _, _ in self._inner.parameters()}

    @property
    def name(self) -> str | None:
        """Its name, if it has one."""
        return self._inner.name

    @property
    def start(self) -> tuple[float, float]:
        """Position and velocity at time 0."""
        return self._inner.start

    @property
    def period(self) -> float:
        """The drive period in s."""
        return self._inner.period

    def to_toml(self) -> str:
        """The text of its file, complete; `from_toml` makes the same machine of it."""
        return self._inner.to_toml()

    @checked
    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes its file."""
        pathlib.Path(path).write_text(self.to_toml(), encoding="utf-8")

    @checked
    def fmu(self, path: str | os.PathLike[str]) -> None:
        """Writes it as an FMU 2.0 for co-simulation, which starts in its initial state."""
        pathlib.Path(path).write_bytes(self._inner.fmu())

    def __getitem__(self, key: str) -> float:
        """The number of a key, older name or letter."""
        try:
            return self._inner.value(key)
        except _softstop.MachineError as error:
            raise KeyError(str(error)) from error

    def __iter__(self) -> Iterator[str]:
        return iter(self.parameters)

    def __len__(self) -> int:
        return len(self.parameters)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Machine) and self._inner == other._inner

    def __hash__(self) -> int:
        return hash(self.to_toml())

    def __repr__(self) -> str:
        pairs = ", ".join(f"{key}={value:g}" for key, value in self.parameters.items())
        return f"<Machine {self.name or ''}: {pairs}>"

    def _repr_html_(self) -> str:
        """A sketch with its dimensions, and its numbers."""
        from html import escape

        sketch = self._inner.sketch()
        sketch = sketch[sketch.index("<svg"):]

        rows = "".join(
            f"<tr><td>{escape(meaning)}</td><td><code>{escape(key)}</code></td>"
            f"<td style='text-align:right'>{value:.7g}</td><td>{escape(unit)}</td></tr>"
            for key, value, unit, meaning in self._inner.parameters()
        )
        return f"{sketch}<table><caption>{escape(self.name or 'machine')}</caption>{rows}</table>"

    def __reduce__(self) -> tuple[Any, ...]:
        return Machine.from_toml, (self.to_toml(),)


def _of_table(table: Mapping[str, Any]) -> _softstop.Machine:
    return _softstop.Machine.from_json(json.dumps(_tables(table)))


@checked
def read(path: str | os.PathLike[str]) -> Machine:
    """The machine of a TOML file, called as the file if that gives it no name.

    Parameters
    ----------
    path : path
        The file (`softstop schema` says what it may hold).

    Returns
    -------
    Machine
        The machine.

    Raises
    ------
    MachineError
        With line and key of what cannot be.
    OSError
        If the file cannot be read.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     Machine.unloaded().save(f"{folder}/machine.toml")
    ...     read(f"{folder}/machine.toml") == Machine.unloaded()
    True
    """
    file = pathlib.Path(path)
    return Machine._of(_softstop.Machine.from_toml(file.read_text(encoding="utf-8"), file.stem))
