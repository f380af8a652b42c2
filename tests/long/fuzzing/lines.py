"""Command lines of every subcommand and option, given to the command itself in a folder with a few runs."""

import json
import os
import re
import shutil
import subprocess
import tempfile
from pathlib import Path

from fuzzing import harness
from progress import Progress

LINES_A_FOLDER = 250  # then it is made anew, as they write into it
TIMEOUT_S = 600

SCENARIO = {"extends": str(harness.ROOT / "scenarios/pathfinder/nominal.json"), "name": "small", "trials": 2,
            "referee": {"time_limit_s": 1}}
SEEN = {"extends": str(harness.ROOT / "scenarios/hazard_detection/height_factor.json"), "name": "seen", "trials": 1}
SWEEP = {"name": "two", "scenario": "s.json", "trials": 1, "seed": 1,
         "axes": [{"path": "referee.time_limit_s", "values": [1, 2]}]}

FILES = ["s.json", "seen.json", "w.json", "done", "other", "swept", "shard-1", "shard-2", "b.json",
         "done/scenario.resolved.json", "done/results.sqlite", "done/trials.csv", "none", "none.json", "empty", ".",
         "not.json", "-x", "--", "=1", "a b", "\u202e", "s.json/x", "x" * 300, "", "garbage.json", "locked"]
NEW_FILES = ["out.csv", "out.svg", "out.json", "out.html", "out.urdf", "out.npz", "out.mcap", "out.obj", "out.xml",
             "new", "out", "done", "done/out.csv", "none/out.csv", "empty", "-o", "", "x" * 300, "a\nb.csv", "s.json", "pipe"]
SETTINGS = ["referee.time_limit_s=2", "rover.fidelity=quasi_static", "name=x", "trials=3", "seed=-1", "a=1", "=",
            "a", "", "terrain.rocks.k_per_m2=0.01", "terrain.rocks.k_per_m2=1e9", "terrain=1", "terrain.rocks={",
            "rover.geometry.wheel_radius_m=NaN", "a.b.c.d=[]", "a..b=1", ".=1", "description=\u202e", "extends=s.json",
            "x=" + "[" * 5000, "." * 100 + "=1"]
WHOLE = ["0", "1", "2", "3", "-1", "00", "1.5", "1e1", "x", "", "999999999999999999999999", "-9223372036854775809",
         "18446744073709551615", "18446744073709551616", " 1", "1 ", "0x1", "nan", "+2"]
REAL = ["0", "0.5", "0.3", "1", "-1", "1e-9", "1e300", "1e999", "nan", "inf", "-inf", "x", "", "0,5", "0.49", "0.05",
        "0.0005", "0.95", "0.999", ".1", "1e-5"]
TEXT = ["all", "failures", "worst:1", "worst:-1", "worst:99999999999", "share:0.5", "share:nan", "1/2", "2/1", "0/0",
        "1/99999999999999999999", "npz", "csv", "mcap", "uniform", "adaptive", "wilson", "clopper-pearson", "published",
        "assumed", "bash", "zsh", "fish", "no_slip", "perfect_sensing", "time_s=1", "0", "time=off", "x", "",
        "\u202e", "\x1b[2J", "a" * 5000, "'", '"', "$(id)", "=1+1", "-", "--", "%s%n"]
# Values that these options need to end soon.
SMALL = {"--fields": ["1", "2", "0", "-1", "x"], "--threads": ["1", "2", "0", "4097", "-1", "x"],
         "--trials": ["0", "1", "2", "3", "-1", "x", ""], "--replicates": ["100", "99", "200", "x"],
         "--max-trials": ["1", "2", "30", "0", "x"], "--pilots": ["0", "1", "-1", "x"],
         "--replays": ["0", "1", "1001", "x"], "--block": ["1", "2", "25", "0", "x"]}
MADE = {"--out", "--csv", "--svg", "--npz", "--mcap", "--junit", "--data"}
FOUND = {"--against", "--cell", "--cell-b", "--dem", "--fit", "--rocks"}


class Command:
    """A subcommand as its help tells of it."""

    def __init__(self, words, text):
        self.words = words
        self.options = []
        for name, rest in re.findall(r"^  (?:-\w,)?(--[\w-]+)(.*)$", text, re.M):
            kind = re.match(r" (INT|UINT|FLOAT|TEXT|RULE|ENUM|NUMBER)", rest)
            choices = re.search(r"\{([\w:,-]+)\}", rest)
            self.options.append((name, kind.group(1) if kind else "", choices.group(1).split(",") if choices else []))
        usage = re.search(r"^Usage: (.*)$", text, re.M)
        self.places = re.findall(r" ([A-Z_a-z]+)(?:\.\.\.)?", usage.group(1).split("[OPTIONS]")[-1]) if usage else []


def commands(rockyard):
    """All of them; those of `plan` too."""
    def help_of(*words):
        return harness.run([rockyard, *words, "--help"], harness.ROOT, TIMEOUT_S).out

    def names(text):
        at = text.find("Subcommands:")
        return re.findall(r"^  ([a-z][\w-]*)", text[at:], re.M) if at >= 0 else []

    found = []
    for name in names(help_of()):
        text = help_of(name)
        below = names(text)
        found += [Command([name, each], help_of(name, each)) for each in below] or [Command([name], text)]
    if len(found) < 15:
        raise RuntimeError(f"only {len(found)} subcommands are found in the help")
    return found


