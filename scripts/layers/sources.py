"""Source files and the arrows among them: includes of C++, imports of TypeScript."""

import re
from dataclasses import dataclass
from pathlib import Path

CPP_SUFFIXES = {".h", ".cc"}
SCRIPT_SUFFIXES = {".ts", ".mjs"}

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.M)
# import ... from "./x", export ... from "./x", import "./x", import("./x"); packages have no dot.
IMPORT = re.compile(r'(?:\bfrom\s*|\bimport\s*\(?\s*)["\'](\.{1,2}/[^"\']*)["\']')
COMMENT = re.compile(r"/\*.*?\*/|(?<!:)//[^\n]*", re.S)


@dataclass
class Source:
    """A file of C++ without its comments; places are paths below src/."""

    place: str
    suffix: str
    length: int      # lines
    code: str
    includes: list   # (line number, quote or bracket, path)

    @property
    def module(self):
        return self.place.split("/", 1)[0]


def strip_comments(text):
    """Blanks comments and keeps line numbers, so that commented words are not taken for code."""
    return COMMENT.sub(lambda match: re.sub(r"[^\n]", " ", match.group(0)), text)


def read_source(src, path):
    text = path.read_text(encoding="utf-8")
    code = strip_comments(text)
    includes = [(code.count("\n", 0, match.start(1)) + 1, match.group(1), match.group(2))
                for match in INCLUDE.finditer(code)]
    return Source(path.relative_to(src).as_posix(), path.suffix, text.count("\n"), code, includes)


def room_of(place):
    """The room of "module/room/file.h", or None for a file that lies in its module directly."""
    parts = place.split("/")
    return "/".join(parts[:2]) if len(parts) > 2 else None


def file_graph(sources):
    """File -> files of this project that it includes."""
    places = {source.place for source in sources}
    return {source.place: [target for _, kind, target in source.includes
                           if kind == '"' and target in places] for source in sources}


def raise_graph(files, group_of):
    """The graph of files as one of groups, and an example of each arrow: (from, to) -> (file, file).

    group_of gives the group of a file, or None for those that do not count.
    """
    examples = {}
    for place, targets in files.items():
        for target in targets:
            arrow = (group_of(place), group_of(target))
            if None not in arrow and arrow[0] != arrow[1]:
                examples.setdefault(arrow, (place, target))
    graph = {}
    for here, there in sorted(examples):
        graph.setdefault(here, []).append(there)
    return graph, examples


def import_graph(src):
    """File -> files that it imports, of everything that is bundled into a page."""
    paths = {path.relative_to(src).as_posix(): path for path in sorted(src.rglob("*"))
             if path.suffix in SCRIPT_SUFFIXES and "node_modules" not in path.parts}
    graph = {}
    for place, path in paths.items():
        graph[place] = []
        for target in IMPORT.findall(strip_comments(path.read_text(encoding="utf-8"))):
            meant = resolve(Path(place).parent, target)
            graph[place] += [name for name in (meant, f"{meant}.ts", f"{meant}/index.ts")
                             if name in paths][:1]
    return graph


def resolve(folder, target):
    """The path that "./x" or "../x" in a file of `folder` means."""
    parts = list(folder.parts)
    for part in target.split("/"):
        if part == "..":
            parts = parts[:-1]
        elif part != ".":
            parts.append(part)
    return "/".join(parts)
