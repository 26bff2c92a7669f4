"""Reference motions of the piercing machine, integrated event by event in mpmath.

Equation (dimensionless, t = Omega times time):
    X'' + 2 B X' + X + F = cos(angle),   angle = drive_angle + frequency t,
    B = damping for X < clearance, contact_damping above;
unloaded regime  F = preload + stiffness (X - clearance)        X > clearance
loaded regime    F = (X - clearance) (k2 + k3 sign X')          phase I, width sigma
                 F = sigma (k2 + k3) / 40 (1 + 3 sign X')       phase II, up to sigma_nu
                 F = preload + stiffness (X - X3)               X > X3 = clearance + sigma_nu
The sign terms are dry friction (Filippov): at X' = 0 the mass turns round if one
side lets it, otherwise it sticks until the drive overcomes one side.
A mass that is pushed against the preloaded stop in the loaded regime bounces with
geometrically falling velocity (friction takes a share of every bounce), infinitely
often in a finite time, and then leans on the stop. Below 1e-15 it is taken to
rest there; the states after that do not depend on when exactly.
No rigid stop. All parameters are doubles, taken exactly; sums and products of
them are not rounded.

Each arc is a closed form; its end is bracketed by sampling 32 times per shortest
period, split at every zero of X' (and of X'' where X' might touch zero), and then
solved by safeguarded Newton to the working precision, 50 digits. Monodromy =
product of arc matrices and saltation matrices.

Run:  python machine.py [trajectories] [orbits] [folds] [boundaries] [zone] [peaks]
      writes the named sections (default: all) of machine.json beside this file
"""
import json
import os
import sys
import time
from mpmath import mp, mpf, mpc, cos, sin, exp, pi, acos, sqrt, nstr, inf, sign

mp.dps = 50
DIGITS = 30
LEAST = mpf(10) ** -15


