#!/usr/bin/python3
"""An hour of a coupled run: memory constant, fines' ledger closed, mass of the air kept.

usage: soak.py PROGRAM OUT [MINUTES]        needs python3-vtk9 of Debian; writes OUT.csv, OUT.txt and the run OUT

Runs soak.toml on one thread for MINUTES (60) of wall clock and looks at the process each minute. Exits 1 if
  the resident memory of the last half exceeds that after the first quarter, its warm-up, by more than 5 %,
  a ledger is off by more than 1e-12 of the dose,
  the mass of the air has moved by more than 1e-6 of itself,
  or the run ended other than by its wall time (exit code 75).
"""

import csv
import json
import subprocess
import sys
import time
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy
import vtk
from vtk.util.numpy_support import vtk_to_numpy

RHO, LID, LATTICE_SPEED = 1.204, 10.0, 0.1  # of soak.toml
SOUND2 = (LID / LATTICE_SPEED) ** 2 / 3.0  # [m^2/s^2] p = c_s^2 (rho - rho0)


def resident(process: int) -> float:
    """[MB]"""
    for line in Path(f"/proc/{process}/status").read_text().splitlines():
        if line.startswith("VmRSS:"):
            return int(line.split()[1]) / 1024.0
    return float("nan")


def cpu_seconds(process: int) -> float:
    fields = Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / 100.0


def history(run: Path) -> list[dict]:
    """Whole rows alone: the last line may be in the making, or the first."""
    file = run / "history.csv"
    return list(csv.DictReader(file.read_text().split("\n")[:-1])) if file.exists() else []


def masses(run: Path) -> list[tuple[float, float]]:
    """Time and relative excess of the air's mass, from the pressure in every cell."""
    found = []
    for entry in ElementTree.parse(run / "vtk/fields.pvd").getroot().iter("DataSet"):
        reader = vtk.vtkXMLImageDataReader()
        reader.SetFileName(str(run / "vtk" / entry.get("file")))
        reader.Update()
        cells = reader.GetOutput().GetCellData()
        pressure = vtk_to_numpy(cells.GetArray("pressure")).astype(float)
        air = vtk_to_numpy(cells.GetArray("fluid")) == 1
        found.append((float(entry.get("timestep")), float(numpy.mean(pressure[air]) / SOUND2 / RHO)))
    return found


def watch(program: str, run: Path, minutes: float) -> tuple[int, list[list[float]]]:
    child = subprocess.Popen([program, "run", str(Path(__file__).with_name("soak.toml")), "--out", str(run), "--quiet",
                              "--threads", "1", "--walltime", f"{minutes * 60:.0f} s", "--no-report"])
    begin, rows = time.monotonic(), []
    with open(f"{run}.csv", "w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["minute", "resident_MB", "cpu_s", "simulated_s", "in_air", "ledger_error"])
        while child.poll() is None:
            time.sleep(max(0.0, begin + 60.0 * (len(rows) + 1) - time.monotonic()))
            if child.poll() is not None:
                break
            last = (history(run) or [{"time": "0", "in_air": "nan", "ledger_error": "nan"}])[-1]
            rows.append([len(rows) + 1, round(resident(child.pid), 2), cpu_seconds(child.pid), float(last["time"]),
                         float(last["in_air"]), float(last["ledger_error"])])
            table.writerow(rows[-1])
            file.flush()
    return child.returncode, rows


def main(program: str, out: str, minutes: str = "60") -> int:
    run = Path(out)
    code, rows = watch(program, run, float(minutes))
    memory = [row[1] for row in rows]
    start, late = memory[len(memory) // 4], max(memory[len(memory) // 2:])
    ledger = max(abs(float(row["ledger_error"])) for row in history(run))
    mass = masses(run)
    drift = max(abs(m - mass[0][1]) for _, m in mass)
    claims = [
        (code == 75, f"exit code {code} (75: its wall time was over)"),
        (late <= 1.05 * start, f"resident memory {start:.1f} MB after a quarter, at most {late:.1f} MB in the last half"),
        (ledger <= 1e-12, f"largest ledger error {ledger:.3g} of the dose, of {len(history(run))} rows"),
        (drift <= 1e-6, f"mass of the air moved by at most {drift:.3g} of itself, {len(mass)} fields to "
                        f"{mass[-1][0]:.3g} s"),
    ]
    text = "".join(f"{'ok  ' if good else 'FAIL'}  {line}\n" for good, line in claims)
    air = json.loads((run / "summary.json").read_text())["air_mass"]
    text += (f"rounding took {air['lost']:.3g} of the air's mass; {air['returned']:.3g} were given back in "
             f"{air['corrections']} corrections\n")
    text += f"{rows[-1][0]} minutes, {rows[-1][2]:.0f} CPU-s, {rows[-1][3]:.4g} s simulated\n"
    Path(f"{out}.txt").write_text(text)
    print(text, end="")
    return 0 if all(good for good, _ in claims) else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
