"""An independent solution for every stop: the laws of force, integrated arc by arc by scipy.

No strip; the stop stands at the clearance. F is the force on the mass without the damping b1.
"""

import numpy as np
from scipy.integrate import solve_ivp

DEFAULTS = dict(m=1.0, k1=1.0, b1=0.04, amplitude=1.0, frequency=1.15, clearance=2.0, b=0.18)


def chain(slopes, d):
    """Force of a continuous chain of slopes (from, stiffness)."""
    ends = [start for start, _ in slopes[1:]] + [np.inf]
    return sum(k * max(min(d, end) - start, 0.0) for (start, k), end in zip(slopes, ends))


class Stop:
    """A law of force; deflections at which it has a kink, and when it pulls."""

    edges = [0.0]
    two_ways = False

    def pulls(self, d, v, extra):
        """Positive where contact would pull and lets go; `extra` is the damping b - b1."""
        return -1.0

    def released(self, d, v, extra):
        return 0.0


class Spring(Stop):
    """Kelvin-Voigt, or preloaded."""

    def __init__(self, stiffness, preload=0.0, zero_force=False):
        self.stiffness, self.preload, self.zero_force = stiffness, preload, zero_force

    def pressed(self, d, v, extra, sign):
        return self.preload + self.stiffness * d + extra * v

    def pulls(self, d, v, extra):
        return -(self.stiffness * d + extra * v) if self.zero_force else -1.0


class Chain(Stop):
    """Piecewise linear."""

    def __init__(self, loading, unloading=None):
        self.ways = {1.0: loading, -1.0: unloading or loading}
        self.two_ways = unloading is not None
        self.edges = sorted({start for way in self.ways.values() for start, _ in way})

    def pressed(self, d, v, extra, sign):
        return chain(self.ways[sign], d) + extra * v


class Hertz(Stop):
    """Hertz, Hunt and Crossley; lets go of the spring alone."""

    def __init__(self, stiffness, exponent=1.5, dissipation=0.0):
        self.stiffness, self.exponent, self.dissipation = stiffness, exponent, dissipation

    def pressed(self, d, v, extra, sign):
        spring = self.stiffness * max(d, 0.0) ** self.exponent
        return spring * (1.0 + self.dissipation * v) + extra * v

    def pulls(self, d, v, extra):
        return -(1.0 + self.dissipation * v)

    def released(self, d, v, extra):
        return extra * v


class Rigid(Stop):
    """Nothing before the wall."""

    edges = []


def simulate(stop, start, end, travel=None, restitution=0.6, **changes):
    """State at `end` and (time, velocity) of each impact at the clearance.

    Starts below the clearance. A rigid stop stands `travel` behind the clearance.
    """
    p = {**DEFAULTS, **changes}
    clearance, extra = p["clearance"], p["b"] - p["b1"]
    wall = np.inf if travel is None else clearance + travel
    faces = [clearance + edge for edge in stop.edges if clearance + edge < wall] + [wall]
    t, y, layer, free = 0.0, np.array(start, float), 0, False
    impacts = []
    while t < end:
        sign = 1.0 if y[1] > 0 else -1.0
        law = stop.released if free else lambda d, v, e: stop.pressed(d, v, e, sign)

        def right(t, y):
            contact = law(y[0] - clearance, y[1], extra) if layer else 0.0
            drive = p["amplitude"] * np.cos(p["frequency"] * t)
            return [y[1], (drive - p["b1"] * y[1] - p["k1"] * y[0] - contact) / p["m"]]

        def event(value, direction):
            def guard(t, y):
                return value(y)
            guard.terminal, guard.direction = True, direction
            return guard

        above, below = faces[layer], faces[layer - 1] if layer else -np.inf
        events = [
            event(lambda y: y[0] - above if np.isfinite(above) else -1.0, 1),
            event(lambda y: y[0] - below if np.isfinite(below) else 1.0, -1),
            event(lambda y: y[1] if layer and stop.two_ways else 1.0, -sign),
            event(lambda y: stop.pulls(y[0] - clearance, y[1], extra) if layer else -1.0,
                  -1 if free else 1),
        ]
        run = solve_ivp(right, (t, min(end, t + 0.3)), y, method="DOP853", rtol=3e-14, atol=1e-14,
                        events=events, max_step=0.02)
        t, y = run.t[-1], run.y[:, -1].copy()
        if run.status != 1:
            continue
        up, down, turn, _ = (len(times) > 0 for times in run.t_events)
        if up and layer == 0:
            impacts.append((t, y[1]))
        if up and above == wall:
            y[:] = wall, -restitution * y[1]
        elif up or down:
            y[0] = above if up else below
            layer += 1 if up else -1
            free = False
        elif turn:
            y[1] = -sign * 1e-300
        else:
            free = not free
        if up and layer and not free:
            free = stop.pulls(y[0] - clearance, y[1], extra) > 1e-12
    return y, np.array(impacts)
