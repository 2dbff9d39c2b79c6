"""Forces on walls and obstacles by the balance of momentum, hydrostatics, drag in slow flow; places of samplers."""
import math

from channels import AXES, DX, H, vector
from scene import MU, RHO, box, periodic, scene, walls


@scene
def hydrostatic(bench):
    """A closed box under a body force: pressure linear, air at rest, the walls carry the weight."""
    size, force = 1e-3, 50.0
    for i, axis in enumerate(AXES):
        faces = [f"{a}-{e}" for a in AXES for e in ("min", "max")]

        def at(s):
            return [s if a == axis else size / 2 for a in AXES]
        run = bench.run(box(size, size, size), {"body_force": vector(axis, -force)}, walls(*faces), {"dx": size / 12,
            "reference_speed": 0.2}, 0.1,
                        {"statistics": 0.05, "probe": [{"name": "low", "at": at(0.2 * size)}, {"name": "high",
                        "at": at(0.8 * size)}], "force": faces})
        low, high = run.last("probes", probe="low"), run.last("probes", probe="high")
        yield f"along {axis}: pressure difference", force * 0.6 * size, low["p"] - high["p"], 0.01
        yield (f"along {axis}: speed over sqrt(2 F L/rho)", 0, max(abs(low[c])
            for c in "uvw") / math.sqrt(2 * force * size / RHO), 1e-3)
        total = [sum(run.force(f)[k] for f in faces) for k in range(3)]
        yield f"along {axis}: force on all walls over the weight", -1, total[i] / (force * size**3), 0.01
        pair = run.force(f"{axis}-min")[i] + run.force(f"{axis}-max")[i]
        yield f"along {axis}: of the two ends alone", -1, pair / (force * size**3), 0.02


@scene
def sphere_array_other_axes(bench):
    """Simple cubic array of spheres, d/L = 0.5, Stokes flow: F = 2.842 x 6 pi mu a U; the force along y and -z."""
    size, d = 2e-3, 1e-3
    for axis, sign in (("y", 1), ("z", -1)):
        force = 0.02
        run = bench.run({"generator": "obstacle", "obstacle": {"length": size, "width": size, "height": size,
            "shape": "sphere", "diameter": d,
                         "center": [size / 2] * 3, "periodic": True}}, {"body_force": vector(axis, sign * force)},
                         periodic("x", "y", "z"),
                        {"dx": size / 24}, 0.3, {"statistics": 0.1, "force": ["obstacle"],
                        "plane": [{"name": "p", "normal": axis, "at": 0.05 * size}]})
        drag = sign * force * size**3
        speed = drag / (2.842 * 6 * math.pi * MU * d / 2)
        i = AXES.index(axis)
        yield f"along {axis}: mean speed over the whole section", speed, run.flow("p") / size**2, 0.04
        yield ("force on the sphere over the force on air and sphere", 1 - math.pi / 6 / 8,
            run.force("obstacle")[i] / drag, 0.02)


@scene
def cylinders_in_a_square_array(bench):
    """Stokes flow across cylinders, solid share 0.2: drag a length 51.53 mu U (Sangani & Acrivos 1982)."""
    size, share = 1e-3, 0.2
    d = 2 * size * math.sqrt(share / math.pi)
    dx = size / 32
    high = 4 * dx
    for axis in ("x", "y"):
        run = bench.run({"generator": "obstacle", "obstacle": {"length": size, "width": size, "height": high,
            "shape": "cylinder", "diameter": d,
                         "center": [size / 2, size / 2, high / 2], "periodic": True}},
                         {"body_force": vector(axis, 1.0)}, periodic("x", "y", "z"),
                        {"dx": dx}, 0.1, {"statistics": 0.05, "force": ["obstacle"],
                        "plane": [{"name": "p", "normal": axis, "at": 0.02 * size}]})
        yield (f"along {axis}: mean speed over the whole section", size**2 / (51.53 * MU),
            run.flow("p") / (size * high), 0.03)
        yield ("force on the cylinder over that on the air", 1,
            run.force("obstacle")[AXES.index(axis)] / (size**2 * (1 - share) * high), 0.02)


