"""Scripts in a folder where every program that they call is a fake that writes down how it was called."""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

# Stands for every program that the scripts call: writes down how it was called.
FAKE = """#!/bin/sh
echo "$(basename "$0") $*" >> "$CALLS"
case "$(basename "$0") $1" in
  "rockyard check") exit "${CHECK_CODE:-0}" ;;
  "rockyard report") exit "${REPORT_CODE:-0}" ;;
  "rockyard run") exit "${RUN_CODE:-0}" ;;
esac
"""


class ScriptTest(unittest.TestCase):
    """A copy of the scripts in a folder where nothing real can be called."""

    def setUp(self):
        self.root = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.calls = self.root / "calls"
        self.calls.touch()
        shutil.copytree(ROOT / "scripts", self.root / "scripts")
        for name in ("cmake", "ctest"):
            self.fake(f"bin/{name}")
        self.fake("build/release/bin/rockyard")
        self.fake("scripts/install_dependencies.sh")

    def fake(self, name):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(FAKE, encoding="utf-8")
        path.chmod(0o755)
        return path

    def run_script(self, name, *arguments, **environment):
        variables = {**os.environ, "CALLS": str(self.calls), **environment,
                     "PATH": f"{self.root / 'bin'}:{os.environ['PATH']}"}
        program = [sys.executable] if name.endswith(".py") else []
        return subprocess.run([*program, self.root / "scripts" / name, *arguments], env=variables, text=True,
                              capture_output=True, check=False)

    def run_well(self, name, *arguments, **environment):
        result = self.run_script(name, *arguments, **environment)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def called(self, program):
        lines = self.calls.read_text(encoding="utf-8").splitlines()
        return [line.removeprefix(f"{program} ") for line in lines if line.startswith(program)]
