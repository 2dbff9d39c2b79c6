#!/usr/bin/env python3
"""Looks for inputs that break a reader, for a given processor time, and writes a row of what came of it.

usage: search.py BUILD_DIR NAME [CPU_SECONDS] [--table FILE.csv]      (600 s)

BUILD_DIR is that of the preset sanitize with the target fuzz_NAME built. libFuzzer counts the wall clock; here its processor time
is measured, and it is started again until that is enough. What is new goes to BUILD_DIR/found/NAME. Exits 1 at a finding,
whose input lies there as crash-..., timeout-... or oom-....
"""

import argparse
import csv
import os
import re
import resource
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
LONGEST = {"stl": 20000, "case": 8000, "micromodels": 4000, "study": 4000, "table": 4000, "checkpoint": 70000}  # [byte]
TIMEOUT = 200  # [s] an input
TIMED_OUT = 70  # libFuzzer's exit code then
STRICT = {"UBSAN_OPTIONS": "halt_on_error=1:print_stacktrace=1", "LLVM_PROFILE_FILE": os.devnull}


def part(program: Path, found: Path, corpus: Path, longest: int, seconds: float) -> tuple[float, str, int]:
    """One run of libFuzzer: processor time [s], what it printed, exit code."""
    with open(found / "log", "w+", encoding="utf-8", errors="replace") as log:
        child = subprocess.Popen(
            [str(program), f"-max_total_time={max(20, round(seconds))}", f"-timeout={TIMEOUT}", "-rss_limit_mb=2048",
             f"-max_len={longest}", "-print_final_stats=1", f"-artifact_prefix={found}/", str(found / "corpus"),
             str(corpus)],
            stdout=log, stderr=subprocess.STDOUT, env=os.environ | STRICT)
        _, status, usage = os.wait4(child.pid, 0)
        log.seek(0)
        return usage.ru_utime + usage.ru_stime, log.read(), os.waitstatus_to_exitcode(status)


def seconds_of(program: Path, input_file: Path, most: int) -> float:
    """Processor time that one input takes [s]; it is ended at `most`."""
    child = subprocess.Popen([str(program), str(input_file)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                             env=os.environ | STRICT,
                             preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (most, most)))
    usage = os.wait4(child.pid, 0)[2]
    return usage.ru_utime + usage.ru_stime


def only_waited(program: Path, found: Path) -> bool:
    """libFuzzer's timeout goes by the wall clock: takes away the inputs that lay still with the whole process, on a machine that had other
    work. True if no other finding is left."""
    for late in found.glob("timeout-*"):
        if seconds_of(program, late, TIMEOUT) < 0.5 * TIMEOUT:
            late.unlink()
    return not any(path.name.startswith(("timeout-", "crash-", "oom-", "leak-")) for path in found.iterdir())


def last(pattern: str, text: str) -> int:
    values = re.findall(pattern, text)
    return int(values[-1]) if values else 0


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=Path)
    parser.add_argument("name", choices=sorted(LONGEST))
    parser.add_argument("seconds", type=float, nargs="?", default=600.0)
    parser.add_argument("--table", type=Path)
    given = parser.parse_args()
    found = given.build / "found" / given.name
    (found / "corpus").mkdir(parents=True, exist_ok=True)
    cpu, executions, edges, corpus, code = 0.0, 0, 0, 0, 0
    program = given.build / "tests" / f"fuzz_{given.name}"
    while cpu < given.seconds and code == 0:
        used, log, code = part(program, found, HERE / "corpus" / given.name, LONGEST[given.name], given.seconds - cpu)
        if code == TIMED_OUT and only_waited(program, found):
            code = 0
        cpu += used
        executions += last(r"stat::number_of_executed_units:\s*(\d+)", log)
        edges, corpus = last(r"cov: (\d+)", log), last(r"corp: (\d+)", log)
    row = [given.name, round(cpu, 1), executions, edges, corpus, "none" if code == 0 else f"exit code {code}"]
    if given.table:
        new = not given.table.exists()
        with open(given.table, "a", newline="", encoding="utf-8") as file:
            table = csv.writer(file, lineterminator="\n")
            if new:
                table.writerow(["target", "cpu_s", "executions", "edges", "corpus", "findings"])
            table.writerow(row)
    print(*row, sep=",")
    return 1 if code else 0


if __name__ == "__main__":
    sys.exit(main())
