"""Records of a run as one NumPy array, kept beside the store so that they open at once.

The file records.npy of a run's folder (records-<cell>.npy of a campaign) is a structured array: trial,
outcome (place in rockyard.OUTCOMES), and a float64 a column. It is made anew where the store is not
the one that it was made of, and can be deleted at any time. A folder that cannot be written gets none.
"""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import tempfile
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from . import _core

OUTCOMES: tuple[str, ...] = _core.outcomes


def _known_by(*files: Path) -> str:
    """Returns what files are known by until somebody writes them again."""
    told = []
    for file in files:
        try:
            stat = file.stat()
            told.append((file.name, stat.st_size, stat.st_mtime_ns, stat.st_ino))
        except FileNotFoundError:
            pass
    return repr(told)


def _file(folder: Path, cell: str) -> Path:
    return folder / ("records.npy" if not cell else
                     f"records-{hashlib.sha256(cell.encode()).hexdigest()[:12]}.npy")


def _write(path: Path, store: Path, write: Any) -> None:
    """Writes a file whole or not at all; who may read the store may read it."""
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    try:
        with os.fdopen(handle, "wb") as file:
            write(file)
        shutil.copymode(store, name)
        os.replace(name, path)
    except BaseException:
        os.unlink(name)
        raise


def structured(trials: Any, outcomes: Any, values: Any, names: list[str]) -> "np.ndarray[Any, Any]":
    """Returns the arrays of the compiled part as one structured array."""
    dtype = np.dtype([("trial", "u8"), ("outcome", "i1"), *((name, "f8") for name in names)])
    records = np.empty(len(trials), dtype)
    records["trial"], records["outcome"] = trials, outcomes
    for place, name in enumerate(names):
        records[name] = values[:, place]
    return records


class Told(NamedTuple):
    """The records of a run, or of a cell of a campaign."""

    records: "np.ndarray[Any, Any]"
    hash: str
    sentences: list[str]  # all that is said of the ends of trials
    sentence: list[int]  # the place of each record's among them

    def detail(self, row: int) -> str:
        """Returns how the trial in a row ended, in words."""
        return self.sentences[self.sentence[row]]


def read(folder: Path, cell: str, columns: list[str]) -> Told:
    """Returns the records. Raises InputError: no run, a damaged store."""
    file, store = _file(folder, cell), folder / "results.sqlite"
    key = _known_by(store, folder / "results.sqlite-wal")
    side = file.with_suffix(".json")
    try:
        kept = json.loads(side.read_text(encoding="utf-8"))
        if kept["key"] == key and kept["file"] == _known_by(file):
            return Told(np.load(file, mmap_mode="r"), kept["hash"], kept["sentences"], kept["sentence"])
    except (OSError, ValueError, KeyError, TypeError):
        pass  # none, half of one, or something else by its name
    arrays, details, digest = _core.read_records(str(folder), cell)
    sentences = sorted(set(details))
    place_of = {detail: place for place, detail in enumerate(sentences)}
    told = Told(structured(*arrays, columns), digest, sentences, [place_of[detail] for detail in details])
    told.records.flags.writeable = False  # as those of the file
    try:
        side.unlink(missing_ok=True)  # until both are whole, there is none
        _write(file, store, lambda out: np.save(out, told.records))
        text = json.dumps({"key": key, "file": _known_by(file), "hash": digest, "sentences": sentences, "sentence": told.sentence}).encode()
        _write(side, store, lambda out: out.write(text))
    except OSError:
        pass  # no right to write, a full disk: it is read from the store the next time
    return told
