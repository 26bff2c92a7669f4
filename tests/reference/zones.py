"""Zones of random machines: g0, s_SN and s_PD of z = 1, by the integrator of machine.py.

Folds and flips are found from guesses by Newton's method for the orbit and the frequency at once, with the exact
monodromy matrix M of 50 digits: P(x, v) = (x, v) and 1 -+ tr M + det M = 0, which the residuals of each record prove.
The guesses are those of crates/dynamics/tests/zone_sample.rs, as is the choice of machines; nothing else is taken
from there. A stop of two slopes: F = k2 (X - clearance) up to sigma beyond the clearance, from there on with the
slope `stiffness`.

Run:  python zones.py              writes zones.json beside this file anew, from the guesses in it
      python zones.py SAMPLE.json  from the guesses in another file
"""
import json
import os
import sys
import time
from mpmath import mpf, sqrt

from machine import Machine, newton, text, trace_det

PATH = os.path.join(os.path.dirname(os.path.abspath(__file__)), "zones.json")
PROVEN = mpf(10) ** -33


class Slopes(Machine):
    """beyond the clearance one spring, from sigma on another"""

    def __init__(self, **p):
        super().__init__(**p)
        q = {k: mpf(v) for k, v in self.p.items() if k != "regime"}
        r, s, B, k, k2 = (q[n] for n in ("clearance", "sigma", "contact_damping", "stiffness", "k2"))
        self.levels, self.friction = [r, r + s], []
        self.phases = [self.phases[0], {0: (B, 1 + k2, k2 * r)}, {0: (B, 1 + k, k * (r + s) - k2 * s)}]


def machine(parameters, frequency):
    kind = Slopes if parameters["regime"] == "slopes" else Machine
    regime = "loaded" if parameters["regime"] == "loaded" else "unloaded"
    return kind(**{**parameters, "regime": regime, "frequency": frequency})


def critical(parameters, guess, way):
    """the orbit near a guess at which 1 - way tr + det is zero: 1 for a fold, -1 for a flip"""
    def equations(u):
        (s,), M, *_ = machine(parameters, u[2]).cycle(u[0], u[1])
        tr, det = trace_det(M)
        return [s[0] - u[0], s[1] - u[1], 1 - way * tr + det]

    u = newton(equations, [mpf(z) for z in guess])
    assert max(abs(z) for z in equations(u)) < PROVEN
    near = max(abs(a - mpf(b)) for a, b in zip(u, guess))
    (_, velocity), = machine(parameters, u[2]).cycle(u[0], u[1])[2]
    return u[2], velocity, near


def g0(rho, B):
    """the larger frequency at which the amplitude of the motion without impacts is the clearance"""
    p = 1 - 2 * B ** 2
    return sqrt(p + sqrt(p ** 2 - 1 + 1 / rho ** 2))


def zone(record):
    parameters = record["parameters"]
    out = dict(parameters=parameters, fold=record["fold"], flip=record["flip"])
    out["frequency_g0"] = text(g0(mpf(parameters["clearance"]), mpf(parameters["damping"])))
    frequency, velocity, near = critical(parameters, record["fold"], 1)
    out["frequency_sn"], out["velocity_sn"] = text(frequency), text(velocity)
    if record["flip"]:
        frequency, _, far = critical(parameters, record["flip"], -1)
        near = max(near, far)
    out["frequency_pd"] = text(frequency) if record["flip"] else None
    assert near < 1e-4, f"another orbit than the one asked for: {near}"
    return out


def main():
    with open(sys.argv[1] if len(sys.argv) > 1 else PATH) as f:
        given = json.load(f)
    zones = []
    for record in (given if isinstance(given, list) else given["zones"]):
        begin = time.time()
        zones.append(zone(record))
        print(len(zones), record["parameters"]["regime"], zones[-1]["frequency_sn"],
              f"{time.time() - begin:.1f} s", flush=True)
    with open(PATH, "w") as f:
        json.dump(dict(zones=zones), f, indent=1)
        f.write("\n")


if __name__ == "__main__":
    main()
