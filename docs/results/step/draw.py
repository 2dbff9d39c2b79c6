#!/usr/bin/env python3
"""Draws behind-the-step.svg from behind-the-step.csv: mean velocity along the floor, one curve a grid."""
import csv
import pathlib

here = pathlib.Path(__file__).parent
lines = [line for line in open(here / "behind-the-step.csv") if not line.startswith("#")]
curves = {}
for row in csv.DictReader(lines):
    if row["line"] == "along":
        curves.setdefault(row["dx_mm"], []).append((float(row["x_mm"]), float(row["u"])))

WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 760, 360, 64, 150, 24, 52
LOW, HIGH, END = -6.0, 30.0, 14.0
COLOURS = ["#b8c4d0", "#8fa9c4", "#d1495b", "#2e7d6b", "#1b3a6b"]


def at(x, u):
    return LEFT + (WIDTH - LEFT - RIGHT) * x / END, HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * (u - LOW) / (HIGH - LOW)


out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="system-ui, sans-serif" '
       'font-size="13"><rect width="100%" height="100%" fill="#fff"/>']
for u in range(-5, 31, 5):
    x, y = at(0, u)
    out.append(f'<line x1="{x}" y1="{y:.1f}" x2="{WIDTH - RIGHT}" y2="{y:.1f}" stroke="{"#5f6873" if u == 0 else "#e3e6ea"}"/>'
               f'<text x="{x - 8}" y="{y + 4:.1f}" text-anchor="end">{u}</text>')
for x in range(0, 15, 2):
    out.append(f'<text x="{at(x, 0)[0]:.1f}" y="{HEIGHT - BOTTOM + 18}" text-anchor="middle">{x}</text>')
x0, x1 = at(1, 0)[0], at(6, 0)[0]
out.append(f'<rect x="{x0:.1f}" y="{TOP}" width="{x1 - x0:.1f}" height="{HEIGHT - TOP - BOTTOM}" fill="#e9b44c" opacity="0.18"/>'
           f'<text x="{0.5 * (x0 + x1):.1f}" y="{TOP + 16}" text-anchor="middle" fill="#7a5a12">the dose</text>')
for n, (dx, points) in enumerate(curves.items()):
    path = " ".join("{:.1f},{:.1f}".format(*at(*p)) for p in points)
    y = TOP + 20 + 20 * n
    out.append(f'<polyline fill="none" stroke="{COLOURS[n]}" stroke-width="2" points="{path}"/>'
               f'<line x1="{WIDTH - RIGHT + 12}" y1="{y}" x2="{WIDTH - RIGHT + 36}" y2="{y}" stroke="{COLOURS[n]}" stroke-width="3"/>'
               f'<text x="{WIDTH - RIGHT + 42}" y="{y + 4}">dx {float(dx):.3g} mm</text>')
out.append(f'<text x="{0.5 * (LEFT + WIDTH - RIGHT)}" y="{HEIGHT - 12}" text-anchor="middle">distance from the step, mm</text>'
           f'<text transform="translate(18 {0.5 * HEIGHT}) rotate(-90)" text-anchor="middle">velocity 0.4 mm above the floor, m/s</text></svg>')
(here / "behind-the-step.svg").write_text("\n".join(out) + "\n")
