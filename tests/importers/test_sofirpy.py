"""sofirpy, a simulator of units and Python models that are wired to each other."""

import pytest

pytest.importorskip("sofirpy", reason="sofirpy is not installed")

from machine import (  # noqa: E402
    OBSERVED, PERIOD, PUSH, PUSHED, check_orbit, check_pushed, orbit_values,
)
from sofirpy import SimulationEntity, simulate  # noqa: E402


class Pusher(SimulationEntity):
    """Gives a steady force from the start."""

    def initialize(self, start_values):
        del start_values

    def do_step(self, time):
        del time

    def get_parameter_value(self, parameter_name):
        assert parameter_name == "out"
        return PUSH

    def set_parameter(self, parameter_name, parameter_value):
        raise NotImplementedError((parameter_name, parameter_value))


@pytest.mark.parametrize("per_period", [1, 100])
def test_orbit(path, orbit, per_period):
    step = PERIOD / per_period
    table = simulate(
        stop_time=(10 * per_period + 0.5) * step, step_size=step, fmu_paths={"unit": path},
        start_values={"unit": orbit_values(orbit)}, parameters_to_log={"unit": OBSERVED},
    )
    last = table.iloc[-1]
    late = last["time"] - 10 * PERIOD
    check_orbit(orbit, 10, late, [last[f"unit.{name}"] for name in OBSERVED])


def test_force_from_a_model_in_python(path):
    step, observed = PERIOD / 10, ["position", "velocity", "impact.count"]
    table = simulate(
        stop_time=30.5 * step, step_size=step, fmu_paths={"unit": path},
        model_classes={"pusher": Pusher},
        connections_config={"unit": [
            {"parameter_name": "force", "connect_to_system": "pusher",
             "connect_to_external_parameter": "out"},
        ]},
        start_values={"unit": PUSHED | {"force": PUSH}}, parameters_to_log={"unit": observed},
    )
    last = table.iloc[-1]
    check_pushed(last["time"], [last[f"unit.{name}"] for name in observed])
