#!/usr/bin/env python3
"""Writes what ctest needs to run the tests of a GoogleTest program, those of a source file in one process.

Usage: list_tests.py PROGRAM LABELS OUTPUT
LABELS has one line per source file with tests: its path, a tab, the labels separated by ";". A label
"tests/FOLDER" tells the name: FOLDER/ and the path of the file below it, without its extension.
OUTPUT is a CMake script of add_test() and set_tests_properties(), one pair a file.
Exit code 0; 1: a test stands in a file that LABELS does not name, or a file of LABELS has no test.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path


def read_labels(path):
    lines = Path(path).read_text(encoding="utf-8").splitlines()
    return dict(line.split("\t") for line in lines if line)


def tests_of(program):
    """Yields (suite, test, file) of every test, as the program lists them."""
    with tempfile.TemporaryDirectory() as folder:
        output = Path(folder, "tests.json")
        subprocess.run([program, "--gtest_list_tests", f"--gtest_output=json:{output}"], check=True,
                       stdout=subprocess.DEVNULL)
        suites = json.loads(output.read_text(encoding="utf-8"))["testsuites"]
    for suite in suites:
        for test in suite["testsuite"]:
            yield suite["name"], test["name"], test["file"]


def absolute(file, program, labels):
    """The file as LABELS names it: compiler caches may tell paths from the build folder on."""
    places = [Path(folder, file).resolve() for folder in Path(program).resolve().parents]
    return next((str(place) for place in places if str(place) in labels), file)


def bracket(text):
    """A CMake argument in which no character has a meaning."""
    level = "=" * next(n for n in range(1, 9) if f"]{'=' * n}]" not in text)
    return f"[{level}[{text}]{level}]"


def filters_of(tests):
    """The filter that chooses the tests of each file: whole suites where a suite stands in one file."""
    suites = {}
    for suite, name, file in tests:
        suites.setdefault(suite, {}).setdefault(file, []).append(f"{suite}.{name}")
    filters = {}
    for suite, files in suites.items():
        for file, names in files.items():
            filters.setdefault(file, []).extend([f"{suite}.*"] if len(files) == 1 else names)
    return {file: ":".join(patterns) for file, patterns in filters.items()}


def name_of(file, labels):
    """navigation/gestalt/votes_test of a file .../tests/navigation/gestalt/votes_test.cc."""
    folder = next(label for label in labels.split(";") if label.startswith("tests/"))
    below = Path(file).with_suffix("").as_posix().rpartition(f"/{folder}/")[2]
    return f"{folder.removeprefix('tests/')}/{below}"


def script(program, filters, labels):
    for file in sorted(filters):
        name = bracket(name_of(file, labels[file]))
        yield (f"add_test({name} {bracket(program)} {bracket('--gtest_filter=' + filters[file])} "
               "--gtest_also_run_disabled_tests)")
        yield (f"set_tests_properties({name} PROPERTIES LABELS {bracket(labels[file])} "
               f"WORKING_DIRECTORY {bracket(str(Path(program).parent))})")


def main(arguments):
    if len(arguments) != 3:
        print(__doc__)
        return 1
    program, labels_file, output = arguments
    labels = read_labels(labels_file)
    tests = [(suite, name, absolute(file, program, labels)) for suite, name, file in tests_of(program)]
    seen = {file for _, _, file in tests}
    for file in sorted(seen - labels.keys()):
        print(f"list_tests: {file} has tests, but stands in no list of rockyard_test", file=sys.stderr)
    for file in sorted(labels.keys() - seen):
        print(f"list_tests: {file} is listed as tests, but has none", file=sys.stderr)
    if seen != labels.keys():
        return 1
    Path(output).write_text("\n".join(script(program, filters_of(tests), labels)) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
