#!/usr/bin/env python3
"""Uses the command as people do, in a build with sanitizers: does one of them complain?

    scenarios  every scenario of the project, the first seconds of a few drives on two threads, three of a
               mission, at its fidelity and at the other
    session    a sweep, a run that is killed and gone on with, shards and their merge, and every command
               that reads them
    hostile    wrong and extreme scenarios and command lines (tests/long/fuzz.py), where asked for

A finding is a report of a sanitizer, an end by a signal other than the kills of this study, or an exit
code that the command should not have; each is printed with its command and its last words. Works with any
build; without sanitizers only the ends are judged. Prints each part with its number of commands and how
long it took. Exit code: 0 no finding, 1 findings.

    tests/long/commands.py --rockyard build/asan/bin/rockyard [--trials 2] [--hostile 0]
"""

import argparse
import csv
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
REPORTED = re.compile(r"(Address|Leak|Thread|UndefinedBehavior)Sanitizer|runtime error:|DEADLYSIGNAL")
FIDELITIES = ("quasi_static", "multibody")
THREADS = "2"
# With the thread sanitizer a second takes twenty; longer drives and missions do the same on.
DRIVEN_S = 20.0  # simulated
SOLS = "mission.sols"
MOST_SOLS = 3
LIMIT_S = 3600  # what takes longer hangs
# Signals are the program's own, which contains them; parts of the OpenMP runtime are not instrumented.
SANITIZERS = {
    "ASAN_OPTIONS": "handle_segv=0:handle_abort=0:handle_sigfpe=0:handle_sigbus=0",
    "TSAN_OPTIONS": "ignore_noninstrumented_modules=1",
}


class Session:
    """Commands in one folder, and what was wrong with them."""

    def __init__(self, rockyard, folder):
        self.rockyard, self.folder = rockyard, folder
        self.environment = {**SANITIZERS, **os.environ}
        self.commands, self.findings = 0, []

    def start(self, words):
        self.commands += 1
        return subprocess.Popen([self.rockyard, *map(str, words)], cwd=self.folder, env=self.environment,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                start_new_session=True)

    def end(self, process, words, expected):
        try:
            out, told = process.communicate(timeout=LIMIT_S)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            out, told = process.communicate()
            told += f"\nkilled after {LIMIT_S} s"
        if process.returncode not in expected or REPORTED.search(told):
            line = " ".join(["rockyard", *map(str, words)])
            self.findings.append(f"{line}\n  exit code {process.returncode}\n{told[-3000:]}")
            print(self.findings[-1], file=sys.stderr, flush=True)
        return out

    def run(self, *words, expected=(0,)):
        return self.end(self.start(words), words, expected)


def settings_of(session, path):
    """Values of parameters by their paths, as texts."""
    rows = csv.DictReader(session.run("parameters", path, "--csv").splitlines())
    return {row["path"]: row["value"] for row in rows}


def scenarios(session, options):
    listed = json.loads(session.run("list", ROOT / "scenarios", "--json"))
    files = [file["file"] for file in listed["files"] if file["kind"] == "scenario"]
    for file in files:
        path = ROOT / "scenarios" / file
        words = ["run", path, "--trials", options.trials, "--threads", THREADS, "--out", "trials", "--force",
                 "--quiet"]
        settings = settings_of(session, path)
        if not 0 < float(settings.get("referee.time_limit_s", 1)) < DRIVEN_S:  # 0: never
            words += ["--set", f"referee.time_limit_s={DRIVEN_S}"]
        if SOLS in settings:
            words += ["--set", f"{SOLS}={MOST_SOLS}"]
        session.run(*words)
        own = settings.get("rover.fidelity")  # None where nothing drives
        for other in FIDELITIES if own else ():
            if other != own:  # which a scenario may have a reason to refuse
                session.run(*words, "--set", f"rover.fidelity={other}", expected=(0, 2))


def killed_and_resumed(session, words):
    """Ended by SIGKILL after half a second or more, then gone on with."""
    process = session.start(words)
    time.sleep(0.5 + 0.1 * session.commands % 1)
    os.killpg(process.pid, signal.SIGKILL)
    session.end(process, words, (-signal.SIGKILL, 0))
    session.run(*words, "--resume")


