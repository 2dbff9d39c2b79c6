#!/usr/bin/env python3
"""The order of the layers: a folder includes only what lies below it, and the lower layers stay silent.

usage: check_layers.py ROOT
"""

import re
import sys
from pathlib import Path

from tree import conclude, cpp, text

# What the files of a folder may include, besides their own folder. The longest matching folder counts.
ALLOWED = {
    "lbm": set(),
    "lbm/geometry": set(),
    "dem": set(),
    "micromodels": set(),
    "micromodels/derivation": {"micromodels", "dem"},
    "coupling": {"lbm", "dem", "micromodels"},
    "cases": {"lbm", "dem", "micromodels", "coupling"},
    "tools": {"lbm", "dem", "micromodels", "coupling", "cases"},
    "tests": {"lbm", "dem", "micromodels", "coupling", "cases", "tools"},
}
OWN = {"lbm/geometry": "lbm/geometry", "micromodels/derivation": "micromodels"}  # else the top-level folder
REASON = {
    "lbm/geometry": "lbm/geometry knows no lattice",
    "micromodels": "only micromodels/derivation/ may use dem",
}
SOLVER = {"lbm", "dem", "micromodels", "coupling", "cases"}  # build without VTK; never print or exit

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
LOUD = re.compile(r"\bstd::(cout|cerr|clog|exit|abort|quick_exit|terminate|printf|puts)\b|(?<![\w:.>])f?printf\s*\(")
COMMENT = re.compile(r"//.*|/\*.*?\*/")
STRING = re.compile(r'"(?:[^"\\]|\\.)*"')


def layer_of(path: Path) -> str:
    folder = path.parent
    while folder.as_posix() not in ALLOWED and folder.name:
        folder = folder.parent
    return folder.as_posix()


def inside(path: str, folder: str) -> bool:
    return path.startswith(folder + "/")


def faults_in_line(layer: str, line: str) -> list[str]:
    faults = []
    include = INCLUDE.match(line)
    if include:
        kind, target = include.groups()
        top = target.split("/")[0]
        if kind == "<":
            if layer.split("/")[0] in SOLVER and re.match(r"vtk\w*\.h", target):
                faults.append(f"includes {target}: the solver folders build without VTK")
            if layer.split("/")[0] in SOLVER and target == "iostream":
                faults.append("includes <iostream>: libraries never print; throw, or return the text")
        elif "/" not in target or top not in ALLOWED:
            faults.append(f'includes "{target}": write the path from the root, "folder/file.hpp"; <...> for other people\'s')
        elif not inside(target, OWN.get(layer, layer)) and not any(inside(target, f) for f in ALLOWED[layer]):
            reason = REASON.get(layer, f"{layer} may include {', '.join(sorted(ALLOWED[layer])) or 'nothing of ours'}")
            faults.append(f'includes "{target}": {reason}')
        return faults
    if layer.split("/")[0] in SOLVER:
        loud = LOUD.search(COMMENT.sub("", STRING.sub('""', line)))
        if loud:
            faults.append(f"{loud.group().rstrip('( ')}: libraries never print or exit; throw a standard exception")
    return faults


def check(root: Path) -> list[str]:
    faults = []
    for path in cpp(root):
        layer = layer_of(path)
        if layer not in ALLOWED:
            faults.append(f"{path}: C++ outside the folders {', '.join(sorted(ALLOWED))}")
            continue
        for number, line in enumerate(text(root, path).splitlines(), start=1):
            faults += [f"{path}:{number}: {fault}" for fault in faults_in_line(layer, line)]
    return faults


if __name__ == "__main__":
    sys.exit(conclude("order of the layers", check(Path(sys.argv[1]))))
