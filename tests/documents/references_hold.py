#!/usr/bin/env python3
"""Whatever a document points to must be there: links, files of this project, tests by name.

    references_hold.py ROOT [DOCUMENT...]      all Markdown files of ROOT, or only those

A file is a code span that starts with one of the project's folders; a test is a code span `Suite.Name` that starts like
a GoogleTest suite and whose suite or name is spelled in upper camel case.
"""
import pathlib
import re
import sys

FOLDERS = "adapters bench cli cmake core docs harness labs reports scenarios tests".split()
root = pathlib.Path(sys.argv[1])
documents = [pathlib.Path(a) for a in sys.argv[2:]] or [
    p for p in sorted(root.rglob("*.md")) if not {"build", "node_modules", "broken"} & set(p.relative_to(root).parts)]

tests = set()
for source in (root / "tests").rglob("*.cpp"):
    for suite, name in re.findall(r"^(?:TYPED_)?TEST(?:_[FP])?\((\w+),\s*(\w+)\)", source.read_text(), re.M):
        tests.add(f"{suite}.{name}")
suites = {t.split(".")[0] for t in tests}

problems = []
checked = 0
for document in documents:
    text = document.read_text()
    prose = re.sub(r"^```.*?^```", lambda m: "\n" * m.group().count("\n"), text, flags=re.M | re.S)

    def line_of(match):
        return prose.count("\n", 0, match.start()) + 1

    def problem(match, what):
        problems.append(f"{document}:{line_of(match)}: {what}")

    for match in re.finditer(r"\]\(([^)\s#]+)(?:#[^)]*)?\)", prose):
        if not re.match(r"[a-z]+:", match[1]):
            checked += 1
            if not (document.parent / match[1]).exists():
                problem(match, f"link to {match[1]}, which is not there")
    for match in re.finditer(r"`([^`\n]+)`", prose):
        span = match[1]
        if re.fullmatch(rf"(?:{'|'.join(FOLDERS)})/[\w./-]+", span) and not re.search("[A-Z]{4}", span):  # FAMILY: any
            checked += 1
            if not (root / span).exists() and not list(root.glob(span + ".*")):
                problem(match, f"file {span}, which is not there")
        elif re.fullmatch(r"[A-Z]\w+\.[A-Z]\w+", span):
            checked += 1
            if span not in tests:
                known = " (the suite exists)" if span.split(".")[0] in suites else ""
                problem(match, f"test {span}, which is not there{known}")

print(f"{checked} references in {len(documents)} documents, {len(problems)} broken")
print("\n".join(problems))
sys.exit(1 if problems or not checked else 0)
