"""The program: `impactlaw`, or `python -m impactlaw`."""

import signal
import sys

from ._impactlaw import main as program


def main() -> int:
    # Python would wait for the program to come back before it looks at Ctrl-C
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return program(["impactlaw", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
