"""Proves a certificate of `softstop prove` again, from the equations of motion alone.

    python examples/check_certificate.py proof.json

Needs mpmath, whose interval arithmetic (iv) rounds outwards at any precision. Shares no code with softstop: from the laws of
the layers it writes the motion from event to event, differentiates it, and proves in 120 bits what the certificate claims.
Exits with 1 if any of it is not proven. docs/proof.md says what is proven, and what is assumed.
"""

import json
import sys

from mpmath import iv, mp

iv.prec = mp.prec = 120
ZERO, ONE, TURN = iv.mpf(0), iv.mpf(1), 2 * iv.pi


def require(holds, what):
    if not holds:
        sys.exit(f"not proven: {what}")


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
    if not isinstance(x, Dual):
        return ONE / x
    value = inverse(x.value)
    return x.chain(value, value * value * -ONE)


def sin_cos(x):
    if not isinstance(x, Dual):
        return iv.sin(x), iv.cos(x)
    sine, cosine = sin_cos(x.value)
    return x.chain(sine, cosine), x.chain(cosine, sine * -ONE)


def free(a, b, t):
    """u = exp(-a t) cos(w t), s = exp(-a t) sin(w t)/w with w^2 = b - a^2, for x'' + 2 a x' + b x = 0."""
    square = b - a * a
    if isinstance(t, Dual):
        u, s = free(a, b, t.value)
        return t.chain(u, (u * a + s * square) * -ONE), t.chain(s, u - s * a)
    w = iv.sqrt(square if square > 0 else -square)
    if square > 0:
        return iv.exp(-a * t) * iv.cos(w * t), iv.exp(-a * t) * iv.sin(w * t) / w
    slow, fast = iv.exp(-b / (a + w) * t), iv.exp(-(a + w) * t)
    return (slow + fast) / 2, (slow - fast) / (2 * w)


