#!/usr/bin/env python3
"""Whether what trials are computed by calls elementary functions of the C library, whose bits depend on the processor.

Usage: elementary_test.py BUILD_FOLDER
Looks into the archives of all modules but those that rule 4 of src/README.md names, headers of Eigen and of the
standard library included. Exit code 0: no calls; 1: calls, one line each; 2: no archives.
"""

import re
import subprocess
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "scripts"))
from layers.rules import read_rules  # noqa: E402  (the path comes first)

CALL = re.compile(r"\s+U (a?(?:sin|cos|tan)h?|atan2|sincos|exp(?:2|10|m1)?|log(?:2|10|1p)?|pow|cbrt|hypot|erfc?|"
                  r"[lt]gamma|j[01n]|y[01n])[fl]?(?:@.*)?$", re.M)


def calls(listing):
    """The elementary functions in what nm says of an archive."""
    return sorted({match.group(1) for match in CALL.finditer(listing)})


def main(build):
    free = read_rules(ROOT / "src/README.md").free
    archives = sorted(path for path in Path(build, "src").glob("*/librockyard_*.a") if path.parent.name not in free)
    if not archives:
        print(f"elementary_test: no archives in {build}", file=sys.stderr)
        return 2
    found = False
    for archive in archives:
        listing = subprocess.run(["nm", "-u", archive], text=True, capture_output=True, check=True).stdout
        for name in calls(listing):
            print(f"{archive.name} calls {name} of the C library: see math/functions.h")
            found = True
    return 1 if found else 0


class Calls(unittest.TestCase):
    def test_listings_of_nm(self):
        found = calls("a.o:\n                 U sincos\n                 U expl@GLIBC_2.29\n                 U powf\n")
        self.assertEqual(found, ["exp", "pow", "sincos"])
        self.assertEqual(calls("                 U sqrt\n                 U _Zsin\n0000000000000000 T sin\n"), [])


if __name__ == "__main__":
    if len(sys.argv) == 2:
        sys.exit(main(sys.argv[1]))
    unittest.main()
