"""Surfaces of our own as STL, ASCII or binary: prisms along an axis and bodies made of blocks, turned as one likes."""
import math
import struct


def prism(section, length):
    """A convex section (y, z), counter-clockwise, drawn along x: solids inlet, outlet, wall."""
    n = len(section)
    cy, cz = sum(p[0] for p in section) / n, sum(p[1] for p in section) / n
    solids = {"inlet": [], "outlet": [], "wall": []}
    for i in range(n):
        (y0, z0), (y1, z1) = section[i], section[(i + 1) % n]
        a, b = (0.0, y0, z0), (0.0, y1, z1)
        c, d = (length, y1, z1), (length, y0, z0)
        solids["wall"] += [(a, b, c), (a, c, d)]
        solids["inlet"].append(((0.0, cy, cz), b, a))
        solids["outlet"].append(((length, cy, cz), d, c))
    return solids


def ring(outer, inner, length, sides=96):
    """The gap between two round tubes: solids inlet, outlet, wall (outer), core (inner)."""
    def circle(r, x, i):
        angle = 2 * math.pi * i / sides
        return (x, r * math.cos(angle), r * math.sin(angle))
    # circumscribed and inscribed polygons of equal area, so that the gap is right on average
    k = math.sqrt(2 * math.pi / sides / math.sin(2 * math.pi / sides))
    solids = {"inlet": [], "outlet": [], "wall": [], "core": []}
    for i in range(sides):
        a, b = circle(outer * k, 0.0, i), circle(outer * k, 0.0, i + 1)
        c, d = circle(outer * k, length, i + 1), circle(outer * k, length, i)
        e, f = circle(inner * k, 0.0, i), circle(inner * k, 0.0, i + 1)
        g, h = circle(inner * k, length, i + 1), circle(inner * k, length, i)
        solids["wall"] += [(a, b, c), (a, c, d)]
        solids["core"] += [(e, h, g), (e, g, f)]
        solids["inlet"] += [(a, f, b), (a, e, f)]
        solids["outlet"] += [(d, g, h), (d, c, g)]
    return solids


def blocks(xs, ys, zs, filled, name):
    """The surface of the fluid in cells of a coarse grid: filled(i, j, k) says where it is, name(axis, sign, i, j, k)
    what a face of such a cell is called."""
    grid, solids = (xs, ys, zs), {}
    count = [len(g) - 1 for g in grid]
    for i in range(count[0]):
        for j in range(count[1]):
            for k in range(count[2]):
                if not filled(i, j, k):
                    continue
                for axis in range(3):
                    for sign in (-1, 1):
                        other = [i, j, k]
                        other[axis] += sign
                        if 0 <= other[axis] < count[axis] and filled(*other):
                            continue
                        at = grid[axis][[i, j, k][axis] + (sign > 0)]
                        u, v = (axis + 1) % 3, (axis + 2) % 3
                        corner = []
                        for du, dv in ((0, 0), (1, 0), (1, 1), (0, 1)):
                            p = [0.0] * 3
                            p[axis], p[u], p[v] = at, grid[u][[i, j, k][u] + du], grid[v][[i, j, k][v] + dv]
                            corner.append(tuple(p))
                        if sign < 0:
                            corner.reverse()
                        solids.setdefault(name(axis, sign, i, j, k), []).extend(
                            [(corner[0], corner[1], corner[2]), (corner[0], corner[2], corner[3])])
    return solids


def turn(matrix, p):
    return tuple(sum(matrix[i][k] * p[k] for k in range(3)) for i in range(3))


def frame(axis, seed=(0.0, 0.0, 1.0)):
    """A rotation matrix that takes x to the axis; z stays as near to the seed as it can."""
    def unit(v):
        size = math.sqrt(sum(c * c for c in v))
        return [c / size for c in v]

    def cross(a, b):
        return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    x = unit(axis)
    y = unit(cross(seed, x))
    z = cross(x, y)
    return [[x[i], y[i], z[i]] for i in range(3)]


def ascii_stl(solids, matrix=None, unit=1.0):
    text = []
    for name, triangles in solids.items():
        text.append(f"solid {name}")
        for t in triangles:
            text.append(" facet normal 0 0 0\n  outer loop")
            for p in t:
                q = turn(matrix, p) if matrix else p
                text.append("   vertex " + " ".join(f"{c / unit:.9g}" for c in q))
            text.append("  endloop\n endfacet")
        text.append(f"endsolid {name}")
    return "\n".join(text) + "\n"


def binary_stl(solids, matrix=None, unit=1.0):
    triangles = [t for group in solids.values() for t in group]
    data = bytearray(b"scene".ljust(80, b" ") + struct.pack("<I", len(triangles)))
    for t in triangles:
        data += struct.pack("<3f", 0, 0, 0)
        for p in t:
            q = turn(matrix, p) if matrix else p
            data += struct.pack("<3f", *(c / unit for c in q))
        data += b"\0\0"
    return bytes(data)
