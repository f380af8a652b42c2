#!/usr/bin/env python3
"""Runs what a release needs beside the tests of every change, and notes how each entry ended.

Usage: scripts/long_tests.py [--list] [--again] [NAME]...     (default: all, one after the other)
tests/long/tests.json names the entries, what each builds first (targets by preset) and its command;
tests/long/README.md lists them with their last results, and is written anew after each. An entry that passed is
not run again as long as nothing but that page and the changelog differs from the commit of its pass: what was
interrupted goes on where it was (--again: run it all the same).
Exit code 0: all pass; 1: some failed; 2: wrong use; 130: interrupted.
"""

import argparse
import datetime
import json
import re
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
FOLDER = ROOT / "tests" / "long"
ROW = re.compile(r"^\| (\w+) \|[^|]*\| `(.*)` \| ([^|]*) \|$", re.M)
RESULT = re.compile(r"(passed|FAILED).*?, \d{4}-\d{2}-\d{2}, commit (\w+)(-dirty)?, ([\d.]+) min")
NEVER = "not run yet"
TOLD_APART = ("tests/long/README.md", "CHANGELOG.md")  # what may change after a pass
LIMIT_MIN = 60.0


def read_tests():
    return json.loads((FOLDER / "tests.json").read_text(encoding="utf-8"))


def read_results(table, tests):
    """The last column of the table, by name; what another command gave is no result of this one."""
    commands = {test["name"]: test["command"] for test in tests}
    rows = ROW.findall(table.read_text(encoding="utf-8")) if table.is_file() else []
    return {name: result for name, command, result in rows if commands.get(name) == command}


def minutes_of(result):
    match = RESULT.match(result)
    return float(match[4]) if match else 0.0


def page(tests, results):
    """The table of all entries, and what they take together."""
    told = {test["name"]: results.get(test["name"], NEVER) for test in tests}
    lines = ["# Long tests", "",
             "`scripts/test.sh --all [NAME]...` runs them and writes this page.", "",
             "| name | what | command | last result |", "|---|---|---|---|"]
    lines += [f"| {test['name']} | {test['what']} | `{test['command']}` | {told[test['name']]} |" for test in tests]
    times = {name: minutes_of(result) for name, result in told.items()}
    over = [name for name, minutes in times.items() if minutes > LIMIT_MIN]
    ran = sum(result != NEVER for result in told.values())
    lines += ["", f"{ran} of {len(tests)} have run; together they took {sum(times.values()) / 60:.1f} hours."]
    if over:
        lines += [f"Longer than an hour, and so to be divided: {', '.join(over)}."]
    return "\n".join(lines) + "\n"


def git(*arguments):
    result = subprocess.run(["git", *arguments], cwd=ROOT, text=True, capture_output=True, check=False)
    return result.stdout.strip() if result.returncode == 0 else None


def only_told_apart(names):
    return all(name in TOLD_APART for name in names.splitlines())


def commit():
    """The commit that is tried, "-dirty" where anything else differs from it."""
    at = git("rev-parse", "--short=12", "HEAD") or "unknown"
    changed = git("diff", "--name-only", "HEAD")
    unknown = git("ls-files", "--others", "--exclude-standard")
    clean = changed is not None and only_told_apart(changed) and only_told_apart(unknown or "")
    return at if clean else f"{at}-dirty"


def holds_still(result):
    """Whether it is of a pass, of the tree as it is now."""
    match = RESULT.match(result)
    if not match or match[1] != "passed" or match[3] or commit().endswith("-dirty"):
        return False
    changed = git("diff", "--name-only", match[2], "HEAD")
    return changed is not None and only_told_apart(changed)


def commands_of(test):
    """What is built first, and the command."""
    for preset, targets in test.get("builds", {}).items():
        yield f"cmake --preset {preset} -DROCKYARD_BUILD_TESTS=ON"
        yield f"cmake --build --preset {preset} --target {' '.join(targets)}"
    yield test["command"]


def run(test):
    """Whether the test passed, and its result in a few words."""
    at = commit()
    start = time.monotonic()
    code = 0
    for command in commands_of(test):
        code = code or subprocess.run(command, shell=True, cwd=ROOT, check=False).returncode
    minutes = (time.monotonic() - start) / 60
    if commit() != at and not at.endswith("-dirty"):
        at += "-dirty"  # changed meanwhile: nobody knows what was tried
    verdict = "passed" if code == 0 else f"FAILED with exit code {code}"
    today = datetime.datetime.now(datetime.timezone.utc).date()
    return code == 0, f"{verdict}, {today}, commit {at}, {minutes:.1f} min"


def run_all(tests, chosen, again):
    """Whether all that are chosen pass; the page is written after each."""
    table, passed = FOLDER / "README.md", True
    results = read_results(table, tests)
    for number, test in enumerate(chosen, start=1):
        name = test["name"]
        before = f"== {name} ({number} of {len(chosen)})"
        if not again and holds_still(results.get(name, NEVER)):
            print(f"{before}: {results[name]}; nothing has changed since", flush=True)
            continue
        print(f"{before}: {test['command']}", flush=True)
        good, result = run(test)
        print(f"{before}: {result}", flush=True)
        passed = passed and good
        results = read_results(table, tests) | {name: result}  # others may have ended meanwhile
        table.write_text(page(tests, results), encoding="utf-8")
    return passed


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--list", action="store_true", help="names and last results; runs nothing")
    parser.add_argument("--again", action="store_true", help="also what passed and cannot have changed")
    parser.add_argument("names", metavar="NAME", nargs="*")
    options = parser.parse_args(arguments)
    tests = read_tests()
    unknown = set(options.names) - {test["name"] for test in tests}
    if unknown:
        names = ", ".join(test["name"] for test in tests)
        parser.error(f"no long test {', '.join(sorted(unknown))}; there are {names}")
    chosen = [test for test in tests if not options.names or test["name"] in options.names]
    if options.list:
        results = read_results(FOLDER / "README.md", tests)
        for test in chosen:
            print(f"{test['name']:18} {test['what']}\n{'':18} {results.get(test['name'], NEVER)}")
        return 0
    try:
        return 0 if run_all(tests, chosen, options.again) else 1
    except KeyboardInterrupt:
        print("long_tests: interrupted; what had passed is noted, and the next call goes on", file=sys.stderr)
        return 130


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
