"""scripts/studies.py on a small repository: what it refuses, makes, marks and names."""

import fcntl
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]

# Gives a hash by the scenario's text and the file `bits`, which stands for what the program computes.
ROCKYARD = rf"#!{sys.executable} -IS" + r"""
import hashlib, json, pathlib, sys
root = pathlib.Path(__file__).resolve().parents[3]
words = sys.argv[1:]
if words == ["--version"]:
    print(f"rockyard 0.1.0 (commit {(root / 'build/commit').read_text().strip()}, GNU)")
    sys.exit()
words[1] = {"one": "scenarios/one.json", "a_run": "scenarios/one.json"}.get(words[1], words[1])
text = pathlib.Path(words[1]).read_text() + " ".join(w for a, w in zip(words, words[1:]) if a in ("--set", "--seed"))
made = lambda *parts: hashlib.sha256(" ".join(parts).encode()).hexdigest()[:16]
bits = json.loads((root / "build/bits").read_text()).get(pathlib.Path(words[1]).stem, "")
trials = words[words.index("--trials") + 1]
print(json.dumps({"fingerprint": made(text), "trial_hash": made(text, bits, trials)}))
"""
SCRIPT = f"#!{sys.executable} -IS" + """
import os, subprocess, sys, time
from pathlib import Path
page, rockyard = sys.argv[1:3]
Path("build/python_path").write_text(os.environ["PYTHONPATH"])
Path(page).write_text("# Half\\n")
if Path("build/slow").exists():
    time.sleep(600)
if Path("build/fails").exists():
    sys.exit(3)
named = Path("build/scenario")
scenario = named.read_text() if named.exists() else f"scenarios/{Path(page).stem}.json"
said = subprocess.run([rockyard, "run", scenario, "--trials", "50"], capture_output=True,
                      text=True, check=True).stdout
Path(page).write_text(f"# Page\\n\\n{said}")
"""


