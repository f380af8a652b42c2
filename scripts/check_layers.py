#!/usr/bin/env python3
"""Checks that the source tree keeps the layers that src/README.md draws.

Usage: scripts/check_layers.py [ROOT]     ROOT holds src/ (default: the project of this script)

The rules come from src/README.md: the table "folder | may also include" and the sentence of rule 2
that says which folder each heavy library belongs to. Checked:
  * every #include of every source file: the module is allowed, "only their *_params.h" is kept, the
    path starts with a module, the header exists, heavy libraries appear in .cc files of their
    folder only, no other third-party library appears unannounced;
  * the modules and libraries that each CMakeLists.txt names go no further than the same rules;
  * no cycle among files that include each other;
  * every folder has a README.md and no file is longer than 600 lines.
Exit code 0: kept; 1: violations, one line each; 2: the rules cannot be read.
"""

import re
import sys
from dataclasses import dataclass, field
from pathlib import Path

MAX_LINES = 600
SOURCE_SUFFIXES = {".h", ".cc"}

# Heavy libraries: how src/README.md, an #include and a CMake target name them.
HEAVY = {
    "Bullet": (r"bullet/|Bullet(Dynamics|Collision|SoftBody)|LinearMath/|bt[A-Z]", r"BULLET"),
    "Embree": (r"embree", r"embree"),
    "OpenMP": (r"omp\.h", r"OpenMP::"),
    "MPI": (r"mpi\.h", r"MPI::"),
    "SQLite": (r"sqlite3", r"SQLite"),
    "nlohmann-json": (r"nlohmann/", r"nlohmann_json"),
    "CLI11": (r"CLI/", r"CLI11"),
    "tinyxml2": (r"tinyxml2", r"tinyxml2"),
    "libpng": (r"png\.h", r"PNG::"),
    "libzip": (r"zip\.h", r"LIBZIP"),
    "zlib": (r"zlib\.h", r"ZLIB::"),
    "Boost.Math": (r"boost/", r"Boost::"),
}
# Everything else that <...> may name: the standard library, POSIX, and light libraries.
STANDARD = re.compile(r"[a-z_0-9]+$")
POSIX = re.compile(
    r"(unistd|fcntl|signal|poll|sched|dirent|pthread|cpuid|immintrin|x86intrin)\.h$|sys/[a-z_]+\.h$")
LIGHT = re.compile(r"(Eigen|unsupported/Eigen|fmt|Random123)/")

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
HAS_INCLUDE = re.compile(r"__has_include")
PRAGMA_OMP = re.compile(r"^\s*#\s*pragma\s+omp\b")


class RulesError(Exception):
    """src/README.md does not say what the check needs."""


@dataclass
class Rules:
    """What src/README.md allows."""

    allowed: dict = field(default_factory=dict)      # folder -> folders it may include
    params_only: set = field(default_factory=set)    # folders that may include *_params.h only
    heavy: dict = field(default_factory=dict)        # library -> folders of its .cc files


def read_table(text):
    """Returns (allowed, params_only) from the table below "may also include"."""
    allowed, params_only = {}, set()
    lines = iter(text.splitlines())
    for line in lines:
        if re.match(r"\|\s*folder\s*\|\s*may also include\s*\|", line):
            next(lines)
            break
    else:
        raise RulesError('src/README.md has no table "| folder | may also include |"')
    for line in lines:
        if not line.startswith("|"):
            break
        folder, others = [cell.strip() for cell in line.strip().strip("|").split("|")][:2]
        note = re.search(r"\(([^)]*)\)", others)
        if note and "*_params.h" in note.group(1):
            params_only.add(folder)
        names = re.sub(r"\([^)]*\)", "", others)
        allowed[folder] = {name.strip() for name in names.split(",") if name.strip()}
    for folder, others in allowed.items():
        unknown = others - allowed.keys()
        if unknown:
            raise RulesError(f"src/README.md: {folder} may include unknown {sorted(unknown)}")
        others |= {folder, "core", "math"}
    return allowed, params_only


