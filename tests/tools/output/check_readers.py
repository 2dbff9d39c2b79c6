#!/usr/bin/python3
"""Everything that a run writes opens in programs that are not ours, and holds what docs/formats.md says.

usage: check_readers.py PROGRAM        needs python3-vtk9, python3-h5py and hdf5-tools of Debian

Runs a small case with every output switched on, then reads the CSV files with csv, the JSON files with a strict json,
the HDF5 files with h5py and h5dump, the VTK series with VTK's readers.
"""

import csv
import json
import math
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import h5py
import vtk

CASE = """
schema = 1
name = "everything"
[geometry]
generator = "duct"
[geometry.duct]
length = "6 mm"
width = "2 mm"
height = "2 mm"
[air]
density = "1.204 kg/m^3"
viscosity = "1.82e-5 Pa s"
[[air.boundary]]
patch = "inlet"
type = "velocity-inlet"
flow_rate = [["0 s", "1 L/min"], ["2 ms", "4 L/min"]]
[[air.boundary]]
patch = "outlet"
type = "pressure-outlet"
[numerics]
dx = "0.25 mm"
[carriers]
diameter = "70 um"
density = "1520 kg/m^3"
fines_each = 2000
gravity = [0.0, 0.0, -9.81]
list = [
  { position = [1e-3, 1e-3, 36e-6], velocity = [0.5, 0, -1], spin = [10, 0, 0], diameter = 7e-5, density = 1520 },
  { position = [3e-3, 1e-3, 1e-3], velocity = [-1, 0, 0], spin = [0, 0, 0], diameter = 7e-5, density = 1520 },
  { position = [2.8e-3, 1.01e-3, 1e-3], velocity = [2, 0, 0], spin = [0, 0, 0], diameter = 7e-5, density = 1520 },
]
[carriers.contact]
restitution = 0.6
friction = 0.3
[carriers.adhesion]
model = "hamaker"
surface_energy = "3.6e-3 J/m^2"
[fines]
micromodels = "lactose-3.6e-3.toml"
[[fines.scalar]]
name = "drug"
diffusion = "1e-6 kg/(m s)"
[stop]
time = "1 ms"
[output]
statistics = "0.1 ms"
carriers = "0.2 ms"
fields = [{ what = ["velocity", "pressure", "fines"], region = "all", every = "0.5 ms" }]
probe = [{ name = "p, with a comma", at = [3e-3, 1e-3, 1e-3] }]
line = [{ name = "l", from = [3e-3, 0.0, 1e-3], to = [3e-3, 2e-3, 1e-3], points = 5 }]
plane = [{ name = "x", normal = "x", at = 3e-3 }]
force = ["wall"]
"""

COLUMNS = {
    "history.csv": "time,dt,flow_rate,static_drop,total_to_static_drop,carriers_in,carriers_emitted,carriers_asleep,"
                   "FFE,FFW,FFCR,FFCE,in_air,ledger_error",
    "probes.csv": "time,probe,u,v,w,p",
    "lines.csv": "line,s,x,y,z,u,v,w,p,samples",
    "planes.csv": "time,plane,flow_rate,static_pressure,total_pressure",
    "forces.csv": "time,patch,fx,fy,fz",
    "tracks.csv": "time,id,x,y,z,u,v,w,wx,wy,wz",
    "summary.csv": "quantity,value",
}
TEXT_COLUMNS = {"probe", "line", "plane", "patch", "quantity", "value"}
EVENTS = ["time_start", "time_end", "a", "b", "triangle", "normal_speed", "tangential_speed", "energy", "max_force",
          "max_overlap", "detached", "attached"]
ARRAYS = {"fields": {"velocity", "pressure", "fines_drug"},
          "carriers": {"id", "diameter", "velocity", "spin", "fines", "asleep"},
          "walls": {"fines", "hits", "energy", "patch"}}

faults: list[str] = []


def expect(holds: bool, what: str) -> None:
    if not holds:
        faults.append(what)


