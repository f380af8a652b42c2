#!/usr/bin/env python3
"""Runs what the README and the pages of results/ tell a newcomer to run.

Commands of the project's scripts are called with --help (the scripts themselves are run by whoever
sets up a machine); every other command runs as printed, in a scratch folder that sees the scenarios
and the reference values. The JSON example must be a valid scenario. Links: pages_test.py.

Usage: readme_test.py README ROCKYARD (pages: README, and results/*.md beside it)
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

# A check may find a difference (1) or too little to tell (4): the verdict is no part of the test.
ALLOWED = {"check": {0, 1, 4}}


def blocks(text, language):
    return re.findall(rf"```{language}\n(.*?)```", text, flags=re.DOTALL)


def commands(text):
    return [line for block in blocks(text, "sh") for line in block.splitlines() if line.strip()]


def run(command, folder, environment):
    if command.startswith("scripts/"):
        command += " --help"
    # Against one that hangs: with sanitizers the sweep of the regression check takes ten minutes.
    result = subprocess.run(command, shell=True, cwd=folder, env=environment, text=True,
                            capture_output=True, check=False, timeout=3600)
    words = command.split()
    allowed = ALLOWED.get(words[1], {0}) if len(words) > 1 else {0}
    if result.returncode not in allowed:
        return f"$ {command}\nexit code {result.returncode}\n{result.stdout}{result.stderr}"
    return None


def check_json(text, folder, environment):
    for index, block in enumerate(blocks(text, "json")):
        path = folder / "scenarios/pathfinder" / f"readme_{index}.json"
        path.write_text(block, encoding="utf-8")
        yield run(f"rockyard validate {path}", folder, environment)


def main():
    readme, rockyard = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    root = readme.parent
    pages = [readme, *sorted((root / "results").glob("*.md"))]
    text = readme.read_text(encoding="utf-8")
    found = commands(text)
    if [line for line in found[:2]] != ["scripts/quickstart.sh", "scripts/test.sh"]:
        sys.exit("the README does not start with quickstart and test")
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        shutil.copytree(root / "scenarios", folder / "scenarios")
        for name in ("reference", "baselines"):
            shutil.copytree(root / "results" / name, folder / "results" / name)
        (folder / "scripts").symlink_to(root / "scripts")
        environment = dict(os.environ, PATH=f"{rockyard.parent}{os.pathsep}{os.environ['PATH']}")
        for page in pages[1:]:
            found += commands(page.read_text(encoding="utf-8"))
        faults = [run(command, folder, environment) for command in found]
        faults += check_json(text, folder, environment)
    faults = [fault for fault in faults if fault]
    print(f"{len(found)} commands, {len(faults)} faults")
    sys.exit("\n".join(faults) if faults else 0)


if __name__ == "__main__":
    main()
