"""Worlds that others wrote: what they become, what is refused and how, and that hostile files do no harm.

foreign_worlds.py PROGRAM FOLDER FORMAT...

Formats: mjcf, sdf, those whose reader was built. Numbers are compared with those of worlds/, worked out by hand.
"""
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tomllib

PROGRAM, FOLDER, FORMATS = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3:]
WORLDS = pathlib.Path(__file__).parent / "worlds"
ROUNDING = 1e-12


def plumbline(*arguments, code=0):
    """HOME is an empty folder: readers must not leave anything there."""
    home = FOLDER / "home"
    shutil.rmtree(home, ignore_errors=True)
    home.mkdir()
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=120, cwd=FOLDER,
                          env={**os.environ, "HOME": str(home)}, errors="replace")
    assert done.returncode == code, f"plumbline {arguments}: {done.returncode}\n{done.stdout}\n{done.stderr}"
    # Workers of engines may keep logs there; readers of worlds may not.
    assert arguments[0] != "import" or not list(home.iterdir()), f"{arguments} wrote {list(home.iterdir())}"
    return done


def imported(file, *options):
    """(the scenario as a table, what was said on the way)"""
    done = plumbline("import", file, *options)
    return tomllib.loads(done.stdout), done.stderr


def named(items, name):
    return next(item for item in items if item["name"] == name)


def near(found, expected):
    assert len(found) == len(expected) and math.dist(found, expected) <= ROUNDING, (found, expected)


def check_arm():
    scene, said = imported(WORLDS / "arm.urdf")
    upper, lower = named(scene["body"], "upper"), named(scene["body"], "lower")
    near(upper["position"], [0.5, 0, 2])
    near(lower["position"], [1, 0, 1.75])
    # Moments of [[0.1, 0.02], [0.02, 0.2]]: 0.15 -+ sqrt(0.05^2 + 0.02^2).
    root = math.sqrt(0.05**2 + 0.02**2)
    near(upper["inertia"], [0.15 - root, 0.15 + root, 0.25])
    near(lower["inertia"], [0.02, 0.03, 0.04])
    assert "principal axes" in said
    shoulder, elbow = named(scene["joint"], "shoulder"), named(scene["joint"], "elbow")
    assert shoulder["kind"] == "hinge" and elbow["kind"] == "slider"
    assert shoulder["between"] == ["world", "upper"] and elbow["between"] == ["upper", "lower"]
    near(shoulder["anchor"], [0, 0, 2])
    near(shoulder["axis"], [0, 1, 0])
    near(shoulder["range"], [-1, 0.5])
    assert shoulder["damping"] == 0.3
    near(elbow["axis"], [0, 1, 0])  # the child is a quarter turn round z
    near(elbow["range"], [-0.1, 0.4])
    assert [g["metric"] for g in scene["gate"]] == ["joint_gap.max"]  # damped: energy is not kept


def check_yard():
    scene, said = imported(WORLDS / "yard.sdf")
    near(scene["gravity"], [0, 0, -3.7])
    assert scene["steps"] == [0.004]
    assert scene["contact"] == {"restitution": 0, "friction": 0.3}
    ground, can = (scene["body"][0], scene["body"][1])
    near(ground["position"], [0, 0, -1])
    near(ground["shape"]["half_space"], [0, 0, 1])
    near(can["shape"]["cylinder"], [0.2, 0.9])
    near(can["position"], [1, 2.5, 3.2])  # half a metre along the model's x, which points along y
    near(can["inertia"], [0.5, 0.5, 0.3])
    # The state speaks of the link's origin, 0.2 m below the mass: w x r = (0, 7, 0) x (0, 0, 0.2) = (1.4, 0, 0).
    near(can["velocity"], [2.4, 0, 0])
    near(can["angular_velocity"], [0, 7, 0])
    assert "lights" in said


def check_poses():
    shut, said = imported(WORLDS / "poses.xml")
    assert "--keyframe takes one of: shut, ajar" in said
    door, hinge = shut["body"][0], shut["joint"][0]
    near(door["position"], [1.5, 0, 0])
    near(hinge["range"], [-math.pi / 2, math.pi / 2])
    near([hinge["rest"]], [math.pi / 6])
    ajar, said = imported(WORLDS / "poses.xml", "--keyframe", "ajar", "--duration", "3")
    door, hinge = ajar["body"][0], ajar["joint"][0]
    assert ajar["duration"] == 3
    near(door["position"], [1 + 0.5 * math.cos(0.5), 0.5 * math.sin(0.5), 0])
    near(door["velocity"], [-math.sin(0.5), math.cos(0.5), 0])  # 2 rad/s at half a metre
    near(door["angular_velocity"], [0, 0, 2])
    near(hinge["range"], [-math.pi / 2 - 0.5, math.pi / 2 - 0.5])
    near([hinge["rest"]], [math.pi / 6 - 0.5])
    error = plumbline("import", WORLDS / "poses.xml", "--keyframe", "open", code=2).stderr
    assert "there are: shut, ajar" in error, error


