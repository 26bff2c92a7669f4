"""PathSim, a block simulator: the unit as a block among others.

pathsim-fmi 0.1.1 sets every input with fmi2SetReal and reads every output with fmi2GetReal, also
those that are no real numbers. These are taken out of the model description first.
"""

import pytest

pytest.importorskip("pathsim_fmi", reason="pathsim-fmi is not installed")
pytest.importorskip("fmu_manipulation_toolbox", reason="fmu-manipulation-toolbox is not installed")

import fmpy  # noqa: E402
from fmu_manipulation_toolbox.operations import FMU, OperationRemoveRegexp  # noqa: E402
from machine import OBSERVED, PERIOD, check_orbit, orbit_values  # noqa: E402
from pathsim import Connection, Simulation  # noqa: E402
from pathsim.blocks import Scope, Source  # noqa: E402
from pathsim_fmi import CoSimulationFMU  # noqa: E402


@pytest.fixture(scope="module")
def real_outputs_only(path, tmp_path_factory):
    fmu = FMU(path)
    fmu.apply_operation(OperationRemoveRegexp(r"material|phase|(impact|pierce)\.((step|below)\.)?count"))
    trimmed = tmp_path_factory.mktemp("pathsim") / "softstop.fmu"
    fmu.repack(str(trimmed))
    fmu.close()
    return trimmed


def test_orbit(path, real_outputs_only, orbit):
    step = PERIOD / 50
    unit = CoSimulationFMU(str(real_outputs_only), start_values=orbit_values(orbit), dt=step)
    force, scope = Source(lambda t: 0.0), Scope(labels=["position"])
    wires = [Connection(force, unit["force"]), Connection(unit["position"], scope)]
    simulation = Simulation([unit, force, scope], wires, dt=step, log=False)
    # The unit steps ahead at each instant, the last one is a step before the end.
    simulation.run(10 * PERIOD - 1.5 * step)
    values = [unit.outputs[name] for name in OBSERVED[:3]]
    variables = fmpy.read_model_description(path).modelVariables
    counts = [v.valueReference for v in variables if v.name in OBSERVED[3:]]
    values += unit.fmu_wrapper.fmu.getInteger(counts)
    check_orbit(orbit, 10, 0.0, values)
