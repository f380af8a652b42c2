"""What hashes_test.py makes of programs that agree, differ and fail."""

import contextlib
import io
import json
import tempfile
import unittest
import unittest.mock
from pathlib import Path

import hashes_test

DRIVES = {"a": {"scenario": "a.json", "trials": 20, "set": ["x=1"]}, "b": {"scenario": "b.json", "trials": 3, "set": []}}


class Hashes(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.kept = self.folder / "hashes.json"
        self.keep({hashes_test.class_of_cpu(): {"a": "aa", "b": "aa"}})

    def keep(self, hashes):
        self.kept.write_text(json.dumps({"drives": DRIVES, "hashes": hashes}), encoding="utf-8")

    def program(self, name, words):
        """A stand-in for hash_trials: shell words that see $1 scenario, $2 trials, $3 threads, $4 setting."""
        path = self.folder / name
        path.write_text(f"#!/bin/sh\n{words}\n", encoding="utf-8")
        path.chmod(0o755)
        return str(path)

    def code(self, *arguments):
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            return hashes_test.main(arguments, self.kept)

    def test_hashes_as_kept(self):
        self.assertEqual(self.code(self.program("p", '[ "$2$4" = 20x=1 ] || [ "$2" = 3 ] && echo aa')), 0)

    def test_one_that_differs_by_drive_threads_or_from_run_to_run(self):
        for words in ('[ "$2" = 3 ] && echo bb || echo aa', '[ "$3" = 2 ] && echo bb || echo aa', "echo $$"):
            with self.subTest(words=words):
                self.assertEqual(self.code(self.program("p", words)), 1)

    def test_a_drive_or_a_class_of_cpu_that_is_not_kept(self):
        good = self.program("p", "echo aa")
        self.keep({hashes_test.class_of_cpu(): {"a": "aa"}})
        self.assertEqual(self.code(good), 1)
        self.keep({"another": {"a": "aa", "b": "aa"}})
        self.assertEqual(self.code(good), 2)
        self.assertEqual(self.code(good, "--update"), 0)
        self.assertEqual(self.code(good), 0)
        self.assertIn("another", json.loads(self.kept.read_text(encoding="utf-8"))["hashes"])

    def test_another_build(self):
        mine = self.program("p", 'echo "$2"')
        self.assertEqual(self.code(mine, "--against", self.program("q", 'echo "$2"'), "--trials", "7"), 0)
        self.assertEqual(self.code(mine, "--against", self.program("q", "echo 7"), "--trials", "8"), 1)

    def test_no_hash_is_no_agreement(self):
        for words in ("exit 3", "true"):
            program = self.program("p", words)
            self.assertEqual(self.code(program), 3)
            self.assertEqual(self.code(program, "--against", program), 3)

    def test_classes_of_cpus(self):
        info = self.folder / "cpuinfo"
        for flags, name in (("fpu fma avx2", "with"), ("fpu avx2", "without"), ("fma avx", "without")):
            info.write_text(f"processor\t: 0\nflags\t\t: {flags}\nbugs\t: fma avx2\n", encoding="utf-8")
            with unittest.mock.patch("platform.machine", return_value="x86_64"):
                self.assertEqual(hashes_test.class_of_cpu(info), f"x86_64 {name} FMA")


if __name__ == "__main__":
    unittest.main()
