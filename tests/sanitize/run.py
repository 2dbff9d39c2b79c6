#!/usr/bin/env python3
"""Runs test programs and a coupled run that were built with a sanitizer, and writes a row of what came of each.

usage: run.py BUILD_DIR [--tests REGEX] [--tbb FOLDER] [--threads 4] [--seconds 900] [--table FILE.csv]

BUILD_DIR is that of the preset tsan, debug or fuzz. Runs every test_* in BUILD_DIR/tests whose name matches, on as many
threads as there are processors, then coupled_run on THREADS. --tbb: folder of a libtbb.so that was itself built with the
sanitizer (build_tbb.sh). What a sanitizer found stands in what a program said. Exits 1 if anything failed.
"""

import argparse
import csv
import os
import re
import subprocess
import sys
import time
from pathlib import Path

STRICT = {
    "TSAN_OPTIONS": f"exitcode=66:second_deadlock_stack=1:suppressions={Path(__file__).with_name('threads.supp')}",
    "UBSAN_OPTIONS": "halt_on_error=1:print_stacktrace=1",
    "ASAN_OPTIONS": "detect_stack_use_after_return=1",
}
REPORT = re.compile(r"(WARNING: ThreadSanitizer|ERROR: AddressSanitizer|ERROR: LeakSanitizer|runtime error:).*")


def watched(program: Path, arguments: list[str], environment: dict, seconds: float) -> list:
    """Name, claims that held, reports of the sanitizer, exit code, processor seconds."""
    before, begin = os.times(), time.monotonic()
    try:
        # A fixed layout of memory: the thread sanitizer knows no other.
        run = subprocess.run(["setarch", "--addr-no-randomize", str(program.resolve()), *arguments], env=environment,
                             capture_output=True, text=True, timeout=seconds, check=False, errors="replace")
        said, code = run.stdout + run.stderr, run.returncode
    except subprocess.TimeoutExpired as late:
        said, code = (late.stdout or b"").decode(errors="replace"), f"too long ({time.monotonic() - begin:.0f} s)"
    after = os.times()
    reports = [found.group(0) for found in REPORT.finditer(said)]
    if code != 0 or reports:
        print(f"{program.name}: exit code {code}\n{said[-8000:]}")
    cpu = after.children_user + after.children_system - before.children_user - before.children_system
    return [program.name, said.count("[       OK ]"), len(reports), code, round(cpu)]


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=Path)
    parser.add_argument("--tests", default="")
    parser.add_argument("--tbb", type=Path)
    parser.add_argument("--threads", type=int, default=4)
    parser.add_argument("--seconds", type=float, default=900.0)
    parser.add_argument("--table", type=Path)
    given = parser.parse_args()
    environment = os.environ | STRICT | {"LLVM_PROFILE_FILE": os.devnull}
    if given.tbb:
        environment["LD_LIBRARY_PATH"] = str(given.tbb.resolve())
    programs = [(file, []) for file in sorted((given.build / "tests").glob("test_*"))
                if file.is_file() and os.access(file, os.X_OK) and re.search(given.tests, file.name)]
    coupled = given.build / "tests" / "coupled_run"
    if coupled.exists():
        programs.append((coupled, [str(given.threads)]))
    rows = []
    for program, arguments in programs:
        rows.append(watched(program, arguments, environment, given.seconds))
        print(*rows[-1], sep=",", flush=True)
    if given.table:
        with open(given.table, "w", newline="", encoding="utf-8") as file:
            csv.writer(file, lineterminator="\n").writerows(
                [["program", "claims", "reports", "exit_code", "cpu_s"], *rows])
    return 1 if not rows or any(row[2] or row[3] != 0 for row in rows) else 0


if __name__ == "__main__":
    sys.exit(main())
