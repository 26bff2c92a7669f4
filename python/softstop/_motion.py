"""One exact motion."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from . import _softstop
from ._commands import picture_of
from ._machine import Machine
from ._result import Table

Floats = npt.NDArray[np.float64]


class Motion:
    """An exact motion from time 0 over whole drive periods."""

    def __init__(self, machine: Machine, inner: _softstop.Trajectory) -> None:
        self.machine = machine
        self._inner = inner

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
        """Each crossing, rest and release: time in s, position in m, velocity before and after in m/s, kind."""
        time, position, before, after, kind = self._inner.crossings()
        return Table({"time": time, "position": position, "velocity": before, "velocity_after": after, "kind": kind})

    def sample(self, times: npt.ArrayLike) -> tuple[Floats, Floats]:
        """Positions in m and velocities in m/s at times in s, of any shape, within the motion."""
        at = np.asarray(times, dtype=np.float64)
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
        """Position and velocity at the end."""
        return self._inner.end

    @property
    def energies(self) -> dict[str, float]:
        """Energies in J: supplied by the drive, dissipated, and stored at the end less at the start."""
        return dict(zip(["supplied", "dissipated", "stored"], self._inner.energies, strict=True))

    def __repr__(self) -> str:
        return f"<Motion over {self.duration:g} s: {len(self.impacts)} impacts>"

    def _repr_mimebundle_(self, include: object = None, exclude: object = None) -> dict[str, str]:
        x, v = self.sample([0.0])
        picture = picture_of(self.machine, (float(x[0]), float(v[0])), round(self.duration / self.machine.period))
        return {"text/plain": repr(self), "image/svg+xml": picture}
