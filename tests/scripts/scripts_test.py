"""The command lines of the scripts: what they accept, refuse and pass on."""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from fake_scripts import ROOT, ScriptTest


class Quickstart(ScriptTest):
    def test_runs_every_scenario_of_the_comparison_with_300_trials(self):
        result = self.run_well("quickstart.sh")
        out = "results/runs/quickstart"
        names = ["obstacles_0.28", "obstacles_0.57", "obstacles_0.85", "nominal",
                 "nominal_perfect_localization", "level_sand"]
        runs = [f"run scenarios/pathfinder/{name}.json --resume --force --out {out}/{name}"
                " --trials 300" for name in names]
        folders = " ".join(f"{out}/{name}" for name in names)
        look = f"{out}/first_look"
        self.assertEqual(self.called("rockyard"), [
            "run scenarios/pathfinder/nominal.json --resume --force"
            f" --out {look} --set rover.fidelity=quasi_static --trials 40",
            f"report {look} --out {look}.html",
            *runs,
            f"check {folders} --against results/reference/matthies1995.json",
            f"report {out}/nominal {out}/nominal_perfect_localization"
            f" --against results/reference/matthies1995.json --out {out}/report.html"])
        self.assertIn(f"{out}/report.html (open it", result.stdout)

    def test_a_page_that_fails_ends_it(self):
        self.assertEqual(self.run_script("quickstart.sh", REPORT_CODE="5").returncode, 5)

    def test_the_first_look_can_be_all(self):
        result = self.run_script("quickstart.sh", "--first")
        self.assertEqual(result.returncode, 0)
        self.assertEqual([line.split()[0] for line in self.called("rockyard")], ["run", "report"])
        self.assertIn("results/runs/quickstart/first_look.html", result.stdout)

    def test_options_pass_through(self):
        self.run_script("quickstart.sh", "--trials", "50", "--seed", "2")
        runs = [line for line in self.called("rockyard") if line.startswith("run")]
        for line in runs:
            self.assertTrue(line.endswith("--trials 50 --seed 2"), line)
            self.assertEqual(line.count("--trials"), 1, line)

    def test_an_option_with_a_space_stays_one_word(self):
        script = self.root / "build/release/bin/rockyard"
        script.write_text('#!/bin/sh\nfor word in "$@"; do echo "[$word]" >> "$CALLS"; done\n', encoding="utf-8")
        self.run_script("quickstart.sh", "--set", "name=two words")
        self.assertIn("[name=two words]", self.calls.read_text(encoding="utf-8"))

    def test_options_that_change_results_get_a_folder_of_their_own(self):
        self.run_script("quickstart.sh", "--threads", "1")
        self.run_script("quickstart.sh", "--seed", "2")
        self.run_script("quickstart.sh", "--seed", "3")
        folders = {line.split("--out ")[1].split()[0].rpartition("/")[0]
                   for line in self.called("rockyard") if "run scenarios/pathfinder/nominal" in line}
        self.assertEqual(len(folders), 3)
        self.assertIn("results/runs/quickstart", folders)

    def test_output_folder_can_be_chosen(self):
        self.run_script("quickstart.sh", "--out", "elsewhere")
        self.assertTrue(any("--out elsewhere/nominal" in line for line in self.called("rockyard")))

    def test_a_verdict_is_no_failure(self):
        for code, expected in ((0, 0), (1, 0), (4, 0), (2, 2)):
            with self.subTest(code=code):
                result = self.run_script("quickstart.sh", CHECK_CODE=str(code))
                self.assertEqual(result.returncode, expected)

    def test_a_failed_run_stops_with_its_code(self):
        self.assertEqual(self.run_script("quickstart.sh", RUN_CODE="3").returncode, 3)
        self.assertEqual(len(self.called("rockyard")), 1)

    def test_help_runs_nothing(self):
        result = self.run_script("quickstart.sh", "--help")
        self.assertIn("Usage", result.stdout)
        self.assertEqual(self.calls.read_text(encoding="utf-8"), "")