class Arc:
    """x(s) on one linear phase from the state (x, v) at drive angle th."""

    def __init__(self, phase, w, th, x, v):
        self.a, self.b, c = phase
        self.w, self.th, self.x, self.v = w, th, x, v
        d = sqrt(mpc(self.a ** 2 - self.b))
        self.l1, self.l2 = -self.a + d, -self.a - d
        self.q = c / self.b
        self.Z = exp(mpc(0, th)) / mpc(self.b - w * w, 2 * self.a * w)
        u0, u1 = x - self.q - self.Z.real, v + w * self.Z.imag
        self.c = c
        self.C1 = (u1 - self.l2 * u0) / (self.l1 - self.l2)
        self.C2 = (self.l1 * u0 - u1) / (self.l1 - self.l2)
        self.step = 2 * pi / (32 * max(w, abs(self.l1), abs(self.l2)))

    def acc(self, s, x, v):
        return self.c + cos(self.th + self.w * s) - 2 * self.a * v - self.b * x

    def at(self, s):
        """position, velocity, acceleration after s"""
        z = self.Z * exp(mpc(0, self.w * s))
        if self.l1.imag:
            e1 = 2 * self.C1 * exp(self.l1 * s)
            x, v = e1.real, (self.l1 * e1).real
        else:
            e1, e2 = self.C1.real * exp(self.l1.real * s), self.C2.real * exp(self.l2.real * s)
            x, v = e1 + e2, self.l1.real * e1 + self.l2.real * e2
        x, v = x + self.q + z.real, v - self.w * z.imag
        return x, v, self.acc(s, x, v)

    def matrix(self, s):
        """derivative of (x, v) after s by the state at the start"""
        e1, e2, d = exp(self.l1 * s), exp(self.l2 * s), self.l1 - self.l2
        return [[((self.l1 * e2 - self.l2 * e1) / d).real, ((e1 - e2) / d).real],
                [(self.l1 * self.l2 * (e2 - e1) / d).real, ((self.l1 * e1 - self.l2 * e2) / d).real]]

    def solve(self, i, level, lo, hi):
        """the time in [lo, hi] at which at()[i] passes level; signs differ at the ends"""
        up = self.at(hi)[i] > level
        s, tol = (lo + hi) / 2, mpf(10) ** (5 - mp.dps) * max(1, hi)
        for _ in range(500):
            y = self.at(s)
            f, df = y[i] - level, y[i + 1]
            if (f > 0) == up:
                hi = s
            else:
                lo = s
            n = s - f / df if df else lo
            if not lo < n < hi:
                n = (lo + hi) / 2
            if abs(n - s) < tol or hi - lo < tol:
                return n
            s = n
        raise ArithmeticError("no convergence")

    def first_exit(self, lo, hi, end, friction, direction):
        """(time, kind) of the first event; kind is 'down', 'up', 'halt' or 'end'.
        direction: sign of the velocity just after the start."""
        s0, y0 = mpf(0), (self.x, self.v, self.acc(0, self.x, self.v))
        if not self.v and abs(y0[2]) < mpf(10) ** (10 - mp.dps):
            y0 = self.x, self.v, mpf(0)     # coming off a rest: nothing but rounding
        if self.v and y0[2]:
            ds = min(self.step, abs(self.v / y0[2]) / 4)
        else:
            ds = self.step / 2 ** 20
            while sign(self.at(ds)[1]) != direction:
                ds /= 2
                assert ds > self.step / mpf(2) ** 120, "cannot leave the start"
        while s0 < end:
            s1 = min(s0 + ds, end)
            y1 = self.at(s1)
            zeros = []
            d0 = sign(y0[1]) if s0 and y0[1] else direction
            if sign(y1[1]) != d0:
                if s0 == 0 and y0[2] and not y0[1]:
                    raise ArithmeticError("first step too long")
                zeros = [self.solve(1, 0, s0, s1)]
            elif y0[2] * y1[2] < 0 and y0[2] * d0 < 0:
                m = self.touch(s0, s1)
                if sign(self.at(m)[1]) != d0:
                    zeros = [self.solve(1, 0, s0, m), self.solve(1, 0, m, s1)]
            direction = sign(y1[1]) or direction
            left = s0
            for right in zeros + [s1]:
                x = y1[0] if right is s1 else self.at(right)[0]
                if x < lo or x > hi:
                    return self.solve(0, lo if x < lo else hi, left, right), \
                        "down" if x < lo else "up"
                if friction and right is not s1:
                    return right, "halt"
                left = right
            s0, y0, ds = s1, y1, min(2 * ds, self.step)
        return end, "end"

    def touch(self, lo, hi):
        """zero of the acceleration in [lo, hi] by bisection (precision is not needed)"""
        up = self.at(hi)[2] > 0
        for _ in range(100):
            m = (lo + hi) / 2
            lo, hi = (lo, m) if (self.at(m)[2] > 0) == up else (m, hi)
        return (lo + hi) / 2


