#!/usr/bin/env python3
"""CITATION.cff is a Citation File Format 1.2.0 file of this version, with whole references.

Read line by line, by the layout that the file has, so that no YAML package is needed.

Usage: citation_test.py VERSION
"""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
REQUIRED = ("cff-version", "message", "title", "authors")  # by the schema of 1.2.0
REFERENCE = ("type", "title", "authors", "year")
PAPERS = {"1995", "2002", "2012"}


def top_level(text):
    """Keys at the left margin with what stands behind them."""
    return dict(re.findall(r"^([a-z-]+):[ \t]*(.*)$", text, flags=re.MULTILINE))


def references(text):
    """Each reference as its keys."""
    part = text.partition("\nreferences:\n")[2]
    return [dict(re.findall(r"^(?:  - |    )([a-z-]+):[ \t]*(.*)$", entry, flags=re.MULTILINE))
            for entry in re.split(r"(?m)^(?=  - type:)", part) if entry.strip()]


def faults_of(text, version):
    """What is wrong with the text of the file."""
    keys = top_level(text)
    faults = [f"{key} is missing" for key in REQUIRED if key not in keys]
    if keys.get("cff-version") != "1.2.0":
        faults.append("cff-version is not 1.2.0")
    if keys.get("version") != version:
        faults.append(f"version is {keys.get('version')}, not {version}")
    for entry in references(text):
        faults += [f"{entry.get('title')}: {key} is missing" for key in REFERENCE if key not in entry]
    if {entry.get("year") for entry in references(text)} != PAPERS:
        faults.append("the papers of 1995, 2002 and 2012 are not the references")
    if "\t" in text:
        faults.append("has tabulators, which YAML refuses")
    return faults


def main():
    text, version = (ROOT / "CITATION.cff").read_text(encoding="utf-8"), sys.argv[1]
    for wrong in ("message: ", "cff-version: 1", "version: 0", "    year: 2012"):
        if not faults_of(text.replace(wrong, "other: "), version):
            sys.exit(f"a file with another \"{wrong}\" passes")
    faults = faults_of(text, version)
    sys.exit("\n".join(faults) if faults else 0)


if __name__ == "__main__":
    main()
