"""The command line: `python -m asperity`, or `asperity`."""

import signal
import sys

from asperity._asperity import main as run


def main() -> int:
    """Runs the command line with the words of this process, and returns its exit code."""
    # Ctrl-C ends a command at once, as it does of the program
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return run(sys.argv[1:])


if __name__ == "__main__":
    sys.exit(main())
