#!/usr/bin/env python3
"""Whether first trials have the records that hashes.json keeps: the same bits as those of every other build.

Usage: hashes_test.py PROGRAM [--against PROGRAM [--trials N] | --levels [N]] [--update]
PROGRAM is hash_trials of the build under test. Each drive of hashes.json runs on one thread, and on two as if the
processor had neither AVX nor fused operations.
  --against PROGRAM  instead: the hashes of another build's hash_trials
  --trials N         of each drive with --against
  --levels [N]       instead: N trials (default: 200) of each drive and of some scenarios more, as if the processor
                     were of x86-64-v2, -v3 and, where it is, -v4: one hash of all
  --update           write the hashes, in a commit that changes results on purpose
Exit code 0: the same; 1: a hash differs; 2: wrong use; 3: a program fails.
"""

import argparse
import json
import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent


# What is hidden of the processor: from the program's own dispatch and from the GNU C library, under its names of
# before and after 2.33.
LEVELS = {
    "as it is": ((), ""),
    "x86-64-v2": (("--without-avx",), "-AVX,-AVX2,-AVX_Usable,-AVX2_Usable,-FMA,-FMA_Usable,-FMA4,-BMI2,-AVX512F,-AVX512VL"),
    "x86-64-v3": (("--without-avx512",), "-AVX512F,-AVX512VL,-AVX512BW,-AVX512DQ"),
}
LACKS = 77  # hash_trials: there is nothing to hide

# What the kept drives leave out of those that --levels runs.
MORE = {
    "images, GESTALT": {"scenario": "scenarios/gestalt/abundance_images.json", "trials": 5, "set": []},
    "images, hazards": {"scenario": "scenarios/hazard_detection/detection_image.json", "trials": 20, "set": []},
    "mission": {"scenario": "scenarios/mission/tour.json", "trials": 5, "set": []},
}


class Failed(Exception):
    """A program gave no hash."""


def hash_of(program, drive, trials, threads, level="as it is"):
    hidden, features = LEVELS[level]
    command = [program, str(ROOT / drive["scenario"]), str(trials or drive["trials"]), str(threads), *hidden,
               *drive["set"]]
    environment = os.environ | {"GLIBC_TUNABLES": f"glibc.cpu.hwcaps={features}"} if features else None
    result = subprocess.run(command, text=True, capture_output=True, check=False, env=environment)
    if result.returncode == LACKS and hidden:
        return hash_of(program, drive, trials, threads)
    if result.returncode != 0 or not result.stdout.strip():
        raise Failed(f"{' '.join(command)} ended with {result.returncode}: {result.stderr}")
    return result.stdout.strip()


def compare(program, drives, wanted_of, trials):
    """(hashes by drive, whether all are as wanted, on two threads without AVX as well); says so line by line."""
    found, all_same = {}, True
    for name, drive in drives.items():
        found[name] = hash_of(program, drive, trials, 1)
        wanted = wanted_of(name, drive)
        on_two = hash_of(program, drive, trials, 2, "x86-64-v2")
        same = found[name] == on_two == wanted
        all_same = all_same and same
        told = "same" if same else f"DIFFERS from {wanted} (two threads, without AVX: {on_two}):"
        print(f"{told} {found[name]}  {name}", flush=True)
    return found, all_same


def compare_levels(program, drives, trials, told=print):
    """Whether the drives have one hash each at all levels; says so line by line."""
    all_same = True
    for name, drive in drives.items():
        found = {level: hash_of(program, drive, trials, 2, level) for level in LEVELS}
        same = len(set(found.values())) == 1
        all_same = all_same and same
        told(f"same {found['as it is']}  {name}" if same else f"DIFFERS {found}  {name}", flush=True)
    return all_same


def main(arguments, kept_file=Path(__file__).with_name("hashes.json")):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", metavar="PROGRAM")
    parser.add_argument("--against", metavar="PROGRAM")
    parser.add_argument("--trials", type=int, metavar="N")
    parser.add_argument("--levels", type=int, nargs="?", const=200, metavar="N")
    parser.add_argument("--update", action="store_true")
    args = parser.parse_args(arguments)
    if args.trials and not args.against:
        parser.error("--trials goes with --against: hashes are kept of the trials that hashes.json names")
    kept = json.loads(kept_file.read_text(encoding="utf-8"))
    try:
        if args.levels:
            return 0 if compare_levels(args.program, kept["drives"] | MORE, args.levels) else 1
        found, same = compare(
            args.program, kept["drives"],
            (lambda _, drive: hash_of(args.against, drive, args.trials, 1)) if args.against
            else (lambda name, _: kept["hashes"].get(name, "none")), args.trials)
    except Failed as failure:
        print(f"hashes_test: {failure}", file=sys.stderr)
        return 3
    if args.update:
        kept["hashes"] = found
        kept_file.write_text(json.dumps(kept, indent=1) + "\n", encoding="utf-8")
        return 0
    return 0 if same else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
