"""The machine as a component of OpenMDAO, with exact derivatives.

>>> import openmdao.api as om
>>> import softstop as ss
>>> from softstop.openmdao import ImpactMachine
>>> problem = om.Problem(reports=False)
>>> press = ss.Machine.unloaded(eta=1.15, clearance=10)
>>> _ = problem.model.add_subsystem("press", ImpactMachine(press, inputs=["clearance"], outputs=["velocity"]), promotes=["*"])
>>> _ = problem.setup()
>>> problem.run_model()
>>> round(problem["velocity"].item(), 6)
6.494627
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import openmdao.api as om  # type: ignore[import-untyped]

from . import _softstop
from ._machine import Machine


def _name(key: str) -> str:
    """OpenMDAO's name of a key: it keeps dots for itself."""
    return key.replace(".", ":")


class ImpactMachine(om.ExplicitComponent):  # type: ignore[misc]
    """Figures of a machine's stable z = 1 motion as functions of its parameters.

    Parameters
    ----------
    machine : Machine
        The machine; what is no input keeps its value.
    inputs : sequence of str
        Keys of the machine in its own units. The input of `stop.stiffness` is called `stop:stiffness`.
    outputs : sequence of str
        Figures, as those of `[require]` that one motion tells: velocity, stop_force, drive_power, stroke, ...

    Raises
    ------
    openmdao.api.AnalysisError
        From `compute`, where there is no such motion, so that drivers step back.
    """

    def __init__(
        self, machine: Machine, inputs: Sequence[str], outputs: Sequence[str] = ("velocity",), **options: Any
    ) -> None:
        self.machine = machine
        self.keys = list(inputs)
        self.figures = list(outputs)
        super().__init__(**options)

    def setup(self) -> None:
        """Declares inputs at the machine's values, outputs, and exact partial derivatives."""
        for key in self.keys:
            self.add_input(_name(key), val=self.machine[key])
        for figure in self.figures:
            self.add_output(figure)
        self.declare_partials(self.figures, [_name(key) for key in self.keys])

    def _solve(self, inputs: Any, by: list[str]) -> tuple[list[float], list[list[float]]]:
        try:
            changed = self.machine.replace({key: inputs[_name(key)].item() for key in self.keys})
            return _softstop.figures(changed._inner, self.figures, by)
        except (_softstop.SoftstopError, _softstop.MachineError) as error:
            raise om.AnalysisError(str(error)) from error

    def compute(self, inputs: Any, outputs: Any) -> None:  # pyright: ignore[reportIncompatibleMethodOverride]
        """The figures."""
        values, _ = self._solve(inputs, [])
        for figure, value in zip(self.figures, values, strict=True):
            outputs[figure] = value

    def compute_partials(self, inputs: Any, partials: Any) -> None:  # pyright: ignore[reportIncompatibleMethodOverride]
        """Their derivatives."""
        _, rows = self._solve(inputs, self.keys)
        for figure, row in zip(self.figures, rows, strict=True):
            for key, value in zip(self.keys, row, strict=True):
                partials[figure, _name(key)] = value
