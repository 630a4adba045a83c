"""A scenario, exported and imported again, must give the same run on every engine.

round_trip.py PROGRAM SOURCE FORMAT FOLDER

Both scenarios go to the same engines with the same step, and the trajectories are compared body by body. What may differ:
the files hold the scenario's own doubles, but poses are composed anew on the way, which rounds a few times: 1e-16 of the
size of the scene. A motion carries that on; a turn that grows or a contact that acts a bit later multiplies it by
hundreds, an iterative solver that stops elsewhere by more. TOLERANCE leaves it a factor of ten million. What the test is
after is of another size: a sign, a frame, an inertia, half a length in place of a whole one shows in the first digits.
"""
import csv
import json
import math
import pathlib
import shutil
import subprocess
import sys
import tomllib

TOLERANCE = 1e-9  # of the length scale, of the velocity scale, and in attitude [rad]
LEAST_MOTION = 1e-3  # of the length scale: a world in which nothing moves proves nothing

CASES = [  # name of the case or file, parameters, dt, scales of length and time
    ("collision/two_sphere", ["e=0.5", "b=0.48"], "0.01", 0.8, 0.27),
    ("joint/pendulum", [], "0.005", 1.0, 0.32),
    ("rotation/free_rotation", [], "0.005", 0.9, 0.2),
    ("friction/incline", ["mu=0.2"], "0.01", 1.0, 0.32),
    ("tests/exchange/double_swing.toml", [], "0.005", 1.0, 0.3),
]


def run(program, *arguments, codes=(0,)):
    done = subprocess.run([program, *arguments], capture_output=True, text=True, timeout=600)
    if done.returncode not in codes:
        sys.exit(f"plumbline {' '.join(arguments)}: exit code {done.returncode}\n{done.stdout}\n{done.stderr}")
    return done


def trajectories(folder):
    """{engine file: {body: [(t, 13 numbers)]}}"""
    result = {}
    for path in sorted((folder / "trajectories").rglob("*.csv")):
        bodies = {}
        with open(path, newline="") as file:
            for row in csv.DictReader(file):
                numbers = [float(row[k]) for k in "x y z qw qx qy qz vx vy vz wx wy wz".split()]
                bodies.setdefault(row["body"], []).append((float(row["t"]), numbers))
        result[path.name] = bodies
    return result


def angle(a, b):
    """Between two attitudes; q and -q are the same one."""
    sign = 1 if sum(x * y for x, y in zip(a, b)) >= 0 else -1
    return 2 * math.dist(a, [sign * x for x in b])


def difference(a, b, length, time):
    return max(math.dist(a[0:3], b[0:3]) / length, angle(a[3:7], b[3:7]),
               math.dist(a[7:10], b[7:10]) * time / length, math.dist(a[10:13], b[10:13]) * time)


def compare(before, after, length, time, planar):
    """Returns the largest difference; ends the test where one is too large."""
    if not after or set(after) - set(before):
        sys.exit(f"engines differ: {sorted(before)} and {sorted(after)}")
    # Poses that were composed anew lie beside the plane by a rounding, and a planar engine takes that at its word.
    missing = {name for name in set(before) - set(after) if name.split(".")[0] not in planar}
    if missing:
        sys.exit(f"ran before and not after: {sorted(missing)}")
    worst = 0.0
    for engine, bodies in before.items():
        if engine not in after:
            continue
        if bodies.keys() != after[engine].keys():
            sys.exit(f"{engine}: bodies differ: {sorted(bodies)} and {sorted(after[engine])}")
        moved = 0.0
        for body, samples in bodies.items():
            others = after[engine][body]
            if len(samples) != len(others) or len(samples) < 10:
                sys.exit(f"{engine}, {body}: {len(samples)} samples and {len(others)}")
            for (t, a), (u, b) in zip(samples, others):
                found = difference(a, b, length, time)
                if t != u or not found <= TOLERANCE:
                    sys.exit(f"{engine}, {body} at t = {t}: {found}\n  {a}\n  {b}")
                worst = max(worst, found)
            moved = max(moved, difference(samples[0][1], samples[-1][1], length, time))
        if not moved > LEAST_MOTION:
            sys.exit(f"{engine}: nothing moves")
    return worst


def value(x):
    """Numbers stand as they are; the few expressions of the files are Python, too."""
    return eval(x, {"sqrt": math.sqrt, "sin": math.sin, "cos": math.cos}) if isinstance(x, str) else x


