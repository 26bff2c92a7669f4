"""Reference motions of impact oscillators with many kinds of stops, in mpmath.

Equation:  x'' + b x' + x + F = a cos(w t + phase) + p(t),  a = 1, p = 0 here (lab.py and force.py have others)
x < clearance: b = damping, F = 0;  beyond: b = contact_damping and
    strip, if any   r < x < r+s:     F = (x - r)(k2 + k3 sign v)          (phase I)
                    r+s < x < x_stop = r+s+travel: F = s (k2+k3)/40 (1 + 3 sign v)
    x > x_stop      d = x - x_stop, F by the model of the stop:
      kelvinVoigt     k d; release "zeroForce": F = 0 and b = damping while k d + (b - b1) v < 0
      preloaded       P + k d
      piecewiseLinear continuous, slopes from each deflection on; unloading curve for v < 0
      hertz           k d^n max(0, 1 + lam v)
      rigid           v -> -R v at x_stop; a rigid wall may also lie behind another stop
Forces that jump at v = 0 are dry friction (Filippov): the mass sticks while cos - x lies between
them. A mass that bounces with falling velocity is bounced on until 1e-45, then it rests (twice the
digits where it bounces between friction and a stop: heights of the bounces down to 1e-90).
All parameters are doubles, taken exactly; sums of them are not rounded.

Arcs: Taylor series of the equation itself, both for linear laws (entire functions) and for Hertz
at d > 0 (order 64, steps geometric in d, integers of 200 bits). At the touch of a Hertz stop d is
a double series in t and t^n (t and t^2n from rest); leaving, the same series backwards in time,
matched to the arc by Broyden's method. First roots of the events are isolated by bounds on
first and second derivatives, then Newton. Growth: product of arc and saltation matrices, floats.

Times: t, not divided by the period; "periods" = t w / (2 pi). Growth = largest singular value of
d(state)/d(start), or of that since the end of the last rest, or 1, whichever is the largest.
rests: also sticking by friction; "to" is null if it never ends. wall: hits of a rigid stop that
does not lie at the clearance itself.

Run:  python stops.py [family] ...      writes the named families (default: all) of stops.json
      python stops.py check             Hertz against the energy integral (quadrature)
      DPS=70 python stops.py compare [family] ...   runs again, other precision, prints differences
"""
import cmath
import json
import math
import os
import random
import sys
import time
from operator import mul
from mpmath import mp, mpf, cos, sin, acos, pi, sqrt, nstr, inf, log, floor

BASE = mp.dps = int(os.environ.get("DPS", 56))
DIGITS = 30
TINY = mpf(10) ** -45
TOL = mpf(10) ** (6 - mp.dps)       # truncation of the Hertz series
P = int(mp.dps * 3.33) + 16         # bits behind the point of their integers
ONE = 1 << P
ORDER = 64 + 2 * (mp.dps - 56)
REACH = 32 + (mp.dps - 56)


def fix(z):
    return int(floor(mpf(z) * ONE + mpf(1) / 2))


def horner(c, s):
    y = mpf(0)
    for a in reversed(c):
        y = y * s + a
    return y


def first_root(G, h):
    """the first s in (0, h] at which the polynomial G, positive just after 0, turns negative"""
    n = 0
    while n < len(G) and not G[n]:
        n += 1
    G = G[n:]
    if not G:
        return None
    if G[0] < 0:
        raise ArithmeticError("event at the start of an arc")
    size, q = [], mpf(1)
    for a in G:
        size.append(abs(a) * q)
        q *= h
    if sum(size[1:], -size[0]) < 0:
        return None
    D = [k * a for k, a in enumerate(G)][1:] or [mpf(0)]
    d1 = sum((k * a for k, a in enumerate(size)), mpf(0)) / h
    d2 = sum((k * (k - 1) * a for k, a in enumerate(size)), mpf(0)) / h ** 2
    todo = [(mpf(0), h)]
    while todo:
        a, b = todo.pop()
        m, r = (a + b) / 2, (b - a) / 2
        g = horner(G, m)
        if g > d1 * r:
            continue
        if abs(horner(D, m)) > d2 * r or r < h * mpf(10) ** -25:
            if horner(G, b) < 0:
                return newton(G, D, a, b)
            continue
        if g > 0:
            todo.append((m, b))
        todo.append((a, m))
    return None


def newton(G, D, lo, hi):
    s, eps = (lo + hi) / 2, mpf(10) ** (3 - mp.dps)
    for _ in range(600):
        g, d = horner(G, s), horner(D, s)
        if g > 0:
            lo = s
        else:
            hi = s
        n = s - g / d if d else lo
        if not lo <= n <= hi:
            n = (lo + hi) / 2
        if abs(n - s) <= eps * n:
            return n
        s = n
    raise ArithmeticError("no convergence")


class Push:
    """amplitude cos(w t + phase) + p(t), p = sum of force[k] t^k / k!, t = (th - phase) / w"""

    def __init__(self, w, phase, force, amplitude):
        self.w, self.phase, self.force, self.amplitude = w, phase, force, amplitude

    def series(self, th, size, way=1):
        """coefficients by s at th + way w s"""
        w, a = way * self.w, self.amplitude
        f = [a * cos(th), -a * w * sin(th)]
        for k in range(2, size):
            f.append(-w * w * f[k - 2] / (k * (k - 1)))
        if self.force:
            t, c = (th - self.phase) / self.w, mpf(1)
            for k in range(min(size, len(self.force))):
                p, q = mpf(0), mpf(1)
                for j, d in enumerate(self.force[k:]):
                    p, q = p + d * q, q * t / (j + 1)
                f[k] += c * p
                c *= mpf(way) / (k + 1)
        return f[:size]

    def at(self, th):
        return self.series(th, 1)[0]

    def crossing(self, th, level, way, end):
        """time from th until the push minus level, way times, turns positive; inf if not before end"""
        g = lambda s: way * (self.at(th + self.w * s) - level)
        left, ds = mpf(0), min(1 / self.w, mpf(1)) / 50
        while left < end:
            if g(left + ds) > 0:
                lo, hi = left, left + ds
                while hi - lo > mpf(10) ** (4 - mp.dps) * hi:
                    m = (lo + hi) / 2
                    lo, hi = (lo, m) if g(m) > 0 else (m, hi)
                return hi
            left += ds
        return inf


