"""Ducts of many sections: round, ring, triangle, ellipse, rectangles; along an axis or not; by body force or inlet."""
import math

from scene import MU, RHO, periodic, scene, walls
from solids import ascii_stl, binary_stl, frame, prism, ring


def periodic_prism(bench, section, length, force, dx, name="x", numerics=None, points=None):
    """Body force along x through a section. Gives the run."""
    mid = points or (0.0, 0.0)
    return bench.run(
        {"stl": "own.stl", "unit": "mm"}, {"body_force": [force, 0.0, 0.0]},
        {"inlet": {"type": "periodic", "with": "outlet"}},
        {"dx": dx} | (numerics or {}), 0.08,
        {"statistics": 0.02, "plane": [{"name": "section", "normal": "x", "at": length / 2}], "force": ["wall"],
         "probe": [{"name": "mid", "at": [length / 2, *mid]}]},
        files={"own.stl": ascii_stl(section if isinstance(section, dict) else prism(section, length), unit=1e-3)})


def polygon(n, a, b):
    k = math.sqrt(2 * math.pi / n / math.sin(2 * math.pi / n))  # the polygon has the ellipse's area
    return [(a * k * math.cos(2 * math.pi * (i + 0.5) / n), b * k * math.sin(2 * math.pi * (i + 0.5) / n))
        for i in range(n)]


def rectangle_series(width, height, terms=60):
    """Q mu/G and u_mid mu/G of a rectangle, the shorter side first in the series."""
    a, b = max(width, height) / 2, min(width, height) / 2
    q = 4 * a * b**3 / 3 * (1 - 192 / math.pi**5 * b / a * sum(math.tanh(n * math.pi * a / (2 * b)) / n**5
        for n in range(1, 2 * terms, 2)))
    mid = 16 * b * b / math.pi**3 * sum((-1) ** ((n - 1) // 2) * (1 - 1 / math.cosh(min(700,
        n * math.pi * a / (2 * b)))) / n**3
                                        for n in range(1, 2 * terms, 2))
    return q, mid


@scene
def equilateral_triangle(bench):
    """f Re 53.33: Q = sqrt(3) G a^4/(320 mu), at the centroid G a^2/(36 mu)."""
    a, force = 2.0e-3, 40.0
    low = -a / (2 * math.sqrt(3))
    section = [(-a / 2, low), (a / 2, low), (0.0, a / math.sqrt(3))]
    dx = a / 32
    run = periodic_prism(bench, section, 4 * dx, force, dx)
    yield "flow rate", math.sqrt(3) * force * a**4 / (320 * MU), run.flow("section"), 0.02
    yield "speed at the centroid", force * a * a / (36 * MU), run.last("probes", probe="mid")["u"], 0.02
    yield ("force on the walls over that on the air", 1, run.force("wall")[0] / (force * math.sqrt(3) / 4 * a * a *
        4 * dx), 0.02)


@scene
def ellipse(bench):
    """Q = pi G a^3 b^3/(4 mu (a^2 + b^2))."""
    a, b, force = 1.0e-3, 0.5e-3, 60.0
    dx = b / 10
    run = periodic_prism(bench, polygon(96, a, b), 4 * dx, force, dx)
    yield "flow rate", math.pi * force * (a * b) ** 3 / (4 * MU * (a * a + b * b)), run.flow("section"), 0.02
    yield ("speed in the middle", force * (a * b) ** 2 / (2 * MU * (a * a + b * b)), run.last("probes",
        probe="mid")["u"], 0.02)
    yield "force on the wall over that on the air", 1, run.force("wall")[0] / (force * math.pi * a * b * 4 * dx), 0.02


@scene
def round_pipe_schemes(bench):
    """Hagen-Poiseuille by body force, 20 cells across, the four walls."""
    r, force = 0.5e-3, 80.0
    dx = r / 10
    for wall, tolerance in (("bouzidi", 0.02), ("psm", 0.03), ("ibm", 0.07), ("halfway", 0.1)):
        run = periodic_prism(bench, polygon(96, r, r), 4 * dx, force, dx, numerics={"wall": wall})
        yield f"{wall}: flow rate", math.pi * force * r**4 / (8 * MU), run.flow("section"), tolerance
        yield f"{wall}: speed on the axis", force * r * r / (4 * MU), run.last("probes", probe="mid")["u"], tolerance
        yield (f"{wall}: force on the wall over that on the air", 1,
            run.force("wall")[0] / (force * math.pi * r * r * 4 * dx), tolerance)


