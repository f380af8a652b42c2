#!/usr/bin/env python3
"""Runs clang-tidy on the .cc files of folders of src/ that changed since they last passed.

Usage: scripts/check_tidy.py BUILD_DIR FOLDER...      BUILD_DIR holds compile_commands.json

A file passes again without running if nothing that it is made of changed: its text, the headers of
this project that it includes, the compiler command, .clang-tidy and the version of clang-tidy.
Exit code 0: no finding; 1: findings, printed; 2: wrong use.
"""

import hashlib
import json
import shlex
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
CLANG_TIDY = "clang-tidy"


def entries_of(build, folder):
    """The compile commands of the files of src/FOLDER."""
    commands = json.loads((build / "compile_commands.json").read_text(encoding="utf-8"))
    place = (ROOT / "src" / folder).resolve()
    return [entry for entry in commands if Path(entry["file"]).resolve().is_relative_to(place)]


def dependencies(entry):
    """The file and the headers that it includes, system headers left out."""
    arguments = shlex.split(entry["command"])
    if Path(arguments[0]).name == "ccache":
        del arguments[0]
    start = arguments.index("-o")
    del arguments[start:start + 2]
    arguments = [word for word in arguments if word not in ("-c", "-MD")]
    for option in ("-MT", "-MF"):
        if option in arguments:
            start = arguments.index(option)
            del arguments[start:start + 2]
    rule = subprocess.run([*arguments, "-MM"], cwd=entry["directory"], text=True,
                          capture_output=True, check=True).stdout
    return sorted(rule.replace("\\\n", " ").split(":", 1)[1].split())


def fingerprint(entry, version):
    """A hash over everything that the outcome depends on."""
    digest = hashlib.sha256()
    for text in (version, (ROOT / ".clang-tidy").read_text(encoding="utf-8"), entry["command"]):
        digest.update(text.encode())
    for name in dependencies(entry):
        digest.update(Path(entry["directory"], name).read_bytes())
    return digest.hexdigest()


def passes(build, entry, version):
    """True without findings; prints them otherwise."""
    cache = build / "clang-tidy"
    cache.mkdir(exist_ok=True)
    try:
        stamp = cache / fingerprint(entry, version)
    except subprocess.CalledProcessError as error:
        print(f"{entry['file']}: does not compile\n{error.stderr}")
        return False
    if stamp.exists():
        return True
    result = subprocess.run([CLANG_TIDY, "-p", str(build), "--quiet", entry["file"]], text=True,
                            capture_output=True, check=False)
    if result.returncode != 0:
        print(result.stdout or result.stderr)
        return False
    stamp.touch()
    return True


def main(arguments):
    if len(arguments) < 2 or arguments[0] in ("-h", "--help"):
        print(__doc__)
        return 2
    build, folders = Path(arguments[0]).resolve(), arguments[1:]
    version = subprocess.run([CLANG_TIDY, "--version"], text=True, capture_output=True,
                             check=True).stdout
    entries = [entry for folder in folders for entry in entries_of(build, folder)]
    failed = [entry["file"] for entry in entries if not passes(build, entry, version)]
    print(f"check_tidy: {len(entries)} files, {len(failed)} with findings")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
