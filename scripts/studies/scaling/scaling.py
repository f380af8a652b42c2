#!/usr/bin/env python3
"""Measures how a campaign grows with threads and ranks on this machine.

Runs the same trials with every number of threads and ranks in turn, several rounds, and prints trials
per second (best round), efficiency against one thread, CPU time, and whether the records are the same.
Run it on a machine that does nothing else.

    scripts/studies/scaling/scaling.py [--threads 1,2] [--ranks 1,2] [--trials 2000] [--rounds 3]
"""

import os
import resource
import shutil
import subprocess
import sys
import time
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402
from study import ROOT, ry, table  # noqa: E402


def launch(args, kind, count):
    """The command that runs the trials on so many threads or ranks (of one thread each)."""
    command = [args.rockyard, "run", args.scenario, "--trials", args.trials, "--quiet",
               "--out", args.out / f"{kind}-{count}", *study.settings(args.set)]
    if kind == "threads":
        return [*command, "--threads", count]
    return ["mpirun", "--oversubscribe", "--bind-to", "none", "-n", count, *command, "--threads", 1]


def measure(args, kind, count):
    """Wall and CPU seconds, and the trial hash, of one run in a new folder."""
    folder = args.out / f"{kind}-{count}"
    shutil.rmtree(folder, ignore_errors=True)
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    start = time.monotonic()
    subprocess.run([str(part) for part in launch(args, kind, count)], env=environment, check=True)
    wall = time.monotonic() - start
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return wall, cpu, ry.Run(folder).hash


def counts(text):
    return [int(part) for part in text.split(",") if part]


def main():
    parser = study.argument_parser(__doc__)
    parser.add_argument("--scenario", type=Path, default=ROOT / "scenarios/pathfinder/nominal.json")
    parser.add_argument("--set", action="append", default=["rover.fidelity=quasi_static"])
    parser.add_argument("--trials", type=int, default=2000)
    parser.add_argument("--threads", type=counts, default=[1, 2], help="joined by commas (1,2)")
    parser.add_argument("--ranks", type=counts, default=[1, 2], help="needs mpirun (1,2)")
    parser.add_argument("--rounds", type=int, default=3, help="the best one counts (3)")
    parser.add_argument("--out", type=Path, default=ROOT / "results/runs/scaling")
    parser.add_argument("--rockyard", type=Path, default=ROOT / "build/release/bin/rockyard")
    args = parser.parse_args()
    ways = [("threads", n) for n in args.threads] + [("ranks", n) for n in args.ranks]
    found = {way: [] for way in ways}
    for _ in range(args.rounds):  # in turn, so that a disturbance does not meet one way only
        for way in ways:
            found[way].append(measure(args, *way))
    hashes = {run[2] for runs in found.values() for run in runs}
    if len(hashes) != 1:
        sys.exit(f"the records differ: {', '.join(sorted(hashes))}")
    base = min(run[0] for run in found[ways[0]]) * ways[0][1]
    rows = []
    for (kind, count), runs in found.items():
        wall = min(run[0] for run in runs)
        rows.append([f"{count} {kind if count > 1 else kind[:-1]}", f"{args.trials / wall:.0f}",
                     f"{base / wall:.2f}", f"{100 * base / wall / count:.0f} %",
                     f"{1000 * min(run[1] for run in runs) / args.trials:.2f}"])
    print(table(["", "trials per second", "times one thread", "efficiency", "CPU ms a trial"], rows))
    print(f"\n{args.trials} trials, best of {args.rounds} rounds; trial hash {hashes.pop()} everywhere")


if __name__ == "__main__":
    main()
