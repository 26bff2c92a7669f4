"""The program: `python -m softstop`, or `softstop`."""

import sys

from . import _softstop


def main() -> int:
    """Runs the program with this process's arguments and returns its exit code."""
    try:
        return _softstop.main(["softstop", *sys.argv[1:]])
    except KeyboardInterrupt:
        return 130


if __name__ == "__main__":
    sys.exit(main())
