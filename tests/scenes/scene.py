"""What a scene is: a case file, its run, and rows of expected and computed numbers.

A scene is a function with the mark @scene that takes a Bench, runs one or several cases and yields rows
(quantity, expected, got, tolerance). Errors are relative, but absolute where the expected value is 0.
Lengths in metres, everything SI. Only Python's standard library.
"""
import csv
import json
import subprocess
import time
from pathlib import Path

RHO, MU = 1.204, 1.82e-5  # the air of every scene [kg/m^3, Pa s]
NU = MU / RHO
SCENES = []


def scene(function):
    SCENES.append(function)
    return function


def toml(value):
    """A Python value as TOML."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value)
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(toml(v) for v in value) + "]"
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{json.dumps(k)} = {toml(v)}" for k, v in value.items()) + " }"
    return repr(float(value)) if isinstance(value, float) else str(value)


class Run:
    """A finished run and its tables."""

    def __init__(self, folder, code, log, seconds):
        self.folder, self.code, self.log, self.seconds = Path(folder), code, log, seconds
        summary = self.folder / "summary.json"
        self.summary = json.loads(summary.read_text()) if summary.exists() else {}

    def rows(self, table, **where):
        """Rows of a CSV table; words stay words, the rest become numbers."""
        def number(text):
            try:
                return float(text)
            except ValueError:
                return text
        with open(self.folder / f"{table}.csv") as file:
            rows = [{k: number(v) for k, v in row.items()} for row in csv.DictReader(file)]
        return [r for r in rows if all(r[k] == v for k, v in where.items())]

    def last(self, table, **where):
        return self.rows(table, **where)[-1]

    def line(self, name):
        return self.rows("lines", line=name)

    def flow(self, plane):
        return self.last("planes", plane=plane)["flow_rate"]

    def force(self, patch):
        row = self.last("forces", patch=patch)
        return [row["fx"], row["fy"], row["fz"]]


class Bench:
    """Runs cases, one at a time, and keeps what they took."""

    def __init__(self, program, folder):
        self.program, self.folder, self.seconds, self.runs = program, Path(folder), 0.0, 0

    def run(self, geometry, air, boundaries, numerics, stop, output, files=None, patches=(), extra=()):
        """Writes the case and runs it. `boundaries`: patch -> table; the others are tables of the case file."""
        self.runs += 1
        work = self.folder / f"run-{self.runs}"
        work.mkdir(parents=True)
        for name, text in (files or {}).items():
            (work / name).write_bytes(text if isinstance(text, bytes) else text.encode())
        lines = ["schema = 1", f'name = "{self.folder.name}"', "[geometry]"]
        nested = {k: v for k, v in geometry.items() if isinstance(v, dict)}
        lines += [f"{k} = {toml(v)}" for k, v in geometry.items() if k not in nested]
        for key, table in nested.items():
            lines += [f"[geometry.{key}]"] + [f"{k} = {toml(v)}" for k, v in table.items()]
        for name, select in patches:
            lines += ["[[geometry.patch]]", f"name = {toml(name)}", f"select = {toml(select)}"]
        lines += ["[air]", 'model = "lbm"', f"density = {RHO}", f"viscosity = {MU}"]
        lines += [f"{k} = {toml(v)}" for k, v in air.items()]
        for patch, table in boundaries.items():
            lines += ["[[air.boundary]]", f"patch = {toml(patch)}"] + [f"{k} = {toml(v)}" for k, v in table.items()]
        for head, table in (("numerics", numerics), ("stop", {"time": stop}), ("output", output)):
            lines += [f"[{head}]"] + [f"{k} = {toml(v)}" for k, v in table.items()]
        (work / "case.toml").write_text("\n".join(lines) + "\n")
        start = time.time()
        done = subprocess.run([self.program, "run", "case.toml", "--threads", "1", "--out", "out", *extra], cwd=work,
                              capture_output=True, text=True)
        took = time.time() - start
        self.seconds += took
        (work / "stderr.txt").write_text(done.stderr)
        if done.returncode != 0 and not extra:
            tail = "\n".join(done.stderr.strip().splitlines()[-6:])
            raise RuntimeError(f"{work}: exit code {done.returncode}\n{tail}")
        return Run(work / "out", done.returncode, done.stderr, took)


def periodic(*axes):
    """Boundaries that join the two faces of a box along each axis."""
    return {f"{a}-min": {"type": "periodic", "with": f"{a}-max"} for a in axes}


def walls(*faces):
    return {f: {"type": "wall"} for f in faces}


def box(x, y, z):
    return {"generator": "box", "box": {"x": x, "y": y, "z": z}}


def worst(pairs, scale):
    """The largest difference of (expected, got) over a scale."""
    return max(abs(a - b) for a, b in pairs) / scale
