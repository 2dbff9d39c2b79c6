#!/usr/bin/env python3
"""The five steps of README.md work as they are written.

usage: check_readme.py ROOT PUFFIN

Makes the STL with the command that the README offers, writes its case file, and runs each of its commands in order in an
empty folder. Only the simulated time of the run is cut short.
"""

import re
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

from tree import conclude

PROGRAM = "build/release/puffin"
CASE = re.compile(r"```toml\n(.*?)```", re.DOTALL)
CASE_NAME = "my-case.toml"
COMMAND = re.compile(rf"^(?:.*`)?({PROGRAM} [^`\n]+)", re.MULTILINE)  # alone on a line, or in the text
SHORT = ["--until", "1ms", "--quiet"]


def commands(readme: str) -> list[list[str]]:
    """Every command of the README, the one that makes the STL first."""
    found = [shlex.split(line) for line in COMMAND.findall(readme)]
    return sorted(found, key=lambda words: words[1] != "geometry")


def check(root: Path, puffin: str) -> list[str]:
    readme = (root / "README.md").read_text()
    cases = CASE.findall(readme)
    steps = commands(readme)
    if len(cases) != 1 or [words[1] for words in steps] != ["geometry", "voxelize", "check", "run", "report"]:
        return [f"README.md: expected one case file and five commands, found {len(cases)} and {steps}"]
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / CASE_NAME).write_text(cases[0])
        for words in steps:
            short = SHORT if words[1] == "run" else []
            run = subprocess.run([puffin, *words[1:], *short], cwd=folder, capture_output=True, text=True, check=False)
            if run.returncode != 0:
                return [f"README.md: {shlex.join(words)}: exit {run.returncode}\n{run.stdout}{run.stderr}"]
        if not list(Path(folder).glob("*/report.html")):
            return ["README.md: the five steps left no report.html"]
    return []


if __name__ == "__main__":
    sys.exit(conclude("the five steps of README.md", check(Path(sys.argv[1]), sys.argv[2])))