class Runner(unittest.TestCase):
    """Two studies, each with a scenario and a page."""

    prepared = None  # the tree of a new test, with ".made" beside it where both studies were made

    @classmethod
    def setUpClass(cls):
        cls.prepared = Path(cls.enterClassContext(tempfile.TemporaryDirectory())).resolve() / "tree"

    def setUp(self):
        self.root = Path(self.enterContext(tempfile.TemporaryDirectory())).resolve() / "tree"
        if self.prepared.exists():
            shutil.copytree(self.prepared, self.root)
        else:
            self.plant()
            shutil.copytree(self.root, self.prepared)

    def plant(self):
        shutil.copytree(ROOT / "scripts/studies/runner", self.root / "scripts/studies/runner",
                        ignore=shutil.ignore_patterns("__pycache__"))
        shutil.copy(ROOT / "scripts/studies.py", self.root / "scripts/studies.py")
        self.write("build/release/bin/rockyard", ROCKYARD).chmod(0o755)
        self.write("build/bits", "{}")
        self.write(".gitignore", "build/\n__pycache__/\nresults/runs/\n")
        self.write("CHANGELOG.md", "# Changelog\n\n### Changes results\n\n- Old.\n\n### Does not\n\n- Other.\n")
        self.write("src/code.cc", "int x;\n")
        for name in ("one", "two"):
            self.write(f"scenarios/{name}.json", json.dumps({"name": name}))
            self.write(f"results/{name}.md", "# Page\n\nMade by rockyard 0.1.0 abcdef012345.\n")
            self.write(f"scripts/studies/{name}/{name}.py", SCRIPT).chmod(0o755)
            self.declare(name)
        self.git("init", "-q")
        self.commit()
        self.build()

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return path

    def read(self, name):
        return (self.root / name).read_text(encoding="utf-8")

    def declare(self, name, **other):
        study = {"what": "A page.", "cells": [{"scenario": f"scenarios/{name}.json"}], "cpu_minutes": 1,
                 "commands": [f"scripts/studies/{name}/{name}.py results/{name}.md {{rockyard}}"],
                 "writes": [f"results/{name}.md"]} | other
        self.write(f"scripts/studies/{name}/study.json", json.dumps({name: study}))

    def git(self, *words):
        return subprocess.run(["git", "-c", "user.name=x", "-c", "user.email=x@x", *words], cwd=self.root, text=True,
                              capture_output=True, check=True).stdout.strip()

    def commit(self):
        self.git("add", "-A")
        self.git("commit", "-q", "-m", "x")

    def build(self):
        self.write("build/commit", self.git("rev-parse", "--short=12", "HEAD"))

    def call(self, *words):
        result = subprocess.run([sys.executable, self.root / "scripts/studies.py", *words], text=True,
                                capture_output=True, check=False)
        return result.returncode, result.stdout, result.stderr

    def made(self, anew=False):
        """Both studies made and committed; `anew` where the test has declared other ones."""
        made = self.prepared.with_name("tree.made")
        if anew or not made.exists():
            self.assertEqual(self.call("run", "one", "two")[0], 0)
            self.commit()
            if not anew:
                shutil.copytree(self.root, made, ignore=shutil.ignore_patterns("runs"))  # whose paths are absolute
        else:
            shutil.rmtree(self.root)
            shutil.copytree(made, self.root)

    def test_studies_take_the_package_of_the_build(self):
        self.assertEqual(self.call("run", "one")[0], 0)
        self.assertEqual(self.read("build/python_path").split(os.pathsep)[0], str(self.root / "build/release/python"))

    def test_a_page_without_a_stamp_must_say_so_with_the_build_that_it_names(self):
        code, said, _ = self.call("check")
        self.assertEqual(code, 1)
        line = ("> **Stale**: made by rockyard 0.1.0 abcdef012345; today's program may give other numbers. "
                "`scripts/studies.py run one` makes it anew.")
        self.assertIn(line, said)
        self.assertEqual(self.call("check", "--mark")[0], 0)
        self.assertIn(f"# Page\n\n<!-- begin made -->\n{line}\n<!-- end made -->\n\nMade by",
                      self.read("results/one.md"))
        self.assertEqual(self.call("check")[0], 0)
        self.assertEqual(self.call("stale")[0], 0)

    def test_what_was_made_is_stamped_and_current(self):
        self.made()
        stamp = json.loads(self.read("results/stamps/one.json"))
        self.assertEqual(stamp["commit"], self.read("build/commit"))
        self.assertEqual([cell["file"] for cell in stamp["cells"]], ["scenarios/one.json"])
        self.assertEqual(stamp["cells"][0]["trials"], 20)  # of 50 that the study drove
        self.assertIn(f"> Made by rockyard 0.1.0 {stamp['commit']} by `scripts/studies.py run one`.",
                      self.read("results/one.md"))
        self.assertEqual(self.call("check")[0], 0)
        self.assertEqual(self.call("stale")[0], 0)

    def test_other_trials_name_the_right_page_and_no_other(self):
        self.made()
        self.write("build/bits", json.dumps({"one": "others"}))
        code, said, _ = self.call("stale")
        self.assertEqual(code, 1)
        self.assertIn("one: scenarios/one.json: other trials; stale: results/one.md", said)
        self.assertIn("one is stale, and its pages do not say so", said)
        self.assertNotIn("two", said)
        self.assertEqual(self.call("stale", "--mark")[0], 0)
        self.assertIn("**Stale**", self.read("results/one.md"))
        self.assertNotIn("**Stale**", self.read("results/two.md"))
        self.assertEqual((self.call("check")[0], self.call("stale")[0]), (0, 0))
        self.write("build/bits", "{}")  # and back again: the mark is what is wrong then
        self.assertIn("is marked as giving other trials, and does not", self.call("stale")[1])
        self.assertEqual(self.call("stale", "--mark")[0], 0)
        self.assertNotIn("**Stale**", self.read("results/one.md"))

    def test_another_scenario_names_its_page(self):
        self.made()
        stamp = json.loads(self.read("results/stamps/two.json"))
        stamp["cells"][0]["fingerprint"] = "0" * 16
        self.write("results/stamps/two.json", json.dumps(stamp))
        code, said, _ = self.call("stale")
        self.assertEqual(code, 1)
        self.assertIn("two: scenarios/two.json: another scenario", said)
        self.assertNotIn("one:", said)

    def test_a_marked_page_that_is_current_fails_and_so_does_an_unmarked_stale_one(self):
        self.made()
        current = self.read("results/one.md")
        self.write("results/one.md", current.replace("> Made by", "> **Stale**: made by"))
        self.assertEqual(self.call("check")[0], 1)
        self.write("results/one.md", current)
        self.assertEqual(self.call("check")[0], 0)
        (self.root / "results/stamps/one.json").unlink()
        code, said, _ = self.call("check")
        self.assertEqual(code, 1)
        self.assertIn("results/one.md does not say at its head: > **Stale**", said)
        self.assertNotIn("results/two.md", said)

    def test_a_later_change_of_results_asks_for_the_pages_that_it_touches(self):
        self.made()
        change = "### Changes results\n\n- New words{}.\n- Old.\n"
        for touches, pages in ((" (touches: scenarios/t*)", {"two"}), (" (touches: scenarios/x.json)", set()),
                               ("", {"one", "two"})):
            self.write("CHANGELOG.md", change.format(touches))
            said = self.call("check")[1]
            self.assertEqual({name for name in ("one", "two") if f"results/{name}.md" in said}, pages, said)

    def test_a_change_touches_what_is_driven_by_way_of_other_files(self):
        self.write("scenarios/base.json", "{}")
        self.write("scenarios/two.json", '{"extends": "base.json"}')
        self.declare("one", cells=[{"scenario": "scenarios/o*.json"}])
        self.commit()
        self.build()
        self.made(anew=True)
        for touches, pages in (("scenarios/base.json", {"two"}), ("scenarios/one.json", {"one"})):
            self.write("CHANGELOG.md", f"### Changes results\n\n- New words (touches: {touches})\n- Old.\n")
            said = self.call("check")[1]
            self.assertEqual({name for name in ("one", "two") if f"results/{name}.md" in said}, pages, said)
        self.write("CHANGELOG.md", "### Changes results\n\n- Old.\n- Old.\n")
        self.assertIn("two changes of results begin with", self.call("check")[2])

    def test_what_was_edited_by_hand_is_named(self):
        self.made()
        self.write("results/one.md", self.read("results/one.md") + "One word more.\n")
        for command in ("check", "stale"):
            code, said, _ = self.call(command)
            self.assertEqual(code, 1)
            self.assertIn("results/one.md is not as one wrote it", said)
            self.assertNotIn("two wrote it", said)

    def test_a_scenario_that_is_gone_hides_nothing_else(self):
        self.made()
        (self.root / "scenarios/one.json").unlink()
        self.write("build/bits", json.dumps({"two": "others"}))
        code, said, _ = self.call("stale")
        self.assertEqual(code, 1)
        self.assertIn("one: scenarios/one.json: cannot be driven: ", said)
        self.assertIn("two: scenarios/two.json: other trials", said)

    def test_scenarios_may_be_named_as_people_do_and_no_campaign_is_missed(self):
        self.write("build/scenario", "one")
        self.made(anew=True)
        self.assertEqual(json.loads(self.read("results/stamps/one.json"))["cells"][0]["file"], "scenarios/one.json")
        self.write("build/scenario", "a_run")
        code, _, errors = self.call("run", "one")
        self.assertEqual(code, 2)
        self.assertIn("names 0 scenarios that can be driven again", errors)

    def test_marks_are_set_by_the_program_of_today_only(self):
        self.made()
        self.write("build/commit", self.git("rev-parse", "--short=12", "HEAD") + "-dirty")
        self.assertEqual(self.call("stale")[0], 0)
        code, _, errors = self.call("stale", "--mark")
        self.assertEqual(code, 2)
        self.assertIn("dirty tree", errors)

    def test_only_one_makes_studies_in_a_tree(self):
        self.write("results/runs/studies/lock", "")
        with open(self.root / "results/runs/studies/lock", "w", encoding="utf-8") as held:
            fcntl.flock(held, fcntl.LOCK_EX)
            code, _, errors = self.call("run", "one")
        self.assertEqual(code, 2)
        self.assertIn("being made already", errors)

    def test_of_a_page_of_others_only_the_own_table_is_put_back(self):
        table = "<!-- begin t -->\n{}\n<!-- end t -->\n"
        self.write("results/one.md", f"# Page\n\n{table.format('old')}")
        self.declare("one", writes=["results/one.md#t"], commands=[
            f"printf '# Other title\\n\\n{table.format('new')}' > results/one.md; exit 3 # {{rockyard}}"])
        self.commit()
        self.build()
        self.assertEqual(self.call("run", "one")[0], 2)
        self.assertEqual(self.read("results/one.md"), f"# Other title\n\n{table.format('old')}")

    def test_what_another_study_came_to_know_does_not_vouch_for_this_one(self):
        self.made()
        self.write("CHANGELOG.md", "### Changes results\n\n- New words.\n- Old.\n")
        self.commit()
        self.assertEqual(self.call("run", "two")[0], 0)
        said = self.call("check")[1]
        self.assertIn("results/one.md does not say", said)
        self.assertNotIn("results/two.md", said)

    def test_a_dirty_tree_or_another_program_is_refused(self):
        self.write("scenarios/one.json", "{}")
        code, _, errors = self.call("run", "one")
        self.assertEqual(code, 2)
        self.assertIn("the tree is dirty", errors)
        self.assertIn("scenarios/one.json", errors)
        self.git("checkout", "-q", "scenarios/one.json")
        self.write("results/one.md", "# Page\n\nHalf edited.\n")  # which the study writes
        self.assertEqual(self.call("run", "one")[0], 0)
        self.write("src/code.cc", "int y;\n")
        self.commit()
        self.assertIn("whose sources differ", self.call("run", "one")[2])
        self.write("build/commit", self.git("rev-parse", "--short=12", "HEAD") + "-dirty")
        self.assertIn("dirty tree", self.call("run", "one")[2])
        self.assertFalse((self.root / "results/stamps/two.json").exists())

    def test_declarations_that_cannot_be_right(self):
        for change, words in (({"writes": ["results/one.md", "results/two.md"]}, "both one and two write it"),
                              ({"cells": [{"scenario": "scenarios/three.json"}]}, "there is no scenarios/three.json"),
                              ({"commands": ["scripts/studies/one/no.py"]}, "there is no scripts/studies/one/no.py"),
                              ({"writes": ["results/none.md"]}, "results/none.md is not there"),
                              ({"writes": ["results/one.md#t"]}, "has no table t"),
                              ({"other": 1}, "unknown ['other']"), ({"first": "x"}, "first is of the wrong type")):
            with self.subTest(change=change):
                self.declare("one", **change)
                code, said, _ = self.call("check")
                self.assertEqual(code, 1)
                self.assertIn(words, said)
        (self.root / "scripts/studies/one/study.json").unlink()
        self.assertIn("scripts/studies/one has no study.json", self.call("check")[1])

    def test_a_study_that_fails_or_is_interrupted_leaves_the_old_page(self):
        before = self.read("results/one.md")
        self.write("build/fails", "")
        code, _, errors = self.call("run", "one")
        self.assertEqual((code, self.read("results/one.md")), (2, before), errors)
        (self.root / "build/fails").unlink()
        self.write("build/slow", "")
        # A shell ignores it in what it starts in the background.
        signal.signal(signal.SIGINT, signal.default_int_handler)
        for asked, code in ((signal.SIGINT, 130), (signal.SIGTERM, 143)):
            with subprocess.Popen([sys.executable, self.root / "scripts/studies.py", "run", "one"], text=True,
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
                while "# Half" not in self.read("results/one.md"):
                    self.assertIsNone(process.poll(), "it ended before it was interrupted")
                    time.sleep(0.05)
                os.kill(process.pid, asked)
                _, errors = process.communicate()
            self.assertEqual((process.returncode, self.read("results/one.md")), (code, before), errors)
            self.assertFalse((self.root / "results/stamps/one.json").exists())
        (self.root / "build/slow").unlink()
        self.assertEqual(self.call("run", "one")[0], 0)

    def test_list_and_unknown_names(self):
        self.assertIn("one  (one, 1 CPU-minutes, stale, rockyard 0.1.0 abcdef012345)", self.call("list")[1])
        code, _, errors = self.call("run", "three")
        self.assertEqual(code, 2)
        self.assertIn("three: is no study; there are one, two", errors)
