"""What cannot be raises an exception that names the argument; nothing crashes or leaks."""

import os
import pathlib
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
    (lambda: ss.simulate(A, keep=5), "keep = 5: for many motions"),
    (lambda: ss.simulate(A, keep=1_000_000, periods=1_000_000, eta=np.ones(1000)), "keep = 1000000: with 1000 motions at most 100000"),
    (lambda: ss.simulate(A, periods=1_000_000), r"periods = 1000000: must be a whole number in \[1, 100000\]"),
    (lambda: ss.simulate(A, start=3), "start = 3: must be"),
    (lambda: ss.simulate(A, start=(np.inf, 0)), "position = inf"),
    (lambda: ss.simulate(A, start=(0, [14, np.nan])), "velocity = NaN: must be finite"),
    (lambda: ss.exponents(A, eta=[1.1, 1.2], start=(np.nan, 0)), "position = NaN: must be finite"),
    (lambda: A.replace(clearence=3), "did you mean clearance"),
    (lambda: A.replace(start=3), "start = 3: must be"),
    (lambda: A.replace(stop=ss.Rigid(1.8)), "stop.restitution = 1.8"),
    (lambda: A.replace(clearance=None), "None: must be a number or a word"),
    (lambda: ss.Machine.from_toml("mass = "), "TOML"),
    (lambda: ss.Machine.from_dict({"mass": object()}), "must be a number, a word, or a table"),
    (lambda: ss.sweep(A, (0.8, 1.8), steps=1), "steps"),
    (lambda: ss.sweep(A, (0.8, 1.8), direction="sideways"), "direction"),
    (lambda: ss.continue_(A, "colour", (0, 1)), "^parameter colour"),
    (lambda: ss.continue_(A, "eta", (1.2, 1.5)), r"^between\[0\] 1.2 between\[1\] 1.5: must be"),
    (lambda: ss.continue_(A, "eta", (1, 1.5), second="rho", second_between=(1, 2)), r"^second_between\[0\] 1 second_between\[1\] 2: must be"),
    (lambda: ss.continue_(A, "eta", (1, 1.5), second="rho"), "second_between = None"),
    (lambda: ss.continue_(A, "eta", (1, 1.5), second="rho", second_between=(2, 18), switch=7), "switch"),
    (lambda: ss.optimize(A), "^task = "),
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
    motion = ss.simulate(A, start=(0.1, 14), periods=30, forces=([0.3, 5, 9], [1, 2, 0]))
    again = pickle.loads(pickle.dumps(motion))
    assert again.end == motion.end and again.energies == motion.energies
    assert (again.impacts.time == motion.impacts.time).all()


def resident():
    """Memory of this process in bytes."""
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


M = ss.simulate(A, periods=2)
O = ss.orbit(A)
WRONG = [
    0, -1, 1, 0.5, 1e300, -1e300, 5e-324, np.nan, np.inf, 10**18, 10**400, None, True, 1j, b"1", "", "x", "1e3", "--help", [], [1.0],
    [None], [[1], [2, 3]], (), (1, 2), (np.nan, 1), {}, {"a": 1}, range(3), slice(1), object(), float, np.float32(1.5), np.int64(3),
    np.array(3), np.ones((2, 3)), np.ones((0, 3)), np.array(["a"]), np.ones(3, dtype=complex), np.broadcast_to(1.0, (10**13,)),
    np.datetime64("2020"), np.ma.masked,
]
CALLS = {
    "eta|excitation.frequency": lambda value: ss.simulate(A, eta=value, periods=3),
    "stop__stiffness|stop.stiffness": lambda value: ss.simulate(A, stop__stiffness=value, clearance=[9, 10], periods=3),
    "start|position|velocity": lambda value: ss.simulate(A, start=value, periods=3),
    "start|velocity": lambda value: ss.simulate(A, start=(0.0, value), periods=3),
    "periods": lambda value: ss.simulate(A, periods=value),
    "keep": lambda value: ss.simulate(A, eta=[1.0, 1.1], periods=3, keep=value),
    "clearance": lambda value: A.replace(clearance=value),
    "stop.stiffness": lambda value: A.replace({"stop.stiffness": value}),
    "unknown key|changes": lambda value: A.replace({str(value): 1.0}),
    "changes|unknown key": lambda value: A.replace(value),
    "mass|missing key": lambda value: ss.Machine.from_dict({"mass": value}),
    "stop|missing key": lambda value: ss.Machine.from_dict({"stop": value}),
    "text|TOML|missing key": lambda value: ss.Machine.from_toml(value),
    "times|time": lambda value: M.sample(value),
    "between|range": lambda value: ss.sweep(A, value, steps=2),
    "range|between": lambda value: ss.sweep(A, (1.1, value), steps=2),
    "steps": lambda value: ss.sweep(A, (1.1, 1.2), steps=value),
    "parameter|between|range": lambda value: ss.continue_(A, value, (9, 11), points=5),
    "between|range|points": lambda value: ss.continue_(A, "clearance", value, points=5),
    "starts|seed": lambda value: ss.motions(A, starts=value),
    "size|at": lambda value: ss.basin(A, size=value, at="x"),
    "x": lambda value: ss.basin(A, size=4, x=value),
    "v|size": lambda value: ss.basin(A, size=4, v=(-1, 1, value)),
    "forces": lambda value: ss.simulate(A, periods=3, forces=value),
    "forces|force:": lambda value: ss.simulate(A, periods=3, forces=(value, [1.0, 2.0])),
    "forces|force: ": lambda value: ss.simulate(A, periods=3, forces=([0, 1], value)),
    "eta|excitation.frequency ": lambda value: ss.exponents(A, eta=value, transient=1, periods=32),
    "transient": lambda value: ss.exponents(A, transient=value, periods=32),
    "progress": lambda value: ss.sweep(A, (1.1, 1.2), steps=2, progress=value),
    "machine": lambda value: ss.orbit(value),
    "task|cannot be read|study.toml": lambda value: ss.study(value),
    "name|no such figure": lambda value: O.gradient(value, ["clearance"]),
    "by|unknown key": lambda value: O.gradient("velocity", value),
}


