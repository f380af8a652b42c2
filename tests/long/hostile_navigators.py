#!/usr/bin/env python3
"""Runs campaigns whose navigator does harm in a third of the drives, and demands that the campaign ends as it should.

Each case is a campaign of quick drives with a plugin (hostile_navigator.cc) or a process (hostile_process.py) that
does one kind of harm at one of its first questions: it throws, crashes, hangs, decides NaN, writes without end, sends
what is no message, forks, allocates 10 GiB, exits, kills or stops itself. Demanded of every case:

    the command ends within its time, with 0, or with 5 where trials were left out (a process that something killed);
    every trial has an outcome, navigator_fault with a reason where harm was done, or is pending where a kill may have
    been the machine's; drives without harm are those of a navigator that does none, bit for bit;
    no process of the navigator is left, and no zombie.

Prints how many of each kind were done and every case that came out otherwise; ends with 1 where there is one.

    tests/long/hostile_navigators.py --rockyard build/release/bin/rockyard [--cases 1000] [--seed 1] [--headers DIR]
"""

import argparse
import collections
import json
import os
import random
import shlex
import sqlite3
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from progress import Progress

ROOT = Path(__file__).resolve().parents[2]
HERE = Path(__file__).resolve().parent
TRIALS = 6
LONGEST_S = 120
QUICK = ("rover.fidelity=quasi_static", "terrain.rocks.kind=none", "course.start_x_m=1.0", "course.goal_x_m=3.0",
         "navigation.limits.decision_cpu_s=0.3", "navigation.limits.answer_s=0.5", "navigation.limits.memory_mb=600")
PLUGIN = ("none", "throws", "throws_int", "crashes", "aborts", "hangs", "nan", "no_direction", "exits", "quick_exits",
          "forks", "prints", "allocates", "recurses", "kills_itself")
PROCESS = ("none", "error", "raises", "crashes", "aborts", "hangs", "sleeps", "nan", "text_for_number", "no_direction",
           "garbage", "too_long", "two_answers", "half_an_answer", "no_object", "endless_answer", "endless_stderr",
           "prints", "exits", "closes", "forks", "daemon", "allocates", "kills_itself", "stops_itself", "wrong_own")
# Harm that ends no drive, and harm that leaves trials pending, as a kill may come from outside.
HARMLESS = {"none", "prints", "forks", "allocates_plugin", "daemon"}
PENDING = {"kills_itself_plugin"}


