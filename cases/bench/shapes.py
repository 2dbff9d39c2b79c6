#!/usr/bin/env python3
"""Writes the surfaces and the starting air of the cases P4 and P4b: python3 cases/bench/shapes.py.

p4-duct/duct-DEGREES.stl: the square duct of V14, 2 x 2 x 12.5 mm, turned about its axis x; start-DEGREES.csv: the air of
cases/verify/turbulent-duct/start.csv turned likewise, still outside the walls.
p4b-contraction/offset-NN.stl: a channel 10 mm high and 30 mm long that ends in a gap 5 mm high and 15 mm long, whose walls lie NN
hundredths of a cell of 0.5 mm above a cell's face (the larger walls, of the channel, lie on faces); not in the middle, where the
gap of offset 0 alone would be symmetric.
"""
import csv
import math
import pathlib

HERE = pathlib.Path(__file__).resolve().parent


def normal(p, q, r):
    a, b = [y - x for x, y in zip(p, q)], [y - x for x, y in zip(p, r)]
    n = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
    return [v / math.hypot(*n) for v in n]


def write_stl(file, solids):
    """solids: name -> polygons (flat, convex, counter-clockwise from outside) [mm]."""
    with open(file, "w") as out:
        for name, polygons in solids.items():
            out.write(f"solid {name}\n")
            for p in polygons:
                for k in range(1, len(p) - 1):
                    n = normal(p[0], p[k], p[k + 1])
                    out.write(" facet normal {:.9g} {:.9g} {:.9g}\n  outer loop\n".format(*n))
                    for x in (p[0], p[k], p[k + 1]):
                        out.write("   vertex {:.9g} {:.9g} {:.9g}\n".format(*x))
                    out.write("  endloop\n endfacet\n")
            out.write(f"endsolid {name}\n")


def duct(degrees):
    length, half = 12.5, 1.0
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    corners = [(c * y - s * z, s * y + c * z) for y, z in ((-half, -half), (half, -half), (half, half), (-half, half))]
    low, high = [(0.0, *p) for p in corners], [(length, *p) for p in corners]
    walls = [[low[k], low[(k + 1) % 4], high[(k + 1) % 4], high[k]] for k in range(4)]
    write_stl(HERE / f"p4-duct/duct-{degrees}.stl", {"low": [low[::-1]], "high": [high], "wall": walls})

    with open(HERE / "../verify/turbulent-duct/start.csv") as f:
        rows = [[float(v) for v in row] for row in list(csv.reader(f))[1:]]
    axes = [sorted({row[k] for row in rows}) for k in range(3)]
    n = [len(a) for a in axes]

    def at(i, y, z):
        """Bilinear in the plane i of x; y, z [m] from the corner."""
        j, k = (min(int(v / axes[1][1]), n[1] - 2) for v in (y, z))
        a, b = y / axes[1][1] - j, z / axes[2][1] - k
        total = [0.0, 0.0, 0.0]
        for dj, dk, weight in ((0, 0, (1 - a) * (1 - b)), (1, 0, a * (1 - b)), (0, 1, (1 - a) * b), (1, 1, a * b)):
            row = rows[((k + dk) * n[1] + j + dj) * n[0] + i]  # x runs fastest
            total = [t + weight * v for t, v in zip(total, row[3:])]
        return total

    reach = 1e-3 * (abs(c) + abs(s))
    across = [reach * (k / 6.0 - 1.0) for k in range(13)]
    with open(HERE / f"p4-duct/start-{degrees}.csv", "w") as out:
        out.write("x,y,z,u,v,w\n")
        for z in across:
            for y in across:
                own = c * y + s * z + 1e-3, -s * y + c * z + 1e-3
                inside = all(-1e-9 <= v <= 2e-3 + 1e-9 for v in own)
                for i, x in enumerate(axes[0]):
                    u, v, w = at(i, *(min(max(v, 0.0), 2e-3) for v in own)) if inside else (0.0, 0.0, 0.0)
                    out.write("{:.6g},{:.6g},{:.6g},{:.3g},{:.3g},{:.3g}\n".format(
                        x, y, z, u, c * v - s * w, s * v + c * w))


def contraction(hundredths):
    width, height, gap, x1, x2 = 5.0, 10.0, 5.0, 30.0, 45.0
    a = 1.5 + 0.5 * hundredths / 100.0
    b = a + gap
    outline = [(0, 0), (x1, 0), (x1, a), (x2, a), (x2, b), (x1, b), (x1, height), (0, height)]  # counter-clockwise in x, z
    solids = {"inlet": [], "outlet": [], "wall": []}
    for p, q in zip(outline, outline[1:] + outline[:1]):
        face = [(p[0], 0, p[1]), (p[0], width, p[1]), (q[0], width, q[1]), (q[0], 0, q[1])]
        solids["outlet" if p[0] == q[0] == x2 else "inlet" if p[0] == q[0] == 0 else "wall"].append(face)
    # Every edge must meet whole: the wide part has the corners of the gap on its end. Fans from a corner beyond that end.
    blocks = [[(0, height), (0, 0), (x1, 0), (x1, a), (x1, b), (x1, height)], [(x1, a), (x2, a), (x2, b), (x1, b)]]
    solids["y-min"] = [[(x, 0, z) for x, z in block] for block in blocks]
    solids["y-max"] = [[(x, width, z) for x, z in block[:1] + block[:0:-1]] for block in blocks]
    write_stl(HERE / f"p4b-contraction/offset-{hundredths:02d}.stl", solids)


if __name__ == "__main__":
    for angle in (0, 17, 45):
        duct(angle)
    for offset in (0, 20, 35):
        contraction(offset)
