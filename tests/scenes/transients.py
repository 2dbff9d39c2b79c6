"""Flows in time: starts from rest, oscillations, decaying vortices, sound."""
import cmath
import math

from channels import DX, H
from scene import MU, NU, RHO, box, periodic, scene, walls, worst


@scene
def stokes_first_problem(bench):
    """A plate starts in air at rest, in the middle of a step: u = U erfc(z/(2 sqrt(nu t)))."""
    speed, deep, t = 0.5, 6e-3, 0.03
    run = bench.run(box(4 * DX, 8 * DX, deep), {}, periodic("x", "y") |
        {"z-min": {"type": "moving-wall", "velocity": [0.0, speed, 0.0]}} |
                    walls("z-max"), {"dx": DX}, t,
                    {"statistics": 0.005, "line": [{"name": "up", "from": [2 * DX, 4 * DX, 0.0], "to": [2 * DX,
                    4 * DX, 3e-3], "points": 31}],
                     "force": ["z-min"], "probe": [{"name": "p", "at": [2 * DX, 4 * DX, 0.5e-3]}]})
    end = run.last("history")["time"]
    yield "time of the last row", t, end, 1e-3
    yield ("profile over U", 0, worst([(speed * math.erfc(r["z"] / (2 * math.sqrt(NU * end))), r["v"])
        for r in run.line("up")], speed), 0.01)
    yield "force on the plate", -RHO * speed * math.sqrt(NU / (math.pi * end)) * 32 * DX**2, run.force("z-min")[1], 0.02
    pairs = [(speed * math.erfc(0.5e-3 / (2 * math.sqrt(NU * r["time"]))), r["v"]) for r in run.rows("probes")
        if r["time"] > 0]
    yield "probe at 0.5 mm over time, over U", 0, worst(pairs, speed), 0.015


@scene
def couette_start(bench):
    """A lid starts: u = U (z/h - sum 2/(n pi) (-1)^(n+1) exp(-n^2 pi^2 nu t/h^2) sin(n pi z/h))."""
    speed = 0.3
    run = bench.run(box(8 * DX, 4 * DX, H), {}, periodic("x", "y") |
        {"z-max": {"type": "moving-wall", "velocity": [speed, 0.0, 0.0]}} |
                    walls("z-min"), {"dx": DX}, 0.012,
                    {"statistics": 0.001, "probe": [{"name": f"z{i}", "at": [4 * DX, 2 * DX, i * H / 4]} for i in (1,
                    2, 3)]})

    def exact(z, t):
        return speed * (z / H - sum(2 / (n * math.pi) * (-1) ** (n + 1) * math.exp(-(n * math.pi / H) ** 2 * NU * t) *
                                    math.sin(n * math.pi * z / H) for n in range(1, 60)))
    for i in (1, 2, 3):
        rows = [r for r in run.rows("probes", probe=f"z{i}") if r["time"] > 5e-4]
        yield (f"u at {i}/4 of the gap over time, over U", 0,
            worst([(exact(i * H / 4, r["time"]), r["u"]) for r in rows], speed), 0.01)
        yield "rows of the probe", 12, len(rows), 0.1


def poiseuille_start(z, t, force):
    """Body force from t = 0 on."""
    steady = force * z * (H - z) / (2 * MU)
    return steady - sum(4 * force * H * H / (MU * (n * math.pi) ** 3) * math.exp(-(n * math.pi / H) ** 2 * NU * t) *
        math.sin(n * math.pi * z / H)
                        for n in range(1, 60, 2))


@scene
def force_from_file(bench):
    """A step and a ramp of the body force, from a file; u in the middle over time."""
    force, begin, ramp = 12 * MU * 0.2 / H**2, 0.004, 0.008
    step_file = f"time,fx,fy,fz\n0,0,0,0\n{begin},0,0,0\n{begin + 1e-6},0,{force},0\n1,0,{force},0\n"
    ramp_file = f"time,fx,fy,fz\n0,0,0,0\n{ramp},0,{force},0\n"

    def run(text):
        return bench.run(box(4 * DX, 8 * DX, H), {"body_force": {"file": "force.csv"}}, periodic("x", "y") |
            walls("z-min", "z-max"), {"dx": DX},
                         0.02, {"statistics": 0.001, "probe": [{"name": "mid", "at": [2 * DX, 4 * DX, H / 2]}],
                         "force": ["z-min"]},
                         files={"force.csv": text})
    rows = [r for r in run(step_file).rows("probes")]
    pairs = [(poiseuille_start(H / 2, r["time"] - begin, force) if r["time"] > begin else 0.0, r["v"]) for r in rows]
    yield "step at 4 ms: u in the middle over the last's", 0, worst(pairs, 0.3), 0.01

    def ramped(t):  # superposition of steps
        n = 400
        return sum(poiseuille_start(H / 2, t - (i + 0.5) * ramp / n, force / n) for i in range(n)
            if t > (i + 0.5) * ramp / n)
    rows = [r for r in run(ramp_file).rows("probes")]
    yield "ramp of 8 ms, constant after: the same", 0, worst([(ramped(r["time"]), r["v"]) for r in rows], 0.3), 0.01