@scene
def annulus(bench):
    """Between tubes of 1 and 0.5 mm radius: Q = pi G/(8 mu) (R^4 - r^4 - (R^2 - r^2)^2/ln(R/r)); forces."""
    big, small, force = 1.0e-3, 0.5e-3, 150.0
    dx = (big - small) / 10
    length = 4 * dx
    run = bench.run(
        {"stl": "own.stl", "unit": "mm"}, {"body_force": [force, 0.0, 0.0]},
        {"inlet": {"type": "periodic", "with": "outlet"}}, {"dx": dx},
        0.06, {"statistics": 0.05, "plane": [{"name": "section", "normal": "x", "at": length / 2}], "force": ["wall",
        "core"]},
        files={"own.stl": ascii_stl(ring(big, small, length), unit=1e-3)})
    log = math.log(big / small)
    yield ("flow rate", math.pi * force / (8 * MU) * (big**4 - small**4 - (big**2 - small**2) ** 2 / log),
        run.flow("section"), 0.03)
    core = math.pi * force * length * ((big**2 - small**2) / (2 * log) - small**2)
    outer = math.pi * force * length * (big**2 - (big**2 - small**2) / (2 * log))
    yield "force on the core", core, run.force("core")[0], 0.03
    yield "force on the outer tube", outer, run.force("wall")[0], 0.03


@scene
def rectangles_with_inlet(bench):
    """The exact laminar profile enters, is kept, and its pressure gradient is the series'."""
    for width, height, force_on in ((1.0e-3, 1.0e-3, True), (2.0e-3, 1.0e-3, True), (0.5e-3, 2.0e-3, False)):
        dx, length, speed = min(width, height) / 12, 4e-3, 0.3
        q, mid = rectangle_series(width, height)
        gradient = MU * speed * width * height / q
        run = bench.run(
            {"generator": "duct", "duct": {"length": length, "width": width, "height": height}}, {},
            {"inlet": {"type": "velocity-inlet", "profile": "duct", "velocity": speed},
            "outlet": {"type": "pressure-outlet"}},
            {"dx": dx}, 0.03,
            {"statistics": 0.01, "plane": [{"name": f"x{i}", "normal": "x", "at": i * 1e-3} for i in (1, 2, 3)],
             "line": [{"name": "axis", "from": [0.001, width / 2, height / 2], "to": [0.003, width / 2, height / 2],
             "points": 5}], "force": ["wall"]})
        shape = f"{width * 1e3:g} x {height * 1e3:g} mm"
        axis = [r for r in run.line("axis")]
        exact = mid * width * height / q * speed
        for row in axis[:1] + axis[-1:]:
            yield f"{shape}: speed on the axis at {row['x'] * 1e3:.3g} mm", exact, row["u"], 0.015
        planes = [run.last("planes", plane=f"x{i}") for i in (1, 2, 3)]
        yield (f"{shape}: pressure gradient", gradient, (planes[0]["static_pressure"] -
            planes[2]["static_pressure"]) / 2e-3, 0.02)
        yield f"{shape}: flow rate", speed * width * height, planes[2]["flow_rate"], 0.002
        yield f"{shape}: force on the walls", gradient * length * width * height, run.force("wall")[0], 0.03
        drop = run.summary["pressure"]["static_drop"]
        yield (f"{shape}: static_drop of the summary", gradient * length, drop["mean"] if isinstance(drop,
            dict) else drop, 0.03)


@scene
def round_pipe_inlet(bench):
    """Pipe of the generator, profile pipe: axis 2 U, total less static rho U^2, gradient 8 mu U/R^2."""
    d, speed = 1.0e-3, 0.3
    run = bench.run(
        {"generator": "pipe", "pipe": {"length": 4e-3, "diameter": d}}, {},
        {"inlet": {"type": "velocity-inlet", "profile": "pipe", "velocity": speed},
        "outlet": {"type": "pressure-outlet"}},
        {"dx": d / 16}, 0.04,
        {"statistics": 0.01, "plane": [{"name": f"x{i}", "normal": "x", "at": i * 1e-3} for i in (1, 2, 3)],
         "probe": [{"name": "axis", "at": [0.003, 0.0, 0.0]}], "force": ["wall"]})
    planes = [run.last("planes", plane=f"x{i}") for i in (1, 2, 3)]
    area = math.pi * d * d / 4
    yield "flow rate at 2 mm", speed * area, planes[1]["flow_rate"], 0.005
    yield "speed on the axis at 3 mm", 2 * speed, run.last("probes", probe="axis")["u"], 0.02
    yield ("total less static pressure at 2 mm", RHO * speed**2,
        planes[1]["total_pressure"] - planes[1]["static_pressure"], 0.04)
    gradient = 32 * MU * speed / d**2
    yield "pressure gradient", gradient, (planes[0]["static_pressure"] - planes[2]["static_pressure"]) / 2e-3, 0.02
    yield "force on the wall", gradient * 4e-3 * area, run.force("wall")[0], 0.03


