#!/usr/bin/env python3
"""Runs clang-tidy on the .cc files of folders of src/, or on what changed, on every processor.

Usage: scripts/check_tidy.py BUILD_DIR [FOLDER]...          all files, or those of these folders of src/
       scripts/check_tidy.py BUILD_DIR --changed [BASE]     files that differ from the commit BASE

BUILD_DIR holds compile_commands.json. BASE is the commit at which all files passed last, as
tests/long/README.md says (entry tidy); else where the branch left its upstream or main, and where it
has not left, the commit before this one. What is not committed counts as changed.

Folders: files that are compiled in one batch (ROCKYARD_UNITY_BATCH) are checked in one run, as
their texts one after the other in one file, which takes the time of one or two of them by
itself. Findings are told by the place in the real file. A batch that includes its files would be as
fast, but some checks (misc-unused-alias-decls, unused constants) judge only the main file. Nothing
is known to be lost against a run for each file: a planted violation of every check that found one was
found both ways (tests/scripts/check_tidy_test.py plants some). What a batch cannot see is a file that
does not compile by itself, and, as with any error of the compiler, a file with an error keeps
warnings of unused functions in its batch back until it is mended.

Changed: the changed files of each batch; a changed header by the source of its name, or by one that
includes it.

A batch or file passes again without running if nothing that it is made of changed: its text, the
headers of this project that it includes, the options of the compiler, .clang-tidy and the version of
clang-tidy.
Exit code 0: no finding; 1: findings, printed; 2: wrong use.
"""

import functools
import hashlib
import json
import os
import re
import shlex
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
CLANG_TIDY = "clang-tidy"
ONE_INSTRUCTION_SET = "-DHWY_COMPILE_ONLY_STATIC"  # of Highway; the time of a file is less than half

LEDGER_ROW = re.compile(r"^\| tidy \|.*\| passed, [\d-]+, commit (\w+), [^|]*\|$", re.M)
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.M)
# Between two files of a batch: readability-duplicate-include forgets what was included before a
# macro, and would take a header that both include for included twice.
BOUNDARY = "#define ROCKYARD_NEXT_FILE\n#undef ROCKYARD_NEXT_FILE\n"


class UseError(Exception):
    """The arguments ask for what is not there."""


@dataclass
class Batch:
    """Files that are checked in one run."""

    name: str
    place: Path     # where the compiler runs
    options: list   # of the compiler
    files: list


def options_of(entry):
    """The compiler's options, without programs, input and output."""
    words = list(entry["arguments"]) if "arguments" in entry else shlex.split(entry["command"])
    del words[:2 if Path(words[0]).name == "ccache" else 1]
    options, skip = [], False
    for word in words:
        if skip:
            skip = False
        elif word in ("-o", "-c", "-MT", "-MF"):
            skip = True
        elif word not in ("-MD", entry["file"]) and not word.startswith("--param="):  # of GCC alone
            options.append(word)
    return options


def read_batches(build):
    """Every batch of files below src/, in the order of compile_commands.json."""
    database = build / "compile_commands.json"
    if not database.is_file():
        raise UseError(f"{database} is not there: configure the build first")
    batches = []
    for entry in json.loads(database.read_text(encoding="utf-8")):
        file = Path(entry["directory"], entry["file"]).resolve()
        files, name = [file], file.stem
        if file.parent.name == "Unity":
            texts = INCLUDE.findall(file.read_text(encoding="utf-8"))
            files = [Path(entry["directory"], text).resolve() for text in texts]
            name = f"{file.parent.parent.stem}_{file.stem}"
        files = [path for path in files if path.is_relative_to(ROOT / "src")]
        if files:
            batches.append(Batch(name, Path(entry["directory"]), options_of(entry), files))
    if not batches:
        raise UseError(f"{database} compiles nothing of {ROOT / 'src'}")
    return batches


@functools.lru_cache(maxsize=None)
def read(path):
    return path.read_text(encoding="utf-8")


def dependencies(batch):
    """The files of the batch and the headers that they include, system headers left out."""
    roots = [batch.place / word[2:] for word in batch.options if word.startswith("-I")]
    found, todo = set(), list(batch.files)
    while todo:
        path = todo.pop()
        if path not in found:
            found.add(path)
            for target in INCLUDE.findall(read(path)):
                places = (root / target for root in [path.parent, *roots])
                todo += [place.resolve() for place in places if place.is_file()][:1]
    return sorted(found)


def fingerprint(batch, version):
    """A hash over everything that the outcome depends on."""
    digest = hashlib.sha256()
    for text in (version, read(ROOT / ".clang-tidy"), ONE_INSTRUCTION_SET, *batch.options,
                 *map(str, batch.files)):
        digest.update(text.encode() + b"\0")
    for path in dependencies(batch):
        digest.update(read(path).encode() + b"\0")
    return digest.hexdigest()


def join(files):
    """(text, starts): the files one after the other, and the line that each begins after."""
    text, starts = "", []
    for path in files:
        starts.append(text.count("\n"))
        text += read(path).rstrip("\n") + "\n" + BOUNDARY
    return text, starts


