"""Each engine gives the same bits whichever others are there.

Runs some cases with all engines built, then again in an installation that holds one worker program alone, and compares
the trajectories byte for byte.
"""
import argparse
import filecmp
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

CASES = ["-f", "falling_box", "-f", "two_sphere/e=0.5,b=0.48", "-f", "incline/mu=0.2", "-f", "pendulum"]


def run(program, output):
    done = subprocess.run([program, "run", "-q", "--no-conformance", "--dt", "0.02", "-o", output, *CASES],
                          capture_output=True, text=True)
    if done.returncode not in (0, 1, 77):
        sys.exit(f"{program} run ended with {done.returncode}:\n{done.stdout}{done.stderr}")
    folder = Path(output) / "trajectories"
    return {str(file.relative_to(folder)): file for file in sorted(folder.rglob("*.csv"))}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build", required=True, help="build tree: bin/, libexec/plumbline/, share/plumbline/")
    build = Path(parser.parse_args().build)
    workers = sorted(p for p in (build / "libexec/plumbline").glob("plumbline-engine-*")
                     if not p.name.endswith(".toml") and not p.name.endswith("-fake"))
    with tempfile.TemporaryDirectory() as work:
        together = run(build / "bin/plumbline", Path(work) / "together")
        alone = {}
        for worker in workers:
            root = Path(work) / worker.name
            (root / "bin").mkdir(parents=True)
            (root / "libexec/plumbline").mkdir(parents=True)
            (root / "share/plumbline").mkdir(parents=True)
            shutil.copy(build / "bin/plumbline", root / "bin/plumbline")
            shutil.copy(worker, root / "libexec/plumbline")
            (root / "share/plumbline/scenarios").symlink_to((build / "share/plumbline/scenarios").resolve())
            found = run(root / "bin/plumbline", root / "out")
            alone.update(found)
            print(f"{worker.name}: {len(found)} trajectories alone")
        differing = [name for name in together if name not in alone or
                     not filecmp.cmp(together[name], alone[name], shallow=False)]
        if differing or set(together) != set(alone) or not together:
            sys.exit(f"not the same alone and together: {differing or set(together) ^ set(alone)}")
        print(f"{len(together)} trajectories, the same bytes alone and together")


main()
