#!/usr/bin/env python3
"""Which lines of each layer the tests reach.

usage: coverage.py ROOT BUILD_DIR [--label unit] [--exclude REGEX] [--jobs 2] [--table FILE.csv]

BUILD_DIR is that of the preset fuzz (clang with PUFFIN_COVERAGE, sanitizers on); the test programs to count must be built.
Runs the tests of the label with ctest, merges what each process counted, and prints for each layer lines, lines reached and
share, then the files below 80 %. Exits 1 if a test fails or lbm, dem, micromodels or coupling stays below 90 %.
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
STRICT = {"UBSAN_OPTIONS": "halt_on_error=1:print_stacktrace=1", "ASAN_OPTIONS": "detect_stack_use_after_return=1"}


def run_tests(build: Path, label: str, exclude: str, jobs: int) -> int:
    profiles = build / "profiles"
    profiles.mkdir(exist_ok=True)
    for old in profiles.glob("*.profraw"):
        old.unlink()
    command = ["ctest", "--test-dir", str(build), "-L", f"^{label}$", "-j", str(jobs), "--timeout", "1500",
               "--output-on-failure", "--no-tests=error"] + (["-E", exclude] if exclude else [])
    pattern = str(profiles.resolve() / "%4m.profraw")  # four files a program, into which its processes add up
    return subprocess.run(command, env=os.environ | STRICT | {"LLVM_PROFILE_FILE": pattern}, check=False).returncode


def summaries(root: Path, build: Path) -> dict[Path, tuple[int, int]]:
    """Lines and lines reached of each file of ours."""
    merged = build / "profiles" / "all.profdata"
    raw = sorted(str(file) for file in (build / "profiles").glob("*.profraw"))
    subprocess.run(["llvm-profdata", "merge", "-sparse", "-o", str(merged), *raw], check=True)
    programs = [file for file in (build / "tests").iterdir() if file.is_file() and os.access(file, os.X_OK)]
    objects = [word for file in programs[1:] for word in ("-object", str(file))]
    text = subprocess.run(["llvm-cov", "export", "-summary-only", f"-instr-profile={merged}", str(programs[0]), *objects],
                          check=True, capture_output=True, text=True).stdout
    found = {}
    for entry in json.loads(text)["data"][0]["files"]:
        path = Path(entry["filename"])
        if path.is_relative_to(root):
            lines = entry["summary"]["lines"]
            found[path.relative_to(root)] = (lines["count"], lines["covered"])
    return found


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("root", type=Path)
    parser.add_argument("build", type=Path)
    parser.add_argument("--label", default="unit")
    parser.add_argument("--exclude", default="")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--table", type=Path)
    given = parser.parse_args()
    failed = run_tests(given.build, given.label, given.exclude, given.jobs)
    files = summaries(given.root.resolve(), given.build)
    rows, low = [], False
    for layer in LAYERS:
        counts = [count for path, count in files.items() if path.parts[0] == layer]
        lines, reached = sum(c[0] for c in counts), sum(c[1] for c in counts)
        share = 100.0 * reached / lines if lines else 0.0
        rows.append([layer, len(counts), lines, reached, f"{share:.1f}"])
        low = low or (layer in DEMANDED and share < 90.0)
    header = ["layer", "files", "lines", "reached", "percent"]
    for row in [header, *rows]:
        print(*row, sep=",")
    if given.table:
        with open(given.table, "w", newline="", encoding="utf-8") as file:
            csv.writer(file).writerows([header, *rows])
    print("\nfiles below 80 %:")
    for path, (lines, reached) in sorted(files.items(), key=lambda item: item[1][1] - item[1][0]):
        if path.parts[0] in DEMANDED and reached < 0.8 * lines:
            print(f"{path}: {reached} of {lines}")
    return 1 if failed or low else 0


if __name__ == "__main__":
    sys.exit(main())
