"""drive.fmu on softstop.fmu: a motor that is held by the resonance and jumps over it, up and down.

A master with roll back: both units go through a step until the work that the drive pays is the work that the machine
has received. The reference integrates motor and machine as one system of equations, from contact to contact.
"""

import fmpy
import numpy as np
import pytest
from conftest import Unit
from packages import package
from scipy.integrate import solve_ivp

MACHINE = {
    "damping": 0.1, "contact.damping": 0.1, "clearance": 1.2, "stop.model": 2, "stop.stiffness": 3.0,
    "rigid.present": False, "piercing.thickness": 0.0, "piercing.travel": 0.0,
    "initial.position": 0.0, "initial.velocity": 0.0,
    "drive.takes.speed": True, "drive.takes.amplitude": True,
}
DRIVE = {"motor.torque": 1.0, "motor.speed": 2.0, "inertia": 2.0, "unbalance": 0.3, "initial.speed": 0.6}
VOLTAGES = [0.5, 0.7, 1.3, 0.7, 0.5]
PLATEAU = 80.0


@pytest.fixture(scope="session")
def drive(path, tmp_path_factory):
    """Folder and description of the drive."""
    folder = fmpy.extract(package(path, "drive"), unzipdir=str(tmp_path_factory.mktemp("drive")))
    return folder, fmpy.read_model_description(folder)


@pytest.fixture
def pair(make, drive):
    machine, motor = make(), Unit(*drive)
    yield Pair(machine, motor)
    motor.fmu.fmi2FreeInstance(motor.fmu.component)


def slopes(unit, name, values):
    orders = list(range(1, len(values) + 1))
    unit.fmu.setRealInputDerivatives([unit.reference(name)] * len(values), orders, list(values))


def cubic(size, first, last):
    """Derivatives of orders 1 to 3 of the cubic through two values with their slopes."""
    (a, da), (b, db) = first, last
    rise = (b - a) / size
    return [da, 2 * (3 * rise - 2 * da - db) / size, 6 * (da + db - 2 * rise) / size**2]


class Pair:
    def __init__(self, machine, motor):
        self.machine, self.motor = machine, motor

    def begin(self, voltage):
        self.motor.begin(DRIVE | {"motor.voltage": voltage})
        self.machine.begin(MACHINE | {
            "drive.speed": self.motor.get("speed"), "drive.amplitude": self.motor.get("amplitude")})

    def speed(self):
        reference = self.motor.reference("speed")
        (rate,) = self.motor.fmu.getRealOutputDerivatives([reference], [1])
        return self.motor.get("speed"), rate

    def work(self):
        return self.machine.get("drive.work"), self.machine.get("drive.power")

    def step(self, size):
        units, begin = (self.machine, self.motor), self.machine.time
        states = [unit.fmu.getFMUstate() for unit in units]
        work, power = self.work()
        self.motor.set({"load.work": work})
        slopes(self.motor, "load.work", [power, 0.0, 0.0])
        speed = self.speed()
        end, reached = (work + size * power, power), np.inf
        for _ in range(20):
            for unit, state in zip(units, states):
                unit.fmu.setFMUstate(state)
                unit.time = begin
            self.motor.set({"load.work": work})
            slopes(self.motor, "load.work", cubic(size, (work, power), end))
            self.motor.step(size)
            curve = np.array(cubic(size, speed, self.speed())) / [1, 2, 6]
            curve = np.array([speed[0], *curve])
            amplitude = DRIVE["unbalance"] * np.convolve(curve, curve)
            self.machine.set({"drive.speed": curve[0], "drive.amplitude": amplitude[0]})
            factorials = np.cumprod(np.arange(1.0, 7.0))
            slopes(self.machine, "drive.speed", curve[1:] * factorials[:3])
            slopes(self.machine, "drive.amplitude", amplitude[1:] * factorials)
            self.machine.step(size)
            end, before = self.work(), reached
            reached = end[0]
            if abs(reached - before) < 1e-12:
                break
        for unit, state in zip(units, states):
            unit.fmu.freeFMUstate(state)


def reference():
    """Speed at the end of each plateau, and impacts."""
    unbalance, inertia = DRIVE["unbalance"], DRIVE["inertia"]

    def right(voltage, touching):
        def rates(t, y):
            x, v, w, angle = y
            torque = DRIVE["motor.torque"] * (voltage - w / DRIVE["motor.speed"])
            force = unbalance * w * np.cos(angle)
            contact = MACHINE["stop.stiffness"] * (x - MACHINE["clearance"]) if touching else 0.0
            return [v, w * force - 0.1 * v - x - contact, (torque - force * v) / inertia, w]
        return rates

    t, y, touching, impacts, speeds = 0.0, np.array([0.0, 0.0, 0.6, 0.0]), False, 0, []
    for number, voltage in enumerate(VOLTAGES):
        end = PLATEAU * (number + 1)
        while t < end:
            def crossing(t, y):
                return y[0] - MACHINE["clearance"]
            crossing.terminal, crossing.direction = True, -1 if touching else 1
            run = solve_ivp(right(voltage, touching), (t, end), y, method="DOP853", rtol=1e-12,
                            atol=1e-12, events=crossing, max_step=0.2)
            t, y = run.t[-1], run.y[:, -1]
            if run.status == 1:
                impacts += not touching
                touching = not touching
                beyond = np.inf if touching else -np.inf
                y[0] = np.nextafter(MACHINE["clearance"], beyond)
        speeds.append(y[2])
    return np.array(speeds), impacts


def test_jumps_up_and_down_beside_scipy(pair):
    pair.begin(VOLTAGES[0])
    speeds = []
    for number, voltage in enumerate(VOLTAGES):
        pair.motor.set({"motor.voltage": voltage})
        steps = round(PLATEAU / 0.05)
        for k in range(steps):
            pair.step(PLATEAU * (number + (k + 1) / steps) - pair.machine.time)
        speeds.append(pair.motor.get("speed"))
    expected, impacts = reference()
    assert pair.machine.get("impact.count") == impacts > 5
    np.testing.assert_allclose(speeds, expected, atol=1e-6)
    assert speeds[1] < 1.2 < speeds[3]
    motor, machine = pair.motor, pair.machine
    supplied = motor.get("energy.supplied")
    kept = motor.get("energy.kinetic") - DRIVE["inertia"] / 2 * DRIVE["initial.speed"] ** 2
    kept += machine.get("energy.mechanical") + machine.get("energy.dissipated")
    assert abs(supplied - kept) < 1e-9 * supplied


def test_plain_steps_lose_no_energy(pair):
    """What the machine received in a step the drive pays in the next one."""
    pair.begin(1.0)
    motor, machine = pair.motor, pair.machine
    for _ in range(2000):
        machine.set({"drive.speed": motor.get("speed"), "drive.amplitude": motor.get("amplitude")})
        motor.set({"load.work": machine.get("drive.work")})
        machine.step(0.05)
        motor.step(0.05)
    machine_work = machine.get("drive.work")
    motor.set({"load.work": machine_work})
    motor.step(0.05)
    paid, supplied = motor.get("energy.load", "energy.supplied")
    kinetic = motor.get("energy.kinetic") - DRIVE["inertia"] / 2 * DRIVE["initial.speed"] ** 2
    assert machine_work > 1.0 and abs(paid - machine_work) < 1e-9 * machine_work
    assert abs(supplied - paid - kinetic) < 1e-9 * supplied
