#!/usr/bin/env python3
"""Navigators in Python within the process: the same drives as by a pipe or built in, and whatever is wrong with one ends
as a navigator_fault with its text or as an InputError.

Usage: navigators_test.py ROCKYARD PLUGINS [unittest's arguments]
"""

import contextlib
import io
import sys
from pathlib import Path

import package
import rockyard as ry
from package import EXAMPLES, NOMINAL, PLUGINS, QUICK, SEED, TOLERANCE, navigator, raises, run
from rockyard import inprocess
from rockyard.navigator import arrived, drive, look, parameter, rest, turn

import numpy as np

# Typed into a prompt: there is no file with its source.
TYPED = """
class Typed(Navigator):
    name, doc, version, gain = "typed", "of a prompt", "2.1", GAIN
    parameters = [parameter("goal_tolerance_m", "real", 0.3, "arrives within", min=0, max=5)]
    def decide(self, seen):
        odd = [each for each in (1, 2, 3) if each in {"a", "b", 1, 3}]
        if seen.estimate.x_m > self.goal.x_m - 0.2: return arrived()
        return drive(self.gain * len(odd) * 0.01, until_distance_m=0.7)
"""


def typed(gain=1.5):
    space = {"Navigator": ry.Navigator, "parameter": parameter, "drive": drive, "arrived": arrived}
    exec(TYPED.replace("GAIN", repr(gain)), space)
    return space["Typed"]


class Weaves(ry.Navigator):
    """Looks, drives to the side without a hazard, and counts."""

    name, doc, version = "weaves", "looks and weaves", "1.0"
    parameters = [TOLERANCE, parameter("step_m", "real", 0.4, "between two looks", min=0.1, max=2)]
    own_values = [("looks", "1", "Looks that it took."), ("longest_s", "s", "Time of the last look.")]

    def traits(self):
        return {**super().traits(), "reads": "hazards"}

    def start(self, setup):
        self.side = 1.0 if int(setup.random_seed) % 2 else -1.0

    def decide(self, seen):
        if abs(self.goal.x_m - seen.estimate.x_m) < self.p.goal_tolerance_m:
            return arrived()
        if seen.report is None:
            return look()
        self.own["looks"] += 1
        self.own["longest_s"] = seen.time_s
        if any(seen.report.hazards):
            return turn(1 if self.side > 0 else -1, 0.6)
        return drive(-0.1 * seen.estimate.y_m, until_distance_m=self.p.step_m)


class Same(package.PackageTest):
    def test_the_example_decides_as_by_a_pipe_and_as_its_library(self):
        sys.path.insert(0, str(EXAMPLES))
        self.addCleanup(sys.path.remove, str(EXAMPLES))
        from arc_planner import ArcPlanner  # of rockyard_navigator, as the process imports it
        here = run("here", 2, deciders=[ArcPlanner], threads=2)
        piped = run("piped", 2, plugins=[{"process": f"{sys.executable} {EXAMPLES / 'arc_planner.py'}"}])
        self.assertEqual(here.hash, piped.hash)
        self.assertGreater(here.records["arc_planner.plans"].min(), 0)
        self.assertGreater(ArcPlanner.uses.decisions, 20)
        self.assertGreater(ArcPlanner.uses.longest_s, 0)
        self.assertNotEqual(here.hash, run("pathfinder", 2).hash)

    def test_the_twin_library_decides_as_what_is_built_in(self):
        built_in = run("built_in", 6)
        twin = run("twin", 6, plugins=[PLUGINS["pathfinder_twin"]], threads=2)
        self.assertEqual(twin.hash, built_in.hash)
        self.assertEqual(twin.scenario["navigation.navigator"], "pathfinder_twin")

    def test_threads_take_turns(self):
        one = run("one", 8, deciders=[Weaves], threads=1)
        two = run("two", 8, deciders=[Weaves], threads=2)
        self.assertEqual(one.hash, two.hash)
        self.assertEqual(package.tables("one")["trials"], package.tables("two")["trials"])
        self.assertNotIn("navigator_fault", one.outcomes)

    def test_own_values_are_columns(self):
        made = run("counted", 3, deciders=[Weaves])
        self.assertGreater(made.records["weaves.looks"].min(), 0)
        self.assertEqual(made.units["weaves.longest_s"], "s")
        self.assertEqual(made.meanings["weaves.looks"], "Looks that it took.")
        self.assertIn("weaves.looks", made.summary["metrics"])
        looked = made.records["scans"] - made.records["rescans"]
        self.assertTrue(np.all(made.records["weaves.looks"] <= made.records["scans"]), looked)

    def test_parameters_are_set_and_checked(self):
        short = run("short", 2, deciders=[Weaves], set={"navigation.weaves.step_m": 0.2})
        self.assertGreater(short.records["weaves.looks"].sum(), run("long", 2, deciders=[Weaves]).records["weaves.looks"].sum())
        refused = self.refusal(run, "wrong", 2, deciders=[Weaves], set={"navigation.weaves.step_m": 9})
        self.assertEqual([problem.path for problem in refused.problems], ["navigation.weaves.step_m"])
        held = ry.Scenario(NOMINAL, set=QUICK, deciders=[Weaves])
        self.assertEqual(held.navigation.weaves.step_m, 0.4)
        held["navigation.weaves.step_m"] = 0.2
        self.assertEqual(ry.run(held, 2, SEED, folder="held").hash, short.hash)

    def test_a_scenario_that_goes_back_to_another_navigator_keeps_it(self):
        held = ry.Scenario(NOMINAL, set=QUICK, deciders=[Weaves]).set({"navigation.navigator": "pathfinder"})
        self.assertEqual(held.copy()["navigation.navigator"], "pathfinder")
        made = ry.run(held, 2, SEED, folder="back")
        self.assertEqual(list(made.records["true_distance_m"]), list(run("plain", 2).records["true_distance_m"]))
        self.assertEqual(ry.run(held, 2, SEED, folder="again", deciders=[Weaves]).scenario["navigation.navigator"], "weaves")

    def test_two_navigators_stand_side_by_side(self):
        other = navigator("other")
        made = run("both", 2, deciders=[other, Weaves])
        self.assertEqual(made.hash, run("both_too", 2, deciders=(each for each in (other, Weaves))).hash)
        self.assertEqual(made.scenario["navigation.navigator"], "weaves")
        first = run("first", 2, deciders=[other, Weaves], set={"navigation.navigator": "other"})
        alone = run("alone", 2, deciders=[other])
        self.assertEqual(list(first.records["true_distance_m"]), list(alone.records["true_distance_m"]))


