"""Forces in time: polynomials, piece by piece."""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from . import _softstop
from ._checks import floats

Floats = npt.NDArray[np.float64]


class Polynomials(Protocol):
    """Piecewise polynomials as SciPy's `PPoly`: `CubicSpline`, `PchipInterpolator`, `Akima1DInterpolator` and others are some;
    of a `BPoly`, `PPoly.from_bernstein_basis` makes one."""

    @property
    def x(self) -> Any:
        """Times between the pieces, in s: one more than there are pieces."""

    @property
    def c(self) -> Any:
        """Coefficients, a column for each piece, the highest power of (t - x[i]) first, in N/s^k."""


Forces = Polynomials | tuple[npt.ArrayLike, npt.ArrayLike]
Pieces = tuple[Floats, Floats]


def pieces_of(forces: Forces | None) -> Pieces:
    """When each piece begins, in s, and its derivatives then, value first; none before the first time and after the last."""
    if forces is None:
        return np.zeros(0), np.zeros((0, 1))
    if isinstance(forces, tuple):
        if len(forces) != 2:
            raise _softstop.MachineError("forces: must be (times, values), or piecewise polynomials with x and c as of SciPy")
        times, coefficients = floats("forces[0]", forces[0]), floats("forces[1]", forces[1])
        if times.shape == coefficients.shape and times.ndim == 1:
            with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
                slopes = np.diff(coefficients) / np.diff(times)
            coefficients = np.array([slopes, coefficients[:-1]])
        elif coefficients.ndim == 1:
            coefficients = coefficients[None, :]
    elif hasattr(forces, "x") and hasattr(forces, "c") and type(forces).__name__ != "BPoly":
        times, coefficients = floats("forces.x", forces.x), floats("forces.c", forces.c)
    else:
        raise _softstop.MachineError(f"forces = {forces!r}: must be (times, values), or piecewise polynomials with x and c as of SciPy")
    if times.ndim != 1 or coefficients.ndim != 2 or len(times) != coefficients.shape[1] + 1:
        shapes = f"{times.shape} and {coefficients.shape}"
        raise _softstop.MachineError(f"forces: shapes {shapes}: must be as many values as times, or one less for steps")
    lengths = np.diff(times)
    if not (np.isfinite(times).all() and times[0] >= 0 and (lengths >= 0).all()):
        raise _softstop.MachineError("forces: times must be finite, >= 0 and rise")
    with np.errstate(over="ignore", invalid="ignore"):
        factorials = np.cumprod(np.maximum(np.arange(len(coefficients), dtype=np.float64), 1.0))
        derivatives = (coefficients[::-1].T * factorials)[lengths > 0]
    last = np.zeros((1, len(factorials)))
    return np.append(times[:-1][lengths > 0], times[-1]), np.ascontiguousarray(np.concatenate([derivatives, last]))
