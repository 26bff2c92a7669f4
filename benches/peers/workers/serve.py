"""The worker's side of the talk with run.py: lines of JSON in, lines of JSON out.

A request names a method, a tolerance, the scene and frequencies; the answer holds the processor time in s
that the solver took and, for each frequency, X, X' and the number of impacts at the end; or an error.
"""

import json
import math
import sys


class Scene:
    """The machine, its two laws and its start, as run.py sends them."""

    def __init__(self, told):
        self.clearance = told["clearance"]
        self.free = (told["free"]["damping"], told["free"]["stiffness"])
        self.contact = (told["contact"]["damping"], told["contact"]["stiffness"])
        self.start = told["start"]
        self.periods = told["periods"]

    def end(self, frequency):
        """The end of a motion, in dimensionless time."""
        return self.periods * math.tau / frequency


def serve(solve):
    """Answer requests with `solve(method, tolerance, scene, frequencies) -> (seconds, ends)`."""
    answers = sys.stdout
    sys.stdout = sys.stderr
    for line in sys.stdin:
        request = json.loads(line)
        try:
            seconds, ends = solve(
                request["method"],
                request["tolerance"],
                Scene(request["scene"]),
                request["frequencies"],
            )
            answer = {"seconds": seconds, "ends": ends}
        except Exception as error:  # whatever a peer throws is its answer
            answer = {"error": f"{type(error).__name__}: {error}"}
        answers.write(json.dumps(answer) + "\n")
        answers.flush()
