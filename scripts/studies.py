#!/usr/bin/env python3
"""Makes what studies write, and says what of it is out of date.

    scripts/studies.py list               what each shows, costs and writes, and of which build that is
    scripts/studies.py run NAME...        runs studies, or all of a folder, and stamps what they write
    scripts/studies.py stale [NAME...]    drives the first trials again and names what would come out otherwise
    scripts/studies.py check              the cheap form: declarations, stamps, and what pages say at their heads

A page says at its head which build it is of, and that it is stale where the program of today may give other numbers:
without a stamp (results/stamps), or with one that is older than a change of results which touches its scenarios
(CHANGELOG.md), or where `stale --mark` found other trials. `check --mark` writes the heads that are due.
An interrupted study goes on where it was; its pages are the old ones until it is done.

Exit code: 0 done; 1 `stale`, `check`: something is not as its page says; 2 wrong use or a study that failed.
"""

import argparse
import fcntl
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path[0] = str(ROOT / "scripts/studies")
from runner import declarations, heads, stamps, trials  # noqa: E402
from runner.declarations import StudyError, carrier, file_of  # noqa: E402

RUNS = ROOT / "results/runs/studies"
# What a program is made of.
SOURCES = ("src", "terrain", "CMakeLists.txt", "CMakePresets.json", "scripts/cmake")


def git(*words):
    result = subprocess.run(["git", *words], cwd=ROOT, text=True, capture_output=True, check=False)
    if result.returncode != 0:
        raise StudyError(f"git {' '.join(words)}: {result.stderr.strip()}")
    return result.stdout


def written_by(studies):
    """Files that studies and their stamps may change."""
    return {path for study in studies for item in study.writes for path in (file_of(item), carrier(item))}


def require_clean(studies):
    """Refuses a tree whose tracked files differ from its commit, but for what the studies write."""
    own = written_by(studies)
    changed = [line[3:].split(" -> ")[-1] for line in git("status", "--porcelain", "--untracked-files=no").splitlines()]
    dirty = [file for file in changed if file not in own and not file.startswith(f"{stamps.STAMPS}/")]
    if dirty:
        raise StudyError(f"the tree is dirty, so that no commit would tell what was run: {', '.join(dirty[:5])}"
                         f"{' and more' if len(dirty) > 5 else ''}; commit or set aside first")


def own_words(rockyard):
    """What the program says of its version."""
    if not rockyard.is_file():
        raise StudyError(f"{rockyard}: there is no such program; build it (cmake --build --preset release) "
                         "or name one with --rockyard")
    return subprocess.run([rockyard, "--version"], text=True, capture_output=True, check=False).stdout.strip()


def version_of(rockyard):
    """Version and commit of the program; refuses one that is not of the sources of HEAD."""
    said = own_words(rockyard)
    found = re.match(r"rockyard (\S+) \(commit ([0-9a-f]+)(-dirty)?", said)
    if not found:
        raise StudyError(f"{rockyard} --version names no commit: {said[:80]}")
    if found[3]:
        raise StudyError(f"{rockyard} was built from a dirty tree ({found[2]}-dirty); build it from a commit")
    if git("diff", "--name-only", found[2], "HEAD", "--", *SOURCES).strip():
        raise StudyError(f"{rockyard} is of {found[2]}, whose sources differ from those of HEAD; build it anew")
    return found[1], found[2]


def list_studies(options):
    studies, _ = declarations.read(ROOT)
    known = stamps.read(ROOT)
    total = 0.0
    for study in studies.values():
        total += study.cpu_minutes
        state = "stale" if stamps.is_stale(study, known, ROOT) else "current"
        made = heads.build_of(study, study.writes, known, ROOT)
        print(f"{study.name}  ({study.folder}, {study.cpu_minutes:g} CPU-minutes, {state}, {made})\n    {study.what}")
        for item in study.writes if options.files else ():
            print(f"    writes {item}")
    print(f"{len(studies)} studies, {total / 60:.0f} CPU-hours; what they write: --files")
    return 0