class Motion:
    """A motion from event to event: unknowns are drive angle, position and velocity before each. An arc follows, under the law of
    a phase. A phase ends where one of its guards g = p x + q x' - level rises through zero."""

    def __init__(self, claimed):
        self.claim, self.events, self.periods, self.frequency = (claimed[it] for it in ("claim", "events", "periods", "frequency"))
        self.mass, self.amplitude, self.phases = (claimed["laws"][it] for it in ("mass", "amplitude", "phases"))
        self.count, self.pinned = len(self.events), claimed.get("pinned")

    def event(self, index):
        """What happens, the guard that is zero, and the phase that follows; counted on into the next period."""
        event, before = self.events[index % self.count], self.events[(index - 1) % self.count]["phase"]
        return event["event"], self.phases[before]["guards"][event["guard"]], event["phase"]

    def law(self, index):
        law = self.phases[self.event(index)[2]]["law"]
        return law["damping"], law["stiffness"], law["force"]

    def before(self, index, unknowns):
        angle, x, v = unknowns[3 * (index % self.count):][:3]
        return angle + TURN * (self.periods * (index // self.count)), x, v

    def after(self, index, unknowns):
        (kind, guard, _), (angle, x, v) = self.event(index), self.before(index, unknowns)
        return angle, x, v * guard["factor"] if kind == "crossing" else v

    def flow(self, index, w, start, angle, elapsed):
        """Position and velocity on an arc."""
        damping, stiffness, force = self.law(index)
        elastic, lossy = w * w * -self.mass + stiffness, w * damping
        scale = inverse(elastic * elastic + lossy * lossy) * self.amplitude
        p, q, rest = elastic * scale, lossy * scale, ZERO if force == 0 else force / stiffness
        (s0, c0), (s1, c1) = sin_cos(start[0]), sin_cos(angle)
        a, b = damping / (2 * self.mass), stiffness / self.mass
        u, s = free(a, b, elapsed)
        x, v = start[1] - (p * c0 + q * s0 + rest), start[2] - w * (q * c0 - p * s0)
        return p * c1 + q * s1 + rest + u * x + s * (x * a + v), w * (q * c1 - p * s1) + u * v - s * (x * b + v * a)

    def misses(self, unknowns, closing, w):
        """By how much arcs miss the events at their ends (the last one the first event of `closing`) and events their guards."""
        found = []
        for index in range(self.count):
            (kind, guard, _), start = self.event(index), self.after(index, unknowns)
            angle, x, v = self.before(index + 1, closing if index + 1 == self.count else unknowns)
            ends = self.flow(index, w, start, angle, (angle - start[0]) * inverse(w))
            here = self.before(index, unknowns)
            zero = here[1] * guard["position"] + here[2] * guard["velocity"] - guard["level"]
            found += [ends[0] - x, ends[1] - v, here[0] if kind == "section" else zero]
            found += [here[2]] if kind == "touch" else []
        return found

    def equations(self, unknowns):
        """Zero on the motion; at a fold or a flip also on a tangent that a period carries into itself or its opposite."""
        if self.claim in ("orbit", "grazing"):
            w = unknowns[-1] if self.claim == "grazing" else unknowns[0] * ZERO + self.frequency
            return self.misses(unknowns, unknowns, w)
        own, tangent, w = unknowns[:3 * self.count], unknowns[3 * self.count:-1], unknowns[-1]
        signs = ONE, {"fold": ONE, "flip": -ONE}[self.claim]
        start, closing = ([Dual(x, [t * sign]) for x, t in zip(own, tangent)] for sign in signs)
        found = self.misses(start, closing, Dual(w, [w * ZERO]))
        return [it.value for it in found] + [it.slopes[0] for it in found] + [tangent[self.pinned] - ONE]

    def image(self, box):
        """Krawczyk's operator: if it maps a box into its interior, exactly one zero is in the box."""
        count, middle = range(len(box)), [it.mid for it in box]
        rows = self.equations([Dual(x, [ONE if i == j else ZERO for j in count]) for i, x in enumerate(box)])
        y, values, image = mp.matrix([[mp.mpf(it.mid) for it in row.slopes] for row in rows]) ** -1, self.equations(middle), []
        for i in count:
            line = [iv.mpf(y[i, k]) for k in count]
            defects = [(ONE if i == j else ZERO) - sum(line[k] * rows[k].slopes[j] for k in count) for j in count]
            rest = sum(defects[j] * (box[j] - middle[j]) for j in count)
            image.append(middle[i] - sum(line[k] * values[k] for k in count) + rest)
        require(len(rows) == len(box) and all(a.a < b.a and b.b < a.b for a, b in zip(box, image)), "one motion in the box")
        return image

    def jet(self, index, w, start, since):
        """Position, velocity, acceleration and its derivative at times since the start of an arc, by Taylor about the middle."""
        (damping, stiffness, force), angle = self.law(index), start[0] + w * since
        x, v = self.flow(index, w, start, angle, since)
        sine, cosine = sin_cos(angle)

        def rates():
            acceleration = (force + self.amplitude * cosine - damping * v - stiffness * x) / self.mass
            return acceleration, (sine * -w * self.amplitude - damping * acceleration - stiffness * v) / self.mass

        if since.delta > 0:
            away, (acceleration, jerk), middle = since - since.mid, rates(), self.jet(index, w, start, since.mid)
            x = common(x, middle[0] + middle[1] * away + acceleration * away ** 2 / 2)
            v = common(v, middle[1] + middle[2] * away + jerk * away ** 2 / 2)
        return x, v, *rates()

    def check_arc(self, index, unknowns, w):
        """No guard rises through zero on an arc before the one at its end, and this one does; the right phase follows."""
        start, (begins, zero, phase), (ends, leaves, then) = self.after(index, unknowns), self.event(index), self.event(index + 1)
        require(then in leaves["to"] if ends == "crossing" else then == phase, f"arc {index} is followed by its phase")
        parts, elapsed = self.events[index]["division"], (self.before(index + 1, unknowns)[0] - start[0]) / w
        require(elapsed > 0 and parts[0] == 0 and elapsed.b <= parts[-1] and parts == sorted(parts), f"arc {index} is divided whole")
        for since, until in zip(parts, parts[1:]):
            x, v, acceleration, jerk = self.jet(index, w, start, iv.mpf([since, until]))
            for guard in self.phases[phase]["guards"]:
                p, q, level = weights = guard["position"], guard["velocity"], guard["level"]
                value, slope, curvature = p * x + q * v - level, p * v + q * acceleration, p * acceleration + q * jerk
                at_zero = [zero[it] for it in ("position", "velocity", "level")]
                comes = since == 0 and begins != "section" and list(weights) in (at_zero, [-it for it in at_zero])
                goes = until == parts[-1] and ends != "section" and guard is leaves
                falls = comes and (slope < 0 if begins == "crossing" else curvature < 0)
                rises = goes and (slope > 0 if ends == "crossing" else curvature < 0)
                require(value < 0 or falls or rises, f"nothing else happens on arc {index}")

    def multipliers(self, unknowns, w):
        """Trace and determinant of the product of the matrices of arcs and events (saltation)."""
        matrix, determinant = (ONE, ZERO, ZERO, ONE), ONE
        for index in range(self.count):
            start, (angle, x, v), (kind, guard, _) = self.after(index, unknowns), self.before(index + 1, unknowns), self.event(index + 1)
            a, b, elapsed = self.law(index)[0] / (2 * self.mass), self.law(index)[1] / self.mass, (angle - start[0]) / w
            u, s = free(a, b, elapsed)
            matrix, determinant = product((u + a * s, s, -b * s, u - a * s), matrix), iv.exp(-2 * a * elapsed) * determinant
            if kind == "crossing":
                factor, push = guard["factor"], self.amplitude * iv.cos(angle)
                before, after = ((force + push - damping * y - stiffness * x) / self.mass for (damping, stiffness, force), y in
                                 ((self.law(index), v), (self.law(index + 1), v * factor)))
                p, q = (guard[it] / (guard["position"] * v + guard["velocity"] * before) for it in ("position", "velocity"))
                jump, kick = (factor - 1) * v, after - factor * before
                saltation = 1 + jump * p, jump * q, kick * p, factor + kick * q
                matrix = product(saltation, matrix)
                determinant *= saltation[0] * saltation[3] - saltation[1] * saltation[2]
        return matrix[0] + matrix[3], determinant


def product(a, b):
    return a[0] * b[0] + a[1] * b[2], a[0] * b[1] + a[1] * b[3], a[2] * b[0] + a[3] * b[2], a[2] * b[1] + a[3] * b[3]


def common(a, b):
    return iv.mpf([max(a.a, b.a), min(a.b, b.b)])


def check(claimed):
    """Proves all that is claimed."""
    motion, (unique, enclosure) = Motion(claimed), (claimed["unique"], claimed["enclosure"])
    require(all(a in b for a, b in zip(enclosure, unique)), "the motion is the one in the box")
    image = (motion.image(unique), motion.image(enclosure))[1]
    unknowns, w = image[:3 * motion.count], motion.frequency if motion.claim == "orbit" else image[-1]
    require(w in motion.frequency, "frequency")
    for index in range(motion.count):
        motion.check_arc(index, unknowns, w)
    happens = [motion.event(it) for it in range(motion.count)]
    require(sum(kind == "crossing" and guard["impact"] for kind, guard, _ in happens) == claimed["impacts"], "impacts")
    later = [it - unknowns[0] - TURN * shift for it in unknowns[3::3] for shift in range(1, motion.periods)]
    require(all(it > 0 or it < 0 for it in later), "no shorter period")
    trace, determinant = motion.multipliers(unknowns, w)
    require(trace in claimed["trace"] and determinant in claimed["determinant"], "multipliers")
    edges = 1 - trace + determinant, 1 + trace + determinant, 1 - determinant
    stable, unstable = all(it > 0 for it in edges), any(it < 0 for it in edges)
    require({"stable": stable, "unstable": unstable, "undecided": True}[claimed["stability"]], "stability")
    return f"{motion.claim}, z = {claimed['impacts']}/{motion.periods}, {motion.count} events"


def intervals(fields):
    """Pairs of numbers as intervals, and lists of them, but for phases and divisions of arcs."""
    def read(it):
        if not isinstance(it, list):
            return it
        return iv.mpf(it) if len(it) == 2 and all(isinstance(x, (int, float)) for x in it) else [read(x) for x in it]
    return {name: it if name in ("division", "to") else read(it) for name, it in fields.items()}


if __name__ == "__main__":
    for path in sys.argv[1:]:
        with open(path, encoding="utf-8") as file:
            print("proven:", check(json.load(file, object_hook=intervals)))
