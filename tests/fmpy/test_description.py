"""The package as importers see it before they load it."""

import zipfile

import numpy as np
from conftest import TOP
from fmpy.validation import validate_fmu


def test_validation_finds_nothing(path):
    assert validate_fmu(path) == []


def test_top_level_description_is_the_packaged_one(path):
    with zipfile.ZipFile(path) as archive:
        packaged = archive.read("modelDescription.xml").decode()
        names = archive.namelist()
    assert packaged == (TOP / "modelDescription.xml").read_text()
    assert "documentation/index.html" in names
    assert any(name.startswith("documentation/licenses/") for name in names)


def test_contract(description):
    variables = {v.name: v for v in description.modelVariables}
    expected = {
        "mass": ("fixed", "kg", 1), "stiffness": ("fixed", "N/m", 1),
        "damping": ("fixed", "N.s/m", 0.04),
        "excitation.amplitude": ("tunable", "N", 1),
        "excitation.frequency": ("tunable", "rad/s", 1.15),
        "excitation.phase": ("fixed", "rad", 0),
        "clearance": ("tunable", "m", 10), "contact.damping": ("fixed", "N.s/m", 0.18),
        "stop.stiffness": ("tunable", "N/m", 7), "stop.preload": ("tunable", "N", 70),
        "piercing.stiffness": ("fixed", "N/m", 21), "piercing.friction": ("fixed", "N/m", 23),
        "piercing.thickness": ("fixed", "m", 0.4), "piercing.travel": ("fixed", "m", 0.5),
    }
    for name, (variability, unit, start) in expected.items():
        variable = variables[name]
        assert variable.causality == "parameter", name
        assert variable.variability == variability, name
        assert variable.unit == unit, name
        assert np.isclose(float(variable.start), start, rtol=1e-15), name
    assert variables["stop.model"].start == "5"
    assert {i.name: int(i.value) for i in variables["stop.model"].declaredType.items} == {
        "none": 1, "preloaded": 5,
    }
    assert (variables["force"].causality, variables["force"].variability) == ("input", "continuous")
    assert (variables["material"].causality, variables["material"].start) == ("input", "true")
    outputs = {v.name: v.variability for v in description.modelVariables if v.causality == "output"}
    assert outputs == {
        "position": "continuous", "velocity": "continuous", "acceleration": "continuous",
        "contact.force": "continuous", "phase": "discrete", "impact.count": "discrete",
        "pierce.count": "discrete", "impact.time": "discrete", "impact.velocity": "discrete",
        "energy.mechanical": "continuous", "energy.supplied": "continuous",
        "energy.dissipated": "continuous",
    }
