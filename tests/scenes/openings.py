"""Several inlets and outlets, on one side or at different pressures, profiles from files, ramps, turbulence."""
import math

from channels import DX, H
from ducts import rectangle_series
from scene import MU, RHO, box, periodic, scene, walls
from solids import ascii_stl, blocks


def tee(name_of_end):
    """A duct of 1 x 1 mm along x from 0 to 4 mm that meets one along z of 9 mm: ends at x = 0, z = -4 and z = 5 mm."""
    xs, ys, zs = [0, 4e-3, 5e-3], [0, 1e-3], [-4e-3, 0, 1e-3, 5e-3]

    def filled(i, j, k):
        return i == 1 or k == 1

    def name(axis, sign, i, j, k):
        if axis == 0 and sign < 0 and i == 0:
            return name_of_end[0]
        if axis == 2 and sign < 0 and k == 0 and i == 1:
            return name_of_end[1]
        if axis == 2 and sign > 0 and k == 2 and i == 1:
            return name_of_end[2]
        return "wall"
    return ascii_stl(blocks(xs, ys, zs, filled, name), unit=1e-3)


TEE_PLANES = [{"name": "stem", "normal": "x", "at": 2e-3}, {"name": "low", "normal": "z", "at": -2e-3},
    {"name": "high", "normal": "z", "at": 3e-3}]


@scene
def tee_two_outlets(bench):
    """By symmetry half of the air leaves through each arm; planes say which way."""
    q = 0.3e-6
    run = bench.run({"stl": "tee.stl", "unit": "mm"}, {}, {
        "stem": {"type": "velocity-inlet", "profile": "duct", "flow_rate": q}, "low": {"type": "pressure-outlet"},
        "high": {"type": "pressure-outlet"}}, {"dx": H / 10}, 0.06, {"statistics": 0.01, "plane": TEE_PLANES,
        "force": ["wall"]},
        files={"tee.stl": tee(("stem", "low", "high"))})
    yield "flow rate in the stem", q, run.flow("stem"), 0.002
    yield "upper arm", q / 2, run.flow("high"), 0.005
    yield "lower arm, down", -q / 2, run.flow("low"), 0.005
    yield "sideways force on the walls over that along the stem", 0, run.force("wall")[2] / run.force("wall")[0], 0.01


@scene
def tee_two_inlets(bench):
    """Two inlets of different flow rates into one outlet; units of the flow rate."""
    run = bench.run({"stl": "tee.stl", "unit": "mm"}, {}, {
        "stem": {"type": "pressure-outlet"}, "low": {"type": "velocity-inlet", "flow_rate": "0.006 L/min"},
        "high": {"type": "velocity-inlet", "profile": "duct", "flow_rate": "200 mm^3/s"}}, {"dx": H / 10}, 0.06,
        {"statistics": 0.01, "plane": TEE_PLANES}, files={"tee.stl": tee(("stem", "low", "high"))})
    yield "lower arm", 0.1e-6, run.flow("low"), 0.002
    yield "upper arm, down", -0.2e-6, run.flow("high"), 0.002
    yield "stem, out against x", -0.3e-6, run.flow("stem"), 0.002
    yield "flow rate of history.csv", 0.3e-6, run.last("history")["flow_rate"], 0.002


@scene
def tee_pressures(bench):
    """Slow flow between three pressures: a network of ducts of 4.5 mm to the middle of the joint (a little less)."""
    p = {"stem": 0.06, "low": 0.02, "high": 0.0}
    run = bench.run({"stl": "tee.stl", "unit": "mm"}, {}, {k: {"type": "pressure-outlet", "pressure": v} for k,
        v in p.items()},
                    {"dx": H / 10}, 0.1, {"statistics": 0.01, "plane": TEE_PLANES},
                    files={"tee.stl": tee(("stem", "low", "high"))})
    conduct = rectangle_series(H, H)[0] / MU / 4.5e-3
    middle = sum(p.values()) / 3
    for name, sign in (("stem", 1), ("low", 1), ("high", -1)):
        yield f"flow rate {name}, towards the axes", sign * conduct * (p[name] - middle), run.flow(name), 0.15
    yield ("sum of the three over the stem's", 0, (run.flow("stem") + run.flow("low") - run.flow("high")) /
        run.flow("stem"), 2e-3)


