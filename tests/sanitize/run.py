#!/usr/bin/env python3
"""Runs the test programs, the corpora of the readers and a coupled run under the sanitizers they were built with; writes a row of each.

usage: run.py BUILD_DIR [--tests REGEX] [--claims FILTER] [--seconds 1800] [--table FILE.csv] [--tbb FOLDER] [--threads 4]

BUILD_DIR is that of the preset sanitize, tsan or debug. Runs what is built of test_*, fuzz_*_replay and coupled_run and whose name matches
(without REGEX, all but the programs labelled long: LONG), each for at most that time. What a sanitizer finds, in the program or
in one that it starts, is left in BUILD_DIR/reports and counted. Lines that were reached are counted for tests/coverage.py.
--claims: of these programs only the claims that this --gtest_filter names. Without it a claim of LEFT_OUT does not run, and the row says so.
--table: rows of programs that ran replace those of the same name. --tbb: folder of a libtbb.so that was itself built with
the sanitizer (build_tbb.sh). Exits 1 at a report, a failure or what took too long.
"""

import argparse
import csv
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
HEADER = ["program", "claims", "reports", "result", "left_out", "cpu_s"]
LONG = {"test_restart_l_base", "test_restart_walls", "test_determinism", "test_scalar_boundedness"}
# Claims that take too long or need what a sanitizer forbids; behind each what runs its lines instead.
LEFT_OUT: dict[str, list[str]] = {
    "test_checkpoint": ["Checkpoint.AlteredBytesAreRefusedOrHarmless"],  # stopped after 527 s with the claims before it; fuzz_checkpoint alters bytes the same way
    "test_restart": ["Restart.KilledAtRandomMomentsARunEndsAsIfNothingHadHappened"],  # stopped after 600 s; whole_runs.py resumes a run
}


def strict(build: Path, name: str) -> dict[str, str]:
    """What every sanitizer is told: end at the first finding with a code no test expects; say it in a file, as a program that a test
    starts may keep its words for itself."""
    log = f"log_path={(build / 'reports' / name).resolve()}:exitcode=66"
    return {
        "ASAN_OPTIONS": f"{log}:detect_stack_use_after_return=1",
        "UBSAN_OPTIONS": f"{log}:halt_on_error=1:print_stacktrace=1",
        "TSAN_OPTIONS": f"{log}:second_deadlock_stack=1:suppressions={HERE / 'threads.supp'}",
        # Debian's VTK is built without the sanitizer, which therefore does not see where its threads wait for each other.
        "VTK_SMP_BACKEND_IN_USE": "Sequential",
        "LLVM_PROFILE_FILE": str((build / "profiles" / f"{name}-%m.profraw").resolve()),  # %m: all that ran of a program
    }


def watched(program: Path, arguments: list[str], environment: dict, seconds: float) -> tuple[str, str, float]:
    """What it said, what came of it, processor seconds (its children too)."""
    before = os.times()
    # A fixed layout of memory: the thread sanitizer knows no other.
    with subprocess.Popen(["setarch", "--addr-no-randomize", str(program.resolve()), *arguments], env=environment,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True) as run:
        try:
            said, result = run.communicate(timeout=seconds)[0], ""
        except subprocess.TimeoutExpired:
            os.killpg(run.pid, signal.SIGKILL)
            said, result = run.communicate()[0], f"stopped after {seconds:.0f} s"
    after = os.times()
    cpu = after.children_user + after.children_system - before.children_user - before.children_system
    return said.decode(errors="replace"), result or ("passed" if run.returncode == 0 else f"exit code {run.returncode}"), cpu


def row_of(program: Path, arguments: list[str], build: Path, given: argparse.Namespace) -> list:
    name = program.name
    for old in (build / "reports").glob(f"{name}.*"):
        old.unlink()
    environment = os.environ | strict(build, name)
    if given.tbb:
        environment["LD_LIBRARY_PATH"] = str(given.tbb.resolve())
    left_out = [] if given.claims else LEFT_OUT.get(name, [])
    if name.startswith("test_") and (given.claims or left_out):
        arguments = ["--gtest_filter=" + (given.claims or "-" + ":".join(left_out))]
    begin = time.monotonic()
    said, result, cpu = watched(program, arguments, environment, given.seconds)
    reports = sorted((build / "reports").glob(f"{name}.*"))
    if result != "passed" or reports:
        print(f"{name}: {result} after {time.monotonic() - begin:.0f} s\n{said[-8000:]}")
        for report in reports:
            print(report.read_text(errors="replace")[:6000])
    claims = said.count("[       OK ]")
    skipped = len(set(re.findall(r"\[  SKIPPED \] (\S+)", said)))
    result += f"; {skipped} skip themselves" if skipped else ""
    result += f" ({given.claims})" if given.claims else ""
    return [name, claims if name.startswith("test_") else "", len(reports), result, " ".join(left_out), round(cpu)]


def programs_of(build: Path, asked: str) -> list[tuple[Path, list[str]]]:
    found = []
    for file in sorted((build / "tests").glob("*")):
        if not file.is_file() or not os.access(file, os.X_OK) or not re.search(asked, file.name):
            continue
        replay = re.fullmatch(r"fuzz_(\w+)_replay", file.name)
        if replay:
            found.append((file, [str(HERE.parent / "fuzz" / "corpus" / replay.group(1))]))
        elif file.name.startswith("test_") and (asked or file.name not in LONG):
            found.append((file, []))
    return found


def keep(table: Path, rows: list[list]) -> None:
    new = {str(row[0]): [str(value) for value in row] for row in rows}
    old = {}
    if table.exists():
        with open(table, newline="", encoding="utf-8") as file:
            old = {row[0]: row for row in list(csv.reader(file))[1:]}
    with open(table, "w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows([HEADER, *(old | new).values()])


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=Path)
    parser.add_argument("--tests", default="")
    parser.add_argument("--claims", default="")
    parser.add_argument("--seconds", type=float, default=1800.0)
    parser.add_argument("--table", type=Path)
    parser.add_argument("--tbb", type=Path)
    parser.add_argument("--threads", type=int, default=4)
    given = parser.parse_args()
    for folder in ("reports", "profiles"):
        (given.build / folder).mkdir(exist_ok=True)
    programs = programs_of(given.build, given.tests)
    coupled = given.build / "tests" / "coupled_run"
    if coupled.exists() and re.search(given.tests, coupled.name):
        programs.append((coupled, [str(given.threads)]))
    rows = []
    for program, arguments in programs:
        rows.append(row_of(program, arguments, given.build, given))
        print(*rows[-1], sep=",", flush=True)
        if given.table:
            keep(given.table, [rows[-1]])
    return 1 if not rows or any(row[2] or not row[3].startswith("passed") for row in rows) else 0


if __name__ == "__main__":
    sys.exit(main())
