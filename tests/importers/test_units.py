"""The units beside softstop.fmu under the same importers: each gives what FMPy gives of the same run."""

import importlib
import zipfile

import pytest

fmpy = pytest.importorskip("fmpy", reason="fmpy, which drives the reference, is not installed")

from machine import package  # noqa: E402

STEP, STEPS = 0.1, 400
RUNS = {  # parameters, outputs; real numbers and counts only, as libcosim and ecos know no enumerations
    "drive": ({"initial.speed": 0.3, "motor.torque": 5.0}, ["speed", "angle", "energy.kinetic", "energy.supplied"]),
    "feeder": ({"jam.probability": 0.3, "feed.speed": 3.0}, ["strip.count", "jam.count", "material_real", "fed.time"]),
}


def by_fmpy(unit, values, names, folder):
    result = fmpy.simulate_fmu(unit, stop_time=STEP * STEPS, step_size=STEP, output_interval=STEP,
                               start_values=values, output=names)
    return [result[-1][name] for name in names]


def by_libcosim(unit, values, names, folder):
    cosim = importlib.import_module("test_libcosim").Cosim(unit, STEP, values)
    cosim.run(STEPS)
    return cosim.get(*names)


def by_ecos(unit, values, names, folder):
    ecos = importlib.import_module("test_ecos").Ecos(unit, STEP, values)
    ecos.simulation.step(STEPS)
    return ecos.get(*names)


def by_fmuloader(unit, values, names, folder):
    module = importlib.import_module("test_fmuloader")
    loaded = module.Loaded(unit, module.read_model_description(unit), values)
    for number in range(STEPS):
        loaded.slave.do_step(number * STEP, STEP)
    return loaded.get(*names)


def by_fmi_sim(unit, values, names, folder):
    module = importlib.import_module("test_rust")
    last = module.fmi_sim(unit, folder, STEP, STEP * STEPS, values)
    return module.numbers(last, names)


def by_fmipp(unit, values, names, folder):
    module = importlib.import_module("test_fmipp")
    with zipfile.ZipFile(unit) as archive:
        archive.extractall(folder)
    identifier = fmpy.read_model_description(unit).coSimulation.modelIdentifier
    loaded = module.start(f"file://{folder}", values, identifier=identifier)
    for number in range(STEPS):
        assert loaded.doStep(number * STEP, STEP, True) == 0
    get = lambda name: loaded.getIntegerValue if name.endswith(".count") else loaded.getRealValue
    return [get(name)(name) for name in names]


def by_container(unit, values, names, folder):
    module = importlib.import_module("test_toolbox")
    box, prefix = module.container(unit, folder, STEP), fmpy.read_model_description(unit).modelName
    return by_fmpy(str(box), {f"{prefix}.{name}": value for name, value in values.items()}, names, folder)


@pytest.mark.parametrize(
    "run", [by_libcosim, by_ecos, by_fmuloader, by_fmi_sim, by_fmipp, by_container], ids=lambda run: run.__name__[3:])
@pytest.mark.parametrize("name", RUNS)
def test_the_same_run(path, name, run, tmp_path, monkeypatch):
    unit, (values, names) = package(path, name), RUNS[name]
    if run is by_fmuloader:
        module = importlib.import_module("test_fmuloader")
        monkeypatch.setattr(module.fmuloader.fmi2, "CDLL", module.Library)
    expected = by_fmpy(unit, values, names, tmp_path)
    assert run(unit, values, names, tmp_path) == pytest.approx(expected, rel=1e-9)
