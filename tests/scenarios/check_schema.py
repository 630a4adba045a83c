"""Every scenario file satisfies the published schema, and files with a fault do not. Usage: check_schema.py SOURCE_DIR"""

import copy
import json
import pathlib
import sys
import tomllib

try:
    import jsonschema
except ImportError:
    print("python3-jsonschema is not installed: apt-get install python3-jsonschema")
    sys.exit(1)


def faults(sound):
    """Broken copies of a sound file, each with the fault's name."""

    def broken(name, change):
        data = copy.deepcopy(sound)
        change(data)
        return name, data

    body = next(i for i, b in enumerate(sound["body"]) if "mass" in b)
    yield broken("unknown key", lambda d: d.update(colour="red"))
    yield broken("no duration", lambda d: d.pop("duration"))
    yield broken("no scales", lambda d: d.pop("scales"))
    yield broken("no reference", lambda d: d.pop("reference"))
    yield broken("duration of zero", lambda d: d.update(duration=0))
    yield broken("duration of another type", lambda d: d.update(duration=[1]))
    yield broken("two components", lambda d: d.update(gravity=[0, 0]))
    yield broken("empty sweep", lambda d: d.setdefault("parameters", {}).update(m=[]))
    yield broken("expression as a parameter", lambda d: d.setdefault("parameters", {}).update(m="2*3"))
    yield broken("unknown shape", lambda d: d["body"][body].update(shape={"cone": 1}))
    yield broken("two shapes", lambda d: d["body"][body].update(shape={"sphere": 1, "box": [1, 1, 1]}))
    yield broken("no mass", lambda d: d["body"][body].pop("mass"))
    yield broken("negative mass", lambda d: d["body"][body].update(mass=-1))
    yield broken("half-space with a mass", lambda d: d["body"].append(
        {"name": "wall", "shape": {"half_space": [1, 0, 0]}, "mass": 1}))
    yield broken("unknown component", lambda d: d["reference"].update({d["body"][body]["name"]: {"speed": "t"}}))
    yield broken("unknown kind", lambda d: d["reference"].update(kind="guess"))
    yield broken("spring with one end", lambda d: d.update(spring=[
        {"name": "s", "between": ["world"], "anchors": [[0, 0, 0], [0, 0, 1]], "stiffness": 1}]))
    yield broken("spring that pushes apart", lambda d: d.update(spring=[
        {"name": "s", "between": ["world", "b"], "anchors": [[0, 0, 0], [0, 0, 1]], "stiffness": -1}]))
    hinge = {"name": "j", "kind": "hinge", "between": ["world", "b"], "anchor": [0, 0, 0], "axis": [0, 1, 0]}
    yield broken("range with one end", lambda d: d.update(joint=[hinge | {"range": [0]}]))
    yield broken("negative damping", lambda d: d.update(joint=[hinge | {"damping": -1}]))
    yield broken("rest without a spring", lambda d: d.update(joint=[hinge | {"rest": 1}]))
    yield broken("range of a ball joint", lambda d: d.update(joint=[
        {"name": "j", "kind": "ball", "between": ["world", "b"], "anchor": [0, 0, 0], "range": [0, 1]}]))
    yield broken("cylinder without a height", lambda d: d["body"][body].update(shape={"cylinder": [1]}))
    yield broken("fixed body with a mass", lambda d: d["body"][body].update(fixed=True))
    yield broken("unknown tier", lambda d: d.update(tier="quick"))
    yield broken("validity of zero", lambda d: d.update(t_valid=0))
    yield broken("solution without a name", lambda d: (d["reference"].clear(), d["reference"].update(kind="solution")))
    yield broken("ode without an uncertainty", lambda d: (d["reference"].clear(), d["reference"].update(kind="ode")))
    yield broken("table without a row", lambda d: (d["reference"].clear(),
                                                   d["reference"].update(kind="table", uncertainty=1e-6)))
    yield broken("motion of invariants", lambda d: (d["reference"].clear(), d["reference"].update(
        kind="invariants", **{d["body"][body]["name"]: {"x": "t"}})))
    certificate = {"quantity": "t", "equals": 0, "within": 1, "source": "a book"}
    yield broken("certificate without a source", lambda d: d.update(certificate=[
        {key: certificate[key] for key in ("quantity", "equals", "within")}]))
    yield broken("certificate within nothing", lambda d: d.update(certificate=[certificate | {"within": 0}]))
    threshold = {"parameter": "m", "between": [0, 2], "exact": 1, "resolution": 0.1, "body": "b", "question": "x > 0"}
    if "threshold" in sound:
        yield broken("no threshold", lambda d: d.pop("threshold"))
        yield broken("yes in between", lambda d: d["threshold"].update(yes="middle"))
    else:
        yield broken("threshold of a motion", lambda d: d.update(threshold=threshold))
    yield broken("restitution above one", lambda d: d.update(contact={"restitution": 1.5, "friction": 0}))
    yield broken("gate without a reason", lambda d: d["gate"][0].pop("reason"))
    yield broken("gate with an empty reason", lambda d: d["gate"][0].update(reason=""))
    yield broken("event with itself", lambda d: d.update(event=[{"name": "e", "between": ["a", "a"], "time": 1}]))


def main():
    root = pathlib.Path(sys.argv[1])
    schema = json.loads((root / "docs/schemas/scenario.schema.json").read_text())
    jsonschema.Draft202012Validator.check_schema(schema)
    validator = jsonschema.Draft202012Validator(schema)
    files = sorted(root.glob("scenarios/*/*.toml"))
    wrong = [] if len(files) >= 5 else [f"only {len(files)} scenario files found"]
    for file in files:
        sound = tomllib.loads(file.read_text())
        wrong += [f"{file.name}: {list(e.absolute_path)}: {e.message}" for e in validator.iter_errors(sound)]
        wrong += [f"{file.name}: accepted with the fault: {name}" for name, data in faults(sound) if validator.is_valid(data)]
    print("\n".join(wrong) or f"{len(files)} files satisfy the schema, their faulty copies do not")
    return 1 if wrong else 0


sys.exit(main())
