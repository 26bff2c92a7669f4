"""piercing-machine-fmi3.ssp, the system by SSP 2.0, in pyssp_standard."""

import pathlib
import zipfile

import pytest
from machine import TOP

fmpy = pytest.importorskip("fmpy", reason="fmpy, which reads the units, is not installed")
pytest.importorskip("pyssp_standard", reason="pyssp_standard is not installed")

from pyssp_standard.ssd import SSD  # noqa: E402
from pyssp_standard.ssv import SSV  # noqa: E402

NAME = "piercing-machine-fmi3.ssp"


@pytest.fixture
def folder(path, tmp_path):
    beside = pathlib.Path(path).with_name(NAME)
    zipfile.ZipFile(beside if beside.exists() else TOP / NAME).extractall(tmp_path)
    return tmp_path


def test_pyssp_standard_reads_it_by_the_schema(folder):
    with SSD(folder / "SystemStructure.ssd") as structure:
        structure.__check_compliance__()
        assert structure.version == "2.0"
        kinds = {of.name: {one.name: one.kind for one in of.connectors} for of in structure.system.elements}
        assert set(kinds) == {"drive", "feeder", "press"} and len(structure.connections()) == 5
        for wire in structure.connections():
            assert kinds[wire.start_element][wire.start_connector] == "output"
            assert kinds[wire.end_element][wire.end_connector] == "input"
    for name, connectors in kinds.items():
        description = fmpy.read_model_description(folder / "resources" / f"{name}.fmu")
        assert description.fmiVersion == "3.0"
        assert connectors.items() <= {v.name: v.causality for v in description.modelVariables}.items()
    sets = list((folder / "resources").glob("*.ssv"))
    assert len(sets) == 6
    for file in sets:
        with SSV(file) as parameters:
            parameters.__check_compliance__()