class TestScript(ScriptTest):
    def setUp(self):
        super().setUp()
        for folder in ("navigation", "trial"):
            (self.root / "tests" / folder).mkdir(parents=True)

    def last_test(self):
        return (self.root / "build/last_test").read_text(encoding="utf-8").splitlines()

    def test_everything_by_default(self):
        self.assertEqual(self.run_script("test.sh", "--jobs", "2").returncode, 0)
        self.assertEqual(self.called("install_dependencies.sh"), ["build mpi python pages test figures"])
        self.assertEqual(self.called("ctest"), ["--preset test -j 4 -LE ^long$ --no-tests=error --output-on-failure"])

    def test_label_and_lint(self):
        self.run_script("test.sh", "--label", "statistical", "--no-lint")
        self.assertIn("-L ^statistical$ -LE ^(long|lint)$", self.called("ctest")[0])

    def test_fast_tests_of_folders_build_only_these(self):
        self.run_script("test.sh", "--fast", "navigation", "trial/", "--jobs", "2")
        builds = [line for line in self.called("cmake") if line.startswith("--build")]
        self.assertEqual([line.split("--target ")[1] for line in builds], ["tests/navigation/all tests/trial/all"])
        self.assertEqual(len(self.called("ctest")), 1)
        self.assertIn("-L ^(tests/navigation|tests/trial)$ -L ^fast$", self.called("ctest")[0])

    def test_last_test_says_what_ran_and_how_it_ended(self):
        self.run_script("test.sh")
        self.assertTrue(self.last_test()[0].startswith("passed: commit "), self.last_test())
        self.assertEqual(self.last_test()[1], "ran: preset test, tier full, without ^long$")
        self.fake("bin/ctest").write_text("#!/bin/sh\nexit 8\n", encoding="utf-8")
        result = self.run_script("test.sh", "--fast", "--label", "unit", "navigation")
        self.assertEqual(result.returncode, 8)
        self.assertTrue(self.last_test()[0].startswith("FAILED: commit "), self.last_test())
        self.assertEqual(self.last_test()[1],
                         "ran: preset test, tier fast, label ^unit$, without ^long$, folders navigation")

    def test_an_interrupted_run_did_not_pass(self):
        for name, code in (("INT", 130), ("TERM", 143)):
            self.fake("bin/ctest").write_text(f"#!/bin/sh\nkill -{name} $PPID\n", encoding="utf-8")
            self.assertEqual(self.run_script("test.sh").returncode, code)
            self.assertTrue(self.last_test()[0].startswith("FAILED: commit "), self.last_test())

    def test_tsan_needs_its_own_packages(self):
        self.run_script("test.sh", "--preset", "tsan")
        self.assertEqual(self.called("install_dependencies.sh"), ["build mpi python pages test figures tsan"])

    def test_the_long_tier_is_what_the_others_leave_out(self):
        self.run_script("test.sh", "--long")
        self.run_script("test.sh", "--no-lint", "--long")
        called = self.called("ctest")
        self.assertIn("-L ^long$ -LE ^$ ", called[0])
        self.assertIn("-L ^long$ -LE ^lint$ ", called[1])

    def test_the_dearest_tests_of_the_last_run(self):
        self.assertEqual(self.run_script("test.sh", "--times").returncode, 2)
        self.fake("bin/ctest").write_text("""#!/bin/sh
printf 'a_test\\tA.Cheap\\t1.0\\t0.5\\nctest\\tpages\\t9.0\\t8.0\\nb_test\\tB.Dear\\t2.0\\t20.0\\n' >> "$ROCKYARD_TEST_TIMES"
""", encoding="utf-8")
        self.run_script("test.sh")
        lines = self.run_script("test.sh", "--times", "2").stdout.splitlines()
        self.assertEqual([line.split() for line in lines],
                         [["cpu_s", "clock_s"], ["20.0", "2.0", "b_test", "B.Dear"], ["8.0", "9.0", "pages"]])

    def test_unknown_words_run_nothing(self):
        for arguments in (["--quick"], ["--label"], ["--times"], ["nowhere"], ["--times", "3", "--fast"],
                          ["--fast", "--all"]):
            result = self.run_script("test.sh", *arguments)
            self.assertEqual(result.returncode, 2)
            self.assertEqual(self.calls.read_text(encoding="utf-8"), "")
            self.assertFalse((self.root / "build/last_test").exists())

    def test_continuous_integration_runs_the_same(self):
        shutil.copytree(ROOT / ".ci", self.root / ".ci")
        variables = {**os.environ, "CALLS": str(self.calls), "PATH": f"{self.root / 'bin'}:{os.environ['PATH']}"}
        subprocess.run([self.root / ".ci/run"], env=variables, check=True, capture_output=True)
        self.assertEqual(len(self.called("ctest")), 1)


