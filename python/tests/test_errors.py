"""What cannot be raises an exception that names the argument; nothing crashes or leaks."""

import os
import pickle
import random
import signal
import subprocess
import sys
import textwrap
import time

import numpy as np
import pytest

import softstop as ss

A = ss.Machine.unloaded(eta=1.15, clearance=10)


@pytest.mark.parametrize(("call", "words"), [
    (lambda: ss.simulate(A, eta=[1.0, -1.0]), "excitation.frequency = -1: must be finite and > 0"),
    (lambda: ss.simulate(A, eta=np.nan), "excitation.frequency = NaN"),
    (lambda: ss.simulate(A, eta=[1, 2], clearance=[1, 2, 3]), r"eta \(2,\), clearance \(3,\): do not broadcast"),
    (lambda: ss.simulate(A, eta="fast"), "eta = 'fast'"),
    (lambda: ss.simulate(A, eta=["a", "b"]), r"eta = \['a', 'b'\]"),
    (lambda: ss.simulate(A, periods=0), r"periods = 0: must be a whole number in \[1, 1000000\]"),
    (lambda: ss.simulate(A, periods=1.5), "periods = 1.5"),
    (lambda: ss.simulate(A, keep=-1, eta=[1]), "keep = -1"),
    (lambda: ss.simulate(A, keep=1_000_000, periods=1_000_000, eta=np.ones(1000)), "keep = 1000000: with 1000 motions at most 100000"),
    (lambda: ss.simulate(A, periods=1_000_000), r"periods = 1000000: must be a whole number in \[1, 100000\]"),
    (lambda: ss.simulate(A, start=3), "start = 3: must be"),
    (lambda: ss.simulate(A, start=(np.inf, 0)), "position = inf"),
    (lambda: A.replace(clearence=3), "did you mean clearance"),
    (lambda: A.replace(clearance=None), "None: must be a number or a word"),
    (lambda: ss.Machine.from_toml("mass = "), "TOML"),
    (lambda: ss.Machine.from_dict({"mass": object()}), "must be a number, a word, or a table"),
    (lambda: ss.sweep(A, (0.8, 1.8), steps=1), "steps"),
    (lambda: ss.sweep(A, (0.8, 1.8), direction="sideways"), "direction"),
    (lambda: ss.continue_(A, "colour", (0, 1)), "colour"),
    (lambda: ss.basin(A, size=1), "size"),
    (lambda: ss.optimize({"machine": "loaded", "require": {"beauty": 1}}), "beauty"),
    (lambda: ss.study({"outputs": []}), "^study.toml:1:1: missing field"),
])
def test_the_argument_is_named(call, words):
    with pytest.raises((ss.MachineError, ValueError), match=words):
        call()


def test_the_key_of_a_machine():
    with pytest.raises(ss.MachineError) as raised:
        A.replace(clearance=float("nan"))
    assert raised.value.key == "clearance"
    with pytest.raises(ss.SoftstopError):
        ss.orbit(A.replace(eta=3.0))


def test_pickle_and_hash():
    assert pickle.loads(pickle.dumps(A)) == A
    orbit = ss.orbit(A)
    again = pickle.loads(pickle.dumps(orbit))
    assert dict(again) == dict(orbit)
    assert again.gradient("velocity", ["clearance"]) == orbit.gradient("velocity", ["clearance"])
    assert len({A, A.replace(clearance=10), A.replace(clearance=9)}) == 2


def resident():
    """Memory of this process in bytes."""
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


VALUES = [0, 1, -1, 0.5, 1e300, -1e300, np.nan, np.inf, None, "x", "", True, [], [1.0], [1, 2], np.ones((2, 3)), {}, (), (1, 2),
          object(), np.array(["a"]), 10**400, 1j, b"1", np.float32(1.5), np.int64(3)]


def any_call(choose):
    """A call with wrong values."""
    value = lambda: choose.choice(VALUES)  # noqa: E731
    return choose.choice([
        lambda: ss.simulate(A, eta=value(), periods=3),
        lambda: ss.simulate(A, start=(value(), value()), periods=3),
        lambda: ss.simulate(A, clearance=value(), stop__stiffness=value(), periods=3, keep=value()),
        lambda: ss.simulate(A, periods=value()) if value() not in (None, 10**400) else None,
        lambda: A.replace(clearance=value()),
        lambda: A.replace({"stop.stiffness": value(), str(value()): value()}),
        lambda: ss.Machine.from_dict({"mass": value(), "stop": value()}),
        lambda: ss.Machine.from_toml(str(value())),
        lambda: ss.Table({"a": np.ones(3)})[value()],
        lambda: ss.simulate(A, periods=2).sample(value()),
    ])


def test_wrong_calls_raise_and_leave_nothing():
    choose = random.Random(1)
    raised = 0
    for number in range(int(os.environ.get("SOFTSTOP_CALLS", "3000"))):
        if number == 1000:
            before = resident()
        try:
            any_call(choose)()
        except (ss.MachineError, ss.SoftstopError, ValueError, TypeError, KeyError, OverflowError):
            raised += 1
    assert raised > number / 2
    assert resident() - before < 20e6


@pytest.mark.skipif(os.name == "nt", reason="signals")
def test_ctrl_c_ends_a_long_call_within_moments(tmp_path):
    script = textwrap.dedent("""
        import numpy as np, softstop as ss, sys
        machine = ss.Machine.unloaded(eta=0.98, clearance=10)
        print("begun", flush=True)
        try:
            ss.simulate(machine, start=(np.zeros(1000), np.linspace(10, 14, 1000)), periods=1_000_000, keep=1)
        except KeyboardInterrupt:
            print("interrupted", flush=True)
        print(len(ss.simulate(machine, periods=10).impacts), flush=True)
    """)
    child = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True, start_new_session=True,
                             preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler))
    assert child.stdout.readline() == "begun\n"
    time.sleep(1.0)
    child.send_signal(signal.SIGINT)
    assert child.stdout.readline() == "interrupted\n"
    assert int(child.stdout.readline()) >= 0
    assert child.wait() == 0
