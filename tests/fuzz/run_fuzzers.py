#!/usr/bin/env python3
"""Runs the fuzzer of every reader from its corpus: does one crash, hang, leak or throw what is no refusal?

Usage: tests/fuzz/run_fuzzers.py [--runs 1000000] [--slow-runs 100000] [--seed 1] [--jobs 1] [--keep] [READER]...
Wants the preset fuzz: cmake --preset fuzz && cmake --build --preset fuzz --target reader_fuzz
What is found new goes to build/fuzz/corpus/READER, inputs that fail to build/fuzz/findings. --keep then adds to
tests/data/readers what of it reaches code that nothing there reaches.
Exit code: 0, or 1 with any finding.
"""

import argparse
import os
import re
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FUZZER = ROOT / "build/fuzz/tests/fuzz/reader_fuzz"
KEPT = ROOT / "tests/data/readers"
SLOW = ("scenario", "sweep")  # a resolved scenario has a thousand parameters
LONGEST = {"image": 16384, "scenario": 16384, "sweep": 16384}  # bytes of an input; 4096 of the others
# One input: bounds of what is read, not of a quick machine.
LIMITS = ["-timeout=120", "-rss_limit_mb=3000", "-malloc_limit_mb=1500"]


def fuzzer(reader, *words):
    environment = {**os.environ, "ROCKYARD_READER": reader,
                   "ASAN_OPTIONS": "allocator_may_return_null=1:detect_leaks=1"}
    return subprocess.run([FUZZER, *map(str, words)], cwd=ROOT, env=environment, text=True, errors="replace",
                          capture_output=True, check=False)


def run(reader, options):
    """What is said of a reader, and whether nothing was found."""
    grown = ROOT / "build/fuzz/corpus" / reader
    findings = ROOT / "build/fuzz/findings"
    grown.mkdir(parents=True, exist_ok=True)
    findings.mkdir(parents=True, exist_ok=True)
    runs = options.slow_runs if reader in SLOW else options.runs
    longest = f"-max_len={LONGEST.get(reader, 4096)}"
    start = time.monotonic()
    done = fuzzer(reader, f"-runs={runs}", f"-seed={options.seed}", longest, *LIMITS,
                  f"-artifact_prefix={findings}/{reader}-", grown, KEPT / reader)
    count = re.findall(r"Done (\d+) runs", done.stderr)
    told = f"{reader}: {count[-1] if count else 'not all'} runs, {time.monotonic() - start:.0f} s"
    if done.returncode != 0:
        return f"{told}, FOUND\n{done.stderr[-3000:]}", False
    if options.keep:
        fuzzer(reader, "-merge=1", longest, *LIMITS, KEPT / reader, grown)
    return f"{told}, nothing found, {len(list(KEPT.joinpath(reader).iterdir()))} inputs kept", True


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=1_000_000)
    parser.add_argument("--slow-runs", type=int, default=100_000, help=f"of {', '.join(SLOW)}")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--keep", action="store_true")
    parser.add_argument("readers", metavar="READER", nargs="*")
    options = parser.parse_args(arguments)
    known = sorted(folder.name for folder in KEPT.iterdir())
    if unknown := set(options.readers) - set(known):
        parser.error(f"no reader {', '.join(sorted(unknown))}; there are {', '.join(known)}")
    if not FUZZER.is_file():
        parser.error(f"{FUZZER} is not there (see --help)")
    good = True
    with ThreadPoolExecutor(options.jobs) as pool:
        for told, passed in pool.map(lambda reader: run(reader, options), options.readers or known):
            print(told, flush=True)
            good = good and passed
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
