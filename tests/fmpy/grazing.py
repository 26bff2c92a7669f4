"""Machines that barely reach their stop, solved by FMPy's CVODE: which impacts model exchange misses.

    python tests/fmpy/grazing.py 1000
"""

import contextlib
import sys
from unittest import mock

import fmpy
import numpy as np
from fmpy.fmi2 import FMU2Model
from fmpy.fmi3 import FMU3Model
from packages import TOP
from scipy.optimize import minimize_scalar

UPDATES = {"2.0": (FMU2Model, "newDiscreteStates"), "3.0": (FMU3Model, "updateDiscreteStates")}
OUTPUT = ["impact.count", "impact.time", "impact.velocity"]


def highest(frequency, start, end):
    """The highest place up to a time of x'' + 0.04 x' + x = cos(w t), in closed form."""
    answer = 1 / (1 - frequency**2 + 0.04j * frequency)
    decay, own = 0.02, np.sqrt(1 - 0.02**2)
    place = start[0] - answer.real
    speed = (start[1] - (1j * frequency * answer).real + decay * place) / own

    def position(time):
        free = np.exp(-decay * time) * (place * np.cos(own * time) + speed * np.sin(own * time))
        return (answer * np.exp(1j * frequency * time)).real + free

    times = np.linspace(0, end, 20001)
    best = np.argmax(position(times))
    low, high = times[max(best - 1, 0)], times[min(best + 1, 20000)]
    found = minimize_scalar(lambda time: -position(time), bounds=(low, high), method="bounded",
                            options={"xatol": 1e-14})
    return position(found.x)


def machines(number):
    """Values of machines that pass the clearance by 1e-9 to 1e-3 of it in three drive periods, and their end."""
    random = np.random.default_rng(7)
    while number:
        frequency = random.uniform(0.5, 2.0)
        start, end = random.uniform([-2.0, -2.0], [0.5, 2.0]), 6 * np.pi / frequency
        top = highest(frequency, start, end)
        if top < max(start[0], 0.0) + 0.1:
            continue
        number -= 1
        yield {
            "piercing.thickness": 0.0, "piercing.travel": 0.0, "stop.model": int(random.choice([2, 4, 5, 6])),
            "clearance": top / (1 + 10 ** random.uniform(-9, -3)), "contact.damping": 0.05,
            "stop.stiffness": 7.0, "stop.preload": 0.5, "stop.restitution": 0.7,
            "excitation.frequency": frequency, "initial.position": start[0], "initial.velocity": start[1],
        }, end


@contextlib.contextmanager
def without_next_event_time(version):
    """FMPy as if it were not told when the next event comes: indicators alone are left."""
    model, name = UPDATES[version]
    update = getattr(model, name)

    def untold(self):
        *told, _, time = update(self)
        return *told, False, time

    with mock.patch.object(model, name, untold):
        yield


def impacts(path, values, end, fmi_type, **options):
    rows = fmpy.simulate_fmu(path, start_values=values, stop_time=end, output_interval=end / 60,
                             output=OUTPUT, fmi_type=fmi_type, **options)
    return list(rows[OUTPUT][-1])


def missed(path, number, tolerance):
    """How many machines have no impact with predicted events, and by indicators alone; and how many are not as in
    co-simulation with predicted events."""
    description = fmpy.read_model_description(path)
    folder = fmpy.extract(path)
    counts = np.zeros(3, int)
    for values, end in machines(number):
        options = {"model_description": description, "relative_tolerance": tolerance}
        told = impacts(folder, values, end, "ModelExchange", **options)
        with without_next_event_time(description.fmiVersion):
            untold = impacts(folder, values, end, "ModelExchange", **options)
        expected = impacts(folder, values, end, "CoSimulation", model_description=description)
        assert expected[0] > 0
        counts += [told[0] == 0, untold[0] == 0, told != expected]
    return counts


if __name__ == "__main__":
    count = int(sys.argv[1])
    for unit in [TOP / "softstop-exchange.fmu", TOP / "softstop-fmi3.fmu"]:
        for given in (1e-5, 1e-8):
            none, without, other = missed(str(unit), count, given)
            print(f"{unit}, {count} machines, tolerance {given:g}: {none} missed, {other} not as in co-simulation; "
                  f"by indicators alone {without} missed")
