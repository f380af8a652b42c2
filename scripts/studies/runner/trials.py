"""The first trials of a study: which they are, told by the commands that it gave, and what they give."""

import json
import os
import sqlite3
import subprocess
import tempfile
from concurrent.futures import ThreadPoolExecutor, as_completed
from contextlib import closing
from pathlib import Path

from .declarations import ROOT, StudyError

WRAPPER = """#!/bin/sh
# Notes how rockyard was called, one line a call.
printf '%s\\037' "$PWD" "$@" >> '{log}'
printf '\\n' >> '{log}'
exec '{rockyard}' "$@"
"""
CAMPAIGNS = ("run", "sweep")
DRIVES = (*CAMPAIGNS, "replay", "trace", "render", "terrain")
VALUES = ("--trials", "--seed", "--set", "--trial", "--out", "--threads")
STORE = "results.sqlite"


def wrapped(rockyard, runs):
    """A program in the folder of the runs that is rockyard and notes its calls; they outlive an interruption."""
    path = runs / "rockyard"
    path.write_text(WRAPPER.format(log=runs / "calls", rockyard=rockyard), encoding="utf-8")
    path.chmod(0o755)
    return path


def parsed(words, root=ROOT):
    """The file that a call drives, a scenario's name being one too, and the options that decide what is driven.

    None where it drives no scenario; raises StudyError for a campaign of one that cannot be told.
    """
    options, named, left = {"--set": []}, [], list(words[1:])
    while left:
        word, equals, value = left.pop(0).partition("=")
        if not word.startswith("-"):
            named.append(word + equals + value)
            continue
        if word in VALUES and not equals and left:
            value = left.pop(0)
        if word == "--set":
            options["--set"].append(value)
        elif word in VALUES:
            options[word] = value
    files = [word for word in named if word.endswith(".json")]
    files += [str(file) for word in named if "*" not in word for file in root.glob(f"scenarios/**/{word}.json")]
    if words[0] in CAMPAIGNS and len(files) != 1:
        raise StudyError(f"rockyard {' '.join(words)}: names {len(files)} scenarios that can be driven again, not one; "
                         "the study should name its file")
    return (files[0], options) if files else None


def cells_of(runs, first, root=ROOT):
    """The cells whose trials the calls of a study drove, each once: what to do to drive its first ones."""
    cells = {}
    for call in (runs / "calls").read_text(encoding="utf-8").splitlines() if (runs / "calls").is_file() else []:
        folder, *words = call.split("\037")[:-1]
        # A plugin is of the runs, and does not last.
        found = parsed(words, root) if words and words[0] in DRIVES and "--plugin" not in words else None
        if not found:
            continue
        path, options = (Path(folder) / found[0]).resolve(), found[1]
        if words[0] not in CAMPAIGNS and not path.is_relative_to(root):
            continue  # a copy for a picture of what a run drove
        cell = {"kind": "sweep" if words[0] == "sweep" else "run", "set": options["--set"],
                "seed": options.get("--seed"), "trials": min(first, int(options.get("--trials", first)))}
        if path.is_relative_to(runs.resolve()) or not path.is_relative_to(root):
            cell["composed"] = path.read_text(encoding="utf-8").replace(str(root), "{root}")
        else:
            cell["file"] = str(path.relative_to(root))
        key = json.dumps([cell[part] for part in ("kind", "set", "seed")] + [cell.get("file"), cell.get("composed")])
        if key not in cells or cells[key]["trials"] < cell["trials"]:
            cells[key] = cell
    return list(cells.values())


def fingerprint_of(out, summary):
    """Of a run its scenario's; of a sweep those of its cells together."""
    if "fingerprint" in summary:
        return summary["fingerprint"]
    with closing(sqlite3.connect(f"file:{out / STORE}?mode=ro", uri=True)) as store:
        return " ".join(row[0] for row in store.execute("select fingerprint from cells order by cell"))


def drive(rockyard, cell, root=ROOT, processes=None):
    """Fingerprint and hash of the first trials of a cell by this program."""
    with tempfile.TemporaryDirectory(prefix="rockyard-first-") as name:
        out, file = Path(name) / "out", root / cell.get("file", "")
        if "composed" in cell:
            file = Path(name) / "composed.json"
            file.write_text(cell["composed"].replace("{root}", str(root)), encoding="utf-8")
        command = [rockyard, cell["kind"], file, "--trials", cell["trials"], "--threads", 1, "--out", out, "--json",
                   "--max-faults", 1]
        command += ["--seed", cell["seed"]] if cell["seed"] is not None else []
        command += [word for setting in cell["set"] for word in ("--set", setting)]
        with subprocess.Popen([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              text=True, start_new_session=True) as process:
            if processes is not None:
                processes.append(process)
            said, errors = process.communicate()
        if process.returncode != 0:
            raise StudyError(f"{' '.join(map(str, command))}\nexit code {process.returncode}: {errors.strip()[-400:]}")
        summary = json.loads(said)
        return {"fingerprint": fingerprint_of(out, summary), "trial_hash": summary["trial_hash"]}


def drive_all(rockyard, cells, jobs, told, root=ROOT):
    """What the cells give, in their order, or {"error": why not}; equal ones are driven once.

    told(done, all) after each.
    """
    keys = [json.dumps({part: value for part, value in cell.items() if part not in ("fingerprint", "trial_hash")},
                       sort_keys=True) for cell in cells]
    wanted, found, processes = dict(zip(keys, cells)), {}, []
    pool = ThreadPoolExecutor(jobs)
    try:
        waiting = {pool.submit(drive, rockyard, cell, root, processes): key for key, cell in wanted.items()}
        for future in as_completed(waiting):
            try:
                found[waiting[future]] = future.result()
            except StudyError as error:
                found[waiting[future]] = {"error": str(error)}
            told(len(found), len(wanted))
    except BaseException:
        pool.shutdown(wait=False, cancel_futures=True)
        for process in processes:
            if process.poll() is None:
                os.killpg(process.pid, 15)
        raise
    pool.shutdown()
    return [found[key] for key in keys]
