"""tests/long/commands.py: whether it sees what a sanitizer says, a crash, a hang and a wrong exit code."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
STUDY = ROOT / "tests/long/commands.py"

# A rockyard with one scenario and nothing to say, but where its command is $FAULTY.
FAKE = """#!/bin/sh
case "$1" in
  --version) echo "flags -fsanitize=address,undefined" ;;
  list) echo '{"files": [{"kind": "scenario", "file": "a.json"}, {"kind": "sweep", "file": "b.json"}]}' ;;
  parameters) printf 'path,value\\nrover.fidelity,multibody\\n' ;;
esac
[ "$1" = "${FAULTY:-}" ] || exit 0
case "$AS" in
  report) echo "x.cc:3:5: runtime error: signed integer overflow" >&2 ;;
  race) echo "WARNING: ThreadSanitizer: data race" >&2 ;;
  crash) kill -s SEGV $$ ;;
  wrong) exit 3 ;;
  refused) case "$*" in *quasi_static*--out*) exit 0 ;; *quasi_static) exit 2 ;; esac ;;
esac
"""


class CommandStudy(unittest.TestCase):
    def study(self, faulty="", how=""):
        with tempfile.TemporaryDirectory() as folder:
            program = Path(folder) / "rockyard"
            program.write_text(FAKE, encoding="utf-8")
            program.chmod(0o755)
            return subprocess.run([sys.executable, STUDY, "--rockyard", program], text=True,
                                  env={**os.environ, "FAULTY": faulty, "AS": how}, capture_output=True, check=False)

    def test_nothing_is_found_where_nothing_is_wrong(self):
        done = self.study()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("sanitizers: address,undefined", done.stdout)
        self.assertRegex(done.stdout, r"scenarios: 4 commands, \d+ s")
        self.assertIn(" 0 findings", done.stdout)

    def test_what_is_wrong_with_one_command_is_found(self):
        for how in ("report", "race", "crash", "wrong"):
            done = self.study("merge", how)
            self.assertEqual(done.returncode, 1, how)
            self.assertIn(" 1 findings", done.stdout, how)
            self.assertIn("rockyard merge shard1 shard2", done.stderr, how)

    def test_a_scenario_may_refuse_the_other_fidelity_alone(self):
        self.assertEqual(self.study("run", "refused").returncode, 0)
        self.assertEqual(self.study("run", "wrong").returncode, 1)

    def test_a_killed_run_that_ends_by_a_signal_of_its_own_is_found(self):
        self.assertIn("exit code -11", self.study("run", "crash").stderr)


if __name__ == "__main__":
    unittest.main()
