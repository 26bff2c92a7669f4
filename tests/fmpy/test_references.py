"""The stored references of the laboratory are what many digits give."""

import subprocess
import sys

from packages import TOP

EACH = 30
"""Of so many references one is computed again."""


def test_stored_references_are_what_many_digits_give():
    program = TOP / "tests/reference/lab.py"
    subprocess.run([sys.executable, program, "check", str(EACH)], check=True)
