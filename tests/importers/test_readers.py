"""Readers of model descriptions: strict parsers and the standard's own schema."""

import io
import pathlib
import re
import zipfile

import pytest


def text_of(package):
    """Its model description."""
    with zipfile.ZipFile(package) as archive:
        return archive.read("modelDescription.xml")


@pytest.mark.parametrize("reader", ["fmureader", "mdreader"])
def test_pydantic_reader(each, reader):
    fmi = pytest.importorskip(f"{reader}.fmi", reason=f"{reader} is not installed")
    description = fmi.read_model_description(each)
    names = [v.name for v in description.model_variables]
    assert description.model_name == pathlib.Path(each).stem
    assert names == re.findall('<ScalarVariable name="([^"]*)"', text_of(each).decode())
    assert len(names) == len(set(names))
    outputs = [v for v in description.model_variables if v.causality == "output"]
    assert len(description.model_structure.outputs.unknowns) == len(outputs) > 0
    order = re.search(rb'maxOutputDerivativeOrder="(\d)"', text_of(each))[1]
    assert description.co_simulation.max_output_derivative_order == int(order)


@pytest.mark.parametrize("validator", ["lxml", "xmlschema"])
def test_schema(each, validator):
    fmpy = pytest.importorskip("fmpy", reason="fmpy, which has the schema, is not installed")
    library = pytest.importorskip(
        "lxml.etree" if validator == "lxml" else validator, reason=f"{validator} is not installed"
    )
    schema = pathlib.Path(fmpy.__file__).parent / "schema" / "fmi2" / "fmi2ModelDescription.xsd"
    text = text_of(each)
    if validator == "lxml":
        judge = library.XMLSchema(library.parse(str(schema)))
        judge.validate(library.fromstring(text).getroottree())
        assert list(judge.error_log) == []
    else:
        assert list(library.XMLSchema(str(schema)).iter_errors(io.BytesIO(text))) == []