@scene
def womersley(bench):
    """A sine of the force, alpha = h/2 sqrt(w/nu) = 3: amplitude and phase in the middle in the sixth period."""
    alpha, samples = 3.0, 400
    w = alpha**2 * NU / (H / 2) ** 2
    period, force = 2 * math.pi / w, 0.3 * RHO * w
    sine = [(i * period / samples, force * math.sin(2 * math.pi * i / samples)) for i in range(6 * samples + 1)]
    text = "time,fx,fy,fz\n" + "".join(f"{t!r},{f!r},0,0\n" for t, f in sine)
    run = bench.run(box(8 * DX, 4 * DX, H), {"body_force": {"file": "force.csv"}}, periodic("x", "y") | walls("z-min",
        "z-max"), {"dx": DX},
                    6 * period, {"statistics": period / 40, "probe": [{"name": "mid", "at": [4 * DX, 2 * DX, H / 2]}],
                                 "plane": [{"name": "p", "normal": "x", "at": 4 * DX}]}, files={"force.csv": text})

    k = alpha * complex(1, 1) / math.sqrt(2)
    tanh = (cmath.exp(k) - cmath.exp(-k)) / (cmath.exp(k) + cmath.exp(-k))
    mid = force / (RHO * w) * -1j * (1 - 2 / (cmath.exp(k) + cmath.exp(-
        k)))  # of exp(i w t); the force is its imaginary part
    mean = force / (RHO * w) * -1j * (1 - tanh / k)
    late = [r for r in run.rows("probes") if r["time"] > 5 * period]
    yield "u in the middle over the force's speed", 0, worst(
        [((mid * complex(math.cos(w * r["time"]), math.sin(w * r["time"]))).imag, r["u"]) for r in late], 0.3), 0.01
    late = [r for r in run.rows("planes") if r["time"] > 5 * period]
    yield "flow rate of the plane over the force's", 0, worst(
        [((mean * complex(math.cos(w * r["time"]), math.sin(w * r["time"]))).imag, r["flow_rate"] / (4 * DX * H))
        for r in late], 0.3), 0.015


@scene
def taylor_green_planes(bench):
    """Taylor-Green vortices from a file in each plane, in a mean wind: they decay by exp(-2 nu k^2 t)."""
    size = 2e-3
    k = 2 * math.pi / size
    n, speed, wind = 32, 0.2, 0.1
    for a, b in ((0, 1), (1, 2), (2, 0)):
        rows = ["x,y,z,u,v,w"]
        for i in range(4 * n + 1):
            for j in range(4 * n + 1):
                p, v = [0.0] * 3, [0.0] * 3
                p[a], p[b] = i * size / (4 * n), j * size / (4 * n)
                v[a] = wind - speed * math.cos(k * p[a]) * math.sin(k * p[b])
                v[b] = speed * math.sin(k * p[a]) * math.cos(k * p[b])
                rows.append(",".join(repr(c) for c in p + v))
        dx, t = size / n, 0.004
        lengths = [size if i in (a, b) else 2 * dx for i in range(3)]

        def at(pa, pb):
            point = [dx] * 3
            point[a], point[b] = pa, pb
            return point
        run = bench.run(box(*lengths), {"initial": {"file": "field.csv"}},
                        periodic("x", "y", "z"), {"dx": dx}, t,
                        {"statistics": 0.001, "line": [{"name": "l", "from": at(0.0, 0.3 * size), "to": at(size,
                        0.3 * size), "points": 33}]},
                        files={"field.csv": "\n".join(rows) + "\n"})
        t = run.last("history")["time"]
        decay = speed * math.exp(-2 * NU * k * k * t)
        pairs = []
        for r in run.line("l"):
            pa, pb = r["xyz"[a]] - wind * t, r["xyz"[b]]
            pairs += [(wind - decay * math.cos(k * pa) * math.sin(k * pb), r["uvw"[a]]),
                (decay * math.sin(k * pa) * math.cos(k * pb), r["uvw"[b]])]
        yield (f"plane {'xyz'[a]}{'xyz'[b]}, decayed to {decay / speed:.2f}: velocity over the start's", 0,
            worst(pairs, speed), 0.01)


