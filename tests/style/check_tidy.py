#!/usr/bin/env python3
"""clang-tidy with the .clang-tidy of the root finds nothing in the .cpp files that the build compiles.

usage: check_tidy.py ROOT BUILD_DIR sources|FOLDER[,FOLDER...] [CLANG_TIDY]

sources: all tracked .cpp files but those of tests/; else the tracked .cpp files in and below these folders, like
dem,tests/lbm. Only files that BUILD_DIR/compile_commands.json lists, and through them the headers of our folders. Says which
files the build does not compile: nothing is left out in silence.

Nine tenths of the time go into the headers of the library and Eigen. So files that are compiled with equal flags and share no
private name are looked at together, as one source that includes them (groups.py). Where that finds anything (a fault, or just
two names that do not go together), its halves are looked at, and at last the files alone: what is reported was found in a
file alone.
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

from groups import groups
from tree import conclude, cpp


def chosen(root: Path, which: str) -> list[Path]:
    folders = which.split(",")
    return [path for path in cpp(root) if path.suffix == ".cpp" and
            (any(path.is_relative_to(folder) for folder in folders) or (which == "sources" and path.parts[0] != "tests"))]


def entries(build: Path) -> list[tuple[Path, dict]]:
    """Each source and its compile command; a group (PUFFIN_TOGETHER) stands for the sources that it includes."""
    found = []
    for entry in json.loads((build / "compile_commands.json").read_text()):
        file = (Path(entry["directory"]) / entry["file"]).resolve()
        members = re.findall(r'#include "(.*)"', file.read_text()) if file.name.startswith("unity_") else [file]
        found += [(Path(member).resolve(), entry) for member in members]
    return found


def compiled(build: Path) -> set[Path]:
    return {file for file, _ in entries(build)}


def flags_of(entry: dict) -> str:
    """The compile command without its file, and without gcc's precompiled headers, which clang cannot read; our sources
    do not need them."""
    return re.sub(r" -Winvalid-pch| -Wno-\S+| -include \S*cmake_pch\.hxx| -o \S+| -c \S+", "", entry["command"])


class Tidy:
    """Looks at lists of files with equal flags; its folder holds the sources that include them and their commands."""

    def __init__(self, root: Path, build: Path, program: str, folder: str):
        self.root, self.program, self.folder = root, program, Path(folder)
        self.flags = {}
        for file, entry in entries(build):
            self.flags.setdefault(file, (entry["directory"], flags_of(entry)))
        settings = (root / ".clang-tidy").read_text()
        self.header = re.search(r"HeaderFilterRegex: '(.*)'", settings).group(1)

    def groups(self, paths: list[Path]) -> list[list[Path]]:
        alike = {}
        for path in paths:  # of one folder: they share headers
            alike.setdefault((path.parent, self.flags[(self.root / path).resolve()]), []).append(path)
        return [[file.relative_to(self.root) for file in members]
                for files in alike.values() for members in groups([self.root / path for path in files])]

    def look(self, paths: list[Path]) -> tuple[float, str]:
        """Seconds, and what clang-tidy said if it found anything."""
        with tempfile.TemporaryDirectory(dir=self.folder) as place:
            source = self.root / paths[0] if len(paths) == 1 else Path(place) / "together.cpp"
            if len(paths) > 1:
                source.write_text("".join(f'#include "{self.root / path}"\n' for path in paths))
            directory, flags = self.flags[(self.root / paths[0]).resolve()]
            commands = [{"directory": directory, "file": str(source), "command": f"{flags} -c {source}"}]
            (Path(place) / "compile_commands.json").write_text(json.dumps(commands))
            begin = time.monotonic()
            run = subprocess.run(
                [self.program, "--quiet", "-p", place, f"--config-file={self.root / '.clang-tidy'}",
                 "--header-filter=" + (self.header if len(paths) == 1 else self.header.replace("hpp", "[ch]pp")),
                 str(source)], cwd=self.root, capture_output=True, text=True, check=False)
            return time.monotonic() - begin, run.stdout + run.stderr if run.returncode != 0 else ""

    def __call__(self, paths: list[Path]) -> tuple[float, list[str]]:
        """Seconds and findings."""
        seconds, said = self.look(paths)
        if not said:
            return seconds, []
        if len(paths) == 1:
            return seconds, [f"{paths[0]}:\n{said}"]
        half = len(paths) // 2
        parts = [self(paths[:half]), self(paths[half:])]
        return seconds + sum(part[0] for part in parts), [finding for part in parts for finding in part[1]]


def check(root: Path, build: Path, which: str, program: str = "clang-tidy") -> list[str]:
    known = compiled(build)
    paths = [path for path in chosen(root, which) if (root / path).resolve() in known]
    if not paths:
        return [f"{build} compiles none of our {which}: is it a build folder of this tree?"]
    jobs = len(os.sched_getaffinity(0))
    for path in chosen(root, which):
        if path not in paths:
            print(f"not compiled by this build, so not checked: {path}")
    try:
        with ThreadPoolExecutor(jobs) as pool, tempfile.TemporaryDirectory() as folder:
            tidy = Tidy(root, build, program, folder)
            groups = tidy.groups(paths)
            print(f"clang-tidy: {len(paths)} files of the {which} in {len(groups)} groups, {jobs} at a time", flush=True)
            results = list(pool.map(tidy, groups))
    except FileNotFoundError:
        return [f"{program} is not there; tools/check installs it"]
    slowest = max(range(len(groups)), key=lambda n: results[n][0])
    print(f"{sum(seconds for seconds, _ in results):.0f} s in all, longest that of {groups[slowest][0]}: "
          f"{results[slowest][0]:.1f} s")
    return [finding for _, findings in results for finding in findings]


if __name__ == "__main__":
    sys.exit(conclude("clang-tidy", check(Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve(), *sys.argv[3:5])))
