"""What results have besides the program's numbers: arrays, tables, pictures, progress."""

import builtins
import doctest
import importlib
import pickle
import pkgutil
import re

import matplotlib
import numpy as np
import polars
import pytest
from conftest import TOP

import softstop as ss

matplotlib.use("Agg")
A = ss.Machine.unloaded(frequency=1.15, clearance=10)


def test_lines_as_in_the_first_sketch(tmp_path):
    motion = ss.simulate(A, start=(0, 14), periods=300)
    assert motion.impacts.velocity[-1] == pytest.approx(6.494627429363037, abs=1e-12)
    assert motion.position([1.0, 2.0]).shape == (2,)
    frequencies = np.linspace(0.95, 1.4, 10_000)
    batch = ss.simulate(A, frequency=frequencies, start=(0, 14), periods=500, keep=64)
    assert batch.offsets[-1] == len(batch.impacts.velocity)
    branch = ss.continue_(A, "frequency", (0.9, 1.5), double=3)
    assert polars.DataFrame(branch.specials)["symbol"].to_list() == ["G", "PD", "SN", "G", "G"]
    zone = ss.zone(A)
    assert zone.frequency_sn == pytest.approx(branch.specials.value[2], abs=1e-12)
    assert set(ss.orbit(A).gradient("velocity")) < set(A.parameters)
    basin = ss.basin(A, x=(-20, 20, 40), v=(-20, 20, 30))
    assert basin.labels.shape == (30, 40)
    assert basin.to_xarray().sel(x=7, v=9.5, method="nearest") == 1


def test_basins_are_grids_with_names():
    basin = ss.basin(A, x=(-20, 20, 40), v=(-15, 20, 30))
    counts = np.bincount(basin.labels.ravel(), minlength=len(basin.motions))
    np.testing.assert_array_equal(counts, [it["cells"] for it in basin.basins])
    np.testing.assert_array_equal(basin.shares, counts / 1200)
    assert basin.motions == ["z = 0", "z = 1"]
    assert list(basin.coords) == ["v", "x"] == list(basin.dims)
    np.testing.assert_allclose(basin.coords["x"], np.linspace(-20, 20, 81)[1::2], atol=1e-12)
    rows, columns = np.mgrid[0:30, 0:40]
    v, x = basin.coords["v"][rows], basin.coords["x"][columns]
    settled = ss.simulate(A, start=(x, v), periods=1000, keep=1)
    strikes = np.diff(settled.offsets).reshape(30, 40) > 0
    assert (strikes == (basin.labels == 1)).all()
    array = basin.to_xarray()
    assert array.dims == ("v", "x")
    assert array.attrs["motions"] == basin.motions
    again = pickle.loads(pickle.dumps(basin))
    np.testing.assert_array_equal(again.labels, basin.labels)
    turned = ss.basin(A, plane="phi,v", v=(-15, 20, 12), size=10)
    assert turned.labels.shape == (12, 10)
    assert turned.dims == ("v", "phi")


def test_exponents_are_those_of_multipliers_and_motions():
    found = ss.exponents(A, eta=[0.9875, 1.15], start=(0, 14), periods=32_000)
    assert found.per_period.shape == found.per_second.shape == (2, 2)
    assert found.chaotic.tolist() == [True, False]
    multipliers = ss.orbit(A).multipliers
    assert found.per_period[1, 0] == pytest.approx(np.log(abs(multipliers[0])), abs=1e-3)
    assert multipliers.prod() == pytest.approx(ss.orbit(A).determinant)
    chaos = next(it for it in ss.motions(A.replace(eta=0.9875)).motions if it["kind"] == "chaos")
    other, error = chaos["exponents"]["per_period"][0], chaos["exponents"]["error"]
    assert abs(found.per_period[0, 0] - other) < 2 * (found.error[0] + error)
    np.testing.assert_allclose(found.per_period.sum(axis=-1)[1], np.log(ss.orbit(A).determinant), atol=1e-9)
    np.testing.assert_allclose(found.per_second[0], found.per_period[0] * 0.9875 / (2 * np.pi), rtol=1e-12)
    alone = ss.exponents(A, start=(0, 14), transient=10, periods=100)
    assert alone.per_period.shape == (2,)
    assert alone.periods == 128
    with pytest.raises(ss.MachineError, match="periods = 3"):
        ss.exponents(A, periods=3)
    with pytest.raises(ss.MachineError, match="clearence"):
        ss.exponents(A, clearence=[3.0])


RESULTS = {
    "motion": lambda: ss.simulate(A, start=(0, 14), periods=30),
    "batch": lambda: ss.simulate(A, eta=np.linspace(1.0, 1.3, 20), start=(0, 14), periods=100, keep=4),
    "motions": lambda: ss.motions(A.replace(eta=0.9875), starts=64),
    "zone": lambda: ss.zone(A),
    "branch": lambda: ss.continue_(A, "clearance", (8, 12), double=1),
    "sweep": lambda: ss.sweep(A, (0.9, 1.5), steps=30),
    "basin": lambda: ss.basin(A, size=20),
    "certainty": lambda: ss.certainty(A, 3, size=10),
    "design": lambda: ss.optimize({"machine": "loaded", "vary": {"stop.stiffness": 7.0, "clearance": 10}}),
}