def read_heavy(text, folders):
    """Returns library -> folders from rule 2: libraries, then the folders they are in, and so on."""
    rule = re.search(r"Heavy libraries stay(.*?)(?:\n\s*\n|\n3\.|\Z)", text, re.S)
    if not rule:
        raise RulesError('src/README.md has no rule "Heavy libraries stay ..."')
    sentence = rule.group(1).split("**", 1)[-1]
    names = sorted([*HEAVY, *folders], key=len, reverse=True)
    words = re.findall("|".join(rf"(?<!\w){re.escape(name)}(?!\w)" for name in names), sentence)
    heavy, current, last_was_library = {}, [], False
    for word in words:
        if word in HEAVY:
            current = [*current, word] if last_was_library else [word]
            heavy[word] = set()
        else:
            for library in current:
                heavy[library].add(word)
        last_was_library = word in HEAVY
    if not heavy or not all(heavy.values()):
        raise RulesError("src/README.md: rule 2 names no folder for some heavy library")
    return heavy


def read_rules(readme):
    text = readme.read_text(encoding="utf-8")
    allowed, params_only = read_table(text)
    return Rules(allowed, params_only, read_heavy(text, allowed.keys()))


def strip_comments(text):
    """Blanks comments and keeps line numbers, so that commented words are not taken for code."""
    keep_newlines = lambda match: re.sub(r"[^\n]", " ", match.group(0))
    return re.sub(r"/\*.*?\*/|(?<!:)//[^\n]*", keep_newlines, text, flags=re.S)


def includes_of(text):
    """Yields (line number, quote or bracket, path) of every #include."""
    for number, line in enumerate(strip_comments(text).splitlines(), start=1):
        match = INCLUDE.match(line)
        if match:
            yield number, match.group(1), match.group(2)


def check_own_include(rules, src, path, target):
    """Why a file may not include "target", or None."""
    module = path.relative_to(src).parts[0]
    parts = target.split("/")
    if ".." in parts or target.startswith("/"):
        return "paths start with a module, never with .. or /"
    other = parts[0]
    if len(parts) < 2 or other not in rules.allowed:
        return f"'{other}' is no folder of the table: write \"module/header.h\""
    if other not in rules.allowed.get(module, set()):
        return f"{module} may not include {other}"
    basic = other in (module, "core", "math")
    if module in rules.params_only and not basic and not target.endswith("_params.h"):
        return f"{module} may include only *_params.h of {other}"
    if not (src / target).is_file():
        generated = (src / f"{target}.in").is_file()
        return None if generated else "there is no such header"
    return None


def check_library_include(rules, src, path, target):
    """Why a file may not include <target>, or None."""
    module = path.relative_to(src).parts[0]
    for library, (pattern, _) in HEAVY.items():
        if re.match(pattern, target):
            return check_heavy_use(rules, module, path, library)
    if STANDARD.match(target) or POSIX.match(target) or LIGHT.match(target):
        return None
    if target.split("/")[0] in rules.allowed:
        return 'headers of this project are included with "..."'
    return "a library that scripts/check_layers.py does not list"


def check_heavy_use(rules, module, path, library):
    folders = rules.heavy.get(library)
    if not folders:
        return f"src/README.md gives {library} to no folder"
    if module not in folders:
        return f"{library} belongs to {', '.join(sorted(folders))}"
    if path.suffix != ".cc":
        return f"{library} stays in .cc files"
    return None


def check_file(rules, src, path):
    """Yields (line, message) for one source file."""
    text = path.read_text(encoding="utf-8")
    count = text.count("\n")
    if count > MAX_LINES:
        yield 1, f"{count} lines, more than {MAX_LINES}"
    module = path.relative_to(src).parts[0]
    for number, kind, target in includes_of(text):
        check = check_own_include if kind == '"' else check_library_include
        problem = check(rules, src, path, target)
        if problem:
            yield number, f"#include {target}: {problem}"
    for number, line in enumerate(strip_comments(text).splitlines(), start=1):
        if PRAGMA_OMP.match(line):
            problem = check_heavy_use(rules, module, path, "OpenMP")
            if problem:
                yield number, f"#pragma omp: {problem}"
        if HAS_INCLUDE.search(line):
            yield number, "__has_include hides an include from this check"


