#!/usr/bin/env python3
"""Whole runs of the program that was built with a sanitizer: case file, threads, tables, HDF5, VTK, checkpoints, restart, report.

usage: whole_runs.py BUILD_DIR [--only NAME] [--threads 4] [--table FILE.csv] [--tbb FOLDER]

l_base   the 25,000 carriers of L-Base in parcels of ten on coarse cells, hit within 2 ms, with fines; stopped at 1.5 ms, taken up at its
         checkpoint on another number of threads, and reported on
dry      800 carriers of all sizes that fall into a bed, without air

Demands the exit code 0 of each and no report of the sanitizer; rows go to the table as those of run.py do. Exits 1 otherwise.
"""

import argparse
import os
import shutil
import sys
import tempfile
from pathlib import Path

from run import keep, strict, watched

ROOT = Path(__file__).resolve().parents[2]

L_BASE = f"""base = "{ROOT}/cases/l-base/case.toml"
name = "L-Base, hurried"
[[air.boundary]]
patch = "inlet"
type = "velocity-inlet"
flow_rate = [["0 s", "0 L/min"], ["2 ms", "40 L/min"]]
[[air.boundary]]
patch = "outlet"
type = "pressure-outlet"
[numerics]
dx = "0.7 mm"
[output]
statistics = "0.1 ms"
carriers = "0.5 ms"
checkpoint = {{ wall = "10 s", keep = 2 }}
fields = [{{ what = ["velocity", "pressure", "fines"], region = "all", every = "1 ms" }},
          {{ what = ["velocity", "fines"], region = "slice:y=0", every = "0.5 ms" }}]
[stop]
time = "3 ms"
"""

DRY = """schema = 1
name = "dry"
geometry = { generator = "box", box = { x = "4 mm", y = "4 mm", z = "6 mm" } }
air = { model = "none" }
stop = { time = "30 ms" }
output = { statistics = "1 ms", carriers = "4 ms" }
[carriers]
count = 800
diameter = { law = "log-normal", median = "150 um", sigma = 0.2, by = "number" }
density = "1520 kg/m^3"
gravity = [0.0, 0.0, -9.81]
fill = { shape = "cylinder", at = [2e-3, 2e-3, 0.5e-3], gap = 0.2 }
contact = { model = "linear", restitution = 0.6, friction = 0.3 }
"""


def parts_of(name: str, case: Path, out: Path, threads: int) -> list[list[str]]:
    run = ["run", str(case), "--out", str(out)]
    if name == "dry":
        return [[*run, "--threads", str(threads)]]
    return [[*run, "--threads", str(threads), "--until", "1.5ms"], [*run, "--threads", str(max(2, threads // 2)), "--resume"]]


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=Path)
    parser.add_argument("--only", choices=("l_base", "dry"))
    parser.add_argument("--threads", type=int, default=4)
    parser.add_argument("--table", type=Path)
    parser.add_argument("--tbb", type=Path)
    given = parser.parse_args()
    for folder in ("reports", "profiles"):
        (given.build / folder).mkdir(exist_ok=True)
    failed = False
    for name, text in (("l_base", L_BASE), ("dry", DRY)):
        if given.only not in (None, name):
            continue
        environment = os.environ | strict(given.build, f"puffin_{name}")
        if given.tbb:
            environment["LD_LIBRARY_PATH"] = str(given.tbb.resolve())
        for old in (given.build / "reports").glob(f"puffin_{name}.*"):
            old.unlink()
        folder = Path(tempfile.mkdtemp())
        (folder / "case.toml").write_text(text)
        cpu, result = 0.0, "passed"
        for arguments in parts_of(name, folder / "case.toml", folder / "out", given.threads):
            said, came, used = watched(given.build / "puffin", arguments, environment, 3600.0)
            cpu += used
            if came != "passed":
                print(f"puffin {' '.join(arguments)}: {came}\n{said[-4000:]}")
                result = came
                break
        reports = sorted((given.build / "reports").glob(f"puffin_{name}.*"))
        for report in reports:
            print(report.read_text(errors="replace")[:6000])
        if result == "passed":
            shutil.rmtree(folder)
        else:
            print(f"left in {folder}")
        row = [f"puffin run ({name})", "", len(reports), result, "", round(cpu)]
        print(*row, sep=",", flush=True)
        if given.table:
            keep(given.table, [row])
        failed = failed or result != "passed" or bool(reports)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
