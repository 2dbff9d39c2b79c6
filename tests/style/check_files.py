#!/usr/bin/env python3
"""House rules that concern whole files: folders, READMEs, lengths, links, and words that must not be committed.

usage: check_files.py ROOT
"""

import re
import sys
from pathlib import Path

from tree import TOP_FOLDERS, conclude, text, tracked

README_LINES = 40
CPP_LINES = 400
# A longer file says why: its first comment holds "Long because ..." or "Long, because ...".
LONG_BECAUSE = re.compile(r"\blong,? because\b", re.IGNORECASE)
# Spelt in pieces, so that this file passes its own check.
UNFINISHED = re.compile(r"\b(" + "|".join(("TO" + "DO", "FIX" + "ME", "XX" + "X")) + r")\b")
MACHINE_PATH = re.compile(r"(?<![\w./~$}-])/(" + "|".join(("tmp", "root", "home", "work")) + r")/")
LINK = re.compile(r"\]\(([^)\s]+)\)")
# A file named in the text, `folder/file.ext`; capitals stand for a name of the reader's choice.
NAMED = re.compile(r"`((?:" + "|".join(TOP_FOLDERS) + r")/[a-z0-9_./-]+\.(?:hpp|cpp|md|py|toml|txt))`")
HISTORY = ("CHANGELOG.md", "docs/decisions/")  # may name what is gone


def first_comment(source: str) -> str:
    """The first block of comment lines of a C++ file."""
    lines = []
    for line in source.splitlines():
        if line.startswith("//"):
            lines.append(line.lstrip("/ "))
        elif lines:
            break
    return " ".join(lines)


def check_folders(root: Path, paths: list[Path]) -> list[str]:
    present = {path.parts[0] for path in paths if len(path.parts) > 1}
    faults = [f"{name}/: no such top-level folder in this house; it has {', '.join(TOP_FOLDERS)} and .ci"
              for name in sorted(present - set(TOP_FOLDERS) - {".ci"})]
    for name in sorted(present & set(TOP_FOLDERS)):
        readme = root / name / "README.md"
        if not readme.is_file():
            faults.append(f"{name}/: has no README.md (what lives here, what it may include, how to add one thing)")
        elif len(readme.read_text().splitlines()) > README_LINES:
            faults.append(f"{name}/README.md: more than {README_LINES} lines")
    return faults


def check_text(path: Path, content: str) -> list[str]:
    faults = []
    for number, line in enumerate(content.splitlines(), start=1):
        unfinished = UNFINISHED.search(line)
        if unfinished:
            faults.append(f"{path}:{number}: {unfinished.group()}: finish it, or file an issue")
        machine = MACHINE_PATH.search(line)
        if machine:
            faults.append(f"{path}:{number}: {machine.group()}...: a path of one machine")
    if path.suffix in (".cpp", ".hpp"):
        lines = len(content.splitlines())
        if lines > CPP_LINES and not LONG_BECAUSE.search(first_comment(content.removeprefix("#pragma once\n"))):
            faults.append(f'{path}: {lines} lines; split it, or say "Long because ..." in its first comment')
    return faults


def check_links(root: Path, path: Path, content: str) -> list[str]:
    """What a Markdown file links to, or names, in the repository is there."""
    faults = []
    names_must_exist = not path.as_posix().startswith(HISTORY)
    for number, line in enumerate(content.splitlines(), start=1):
        for target in LINK.findall(line):
            place = target.split("#")[0]
            if place and "://" not in target and not target.startswith("mailto:"):
                if not (root / path.parent / place).exists():
                    faults.append(f"{path}:{number}: the link {target} leads nowhere")
        for name in NAMED.findall(line) if names_must_exist else ():
            if not (root / name).is_file():
                faults.append(f"{path}:{number}: there is no {name}")
    return faults


def check(root: Path) -> list[str]:
    paths = tracked(root)
    faults = check_folders(root, paths)
    for path in paths:
        content = text(root, path)
        if content is None or path.suffix == ".stl":
            continue
        faults += check_text(path, content)
        if path.suffix == ".md":
            faults += check_links(root, path, content)
    return faults


if __name__ == "__main__":
    sys.exit(conclude("house rules", check(Path(sys.argv[1]))))
