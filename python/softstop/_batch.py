"""Motions: one, or many at once."""

from __future__ import annotations

from dataclasses import dataclass
from typing import overload

import numpy as np
import numpy.typing as npt

from . import _softstop
from ._machine import Machine
from ._motion import Floats, Motion
from ._result import Table

MAX_PERIODS = 1_000_000
MAX_KEPT_PERIODS = 100_000
MAX_KEPT = 100_000_000
"""Drive periods of a motion at most; of one that is kept whole, some 100 MB; impacts that a batch may keep, some 4 GB, if there
is one in each period."""


@dataclass(frozen=True)
class Motions:
    """Many motions, in the shape to which the arguments broadcast.

    Attributes
    ----------
    position, velocity : array
        State at the end in m and m/s.
    counts : array of int
        Impacts on the way.
    impacts : Table
        The impacts that were kept, motion after motion: motion (number in the flattened shape), time in s, velocity in m/s.
    offsets : array of int
        The impacts of motion i are the rows offsets[i] to offsets[i + 1].
    errors : dict
        Why motions ended early, by their number.
    """

    position: Floats
    velocity: Floats
    counts: npt.NDArray[np.uint64]
    impacts: Table
    offsets: npt.NDArray[np.int64]
    errors: dict[int, str]

    def __repr__(self) -> str:
        return f"<Motions {self.position.shape}: {int(self.counts.sum())} impacts, {len(self.impacts)} kept>"


@overload
def simulate(
    machine: Machine, *, start: tuple[float, float] | None = ..., periods: int = ..., keep: int | None = ...,
    **changes: float,
) -> Motion: ...
@overload
def simulate(
    machine: Machine, *, start: tuple[npt.ArrayLike, npt.ArrayLike] | None = ..., periods: int = ...,
    keep: int | None = ..., **changes: npt.ArrayLike,
) -> Motion | Motions: ...
def simulate(
    machine: Machine,
    *,
    start: tuple[npt.ArrayLike, npt.ArrayLike] | None = None,
    periods: int = 100,
    keep: int | None = None,
    **changes: npt.ArrayLike,
) -> Motion | Motions:
    """Follows a motion exactly; many at once, on all processors, where a value is an array.

    Parameters
    ----------
    machine : Machine
        The machine.
    start : (position, velocity), optional
        State at time 0 in m and m/s, each a number or an array; the machine's own unless it is stated.
    periods : int
        Drive periods to follow, 1 to 1,000,000; of one motion, which is kept whole, 100,000 at most.
    keep : int, optional
        With arrays: so many of the last periods have their impacts kept, 0 unless it is stated.
    **changes : float or array
        Values of the machine by key or letter, as in `Machine.replace`; arrays broadcast as in NumPy.

    Returns
    -------
    Motion
        If all values are numbers.
    Motions
        If one is an array.

    Raises
    ------
    MachineError
        With the parameter, its value and the allowed range.
    SoftstopError
        If the motion cannot be followed.
    """
    periods = _count("periods", periods, 1, MAX_PERIODS)
    keep = _count("keep", 0 if keep is None else keep, 0, MAX_PERIODS)
    begin = machine.start if start is None else start
    if not isinstance(begin, tuple) or len(begin) != 2:
        raise _softstop.MachineError(f"start = {begin!r}: must be (position, velocity)")
    names = ["start[0]", "start[1]", *changes]
    values = [_floats(name, value) for name, value in zip(names, [*begin, *changes.values()], strict=True)]
    if all(value.ndim == 0 for value in values):
        periods = _count("periods", periods, 1, MAX_KEPT_PERIODS)
        changed = machine.replace(**{key: float(value) for key, value in zip(changes, values[2:], strict=True)})
        state = float(values[0]), float(values[1])
        return Motion(changed, _softstop.Trajectory(changed._inner, state, periods))
    try:
        shape = np.broadcast_shapes(*(value.shape for value in values))
    except ValueError as error:
        shapes = ", ".join(f"{name} {value.shape}" for name, value in zip(names, values, strict=True))
        raise _softstop.MachineError(f"{shapes}: do not broadcast to one shape") from error
    x, v, *rest = (np.ascontiguousarray(np.broadcast_to(value, shape)).ravel() for value in values)
    if len(x) * keep > MAX_KEPT:
        words = f"keep = {keep}: with {len(x)} motions at most {MAX_KEPT // len(x)}, for memory's sake"
        raise _softstop.MachineError(words)
    keys = [key.replace("__", ".") for key in changes]
    batch = _softstop.follow(machine._inner, list(zip(keys, rest, strict=True)), (x, v), periods, keep)
    motion = np.repeat(np.arange(len(x), dtype=np.float64), np.diff(batch.offsets))
    return Motions(
        batch.position.reshape(shape),
        batch.velocity.reshape(shape),
        batch.counts.reshape(shape),
        Table({"motion": motion, "time": batch.times, "velocity": batch.velocities}),
        batch.offsets,
        dict(batch.errors),
    )


def _floats(name: str, value: npt.ArrayLike) -> Floats:
    """An array of numbers."""
    try:
        array = np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise _softstop.MachineError(f"{name} = {value!r}: must be a number or an array of numbers") from error
    return array


def _count(name: str, value: int, least: int, most: int) -> int:
    """A whole number within a range."""
    if isinstance(value, bool) or not hasattr(value, "__index__") or not least <= value <= most:
        raise _softstop.MachineError(f"{name} = {value!r}: must be a whole number in [{least}, {most}]")
    return int(value)
