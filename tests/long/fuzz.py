#!/usr/bin/env python3
"""Gives rockyard what nobody should: does it ever crash, hang, or answer in words that are not its own?

    scenarios  files of scenarios/ with changed types, keys, numbers, depths and encodings, read by `validate`
    valid      scenarios with extreme values that are allowed, run for two trials at both fidelities
    lines      command lines of every subcommand and option; some of them write into a full disk or a closed pipe

A failure is an end by a signal, none within a minute or two, an exit code that no page knows (or 5, which is
for disks and machines), a message of a library or of the language, a refusal without a reason, and a simulator
fault in an allowed scenario. Each is kept in a folder, with the line that makes it again. Trials that take more
CPU time than a limit are counted, not failures. Each case is made of the seed and its own number.

Exit code: 0 no failure, 1 failures.

    tests/long/fuzz.py --seed 1 --scenarios 200000 --valid 10000 --lines 20000
"""

import argparse
import sys
import time
from pathlib import Path

from fuzzing import harness, lines, scenarios, valid

PARTS = {"scenarios": scenarios, "valid": valid, "lines": lines}


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for part in PARTS:
        parser.add_argument(f"--{part}", type=int, default=0, metavar="N", help="cases of this part")
    parser.add_argument("--first", type=int, default=0, metavar="I", help="begin with case I of N")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--rockyard", type=Path, default=harness.ROOT / "build/release/bin/rockyard")
    parser.add_argument("--out", type=Path, default=harness.ROOT / "results/runs/fuzz", help="folder for failures")
    options = parser.parse_args(arguments)
    if not any(getattr(options, part) for part in PARTS):
        parser.error("name a part and its number of cases, such as --scenarios 1000")
    if not options.rockyard.is_file():
        parser.error(f"{options.rockyard} is not there: build it, or name it with --rockyard")
    failed = False
    for name, part in PARTS.items():
        count = getattr(options, name)
        if count <= 0:
            continue
        findings = harness.Findings(name, options.seed, options.out.resolve())
        start = time.monotonic()
        part.run(str(options.rockyard.resolve()), options.first, count, findings)
        print(f"{findings.summary()}, {time.monotonic() - start:.0f} s", flush=True)
        for failure in findings.failures:
            print(f"  {failure}", flush=True)
        failed = failed or bool(findings.failures)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
