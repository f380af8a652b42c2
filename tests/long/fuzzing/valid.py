"""Scenarios whose values are allowed and extreme, run for some trials at both fidelities of the rover."""

import csv
import io
import json
import math
import re
import shutil
import tempfile
from pathlib import Path

from fuzzing import harness
from progress import Progress

BASES = ["pathfinder/nominal", "pathfinder/vl2", "gestalt/abundance", "mars/mfex_nominal",
         "hazard_detection/height_factor", "gestalt/abundance_behaviour_stereo"]
FIDELITIES = ("multibody", "quasi_static")
BATCH = 50
TRIALS = 2
TRIAL_CPU_S = 20
TIMEOUT_S = 600
SIMULATED_S = 120
# What says who and how much rather than what is simulated.
KEPT = {"schema_version", "name", "description", "accepted", "experiment", "trials", "rover.fidelity",
        "referee.time_limit_s",
        "hazard_detection.scenes_per_run", "stereo_sensing.looks_per_run",
        "dead_reckoning.walks_per_run"}
SLOW = "used more CPU time than --trial-cpu-limit"


def parameters(rockyard, scenario):
    """Rows of `rockyard parameters`, of what may be set."""
    told = harness.run([rockyard, "parameters", str(scenario), "--csv"], harness.ROOT, TIMEOUT_S)
    return [row for row in csv.DictReader(io.StringIO(told.out)) if row["path"] not in KEPT and row["kind"] != "text"]


def _number(row, rng):
    low = float(row["min"]) if row["min"] else -1e6
    high = float(row["max"]) if row["max"] else 1e6
    kind = rng.randrange(7)
    if kind == 0:
        return low
    if kind == 1:
        return high
    if kind == 2 and row["study_low"]:
        return float(rng.choice([row["study_low"], row["study_high"]]))
    if kind == 3:
        return math.nextafter(low, high)
    if kind == 4 and 0.0 <= low < high:  # as likely in each decade
        return min(high, max(low, high * 10.0 ** -rng.uniform(0, 8)))
    if kind == 5:
        return min(high, max(low, 0.0))
    return rng.uniform(low, high)


def _value(row, rng):
    kind = row["kind"]
    if kind == "choice":
        return rng.choice(row["choices"].split("|"))
    if kind == "boolean":
        return rng.random() < 0.5
    if kind == "integer":
        return int(_number(row, rng))
    if kind == "reals":
        return [_number(row, rng) for _ in range(rng.choice([0, 1, 1, 2, len(row["value"].split(","))]))]
    if kind == "integers":
        return [int(_number(row, rng)) for _ in range(rng.choice([0, 1, 1, 2, len(row["value"].split(","))]))]
    return _number(row, rng)


def make(tables, rng):
    """A scenario that extends a base: some of its values, each anywhere in its bounds."""
    base = rng.choice(sorted(tables))
    document = {"extends": str(harness.ROOT / "scenarios" / f"{base}.json"), "name": "extreme",
                "referee": {"time_limit_s": SIMULATED_S}, "trials": TRIALS}
    for row in rng.sample(tables[base], rng.choice([1, 1, 2, 3, 5])):
        at = document
        *groups, key = row["path"].split(".")
        for group in groups:
            at = at.setdefault(group, {})
        at[key] = _value(row, rng)
    document.setdefault("rover", {})["fidelity"] = FIDELITIES[0]
    return document


def _accepted(rockyard, names, folder, findings):
    """Those that are allowed: conditions across values refuse some."""
    end = harness.run([rockyard, "validate", *names], folder, TIMEOUT_S)
    reason = harness.problem_of(end, {harness.DONE, harness.BAD_INPUT})
    if reason:
        findings.fail(int(names[0].split(".")[0]), f"one of {len(names)} {reason}", [rockyard, "validate", *names],
                      end, [Path(folder) / name for name in names])
    return re.findall(r"^(\d+\.json): valid, ", end.out, re.M)


def _run_one(rockyard, name, fidelity, folder, findings):
    """Without a supervisor, so that a crash is seen as one."""
    command = [rockyard, "run", name, "--set", f"rover.fidelity={fidelity}", "--trials", str(TRIALS), "--threads",
               "1", "--no-supervisor", "--trial-cpu-limit", str(TRIAL_CPU_S), "--out", "run", "--quiet"]
    end = harness.run(command, folder, TIMEOUT_S)
    findings.counts[f"runs, {fidelity}"] += 1
    if end.code == harness.BAD_INPUT and "error: " in end.err:
        findings.counts["refused with quasi_static" if fidelity == FIDELITIES[1] else "refused after all"] += 1
    elif end.code == harness.FAILED and SLOW in end.err:
        findings.counts[f"slower than {TRIAL_CPU_S} CPU seconds a trial"] += 1
        print(f"  slow: {findings.part} {name} ({fidelity})", flush=True)
    else:
        reason = harness.problem_of(end, {harness.DONE})
        if reason:
            findings.fail(int(name.split(".")[0]), f"{fidelity}: {reason}", command, end,
                          [Path(folder) / name, Path(folder) / "run/trials.csv"])
    shutil.rmtree(Path(folder) / "run", ignore_errors=True)


def run(rockyard, first, count, findings):
    """Cases `first` to `count` - 1, those included that are refused."""
    tables = {base: parameters(rockyard, harness.ROOT / "scenarios" / f"{base}.json") for base in BASES}
    folder = tempfile.mkdtemp(prefix="rockyard-fuzz-")
    try:
        progress = Progress(findings.part, count - first)
        for begin in range(first, count, BATCH):
            progress.at(begin - first, len(findings.failures))
            names = []
            for index in range(begin, min(begin + BATCH, count)):
                document = make(tables, harness.generator(findings.seed, findings.part, index))
                names.append(f"{index}.json")
                (Path(folder) / names[-1]).write_text(json.dumps(document), encoding="utf-8")
            accepted = _accepted(rockyard, names, folder, findings)
            findings.counts["scenarios"] += len(names)
            findings.counts["allowed"] += len(accepted)
            for name in accepted:
                for fidelity in FIDELITIES:
                    _run_one(rockyard, name, fidelity, folder, findings)
            for name in names:
                (Path(folder) / name).unlink()
    finally:
        shutil.rmtree(folder, ignore_errors=True)
