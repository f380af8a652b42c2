"""What is installed: the list of public headers, src/public_headers.txt."""

import re
from pathlib import Path

LIST = "public_headers.txt"
MOST = 46
SIDES = ("onboard", "world")  # a side includes itself and those before it

CODE = re.compile(r'"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])*\'')
PLAIN = re.compile(r"//(?!\s*(NOLINT|namespace\b))")
FORWARD = re.compile(r"(class|struct) \w+;$")
NEEDS_NONE = re.compile(r"[}#]|namespace\b")


def read_list(path):
    """Side of each listed header, in order, and messages about the list itself."""
    sides, found = {}, []
    for line in path.read_text(encoding="utf-8").splitlines():
        words = line.split()
        if not words or words[0].startswith("#"):
            continue
        if len(words) != 2 or words[0] not in SIDES:
            found.append(f"'{line}' is not \"{' or '.join(SIDES)} module/header.h\"")
        elif words[1] in sides:
            found.append(f"lists {words[1]} twice")
        else:
            sides[words[1]] = words[0]
    if len(sides) > MOST:
        found.append(f"lists {len(sides)} headers, more than {MOST}")
    return sides, found


def check_comments(text):
    """Yields (line, message) where a documentation generator would miss something."""
    lines = text.splitlines()
    if not lines or lines[0] != "/// @file":
        yield 1, 'a public header begins with "/// @file"'
    namespaces = False
    for number, line in enumerate(lines, start=1):
        if PLAIN.search(CODE.sub("", line).split("///")[0]):
            yield number, "a comment of a public header is ///, behind a member ///<"
        namespaces = namespaces or line.startswith("namespace")
        begins = number == 1 or not lines[number - 2]
        code = line and not line[0].isspace() and not line.startswith("/")
        if namespaces and begins and code and not NEEDS_NONE.match(line) and not FORWARD.match(line):
            yield number, "a public declaration has no /// comment"


def check_public(src, sources):
    """Yields (path below src/, line, message) about the list and its headers."""
    if not (src / LIST).is_file():
        return
    sides, found = read_list(src / LIST)
    for message in found:
        yield LIST, 1, message
    headers = {source.place: source for source in sources}
    for place, side in sides.items():
        if place not in headers:
            yield LIST, 1, f"lists {place}, which is no header"
            continue
        for line, kind, target in headers[place].includes:
            if kind == '"' and target not in sides:
                yield place, line, f"#include {target}: not in {LIST}, so that it is not installed"
            elif kind == '"' and SIDES.index(sides[target]) > SIDES.index(side):
                yield place, line, f"#include {target}: the side {side} does not see {sides[target]}"
        for line, message in check_comments(Path(src / place).read_text(encoding="utf-8")):
            yield place, line, message
