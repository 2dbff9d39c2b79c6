#!/usr/bin/env python3
"""Every bad input of table.toml ends with its exit code and its exact message, soon, in bounded memory, writing nothing.

usage: run_table.py PROGRAM [--only WORD] [--show] [--document FILE [--write]] [--sanitized]

Each input runs in an empty folder of its own that holds case.toml (the sound base with the input's changes) and the
input's files. The program then
  - ends within 20 s, with the exit code `exit`; never by a signal;
  - says `message`, each of its lines a whole line of stderr, byte for byte ({here} stands for the folder,
    {prefix} for where the program is installed, {source} for this tree), and no other line with "error: ";
  - needs less than 2 GB of address space on one thread;
  - leaves no file that was not there, in the folder or beside it, unless `leaves` names it.
--show prints what is said instead of comparing. --document compares FILE with the table as a page; --write makes it.
--sanitized: for a program with the address sanitizer, which is slow and takes terabytes of address space: 200 s an input, no limit of
memory, and without the inputs that need that limit (`limited = true`).

Keys of an [[input]]: what, exit, message, and any of: replace (list of [old, new] in the base), append, case (instead
of the base), files (name -> text, or { hex = "..." } or { repeat = "text", times = n }, or a list of these), arguments (default: check
case.toml), environment, leaves, on_stdout (the message is a result: that of plan), limited, setup (shell commands run before in
the folder).
"""

import argparse
import os
import resource
import subprocess
import sys
import tempfile
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

SECONDS = 20
SANITIZED_SECONDS = 200
ADDRESS_SPACE = 2 << 30  # bytes
HERE = Path(__file__).resolve().parent


def content(value) -> bytes:
    if isinstance(value, str):
        return value.encode()
    if isinstance(value, list):
        return b"".join(map(content, value))
    if "hex" in value:
        return bytes.fromhex(value["hex"])
    return value.get("head", "").encode() + value["repeat"].encode() * value["times"] + value.get("tail", "").encode()


def prepare(folder: Path, base: str, row: dict) -> None:
    text = row.get("case", base)
    for old, new in row.get("replace", []):
        if text.count(old) != 1:
            raise SystemExit(f"{row['what']}: '{old}' stands {text.count(old)} times in the base, not once")
        text = text.replace(old, new)
    (folder / "case.toml").write_bytes(content(text) + row.get("append", "").encode()
                                       if not isinstance(text, str) else (text + row.get("append", "")).encode())
    for name, value in row.get("files", {}).items():
        (folder / name).write_bytes(content(value))
    for command in row.get("setup", []):
        subprocess.run(command, shell=True, cwd=folder, check=True)


def listing(folder: Path) -> set[str]:
    return {str(path.relative_to(folder)) for path in folder.rglob("*")}


def limits() -> None:
    resource.setrlimit(resource.RLIMIT_AS, (ADDRESS_SPACE, ADDRESS_SPACE))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def attempt(program: str, base: str, row: dict, sanitized: bool) -> tuple[int | str, str, set[str]]:
    with tempfile.TemporaryDirectory() as outer:
        folder = Path(outer) / "here"
        folder.mkdir()
        prepare(folder, base, row)
        before = listing(Path(outer))
        environment = {**os.environ, "NO_COLOR": "1", **row.get("environment", {})}
        seconds, limit = (SANITIZED_SECONDS, None) if sanitized else (SECONDS, limits)
        try:
            run = subprocess.run([program, *row.get("arguments", ["check", "case.toml"])], cwd=folder, env=environment,
                                 capture_output=True, timeout=seconds, preexec_fn=limit, stdin=subprocess.DEVNULL,
                                 check=False)
            code, said = run.returncode, (run.stdout if row.get("on_stdout") else run.stderr).decode(errors="replace")
        except subprocess.TimeoutExpired:
            code, said = f"none within {seconds} s", ""
        left = {name.removeprefix("here/") for name in listing(Path(outer)) - before}
        prefix, source = Path(program).parents[1], HERE.parents[2]
        for path, name in ((folder, "{here}"), (prefix, "{prefix}"), (source, "{source}")):
            said = said.replace(str(path), name)
        return code, said, left


def faults(row: dict, outcome: tuple[int | str, str, set[str]]) -> list[str]:
    code, said, left = outcome
    found = []
    if code != row["exit"]:
        found.append(f"exit code {code}, not {row['exit']}")
    lines = said.splitlines()
    wanted = row["message"].splitlines()
    found += [f"does not say: {line}" for line in wanted if line not in lines]
    found += [f"says besides: {line}" for line in lines if "error: " in line and line not in wanted]
    if not wanted:
        found.append("the table has no message")
    if left != set(row.get("leaves", [])):
        found.append(f"leaves {sorted(left)}, not {sorted(row.get('leaves', []))}")
    if found:
        found.append("it says:\n" + said)
    return found


def page(rows: list[dict]) -> str:
    def change(row: dict) -> str:
        if "arguments" in row:
            return "`puffin " + " ".join(row["arguments"]) + "`"
        return "`puffin check`"

    lines = ["# Bad inputs and what is said", "",
             "Made from `tests/tools/bad_inputs/table.toml` by `run_table.py`; the test `bad_inputs` runs every row and checks",
             "exit code, message, time, memory, and that nothing is left behind.", "",
             "| input | command | exit | message |", "|---|---|---|---|"]
    for row in rows:
        message = "<br>".join("`" + line.replace("|", "\\|") + "`" for line in row["message"].splitlines())
        lines.append(f"| {row['what']} | {change(row)} | {row['exit']} | {message} |")
    return "\n".join(lines) + "\n"


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=lambda given: str(Path(given).resolve()))  # each input has a folder of its own
    parser.add_argument("--only", default="")
    parser.add_argument("--show", action="store_true")
    parser.add_argument("--document", type=Path)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--sanitized", action="store_true")
    options = parser.parse_args()
    table = tomllib.loads((HERE / "table.toml").read_text())
    rows = [row for row in table["input"] if options.only in row["what"] and not (options.sanitized and row.get("limited"))]
    if options.write:
        options.document.write_text(page(table["input"]))
    with ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        outcomes = list(pool.map(lambda row: attempt(options.program, table["base"], row, options.sanitized), rows))
    bad = 0
    for row, outcome in zip(rows, outcomes):
        if options.show:
            print(f"== {row['what']}\n{outcome[0]} {sorted(outcome[2])}\n{outcome[1]}")
            continue
        if found := faults(row, outcome):
            bad += 1
            print(f"{row['what']}:\n  " + "\n  ".join(found))
    if options.document and options.document.read_text() != page(table["input"]):
        print(f"{options.document} is not the table as a page; make it with --document {options.document} --write")
        bad += 1
    print(f"{len(rows)} bad inputs, {bad} faults")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
