#!/usr/bin/env python3
"""Every C++ file is laid out as clang-format with the .clang-format of the root would lay it out.

usage: check_format.py ROOT [CLANG_FORMAT]
"""

import subprocess
import sys
from pathlib import Path

from tree import conclude, cpp


def check(root: Path, program: str = "clang-format") -> list[str]:
    """The files that differ. All in one call: starting the program costs more than reading a file."""
    paths = cpp(root)
    if not paths:
        return ["no C++ file found: is this the root?"]
    try:
        run = subprocess.run([program, "--style=file", "--dry-run", "--Werror", "--ferror-limit=1", *map(str, paths)],
                             cwd=root, capture_output=True, text=True, check=False)
    except FileNotFoundError:
        return [f"{program} is not there; tools/check installs it"]
    if run.returncode == 0:
        return []
    differ = [str(path) for path in paths if f"{path}:" in run.stderr]
    return [f"{path}: not laid out by .clang-format; run clang-format -i {path}" for path in differ] or [run.stderr]


if __name__ == "__main__":
    sys.exit(conclude("layout", check(Path(sys.argv[1]), *sys.argv[2:3])))
