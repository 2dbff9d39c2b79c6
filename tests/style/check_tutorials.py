#!/usr/bin/env python3
"""The tutorials work as they are written.

usage: check_tutorials.py ROOT PUFFIN

A tutorial is a page in docs/tutorials. In an empty folder, from top to bottom: a fence ```toml NAME (or csv) is written to
that file; every line of a fence ```bash is run with `puffin` on the path, and must end with exit code 0; a fence ```text
behind it holds words that the last command must have printed, a line each (`...` stands for anything).
"""

import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from tree import conclude

FENCE = re.compile(r"^```(\w+)(?: (\S+))?\n(.*?)^```", re.DOTALL | re.MULTILINE)


def matches(wanted: str, said: str) -> bool:
    pattern = r".*".join(re.escape(part.strip()) for part in wanted.split("..."))
    return re.search(pattern.replace(r"\ ", r"\s+"), said) is not None


def follow(page: Path, folder: Path, path: str) -> list[str]:
    said, ran = "", 0
    for kind, name, text in FENCE.findall(page.read_text()):
        if kind in ("toml", "csv") and name:
            (folder / name).write_text(text)
        elif kind == "bash":
            for command in text.strip().splitlines():
                run = subprocess.run(["bash", "-c", command], cwd=folder, env={**os.environ, "PATH": path},
                                     capture_output=True, text=True, check=False)
                said, ran = run.stdout + run.stderr, ran + 1
                if run.returncode != 0:
                    return [f"{page.name}: {command}: exit {run.returncode}\n{said}"]
        elif kind == "text":
            for line in text.strip().splitlines():
                if not matches(line, said):
                    return [f"{page.name}: expected '{line.strip()}' from the command before; it said\n{said}"]
    return [] if ran else [f"{page.name}: no commands to follow"]


def check(root: Path, puffin: str) -> list[str]:
    pages = sorted(page for page in (root / "docs/tutorials").glob("*.md") if page.name != "README.md")
    if not pages:
        return ["docs/tutorials: no tutorials"]
    problems = []
    for page in pages:
        with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as bin_folder:
            (Path(bin_folder) / "puffin").symlink_to(Path(puffin).resolve())
            problems += follow(page, Path(folder), f"{bin_folder}:{os.environ['PATH']}")
    return problems


if __name__ == "__main__":
    sys.exit(conclude("the tutorials", check(Path(sys.argv[1]), sys.argv[2])))
