"""Steady flow between plates: driven by a wall, a body force, pressures, an inlet; in every direction, with every
scheme. u = U z/h + G z (h - z)/(2 mu), flow a width U h/2 + G h^3/(12 mu), G the body force along the plates [N/m^3].
"""
from scene import MU, RHO, box, periodic, scene, walls, worst

H = 1.0e-3  # the gap [m]
DX = H / 16
AXES = "xyz"


def turned(flow, across, along_flow, width, height):
    """Lengths of a box with the flow along one axis and the gap across another."""
    size = {a: width for a in AXES}
    size[flow], size[across] = along_flow, height
    return box(**size)


def vector(axis, value):
    return [value if a == axis else 0.0 for a in AXES]


def profile_line(flow, across, low, high, height, mid_flow, mid_side, points=21):
    def at(value):
        return [mid_flow if a == flow else value if a == across else mid_side for a in AXES]
    return {"name": "across", "from": at(low), "to": at(high), "points": points}


def driven(bench, flow="x", across="z", force=0.0, lid=0.0, height=H, dx=DX, numerics=None, stop=0.3, sign=1):
    """Plates with a body force and a moving upper plate. Gives the run, the exact profile and flow a depth."""
    side = (set(AXES) - {flow, across}).pop()
    width = 4 * dx
    bounds = periodic(flow, side) | walls(f"{across}-min", f"{across}-max")
    if lid:
        bounds[f"{across}-max"] = {"type": "moving-wall", "velocity": vector(flow, lid)}
    run = bench.run(
        turned(flow, across, 8 * dx, width, height), {"body_force": vector(flow, force)}, bounds, {"dx": dx} |
        (numerics or {}), stop,
        {"statistics": stop / 4, "line": [profile_line(flow, across, 0.0, height, height, 4 * dx, width / 2)],
         "plane": [{"name": "section", "normal": flow, "at": 4 * dx}], "force": [f"{across}-min", f"{across}-max"]})
    component = "uvw"[AXES.index(flow)]
    rows = [(r["s"], r[component]) for r in run.line("across")]
    exact = [(lid * s / height + force * s * (height - s) / (2 * MU), u) for s, u in rows]
    flow_rate = width * (lid * height / 2 + force * height**3 / (12 * MU))
    area = 8 * dx * width
    low = area * (MU * lid / height + force * height / 2)
    high = area * (force * height / 2 - MU * lid / height)
    i = AXES.index(flow)
    return run, exact, flow_rate, (low, run.force(f"{across}-min")[i]), (high, run.force(f"{across}-max")[i])


@scene
def couette_with_pressure(bench):
    """A lid of 0.3 m/s with, without and against a body force; the last turns the flow at the lower plate."""
    speed = 0.3
    for share in (0.0, 2.0, -3.0):
        force = share * speed * 2 * MU / H**2
        run, exact, flow, low, high = driven(bench, force=force, lid=speed)
        flow = 0.0 if share == -3.0 else flow
        yield (f"profile, force {share:+g} of the lid's, largest error over the lid's speed", 0, worst(exact, speed),
            0.01)
        yield "points of the line from plate to plate", 21, len(exact), 0
        yield ("flow rate of the plane over the lid's share", flow / (2 * DX * speed * H),
            run.flow("section") / (2 * DX * speed * H), 0.01)
        yield "force on the lower plate", low[0], low[1], 0.01
        yield "force on the lid", high[0], high[1], 0.01


@scene
def poiseuille_three_directions(bench):
    """Body force along each axis, both signs; gap across another axis."""
    for flow, across, sign in (("x", "y", 1), ("y", "z", -1), ("z", "x", -1)):
        force = sign * 12 * MU * 0.2 / H**2
        run, exact, flow_rate, low, high = driven(bench, flow, across, force)
        yield f"along {flow}, plates across {across}: profile over the largest speed", 0, worst(exact, 0.3), 0.01
        yield "flow rate of the plane, its sign along the axis", flow_rate, run.flow("section"), 0.01
        yield "force on one plate", low[0], low[1], 0.005


@scene
def poiseuille_collisions(bench):
    """Every collision operator and eddy viscosity on the same laminar flow."""
    force = 12 * MU * 0.2 / H**2
    for numerics in ({"collision": "bgk"}, {"collision": "trt"}, {"collision": "hrr"}, {"collision": "central-moments"},
                     {"les": "none"}, {"les": "vreman"}, {"precision": "double"}, {"reference_speed": "0.4 m/s"},
                     {"lattice_speed": 0.03}, {"time_step": "fixed"}, {"time_step": "1e-5 s"}):
        run, exact, flow_rate, low, high = driven(bench, force=force, numerics=numerics)
        what = ", ".join(f"{k} {v}" for k, v in numerics.items())
        yield f"{what}: profile over the largest speed", 0, worst(exact, 0.3), 0.01
        yield f"{what}: force on one plate", low[0], low[1], 0.005


@scene
def poiseuille_wall_schemes(bench):
    """A gap of 16.4 cells: the plates lie inside cells."""
    force = 12 * MU * 0.2 / H**2
    for wall, tolerance in (("bouzidi", 0.012), ("halfway", 0.1), ("psm", 0.02), ("ibm", 0.1)):
        run, exact, flow_rate, low, high = driven(bench, force=force, dx=H / 16.4, numerics={"wall": wall})
        yield f"{wall}: profile over the largest speed", 0, worst(exact, 0.3), tolerance
        yield f"{wall}: flow rate of the plane", flow_rate, run.flow("section"), tolerance
        yield (f"{wall}: force on both plates over that of the body force", 1,
            (low[1] + high[1]) / (low[0] + high[0]), 0.002)


