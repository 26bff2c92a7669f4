"""Two coupled units in one SSP file, run by three engines that know nothing of each other.

The position of the first unit is the force on the second; the coupling is of Jacobi's kind. The
reference is the same coupling, driven by hand.
"""

import zipfile

import numpy as np
import pytest

fmpy = pytest.importorskip("fmpy", reason="fmpy, which drives the reference, is not installed")

from fmpy.fmi2 import FMU2Slave  # noqa: E402

STEP, STEPS = 0.05, 400
VELOCITY = 11.0
BINDING = """<ssd:ParameterBindings><ssd:ParameterBinding><ssd:ParameterValues>
  <ssv:ParameterSet name="run" version="1.0"><ssv:Parameters>
    <ssv:Parameter name="initial.velocity"><ssv:Real value="{}"/></ssv:Parameter>
  </ssv:Parameters></ssv:ParameterSet>
</ssd:ParameterValues></ssd:ParameterBinding></ssd:ParameterBindings>"""
SYSTEM = """<?xml version="1.0" encoding="UTF-8"?>
<ssd:SystemStructureDescription name="two" version="1.0"
    xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription"
    xmlns:ssv="http://ssp-standard.org/SSP1/SystemStructureParameterValues"
    xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon">
  <ssd:System name="system">
    <ssd:Elements>
      <ssd:Component name="first" source="resources/softstop.fmu"
          type="application/x-fmu-sharedlibrary">
        <ssd:Connectors>
          <ssd:Connector name="position" kind="output"><ssc:Real/></ssd:Connector>
        </ssd:Connectors>
        {}
      </ssd:Component>
      <ssd:Component name="second" source="resources/softstop.fmu"
          type="application/x-fmu-sharedlibrary">
        <ssd:Connectors>
          <ssd:Connector name="force" kind="input"><ssc:Real/></ssd:Connector>
          <ssd:Connector name="position" kind="output"><ssc:Real/></ssd:Connector>
        </ssd:Connectors>
      </ssd:Component>
    </ssd:Elements>
    <ssd:Connections>
      <ssd:Connection startElement="first" startConnector="position"
          endElement="second" endConnector="force"/>
    </ssd:Connections>
  </ssd:System>
  <ssd:DefaultExperiment startTime="0" stopTime="40"/>
</ssd:SystemStructureDescription>
"""


@pytest.fixture
def system(path, tmp_path):
    """Writes the SSP file, with the velocity or without."""

    def write(velocity=None):
        name = tmp_path / "two.ssp"
        binding = BINDING.format(velocity) if velocity is not None else ""
        with zipfile.ZipFile(name, "w") as archive:
            archive.writestr("SystemStructure.ssd", SYSTEM.format(binding))
            archive.write(path, "resources/softstop.fmu")
        return str(name)

    return write


def by_hand(path, folder, velocity=None, connected_initially=True):
    """Both positions at the end; the unit is unpacked in the folder."""
    description = fmpy.read_model_description(path)
    folder = fmpy.extract(path, unzipdir=str(folder))
    references = {v.name: v.valueReference for v in description.modelVariables}
    position, force = [references["position"]], [references["force"]]
    units = []
    for name in ("first", "second"):
        units.append(FMU2Slave(
            guid=description.guid, unzipDirectory=folder, modelIdentifier="softstop",
            instanceName=name,
        ))
        units[-1].instantiate()
        units[-1].setupExperiment()
    first, second = units
    if velocity is not None:
        first.setReal([references["initial.velocity"]], [velocity])
    for unit in units:
        unit.enterInitializationMode()
    if connected_initially:
        second.setReal(force, first.getReal(position))
    for unit in units:
        unit.exitInitializationMode()
    for number in range(STEPS):
        if number:
            second.setReal(force, first.getReal(position))
        for unit in units:
            unit.doStep(number * STEP, STEP)
    ends = [unit.getReal(position)[0] for unit in units]
    for unit in units:
        unit.terminate()
        unit.freeInstance()
    return ends


def test_ecos(path, system, tmp_path):
    from test_ecos import EcosSimulation

    with EcosSimulation(STEP, ssp_path=system(VELOCITY)) as simulation:
        assert simulation.init(parameter_set="run")
        simulation.step(STEPS)
        ends = [simulation.get_real(f"{name}::position") for name in ("first", "second")]
    np.testing.assert_allclose(ends, by_hand(path, tmp_path, VELOCITY), atol=1e-9)


def test_libcosim(path, system, tmp_path):
    from test_libcosim import CosimExecution, CosimObserver

    execution = CosimExecution.from_ssp_file(system(VELOCITY), round(STEP * 1e9))
    observer = CosimObserver.create_last_value()
    assert execution.add_observer(observer)
    assert execution.step(STEPS)
    units = [execution.slave_index_from_instance_name(name) for name in ("first", "second")]
    (reference,) = {
        v.reference for v in execution.slave_variables(units[0]) if v.name == b"position"
    }
    ends = [observer.last_real_values(unit, [reference])[0] for unit in units]
    np.testing.assert_allclose(ends, by_hand(path, tmp_path, VELOCITY), atol=1e-9)


def test_fmpy(path, system, tmp_path):
    """FMPy connects from the first step on, not initially, and reads no bindings in the file."""
    from fmpy.ssp.simulation import simulate_ssp

    result = simulate_ssp(system(), start_time=0.0, stop_time=STEP * STEPS, step_size=STEP)
    assert len(result) == STEPS
    ends = [result[-1]["first.position"], result[-1]["second.position"]]
    np.testing.assert_allclose(ends, by_hand(path, tmp_path, connected_initially=False), atol=1e-9)
