#!/usr/bin/env python3
"""Runs small scenes of the air with known answers and writes a table.

    tests/scenes/run.py --puffin build/release/puffin [--only WORD] [--work DIR] [--out TABLE.csv]

Exit code 1 if a number is out of its tolerance or a run fails.
"""
import argparse
import csv
import os
import shutil
import subprocess
import sys
import tempfile
import traceback

sys.dont_write_bytecode = True  # no __pycache__ in the tree
import scene  # noqa: E402
import channels  # noqa: F401  each of these adds its scenes to scene.SCENES
import ducts  # noqa: F401
import forces  # noqa: F401
import openings  # noqa: F401
import transients  # noqa: F401


def judge(expected, got, tolerance):
    error = got - expected if expected == 0 else got / expected - 1
    return error, "ok" if abs(error) <= tolerance else "OUT"


def write(path, table):
    """The table so far."""
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["scene", "quantity", "expected", "got", "error", "tolerance", "verdict", "seconds"])
        writer.writerows(table)


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--puffin", default="build/release/puffin")
    options.add_argument("--only", default="",
        help="scenes whose names have one of these words in them (comma between)")
    options.add_argument("--work", help="keeps the runs here")
    options.add_argument("--out", help="the table")
    chosen = options.parse_args()
    program = os.path.abspath(chosen.puffin)
    work = chosen.work or tempfile.mkdtemp(prefix="air-scenes-")
    commit = subprocess.run([program, "version"], capture_output=True, text=True).stdout.split("\n")[0]
    table, bad = [], 0
    for function in scene.SCENES:
        name = function.__name__.replace("_", "-")
        if not any(word in name for word in chosen.only.split(",")):
            continue
        folder = os.path.join(work, name)
        shutil.rmtree(folder, ignore_errors=True)
        bench = scene.Bench(program, folder)
        try:
            rows = [(q, e, g, *judge(e, g, t), t) for q, e, g, t in function(bench)]
        except Exception as failure:  # a scene that fails is a row, the others go on
            traceback.print_exc()
            rows = [(f"failed: {failure}".split("\n")[0], 0, 0, 0, "FAILED", 0)]
        for quantity, expected, got, error, verdict, tolerance in rows:
            bad += verdict != "ok"
            print(f"{name:28} {quantity:62} {expected:12.6g} {got:12.6g} {error:10.2g} {verdict}", flush=True)
            table.append([name, quantity, f"{expected:.6g}", f"{got:.6g}", f"{error:.2g}", f"{tolerance:g}", verdict,
                          f"{bench.seconds:.1f}"])
        if chosen.out:
            write(chosen.out, table)
    print(f"{commit}: {len(table)} numbers, {bad} out of tolerance", file=sys.stderr)
    if not chosen.work:
        shutil.rmtree(work, ignore_errors=True)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
