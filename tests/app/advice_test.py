#!/usr/bin/env python3
"""The "try:" of each error that the command can be brought to by small files is carried out.

Following it ends the problem, or at least changes nothing: it leads into no further error, and every file
that was there is there afterwards with the same bytes, under its name or set aside. Commands and options that
it names are taken from the printed line.

Usage: advice_test.py ROCKYARD PROJECT SHARE [unittest's arguments]

Rows of the tables: what is typed or written, the advice, and the ways to follow it. What a row may leave
changed is named in it; a run or sequence that is gone on with by --resume grows.
"""

import collections
import contextlib
import csv
import dataclasses
import fcntl
import fnmatch
import hashlib
import io
import json
import os
import re
import resource
import shlex
import shutil
import sqlite3
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

import numpy as np

ROCKYARD, PROJECT = (Path(word).resolve() for word in sys.argv[1:3])
SHARE = int(sys.argv[3])  # of the commands that are typed, one of so many
RUN = "--trials 2 --threads 1 --quiet --no-supervisor --set referee.time_limit_s=1 --set rover.fidelity=quasi_static"
# What a command changes where it goes on by --resume, of the folder that --out names.
SAME_RUN = ("results.sqlite*", "summary.json", "trials.csv", "distance_cdf.csv", "scenario.resolved.json", "sweep.json",
            "cells.*", "success.svg", "fit.csv", "fits.csv", "curves.csv", "differences.csv", "attribution.csv")
GROWS = {"run": SAME_RUN, "sweep": SAME_RUN, "vo": ("*",), "render": ("*",)}
# Whom permissions hold for.
NOBODY = {"user": 65534, "group": 65534, "extra_groups": []} if os.geteuid() == 0 else {}
LONG = "n" * 300
NOMINAL = "pathfinder/nominal"
TOLD = object()  # in the place of commands: nothing is left to do
HELP = {}  # what commands say of themselves, by their words
ALIKE = object()  # behind a command that stands for all that follow the same advice alike


# ---- The command, its options and its files