@scene
def square_duct_askew(bench):
    """A square duct along (1, 2, 2) and (3, 0, -4), ASCII and binary, mm and um; openings by solid or point."""
    side, length, speed = 1.0e-3, 5e-3, 0.3
    half = side / 2
    section = [(-half, -half), (half, -half), (half, half), (-half, half)]
    q, mid = rectangle_series(side, side)
    for axis, write, unit, dx in (((1, 2, 2), ascii_stl, "um", side / 14), ((3, 0, -4), binary_stl, "mm", side / 14)):
        turn = frame(axis)
        x = [turn[i][0] for i in range(3)]
        data = write(prism(section, length), turn, {"mm": 1e-3, "um": 1e-6}[unit])
        named = write is ascii_stl
        patches = () if named else (("inlet", "near:[0, 0, 0]"), ("outlet",
            f"near:[{', '.join(repr(c * length) for c in x)}]"))
        at = [[c * s for c in x] for s in (1.5e-3, 3.5e-3)]
        run = bench.run(
            {"stl": "own.stl", "unit": unit}, {},
            {"inlet": {"type": "velocity-inlet", "profile": "duct", "velocity": [c * speed for c in x]},
            "outlet": {"type": "pressure-outlet"}},
            {"dx": dx}, 0.03, {"statistics": 0.01, "probe": [{"name": f"p{i}", "at": p} for i, p in enumerate(at)],
            "force": ["wall"]},
            files={"own.stl": data}, patches=patches)
        p = [run.last("probes", probe=f"p{i}") for i in (0, 1)]
        along = [sum(r["uvw"[i]] * x[i] for i in range(3)) for r in p]
        aside = max(abs(r["uvw"[i]] - along[0] * x[i]) for r in p[:1] for i in range(3))
        gradient = MU * speed * side**2 / q
        yield f"along {axis}, {unit}: speed on the axis at 1.5 mm", mid * side**2 / q * speed, along[0], 0.03
        yield "the same at 3.5 mm", mid * side**2 / q * speed, along[1], 0.03
        yield "sideways velocity on the axis over U", 0, aside / speed, 0.01
        yield "pressure gradient between the probes", gradient, (p[0]["p"] - p[1]["p"]) / 2e-3, 0.06
        force = run.force("wall")
        yield ("force on the walls along the duct", gradient * length * side**2, sum(force[i] * x[i]
            for i in range(3)), 0.08)


@scene
def duct_wall_schemes(bench):
    """A square duct 12.4 cells across with the exact profile at its inlet: drop and force of each kind of wall."""
    side, length, speed = 1.0e-3, 4e-3, 0.3
    gradient = MU * speed * side**2 / rectangle_series(side, side)[0]
    for wall, tolerance in (("bouzidi", 0.05), ("halfway", 0.2), ("psm", 0.05), ("ibm", 0.15)):
        run = bench.run(
            {"generator": "duct", "duct": {"length": length, "width": side, "height": side}}, {},
            {"inlet": {"type": "velocity-inlet", "profile": "duct", "velocity": speed},
            "outlet": {"type": "pressure-outlet"}},
            {"dx": side / 12.4, "wall": wall}, 0.03,
            {"statistics": 0.01, "plane": [{"name": f"x{i}", "normal": "x", "at": i * 1e-3} for i in (1, 3)],
            "force": ["wall"]})
        drop = run.last("planes", plane="x1")["static_pressure"] - run.last("planes", plane="x3")["static_pressure"]
        yield f"{wall}: pressure gradient", gradient, drop / 2e-3, tolerance
        yield (f"{wall}: force on the walls over drop x area", 1,
            run.force("wall")[0] / (drop / 2e-3 * length * side**2), 0.08)


@scene
def duct_between_pressures_fast(bench):
    """100 Pa over a duct of 4 x 4 x 20 mm, Re some 3000: it runs, and the air is no faster than Bernoulli allows
    with the pressure it may bring along (twice the drop); friction and entrance take at least a third of the head."""
    run = bench.run({"generator": "duct", "duct": {"length": 20e-3, "width": 4e-3, "height": 4e-3}}, {},
                    {"inlet": {"type": "pressure-outlet", "pressure": 100.0}, "outlet": {"type": "pressure-outlet"}},
                    {"dx": 0.4e-3}, 0.06,
                    {"statistics": 0.001, "plane": [{"name": "p", "normal": "x", "at": 10e-3}]})
    top = math.sqrt(2 * 100.0 / RHO)
    rows = [r["flow_rate"] / 16e-6 / top for r in run.rows("planes") if r["time"] > 0.04]
    yield "mean speed over sqrt(2 dp/rho), between 0.6 and 1.4", 1, sum(rows) / len(rows), 0.4
    yield "mean of the flow rate of history.csv over the plane's", 1, sum(
        r["flow_rate"] for r in run.rows("history") if r["time"] > 0.04) / (sum(rows) * 16e-6 * top), 0.02
