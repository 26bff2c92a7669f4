"""Random calls of every unit, right and wrong, in any order."""

import ctypes

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from kinds import bits, kind, make  # noqa: F401

CALLS = ["reset", "setup", "enter", "exit", "terminate", "step", "get", "set", "state", "bytes", "along", "slopes"]


def any_call(unit, kind, random, states):
    """A call that may be wrong, with arguments that may be."""
    fmu, variable = unit.fmu, random.choice(kind.description.modelVariables)
    reference = [int(random.choice([variable.valueReference] * 9 + [199]))]
    odd = float(random.choice([0.0, 1.0, 0.5, -1.0, 3.0, 1e-9, 1e300, np.nan, np.inf]))
    name = random.choice(CALLS, p=[0.02, 0.06, 0.06, 0.06, 0.01, 0.25, 0.14, 0.2, 0.08, 0.04, 0.04, 0.04])
    integer = int(odd) if abs(odd) < 100 else 7
    if name == "reset":
        fmu.reset()
    elif name == "setup":
        fmu.setupExperiment(startTime=0.0)
    elif name == "enter":
        fmu.enterInitializationMode()
    elif name == "exit":
        fmu.exitInitializationMode()
    elif name == "terminate":
        fmu.terminate()
    elif name == "step":
        time = ctypes.c_double()
        fmu.fmi2GetRealStatus(fmu.component, 2, ctypes.byref(time))
        fmu.doStep(time.value, odd)
    elif name == "get":
        [fmu.getReal, fmu.getInteger, fmu.getBoolean][random.integers(3)](reference)
    elif name == "set":
        right = {"Real": (fmu.setReal, odd), "Boolean": (fmu.setBoolean, odd > 0)}
        call, value = right.get(variable.type, (fmu.setInteger, integer))
        if random.random() < 0.1:
            call, value = fmu.setReal, odd
        call(reference, [value])
    elif name == "state" and states and random.random() < 0.5:
        fmu.setFMUstate(states[random.integers(len(states))])
    elif name == "state":
        states.append(fmu.getFMUstate())
    elif name == "bytes" and states:
        blob = bytearray(fmu.serializeFMUstate(states[-1]))
        if random.random() < 0.5:
            blob[random.integers(len(blob))] ^= 4
        states.append(fmu.deSerializeFMUstate(bytes(blob)))
    elif name == "along":
        output = int(random.choice([unit.reference(n) for n in kind.outputs]))
        fmu.getDirectionalDerivative([output], reference, [odd])
    elif name == "slopes":
        fmu.setRealInputDerivatives(reference, [int(random.integers(0, 9))], [odd])


@pytest.mark.parametrize("seed", range(10))
def test_any_calls_in_any_order(make, kind, seed):
    """Refused calls leave no trace, discarded steps can be told, and a reset unit is as a fresh one."""
    unit, probe, fresh = make(), make(), make()
    random, states, done = np.random.default_rng(seed), [], 0

    def everything():
        state = unit.fmu.getFMUstate()
        probe.fmu.setFMUstate(state)
        probe.fmu.freeFMUstate(state)
        read = []
        for name in kind.names:
            try:
                read.append(float(probe.get(name)).hex())
            except FMICallException:
                read.append(None)
        return read

    for _ in range(1500):
        before = everything()
        try:
            any_call(unit, kind, random, states)
            done += 1
        except FMICallException as refused:
            assert refused.status in (2, 3)
            if refused.status == 3:
                assert everything() == before
    assert done > 300
    for state in states:
        unit.fmu.freeFMUstate(state)
    unit.fmu.reset()
    for one in (unit, fresh):
        one.begin()
        one.step(3.0)
    assert bits(unit, kind.names) == bits(fresh, kind.names)
