"""Forty-digit reference values for the flow of one linear phase.

Equation:  x'' + 2 a x' + b x = c0 + c1 t + A cos(theta0 + w t),
           x(0) = x0,  x'(0) = v0;  wanted: x(t), x'(t).

The inputs are doubles and are taken exactly, the arithmetic is mpmath's. Two
unrelated methods, neither of which has a degenerate case, must agree to 42
digits:
  1. exp(t G) of the augmented system (x, v, 1, s, cos, sin), scaled and
     squared Taylor series, 110 digits;
  2. the textbook sum of exponentials (roots of l^2 + 2 a l + b, undetermined
     coefficients), with b moved by 1e-150 so that all roots are distinct and
     no denominator vanishes, 900 digits. The move changes the result in the
     150th digit or so; the cancellations it brings fit in 900 digits.

"position_sensitivity" and "velocity_sensitivity" are sum |p d(result)/dp| over
all ten inputs p: times 2^-53 it is the error that one rounding of each input
already makes, hence the yardstick for a double implementation.

Run:  python flow.py            writes flow.json beside this file (about 1 min)
"""
import json
import os
import random
from math import pi, sqrt
from mpmath import mp, mpf, mpc, cos, sin, exp, sqrt as msqrt, nstr

KEYS = ("decay", "stiffness", "constant", "ramp", "amplitude", "drive_frequency",
        "drive_angle", "position", "velocity", "elapsed")


def by_exponential(p):
    """x(t), x'(t) by the exponential of the augmented generator."""
    a, b, c0, c1, A, w, th, x0, v0, t = p
    G = [[0] * 6 for _ in range(6)]
    G[0][1] = t
    G[1] = [-b * t, -2 * a * t, c0 * t, c1 * t, A * t, mpf(0)]
    G[3][2] = t
    G[4][5], G[5][4] = -w * t, w * t
    G = [[mpf(g) for g in row] for row in G]
    norm = max(sum(abs(g) for g in row) for row in G)
    n = max(0, int(mp.ceil(mp.log(norm, 2))) + 4) if norm else 0
    G = [[g / 2 ** n for g in row] for row in G]

    def mul(P, Q):
        return [[mp.fdot((P[i][k], Q[k][j]) for k in range(6) if P[i][k] and Q[k][j])
                 for j in range(6)] for i in range(6)]

    # E = exp(G) - 1, kept without the 1 so that squaring stays accurate
    E, T, k = [row[:] for row in G], [row[:] for row in G], 1
    while max(abs(g) for row in T for g in row) > mpf(10) ** (-mp.dps - 10):
        k += 1
        T = [[g / k for g in row] for row in mul(T, G)]
        E = [[e + g for e, g in zip(x, y)] for x, y in zip(E, T)]
    for _ in range(n):
        S = mul(E, E)
        E = [[2 * e + s for e, s in zip(x, y)] for x, y in zip(E, S)]
    y = [x0, v0, mpf(1), mpf(0), cos(th), sin(th)]
    return tuple(y[i] + mp.fdot(E[i], y) for i in (0, 1))


def by_roots(p):
    """x(t), x'(t) by the closed form with b moved off every degenerate case."""
    a, b, c0, c1, A, w, th, x0, v0, t = p
    b = b + mpf(10) ** -150
    d = msqrt(mpc(a * a - b))
    l1, l2 = -a + d, -a - d
    q1 = c1 / b
    q0 = (c0 - 2 * a * q1) / b
    Z = A * exp(mpc(0, th)) / (b - w * w + mpc(0, 2 * a * w))
    u0, u1 = x0 - q0 - Z.real, v0 - q1 - (mpc(0, w) * Z).real
    C1, C2 = (u1 - l2 * u0) / (l1 - l2), (l1 * u0 - u1) / (l1 - l2)
    e1, e2, z = C1 * exp(l1 * t), C2 * exp(l2 * t), Z * exp(mpc(0, w * t))
    x = q0 + q1 * t + (z + e1 + e2).real
    return x, q1 + (mpc(0, w) * z + l1 * e1 + l2 * e2).real


