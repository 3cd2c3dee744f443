"""The command ``lissom``; also ``python -m lissom``."""

import sys

from ._lissom import command
from ._own_command import own_command


def main() -> int:
    """Run the command with the arguments of this process.

    Returns
    -------
    int
        The exit code.
    """
    return command(["lissom", *sys.argv[1:]], own_command())


if __name__ == "__main__":
    sys.exit(main())
