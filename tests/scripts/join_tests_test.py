#!/usr/bin/env python3
"""What scripts/cmake/join_tests.py makes of files of tests: one that compiles, told by the real places."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
JOIN = ROOT / "scripts/cmake/join_tests.py"

FILE = """#include "neighbour.h"
#include <string>

namespace project {{
namespace {{

int Twice(int x) {{ return {factor} * x; }}
{more}
struct Check {{
  Check() {{ Results().push_back(Twice({argument})); }}
}} const check;

}}  // namespace
}}  // namespace project
"""
NEIGHBOUR = """#pragma once
#include <vector>
namespace project {
std::vector<int>& Results();
}
"""
MAIN = """#include <cstdio>
#include "a/neighbour.h"
std::vector<int>& project::Results() {
  static std::vector<int> results;
  return results;
}
int main() {
  for (int result : project::Results()) std::printf("%d ", result);
}
"""


class JoinTests(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        (self.folder / "a").mkdir()
        (self.folder / "b").mkdir()
        for name in ("a", "b"):
            (self.folder / name / "neighbour.h").write_text(NEIGHBOUR, encoding="utf-8")
        (self.folder / "main.cc").write_text(MAIN, encoding="utf-8")

    def write(self, name, factor=2, argument=1, more="", end=""):
        path = self.folder / name
        path.write_text(FILE.format(factor=factor, argument=argument, more=more) + end, encoding="utf-8")
        return path

    def join(self, *files):
        return subprocess.run([sys.executable, JOIN, self.folder / "joined.cc", *files],
                              capture_output=True, text=True, check=False)

    def compile(self, *more):
        return subprocess.run(["c++", "-std=c++20", "-Wall", "-Wextra", *more, "joined.cc", "main.cc",
                               "-o", "program"], cwd=self.folder, capture_output=True, text=True,
                              check=False)

    def test_equal_names_of_files_do_not_meet(self):
        result = self.join(self.write("a/same_test.cc", argument=5),
                           self.write("b/same_test.cc", factor=3, argument=7))
        self.assertEqual(result.returncode, 0, result.stderr)
        compiled = self.compile()
        self.assertEqual((compiled.returncode, compiled.stderr), (0, ""))
        printed = subprocess.run([self.folder / "program"], capture_output=True, text=True, check=True)
        self.assertEqual(printed.stdout, "10 21 ")

    def test_errors_and_unused_names_are_told_by_the_real_place(self):
        first = self.write("a/first_test.cc")
        second = self.write("b/second_test.cc", more="void NobodyCalls() {}")
        self.assertEqual(self.join(first, second).returncode, 0)
        line = second.read_text(encoding="utf-8").splitlines().index("void NobodyCalls() {}") + 1
        self.assertRegex(self.compile().stderr, rf"{second}:{line}:\d+: warning: .*NobodyCalls")

    def test_a_file_of_another_make_is_refused(self):
        good = self.write("a/good_test.cc")
        after = self.write("b/after_test.cc", end="int Global() { return 1; }\n")
        none = self.folder / "none_test.cc"
        none.write_text("int x;\n", encoding="utf-8")
        two = self.folder / "two_test.cc"
        two.write_text(good.read_text(encoding="utf-8") * 2, encoding="utf-8")
        for bad in (after, none, two):
            with self.subTest(bad=bad.name):
                result = self.join(good, bad)
                self.assertEqual(result.returncode, 1)
                self.assertIn(str(bad), result.stderr)
                self.assertFalse((self.folder / "joined.cc").exists())


if __name__ == "__main__":
    unittest.main()