def cases():
    """(name, ten doubles in the order of KEYS)"""
    rng = random.Random(2003)
    out = []

    def add(name, a, b, t, c0=0.0, c1=0.0, A=0.0, w=1.15, th=0.0, x0=0.0, v0=0.0):
        out.append((name, [float(z) for z in (a, b, c0, c1, A, w, th, x0, v0, t)]))

    def some(**fixed):
        """ordinary forces and start, changed by name"""
        u = lambda lo, hi: round(rng.uniform(lo, hi), 3)
        d = dict(c0=u(-2, 2), c1=u(-1, 1), A=u(.5, 2), w=u(.7, 1.6), th=u(-3, 3),
                 x0=u(-10, 10), v0=u(-10, 10))
        d.update(fixed)
        return d

    only = dict(c0=0.0, c1=0.0, A=0.0)
    for t in (1e-8, 1e-4, .1, 1., 10.):
        add(f"under-damped t={t:g}", .02, 1., t, **some())
        add(f"under-damped contact t={t:g}", .09, 8., t, **some())
        add(f"critical t={t:g}", 1.5, 2.25, t, **some())
        add(f"over-damped mild t={t:g}", 1.3, 1., t, **some())
        add(f"over-damped strong t={t:g}", 1e4, 1., t, **some())
        add(f"zero stiffness damped t={t:g}", .09, 0., t, **some())
        add(f"zero stiffness undamped t={t:g}", 0., 0., t, **some())
        add(f"hyperbolic phase I return t={t:g}", .09, -1., t, **some())
        add(f"exact resonance t={t:g}", 0., 2.25, t, **some(w=1.5))
    for e in (1e-3, 1e-6, 1e-9, 1e-12, 1e-15):
        for s in (1, -1):
            b = 2.25 * (1 + s * e)
            for t in (1e-4, .7, 8.):
                add(f"near critical b=a^2(1{s*e:+g}) t={t:g}", 1.5, b, t, **some())
            add(f"near critical b=a^2(1{s*e:+g}) free", .3, .09 * (1 + s * e), 5.,
                **some(**only))
    add("critical, a^2 rounded", .1, .1 * .1, 30., **some())
    add("critical, irrational", sqrt(3.), sqrt(3.) * sqrt(3.), 2., **some())
    add("critical free long", .01, .0001, 400., **some(**only))
    for a in (1.0001, 1.01, 3., 30., 1e3, 1e4):
        for t in (1e-3 / a, .5, 20.):
            add(f"over-damped a={a:g} t={t:g}", a, 1., t, **some())
    add("over-damped strong, stiff", 1e4 * 1000., 1e6, .3, **some())
    add("over-damped strong, soft", 100., 1e-4, 1000., **some())
    for b in (1e-3, -1e-3, 1e-8, -1e-8, 1e-14, -1e-14):
        for name, f in (("constant", dict(c1=0., A=0.)), ("ramp", dict(c0=0., A=0.)),
                        ("all", {})):
            for a in (0., .02):
                add(f"tiny stiffness b={b:g} a={a:g} {name}", a, b, 6.,
                    **some(**f))
        add(f"tiny stiffness b={b:g} t=1e-4", .02, b, 1e-4, **some())
        add(f"tiny stiffness b={b:g} strong damping", 50., b, 9., **some())
        add(f"tiny stiffness and damping b={b:g}", 1e-9, b, 9., **some())
    for a in (1e-3, 1e-8, 1e-14):
        add(f"zero stiffness tiny damping a={a:g}", a, 0., 7., **some())
        add(f"zero stiffness tiny damping a={a:g} ramp", a, 0., 7., **some(c0=0., A=0.))
    add("zero stiffness strong damping", 200., 0., 7., **some())
    add("zero stiffness long harmonic", .01, 0., 1500., **some(c1=0.))
    for a, b in ((0., -1.), (.5, -1.), (.09, -2.), (.02, -25.), (5., -.01), (0., -1e4)):
        add(f"hyperbolic a={a:g} b={b:g}", a, b, min(8., 20. / sqrt(abs(b))), **some())
    add("hyperbolic on the stable direction", 0., -1., 6., x0=1., v0=-1.)
    for w in (.75, 1.25, 1.5, 2., 0.9375):
        add(f"exact resonance w={w}", 0., w * w, 5., **some(w=w))
    add("exact resonance, 100 periods", 0., 2.25, 100 * 2 * pi / 1.5, **some(w=1.5, c1=0.))
    add("resonance, w^2 rounded", 0., 1.15 * 1.15, 40., **some(w=1.15))
    for e in (1e-3, 1e-6, 1e-9, 1e-12, 1e-15):
        for s in (1, -1):
            for t in (3., 120.):
                add(f"near resonance b=w^2(1{s*e:+g}) t={t:g}", 0.,
                    2.25 * (1 + s * e), t, **some(w=1.5))
    for a in (1e-3, 1e-6, 1e-9, 1e-12, 1e-15):
        add(f"resonance with decay {a:g}", a, 2.25, 50., **some(w=1.5))
    add("resonance decay 1e-12, detuned 1e-12", 1e-12, 2.25 * (1 + 1e-12), 60., **some(w=1.5))
    for w in (1e-12, 1e-8, 1e-4, 1e-2, 30., 1e3, 1e6):
        add(f"drive frequency {w:g}", .02, 1., 9., **some(w=w))
        add(f"drive frequency {w:g} zero stiffness", 0., 0., 4., **some(w=w))
        add(f"drive frequency {w:g} tiny stiffness", .02, 1e-8, 4., **some(w=w))
    add("drive frequency 0", .02, 1., 9., **some(w=0.))
    add("slow drive resonant with tiny stiffness", 0., 2.**-40, 4., **some(w=2.**-20))
    add("stiff contact", .09, 1 + 1e6, 2.5e-3, **some())
    add("stiff contact, many oscillations", .09, 1 + 1e6, 2., **some())
    add("stiff contact, damping ratio 0.09", .09 * sqrt(1 + 1e6), 1 + 1e6, 2.5e-3, **some())
    add("stiffest", 1., 1e12, 1e-6, **some())
    for w, b, a in ((1.15, 1., .02), (.9875, 1., .02), (1.15, 1., 0.), (1.5, 8., .09)):
        for n in (1, 30, 300):
            add(f"{n} periods at w={w} b={b:g} a={a:g}", a, b, n * 2 * pi / w,
                **some(w=w, c1=0.))
    add("300 periods critical", 1., 1., 300 * 2 * pi / 1.15, **some(w=1.15, c1=0.))
    add("300 periods over-damped", 40., 1., 300 * 2 * pi / 1.15, **some(w=1.15, c1=0.))
    add("300 periods with ramp", .02, 1., 300 * 2 * pi / 1.15, **some(w=1.15, c1=1e-3))
    add("free undamped", 0., 1., 3., x0=1., v0=2.)
    add("at rest, constant", .02, 1., 3., c0=1., w=1.15)
    add("at rest, ramp", .02, 1., 3., c1=1., w=1.15)
    add("at rest, harmonic", .02, 1., 3., A=1., w=1.15)
    add("elapsed 0", .02, 1., 0., **some())
    add("large drive angle", .02, 1., 3., **some(th=1e6))
    add("nothing", 0., 0., 5., x0=2., v0=-3.)
    return out


