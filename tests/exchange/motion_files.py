"""Motions on their way out: CSV, NPZ, TUM and C++ header must hold the same doubles.

motion_files.py PROGRAM SOURCE COMPILER FOLDER
"""
import csv
import pathlib
import shutil
import subprocess
import sys

import numpy

PROGRAM, SOURCE, COMPILER, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3], pathlib.Path(sys.argv[4])
COLUMNS = "x y z qw qx qy qz vx vy vz wx wy wz".split()


def plumbline(*arguments, code=0):
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=120, cwd=FOLDER)
    assert done.returncode == code, f"plumbline {arguments}: {done.returncode}\n{done.stdout}\n{done.stderr}"
    return done


def table(path):
    """(times, names, array of samples x bodies x 13)"""
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    names = []
    for row in rows:
        if row["body"] in names:
            break
        names.append(row["body"])
    numbers = numpy.array([[float(row[c]) for c in COLUMNS] for row in rows])
    return numpy.array([float(r["t"]) for r in rows[::len(names)]]), names, numbers.reshape(-1, len(names), 13)


def check_npz(path, times, names, states):
    with numpy.load(path, allow_pickle=False) as archive:
        assert sorted(archive.files) == sorted(["t", "names", "position", "attitude", "velocity", "angular_velocity"])
        assert archive["t"].dtype == numpy.float64 and numpy.array_equal(archive["t"], times)
        assert list(archive["names"]) == names, archive["names"]
        for key, part in (("position", slice(0, 3)), ("attitude", slice(3, 7)), ("velocity", slice(7, 10)),
                          ("angular_velocity", slice(10, 13))):
            assert numpy.array_equal(archive[key], states[:, :, part]), key


def check_tum(paths, times, states):
    for body, path in enumerate(paths):
        columns = numpy.loadtxt(path)
        assert columns.shape == (len(times), 8), columns.shape
        assert numpy.array_equal(columns[:, 0], times)
        assert numpy.array_equal(columns[:, 1:4], states[:, body, 0:3])
        assert numpy.array_equal(columns[:, 4:8], states[:, body][:, [4, 5, 6, 3]])  # x y z w


def check_header(path, times, names, states):
    """Compiled alone, as constants, it must print the same bits."""
    text = path.read_text()
    assert "Apache License" in text and "Source: " in text
    space = next(line.split()[1] for line in text.splitlines() if line.startswith("namespace "))
    (FOLDER / "use.cpp").write_text(f'''#include "{path.name}"
#include <cstdio>
namespace d = {space};
static_assert(d::sample_count == {len(times)} && d::body_count == {len(names)});
static_assert(sizeof(d::samples) == sizeof(d::Sample) * d::sample_count * d::body_count);
static_assert(d::times[0] == 0);
int main() {{
  for (const char* name : d::names) std::printf("%s\\n", name);
  for (const double t : d::times) std::printf("%a\\n", t);
  for (const d::Sample& s : d::samples) {{
    for (const double x : s.position) std::printf("%a\\n", x);
    for (const double x : s.attitude) std::printf("%a\\n", x);
    for (const double x : s.velocity) std::printf("%a\\n", x);
    for (const double x : s.angular_velocity) std::printf("%a\\n", x);
  }}
}}
''')
    subprocess.run([COMPILER, "-std=c++17", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "use.cpp", "-o", "use"], cwd=FOLDER,
                   check=True, timeout=120)
    lines = subprocess.run([FOLDER / "use"], capture_output=True, text=True, check=True).stdout.splitlines()
    assert lines[:len(names)] == names
    printed = numpy.array([float.fromhex(line) for line in lines[len(names):]])
    assert numpy.array_equal(printed[:len(times)], times)
    assert numpy.array_equal(printed[len(times):].reshape(states.shape), states)


