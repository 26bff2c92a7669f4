"""Ctrl-C ends every long call, and the next call works. `pytest -s` prints how soon."""

import os
import signal
import subprocess
import sys
import textwrap
import threading
import time

import pytest
from conftest import TOP

CALLS = {
    "simulate": "ss.simulate(m, eta=0.98, start=(np.zeros(1000), np.linspace(10, 14, 1000)), periods=1_000_000, keep=1)",
    "simulate machines": "ss.simulate(m, eta=np.linspace(0.8, 1.8, 1_000_000), start=(0, 14), periods=100_000)",
    "exponents": "ss.exponents(m, eta=np.linspace(0.96, 0.98, 100), start=(0, 12), periods=1_000_000)",
    "motions": "ss.motions(m, starts=1_000_000)",
    "sweep": "ss.sweep(m, (0.8, 1.8), steps=100_000)",
    "basin": "ss.basin(m.replace(eta=0.9875), size=3000)",
    "optimize": f"ss.optimize({str(TOP / 'docs/press/press.toml')!r})",
}
"""Calls that take far longer than it takes the signal to come."""


def seconds_to_end(call):
    """Seconds from the signal to the exception."""
    script = textwrap.dedent(f"""
        import numpy as np, softstop as ss
        m = ss.Machine.unloaded(clearance=10)
        print("begun", flush=True)
        try:
            {call}
        except KeyboardInterrupt:
            print("interrupted", flush=True)
        print(len(ss.simulate(m, periods=10, start=(0, 14)).impacts), flush=True)
    """)
    child = subprocess.Popen(
        [sys.executable, "-c", script], stdout=subprocess.PIPE, text=True, start_new_session=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )
    # A call that goes on fails the test instead of holding it up.
    deadline = threading.Timer(60, child.kill)
    deadline.start()
    with child:
        assert child.stdout.readline() == "begun\n"
        time.sleep(0.7)
        begin = time.monotonic()
        child.send_signal(signal.SIGINT)
        assert child.stdout.readline() == "interrupted\n"
        seconds = time.monotonic() - begin
        assert int(child.stdout.readline()) > 0
    deadline.cancel()
    assert child.returncode == 0
    return seconds


@pytest.mark.skipif(os.name == "nt", reason="signals")
@pytest.mark.parametrize("name", CALLS)
def test_ctrl_c(name):
    seconds = seconds_to_end(CALLS[name])
    print(f"{name}: {seconds:.3f} s")
    assert seconds < 3