class Machine:
    def __init__(self, **p):
        self.p = dict(regime="unloaded", frequency=1.15, clearance=10.0, damping=0.02,
                      contact_damping=0.09, stiffness=7.0, preload=70.0)
        if p.get("regime") == "loaded":
            self.p.update(k2=21.0, k3=23.0, sigma=0.4, sigma_nu=0.9)
        self.p.update(p)
        q = {k: v if k == "regime" else mpf(v) for k, v in self.p.items()}
        self.w, r, k4 = q["frequency"], q["clearance"], q["stiffness"]
        B, free = q["contact_damping"], (q["damping"], mpf(1), mpf(0))
        last = lambda x3: (B, 1 + k4, k4 * x3 - q["preload"])
        if q["regime"] == "unloaded":
            self.levels, self.friction = [r], []
            self.phases = [{0: free}, {0: last(r)}]
        else:
            s, k2, k3 = q["sigma"], q["k2"], q["k3"]
            self.levels, self.friction = [r, r + s, r + q["sigma_nu"]], [1, 2]
            one = {g: (B, 1 + k2 + g * k3, (k2 + g * k3) * r) for g in (1, -1)}
            two = {g: (B, mpf(1), -s * (k2 + k3) / 40 * (1 + 3 * g)) for g in (1, -1)}
            self.phases = [{0: free}, one, two, {0: last(self.levels[2])}]
        self.period = 2 * pi / self.w

    def rest(self, i, x, th):
        """after X' = 0 at x in friction phase i: (direction, time stuck)"""
        pull = {g: self.phases[i][g][1] * x - self.phases[i][g][2] for g in (1, -1)}
        if x == self.levels[-1]:        # leaning on the preloaded stop
            pull[1] = self.phases[-1][0][1] * x - self.phases[-1][0][2]
        if cos(th) > pull[1]:
            return 1, mpf(0)
        if cos(th) < pull[-1]:
            return -1, mpf(0)
        # stuck: cos rises through pull[1] at angle -acos, falls through pull[-1] at +acos
        out = [(inf, 1)]
        for g in (1, -1):
            if abs(pull[g]) < 1:
                out.append(((-g * acos(pull[g]) - th) % (2 * pi), g))
        wait, g = min(out)
        return g, wait / self.w

    def run(self, th, x, v, marks):
        """From (x, v) at drive angle th: states at the times in marks, the monodromy
        to the last one, impacts (time, velocity), largest position, list of events"""
        x, v, t, marks = mpf(x), mpf(v), mpf(0), [mpf(m) for m in marks]
        th0, end = mpf(th), marks[-1]
        M, states, impacts, events, top = [[mpf(1), mpf(0)], [mpf(0), mpf(1)]], [], [], [], x
        i = sum(1 for l in self.levels if x > l or x == l and v > 0)
        g = int(sign(v)) if i in self.friction else 0
        kind = "halt" if i in self.friction and v == 0 else ""
        assert v or x not in self.levels
        mulm = lambda A, B: [[A[r][0] * B[0][c] + A[r][1] * B[1][c] for c in (0, 1)] for r in (0, 1)]

        while True:
            th = th0 + self.w * t
            before = acc if t else None
            direction = sign(v)
            if kind == "halt":
                g, wait = self.rest(i, x, th)
                direction = g
                if wait:
                    events.append((t, "stick", x))
                    while len(states) < len(marks) and marks[len(states)] <= t + wait:
                        states.append((x, mpf(0)))
                    M = [M[0], [mpf(0), mpf(0)]]
                    if t + wait >= end:
                        break
                    t, th = t + wait, th + self.w * wait
            arc = Arc(self.phases[i][g], self.w, th, x, v)
            after = arc.acc(0, x, v)
            if kind in ("up", "down"):
                M = mulm([[1, 0], [(after - before) / v, 1]], M)
            elif kind == "halt" and before and not wait:
                M = mulm([[1, 0], [0, after / before]], M)
            if not v and not direction:
                direction = sign(after)
            lo = self.levels[i - 1] if i else -inf
            hi = self.levels[i] if i < len(self.levels) else inf
            s, kind = arc.first_exit(lo, hi, end - t, i in self.friction, direction)
            while len(states) < len(marks) and (marks[len(states)] < t + s or kind == "end"):
                states.append(arc.at(marks[len(states)] - t)[:2])
            if kind == "end":
                M = mulm(arc.matrix(s), M)
                break
            M = mulm(arc.matrix(s), M)
            x, v, acc = arc.at(s)
            if i == len(self.levels):   # the largest position lies in the last phase
                top = max(top, arc.at(arc.solve(1, 0, mpf(0), s))[0] if arc.v > 0 > v else x)
            t = t + s
            if kind == "halt":
                v, top = mpf(0), max(top, x)
            else:
                x = hi if kind == "up" else lo
                if kind == "up" and i == 0:
                    impacts.append((t, v))
                i += 1 if kind == "up" else -1
                g = int(sign(v)) if i in self.friction else 0
            events.append((t, kind, x))
            if self.friction and kind == "up" and x == self.levels[-1] and v < LEAST:
                i, v, kind = i - 1, mpf(0), "halt"
        return states, M, impacts, top, events

    def cycle(self, x, v):
        """one period from drive angle 0"""
        return self.run(0, x, v, [self.period])


