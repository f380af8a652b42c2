"""How fast environments are beside the plain loop: the same trials, decided by the same trivial policy.

    PYTHONPATH=build/release/python tests/python/environment_speed.py build/test/tests/navigators/libstraight_ahead.so

The plain loop is that of a campaign with the policy as a plugin in C++. All drive quasi-statically on one
thread, turn by turn, so that the machine's mood meets them alike. Prints decisions a CPU second, ratios,
and whether the records are the same.
"""
import statistics
import sys
import time

import numpy as np

import rockyard as ry
from rockyard.environment import arrived, forward, look

TRIALS, ROUNDS, SETTINGS = 200, 7, {"rover.fidelity": "quasi_static"}
ACTIONS = np.array([look(), forward(until_distance_m=0.25), arrived()])


def plain(library):
    scenario = ry.Scenario("nominal", {**SETTINGS, "plugins": [library], "navigation.navigator": "straight_ahead"})
    return lambda: [scenario.run_trial(trial) for trial in range(TRIALS)]


def one_at_a_time():
    environment = ry.Environment("nominal", set=SETTINGS)

    def drive(trial):
        seen, _ = environment.reset(index=trial)
        while True:
            drive.decisions += 1
            action = ACTIONS[2] if seen["goal"][2] < 0.3 else ACTIONS[seen["looked"]]
            seen, _, ended, out_of_time, told = environment.step(action)
            if ended or out_of_time:
                return told["record"]

    def all_of_them():
        drive.decisions = 0
        records = [drive(trial) for trial in range(TRIALS)]
        all_of_them.decisions = drive.decisions
        return records
    return all_of_them


def side_by_side(count):
    environments = ry.Environments("nominal", count, set=SETTINGS)

    def all_of_them():
        records, driven = [None] * TRIALS, list(range(count))
        seen, begun = environments.reset(driven), count
        while None in records:
            seen, ended = environments.step(ACTIONS[np.where(seen["goal"][:, 2] < 0.3, 2, seen["looked"])])
            for lane in np.flatnonzero(ended):
                records[driven[lane]] = environments.record(int(lane))
                if begun < TRIALS:
                    driven[lane], begun = begun, begun + 1
                    environments.reset([driven[lane]], lanes=[int(lane)])
        return records
    return all_of_them


def main():
    loops = {"plain": plain(sys.argv[1]), "Environment": one_at_a_time(), "Environments(16)": side_by_side(16)}
    used = {name: [] for name in loops}
    records = {}
    for _ in range(ROUNDS):
        for name, loop in loops.items():
            began = time.process_time()
            records[name] = loop()
            used[name].append(time.process_time() - began)
    decisions = loops["Environment"].decisions
    for name, times in used.items():
        ratios = [first / each for first, each in zip(used["plain"], times)]
        same = all(repr(each) == repr(first) for each, first in zip(records[name], records["plain"]))
        print(f"{name:18} {decisions / min(times):8.0f} decisions a CPU second, {statistics.median(ratios):.2f} of the plain "
              f"loop ({min(ratios):.2f} .. {max(ratios):.2f}), records {'the same' if same else 'DIFFER'}")


if __name__ == "__main__":
    main()