@scene
def cube_in_a_duct(bench):
    """Momentum between two planes of a duct with a cube: forces on cube and walls = drop x area."""
    side, length = 2e-3, 12e-3
    run = bench.run({"generator": "obstacle", "obstacle": {"length": length, "width": side, "height": side,
        "shape": "cube", "diameter": 0.5e-3,
                     "center": [5e-3, side / 2, side / 2]}}, {},
                     {"inlet": {"type": "velocity-inlet", "profile": "duct", "velocity": 0.2},
                    "outlet": {"type": "pressure-outlet"}}, {"dx": side / 16}, 0.08,
                    {"statistics": 0.02, "force": ["obstacle", "wall"],
                    "plane": [{"name": "in", "normal": "x", "at": 0.5e-3}, {"name": "out", "normal": "x",
                    "at": 11.5e-3}],
                     "line": [{"name": "through", "from": [4e-3, side / 2, side / 2], "to": [6e-3, side / 2,
                     side / 2], "points": 21}]})
    rows = run.line("through")
    yield "points of a line outside the cube", 16, len([r for r in rows if abs(r["x"] - 5e-3) > 0.25e-3]), 0
    yield "points of the line in all (five inside the cube have none)", 16, len(rows), 0
    drop = (run.last("planes", plane="in")["static_pressure"] - run.last("planes",
        plane="out")["static_pressure"]) * length / 11e-3
    drag = run.force("obstacle")[0]
    # outside the planes the gradient is the duct's: the whole is extrapolated by the walls of half a millimetre each
    from ducts import rectangle_series
    gradient = MU * 0.2 * side**2 / rectangle_series(side, side)[0]
    whole = (drop * 11 / 12 + gradient * 1e-3) * side**2
    yield "force on cube and walls over drop x area", 1, (drag + run.force("wall")[0]) / whole, 0.03
    yield "side forces on the cube over its drag", 0, max(abs(f) for f in run.force("obstacle")[1:]) / drag, 0.01


@scene
def averages_of_a_line(bench):
    """average_from: the mean of a force that swings about zero vanishes; samples as the statistics say."""
    period = 0.016
    text = "time,fx,fy,fz\n" + "".join(f"{i * period / 40!r},{5.0 * math.sin(2 * math.pi * i / 40)!r},0,0\n"
        for i in range(12 * 40 + 1))
    run = bench.run(box(8 * DX, 4 * DX, H), {"body_force": {"file": "force.csv"}}, periodic("x", "y") | walls("z-min",
        "z-max"), {"dx": DX}, 12 * period,
                    {"statistics": period / 40, "line": [
                        {"name": "mean", "from": [4 * DX, 2 * DX, 0.0], "to": [4 * DX, 2 * DX, H], "points": 9,
                        "average_from": f"{8 * period} s"},
                        {"name": "end", "from": [4 * DX, 2 * DX, 0.0], "to": [4 * DX, 2 * DX, H], "points": 9}],
                     "probe": [{"name": "p", "at": [4 * DX, 2 * DX, H / 2]}]}, files={"force.csv": text})
    largest = max(abs(r["u"]) for r in run.rows("probes") if r["time"] > 8 * period)
    mean = run.line("mean")
    yield "samples", 160, mean[4]["samples"], 0.02
    yield "mean in the middle over the amplitude", 0, mean[4]["u"] / largest, 0.02
    yield "samples of a line without average_from", 1, run.line("end")[4]["samples"], 0
    yield ("its value is the probe's last, over the amplitude", 0,
        (run.line("end")[4]["u"] - run.last("probes", probe="p")["u"]) / largest, 1e-3)


@scene
def places_that_are_wrong(bench):
    """Probes and planes outside the air, a key misspelt, an unknown patch: exit code 3 and a line of the case."""
    air, bounds = {"body_force": [1.0, 0.0, 0.0]}, periodic("x", "y") | walls("z-min", "z-max")
    for what, output in (("probe outside", {"probe": [{"name": "p", "at": [0.0001, 0.0001, 0.5]}]}),
                         ("plane outside", {"plane": [{"name": "p", "normal": "x", "at": 0.7}]}),
                         ("normal unknown", {"plane": [{"name": "p", "normal": "q", "at": 0.0001}]}),
                         ("line all outside", {"line": [{"name": "l", "from": [1, 1, 1], "to": [2, 2, 2],
                         "points": 5}]}),
                         ("patch unknown", {"force": ["lid"]}), ("word misspelt", {"probes": []})):
        run = bench.run(box(8 * DX, 4 * DX, H), air, bounds, {"dx": DX}, 0.001, output, extra=("--quiet",))
        yield f"{what}: exit code", 3, run.code, 0
        yield f"{what}: the message names file and line", 1, float("case.toml:" in run.log), 0