def newton(f, u, tol=mpf(10) ** -38, limit=30):
    """Newton for f(u) = 0 in n unknowns; the Jacobian by differences of 1e-22."""
    h = mpf(10) ** -22
    for _ in range(limit):
        F = f(u)
        J = mp.matrix(len(u), len(u))
        for j in range(len(u)):
            G = f([x + (h if k == j else 0) for k, x in enumerate(u)])
            for r in range(len(u)):
                J[r, j] = (G[r] - F[r]) / h
        d = mp.lu_solve(J, mp.matrix(F))
        u = [x - d[k] for k, x in enumerate(u)]
        if max(abs(x) for x in d) < tol:
            return u
    raise ArithmeticError("Newton did not converge")


def orbit(machine, x, v):
    """the z = 1 orbit near (x, v): Newton with the exact monodromy"""
    for _ in range(30):
        (s,), M, *_ = machine.cycle(x, v)
        d = mp.lu_solve(mp.matrix([[M[0][0] - 1, M[0][1]], [M[1][0], M[1][1] - 1]]),
                        mp.matrix([x - s[0], v - s[1]]))
        x, v = x + d[0], v + d[1]
        if max(abs(d[0]), abs(d[1])) < mpf(10) ** -40:
            return x, v
    raise ArithmeticError("no orbit")


def settle(machine, x, v, periods):
    return machine.run(0, x, v, [machine.period * periods])[0][-1]


def trace_det(M):
    return M[0][0] + M[1][1], M[0][0] * M[1][1] - M[0][1] * M[1][0]


def text(z):
    return nstr(z, DIGITS, strip_zeros=False)


# ---------------------------------------------------------------- (a) trajectories
STIFF = dict(stiffness=1e6, preload=0.0)
SCENES = [
    # name, parameters, drive angle, starts, periods
    ("unloaded A", dict(), 0.0, [(0., 14.), (-3., 2.), (10.5, 1.), (-20., 0.)], 30),
    ("unloaded chaotic", dict(frequency=0.9875), 0.0, [(0., 14.), (5., 0.)], 6),
    ("loaded B", dict(regime="loaded"), 0.0,
     [(0., 14.), (10.2, 3.), (10.6, -1.), (11.5, 0.), (10.6, 0.)], 30),
    ("loaded small clearance", dict(regime="loaded", frequency=1.1, clearance=2.0), 0.0,
     [(0., 14.), (2.2, 0.), (-4., 1.)], 25),
    ("loaded clearance 0", dict(regime="loaded", frequency=0.8, clearance=0.0), 0.0,
     [(0., 14.), (-1., 0.5)], 20),
    ("loaded clearance -0.5", dict(regime="loaded", frequency=0.5, clearance=-0.5), 0.0,
     [(0., 3.), (-2., 0.)], 12),
    ("loaded clearance -2", dict(regime="loaded", frequency=1.3, clearance=-2.0), 1.0,
     [(0., 0.), (-4., 8.)], 12),
    ("loaded, leaning on the stop",
     dict(regime="loaded", frequency=0.5, clearance=-0.3, sigma=0.05, sigma_nu=0.3), 0.0,
     [(0., 3.), (-1., 0.)], 10),
    ("unloaded clearance 0.5", dict(frequency=0.7, clearance=0.5), 0.0,
     [(0., 14.), (0., 0.)], 12),
    ("unloaded clearance -1", dict(frequency=1.3, clearance=-1.0), 0.0,
     [(0., 14.), (-2., 0.)], 12),
    ("stiff, small damping", dict(STIFF), 0.0, [(0., 14.)], 10),
    ("stiff, damping ratio 0.09", dict(STIFF, contact_damping=0.09 * (1 + 1e6) ** 0.5), 0.0,
     [(0., 14.), (9.9, 5.)], 20),
    ("no preload", dict(preload=0.0), -2.0, [(0., 14.), (12., 0.)], 20),
    ("drive angle 2.5", dict(frequency=1.3), 2.5, [(-4., 16.)], 20),
]


