#!/usr/bin/env python3
"""Checks that the source tree keeps the layers that src/README.md draws.

Usage: scripts/check_layers.py [ROOT]     ROOT holds src/ (default: the project of this script)

The rules come from src/README.md: the table "folder | may also include", whose rows stand from the
bottom up, and the sentences of rules 2 and 4 that say which folders heavy libraries belong to and which may
call the C library's elementary functions. Checked:
  * the table: no row allows a folder of a later row (an arrow up), nor one that nothing there
    includes, nor one that is not there;
  * every #include of every source file: the module is allowed, "only their *_params.h, but for NAME" is kept, the
    path starts with a module, the header exists, heavy libraries appear in .cc files of their
    folder only, no other third-party library appears unannounced;
  * no circle among modules, among the rooms of a module (its subfolders; files that lie in the
    module directly are of no room), among files that include each other, and among files of
    TypeScript that import each other, types included;
  * CMakeLists.txt of each module lists every .cc file below it once, one a line, and no other file;
    it links no further than the table, and nothing that no include needs;
  * src/public_headers.txt lists at most 46 headers, which are what is installed: what they include is
    listed too, on a side that theirs may see, and their comments are ///;
  * CMakeLists.txt of each folder of tests names every file of tests below it;
  * modules that rule 4 does not name call no elementary functions of the C library, nor what of Eigen does;
  * every module has a README.md and no file is longer than 600 lines.
Exit code 0: kept; 1: violations, one line each; 2: the rules cannot be read.
"""

import re
import sys
from pathlib import Path

from layers.circles import find_circles
from layers.cmake import check_cmake
from layers.public import check_public
from layers.rules import FOR_ALL, HEAVY, RulesError, read_rules
from layers.sources import (CPP_SUFFIXES, file_graph, import_graph, raise_graph, read_source,
                            room_of)

MAX_LINES = 600

# What <...> may name beside heavy libraries: the standard library, POSIX, and light libraries.
STANDARD = re.compile(r"[a-z_0-9]+$")
POSIX = re.compile(
    r"(stddef|stdint|unistd|fcntl|dlfcn|signal|poll|sched|dirent|pthread|cpuid|immintrin|x86intrin|cxxabi)\.h$|(sys|sanitizer)/[a-z_]+\.h$")
LIGHT = re.compile(r"(Eigen|unsupported/Eigen|fmt|Random123)/")

HAS_INCLUDE = re.compile(r"__has_include")
# What calls the C library's elementary functions, whose last bits depend on the processor.
ELEMENTARY = re.compile(
    r"\bstd::(?:a?(?:sin|cos|tan)h?|atan2|exp2?|expm1|expint|log(?:2|10|1p)?|pow|cbrt|hypot|erfc?|[lt]gamma)\b"
    r"|\bEigen::(?:AngleAxis|Rotation2D)[df]?\b|\.(?:slerp|eulerAngles|angularDistance)\b")
PRAGMA_OMP = re.compile(r"^\s*#\s*pragma\s+omp\b")


def check_own_include(rules, src, source, target):
    """Why a file may not include "target", or None."""
    module = source.module
    parts = target.split("/")
    if ".." in parts or target.startswith("/"):
        return "paths start with a module, never with .. or /"
    other = parts[0]
    if len(parts) < 2 or other not in rules.allowed:
        return f"'{other}' is no folder of the table: write \"module/header.h\""
    if other not in rules.allowed.get(module, set()):
        return f"{module} may not include {other}"
    basic = other in (module, *FOR_ALL)
    whole = basic or other in rules.params_only.get(module, ())
    if module in rules.params_only and not whole and not target.endswith("_params.h"):
        return f"{module} may include only *_params.h of {other}"
    if not (src / target).is_file():
        generated = (src / f"{target}.in").is_file()
        return None if generated else "there is no such header"
    return None


def check_library_include(rules, _, source, target):
    """Why a file may not include <target>, or None."""
    for library, (pattern, _) in HEAVY.items():
        if re.match(pattern, target):
            return check_heavy_use(rules, source, library)
    if STANDARD.match(target) or POSIX.match(target) or LIGHT.match(target):
        return None
    if target.split("/")[0] in rules.allowed:
        return 'headers of this project are included with "..."'
    return "a library that scripts/check_layers.py does not list"


def check_heavy_use(rules, source, library):
    folders = rules.heavy.get(library)
    if not folders:
        return f"src/README.md gives {library} to no folder"
    if source.module not in folders:
        return f"{library} belongs to {', '.join(sorted(folders))}"
    is_leaf = not any(source.module in may for folder, may in rules.allowed.items() if folder != source.module)
    if source.suffix != ".cc" and not is_leaf:  # nobody includes the headers of a leaf
        return f"{library} stays in .cc files"
    return None


