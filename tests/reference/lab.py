"""The references of the laboratory, crates/lab/assets/references.txt, in 67 digits, checked in 48.

One motion in each line: scene, drive periods, stiffness of the stop if it is swept, else 0, position and velocity at the
end, how far the two runs are apart (end, times and velocities of impacts), then time and velocity of each impact. To add
one, append a line with its scene, periods and stiffness.

Run:  python lab.py             computes all motions again and writes them
      python lab.py check [N]   computes every N-th again and fails if one differs
      python lab.py closed      compares one motion with the closed form of its arcs
      python lab.py graze       the constants of crates/lab/tests/grazing.rs
"""
import sys
import tomllib
from pathlib import Path

import stops
from mpmath import exp, findroot, mpc
from stops import cos, mp, mpf, pi, sin, sqrt

DIGITS = 48, 67
TOP = Path(__file__).resolve().parents[2]
FILE = TOP / "crates/lab/assets/references.txt"
# Where the two runs are as near as this their difference is rounding.
CERTAIN = 1e-30


class Scene(stops.Scene):
    """tells all impacts; a bounce shorter than 2^-63 of a drive period is none"""
    slowest = mpf(0)

    def faint(self):
        _, _, most, least = self.sides()
        push = self.push.at(self.w * self.t + self.phase)
        pressed = min(push - least, most - push)
        return pressed >= 0 and abs(self.v) < pressed * 2 * pi / self.w / 2 ** 64


def read(name, stiffness):
    """the machine of a scene and its start"""
    folder, name = name.split("/")
    place = {"precision": "scenes", "failures": "failures"}[folder]
    file = {"periodic": "preloaded"}.get(name, name)
    data = tomllib.loads((TOP / f"docs/{place}/{file}.toml").read_text(encoding="utf-8"))
    assert data["mass"] == data["stiffness"] == 1
    drive, start, strip = data["excitation"], data.get("initial") or data["start"], data.get("piercing")
    x, v = (start.get(key, 0.0) for key in ("position", "velocity"))
    stop = dict(release="clearance") | data["stop"]
    if stiffness:
        stop["stiffness"] = stiffness
    if name == "pressed":
        # At 0.9 of the depth at which the stop carries the suspension's load.
        x += 0.9 * (-data["clearance"] / (1.0 + stiffness))
    machine = dict(
        frequency=drive["frequency"], amplitude=drive["amplitude"], damping=data["damping"],
        contact_damping=data.get("contact_damping") or data.get("contact", {}).get("damping", 0.0),
        clearance=data["clearance"], stop=stop, rigid=data.get("rigid"), strip=strip)
    return machine, (x, v)


def run(machine, start, periods, digits):
    """the state at the end and the impacts"""
    mp.dps = digits
    scene = Scene(**machine)
    samples, impacts, *_ = scene.run(*start, [mpf(periods) * 2 * pi / scene.w])
    return samples[-1][:2], impacts


def line(name, periods, stiffness):
    """a line of the file, as words, and the largest difference of the two runs"""
    machine, start = read(name, stiffness)
    (end, impacts), (best, hits) = (run(machine, start, periods, digits) for digits in DIGITS)
    assert len(impacts) == len(hits), name
    largest = lambda pairs: max((float(abs(a - b)) for a, b in pairs), default=0.0)
    doubt = [largest(zip(end, best))]
    doubt += [largest((a[k], b[k]) for a, b in zip(impacts, hits)) for k in (0, 1)]
    numbers = [periods, stiffness, *best, *doubt, *(number for hit in hits for number in hit)]
    return [name, *(repr(float(number)) for number in numbers)], max(doubt)


def check(every):
    """which of the lines are others"""
    differ = []
    for words in [it.split() for it in FILE.read_text().splitlines()][::every]:
        found, doubt = line(words[0], *map(float, words[1:3]))
        numbers = lambda words: [float(it) for it in words[1:5] + words[8:]]
        if doubt > CERTAIN or numbers(found) != numbers(words):
            differ.append(words[:3])
        print(*words[:3], f"{doubt:.1e}", differ[-1:] == [words[:3]] and "DIFFERS" or "", flush=True)
    return differ


def graze():
    """the image of a state whose motion all but grazes the stop, and its Jacobian by differences"""
    machine, _ = read("precision/periodic", 0.0)
    machine["frequency"], state = 0.9526610864687346, (9.245388870997623, 3.6304389245854143)
    width = mpf(2) ** -40

    def image(dx, dv):
        return run(machine, (state[0] + dx, state[1] + dv), 1.0, DIGITS[1])[0]

    columns = [[(a - b) / (2 * width) for a, b in zip(image(*step), image(*(-it for it in step)))]
               for step in ((width, 0), (0, width))]
    print(*map(float, image(0, 0)), [float(it) for row in zip(*columns) for it in row])


def motion(damping, stiffness, force, w, time, state):
    """x'' + damping x' + stiffness x = cos(w t) + force from a state on: position and velocity, in closed form"""
    answer = 1 / mpc(stiffness - w * w, damping * w)

    def forced(t):
        turning = answer * exp(mpc(0, w * t))
        return turning.real + force / stiffness, (mpc(0, w) * turning).real

    decay, own = damping / 2, sqrt(stiffness - damping**2 / 4)
    x, v = (mpf(it) - of for it, of in zip(state, forced(time), strict=True))
    beside = (v + decay * x) / own

    def at(t):
        c, s, shrunk = cos(own * (t - time)), sin(own * (t - time)), exp(-decay * (t - time))
        free = shrunk * (x * c + beside * s)
        rate = shrunk * own * (beside * c - x * s) - decay * free
        position, velocity = forced(t)
        return position + free, velocity + rate

    return at


def closed():
    """how far flight up to the stop, and contact with it, are from the formulas of their linear laws"""
    machine, start = read("precision/periodic", 0.0)
    assert machine["amplitude"] == 1 and machine["stop"]["model"] == "preloaded"
    mp.dps = DIGITS[1]
    w, clearance, stop = mpf(machine["frequency"]), mpf(machine["clearance"]), machine["stop"]
    stiffness, preload = mpf(stop["stiffness"]), mpf(stop["preload"])
    flight = motion(mpf(machine["damping"]), mpf(1), mpf(0), w, mpf(0), start)
    rough = next(mpf(n) / 1000 for n in range(10000) if flight(mpf(n) / 1000)[0] > clearance)
    impact = findroot(lambda t: flight(t)[0] - clearance, rough)
    damping, force = mpf(machine["contact_damping"]), stiffness * clearance - preload
    contact = motion(damping, 1 + stiffness, force, w, impact, flight(impact))
    end = impact + mpf("0.125")
    found, impacts = run(machine, start, end * w / (2 * pi), DIGITS[1])
    assert len(impacts) == 1
    pairs = zip([*found, *impacts[0]], [*contact(end), impact, flight(impact)[1]])
    return max(float(abs(a - b)) for a, b in pairs)


def main():
    args = sys.argv[1:]
    if args[:1] == ["check"]:
        sys.exit(bool(check(int((args[1:] or ["1"])[0]))))
    if args[:1] == ["closed"]:
        apart = closed()
        print(f"{apart:.1e}")
        sys.exit(apart > 1e-40)
    if args[:1] == ["graze"]:
        return graze()
    tasks = [it.split()[:3] for it in FILE.read_text().splitlines()]
    lines = [line(name, float(periods), float(stiffness))[0] for name, periods, stiffness in tasks]
    FILE.write_text("".join(" ".join(words) + "\n" for words in lines))


if __name__ == "__main__":
    main()
