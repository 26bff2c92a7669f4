"""Proves a certificate of `softstop prove` again, from the equations of motion alone.

    python examples/check_certificate.py proof.json

Needs mpmath, whose interval arithmetic (iv) rounds outwards, here to 120 bits. Shares no code with softstop. Exits with 1 if
anything that is claimed is not proven. docs/proof.md says what is proven, and what is assumed.
"""

import json
import sys

from mpmath import iv, mp

iv.prec = mp.prec = 120
ZERO, ONE, TURN = iv.mpf(0), iv.mpf(1), 2 * iv.pi


class Dual:
    """A number with its derivatives; the parts are intervals, or themselves such numbers."""

    def __init__(self, value, slopes):
        self.value, self.slopes = value, slopes

    def chain(self, value, slope):
        return Dual(value, [it * slope for it in self.slopes])

    def __add__(self, other):
        if not isinstance(other, Dual):
            return Dual(self.value + other, self.slopes)
        return Dual(self.value + other.value, [a + b for a, b in zip(self.slopes, other.slopes)])

    def __mul__(self, other):
        if not isinstance(other, Dual):
            return self.chain(self.value * other, other)
        slopes = [a * other.value + self.value * b for a, b in zip(self.slopes, other.slopes)]
        return Dual(self.value * other.value, slopes)

    def __sub__(self, other):
        return self + other * -ONE


def inverse(x):
    value = inverse(x.value) if isinstance(x, Dual) else ONE / x
    return x.chain(value, value * value * -ONE) if isinstance(x, Dual) else value


def free(a, b, t):
    """exp(-a t) cos(w t), exp(-a t) sin(w t)/w with w^2 = b - a^2, for x'' + 2 a x' + b x = 0; cos t, sin t for a, b = 0, 1."""
    square = b - a * a
    if isinstance(t, Dual):
        u, s = free(a, b, t.value)
        return t.chain(u, (u * a + s * square) * -ONE), t.chain(s, u - s * a)
    w = iv.sqrt(square if square.a > 0 else -square)
    if square.a > 0:
        return iv.exp(-a * t) * iv.cos(w * t), iv.exp(-a * t) * iv.sin(w * t) / w
    slow, fast = iv.exp(-b / (a + w) * t), iv.exp(-(a + w) * t)
    return (slow + fast) / 2, (slow - fast) / (2 * w)


