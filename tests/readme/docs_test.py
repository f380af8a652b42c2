#!/usr/bin/env python3
"""Runs the snippets of a page of docs/ (snippets.py) in a scratch folder that looks like the project.

Usage: docs_test.py PAGE BUILD_FOLDER
"""

import os
import shutil
import sys
import tempfile
from pathlib import Path

import snippets

COPIED = ("scenarios", "results/reference", "results/baselines")
LINKED = ("scripts", "tests")


def main():
    page, build = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    root = Path(__file__).resolve().parents[2]
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        for name in COPIED:
            shutil.copytree(root / name, folder / name)
        for name in LINKED:
            (folder / name).symlink_to(root / name)
        (folder / "build").mkdir()
        (folder / "build/release").symlink_to(build)
        environment = dict(os.environ, PATH=f"{build / 'bin'}{os.pathsep}{os.environ['PATH']}")
        faults = list(snippets.faults_of(page, folder, environment, sys.executable))
    print(f"{len(snippets.snippets_of(page))} snippets, {len(faults)} faults")
    sys.exit("\n".join(faults) if faults else 0)


if __name__ == "__main__":
    main()