class LongTests(ScriptTest):
    """With two long tests, the second of which fails."""

    def setUp(self):
        super().setUp()
        self.folder = self.root / "tests" / "long"
        self.folder.mkdir(parents=True)
        (self.folder / "tests.json").write_text(
            """[{"name": "good", "what": "passes", "command": "echo good >> $CALLS"},
                {"name": "bad", "what": "fails", "command": "echo bad >> $CALLS; exit 3"}]""",
            encoding="utf-8")

    def test_what_it_tries_is_configured_and_built_first(self):
        (self.folder / "tests.json").write_text(
            """[{"name": "good", "what": "x", "builds": {"asan": ["a", "b"]}, "command": "echo good >> $CALLS"}]""",
            encoding="utf-8")
        self.run_script("long_tests.py", "good")
        self.assertEqual(self.called("cmake"), ["--preset asan -DROCKYARD_BUILD_TESTS=ON",
                                                "--build --preset asan --target a b"])
        self.calls.write_text("", encoding="utf-8")
        self.fake("bin/cmake").write_text("#!/bin/sh\nexit 1\n", encoding="utf-8")
        self.assertEqual(self.run_script("long_tests.py", "good").returncode, 1)
        self.assertEqual(self.calls.read_text(encoding="utf-8"), "")
        self.assertIn("FAILED with exit code 1", self.results()["good"])

    def results(self):
        lines = (self.folder / "README.md").read_text(encoding="utf-8").splitlines()
        return {line.split(" | ")[0].strip("| "): line.split(" | ")[-1] for line in lines[6:] if line.startswith("|")}

    def test_each_is_noted_with_its_last_result(self):
        self.assertEqual(self.run_script("test.sh", "--all").returncode, 1)
        self.assertTrue(self.results()["good"].startswith("passed, 20"), self.results())
        self.assertTrue(self.results()["bad"].startswith("FAILED with exit code 3"))

    def test_one_by_name_leaves_the_results_of_others(self):
        self.run_script("long_tests.py", "bad")
        self.assertEqual(self.results()["good"], "not run yet |")
        self.assertEqual(self.run_script("long_tests.py", "good").returncode, 0)
        self.assertTrue(self.results()["bad"].startswith("FAILED"))
        self.assertEqual(self.calls.read_text(encoding="utf-8"), "bad\ngood\n")

    def git(self, *arguments):
        subprocess.run(["git", "-c", "user.name=a", "-c", "user.email=a@b", *arguments], cwd=self.root, check=True,
                       capture_output=True)

    def test_goes_on_where_it_was_interrupted_as_long_as_the_tree_is_the_same(self):
        (self.root / ".gitignore").write_text("calls\nbuild\n__pycache__\n", encoding="utf-8")
        self.git("init", "-q")
        self.git("add", "-A")
        self.git("commit", "-q", "-m", "first")
        steps = ((["good"], "good\n"), (["good"], ""), ([], "bad\n"), (["--again", "good"], "good\n"))
        for arguments, ran in steps:
            with self.subTest(arguments=arguments):
                self.calls.write_text("", encoding="utf-8")
                self.run_script("long_tests.py", *arguments)
                self.assertEqual(self.calls.read_text(encoding="utf-8"), ran)
        self.git("add", "-A")  # its page, which is no reason to run again
        self.git("commit", "-q", "-m", "results")
        for name, ran in (("CHANGELOG.md", ""), ("another", "good\n")):
            with self.subTest(changed=name):
                self.calls.write_text("", encoding="utf-8")
                (self.root / name).write_text("new", encoding="utf-8")
                self.run_script("long_tests.py", "good")
                self.assertEqual(self.calls.read_text(encoding="utf-8"), ran)
        self.assertIn("-dirty, ", self.results()["good"])

    def test_the_page_sums_up_and_names_what_is_too_long(self):
        page = self.folder / "README.md"
        bad = "echo bad >> $CALLS; exit 3"
        row = "| bad | x | `{}` | passed, 2026-01-01, commit 0123456789ab, 90.5 min |\n"
        page.write_text(row.format(bad), encoding="utf-8")
        self.run_script("long_tests.py", "--again", "good")
        text = page.read_text(encoding="utf-8")
        self.assertIn("2 of 2 have run; together they took 1.5 hours.", text)
        self.assertIn("Longer than an hour, and so to be divided: bad.", text)
        page.write_text(row.format("another command"), encoding="utf-8")
        self.run_script("long_tests.py", "--again", "good")
        self.assertIn("1 of 2 have run", page.read_text(encoding="utf-8"))
        self.assertEqual(self.results()["bad"], "not run yet |")

    def test_a_tree_that_changed_meanwhile_is_no_commit(self):
        self.git("init", "-q")
        (self.root / ".gitignore").write_text("calls\nbuild\n__pycache__\n", encoding="utf-8")
        (self.folder / "tests.json").write_text(
            """[{"name": "good", "what": "x", "command": "echo more >> scripts/test.sh"}]""", encoding="utf-8")
        self.git("add", "-A")
        self.git("commit", "-q", "-m", "first")
        self.run_script("long_tests.py", "good")
        self.assertIn("-dirty, ", self.results()["good"])

    def test_list_and_unknown_names_run_nothing(self):
        listed = self.run_script("long_tests.py", "--list")
        self.assertIn("good", listed.stdout)
        self.assertEqual(self.run_script("long_tests.py", "other").returncode, 2)
        self.assertEqual(self.calls.read_text(encoding="utf-8"), "")