class Traces(package.PackageTest):
    def test_a_trace_needs_the_deciders_again(self):
        made = run("run", 2, deciders=[Weaves])
        for opened in (made, ry.load("run", deciders=[Weaves])):
            trace = opened.trial(1).trace
            self.assertEqual(trace.meta["outcome"], opened.trial(1).record["outcome"])
            self.assertEqual(trace.position_m[-1][0], opened.trial(1).record["final_x_m"])
        without = ry.load("run")
        self.assertEqual(without.trial(1).record["outcome"], made.trial(1).record["outcome"])
        told = str(self.refusal(lambda: without.trial(1).trace))
        self.assertIn("deciders=", told)
        self.assertIn("weaves", told)
        held = ry.run(ry.Scenario(NOMINAL, set=QUICK, deciders=[Weaves]), 1, SEED, folder="held")
        self.assertEqual(held.trial(0).trace.meta["trial"], 0)

    def test_another_class_of_that_name_does_not_repeat_the_record(self):
        run("mine", 1, deciders=[navigator("mine")])
        other = navigator("mine", decide=lambda self, seen: drive(0.3, until_distance_m=0.5))
        self.assertIn("use the program", str(self.refusal(lambda: ry.load("mine", deciders=[other]).trial(0).trace)))

    def test_a_run_goes_on_with_the_same_class_alone(self):
        whole = run("whole", 4, deciders=[Weaves])
        run("half", 2, deciders=[Weaves])
        self.assertEqual(run("half", 4, deciders=[Weaves], resume=True).hash, whole.hash)
        other = type("Weaves", (Weaves,), {"version": "1.1"})
        told = str(self.refusal(run, "half", 6, deciders=[other], resume=True))
        self.assertIn("weaves 1.0", told)
        self.assertIn("weaves 1.1", told)
        package.command_run("half", "--resume", trials=6, ends=2)

    def test_a_replay_says_what_it_lacks(self):
        made = run("replayed", 1, deciders=[Weaves])
        self.refusal(made.trial(0).replay)


