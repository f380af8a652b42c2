"""Where tests of studies find them. All: `python3 -m unittest discover -s tests/scripts/studies -p "*_test.py"`."""

import contextlib
import sqlite3
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
sys.path[:0] = [str(ROOT / "scripts/studies"), str(ROOT / "scripts"), str(ROOT / "tests/scripts")]


def write_store(folder, cell, columns, trials):
    """Of a campaign with one cell (number, name); trials are (number, outcome, values of the columns)."""
    names = ", ".join(f'"{name}"' for name in columns)
    marks = ", ".join("?" * (3 + len(columns)))
    with contextlib.closing(sqlite3.connect(Path(folder) / "results.sqlite")) as store:
        store.execute("create table cells (cell, name)")
        store.execute("insert into cells values (?, ?)", cell)
        store.execute(f"create table trials (campaign_cell, trial, outcome, {names})")
        store.executemany(f"insert into trials values ({marks})", [
            [cell[0], trial, outcome, *values] for trial, outcome, values in trials])
        store.commit()