def main():
    out, worst = [], mpf(0)
    names = set()
    for name, d in cases():
        assert name not in names, name
        names.add(name)
        mp.dps = 110
        p = [mpf(z) for z in d]
        r = by_exponential(p)
        sens = [mpf(0)] * 2
        for i, z in enumerate(p):
            if z:
                q = p[:]
                q[i] = z * (1 + mpf(10) ** -40)
                s = by_exponential(q)
                sens = [u + abs(v - w) * mpf(10) ** 40 for u, v, w in zip(sens, s, r)]
        mp.dps = 900
        for u, v in zip(r, by_roots(p)):
            worst = max(worst, abs(u - v) / max(abs(v), mpf(10) ** -60))
        mp.dps = 110
        assert worst < mpf(10) ** -42, (name, nstr(worst, 3))
        out.append(dict(name=name, **dict(zip(KEYS, d)),
                        expected_position=nstr(r[0], 40), expected_velocity=nstr(r[1], 40),
                        position_sensitivity=float(sens[0]),
                        velocity_sensitivity=float(sens[1])))
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "flow.json")
    with open(path, "w") as f:
        f.write("[\n" + ",\n".join(json.dumps(c) for c in out) + "\n]\n")
    print(len(out), "cases; the two methods differ by at most", nstr(worst, 3))


if __name__ == "__main__":
    main()
