"""What the CMakeLists.txt of a module says: its sources and what it links."""

import re

from layers.rules import FOR_ALL, HEAVY

KEYWORDS = {"SOURCES", "DEPENDS", "PARAMS_OF", "PRIVATE_LIBRARIES", "SELDOM_RUN"}
SOURCE = re.compile(r"[\w./-]+\.cc\b")


def module_call(text):
    """The arguments of rockyard_module(...) as (line, word) by keyword, or None."""
    match = re.search(r"rockyard_module\s*\(([^)]*)\)", text)
    if not match:
        return None
    arguments, keyword = {"NAME": []}, "NAME"
    for line in match.group(1).splitlines():
        for word in line.split():
            if word in KEYWORDS:
                keyword = word
                arguments.setdefault(keyword, [])
            else:
                arguments[keyword].append((line, word))
    return arguments


def check_sources(folder, text, arguments, helpers):
    """Yields messages about files that are not listed exactly once, on a line of their own.

    `helpers` is the text of the project's CMake functions: a variable among the sources may hold a
    file that one of them names.
    """
    sources = arguments.get("SOURCES", [])
    for line, word in sources:
        if line.strip() != word:
            yield f"SOURCES {word}: one file a line"
    listed = SOURCE.findall(text)
    if any("${" in word for _, word in sources):
        listed += [name for name in set(SOURCE.findall(helpers)) if (folder / name).is_file()]
    there = {path.relative_to(folder).as_posix() for path in folder.rglob("*.cc")}
    for name in sorted(there | set(listed)):
        if name not in there:
            yield f"lists {name}, which is no file"
        elif name not in listed:
            yield f"{name} is in no list: it is not compiled"
        elif listed.count(name) > 1:
            yield f"lists {name} {listed.count(name)} times"


def check_links(rules, module, text, arguments, used):
    """Yields messages about links beyond the table, and about those that no include needs.

    `used` holds the folders that files of the module include.
    """
    for keyword in ("DEPENDS", "PARAMS_OF"):
        for _, other in arguments.get(keyword, []):
            if other not in rules.allowed.get(module, set()):
                yield f"{keyword} {other}: the table does not allow it"
            elif keyword == "DEPENDS" and module in rules.params_only and other not in (*FOR_ALL, *rules.params_only[module]):
                yield f"DEPENDS {other}: {module} may link parameters only (PARAMS_OF)"
            elif other not in used:
                yield f"{keyword} {other}: nothing in {module} includes it"
    for other in re.findall(r"\brockyard(?:_|::)(\w+)", text):
        other = other.removesuffix("_params")
        if other in rules.allowed and other not in rules.allowed.get(module, set()):
            yield f"names rockyard_{other}: the table does not allow it"
    for library, (_, target) in HEAVY.items():
        if re.search(target, text) and module not in rules.heavy.get(library, set()):
            yield f"links {library}, which belongs to {sorted(rules.heavy.get(library, []))}"


def check_cmake(rules, folder, used, helpers):
    """Yields messages about src/FOLDER/CMakeLists.txt."""
    text = re.sub(r"#[^\n]*", "", (folder / "CMakeLists.txt").read_text(encoding="utf-8"))
    arguments = module_call(text)
    if arguments is None:
        yield "no rockyard_module(...)"
        return
    if [word for _, word in arguments["NAME"]] != [folder.name]:
        yield f"rockyard_module is not named {folder.name}"
    yield from check_sources(folder, text, arguments, helpers)
    yield from check_links(rules, folder.name, text, arguments, used)