def trajectories():
    out = []
    for name, p, angle, starts, n in SCENES:
        m = Machine(**p)
        marks = [m.period * k for k in range(1, n + 1)]
        for x, v in starts:
            begin = time.time()
            states, _, impacts, top, events = m.run(angle, x, v, marks)
            # growth of a disturbance of the start, by differences
            h = mpf(10) ** -25
            near = [m.run(angle, *z, marks)[0] for z in ((mpf(x) + h, v), (x, mpf(v) + h))]
            growth = [float(max(abs(b[k][j] - states[k][j]) / h for b in near for j in (0, 1)))
                      for k in range(n)]
            stuck = [e for e in events if e[1] == "stick"]
            print(f"{name} from ({x}, {v}): {len(impacts)} impacts, {len(events)} events, "
                  f"{len(stuck)} rests, growth {growth[-1]:.2g}, {time.time() - begin:.1f} s",
                  flush=True)
            out.append(dict(
                name=name, parameters=m.p, drive_angle=angle, position=x, velocity=v,
                periods=[dict(time=text(t), position=text(s[0]), velocity=text(s[1]), growth=g)
                         for t, s, g in zip(marks, states, growth)],
                impacts=[dict(time=text(t), velocity=text(u)) for t, u in impacts],
                rests=[dict(time=text(t), position=text(z)) for t, _, z in stuck],
                events=len(events)))
    return out


# ---------------------------------------------------------------- (b) z = 1 orbits
def describe(m, x, v):
    (s,), M, impacts, top, events = m.cycle(x, v)
    tr, det = trace_det(M)
    h = mpf(10) ** -18
    cols = []
    for d in ((h, 0), (0, h)):
        (a,), (b,) = m.cycle(x + d[0], v + d[1])[0], m.cycle(x - d[0], v - d[1])[0]
        cols.append([(a[j] - b[j]) / (2 * h) for j in (0, 1)])
    worst = max(abs(cols[c][r] - M[r][c]) for r in (0, 1) for c in (0, 1))
    assert worst < mpf(10) ** -25, worst
    d = sqrt(mpc(tr * tr / 4 - det))
    return dict(parameters=m.p, position=text(x), velocity=text(v),
                impacts=[dict(time=text(t), velocity=text(u)) for t, u in impacts],
                max_position=text(top), trace=text(tr), determinant=text(det),
                monodromy=[[text(z) for z in row] for row in M],
                multipliers=[[text(z.real), text(z.imag)] for z in (tr / 2 + d, tr / 2 - d)],
                events=[dict(time=text(t), kind=k, position=text(z)) for t, k, z in events])


def orbits():
    out = []
    for p, start in ((dict(), (6.901267951548, 9.516655745459)),
                     (dict(regime="loaded"), (0., 14.))):
        m = Machine(**p)
        x, v = orbit(m, *settle(m, *start, 60))
        out.append(describe(m, x, v))
        print(m.p["regime"], {k: out[-1][k] for k in out[-1] if k not in ("parameters", "events")})
    return out


# ---------------------------------------------------------------- (c) folds
def fold_equations(regime, rho):
    def f(u):
        m = Machine(regime=regime, clearance=rho, frequency=u[2])
        (s,), M, *_ = m.cycle(u[0], u[1])
        tr, det = trace_det(M)
        return [s[0] - u[0], s[1] - u[1], 1 - tr + det]
    return f


def folds():
    """the fold that ends z = 1 (s_SN): starts at clearance 10 from the orbit just short
    of it and is followed in the clearance, steps of 1, both ways"""
    out = []
    for regime, near, start in (("unloaded", 1.369, (-9.2, 17.41)),
                                ("loaded", 1.293, (-6.47, 15.55))):
        x, v = orbit(Machine(regime=regime, frequency=near, clearance=10), *start)
        found = {10: newton(fold_equations(regime, 10), [x, v, mpf(near)])}
        for step, last in ((1, 24), (-1, 1)):
            for rho in range(10 + step, last + step, step):
                a, b = found[rho - step], found.get(rho - 2 * step)
                try:
                    found[rho] = newton(fold_equations(regime, rho),
                                        [2 * p - q for p, q in zip(a, b)] if b else a)
                except (ArithmeticError, AssertionError, IndexError, ZeroDivisionError) as e:
                    print(regime, rho, "fold not followed:", repr(e))
                    break
        for rho, (x, v, eta) in sorted(found.items()):
            m = Machine(regime=regime, clearance=float(rho), frequency=eta)
            (s,), M, impacts, top, events = m.cycle(x, v)
            tr, det = trace_det(M)
            assert len(impacts) == 1 and abs(1 - tr + det) < mpf(10) ** -33
            halts = [e for e in events if e[1] in ("halt", "stick")]
            print(regime, rho, *(nstr(z, 15) for z in (eta, impacts[0][1], top, tr, det)),
                  "turns round in phase I or II" if halts else "", flush=True)
            del m.p["frequency"]
            out.append(dict(parameters=m.p, frequency_sn=text(eta), velocity_sn=text(impacts[0][1]),
                            position=text(x), velocity=text(v), max_position=text(top),
                            trace=text(tr), determinant=text(det)))
    return out


