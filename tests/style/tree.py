"""The files that the style checks look at, and how they report."""

import subprocess
import sys
from pathlib import Path

TOP_FOLDERS = ("lbm", "dem", "micromodels", "coupling", "cases", "tests", "tools", "docs")
SKIPPED = {"build", "runs", ".git", ".cache", "__pycache__"}  # never tracked; matters only without git


def tracked(root: Path) -> list[Path]:
    """Every tracked file that exists, relative to root, sorted; without git, every file below root."""
    git = subprocess.run(["git", "-C", str(root), "ls-files", "-z"], capture_output=True, check=False)
    if git.returncode == 0 and git.stdout:
        found = [Path(name) for name in git.stdout.decode().split("\0") if name]
    else:
        found = [path.relative_to(root) for path in root.rglob("*")]
        found = [path for path in found if not SKIPPED.intersection(path.parts)]
    return sorted(path for path in found if (root / path).is_file())


def cpp(root: Path) -> list[Path]:
    return [path for path in tracked(root) if path.suffix in (".cpp", ".hpp")]


def text(root: Path, path: Path) -> str | None:
    """The text of a file; None if it is binary."""
    data = (root / path).read_bytes()
    return None if b"\0" in data else data.decode(errors="replace")


def conclude(what: str, faults: list[str]) -> int:
    """Prints the faults, one a line, and the exit code that goes with them."""
    for fault in faults:
        print(fault)
    print(f"{what}: {len(faults)} fault(s)" if faults else f"{what}: in order")
    sys.stdout.flush()
    return 1 if faults else 0