def find_cycles(src, files):
    """Yields each cycle of files that include each other, once, as a list of paths."""
    graph = {}
    for path in files:
        targets = (src / target for _, kind, target in includes_of(path.read_text("utf-8"))
                   if kind == '"')
        graph[path] = [target for target in targets if target.is_file()]
    state, stack = {}, []

    def visit(node):
        state[node] = "open"
        stack.append(node)
        for target in graph.get(node, []):
            if state.get(target) == "open":
                yield stack[stack.index(target):] + [target]
            elif target not in state:
                yield from visit(target)
        stack.pop()
        state[node] = "done"

    for node in sorted(graph):
        if node not in state:
            yield from visit(node)


KEYWORDS = {"SOURCES", "DEPENDS", "PARAMS_OF", "PRIVATE_LIBRARIES"}


def module_call(text):
    """The arguments of rockyard_module(...) by keyword, or None."""
    text = re.sub(r"#[^\n]*", "", text)
    match = re.search(r"rockyard_module\s*\(([^)]*)\)", text)
    if not match:
        return None
    arguments, keyword = {"NAME": []}, "NAME"
    for word in match.group(1).split():
        if word in KEYWORDS:
            keyword = word
            arguments.setdefault(keyword, [])
        else:
            arguments[keyword].append(word)
    return arguments


def check_cmake(rules, folder):
    """Yields messages about what src/FOLDER/CMakeLists.txt links."""
    module = folder.name
    text = (folder / "CMakeLists.txt").read_text(encoding="utf-8")
    arguments = module_call(text)
    if arguments is None:
        yield "no rockyard_module(...)"
        return
    if arguments["NAME"] != [module]:
        yield f"rockyard_module is not named {module}"
    for keyword in ("DEPENDS", "PARAMS_OF"):
        for other in arguments.get(keyword, []):
            if other not in rules.allowed.get(module, set()):
                yield f"{keyword} {other}: the table does not allow it"
            elif keyword == "DEPENDS" and module in rules.params_only and other not in (
                    "core", "math"):
                yield f"DEPENDS {other}: {module} may link parameters only (PARAMS_OF)"
    for other in re.findall(r"\brockyard(?:_|::)(\w+)", re.sub(r"#[^\n]*", "", text)):
        other = other.removesuffix("_params")
        if other in rules.allowed and other not in rules.allowed.get(module, set()):
            yield f"names rockyard_{other}: the table does not allow it"
    for library, (_, target) in HEAVY.items():
        if re.search(target, text) and module not in rules.heavy.get(library, set()):
            yield f"links {library}, which belongs to {sorted(rules.heavy.get(library, []))}"


def check_tree(root):
    """Every violation below ROOT/src as 'path:line: message'."""
    src = root / "src"
    rules = read_rules(src / "README.md")
    folders = sorted(path for path in src.iterdir() if path.is_dir())
    files = sorted(path for path in src.rglob("*") if path.suffix in SOURCE_SUFFIXES)
    found = []
    for folder in folders:
        if folder.name not in rules.allowed:
            found.append(f"src/{folder.name}:1: not in the table of src/README.md")
        if not (folder / "README.md").is_file():
            found.append(f"src/{folder.name}:1: has no README.md")
        if not (folder / "CMakeLists.txt").is_file():
            found.append(f"src/{folder.name}:1: has no CMakeLists.txt")
            continue
        found += [f"src/{folder.name}/CMakeLists.txt:1: {message}"
                  for message in check_cmake(rules, folder)]
    for path in files:
        if path.parent == src:
            found.append(f"{path.relative_to(root)}:1: source files belong to a folder")
            continue
        found += [f"{path.relative_to(root)}:{line}: {message}"
                  for line, message in check_file(rules, src, path)]
    for cycle in find_cycles(src, files):
        names = " -> ".join(str(path.relative_to(src)) for path in cycle)
        found.append(f"src/{cycle[0].relative_to(src)}:1: include cycle {names}")
    return found, len(files)


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
