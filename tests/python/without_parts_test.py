#!/usr/bin/env python3
"""Without pandas and matplotlib everything but frames and figures works, and what does not says which package it lacks.

Usage: without_parts_test.py ROCKYARD PLUGINS [unittest's arguments]
"""

import unittest
from pathlib import Path

import package

PROGRAM = """
import sys
for name in ("pandas", "matplotlib", "matplotlib.pyplot", "gymnasium"):
    sys.modules[name] = None  # as where it is not installed
sys.path.insert(0, sys.argv.pop(1))
from package import *
import numpy as np
DESIGN = {"name": "two", "scenario": str(NOMINAL), "set": QUICK, "axes": [{"path": "terrain.rocks.k_per_m2", "values": [0.001, 0.006]}]}
made = run("run", 2, traces=["all"], resume=True)
sweep = ry.sweep(DESIGN, 2, folder="sweep", resume=True)

def lacks(call, package):
    try:
        call()
    except ry.MissingPart as error:
        assert isinstance(error, ImportError)
        assert f"needs {package} (Debian: python3-" in str(error), str(error)
        return
    raise AssertionError(f"{package} was not missed")
"""


class WithoutParts(package.PackageTest):
    def there(self, text):
        package.python(PROGRAM + text, Path(__file__).parent)

    def test_all_else_works(self):
        self.there("""
assert len(made.records) == 2 and made.true_success.trials == 2 and made.units and made.outcomes
trial = made.trial(1)
assert trial.record["trial"] == 1 and trial.trace.position_error_m.size and len(trial.place.rocks)
trial.tum("trial.tum")
assert sweep[1].true_success.trials == 2 and sweep.axes == ["k_per_m2"]
env = ry.Environment(NOMINAL, set=QUICK)
env.reset()
assert ry.compare(sweep[0], sweep[1]).json and made.report(replays=0).exists() and repr(made) and repr(sweep)
ry.write_baseline([made], "baseline.json", "mine", "a test")
assert ry.check(made, "baseline.json").agrees
""")

    def test_what_does_not_names_what_it_lacks(self):
        self.there("""
trace = made.trial(0).trace
for call in (lambda: made.trials, lambda: made.traces("speed_m_s"), lambda: sweep.cells, lambda: sweep.trials, lambda: trace.events,
             lambda: trace.hazards, lambda: ry.compare(sweep[0], sweep[1]).differences, lambda: ry.compare(sweep[0], sweep[1]).successes):
    lacks(call, "pandas")
for call in (lambda: ry.plot.map(made.trial(0)), lambda: ry.plot.cdf(made), lambda: ry.plot.outcomes(made), lambda: ry.plot.success(sweep),
             lambda: ry.plot.over_time(made)):
    lacks(call, "matplotlib")
""")


if __name__ == "__main__":
    package.main()
