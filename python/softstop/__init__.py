"""Exact dynamics and optimal design of impact oscillators with soft, preloaded and rigid stops.

>>> import numpy as np, softstop as ss
>>> machine = ss.Machine.unloaded(frequency=1.15, clearance=10)
>>> round(ss.orbit(machine).before_impact_velocity, 6)
6.494627
>>> batch = ss.simulate(machine, eta=np.linspace(0.95, 1.4, 1000), start=(0, 14), periods=200)
>>> batch.counts.shape
(1000,)

Machines (`Machine`, `read`) are immutable. `simulate` follows one motion or, where a value is an array, many at once on all
processors; `exponents` are Lyapunov's. `orbit`, `motions`, `zone`, `continue_`, `sweep`, `basin`, `certainty`, `study`, `fidelity` and
`optimize` are the commands of the program `softstop`, which this package installs, too: their results hold the numbers that the
program prints. What has a picture has `plot()`, which returns Matplotlib axes, where Matplotlib is installed.
"""

from ._batch import Exponents, Motions, exponents, simulate
from ._commands import (
    basin,
    basins,
    certainty,
    continue_,
    fidelity,
    motions,
    optimize,
    orbit,
    prove,
    study,
    sweep,
    zone,
)
from ._machine import Drive, Hertz, KelvinVoigt, Machine, PiecewiseLinear, Preloaded, Rigid, Strip, read
from ._motion import Motion
from ._result import Attractors, Basin, Branch, Certainty, Design, Orbit, Result, Sweep, Zone
from ._softstop import MachineError, SoftstopError, __version__
from ._table import Table

__all__ = [
    "Attractors",
    "Basin",
    "Branch",
    "Certainty",
    "Design",
    "Drive",
    "Exponents",
    "Hertz",
    "KelvinVoigt",
    "Machine",
    "MachineError",
    "Motion",
    "Motions",
    "Orbit",
    "PiecewiseLinear",
    "Preloaded",
    "Result",
    "Rigid",
    "SoftstopError",
    "Strip",
    "Sweep",
    "Table",
    "Zone",
    "basin",
    "basins",
    "certainty",
    "continue_",
    "exponents",
    "fidelity",
    "motions",
    "optimize",
    "orbit",
    "prove",
    "read",
    "simulate",
    "study",
    "sweep",
    "zone",
    "__version__",
]