# ---------------------------------------------------------------- (d) g0, zone, optimum
def g0(rho, B=mpf(0.02)):
    p = 1 - 2 * B ** 2
    d = sqrt(p ** 2 - 1 + 1 / mpf(rho) ** 2)
    return sqrt(p - d), sqrt(p + d)


def boundaries():
    """amplitude of the impact-less motion = clearance"""
    B, out = mpf(0.02), []
    for rho in (2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 25):
        lo, hi = g0(rho)
        for e in (lo, hi):
            assert abs(1 / sqrt((1 - e ** 2) ** 2 + (2 * B * e) ** 2) - rho) < mpf(10) ** -40
        out.append(dict(clearance=float(rho), damping=0.02, frequency_low=text(lo),
                        frequency_g0=text(hi)))
    return out


def zone():
    """velocity of z = 1 inside the hysteresis zone, frequency = g0 + s (s_SN - g0), and
    the clearance at which it is largest for s = 0.75 (margin 0.25), from folds"""
    with open(PATH) as f:
        known = [(c["parameters"]["regime"], int(c["parameters"]["clearance"]),
                  [mpf(c[k]) for k in ("position", "velocity", "frequency_sn")])
                 for c in json.load(f)["folds"]]
    out = []
    for regime in ("unloaded", "loaded"):
        fold = {rho: u for r, rho, u in known if r == regime}
        # at clearance 10 from the known orbit up to each s, then along the clearance
        start = orbit(Machine(regime=regime), *settle(Machine(regime=regime), 0., 14., 60))
        for part in (.25, .5, .75, .9):
            at = lambda rho, e: g0(rho)[1] + mpf(part) * (e - g0(rho)[1])
            goal, z = at(10, fold[10][2]), start
            for k in range(1, 21):
                m = Machine(regime=regime, frequency=mpf(1.15) + (goal - mpf(1.15)) * k / 20)
                z = orbit(m, *z)
            found = {10: z}
            for step in (1, -1):
                rho = 10 + step
                while rho in fold:
                    a, b = found[rho - step], found.get(rho - 2 * step)
                    m = Machine(regime=regime, clearance=rho, frequency=at(rho, fold[rho][2]))
                    try:
                        found[rho] = orbit(m, *([2 * p - q for p, q in zip(a, b)] if b else a))
                    except (ArithmeticError, AssertionError, IndexError, ZeroDivisionError) as e:
                        print(regime, part, rho, "not followed:", repr(e))
                        break
                    rho += step
            speed = {}
            for rho, z in sorted(found.items()):
                m = Machine(regime=regime, clearance=float(rho), frequency=at(rho, fold[rho][2]))
                _, M, impacts, top, events = m.cycle(*z)
                tr, det = trace_det(M)
                stable = abs(det) < 1 and 1 - tr + det > 0 and 1 + tr + det > 0
                speed[rho] = impacts[0][1]
                print(regime, part, rho, nstr(m.w, 10), nstr(speed[rho], 10), len(impacts),
                      "" if stable else "UNSTABLE", flush=True)
                out.append(dict(regime=regime, clearance=float(rho), s=part, frequency=text(m.w),
                                before_impact_velocity=text(speed[rho]), impacts=len(impacts),
                                stable=bool(stable), position=text(z[0]), velocity=text(z[1])))
            if part == .75:
                out.append(optimum(regime, at, fold, found, max(speed, key=speed.get)))
                print(out[-1])
    return out