def check_file(rules, src, source):
    """Yields (line, message) for one source file."""
    if source.length > MAX_LINES:
        yield 1, f"{source.length} lines, more than {MAX_LINES}"
    for number, kind, target in source.includes:
        check = check_own_include if kind == '"' else check_library_include
        problem = check(rules, src, source, target)
        if problem:
            yield number, f"#include {target}: {problem}"
    for number, line in enumerate(source.code.splitlines(), start=1):
        if PRAGMA_OMP.match(line):
            problem = check_heavy_use(rules, source, "OpenMP")
            if problem:
                yield number, f"#pragma omp: {problem}"
        call = ELEMENTARY.search(line)
        if call and source.module not in rules.free:
            yield number, f"{call.group()}: its bits depend on the processor, see math/functions.h"
        if HAS_INCLUDE.search(line):
            yield number, "__has_include hides an include from this check"


def used_folders(sources):
    """Module -> folders that its files include."""
    used = {}
    for source in sources:
        folders = used.setdefault(source.module, set())
        folders |= {target.split("/")[0] for _, kind, target in source.includes if kind == '"'}
    return used


def check_table(rules, src, used):
    """Yields messages about rows that allow an arrow up, or more than is used."""
    for folder, others in rules.named.items():
        if not (src / folder).is_dir():
            yield f"a row for {folder}, which is no folder"
        for other in sorted(others, key=rules.height):
            if rules.height(other) > rules.height(folder):
                yield f"{folder} may include {other}, whose row stands above: an arrow up"
            elif other not in used.get(folder, set()):
                yield f"{folder} may include {other}, which nothing there includes"


def check_circles(src, sources):
    """Yields (file, message) for every kind of circle."""
    files = file_graph(sources)
    for circle in find_circles(files):
        yield circle[0], f"include cycle {' -> '.join(circle)}"
    groups = (("modules", lambda place: place.split("/", 1)[0]), ("rooms", room_of))
    for what, group_of in groups:
        graph, examples = raise_graph(files, group_of)
        for circle in find_circles(graph):
            arrows = [examples[arrow] for arrow in zip(circle, circle[1:])]
            reasons = ", ".join(f"{place} includes {target}" for place, target in arrows)
            yield arrows[0][0], f"circle of {what} {' -> '.join(circle)} ({reasons})"
    for circle in find_circles(import_graph(src)):
        yield circle[0], f"import cycle {' -> '.join(circle)}"


def check_folder(rules, folder, used, helpers):
    """Yields (path below src/, message) about what a module consists of beside its sources."""
    if folder.name not in rules.allowed:
        yield folder.name, "not in the table of src/README.md"
    if not (folder / "README.md").is_file():
        yield folder.name, "has no README.md"
    if not (folder / "CMakeLists.txt").is_file():
        yield folder.name, "has no CMakeLists.txt"
        return
    for message in check_cmake(rules, folder, used.get(folder.name, set()), helpers):
        yield f"{folder.name}/CMakeLists.txt", message


def unlisted_tests(tests):
    """Yields the files of tests, below tests/, that no program compiles: they would never fail."""
    for path in sorted(tests.rglob("*_test.cc")):
        place = path.relative_to(tests)
        folder = tests / place.parts[0]
        lists = folder / "CMakeLists.txt"
        words = re.split(r"[\s()]+", lists.read_text(encoding="utf-8")) if lists.is_file() else []
        if path.relative_to(folder).as_posix() not in words:
            yield place


def check_tree(root):
    """Every violation below ROOT/src as 'path:line: message', and the number of source files."""
    src = root / "src"
    rules = read_rules(src / "README.md")
    helpers = "".join(path.read_text(encoding="utf-8")
                      for path in sorted((root / "scripts" / "cmake").glob("*.cmake")))
    paths = sorted(path for path in src.rglob("*") if path.suffix in CPP_SUFFIXES)
    sources = [read_source(src, path) for path in paths if path.parent != src]
    used = used_folders(sources)
    found = [f"src/README.md:1: {message}" for message in check_table(rules, src, used)]
    for folder in sorted(path for path in src.iterdir() if path.is_dir()):
        found += [f"src/{place}:1: {message}"
                  for place, message in check_folder(rules, folder, used, helpers)]
    found += [f"src/{path.name}:1: source files belong to a folder"
              for path in paths if path.parent == src]
    for source in sources:
        found += [f"src/{source.place}:{line}: {message}"
                  for line, message in check_file(rules, src, source)]
    found += [f"src/{place}:1: {message}" for place, message in check_circles(src, sources)]
    found += [f"src/{place}:{line}: {message}" for place, line, message in check_public(src, sources)]
    found += [f"tests/{place}:1: in no list of {place.parts[0]}/CMakeLists.txt"
              for place in unlisted_tests(root / "tests")]
    return found, len(paths)


def main(arguments):
    if len(arguments) > 1 or (arguments and arguments[0] in ("-h", "--help")):
        print(__doc__)
        return 0 if len(arguments) == 1 else 2
    root = Path(arguments[0]) if arguments else Path(__file__).resolve().parent.parent
    try:
        found, count = check_tree(root)
    except (RulesError, OSError) as error:
        print(f"check_layers: {error}", file=sys.stderr)
        return 2
    for line in found:
        print(line)
    print(f"check_layers: {count} files, {len(found)} violations")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