def same(what, before, after, rounding=1e-14):
    pairs = list(zip(before, after, strict=True))
    if not all(abs(value(a) - value(b)) <= rounding for a, b in pairs):
        sys.exit(f"{what}: {before} became {after}")


def check_everything(program, source, form, folder):
    """One of each: every number of it must come back, but for what the format cannot say."""
    folder.mkdir(parents=True)
    path, world, back = source / "tests/exchange/everything.toml", folder / ("world." + form), folder / "back.toml"
    run(program, "export", str(path), "--as", form, "-o", str(world))
    run(program, "import", str(world), "-o", str(back))  # nothing of what was written may be a loss
    before, after = tomllib.loads(path.read_text()), tomllib.loads(back.read_text())
    same("gravity", before["gravity"], after["gravity"])
    for table in ("contact", "scales"):
        same(table, *([t[table][k] for k in sorted(before[table])] for t in (before, after)))
    bodies = {b["name"]: b for b in after["body"]}
    if sorted(bodies) != sorted(b["name"] for b in before["body"]):
        sys.exit(f"bodies: {sorted(bodies)}")
    for body in before["body"]:
        other = bodies[body["name"]]
        (kind, size), = body["shape"].items()
        same(body["name"], size if isinstance(size, list) else [size],
             other["shape"][kind] if isinstance(size, list) else [other["shape"][kind]])
        same(body["name"], [body.get("mass", 0)], [other.get("mass", 0)])
        if body.get("fixed", False) != other.get("fixed", False):
            sys.exit(f"{body['name']}: fixed or not")
        for key, none in (("position", [0] * 3), ("velocity", [0] * 3), ("angular_velocity", [0] * 3), ("inertia", None)):
            if none or key in body:
                same(f"{body['name']}, {key}", body.get(key, none), other.get(key, none))
        turn = angle([value(x) for x in body.get("attitude", [1, 0, 0, 0])], other.get("attitude", [1, 0, 0, 0]))
        same(f"{body['name']}, attitude", [0], [turn])
    joints = {(frozenset(j["between"]), j["kind"]): j for j in after["joint"]}
    for joint in before["joint"]:
        if joint["kind"] == "distance" and form == "sdf":
            continue
        other = joints.pop((frozenset(joint["between"]), joint["kind"]))
        for key in ("anchor", "axis", "range") if joint["kind"] != "fixed" else ():
            same(f"{joint['name']}, {key}", joint.get(key, []), other.get(key, []))
        for end, other_end in zip(joint.get("anchors", []), other.get("anchors", [])):
            same(joint["name"], end, other_end)
        for key in ("stiffness", "damping", "rest"):
            same(f"{joint['name']}, {key}", [joint.get(key, 0)], [other.get(key, 0)])
    if joints:
        sys.exit(f"joints from nowhere: {joints}")
    if form == "mjcf":
        (spring,), (other,) = before["spring"], after["spring"]
        for a, b in zip(spring["anchors"], other["anchors"]):
            same("spring", a, b)
        same("spring", *([s[k] for k in ("stiffness", "damping", "length")] for s in (spring, other)))
    print(f"everything: {len(bodies)} bodies, {len(after['joint'])} joints come back")


def main():
    program, source, form, folder = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3], pathlib.Path(sys.argv[4])
    shutil.rmtree(folder, ignore_errors=True)
    check_everything(program, source, form, folder / "everything")
    listing = json.loads(run(program, "list", "--json").stdout)
    planar = {row["name"] for row in listing["engines"] if row["dimension"] == 2}
    for name, parameters, dt, length, time in CASES:
        here = folder / name.replace("/", "_")
        here.mkdir(parents=True)
        given = [word for p in parameters for word in ("-P", p)]
        path = str(source / name) if name.endswith(".toml") else str(source / "scenarios" / (name + ".toml"))
        world, back = str(here / ("world." + form)), str(here / "back.toml")
        run(program, "export", path, "--as", form, "-o", world, *given)
        run(program, "import", world, "-o", back)
        # A gate that an engine misses is not this test's business.
        common = ["--profile", "matched", "--dt", dt, "--no-conformance", "-q"]
        run(program, "run", path, *given, *common, "-o", str(here / "before"), codes=(0, 1))
        run(program, "run", back, *common, "-o", str(here / "after"), codes=(0, 1))
        before, after = trajectories(here / "before"), trajectories(here / "after")
        print(f"{name}: {len(before)} rows, largest difference "
              f"{compare(before, after, length, time, planar):.2g}")


main()