def optimum(regime, at, fold, found, rho):
    """clearance of the largest velocity along s = const: dV/d(clearance) = 0, differences
    of 1e-10 at 50 digits, secant"""
    def speed(r):
        u = newton(fold_equations(regime, r), fold[rho])
        m = Machine(regime=regime, clearance=r, frequency=at(r, u[2]))
        z = orbit(m, *found[rho])
        return m.cycle(*z)[2][0][1], m.w, u[2]

    h = mpf(10) ** -10
    slope = lambda r: (speed(r + h)[0] - speed(r - h)[0]) / (2 * h)
    r0, r1 = mpf(rho), mpf(rho) + mpf("0.1")
    f0, f1 = slope(r0), slope(r1)
    while abs(r1 - r0) > mpf(10) ** -16:
        r0, r1, f0 = r1, r1 - f1 * (r1 - r0) / (f1 - f0), f1
        f1 = slope(r1)
    v, w, e = speed(r1)
    return dict(regime=regime, optimum=True, margin=0.25, clearance=nstr(r1, 15),
                frequency=nstr(w, 15), before_impact_velocity=nstr(v, 18),
                frequency_g0=nstr(g0(r1)[1], 15), frequency_sn=nstr(e, 15))


# regime, clearance, then near the peak: frequency, position, velocity
PEAKS = [("unloaded", 1, 1.7016511, -10.7327, 14.5642),
         ("unloaded", 2, 1.6539727, -10.3778, 14.9336),
         ("unloaded", 4, 1.56786, -9.69202, 15.7014), ("unloaded", 6, 1.4926441, -9.08773, 16.4712),
         ("unloaded", 8, 1.4261821, -8.38607, 17.3219),
         ("unloaded", 10, 1.3673158, -7.75822, 18.1567),
         ("loaded", 2, 1.6021247, -6.95549, 10.6478), ("loaded", 4, 1.4992909, -6.9833, 12.0133),
         ("loaded", 6, 1.4171291, -6.55506, 13.4177), ("loaded", 8, 1.349506, -6.11585, 14.6878),
         ("loaded", 10, 1.2917787, -5.62607, 15.8953)]


def peaks():
    """the largest before-impact velocity on the stable z = 1 branch at given clearance:
    dV/d(frequency) = 0, differences of 1e-12, secant"""
    out, h = [], mpf(10) ** -12
    for regime, rho, e0, *z in PEAKS:
        def at(e):
            m = Machine(regime=regime, clearance=float(rho), frequency=e)
            u = orbit(m, *z)
            return u, m.cycle(*u)

        slope = lambda e: (at(e + h)[1][2][0][1] - at(e - h)[1][2][0][1]) / (2 * h)
        e0 = mpf(e0)
        e1, f0 = e0 + mpf("1e-5"), slope(e0)
        f1 = slope(e1)
        while abs(e1 - e0) > mpf(10) ** -13:
            e0, e1, f0 = e1, e1 - f1 * (e1 - e0) / (f1 - f0), f1
            z = at(e1)[0]
            f1 = slope(e1)
        u, (_, M, impacts, top, _) = at(e1)
        tr, det = trace_det(M)
        assert len(impacts) == 1 and abs(det) < 1 and 1 - tr + det > 0 and 1 + tr + det > 0
        print(regime, rho, nstr(e1, 15), nstr(impacts[0][1], 15), flush=True)
        out.append(dict(regime=regime, clearance=float(rho), frequency=nstr(e1, 13),
                        before_impact_velocity=nstr(impacts[0][1], 18),
                        position=nstr(u[0], 12), velocity=nstr(u[1], 12),
                        max_position=nstr(top, 12), trace=nstr(tr, 12), determinant=nstr(det, 12)))
    return out


PATH = os.path.join(os.path.dirname(os.path.abspath(__file__)), "machine.json")


def main():
    try:
        with open(PATH) as f:
            data = json.load(f)
    except FileNotFoundError:
        data = {}
    for section in sys.argv[1:] or ("trajectories", "orbits", "folds", "boundaries", "zone", "peaks"):
        begin = time.time()
        data[section] = globals()[section]()
        print(section, f"{time.time() - begin:.0f} s", flush=True)
        with open(PATH, "w") as f:
            json.dump(data, f, indent=1)
            f.write("\n")


if __name__ == "__main__":
    main()
