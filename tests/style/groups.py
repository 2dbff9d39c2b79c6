#!/usr/bin/env python3
"""Which sources of a target can be compiled as one: those whose private names differ.

usage: groups.py FILE...        prints a line "GROUP FILE" for each that was not made by the build

Headers are half of a compilation under sanitizers and nine tenths of a look of clang-tidy. Sources that stand together share them, but
then also what they keep in `namespace { }`: two that use one name there must stay apart. Names are found by the shape of a
line, rather too many than too few. Read by tools/together.cmake and check_tidy.py.
"""

import re
import sys
from pathlib import Path

LARGEST = 8  # with more a single compilation takes a minute, and one change costs it again
OVERLOADED = {"describe"}  # of cases/format: one for each table of a case file, told apart by its arguments
PRIVATE = re.compile(r"^namespace \{$(.*?)^\}  // namespace$", re.DOTALL | re.MULTILINE)
TYPE = re.compile(r"^(?:template <.*?> )?(?:struct|class|union|enum(?: class)?) (\w+)")
OTHER = re.compile(r"(\w+)\s*(?:\[[^\]]*\]\s*)*(?:\(|=|\{|;)")
NO_NAMES = re.compile(r"[\s}/#)]|using |namespace |template <[^>]*>$|static_assert|requires |public:|private:|$")


def private_names(text: str) -> set[str]:
    names = set()
    for line in re.findall(r"^const.*", text, re.MULTILINE):  # private wherever it stands
        names.update(re.findall(r"(\w+)(?:\[[^\]]*\])*(?: =|\{|\()", line))
    for line in (line for block in PRIVATE.findall(text) for line in block.split("\n")):
        if NO_NAMES.match(line) or line.startswith("const"):
            continue
        if found := TYPE.match(line):
            names.add(found.group(1))
        elif found := OTHER.search(line):
            names.add(found.group(1))
    return names - OVERLOADED | set(re.findall(r"^static .*?(\w+)\(", text, re.MULTILINE))


def groups(files: list) -> list[list]:
    """Each file goes to the first group that has room and none of its names."""
    made: list[tuple[list, set[str]]] = []
    for file in files:
        names = private_names(Path(file).read_text(encoding="utf-8"))
        for members, taken in made:
            if len(members) < LARGEST and not names & taken:
                members.append(file)
                taken |= names
                break
        else:
            made.append(([file], names))
    return [members for members, _ in made]


if __name__ == "__main__":
    for number, members in enumerate(groups([name for name in sys.argv[1:] if name.endswith(".cpp") and not Path(name).is_absolute()])):
        for member in members:
            print(number, member)