@scene
def taylor_vortex(bench):
    """A vortex without circulation decays: u = C r/t^2 exp(-r^2/(4 nu t))."""
    size, n = 4e-3, 64
    dx = size / n
    core = 0.4e-3
    t0 = core**2 / (2 * NU)  # largest speed at r = sqrt(2 nu t) = core
    c = 0.4 * t0**2 / core * math.exp(0.5)

    def speed(r, t):
        return c * r / t**2 * math.exp(-r * r / (4 * NU * t))
    rows = ["x,y,z,u,v,w"]
    for i in range(2 * n + 1):
        for j in range(2 * n + 1):
            x, y = i * dx / 2 - size / 2, j * dx / 2 - size / 2
            r = math.hypot(x, y)
            s = speed(r, t0) / r if r > 0 else 0.0
            rows.append(f"{x + size / 2!r},{y + size / 2!r},0,{-s * y!r},{s * x!r},0")
    run = bench.run(box(size, size, dx), {"initial": {"file": "field.csv"}}, periodic("x", "y", "z"), {"dx": dx}, t0,
                    {"statistics": t0 / 4, "line": [{"name": "l", "from": [size / 2, size / 2, dx / 2],
                    "to": [size * 0.95, size / 2, dx / 2], "points": 30}]},
                    files={"field.csv": "\n".join(rows) + "\n"})
    t = t0 + run.last("history")["time"]
    yield ("speed at twice the age over the first largest", 0,
        worst([(speed(r["x"] - size / 2, t), r["v"]) for r in run.line("l")], 0.4), 0.01)


@scene
def standing_sound(bench):
    """Air at rest with p = P cos(pi x/L) between closed ends: period 2 L/c, c = dx/(sqrt(3) dt) of the lattice."""
    length = 4e-3
    wave = [(i * DX / 2, 0.5 * math.cos(math.pi * i * DX / 2 / length)) for i in range(129)]
    rows = "x,y,z,u,v,w,p\n" + "".join(f"{x!r},0,0,0,0,0,{p!r}\n" for x, p in wave)
    run = bench.run(box(length, 4 * DX, 4 * DX), {"initial": {"file": "field.csv"}}, periodic("y", "z") |
        walls("x-min", "x-max"),
                    {"dx": DX, "reference_speed": 5.0, "time_step": "fixed"}, 1.0e-3,
                    {"statistics": 4e-6, "probe": [{"name": "end", "at": [0.1 * DX, 2 * DX, 2 * DX]}],
                    "force": ["x-min", "x-max"]},
                    files={"field.csv": rows})
    dt = run.summary["dt_max"]
    c = DX / (math.sqrt(3) * dt)
    p = [(r["time"], r["p"]) for r in run.rows("probes")]
    cross = [a[0] + (b[0] - a[0]) * a[1] / (a[1] - b[1]) for a, b in zip(p, p[1:]) if a[1] * b[1] < 0]
    yield "period", 2 * length / c, 2 * (cross[-1] - cross[0]) / (len(cross) - 1), 0.005
    yield "first crossing over the period", 0.25, cross[0] / (2 * length / c), 0.03
    yield ("force on the end at x = 0 over its area's pressure", 1, run.force("x-min")[0] / (-p[-1][1] * 16 * DX**2),
        0.02)


@scene
def free_fall(bench):
    """Nothing but a tilted body force, periodic in all directions: u = G t/rho. Half a step (0.02 ms)
    stands between the start and the first step of the force: 0.2 %."""
    force = [3.0, -2.0, 1.0]
    run = bench.run(box(4 * DX, 5 * DX, 6 * DX), {"body_force": force}, periodic("x", "y", "z"), {"dx": DX}, 0.01,
                    {"statistics": 0.001, "probe": [{"name": "p", "at": [DX, 2 * DX, 3 * DX]}],
                    "plane": [{"name": "y", "normal": "y", "at": 2 * DX}]})
    end = run.last("probes")
    for c, g in zip("uvw", force):
        yield f"{c} at 10 ms", g * end["time"] / RHO, end[c], 3e-3
    yield "flow rate along y", -2.0 * end["time"] / RHO * 24 * DX**2, run.flow("y"), 1e-3
    yield "momentum of the air in no one's way: pressure", 0, end["p"], 1e-3


@scene
def slanted_lid(bench):
    """A lid that moves along (1, 2, 0) between periodic sides: both components are Couette's, forces too."""
    run = bench.run(box(6 * DX, 6 * DX, H), {}, periodic("x", "y") |
        {"z-min": {"type": "moving-wall", "velocity": [0.1, 0.2, 0.0]},
                    "z-max": {"type": "moving-wall", "velocity": [-0.1, 0.0, 0.0]}}, {"dx": DX}, 0.25,
                    {"statistics": 0.05, "probe": [{"name": "p", "at": [DX, DX, 0.25 * H]}], "force": ["z-min",
                    "z-max"]})
    p, area = run.last("probes"), 36 * DX**2
    yield "u at a quarter", 0.05, p["u"], 0.005
    yield "v at a quarter", 0.15, p["v"], 0.005
    yield "force on the lower wall along x", -MU * 0.2 / H * area, run.force("z-min")[0], 0.005
    yield "force on the upper wall along y", MU * 0.2 / H * area, run.force("z-max")[1], 0.005
