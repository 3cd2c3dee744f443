"""The command ``lissom``; also ``python -m lissom``."""

import sys

from ._lissom import command


def main() -> int:
    """Run the command with the arguments of this process.

    Returns
    -------
    int
        The exit code.
    """
    return command(["lissom", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
