"""Reference motions under a polynomial external force, by the integrators of stops.py.

Equation:  x'' + b x' + x + F = cos(w t + phase) + sum of force[k] t^k / k!,  t = 0 at the start
The force is part of the equation's Taylor series; the time at which it lets a held mass go is
bracketed by sampling and bisected. Everything else stands in stops.py.

Run:  python force.py               writes force.json beside this file
      DPS=70 python force.py compare   runs again, other precision, prints differences
"""
import json
import os
import sys

import stops
from stops import PETERKA, Z, hertz, kv, pre, pwl, rigid, strip, wall

stops.PATH = os.path.join(os.path.dirname(os.path.abspath(__file__)), "force.json")
NONE = dict(model="none")
SQUARE = (.4, -.3, .02)
CUBIC = (.1, .2, -.05, .004)
FIFTH = (-.3, .1, .05, -.03, .01, -.0015)
SEVENTH = (.2, -.1, .15, -.02, -.03, .02, -.006, .0008)
STRONG = (0., 3., -40., 300., -900., 2000., -7000., 12000.)


def f(force, **more):
    return dict(force=list(force), **more)


# name, frequency, damping, contact damping, clearance, stop, start, periods, sample every, more
stops.FAMILIES = {
    "free": [
        ("free, degree 2", 1.15, .04, .04, 1e6, NONE, (.3, -.7), 4, .25, f(SQUARE)),
        ("free, degree 3", .7, .3, .3, 1e6, NONE, (.3, -.7), 3, .25, f(CUBIC)),
        ("free, degree 5", 2.1, .04, .04, 1e6, NONE, (0., 0.), 4, .25, f(FIFTH)),
        ("free, degree 7", 1.15, .04, .04, 1e6, NONE, (0., 0.), 2, .125, f(SEVENTH, phase=.4)),
        ("free, heavily damped, degree 7", 1.15, 30., 30., 1e6, NONE, (.3, -.7), 2, .25, f(SEVENTH)),
        ("free, strong and fast", 1.15, .04, .04, 1e6, NONE, (.3, -.7), .25, .03125, f(STRONG)),
        ("free, the highest order alone", 1.15, .04, .04, 1e6, NONE, (0., 0.), 1, .125,
         f([0.] * 7 + [1.])),
    ],
    "linear": [
        ("kv, degree 2", .8, .04, 3., .5, kv(100), (-1., 0.), 5, .25, f(SQUARE)),
        ("kv, degree 3", .8, .04, 3., .5, kv(100), (-1., 0.), 4, .25, f(CUBIC)),
        ("kv zeroForce, degree 5", .8, .04, 3., .2, kv(100, Z), (-1., 0.), 2, .25, f(FIFTH)),
        ("kv, degree 7", 1.15, .04, .5, .5, kv(5), (-1., 1.), 2, .125, f(SEVENTH)),
        ("kv overdamped, degree 3", .9, .04, 300., .5, kv(100), (0., 3.), 2, .25, f(CUBIC)),
        ("preloaded, strong and fast", 1.15, .04, .18, .5, pre(7, 7), (.3, -.7), .25, .03125, f(STRONG)),
        ("two slopes, degree 5", .8, .04, .18, .3, pwl([(0, 5), (.1, 50)]), (-1., 0.), 2, .25, f(FIFTH)),
        ("wall behind, degree 3", 1.15, .04, .18, 1., pre(7, .5), (0., 3.), 4, .25,
         f(CUBIC, rigid=wall(.1, .6))),
    ],
    "hertz": [
        ("hertz, degree 2", .8, .04, .04, .3, hertz(50, 1.5), (-1., 0.), 4, .25, f(SQUARE)),
        ("hertz, degree 3", .6, .04, .5, -.5, hertz(50, 1.5, .1), (-1., 0.), 3, .25, f(CUBIC)),
        ("hertz, degree 5", .8, .04, .18, 0., hertz(50, 2.5), (-1., 0.), 2, .25, f(FIFTH)),
        ("hertz, degree 7", 1.15, .04, .04, .5, hertz(1e4, 1.5), (-1., 1.), 2, .125, f(SEVENTH)),
        ("hertz n 1.2, degree 7", 1.15, .04, .18, .5, hertz(50, 1.2, .5), (-1., 1.), 2, .125, f(SEVENTH)),
        ("hertz from rest at the face, degree 3", .8, .04, .04, 0., hertz(50, 1.5), (0., 0.), 3, .25,
         f(CUBIC)),
        ("hertz, strong and fast", 1.15, .04, .18, .5, hertz(50, 1.5), (.3, -.7), .25, .03125, f(STRONG)),
    ],
    "held": [
        ("leaning on the preload, let go by a square", .4, .04, 1., -.3, pre(10, 2), (-.3, 0.), 1.5, .125,
         f((0., .2, .1))),
        ("leaning on the preload, let go back by a cubic", .4, .04, 1., -.3, pre(10, 3), (-.3, 0.), 1, .125,
         f((.5, 0., 0., -.3))),
        ("loop, stuck, let go by a square", .6, .04, .5, -4., pwl([(0, 20)], [(0, 1)]), (-3.8, 0.), 2, .125,
         f((-3., 0., .6))),
        ("loop, stuck, let go back by degree 7", .6, .04, .5, -4., pwl([(0, 20)], [(0, 1)]), (-3.8, 0.), 1,
         .125, f((-2., 0., 0., 0., 0., 0., 0., -.2))),
        ("cut, stuck, let go by a cubic", .5, .04, .18, -.3, pre(7, 70), (.05, 0.), 1, .125,
         f((0., 0., 0., .2), strip=strip(21, 23, .2, .8))),
        ("strip, degree 5", 1.15, .04, .18, 1., pre(7, 7), (0., 6.), 2, .25, f(FIFTH, strip=PETERKA)),
    ],
    "rigid": [
        ("rigid, degree 2", .8, .04, .04, .5, rigid(.6), (-1., 0.), 4, .25, f(SQUARE)),
        ("rigid, degree 3", 1.15, .04, .04, .5, rigid(.9), (-1., 0.), 3, .25, f(CUBIC)),
        ("rigid, degree 7", 1.15, .04, .04, .5, rigid(.8), (-1., 1.), 2, .125, f(SEVENTH)),
        ("rigid, rest let go by a cubic", .3, .04, .04, 0., rigid(.6), (0., 0.), 1, .125,
         f((1., 0., 0., -.05))),
        ("rigid zeno, let go by a square", .3, .04, .04, 0., rigid(.6), (-1., 0.), 1.5, .125,
         f((1.5, .1, -.05))),
        ("rigid zeno, let go by degree 5", .3, .04, .04, 0., rigid(.6), (-.5, .3), 1, .125,
         f((1.5, .2, -.1, .05, -.02, -.002))),
    ],
}


def main():
    cases, again = [], sys.argv[1:] == ["compare"]
    if again:
        with open(stops.PATH) as file:
            old = {c["name"]: c for c in json.load(file)["cases"]}
    for family, scenes in stops.FAMILIES.items():
        for scene in scenes:
            cases.append(stops.case(family, *scene))
            if again:
                new = cases[-1]
                print(new["name"], stops.nstr(stops.compare(old[new["name"]], new), 3), flush=True)
    if not again:
        with open(stops.PATH, "w") as file:
            json.dump(dict(cases=cases), file, indent=1)
            file.write("\n")


if __name__ == "__main__":
    main()
