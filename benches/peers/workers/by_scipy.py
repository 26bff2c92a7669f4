"""scipy.integrate.solve_ivp with terminal events, each followed by a new call, as its manual says."""

import math
import time

import numpy as np
from scipy.integrate import solve_ivp
from serve import serve

METHODS = {"RK45", "DOP853", "LSODA", "Radau"}
IMPLICIT = {"LSODA", "Radau"}


def phase(law, frequency, clearance, direction):
    """The rates, their Jacobian and the event of one law."""
    damping, stiffness = law

    def rates(t, y):
        position, velocity = y.tolist()
        return velocity, math.cos(frequency * t) - damping * velocity - stiffness * position

    def event(_t, y):
        return y[0] - clearance

    event.terminal = True
    event.direction = direction
    return rates, np.array([[0.0, 1.0], [-stiffness, -damping]]), event


def jacobian(method, matrix):
    """Only implicit methods take a Jacobian; LSODA wants a function."""
    if method == "Radau":
        return {"jac": matrix}
    return {"jac": lambda _t, _y: matrix} if method == "LSODA" else {}


def motion(method, tolerance, scene, frequency):
    """X, X' and the number of impacts at the end of one motion."""
    phases = [
        phase(scene.free, frequency, scene.clearance, 1.0),
        phase(scene.contact, frequency, scene.clearance, -1.0),
    ]
    t, end, y, contact, impacts = 0.0, scene.end(frequency), scene.start, 0, 0
    while True:
        rates, matrix, event = phases[contact]
        part = solve_ivp(
            rates,
            (t, end),
            y,
            method=method,
            events=event,
            rtol=tolerance,
            atol=tolerance,
            **jacobian(method, matrix),
        )
        if part.status < 0:
            raise RuntimeError(part.message)
        t, y = part.t[-1], part.y[:, -1]
        if part.status == 0:
            return float(y[0]), float(y[1]), impacts
        contact = 1 - contact
        impacts += contact


def solve(method, tolerance, scene, frequencies):
    """One motion after the other."""
    name = method.removeprefix("scipy-")
    if name not in METHODS:
        raise ValueError(f"no method {method}")
    start = time.process_time()
    ends = [motion(name, tolerance, scene, frequency) for frequency in frequencies]
    return time.process_time() - start, ends


if __name__ == "__main__":
    serve(solve)