class Kept:
    """What the study is going to write, put back where it does not end well; the rest of a page stays."""

    def __init__(self, study):
        paths = [ROOT / item for item in study.writes if "#" not in item]
        self.files = {path: path.read_bytes() if path.is_file() else None for path in paths}
        self.tables = {}
        for item in study.writes:
            if "#" in item:
                path, name = ROOT / file_of(item), item.split("#")[1]
                self.tables[path, name] = declarations.has_table(path.read_text(encoding="utf-8"), name)[0]

    def put_back(self):
        for path, content in self.files.items():
            if content is None:
                path.unlink(missing_ok=True)
                continue
            part = path.with_name(path.name + ".part")
            part.write_bytes(content)
            part.replace(path)
        for (path, name), table in self.tables.items():
            text = path.read_text(encoding="utf-8")
            now = declarations.has_table(text, name)
            if now:
                stamps.write_whole(path, text[:now.start()] + table + text[now.end():])


def give(line):
    """Gives a shell line; its exit code. What ends this ends all that the line has started, before it goes on."""
    with subprocess.Popen(line, shell=True, cwd=ROOT, stdout=sys.stderr, start_new_session=True) as process:
        try:
            return process.wait()
        except BaseException:
            os.killpg(process.pid, signal.SIGINT)
            process.wait()
            raise


def lock():
    """Held until the program ends: two that make studies would put back each other's pages."""
    RUNS.mkdir(parents=True, exist_ok=True)
    file = open(RUNS / "lock", "w", encoding="utf-8")
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        raise StudyError("studies are being made already in this tree; wait for their end") from None
    return file


def make(study, rockyard, threads, commit):
    """Gives the study's commands; returns its cells with what their first trials give."""
    runs = RUNS / f"{study.name}-{commit[:12]}"
    runs.mkdir(parents=True, exist_ok=True)
    noting = trials.wrapped(rockyard, runs)
    for command in study.commands:
        line = command.format(rockyard=noting, threads=threads, runs=runs)
        print(f"== {study.name}: {line}", file=sys.stderr, flush=True)
        code = give(line)
        if code != 0:
            raise StudyError(f"{study.name}: exit code {code} of {line}\n"
                             "what it writes is as it was; the same command goes on")
    cells = trials.cells_of(runs, study.first, ROOT)
    first = trials.drive_all(rockyard, cells, threads, progress(study.name), ROOT)
    for found in first:
        if "error" in found:
            raise StudyError(f"{study.name}: {found['error']}")
    return [cell | found for cell, found in zip(cells, first)]


def progress(name):
    start = time.monotonic()

    def told(done, all_of_them):
        end = "\n" if done == all_of_them else ""
        print(f"\r{name}: first trials of {done} of {all_of_them} cells, {time.monotonic() - start:.0f} s", end=end,
              file=sys.stderr, flush=True)
    return told


def run(options):
    studies, faults = declarations.read(ROOT)
    if faults:
        raise StudyError("\n".join(faults))
    wanted = declarations.chosen(studies, options.names)
    by_hand = [study.name for study in wanted if not study.commands]
    if by_hand:
        raise StudyError(f"no script makes {', '.join(by_hand)}")
    require_clean(wanted)
    faults = declarations.faults_of({study.name: study for study in wanted}, ROOT)
    if faults:
        raise StudyError("\n".join(faults))
    rockyard = options.rockyard.resolve()
    version, commit = version_of(rockyard)
    # Studies take the package of the same build, which they are not told by the program that notes its calls.
    os.environ["PYTHONPATH"] = os.pathsep.join([str(rockyard.parents[1] / "python"), *filter(None, [os.environ.get("PYTHONPATH")])])
    held = lock()
    for study in wanted:
        kept = Kept(study)
        try:
            cells = make(study, rockyard, options.threads, commit)
        except BaseException:
            kept.put_back()
            raise
        stamps.write({"study": study.name, "version": version, "commit": commit,
                      "changes": " ".join(stamps.entries(ROOT)),
                      "written": {item: heads.content_hash(item, ROOT) for item in study.writes},
                      "cells": cells}, ROOT)
        heads.write(studies, stamps.read(ROOT), ROOT, {carrier(item) for item in study.writes})
        print(f"{study.name}: made; {', '.join(study.writes)}")
    held.close()
    return 0


def differences(stamp, found):
    """What of the cells comes out otherwise: words, one a cell."""
    told = []
    for cell, now in zip(stamp["cells"], found):
        name = " ".join([cell.get("file", "a composed scenario"), *cell["set"]])
        if "error" in now:
            told.append(f"{name}: cannot be driven: {now['error'].splitlines()[-1]}")
        elif now["trial_hash"] != cell["trial_hash"]:
            told.append(f"{name}: other trials")
        elif now["fingerprint"] != cell["fingerprint"]:
            told.append(f"{name}: another scenario")
    return told


