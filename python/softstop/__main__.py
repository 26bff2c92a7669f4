"""The program: `python -m softstop`, or `softstop`."""

import sys

from . import _softstop


def main() -> int:
    """Runs the program with this process's arguments and returns its exit code."""
    return _softstop.main(["softstop", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