@scene
def both_openings_on_one_side(bench):
    """A U: in and out through x = 0; flow in the two legs and the pressures of the straight legs."""
    xs, ys, zs = [0, 5e-3, 6e-3], [0, 1e-3], [0, 1e-3, 2e-3, 3e-3]

    def name(axis, sign, i, j, k):
        return ("in" if k == 0 else "out") if axis == 0 and sign < 0 and i == 0 else "wall"
    q = 0.2e-6
    run = bench.run({"stl": "u.stl", "unit": "mm"}, {}, {"in": {"type": "velocity-inlet", "profile": "duct",
        "flow_rate": q},
                    "out": {"type": "pressure-outlet", "pressure": 3.0}}, {"dx": H / 10}, 0.06,
                    {"statistics": 0.01, "plane": [{"name": "all", "normal": "x", "at": 2e-3}, {"name": "turn",
                    "normal": "z", "at": 1.5e-3}],
                     "probe": [{"name": f"{n}{x}", "at": [x * 1e-3, 0.5e-3, z]} for n, z in (("in", 0.5e-3),
                     ("out", 2.5e-3)) for x in (1, 3)]},
                    files={"u.stl": ascii_stl(blocks(xs, ys, zs, lambda i, j, k: i == 1 or k != 1, name), unit=1e-3)})
    gradient = MU * q / rectangle_series(H, H)[0]
    at = {r["probe"]: r for r in run.rows("probes")[-4:]}
    yield "flow rate through both legs together", 0, run.flow("all") / q, 2e-3
    yield "flow rate of the turn", q, run.flow("turn"), 2e-3
    yield "pressure gradient in", -gradient, (at["in3"]["p"] - at["in1"]["p"]) / 2e-3, 0.02
    yield "pressure gradient out", gradient, (at["out3"]["p"] - at["out1"]["p"]) / 2e-3, 0.02
    yield "gauge pressure 1 mm before the outlet at 3 Pa", 3 + gradient * 1e-3, at["out1"]["p"], 0.002


@scene
def profile_from_file(bench):
    """A parabola between plates as a table, scaled by flow_rate, and as it is."""
    rows = "x,y,z,u,v,w\n" + "".join(f"0,{y!r},{i * H / 40!r},{0.6 * (i / 40) * (1 - i / 40)!r},0,0\n"
        for i in range(41) for y in (0.0, 4 * DX))
    for given in ({}, {"flow_rate": 0.2 * 4 * DX * H}):
        speed = 0.2 if given else 0.1
        run = bench.run(box(4 * H, 4 * DX, H), {}, {"x-min": {"type": "velocity-inlet",
            "profile": {"file": "profile.csv"}} | given,
                        "x-max": {"type": "pressure-outlet"}} | periodic("y") | walls("z-min", "z-max"), {"dx": DX},
                        0.05,
                        {"statistics": 0.01, "probe": [{"name": "mid", "at": [2 * H, 2 * DX, H / 2]}],
                         "plane": [{"name": "p", "normal": "x", "at": 2 * H}]}, files={"profile.csv": rows})
        yield f"flow rate {'given' if given else 'of the file'}", speed * 4 * DX * H, run.flow("p"), 0.003
        yield "speed in the middle", 1.5 * speed, run.last("probes", probe="mid")["u"], 0.015