def stale(options):
    studies, faults = declarations.read(ROOT)
    if faults:
        raise StudyError("\n".join(faults))
    known = stamps.read(ROOT)
    wanted = declarations.chosen(studies, options.names) if options.names else list(studies.values())
    stamped = [study for study in wanted if study.name in known]
    cells = [cell for study in stamped for cell in known[study.name]["cells"]]
    rockyard = options.rockyard.resolve()
    if options.mark:
        version_of(rockyard)
    print(f"driven by {own_words(rockyard)}")
    found = trials.drive_all(rockyard, cells, options.jobs, progress("stale"), ROOT)
    wrong = []
    for study in wanted:
        reasons = ["no stamp"]
        if study in stamped:
            own, found = found[:len(known[study.name]["cells"])], found[len(known[study.name]["cells"]):]
            reasons = differences(known[study.name], own)
            if options.mark and bool(reasons) != known[study.name].get("differs", False):
                known[study.name]["differs"] = bool(reasons)
                stamps.write(known[study.name], ROOT)
        says = stamps.is_stale(study, known, ROOT)
        if reasons:
            print(f"{study.name}: {reasons[0]}{f' and {len(reasons) - 1} more' if len(reasons) > 1 else ''}; "
                  f"stale: {', '.join(study.writes) or 'nothing that is kept'}")
        elif says:
            print(f"{study.name}: its first trials are as they were, and a change of results touches it")
        if bool(reasons) and not says:
            wrong.append(f"{study.name} is stale, and its pages do not say so (--mark makes them)")
        elif study in stamped and not reasons and known[study.name].get("differs", False):
            wrong.append(f"{study.name} is marked as giving other trials, and does not (--mark takes it away)")
    if options.mark:
        heads.write(studies, known, ROOT)
    wrong += heads.edited(studies, known, ROOT) + heads.faults(studies, known, ROOT)
    print("\n".join(wrong) or f"{len(wanted)} studies: pages say what is true of them")
    return 1 if wrong else 0


def check(options):
    studies, faults = declarations.read(ROOT)
    faults += declarations.faults_of(studies, ROOT)
    known = stamps.read(ROOT)
    faults += [f"{stamps.STAMPS}/{name}.json is of no study" for name in known if name not in studies]
    if options.mark and not faults:
        for page in heads.write(studies, known, ROOT):
            print(f"{page}: head written")
    faults += heads.edited(studies, known, ROOT) + heads.faults(studies, known, ROOT) if not faults else []
    print("\n".join(faults) or f"{len(studies)} studies, {len(known)} with a stamp; pages say what is known of them")
    return 1 if faults else 0


def parser():
    result = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = result.add_subparsers(required=True, metavar="COMMAND")
    program = {"type": Path, "default": ROOT / "build/release/bin/rockyard",
               "help": "the program (default: build/release/bin/rockyard)"}
    one = commands.add_parser("list", help="what there is")
    one.add_argument("--files", action="store_true", help="also what each writes")
    one.set_defaults(call=list_studies)
    one = commands.add_parser("run", help="makes what studies write")
    one.add_argument("names", nargs="+", metavar="NAME")
    one.add_argument("--rockyard", **program)
    one.add_argument("--threads", type=int, default=1)
    one.set_defaults(call=run)
    one = commands.add_parser("stale", help="drives the first trials of stamped studies again")
    one.add_argument("names", nargs="*", metavar="NAME")
    one.add_argument("--rockyard", **program)
    one.add_argument("--jobs", type=int, default=2, help="cells at a time (2)")
    one.add_argument("--mark", action="store_true", help="note what differs in stamps and heads")
    one.set_defaults(call=stale)
    one = commands.add_parser("check", help="what can be told without driving")
    one.add_argument("--mark", action="store_true", help="write the heads that are due")
    one.set_defaults(call=check)
    return result


def main():
    options = parser().parse_args()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))  # as an exception, so that pages are put back
    try:
        return options.call(options)
    except (StudyError, OSError) as error:
        print(f"studies: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("\nstudies: interrupted; nothing that was written is in halves", file=sys.stderr)
        return 130


if __name__ == "__main__":
    sys.exit(main())