def real_places(output, joined, files, starts):
    """Output of clang-tidy with lines of the joined file told as those of the real ones."""
    def place(match):
        line = int(match.group(1))
        number = max(n for n, start in enumerate(starts) if start < line)
        return f"{files[number]}:{line - starts[number]}"
    return re.sub(re.escape(str(joined)) + r":(\d+)", place, output)


def passes(build, batch, version):
    """True without findings; prints them otherwise."""
    cache = build / "clang-tidy"
    cache.mkdir(exist_ok=True)
    stamp = cache / fingerprint(batch, version)
    if stamp.exists():
        return True
    text, starts = join(batch.files)
    file = batch.files[0]
    if len(batch.files) > 1:
        file = cache / f"{batch.name}.cc"
        file.write_text(text, encoding="utf-8")
    result = subprocess.run([CLANG_TIDY, "--quiet", f"--config-file={ROOT / '.clang-tidy'}", str(file),
                             "--", *batch.options, ONE_INSTRUCTION_SET], cwd=batch.place, text=True,
                            capture_output=True, check=False)
    if result.returncode != 0:
        output = result.stdout or result.stderr
        print(output if file == batch.files[0] else real_places(output, file, batch.files, starts))
        return False
    stamp.touch()
    return True


def git(*arguments):
    """The lines that git prints, or None where it fails."""
    result = subprocess.run(["git", "-C", str(ROOT), *arguments], text=True, capture_output=True,
                            check=False)
    return result.stdout.splitlines() if result.returncode == 0 else None


def last_whole_pass():
    """The commit at which all files passed last, if this history has it."""
    ledger = ROOT / "tests" / "long" / "README.md"
    row = LEDGER_ROW.search(read(ledger)) if ledger.is_file() else None
    return row[1] if row and git("merge-base", "--is-ancestor", row[1], "HEAD") is not None else None


def default_base():
    """The last pass over all files; else where this branch left its upstream or main, or the last commit but one."""
    whole = last_whole_pass()
    if whole:
        return whole
    head = git("rev-parse", "HEAD")
    for branch in ("@{upstream}", "origin/main", "main"):
        base = git("merge-base", "HEAD", branch)
        if base and base != head:
            return base[0]
    return "HEAD~1"


def changed_files(base):
    """The C++ files of src/ that differ from the commit, and those that git does not know yet."""
    known = git("diff", "--name-only", "--diff-filter=d", base, "--", "src")
    if known is None:
        raise UseError(f"git knows no commit '{base}'")
    unknown = git("ls-files", "--others", "--exclude-standard", "--", "src")
    return [ROOT / name for name in sorted({*known, *unknown}) if name.endswith((".h", ".cc"))]


def batches_of_changes(batches, base):
    """Of each batch what changed: its files, and sources that show a changed header."""
    by_file = {path: batch for batch in batches for path in batch.files}
    wanted = []
    for path in changed_files(base):
        source = path.with_suffix(".cc")
        if path.suffix == ".h" and source not in by_file:
            target = path.relative_to(ROOT / "src").as_posix()
            source = next((file for file in sorted(by_file) if target in INCLUDE.findall(read(file))),
                          path)
        if source not in by_file:
            print(f"{path}: not compiled in this build, so not checked")
        elif source not in wanted:
            wanted.append(source)
    parts = [(batch, [path for path in batch.files if path in wanted]) for batch in batches]
    return [Batch(f"{batch.name}_changed", batch.place, batch.options, files) for batch, files in parts if files]


def batches_of_folders(batches, folders):
    """The batches of src/FOLDER for each folder, all without one; a folder without any batch is an error."""
    if not folders:
        return batches
    chosen = []
    for folder in folders:
        place = (ROOT / "src" / folder).resolve()
        found = [batch for batch in batches if batch.files[0].is_relative_to(place)]
        if not found:
            raise UseError(f"the build compiles nothing of src/{folder}")
        chosen += found
    return chosen


def main(arguments):
    changed = arguments[1:2] == ["--changed"]
    asked = arguments[:1] in (["-h"], ["--help"])
    if not arguments or asked or (changed and len(arguments) > 3):
        print(__doc__)
        return 0 if asked else 2
    build = Path(arguments[0]).resolve()
    try:
        batches = read_batches(build)
        if changed:
            batches = batches_of_changes(batches, arguments[2] if arguments[2:] else default_base())
        else:
            batches = batches_of_folders(batches, arguments[1:])
    except UseError as error:
        print(f"check_tidy: {error}", file=sys.stderr)
        return 2
    version = subprocess.run([CLANG_TIDY, "--version"], text=True, capture_output=True,
                             check=True).stdout
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        good = list(pool.map(lambda batch: passes(build, batch, version), batches))
    failed = [batch for batch, passed in zip(batches, good) if not passed]
    count = sum(len(batch.files) for batch in batches)
    print(f"check_tidy: {count} files in {len(batches)} runs, {len(failed)} runs with findings")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