@pytest.mark.parametrize("name", RESULTS)
def test_plots_return_axes(name):
    result = RESULTS[name]()
    axes = result.plot()
    assert isinstance(axes, matplotlib.axes.Axes)
    assert axes.has_data()
    assert result.plot(axes=axes) is axes
    assert axes.get_xlabel()
    assert axes.get_ylabel()
    matplotlib.pyplot.close("all")


def test_axes_have_units():
    press = ss.read(TOP / "docs/press/press.toml")
    axes = ss.continue_(press, "frequency_hz", (23, 25)).plot()
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("drive frequency (Hz)", "before-impact velocity (m/s)")
    assert ss.simulate(press, stop__stiffness=[1e7, 2e7], keep=2).plot().get_xlabel() == "stiffness of the stop (N/m)"
    assert ss.simulate(press, frequency=[150, 151], keep=2).plot().get_xlabel() == "frequency"
    assert ss.zone(press).plot().get_xlabel() == "drive frequency (Hz)"
    assert ss.sweep(A, (1.1, 1.2), steps=5).plot().get_xlabel() == "drive frequency η = ω/Ω"
    assert ss.simulate(A, eta=[1.0, 1.1], keep=2).plot().get_xlabel() == "drive frequency η = ω/Ω"
    matplotlib.pyplot.close("all")


@pytest.mark.parametrize(("package", "call"), [
    ("matplotlib", lambda: ss.zone(A).plot()),
    ("xarray", lambda: ss.basin(A, size=4).to_xarray()),
])
def test_what_is_not_installed_is_named(monkeypatch, package, call):
    real = builtins.__import__

    def without(name, *rest):
        if name.split(".")[0] == package:
            raise ImportError(name)
        return real(name, *rest)

    monkeypatch.setattr(builtins, "__import__", without)
    with pytest.raises(ImportError, match=f"pip install {package}"):
        call()


def test_notebooks_show_pictures():
    assert A._repr_html_().startswith("<svg")
    assert ss.simulate(A, periods=5)._repr_mimebundle_()["image/svg+xml"].lstrip().startswith(("<?xml", "<svg"))
    assert "image/svg+xml" in RESULTS["branch"]()._repr_mimebundle_()
    assert RESULTS["basin"]()._repr_mimebundle_()["image/png"].startswith(b"\x89PNG")
    assert RESULTS["design"]()._repr_mimebundle_()["image/svg+xml"].count("<svg") == 1


def test_progress_is_shown_and_can_be_off(capfd, monkeypatch):
    monkeypatch.setattr("softstop._progress.PATIENCE", 0)
    call = lambda progress: ss.simulate(  # noqa: E731
        A.replace(eta=0.98), start=(np.zeros(20_000), np.linspace(10, 14, 20_000)), periods=1500, keep=1, progress=progress
    )
    call(False)
    assert capfd.readouterr().err == ""
    call(True)
    assert re.search(r"motions: +\d+%", capfd.readouterr().err)


def test_a_report_is_made_when_it_is_asked_for(tmp_path):
    design = ss.optimize({"machine": "loaded", "vary": {"stop.stiffness": 7.0, "clearance": 10}}, evaluations=100)
    design = pickle.loads(pickle.dumps(design))
    assert "report.html" not in design.files
    design.report(tmp_path / "report.html")
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert page.startswith("<!DOCTYPE html>")
    assert dict(design)["design"]["machine"]["parameters"]["clearance"] == 10


def test_a_report_is_of_the_design_that_was_found(tmp_path):
    task = {"machine": "loaded", "vary": {"stop.stiffness": 7.0, "clearance": [2, 22]}, "require": {"margin": 0.1}}
    design = ss.optimize(task)
    clearance = design.machine["clearance"]
    task["require"] = {"margin": 0.4}
    design.report(tmp_path / "report.html")
    assert design.machine["clearance"] == clearance == design.design["clearance"]
    assert f"{clearance:.4f}" in (tmp_path / "report.html").read_text(encoding="utf-8")


def test_tables_without_rows_have_their_columns():
    branch = ss.continue_(A, "frequency", (1.14, 1.16))
    assert list(branch.specials.columns) == list(RESULTS["branch"]().specials.columns)
    assert not len(branch.specials.value[branch.specials.symbol == "PD"])


MODULES = [module.name for module in pkgutil.iter_modules(ss.__path__) if module.name not in ("_softstop", "__main__")]


@pytest.mark.parametrize("name", MODULES)
def test_examples_of_docstrings(name, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    module = importlib.import_module(f"softstop.{name}")
    failed, _ = doctest.testmod(module, optionflags=doctest.NORMALIZE_WHITESPACE)
    assert failed == 0


def test_everything_public_says_what_it_returns():
    for name in ss.__all__:
        thing = getattr(ss, name)
        assert thing.__doc__, name
        if callable(thing) and name[0].islower():
            for part in ("Parameters\n", "Returns\n", "Raises\n", "Examples\n"):
                assert part in thing.__doc__, (name, part)
