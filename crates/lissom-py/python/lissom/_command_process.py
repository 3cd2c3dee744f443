"""Starts the command in a process of its own, without the package and its imports: ``python THIS EXTENSION ARGUMENT...``."""

import sys
from importlib.machinery import ExtensionFileLoader
from importlib.util import module_from_spec, spec_from_file_location


def main() -> int:
    """Run the command with the arguments of this process.

    Returns
    -------
    int
        The exit code.
    """
    extension = sys.argv[1]
    loader = ExtensionFileLoader("_lissom", extension)
    spec = spec_from_file_location("_lissom", extension, loader=loader)
    if spec is None:
        return 1
    module = module_from_spec(spec)
    loader.exec_module(module)
    own = [sys.executable, *sys.orig_argv[1 : -len(sys.argv[2:]) or None]]
    code: int = module.command(["lissom", *sys.argv[2:]], own)
    return code


if __name__ == "__main__":
    sys.exit(main())
