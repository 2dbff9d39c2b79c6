#!/usr/bin/env python3
"""The table of soak.py as a picture: memory and the error of the ledger over the minutes.

usage: draw.py TABLE.csv PICTURE.svg
"""

import csv
import sys
from pathlib import Path

WIDTH, HEIGHT, LEFT, TOP = 640, 150, 70, 28


def panel(offset: int, title: str, minutes: list[float], values: list[float], top: float, unit: str) -> list[str]:
    """One curve from 0 to `top`, with its range at the left and the minutes below."""
    def at(minute: float, value: float) -> str:
        x = LEFT + (WIDTH - LEFT - 20) * minute / minutes[-1]
        return f"{x:.1f},{offset + TOP + HEIGHT * (1 - value / top):.1f}"

    base = offset + TOP + HEIGHT
    lines = [f'<text x="{LEFT}" y="{offset + 18}">{title}</text>',
             f'<path d="M{LEFT},{offset + TOP}V{base}H{WIDTH - 20}" fill="none" stroke="#888"/>',
             f'<text x="{LEFT - 6}" y="{offset + TOP + 5}" text-anchor="end">{top:.3g} {unit}</text>',
             f'<text x="{LEFT - 6}" y="{base}" text-anchor="end">0</text>']
    for tick in range(0, int(minutes[-1]) + 1, 10):
        x = at(tick, 0.0).split(",")[0]
        lines.append(f'<text x="{x}" y="{base + 15}" text-anchor="middle">{tick}</text>')
    points = " ".join(at(m, v) for m, v in zip(minutes, values))
    return lines + [f'<polyline points="{points}" fill="none" stroke="#1b6ca8" stroke-width="2"/>']


def main(table: str, picture: str) -> None:
    with open(table, newline="", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["ledger_error"] != "nan"]
    minutes = [float(row["minute"]) for row in rows]
    memory = [float(row["resident_MB"]) for row in rows]
    ledger = [abs(float(row["ledger_error"])) for row in rows]
    body = panel(0, "resident memory over the minutes of the run", minutes, memory, 1.2 * max(memory), "MB")
    body += panel(HEIGHT + 60, "error of the fines' ledger, of the dose (limit 1e-12)", minutes, ledger,
                  1.2 * max(ledger) or 1e-16, "")
    height = 2 * (HEIGHT + 60)
    Path(picture).write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{height}" font-family="sans-serif" '
        f'font-size="12">\n<rect width="100%" height="100%" fill="white"/>\n' + "\n".join(body) + "\n</svg>\n",
        encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:3])