def check_csv(run: Path) -> None:
    expect({f.name for f in run.glob("*.csv")} == set(COLUMNS), f"CSV files: {sorted(f.name for f in run.glob('*.csv'))}")
    for name, columns in COLUMNS.items():
        with open(run / name, newline="") as stream:
            rows = list(csv.DictReader(stream, strict=True))
            stream.seek(0)
            expect(stream.readline().rstrip("\r\n") == columns, f"{name}: columns")
        expect(len(rows) > 0, f"{name}: no rows")
        for row in rows:
            for key, value in row.items():
                if key not in TEXT_COLUMNS:
                    expect(math.isfinite(float(value)) or name == "planes.csv", f"{name}: {key} = {value}")
    with open(run / "probes.csv", newline="") as stream:
        expect(next(csv.DictReader(stream))["probe"] == "p, with a comma", "probes.csv: quoting")
    with open(run / "summary.csv", newline="") as stream:
        table = {row["quantity"]: row["value"] for row in csv.DictReader(stream)}
    summary = json.loads((run / "summary.json").read_text())
    expect(table["name"] == summary["name"] and table["format"] == "1", "summary.csv: not the values of summary.json")


def check_json(run: Path) -> None:
    def refuse(word: str):
        raise ValueError(word + " is no JSON")

    for name in ("summary.json", "status.json"):
        value = json.loads((run / name).read_text(), parse_constant=refuse)
        expect(value["format"] == 1, f"{name}: format")


def check_hdf5(run: Path) -> None:
    for name, format_name in (("stats.h5", "puffin-stats"), ("events.h5", "puffin-events")):
        with h5py.File(run / name, "r") as file:
            expect(file.attrs["format"] == format_name.encode() or file.attrs["format"] == format_name, f"{name}: format")
            expect(int(file.attrs["format_version"]) == 1, f"{name}: format_version")
        dumped = subprocess.run(["h5dump", str(run / name)], capture_output=True, text=True, check=False)
        expect(dumped.returncode == 0 and "error" not in dumped.stderr, f"h5dump {name}: {dumped.stderr}")
    with h5py.File(run / "events.h5", "r") as file:
        events = file["events"]
        expect([n for n in EVENTS if n not in events.dtype.names] == [], f"events: {events.dtype.names}")
        expect(len(events) > 0, "events: none, though a carrier hits the floor")
        expect(bool((events["time_end"] >= events["time_start"]).all()), "events: end before start")
    with h5py.File(run / "stats.h5", "r") as file, open(run / "history.csv", newline="") as stream:
        rows = list(csv.DictReader(stream))
        times = file["history/time"][:]
        expect(len(times) == len(rows), "stats.h5 and history.csv differ in length")
        expect(all(float(r["time"]) == t for r, t in zip(rows, times)), "stats.h5 and history.csv differ in time")
        for name, dataset in file["history"].items():
            expect("unit" in dataset.attrs and len(dataset) == len(times), f"stats.h5: {name}")


def check_vtk(run: Path) -> None:
    for series, arrays in ARRAYS.items():
        frames = ElementTree.parse(run / "vtk" / f"{series}.pvd").getroot().findall("./Collection/DataSet")
        expect(len(frames) > 0, f"{series}.pvd: empty")
        for frame in frames:
            path = run / "vtk" / frame.attrib["file"]
            float(frame.attrib["timestep"])
            reader = vtk.vtkXMLImageDataReader() if path.suffix == ".vti" else vtk.vtkXMLPolyDataReader()
            reader.SetFileName(str(path))
            expect(reader.CanReadFile(str(path)) == 1, f"{path.name}: VTK cannot read it")
            reader.Update()
            data = reader.GetOutput()
            attributes = data.GetPointData() if series == "carriers" else data.GetCellData()
            names = {attributes.GetArrayName(i) for i in range(attributes.GetNumberOfArrays())}
            expect(arrays <= names, f"{path.name}: lacks {arrays - names}")
            version = data.GetFieldData().GetArray("puffin_format")
            expect(version is not None and version.GetTuple1(0) == 1, f"{path.name}: puffin_format")


def main() -> int:
    with tempfile.TemporaryDirectory() as folder:
        case, run = Path(folder) / "case.toml", Path(folder) / "run"
        case.write_text(CASE)
        done = subprocess.run([sys.argv[1], "run", str(case), "--out", str(run), "--quiet"], capture_output=True, text=True,
                              check=False)
        if done.returncode != 0:
            print(done.stderr)
            return 1
        for check in (check_csv, check_json, check_hdf5, check_vtk):
            check(run)
    for fault in faults:
        print(fault)
    print(f"{len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
