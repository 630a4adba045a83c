"""Compares an adapter with a program written against the engine's own API, bit for bit.

Runs the named cases through `plumbline run` and through the raw program, for both profiles, and compares every number
of both trajectories as 64 bits: -0 is not 0 here, and a NaN is only itself.
"""
import argparse
import csv
import struct
import subprocess
import sys
from pathlib import Path

CASES = ["particle/falling_box", "particle/drag_ship/v0=30", "collision/two_sphere/e=0.5,b=0.48",
         "rotation/free_rotation", "joint/pendulum", "friction/incline/mu=0.2"]
DT = "0.02"
UNSUPPORTED = 77


def rows_of(path):
    """Time and body name of every row, and its 13 numbers as bits."""
    with open(path, newline="") as file:
        lines = list(csv.reader(file))
    return [(line[0], line[1], [struct.pack("<d", float(x)) for x in line[2:]]) for line in lines[1:]], lines[0]


def difference(ours, theirs):
    """What is the first thing that differs, in words; empty when nothing does."""
    (a, head), (b, other_head) = rows_of(ours), rows_of(theirs)
    if head != other_head:
        return f"the columns differ: {head} and {other_head}"
    if len(a) != len(b):
        return f"{len(a)} rows and {len(b)} rows"
    for (t, body, x), (u, other, y) in zip(a, b):
        if body != other or float(t) != float(u):
            return f"row t={t} {body} stands beside t={u} {other}"
        for name, p, q in zip(head[2:], x, y):
            if p != q:
                p, q = struct.unpack("<d", p)[0], struct.unpack("<d", q)[0]
                return f"t={t} {body}.{name}: adapter {p!r} ({p.hex()}), raw {q!r} ({q.hex()})"
    return ""


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("plumbline", "raw", "row", "work"):
        parser.add_argument(f"--{name}", required=True)
    options = parser.parse_args()
    work = Path(options.work)
    work.mkdir(parents=True, exist_ok=True)
    selected = sum((["-f", "^" + case.replace(".", r"\.") + "/"] for case in CASES), [])
    run = subprocess.run([options.plumbline, "run", "-q", "-e", options.row, "--dt", DT, "-o", str(work / "results"),
                          *selected], capture_output=True, text=True)
    if run.returncode not in (0, 1):
        sys.exit(f"plumbline run ended with {run.returncode}:\n{run.stdout}{run.stderr}")
    failures, compared = [], 0
    for case in CASES:
        for profile in ("default", "matched"):
            name = f"{case} {options.row}.{profile}"
            ours = work / "results" / "trajectories" / case / f"{options.row}.{profile}.dt={DT}.csv"
            theirs = work / (case.replace("/", "_") + "." + profile + ".csv")
            theirs.unlink(missing_ok=True)
            raw = subprocess.run([options.raw, options.row, case, profile, DT, str(theirs)], capture_output=True,
                                 text=True, cwd=work)
            if raw.returncode == UNSUPPORTED and not ours.exists():
                print(f"unsupported  {name}")
            elif raw.returncode != 0:
                failures.append(f"{name}: the raw program ended with {raw.returncode}: {raw.stderr[-400:]}")
            elif not ours.exists():
                failures.append(f"{name}: the adapter gave no trajectory {ours}")
            elif fault := difference(ours, theirs):
                failures.append(f"{name}: {fault}")
            else:
                compared += 1
                print(f"same bits    {name}")
    for failure in failures:
        print(f"DIFFERENT    {failure}")
    if compared == 0:
        failures.append("nothing was compared")
    sys.exit(1 if failures else 0)


main()
