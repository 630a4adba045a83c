"""Checks results.json against its published schema, and that the schema refuses broken documents.
Usage: check_results_schema.py results.schema.json results.json"""
import copy
import json
import sys

try:
    import jsonschema
except ImportError:
    print("python3-jsonschema is not installed: apt-get install python3-jsonschema")
    sys.exit(1)


def run_with(key):
    """The index of the first run for which key(run) holds."""
    return lambda doc: next(r for r in doc["runs"] if key(r))


# What must be refused: a name and a change to a good document.
def broken():
    first = lambda doc: doc["runs"][0]
    measured = run_with(lambda r: r["metrics"])
    gated = run_with(lambda r: r["gates"])
    drawn = run_with(lambda r: r["curve"])
    yield "another schema", lambda d: d.update(schema="plumbline-results/2")
    yield "no schema", lambda d: d.pop("schema")
    yield "an unknown key", lambda d: d.update(colour="red")
    yield "an unknown key of a run", lambda d: first(d).update(colour="red")
    for key in ("scenario", "case", "parameters", "engine", "profile", "dt", "verdict", "reason", "notes", "metrics",
                "gates", "explanation", "settings", "wall_seconds", "messages", "trajectory", "curve"):
        yield f"a run without {key}", lambda d, k=key: first(d).pop(k)
    for key in ("tool", "environment", "engines", "missing_engines", "scenarios", "runs", "convergence", "divergence",
                "wall_seconds", "interrupted"):
        yield f"no {key}", lambda d, k=key: d.pop(k)
    for key in ("engine", "profile", "check", "verdict", "text", "why", "messages"):
        yield f"an answer without {key}", lambda d, k=key: d["conformance"][0].pop(k)
    yield "a check without a question", lambda d: d["conformance_checks"][0].pop("question")
    yield "an answer that is no verdict", lambda d: d["conformance"][0].update(verdict="holds")
    yield "an unknown verdict", lambda d: first(d).update(verdict="maybe")
    yield "an unknown profile", lambda d: first(d).update(profile="tuned")
    yield "a dt of zero", lambda d: first(d).update(dt=0)
    yield "a number as text", lambda d: measured(d)["metrics"].update({"position.max": "0.5"})
    yield "another spelling of nan", lambda d: measured(d)["metrics"].update({"position.max": "NaN"})
    yield "a metric without statistic", lambda d: measured(d)["metrics"].update({"position": 1})
    yield "a gate without reason", lambda d: gated(d)["gates"][0].update(reason="")
    yield "a point of three numbers", lambda d: drawn(d)["curve"][0].append(1)
    yield "a dimension of 4", lambda d: d["engines"][0].update(dimension=4)
    yield "a precision of half", lambda d: d["engines"][0].update(precision="half")


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        schema = json.load(file)
    with open(sys.argv[2], encoding="utf-8") as file:
        results = json.load(file)
    jsonschema.Draft202012Validator.check_schema(schema)
    validator = jsonschema.Draft202012Validator(schema)
    problems = [f"{'/'.join(map(str, e.absolute_path))}: {e.message[:200]}" for e in validator.iter_errors(results)]
    refused = 0
    for name, change in broken():
        document = copy.deepcopy(results)
        change(document)
        if validator.is_valid(document):
            problems.append(f"the schema accepts {name}")
        refused += 1
    print("\n".join(problems) or f"{sys.argv[2]}: valid; {refused} broken documents are refused")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
