"""The unit on a motor of finite power: roll back, energy, and steps of any size."""

import numpy as np
from master import Coupled, Motor
from reference import PERIOD, UNLOADED

START = (UNLOADED["initial.position"] ** 2 + UNLOADED["initial.velocity"] ** 2) / 2
MOTOR = Motor(stall=60.0, idle=1.2, inertia=40.0, unbalance=1 / 1.15**2)


def run(unit, size, periods, **how):
    coupled = Coupled(unit, MOTOR, 1.15, UNLOADED, **how)
    while unit.time < periods * PERIOD - 1e-9:
        coupled.step(min(size, periods * PERIOD - unit.time))
    return coupled


def test_impact_times_do_not_depend_on_the_step(make):
    fine, coarse = (run(make(), PERIOD / per, 6) for per in (400, 100))
    assert len(coarse.impacts) == len(fine.impacts) >= 5
    np.testing.assert_allclose(coarse.impacts, fine.impacts, atol=1e-8)
    assert abs(coarse.speed - fine.speed) < 1e-8


def test_balance_of_unit_and_motor_over_a_thousand_periods(make):
    """What the motor has supplied is dissipated, stored in the unit or in the rotor."""
    unit = make()
    coupled = run(unit, PERIOD / 16, 1000, finer=1, tolerance=1e-8)
    rotor = MOTOR.inertia / 2 * (coupled.speed**2 - 1.15**2)
    stored = unit.get("energy.mechanical") - START
    lost = unit.get("energy.dissipated")
    assert len(coupled.impacts) == unit.get("impact.count") > 900
    assert abs(coupled.supplied - rotor - stored - lost) < 1e-9 * coupled.supplied