class Motion:
    """Events, each with drive angle, position and velocity; after each an arc of a phase, which ends as a guard rises to zero."""

    def __init__(self, claimed):
        self.claim, self.periods, self.pinned, self.events = map(claimed.get, ("claim", "periods", "pinned", "events"))
        self.mass, self.amplitude, self.phases = map(claimed["laws"].get, ("mass", "amplitude", "phases"))
        self.frequency, self.count = iv.mpf(claimed["frequency"]), len(self.events)

    def event(self, index):
        """What happens, the guard that is zero, and the phase that follows; counted on into the next period."""
        event, last = self.events[index % self.count], self.phases[self.events[(index - 1) % self.count]["phase"]]
        return event["event"], last["guards"][event["guard"]], self.phases[event["phase"]]

    def states(self, index, unknowns):
        """Drive angle, position and velocity before an event, and right after it."""
        (kind, guard, _), (angle, x, v) = self.event(index), unknowns[3 * (index % self.count):][:3]
        angle = angle + TURN * (self.periods * (index // self.count))
        return (angle, x, v), (angle, x, v * guard["factor"] if kind == "crossing" else v)

    def flow(self, law, w, start, angle, elapsed):
        """Position and velocity on an arc."""
        elastic, lossy = w * w * -self.mass + law["stiffness"], w * law["damping"]
        scale = inverse(elastic * elastic + lossy * lossy) * self.amplitude
        p, q, rest = elastic * scale, lossy * scale, ONE * law["force"] / law["stiffness"] if law["force"] != 0 else ZERO
        (c0, s0), (c1, s1) = free(ZERO, ONE, start[0]), free(ZERO, ONE, angle)
        a, b = ONE * law["damping"] / (2 * self.mass), ONE * law["stiffness"] / self.mass
        u, s = free(a, b, elapsed)
        x, v = start[1] - (p * c0 + q * s0 + rest), start[2] - w * (q * c0 - p * s0)
        return p * c1 + q * s1 + rest + u * x + s * (x * a + v), w * (q * c1 - p * s1) + u * v - s * (x * b + v * a)

    def misses(self, unknowns, closing, w):
        """By how much arcs miss the next event (the last one the first of `closing`) and events their guards; then, touches."""
        misses, touches = [], []
        for index in range(self.count):
            (kind, guard, phase), (here, start) = self.event(index), self.states(index, unknowns)
            (angle, x, v), _ = self.states(index + 1, closing if index + 1 == self.count else unknowns)
            ends = self.flow(phase["law"], w, start, angle, (angle - start[0]) * inverse(w))
            zero = here[1] * guard["position"] + here[2] * guard["velocity"] - guard["level"]
            misses += [ends[0] - x, ends[1] - v, {"crossing": zero, "touch": here[2], "section": here[0]}[kind]]
            touches += [zero] if kind == "touch" else []
        return misses, touches

    def equations(self, unknowns):
        """Zero on the motion; at a fold or a flip also on a tangent that a period carries into itself or its opposite."""
        if self.claim in ("orbit", "grazing"):
            w = unknowns[-1] if self.claim == "grazing" else unknowns[0] * ZERO + self.frequency
            return sum(self.misses(unknowns, unknowns, w), [])
        tangent, ends = unknowns[3 * self.count:-1], (ONE, {"fold": ONE, "flip": -ONE}[self.claim])
        start, closing = ([Dual(x, [t * m]) for x, t in zip(unknowns, tangent)] for m in ends)
        found, _ = self.misses(start, closing, Dual(unknowns[-1], [unknowns[-1] * ZERO]))
        return [it.value for it in found] + [it.slopes[0] for it in found] + [tangent[self.pinned] - ONE]

    def image(self, box):
        """Krawczyk's operator: if it maps a box into its interior, exactly one zero is in the box."""
        count, middle = range(len(box)), [it.mid for it in box]
        rows = self.equations([Dual(x, [ONE if i == j else ZERO for j in count]) for i, x in enumerate(box)])
        y = iv.matrix(mp.matrix([[mp.mpf(it.mid) for it in row.slopes] for row in rows]) ** -1)
        values, image = self.equations(middle), []
        for i in count:
            defects = [(ONE if i == j else ZERO) - sum(y[i, k] * rows[k].slopes[j] for k in count) for j in count]
            image.append(middle[i] + sum(defects[k] * (box[k] - middle[k]) - y[i, k] * values[k] for k in count))
        require(len(rows) == len(box) and all(a.a < b.a and b.b < a.b for a, b in zip(box, image)), "one motion in the box")
        return image

    def jet(self, law, w, start, since):
        """Position, velocity, acceleration and its derivative at times since the start of an arc, by Taylor about the middle."""
        angle = start[0] + w * since
        (x, v), (cosine, sine) = self.flow(law, w, start, angle, since), free(ZERO, ONE, angle)
        for wide in (since.delta > 0, False):
            acceleration = (law["force"] + self.amplitude * cosine - law["damping"] * v - law["stiffness"] * x) / self.mass
            jerk = (-self.amplitude * w * sine - law["damping"] * acceleration - law["stiffness"] * v) / self.mass
            if wide:
                away, middle = since - since.mid, self.jet(law, w, start, since.mid)
                x = middle[0] + middle[1] * away + acceleration * away ** 2 / 2
                v = middle[1] + middle[2] * away + jerk * away ** 2 / 2
        return x, v, acceleration, jerk

    def check_arc(self, index, unknowns, w):
        """No guard rises through zero on an arc before the one at its end, and this one does; the right phase follows."""
        (begins, zero, phase), (ends, leaves, then) = self.event(index), self.event(index + 1)
        start, parts = self.states(index, unknowns)[1], self.events[index]["division"]
        follows = any(then is self.phases[it] for it in leaves["to"]) if ends == "crossing" else then is phase
        elapsed = (self.states(index + 1, unknowns)[0][0] - start[0]) / w
        whole = elapsed.a > 0 and parts[0] == 0 and elapsed.b <= parts[-1] and all(a < b for a, b in zip(parts, parts[1:]))
        keeps = begins == "section" or zero["velocity"] == 0 or begins == "crossing" and zero["factor"] == 1
        require(follows and whole and keeps, f"arc {index} is divided whole, from a guard at zero, and followed by its phase")
        for since, until in zip(parts, parts[1:]):
            x, v, acceleration, jerk = self.jet(phase["law"], w, start, iv.mpf([since, until]))
            for guard in phase["guards"]:
                (p, q, level), zeros = ([it[name] for name in ("position", "velocity", "level")] for it in (guard, zero))
                value, slope, curvature = p * x + q * v - level, p * v + q * acceleration, p * acceleration + q * jerk
                comes = since == 0 and begins != "section" and [p, q, level] in (zeros, [-it for it in zeros])
                falls = comes and (slope if begins == "crossing" and zero["factor"] != 0 else curvature).b < 0
                rises = until == parts[-1] and guard is leaves and {"crossing": slope.a > 0, "touch": curvature.b < 0}.get(ends)
                require(value.b < 0 or falls or rises, f"nothing else happens on arc {index}")

    def multipliers(self, unknowns, w):
        """Trace, determinant: that of equations whose end is m times the start is a multiple of m^2 - trace m + determinant."""
        start = [Dual(x, [ONE if i == j else ZERO for j in range(len(unknowns))]) for i, x in enumerate(unknowns)]
        ends = ([it.chain(it.value, m * ONE) for it in start] for m in (0, 1, -1))
        a, b, c = (determinant([it.slopes for it in self.misses(start, end, start[0] * ZERO + w)[0]]) for end in ends)
        return (c - b) / (b + c - 2 * a), 2 * a / (b + c - 2 * a)


def determinant(rows):
    """By elimination, with the largest pivot."""
    at = max(range(len(rows)), key=lambda it: abs(rows[it][0].mid))
    (pivot, *line), rest = rows[at], rows[:at] + rows[at + 1:]
    minor = [[b - a / pivot * c for b, c in zip(row, line)] for a, *row in rest]
    return pivot * (-1) ** at * (determinant(minor) if minor else 1)


def require(holds, what):
    return holds or sys.exit(f"not proven: {what}")


def check(claimed):
    """Proves all that is claimed."""
    require(claimed.get("format") == "softstop certificate 1", f"format {claimed.get('format')!r} is unknown")
    motion, boxes = Motion(claimed), [[iv.mpf(it) for it in claimed[name]] for name in ("unique", "enclosure")]
    require(motion.events and all(b in a for a, b in zip(*boxes)), "the motion is the one in the box")
    kinds, guards, _ = zip(*map(motion.event, range(motion.count)))
    require(kinds.count("touch") == (motion.claim == "grazing"), "a grazing touches once, all else never")
    _, image = map(motion.image, boxes)
    unknowns, w = image[:3 * motion.count], motion.frequency if motion.claim == "orbit" else image[-1]
    for index in range(motion.count):
        motion.check_arc(index, unknowns, w)
    require(sum(it["impact"] for it, kind in zip(guards, kinds) if kind == "crossing") == claimed["impacts"], "impacts")
    later = [it - unknowns[0] - TURN * shift for it in unknowns[3::3] for shift in range(1, motion.periods)]
    require(motion.periods == 1 or "section" not in kinds and all(0 not in it for it in later), "no shorter period")
    a, b = motion.multipliers(unknowns, w)
    for name, it in ("frequency", w), ("trace", a), ("determinant", b):
        require(it in iv.mpf(claimed[name]), name)
    edges = 1 - a + b, 1 + a + b, 1 - b
    proven = {"stable": all(it.a > 0 for it in edges), "unstable": any(it.b < 0 for it in edges), "undecided": True}
    require(proven[claimed["stability"]], "stability")
    return f"{motion.claim}, z = {claimed['impacts']}/{motion.periods}, {motion.count} events"


if __name__ == "__main__" and require(len(sys.argv) == 2, "give one certificate"):
    print("proven:", check(json.load(open(sys.argv[1], encoding="utf-8"), parse_float=lambda it: iv.mpf(float(it)))))
