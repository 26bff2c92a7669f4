"""fmuloader, a ctypes binding of its own; here it gives the unit no memory functions.

fmuloader 0.1.2rc0 asks for the functions of model exchange as well when it loads a unit for
co-simulation, which need not have them. They are put in as functions that fail when called.
"""

import ctypes

import pytest

pytest.importorskip("fmuloader", reason="fmuloader is not installed")
pytest.importorskip("fmureader", reason="fmureader is not installed")

import fmuloader.fmi2  # noqa: E402
from fmuloader.fmi2 import Fmi2Error, Fmi2Slave, Fmi2StatusKind, Fmi2Type  # noqa: E402
from fmureader.fmi import read_model_description  # noqa: E402
from machine import (  # noqa: E402
    OBSERVED, PERIOD, PUSH, PUSHED, check_orbit, check_pushed, orbit_values,
)


class Library(ctypes.CDLL):
    """A shared library; a function that it lacks is missed only when it is called."""

    def __getattr__(self, name):
        try:
            return super().__getattr__(name)
        except AttributeError:
            def missing(*_):
                raise NotImplementedError(name)
            return missing


class Loaded:
    """One unit; knows the references of its variables."""

    def __init__(self, path, description, values=None):
        self.references = {v.name: v.value_reference for v in description.model_variables}
        self.slave = Fmi2Slave(path, model_identifier=description.co_simulation.model_identifier)
        self.slave.instantiate(
            "unit", Fmi2Type.CO_SIMULATION, guid=description.guid,
            cannot_use_memory_management_functions=True,
        )
        # Before the experiment is set up, as importers with a parameter dialogue do it.
        for name, value in (values or {}).items():
            self.slave.set_real([self.references[name]], [value])
        self.slave.setup_experiment(start_time=0.0)
        self.slave.enter_initialization_mode()
        self.slave.exit_initialization_mode()

    def get(self, *names):
        values = []
        for name in names:
            get = self.slave.get_integer if name.endswith(".count") else self.slave.get_real
            values += get([self.references[name]])
        return values


@pytest.fixture(autouse=True)
def co_simulation_only(monkeypatch):
    monkeypatch.setattr(fmuloader.fmi2, "CDLL", Library)


@pytest.fixture(scope="module")
def description(path):
    return read_model_description(path)


@pytest.mark.parametrize("per_period", [0.1, 1, 100, 1000])
def test_orbit(path, description, orbit, per_period):
    unit = Loaded(path, description, orbit_values(orbit))
    for number in range(round(10 * per_period)):
        unit.slave.do_step(number * PERIOD / per_period, PERIOD / per_period)
    check_orbit(orbit, 10, 0.0, unit.get(*OBSERVED))
    unit.slave.terminate()
    unit.slave.free_instance()


def test_force_between_initialisation_and_first_step(path, description):
    unit = Loaded(path, description, PUSHED)
    unit.slave.set_real([unit.references["force"]], [PUSH])
    unit.slave.do_step(0.0, 3 * PERIOD)
    check_pushed(3 * PERIOD, unit.get("position", "velocity", "impact.count"))


def test_input_and_output_derivatives(path, description):
    one, many = (Loaded(path, description, PUSHED) for _ in range(2))
    force = one.references["force"]
    for unit in (one, many):
        unit.slave.set_real_input_derivatives([force], [1], [0.03])
    one.slave.do_step(0.0, 10.0)
    for number in range(1000):
        many.slave.do_step(number * 0.01, 0.01)
    assert one.get("position") == pytest.approx(many.get("position"), abs=1e-10)
    position = one.references["position"]
    rates = one.slave.get_real_output_derivatives([position, position], [1, 2])
    assert rates == one.get("velocity", "acceleration")


def test_state_is_set_back(path, description):
    unit = Loaded(path, description)
    unit.slave.do_step(0.0, PERIOD)
    state = unit.slave.get_fmu_state()
    unit.slave.do_step(PERIOD, 3.0)
    first = unit.get(*OBSERVED)
    unit.slave.set_fmu_state(state)
    unit.slave.do_step(PERIOD, 3.0)
    assert unit.get(*OBSERVED) == first
    unit.slave.free_fmu_state(state)


def test_state_goes_through_bytes(path, description):
    if not description.co_simulation.can_serialize_fmu_state:
        pytest.skip("the unit says that it cannot serialise its state")
    unit, other = (Loaded(path, description) for _ in range(2))
    unit.slave.do_step(0.0, PERIOD)
    state = unit.slave.get_fmu_state()
    blob = unit.slave.serialize_fmu_state(state)
    unit.slave.do_step(PERIOD, 3.0)
    other.slave.set_fmu_state(other.slave.deserialize_fmu_state(blob))
    other.slave.do_step(PERIOD, 3.0)
    assert other.get(*OBSERVED) == unit.get(*OBSERVED)


def test_directional_derivative_before_any_impact(path, description):
    if not description.co_simulation.provides_directional_derivative:
        pytest.skip("the unit says that it has no directional derivatives")
    unit = Loaded(path, description)
    pair = [unit.references["acceleration"]], [unit.references["force"]]
    assert unit.slave.get_directional_derivative(*pair, [1.0]) == pytest.approx([1.0])


def test_status_after_a_step_and_a_refused_one(path, description):
    unit = Loaded(path, description)
    unit.slave.do_step(0.0, 0.5)
    last = unit.slave.get_real_status(Fmi2StatusKind.LAST_SUCCESSFUL_TIME)
    assert last == pytest.approx(0.5)
    with pytest.raises(Fmi2Error):
        unit.slave.do_step(0.5, -1.0)
    unit.slave.do_step(0.5, 0.5)
    assert unit.slave.get_boolean_status(Fmi2StatusKind.TERMINATED) is False


def test_reset(path, description):
    unit = Loaded(path, description)
    unit.slave.do_step(0.0, 2.0)
    unit.slave.reset()
    unit.slave.setup_experiment(start_time=0.0)
    unit.slave.enter_initialization_mode()
    unit.slave.exit_initialization_mode()
    unit.slave.do_step(0.0, 10 * PERIOD)
    check_orbit("loaded", 10, 0.0, unit.get(*OBSERVED))
