#!/usr/bin/env python3
"""Writes files of tests one after the other into one file, which is compiled in the time of a few.

Usage: join_tests.py OUT FILE...

Most of the time of a test's compilation goes into headers. What files of one folder name alike in their
unnamed namespaces would meet in one file; so each unnamed namespace is wrapped in a named one of its
file. Lines keep their numbers, and the compiler tells them by the real file. It is asked of a file that
it opens its one unnamed namespace by a line `namespace {`, closes it by a line `}  // namespace`, and has
nothing but closing braces after it.
Exit code 0: written; 1: a file is not like that.
"""

import re
import sys
from pathlib import Path

OPEN, CLOSE = "namespace {", "}  // namespace"
INCLUDE = re.compile(r'#include "([^"]+)"')


def with_own_namespace(path, number):
    """The lines of a file, those of its unnamed namespace wrapped in a namespace of its own."""
    lines = path.read_text(encoding="utf-8").splitlines()
    if lines.count(OPEN) != 1 or lines.count(CLOSE) != 1:
        raise ValueError(f"{path}: has not one line '{OPEN}' and one '{CLOSE}'")
    begin, end = lines.index(OPEN), lines.index(CLOSE)
    if any(line.strip() and line[0] != "}" for line in lines[end + 1:]):
        raise ValueError(f"{path}: has code after its unnamed namespace: compile it by itself "
                         "(SKIP_UNITY_BUILD_INCLUSION)")
    name = re.sub(r"\W", "_", path.stem)
    lines[begin] = f"namespace file_{number}_{name} {{ {OPEN}"
    lines[end] = "} " + CLOSE
    return lines


def from_its_folder(line, folder):
    """An include of a neighbour, as seen from another folder."""
    match = INCLUDE.fullmatch(line)
    if match and (folder / match[1]).is_file():
        return f'#include "{folder / match[1]}"'
    return line


def joined(paths):
    """The text of all files."""
    text = []
    for number, path in enumerate(paths):
        lines = with_own_namespace(path, number)
        text.append(f'#line 1 "{path}"')
        text += [from_its_folder(line, path.parent) for line in lines]
    return "\n".join(text) + "\n"


def main(arguments):
    out, *files = [Path(argument) for argument in arguments]
    try:
        out.write_text(joined([path.resolve() for path in files]), encoding="utf-8")
    except ValueError as error:
        print(f"join_tests: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
