"""FMUGym, environments for reinforcement learning: acts on an input, observes outputs, resets."""

from types import SimpleNamespace

import numpy as np
import pytest

pytest.importorskip("fmugym", reason="fmugym is not installed")

from fmugym import FMUGym, VarSpace  # noqa: E402
from machine import (  # noqa: E402
    OBSERVED, PERIOD, PUSH, PUSHED, check_orbit, check_pushed, orbit_values,
)


class Machine(FMUGym):
    """The unit; the action is the force, one action holds for ten steps."""

    def __init__(self, path, values, step):
        self.values = values
        force, seen = VarSpace("inputs"), VarSpace("outputs")
        force.add_var_box("force", np.array([-1.0]), np.array([1.0]))
        seen.add_var_box("position", np.array([-20.0]), np.array([20.0]))
        seen.add_var_box("velocity", np.array([-20.0]), np.array([20.0]))
        nothing = VarSpace("nothing")
        super().__init__(SimpleNamespace(
            fmu_path=path, start_time=0.0, stop_time=100.0, sim_step_size=step,
            action_step_size=9.5 * step, inputs=force, outputs=seen, input_noise=nothing,
            output_noise=nothing, random_vars=nothing,
        ))

    def _noisy_init(self):
        variables = self.fmu_description.modelVariables
        return {v.valueReference: self.values[v.name] for v in variables if v.name in self.values}

    def _get_terminated(self):
        return False, False

    def compute_reward(self, *_):
        return 0.0

    def exact(self, names):
        """Outputs in full precision; observations have single precision."""
        variables = {v.name: v for v in self.fmu_description.modelVariables}
        read = {"Real": self.fmu.getReal, "Integer": self.fmu.getInteger}
        return [read[variables[n].type]([variables[n].valueReference])[0] for n in names]


def test_episodes(path, orbit):
    machine = Machine(path, orbit_values(orbit), PERIOD / 50)
    for _ in range(3):
        machine.reset()
        for _ in range(50):
            seen, *_ = machine.step(np.array([0.0]))
        check_orbit(orbit, 10, machine.time - 10 * PERIOD, machine.exact(OBSERVED))
        np.testing.assert_allclose(seen, machine.exact(OBSERVED[:2]), rtol=1e-6)
    machine.close()


def test_action(path):
    machine = Machine(path, PUSHED, PERIOD / 20)
    machine.reset()
    for _ in range(6):
        machine.step(np.array([PUSH]))
    check_pushed(machine.time, machine.exact(["position", "velocity", "impact.count"]))
    machine.close()
