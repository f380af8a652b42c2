#!/usr/bin/env python3
"""docs/commands is what the parser of the command says, and its man pages are roff without a warning.

Usage: command_pages_test.py ROCKYARD PROJECT
After a change of an option: rockyard help --format markdown --out docs/commands
"""

import subprocess
import sys
import tempfile
from pathlib import Path

REMEDY = "rockyard help --format markdown --out docs/commands"


def written(rockyard, form, folder):
    """The pages of every command, by name."""
    subprocess.run([rockyard, "help", "--format", form, "--out", folder], check=True, capture_output=True)
    return {page.name: page.read_text(encoding="utf-8") for page in Path(folder).iterdir()}


def differences(made, kept):
    """Names of pages that are not as the parser makes them."""
    return sorted(name for name in made.keys() | kept.keys() if made.get(name) != kept.get(name))


def warnings_of(page):
    """What groff says about a man page."""
    result = subprocess.run(["groff", "-man", "-Tutf8", "-ww", "-"], input=page, text=True, check=False,
                            capture_output=True)
    return result.stderr + ("" if result.returncode == 0 and "NAME" in result.stdout.replace("\b", "")
                            .replace("NNAAMMEE", "NAME") else "no page")


def main():
    rockyard, project = sys.argv[1], Path(sys.argv[2])
    kept = {page.name: page.read_text(encoding="utf-8") for page in (project / "docs/commands").iterdir()}
    with tempfile.TemporaryDirectory() as folder:
        made = written(rockyard, "markdown", folder)
    with tempfile.TemporaryDirectory() as folder:
        man = written(rockyard, "man", folder)
    changed = dict(made, **{"run.md": made["run.md"] + "x"})
    if differences(changed, made) != ["run.md"] or not warnings_of(".TH A 1\n.SH NAME\n.nosuchrequest\n"):
        sys.exit("the checks find nothing where something is wrong")
    faults = [f"docs/commands/{name} is not what the parser says; {REMEDY}" for name in differences(made, kept)]
    faults += [f"{name}: {text}" for name, page in sorted(man.items()) if (text := warnings_of(page))]
    print(f"{len(made)} pages, {len(man)} man pages, {len(faults)} faults")
    sys.exit("\n".join(faults) if faults else 0)


if __name__ == "__main__":
    main()
