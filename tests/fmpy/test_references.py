"""The stored references of the laboratory are what many digits give."""

import subprocess
import sys

import pytest
from packages import TOP

EACH = 7
"""Of so many references one is computed again."""


@pytest.mark.parametrize("check", [["check", str(EACH)], ["closed"]])
def test_stored_references_are_what_many_digits_give(check):
    subprocess.run([sys.executable, TOP / "tests/reference/lab.py", *check], check=True)
