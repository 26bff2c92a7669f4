"""ecos, a C++ co-simulation framework, in process and through its server proxyfmu."""

import ctypes
import pathlib
import sys

import pytest


def load_tbb():
    """ecos needs Intel's tbb; where only the Python package has it, it must be loaded first."""
    library = pathlib.Path(sys.prefix) / "lib" / "libtbb.so.12"
    if library.exists():
        ctypes.CDLL(str(library), ctypes.RTLD_GLOBAL)


load_tbb()
ecospy = pytest.importorskip("ecospy", reason="ecospy is not installed")

from ecospy import EcosSimulation, EcosSimulationStructure  # noqa: E402
from ecospy.EcosSimulationRunner import EcosSimulationRunner  # noqa: E402
from machine import (  # noqa: E402
    OBSERVED, PERIOD, PUSH, PUSHED, check_orbit, check_pushed, orbit_values,
)


@pytest.fixture(params=["in process", "proxyfmu"])
def uri(request, path, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # proxyfmu writes its logs where it stands
    if request.param == "in process":
        return path
    # The package installs its server as a file that may not be run.
    (pathlib.Path(ecospy.__file__).parent / "binaries" / "proxyfmu").chmod(0o755)
    # The server is a process of its own, which cannot be helped by loading tbb here.
    monkeypatch.setenv("LD_LIBRARY_PATH", str(pathlib.Path(sys.prefix) / "lib"))
    return f"proxyfmu://localhost?file={path}"


class Ecos:
    """One unit with a fixed step."""

    def __init__(self, uri, step, values=None):
        with EcosSimulationStructure() as structure:
            structure.add_model("unit", uri)
            named = {f"unit::{name}": value for name, value in (values or {}).items()}
            structure.add_parameter_set("run", named)
            self.simulation = EcosSimulation(step, structure=structure)
        assert self.simulation.init(parameter_set="run")

    def get(self, *names):
        values = []
        for name in names:
            count = name.endswith(".count")
            get = self.simulation.get_integer if count else self.simulation.get_real
            values.append(get(f"unit::{name}"))
        return values


@pytest.mark.parametrize("per_period", [1, 50, 1000])
def test_orbit(uri, orbit, per_period):
    ecos = Ecos(uri, PERIOD / per_period, orbit_values(orbit))
    ecos.simulation.step(10 * per_period)
    late = ecos.simulation.get_time() - 10 * PERIOD
    check_orbit(orbit, 10, late, ecos.get(*OBSERVED))
    ecos.simulation.terminate()
    ecos.simulation.free()


def test_reset_and_another_run(path):
    ecos = Ecos(path, PERIOD / 50)
    ecos.simulation.step(123)
    ecos.simulation.reset()
    assert ecos.simulation.init(parameter_set="run")
    ecos.simulation.step(500)
    late = ecos.simulation.get_time() - 10 * PERIOD
    check_orbit("loaded", 10, late, ecos.get(*OBSERVED))


@pytest.mark.parametrize("per_period", [1, 37])
def test_force_from_the_start(uri, per_period):
    ecos = Ecos(uri, PERIOD / per_period, PUSHED | {"force": PUSH})
    ecos.simulation.step(3 * per_period)
    end = ecos.simulation.get_time()
    check_pushed(end, ecos.get("position", "velocity", "impact.count"))


def test_material_taken_away_while_it_runs(uri):
    ecos = Ecos(uri, PERIOD / 10)
    ecos.simulation.step(50)
    assert ecos.get("pierce.count") == [5]
    ecos.simulation.set_bool("unit::material", False)
    ecos.simulation.step(50)
    pierced, impacts = ecos.get("pierce.count", "impact.count")
    assert (pierced, impacts > 5) == (5, True)


def test_a_thread_of_its_own(path):
    ecos = Ecos(path, PERIOD / 50)
    with EcosSimulationRunner(ecos.simulation) as runner:
        runner.set_real_time_factor(1e6)
        runner.start()
        while ecos.simulation.get_time() < 20 * PERIOD:
            pass
        runner.stop()
    steps = round(ecos.simulation.get_time() / PERIOD * 50)
    ecos.simulation.step(-steps % 50)
    periods = round(ecos.simulation.get_time() / PERIOD)
    late = ecos.simulation.get_time() - periods * PERIOD
    check_orbit("loaded", periods, late, ecos.get(*OBSERVED))