def _value(name, kind, choices, rng):
    if rng.random() < 0.03:
        return rng.choice(TEXT + WHOLE + REAL + FILES)
    if choices and rng.random() < 0.8:
        return rng.choice(choices)
    if name in SMALL:
        return rng.choice(SMALL[name])
    if name in MADE:
        return rng.choice(NEW_FILES)
    if name in FOUND:
        return rng.choice(FILES + ["0", "1", "time_limit_s=1"])
    if name == "--set":
        return rng.choice(SETTINGS)
    if kind in ("INT", "UINT"):
        return rng.choice(WHOLE)
    if kind in ("FLOAT", "NUMBER"):
        return rng.choice(REAL)
    return rng.choice(TEXT)


def _place(name, rng):
    if name == "SHELL":
        return rng.choice(["bash", "zsh", "fish", "sh", ""])
    good = {"FILE": ["w.json"], "RUN": ["done", "other", "swept"], "SHARD": ["shard-1", "shard-2"],
            "FOLDER": [".", "empty"]}.get(name, ["s.json", "seen.json", "done"])
    return rng.choice(good if rng.random() < 0.75 else FILES)


def make(known, rng):
    """The words of one command line, without the command."""
    if rng.random() < 0.02:
        return [rng.choice(TEXT + WHOLE + FILES) for _ in range(rng.randrange(5))]
    command = rng.choice(known)
    words = []
    for place in command.places:
        words += [_place(place, rng) for _ in range(rng.choice([1, 1, 1, 1, 2, 0]))]
    for name, kind, choices in rng.sample(command.options, min(len(command.options), rng.choice([0, 1, 2, 2, 3, 5]))):
        if name == "--help" and rng.random() < 0.9:
            continue
        if not kind or rng.random() < 0.02:
            words.append(name)
        elif rng.random() < 0.2:
            words.append(f"{name}={_value(name, kind, choices, rng)}")
        else:
            words += [name, _value(name, kind, choices, rng)]
    if command.words[0] in ("run", "sweep") and any(word.startswith("--until-half-width") for word in words):
        words += ["--max-trials", rng.choice(SMALL["--max-trials"])]
    if rng.random() < 0.02:
        words.insert(rng.randrange(len(words) + 1), rng.choice(["--nonsense", "-q", "--", "---", "-", "--trails"]))
    return [word.replace("\0", "") for word in command.words + words]


def _prepare(rockyard, folder):
    """The folder in which lines are run: small runs of each kind, and things that are none."""
    for name, content in (("s.json", SCENARIO), ("seen.json", SEEN), ("w.json", SWEEP)):
        (folder / name).write_text(json.dumps(content), encoding="utf-8")
    (folder / "not.json").write_text("{", encoding="utf-8")
    (folder / "garbage.json").write_bytes(bytes(range(256)))
    (folder / "empty").mkdir()
    (folder / "locked").mkdir(mode=0)
    os.mkfifo(folder / "pipe")
    for words in (["run", "s.json", "--out", "done"], ["run", "s.json", "--out", "other", "--seed", "2"],
                  ["run", "s.json", "--out", "shard-1", "--shard", "1/2"],
                  ["run", "s.json", "--out", "shard-2", "--shard", "2/2"], ["sweep", "w.json", "--out", "swept"],
                  ["baseline", "done", "--reason", "fuzzing", "--out", "b.json"]):
        end = harness.run([rockyard, *words], folder, TIMEOUT_S)
        if end.code != harness.DONE:
            raise RuntimeError(f"{words} ends with {end.code}: {end.err}")


def _run_line(rockyard, words, folder, where):
    """How it ended, and what was wrong with that.

    `where` it writes: below 0.9 where it is read, up to 0.95 into a full disk, else into a pipe without a reader.
    """
    if where < 0.9:
        end = harness.run([rockyard, *words], folder, TIMEOUT_S)
        return end, harness.problem_of(end)
    if where < 0.95:
        with open("/dev/full", "wb") as full:
            end = harness.run([rockyard, *words], folder, TIMEOUT_S, stdout=full)
        lost = "standard output: cannot be written" in end.err
        reason = harness.problem_of(end, harness.DOCUMENTED)
        if not reason and (end.code == harness.FAILED) != lost and end.code != harness.BAD_INPUT:
            reason = f"ends with {end.code}, and its output was {'' if lost else 'not '}lost"
        return end, reason
    reader, writer = os.pipe()
    os.close(reader)
    with os.fdopen(writer, "wb") as nobody:
        end = harness.run([rockyard, *words], folder, TIMEOUT_S, stdout=nobody)
    return end, harness.problem_of(end)


def run(rockyard, first, count, findings):
    """Cases `first` to `count` - 1."""
    known = commands(rockyard)
    findings.counts["subcommands"] = len(known)
    findings.counts["options"] = sum(len(command.options) for command in known)
    ready = Path(tempfile.mkdtemp(prefix="rockyard-fuzz-"))
    folder = ready / "work"
    try:
        (ready / "fresh").mkdir()
        _prepare(rockyard, ready / "fresh")
        progress = Progress(findings.part, count - first)
        for index in range(first, count):
            progress.at(index - first, len(findings.failures))
            if index == first or index % LINES_A_FOLDER == 0:
                shutil.rmtree(folder, ignore_errors=True)
                subprocess.run(["cp", "-a", ready / "fresh", folder], check=True)
            words = make(known, harness.generator(findings.seed, findings.part, index))
            where = harness.generator(findings.seed, "where", index).random()
            end, reason = _run_line(rockyard, words, folder, where)
            findings.counts["lines"] += 1
            findings.counts[f"ended with {end.code}"] += 1
            if reason:
                findings.fail(index, reason, [rockyard, *words], end)
    finally:
        shutil.rmtree(ready, ignore_errors=True)
