"""Motions: one, or many at once."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, overload

import numpy as np
import numpy.typing as npt

from . import _softstop, plot
from ._checks import checked, floats, pair
from ._forces import Floats, Forces, pieces_of
from ._machine import Machine
from ._motion import Motion
from ._progress import shown
from ._table import Table

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MAX_PERIODS = 1_000_000
MAX_KEPT_PERIODS = 100_000
MAX_KEPT = 100_000_000
MAX_MOTIONS = 100_000_000
"""Drive periods of a motion at most; of one that is kept whole, some 100 MB; impacts that a batch may keep, some 4 GB, if there
is one in each period; motions of a batch."""
BATCHES = 32
"""Batches of drive periods whose means tell how uncertain an exponent is."""


@dataclass(frozen=True)
class Motions:
    """Many motions, in the shape to which the arguments broadcast, as `simulate` follows them.

    Attributes
    ----------
    machine : Machine
        The machine whose values were stated.
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
    values : dict of array
        The values of the machine that were stated, in the shape of the motions.

    Examples
    --------
    >>> import numpy as np, softstop as ss
    >>> eta = np.linspace(0.95, 1.4, 1000)
    >>> batch = ss.simulate(ss.Machine.unloaded(clearance=10), eta=eta, start=(0, 14), periods=200, keep=8)
    >>> batch.counts.shape, len(batch.offsets)
    ((1000,), 1001)
    """

    machine: Machine
    position: Floats
    velocity: Floats
    counts: npt.NDArray[np.uint64]
    impacts: Table
    offsets: npt.NDArray[np.int64]
    errors: dict[int, str]
    values: dict[str, Floats]

    def plot(self, axes: Axes | None = None, *, over: str | None = None) -> Axes:
        """Draws the velocities of the impacts that were kept over a value that was an array; returns the Matplotlib axes."""
        return plot.motions(self, over, axes)

    def __repr__(self) -> str:
        return f"<Motions {self.position.shape}: {int(self.counts.sum())} impacts, {len(self.impacts)} kept>"


@dataclass(frozen=True)
class Exponents:
    """Lyapunov exponents of motions of the state (position, velocity), in the shape to which the arguments broadcast.

    Attributes
    ----------
    per_period, per_second : array
        Both exponents, the larger first, along a last axis of length 2: of the map in 1, and of the flow in 1/s.
    error : array
        Half-width of the 95 % interval of the larger one per period, from the means of 32 batches of drive periods.
    chaotic : array of bool
        Where the larger one is positive beyond doubt: above zero by more than three half-widths.
    periods : int
        Drive periods that they are the mean over.
    errors : dict
        Why motions could not be followed, by their number in the flattened shape.
    """

    per_period: Floats
    per_second: Floats
    error: Floats
    chaotic: npt.NDArray[np.bool_]
    periods: int
    errors: dict[int, str]


@dataclass(frozen=True)
class _Rows:
    """Arguments as arrays of one shape, flattened: positions, velocities, values of the machine."""

    shape: tuple[int, ...]
    start: tuple[Floats, Floats]
    changes: dict[str, Floats]

    @classmethod
    def of(cls, machine: Machine, start: object, changes: Mapping[str, npt.ArrayLike]) -> _Rows:
        begin = pair("start", machine.start if start is None else start)
        for key in changes:
            if key.startswith("initial"):
                raise _softstop.MachineError(f"{key}: is the start: start=(position, velocity)")
        names = ["start[0]", "start[1]", *changes]
        values = [floats(name, value) for name, value in zip(names, [*begin, *changes.values()], strict=True)]
        try:
            shape = np.broadcast_shapes(*(value.shape for value in values))
        except ValueError as error:
            shapes = ", ".join(f"{name} {value.shape}" for name, value in zip(names, values, strict=True))
            raise _softstop.MachineError(f"{shapes}: do not broadcast to one shape") from error
        if math.prod(shape) > MAX_MOTIONS:
            raise _softstop.MachineError(f"{', '.join(names)}: {math.prod(shape)} motions, at most {MAX_MOTIONS}")
        x, v, *rest = (np.ascontiguousarray(np.broadcast_to(value, shape)).ravel() for value in values)
        return cls(shape, (x, v), dict(zip(changes, rest, strict=True)))

    @property
    def keyed(self) -> list[tuple[str, Floats]]:
        """The values by key."""
        return [(key.replace("__", "."), value) for key, value in self.changes.items()]


@overload
def simulate(  # pyright: ignore[reportOverlappingOverload]
    machine: Machine, *, start: Sequence[float] | None = ..., periods: int = ..., keep: None = ...,
    forces: Forces | None = ..., progress: bool = ..., **changes: float,
) -> Motion: ...
@overload
def simulate(
    machine: Machine, *, start: Sequence[npt.ArrayLike] | None = ..., periods: int = ...,
    keep: int | None = ..., forces: None = ..., progress: bool = ..., **changes: npt.ArrayLike,
) -> Motions: ...
@checked
def simulate(
    machine: Machine,
    *,
    start: Sequence[npt.ArrayLike] | None = None,
    periods: int = 100,
    keep: int | None = None,
    forces: Forces | None = None,
    progress: bool = True,
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
        Of many motions: so many of the last periods have their impacts kept, 0 unless it is stated. One motion has them all.
    forces : (times, values) or piecewise polynomials, optional
        With one motion: an external force in N over time in s, beside the drive. As many values as times are joined by
        straight lines; one value less is held between two times each, in steps; SciPy's `CubicSpline` and other `PPoly` up to
        degree 7 are followed as they are. All are exact. There is no force before the first time and after the last one.
    progress : bool
        Whether progress of many motions is shown, where tqdm is installed.
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
        With the parameter, its value and the allowed range: if one value of the machine, or of a start, cannot be, no motion is
        followed.
    SoftstopError
        If the motion cannot be followed; of many, `errors` of the result says which cannot, as from beyond a rigid stop.

    Examples
    --------
    >>> import numpy as np, softstop as ss
    >>> machine = ss.Machine.unloaded(eta=1.15, clearance=10)
    >>> len(ss.simulate(machine, start=(0, 14), periods=300).impacts)
    300
    >>> ss.simulate(machine, eta=[1.1, 1.2], clearance=[[9], [10], [11]], start=(0, 14), periods=300).counts.shape
    (3, 2)
    >>> pushed = ss.simulate(machine, start=(0, 0), periods=20, forces=([0, 5, 5, 8], [0, 40, 40, 0]))
    >>> len(pushed.impacts) > 0
    True
    """
    periods = _count("periods", periods, 1, MAX_PERIODS)
    kept = _count("keep", 0 if keep is None else keep, 0, MAX_PERIODS)
    rows = _Rows.of(machine, start, changes)
    x, v = rows.start
    if rows.shape == ():
        if keep is not None:
            raise _softstop.MachineError(f"keep = {keep}: for many motions; one motion has all its impacts")
        periods = _count("periods", periods, 1, MAX_KEPT_PERIODS)
        changed = machine.replace(**{key: float(value[0]) for key, value in rows.changes.items()})
        return Motion(changed, (float(x[0]), float(v[0])), periods, pieces_of(forces))
    if forces is not None:
        raise _softstop.MachineError("forces: for one motion; the lanes of many motions know of none")
    if len(x) * kept > MAX_KEPT:
        words = f"keep = {keep}: with {len(x)} motions at most {MAX_KEPT // len(x)}, for memory's sake"
        raise _softstop.MachineError(words)
    with shown(progress) as teller:
        batch = _softstop.follow(machine._inner, rows.keyed, rows.start, periods, kept, teller)
    motion = np.repeat(np.arange(len(x), dtype=np.float64), np.diff(batch.offsets))
    return Motions(
        machine,
        batch.position.reshape(rows.shape),
        batch.velocity.reshape(rows.shape),
        batch.counts.reshape(rows.shape),
        Table({"motion": motion, "time": batch.times, "velocity": batch.velocities}),
        batch.offsets,
        dict(batch.errors),
        {name: value.reshape(rows.shape) for name, value in rows.changes.items()},
    )