def bare(words, folder, **how):
    """The command on these words in the folder."""
    scenarios = folder / "scenarios" if (folder / "scenarios").exists() else PROJECT / "scenarios"
    environment = dict(os.environ, ROCKYARD_SCENARIOS=str(scenarios))
    return subprocess.run([ROCKYARD, *words], cwd=folder, env=environment, check=False, stdin=subprocess.DEVNULL,
                          **{"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **how})


def problems_in(err):
    """Path with reason, and advice, of every problem with advice."""
    return re.findall(r"^error: (.*)\n  try: (.*)$", err.decode(errors="replace"), re.M)


def files_in(folder):
    """Hashes of the bytes of all files, by name."""
    found = {}
    for path in sorted(folder.rglob("*")):
        if path.is_file() and not path.is_symlink():
            with contextlib.suppress(PermissionError):
                found[str(path.relative_to(folder))] = hashlib.sha256(path.read_bytes()).hexdigest()
    return found


def lost(before, after, may_change):
    """Files of which no copy is left; one may not stand for two."""
    copies = collections.Counter(after.values())
    gone = []
    for name, digest in before.items():
        if copies[digest] > 0:
            copies[digest] -= 1
        elif not any(fnmatch.fnmatch(name, pattern) for pattern in may_change):
            gone.append(name)
    return gone


def options_of_commands(folder):
    """Options of every command, from its own pages."""
    made = bare(["help", "--format", "markdown", "--out", "pages"], folder)
    assert made.returncode == 0, made.stderr
    pages = {page.stem: page.read_text() for page in (folder / "pages").glob("*.md") if page.stem != "README"}
    return {name: {*re.findall(r"--[a-z][a-z-]*", " ".join(re.findall(r"^\| `(-[^`]*)`", page, re.M)))}
            for name, page in pages.items()}


def unknown_words(advice, command, options):
    """What a line of advice names that is no command, or no option of the command that it is about."""
    wrong = [f"rockyard {name}" for name in re.findall(r"rockyard ([a-z]+)", advice) if name not in options]
    for quoted in re.findall(r"`rockyard ([^`]*)`", advice):
        name, *rest = quoted.split()
        wrong += [f"{name} {word}" for word in rest if word.startswith("--") and word not in options.get(name, ())]
    plain = re.sub(r"`[^`]*`", "", advice)
    about = {command, *re.findall(r"rockyard ([a-z]+)", advice)}
    about |= {"run", "sweep"} if "run and sweep" in plain else set()
    known = {"--help", "--version"}.union(*(options.get(name, ()) for name in about))
    return wrong + [word for word in re.findall(r"(?<![\w-])--[a-z][a-z-]*", plain) if word not in known]


# ---- Rows, and ways to follow advice

@dataclasses.dataclass
class Row:
    fails: object  # words of the command, as a line or a list
    says: str  # the whole advice, a regular expression
    ways: list  # of (folder, words, the advice and its groups) to the commands that are to succeed, or TOLD
    given: str = ""  # what lies in the folder: names of what is made once
    files: dict = dataclasses.field(default_factory=dict)  # and files: text, bytes, or what is written as JSON
    make: object = None  # what else is done in the folder
    hold: object = None  # what another program holds while the command fails, to be closed then
    how: dict = dataclasses.field(default_factory=dict)  # of the process that fails
    then: dict = dataclasses.field(default_factory=dict)  # of those that follow the advice
    exit: int = 2  # of the command that fails
    ends: tuple = (0,)  # exit codes of what follows the advice
    may_change: tuple = ()


def words_of(line):
    """What a shell makes of a line."""
    return shlex.split(line) if isinstance(line, str) else list(line)


def replaced(words, old, new):
    """The words with others in the place of some that stand together."""
    old, new = words_of(old), words_of(new)
    for at in range(len(words) - len(old) + 1):
        if words[at:at + len(old)] == old:
            return words[:at] + new + words[at + len(old):]
    raise AssertionError(f"{words} has no {old}")


def filled(text, said):
    """The text with what the advice said in place of {1}, {2}, ..."""
    return re.sub(r"\{(\d)\}", lambda match: said[int(match[1])], text)


def add(option):
    """The same, and behind it what the advice names."""
    def way(_, words, said):
        option_said = filled(option, said)
        assert option_said.split()[0] in said[0], f"{said[0]} does not name {option_said}"
        return [[*words, *words_of(option_said)]]
    return way


def swap(old, new):
    """The same with other words in the place of some; {1} is what the advice said."""
    return lambda _, words, said: [replaced(words, old, filled(new, said))]


def elsewhere(old, new):
    """Another folder or file, which needs no trial of its own wherever a command gives the same advice."""
    way = swap(old, new)
    return lambda folder, words, said: way(folder, words, said) + [ALIKE]


def drop(old):
    """The same without some words."""
    return swap(old, "")


def instead(*lines):
    """Other commands; with {words} the same."""
    def way(_, words, said):
        return [words if line == "{words}" else words_of(filled(line, said)) for line in lines]
    return way


def printed(*within):
    """Every command of the advice as it stands there, in backticks or from "rockyard" on, and words behind it."""
    def way(_, __, said):
        quoted = re.findall(r"`rockyard ([^`]*)`", said[0]) or re.findall(r"rockyard ([^,;`]*)", said[0])
        assert quoted, said[0]
        return [[*words_of(line), *within] for line in quoted]
    return way


def write(**files):
    """The same after files are written: a_json is a.json, and a__b_json is a/b.json."""
    def way(folder, words, said):
        for name, content in files.items():
            put(folder / name.replace("__", "/").replace("_", ".", 1), content, said)
        return [words]
    return way


def done(action, line="{words}"):
    """The same words, or other ones, after something is done in the folder."""
    def way(folder, words, said):
        action(folder)
        return instead(line)(folder, words, said)
    return way


def shows(pattern):
    """The page of help that the advice names says this."""
    def way(folder, words, said):
        line = tuple(printed()(folder, words, said)[0])
        if line not in HELP:
            HELP[line] = bare(line, folder).stdout.decode()
        assert line[-1] == "--help" and re.search(pattern, HELP[line]), f"{line} does not say {pattern}"
        return [TOLD]
    return way


def put(path, content, said=None):
    """Writes text, bytes, what is made of the bytes that are there, or all else as JSON."""
    if callable(content):
        content = content(path.read_bytes())
    path.parent.mkdir(parents=True, exist_ok=True)
    if isinstance(content, str):
        content = filled(content, said) if said else content
        content = content.encode()
    path.write_bytes(content if isinstance(content, bytes) else json.dumps(content).encode())


def limited(kind, most):
    """How a process with such a limit begins."""
    return {"preexec_fn": lambda: resource.setrlimit(kind, (most, most))}


# ---- What is typed

FEW = {"scenarios/pathfinder/nominal.json": {"name": "nominal"}, "scenarios/gestalt/abundance.json": {"name": "one"},
       "scenarios/sweeps/abundance.json": {"name": "two", "axes": [{"path": "course.goal_x_m", "values": [6, 7]}]}}
SCAN = ("replay nominal --trial 0 --set referee.time_limit_s=1 --set sensors.light_stripe.columns=64 "
        "--set sensors.light_stripe.rows=48 ")
def described(folder, *changes):
    """mine.urdf, as the command writes a rover, with (old, new) once each."""
    bare(["rover", "nominal", "--out", "mine.urdf"], folder)
    text = (folder / "mine.urdf").read_text(encoding="utf-8")
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new, 1)
    (folder / "mine.urdf").write_text(text, encoding="utf-8")


def urdf(says, old, new):
    """A URDF file with one change, which the advice takes back."""
    return Row("rover mine.urdf", says, [done(described)], make=lambda box: described(box, (old, new)),
               may_change=("mine.urdf",))


TYPED = [
    Row("fly", r"one of: (\w+), .*completion", [instead("{1} --help")]),
    Row("chekc a", r'did you mean "(\w+)"\? one of: .*', [instead("{1} --help")]),
    Row("--versoin", r'did you mean "(--version)"\? see (rockyard --help)', [instead("{1}"), printed()]),
    Row("--quiet", r"rockyard --help", [shows("(?s)Subcommands:.* run ")]),
    Row("run", r"rockyard run --help", [shows(r"SCENARIO TEXT REQUIRED")]),
    Row("metrics all", r"rockyard metrics --help", [shows("--markdown")]),
    Row(f"run nominal {RUN} --out a --trails 3", r'did you mean "(--trials)"\? see (rockyard run --help)',
        [swap("--trails 3", ""), shows("--trials INT")]),
    Row(f"run nominal {RUN} --out a --intervall wilson", r'did you mean "(--interval)"\? see (rockyard run --help)',
        [swap("--intervall", "{1}")]),
    Row("run nominal --threads 0", r"rockyard run --help", [shows(r"--threads INT:INT in \[1 - 4096\]")]),
    Row("run nominal --out ''", r"rockyard run --help", [shows("--out TEXT")]),
    Row(f"run nominal {RUN} --out a --interval wilsen", r'did you mean "(\w+)"\? one of: wilson, clopper-pearson',
        [swap("wilsen", "{1}")]),
    Row("parameters --origin guessed", r"one of: (\w+), (\w+), .*", [swap("guessed", "{2}")]),
    Row("plan", r"rockyard plan --help", [shows("half-width .*\n.*claim")]),
    Row("plan half-width --half-width 5", r"rockyard plan( half-width)? --help",
        [shows(r"--half-width FLOAT:FLOAT in \[1e-05 - 0.49\]")]),
    Row("plan claim --belov 0.1", r".*rockyard plan( claim)? --help", [shows("--below FLOAT")]),
    Row("plan difference --from 0.1 --to 0.1", r"give the rate that matters, or use rockyard plan equivalence",
        [swap("--to 0.1", "--to 0.2"), instead("plan equivalence --margin 0.1 --deviation 0.3")]),
    Row("plan difference --from 0.1234567 --to 0.7654321 --discordant 0.1", r"use a share from ([\d.]+) to ([\d.]+)",
        [swap("--discordant 0.1", "--discordant {1}"), swap("--discordant 0.1", "--discordant {2}")]),
    Row(f"run nominal {RUN.replace('--trials 2', '--trials 3')} --out a --until-half-width 0.45 ",
        r"--max-trials bounds the trials of --until-half-width", [swap("--trials", "--max-trials")]),
    Row("help fly", r"one of: (\w+), .*", [swap("fly", "{1}")]),
    Row("help plan clam", r'did you mean "(\w+)"\? one of: .*', [swap("clam", "{1}")]),
    Row("help run --out pages --format man", r"name a --format and no command", [drop("run")]),
    Row("help --out pages", r"name a --format and no command", [add("--format man")]),
    Row([b"validate", b"caf\xe9.json"], r"set a locale of UTF-8, or rename the file",
        [done(lambda box: (box / os.fsdecode(b"caf\xe9.json")).rename(box / "café.json"), "validate café.json")],
        make=lambda box: put(box / os.fsdecode(b"caf\xe9.json"), {"name": "a"})),
    Row("parameters --search zzzz", r"search for a part of a word, such as (\w+); `rockyard parameters` lists all",
        [swap("zzzz", "{1}"), printed()]),
    Row("list nowhere", r"name a folder with scenarios", [instead("list folder")],
        files={"folder/one.json": {"name": "one"}}),
    Row("validate nominl", r'did you mean "(\w+)"\? `rockyard list` shows those of (.*)',
        [swap("nominl", "{1}"), printed(), instead("list {2}")], files=FEW),
    Row("validate mien.json", r'did you mean "(mine.json)"\? `rockyard list` shows .*', [swap("mien.json", "{1}")],
        files={"mine.json": {"name": "mine"}}),
    Row("sweep zzzzzzzzzzz", r"`rockyard list` shows those of (.*)", [printed(), instead("list {1}")], files=FEW),
    Row("validate abundance", r"say which: (\S+), (\S+)", [swap("abundance", "{1}"), swap("abundance", "{2}")],
        files=FEW),
    Row("terrain nominal --out a.txt", r"use a file that ends in (\.json), (\.csv), (\.obj) or (\.svg)",
        [swap("a.txt", "a{2}"), swap("a.txt", "a{4}")]),
    Row("terrain nominal --fields 10", r"name a file to write, or ask for --blind-swath or --density",
        [add("--blind-swath"), add("--density"), instead("terrain nominal --out a.svg")]),
    Row("terrain nominal --out no/a.svg", r"make the folder first", [done(lambda box: (box / "no").mkdir())]),
    Row("terrain nominal --out a.svg", r"name a file", [swap("a.svg", "b.svg")],
        make=lambda box: (box / "a.svg").mkdir()),
    Row("terrain nominal --out a.svg", r"name a file", [swap("a.svg", "b.svg")],
        make=lambda box: os.mkfifo(box / "a.svg")),
    Row(f"terrain nominal --out {LONG[:250]}.svg", r"shorten it", [swap(f"{LONG[:250]}.svg", "n.svg")]),
    Row("terrain nominal --out /proc/a.svg", r"check the free space and the permissions of its folder",
        [swap("/proc/a.svg", "a.svg")]),
    Row("terrain mine.json --out mine.json", r"name another file", [swap("--out mine.json", "--out yours.json")],
        files={"mine.json": {"name": "mine"}}),
    Row("terrain gestalt/waypoints --blind-swath --fields 10",
        r"leave the waypoints out: (--set course.waypoints=\{\})", [add("{1}")]),
    Row("terrain nominal --blind-swath --fields 10 --set course.goal_x_m=0.9",
        r"use a goal farther along \+x from the start", [swap("course.goal_x_m=0.9", "course.goal_x_m=7.6")]),
    Row("terrain nominal --density --fields 10 --set terrain.rocks.kind=none",
        r"use rocks of kind moore, golombek or uniform_count, a course straight along x, and a layout at least 0.5 m wide .*",
        [swap("terrain.rocks.kind=none", "terrain.rocks.kind=moore"),
         swap("terrain.rocks.kind=none", "terrain.rocks.kind=golombek"),
         swap("terrain.rocks.kind=none", "terrain.rocks.kind=uniform_count")]),
    Row("rover nominal --out a.txt", r"name a URDF file \((\.urdf)\) or a rover file \((\.json)\)",
        [swap("a.txt", "a{1}"), swap("a.txt", "a{2}")]),
    urdf(r"name a URDF file, as xacro writes it", "</robot>", ""),
    urdf(r"expand it first: xacro FILE > rover.urdf", "<robot name=\"rover\">", "<robot><xacro:rover/>"),
    urdf(r"give each link and joint a name of its own", "<link name=\"chassis\">", "<link>"),
    urdf(r"give it a name of its own", "<link name=\"left_bogie\">", "<link name=\"chassis\">"),
    urdf(r"name a link of this file", "<child link=\"left_bogie\"/>", "<child link=\"bogie\"/>"),
    urdf(r"name a joint of this file", "<mimic joint=\"left_rocker_joint\"", "<mimic joint=\"rocker\""),
    urdf(r'did you mean "revolute"\? one of: .*', "type=\"revolute\"", "type=\"revolut\""),
    urdf(r"write decimal numbers in SI units", "<mass value=\"", "<mass value=\"about "),
    urdf(r"give a vector such as 0 1 0", "<axis xyz=\"0 1 0\"/>", "<axis xyz=\"0 0 0\"/>"),
    urdf(r"describe a rocker-bogie of six wheels", "type=\"continuous\"", "type=\"fixed\""),
    urdf(r"let it turn as a bogie does", "left_bogie_joint\" type=\"revolute\"",
         "left_bogie_joint\" type=\"prismatic\""),
    urdf(r"steer the four outer wheels or all six, .*", "left_front_steering_joint\" type=\"revolute\"",
         "left_front_steering_joint\" type=\"fixed\""),
    Row("replay nominal --trial 0 --set referee.time_limit_s=1 --out a.txt", r"name a file such as (report.html)",
        [swap("a.txt", "{1}")]),
    Row("replay nominal --trial 0 --set referee.time_limit_s=1 --out a.html --svg b --data b", r"name another file",
        [swap("--data b", "--data c")]),
    Row(SCAN + "--scan 99", r"the trial has (\d+) scans; .*", [
        swap("--scan 99", "--scan 0"), lambda _, words, said: [
            (replaced(words, "--scan 99", "--list" if "--list" in said[0] else ""), r"scan +0 .*\n +1 scans")]]),
    Row("replay gestalt/abundance --trial 0 --set referee.time_limit_s=40 --step 99 --out a",
        r"the trial has (\d+) steps; .*", [swap("--step 99", "--step 0")]),
    Row("replay nominal --trial 0 --set referee.time_limit_s=1", r"name another file with (--out)", [add("{1} a.html")],
        files={"results": "mine"}, exit=5),
    Row(SCAN + "--scan 0", r"name another folder with (--out)", [add("{1} a")], files={"results": "mine"}, exit=5),
    Row(SCAN + "--scan 0 --out a", r"name another folder", [swap("--out a", "--out b")], files={"a/mine": "kept"}),
    Row("trace hazard_detection/detection --trial 0 --set hazard_detection.scenes_per_run=2",
        r"use rockyard replay --list, which lists the scans of any trial", [
            lambda _, words, said: [(["replay", *words[1:], "--list"], r"  \d+ scans; ")]]),
    Row("validate nominal --set terrain", r"write PATH=VALUE", [swap("terrain", "terrain.rocks.kind=none")]),
    Row("validate nominal --set =3", r"write keys joined by dots, such as a.b.c", [swap("=3", "seed=3")]),
    Row(["validate", "nominal", "--set", ".".join("a" * 200) + "=1"], r"check the path",
        [instead("validate nominal --set seed=1")]),
    Row("list", r"check the free space of where it goes", [instead("list")], files=FEW,
        how={"stdout": os.open("/dev/full", os.O_WRONLY)}, exit=5),
    Row("trace nominal --trial 0 --cell 5 --set referee.time_limit_s=1", r"leave it out", [drop("--cell 5")]),
]

# ---- Runs and their folders

QUICK_SWEEP = {"name": "two", "trials": 2, "scenario": {"extends": "nominal.json", "referee": {"time_limit_s": 1}},
               "axes": [{"path": "terrain.rocks.k_per_m2", "values": [0.004, 0.008]}]}
EXISTS = (r"go on with it by --resume, set it aside by --force \(nothing is deleted\), or choose another folder "
          r"with --out")
FOREIGN = r"choose another folder with --out, or write into it with --force, which renames files of the names it needs"
DAMAGED = r"run .*--force.*"
OTHER_RUN = (r"choose another folder with --out, or start anew with --force and without --resume \(the store is set "
             r"aside, not deleted\)")
NAME_RUN = r"name the folder of a run, as `rockyard run` prints it"
RUN_SOME = r"(?:run some first|let it run: the same `rockyard run` or `rockyard sweep` with --resume)"


def damage(box):
    put(box / "a/results.sqlite", "no database")


def checksum(values, before=0):
    """Of a row of a store, as src/batch/store_rows.h has it."""
    data = b""
    for value in values:
        if value is None:
            data += b"N"
        elif isinstance(value, str):
            text = value.encode()
            data += b"T" + struct.pack("<q", len(text)) + text
        else:
            data += struct.pack("<cq" if isinstance(value, int) else "<cd", b"I" if isinstance(value, int) else b"R",
                                value)
    return zlib.crc32(data, before)


def forged(box, sql, run="a"):
    """A store with a change that no checksum speaks against."""
    with contextlib.closing(sqlite3.connect(box / run / "results.sqlite")) as store:
        store.executescript(sql)
        starts = {cell: checksum((fingerprint, int(seed)))
                  for cell, fingerprint, seed in store.execute("SELECT cell, fingerprint, seed FROM cells")}
        for table in ("meta", "cells", "columns", "builds", "trials", "infrastructure_faults"):
            sums = []
            for rowid, *row in store.execute(f"SELECT rowid, * FROM {table}").fetchall():
                start = starts[row[0]] if table == "trials" else 0
                sums.append(checksum(row[:-2] if table == "trials" else row[:-1], start))
                store.execute(f"UPDATE {table} SET row_checksum = ? WHERE rowid = ?", (sums[-1], rowid))
                if table == "trials":
                    store.execute("UPDATE trials SET outcome_checksum = ? WHERE rowid = ?",
                                  (checksum(row[:3], start), rowid))
            tally = (table, len(sums), sum(sums))
            store.execute("INSERT OR REPLACE INTO inventory VALUES (?, ?, ?, ?)", (*tally, checksum(tally)))
        store.commit()


class Locked:
    """What another run does to its folder."""

    def __init__(self, folder):
        self.descriptor = os.open(folder, os.O_RDONLY)
        fcntl.flock(self.descriptor, fcntl.LOCK_EX)

    def close(self):
        os.close(self.descriptor)


def broken(box, run="a"):
    """As where trials ended in a fault of the simulator."""
    forged(box, "UPDATE trials SET outcome = 'simulator_fault', detail = 'a broken part'", run)


def written_to(box):
    """What another program does to a store while it writes."""
    store = sqlite3.connect(box / "a/results.sqlite")
    store.execute("BEGIN EXCLUSIVE")
    return store


def emptied(box, run="a"):
    forged(box, "DELETE FROM trials", run)


def details(store):
    """The reasons that a store keeps."""
    with contextlib.closing(sqlite3.connect(store)) as opened:
        return [text for text, in opened.execute("SELECT detail FROM trials") if text]


def like_others(*_):
    """What another row has carried out."""
    return [TOLD]


RUNS = [
    Row(f"run nominal {RUN} --out a", EXISTS, [add("--resume"), add("--force"), elsewhere("--out a", "--out b")], "a"),
    Row(f"run nominal {RUN} --out a --seed 5", EXISTS, [add("--force"), elsewhere("--out a", "--out b")], "a"),
    Row(f"run nominal {RUN} --out a --seed 5 --resume", OTHER_RUN,
        [swap("--resume", "--force"), elsewhere("--out a", "--out b")], "a"),
    Row(f"run nominal {RUN} --out m --resume", r"give every shard a folder of its own",
        [elsewhere("--out m", "--out b")], "m1", make=lambda box: (box / "m1").rename(box / "m")),
    Row(f"run nominal {RUN} --out a", FOREIGN, [add("--force"), elsewhere("--out a", "--out b")],
        files={"a/summary.json": "mine", "a/other": "mine"}),
    Row(f"run nominal {RUN} --out a --resume", FOREIGN, [add("--force"), elsewhere("--out a", "--out b")],
        files={"a/summary.json": "mine"}),
    Row(f"run nominal {RUN} --out a --resume", DAMAGED, [add("--force"), swap("--resume", "--force")], "a",
        make=damage),
    Row(f"run nominal {RUN} --out a", r"choose another folder with --out", [elsewhere("--out a", "--out b")],
        files={"a": "a file"}),
    Row(f"run nominal {RUN} --out a/b", r"check the name and the permissions of the folder, or use another one",
        [swap("--out a/b", "--out b")], files={"a": "a file"}),
    Row(f"run nominal {RUN} --out a --force", r"wait for it to end, or choose another folder with --out",
        [instead("{words}"), elsewhere("--out a", "--out b")], "a", hold=lambda box: Locked(box / "a")),
    Row(f"run nominal {RUN} --out a", r"free some space on the disk \(or lift the quota\), then repeat the command "
        r"\(run and sweep with --resume\)", [add("--resume")], how=limited(resource.RLIMIT_FSIZE, 40960), exit=5),
    Row(f"run nominal {RUN} --out a", r"end other programs or allow more open files \(ulimit -n\), then run it again",
        [instead("{words}")], how=limited(resource.RLIMIT_NOFILE, 7), exit=5),
    Row("parameters mine.json", r"end other programs or allow more open files \(ulimit -n\), then run it again",
        [instead("{words}")], files={"mine.json": {"name": "mine"}}, how=limited(resource.RLIMIT_NOFILE, 4), exit=5),
    Row(f"run nominal {RUN} --out a --resume", r"add (--any-build) to mix them all the same: .*",
        [add("{1}")], "a", make=lambda box: forged(box, "UPDATE builds SET build = 'of yesterday'")),
    Row(f"run nominal {RUN} --out a --shard 3", r"use I/N with 1 <= I <= N, e.g. (1/4)",
        [swap("--shard 3", "--shard {1}")]),
    Row(f"run nominal {RUN} --out a --shard 1/2 --traces worst:1",
        r"leave it out, merge the shards, and ask for it there with --resume",
        [drop("--traces worst:1"),
         instead(f"run nominal {RUN} --out a --shard 1/2", f"run nominal {RUN} --out b --shard 2/2",
                 "merge a b --out c --quiet", f"run nominal {RUN} --out c --traces worst:1 --resume")]),
    Row(f"run nominal {RUN} --out a --traces some",
        r"use (all), (failures), worst:N with N from 1, or share:P with 0 < P <= 1, e.g. (\S+) or (\S+)",
        [swap("some", "{2}"), swap("some", "{4}")]),
    Row(f"run hazard_detection/detection --out a --traces all {RUN} --set hazard_detection.scenes_per_run=2",
        r"leave it out", [drop("--traces all")]),
    Row(f"run nominal {RUN} --out a --resume --traces all", r"make room for a folder of that name",
        [done(lambda box: (box / "a/traces").rename(box / "a/other"))], "a", files={"a/traces": "mine"}, exit=5),
    Row(f"run nominal --out a --until-half-width 0.45 --shard 1/2 {RUN.replace('--trials 2', '--max-trials 3')}",
        r"leave out --shard, or say how many trials to run with --trials",
        [drop("--shard 1/2"), instead(f"run nominal --out a --shard 1/2 {RUN}")]),
    Row(f"run nominal --out a --until-half-width 0.45 {RUN.replace('--trials 2', '--max-trials 3')} "
        "--set course.trials_per_layout=2",
        r"set (course.trials_per_layout=1), or say how many trials to run with --trials",
        [swap("course.trials_per_layout=2", "{1}"),
         instead(f"run nominal --out a {RUN} --set course.trials_per_layout=2")]),
    Row("run hazard_detection/detection --out a --until-half-width 0.45 --quiet --threads 1",
        r"say how many trials to run with --trials",
        [instead("run hazard_detection/detection --out a --trials 1 --quiet --set hazard_detection.scenes_per_run=2")]),
    Row(f"run nominal {RUN} --out a --ablate no_slipp", r'did you mean "(\w+)"\? one of: .*',
        [swap("no_slipp", "{1}")]),
    Row(f"run nominal {RUN} --out a --ablate no_slip --ablate no_slip", r"give each once",
        [swap("--ablate no_slip --ablate no_slip", "--ablate no_slip")]),
    Row(f"run nominal {RUN} --out a --ablate perfect_path_selection --ablate no_avoidance",
        r"leave one of the two out", [drop("--ablate no_avoidance"), drop("--ablate perfect_path_selection")]),
    Row(f"run nominal {RUN} --out a --resume", r"wait for the other program or end it, then repeat the command "
        r"\(run and sweep with --resume\)", [instead("{words}")], "a", hold=written_to),
    Row(f"run nominal {RUN} --out a --resume", r"trials.csv names .*",
        [lambda box, _, said: [TOLD] if all(word in (box / "a/trials.csv").read_text() for word in (
            "trial,", "a broken part", *re.findall("seed", said[0]))) else []], "a", make=broken, exit=3),
    Row("sweep two.json --quiet --threads 1 --out two --resume",
        r"`detail` in the table trials of results.sqlite names the reason of each",
        [lambda box, *_: [TOLD] if details(box / "two/results.sqlite") else []],
        "two two.json nominal.json", make=lambda box: broken(box, "two"), exit=3),
    Row(f"run nominal {RUN} --out a", r"check the name and the permissions of the folder, or use another one",
        [done(lambda box: box.chmod(0o777))], make=lambda box: box.chmod(0o555), how=NOBODY, then=NOBODY),
    Row("terrain nominal --out a.svg", r"check its permissions, or name a file elsewhere",
        [done(lambda box: box.chmod(0o777))], make=lambda box: box.chmod(0o555), how=NOBODY, then=NOBODY),
    Row("parameters mine.json", r"check its permissions", [done(lambda box: (box / "mine.json").chmod(0o644))],
        files={"mine.json": {"name": "mine"}}, how=NOBODY, then=NOBODY,
        make=lambda box: (box / "mine.json").chmod(0o600) if NOBODY else (box / "mine.json").chmod(0)),
    Row("report a --replays 0 --tracks 0 --out a.html", r"check .*permissions(?!.*--out).*",
        [done(lambda box: (box / "a").chmod(0o755))], "a", how=NOBODY, then=NOBODY,
        make=lambda box: (box.chmod(0o777), (box / "a").chmod(0o700 if NOBODY else 0))),
    # Of what is read
    Row("report b", NAME_RUN, [swap("b", "a")], "a", make=lambda box: (box / "b").mkdir()),
    Row(f"run b {RUN} --out c", NAME_RUN, [swap("b", "a")], "a", make=lambda box: (box / "b").mkdir()),
    Row("compare a b", NAME_RUN, [swap("b", "a")], "a"),
    Row("compare a loop", r"check .*", [done(lambda box: (box / "loop").unlink(), "compare a a")], "a",
        make=lambda box: (box / "loop").symlink_to("loop")),
    Row("report runs --replays 0 --tracks 0", r"name one of them: (\S+) \(nominal, 2 trials, [\d-]+\); (\S+) .*",
        [swap("runs", "{1}"), swap("runs", "{2}")], "a b",
        make=lambda box: [(box / "runs").mkdir(), *((box / name).rename(box / "runs" / name) for name in "ab")]),
    Row("report a --replays 0 --tracks 0", DAMAGED, [instead(f"run nominal {RUN} --out a --force", "{words}")], "a",
        make=damage),
    Row(f"run a {RUN} --out b", DAMAGED, [
        lambda _, words, said: [[*words, "--force"]] if re.match("run again with --force", said[0]) else
        [words_of(f"run nominal {RUN} --out a --force"), words]], "a", make=damage),
    Row("report a a --replays 0 --tracks 0", r"name each run once", [swap("a a", "a")], "a"),
    Row("report m1 --replays 0 --tracks 0", r"put all shards together first: rockyard merge SHARD... --out DIR",
        [instead("merge m1 m2 --out m --quiet", "report m --replays 0 --tracks 0")], "m1 m2"),
    Row("report a --replays 0 --tracks 0", RUN_SOME, [instead(f"run nominal {RUN} --out a --resume", "{words}")], "a",
        make=emptied),
    Row("compare a b", RUN_SOME, [like_others], "a b", make=emptied),
    Row("baseline a --reason why --out b.json", RUN_SOME,
        [instead(f"run nominal {RUN} --out a --resume", "{words}")], "a", make=emptied),
    Row("check a --against a.json", RUN_SOME, [like_others], "a a.json", make=emptied),
    Row("baseline a --reason why --out b.json", r"finish it.*--resume.*",
        [instead(f"run nominal {RUN} --out a --resume", "{words}")], "a",
        make=lambda box: forged(box, "DELETE FROM trials WHERE trial = 1")),
    Row("baseline two --reason why --out b.json", r"finish it.*rockyard sweep.*--resume.*",
        [instead("sweep two.json --quiet --threads 1 --out two --resume", "{words}")], "two two.json nominal.json",
        make=lambda box: forged(box, "DELETE FROM trials WHERE trial = 1", "two")),
    Row(["baseline", "a", "--reason", " ", "--out", "b.json"], r"say why the numbers may be what they are",
        [instead("baseline a --reason why --out b.json")], "a"),
    Row("baseline a a --reason why --out b.json", r"name runs of different scenarios", [swap("a a", "a")], "a"),
    Row("baseline h --reason why --out b.json", r"name runs of drives", [swap("h", "a")], "a h"),
    Row("baseline l --reason why --out b.json", r"run it .*(--set course.trials_per_layout=1)",
        [instead(f"run nominal {RUN} --out k {{1}}", "baseline k --reason why --out b.json")], "l"),
    Row("check l --against a.json --allow-scenario-change", r"run it .*(--set course.trials_per_layout=1)",
        [instead(f"run nominal {RUN} --out k {{1}}", "check k --against a.json")], "l a.json"),
    Row("check a a --against a.json", r"name one run for each cell", [swap("a a", "a")], "a a.json"),
    Row("check a --against old.json", r"write it anew with rockyard baseline",
        [instead("baseline a --reason why --out old.json", "{words}")], "a",
        files={"old.json": {"kind": "rockyard_baseline", "schema_version": 9}}, may_change=("old.json",)),
    Row("check c --against a.json", r"run the baseline's scenario, or add (--allow-scenario-change)",
        [swap("c", "a"), add("{1}")], "a c a.json", ends=(0, 1, 4)),
    Row("check a --against two.baseline.json", r"run it; the runs have nominal",
        [instead("check two --against two.baseline.json")], "a two two.baseline.json"),
    Row("check a a --against published.json", r"name one run of each scenario", [swap("a a", "a")],
        "a published.json", ends=(0, 1, 4)),
    Row("report a --against other.json --replays 0 --tracks 0",
        r"name the reference that their scenarios are in, or leave it out",
        [swap("other.json", "published.json"), drop("--against other.json")], "a published.json",
        make=lambda box: shutil.copy(PROJECT / "results/reference/howard2012.json", box / "other.json")),
    Row("compare a h", r"compare two runs of the same experiment and study", [swap("a h", "a a"), swap("a h", "h h")],
        "a h"),
    Row("compare h h2", r"compare runs whose lists of factors have values in common", [swap("h h2", "h h")], "h h2"),
    Row("trace two --trial 0", r".* take one by (--cell): (\d+) .*",
        [lambda _, words, said: [[*words, said[1], said[2]]]], "two"),
    Row("trace two --trial 0 --cell none", r"use one of (\d+) \((\S+)\), .*",
        [swap("none", "{1}"), swap("none", "{2}")], "two"),
    *(Row(line, r"`rockyard trace`, .* take one by --cell: .*", [instead("trace two --trial 0 --cell 0")], "two")
      for line in (f"run two {RUN} --out b", "rover two", "parameters two")),
    Row("trace a --trial 0 --seed 5", r"name the scenario file, or a scenario.resolved.json, instead of the folder",
        [swap("a", "nominal"), swap("a", "a/scenario.resolved.json")], "a"),
    Row("trace a --trial 7", r"use one of the (\d+) finished trials, or name the scenario file instead",
        [swap("--trial 7", "--trial 0"), swap("a", "a/scenario.resolved.json")], "a"),
    Row("trace a --trial 0 --csv a/results.sqlite", r"choose another name", [swap("a/results.sqlite", "a/a.csv")], "a"),
    Row("trace a --trial 0", r"the same program made it: this is a defect, please report it",
        [lambda *_: [TOLD]], "a", exit=1,
        make=lambda box: forged(box, "UPDATE trials SET outcome = 'tip_over' WHERE trial = 0")),
    Row("trace a --trial 0", r"use the program that made the run: (of yesterday)", [lambda *_: [TOLD]], "a", exit=1,
        make=lambda box: forged(box, "UPDATE trials SET outcome = 'tip_over' WHERE trial = 0;"
                                    "UPDATE builds SET build = 'of yesterday'")),
    Row("report a --replays 1 --tracks 0 --out a.html", r"choose another place with --out, or (--replays 0)",
        [swap("a.html", "b.html"), swap("--replays 1", "{1}")], "a", files={"a_replays": "mine"}),
    Row("report a --replays 0 --tracks 0", r"use the program that made it, or another folder", [swap("a", "b")],
        "a b", make=lambda box: forged(box, "UPDATE meta SET value = '99' WHERE key = 'schema_version'")),
    # Shards
    Row("merge m1 --out m --quiet", r"name their folders too, or take what there is with (--partial)",
        [swap("m1", "m1 m2"), add("{1}")], "m1 m2"),
    Row("merge m1 m1 m2 --out m --quiet", r"name each shard once", [swap("m1 m1", "m1")], "m1 m2"),
    Row("merge a m1 --out m --quiet", r"name folders that .*--shard I/N", [swap("a m1", "m1 m2")], "a m1 m2"),
    Row("merge m1 m2 --out a --quiet", r"choose a new folder with --out", [elsewhere("--out a", "--out m")], "m1 m2",
        files={"a/mine": "kept"}),
    Row("merge m1 m2 --out m --quiet", r"finish it .*--resume, or take what there is with (--partial)",
        [add("{1}"), instead(f"run nominal {RUN} --shard 1/2 --out m1 --resume", "{words}")], "m1 m2",
        make=lambda box: forged(box, "DELETE FROM trials", "m1")),
    Row("merge m1 m2 --out m --quiet", r"run the shorter ones again, by .* with --resume and more --trials",
        [instead(f"run nominal {RUN.replace('--trials 2', '--trials 4')} --shard 1/2 --out m1 --resume", "{words}")],
        "m1 m2",
        make=lambda box: bare(words_of(f"run nominal {RUN.replace('--trials 2', '--trials 4')} --shard 2/2 --out m2 "
                                       "--resume"), box)),
    Row("merge m1 m2 --out m --quiet", r"add (--any-build) to mix them all the same: .*", [add("{1}")], "m1 m2",
        make=lambda box: forged(box, "UPDATE builds SET build = 'of yesterday'", "m2")),
    # Sweeps
    Row("sweep two.json --quiet --threads 1 --dry-run --out a", r"choose another folder with --out",
        [elsewhere("--out a", "--out b")], "two.json nominal.json", files={"a/mine": "kept"}),
    Row("sweep nominal.json --quiet", r"use rockyard run for a scenario",
        [instead(f"run nominal.json {RUN} --out a")], "nominal.json"),
    Row("terrain two.json --out a.svg", r".*rockyard sweep.*", [swap("two.json", "nominal.json")],
        "two.json nominal.json"),
    Row("run two.json --quiet", r"`rockyard sweep FILE --dry-run` writes the scenario of each cell, .*",
        [instead("sweep two.json --quiet --threads 1 --out a")], "two.json nominal.json"),
]

# ---- Images, cameras, sequences and boards

SIZE = (64, 96)  # rows and columns


def netpbm(image, maximum=255):
    """PGM, or PPM of three planes."""
    image = np.asarray(image)
    kind = b"P6" if image.ndim == 3 else b"P5"
    samples = image.astype(">u2" if maximum > 255 else "u1")
    return b"%s\n%d %d\n%d\n" % (kind, image.shape[1], image.shape[0], maximum) + samples.tobytes()


def textures(seed=1):
    """What the left and the right eye see of a wall, five pixels apart."""
    grains = np.random.default_rng(seed).integers(0, 256, (SIZE[0], SIZE[1] + 9))
    smooth = sum(np.roll(grains, shift, (0, 1)) for shift in ((0, 0), (0, 1), (1, 0), (1, 1))) // 4
    return smooth[:, :SIZE[1]], smooth[:, 5:5 + SIZE[1]]


LEFT, RIGHT = textures()
OTHER = textures(2)[1]
COLOURS = [np.stack([eye, eye // 2, 255 - eye], 2) for eye in (LEFT, RIGHT)]


def camera(x_m=0.0, **changed):
    """A camera as JSON."""
    lens = {"model": "cahv", "columns": SIZE[1], "rows": SIZE[0], "C": [x_m, 0, 0], "A": [0, 0, 1],
            "H": [100, 0, 47.5], "V": [0, 100, 31.5]} | changed
    return {name: value for name, value in lens.items() if value is not None}


def turned(angle, **more):
    """What of a camera changes where it is turned to the right."""
    sine, cosine = np.sin(np.radians(angle)), np.cos(np.radians(angle))
    A = [sine, 0, cosine]  # noqa: N806
    lens = {"A": A, "H": (100 * np.array([cosine, 0, -sine]) + 47.5 * np.array(A)).tolist(),
            "V": [31.5 * sine, 100, 31.5 * cosine]}
    return lens | more if more else camera(**lens)


def pair(left=None, **right):
    return {"left": left or camera(), "right": camera(**({"x_m": 0.1} | right))}


def text(left="", right="", **changed):
    """A pair as flight calibrations have it; `changed` of the left one: lines by their key, and one more line."""
    lines = {"Model": "CAHV", "Dimensions": "96 64", "A": "0 0 1", "H": "100 0 47.5", "V": "0 100 31.5"}
    eye = lambda name, x_m, own, more: f"Camera = {name}\n" + "".join(  # noqa: E731
        f"{key} = {value}\n" for key, value in {**lines, "C": f"{x_m} 0 0", **own}.items()) + more
    return eye("left", 0, changed, left) + eye("right", 0.1, {}, right)


def jpeg(process, components):
    """The head of a JPEG file, as far as its kind is told."""
    parts = b"".join(bytes((number + 1, 0x11, 0)) for number in range(components))
    scan = b"".join(bytes((number + 1, 0)) for number in range(components))
    return (b"\xff\xd8\xff" + bytes((process, 0, 8 + 3 * components, 8, 0, SIZE[0], 0, SIZE[1], components)) + parts
            + b"\xff\xda" + bytes((0, 6 + 2 * components, components)) + scan + b"\0\x3f\0" + bytes(99))


IMAGES = {"l.pgm": netpbm(LEFT), "r.pgm": netpbm(RIGHT)}
STEREO = "stereo l.pgm r.pgm --out seen"
CAMERAS = STEREO + " --cameras c.json"
CYLINDER = "cylinder l.ppm r.ppm --cameras c.json --param cylinder.axis=[0,-1,0]"
PAINTED = {"l.ppm": netpbm(COLOURS[0]), "r.ppm": netpbm(COLOURS[1]), "c.json": pair()}
OUT_EXISTS = (r"(?:go on with it by --resume, )?set it aside by --force \(nothing is deleted\), or choose another "
              r"folder with --out")
OUT_FOREIGN = (r"choose another folder with --out, or write into it with --force, which sets files of the names it "
               r"needs aside")
THESE_CAMERAS = r"give the cameras of these very images, not of larger or smaller ones"
COPY = r"copy it again, or make it anew from its source"


def stereo(says, bad, *ways, **more):
    """A row of images that are refused; without ways, the good ones are put in their place."""
    good = {name.replace(".", "_"): content for name, content in IMAGES.items() if name in bad}
    return Row(more.pop("fails", STEREO), says, list(ways) or [write(**good)], files=IMAGES | bad, **more)


def cameras(says, bad, good=None):
    """A row of cameras that are refused, and others that do what the advice says."""
    name = "c.json" if isinstance(bad, dict) else "c.txt"
    return Row(STEREO + f" --cameras {name}", says, [write(**{name.replace(".", "_"): good or pair()})],
               files=IMAGES | {name: bad})


SEEN = [
    Row("stereo", r"(rockyard stereo LEFT RIGHT --out FOLDER); see rockyard stereo --help",
        [instead(STEREO)], files=IMAGES),
    stereo(r"give both, or --nearest alone", {"c.json": pair()}, swap("--farthest 9", "--nearest 1 --farthest 9"),
           swap("--farthest 9", "--nearest 1"), fails=CAMERAS + " --farthest 9"),
    stereo(r"give at least ([\d.]+) m", {"c.json": pair()}, swap("--farthest 1", "--farthest {1}"),
           fails=CAMERAS + " --nearest 1.2345634 --farthest 1"),
    stereo(r"leave one of --align and --cameras out", {"c.json": pair()}, drop("--align"), drop("--cameras c.json"),
           fails=CAMERAS + " --align"),
    stereo(r"give --cameras, or the range in pixels: (--param \S+=0 --param \S+=64)", {"c.json": pair()},
           add("--cameras c.json"), swap("--nearest 1", "{1}"), fails=STEREO + " --nearest 1"),
    stereo(r"begin farther away, or use a higher level of the pyramid", {"c.json": pair()},
           swap("0.015", "1"),
           lambda _, words, said: [[*words, "--param", "pyramid_level=1"]], fails=CAMERAS + " --nearest 0.015"),
    stereo(r"give two images that were taken together, of one size", {"r.pgm": netpbm(RIGHT[1:])}),
    stereo(r"give the image of the other eye", {"r.pgm": netpbm(LEFT)}),
    stereo(r"use a lower level, or images of at least 16 pixels a side", {}, swap("pyramid_level=3", "pyramid_level=1"),
           fails=STEREO + " --param pyramid_level=3"),
    Row("stereo r.pgm l.pgm --out seen", r"give the left eye's image first", [swap("r.pgm l.pgm", "l.pgm r.pgm")],
        files=IMAGES),
    stereo(r"check that rows are aligned \(--cameras or --align\) and that both see the same; widen the range "
           r"\(--param (correlator.disparities)=...\)", {"r.pgm": netpbm(OTHER)}),
    stereo(r"check that the cameras are those of these images and that both see the same; widen the range "
           r"\((--nearest)\)", {"c.json": pair(), "r.pgm": netpbm(OTHER)}, fails=CAMERAS),
    stereo(r"use two images of one textured scene whose rows are less than \d+ px apart, or give --cameras",
           {"l.pgm": netpbm(0 * LEFT + 9), "r.pgm": netpbm(0 * RIGHT + 10)}, fails=STEREO + " --align"),
    stereo(r"give the known disparities of the left image as it is matched: .*", {"t.pgm": netpbm(LEFT[1:])},
           write(t_pgm=netpbm(0 * LEFT + 5)), fails=STEREO + " --reference t.pgm"),
    stereo(r"leave (--reference-samples) out",
           {"t.pfm": b"Pf\n96 64\n-1.0\n" + np.full(SIZE, 5, "<f4").tobytes()}, drop("--reference-samples 4"),
           fails=STEREO + " --reference t.pfm --reference-samples 4"),
    stereo(r"name one of a single channel \(Pf\)", {"t.pfm": b"PF\n96 64\n-1.0\n" + bytes(96 * 64 * 12)},
           write(t_pfm=b"Pf\n96 64\n-1.0\n" + np.full(SIZE, 5, "<f4").tobytes()),
           fails=STEREO + " --reference t.pfm"),
    stereo(r"name a PFM or PNG file", {"t.ppm": netpbm(COLOURS[0])},
           lambda box, words, said: [put(box / "t.pfm", b"Pf\n96 64\n-1.0\n" + np.full(SIZE, 5, "<f4").tobytes())
                                     or replaced(words, "t.ppm", "t.pfm")], fails=STEREO + " --reference t.ppm"),
    stereo(r"a limit of 127 takes windows up to 8 x 8, 36 up to 15 x 15, (18) up to (21) x 21", {},
           swap("dog.limit=127", "dog.limit={1}"), swap("correlator.window_side_px=21", "correlator.window_side_px=8"),
           fails=STEREO + " --param correlator.window_side_px=21 --param dog.limit=127"),
    stereo(COPY, {"r.pgm": b"P5\n96 x\n255\n"}),
    stereo(COPY, {"r.pgm": netpbm(RIGHT).replace(b"255", b"0", 1)}),
    stereo(r"copy it again: only a part of the file is here", {"r.pgm": netpbm(RIGHT)[:-9]}),
    stereo(r"copy it again, or make it anew", {"r.pgm": b""}),
    stereo(r"save it as PGM or PNG", {"r.pgm": b"P4\n96 64\n" + bytes(12 * 64)}),
    stereo(r"name an image: a PFM file is a reference of disparities", {"r.pgm": b"Pf\n1 1\n-1.0\n1234"}),
    stereo(r"name a PNG, JPEG, PGM, PPM, PDS3, PDS4 or VICAR file", {"r.pgm": b"no image"}),
    stereo(r"save it as common JPEG with 8 bits a colour, or as PNG", {"r.pgm": jpeg(0xc3, 1)}),
    stereo(r"save it with Huffman coding, as most programs do, or as PNG", {"r.pgm": jpeg(0xc9, 1)}),
    stereo(r"save it in RGB or grey: how inks become light is not stated in the file", {"r.pgm": jpeg(0xc0, 4)}),
    stereo(r"save it in RGB or grey", {"r.pgm": jpeg(0xc0, 2)}),
    stereo(r"check that this is the right file, and cut out or reduce what is needed",
           {"r.pgm": b"P5\n999999 999999\n255\n"}),
    stereo(r"name another file or folder", {}, swap(LONG, "r.pgm"), fails=f"stereo l.pgm {LONG} --out seen"),
    stereo(r"name another file or folder", {}, swap(f"--out {LONG}", "--out seen"),
           fails=f"stereo l.pgm r.pgm --out {LONG}"),
    stereo(r"name an image file", {}, swap("seen.pgm", "r.pgm"), fails="stereo l.pgm seen.pgm --out seen",
           make=lambda box: (box / "seen.pgm").mkdir()),
    stereo(OUT_FOREIGN, {"seen/stereo.json": "mine"}, add("--force"), elsewhere("--out seen", "--out other")),
    stereo(r"name another folder", {}, swap("--out .", "--out seen"),
           fails="stereo left.png r.pgm --out .", make=lambda box: shutil.copy(box / "l.pgm", box / "left.png")),
    Row("stereo l.pgm r.pgm --out way", OUT_EXISTS, [add("--force"), elsewhere("--out way", "--out seen")], "way",
        files=IMAGES),
    Row(STEREO + " --force", r"wait for it to end, or choose another folder with --out",
        [instead("{words}"), elsewhere("--out seen", "--out other")], files=IMAGES | {"seen/mine": "kept"},
        hold=lambda box: Locked(box / "seen")),
    # Cameras
    Row(CAMERAS, r"write strict JSON: double quotes, no comments, no trailing commas, finite numbers",
        [write(c_json=pair())], files=IMAGES | {"c.json": '{"left": {}, }'}),
    cameras(THESE_CAMERAS, pair(camera(rows=65))),
    cameras(r"give all of it: a calibration has no defaults", pair(camera(H=None))),
    cameras(r"divide it by its length", pair(camera(A=[0, 0, 0.5]))),
    cameras(r"give H = f_h H' \+ c_h A with H' across the columns of V'", pair(camera(H=[0, 100, 47.5]))),
    cameras(r"use a first number above -1", pair(camera(model="cahvor", O=[0, 0, 1], R=[-1, 0, 0])),
            pair(camera(model="cahvor", O=[0, 0, 1], R=[0, 0, 0]))),
    cameras(r'did you mean "(cahv)"\? one of: .*', pair(camera(model="cahw"))),
    cameras(r"give two cameras that stand apart, in one frame", pair(x_m=0)),
    cameras(r"give two cameras that look the same way, in one frame",
            pair(A=[0, 0, -1], H=[-100, 0, -47.5], V=[0, 100, -31.5])),
    cameras(r"use cameras side by side, at least 20 deg off it", pair(C=[0, 0, 1])),
    cameras(r"exchange the left and the right camera with their images", pair(x_m=-0.1)),
    cameras(r"turn images of cameras one above the other by 90 deg", pair(C=[0, 0.1, 0])),
    cameras(r"give two cameras whose images overlap, in one frame", pair(turned(-40), **turned(40, x_m=0.1))),
    cameras(r"flip the image and the signs of its horizontal vector", pair(H=[-100, 0, 47.5])),
    cameras(r"write a line KEY = VALUES", text("what is this\n"), text()),
    cameras(r'did you mean "(Model)"\? one of: .*', text("Modell = CAHV\n"), text()),
    cameras(r"one of: (CAHV), (CAHVOR), CAHVORE1, CAHVORE2, CAHVORE3,LINEARITY", text(Model="PINHOLE"), text()),
    cameras(r"use 1 \(perspective\), 2 \(fisheye\) or 3 \(general\)", text("Mtype = 7\n"), text()),
    cameras(r"use a number from -1 to 1", text("Mparm = x\n"), text()),
    cameras(r"write whole numbers", text(Dimensions="96.5 64"), text()),
    cameras(r"write finite numbers", text(A="0 0 inf"), text()),
    cameras(r"write 3 numbers behind A =", text(A="0 0"), text()),
    cameras(r"give it once", text("A = 0 0 1\n"), text()),
    cameras(r"put the line Camera = left first", text().replace("Camera = left\n", ""), text()),
    cameras(r"begin each camera with a line Camera = left or Camera = right, once", text().replace("right", "left"),
            text()),
    # The cylinder
    Row("cylinder l.ppm", r"rockyard cylinder LEFT RIGHT --cameras FILE; see rockyard cylinder --help",
        [instead(CYLINDER)], files=PAINTED, ends=(0, 4)),
    Row(CYLINDER.replace("r.ppm", "r.pgm"), r"give colour images: red, green and blue", [swap("r.pgm", "r.ppm")],
        files=PAINTED | IMAGES, ends=(0, 4)),
    Row(CYLINDER, r"give two images that were taken together, of one size", [write(r_ppm=PAINTED["r.ppm"])],
        files=PAINTED | {"r.ppm": netpbm(COLOURS[1][1:])}, ends=(0, 4)),
    Row(CYLINDER.replace("r.ppm", "l.ppm"), r"give the image of the other eye", [swap("l.ppm l.ppm", "l.ppm r.ppm")],
        files=PAINTED, ends=(0, 4)),
    Row(CYLINDER, THESE_CAMERAS, [write(c_json=pair())], files=PAINTED | {"c.json": pair(camera(rows=65))},
        ends=(0, 4)),
    Row("cylinder l.ppm r.ppm --cameras c.json", r"say which way is up in the cameras' frame; upwards in the image is "
        r"(cylinder.axis=\S+)", [lambda _, words, said: [[*words, "--param", said[1]]]], files=PAINTED, ends=(0, 4)),
    Row(CYLINDER.replace("[0,-1,0]", "[0,0,0]"), r"give a direction such as (\[0, 0, 1\])",
        [swap("cylinder.axis=[0,0,0]", "cylinder.axis=[0,-1,0]")], files=PAINTED, ends=(0, 4)),
]

# ---- Sequences

RENDER = ("render gestalt/abundance --set sensors.stereo.columns=160 --set sensors.stereo.rows=128 "
          "--set sensors.stereo.images.pyramid_level=0 --set sensors.stereo.max_disparity_px=40 ")
TINY = RENDER.replace("160", "24").replace("128", "24")
WAY = RENDER + "--pairs 3 --step-m 0.1 "
VO = "vo way --cameras way/cameras.json --out path"
WAYS = (r"give a folder with left and right, image_0 and image_1 or image_l and image_r, one with mav0, or a text file "
        r"with two paths a line")
POSE = "1 0 0 0 0 1 0 0 0 0 1 0\n"
TUM = "".join(f"{time} 0 0 0 0 0 0 1\n" for time in range(3))
IDENTITY = "0 0 0 0 0 0 0 1"
KITTI = "P0: 100 0 79.5 0 0 100 63.5 0 0 0 1 0\nP1: 100 0 79.5 -12 0 100 63.5 0 0 0 1 0\n"
TWELVE = r"give twelve in every line \(KITTI: the rows of \[R p\]\) or eight \(TUM: time x y z qx qy qz qw\)"
LIST = "".join(f"way/left/00000{i}.png way/right/00000{i}.png\n" for i in range(3))


RING = "--set terrain.rocks.kind=listed " + " ".join(
    f"--set terrain.rocks.listed.{name}={list(values)}".replace(", ", ",") for name, values in (
        ("x_m", (1.6, -1.6, 0, 0, 1.2, 1.2, -1.2, -1.2)), ("y_m", (0, 0, 1.6, -1.6, 1.2, -1.2, 1.2, -1.2)),
        ("diameter_m", 8 * (1.2,)), ("height_m", 8 * (1,))))
EUROC = "".join(f"{i},00000{i}.png\n" for i in range(3))


def euroc(box, listed):
    """The sequence as EuRoC has it, with a list of its own for the left eye."""
    for eye, number, text_of in (("left", 0, listed), ("right", 1, EUROC)):
        shutil.copytree(box / "way" / eye, box / f"mav/cam{number}/data")
        put(box / f"mav/cam{number}/data.csv", text_of)


def vo(says, more, *ways, line=VO, **others):
    """A row of odometry on the rendered sequence."""
    return Row(line + " " + more if more else line, says, list(ways), given="way", **others)


def truth(says, bad, good):
    return vo(says, "--truth t.txt", write(t_txt=good), files={"t.txt": bad})


def moved(old, new):
    return done(lambda box: (box / old).rename(box / new))


def force(_, words, said):
    """With --force, in the place of --resume where the advice says so."""
    assert "--force" in said[0]
    return [replaced(words, "--resume", "--force") if "in place of --resume" in said[0] else [*words, "--force"]]


SEQUENCES = [
    Row(TINY, r"name a folder for the images", [instead(TINY + "--out a")]),
    Row(TINY + "--out a --route", r"say how many pairs a sequence has",
        [lambda _, words, said: [[*words, "--pairs", "2"]]]),
    Row(TINY + "--out a --resume", r".*--force.*", [force]),
    Row(TINY + "--out a --pairs 2 --route --step-m 0", r"leave them out, or give steps that lead somewhere",
        [drop("--step-m 0"), swap("--step-m 0", "--step-m 0.2")]),
    Row(TINY + "--out a --pairs 2 --route --x 1",
        r"leave --x, --y and --heading out, or set (course.start_x_m) and so on",
        [drop("--x 1"), swap("--x 1", "--set {1}=1")]),
    Row(TINY + "--out a --pairs 2 --step-m 50", r"take fewer or shorter steps, or make the arena larger "
        r"\(--set (terrain.arena.length_m)=...\)",
        [swap("--step-m 50", "--step-m 0.1"), lambda _, words, said: [[*words, "--set", f"{said[1]}=100"]]]),
    Row(TINY + "--out a --pairs 2 --route " + RING, r"choose another --trial, or leave --route out", [drop("--route")]),
    Row(TINY + "--out a --pairs 2", OUT_FOREIGN, [force, elsewhere("--out a", "--out b")],
        files={"a/poses.txt": "mine"}),
    Row(TINY + "--out a --pairs 2 --resume", r"choose another folder with --out, or write into it with --force.*",
        [force, elsewhere("--out a", "--out b")], files={"a/poses.txt": "mine"}),
    Row(TINY + "--pairs 2 --out tiny --resume", r"give what it was begun with, or set it aside by --force.*",
        [swap("--pairs 2", "--pairs 3"), force], "tiny"),
    Row(TINY + "--pairs 3 --out tiny --resume", r"use the program that began it, or set it aside by --force.*",
        [force], "tiny", make=lambda box: put(
            box / "tiny/made_by.json", lambda old: json.loads(old) | {"program": "rockyard of yesterday"})),
    Row(VO + " --resume", r"choose another folder", [elsewhere("--out path", "--out b")], "way",
        files={"path/made_by.json": {"command": "stereo", "program": "", "finished": True}}),
    vo(OUT_EXISTS, "", add("--resume"), add("--force"), elsewhere("--out path", "--out b"),
       make=lambda box: (bare(words_of(VO), box), put(box / "path/made_by.json", lambda old: json.loads(old) | {
           "finished": False}))),
    vo(r"begin anew in another folder, or set this one aside by --force.*", "--resume",
       elsewhere("--out path", "--out b"), force, make=lambda box: (bare(words_of(VO), box),
                                                      put(box / "path/journal.jsonl", "{}\n"))),
    vo(r"begin anew in another folder", "--resume", elsewhere("--out path", "--out b"),
       make=lambda box: (bare(words_of(VO), box),
                         put(box / "path/journal.jsonl", lambda old: old.replace(b'"pair":1', b'"pair":2')
                             .replace(b'"pair": 1', b'"pair": 2')))),
    Row("vo", r"rockyard vo SEQUENCE --cameras FILE --out FOLDER; see rockyard vo --help", [instead(VO)], "way"),
    vo(r"name a file with the cameras of both images \(src/vision/README.md\)", "",
       lambda _, words, said: [[*words, "--cameras", "way/cameras.json"]], line="vo way --out path"),
    vo(r".*--first.*--every.*", "", drop("--first 2"), line=VO + " --first 2"),
    vo(r".*--first.*--every.*", "", drop("--every 3"), line=VO + " --every 3"),
    vo(r"give one pose a pair of the whole sequence", "--predict p.txt", write(p_txt=3 * POSE), files={"p.txt": POSE}),
    vo(r"give the cameras of these very images", "", swap("c.json", "way/cameras.json"),
       line="vo way --cameras c.json --out path", files={"c.json": pair()}),
    Row("vo none --out path --cameras way/cameras.json", WAYS, [swap("none", "way")], "way"),
    Row("vo none --out path --cameras way/cameras.json", WAYS,
        [done(lambda box: [(box / "way" / eye).rename(box / "none" / f"image_{n}") for n, eye in
                           ((0, "left"), (1, "right"))]),
         swap("none", "list.txt")], "way", files={"none/mine": "kept", "list.txt": LIST}),
    Row("vo list.txt --out path --cameras way/cameras.json", WAYS, [write(list_txt=LIST)], "way",
        files={"list.txt": "# none\n"}),
    Row("vo list.txt --out path --cameras way/cameras.json", r'give "LEFT RIGHT" or "LEFT RIGHT TIME_S"',
        [write(list_txt=LIST)], "way", files={"list.txt": LIST + "one\n"}),
    Row("vo mav --cameras way/cameras.json --out path", r'give "TIME_NS,NAME", the name of a file in data',
        [write(mav__cam0__data_csv=EUROC)], "way", make=lambda box: euroc(box, EUROC + "late\n")),
    Row("vo mav --cameras way/cameras.json --out path",
        r"list both images of a pair at the same time, or remove its line", [write(mav__cam0__data_csv=EUROC)], "way",
        make=lambda box: euroc(box, EUROC.replace("2,", "3,"))),
    vo(r"put the images of the other eye beside it", "", moved("way/wrong", "way/right"),
       make=lambda box: (box / "way/right").rename(box / "way/wrong")),
    vo(r"put the images of one eye into it", "", done(lambda box: [
        image.rename(box / "way/right" / image.name) for image in (box / "kept").iterdir()]),
       make=lambda box: ((box / "way/right").rename(box / "kept"), (box / "way/right").mkdir())),
    vo(r"give both images of a pair the same name, or remove this one", "",
       moved("way/right/9.png", "way/right/000001.png"), make=lambda box: (box / "way/right/000001.png").rename(
           box / "way/right/9.png")),
    vo(r"give one time a pair, or remove the file", "", write(way__times_txt="0\n1\n2\n"),
       moved("way/times.txt", "way/old.txt"), make=lambda box: put(box / "way/times.txt", "0\n")),
    vo(r"give one time in every line, s", "", write(way__times_txt="0\n1\n2\n"),
       make=lambda box: put(box / "way/times.txt", "0 0\n1 1\n2 2\n")),
    vo(r"sort the lines by time, each time once", "", write(way__times_txt="0\n1\n2\n"),
       make=lambda box: put(box / "way/times.txt", "0\n2\n1\n")),
    vo(r"give images of one size", "", done(lambda box: shutil.copy(box / "way/left/000001.png",
                                                                     box / "way/right/000000.png"), VO),
       make=lambda box: put(box / "way/right/000000.png", netpbm(LEFT))),
    vo(r"give the images of the other eye", "", done(lambda box: shutil.copy(box / "way/right/000001.png",
                                                                              box / "way/right/000000.png"), VO),
       make=lambda box: shutil.copy(box / "way/left/000000.png", box / "way/right/000000.png")),
    vo(r'give "P0: " and "P1: " with the twelve numbers of each camera', "", write(way__calib_txt=KITTI),
       line="vo way --out path", make=lambda box: put(box / "way/calib.txt", "P0: 1 2\n")),
    vo(r'give "P0: " and "P1: " with the twelve numbers of each camera', "", write(way__calib_txt=KITTI),
       line="vo way --out path", make=lambda box: put(box / "way/calib.txt", KITTI.replace("0 0 1 0", "0 0 2 0"))),
    truth(r"give one pose a pair of the whole sequence, or poses with times \(TUM\)", POSE, TUM),
    truth(r"give one pose a pair of the whole sequence, or poses with times \(TUM\)", POSE, 3 * POSE),
    truth(r"give poses of the time in which the images were taken", "9 " + IDENTITY[2:] + "\n", TUM),
    truth(TWELVE, "1 2 3\n", 3 * POSE),
    truth(r"give the rows of \[R p\], twelve numbers, with a right-handed R", 3 * POSE.replace("1", "2"), 3 * POSE),
    truth(r'give "time x y z qx qy qz qw", the quaternion of length 1', "0 0 0 0 0 0 0 2\n", TUM),
    truth(r"sort the lines by time, each time once", TUM + TUM, TUM),
    truth(r"give a file of poses", "x 0 0 0 0 0 0 1\n", TUM),
    truth(r"give a file of poses", "# none\n", TUM),
    truth(r"name a file of poses; if it is of another encoding, save it as UTF-8", b"# caf\xe9\n" + TUM.encode(),
          "# café\n" + TUM),
    Row("vo list.txt --cameras way/cameras.json --out path --truth t.txt",
        r"add times.txt to the sequence, or give poses of KITTI's form", [write(t_txt=3 * POSE)], "way",
        files={"list.txt": LIST, "t.txt": TUM}),
    vo(r"add times.txt to the sequence, or give poses of KITTI's form", "--truth t.txt",
       done(lambda box: put(box / "way/times.txt", "0\n1\n2\n")), files={"t.txt": TUM},
       make=lambda box: os.remove(box / "way/times.txt")),
]

# ---- Boards

BOARD = {"rows": 6, "columns": 9, "spacing_m": 0.03}
TILTS = ((30, 0), (-30, 5), (5, 30), (-5, -30), (20, 20))  # deg, about the rows and about the columns


def placed(tilt):
    """Rotation and position of a board half a metre away."""
    about_x, about_y = np.radians(tilt)
    turn = (np.array([[1, 0, 0], [0, np.cos(about_x), -np.sin(about_x)], [0, np.sin(about_x), np.cos(about_x)]])
            @ np.array([[np.cos(about_y), 0, np.sin(about_y)], [0, 1, 0], [-np.sin(about_y), 0, np.cos(about_y)]]))
    return turn, np.array([0, 0, 0.5]) - turn @ [4 * BOARD["spacing_m"], 2.5 * BOARD["spacing_m"], 0]


def pose(tilt):
    """The same as a file of a target has it."""
    turn, position = placed(tilt)
    half = np.sqrt(1 + np.trace(turn)) / 2
    axis_part = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]) / (4 * half)
    return {"position_m": position.tolist(), "rotation_wxyz": [half, *axis_part.tolist()]}


def board(tilt, scale=1.0, size=(240, 320)):
    """What a camera sees of it."""
    turn, position = placed(tilt)
    plane = np.column_stack([turn[:, 0], turn[:, 1], position])
    columns, rows = np.meshgrid(np.arange(size[1]), np.arange(size[0]))
    rays = np.stack([(columns - 160) / 350, (rows - 120) / 350, np.ones_like(rows)])
    x, y, depth = np.tensordot(np.linalg.inv(plane), rays, 1)
    squares = np.floor(np.stack([x, y]) / depth / BOARD["spacing_m"]).astype(int)
    inside = (squares >= -1).all(0) & (squares[0] < BOARD["columns"]) & (squares[1] < BOARD["rows"])
    light = np.where(inside & (squares.sum(0) % 2 == 0), 30, 220)
    return scale * sum(np.roll(light, shift, (0, 1)) for shift in ((0, 0), (0, 1), (1, 0), (1, 1))) / 4


BOARDS = {f"{i}.pgm": netpbm(board(tilt)) for i, tilt in enumerate(TILTS)}
CALIBRATE = "calibrate 0.pgm 1.pgm 2.pgm 3.pgm 4.pgm --target b.json --out seen"
POSED = {"position_m": [0, 0, 0.5], "rotation_wxyz": [1, 0, 0, 0]}
SURVEYED = BOARD | {"poses": [pose(tilt) for tilt in TILTS]}
FEW_BOARDS = "calibrate 0.pgm 1.pgm --target b.json --out seen"
BETTER_BOARD = r"use a board with one of them odd and the other even, such as 6 by 9"


def calibrate(says, bad, *ways, line=CALIBRATE, **more):
    return Row(line, says, list(ways), files=BOARDS | {"b.json": BOARD} | bad, **more)


def target(says, **changed):
    """A row of a target that is refused; without what is changed it is a good one."""
    return calibrate(says, {"b.json": BOARD | changed}, write(b_json=BOARD))


def add_images(box, words, _):
    """The good boards beside those that are there."""
    more = []
    for name, image in BOARDS.items():
        put(box / f"more{name}", image)
        more.append(f"more{name}")
    return [[words[0], *more, *words[1:]]]


CALIBRATIONS = [
    calibrate(r"(rockyard calibrate IMAGE... --target FILE --out FOLDER); see rockyard calibrate --help", {},
              instead(CALIBRATE), line="calibrate 0.pgm"),
    calibrate(r"give the right image of each left one, in the same order", {}, drop("--right 4.pgm"),
              line=CALIBRATE.replace(" 4.pgm", "") + " --right 4.pgm"),
    calibrate(r"give each image once: it adds nothing the second time", {}, swap("0.pgm 0.pgm", "0.pgm"),
              line=CALIBRATE.replace("0.pgm", "0.pgm 0.pgm")),
    calibrate(r"give images of one size, as the cameras took them", {"4.pgm": netpbm(board(TILTS[4])[1:])},
              write(**{"4_pgm": BOARDS["4.pgm"]})),
    calibrate(r"show the whole board, sharp, with squares of 12 px or more, and check rows and columns",
              {"4.pgm": netpbm(np.full((240, 320), 90))}, write(**{"4_pgm": BOARDS["4.pgm"]})),
    calibrate(r"show the whole board, sharp, with squares of 12 px or more, and check rows and columns",
              {"b.json": BOARD | {"rows": 8}}, write(b_json=BOARD)),
    calibrate(r"the brightest sample is \d+ of 65535: (--white) (\d+) would keep more of the image",
              {f"{i}.pgm": netpbm(board(tilt), 65535) for i, tilt in enumerate(TILTS)},
              lambda _, words, said: [[*words, said[1], said[2]]]),
    calibrate(r"give at least 3 images, better 10, or survey the targets", {}, add_images, line=FEW_BOARDS),
    calibrate(r"tilt the target by 20 to 45 deg, about different axes, from image to image",
              {f"{i}.pgm": netpbm(board((30 + 0.3 * i, 0))) for i in range(3)},
              write(**{f"{i}_pgm": BOARDS[f"{i}.pgm"] for i in range(3)}), line=CALIBRATE.replace("3.pgm 4.pgm ", "")),
    calibrate(r"give more images, with the target tilted by 20 to 45 deg about different axes and all over the image",
              {f"{i}.pgm": netpbm(board(tilt)) for i, tilt in enumerate(((4, 0), (0, 4), (-4, 0)))}, add_images,
              line=CALIBRATE.replace("3.pgm 4.pgm ", "")),
    calibrate(r"survey targets at different distances or tilted against each other",
              {"b.json": BOARD | {"poses": 5 * [POSED]}}, write(b_json=SURVEYED)),
    calibrate(r"give one pose for each image, in their order, or leave poses out",
              {"b.json": BOARD | {"poses": [POSED]}}, write(b_json=BOARD)),
    calibrate(r"give a pose for each image, or leave it out", {"b.json": BOARD | {"poses": []}}, write(b_json=BOARD)),
    calibrate(r"give x, y and z in m", {"b.json": BOARD | {"poses": 5 * [{"rotation_wxyz": [1, 0, 0, 0]}]}},
              write(b_json=BOARD)),
    calibrate(r"give the unit quaternion w, x, y, z", {"b.json": BOARD | {"poses": 5 * [{"position_m": [0, 0, 1]}]}},
              write(b_json=BOARD)),
    target(r"count the corners where four squares meet", rows=2),
    target(r"count the corners where four squares meet", columns=0),
    target(r"give the side of a square in m", spacing_m=0),
    target(BETTER_BOARD, rows=7),
]

# ---- Files of JSON: what is wrong in each, and what the advice makes of it

NONE = {"name": "row"}
CHAIN = {f"x{i}.json": {"extends": f"x{i + 1}.json"} for i in range(20)} | {"x20.json": NONE}
WIDE = {f"y{i}.json": {"extends": [f"y{i + 1}.json"] * 8} for i in range(2)} | {"y2.json": NONE}
STRICT = r"write strict JSON: double quotes, no comments, no trailing commas, finite numbers"
MERGE = r"merge some of them"
SWEEP = {"name": "s", "axes": [{"path": "terrain.rocks.k_per_m2", "values": [0.004, 0.008]}]}
AXIS = SWEEP["axes"][0]
STUDIED = {"path": "sensors.stereo.max_range_m", "values": None}  # has a range of studies
SLOPES = {"path": "rover.mass.total_kg", "values": [19, 20]}


def axis(**changed):
    """A sweep of one axis."""
    return SWEEP | {"axes": [{key: value for key, value in (AXIS | changed).items() if value is not None}]}


DOCUMENTS = [
    # (what is wrong, the advice, what the advice makes of it)
    ('{"name": "a", "name": "b"}', r"keep one of the two", '{"name": "a"}'),
    ('{"name": "a",}', STRICT, '{"name": "a"}'),
    ("[" * 300 + "]" * 300, r"remove brackets that nothing reads", NONE),
    ({"extends": 3}, r"write a path relative to this file", {"extends": "x20.json"}),
    ({"extends": "none.json"}, r"check the name and the folder; it is relative to the file that extends it",
     {"extends": "x20.json"}),
    ({"extends": "list.json"}, r"name a file that holds an object", {"extends": "x20.json"}),
    ({"extends": "circle.json"}, r'remove one of the "extends"', NONE),
    ({"extends": "x0.json"}, MERGE, {"extends": "x10.json"}),
    ({"extends": "y0.json"}, MERGE, {"extends": "y2.json"}),
    ([1], r"write an object", NONE),
    ({"seed": "1"}, r"write an integer", {"seed": 1}),
    ({"seed": 1.5}, r"write an integer", {"seed": 1}),
    ({"seed": 1e18}, r"write an integer below (\d+)", {"seed": 10 ** 15}),
    ({"course": {"goal_x_m": "far"}}, r"write a number", {"course": {"goal_x_m": 7}}),
    ({"course": []}, r"write an object", {"course": {}}),
    ({"rover": {"contact": 3}}, r"write an object", {"rover": {}}),
    ({"course": {"tracking": {"enabled": 1}}}, r"write true or false", {"course": {"tracking": {"enabled": True}}}),
    ({"name": 1}, r"write a text", {"name": "1"}),
    ({"name": "n" * 10001}, r"use at most (\d+)", {"name": "n" * 10000}),
    ({"navigation": {"navigator": 1}}, r"write a name", {"navigation": {"navigator": "gestalt"}}),
    ({"navigation": {"navigator": "gestlt"}}, r'did you mean "(gestalt)"\? one of: .*',
     {"navigation": {"navigator": "gestalt"}}),
    ({"sensors": {"light_stripe": {"row_ahead_m": 1}}}, r"write a list of numbers", NONE),
    ({"sensors": {"light_stripe": {"row_ahead_m": ["x"]}}}, r"write a number", NONE),
    ({"cylinder_sighting": {"picture": {"light": {"sun": [1]}}}}, r"write 3 numbers",
     {"cylinder_sighting": {"picture": {"light": {"sun": [1, 1, 1]}}}}),
    ({"course": {"goal_x": 7}}, r'did you mean "(goal_x_m)"\? one of: .*', {"course": {"goal_x_m": 7}}),
    ({f"key{i}": 1 for i in range(120)}, r"correct these first", NONE),
    # Sweeps
    (SWEEP | {"name": ""}, r"give it a name", SWEEP),
    (SWEEP | {"name": "n" * 101}, r"use at most (100)", SWEEP | {"name": "n" * 100}),
    (SWEEP | {"name": "a\nb"}, r"use letters, digits and signs", SWEEP),
    (SWEEP | {"axes": 3}, r"write \[...\]", SWEEP),
    (SWEEP | {"set": 3}, r'write (\{"terrain.rocks.k_per_m2": 0.01\})', SWEEP | {"set": {"course.goal_x_m": 7}}),
    (SWEEP | {"scenario": 3}, r"name a scenario file, or write an object", SWEEP | {"scenario": "x20.json"}),
    (SWEEP | {"scenario": "sweep.json"}, r"name a scenario file", SWEEP | {"scenario": "x20.json"}),
    (SWEEP | {"scenario": "none.json"}, r"check the name and the folder", SWEEP | {"scenario": "x20.json"}),
    (axis(ablation="no_slip"), r"keep one of them", axis()),
    (axis(path=None), r"name a parameter, such as (terrain.rocks.k_per_m2)", axis()),
    (axis(values=None, ablation="no_slip"), r"remove it", axis(values=None, path=None, ablation="no_slip")),
    (axis(steps=3), r"remove from, to and steps", axis()),
    (axis(values=None, path=None, scenarios=[3]), r"write a path relative to this file",
     axis(values=None, path=None, scenarios=["x20.json"])),
    (axis(values=None, path="referee.time_limit_s"), r'write "values", or "from" and "to"',
     axis(path="referee.time_limit_s", values=[9000, 9999])),
    (axis(values=None, **{"from": 2, "to": 1, "steps": 2}), r"write the smaller value first", axis()),
    (axis(values=None, scale="log", **{"from": 0, "to": 0.01, "steps": 2}), r"use a positive value, or scale linear",
     axis(values=None, scale="linear", **{"from": 0, "to": 0.01, "steps": 2})),
    (axis(path="terrain.rocks"), r'name one of them, or write "levels"', axis()),
    (axis(path="terrain.rocks.k_per_m3"), r'did you mean "(terrain.rocks.k_per_m2)"\?', axis()),
    (axis(path="zzz"), r"rockyard parameters lists them", axis()),
    (axis(values=[0.004, 0.004]), r"keep one of them", axis(values=[0.004])),
    (SWEEP | {"axes": [axis(values=[i / 1e6 for i in range(400)])["axes"][0], SLOPES | {"values": [*range(9, 400)]}]},
     r'use fewer levels, or design sobol with "points"', SWEEP),
    (axis(**STUDIED), r'add "steps", or use design latin_hypercube or sobol', axis(**STUDIED, steps=2)),
    (axis(**STUDIED) | {"design": {"kind": "grid"}}, r'add "steps", or use design latin_hypercube or sobol',
     axis(**STUDIED) | {"design": {"kind": "sobol", "points": 2}}),
    (SWEEP | {"axes": [AXIS, AXIS | {"values": [0.003]}]}, r"give each axis a name of its own",
     SWEEP | {"axes": [AXIS, SLOPES]}),
    (axis(values=[0, 0.004]) | {"fit": {"scale": "log"}}, r"use scale linear, or leave that number out",
     axis() | {"fit": {"scale": "log"}}),
    (SWEEP | {"fit": {"axis": "k_per_m3"}}, r'did you mean "(k_per_m2)"\?', SWEEP | {"fit": {"axis": "k_per_m2"}}),
    ({"name": "s", "axes": [AXIS], "design": {"kind": "list"}}, r'write \[\{"name": ..., "set": \{...\}\}\]',
     {"name": "s", "cells": [{"name": "a", "set": {"course.goal_x_m": 7}}], "design": {"kind": "list"}}),
    ({"name": "s", "cells": [{"name": "a", "set": {}}]}, r"name at least one axis, or use design list",
     {"name": "s", "cells": [{"name": "a", "set": {}}], "design": {"kind": "list"}}),
    (SWEEP | {"cells": [{"name": "a", "set": {}}]}, r"remove it, or change design.kind", SWEEP),
    (SWEEP | {"axes": [AXIS | {"name": f"a{n}"} for n in range(101)], "design": {"kind": "sobol", "points": 2}},
     r"use at most (100)", axis() | {"design": {"kind": "sobol", "points": 2}}),
    (SWEEP | {"set": {"seed": 3}}, r'write "seed" beside "axes"', SWEEP | {"seed": 3}),
    (SWEEP | {"set": {"terrain.rocks.k_per_m2": 0.01}},
     r"another setting, axis or --set lies over it: keep one of them", SWEEP),
    (SWEEP | {"scenario": {"experiment": "hazard_detection"}}, r"use rockyard run, or sweep drives", SWEEP),
    (SWEEP | {"axes": [{"name": "one", "levels": [{"name": "a", "set": {}}, {"name": "b", "set": {}}]}]},
     r"a level has no effect: set another value, or leave the cell out",
     SWEEP | {"axes": [{"name": "one", "levels": [{"name": "a", "set": {}}]}]}),
    (axis(values=None, path=None, ablation="no_slipp"), r'did you mean "(no_slip)"\? one of: .*',
     axis(values=None, path=None, ablation="no_slip")),
]
BESIDE = CHAIN | WIDE | {"list.json": [1], "circle.json": {"extends": "circle.json"}, "sweep.json": SWEEP}

# ---- Values of a reference: what is wrong in each, and what the advice makes of it

COUNT = {"scenario": "nominal", "statistic": "outcome_count", "sample_size": 4, "value": 2,
         "outcomes": ["goal_reached"]}
LEAST = {"scenario": "nominal", "statistic": "minimum", "sample_size": 4, "value": 2, "column": "true_distance_m"}
MEAN = {"scenario": "nominal", "statistic": "mean", "column": "true_distance_m", "low": 1, "high": 2}
KINDS = {"scenario": "nominal", "statistic": "failure_kinds", "sample_size": 2,
         "kinds": [{"name": "no path", "outcomes": ["no_path"], "count": 2}]}
OFFSET = {"scenario": "nominal", "statistic": "median_offset", "sample_size": 4, "column": "true_distance_m",
          "other_scenario": "vl2", "other_sample_size": 3}
SUM = {"scenario": "nominal", "statistic": "ratio_sum", "low": 1, "high": 2,
       "terms": [{"columns": ["true_distance_m"], "of": "simulated_time_s"}]}
FORMULA = {"statistic": "computed", "formula": "any_of", "inputs": [0.1, 3], "low": 0, "high": 1}
COLUMN = r"name a column of the trial records"


def but(entry, /, **changed):
    return {key: kept for key, kept in (entry | changed).items() if kept is not None}


VALUES = [
    (but(COUNT, statistic=None), r'name what is compared, e.g. "(outcome_count)"', COUNT),
    (but(COUNT, statistic="outcome_cont"), r'did you mean "(outcome_count)"\? one of: .*', COUNT),
    (but(COUNT, id=""), r"give every value a name of its own", COUNT),
    (but(COUNT, id="twice"), r"give every value a name of its own", COUNT),
    (but(COUNT, scenario=None), r"name the scenario", COUNT),
    (but(COUNT, sample_size=None), r"give the number of published runs", COUNT),
    (but(COUNT, arrived=3), r"give it with negative_count, minimum, maximum, mode or exponential_tail", COUNT),
    (but(COUNT, outcomes=None), r"list the outcomes that count", COUNT),
    (but(LEAST, outcomes=["no_path"]), r"leave it out", LEAST),
    (but(LEAST, column=None), COLUMN, LEAST),
    (but(COUNT, column="true_distance_m"), r"leave it out", COUNT),
    (but(COUNT, other_scenario="nominal", other_sample_size=3), r"give both there, and leave both out elsewhere",
     COUNT),
    (but(OFFSET, other_scenario=None), r"give both there, and leave both out elsewhere", OFFSET),
    (but(COUNT, value=None), r"give the published number", COUNT),
    (but(KINDS, value=2), r"leave it out", KINDS),
    (but(COUNT, value=1.5), r"use a whole number from 0 to sample_size", COUNT),
    (but(KINDS, kinds=None), r"list the kinds of failure", KINDS),
    (but(COUNT, kinds=KINDS["kinds"]), r"leave it out", COUNT),
    (but(KINDS, sample_size=3), r"make the counts add up to the number of published failures", KINDS),
    (but(KINDS, kinds=[{"outcomes": ["no_path"], "count": 2}]), r"name the kind", KINDS),
    (but(KINDS, kinds=[{"name": "no path", "count": 2}]), r"list the outcomes of this kind", KINDS),
    (but(COUNT, outcomes=[3]), r"write the name of a trial outcome", COUNT),
    (but(COUNT, outcomes=["goal_reachd"]), r'did you mean "(goal_reached)"\? one of: .*', COUNT),
    (but(COUNT, outcomes=3), r"write a list", COUNT),
    (but(COUNT, outcome=["goal_reached"], outcomes=None), r'did you mean "(outcomes)"\? one of: .*', COUNT),
    (but(MEAN, where=[{"low": 1}]), COLUMN, MEAN),
    (but(COUNT, low=1), r"leave both out", COUNT),
    (but(COUNT, of="true_distance_m"), r"leave them out", COUNT),
    (but(COUNT, terms=SUM["terms"]), r"leave them out", COUNT),
    (but(COUNT, formula="any_of"), r"leave both out", COUNT),
    (but(MEAN, low=3), r"give one or both, the smaller one as low", MEAN),
    (but(MEAN, arrived=1), r"leave it out", MEAN),
    (but(MEAN, sample_size=1), r"leave it out", MEAN),
    (but(FORMULA, formula=None), r'name a closed form, e.g. "(any_of)"', FORMULA),
    (but(FORMULA, inputs=[0.1]), r"any_of takes chance and number; .*", FORMULA),
    (but(FORMULA, formula="power_law_cover", inputs=[1, 0, 1]),
     r"power_law_cover needs a size above 0 and an exponent above 2; .*",
     but(FORMULA, formula="power_law_cover", inputs=[1, 1, 3])),
    (but(FORMULA, column="true_distance_m"), r"leave them out", FORMULA),
    (but(MEAN, scenario=None), r"name the scenario", MEAN),
    (but(MEAN, terms=SUM["terms"]), r"give at least one there, leave them out elsewhere", MEAN),
    (but(MEAN, column=None), COLUMN + r"; those of a ratio_sum in its terms", MEAN),
    (but(MEAN, of="simulated_time_s"), r"give it there, leave it out elsewhere", MEAN),
    (but(MEAN, along="simulated_time_s"), r"give it there, leave it out elsewhere", MEAN),
    (but(MEAN, formula="any_of"), r"leave both out", MEAN),
    (but(SUM, terms=[{"of": "simulated_time_s"}]), r"name columns of the trial records", SUM),
    (but(SUM, terms=[{"columns": ["true_distance_m"]}]), r"name the column of the base", SUM),
    (but(SUM, terms=[{"columns": [3], "of": "simulated_time_s"}]), COLUMN, SUM),
]
REFERENCE = {"schema_version": 1, "title": "rows", "values": []}
HEADS = [
    (but(REFERENCE, schema_version=None), r"write 1"),
    (but(REFERENCE, values=[]), r"list at least one"),
    (but(REFERENCE, values=3), r"write a list"),
    (but(REFERENCE, values=None, valuse=[]), r'did you mean "(values)"\? one of: .*'),
    (but(REFERENCE, scenarios=[{"file": "a.json"}]), r"name the scenario"),
    (but(REFERENCE, scenarios=[{"name": "a"}]), r"name its file, relative to the reference"),
]

# ---- Parameters of a scenario: over a shipped one, what is set, the advice, and what it makes of it

OBEY = "as it says"
LEFT_OUT = None
C, D, H, M, S3 = "cylinder_sighting.", "dead_reckoning.", "hazard_detection.", "mission.", "stereo_sensing."
L, ST, G, P = "sensors.light_stripe.", "sensors.stereo.", "navigation.gestalt.", "navigation.pathfinder."
V = "perception.visual_odometry."
R, T, A = "terrain.rocks.", "three_rock_run.prior.", "terrain.arena."
MANY = [1 + 0.01 * i for i in range(100)]
PARAMETERS = [
    # (base, what is set, the advice, what it makes of it)
    ("cylinder/views", {C + "distances_m": []}, "list at least one, e.g. 5", {C + "distances_m": [5]}),
    ("cylinder/views", {C + "orientations_deg": MANY, C + "distances_m": [5 + 0.01 * i for i in range(10)]},
     "shorten the lists", {C + "orientations_deg": [10], C + "distances_m": [5]}),
    ("cylinder/views", {C + "picture.clutter.farthest_m": 100}, "move the hills away",
     {C + "picture.backdrop.horizon_distance_m": 200}),
    ("cylinder/views", {C + "distances_m": [0.5]}, "use longer distances or a smaller largest_bearing_deg",
     {C + "distances_m": [3]}),
    ("cylinder/views", {C + "picture.clutter.largest_m": 0.01}, "use at least smallest_m",
     {C + "picture.clutter.largest_m": 0.05}),
    ("cylinder/views", {C + "picture.clutter.farthest_m": 1.1}, "use more", {C + "picture.clutter.farthest_m": 20}),
    ("cylinder/views", {C + "published.classes.red.first_low": 9}, "give a larger one",
     {C + "published.classes.red.first_high": 10}),
    ("cylinder/views", {C + "published.classes.red.second_low": 9}, "give a larger one",
     {C + "published.classes.red.second_high": 10}),
    ("localization/straight_sand", {D + "distances_m": []}, "give every list at least one value, 0 for an error",
     {D + "distances_m": [10]}),
    ("localization/straight_sand", {D + "distances_m": [0.01]}, "walk at least one step", {D + "distances_m": [1]}),
    ("localization/straight_sand", {D + "distances_m": MANY, D + "rests_s": MANY}, "shorten the lists",
     {D + "rests_s": [0]}),
    ("localization/straight_sand", {"localization.estimator": "oracle"}, "use dead_reckoning", OBEY),
    ("localization/designation", {"designation.ranges_m": []}, "list at least one range, e.g. 10",
     {"designation.ranges_m": [10]}),
    ("localization/designation", {"designation.image_side_px": 16}, r"use longer ranges, larger images .image_side_px.",
     {"designation.image_side_px": 256}),
    ("hazard_detection/detection", {H + "heights_m": []}, "list at least one value", {H + "heights_m": [0.1]}),
    ("hazard_detection/detection", {H + "heights_m": [0.000001]}, "use 0 for no rock, or at least",
     {H + "heights_m": [0.05]}),
    ("hazard_detection/detection", {H + "distances_m": [0.1], H + "distance_width_m": 1},
     "use distances of at least half of distance_width_m", {H + "distances_m": [0.5]}),
    ("hazard_detection/detection", {H + "first_scan_m": 0.01}, "start at least one interval before the rock",
     {H + "first_scan_m": 0.4}),
    ("hazard_detection/detection", {H + "heights_m": MANY, H + "lateral_offsets_m": MANY},
     "shorten the lists of this study", {H + "lateral_offsets_m": [0]}),
    ("hazard_detection/detection", {"sensors.terrain_sensor": "stereo"}, "use light_stripe", OBEY),
    ("hazard_detection/detection", {"terrain.ground.slope_deg": 5, R + "pointedness": 0}, "leave the ground flat",
     {"terrain.ground.slope_deg": LEFT_OUT}),
    ("hazard_detection/detection", {"perception.hazard.agreement": "consecutive_moving"},
     "use rescan_same_pose or single_scan", OBEY),
    ("hazard_detection/precision", {H + "rows": [6]}, "count its rows from 0", {H + "rows": [0]}),
    ("hazard_detection/missed", {R + "kind": "none"}, "use kind moore", {R + "kind": "moore"}),
    ("hazard_detection/missed", {H + "rock_k_per_m2": [0.05]},
     "raise k_reference_per_m2 to at least the largest value of the list", {R + "k_reference_per_m2": 0.05}),
    ("hazard_detection/missed", {"course.goal_y_m": 1}, "use start_y_m, and a heading of 0",
     {"course.goal_y_m": 0, "course.start_heading_deg": 0}),
    ("hazard_detection/missed", {"course.waypoints.x_m": [3], "course.waypoints.y_m": [0]}, "leave the waypoints out",
     {"course.waypoints": LEFT_OUT}),
    ("hazard_detection/missed", {"course.goal_x_m": 0.3}, "move the goal away, or begin to scan later",
     {"course.goal_x_m": 7}),
    ("hazard_detection/precision", {L + "emitter_height_m": 0.24},
     "use emitter_height_m = camera_height_m and emitter_x_m = camera_x_m", {L + "emitter_height_m": 0.25}),
    ("hazard_detection/precision", {H + "baselines_m": [1]}, "use shorter baselines, or move the stripes",
     {H + "baselines_m": [0.08]}),
    ("hazard_detection/precision", {H + "plane_heights_m": [3]}, "use heights between its search_low_m and search_high",
     {H + "plane_heights_m": [0]}),
    ("hazard_detection/false_alarm", {H + "sun_elevations_deg": [30]},
     "use sensors.light_stripe.fidelity image, or leave the lists empty", {H + "sun_elevations_deg": []}),
    ("hazard_detection/false_alarm_image", {H + "wrong_place_probabilities": [0.1]},
     "leave both lists empty, or use sensors.light_stripe.fidelity geometric", {H + "wrong_place_probabilities": []}),
    ("mission/level", {M + "goals.x_m": [], M + "goals.y_m": []}, "list x and y of every goal, one at least",
     {M + "goals.x_m": [20], M + "goals.y_m": [0]}),
    ("mission/level", {A + "kind": "virtual_reflected"}, "use open", OBEY),
    ("mission/level", {R + "mobility": "movable", "rover.fidelity": "multibody", "rover.physics.time_scale": 1},
     "use fixed", OBEY),
    ("mission/level", {M + "goals.x_m": [500]}, "move it or enlarge the arena", {M + "goals.x_m": [20]}),
    ("mission/level", {M + "goals.x_m": [1.5], M + "goals.y_m": [0]}, "use a goal that has to be driven to",
     {M + "goals.x_m": [20]}),
    ("mission/level", {"course.waypoints.x_m": [10], "course.waypoints.y_m": [0]}, "list them in mission.goals",
     {"course.waypoints": LEFT_OUT, M + "goals.x_m": [10, 50], M + "goals.y_m": [0, 0]}),
    ("mission/level", {"course.tracking.enabled": True}, "use false", OBEY),
    ("mission/level", {"course.goal_rock.enabled": True}, "use false", OBEY),
    ("mission/level", {"course.target_speed_m_s": 0.1}, "use 0", OBEY),
    ("mission/level", {"course.route_map.use": "waypoints"}, "use navigator, and pathfinder or gestalt",
     {"course.route_map.use": "navigator"}),
    ("mission/level", {"clock.overlap.imaging": True}, "turn all of clock.overlap off", {"clock.overlap": LEFT_OUT}),
    ("mission/level", {"referee.stuck_rover": "run_on"}, "use end", OBEY),
    ("mission/level", {M + "day.rover_images": 10000}, "use fewer or smaller images, more compression",
     {M + "day.rover_images": 1}),
    ("mission/level", {"sensors.aids.sun.latitude_deg": 90}, "use another latitude or areocentric_longitude_deg",
     {"sensors.aids.sun.latitude_deg": 20}),
    ("mission/level", {M + "lander_update": "noon", "localization.estimator": "dead_reckoning"},
     "use evening, or estimator error_state", {M + "lander_update": "evening"}),
    ("stereo_sensing/range", {S3 + "distances_m": [1]}, "list at least a nearest and a farthest distance",
     {S3 + "distances_m": [1, 2]}),
    ("stereo_sensing/range", {S3 + "distances_m": [2, 1]}, "list every edge once, from the nearest to the farthest",
     {S3 + "distances_m": [1, 2]}),
    ("stereo_sensing/range", {"terrain.ground.slope_deg": 5}, "leave the ground flat",
     {"terrain.ground.slope_deg": LEFT_OUT}),
    ("stereo_sensing/range", {R + "pointedness": 0.5}, "use 0", OBEY),
    ("stereo_sensing/range", {S3 + "soil_graininess": [0.001 * i for i in range(60)],
                              S3 + "sun_elevations_deg": [i for i in range(60)]}, "shorten the lists",
     {S3 + "sun_elevations_deg": []}),
    ("stereo_sensing/range", {"sensors.terrain_sensor": "light_stripe"}, "use stereo", OBEY),
    ("stereo_sensing/range", {ST + "fidelity": "ideal"}, "use image or error_model", OBEY),
    ("stereo_sensing/range", {ST + "field_of_view": "stripe"}, "use full", OBEY),
    ("stereo_sensing/range", {"navigation.navigator": "pathfinder"}, "use gestalt", OBEY),
    ("stereo_sensing/range", {S3 + "distances_m": [1, 19]}, "end the bins at max_range_m, or raise it",
     {S3 + "distances_m": [1, 3]}),
    ("stereo_sensing/range", {S3 + "baselines_m": [1.9]}, "use shorter baselines, or search larger disparities",
     {S3 + "baselines_m": [0.1]}),
    ("localization/three_rock_run", {T + "goal_m": [8, 7]}, "give the lowest value first, then the highest",
     {T + "goal_m": [7, 8]}),
    ("localization/three_rock_run", {"sensors.terrain_sensor": "stereo", R + "pointedness": 0}, "use light_stripe",
     OBEY),
    ("localization/three_rock_run", {"navigation.navigator": "gestalt"}, "use pathfinder", OBEY),
    ("localization/three_rock_run", {R + "kind": "moore"}, "use none", OBEY),
    ("localization/three_rock_run", {R + "mobility": "movable", "rover.fidelity": "multibody", R + "pointedness": 0},
     "use fixed", OBEY),
    ("localization/three_rock_run", {"terrain.ground.slope_deg": 5}, "leave the ground flat",
     {"terrain.ground.slope_deg": LEFT_OUT}),
    ("localization/three_rock_run", {A + "kind": "virtual_reflected"}, "use open", OBEY),
    ("localization/three_rock_run", {"course.goal_y_m": 1},
     "start at 0, 0 with heading 0, and leave waypoints out", {"course.goal_y_m": LEFT_OUT}),
    ("localization/three_rock_run", {T + "goal_m": [7, 90]}, "lengthen the arena, or bring the goal nearer",
     {T + "goal_m": [7, 8]}),
    ("visual_odometry/steps_hazcam", {"visual_motion.steps_m": []}, "give both at least one value, 0 for no way",
     {"visual_motion.steps_m": [0]}),
    ("visual_odometry/steps_hazcam", {"visual_motion.steps_m": MANY, "visual_motion.turns_deg": MANY},
     "shorten the lists", {"visual_motion.turns_deg": [0]}),
    ("visual_odometry/steps_hazcam", {"terrain.ground.slope_deg": 5, R + "pointedness": 0}, "leave the ground flat",
     {"terrain.ground.slope_deg": LEFT_OUT}),
    ("gestalt/abundance", {G + "plan.plan_min_dist_m": 6, G + "plan.plan_max_dist_m": 7},
     "use a smaller plan_min_dist_m or a larger map", {G + "plan.plan_min_dist_m": 0.3}),
    ("gestalt/abundance", {G + "drive.step_m": 4}, "use a smaller step_m or a larger plan.plan_max_dist_m",
     {G + "drive.step_m": 0.3}),
    ("continuous/csad", {G + "continuous.motion_m": 4}, "use a smaller motion_m or a larger plan.plan_max_dist_m",
     {G + "continuous.motion_m": 1}),
    ("continuous/csad", {G + "continuous.motion_m": 4, G + "plan.plan_max_dist_m": 5},
     "use a smaller motion_m or a larger splines.length_m", {G + "continuous.motion_m": 1}),
    ("gestalt/abundance", {G + "drive.max_fruitless_cycles": 1},
     "use at least search_turn_deg / point_turn_amount_deg cycles", {G + "drive.max_fruitless_cycles": 4}),
    ("gestalt/abundance", {G + "map.grid.xN_m": 1}, "set bounds at least two vehicle lengths apart, better those of",
     {G + "map.grid.xN_m": 10}),
    ("gestalt/abundance", {G + "map.grid_dist_timeout_m": 0.5}, "use at least the vehicle's length, better plan_max",
     {G + "map.grid_dist_timeout_m": 3}),
    ("gestalt/abundance", {G + "map.outliers_per_cell": 8, G + "map.grid.xstep_m": 0.05, G + "map.grid.ystep_m": 0.07},
     "use fewer outliers, larger cells or closer bounds", {G + "map.outliers_per_cell": 0}),
    ("gestalt/abundance", {G + "map.grid.xN_m": 0.2}, "enlarge xN_m - x0_m", {G + "map.grid.xN_m": 10}),
    ("gestalt/abundance", {G + "map.grid.yN_m": 0.2}, "enlarge yN_m - y0_m", {G + "map.grid.yN_m": 10}),
    ("gestalt/abundance", {G + "map.grid.xN_m": 900}, "use larger cells or closer bounds", {G + "map.grid.xN_m": 10}),
    ("gestalt/abundance", {G + "speed.slow_curvature_per_m": 0.1, G + "speed.full_speed_curvature_per_m": 0.2},
     "use a larger slow_curvature_per_m or a smaller full_speed", {G + "speed.slow_curvature_per_m": 1}),
    ("gestalt/abundance", {G + "splines.waypoint_m": 9}, "use a smaller waypoint_m or a larger length_m",
     {G + "splines.waypoint_m": 2}),
    ("gestalt/abundance", {G + "plan.plan_max_dist_m": 0.2}, "use a larger value", {G + "plan.plan_max_dist_m": 3}),
    (NOMINAL, {P + "left_stripes": [0, 2]}, "use left .0, 1., centre .2., right .3, 4.",
     {P + "left_stripes": [0, 1]}),
    (NOMINAL, {P + "tight_arc_radius_m": 2}, "use a value up to wide_arc_radius_m", {P + "tight_arc_radius_m": 1.5}),
    (NOMINAL, {P + "tight_arc_bearing_deg": 1}, "use a value from heading_deadband_deg up",
     {P + "tight_arc_bearing_deg": 5}),
    (NOMINAL, {P + "point_turn_bearing_deg": 20}, "use a value from tight_arc_bearing_deg up",
     {P + "point_turn_bearing_deg": 30}),
    (NOMINAL, {"navigation.route.point_turn_bearing_deg": 1.6},
     "use a value from heading_deadband_deg up", {"navigation.route.point_turn_bearing_deg": 2}),
    (NOMINAL, {"perception.cloud_elevations.far_m": 0.001}, "use a larger value",
     {"perception.cloud_elevations.far_m": 1}),
    (NOMINAL, {"perception.hazard.on_exhausted": "scan_again"},
     "use trust_last, treat_as_hazard or treat_as_clear", OBEY),
    (NOMINAL, {"perception.stereo.window_side_px": 21, "perception.stereo.dog.limit": 127},
     "use a smaller window or a lower limit", {"perception.stereo.window_side_px": 7}),
    (NOMINAL, {"perception.stereo.dog.narrow_side_px": 2}, "use 1, 3 or 5", OBEY),
    (NOMINAL, {"perception.stereo.dog.wide_side_px": 8}, "use 7, 9, 11, 13 or 15", OBEY),
    (NOMINAL, {"perception.stereo.dog.wide_side_px": 3, "perception.stereo.dog.narrow_side_px": 5},
     "use a square that is two to four times as wide", {"perception.stereo.dog.wide_side_px": 15}),
    (NOMINAL, {V + "matcher.window_px": 8}, "use 15", OBEY),
    (NOMINAL, {V + "placement.window_px": 8}, "use 9 or 15", OBEY),
    (NOMINAL, {V + "detector.min_threshold": 2000}, "use a value up to threshold",
     {V + "detector.min_threshold": 1000}),
    (NOMINAL, {V + "detector.min_features": 26}, "use a value up to max_features", {V + "detector.min_features": 25}),
    (NOMINAL, {V + "placement.max_disparity_px": 4}, "search more disparities",
     {V + "placement.max_disparity_px": 40}),
    (NOMINAL, {V + "placement.source": "disparity_map", V + "placement.max_disparity_px": 900},
     "search fewer disparities, or take places from the right eye", {V + "placement.source": "right_eye"}),
    (NOMINAL, {V + "placement.map.window_side_px": 8},
     "a window of even side lies half a pixel beside its pixel; use 5, 7", {V + "placement.map.window_side_px": 5}),
    (NOMINAL, {V + "placement.map.window_side_px": 21, V + "placement.map.dog.limit": 127},
     "use a smaller window or a lower limit", {V + "placement.map.window_side_px": 7}),
    (NOMINAL, {"perception.stripe_finder.averaging_px": 2}, "use 1, 3, 5 or 7", OBEY),
    (NOMINAL, {L + "imager.exposure.longest_s": 0.00001}, "use a value of shortest_s or more",
     {L + "imager.exposure.longest_s": 0.2}),
    (NOMINAL, {"sensors.look.drift.finest_wavelength_m": 1, "sensors.look.drift.longest_wavelength_m": 0.1},
     "use a value of longest_wavelength_m or less", {"sensors.look.drift.finest_wavelength_m": 0.1}),
    (NOMINAL, {ST + "images.camera.vignetting_c2": -1}, "use c2 . c4 above -1",
     {ST + "images.camera.vignetting_c2": -0.2}),
    (NOMINAL, {"rover.geometry.wheelbase_m": 0.6}, "use at most length_m less two wheel radii",
     {"rover.geometry.wheelbase_m": 0.52}),
    (NOMINAL, {"rover.geometry.wheelbase_m": 0.2},
     "use more than four wheel radii plus twice the offset", {"rover.geometry.wheelbase_m": 0.52}),
    (NOMINAL, {"rover.geometry.rocker_pivot_x_m": -1}, "put it between bogie pivot and outer wheel",
     {"rover.geometry.rocker_pivot_x_m": -0.015}),
    (NOMINAL, {"rover.geometry.width_m": 0.3}, "reduce wheel_width_m or arm_y_m",
     {"rover.geometry.arm_y_m": 0.06, "rover.geometry.wheel_width_m": 0.06}),
    (NOMINAL, {"rover.geometry.height_m": 0.1}, "reduce belly_clearance_m",
     {"rover.geometry.belly_clearance_m": 0.05}),
    (NOMINAL, {"rover.drive.speed_m_s": 0.9, "rover.fidelity": "quasi_static"},
     "use fidelity multibody, or a slower rover", {"rover.fidelity": "multibody"}),
    (NOMINAL, {"rover.physics.time_scale": 900, "rover.fidelity": "multibody"}, "use at most .*, or 1", OBEY),
    (NOMINAL, {"rover.physics.time_scale": 900, "rover.drive.speed_m_s": 0.9}, "use 1", OBEY),
    (NOMINAL, {"rover.mass.total_kg": 1}, "raise it or reduce the parts", {"rover.mass.total_kg": 20}),
    ("mission/lander_noon", {"sensors.aids.sun.enabled": True, "sensors.aids.sun.every_m": 0},
     "set one of them, or turn the aid off", {"sensors.aids.sun.enabled": False}),
    (NOMINAL, {L + "row_ahead_m": [0.3, 0.1, 0.2, 0.4]}, "use rows 0.1, 0.1667, 0.2333, 0.3 and mount",
     {L + "row_ahead_m": [0.1, 0.1667, 0.2333, 0.3]}),
    (NOMINAL, {L + "search_high_m": 1}, "use a value below camera_height_m and emitter_height_m",
     {L + "search_high_m": 0.2}),
    (NOMINAL, {L + "missed_at": [0.1]}, "give rows times stripes values, or none", {L + "missed_at": []}),
    ("gestalt/abundance", {ST + "fidelity": "image", ST + "images.pyramid_level": 4, ST + "columns": 512},
     "use a lower level, or fewer columns and rows", {ST + "images.pyramid_level": 0}),
    ("gestalt/abundance", {ST + "fidelity": "image", ST + "max_disparity_px": 600},
     "search fewer disparities, at a higher images.pyramid_level", {ST + "max_disparity_px": 100}),
    ("gestalt/abundance", {ST + "max_disparity_px": 0.1}, "use a larger value", {ST + "max_disparity_px": 16}),
    ("gestalt/abundance", {ST + "max_disparity_px": 0.6}, "search larger disparities, or use a shorter baseline",
     {ST + "max_disparity_px": 16}),
    ("gestalt/abundance", {ST + "stripe_window.far_m": 0.1}, "use a larger value", {ST + "stripe_window.far_m": 1}),
    ("gestalt/abundance", {ST + "stripe_window.half_width_m": 0}, "use a positive value",
     {ST + "stripe_window.half_width_m": 0.3}),
    (NOMINAL, {"perception.cloud_elevations.half_width_m": 0}, "use a positive value",
     {"perception.cloud_elevations.half_width_m": 0.3}),
    ("gestalt/abundance", {ST + "front.pitch_deg": -90}, "look further down, mount the cameras lower, or widen",
     {ST + "front.pitch_deg": 45}),
    ("gestalt/abundance", {ST + "field_of_view": "stripe", ST + "stripe_window.far_m": 19,
                           ST + "stripe_window.near_m": 18},
     "move the window or the cameras", {ST + "stripe_window.near_m": 0.9, ST + "stripe_window.far_m": 1.3}),
    (NOMINAL, {L + "imager.averaging_rows": 4}, "use 5", OBEY),
    (NOMINAL, {L + "columns": 16384, L + "rows": 16384}, "use 768 columns and 484 rows, or 4096 by 4096",
     {L + "columns": 768, L + "rows": 484}),
    (NOMINAL, {L + "focal_length_m": 0.0005}, "use a longer focal_length_m or a smaller active_width_m",
     {L + "focal_length_m": 0.0048}),
    (NOMINAL, {L + "lens": "equidistant", L + "laser.fan": "three_scanlines"},
     "use lens equidistant_rows or pinhole, or the full fan", {L + "laser.fan": "full"}),
    (NOMINAL, {L + "camera_pitch_deg": 0}, "tilt the cameras towards the rows or use a shorter focal",
     {L + "camera_pitch_deg": 45}),
    (NOMINAL, {L + "outer_stripe_y_m": 3}, "move the stripes inwards or use a shorter focal_length_m",
     {L + "outer_stripe_y_m": 0.37}),
    (NOMINAL, {L + "fan_rad": 0.05}, "use a wider fan or bring the rows closer together", {L + "fan_rad": 1}),
    (NOMINAL, {L + "max_range_m": 0.1}, "use a larger max_range_m", {L + "max_range_m": 1}),
    (NOMINAL, {L + "camera_x_m": 0}, "mount cameras and emitters 5 to 10 cm apart", {L + "camera_x_m": 0.27}),
    (NOMINAL, {L + "fidelity": "image", L + "imager.margin_rows": 256},
     "tilt the cameras towards the rows, or average and read fewer lines", {L + "imager.margin_rows": 0}),
    ("visual_odometry/visual_drive", {"sensors.visual_odometry.schedule.every_m": 0,
                                      "sensors.visual_odometry.schedule.every_deg": 0},
     "set every_m, every_deg or every_s", {"sensors.visual_odometry.schedule.every_m": 0.5}),
    (NOMINAL, {"sensors.encoders.physics_variance_m2_per_m": 0.5},
     "use a value up to distance_variance_m2_per_m", {"sensors.encoders.physics_variance_m2_per_m": 0.0001}),
    (NOMINAL, {"clock.scan_fixed_s": 30}, "use a value up to scan_time_s", {"clock.scan_fixed_s": 20}),
    ("courses/ditch", {"terrain.ground.ditches.width_m": [1, 1]}, "give every list one entry for each place",
     {"terrain.ground.ditches.width_m": [1]}),
    ("courses/ditch", {"terrain.ground.ditches.flank_m": [40]}, "use at most half of the width",
     {"terrain.ground.ditches.flank_m": [0.25]}),
    ("courses/ditch", {"terrain.ground.ditches.length_m": [0.05]},
     "use at least the width, or 0 for a ditch without an end", {"terrain.ground.ditches.length_m": [0]}),
    (NOMINAL, {R + "listed.x_m": [3], R + "listed.y_m": []},
     "give every rock one entry of each list",
     {R + "listed.y_m": [1], R + "listed.diameter_m": [0.3], R + "listed.height_m": [0.2]}),
    (NOMINAL, {R + "k_per_m2": 0.05}, "raise k_reference_per_m2 to at least k_per_m2",
     {R + "k_reference_per_m2": 0.05}),
    (NOMINAL, {R + "max_diameter_m": 0.05}, "use a larger max_diameter_m", {R + "max_diameter_m": 1}),
    (NOMINAL, {R + "uniform_max_diameter_m": 0.05}, "use uniform_min_diameter_m or more",
     {R + "uniform_max_diameter_m": 0.25}),
    (NOMINAL, {R + "kind": "uniform_count", R + "count": 1000},
     "use fewer or smaller rocks, or a larger count area", {R + "count": 5}),
    (NOMINAL, {R + "max_width_ratio": 0.2}, "use min_width_ratio or more", {R + "max_width_ratio": 0.7}),
    (NOMINAL, {R + "max_height_ratio": 0.2}, "use min_height_ratio or more", {R + "max_height_ratio": 0.8}),
    (NOMINAL, {R + "burial_spread": 0.4}, "use a smaller burial_spread", {R + "burial_spread": 0.1}),
    (NOMINAL, {R + "burial_mean": 0.5}, "use burial_mean plus burial_spread of at most 0.5, or a pointed",
     {R + "burial_mean": 0.4}),
    (NOMINAL, {R + "kind": "uniform_count", R + "overlap": "reject"}, "use relocate or allow", OBEY),
    (NOMINAL, {"terrain.ground.slope_deg": 5, A + "kind": "open"},
     "use 0, or ground.slope_deg 0, ground.roughness_rms_m 0", {R + "pointedness": 0}),
    (NOMINAL, {R + "mobility": "movable"}, "use 0, or rocks.mobility fixed", {R + "mobility": "fixed"}),
    (NOMINAL, {A + "mirror_margin_m": 1.9}, "use a value below half the width less 0.25 m",
     {A + "mirror_margin_m": 0.9}),
    (NOMINAL, {A + "mirror_margin_m": 1.5}, "use a value of up to a third of the width",
     {A + "mirror_margin_m": 1.3}),
    (NOMINAL, {R + "kind": "uniform_count", R + "count_area_x_m": 50},
     "keep count_area_x_m, count_area_length_m and count_area_width_m", {R + "count_area_x_m": -0.2}),
    (NOMINAL, {R + "min_diameter_m": 0.02, A + "kind": "open", A + "length_m": 900, A + "width_m": 900},
     "use a larger min_diameter_m, a smaller k_per_m2 or cover, or a smaller arena",
     {A + "length_m": 12, A + "width_m": 4, R + "min_diameter_m": 0.1}),
    (NOMINAL, {A + "kind": "open", A + "length_m": 1000, A + "width_m": 1000, R + "k_per_m2": 0.00001,
                            R + "k_reference_per_m2": 0.1, R + "min_diameter_m": 0.1},
     "use a k_reference_per_m2 nearer to k_per_m2, a larger min_diameter_m", {R + "k_reference_per_m2": 0.00001}),
    (NOMINAL, {A + "kind": "open", A + "length_m": 1000, A + "width_m": 1000, R + "kind": "golombek", R + "cover": 0.001},
     "use a cover_reference nearer to cover, a larger min_diameter_m", {R + "cover_reference": 0.001}),
    (NOMINAL, {R + "clusters_per_m2": 0.01, R + "overlap": "allow"}, "use 0 for rocks without clusters", {R + "clusters_per_m2": 0}),
    (NOMINAL, {R + "clusters_per_m2": 1, R + "cluster_radius_m": 0.1},
     "use a larger cluster_radius_m, a larger clusters_per_m2 or overlap allow", {R + "cluster_radius_m": 0.2}),
    (NOMINAL, {R + "cover": 0.45}, "raise cover_reference to at least cover", {R + "cover_reference": 0.45}),
    (NOMINAL, {R + "kind": "listed", R + "listed.x_m": [3], R + "listed.y_m": [0], R + "listed.diameter_m": [0.5],
               R + "listed.height_m": [0.2], R + "listed.rest": "golombek"},
     "use at most 0.5, the smallest of listed.diameter_m", {R + "max_diameter_m": 0.5}),
    (NOMINAL, {R + "kind": "listed", R + "listed.x_m": [3], R + "listed.y_m": [0], R + "listed.diameter_m": [0.5],
               R + "listed.height_m": [0.2], R + "listed.buried_share": [0.6]},
     "use shares of at most 0.5, or a pointedness of 0", {R + "listed.buried_share": [0.5]}),
    (NOMINAL, {"course.waypoints.x_m": [3]}, "give every waypoint one entry of each list",
     {"course.waypoints.y_m": [0]}),
    (NOMINAL, {"course.goal_x_m": 0}, "use a goal that the rover has to drive to, e.g. 7.6",
     {"course.goal_x_m": 7.6}),
    (NOMINAL, {"course.waypoints.x_m": [0], "course.waypoints.y_m": [0]},
     "leave it out, or move it to where the rover has to drive to", {"course.waypoints": LEFT_OUT}),
    (NOMINAL, {R + "kind": "listed", R + "listed.x_m": [0.1], R + "listed.y_m": [0],
                            R + "listed.diameter_m": [0.3], R + "listed.height_m": [0.2]},
     "move the rock or the course, or use a smaller clear_radius_m", {R + "listed.x_m": [4]}),
    ("courses/ditch", {R + "kind": "listed", R + "listed.x_m": [3.2], R + "listed.y_m": [0],
                       R + "listed.diameter_m": [0.3], R + "listed.height_m": [0.2]},
     "place it beside, or whole on the level floor", {R + "listed.x_m": [4]}),
    (NOMINAL, {"course.designation.enabled": True, "course.designation.pixel_sd_px": 100},
     "use a wider arena, another kind, a nearer lander or smaller errors", {A + "kind": "open"}),
    (NOMINAL, {"navigation.navigator": "gestalt", G + "map.rover.length_m": 2.9},
     'use the size of the rover, e.g. "extends": scenarios/navigation/gestalt_rocky_3_2.json in navigation.gestalt',
     {G + "map.rover.length_m": LEFT_OUT, G + "extends": str(PROJECT / "scenarios/navigation/gestalt_rocky_3_2.json")}),
    ("gestalt/abundance", {"terrain.ground.slope_deg": 40}, "use at most .* deg, or a soil of more friction", OBEY),
    ("courses/ditch", {"terrain.ground.ditches.x_m": [0]}, "move it, or course.start_x_m and course.start_y_m",
     {"terrain.ground.ditches.x_m": [3.5]}),
    (NOMINAL, {"navigation.navigator": "route", "course.waypoints.x_m": [3], "course.waypoints.y_m": [0]},
     "use navigator pathfinder or gestalt, or a course without waypoints", {"navigation.navigator": "pathfinder"}),
    (NOMINAL, {"navigation.navigator": "route", "course.tracking.enabled": True},
     "use navigator pathfinder or gestalt, or no tracking", {"course.tracking.enabled": False}),
    (NOMINAL, {"navigation.navigator": "route", "course.route_map.use": "waypoints"},
     "use navigator, or navigation.navigator pathfinder or gestalt, which", {"course.route_map.use": "navigator"}),
    (NOMINAL, {"course.route_map.use": "waypoints", "course.waypoints.x_m": [3], "course.waypoints.y_m": [0]},
     "use a course without waypoints, or navigator", {"course.route_map.use": "navigator"}),
    (NOMINAL, {"course.route_map.use": "waypoints", "course.tracking.enabled": True},
     "use navigator, or no tracking", {"course.route_map.use": "navigator"}),
    (NOMINAL, {"course.route_map.source": "lander"},
     "use waypoints, navigation.navigator route, or oracle", {"course.route_map.source": "oracle"}),
    (NOMINAL, {"course.route_map.source": "lander", "navigation.navigator": "route"},
     "use course.designation.enabled true, or oracle", {"course.designation.enabled": True}),
    (NOMINAL, {"course.target_speed_m_s": 0.1}, "use a target that stands, or another kind of arena",
     {"course.target_speed_m_s": 0}),
    ("gestalt/abundance", {"course.goal_rock.enabled": True, A + "kind": "open"}, "use navigator pathfinder",
     {"course.goal_rock.enabled": LEFT_OUT}),
    (NOMINAL, {"course.goal_rock.enabled": True, "course.tracking.enabled": True, A + "kind": "open"},
     "use recognition_m, which measures as course.tracking says, or no goal rock",
     {"course.tracking.enabled": False, "course.goal_rock.recognition_m": 3}),
    (NOMINAL, {"course.goal_rock.enabled": True, "course.target_speed_m_s": 0.1, A + "kind": "open"},
     "use a target that stands", {"course.target_speed_m_s": 0}),
    (NOMINAL, {"course.goal_rock.enabled": True}, "use an open arena", {A + "kind": "open"}),
    (NOMINAL, {"course.goal_rock.enabled": True, "course.goal_rock.diameter_m": 5, A + "kind": "open"},
     "use a smaller rock or a larger clear_radius_m", {"course.goal_rock.diameter_m": 0.3}),
    (NOMINAL, {"referee.stuck_rover": "run_on"}, "use end, or batteries that can be empty",
     {"energy.battery_wh": 50}),
    ("visual_odometry/visual_drive", {"perception.visual_odometry.slip_check.enabled": True,
                                      "navigation.on_slip.reaction": "as_stuck"},
     "use stop, or turn on_board_stuck on", {"navigation.on_board_stuck.reaction": "back_off"}),
    ("visual_odometry/visual_drive", {"perception.visual_odometry.slip_check.enabled": True,
                                      "navigation.on_slip.reaction": "replan", "navigation.navigator": "route"},
     "use stop or as_stuck, or another navigator", {"navigation.on_slip.reaction": "stop"}),
    ("continuous/csod", {"clock.overlap.imaging": False, "clock.overlap.computing": False},
     "use stop_and_look, or clock.overlap.imaging and clock.overlap.computing true",
     {"clock.overlap.imaging": True, "clock.overlap.computing": True}),
    ("continuous/csod", {"sensors.terrain_sensor": "light_stripe"},
     "use stop_and_look, or sensors.terrain_sensor stereo", {"sensors.terrain_sensor": "stereo"}),
    ("continuous/csad", {"clock.overlap.steering": False}, "use csod, or clock.overlap.steering true",
     {"clock.overlap.steering": True}),
    ("continuous/csad", {G + "splines.max_curvature_rate_per_m_s": 0.001},
     "use a larger limit, more knots, longer splines or a slower rover",
     {G + "splines.max_curvature_rate_per_m_s": 0.45}),
    (NOMINAL, {"sensors.aids.sun.enabled": True}, "use error_state, or turn the aids off",
     {"localization.estimator": "error_state"}),
    (NOMINAL, {"sensors.visual_odometry.enabled": True},
     "use visual_odometry or error_state, or turn sensors.visual_odometry off",
     {"localization.estimator": "visual_odometry"}),
    (NOMINAL, {"perception.visual_odometry.slip_check.enabled": True},
     "turn sensors.visual_odometry on, or the check off", {"perception.visual_odometry.slip_check.enabled": False}),
    (NOMINAL, {"course.start_x_m": -100}, "move the start or enlarge the arena", {"course.start_x_m": 0}),
    (NOMINAL, {"course.goal_x_m": 100}, "move the goal or enlarge the arena", {"course.goal_x_m": 7.6}),
    (NOMINAL, {"course.waypoints.x_m": [100], "course.waypoints.y_m": [0]},
     "move the waypoint or enlarge the arena", {"course.waypoints.x_m": [4]}),
    (NOMINAL, {"clock.control_rate_hz": 1000}, "use a lower rate or a shorter physics step",
     {"clock.control_rate_hz": 20}),
    (NOMINAL, {"rover.fidelity": "quasi_static", R + "mobility": "movable", R + "pointedness": 0},
     "use fidelity multibody or fixed rocks", {"rover.fidelity": "multibody"}),
    (NOMINAL, {"rover.mass.chassis_com_x_m": 0.9}, "use a value from .* to .*, with which all six", OBEY),
    (NOMINAL, {"course.goal_radius_m": 0.05}, "use a goal radius of at least the navigator's tolerance",
     {"course.goal_radius_m": 0.1}),
    (NOMINAL, {L + "stripe_subdivision": 2}, "name every stripe of a denser array, e.g. left",
     {P + "left_stripes": [0, 1, 2, 3], P + "centre_stripes": [4], P + "right_stripes": [5, 6, 7, 8]}),
    (NOMINAL, {"sensors.terrain_sensor": "stereo", R + "pointedness": 0, "perception.cloud_elevations.stripes": 7},
     "name every stripe of the array, from left to right",
     {P + "left_stripes": [0, 1, 2], P + "centre_stripes": [3], P + "right_stripes": [4, 5, 6]}),
    (NOMINAL, {L + "fidelity": "image", "perception.stripe_finder.averaging_px": 7},
     "use at most its averaging_rows plus twice its margin_rows", {"perception.stripe_finder.averaging_px": 5}),
    (NOMINAL, {L + "fidelity": "image", L + "camera_height_m": 0.4, L + "emitter_height_m": 0.4},
     "mount both below the front edge of the panel, as camera_height_m and emitter_height_m 0.25 do",
     {L + "camera_height_m": 0.25, L + "emitter_height_m": 0.25}),
    ("gestalt/abundance", {R + "pointedness": 0.8},
     "use 0, sensors.stereo.fidelity image, or terrain_sensor light_stripe", {R + "pointedness": 0}),
    ("gestalt/abundance", {ST + "front.ahead_m": 4}, "use -length_m / 2 to length_m of rover.geometry",
     {ST + "front.ahead_m": 0.4}),
    ("gestalt/abundance_behaviour_stereo", {"perception.cloud_elevations.far_m": 9},
     "use a shorter array, a longer range, or cameras", {"perception.cloud_elevations.far_m": 2}),
    ("gestalt/abundance_behaviour_stereo", {"perception.cloud_elevations.near_m": 0},
     "begin farther away, or use fewer rows", {"perception.cloud_elevations.near_m": 0.9}),
    ("gestalt/abundance_behaviour_stereo", {"perception.cloud_elevations.min_points": 10000}, "use fewer points",
     {"perception.cloud_elevations.min_points": 10}),
    ("gestalt/abundance_behaviour_stereo_stripe", {"perception.cloud_elevations.half_width_m": 1},
     "use near_m, far_m and half_width_m of the window", {"perception.cloud_elevations.half_width_m": LEFT_OUT}),
]


# ---- What carries the tables out

def document(base, settings):
    """A scenario of these paths over a shipped one."""
    made = {"name": "row", "extends": str(PROJECT / "scenarios" / f"{base}.json")}
    for path, value in settings.items():
        at = made
        *groups, key = path.split(".")
        for group in groups:
            at = at.setdefault(group, {})
        at[key] = value
    return made


def with_settings(bad, good):
    """What is set, with what the advice changes; LEFT_OUT takes a value or a group away."""
    settings = dict(bad)
    for path, value in good.items():
        if value is LEFT_OUT:
            settings = {key: kept for key, kept in settings.items() if key != path and not key.startswith(path + ".")}
        else:
            settings[path] = value
    return settings


def values_named(advice):
    """The values that an advice of this kind names: "use a value from 1 to 2 m", "use at most 3", "use a or b"."""
    bounds = re.match(r"use (?:a value from (\S+) to (\S+?)|at (?:most|least) (\S+?))(?:,? |$)", advice)
    if bounds:
        return [json.loads(bound) for bound in bounds.groups() if bound]
    named = re.match(r"use ([\w., ]+)$", advice)
    assert named, advice
    values = []
    for word in re.split(r", | or ", named[1]):
        with contextlib.suppress(ValueError):
            values.append(json.loads(word))
            continue
        values.append(word)
    return values


class AdviceTest(unittest.TestCase):
    maxDiff = None

    @classmethod
    def setUpClass(cls):
        own = tempfile.TemporaryDirectory()
        cls.addClassCleanup(own.cleanup)
        cls.folder = Path(own.name)
        cls.made = cls.folder / "made"
        cls.made.mkdir()
        cls.count = 0
        cls.carried_out = set()
        for place in (cls.folder, cls.made):
            place.chmod(0o755)
        try:
            cls.nobody_can = bare(["--version"], cls.folder, **NOBODY).returncode == 0
        except PermissionError:
            cls.nobody_can = False
        cls.options = options_of_commands(cls.folder)
        cls.make_once()

    @classmethod
    def make_once(cls):
        put(cls.made / "nominal.json", document(NOMINAL, {"rover.fidelity": "quasi_static"}))
        put(cls.made / "two.json", QUICK_SWEEP)
        put(cls.made / "published.json", REFERENCE | {"values": [COUNT | {"id": "one"}]})
        hazard = "run hazard_detection/detection --trials 1 --quiet --set hazard_detection.scenes_per_run=2 "
        for line in (f"run nominal {RUN} --out a", f"run nominal {RUN} --out b --seed 2",
                     f"run nominal {RUN} --out c --set course.goal_x_m=7",
                     f"run nominal {RUN} --out l --set course.trials_per_layout=2",
                     f"run nominal {RUN} --out m1 --shard 1/2", f"run nominal {RUN} --out m2 --shard 2/2",
                     "sweep two.json --quiet --threads 1 --out two", hazard + "--out h",
                     hazard + "--out h2 --set hazard_detection.heights_m=[0.5]",
                     "baseline a --reason why --out a.json", "baseline two --reason why --out two.baseline.json",
                     WAY + "--out way", TINY + "--pairs 3 --out tiny"):
            result = bare(words_of(line), cls.made)
            assert result.returncode == 0, (line, result.stderr)

    def box(self, row):
        """A folder of its own with what a row wants in it."""
        type(self).count += 1
        box = self.folder / f"box{self.count}"
        box.mkdir()
        for name in row.given.split():
            source = self.made / name
            (shutil.copytree if source.is_dir() else shutil.copy)(source, box / name)
        for name, content in row.files.items():
            put(box / name, content)
        return box

    def advice_of(self, row, box, words):
        """What the command says where it fails, and that it has written nothing."""
        if row.make:
            row.make(box)
        before = files_in(box)
        with contextlib.ExitStack() as held:
            if row.hold:
                held.enter_context(contextlib.closing(row.hold(box)))
            failed = bare(words, box, **row.how)
        self.assertEqual(failed.returncode, row.exit, failed.stderr.decode(errors="replace"))
        if row.exit == 2:
            self.assertEqual(files_in(box), before)
        found = problems_in(failed.stderr)
        for _, advice in found:
            self.assertEqual(unknown_words(advice, words[0] if isinstance(words[0], str) else "", self.options), [],
                             advice)
        fitting = [match for _, advice in found if (match := re.fullmatch(row.says, advice))]
        self.assertTrue(fitting, found or failed.stderr)
        return fitting[0]

    def carry_out(self, rows):
        for row in rows[::SHARE]:
            words = words_of(row.fails)
            with self.subTest(words=" ".join(map(str, words))[:110]):
                if row.then is NOBODY and not self.nobody_can:
                    self.skipTest("without root's rights the program cannot be run here")
                box = self.box(row)
                match = self.advice_of(row, box, words)
                for number, way in enumerate(row.ways):
                    with self.subTest(way=number):
                        self.follow(row, box, words, match, way)
                shutil.rmtree(box)

    def follow(self, row, box, words, match, way):
        """In the folder as the failure left it, of which each of several ways has a copy."""
        own = box
        if len(row.ways) > 1:
            own = box.with_name(f"{box.name}-way")
            shutil.rmtree(own, ignore_errors=True)
            shutil.copytree(box, own, symlinks=True)
        commands = way(own, words, [match[0], *match.groups()])
        if commands and commands[-1] is ALIKE:
            if (words[0], match[0]) in self.carried_out:
                return
            commands[-1] = TOLD
        self.assertTrue(commands, f"nobody can follow: {match[0]}")
        for command in commands:
            if command is TOLD:
                continue
            line, prints = command if isinstance(command, tuple) else (command, ".*")
            before = files_in(own)
            known = (tuple(line), prints, tuple(before.items()))
            if command is commands[-1] and known in self.carried_out:  # on the same files
                continue
            result = bare(line, own, **row.then)
            err = result.stderr.decode(errors="replace")
            self.assertIn(result.returncode, row.ends, f"{match[0]}: {line}: {err}")
            self.assertRegex(result.stdout.decode(errors="replace"), prints)
            grows = []
            if "--resume" in line:
                grows = [f"{line[line.index('--out') + 1]}/{name}" for name in GROWS[line[0]]]
            self.assertEqual(lost(before, files_in(own), [*row.may_change, *grows]), [], line)
            if commands[-1] is command:
                self.carried_out.add(known)
            elif commands[-1] is TOLD:
                self.carried_out.add((words[0], match[0]))

    def test_the_checks_find_what_is_wrong(self):
        options = {"run": {"--force", "--resume"}, "sweep": {"--force", "--resume"}, "report": {"--out"}}
        for advice, command, wrong in (
                ("run again with --force", "run", []), ("run again with --force", "report", ["--force"]),
                ("use rockyard fly", "run", ["rockyard fly"]), ("see rockyard run --help", "report", []),
                ("the same `rockyard run` with --resume", "report", []),
                ("`rockyard run --out a`", "run", ["run --out"]),
                ("repeat it (run and sweep with --resume)", "report", []),
                ("name it (--outt)", "report", ["--outt"])):
            self.assertEqual(unknown_words(advice, command, options), wrong, advice)
        before = {"a": "1", "b": "1", "c": "2"}
        self.assertEqual(lost(before, {"x": "1", "b": "1", "old/c": "2"}, []), [])
        self.assertEqual(lost(before, {"a": "1", "c": "3"}, ["c"]), ["b"])
        self.assertEqual(values_named("use a value from 0.5 to 2 m"), [0.5, 2])
        self.assertEqual(values_named("use at most 0.31, or 1"), [0.31])
        self.assertEqual(values_named("use relocate, 7 or allow"), ["relocate", 7, "allow"])

    def test_what_is_typed(self):
        self.carry_out(TYPED)

    def test_runs(self):
        self.carry_out(RUNS)

    def test_pending_trials(self):
        """What is advised of a trial that could not be driven, `rockyard replay FOLDER --trial N`."""
        box = self.box(Row("", "", [], "a"))
        forged(box, "DELETE FROM trials WHERE trial = 1")
        result = bare(words_of("replay a --trial 1 --out a.html"), box)
        self.assertEqual(result.returncode, 0, result.stderr.decode())

    def test_images(self):
        self.carry_out(SEEN)

    def test_sequences(self):
        self.carry_out(SEQUENCES)

    def test_calibrations(self):
        self.carry_out(CALIBRATIONS)

    def validate(self, documents, beside=()):
        """Reasons and advice of every document, by its number, and the exit code."""
        type(self).count += 1
        box = self.folder / f"box{self.count}"
        box.mkdir()
        for name, content in dict(beside).items():
            put(box / name, content)
        for number, content in enumerate(documents):
            put(box / f"row{number}.json", content)
        result = bare(["validate", *(f"row{number}.json" for number in range(len(documents)))], box)
        found = collections.defaultdict(list)
        for where, advice in problems_in(result.stderr):
            number, rest = re.fullmatch(r"row(\d+)\.json: (.*)", where).groups()
            found[int(number)].append((rest, advice))
            self.assertEqual(unknown_words(advice, "validate", self.options), [], advice)
        return result, found

    def test_documents(self):
        _, found = self.validate([bad for bad, _, _ in DOCUMENTS], BESIDE)
        for number, (bad, says, _) in enumerate(DOCUMENTS):
            with self.subTest(document=str(bad)[:110]):
                self.assertTrue(any(re.fullmatch(says, advice) for _, advice in found[number]), found[number])
        result, found = self.validate([good for _, _, good in DOCUMENTS], BESIDE)
        self.assertEqual((result.returncode, dict(found)), (0, {}))

    def test_parameters(self):
        _, found = self.validate([document(base, bad) for base, bad, _, _ in PARAMETERS])
        followed = []
        for number, (base, bad, says, good) in enumerate(PARAMETERS):
            with self.subTest(base=base, settings=str(bad)[:110]):
                fitting = [(where.split(":")[0], advice) for where, advice in found[number] if re.match(says, advice)]
                self.assertTrue(fitting, found[number])
                path, advice = fitting[0]
                changes = [{path: value} for value in values_named(advice)] if good == OBEY else [good]
                followed += [document(base, with_settings(bad, change)) for change in changes]
        result, found = self.validate(followed)
        self.assertEqual((result.returncode, dict(found)), (0, {}))

    def test_bounds_of_parameters(self):
        """Every number of a scenario takes the bounds that are told where it is refused."""
        listed = csv.DictReader(io.StringIO(bare(["parameters", "--csv"], self.folder).stdout.decode()))
        refused = [(row["path"], row["kind"], float(row["max"]) * 2 + 9) for row in listed
                   if row["kind"] in ("real", "angle", "integer", "reals", "integers") and row["max"]]
        self.assertGreater(len(refused), 700)

        def wrapped(kind, number):
            return [number] if kind in ("reals", "integers") else number

        parts = [refused[at:at + 90] for at in range(0, len(refused), 90)]  # a hundred problems are told
        _, found = self.validate([document(NOMINAL, {path: wrapped(kind, number) for path, kind, number in part})
                                  for part in parts])
        followed = []
        for number, part in enumerate(parts):
            advice = {where.split(":")[0].split("[")[0]: text for where, text in found[number]}
            self.assertEqual(sorted(advice), sorted(path for path, _, _ in part))
            bounds = {path: (kind, values_named(advice[path])) for path, kind, _ in part}
            for which in (0, -1):
                followed.append(document(NOMINAL, {path: wrapped(kind, named[which])
                                                   for path, (kind, named) in bounds.items()}))
        _, found = self.validate(followed)
        still = [told for problems in found.values() for told in problems if "allowed value" in told[0]]
        self.assertEqual(still, [])

    def check(self, references):
        """What is said of each reference where a run is checked against it."""
        row = Row("check", "", [], "a", {f"row{n}.json": reference for n, reference in enumerate(references)})
        box = self.box(row)
        return [bare(["check", "a", "--against", f"row{n}.json", "--replicates", "100"], box)
                for n in range(len(references))]

    def test_references(self):
        good = [but(value, id=f"v{n}") for n, (_, _, value) in enumerate(VALUES)]
        bad = [{"id": f"v{n}"} | value for n, (value, _, _) in enumerate(VALUES)]
        bad.append(but(COUNT, id="twice"))
        result, fine, *heads = self.check([REFERENCE | {"values": bad}, REFERENCE | {"values": good},
                                         *({"values": good} | head for head, _ in HEADS)])
        found = collections.defaultdict(list)
        for where, advice in problems_in(result.stderr):
            found[int(re.match(r"values\[(\d+)\]", where)[1])].append(advice)
            self.assertEqual(unknown_words(advice, "check", self.options), [], advice)
        for number, (value, says, _) in enumerate(VALUES):
            with self.subTest(value=value):
                wanted = found[number] + (found[len(VALUES)] if value.get("id") == "twice" else [])
                self.assertTrue(any(re.fullmatch(says, advice) for advice in wanted), wanted)
        self.assertIn(fine.returncode, (0, 1, 4), fine.stderr)
        for (head, says), result in zip(HEADS, heads):
            with self.subTest(head=head):
                self.assertEqual(result.returncode, 2)
                told = [advice for _, advice in problems_in(result.stderr)]
                self.assertTrue(any(re.fullmatch(says, advice) for advice in told), result.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[4:])