@scene
def ramp_of_the_flow(bench):
    """Plug flow between slip walls: p = rho L dU/dt while it is ramped, the same with every kind of time step. Sound
    runs to and fro without loss after each bend of the ramp: means over many of its periods (0.3 ms). Column and
    wind of a Mach number M of the lattice (0.17) act as L/(1 - M^2): 3 %."""
    length, top, ramp = 4e-3, 10.0, 0.02
    for step in ("follow-ramp", "fixed", "1e-6 s"):
        rate = [["0 s", 0.0], [f"{ramp} s", top * 16 * DX**2], ["1 s", top * 16 * DX**2]]
        run = bench.run(box(length, 4 * DX, 4 * DX), {}, {"x-min": {"type": "velocity-inlet", "flow_rate": rate},
            "x-max": {
            "type": "pressure-outlet"}} | {f: {"type": "slip"} for f in ("y-min", "y-max", "z-min", "z-max")},
            {"dx": DX, "time_step": step}, 0.03,
            {"statistics": 1.3e-5, "plane": [{"name": "p", "normal": "x", "at": 1e-3}],
            "probe": [{"name": "p", "at": [2e-3, 2 * DX, 2 * DX]}]})

        def mean(table, column, begin, end):
            rows = [r for r in run.rows(table) if begin < r["time"] < end]
            return sum(r[column] for r in rows) / len(rows)
        pressure = mean("planes", "static_pressure", 0.005, 0.019)
        yield f"{step}: pressure 3 mm before the outlet during the ramp", RHO * 3e-3 * top / ramp, pressure, 0.04
        yield (f"{step}: speed over the ramp's at 11 to 13 ms", 1, mean("probes", "u", 0.011,
            0.013) / (0.012 * top / ramp), 0.01)
        head = mean("planes", "total_pressure", 0.022, 0.03) - mean("planes", "static_pressure", 0.022, 0.03)
        yield f"{step}: total less static pressure after it", 0.5 * RHO * top**2, head, 0.02


@scene
def cells_for_dx(bench):
    """cells = N gives a grid of about N cells, and the right flow."""
    run = bench.run({"generator": "duct", "duct": {"length": 4e-3, "width": 1e-3, "height": 1e-3}}, {},
                    {"inlet": {"type": "velocity-inlet", "profile": "duct", "velocity": 0.3},
                    "outlet": {"type": "pressure-outlet"}},
                    {"cells": 10000}, 0.05, {"statistics": 0.01,
                    "plane": [{"name": f"x{i}", "normal": "x", "at": i * 1e-3} for i in (1, 3)]})
    yield "cells", 10000, run.summary["cells_fluid"], 0.1
    p = [run.last("planes", plane=n)["static_pressure"] for n in ("x1", "x3")]
    yield "pressure gradient", MU * 0.3 * 1e-6 / rectangle_series(1e-3, 1e-3)[0], (p[0] - p[1]) / 2e-3, 0.02


@scene
def turbulence_at_an_inlet(bench):
    """rms of each component near the inlet over the mean, half a millimetre in; slip walls, 10 m/s."""
    intensity, speed, width = 0.1, 10.0, 5e-3
    dx = width / 20
    names = [(f"p{i}{j}", [2 * dx, (i + 0.5) * width / 3, (j + 0.5) * width / 3]) for i in range(3) for j in range(3)]
    run = bench.run(box(10e-3, width, width), {}, {"x-min": {"type": "velocity-inlet", "velocity": speed,
        "turbulence": intensity},
                    "x-max": {"type": "pressure-outlet"}} | {f: {"type": "slip"}
                    for f in ("y-min", "y-max", "z-min", "z-max")},
                    {"dx": dx}, 0.04, {"statistics": 5e-5, "probe": [{"name": n, "at": p} for n, p in names]})
    rows = [r for r in run.rows("probes") if r["time"] > 0.002]
    for component, mean in (("u", speed), ("v", 0.0), ("w", 0.0)):
        values = [r[component] for r in rows]
        centre = sum(values) / len(values)
        rms = math.sqrt(sum((v - centre) ** 2 for v in values) / len(values))
        yield f"rms of {component} over the mean speed", intensity, rms / speed, 0.25
        yield f"mean of {component} over the mean speed", mean / speed, centre / speed, 0.02