@scene
def film(bench):
    """A wall below, slip above: u = G (h z - z^2/2)/mu, flow a width G h^3/(3 mu); slip above in each direction."""
    for flow, across, slip, wall in (("x", "z", "max", "min"), ("y", "x", "min", "max")):
        side = (set(AXES) - {flow, across}).pop()
        force = 3 * MU * 0.2 / H**2
        bounds = periodic(flow, side) | {f"{across}-{slip}": {"type": "slip"}, f"{across}-{wall}": {"type": "wall"}}
        run = bench.run(turned(flow, across, 8 * DX, 4 * DX, H), {"body_force": vector(flow, force)}, bounds,
            {"dx": DX}, 0.6,
                        {"statistics": 0.1, "line": [profile_line(flow, across, 0.02 * H, 0.98 * H, H, 4 * DX, 2 * DX)],
                         "plane": [{"name": "section", "normal": flow, "at": 4 * DX}],
                         "force": [f"{across}-min", f"{across}-max"]})
        pairs = []
        for row in run.line("across"):
            depth = row[across] if wall == "min" else H - row[across]
            pairs.append((force * (H * depth - depth**2 / 2) / MU, row["uvw"[AXES.index(flow)]]))
        yield f"along {flow}: profile over the largest speed", 0, worst(pairs, 0.3), 0.01
        yield "flow rate", 4 * DX * force * H**3 / (3 * MU), run.flow("section"), 0.01
        yield "force on the wall", force * H * 32 * DX**2, run.force(f"{across}-{wall}")[AXES.index(flow)], 0.005
        yield "force on the slip face along the flow over the wall's", 0, \
            run.force(f"{across}-{slip}")[AXES.index(flow)] / (force * H * 32 * DX**2), 1e-4


@scene
def plates_between_pressures(bench):
    """Two openings at different pressures, flow down the z-axis. The drop inside is that of the flow which results."""
    length = 6 * H
    ask = 12 * MU * 0.2 * length / H**2
    run = bench.run(box(H, 4 * DX, length), {}, {"z-max": {"type": "pressure-outlet", "pressure": ask + 2.0},
                    "z-min": {"type": "pressure-outlet", "pressure": 2.0}} | periodic("y") | walls("x-min", "x-max"),
                    {"dx": DX}, 0.3,
                    {"statistics": 0.01, "plane": [{"name": f"z{i}", "normal": "z", "at": i * H} for i in (1, 2, 4,
                    5)]})
    flow = run.flow("z2")
    speed = flow / (4 * DX * H)
    rise = run.last("planes", plane="z5")["static_pressure"] - run.last("planes", plane="z2")["static_pressure"]
    yield "mean speed, Re 13", -0.2, speed, 0.02
    yield "pressure gradient over Poiseuille's for this flow", 1, rise / (-12 * MU * speed * 3 * H / H**2), 0.01
    yield "flow rate through z = 1 over that through z = 5 mm", 1, run.flow("z1") / run.flow("z5"), 1e-3
    mean = run.last("planes", plane="z1")["static_pressure"]
    yield "gauge pressure at z = 1 mm, the outlet at 2 Pa", 2 + ask / 6, mean, 0.02
    yield "flow rate in the last row of history.csv", abs(flow), abs(run.last("history")["flow_rate"]), 0.01


@scene
def plates_with_inlet(bench):
    """The parabola enters at y-max and x-max and is kept; total less static pressure is 54/35 of the mean's."""
    speed, length = 0.2, 4 * H
    for flow, across in (("y", "x"), ("x", "z")):
        side = (set(AXES) - {flow, across}).pop()
        bounds = {f"{flow}-max": {"type": "velocity-inlet", "profile": "parabolic", "velocity": speed},
                  f"{flow}-min": {"type": "pressure-outlet"}} | periodic(side) | walls(f"{across}-min", f"{across}-max")
        run = bench.run(turned(flow, across, length, 4 * DX, H), {}, bounds, {"dx": DX}, 0.2, {
            "statistics": 0.01, "plane": [{"name": f"p{i}", "normal": flow, "at": i * H} for i in (1, 2, 3)],
            "line": [profile_line(flow, across, 0.0, H, H, 2 * H, 2 * DX)], "force": [f"{across}-min",
            f"{across}-max"]})
        pairs = [(-6 * speed * (r[across] / H) * (1 - r[across] / H), r["uvw"[AXES.index(flow)]])
            for r in run.line("across")]
        planes = [run.last("planes", plane=f"p{i}") for i in (1, 2, 3)]
        yield f"along -{flow}: profile in the middle over the largest speed", 0, worst(pairs, 0.3), 0.01
        yield "flow rate of the plane", -speed * 4 * DX * H, planes[1]["flow_rate"], 1e-3
        yield ("drop over the middle half", 12 * MU * speed * 2 * H / H**2,
            planes[2]["static_pressure"] - planes[0]["static_pressure"], 0.01)
        yield ("total less static pressure", 0.5 * RHO * speed**2 * 54 / 35,
            planes[1]["total_pressure"] - planes[1]["static_pressure"], 0.015)
        yield ("force on one plate along the flow", -6 * MU * speed / H * length * 4 * DX,
            run.force(f"{across}-min")[AXES.index(flow)], 0.02)
