"""The component of OpenMDAO: exact partials, and a problem of two disciplines."""

import openmdao.api as om
import pytest
from conftest import TOP

import softstop as ss
from softstop.openmdao import ImpactMachine

FIGURES = ["velocity", "impact_energy", "impact_power", "drive_power", "max_position", "stroke", "stop_force", "drive_force"]


def problem_of(machine, inputs, outputs):
    problem = om.Problem(reports=False)
    problem.model.add_subsystem("machine", ImpactMachine(machine, inputs, outputs), promotes=["*"])
    problem.setup()
    problem.run_model()
    return problem


@pytest.mark.parametrize("machine", [
    ss.Machine.unloaded(eta=1.15, clearance=10),
    ss.Machine.loaded(eta=1.2, clearance=10),
    ss.read(TOP / "docs/press/press.toml").replace({"excitation.frequency_hz": 29, "clearance": 0.012}),
])
def test_partials_are_exact(machine):
    inputs = [key for key in machine.parameters if key != "excitation.phase"]
    problem = problem_of(machine, inputs, FIGURES)
    checked = problem.check_partials(out_stream=None, method="fd", form="central", step=1e-6, step_calc="rel")
    for (figure, key), found in checked["machine"].items():
        exact, differenced = found["J_fwd"].item(), found["J_fd"].item()
        scale = abs(problem[figure].item() / max(abs(machine[key.replace(":", ".")]), 1e-3))
        assert abs(exact - differenced) <= 1e-7 * max(abs(exact), scale), (figure, key, exact, differenced)


def test_gradient_of_an_orbit():
    machine = ss.Machine.unloaded(eta=1.15, clearance=10)
    orbit = ss.orbit(machine)
    assert orbit.figure("velocity") == orbit.before_impact_velocity
    step = 1e-5
    ahead, behind = (ss.orbit(machine.replace(clearance=10 + by)).before_impact_velocity for by in (step, -step))
    assert orbit.gradient("velocity", ["clearance"])["clearance"] == pytest.approx((ahead - behind) / (2 * step), rel=1e-8)
    with pytest.raises(ss.MachineError, match="no such figure"):
        orbit.figure("beauty")


class Motor(om.ExplicitComponent):
    """A motor that has less power the faster it turns: 8 - 3 eta."""

    def setup(self):
        self.add_input("excitation:frequency", val=1.15)
        self.add_output("limit")
        self.declare_partials("limit", "excitation:frequency", val=-3.0)

    def compute(self, inputs, outputs):
        outputs["limit"] = 8.0 - 3.0 * inputs["excitation:frequency"]


def test_motor_and_press_together():
    """SLSQP finds the hardest impact with a drive power that the motor has: at its limit."""
    machine = ss.Machine.unloaded(eta=1.15, clearance=10)
    problem = om.Problem(reports=False)
    inputs = ["excitation.frequency", "clearance"]
    problem.model.add_subsystem("motor", Motor(), promotes=["*"])
    problem.model.add_subsystem("press", ImpactMachine(machine, inputs, ["velocity", "drive_power"]), promotes=["*"])
    problem.model.add_subsystem("spare", om.ExecComp("spare = limit - drive_power"), promotes=["*"])
    problem.driver = om.ScipyOptimizeDriver(optimizer="SLSQP", tol=1e-9, disp=False)
    problem.model.add_design_var("excitation:frequency", lower=1.1, upper=1.25)
    problem.model.add_design_var("clearance", lower=9, upper=12)
    problem.model.add_objective("velocity", scaler=-1)
    problem.model.add_constraint("spare", lower=0)
    problem.setup()
    problem.run_driver()
    assert problem.driver.result.success
    assert problem["spare"].item() == pytest.approx(0, abs=1e-7)
    assert problem["velocity"].item() > 6.5


def test_no_motion_is_an_analysis_error():
    problem = problem_of(ss.Machine.unloaded(eta=1.15, clearance=10), ["excitation.frequency"], ["velocity"])
    problem["excitation:frequency"] = 3.0
    with pytest.raises(om.AnalysisError, match="no stable z = 1 motion"):
        problem.run_model()
