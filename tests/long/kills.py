#!/usr/bin/env python3
"""Kills campaigns and sequences of images at random moments, goes on with them, and demands the same
results.

Each trial of this study starts a campaign of quick drives in a folder of its own, ends it by SIGKILL
after a random time within what an undisturbed one takes, repeats the command (with --resume; a merge
as it was) until it ends by itself, sometimes under another kill, and compares the bytes of the CSV
files and the hash of the records with those of a campaign that nobody disturbed; of 40 pairs of
images and the path through them the bytes of all files but the times, and that of what was on disk
when it was killed no more than one pair is done again.

    what     run, sweep, shards (both are killed, then merged), merge, render, vo
    whom     worker: the process that runs the trials; supervisor: the one that was started;
             group: both at once (the worker of a run without a supervisor is the same as the supervisor)
    threads  1 or 2

Prints how many of each were done, in how many the command was still running when it was killed, and
every campaign that was refused or came out otherwise; ends with 1 where there is one.

    tests/long/kills.py --rockyard build/release/bin/rockyard [--kills 200] [--seed 1]
"""

import argparse
import collections
import csv
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from progress import Progress

# The leak sanitizer looks from a child of the command; where that is taken for a worker and killed,
# the command waits for it for ever.
os.environ.setdefault("LSAN_OPTIONS", "detect_leaks=0")
ROOT = Path(__file__).resolve().parents[2]
SCENARIO = ROOT / "scenarios/pathfinder/nominal.json"
WHAT = ("run", "sweep", "shards", "merge", "render", "vo")
WHOM = ("worker", "supervisor", "group")
THREADS = (1, 2)
TRIALS = 6
TIME_LIMIT = "referee.time_limit_s=60"
IMAGES = ROOT / "scenarios/gestalt/abundance.json"
SMALL = ("sensors.stereo.columns=128", "sensors.stereo.rows=96", "sensors.stereo.images.pyramid_level=0",
         "sensors.stereo.max_disparity_px=32")
PAIRS = 40
TIMED = ("times.csv", "vo.json", "journal.jsonl")  # hold times or, of a pair that was begun twice, more
RETRIED = "infrastructure_faults"
# A command that is killed more often than this in a row does not get on.
MOST_COMMANDS = 20
# How often the repeated command is killed, too.
KILLED_AGAIN = 0.3
SWEEP = {"name": "kills", "trials": TRIALS // 2, "set": {"referee.time_limit_s": 60},
         "axes": [{"path": "terrain.rocks.k_per_m2", "values": [0.001, 0.004]}]}


class Study:
    """The commands, and what they come to undisturbed."""

    def __init__(self, rockyard, folder, chance):
        self.rockyard = rockyard
        self.folder = folder
        self.chance = chance
        (folder / "sweep.json").write_text(json.dumps(SWEEP), encoding="utf-8")
        self.whole = {}
        self.seconds = {}
        for what in ("run", "sweep", "shard", "render", "vo"):
            out = folder / f"whole-{what}"
            self.undisturbed(what, self.words(what, out, 1, "1/2"))
            self.whole[what] = contents(out)
        self.undisturbed("shard", self.words("shard", folder / "whole-shard2", 1, "2/2"))
        self.shards = [folder / "whole-shard", folder / "whole-shard2"]
        self.undisturbed("merge", self.merge_words(self.shards, folder / "whole-merge"))
        self.whole["merge"] = contents(folder / "whole-merge")
        if self.whole["merge"] != self.whole["run"]:
            sys.exit("merged shards are not the run, even undisturbed")

    def undisturbed(self, what, words):
        start = time.monotonic()
        result = subprocess.run(words, capture_output=True, text=True, check=False)
        if result.returncode != 0:
            sys.exit(f"{' '.join(map(str, words))}: {result.stderr}")
        self.seconds[what] = time.monotonic() - start

    def words(self, what, out, threads, shard):
        if what == "render":
            return [str(word) for word in
                    [self.rockyard, "render", IMAGES, *(word for text in SMALL for word in ("--set", text)),
                     "--pairs", PAIRS, "--step-m", 0.05, "--out", out]]
        if what == "vo":
            sequence = self.folder / "whole-render"
            return [str(word) for word in
                    [self.rockyard, "vo", sequence, "--cameras", sequence / "cameras.json", "--out", out, "--quiet"]]
        if what == "sweep":
            words = ["sweep", self.folder / "sweep.json"]
        else:
            words = ["run", SCENARIO, "--set", TIME_LIMIT, "--trials", TRIALS]
            words += ["--shard", shard] if what == "shard" else []
        return [str(word) for word in [self.rockyard, *words, "--out", out, "--threads", threads, "--quiet"]]

    def merge_words(self, shards, out):
        return [str(word) for word in [self.rockyard, "merge", *shards, "--out", out, "--quiet"]]

    def kill(self, whom, words, seconds):
        """Starts the command, kills it after that time. Returns its exit code, or None where it had
        ended before, and what it said."""
        with subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                              start_new_session=True) as process:
            try:
                process.wait(timeout=seconds)
            except subprocess.TimeoutExpired:
                return self.strike(whom, process)
            return None, process.stderr.read(), process.returncode

    def strike(self, whom, process):
        if whom == "worker":
            for child in children(process.pid) or [process.pid]:
                kill(child)
        elif whom == "group":
            os.killpg(process.pid, signal.SIGKILL)
        else:
            kill(process.pid)
        told = process.stderr.read()
        return True, told, process.wait()

    def disturbed(self, what, whom, words, again, out):
        """Kills the command, repeats it until it ends by itself. Whether the first kill struck a
        running command, and what is wrong."""
        struck, told, code = self.kill(whom, words, self.chance.uniform(0, self.seconds[what]))
        struck = bool(struck)
        for _ in range(MOST_COMMANDS):
            if code == 0:
                return struck, None
            if code > 0:
                return struck, f"{' '.join(words)} ends with {code}: {told}"
            done = finished(out)
            if self.chance.random() < KILLED_AGAIN:
                _, told, code = self.kill(whom, again, self.chance.uniform(0, self.seconds[what]))
            else:
                result = subprocess.run(again, capture_output=True, text=True, check=False)
                told, code = result.stderr, result.returncode
            if len(done - finished(out)) > 1:
                return struck, f"{' '.join(again)} does {len(done - finished(out))} pairs again"
            words = again
        return struck, f"{' '.join(words)} never ends"

    def campaign(self, what, whom, threads, out):
        """One disturbed campaign in the folder: whether a kill struck, and what is wrong."""
        if what == "merge":
            words = self.merge_words(self.shards, out / "all")
            struck, wrong = self.disturbed("merge", whom, words, words, out / "all")
            return struck, wrong or self.difference("merge", out / "all")
        if what != "shards":
            words = self.words(what, out / "all", threads, "")
            struck, wrong = self.disturbed(what, whom, words, [*words, "--resume"], out / "all")
            return struck, wrong or self.difference(what, out / "all")
        struck = False
        for index in (1, 2):
            words = self.words("shard", out / f"s{index}", threads, f"{index}/2")
            hit, wrong = self.disturbed("shard", whom, words, [*words, "--resume"], out / f"s{index}")
            struck = struck or hit
            if wrong:
                return struck, wrong
        self.undisturbed("merge", self.merge_words([out / "s1", out / "s2"], out / "all"))
        return struck, self.difference("merge", out / "all")

    def difference(self, what, out):
        found = contents(out)
        names = sorted(name for name in found.keys() | self.whole[what].keys()
                       if found.get(name) != self.whole[what].get(name))
        return f"{out}: not as undisturbed: {', '.join(names)}" if names else None


