"""heyoka, scalar and batch: Taylor steps compiled for this machine, terminal events with callbacks.

The law is written once, with a parameter that is 1 in contact and 0 out of it; the callback of the event
sets it by the direction of the crossing and lets the integration go on. In the batch mode the lanes hold
different frequencies.
"""

import math
import time

import heyoka as hy
import numpy as np
from serve import serve

FREQUENCY, CONTACT = 0, 1


def equations(scene):
    """X' = V, V' = cos(eta t) - damping V - stiffness X."""
    x, v = hy.make_vars("x", "v")
    (damping, stiffness), (damping_on, stiffness_on) = scene.free, scene.contact
    contact = hy.par[CONTACT]
    rate = (
        hy.cos(hy.par[FREQUENCY] * hy.time)
        - (damping + (damping_on - damping) * contact) * v
        - (stiffness + (stiffness_on - stiffness) * contact) * x
    )
    return [(x, v), (v, rate)], x - scene.clearance


class Scalar:
    """One motion at a time."""

    lanes = 1

    def __init__(self, scene, tolerance):
        self.scene = scene
        self.impacts = 0
        system, surface = equations(scene)
        event = hy.t_event(surface, callback=self.crossed)
        self.stepper = hy.taylor_adaptive(
            system, [0.0, 0.0], pars=[1.0, 0.0], t_events=[event], tol=tolerance
        )
        self.pars = self.stepper.pars

    def __deepcopy__(self, _memo):
        """heyoka copies callbacks; this one must stay who it is."""
        return self

    def crossed(self, _stepper, direction):
        """The law changes, the integration goes on."""
        onwards = direction > 0
        self.pars[CONTACT] = onwards
        self.impacts += onwards
        return True

    def run(self, frequencies):
        """The motion of the one frequency."""
        (frequency,) = frequencies
        self.stepper.time = 0.0
        self.stepper.state[:] = self.scene.start
        self.pars[:] = frequency, 0.0
        self.stepper.reset_cooldowns()
        self.impacts = 0
        outcome = self.stepper.propagate_until(self.scene.end(frequency))[0]
        if outcome != hy.taylor_outcome.time_limit:
            raise RuntimeError(str(outcome))
        x, v = self.stepper.state.tolist()
        return [(x, v, self.impacts)]


class Batch:
    """As many motions at a time as the machine has SIMD lanes."""

    def __init__(self, scene, tolerance):
        self.scene = scene
        self.lanes = hy.recommended_simd_size()
        self.impacts = [0] * self.lanes
        system, surface = equations(scene)
        event = hy.t_event_batch(surface, callback=self.crossed)
        empty = np.zeros((2, self.lanes))
        self.stepper = hy.taylor_adaptive_batch(
            system, empty, pars=empty.copy(), t_events=[event], tol=tolerance
        )
        self.contact = self.stepper.pars[CONTACT]

    def __deepcopy__(self, _memo):
        """heyoka copies callbacks; this one must stay who it is."""
        return self

    def crossed(self, _stepper, direction, lane):
        """The law of the lane changes, the integration goes on."""
        onwards = direction > 0
        self.contact[lane] = onwards
        self.impacts[lane] += onwards
        return True

    def run(self, frequencies):
        """The motions of as many frequencies as there are lanes."""
        self.stepper.set_time(np.zeros(self.lanes))
        self.stepper.state[:] = np.array(self.scene.start)[:, None]
        self.stepper.pars[FREQUENCY] = frequencies
        self.contact[:] = 0.0
        self.stepper.reset_cooldowns()
        self.impacts[:] = [0] * self.lanes
        self.stepper.propagate_until([self.scene.end(frequency) for frequency in frequencies])
        for outcome, *_ in self.stepper.propagate_res:
            if outcome != hy.taylor_outcome.time_limit:
                raise RuntimeError(str(outcome))
        return list(zip(*self.stepper.state.tolist(), self.impacts, strict=True))


class Uncalled(Batch):
    """A callback that does nothing: the law of free flight throughout. No motion of the machine, but a
    bound on what the batch mode could do if the callback cost no more than a call."""

    def crossed(self, _stepper, _direction, _lane):
        """Goes on."""
        return True


MODES = {"heyoka-scalar": Scalar, "heyoka-batch": Batch, "heyoka-batch-bound": Uncalled}
BUILT = {}


def solve(method, tolerance, scene, frequencies):
    """Batches in order, the last one filled up with its last frequency. Compilation is not counted."""
    key = method, tolerance
    if key not in BUILT:
        BUILT[key] = MODES[method](scene, tolerance)
    mode = BUILT[key]
    filled = math.ceil(len(frequencies) / mode.lanes) * mode.lanes
    padded = frequencies + frequencies[-1:] * (filled - len(frequencies))
    groups = [padded[at : at + mode.lanes] for at in range(0, filled, mode.lanes)]
    start = time.process_time()
    ends = [end for group in groups for end in mode.run(group)]
    return time.process_time() - start, ends[: len(frequencies)]


if __name__ == "__main__":
    serve(solve)
