"""A master with roll back: the unit on a motor of finite power, coupled by the work of the drive.

The motor turns an unbalance u at the speed w, J w w' = T(w) w - P, and the unit's drive has its speed and the amplitude
u w^2. Over each step the speed is the polynomial of degree 3 through both ends and their slopes; the step is repeated until
the energy that the motor loses is the work that the unit has received. Steps end at impacts, and contacts are
gone through in finer ones, since the power has kinks there.
"""

import numpy as np

NODES, WEIGHTS = np.polynomial.legendre.leggauss(6)
TAKES = {"drive.takes.speed": True, "drive.takes.amplitude": True}


class Motor:
    """T(w) = stall (1 - w / idle), as of a motor at constant voltage."""

    def __init__(self, stall, idle, inertia, unbalance):
        self.stall, self.idle, self.inertia, self.unbalance = stall, idle, inertia, unbalance

    def power(self, speed):
        return self.stall * (1 - speed / self.idle) * speed

    def slope(self, speed, load):
        """w' under a load in W."""
        return (self.power(speed) - load) / (self.inertia * speed)


class Coupled:
    """Unit and motor, from `speed` on."""

    def __init__(self, unit, motor, speed, values=None, finer=32, tolerance=1e-13):
        self.unit, self.motor, self.speed = unit, motor, speed
        self.finer, self.tolerance = finer, tolerance
        self.supplied, self.impacts = 0.0, []
        unit.begin(TAKES | (values or {}))
        self.lead(np.array([speed, 0.0, 0.0, 0.0]))

    def lead(self, speed):
        """Gives the unit the speed as a polynomial, lowest order first, and the amplitude with it."""
        unbalance = self.motor.unbalance * np.convolve(speed, speed)
        self.unit.set({"drive.speed": speed[0], "drive.amplitude": unbalance[0]})
        for name, of in (("drive.speed", speed), ("drive.amplitude", unbalance)):
            orders = list(range(1, len(of)))
            values = [of[k] * np.prod(np.arange(1.0, k + 1)) for k in orders]
            references = [self.unit.reference(name)] * len(orders)
            self.unit.fmu.setRealInputDerivatives(references, orders, values)

    def try_step(self, size):
        """A step that is repeated until both agree; the last one stands."""
        unit, motor, begin = self.unit, self.motor, self.unit.time
        state = unit.fmu.getFMUstate()
        work, load = unit.get("drive.work", "drive.power")
        first = motor.slope(self.speed, load)
        last, end = first, self.speed + size * first
        for _ in range(30):
            unit.fmu.setFMUstate(state)
            unit.time = begin
            rise = (end - self.speed) / size
            curve = [self.speed, first, (3 * rise - 2 * first - last) / size,
                     (first + last - 2 * rise) / size**2]
            curve = curve if size > 1e-6 else [self.speed, rise, 0.0, 0.0]
            self.lead(np.array(curve))
            unit.step(size)
            # Gauss's rule on the motor's power along the curve.
            speeds = np.polynomial.polynomial.polyval(size * (NODES + 1) / 2, curve)
            given = size / 2 * WEIGHTS @ motor.power(speeds)
            received, load = unit.get("drive.work", "drive.power")
            energy = motor.inertia * self.speed**2 / 2 + given - (received - work)
            before, end = end, np.sqrt(2 * energy / motor.inertia)
            last = motor.slope(end, load)
            if abs(end - before) < self.tolerance:
                break
        self.outcome = end, given
        return state

    def step(self, size):
        """A whole step, ended before its time at an impact."""
        in_contact = str(self.unit.get("phase")) != "1"
        size = size / self.finer if in_contact else size
        begin, state = self.unit.time, None
        state = self.try_step(size)
        for _ in range(5):
            first = self.unit.get("impact.step.first.time")
            if not begin < first < begin + size - 1e-9:
                break
            self.unit.fmu.setFMUstate(state)
            self.unit.time, size = begin, first - begin + 1e-12
            state = self.try_step(size)
        self.unit.fmu.freeFMUstate(state)
        self.speed, given = self.outcome
        self.supplied += given
        if self.unit.get("impact.step.count"):
            self.impacts.append(self.unit.get("impact.time"))
