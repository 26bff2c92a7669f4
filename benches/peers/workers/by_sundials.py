"""CVODE of SUNDIALS through scikit-sundae, with terminal events, each followed by a new call."""

import math
import time

from serve import serve
from sksundae.cvode import CVODE

MOST_STEPS = 10_000_000
METHODS = {"cvode-adams": "Adams", "cvode-bdf": "BDF"}


def solver(method, tolerance, law, frequency, clearance, direction):
    """CVODE for one law, stopping at the clearance."""
    damping, stiffness = law

    def rates(t, y, rate):
        position, velocity = y.tolist()
        rate[0] = velocity
        rate[1] = math.cos(frequency * t) - damping * velocity - stiffness * position

    def jacobian(_t, _y, _rate, matrix):
        matrix[0, 1] = 1.0
        matrix[1, 0] = -stiffness
        matrix[1, 1] = -damping

    def events(_t, y, event):
        event[0] = y[0] - clearance

    events.terminal = [True]
    events.direction = [direction]
    return CVODE(
        rates,
        method=method,
        rtol=tolerance,
        atol=tolerance,
        eventsfn=events,
        num_events=1,
        jacfn=jacobian,
        max_num_steps=MOST_STEPS,
    )


def motion(method, tolerance, scene, frequency):
    """X, X' and the number of impacts at the end of one motion."""
    settings = (frequency, scene.clearance)
    phases = [
        solver(method, tolerance, scene.free, *settings, 1),
        solver(method, tolerance, scene.contact, *settings, -1),
    ]
    t, end, y, contact, impacts = 0.0, scene.end(frequency), scene.start, 0, 0
    while True:
        part = phases[contact].solve([t, end], y)
        if part.status < 0:
            raise RuntimeError(part.message)
        t, y = part.t[-1], part.y[-1]
        if part.t_events is None or t >= end:
            return float(y[0]), float(y[1]), impacts
        contact = 1 - contact
        impacts += contact


def solve(method, tolerance, scene, frequencies):
    """One motion after the other."""
    start = time.process_time()
    ends = [motion(METHODS[method], tolerance, scene, frequency) for frequency in frequencies]
    return time.process_time() - start, ends


if __name__ == "__main__":
    serve(solve)
