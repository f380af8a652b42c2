"""What the declarations of studies say (scripts/studies/FOLDER/study.json), and what is wrong with them."""

import fnmatch
import json
import re
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
FOLDERS = ROOT / "scripts/studies"
SHARED = ("study", "runner")  # folders that are no study
MEMBERS = {"what": str, "cells": list, "cpu_minutes": (int, float), "commands": list, "writes": list, "first": int}
OPTIONAL = ("first",)
CELL = {"scenario", "sweep", "set", "seed", "trials"}
FIRST = 20


class StudyError(Exception):
    """What is wrong, in words that say what would be right."""


@dataclass(frozen=True)
class Study:
    """One of the studies of a folder: they share scripts, and are made and go stale one by one."""
    name: str
    folder: str
    what: str            # one sentence
    cells: tuple         # of {"scenario" or "sweep": file, "set": [...], "seed", "trials"}: what it drives
    cpu_minutes: float
    commands: tuple      # shell lines with {rockyard}, {threads} and {runs}; none: made by hand
    writes: tuple        # files, or FILE#TABLE for what stands between the marks of a table
    first: int = FIRST   # trials of each cell that `stale` drives again

    def touched_by(self, patterns, noted=(), root=ROOT):
        """Whether a change of the scenarios that these patterns name may change what the study gives.

        noted: files that it was seen to drive. One that names no files may drive any.
        """
        files = [cell.get("scenario") or cell["sweep"] for cell in self.cells] + list(noted)
        if not files or "all" in patterns:
            return True
        return any(fnmatch.fnmatch(file, pattern) for pattern in patterns for file in reached(files, root))


def reached(files, root=ROOT):
    """The files of these names and globs, and all files of JSON that they name, and so on."""
    found, waiting = set(), [path for file in files for path in root.glob(file)]
    while waiting:
        path = waiting.pop().resolve()
        name = str(path.relative_to(root)) if path.is_relative_to(root) else str(path)
        if name not in found:
            found.add(name)
            named = re.findall(r'"([^"\n]+\.json)"', path.read_text(encoding="utf-8"))
            waiting += [path.parent / file for file in named if (path.parent / file).is_file()]
    return found


def file_of(item):
    return item.split("#")[0]


def carrier(item):
    """The page at whose head stands how old a written file is: itself, or the README or gallery of its folder.

    The front page has no such head: results/pathfinder.md, from which its table comes, says it.
    """
    file = Path(file_of(item))
    if str(file) == "README.md":
        return "results/pathfinder.md"
    if file.suffix == ".md":
        return str(file)
    return "docs/gallery.md" if str(file.parent) == "docs/pictures" else str(file.parent / "README.md")


def parse(folder, name, members):
    """A study; raises StudyError."""
    where = f"scripts/studies/{folder}/study.json: {name}"
    if not isinstance(members, dict):
        raise StudyError(f"{where} is no object")
    unknown = set(members) - set(MEMBERS)
    missing = set(MEMBERS) - set(members) - set(OPTIONAL)
    if unknown or missing:
        raise StudyError(f"{where}: unknown {sorted(unknown)}, missing {sorted(missing)}")
    for member, kind in MEMBERS.items():
        if member in members and not isinstance(members[member], kind):
            raise StudyError(f"{where}: {member} is of the wrong type")
    for cell in members["cells"]:
        if not isinstance(cell, dict) or set(cell) - CELL or len({"scenario", "sweep"} & set(cell)) != 1:
            raise StudyError(f"{where}: a cell has a scenario or a sweep, and of the rest {sorted(CELL)}")
    return Study(name, folder, **{key: tuple(value) if isinstance(value, list) else value
                                  for key, value in members.items()})


def read(root=ROOT):
    """All studies by name, and a list of faults of their declarations."""
    studies, faults = {}, []
    for folder in sorted(path for path in (root / "scripts/studies").iterdir() if path.is_dir()):
        file = folder / "study.json"
        if folder.name in SHARED or folder.name.startswith(("_", ".")):
            continue
        if not file.is_file():
            faults.append(f"scripts/studies/{folder.name} has no study.json")
            continue
        try:
            for name, members in json.loads(file.read_text(encoding="utf-8")).items():
                if name in studies:
                    raise StudyError(f"{name} is declared in {studies[name].folder} and in {folder.name}")
                studies[name] = parse(folder.name, name, members)
        except (StudyError, ValueError, AttributeError) as error:
            faults.append(f"scripts/studies/{folder.name}/study.json: {error}")
    return studies, faults


def chosen(studies, names):
    """Studies by their names, or all of a folder by its name."""
    found = []
    for name in names:
        own = [study for study in studies.values() if name in (study.name, study.folder)]
        exact = [study for study in own if study.name == name and study.folder != name]
        if not own:
            raise StudyError(f"{name}: is no study; there are {', '.join(studies)}")
        found += [study for study in exact or own if study not in found]
    return found


def has_table(text, table):
    return re.search(rf"<!-- begin {re.escape(table)} -->\n.*?\n<!-- end {re.escape(table)} -->", text, re.S)


def faults_of(studies, root=ROOT):
    """What declarations name that is not there, and what more than one study writes."""
    faults, writers = [], {}
    for study in studies.values():
        for cell in study.cells:
            file = cell.get("scenario") or cell["sweep"]
            if not list(root.glob(file)):
                faults.append(f"{study.name}: there is no {file}")
        for command in study.commands:
            for script in re.findall(r"(?:^|\s)(scripts/\S+)", command):
                if not (root / script).is_file():
                    faults.append(f"{study.name}: there is no {script}")
        for item in study.writes:
            faults += [f"{item}: both {writers[item]} and {study.name} write it"] if item in writers else []
            writers.setdefault(item, study.name)
            faults += missing(study, item, root)
    whole = {item for item in writers if "#" not in item}
    for item in writers:
        if "#" in item and file_of(item) in whole and writers[file_of(item)] != writers[item]:
            faults.append(f"{item}: {writers[item]} writes a table of a file that is all of {writers[file_of(item)]}")
    return faults


def missing(study, item, root):
    """What is not there of a file or table that a study writes."""
    file = root / file_of(item)
    if not file.is_file():
        return [f"{study.name}: {file_of(item)} is not there"]
    if not (root / carrier(item)).is_file():
        return [f"{study.name}: {carrier(item)} is not there, which says how old {item} is"]
    if "#" in item and not has_table(file.read_text(encoding="utf-8"), item.split("#")[1]):
        return [f"{study.name}: {file_of(item)} has no table {item.split('#')[1]}"]
    return []
