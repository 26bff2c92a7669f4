"""Readers of model descriptions: strict parsers and the standard's own schema."""

import io
import pathlib
import zipfile

import pytest


@pytest.mark.parametrize("reader", ["fmureader", "mdreader"])
def test_pydantic_reader(path, reader):
    fmi = pytest.importorskip(f"{reader}.fmi", reason=f"{reader} is not installed")
    description = fmi.read_model_description(path)
    names = [v.name for v in description.model_variables]
    assert description.model_name == "softstop"
    assert "stop.loading.stiffness[8]" in names
    assert len(names) == len(set(names))
    outputs = [v for v in description.model_variables if v.causality == "output"]
    assert len(description.model_structure.outputs.unknowns) == len(outputs) > 0
    assert description.co_simulation.max_output_derivative_order == 2


@pytest.mark.parametrize("validator", ["lxml", "xmlschema"])
def test_schema(path, validator):
    fmpy = pytest.importorskip("fmpy", reason="fmpy, which has the schema, is not installed")
    library = pytest.importorskip(
        "lxml.etree" if validator == "lxml" else validator, reason=f"{validator} is not installed"
    )
    schema = pathlib.Path(fmpy.__file__).parent / "schema" / "fmi2" / "fmi2ModelDescription.xsd"
    with zipfile.ZipFile(path) as archive:
        text = archive.read("modelDescription.xml")
    if validator == "lxml":
        judge = library.XMLSchema(library.parse(str(schema)))
        judge.validate(library.fromstring(text).getroottree())
        assert list(judge.error_log) == []
    else:
        assert list(library.XMLSchema(str(schema)).iter_errors(io.BytesIO(text))) == []