class Linear:
    """x'' = push - b x' - kappa x - c; still: at rest, the forces in balance;
    ahead: a level (short steps towards it out of a near turn)"""
    end = None

    def __init__(self, law, push, th, x, v, still, ahead):
        self.b, self.kappa, c = law
        w = push.w
        rate = max(w, self.b + sqrt(abs(self.kappa)))
        a = mpf(0) if still else push.at(th) - self.b * v - self.kappa * x - c
        h = mpf("2.5") / rate
        if v * a < 0:
            h = min(h, -8 * v / a)
        elif (ahead - x) * a > 0 and ahead - x < inf:
            h = min(h, 8 * sqrt((ahead - x) / a))
        n, q = 2, mpf(1)
        while n < 9 or q > mpf(10) ** -(mp.dps + 3):
            n += 1
            q *= h * rate / n
        n += 12 if push.force else 0
        f = push.series(th, n)
        C = [x, v, a / 2]
        for k in range(1, n):
            C.append((f[k] - self.b * (k + 1) * C[k + 1] - self.kappa * C[k]) / ((k + 1) * (k + 2)))
        self.C, self.h = C, h
        self.V = [k * z for k, z in enumerate(C)][1:]

    def at(self, s):
        return horner(self.C, s), horner(self.V, s)

    def matrix(self, s):
        s, b, k = float(s), float(self.b), float(self.kappa)
        d = cmath.sqrt(b * b / 4 - k)
        if abs(d * s) < 1e-6:
            c, q = 1 + (d * s) ** 2 / 2, s * (1 + (d * s) ** 2 / 6)
            e = math.exp(-b * s / 2)
            c, q = (e * c).real, (e * q).real
        else:
            p, m = cmath.exp((d - b / 2) * s), cmath.exp((-d - b / 2) * s)
            c, q = ((p + m) / 2).real, ((p - m) / (2 * d)).real
        return [[c + b / 2 * q, q], [-k * q, c - b / 2 * q]]


class Hertz:
    """what the two series of a Hertz contact share"""

    def __init__(self, law):
        self.b, self.k, self.n, self.lam, self.xs = law

    def flow(self, s, state, sub=8):
        """fundamental matrix after s, classical Runge-Kutta in floats, state(s) -> d, v"""
        k, n, lam, b = (float(z) for z in (self.k, self.n, self.lam, self.b))
        h, M = float(s) / sub, [1., 0., 0., 1.]

        def slope(A, M):
            return [M[2], M[3], A[0] * M[0] + A[1] * M[2], A[0] * M[1] + A[1] * M[3]]

        def jac(s):
            d, v = state(s)
            d = max(d, 0.)
            return -1 - k * n * d ** (n - 1) * (1 + lam * v), -b - lam * k * d ** n

        for i in range(sub):
            A, B, C = (jac((i + z) * h) for z in (0, .5, 1))
            p = slope(A, M)
            q = slope(B, [m + h / 2 * z for m, z in zip(M, p)])
            r = slope(B, [m + h / 2 * z for m, z in zip(M, q)])
            u = slope(C, [m + h * z for m, z in zip(M, r)])
            M = [m + h / 6 * (a + 2 * b_ + 2 * c + d) for m, a, b_, c, d in zip(M, p, q, r, u)]
        return [M[:2], M[2:]]