class Study:
    def __init__(self, rockyard, headers, folder, chance):
        self.rockyard = rockyard
        self.folder = folder
        self.chance = chance
        self.library = folder / "libhostile.so"
        subprocess.run(["c++", "-std=c++20", "-O1", "-ffp-contract=off", "-shared", "-fPIC", "-I", headers,
                        "-I", "/usr/include/eigen3", HERE / "hostile_navigator.cc", "-o", self.library], check=True)
        self.plain = {}  # records of drives without harm, by how the navigator comes in

    def command(self, form, harm, at, out, more=()):
        settings = [*QUICK, f"navigation.hostile.harm={harm}", f"navigation.hostile.at={at}",
                    "navigation.hostile.every=3", *more]
        given = (["--plugin", str(self.library)] if form == "plugin" else
                 ["--navigator-process", f"python3 {shlex.quote(str(HERE / 'hostile_process.py'))}"])
        return [self.rockyard, "run", str(ROOT / "scenarios/pathfinder/nominal.json"), "--trials", str(TRIALS),
                "--threads", "2", "--trial-cpu-limit", "3", "--quiet", "--out", str(out), *given,
                *[word for setting in settings for word in ("--set", setting)]]

    def run(self, form, harm, at, out):
        return subprocess.run(self.command(form, harm, at, out), capture_output=True, text=True, errors="replace",
                              timeout=LONGEST_S, check=False)

    def records(self, out):
        store = sqlite3.connect(f"file:{out / 'results.sqlite'}?mode=ro", uri=True)
        found = store.execute("SELECT * FROM trials ORDER BY trial")
        names = [column[0] for column in found.description]
        rows = [dict(zip(names, row)) for row in found]
        store.close()
        told = ("campaign_cell", "trial", "outcome", "detail")
        values = [name for name in names if name not in told and "checksum" not in name]
        return {row["trial"]: (row["outcome"], row["detail"], [row[name] for name in values]) for row in rows}

    def plain_records(self, form, at):
        if form not in self.plain:
            out = self.folder / f"plain-{form}"
            done = self.run(form, "none", at, out)
            if done.returncode != 0:
                raise SystemExit(f"a campaign without harm fails: {done.stderr}")
            self.plain[form] = self.records(out)
        return self.plain[form]

    def case(self, number):
        """Returns the kind of a case, and what is wrong with how it ended, or None."""
        form = self.chance.choice(("plugin", "process"))
        harm = self.chance.choice(PLUGIN if form == "plugin" else PROCESS)
        at = self.chance.randint(1, 4)
        plain = self.plain_records(form, at)
        out = self.folder / f"case-{number}"
        kind = f"{form} {harm}"
        try:
            done = self.run(form, harm, at, out)
        except subprocess.TimeoutExpired:
            return kind, "did not end"
        return kind, self.judge(form, harm, done, out, plain)

    def judge(self, form, harm, done, out, plain):
        if done.returncode not in (0, 5):
            return f"exit code {done.returncode}: {done.stderr[-300:]}"
        left = left_over(out)
        if left:
            return f"left processes behind: {left}"
        records = self.records(out)
        pending = f"{harm}_{form}" in PENDING
        if not pending and len(records) != TRIALS:
            return f"{len(records)} of {TRIALS} trials are stored: {done.stderr[-300:]}"
        if not pending and done.returncode != 0:
            return f"exit code {done.returncode}: {done.stderr[-300:]}"
        harmless = harm in HARMLESS or f"{harm}_{form}" in HARMLESS
        faults = 0
        for trial, (outcome, detail, values) in records.items():
            if outcome == "navigator_fault":
                faults += 1
                if not detail.startswith("stopped because its navigator") and "process of its navigator" not in detail:
                    return f"trial {trial} has the reason {detail!r}"
            elif (outcome, values) != (plain[trial][0], plain[trial][2]):
                return f"trial {trial} is another one than without harm: {outcome} {detail}"
        if harmless and faults:
            return f"{faults} faults of a navigator that does no harm: {records}"
        if not harmless and not pending and not faults:
            return "no fault, though harm was done"
        return None


def left_over(out):
    """The command lines of processes that name the case or are zombies of this study."""
    found = []
    for entry in Path("/proc").iterdir():
        if not entry.name.isdigit():
            continue
        try:
            line = (entry / "cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace")
            state = (entry / "stat").read_text().rsplit(")", 1)[1].split()
        except OSError:
            continue
        zombie = state[0] == "Z" and state[1] == str(os.getpid())
        if str(out) in line or zombie:
            found.append(f"{entry.name} {state[0]} {line}")
    return found


def hostile_processes():
    return [entry for entry in Path("/proc").iterdir() if entry.name.isdigit() and
            b"hostile_process.py" in read_or_nothing(entry / "cmdline")]


def read_or_nothing(path):
    try:
        return path.read_bytes()
    except OSError:
        return b""


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rockyard", required=True)
    parser.add_argument("--cases", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--headers", default=str(ROOT / "src"))
    options = parser.parse_args()
    counts, wrong = collections.Counter(), []
    with tempfile.TemporaryDirectory() as folder:
        study = Study(options.rockyard, options.headers, Path(folder), random.Random(options.seed))
        progress = Progress("cases", options.cases)
        for number in range(options.cases):
            kind, problem = study.case(number)
            counts[kind] += 1
            if problem:
                wrong.append(f"case {number}, {kind}: {problem}")
                print(wrong[-1], flush=True)
            progress.at(number + 1, len(wrong))
        time.sleep(1.0)
        left = hostile_processes()
        # A daemon that left its group lives on where nothing confines it; it ends by itself.
        if left and not counts["process daemon"]:
            wrong.append(f"{len(left)} processes are left")
    for kind, count in sorted(counts.items()):
        print(f"{count:5} {kind}")
    print(f"{options.cases} cases, {len(wrong)} came out otherwise")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
