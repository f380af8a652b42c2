"""What hashes_test.py makes of programs that agree, differ and fail."""

import contextlib
import io
import json
import tempfile
import unittest
from pathlib import Path

import hashes_test

DRIVES = {"a": {"scenario": "a.json", "trials": 20, "set": ["x=1"]}, "b": {"scenario": "b.json", "trials": 3, "set": []}}


class Hashes(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.kept = self.folder / "hashes.json"
        self.keep({"a": "aa", "b": "aa"})

    def keep(self, hashes):
        self.kept.write_text(json.dumps({"drives": DRIVES, "hashes": hashes}), encoding="utf-8")

    def program(self, name, words):
        """A stand-in for hash_trials: shell words that see $1 scenario, $2 trials, $3 threads, $4 hidden or setting."""
        path = self.folder / name
        path.write_text(f"#!/bin/sh\n{words}\n", encoding="utf-8")
        path.chmod(0o755)
        return str(path)

    def code(self, *arguments):
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            return hashes_test.main(arguments, self.kept)

    def test_hashes_as_kept(self):
        self.assertEqual(self.code(self.program("p", 'case "$2$4$5" in 20x=1|20--without-avxx=1|3*) echo aa;; esac')), 0)

    def test_one_that_differs_by_drive_threads_processor_or_from_run_to_run(self):
        for words in ('[ "$2" = 3 ] && echo bb || echo aa', '[ "$3" = 2 ] && echo bb || echo aa', "echo $$",
                      '[ "$4" = --without-avx ] && echo bb || echo aa', '[ -n "$GLIBC_TUNABLES" ] && echo bb || echo aa'):
            with self.subTest(words=words):
                self.assertEqual(self.code(self.program("p", words)), 1)

    def test_a_drive_that_is_not_kept(self):
        good = self.program("p", "echo aa")
        self.keep({"a": "aa"})
        self.assertEqual(self.code(good), 1)
        self.assertEqual(self.code(good, "--update"), 0)
        self.assertEqual(self.code(good), 0)

    def test_levels_of_processors(self):
        for words, code in (("echo $2", 0), ('[ "$4" = --without-avx512 ] && echo bb || echo aa', 1),
                            ('case "$GLIBC_TUNABLES" in *-FMA*) echo bb;; *) echo aa;; esac', 1)):
            with self.subTest(words=words):
                self.assertEqual(self.code(self.program("p", words), "--levels", "7"), code)
        self.assertEqual(self.code(self.program("p", '[ "$2" = 7 ] && echo aa'), "--levels", "7"), 0)

    def test_a_processor_without_avx_is_what_it_is(self):
        words = 'case "$4" in --without*) exit 77;; esac; echo aa'
        self.assertEqual(self.code(self.program("p", words)), 0)

    def test_another_build(self):
        mine = self.program("p", 'echo "$2"')
        self.assertEqual(self.code(mine, "--against", self.program("q", 'echo "$2"'), "--trials", "7"), 0)
        self.assertEqual(self.code(mine, "--against", self.program("q", "echo 7"), "--trials", "8"), 1)

    def test_no_hash_is_no_agreement(self):
        for words in ("exit 3", "true"):
            program = self.program("p", words)
            self.assertEqual(self.code(program), 3)
            self.assertEqual(self.code(program, "--against", program), 3)


if __name__ == "__main__":
    unittest.main()
