"""The program ``gyration``, as ``python -m gyration`` and as a command that the package installs."""

import sys

from gyration import _gyration


def main() -> int:
    """Run the program with the arguments of this process; returns its exit code."""
    return _gyration._main(["gyration", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