class InstallDependencies(unittest.TestCase):
    """The real script with a package system that knows some packages and installs nothing."""

    def setUp(self):
        self.root = Path(self.enterContext(tempfile.TemporaryDirectory()))
        shutil.copytree(ROOT / "scripts", self.root / "scripts")
        (self.root / "scripts/debian_packages.txt").write_text(
            "# list\nhere  build  reason\naway  build  reason\nmore  test  reason\n", encoding="utf-8")
        self.tool("dpkg-query", 'case "$*" in *here*) echo installed;; *) exit 1;; esac')
        self.tool("apt-get", 'echo "$*" >> "$CALLS"')
        self.tool("apt-cache", 'exit "${KNOWN:-0}"')
        self.tool("id", 'echo "${USER_ID:-0}"')

    def tool(self, name, body):
        path = self.root / "bin" / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(f"#!/bin/sh\n{body}\n", encoding="utf-8")
        path.chmod(0o755)

    def install(self, *groups, path=None, **environment):
        calls = self.root / "calls"
        calls.write_text("", encoding="utf-8")
        variables = {"CALLS": str(calls), **environment, "PATH": f"{self.root / 'bin'}:{path or os.environ['PATH']}"}
        result = subprocess.run([self.root / "scripts/install_dependencies.sh", *groups], text=True,
                                env=variables, capture_output=True, check=False)
        return result, calls.read_text(encoding="utf-8").splitlines()

    def test_installs_only_what_is_missing(self):
        result, calls = self.install("build", "test")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(calls, ["install -y --no-install-recommends away more"])

    def test_fetches_the_index_only_when_a_package_is_unknown(self):
        _, calls = self.install("build", KNOWN="100")
        self.assertEqual(calls, ["update", "install -y --no-install-recommends away"])

    def test_nothing_to_do(self):
        (self.root / "scripts/debian_packages.txt").write_text("here build reason\n", encoding="utf-8")
        result, calls = self.install()
        self.assertEqual((result.returncode, calls), (0, []))

    def test_without_root_and_sudo_it_says_what_is_missing(self):
        for name in ("env", "dirname", "awk", "sh"):
            (self.root / "bin" / name).symlink_to(shutil.which(name))
        result, calls = self.install("build", path="/nowhere", USER_ID="1000")
        self.assertEqual((result.returncode, calls), (1, []))
        self.assertIn("needs root or sudo: away", result.stderr)

    def test_a_command_of_another_package_counts_as_its_own(self):
        (self.root / "scripts/debian_packages.txt").write_text(
            "npm:sh build reason\nnodejs:no-such-command build reason\n", encoding="utf-8")
        result, calls = self.install("build")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(calls, ["install -y --no-install-recommends nodejs"])

    def test_unknown_group(self):
        result, calls = self.install("nonsense")
        self.assertEqual((result.returncode, calls), (1, []))
        self.assertIn("nonsense", result.stderr)


class PackageList(unittest.TestCase):
    def test_every_line_has_a_name_a_known_group_and_a_reason(self):
        lines = (ROOT / "scripts/debian_packages.txt").read_text(encoding="utf-8").splitlines()
        packages = [line.split(None, 2) for line in lines if line and not line.startswith("#")]
        for fields in packages:
            self.assertEqual(len(fields), 3, fields)
            self.assertIn(fields[1], ("build", "mpi", "planetary", "pages", "test", "tsan", "figures", "python", "clean_room"))
        names = [fields[0] for fields in packages]
        self.assertEqual(len(names), len(set(names)))


if __name__ == "__main__":
    sys.exit(unittest.main())