def check_all(case, dt, *parameters):
    name = case.replace("/", "_")
    for form in ("csv", "npz", "tum", "header"):
        plumbline("export", "--reference", SOURCE / "scenarios" / (case + ".toml"), "--dt", dt, "--as", form, "-o",
                  f"{name}.{form}", *parameters)
    times, names, states = table(FOLDER / f"{name}.csv")
    check_npz(FOLDER / f"{name}.npz", times, names, states)
    tums = [f"{name}.tum"] if len(names) == 1 else [f"{name}.{body}.tum" for body in names]
    check_tum([FOLDER / t for t in tums], times, states)
    check_header(FOLDER / f"{name}.header", times, names, states)
    # The same from a table, as runs write them.
    plumbline("export", "--run", f"{name}.csv", "--as", "npz", "-o", "again.npz")
    check_npz(FOLDER / "again.npz", times, names, states)
    return times, names, states


def check_exactness():
    """x = 2 t of the falling box holds to the last bit; 2 s hold 200 steps of 0.01 s."""
    times, names, states = check_all("particle/falling_box", "0.01")
    assert len(times) == 201 and names == ["box"]
    assert numpy.array_equal(states[:, 0, 0], 2 * times)
    assert abs(states[-1, 0, 2] - (5 + 3 * 2 - 9.8 * 2)) < 1e-14


def check_hostile():
    (FOLDER / "broken.csv").write_text("t,body,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz\n0,a,1,2,x,1,0,0,0,0,0,0,0,0,0\n")
    (FOLDER / "short.csv").write_text("t,body,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz\n0,a,1,2\n")
    (FOLDER / "other.csv").write_text("a,b\n1,2\n")
    (FOLDER / "empty.csv").write_text("")
    for file, where in (("broken", ":2: 'x' in column 5"), ("short", ":2: has 4 columns"), ("other", ":1: "), ("empty", ":1: "),
                        ("missing", "cannot be read")):
        error = plumbline("export", "--run", f"{file}.csv", "--as", "npz", "-o", "x.npz", code=2).stderr
        assert f"{file}.csv" in error and where in error, error
    box = SOURCE / "scenarios/particle/falling_box.toml"
    for arguments in (["--as", "npz"], [box, "--as", "npz", "-o", "x"], ["--reference", box, "--as", "npz", "-o", "x"],
                      ["--reference", box, "--dt", "3", "--as", "npz", "-o", "x"],
                      ["--reference", box, "--dt", "0.1", "--as", "npz"],
                      ["--reference", box, "--dt", "0.1", "--as", "mjcf", "-o", "x"],
                      ["--reference", box, "--dt", "0.1", "--as", "csv", "-o", "/dev/null/x"],
                      ["--reference", "collision/two_sphere", "--dt", "0.1", "--as", "csv", "-o", "x"],
                      ["--reference", SOURCE / "tests/exchange/everything.toml", "--dt", "0.1", "--as", "csv", "-o", "x"],
                      ["no/such", "--as", "sdf"]):
        error = plumbline("export", *arguments, code=2).stderr
        assert len(error) > 20, arguments


def check_names():
    """Names of any letters reach numpy and the table unchanged."""
    name = 'a "b", \u00fc\u4e16\U0001f680'
    quoted = '"' + name.replace('"', '""') + '"'
    row = ",".join([quoted] + ["0.5"] * 3 + ["1", "0", "0", "0"] + ["nan"] + ["-inf"] + ["1e-300"] * 4)
    header = "t,body," + ",".join(COLUMNS)
    (FOLDER / "odd.csv").write_text(f"{header}\n0,{row}\n0.1,{row}\n")
    plumbline("export", "--run", "odd.csv", "--as", "npz", "-o", "odd.npz")
    with numpy.load(FOLDER / "odd.npz") as archive:
        assert list(archive["names"]) == [name], archive["names"]
        assert numpy.isnan(archive["velocity"][0, 0, 0]) and archive["velocity"][0, 0, 1] == -numpy.inf
    plumbline("export", "--run", "odd.csv", "--as", "header", "-o", "odd.hpp")
    plumbline("export", "--run", "odd.csv", "--as", "csv", "-o", "odd2.csv")
    assert (FOLDER / "odd.csv").read_text() == (FOLDER / "odd2.csv").read_text()


shutil.rmtree(FOLDER, ignore_errors=True)
FOLDER.mkdir(parents=True)
check_exactness()
check_all("collision/two_sphere", "1/60", "-P", "e=0.5", "-P", "b=0.48")
check_all("rotation/free_rotation", "0.01")
check_names()
check_hostile()
print("csv, npz, tum and header agree")
