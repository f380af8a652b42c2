#!/usr/bin/env python3
"""Interrupts campaigns in Python by SIGINT at random moments, goes on with them, and demands the same results.

Each trial of this study starts a program that runs a campaign of quick drives, sends SIGINT after a random time
within what an undisturbed one takes, and demands that KeyboardInterrupt was raised, that what is stored opens and
is whole, and that the same call with resume=True ends with the hash of a campaign that nobody disturbed.

    what     run, sweep, traces, library (a navigator in workers), navigator (in Python)
    whom     process: the program alone; group: all its processes, as a terminal does
    threads  1 or 2

Prints how many of each were done, and in how many the campaign was under way when the signal came; ends with 1
where one came out otherwise.

    tests/long/interrupts.py --package build/test/python --library FILE [--interrupts 200] [--seed 1]
"""

import argparse
import collections
import contextlib
import csv
import os
import random
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from progress import Progress

ROOT = Path(__file__).resolve().parents[2]
NOMINAL = ROOT / "scenarios/pathfinder/nominal.json"
WHAT = ("run", "sweep", "traces", "library", "navigator")
WHOM = ("process", "group")
THREADS = (1, 2)
TRIALS = 12
WAIT_S = 120  # for a program that hangs
DESIGN = {"name": "interrupts", "scenario": str(NOMINAL), "set": {"rover.fidelity": "quasi_static"},
          "axes": [{"path": "terrain.rocks.k_per_m2", "values": [0.001, 0.004]}]}


def campaign(what, folder, threads, library, progress=None):
    """Runs the campaign, or goes on with it, and returns the hashes of its cells."""
    import rockyard as ry
    from rockyard.navigator import drive, parameter

    class Ahead(ry.Navigator):
        name, doc = "ahead", "straight ahead"
        parameters = [parameter("goal_tolerance_m", "real", 0.3, "arrives within", min=0, max=5)]

        def decide(self, seen):
            return drive(-0.2 * seen.estimate.heading_rad, until_distance_m=0.1)

    given = {"folder": folder, "resume": True, "threads": threads, "progress": progress}
    if what == "sweep":
        return [cell.hash for cell in ry.sweep(DESIGN, TRIALS // 2, 1, **given)]
    more = {"run": {}, "traces": {"traces": ["all"]}, "library": {"plugins": [library]}, "navigator": {"deciders": [Ahead]}}
    made = ry.run(NOMINAL, TRIALS, 1, set={"rover.fidelity": "quasi_static"}, **given, **more[what])
    assert what != "traces" or len(made.stored_traces) == TRIALS, "a trace is missing"
    return [made.hash]


def be_program(words):
    """Runs a campaign and says how it ended; the signal comes in any case."""
    what, folder, threads, library = words
    import rockyard  # the time of loading is none of the campaign
    told = []
    print("ready", rockyard.__version__, flush=True)
    try:
        campaign(what, folder, int(threads), library, lambda finished, planned: told.append((finished, planned)))
        print("ended", flush=True)
        time.sleep(WAIT_S)
    except KeyboardInterrupt:
        print(f"interrupted, told {told[-1:]}", flush=True)
        return 0
    return 1


def whole(folder):
    """What is wrong with a store, in words; None: nothing."""
    import rockyard as ry
    store = Path(folder) / "results.sqlite"
    if not store.exists():
        left = sorted(path.name for path in Path(folder).iterdir()) if Path(folder).exists() else []
        return f"without a store there is {left}" if left else None
    with contextlib.closing(sqlite3.connect(store)) as database:
        answer = database.execute("PRAGMA integrity_check").fetchone()[0]
    opened = ry.load(folder)
    for run in opened if isinstance(opened, ry.Sweep) else [opened]:
        if len(set(run.records["trial"])) != len(run):
            return f"{run} has a trial twice"
    return None if answer == "ok" else answer


def interrupted(options, chance, number, folder, plain):
    """Interrupts one campaign. Returns its kind, whether the signal met it under way, and what is wrong."""
    what, whom, threads = WHAT[number % len(WHAT)], chance.choice(WHOM), chance.choice(THREADS)
    kind = (what, whom, threads)
    words = [sys.executable, __file__, "--program", what, str(folder), str(threads), str(options.library)]
    program = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True)
    program.stdout.readline()
    time.sleep(chance.uniform(0, plain[what][1]))
    (os.killpg if whom == "group" else os.kill)(program.pid, signal.SIGINT)
    try:
        said, errors = program.communicate(timeout=WAIT_S)
    except subprocess.TimeoutExpired:
        os.killpg(program.pid, signal.SIGKILL)
        return kind, True, f"{program.communicate()} does not end"
    met = not said.startswith("ended")
    if program.returncode != 0 or "interrupted" not in said:
        return kind, met, f"exit code {program.returncode}: {said}{errors}"
    try:
        problem = whole(folder)
        if problem is None and campaign(what, folder, threads, options.library) != plain[what][0]:
            problem = "goes on to another hash"
    except Exception as error:  # of whatever kind: it is what this study looks for
        problem = repr(error)
    return kind, met, problem


def study(options, folder):
    chance = random.Random(options.seed)
    plain = {}
    for what in WHAT:
        began = time.monotonic()
        hashes = campaign(what, folder / what, 1, options.library)
        plain[what] = (hashes, time.monotonic() - began)
    done, met, wrong = collections.Counter(), collections.Counter(), 0
    progress = Progress("interrupts", options.interrupts)
    for number in range(options.interrupts):
        progress.at(number, wrong)
        at = folder / f"interrupted{number}"
        kind, under_way, problem = interrupted(options, chance, number, at, plain)
        done[kind] += 1
        met[kind] += under_way
        if problem:
            wrong += 1
            print(f"campaign {number}, {kind}: {problem}", file=sys.stderr, flush=True)
        shutil.rmtree(at, ignore_errors=True)
    table = csv.writer(sys.stdout)
    table.writerow(["what", "whom", "threads", "campaigns", "interrupted under way"])
    for kind in sorted(done):
        table.writerow([*kind, done[kind], met[kind]])
    print(f"{sum(done.values())} campaigns, {sum(met.values())} interrupted under way, {wrong} came out otherwise")
    if sum(met.values()) * 3 < options.interrupts:
        print("most signals came too late to show anything", file=sys.stderr)
        return 1
    return 1 if wrong else 0


def main():
    if sys.argv[1:2] == ["--program"]:
        return be_program(sys.argv[2:])
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--package", type=Path, default=ROOT / "build/test/python", help="folder of the package")
    parser.add_argument("--library", type=Path, default=ROOT / "build/test/tests/navigators/libpathfinder_twin.so",
                        help="a library with a navigator")
    parser.add_argument("--interrupts", type=int, default=200, help="campaigns (default: %(default)s)")
    parser.add_argument("--seed", type=int, default=1, help="of the moments (default: %(default)s)")
    options = parser.parse_args()
    for name, path in (("package", options.package / "rockyard"), ("library", options.library)):
        if not path.exists():
            parser.error(f"--{name}: {path} does not exist")
    if options.interrupts < 1:
        parser.error("--interrupts: at least 1")
    sys.path.insert(0, str(options.package))
    os.environ["PYTHONPATH"] = str(options.package)
    with tempfile.TemporaryDirectory(prefix="rockyard-interrupts-") as folder:
        return study(options, Path(folder))


if __name__ == "__main__":
    sys.exit(main())
