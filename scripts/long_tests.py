#!/usr/bin/env python3
"""Runs the tests that take too long to run by default, and notes how each ended.

Usage: scripts/long_tests.py [--list] [NAME]...     (default: all, one after the other)
tests/long/tests.json names them; tests/long/README.md lists them with their last results, and is
written anew after each.
Exit code 0: all pass; 1: some failed; 2: wrong use.
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
ROW = re.compile(r"^\| (\w+) \|.*\| ([^|]*) \|$", re.M)
NEVER = "not run yet"


def read_tests():
    return json.loads((FOLDER / "tests.json").read_text(encoding="utf-8"))


def read_results(table):
    """The last column of the table, by name."""
    return dict(ROW.findall(table.read_text(encoding="utf-8"))) if table.is_file() else {}


def page(tests, results):
    lines = ["# Long tests", "",
             "`scripts/test.sh --long [NAME]...` runs them and writes this page.", "",
             "| name | what | command | last result |", "|---|---|---|---|"]
    lines += [f"| {test['name']} | {test['what']} | `{test['command']}` | "
              f"{results.get(test['name'], NEVER)} |" for test in tests]
    return "\n".join(lines) + "\n"


def commit():
    described = subprocess.run(["git", "describe", "--always", "--dirty", "--abbrev=12", "--exclude=*"],
                               cwd=ROOT, text=True, capture_output=True, check=False)
    return described.stdout.strip() or "unknown"


def run(test):
    """Whether the test passed, and its result in a few words."""
    at = commit()
    start = time.monotonic()
    code = subprocess.run(test["command"], shell=True, cwd=ROOT, check=False).returncode
    minutes = (time.monotonic() - start) / 60
    verdict = "passed" if code == 0 else f"FAILED with exit code {code}"
    today = datetime.datetime.now(datetime.timezone.utc).date()
    return code == 0, f"{verdict}, {today}, commit {at}, {minutes:.1f} min"


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--list", action="store_true", help="names and last results; runs nothing")
    parser.add_argument("names", metavar="NAME", nargs="*")
    options = parser.parse_args(arguments)
    tests, table = read_tests(), FOLDER / "README.md"
    results = read_results(table)
    unknown = set(options.names) - {test["name"] for test in tests}
    if unknown:
        names = ", ".join(test["name"] for test in tests)
        parser.error(f"no long test {', '.join(sorted(unknown))}; there are {names}")
    if options.list:
        for test in tests:
            print(f"{test['name']:18} {test['what']}\n{'':18} {results.get(test['name'], NEVER)}")
        return 0
    passed = True
    for test in tests:
        if options.names and test["name"] not in options.names:
            continue
        print(f"== {test['name']}: {test['command']}", flush=True)
        good, results[test["name"]] = run(test)
        print(f"== {test['name']}: {results[test['name']]}", flush=True)
        passed = passed and good
        table.write_text(page(tests, results), encoding="utf-8")
    return 0 if passed else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
