#!/usr/bin/env python3
"""puffin doctor on a sound machine and on bad ones: what it says, and its exit code (0, or 6 where the machine lacks something).

usage: check_doctor.py PROGRAM

Bad machines are made of this one: folders that cannot be written, limits of address space and processors, a disk of a
megabyte or one that is read-only (in a mount name space of its own; said to be left out where that is not allowed).
"""

import os
import re
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

MOUNT = ["unshare", "--map-root-user", "--mount", "sh", "-c"]


def doctor(program: str, before=(), cwd=None, environment=None, address_space: int = 0) -> tuple[int, str]:
    def limit():
        if address_space:
            resource.setrlimit(resource.RLIMIT_AS, (address_space, address_space))

    run = subprocess.run([*before, program, "doctor"], cwd=cwd, env=os.environ | (environment or {}), preexec_fn=limit,
                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=120, check=False)
    return run.returncode, run.stdout


def on_mount(program: str, folder: str, options: str) -> tuple[int, str]:
    return doctor(program, [*MOUNT, f'mount -t tmpfs -o {options} none {folder} && cd {folder} && exec "$0" "$@"'])


def machines(program: str, folder: str) -> list[tuple[str, tuple[int, str], int, str]]:
    """What, what came of it, the exit code and a pattern of a line that are asked for."""
    closed = Path(folder) / "a file"
    closed.write_text("no folder")
    rows = [
        ("a sound machine", doctor(program), 0, r"^memory +[\d.]+ .B available$"),
        ("no folder for scratch files", doctor(program, environment={"TMPDIR": "/nowhere"}), 6,
         r"^scratch +FAILED: .*: set TMPDIR to a folder that can be written$"),
        ("a file for scratch files", doctor(program, environment={"TMPDIR": str(closed)}), 6,
         r"^scratch +FAILED: .*: set TMPDIR to a folder that can be written$"),
        ("little address space", doctor(program, address_space=600 << 20), 6,
         r"^memory +FAILED: [\d.]+ .B available; a device at the default cell needs about"),
        ("hardly any address space", doctor(program, address_space=300 << 20), 6, r"^lattice +"),
        ("a lesser instruction set", doctor(program, environment={"PUFFIN_ISA": "baseline"}), 0,
         r"^kernel +baseline"),
        ("an unknown instruction set", doctor(program, environment={"PUFFIN_ISA": "sse9"}), 2,
         r"PUFFIN_ISA.*sse9.*is no instruction set; baseline, avx2 and avx512 are"),
    ]
    if len(os.sched_getaffinity(0)) > 1:
        rows.append(("one processor of several", doctor(program, ["taskset", "--cpu-list", "0"]), 0,
                     r"^threads +1 of \d+ \(taskset or a container holds back the others\)$"))
    if subprocess.run([*MOUNT, f"mount -t tmpfs none {folder}"], capture_output=True, check=False).returncode == 0:
        rows += [
            ("a disk of a megabyte", on_mount(program, folder, "size=1m"), 6, r"^disk +FAILED: .* free in .*: free some"),
            ("a read-only disk", on_mount(program, folder, "ro"), 6, r"^disk +FAILED: .* cannot be written"),
            ("a megabyte for scratch files",
             doctor(program, [*MOUNT, f'mount -t tmpfs -o size=1m none {folder} && exec "$0" "$@"'],
                    environment={"TMPDIR": folder}), 6, r"^scratch +FAILED: .* free in .*: set TMPDIR"),
        ]
        no_proc = doctor(program, [*MOUNT, 'mount -t tmpfs none /proc && exec "$0" "$@"'])
        rows += [("no /proc", no_proc, 6, r"^system +FAILED: /proc is not mounted: .*: mount -t proc proc /proc$"),
                 ("memory without /proc", no_proc, 6, r"^memory +\d[\d.]* .B available$")]
    else:
        print("left out: disks (no mount name space here)")
    return rows


def main(program: str) -> int:
    faults = 0
    with tempfile.TemporaryDirectory() as folder:
        for what, (code, said), wanted, pattern in machines(str(Path(program).resolve()), folder):
            good = code == wanted and re.search(pattern, said, re.MULTILINE) is not None
            print(f"{'ok  ' if good else 'FAIL'}  {what}: exit code {code}")
            if not good:
                print(f"      asked for {wanted} and a line {pattern}\n{said}")
                faults += 1
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