def table_of(path):
    """The bytes of a CSV file, less how often a trial was retried: that is told of each cell, and is
    what a kill of a worker changes."""
    data = path.read_bytes()
    rows = list(csv.reader(data.decode("utf-8").splitlines()))
    if not rows or RETRIED not in rows[0]:
        return data
    column = rows[0].index(RETRIED)
    return [row[:column] + row[column + 1:] for row in rows]


def contents(folder):
    """Each CSV file, the hash of the records, and the names of the other files; of images all but times."""
    if (folder / "made_by.json").is_file():
        return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*")
                if path.is_file() and path.name not in TIMED}
    files = {path.name: table_of(path) if path.suffix == ".csv" else b"" for path in folder.iterdir()}
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    files["trial_hash"] = summary.get("trial_hash")
    return files


def finished(folder):
    """The pairs of images that are done, each as what it would be no more if it were done again."""
    journal = folder / "journal.jsonl"
    if journal.is_file():
        return {line for line in journal.read_bytes().splitlines(keepends=True) if line.endswith(b"\n")}
    return {(path.name, path.stat().st_ino, path.stat().st_mtime_ns)
            for path in folder.rglob("*") if path.parent.name == "left"}


def children(process):
    try:
        return [int(child) for child in Path(f"/proc/{process}/task/{process}/children").read_text("ascii").split()]
    except FileNotFoundError:
        return []


def kill(process):
    try:
        os.kill(process, signal.SIGKILL)
    except ProcessLookupError:
        pass


def study(options, folder):
    chance = random.Random(options.seed)
    campaigns = Study(options.rockyard.resolve(), folder, chance)
    done, struck = collections.Counter(), collections.Counter()
    wrong = []
    progress = Progress("kills", options.kills)
    for number in range(options.kills):
        progress.at(number, len(wrong))
        kind = (WHAT[number % len(WHAT)], chance.choice(WHOM), chance.choice(THREADS))
        out = folder / "disturbed"
        out.mkdir()
        hit, problem = campaigns.campaign(*kind, out)
        shutil.rmtree(out)
        done[kind] += 1
        struck[kind] += hit
        if problem:
            wrong.append((number, kind, problem))
            print(f"campaign {number}, {kind}: {problem}", file=sys.stderr, flush=True)
    table = csv.writer(sys.stdout)
    table.writerow(["what", "whom", "threads", "campaigns", "killed while running"])
    for kind in sorted(done):
        table.writerow([*kind, done[kind], struck[kind]])
    print(f"{sum(done.values())} campaigns, {sum(struck.values())} killed while running, "
          f"{len(wrong)} refused or different")
    return 1 if wrong else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rockyard", type=Path, default=ROOT / "build/release/bin/rockyard")
    parser.add_argument("--kills", type=int, default=200, help="campaigns (default: %(default)s)")
    parser.add_argument("--seed", type=int, default=1, help="of the moments (default: %(default)s)")
    options = parser.parse_args()
    if options.kills < 1:
        parser.error("--kills: at least 1")
    if not options.rockyard.is_file():
        parser.error(f"--rockyard: {options.rockyard} does not exist")
    with tempfile.TemporaryDirectory(prefix="rockyard-kills-") as folder:
        return study(options, Path(folder))


if __name__ == "__main__":
    sys.exit(main())
