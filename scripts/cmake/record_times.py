#!/usr/bin/env python3
"""Runs a test's command, and appends what it took to the file that ROCKYARD_TEST_TIMES names.

Usage: record_times.py NAME COMMAND [ARGUMENT]...
The line: "ctest", NAME, seconds of the clock and of processors, joined by tabs, as those of GoogleTest programs
(tests/test_main.cc). Ends as the command ends.
"""

import os
import resource
import subprocess
import sys
import time


def main(arguments):
    name, *command = arguments
    start = time.monotonic()
    code = subprocess.run(command, check=False).returncode
    file = os.environ.get("ROCKYARD_TEST_TIMES")
    if file:
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        with open(file, "a", encoding="utf-8") as times:
            times.write(f"ctest\t{name}\t{time.monotonic() - start:.3f}\t{usage.ru_utime + usage.ru_stime:.3f}\n")
    return code if code >= 0 else 128 - code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