class Identities(package.PackageTest):
    def test_a_class_of_a_prompt_has_the_same_identity_in_every_process(self):
        made = run("typed", 1, deciders=[typed()])
        self.assertEqual(made.outcomes.get("navigator_fault"), None)
        again = package.python("""
            import sys
            sys.path.insert(0, sys.argv.pop(1))
            import navigators_test as test
            print(test.inprocess.identity(test.typed()))
            print(test.run(sys.argv[1], 2, deciders=[test.typed()], resume=True).hash)
            """, Path(__file__).parent, self.folder / "typed").stdout.split("\n")
        self.assertEqual(again[0], inprocess.identity(typed()))
        self.assertEqual(again[1], run("undisturbed", 2, deciders=[typed()]).hash)

    def test_what_decides_is_in_the_identity(self):
        base = inprocess.identity(typed())
        self.assertRegex(base, r"^typed 2\.1 [0-9a-f]{16}$")
        others = {
            "a constant of the class": typed(1.6),
            "a method more": type("Typed", (typed(),), {"start": lambda self, setup: None}),
            "another number in it": navigator("typed", decide=lambda self, seen: drive(0.1)),
            "and another": navigator("typed", decide=lambda self, seen: drive(0.2)),
            "what a closure holds": self.closing(1),
            "and something else": self.closing(2),
            "a function of the class": navigator("typed", helper=staticmethod(lambda: 1)),
            "and another one": navigator("typed", helper=staticmethod(lambda: 2)),
        }
        found = {base, *(inprocess.identity(each) for each in others.values())}
        self.assertEqual(len(found), 1 + len(others))

    def test_what_a_class_counts_is_not_in_the_identity(self):
        counted = []
        made = navigator("typed", decide=lambda self, seen: counted.append(1), counts=counted)
        before = inprocess.identity(made)

        def again(self, seen):
            return again(self, seen) if never else drive()
        self.assertRegex(inprocess.identity(navigator("recurs", decide=again)), "^recurs 1 ")
        never = False
        counted.append(1)
        made.uses = inprocess.Uses()
        self.assertEqual(inprocess.identity(made), before)

    @staticmethod
    def closing(value):
        return navigator("typed", decide=lambda self, seen: drive(value))

    def test_the_source_of_a_file_is_its_identity(self):
        program = """
            import sys, rockyard.navigator as n, rockyard.inprocess as i
            open("mine.py", "w").write(sys.argv[1])
            sys.path.insert(0, ".")
            import mine
            print(i.identity(mine.Mine))
            """
        source = "import rockyard as ry\nclass Mine(ry.Navigator):\n    name = 'mine'\n    gain = 1\n"
        told = [package.python(program, text).stdout for text in (source, "# more\n" + source, source.replace("1", "2"))]
        self.assertEqual(told[0], told[1])
        self.assertNotEqual(told[0], told[2])


