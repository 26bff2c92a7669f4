"""The unit for FMI 3.0 in fmuloader, beside FMPy: events and states to the bit; and checkers."""

import subprocess
import sys

import numpy as np
import pytest
from machine import PERIOD, UNITS, orbit_values, package_3

fmpy = pytest.importorskip("fmpy", reason="fmpy is not installed")

NAMES = ["impact.time", "impact.velocity", "position", "velocity", "energy.dissipated"]
HANDLINGS = [(events, early) for events in (False, True) for early in (False, True)]
SIZES = [1e-4, 1e-2, PERIOD / 100, 0.7, PERIOD, 10 * PERIOD]


@pytest.fixture
def path_3(path):
    return package_3(path, "softstop")


def run(path, values, handling, size, end):
    """States after all events that a step ends at, and at the end."""
    loader = pytest.importorskip("fmuloader.fmi3", reason="fmuloader is not installed")
    description = fmpy.read_model_description(path)
    references = {v.name: v.valueReference for v in description.modelVariables}
    observed = [references[name] for name in NAMES]
    slave = loader.Fmi3Slave(path, model_identifier="softstop")
    slave.instantiate_co_simulation(
        "unit", instantiation_token=description.guid,
        event_mode_used=handling[0], early_return_allowed=handling[1],
    )
    for name, value in values.items():
        slave.set_float64([references[name]], [value])
    slave.enter_initialization_mode(start_time=0.0)
    slave.exit_initialization_mode()
    if handling[0]:
        slave.update_discrete_states()
        slave.enter_step_mode()
    time, number, events = 0.0, 1, []
    while time < end:
        aim = min(number * size, end)
        step = slave.do_step(time, aim - time)
        time, number = (step.last_successful_time, number) if step.early_return else (aim, number + 1)
        if step.event_handling_needed:
            slave.enter_event_mode()
            slave.update_discrete_states()
            slave.enter_step_mode()
        if step.early_return:
            events.append([float(value).hex() for value in (time, *slave.get_float64(observed))])
    last = [float(value).hex() for value in slave.get_float64(observed)]
    slave.terminate()
    slave.free_instance()
    return events, last


@pytest.mark.parametrize("size", SIZES)
def test_fmuloader_sees_what_fmpy_sees(path_3, orbit, size):
    values, end = orbit_values(orbit), PERIOD if size == 1e-4 else 10 * PERIOD
    rows = fmpy.simulate_fmu(path_3, start_values=values, stop_time=end, output_interval=size,
                             output=[*NAMES, "impact.count"], use_event_mode=True, early_return_allowed=True)
    struck = rows[np.flatnonzero(np.diff(rows["impact.count"])) + 1]
    told = [[float(row[name]).hex() for name in ("time", *NAMES)] for row in struck]
    last = [float(rows[-1][name]).hex() for name in NAMES]
    for handling in HANDLINGS:
        events, own = run(path_3, values, handling, size, end)
        assert own == last
        assert bool(events) == handling[1]
        if handling[1]:
            assert [event for event in events if event[0] == event[1]] == told
    assert len(told) == round(end / PERIOD)


@pytest.mark.parametrize("unit", UNITS)
def test_fmu_manipulation_toolbox_finds_nothing(path, unit):
    pytest.importorskip("fmu_manipulation_toolbox", reason="the FMU Manipulation Toolbox is not installed")
    command = [sys.executable, "-m", "fmu_manipulation_toolbox.cli.fmutool", "-input", package_3(path, unit), "-check"]
    done = subprocess.run(command, capture_output=True, text=True)
    text = done.stdout + done.stderr
    assert "This FMU seems to be compliant with FMI-3.0." in text and "No semantic error" in text, text
    assert "ERROR" not in text and "WARNING" not in text