def check_refusals(file, expected):
    error = plumbline("import", WORLDS / file, code=2).stderr
    for part in expected + ["--partial"]:
        assert part in error, f"{part}\n{error}"
    scene, said = imported(WORLDS / file, "--partial")
    for part in expected:
        assert part in said, part
    assert scene["reference"]["kind"] == "invariants"


def check_hostile(files):
    for name, content, where in files:
        path = FOLDER / name
        path.write_bytes(content)
        for options in ([], ["--partial"]):
            error = plumbline("import", path, *options, code=2).stderr
            assert error.startswith("error: ") or "\nerror: " in error, error
            assert f"{path}{where}" in error, f"{name}: {where}\n{error}"


def check_installed(path, expected_losses):
    """A file of another Debian package, where that is installed."""
    if not pathlib.Path(path).exists():
        print(f"{path} is not installed")
        return
    if expected_losses:
        error = plumbline("import", path, code=2).stderr
        for part in expected_losses:
            assert part in error, f"{part}\n{error}"
        print(f"{path}: refused, {error.count(chr(10) + 'error: ')} reasons given")
    else:
        scene, _ = imported(path)
        target = FOLDER / "installed.toml"
        plumbline("import", path, "-o", target)
        assert "imported/" in plumbline("list", target).stdout
        print(f"{path}: {len(scene['body'])} bodies, {len(scene.get('joint', []))} joints")


shutil.rmtree(FOLDER, ignore_errors=True)
FOLDER.mkdir(parents=True)
check_hostile([
    ("cut.xml", b"<mujoco>\n<worldbody>\n<body", ":3"),
    ("empty.sdf", b"", ""),
    ("noise.urdf", bytes(range(255, 0, -1)) * 40, ""),
    ("other.xml", b"<?xml version='1.0'?>\n<html/>\n", ":2"),
    ("lol.xml", b"<!DOCTYPE x [<!ENTITY a 'aaaa'><!ENTITY b '&a;&a;'>]>\n<mujoco>&b;<nonsense/></mujoco>", ""),
])
assert "no such file" in plumbline("import", FOLDER / "missing.xml", code=2).stderr
assert "no such file" in plumbline("import", FOLDER, code=2).stderr
if "mjcf" in FORMATS:
    check_poses()
    check_refusals("bad_joints.xml", ["'cart' hangs by 2 joints", "'axle' has armature 0.5", "'axle' has dry friction",
                                      "actuator 'servo'", "ellipsoid 'rim'", "viscosity"])
    check_hostile([
        ("unknown.xml", b"<mujoco>\n<worldbody>\n<nonsense/>\n</worldbody></mujoco>", ":3"),
        ("massless.xml", b"<mujoco>\n<worldbody>\n<body><freejoint/></body></worldbody></mujoco>", ""),
        ("negative.xml", b"<mujoco><worldbody><body><freejoint/><geom size='-1'/></body></worldbody></mujoco>", ""),
        ("deep.xml", b"<mujoco><worldbody>" + b"<body>" * 20000 + b"</body>" * 20000 + b"</worldbody></mujoco>", ""),
    ])
    check_installed("/usr/share/mujoco/model/slider_crank/slider_crank.xml", ["capsule", "'forward'"])
    check_installed("/usr/share/doc/dart/data/mjcf/openai/inverted_double_pendulum.xml", [])
if "sdf" in FORMATS:
    check_arm()
    check_yard()
    check_refusals("bad_shapes.sdf", ["capsule 'shell'", "joint 'cross'", "plugin 'pusher'"])
    check_hostile([
        ("nothing.sdf", b"<sdf version='1.9'/>", ""),
    ])
    orphan = FOLDER / "orphan.sdf"
    orphan.write_text("<sdf version='1.9'><world name='w'><model name='m'>\n<link name='a'/>\n<joint name='j' type='fixed'>"
                      "<parent>a</parent><child>b</child></joint></model></world></sdf>")
    error = plumbline("import", orphan, code=2).stderr
    assert f"{orphan}: " in error and "name[b]" in error, error
    check_installed("/usr/share/doc/dart/data/sdf/test/issue1624_cubes.sdf", [])
print("foreign worlds behave")
