#!/usr/bin/env python3
"""Which lines of each layer the tests reach.

usage: coverage.py ROOT BUILD_DIR [--table FILE.csv]

BUILD_DIR is that of the preset sanitize (clang, PUFFIN_COVERAGE), in which tests/sanitize/run.py has run what is to be counted: merges
what the programs left in BUILD_DIR/profiles, and prints for each layer lines, lines reached and share, then the files below
80 %. Exits 1 if lbm, dem, micromodels or coupling stays below 90 %.
"""

import argparse
import csv
import json
import os
import subprocess
import sys
from pathlib import Path

LAYERS = ("lbm", "dem", "micromodels", "coupling", "cases", "tools")
DEMANDED = {"lbm", "dem", "micromodels", "coupling"}


def programs_of(build: Path) -> list[Path]:
    files = [*sorted((build / "tests").glob("test_*")), *sorted((build / "tests").glob("fuzz_*_replay")), build / "puffin"]
    return [file for file in files if file.is_file() and os.access(file, os.X_OK)]


def summaries(root: Path, build: Path) -> dict[Path, tuple[int, int]]:
    """Lines and lines reached of each file of ours."""
    merged = build / "profiles" / "all.profdata"
    raw = sorted(str(file) for file in (build / "profiles").glob("*.profraw"))
    subprocess.run(["llvm-profdata", "merge", "-sparse", "-o", str(merged), *raw], check=True)
    programs = programs_of(build)
    objects = [word for file in programs[1:] for word in ("-object", str(file))]
    text = subprocess.run(["llvm-cov", "export", "-summary-only", f"-instr-profile={merged}", str(programs[0]), *objects],
                          check=True, capture_output=True, text=True).stdout
    found = {}
    for entry in json.loads(text)["data"][0]["files"]:
        path = Path(os.path.normpath(entry["filename"]))
        if path.is_relative_to(root):
            lines = entry["summary"]["lines"]
            found[path.relative_to(root)] = (lines["count"], lines["covered"])
    return found


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("root", type=Path)
    parser.add_argument("build", type=Path)
    parser.add_argument("--table", type=Path)
    given = parser.parse_args()
    files = summaries(given.root.resolve(), given.build)
    rows, low = [], False
    for layer in LAYERS:
        counts = [count for path, count in files.items() if path.parts[0] == layer]
        lines, reached = sum(c[0] for c in counts), sum(c[1] for c in counts)
        share = 100.0 * reached / lines if lines else 0.0
        rows.append([layer, len(counts), lines, reached, f"{share:.1f}"])
        low = low or (layer in DEMANDED and share < 90.0)
    rows.insert(0, ["layer", "files", "lines", "reached", "percent"])
    for row in rows:
        print(*row, sep=",")
    if given.table:
        with open(given.table, "w", newline="", encoding="utf-8") as file:
            csv.writer(file, lineterminator="\n").writerows(rows)
    print("files below 80 %:")
    for path, (lines, reached) in sorted(files.items(), key=lambda item: item[1][1] - item[1][0]):
        if path.parts[0] in DEMANDED and reached < 0.8 * lines:
            print(f"{path}: {reached} of {lines}")
    return 1 if low else 0


if __name__ == "__main__":
    sys.exit(main())