class Failures(package.PackageTest):
    """What fails in a drive ends it with a cause and a text; what fails before is refused."""

    IN_A_DRIVE = {
        "decide raises": ({"decide": raises(ValueError("lost it"))}, "threw", r"ValueError: lost it \(.*package.py:\d+\)"),
        "start raises": ({"start": raises(KeyError("goal"))}, "threw", "KeyError: 'goal'"),
        "it leaves": ({"decide": raises(SystemExit(3))}, "threw", "SystemExit: 3"),
        "it leaves at the start": ({"start": raises(SystemExit(3))}, "threw", "SystemExit"),
        "it interrupts": ({"decide": raises(KeyboardInterrupt())}, "threw", "KeyboardInterrupt"),
        "it ends a generator": ({"decide": raises(GeneratorExit())}, "threw", "GeneratorExit"),
        "it recurs": ({"decide": lambda self, seen: self.decide(seen)}, "threw", "RecursionError"),
        "None": ({"decide": lambda self, seen: None}, "threw", r"decide\(\) returned None"),
        "a list": ({"decide": lambda self, seen: [1]}, "threw", "TypeError"),
        "a text": ({"decide": lambda self, seen: "left"}, "threw", "TypeError"),
        "no number": ({"decide": lambda self, seen: drive(float("nan"))}, "threw", "not JSON compliant"),
        "endless": ({"decide": lambda self, seen: drive(float("inf"))}, "threw", "not JSON compliant"),
        "a number of NumPy": ({"decide": lambda self, seen: drive(np.float32(0.1))}, "threw", "float32"),
        "too large a number": ({"decide": lambda self, seen: drive(10 ** 400)}, None, "number|range|1000"),
        "too sharp": ({"decide": lambda self, seen: drive(1e6)}, "nonsense", "curvature_per_m"),
        "too fast": ({"decide": lambda self, seen: drive(speed_share=2.0)}, "nonsense", "speed_share"),
        "an unknown motion": ({"decide": lambda self, seen: {"motion": {"kind": "fly"}}}, "message", "kind"),
        "an unknown status": ({"decide": lambda self, seen: {"status": "bored"}}, "message", "status"),
        "an unknown look": ({"decide": lambda self, seen: look("up")}, "message", "look"),
        "waits for nothing": ({"decide": lambda self, seen: {}}, "nonsense", "more decisions than its time has"),
        "an own value that is none": (
            {"own_values": [("n", "1", "A number.")], "decide": lambda self, seen: self.own.update(n="many") or rest(1)},
            "message", "own_values"),
        "an own value more": (
            {"own_values": [("n", "1", "A number.")], "decide": lambda self, seen: self.own.update(m=1) or rest(1)},
            "message", "own_values"),
    }

    BEFORE = {
        "traits raise": ({"traits": raises(RuntimeError("no traits"))}, "RuntimeError: no traits"),
        "traits leave": ({"traits": raises(SystemExit(3))}, "SystemExit: 3"),
        "no traits": ({"traits": lambda self: None}, "NoneType"),
        "traits of a wrong type": ({"traits": lambda self: {"reads": 3}}, "reads"),
        "it cannot be made": ({"__init__": raises(ValueError("no"))}, "ValueError: no"),
        "it wants more": ({"__init__": lambda self, more: None}, "TypeError"),
        "no name": ({"name": ""}, "cannot be the name"),
        "a name with a space": ({"name": "a b"}, "cannot be the name"),
        "a number for a name": ({"name": 3}, r"Mine\.name: is 3"),
        "no text for its doc": ({"doc": None}, r"Mine\.doc: is None"),
        "a number for its version": ({"version": 1}, r"Mine\.version: is 1"),
        "a name that is taken": ({"name": "pathfinder"}, "is taken"),
        "a key for a name": ({"name": "limits"}, "limits"),
        "parameters that are none": ({"parameters": 3}, r"Mine\.parameters"),
        "a parameter without a type": ({"parameters": [{"name": "x"}]}, r"parameters\[0\]\.type"),
        "a parameter that is no JSON": ({"parameters": [{"name": object()}]}, r"Mine\.parameters"),
        "no tolerance": ({"parameters": []}, "goal_tolerance_m"),
        "own values that are none": ({"own_values": 5}, r"Mine\.own_values"),
        "a text for own values": ({"own_values": "abc"}, r"Mine\.own_values"),
        "own values of two": ({"own_values": [("a", "1")]}, "three texts"),
    }

    def test_what_fails_in_a_drive_is_its_fault(self):
        for name, (members, cause, text) in self.IN_A_DRIVE.items():
            with self.subTest(name), contextlib.redirect_stderr(io.StringIO()):
                told = package.fault(navigator(**members))
                self.assertRegex(told, (package.CAUSES[cause] if cause else "") + ".*" + text)

    def test_what_fails_in_a_run_stands_in_its_files(self):
        with contextlib.redirect_stderr(io.StringIO()):
            made = run("run", 3, deciders=[navigator(decide=raises(ValueError("lost it")))], threads=2)
        self.assertEqual(made.outcomes, {"navigator_fault": 3})
        for index, row in enumerate(package.rows("run")):
            self.assertEqual(row["cause"], "navigator_threw")
            self.assertIn("ValueError: lost it", row["detail"])
            self.assertEqual(row["detail"], made.trial(index).detail)

    def test_what_fails_before_is_refused(self):
        for number, (name, (members, text)) in enumerate(self.BEFORE.items()):
            with self.subTest(name), contextlib.redirect_stderr(io.StringIO()):
                given = {"name": "mine", **members}
                made = navigator(given.pop("name"), **given)
                refused = self.refusal(run, f"before{number}", 2, deciders=[made])
                self.assertRegex(str(refused), text)
                self.assertFalse(Path(f"before{number}").exists())

    def test_wrong_deciders_are_refused(self):
        for wrong in (navigator()(), "arc_planner", 3, int, ry.Scenario, None):
            with self.subTest(repr(wrong)[:40]):
                self.assertIn("class" if not isinstance(wrong, type) else "neither", str(self.refusal(run, "wrong", 1, deciders=[wrong])))
        self.assertIn("is taken", str(self.refusal(run, "wrong", 1, deciders=[navigator(), navigator()])))
        self.assertFalse(Path("wrong").exists())

    def test_a_failure_is_shown_once(self):
        program = """
            import sys
            sys.path.insert(0, sys.argv.pop(1))
            from package import navigator, raises, run
            def decide(self, seen):
                raise ValueError("lost it")
            run("shown", 4, deciders=[navigator(decide=decide)])
            """
        self.assertEqual(package.python(program, Path(__file__).parent).stderr.count("Traceback (most"), 1)


if __name__ == "__main__":
    package.main()
