#!/usr/bin/env python3
"""Whether first trials have the records that hashes.json keeps: the same bits as those of every other build.

Usage: hashes_test.py PROGRAM [--against PROGRAM [--trials N]] [--update]
PROGRAM is hash_trials of the build under test. Each drive of hashes.json runs on one thread and on two. The
mathematics library chooses code by CPU, and so there is a set of hashes for each class of CPU.
  --against PROGRAM  instead: the hashes of another build's hash_trials
  --trials N         of each drive with --against
  --update           write the set of this class, in a commit that changes results on purpose
Exit code 0: the same; 1: a hash differs; 2: wrong use, or hashes.json has no set for this class; 3: a program fails.
"""

import argparse
import json
import os
import platform
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent


def class_of_cpu(info=Path("/proc/cpuinfo")):
    """What the GNU mathematics library tells CPUs apart by; GLIBC_TUNABLES may hide features of this one."""
    if platform.machine() != "x86_64":
        return platform.machine()
    flags = info.read_text(encoding="utf-8").partition("flags")[2].partition("\n")[0].split()
    hidden = "-FMA" in os.environ.get("GLIBC_TUNABLES", "")
    return "x86_64 with FMA" if {"fma", "avx2"} <= set(flags) and not hidden else "x86_64 without FMA"


class Failed(Exception):
    """A program gave no hash."""


def hash_of(program, drive, trials, threads):
    command = [program, str(ROOT / drive["scenario"]), str(trials or drive["trials"]), str(threads), *drive["set"]]
    result = subprocess.run(command, text=True, capture_output=True, check=False)
    if result.returncode != 0 or not result.stdout.strip():
        raise Failed(f"{' '.join(command)} ended with {result.returncode}: {result.stderr}")
    return result.stdout.strip()


def compare(program, drives, wanted_of, trials):
    """(hashes by drive, whether all are as wanted on one thread and on two); says so line by line."""
    found, all_same = {}, True
    for name, drive in drives.items():
        found[name] = hash_of(program, drive, trials, 1)
        wanted = wanted_of(name, drive)
        on_two = hash_of(program, drive, trials, 2)
        same = found[name] == on_two == wanted
        all_same = all_same and same
        told = "same" if same else f"DIFFERS from {wanted} (two threads: {on_two}):"
        print(f"{told} {found[name]}  {name}", flush=True)
    return found, all_same


def main(arguments, kept_file=Path(__file__).with_name("hashes.json")):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", metavar="PROGRAM")
    parser.add_argument("--against", metavar="PROGRAM")
    parser.add_argument("--trials", type=int, metavar="N")
    parser.add_argument("--update", action="store_true")
    args = parser.parse_args(arguments)
    if args.trials and not args.against:
        parser.error("--trials goes with --against: hashes are kept of the trials that hashes.json names")
    kept, cpu = json.loads(kept_file.read_text(encoding="utf-8")), class_of_cpu()
    hashes = kept["hashes"].get(cpu)
    if not (hashes or args.against or args.update):
        print(f"hashes_test: {kept_file} has no hashes for {cpu}; on a build that is known to be right: --update",
              file=sys.stderr)
        return 2
    try:
        found, same = compare(
            args.program, kept["drives"],
            (lambda _, drive: hash_of(args.against, drive, args.trials, 1)) if args.against
            else (lambda name, _: (hashes or {}).get(name, "none")), args.trials)
    except Failed as failure:
        print(f"hashes_test: {failure}", file=sys.stderr)
        return 3
    if args.update:
        kept["hashes"][cpu] = found
        kept_file.write_text(json.dumps(kept, indent=1) + "\n", encoding="utf-8")
        return 0
    return 0 if same else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
