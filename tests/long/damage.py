#!/usr/bin/env python3
"""Damaged result stores: is each one refused, or does it give the right result?

Makes stores of several experiments, damages copies of them in many ways, and puts each copy through the
commands that read stores. Right is an error that names the file, with exit code 2 and nothing on standard
output, or exactly what the whole store gives: the same exit code, text and files, bit for bit. Anything
else is a fault of the program: another result, a crash, a hang, an error without the file or in the words
of a library. Faulty copies are kept in the folder of the study.

Prints a table of damages and a table of commands. Exit code: 0, or 1 with any fault.

    tests/long/damage.py [--stores 500] [--seed 1] [--jobs 1] [--rockyard PROGRAM] [--out FOLDER]
"""

import argparse
import math
import random
import re
import shutil
import sqlite3
import subprocess
import sys
import tempfile
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

from progress import Progress

sys.path.append(str(Path(__file__).resolve().parents[2] / "scripts/studies"))
import study  # noqa: E402

STORE = "results.sqlite"
NAMED = re.compile(r"results\.sqlite|(error:|with|in) run[:\s/]")  # the store, or its folder
PAGE = 4096       # bytes, SQLite's default
SECTOR = 512      # bytes
HANG_S = 600      # a command on these stores takes a fraction of a second
BAD_INPUT = 2     # src/campaign/work.h
# What no message of rockyard's own says: exceptions and contracts as libraries word them.
RAW = re.compile(r"std::|bad_alloc|basic_string|vector::|map::at|stoi|_M_|terminate|what\(\)|Assertion|"
                 r"violated|bad_variant")
SAME, REFUSED = "same", "refused"
FAULTS = ("other result", "crash", "hang", "file not named", "raw message", "exit code", "half a result")


@dataclass
class Answer:
    """What a command said and wrote."""
    code: int
    out: str = ""
    err: str = ""
    files: dict = field(default_factory=dict)  # name: bytes


@dataclass
class Base:
    """A whole store with what belongs to it."""
    name: str
    folder: Path
    commands: dict  # name: words, in which the store is the folder `run`
    foreign: list   # other stores, whose pages and rows get into copies
    answers: dict = field(default_factory=dict)


def judge(right, found):
    """SAME, REFUSED or one of FAULTS."""
    if found.code is None:
        return "hang"
    if found.code < 0 or found.code > 127:
        return "crash"
    if RAW.search(found.err):
        return "raw message"
    if (found.code, found.out, found.files) == (right.code, right.out, right.files):
        return SAME
    if found.code in (0, 1, 4):
        return "other result"
    if found.code != BAD_INPUT:
        return "exit code"
    if not NAMED.search(found.err):
        return "file not named"
    return "half a result" if found.out or found.files else REFUSED


# ---- Whole stores

def make(rockyard, folder, name, command, *settings):
    study.run([rockyard, *command, "--out", folder / name, "--quiet", *settings])
    return folder / name


