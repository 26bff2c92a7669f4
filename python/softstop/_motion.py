"""One exact motion."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _softstop, plot
from ._checks import floats
from ._commands import picture_of
from ._forces import Floats, Pieces
from ._machine import Machine
from ._table import Table

if TYPE_CHECKING:
    from matplotlib.axes import Axes


class Motion:
    """An exact motion from time 0 over whole drive periods, as `simulate` follows it. Pickled, it is machine, start, periods
    and forces, and is followed again where it is read, on the same computer to the same bits.

    Attributes
    ----------
    machine : Machine
        The machine.

    Examples
    --------
    >>> import softstop as ss
    >>> motion = ss.simulate(ss.Machine.unloaded(eta=1.15, clearance=10), start=(0, 14), periods=300)
    >>> round(float(motion.impacts.velocity[-1]), 9)
    6.494627429
    >>> motion.position([0.0, 1.0]).shape
    (2,)
    """

    def __init__(self, machine: Machine, start: tuple[float, float], periods: int, forces: Pieces) -> None:
        self.machine = machine
        self._start = start
        self._periods = periods
        self._forces = forces
        self._inner = _softstop.Trajectory(machine._inner, start, periods, forces)

    @property
    def duration(self) -> float:
        """Time at the end in s."""
        return self._inner.duration

    @property
    def impacts(self) -> Table:
        """Each impact: time in s, before-impact velocity in m/s."""
        times, velocities = self._inner.impacts()
        return Table({"time": times, "velocity": velocities})

    @property
    def crossings(self) -> Table:
        """Each crossing, rest and release: time in s, position in m, velocity before and velocity_after in m/s, kind."""
        time, position, before, after, kind = self._inner.crossings()
        return Table({"time": time, "position": position, "velocity": before, "velocity_after": after, "kind": kind})

    def sample(self, times: npt.ArrayLike) -> tuple[Floats, Floats]:
        """Positions and velocities at any times, from the closed form.

        Parameters
        ----------
        times : array
            Times in s within the motion, of any shape.

        Returns
        -------
        position, velocity : arrays
            In m and m/s, of the shape of the times.

        Raises
        ------
        SoftstopError
            If a time lies outside the motion.

        Examples
        --------
        >>> import softstop as ss
        >>> position, velocity = ss.simulate(ss.Machine.unloaded(), start=(0, 14), periods=2).sample(0.0)
        >>> float(position), float(velocity)
        (0.0, 14.0)
        """
        at = floats("times", times)
        position, velocity = self._inner.sample(np.ascontiguousarray(at).ravel())
        return position.reshape(at.shape), velocity.reshape(at.shape)

    def position(self, times: npt.ArrayLike) -> Floats:
        """Positions in m at times in s."""
        return self.sample(times)[0]

    def velocity(self, times: npt.ArrayLike) -> Floats:
        """Velocities in m/s at times in s."""
        return self.sample(times)[1]

    @property
    def end(self) -> tuple[float, float]:
        """Position in m and velocity in m/s at the end."""
        return self._inner.end

    @property
    def energies(self) -> dict[str, float]:
        """Energies in J: supplied by the drive and the forces, dissipated, and stored at the end less at the start."""
        return dict(zip(["supplied", "dissipated", "stored"], self._inner.energies, strict=True))

    def plot(self, axes: Axes | None = None, *, periods: float = 4) -> Axes:
        """Draws position over time in the last drive periods, with clearance and impacts; returns the Matplotlib axes."""
        return plot.motion(self, axes, periods)

    def __repr__(self) -> str:
        return f"<Motion over {self.duration:g} s: {len(self.impacts)} impacts>"

    def _repr_mimebundle_(self, include: object = None, exclude: object = None) -> dict[str, str]:
        # The program draws motions without forces.
        picture = {} if len(self._forces[0]) else {"image/svg+xml": picture_of(self.machine, self._start, self._periods)}
        return {"text/plain": repr(self)} | picture

    def __reduce__(self) -> tuple[Any, ...]:
        return Motion, (self.machine, self._start, self._periods, self._forces)
