"""The peers: who they are, which worker speaks for them, and the scene that all of them get."""

import json
from dataclasses import dataclass

# The unloaded machine of Peterka 2003 in dimensionless form. In contact the preload and the stop give
# 70 + 7 (X - 10) on top of X, that is 8 X.
SCENE = {
    "clearance": 10.0,
    "free": {"damping": 0.04, "stiffness": 1.0},
    "contact": {"damping": 0.18, "stiffness": 8.0},
    "start": [0.0, 14.0],
}
PERIODS = 200
SHORT_PERIODS = 20
LOWEST, HIGHEST, COUNT = 0.95, 1.4, 1000
# A golden section of COUNT and without a factor in common: any first part of the order is spread evenly.
STRIDE = 617

# What pip installs for each worker.
REQUIREMENTS = {
    "scipy": "scipy==1.17.1",
    "heyoka": "heyoka==7.13.2",
    "sundials": "scikit-sundae==1.2.0",
}


def frequencies():
    """COUNT frequencies over the range, each once, in an order whose every first part is spread evenly."""
    width = (HIGHEST - LOWEST) / (COUNT - 1)
    return [LOWEST + width * (k * STRIDE % COUNT) for k in range(COUNT)]


@dataclass(frozen=True)
class Peer:
    """A solver in one setting."""

    name: str
    worker: str
    package: str
    setting: str


PEERS = [
    Peer("scipy-RK45", "scipy", "scipy", "solve_ivp, terminal events"),
    Peer("scipy-DOP853", "scipy", "scipy", "solve_ivp, terminal events"),
    Peer("scipy-LSODA", "scipy", "scipy", "solve_ivp, terminal events, Jacobian"),
    Peer("scipy-Radau", "scipy", "scipy", "solve_ivp, terminal events, Jacobian"),
    Peer("heyoka-scalar", "heyoka", "heyoka", "Taylor, terminal event with callback"),
    Peer("heyoka-batch", "heyoka", "heyoka", "Taylor in SIMD lanes, terminal event with callback"),
    Peer("cvode-adams", "sundials", "scikit-sundae", "terminal events"),
    Peer("cvode-bdf", "sundials", "scikit-sundae", "terminal events, Jacobian"),
    Peer("diffsol-tsit45", "rust", "diffsol", "root and reset"),
    Peer("diffsol-bdf", "rust", "diffsol", "root and reset, Jacobian"),
    Peer("ode_solvers-dopri5", "rust", "ode_solvers", "no event location"),
    Peer("ode_solvers-dop853", "rust", "ode_solvers", "no event location"),
    Peer(
        "differential-equations-dop853",
        "rust",
        "differential-equations",
        "terminal events",
    ),
    Peer(
        "differential-equations-dop853-unlocated",
        "rust",
        "differential-equations",
        "no event location",
    ),
]


def request(method, tolerance, periods, chosen, start=None):
    """A line for a worker."""
    scene = {**SCENE, "periods": periods, "start": start or SCENE["start"]}
    told = {
        "method": method,
        "tolerance": tolerance,
        "scene": scene,
        "frequencies": list(chosen),
    }
    return json.dumps(told)