def any_value(choose):
    """A value that hardly any argument allows: a wrong one, or a random number, string or array."""
    kind = choose.randrange(8)
    if kind == 0:
        return choose.choice([-1, 1]) * 10 ** choose.uniform(-320, 308)
    if kind == 1:
        return "".join(chr(choose.randrange(1, 0x2FF)) for _ in range(choose.randrange(40)))
    if kind == 2:
        shape = [choose.randrange(4) for _ in range(choose.randrange(4))]
        return np.random.default_rng(choose.randrange(1000)).choice([0.5, -1.0, np.nan, np.inf, 1e300], shape)
    return choose.choice(WRONG)


def refused(count, seed):
    """How many of so many random calls raise; each that a machine or argument is wrong for names it."""
    choose = random.Random(seed)
    raised = 0
    for _ in range(count):
        names, call = choose.choice(list(CALLS.items()))
        value = any_value(choose)
        try:
            call(value)
        except ss.MachineError as error:
            raised += 1
            assert any(name in str(error) for name in names.split("|")), f"{names}: {value!r}: {error}"
        except (ss.SoftstopError, MemoryError):
            raised += 1
    return raised


def test_wrong_calls_name_their_argument_and_leave_nothing():
    script = textwrap.dedent("""
        import os
        import test_errors as tests
        count, seed = int(os.environ.get("SOFTSTOP_CALLS", "10000")), int(os.environ.get("SOFTSTOP_CALLS_SEED", "1"))
        tests.refused(5000, seed + 1)
        before = tests.resident()
        assert tests.refused(count, seed) > count / 2
        print(tests.resident() - before)
    """)
    # One arena: with one for each thread, what the allocator keeps depends on which thread asks.
    done = subprocess.run([sys.executable, "-c", script], cwd=pathlib.Path(__file__).parent, capture_output=True, text=True,
                          env=os.environ | {"MALLOC_ARENA_MAX": "1"})
    assert done.returncode == 0, done.stderr
    assert int(done.stdout) < 5e6


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


def test_errors_of_arguments_have_a_key_too():
    with pytest.raises(ss.MachineError) as raised:
        ss.simulate(ss.Machine.unloaded(), periods=-1)
    assert raised.value.key is None


@pytest.mark.parametrize("call, words", {
    "twice": (lambda m: ss.simulate(m, eta=[1.0], frequency=[1.3]), "frequency: is set twice"),
    "masked": (lambda m: ss.simulate(m, eta=np.ma.masked_array([1.0, 1.1], [False, True])), "eta = .*masked"),
    "start": (lambda m: ss.simulate(m, initial__position=5.0), "initial__position: is the start"),
    "huge": (lambda m: ss.basin(m, x=(0, 1e308, 5), v=(-1, 1, 5)), "x = 1e308"),
    "over": (lambda m: ss.simulate(m, eta=[1.0, 1.1], keep=3).plot(over="colour"), "over = 'colour'"),
    "machine": (lambda m: ss.optimize({"machine": "loaded"}, machine=m), "machine: the task has one, too"),
}.values())
def test_what_once_was_taken_is_refused(call, words):
    with pytest.raises(ss.MachineError, match=words):
        call(ss.Machine.unloaded(eta=1.15, clearance=10))