def session_of_commands(session, _options):
    nominal = ROOT / "scenarios/pathfinder/nominal.json"
    quick = ["--set", "rover.fidelity=quasi_static", "--threads", THREADS, "--quiet"]
    (session.folder / "sweep.json").write_text(json.dumps(
        {"name": "session", "trials": 6, "set": {"rover.fidelity": "quasi_static"},
         "axes": [{"path": "terrain.rocks.k_per_m2", "values": [0.002, 0.006]}]}), encoding="utf-8")
    session.run("validate", nominal, "sweep.json")
    session.run("sweep", "sweep.json", "--threads", THREADS, "--out", "sweep", "--quiet")
    killed_and_resumed(session, ["run", nominal, "--trials", 40, "--out", "run", *quick])
    session.run("run", nominal, "--trials", 40, "--out", "other", "--seed", 2, *quick)
    for index in (1, 2):
        session.run("run", nominal, "--trials", 8, "--shard", f"{index}/2", "--out", f"shard{index}", *quick)
    session.run("merge", "shard1", "shard2", "--out", "merged", "--quiet")
    session.run("report", "run", "sweep", "--data", "report.json")
    session.run("compare", "run", "other", "--csv", "compared.csv", expected=(0, 1, 4))
    session.run("baseline", "run", "--reason", "a session", "--out", "baseline.json")
    session.run("check", "run", "--against", "baseline.json")
    session.run("check", "other", "--against", "baseline.json", expected=(0, 1, 4))
    session.run("trace", "run", "--trial", 3)
    session.run("replay", "run", "--trial", 3, "--out", "replay.html", "--data", "replay.json")
    session.run("replay", "run", "--trial", 3, "--scan", 1, "--out", "scan")
    session.run("rover", nominal, "--out", "rover.urdf")
    seen = ["render", ROOT / "scenarios/gestalt/abundance.json", "--set", "sensors.stereo.columns=128", "--set",
            "sensors.stereo.rows=96", "--set", "sensors.stereo.images.pyramid_level=0", "--out"]
    session.run(*seen, "pair")
    session.run("stereo", "pair/left.png", "pair/right.png", "--cameras", "pair/cameras.json", "--param",
                "correlator.disparities=32", "--out", "matched")
    session.run(*seen, "way", "--pairs", 4, "--step-m", 0.1)
    session.run("vo", "way", "--cameras", "way/cameras.json", "--truth", "way/poses.txt", "--out", "path")
    session.run("parameters", nominal)
    session.run("schema")
    session.run("completion", "bash")
    session.run("--version")


def hostile(session, options):
    count = options.hostile
    if count < 1:
        return
    session.commands += 1
    words = [sys.executable, ROOT / "tests/long/fuzz.py", "--rockyard", session.rockyard, "--seed", 5,
             "--scenarios", 10 * count, "--valid", count, "--lines", count, "--out", session.folder / "fuzz"]
    done = subprocess.run([str(word) for word in words], env=session.environment, capture_output=True,
                          text=True, check=False)
    print(done.stdout, end="", flush=True)
    if done.returncode != 0:
        session.findings.append(f"tests/long/fuzz.py ends with {done.returncode}\n{done.stderr[-3000:]}")


def study(options, folder):
    session = Session(str(options.rockyard.resolve()), folder)
    sanitizers = re.search(r"-fsanitize=(\S+)", session.run("--version"))
    print(f"sanitizers: {sanitizers.group(1) if sanitizers else 'none'}", flush=True)
    for part in (scenarios, session_of_commands, hostile):
        start, before = time.monotonic(), session.commands
        part(session, options)
        print(f"{part.__name__.split('_')[0]}: {session.commands - before} commands, "
              f"{time.monotonic() - start:.0f} s", flush=True)
    print(f"{session.commands} commands, {len(session.findings)} findings")
    return 1 if session.findings else 0


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rockyard", type=Path, default=ROOT / "build/asan/bin/rockyard")
    parser.add_argument("--trials", type=int, default=2, help="of each scenario and fidelity (%(default)s)")
    parser.add_argument("--hostile", type=int, default=0, metavar="N",
                        help="command lines and allowed extremes, and ten times as many wrong scenarios")
    options = parser.parse_args(arguments)
    if not options.rockyard.is_file():
        parser.error(f"{options.rockyard} is not there: build it, or name it with --rockyard")
    with tempfile.TemporaryDirectory(prefix="rockyard-session-") as folder:
        return study(options, Path(folder))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
