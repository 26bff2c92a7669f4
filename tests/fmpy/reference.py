"""An independent solution: the paper's equations, integrated step by step by scipy."""

import numpy as np
from scipy.integrate import solve_ivp

PERIOD = 2 * np.pi / 1.15
"""Drive period of the default unit in s."""

UNLOADED = {
    "piercing.thickness": 0.0,
    "piercing.travel": 0.0,
    "initial.position": 6.901267951548,
    "initial.velocity": 9.516655745459,
}
"""The z = 1 orbit of the unloaded machine at drive angle 0."""

DEFAULTS = dict(
    m=1.0, k1=1.0, b1=0.04, amplitude=1.0, frequency=1.15, clearance=10.0, b=0.18,
    k4=7.0, preload=70.0, k2=21.0, k3=23.0, s=0.4, v=0.5, force=0.0, rate=0.0,
)


def law(region, sign, p):
    """Stiffness, centre, constant and damping of the contact force F in one region."""
    edge = p["clearance"] + p["s"] + p["v"]
    if region == "free":
        return 0.0, 0.0, 0.0, p["b1"]
    if region == "pierce":  # eq. 1
        return p["k2"] + sign * p["k3"], p["clearance"], 0.0, p["b"]
    if region == "cut":  # eqs. 2 and 3
        share = 0.1 if sign > 0 else -0.05
        return 0.0, 0.0, share * p["s"] * (p["k2"] + p["k3"]), p["b"]
    return p["k4"], edge, p["preload"], p["b"]  # eq. 5


def simulate(start, end, **changes):
    """State at `end` and (time, velocity) of each impact. Start below the clearance."""
    p = {**DEFAULTS, **changes}
    near, mid = p["clearance"], p["clearance"] + p["s"]
    edge = mid + p["v"]
    surfaces = {"free": (None, near), "pierce": (near, mid), "cut": (mid, edge), "stop": (edge, None)}
    order = [n for n in surfaces if n in ("free", "stop") or surfaces[n][0] < surfaces[n][1]]

    t, y, region = 0.0, np.array(start, float), "free"
    impacts = []
    while t < end:
        sign = 1.0 if y[1] > 0 else -1.0
        k, centre, constant, b = law(region, sign, p)

        def right(t, y):
            drive = p["amplitude"] * np.cos(p["frequency"] * t) + p["force"] + p["rate"] * t
            contact = k * (y[0] - centre) + constant
            return [y[1], (drive - b * y[1] - p["k1"] * y[0] - contact) / p["m"]]

        below, above = surfaces[region]
        events = []
        for edge_at, direction in ((above, 1), (below, -1)):
            def crossing(t, y, at=edge_at):
                return 1.0 if at is None else y[0] - at
            crossing.terminal, crossing.direction = True, direction
            events.append(crossing)

        def reversal(t, y):
            return y[1]
        reversal.terminal, reversal.direction = True, -sign
        events.append(reversal)

        # In pieces, so that no crossing hides within one long step.
        until = min(end, t + 0.3)
        run = solve_ivp(right, (t, until), y, method="DOP853", rtol=3e-14, atol=1e-14,
                        events=events, max_step=0.05)
        t, y = run.t[-1], run.y[:, -1].copy()
        if run.status == 1:
            up, down, turn = (len(e) > 0 for e in run.t_events)
            place = order.index(region)
            if up:
                if region == "free":
                    impacts.append((t, y[1]))
                y[0], region = above, order[place + 1]
            elif down:
                y[0], region = below, order[place - 1]
            else:
                y[1] = -sign * 1e-300
    return y, np.array(impacts)
