"""Reads the page with another parser: every element is closed in order, ids are unique, links inside the page lead
somewhere, and nothing is loaded from elsewhere. Usage: check_page.py report.html"""
import re
import sys
from html.parser import HTMLParser

VOID = {"meta", "input", "br", "wbr"}
LARGEST = 5_000_000  # [bytes]


class Page(HTMLParser):
    def __init__(self):
        super().__init__()
        self.open, self.ids, self.targets, self.labels, self.problems = [], [], [], [], []

    def handle_starttag(self, tag, attrs):
        names = [name for name, _ in attrs]
        if len(names) != len(set(names)):
            self.problems.append(f"{self.getpos()}: <{tag}> has an attribute twice")
        attrs = dict(attrs)
        if tag in {"script", "link", "img", "iframe", "object", "embed", "base", "form", "image", "use"}:
            self.problems.append(f"{self.getpos()}: <{tag}> may load something")
        for name, value in attrs.items():
            if name.startswith("on") or name in {"src", "srcset", "xlink:href", "action"}:
                self.problems.append(f"{self.getpos()}: attribute {name} of <{tag}>")
            if re.search(r"url\(|javascript:", value or ""):
                self.problems.append(f"{self.getpos()}: {name}={value}")
        href = attrs.get("href")
        if href is not None:
            if href.startswith("#"):
                self.targets.append(href[1:])
            elif not href.startswith("./"):
                self.problems.append(f"{self.getpos()}: the link {href} leaves the page's folder")
        if "id" in attrs:
            self.ids.append(attrs["id"])
        if "for" in attrs:
            self.labels.append(attrs["for"])
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.handle_starttag(tag, attrs)
        if tag not in VOID:
            self.open.pop()

    def handle_endtag(self, tag):
        if not self.open or self.open[-1] != tag:
            self.problems.append(f"{self.getpos()}: </{tag}> closes {self.open[-1:] or 'nothing'}")
        else:
            self.open.pop()


def problems_of(text):
    page = Page()
    page.feed(text)
    page.close()
    problems = page.problems
    if page.open:
        problems.append(f"never closed: {page.open}")
    if len(page.ids) != len(set(page.ids)):
        problems.append("an id stands twice")
    problems += [f"no element has the id {t}" for t in page.targets + page.labels if t not in page.ids]
    # Tabs are switched by labels.
    if not page.targets or ('class="tabs"' in text and not page.labels):
        problems.append("no link or no tab was found: this check looks at the wrong page")
    problems += [f"a resource from elsewhere: {m}" for m in re.findall(r"https?://\S+|@import\S*|url\([^)]*", text)]
    if len(text.encode()) > LARGEST:
        problems.append(f"larger than {LARGEST} bytes")
    return problems


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        text = file.read()
    problems = problems_of(text)
    # A check that finds nothing in a broken page would prove nothing.
    for damage in ("</section>", "<script src='https://example.org/x.js'></script>", "<p id='matrix'>",
                   "<a href='https://example.org/'>x</a>", "<b onclick='x()'>y</b>", "<a href='#nowhere'>z</a>"):
        if not problems_of(text.replace("<main>", "<main>" + damage, 1)):
            problems.append(f"the check did not notice {damage}")
    print("\n".join(problems) or f"{sys.argv[1]}: well-formed, loads nothing, {len(text)} characters")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