@checked
def exponents(
    machine: Machine,
    *,
    start: Sequence[npt.ArrayLike] | None = None,
    transient: int = 1000,
    periods: int = 3200,
    progress: bool = True,
    **changes: npt.ArrayLike,
) -> Exponents:
    """Both Lyapunov exponents of a motion, by the exact tangent with saltation at all crossings; of many motions where a value is
    an array.

    Parameters
    ----------
    machine : Machine
        The machine.
    start : (position, velocity), optional
        State at time 0 in m and m/s, each a number or an array; the machine's own unless it is stated.
    transient : int
        Drive periods ahead, 1 to 1,000,000.
    periods : int
        Drive periods that the exponents are the mean over, 32 to 1,000,000; rounded up to a multiple of 32.
    progress : bool
        Whether progress is shown, where tqdm is installed.
    **changes : float or array
        Values of the machine by key or letter, as in `Machine.replace`; arrays broadcast as in NumPy.

    Returns
    -------
    Exponents
        Per drive period and per second, with the half-width of the 95 % interval. NaN where a motion could not be followed.

    Raises
    ------
    MachineError
        As of `simulate`.
    SoftstopError
        If the motion, if it is one, cannot be followed.

    Examples
    --------
    >>> import softstop as ss
    >>> found = ss.exponents(ss.Machine.unloaded(clearance=10), eta=[0.97, 1.15], start=(0, 14))
    >>> found.chaotic
    array([ True, False])
    >>> found.per_period.shape
    (2, 2)
    """
    transient = _count("transient", transient, 1, MAX_PERIODS)
    batch = -(-_count("periods", periods, BATCHES, MAX_PERIODS) // BATCHES)
    rows = _Rows.of(machine, start, changes)
    with shown(progress) as teller:
        columns, errors = _softstop.exponents(machine._inner, rows.keyed, rows.start, transient, batch, teller)
    if rows.shape == () and errors:
        raise _softstop.SoftstopError(errors[0][1])
    larger, smaller, error, chaotic, period = (column.reshape(rows.shape) for column in columns)
    per_period = np.stack([larger, smaller], axis=-1)
    return Exponents(
        per_period, per_period / period[..., None], error, chaotic == 1.0, BATCHES * batch, dict(errors)
    )


def _count(name: str, value: int, least: int, most: int) -> int:
    """A whole number within a range."""
    if isinstance(value, bool) or not hasattr(value, "__index__") or not least <= value <= most:
        raise _softstop.MachineError(f"{name} = {value!r}: must be a whole number in [{least}, {most}]")
    return int(value)
