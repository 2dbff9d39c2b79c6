#!/usr/bin/env python3
"""clang-tidy with the .clang-tidy of the root finds nothing in the .cpp files that the build compiles.

usage: check_tidy.py ROOT BUILD_DIR sources|FOLDER[,FOLDER...] [CLANG_TIDY]

sources: all tracked .cpp files but those of tests/; else the tracked .cpp files of these top-level folders. Only files that BUILD_DIR/compile_commands.json lists,
and through them the headers of our folders. Says which files the build does not compile: nothing is left out in silence.
"""

import json
import os
import re
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from tree import conclude, cpp


def chosen(root: Path, which: str) -> list[Path]:
    folders = which.split(",")
    return [path for path in cpp(root) if path.suffix == ".cpp" and
            (path.parts[0] in folders or (which == "sources" and path.parts[0] != "tests"))]


def compiled(build: Path) -> set[Path]:
    commands = json.loads((build / "compile_commands.json").read_text())
    return {(Path(entry["directory"]) / entry["file"]).resolve() for entry in commands}


def without_precompiled(build: Path, folder: str) -> Path:
    """The compile commands without gcc's precompiled headers, which clang cannot read; our sources do not need them."""
    entries = json.loads((build / "compile_commands.json").read_text())
    for entry in entries:
        entry["command"] = re.sub(r" -Winvalid-pch| -include \S*cmake_pch\.hxx", "", entry["command"])
    (Path(folder) / "compile_commands.json").write_text(json.dumps(entries))
    return Path(folder)


def tidy(root: Path, build: Path, program: str, path: Path) -> tuple[Path, float, str]:
    begin = time.monotonic()
    run = subprocess.run([program, "--quiet", "-p", str(build), str(path)], cwd=root, capture_output=True, text=True,
                         check=False)
    return path, time.monotonic() - begin, run.stdout + run.stderr if run.returncode != 0 else ""


def check(root: Path, build: Path, which: str, program: str = "clang-tidy") -> list[str]:
    known = compiled(build)
    paths = [path for path in chosen(root, which) if (root / path).resolve() in known]
    if not paths:
        return [f"{build} compiles none of our {which}: is it a build folder of this tree?"]
    jobs = len(os.sched_getaffinity(0))
    print(f"clang-tidy: {len(paths)} files of the {which}, {jobs} at a time")
    for path in chosen(root, which):
        if path not in paths:
            print(f"not compiled by this build, so not checked: {path}")
    try:
        with ThreadPoolExecutor(jobs) as pool, tempfile.TemporaryDirectory() as folder:
            commands = without_precompiled(build, folder)
            results = list(pool.map(lambda path: tidy(root, commands, program, path), paths))
    except FileNotFoundError:
        return [f"{program} is not there; tools/check installs it"]
    slowest = max(results, key=lambda result: result[1])
    print(f"{sum(seconds for _, seconds, _ in results):.0f} s in all, longest {slowest[0]} {slowest[1]:.1f} s")
    return [f"{path}:\n{output}" for path, _, output in results if output]


if __name__ == "__main__":
    sys.exit(conclude("clang-tidy", check(Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve(), *sys.argv[3:5])))
