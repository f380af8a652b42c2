#!/usr/bin/env python3
"""Runs the snippets of pages (snippets.py), each page in a scratch folder that looks like the project.

Usage: docs_test.py BUILD_FOLDER PAGE...
"""

import os
import shutil
import sys
import tempfile
from pathlib import Path

import snippets

ROOT = Path(__file__).resolve().parents[2]
COPIED = ("scenarios", "results/reference", "results/baselines")
LINKED = ("examples", "scripts", "terrain", "tests")


def faults_of(page, build):
    """What is wrong with the page."""
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        for name in COPIED:
            shutil.copytree(ROOT / name, folder / name)
        for name in LINKED:
            (folder / name).symlink_to(ROOT / name)
        (folder / "build").mkdir()
        (folder / "build/release").symlink_to(build)
        environment = dict(os.environ, PATH=f"{build / 'bin'}{os.pathsep}{os.environ['PATH']}",
                           PYTHONPATH=str(build / "python"), MPLBACKEND="Agg")
        return list(snippets.faults_of(page, folder, environment, sys.executable))


def main():
    build, pages = Path(sys.argv[1]).resolve(), [Path(name).resolve() for name in sys.argv[2:]]
    found = sum(len(snippets.snippets_of(page)) for page in pages)
    if not found:
        sys.exit("no snippets")
    faults = [fault for page in pages for fault in faults_of(page, build)]
    print(f"{len(pages)} pages, {found} snippets, {len(faults)} faults")
    sys.exit("\n".join(faults) if faults else 0)


if __name__ == "__main__":
    main()