def make_bases(rockyard, folder):
    """Tiny stores of drives, of a sweep, under a stopping rule, of a sensor and of a shard."""
    scenarios = study.ROOT / "scenarios"
    drive = ["--set", "rover.fidelity=quasi_static", "--set", "referee.time_limit_s=60"]
    nominal = ["run", scenarios / "pathfinder/nominal.json", *drive]
    gestalt = ["run", scenarios / "gestalt/abundance.json", *drive, "--trials", 6]
    sensor = ["run", scenarios / "hazard_detection/detection.json", "--trials", 4]
    rule = ["--until-half-width", 0.3, "--block", 4, "--max-trials", 12]
    sweep = folder / "sweep.json"
    sweep.write_text("""{"name": "two", "trials": 5, "seed": 3, "axes": [{"name": "k", "levels": [
        {"name": "few", "scenario": "%s"}, {"name": "many", "scenario": "%s"}]}]}""" % tuple(
            scenarios / f"pathfinder/{name}.json" for name in ("nominal", "obstacles_0.85")),
                     encoding="utf-8")
    cells = ["sweep", sweep, *drive]

    def of(name, command, others, extra=None):
        whole = make(rockyard, folder, name, command)
        foreign = [make(rockyard, folder, f"{name}-{i}", other) for i, other in enumerate(others)]
        resume = [*command, "--out", "run", "--resume", "--quiet"]
        return Base(name, whole, {"resume": resume, **(extra or {})}, foreign)

    report = ["report", "run", "--data", "data.json", "--replays", 0]
    reads = {"report": report, "trace": ["trace", "run", "--trial", 1, "--csv", "trace.csv"],
             "replay": ["replay", "run", "--trial", 1, "--svg", "plan.svg", "--data", "replay.json",
                        "--out", "replay.html"]}
    baseline = folder / "baseline.json"
    check = ["check", "run", "--against", baseline, "--csv", "check.csv"]
    drives = of("drives", [*nominal, "--trials", 12],
                [[*nominal, "--trials", 12, "--seed", 2], [*nominal, "--trials", 7], gestalt])
    study.run([rockyard, "baseline", drives.foreign[0], "--reason", "study of damage", "--out", baseline])
    compare = ["compare", "run", drives.foreign[0], "--csv", "compare.csv"]
    drives.commands.update(**reads, check=check, compare=compare)
    shards = [[*nominal, "--trials", 12, "--shard", f"{i}/2"] for i in (1, 2)]
    shard = of("shard", shards[0], [shards[1], [*shards[0], "--seed", 2]])
    shard.commands["merge"] = ["merge", "run", shard.foreign[0], "--out", "merged", "--quiet"]
    shard.commands["partial merge"] = ["merge", "run", "--partial", "--out", "merged", "--quiet"]
    reference = study.ROOT / "results/reference/matthies1995_hazard_detection.json"
    return [
        drives, shard,
        of("sweep", cells, [[*cells, "--seed", 9]],
           {"report": report, "compare": ["compare", "run", "run", "--cell", 0, "--cell-b", 1],
            "trace": ["trace", "run", "--cell", 1, "--trial", 1]}),
        of("rule", [*nominal, *rule], [[*nominal, *rule, "--seed", 2]], reads),
        of("gestalt", gestalt, [[*gestalt, "--seed", 2]], reads),
        of("sensor", sensor, [[*sensor, "--seed", 2]],
           {"report": report, "compare": ["compare", "run", "run"],
            "check": ["check", "run", "--against", reference, "--replicates", 100]}),
    ]


# ---- Damages: each changes the file `store` by `rng`, and says what it did

class connected:
    """A connection that commits and leaves no log behind."""

    def __init__(self, store):
        self.data = sqlite3.connect(store, isolation_level=None)

    def __enter__(self):
        self.data.text_factory = bytes
        return self.data

    def __exit__(self, *_):
        self.data.execute("PRAGMA wal_checkpoint(TRUNCATE)")
        self.data.close()


def tables(data):
    return [name.decode() for (name,) in
            data.execute("SELECT name FROM sqlite_master WHERE type = 'table' ORDER BY name")]


def columns(data, table):
    return [row[1].decode() for row in data.execute(f"PRAGMA table_info({table})")]


def quoted(name):
    return '"' + name.replace('"', '""') + '"'


def flip(store, rng, base, bits=1):
    content = bytearray(store.read_bytes())
    for _ in range(bits):
        content[rng.randrange(len(content))] ^= 1 << rng.randrange(8)
    store.write_bytes(content)


def flip_many(store, rng, base):
    flip(store, rng, base, bits=rng.choice((4, 16, 64)))