class Inside(Hertz):
    """Taylor series at d > 0, in units of d and of a guessed step"""
    end = None

    def __init__(self, law, push, th, x, v):
        super().__init__(law)
        b, k, n, lam, xs = law
        w, d = push.w, x - xs
        a = push.at(th) - b * v - x - k * d ** n * (1 + lam * v)
        h = min(d / abs(v) if v else mpf(1), sqrt(d / abs(a)) if a else mpf(1),
                1 / sqrt(1 + k * n * d ** (n - 1) * abs(1 + lam * v)), 1 / w,
                1 / (1 + b + lam * k * d ** n), 1 / (1 + lam * abs(a))) / 5
        D, W, G, m = [ONE, fix(v * h / d)], [ONE], [], [0, 0]
        m[1] = D[1]
        Q = [fix(1 + lam * v)]
        bh, hh, K, n1, ld = fix(b * h), fix(h * h), fix(h * h * k * d ** (n - 1)), fix(n + 1), fix(lam * d / h)
        q = h * h / d
        f = [q * h ** j * z for j, z in enumerate(push.series(th, ORDER))]
        pull = fix(q * xs)
        for j in range(ORDER - 1):
            if j:
                back = W[::-1]
                W.append((n1 * sum(map(mul, m[1:j + 1], back)) // j >> 2 * P)
                         - (sum(map(mul, D[1:j + 1], back)) >> P))
                Q.append(ld * (j + 1) * D[j + 1] >> P)
            g = sum(map(mul, W, Q[::-1])) >> P
            y = fix(f[j]) - (pull if not j else 0) \
                - ((bh * (j + 1) * D[j + 1] + hh * D[j] + K * g) >> P)
            D.append(y // ((j + 1) * (j + 2)))
            m.append((j + 2) * D[-1])
        last = max(abs(D[-1]), abs(D[-2]), abs(D[-3]), 1)
        self.h = h * min(2, (TOL * ONE / last) ** (mpf(1) / ORDER))
        self.C, q = [], d / ONE
        for z in D:
            self.C.append(z * q)
            q /= h
        self.F, self.hf = [float(mpf(z) * d / ONE) for z in D], float(h)
        self.C[0], self.C[1] = x, v
        self.V = [j * z for j, z in enumerate(self.C)][1:]

    at = Linear.at

    def matrix(self, s):
        def state(s):
            s, d, v = s / self.hf, 0., 0.
            for z in reversed(self.F):
                v = v * s + d
                d = d * s + z
            return d, v / self.hf
        return self.flow(s, state)


class Touch(Hertz):
    """y = d as a double series in s and s^(pn) about the touch, y ~ speed s (p = 1) or, from
    rest, acceleration s^2 / 2 (p = 2); way = -1: backwards in time (speed = -v)"""
    end = None

    def __init__(self, law, push, th, speed, way=1):
        super().__init__(law)
        b, k, n, lam, xs = law
        self.way, self.th = way, th
        w, b, lam = push.w, way * b, way * lam
        p = self.p = 1 if speed else 2
        f = push.at(th) - xs
        if p == 1:
            T = min((1 / (k * speed ** (n - 1))) ** (1 / (n + 1)), speed / max(abs(f), TINY))
        else:
            assert f > 0 and way > 0
            T = (1 / (k * (f / 2) ** (n - 1))) ** (1 / (2 * n))
        T = min(T, 1 / abs(w), 1 / (1 + abs(b)), 1 / (1 + abs(lam) * (abs(f) + speed))) / 3
        Y = speed * T if p == 1 else f / 2 * T * T
        q = self.q = p * n
        rows = int(REACH / q) + 1
        bT, T2, K, lY = fix(b * T), fix(T * T), fix(T * T * k * Y ** (n - 1)), fix(lam * Y / T)
        self.T, self.Y, self.U, self.E = T, Y, [], []
        W, Q, g, fn = [], [], None, fix(n)
        for j in range(rows):
            size = int(REACH - q * j) + 1
            e = [fix(p + i + q * j) for i in range(size)]
            ee = [fix((p + i + q * j) * (p + i + q * j - 1)) for i in range(size)]
            if not j:
                c = T * T / Y
                full = [c * T ** i * z for i, z in enumerate(push.series(th, size, way))]
                src = [fix(z) for z in [full[0] - c * xs] + full[1:]]
            else:
                src = [-(K * z >> P) for z in g]
            U, yd = [], []
            if p == 1:
                U.append(0 if j else ONE)
            else:
                yd.append(0)
            while len(U) < size:
                i = len(U)
                if p == 1:
                    yd.append(e[i - 1] * U[i - 1] >> P)
                    z = src[i - 1] - (bT * yd[i - 1] >> P) - (T2 * U[i - 2] >> P if i > 1 else 0)
                    U.append((z << P) // ee[i])
                else:
                    z = src[i] - (bT * yd[i] >> P) - (T2 * U[i - 2] >> P if i > 1 else 0)
                    U.append((z << P) // ee[i])
                    yd.append(e[i] * U[i] >> P)
            if p == 1:
                yd.append(e[size - 1] * U[size - 1] >> P)
            self.U.append(U)
            self.E.append([x * y >> P for x, y in zip(e, U)])
            Q.append([(ONE if not j and not i else 0) + (lY * z >> P) for i, z in enumerate(yd)])
            # W = (y / Y t^p)^n, row j
            U0 = self.U[0]
            if not j:
                row = [ONE]
                for i in range(1, size):
                    s = sum((fn * l - ((i - l) << P)) * (U0[l] * row[i - l] >> P) for l in range(1, i + 1))
                    row.append((s >> P) // i)
            else:
                acc = [0] * size
                for l in range(1, j + 1):
                    A, B = self.U[l], W[j - l]
                    c = fn * l - ((j - l) << P)
                    for i in range(size):
                        acc[i] += c * (sum(map(mul, A[:i + 1], B[i::-1])) >> P) >> P
                row = []
                for i in range(size):       # divide by j U0, U0[0] = 1
                    s = acc[i] // j - (sum(map(mul, row, U0[i:0:-1])) >> P)
                    row.append(s)
            W.append(row)
            size = int(REACH - q * (j + 1)) + 1
            g = [sum(sum(map(mul, W[l][:i + 1], Q[j - l][i::-1])) for l in range(j + 1)) >> P
                 for i in range(max(size, 0))]
        band = sum(abs(z) for j, U in enumerate(self.U) for i, z in enumerate(U)
                   if i + q * j > REACH - 3) + rows
        self.h = T * min(mpf(1), (TOL * ONE / band) ** (mpf(1) / (REACH - 3)))

    def y(self, s):
        """y and its derivative by s"""
        t = s / self.T
        if not t:
            return mpf(0), self.Y / self.T if self.p == 1 else mpf(0)
        u, r = fix(t), t ** self.q
        out = []
        for rows in (self.U, self.E):
            total = mpf(0)
            for R in reversed(rows):
                z = 0
                for c in reversed(R):
                    z = (z * u >> P) + c
                total = total * r + mpf(z) / ONE
            out.append(total)
        return self.Y * t ** self.p * out[0], self.Y / self.T * t ** (self.p - 1) * out[1]

    def at(self, s):
        if self.way < 0:
            y, v = self.y(self.end - s)
            return self.xs + y, -v
        y, v = self.y(s)
        return self.xs + y, v

    def matrix(self, s):
        T, Y, p, q = (float(z) for z in (self.T, self.Y, self.p, self.q))
        one = float(ONE)
        terms = [(p + i + q * j, z / ONE) for j, U in enumerate(self.U) for i, z in enumerate(U)
                 if abs(z) > ONE >> 60]
        end = float(self.end) if self.way < 0 else 0.

        def state(s):
            t = max((end - s if self.way < 0 else s) / T, 0.)
            return Y * sum(c * t ** e for e, c in terms), \
                self.way * Y / T * sum(c * e * t ** (e - 1) for e, c in terms)
        return self.flow(s, state)


def leave(law, push, th, x, v):
    """the backward series of the release that the state with v < 0 is heading for, or None"""
    d, u, s = x - law[4], -v, (x - law[4]) / -v
    b, k, n, lam = law[:4]
    w = push.w
    if k * u ** (n - 1) * s ** (n + 1) > .02 or s * max(w, 1, b) > .2:
        return None
    J = B = None
    for turn in range(30):
        if u <= 0 or s <= 0:
            return None
        L = Touch(law, push, th + w * s, u, -1)
        if s > L.h:
            return None
        y, yv = L.y(s)
        r = [y - d, yv + v]
        if B is None:       # inverse of the approximate Jacobian [[s, u], [1, a]]
            a = push.at(th) - law[4]
            det = s * a - yv
            B = [[a / det, -yv / det], [-1 / det, s / det]]
        else:               # Broyden's good update of the inverse
            z = [ra - rb for ra, rb in zip(r, last)]
            Bz = [B[i][0] * z[0] + B[i][1] * z[1] for i in (0, 1)]
            den = step[0] * Bz[0] + step[1] * Bz[1]
            if den:
                sB = [step[0] * B[0][j] + step[1] * B[1][j] for j in (0, 1)]
                B = [[B[i][j] + (step[i] - Bz[i]) * sB[j] / den for j in (0, 1)] for i in (0, 1)]
        step = [-(B[i][0] * r[0] + B[i][1] * r[1]) for i in (0, 1)]
        u, s, last = u + step[0], s + step[1], r
        if abs(step[0]) < TOL * u and abs(step[1]) < TOL * s:
            if lam and 1 - lam * max(u, -v) <= 0:
                return None
            L = Touch(law, push, th + w * s, u, -1)
            L.end = L.h = s
            return L
    return None


class Scene:
    slowest = mpf("1e-6")       # slower hits of a rigid stop are not told

    def __init__(self, frequency, damping, contact_damping, clearance, stop, rigid=None,
                 strip=None, phase=0.0, force=(), amplitude=1.0):
        self.w, b1, b, r = mpf(frequency), mpf(damping), mpf(contact_damping), mpf(clearance)
        self.phase, self.r = mpf(phase), r
        self.push = Push(self.w, self.phase, [mpf(d) for d in force], mpf(amplitude))
        kind, q = stop["model"], {k: mpf(v) for k, v in stop.items() if isinstance(v, (int, float))}
        free = (b1, mpf(1), mpf(0))
        self.regions = [dict(lo=-inf, up=free, down=free)]

        def add(lo, up, down=None, **more):
            """up, down: (slope, force at x = 0) of the law"""
            self.regions[-1]["hi"] = lo
            law = lambda z: (b, 1 + z[0], z[1])
            self.regions.append(dict(lo=lo, up=law(up), down=law(down or up), **more))

        xs = r
        if strip:
            k2, k3, s, travel = (mpf(strip[k]) for k in ("stiffness", "friction", "thickness", "travel"))
            assert s > 0
            add(r, (k2 + k3, -(k2 + k3) * r), (k2 - k3, -(k2 - k3) * r))
            F = s * (k2 + k3) / 40
            if travel:
                add(r + s, (mpf(0), 4 * F), (mpf(0), -2 * F))
            xs = r + s + travel
        wall, self.R = inf, None
        if kind == "rigid":
            wall, self.R = xs, q["restitution"]
            assert not rigid
        elif rigid:
            wall, self.R = xs + mpf(rigid["travel"]), mpf(rigid["restitution"])
        if kind == "kelvinVoigt":
            more = {}
            if stop["release"] == "zeroForce" and b != b1:
                more["fc"] = (q["stiffness"], b - b1, -q["stiffness"] * xs)
            else:
                assert stop["release"] in ("clearance", "zeroForce")
            add(xs, (q["stiffness"], -q["stiffness"] * xs), **more)
        elif kind == "preloaded":
            add(xs, (q["stiffness"], q["preload"] - q["stiffness"] * xs))
        elif kind == "piecewiseLinear":
            load = [(mpf(d), mpf(k)) for d, k in stop["loading"]]
            back = [(mpf(d), mpf(k)) for d, k in stop["unloading"]] or load
            assert load[0][0] == back[0][0] == 0

            def line(curve, d):     # slope and force at x = 0 of the piece that starts at or before d
                F, (at, k) = mpf(0), curve[0]
                for d1, k1 in curve[1:]:
                    if d1 <= d:
                        F, at, k = F + k * (d1 - at), d1, k1
                return k, F - k * (at + xs)

            for d in sorted({d for d, _ in load + back}):
                up, down = line(load, d), line(back, d)
                assert up[0] * (xs + d) + up[1] >= down[0] * (xs + d) + down[1] - TINY
                add(xs + d, up, down)
        elif kind == "hertz":
            add(xs, (mpf(0), mpf(0)), hertz=(b, q["stiffness"], q["exponent"], q["dissipation"], xs))
        while self.regions[-1]["lo"] >= wall:
            self.regions.pop()
        self.regions[-1]["hi"] = wall
        self.wall, self.free = wall, free
        for z in self.regions:
            z["friction"] = z["up"] != z["down"]

    def law(self):
        """law of the present mode"""
        z = self.regions[self.i]
        if "hertz" in z and self.on:
            return z["hertz"]
        if "fc" in z and not self.on:
            return self.free
        return z["up"] if self.g > 0 else z["down"]

    def acc(self):
        law, f = self.law(), self.push.at(self.w * self.t + self.phase)
        if len(law) == 5:
            b, k, n, lam, xs = law
            return f - b * self.v - self.x - k * (self.x - xs) ** n * max(0, 1 + lam * self.v)
        return f - law[0] * self.v - law[1] * self.x - law[2]

    def static(self, i, g):
        """force of the law of region i at the present place, velocity 0 with sign g"""
        z = self.regions[i]
        if "hertz" in z:
            return z["hertz"][1] * (self.x - z["lo"]) ** z["hertz"][2]
        law = z["up"] if g > 0 else z["down"]
        return (law[1] - 1) * self.x + law[2]

    def enter(self, i):
        """into region i with the present x, v"""
        self.i = i
        z = self.regions[i]
        self.on = True
        if "fc" in z:
            k, c, o = z["fc"]
            y = c * self.v + (k * self.x + o if self.x != z["lo"] else 0)
            self.on = y > 0 or y == 0 and self.v >= 0
        if "hertz" in z:
            self.on = 1 + z["hertz"][3] * self.v > 0
        if self.v:
            self.g = 1 if self.v > 0 else -1

    def sides(self):
        """the regions ahead and behind, and the pushes that balance the mass there at rest"""
        z = self.regions[self.i]
        upper = self.i + 1 if self.x == z["hi"] else self.i
        lower = self.i - 1 if self.x == z["lo"] else self.i
        most = inf if upper == len(self.regions) else self.static(upper, 1) + self.x
        return upper, lower, most, self.static(lower, -1) + self.x

    def faint(self):
        """true of a bounce that counts as rest"""
        return abs(self.v) < TINY

    def decide(self, end):
        """at v = 0: which way the mass goes; None and the time at which it does if it is stuck"""
        upper, lower, most, least = self.sides()
        if not self.regions[self.i]["friction"] and upper == lower:
            return 0, self.i, None
        th = self.w * self.t + self.phase
        f = self.push.at(th)
        if f > most:
            return 1, upper, None
        if f < least:
            return -1, lower, None
        out = [(inf, 0, None)]
        for level, g, i in ((most, 1, upper), (least, -1, lower)):
            if self.push.force:
                if abs(level) < inf:
                    out.append((self.push.crossing(th, level, g, end), g, i))
            elif abs(level) < self.push.amplitude:
                out.append(((-g * acos(level / self.push.amplitude) - th) % (2 * pi) / self.w, g, i))
        wait, g, i = min(out, key=lambda o: o[0])
        return g, i, wait

    def run(self, x, v, marks):
        self.x, self.v, self.t = mpf(x), mpf(v), mpf(0)
        marks, end = list(marks), marks[-1]
        samples, impacts, hits, rests, events = [], [], [], [], 0
        M, since = [[1., 0.], [0., 1.]], None
        mulm = lambda A, B: [[A[r][0] * B[0][c] + A[r][1] * B[1][c] for c in (0, 1)] for r in (0, 1)]

        def norm(A):
            t, d = sum(z * z for r in A for z in r) / 2, A[0][0] * A[1][1] - A[0][1] * A[1][0]
            return math.sqrt(t + math.sqrt(max(t * t - d * d, 0.)))

        def growth(A):
            return max([1., norm(mulm(A, M))] + ([norm(mulm(A, since))] if since else []))

        def jump(S):
            nonlocal M, since
            S = [[float(z) for z in r] for r in S]
            M, since = mulm(S, M), since and mulm(S, since)

        self.g = 1
        at = [j for j, z in enumerate(self.regions) if z["lo"] <= self.x < z["hi"]] or [len(self.regions) - 1]
        i = at[0]
        if self.x == self.regions[i]["lo"] and self.v < 0:
            i -= 1
        assert self.x <= self.wall
        self.enter(i)
        surface, before, halted = None, None, False
        while self.t < end:
            still = False
            if not self.v:
                g, i, wait = self.decide(end - self.t)
                if wait is not None:
                    to = self.t + wait
                    rests.append((self.t, to, self.x))
                    M = [[0., 0.], [0., 0.]] if self.x == self.wall else [M[0], [0., 0.]]
                    since = [[1., 0.], [0., 1.]]
                    while len(samples) < len(marks) and marks[len(samples)] <= to:
                        samples.append((self.x, mpf(0), growth([[1., 0.], [0., 1.]])))
                    if to >= end:
                        break
                    self.t, still, halted = to, True, False
                if g:
                    self.g = g
                self.enter(i)
                if halted:
                    jump([[1, 0], [0, self.acc() / before]])
            halted = False
            z = self.regions[self.i]
            lo, hi, th = z["lo"], z["hi"], self.w * self.t + self.phase
            law, arc = self.law(), None
            inside = len(law) == 5
            if inside:
                if self.x == lo:
                    assert not still
                    arc = Touch(law, self.push, th, self.v)
                else:
                    if self.v < 0:
                        arc = leave(law, self.push, th, self.x, self.v)
                    arc = arc or Inside(law, self.push, th, self.x, self.v)
            else:
                arc = Linear(law, self.push, th, self.x, self.v, still, hi)
            s, kind = min(arc.h, end - self.t), None
            if isinstance(arc, Touch):
                if arc.end and s == arc.end:
                    kind = "lo"
                while arc.at(s)[0] >= hi:
                    s, kind = s / 2, None
            else:
                watch = []
                if lo > -inf and not inside:
                    watch.append(("lo", [arc.C[0] - lo] + arc.C[1:]))
                if hi < inf:
                    watch.append(("hi", [hi - arc.C[0]] + [-c for c in arc.C[1:]]))
                if z["friction"]:
                    watch.append(("halt", [self.g * c for c in arc.V]))
                if "fc" in z:
                    k, c, o = z["fc"]
                    y = [k * p + c * q for p, q in zip(arc.C, arc.V)]
                    y[0] = mpf(0) if surface == "switch" else y[0] + o
                    if self.x == lo:
                        y[0] = c * self.v
                    watch.append(("switch", y if self.on else [-p for p in y]))
                if "hertz" in z and z["hertz"][3]:
                    y = [z["hertz"][3] * q for q in arc.V]
                    y[0] = mpf(0) if surface == "switch" else y[0] + 1
                    watch.append(("switch", y if self.on else [-p for p in y]))
                for name, G in watch:
                    n = first_root(G, s)
                    if n is not None:
                        s, kind = n, name
            while len(samples) < len(marks) and (marks[len(samples)] < self.t + s or
                                                 marks[len(samples)] == self.t + s and not kind):
                p = marks[len(samples)] - self.t
                samples.append((*arc.at(p), growth(arc.matrix(p))))
            jump(arc.matrix(s))
            self.x, self.v = arc.at(s)
            self.t += s
            surface = kind
            if not kind:
                continue
            events += 1
            before = None
            if kind == "lo":
                self.x = lo
                if isinstance(arc, Touch):
                    self.v = -arc.Y / arc.T
                before = self.acc()
            elif kind == "hi":
                self.x = hi
                before = self.acc()
            elif kind == "halt":
                self.v = mpf(0)
                before, halted = self.acc(), True
            if kind in ("lo", "hi") and self.x != self.wall:
                assert (self.v > 0) == (kind == "hi"), (kind, self.v)
                if self.x == self.r and kind == "hi":
                    impacts.append((self.t, self.v))
                if self.faint():
                    self.v = mpf(0)
                else:
                    self.enter(self.i + (1 if kind == "hi" else -1))
                    jump([[1, 0], [(self.acc() - before) / self.v, 1]])
            elif kind == "hi":
                u = self.v
                assert u > 0
                if u > self.slowest:
                    (impacts if self.wall == self.r else hits).append((self.t, u))
                self.v = -self.R * u
                self.g = -1
                if self.faint():
                    self.v = mpf(0)
                self.enter(self.i)
                jump([[-self.R, 0], [(self.acc() + self.R * before) / u, -self.R]])
            elif kind == "switch":
                self.on = not self.on
        return samples, impacts, hits, rests, events


def text(z):
    if z == inf:
        return None
    return "0.0" if abs(z) < mpf(10) ** -40 else nstr(z, DIGITS, strip_zeros=False)


# ---------------------------------------------------------------- the cases
def kv(k, release="clearance"):
    return dict(model="kelvinVoigt", stiffness=float(k), release=release)


def pre(k, preload):
    return dict(model="preloaded", stiffness=float(k), preload=float(preload))


def pwl(loading, unloading=()):
    return dict(model="piecewiseLinear", loading=[[float(a), float(b)] for a, b in loading],
                unloading=[[float(a), float(b)] for a, b in unloading])


def hertz(k, n, lam=0.0):
    return dict(model="hertz", stiffness=float(k), exponent=float(n), dissipation=float(lam))


def rigid(R):
    return dict(model="rigid", restitution=float(R))


def wall(e, R):
    return dict(travel=float(e), restitution=float(R))


def strip(k2, k3, s, v):
    return dict(stiffness=float(k2), friction=float(k3), thickness=float(s), travel=float(v))


PETERKA = strip(21, 23, 0.4, 0.5)
Z = "zeroForce"
# name, frequency, damping, contact damping, clearance, stop, start, periods, sample every, more
FAMILIES = {
    "stiff": [
        ("stiff", 1.15, .04, 180., 10., pre(1e6, 0), (6.9, 9.5), 200, 10, {}),
        ("stiff, little contact damping", 1.15, .04, .18, 10., pre(1e6, 0), (6.9, 9.5), 200, 10, {}),
    ],
    "rigid": [
        ("rigid zeno A", .3, .04, .04, 0., rigid(.6), (-1., 0.), 5.5, .25, {}),
        ("rigid zeno B", .3, .04, .04, 0., rigid(.6), (-.5, .3), 5.5, .25, {}),
        ("rigid R 0", .3, .04, .04, 0., rigid(0), (-1., 0.), 5.5, .25, {}),
        ("rigid R 0 fast", 2.7, .04, .04, .5, rigid(0), (-1., 1.), 12, .5, {}),
        ("rigid R 0.9", .3, .04, .04, 0., rigid(.9), (-1., 0.), 4, .25, {}),
        ("rigid R 1", .3, .04, .04, 0., rigid(1), (-1., 0.), 3, .25, {}),
        ("rigid R 1 fast", 2.7, .04, .04, -.3, rigid(1), (-1., 0.), 8, .5, {}),
        ("rigid pressed", .3, .04, .04, -.3, rigid(.6), (-1., .5), 4, .25, {}),
        ("rigid clearance 0.5", .3, .04, .04, .5, rigid(.6), (-1., 0.), 5, .25, {}),
        ("rigid very slow", .15, .04, .04, 0., rigid(.6), (-1., 0.), 3, .25, {}),
        ("rigid fast", 2.7, .04, .04, 0., rigid(.6), (-1., 0.), 20, 1, {}),
        ("rigid fast, pressed", 2.7, .04, .04, -.3, rigid(.6), (-1., 0.), 20, 1, {}),
        ("rigid R 0.3 slow", .2, .04, .04, 0., rigid(.3), (-1., 0.), 4, .25, {}),
        ("rigid R 0.3 pressed, phase", .2, .1, .1, -.3, rigid(.3), (-.8, .1), 3, .25, dict(phase=2.)),
        ("rigid always pressed", .7, .04, .04, -1.5, rigid(.6), (-3., 0.), 4, .25, {}),
        ("rigid far", 1.15, .04, .04, 10., rigid(.6), (6.9, 9.5), 30, 1, {}),
        ("rigid, start on the stop", .5, .04, .04, 0., rigid(.6), (0., 0.), 3, .25, {}),
        ("rigid, start on the stop, phase", .5, .04, .04, 0., rigid(.6), (0., 0.), 3, .25, dict(phase=2.)),
        ("rigid with strip", 1.15, .04, .18, 10., rigid(.6), (0., 14.), 20, 1, dict(strip=PETERKA)),
        ("rigid with strip, leaning", .4, .04, .18, -.4, rigid(.6), (-2., 0.), 4, .25,
         dict(strip=strip(2, 1, .1, .1))),
        ("rigid with strip, weak friction", .4, .04, .18, -.3, rigid(.8), (-1., 1.), 4, .25,
         dict(strip=strip(1, .2, .05, .2))),
    ],
    "kelvinVoigt": [
        ("kv soft", 1.15, .04, .5, 10., kv(5), (6.9, 9.5), 20, 1, {}),
        ("kv soft zeroForce", 1.15, .04, .5, 10., kv(5, Z), (6.9, 9.5), 20, 1, {}),
        ("kv 100 near", .8, .04, 3., .5, kv(100), (-1., 0.), 20, 1, {}),
        ("kv 100 near zeroForce", .8, .04, 3., .5, kv(100, Z), (-1., 0.), 20, 1, {}),
        ("kv 1e4", 1.15, .04, 3., 10., kv(1e4), (0., 14.), 15, 1, {}),
        ("kv 1e4 zeroForce", 1.15, .04, 3., 10., kv(1e4, Z), (0., 14.), 15, 1, {}),
        ("kv overdamped", .9, .04, 300., 10., kv(100), (0., 14.), 8, .5, {}),
        ("kv overdamped zeroForce", .9, .04, 300., 10., kv(100, Z), (0., 14.), 8, .5, {}),
        ("kv overdamped at 0", .7, .04, 300., 0., kv(100, Z), (-1., .5), 4, .25, {}),
        ("kv overdamped pressed", .7, .04, 300., -.4, kv(100), (-1., .5), 3, .25, {}),
        ("kv 5 at 0", .6, .04, .5, 0., kv(5), (-1., 0.), 12, .5, {}),
        ("kv 5 at 0 zeroForce", .6, .04, .5, 0., kv(5, Z), (-1., 0.), 12, .5, {}),
        ("kv pressed", .5, .04, 3., -.4, kv(100), (-2., 0.), 8, .25, {}),
        ("kv pressed zeroForce", .5, .04, 3., -.4, kv(100, Z), (-2., 0.), 8, .25, {}),
        ("kv 1e4 pressed zeroForce", .5, .04, 20., -.4, kv(1e4, Z), (-2., 0.), 3, .25, {}),
        ("kv damped less than free zeroForce", 1.1, .5, .1, .5, kv(100, Z), (-1., 2.), 10, .5, {}),
        ("kv damped less than free pressed zeroForce", .6, 1., .1, -.4, kv(5, Z), (-2., 0.), 6, .25, {}),
        ("kv equal damping zeroForce", .6, .1, .1, -.4, kv(5, Z), (-2., 0.), 8, .5, {}),
        ("kv start inside zeroForce", .8, .04, 3., .5, kv(100, Z), (.6, -5.), 8, .5, dict(phase=1.)),
        ("kv start on the surface", .8, .04, 3., 0., kv(100, Z), (0., 0.), 8, .5, {}),
        ("kv with strip", 1.15, .04, .5, 10., kv(100), (0., 14.), 15, 1, dict(strip=PETERKA)),
    ],
    "piecewiseLinear": [
        ("two slopes", 1.15, .04, .18, 10., pwl([(0, 5), (.5, 50)]), (0., 14.), 20, 1, {}),
        ("three slopes", .8, .04, .18, .5, pwl([(0, 5), (.1, 50), (.3, 8)]), (-1., 0.), 12, .5, {}),
        ("five slopes", .6, .04, .5, -.4, pwl([(0, 1), (.05, 3), (.1, 10), (.2, 0), (.4, 40)]), (-3., 0.),
         8, .25, {}),
        ("two slopes, starting flat", .9, .04, .18, 0., pwl([(0, 0), (.3, 100)]), (-1., 0.), 8, .5, {}),
        ("loop, far", 1.15, .04, .18, 10., pwl([(0, 7), (.5, 30)], [(0, 3), (.8, 20)]), (0., 14.), 20, 1, {}),
        ("loop, sticks", .2, .04, .18, -.3, pwl([(0, 10), (.1, 30)], [(0, 4), (.1, 20)]), (-1., 0.), 4, .25, {}),
        ("loop, sticks at 0", .3, .04, .18, 0., pwl([(0, 3)], [(0, 1)]), (-1., 0.), 5, .25, {}),
        ("loop, sticks, wide", .3, .04, 1., .2, pwl([(0, 20), (.2, 5), (.4, 60)], [(0, 0), (.1, 6)]), (-2., 1.),
         4, .25, {}),
        ("loop, pressed for ever", .6, .04, .18, -1.5, pwl([(0, 3), (.5, 9)], [(0, 1), (.4, 5)]), (-2., 0.),
         5, .25, {}),
        ("loop with flat unloading", .25, .04, .3, -.2, pwl([(0, 5), (.2, 1)], [(0, 0)]), (-1., .5), 4, .25, {}),
        ("loop, stuck for ever", .6, .04, .5, -4., pwl([(0, 20)], [(0, 1)]), (-5., 0.), 4, .25, {}),
        ("loop, start at rest inside", .4, .04, .18, -.2, pwl([(0, 10)], [(0, 1)]), (.0, 0.), 4, .25, {}),
        ("loop, wall behind", .4, .04, .18, -.3, pwl([(0, 3), (.1, 6)], [(0, 1)]), (-2., 0.), 4, .25,
         dict(rigid=wall(.15, .5))),
        ("loop with strip", 1.1, .04, .18, 2., pwl([(0, 30), (.2, 90)], [(0, 12)]), (0., 9.), 12, .5,
         dict(strip=PETERKA)),
    ],
    "preloaded": [
        ("preloaded", 1.15, .04, .18, 10., pre(7, 70), (0., 14.), 30, 1, {}),
        ("wall behind", 1.15, .04, .18, 10., pre(7, 70), (0., 14.), 30, 1, dict(rigid=wall(.1, .6))),
        ("wall behind, strip", 1.15, .04, .18, 10., pre(7, 70), (0., 14.), 25, 1,
         dict(rigid=wall(.1, .6), strip=PETERKA)),
        ("wall behind, strip, fast start", 1.2, .04, .18, 5., pre(7, 20), (0., 14.), 25, 1,
         dict(rigid=wall(.1, .6), strip=PETERKA)),
        ("wall behind a gap", 1.15, .04, .18, 10., pre(0, 0), (0., 14.), 20, 1, dict(rigid=wall(.1, .6))),
        ("wall behind a gap, pressed", .3, .04, .5, -.3, pre(0, 0), (-1., 0.), 4, .25, dict(rigid=wall(.1, .6))),
        ("wall behind a weak preload, pressed", .3, .04, .5, -.3, pre(1, .2), (-1., 0.), 4, .25,
         dict(rigid=wall(.1, .6))),
        ("wall behind a damped layer, pressed, zeroForce", .4, .04, .5, -.5, kv(2, Z), (-1., 0.), 4, .25,
         dict(rigid=wall(.1, .4))),
        ("wall with R 0 behind", .5, .04, .5, -.2, pre(2, .1), (-1., 0.), 4, .25, dict(rigid=wall(.05, 0))),
        ("preload, pressed", .4, .04, 1., -.3, pre(10, 2), (-1., 0.), 1.5, .25, {}),
        ("preload, start at rest on the stop", .4, .04, 1., -.3, pre(10, 2), (-.3, 0.), 1, .25, {}),
        ("strip, leaning on the preloaded stop", .5, .04, .18, -.3, pre(7, 70), (0., 3.), 5, .25,
         dict(strip=strip(21, 23, .05, .25))),
        ("strip, leaning, weak", .3, .04, .18, -.5, pre(3, 5), (-1., 0.), 4, .25,
         dict(strip=strip(2, 1.5, .1, .05))),
        ("strip, sticking", .25, .04, .18, 0., pre(7, 70), (-1., 0.), 4, .25, dict(strip=strip(6, 4, .3, .2))),
        ("preload 0", 1.15, .04, .18, 2., pre(7, 0), (0., 9.), 20, 1, {}),
        ("preload 0, critical damping of the contact", 1.15, .04, 4., 2., pre(3, 0), (0., 9.), 12, 1, {}),
        ("stiffness 0", 1.15, .04, .18, 5., pre(0, 20), (0., 9.), 20, 1, {}),
        ("no force at all", 1.15, .04, .5, 5., pre(0, 0), (0., 9.), 20, 1, {}),
        ("strip without friction", 1.15, .04, .18, 5., pre(7, 70), (0., 14.), 15, 1,
         dict(strip=strip(21, 0, .4, .5))),
        ("strip without friction, slow", .3, .04, .18, -.2, pre(7, 1), (-1., 0.), 4, .25,
         dict(strip=strip(2, 0, .2, .3))),
        ("strip without stiffness or travel", 1.15, .04, .18, 5., pre(7, 0), (0., 14.), 15, 1,
         dict(strip=strip(0, 3, .4, 0))),
    ],
    "hertz": [
        ("hertz 50", 1.15, .04, .04, 10., hertz(50, 1.5), (6.9, 9.5), 10, 1, {}),
        ("hertz 50, damped", 1.15, .04, .5, 10., hertz(50, 1.5), (0., 14.), 10, 1, {}),
        ("hertz 1", 1.15, .04, .18, 10., hertz(1, 1.5), (0., 14.), 10, 1, {}),
        ("hertz 1e4", 1.15, .04, .04, 10., hertz(1e4, 1.5), (6.9, 9.5), 10, 1, {}),
        ("hertz 1e8", 1.15, .04, .04, 10., hertz(1e8, 1.5), (6.9, 9.5), 10, 1, {}),
        ("hertz 1e8 dissipation", 1.15, .04, .04, 10., hertz(1e8, 1.5, .1), (6.9, 9.5), 10, 1, {}),
        ("hertz dissipation 0.1", 1.15, .04, .04, 10., hertz(1e4, 1.5, .1), (0., 14.), 10, 1, {}),
        ("hertz dissipation 0.5", 1.15, .04, .18, 10., hertz(50, 1.5, .5), (0., 14.), 10, 1, {}),
        ("hertz dissipation 2", 1.15, .04, .04, 10., hertz(1e4, 1.5, 2), (0., 14.), 10, 1, {}),
        ("hertz dissipation 2 soft", 1.15, .04, .18, 10., hertz(1, 1.5, 2), (0., 14.), 10, 1, {}),
        ("hertz n 1.2", 1.15, .04, .04, 10., hertz(50, 1.2), (0., 14.), 10, 1, {}),
        ("hertz n 1.2 dissipation", .8, .04, .18, 0., hertz(50, 1.2, .5), (-1., 0.), 10, .5, {}),
        ("hertz n 2", 1.15, .04, .04, 10., hertz(1e4, 2), (0., 14.), 10, 1, {}),
        ("hertz n 2.5", 1.15, .04, .04, 10., hertz(1e4, 2.5, .1), (0., 14.), 10, 1, {}),
        ("hertz n 3", .8, .04, .18, 0., hertz(50, 3), (-1., 0.), 10, .5, {}),
        ("hertz at 0", .8, .04, .04, 0., hertz(50, 1.5), (-1., 0.), 10, .5, {}),
        ("hertz at 0, damped", .6, .04, 3., 0., hertz(1e4, 1.5), (-1., 0.), 10, .5, {}),
        ("hertz pressed", .6, .04, .5, -.5, hertz(50, 1.5), (-1., 0.), 10, .5, {}),
        ("hertz pressed, n 2.5 dissipation", .6, .04, .5, -.5, hertz(50, 2.5, .5), (-1., 0.), 10, .5, {}),
        ("hertz pressed, n 1.2 dissipation 2", .6, .04, .5, -.5, hertz(1, 1.2, 2), (-1., 0.), 10, .5, {}),
        ("hertz start on the surface", .8, .04, .04, 0., hertz(50, 1.5), (0., 0.), 10, .5, {}),
        ("hertz start on the surface, n 1.2 dissipation", .8, .04, .5, 0., hertz(1e4, 1.2, .5), (0., 0.),
         10, .5, {}),
        ("hertz start on the surface, n 3", .8, .04, .18, 0., hertz(1, 3, .1), (0., 0.), 10, .5, {}),
        ("hertz start inside, fast out", .8, .04, .18, .5, hertz(50, 1.5, .5), (.7, -6.), 10, .5, {}),
        ("hertz, wall behind", 1.15, .04, .18, 10., hertz(50, 1.5), (0., 14.), 10, 1,
         dict(rigid=wall(.1, .6))),
        ("hertz with strip", 1.15, .04, .18, 5., hertz(1e4, 1.5, .1), (0., 14.), 10, 1, dict(strip=PETERKA)),
    ],
}


def drawn(count):
    """random machines with linear laws around the paper's"""
    draw = random.Random(2003)
    between, cases = draw.uniform, []
    for index in range(count):
        name, stop, more = f"random {index}", pre(7, 70), dict(phase=float(index))
        w, r, k = between(.5, 2), between(.2, 8), 10 ** between(.5, 4)
        kind = draw.choice(["unloaded", "loaded", "other"])
        if kind == "loaded":
            more["strip"] = PETERKA
        elif kind == "other":
            stop = draw.choice([rigid(between(.2, .95)), kv(k), kv(k, Z), pre(k, between(0, 100)),
                                pwl([(0, k), (.3, 2 * k)], [(0, k / 2)])])
        far = r if stop["model"] == "rigid" else math.inf
        if far > r and draw.random() < .1:
            more["rigid"] = wall(between(.1, 2), between(.2, .95))
            far = r + more["rigid"]["travel"]
        start = between(-12, min(12, far)), between(-15, 15)
        cases.append((name, w, .04 * (1 + index % 7), .18, r, stop, start, 4, 1, more))
    return cases


FAMILIES["random"] = drawn(80)
PATH = os.path.join(os.path.dirname(os.path.abspath(__file__)), "stops.json")


def case(family, name, w, b1, b, r, stop, start, periods, every, more):
    begin = time.time()
    scene = dict(frequency=w, damping=b1, contact_damping=b, clearance=r, stop=stop,
                 rigid=None, strip=None, phase=0.0)
    scene.update(more)
    friction = stop["model"] != "hertz" and (scene["strip"] or stop.get("unloading"))
    mp.dps = 2 * BASE if friction else BASE
    T = 2 * pi / mpf(w)
    marks = [every * k for k in range(1, int(round(periods / every)) + 1)]
    samples, impacts, hits, rests, events = Scene(**scene).run(*start, [T * m for m in marks])
    print(f"{family}: {name}: {len(impacts)} impacts, {len(hits)} on the wall, {len(rests)} rests, "
          f"{events} events, growth {max(s[2] for s in samples):.2g}, {time.time() - begin:.1f} s", flush=True)
    blow = lambda L: [dict(time=text(t), periods=text(t / T), velocity=text(u)) for t, u in L[:40]]
    return dict(
        family=family, name=name, scene=scene, position=start[0], velocity=start[1],
        samples=[dict(periods=m, time=text(T * m), position=text(x), velocity=text(v), growth=float(f"{g:.4g}"))
                 for m, (x, v, g) in zip(marks, samples)],
        impacts=blow(impacts), wall=blow(hits),
        rests=[{"from": text(a), "to": text(b), "position": text(x)} for a, b, x in rests])


def compare(old, new):
    """largest difference of the numbers in two cases, divided by the growth where there is one"""
    worst = mpf(0)
    for key in ("samples", "impacts", "wall", "rests"):
        assert len(old[key]) == len(new[key]), key
        for a, b in zip(old[key], new[key]):
            for k in a:
                if isinstance(a[k], str):
                    x, y = mpf(a[k]), mpf(b[k])
                    worst = max(worst, abs(x - y) / max(1, abs(x)))
                elif k != "growth":
                    assert a[k] == b[k], k
    return worst


def check():
    """one Hertz impact without drive and damping against quadrature of the energy integral:
    v^2 = u^2 - 2 (xs d + d^2 / 2 + k d^(n+1) / (n+1)), T = 2 int dd / v, d = top (1 - z^2)"""
    from mpmath import quad, findroot
    global cos, sin
    keep = cos, sin
    cos = sin = lambda z: mpf(0)
    for n, k, xs in ((1.5, 50., 10.), (1.2, 1e4, .5), (3., 1., -.5), (1.5, 1e8, 10.), (2.5, 50., 0.)):
        n, k, xs, u = mpf(n), mpf(k), mpf(xs), mpf(4)
        s = Scene(1e-9, 0., 0., float(xs), hertz(float(k), float(n)))
        s.x, s.v, s.t, s.g = xs, u, mpf(0), 1
        E = lambda d: xs * d + d * d / 2 + k * d ** (n + 1) / (n + 1)
        law, out, steps = s.regions[1]["hertz"], None, 0
        x, v, t = xs, u, mpf(0)
        while True:
            arc = Touch(law, s.push, 0, u) if x == xs else (leave(law, s.push, 0, x, v) if v < 0 else None) \
                or Inside(law, s.push, 0, x, v)
            steps += 1
            t += arc.h
            if arc.end:
                v = -arc.Y / arc.T
                break
            x, v = arc.at(arc.h)
        top = findroot(lambda d: E(d) - u * u / 2, (u * u / 2 * (n + 1) / k) ** (1 / (n + 1)) if xs >= 0 else 2)

        def slow(z):
            with mp.workdps(4 * BASE):      # E cancels towards the turn
                return 4 * top * z / sqrt(2 * (E(top) - E(top * (1 - z * z)))) if z else mpf(0)

        q = quad(slow, [0, .01, .1, .3, .6, .9, 1])
        print(nstr(n, 3), nstr(k, 3), "speed", nstr(v + u, 3), "time", nstr(t, 20), nstr(t - q, 3), steps, "steps")
    cos, sin = keep


def main():
    args = sys.argv[1:]
    if args[:1] == ["check"]:
        return check()
    try:
        with open(PATH) as f:
            cases = json.load(f)["cases"]
    except FileNotFoundError:
        cases = []
    again = args[:1] == ["compare"]
    begin = time.time()
    for family in (args[1:] if again else args) or FAMILIES:
        new = [case(family, *c) for c in FAMILIES[family]]
        if again:
            old = {c["name"]: c for c in cases if c["family"] == family}
            for c in new:
                print(c["name"], nstr(compare(old[c["name"]], c), 3), flush=True)
            continue
        cases = [c for f in FAMILIES for c in (new if f == family else cases) if c["family"] == f]
        with open(PATH, "w") as f:
            json.dump(dict(cases=cases), f, indent=1)
            f.write("\n")
        print(f"{family} written, {time.time() - begin:.0f} s", flush=True)


if __name__ == "__main__":
    main()
