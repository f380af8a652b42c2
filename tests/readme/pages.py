"""Rules for the pages of the project: where links lead, and what the tables of src/ name.

* A link leads to a file or folder that is there, and to a heading of it where it names one.
* In the README of a module a `name.h` or `name.cc` of a table row is there: in the module, rooms
  included, or, as a path, below src/ or the project. So is everything in the first column of a
  table of files (first column "file" or "files"), where names may lack the ending and be globs or
  folders.
* Every header of a module is named in some row of a table of files: by its name, without the
  ending, or by a glob such as `*_params`.

A room with a README of its own (src/experiments/hazard_detection) is a part of its module.
"""

import re
from fnmatch import fnmatchcase
from pathlib import Path

FENCED = re.compile(r"^```.*?^```", re.DOTALL | re.MULTILINE)
CODE = re.compile(r"`([^`\n]+)`")
LINK = re.compile(r"\]\(([^)\s]+)\)")
HEADING = re.compile(r"^#+ +(.*)$", re.MULTILINE)
SOURCE_NAME = re.compile(r"[\w./*-]+\.(h|cc)$")
FILE_COLUMN = {"file", "files"}


def pages_of(root):
    """The pages whose links are checked."""
    found = sorted(root.glob("*.md"))
    for folder in ("docs", "examples", "results", "scenarios", "scripts", "src", "terrain", "tests"):
        found += sorted(page for page in (root / folder).rglob("*.md")
                        if "node_modules" not in page.parts and not page.is_relative_to(root / "results/runs"))
    return found


def anchors_of(page):
    """The names by which links reach the headings of a page, as GitHub makes them."""
    found = set()
    for heading in HEADING.findall(FENCED.sub("", page.read_text(encoding="utf-8"))):
        found.add(re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-"))
    return found


def check_links(page):
    text = CODE.sub("", FENCED.sub("", page.read_text(encoding="utf-8")))
    for target in LINK.findall(text):
        if re.match(r"[a-z]+:", target):
            continue
        path, _, anchor = target.partition("#")
        goal = page.parent / path if path else page
        if not goal.exists():
            yield f"{page}: link to {target}, which does not exist"
        elif anchor and anchor not in anchors_of(goal):
            yield f"{page}: link to {target}, but there is no such heading"


def rows_of(page):
    """(cells of a row, whether its table is one of files), without heads and rules."""
    files = None
    for line in FENCED.sub("", page.read_text(encoding="utf-8")).splitlines():
        if not line.startswith("|"):
            files = None
            continue
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if files is None:
            files = cells[0] in FILE_COLUMN
        elif not re.fullmatch(r"[|:\- ]+", line):
            yield cells, files


def names_file(name, path):
    """Whether `name` names the file at `path` below a module: with its room or without."""
    if name.endswith("/"):
        return f"/{path}".rpartition(f"/{name}")[1] != ""
    stem = path.rsplit(".", 1)[0]
    return any(fnmatchcase(whole, name) or fnmatchcase(whole.rsplit("/", 1)[-1], name) for whole in (path, stem))


def check_module(module):
    """The tables of the READMEs of one module."""
    root, src = module.parent.parent, module.parent
    files = [path.relative_to(module).as_posix() for path in sorted(module.rglob("*"))
             if path.is_file() and path.name != "README.md"]
    named = set()
    for page in sorted(module.rglob("README.md")):
        for cells, is_files in rows_of(page):
            for column, cell in enumerate(cells):
                for name in CODE.findall(cell):
                    if is_files and not name.endswith("/"):
                        named.add(name)
                    if not (is_files and column == 0) and not SOURCE_NAME.match(name):
                        continue
                    here = any(names_file(name, path) for path in files)
                    below = "/" in name and any((base / name).exists() for base in (page.parent, src, root))
                    if not here and not below:
                        yield f"{page}: a table names {name}, which does not exist"
    for path in files:
        if path.endswith(".h") and not any(names_file(name, path) for name in named):
            yield f"{module / path}: in no table of files of {module.name}/README.md"


def check_project(root):
    root = Path(root)
    faults = [fault for page in pages_of(root) for fault in check_links(page)]
    for module in sorted((root / "src").iterdir()):
        if module.is_dir():
            faults += check_module(module)
    return faults