def truncate(store, rng, base):
    size = store.stat().st_size
    length = rng.choice((rng.randrange(size), rng.randrange(size // PAGE) * PAGE))
    store.write_bytes(store.read_bytes()[:length])


def blank_sector(store, rng, base):
    content = bytearray(store.read_bytes())
    begin = rng.randrange(len(content) // SECTOR) * SECTOR
    content[begin:begin + SECTOR] = rng.choice((bytes(SECTOR), rng.randbytes(SECTOR)))
    store.write_bytes(content)


def foreign_page(store, rng, base, size=PAGE):
    content = bytearray(store.read_bytes())
    other = (rng.choice(base.foreign) / STORE).read_bytes()
    to = rng.randrange(len(content) // size) * size
    # Mostly the page of the same number: tables of like stores lie in the same places.
    begin = to if rng.random() < 0.8 else rng.randrange(len(other) // size) * size
    page = other[begin:begin + size]
    content[to:to + len(page)] = page
    store.write_bytes(content)


def foreign_sector(store, rng, base):
    foreign_page(store, rng, base, size=SECTOR)


def swap_pages(store, rng, base):
    content = bytearray(store.read_bytes())
    first, second = (n * PAGE for n in rng.sample(range(1, len(content) // PAGE), 2))
    pages = content[first:first + PAGE], content[second:second + PAGE]
    content[second:second + PAGE], content[first:first + PAGE] = pages
    store.write_bytes(content)


def other_value(rng, value):
    """Another value than this: near it, or like nothing that a run writes."""
    near = value
    if isinstance(value, (int, float)):
        near = rng.choice((value + 1, -value - 1, value * 2 + 3, math.nextafter(value, math.inf)))
    elif isinstance(value, bytes):
        place = rng.randrange(len(value) + 1)
        near = value[:place] + rng.choice((b"0", b"7", b"x")) + value[place + 1:]
    odd = [None, 0, 1, -1, 4_000_000_000, 9_000_000_000_000_000_000, 0.5, -3.5, 1e300, math.inf,
           -math.inf, b"", b"0", b"2", b"-1", b"1e999", b"goal_reached", b"jammed", b"none"]
    others = [each for each in [near] * len(odd) + odd if each != value or type(each) != type(value)]
    chosen = rng.choice(others)
    return chosen.decode("utf-8", "replace") if isinstance(chosen, bytes) else chosen


def edit_value(store, rng, base):
    with connected(store) as data:
        table = rng.choice(tables(data) + ["trials"] * 4)
        column = quoted(rng.choice(columns(data, table)))
        rows = [row for (row,) in data.execute(f"SELECT rowid FROM {table}")]
        if not rows:
            return
        row = rng.choice(rows)
        (value,), = data.execute(f"SELECT {column} FROM {table} WHERE rowid = ?", (row,))
        try:
            data.execute(f"UPDATE {table} SET {column} = ? WHERE rowid = ?", (other_value(rng, value), row))
        except sqlite3.IntegrityError:
            pass  # a key that is there already, or NULL where there can be none


def delete_rows(store, rng, base):
    with connected(store) as data:
        table = rng.choice(tables(data) + ["trials"] * 4)
        rows = [row for (row,) in data.execute(f"SELECT rowid FROM {table}")]
        for row in rng.sample(rows, min(len(rows), rng.choice((1, 1, 2, 5)))):
            data.execute(f"DELETE FROM {table} WHERE rowid = ?", (row,))


def double_row(store, rng, base):
    """A row once more, under another key where it must have one."""
    with connected(store) as data:
        table = rng.choice(tables(data) + ["trials"] * 4)
        key = {"trials": "trial", "infrastructure_faults": None}.get(table, columns(data, table)[0])
        row = data.execute(f"SELECT * FROM {table} ORDER BY rowid DESC LIMIT 1").fetchone()
        if row is None:
            return
        values = [each.decode("utf-8", "replace") if isinstance(each, bytes) else each for each in row]
        if key:
            place = columns(data, table).index(key)
            old = values[place]
            values[place] = old + "2" if isinstance(old, str) else old + rng.choice((1, 5, 1000))
        try:
            data.execute(f"INSERT INTO {table} VALUES ({', '.join('?' * len(values))})", values)
        except sqlite3.IntegrityError:
            pass  # a key that is there already


def foreign_rows(store, rng, base):
    """Rows of another store in the place of this one's."""
    with connected(store) as data:
        data.execute("ATTACH ? AS other", (str(rng.choice(base.foreign) / STORE),))
        table = rng.choice(tables(data) + ["trials"] * 4)
        rows = [row for (row,) in data.execute(f"SELECT rowid FROM other.{table}")]
        for row in rng.sample(rows, min(len(rows), rng.choice((1, 1, 2, 5)))):
            try:
                data.execute(f"REPLACE INTO {table} SELECT * FROM other.{table} WHERE rowid = ?", (row,))
            except sqlite3.Error:
                pass  # a table of other columns


DAMAGES = {
    "a bit flipped": flip, "many bits flipped": flip_many, "truncated": truncate,
    "a sector overwritten": blank_sector, "a page of another store": foreign_page,
    "a sector of another store": foreign_sector, "two pages swapped": swap_pages,
    "a value edited": edit_value, "rows deleted": delete_rows, "a row doubled": double_row,
    "rows of another store": foreign_rows,
}


# ---- The study

def answer(rockyard, words, folder):
    """Runs a command in a folder that holds `run`; what it writes beside the store is its answer."""
    before = {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    try:
        done = subprocess.run([str(word) for word in [rockyard, *words]], cwd=folder, timeout=HANG_S,
                              capture_output=True, check=False)
    except subprocess.TimeoutExpired:
        return Answer(None)
    files = {}
    for path in sorted(folder.rglob("*")):
        if path.name.startswith("results.old-"):
            continue  # what was set aside is nobody's result
        if path.is_file() and not path.name.startswith(STORE) and before.get(path) != path.read_bytes():
            files[str(path.relative_to(folder))] = path.read_bytes()
    return Answer(done.returncode, done.stdout.decode("utf-8", "replace"),
                  done.stderr.decode("utf-8", "replace"), files)


def fresh_copy(store, folder):
    shutil.rmtree(folder, ignore_errors=True)
    (folder / "run").mkdir(parents=True)
    shutil.copy(store, folder / "run" / STORE)


def answers(rockyard, base, store, folder):
    """Of every command, each on a copy of its own."""
    found = {}
    for name, words in base.commands.items():
        fresh_copy(store, folder)
        found[name] = answer(rockyard, words, folder)
    return found


def attempt(rockyard, base, damage, seed, folder):
    """Verdict and answer of every command on one damaged copy, whose store stays in the folder."""
    rng = random.Random(seed)
    folder.mkdir(parents=True)
    damaged = folder / STORE
    whole = (base.folder / STORE).read_bytes()
    # Some changes change nothing: the same value, a row that there was.
    for _ in range(20):
        damaged.write_bytes(whole)
        DAMAGES[damage](damaged, rng, base)
        if damaged.read_bytes() != whole:
            break
    found = answers(rockyard, base, damaged, folder / "work")
    verdicts = {name: (judge(base.answers[name], each), each) for name, each in found.items()}
    shutil.rmtree(folder / "work")
    return verdicts


def prepare(rockyard, folder):
    folder.mkdir(parents=True)
    bases = make_bases(rockyard, folder)
    for base in bases:
        base.answers = answers(rockyard, base, base.folder / STORE, folder / "work")
        for name, each in base.answers.items():
            if each.code not in (0, 1, 4):
                sys.exit(f"{name} of a whole store ({base.name}): exit code {each.code}\n{each.err}")
    return bases


def plan(args, bases):
    """(base, damage, seed) of each store; damages take turns."""
    rng = random.Random(args.seed)
    work = []
    for number in range(args.stores):
        kind = list(DAMAGES)[number % len(DAMAGES)]
        work.append((rng.choice(bases), kind, rng.getrandbits(63)))
    return work


def table(title, counts, names):
    kinds = [kind for kind in (SAME, REFUSED, *FAULTS) if any(counts[name, kind] for name in names)]
    rows = [[title, *kinds]] + [[name, *(counts[name, kind] for kind in kinds)] for name in names]
    rows.append(["all", *(sum(counts[name, kind] for name in names) for kind in kinds)])
    widths = [max(len(str(row[i])) for row in rows) for i in range(len(rows[0]))]
    return "\n".join("  ".join(str(cell).ljust(width) if i == 0 else str(cell).rjust(width)
                               for i, (cell, width) in enumerate(zip(row, widths)))
                     for row in rows)


def run_study(args, folder):
    """Counts by damage and by command, and the faults as text."""
    bases = prepare(args.rockyard, folder / "whole")
    by_damage, by_command, faults = Counter(), Counter(), []
    work = list(enumerate(plan(args, bases)))

    def one(item):
        number, (base, damage, seed) = item
        return attempt(args.rockyard, base, damage, seed, folder / f"{number:05}")

    progress = Progress("damaged stores", args.stores)
    with ThreadPoolExecutor(args.jobs) as pool:
        for (number, (base, damage, seed)), verdicts in zip(work, pool.map(one, work)):
            progress.at(number, len(faults))
            faulty = False
            for name, (verdict, found) in verdicts.items():
                by_damage[damage, verdict] += 1
                by_command[name, verdict] += 1
                if verdict in FAULTS:
                    faulty = True
                    faults.append(f"{folder / f'{number:05}' / STORE}: {base.name}, {damage}: {name}: "
                                  f"{verdict} (exit code {found.code})\n    {found.err.strip()[:500]}")
            if not faulty:
                shutil.rmtree(folder / f"{number:05}")
    return by_damage, by_command, faults


def main(words=None):
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--stores", type=int, default=500, help="damaged stores (500)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=1, help="stores at a time")
    parser.add_argument("--rockyard", type=Path, default=study.ROOT / "build/release/bin/rockyard")
    parser.add_argument("--out", type=Path, help="new folder (default: a temporary one)")
    args = parser.parse_args(words)
    args.rockyard = args.rockyard.resolve()
    if args.out and args.out.exists():
        parser.error(f"{args.out} exists: name a new folder")
    folder = args.out.resolve() if args.out else Path(tempfile.mkdtemp(prefix="rockyard-damage-"))
    by_damage, by_command, faults = run_study(args, folder)
    damages = [name for name in DAMAGES if any(kind == name for kind, _ in by_damage)]
    print(f"{args.stores} damaged stores, seed {args.seed}; answers of commands\n")
    print(table("damage", by_damage, damages), end="\n\n")
    print(table("command", by_command, sorted({name for name, _ in by_command})))
    for fault in faults:
        print(f"\n{fault}")
    if not faults and not args.out:
        shutil.rmtree(folder)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
