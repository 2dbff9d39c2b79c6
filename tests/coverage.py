#!/usr/bin/env python3
"""Which lines of each layer the tests reach, under the sanitizers for addresses and undefined behaviour.

usage: coverage.py ROOT BUILD_DIR [--seconds 600] [--jobs 2] [--table FILE.csv] [--tests FILE.csv]

BUILD_DIR is that of the preset coverage or fuzz (clang with PUFFIN_COVERAGE, sanitizers on). Runs every test program that is built there,
each for at most that time, merges what they counted, and prints for each layer lines, lines reached and share, then the files
below 80 %. Exits 1 if a program fails or lbm, dem, micromodels or coupling stays below 90 %.
"""

import argparse
import csv
import json
import os
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

LAYERS = ("lbm", "dem", "micromodels", "coupling", "cases", "tools")
DEMANDED = {"lbm", "dem", "micromodels", "coupling"}
STRICT = {"UBSAN_OPTIONS": "halt_on_error=1:print_stacktrace=1", "ASAN_OPTIONS": "detect_stack_use_after_return=1"}


def programs_of(build: Path) -> list[Path]:
    return sorted(file for file in (build / "tests").glob("test_*") if file.is_file() and os.access(file, os.X_OK))


def run_test(program: Path, profiles: Path, seconds: float) -> list:
    """Name, what came of it, claims that held, seconds."""
    environment = os.environ | STRICT | {"LLVM_PROFILE_FILE": str(profiles / f"{program.name}.profraw")}
    begin = time.monotonic()
    try:
        run = subprocess.run([str(program.resolve())], env=environment, capture_output=True, text=True, timeout=seconds,
                             check=False, errors="replace")
    except subprocess.TimeoutExpired:
        return [program.name, "too long", 0, round(time.monotonic() - begin)]
    result = "passed" if run.returncode == 0 else f"exit code {run.returncode}"
    if run.returncode != 0:
        print(f"{program.name}:\n{run.stdout[-3000:]}\n{run.stderr[-6000:]}")
    return [program.name, result, run.stdout.count("[       OK ]"), round(time.monotonic() - begin)]


def run_tests(build: Path, seconds: float, jobs: int) -> list[list]:
    profiles = (build / "profiles").resolve()
    profiles.mkdir(exist_ok=True)
    for old in profiles.glob("*.profraw"):
        old.unlink()
    with ThreadPoolExecutor(jobs) as pool:
        return list(pool.map(lambda program: run_test(program, profiles, seconds), programs_of(build)))


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


def write(table: Path | None, rows: list[list]) -> None:
    """Prints it too."""
    for row in rows:
        print(*row, sep=",")
    print()
    if table:
        with open(table, "w", newline="", encoding="utf-8") as file:
            csv.writer(file, lineterminator="\n").writerows(rows)


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("root", type=Path)
    parser.add_argument("build", type=Path)
    parser.add_argument("--seconds", type=float, default=600.0)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--table", type=Path)
    parser.add_argument("--tests", type=Path)
    given = parser.parse_args()
    tests = run_tests(given.build, given.seconds, given.jobs)
    write(given.tests, [["program", "result", "claims", "seconds"], *tests])
    files = summaries(given.root.resolve(), given.build)
    rows, low = [], False
    for layer in LAYERS:
        counts = [count for path, count in files.items() if path.parts[0] == layer]
        lines, reached = sum(c[0] for c in counts), sum(c[1] for c in counts)
        share = 100.0 * reached / lines if lines else 0.0
        rows.append([layer, len(counts), lines, reached, f"{share:.1f}"])
        low = low or (layer in DEMANDED and share < 90.0)
    header = ["layer", "files", "lines", "reached", "percent"]
    write(given.table, [header, *rows])
    print("files below 80 %:")
    for path, (lines, reached) in sorted(files.items(), key=lambda item: item[1][1] - item[1][0]):
        if path.parts[0] in DEMANDED and reached < 0.8 * lines:
            print(f"{path}: {reached} of {lines}")
    return 1 if low or any(result != "passed" for _, result, _, _ in tests) else 0


if __name__ == "__main__":
    sys.exit(main())
