"""Snippets of pages run in order, and what is wrong with a page is told with its line."""

import os
import sys
import tempfile
import unittest
from pathlib import Path

import snippets


def faults_of(text):
    with tempfile.TemporaryDirectory() as folder:
        page = Path(folder) / "page.md"
        page.write_text(text, encoding="utf-8")
        return list(snippets.faults_of(page, folder, os.environ, sys.executable))


class SnippetsTest(unittest.TestCase):
    def test_blocks_go_on_from_those_before(self):
        self.assertEqual(faults_of("# A\n```sh\necho 7 > seven\n```\nthen\n```python\n"
                                   "print(open('seven').read())\n```\n```text\n7\n```\n"), [])

    def test_a_command_that_fails_ends_the_page(self):
        faults = faults_of("```sh\nfalse\necho on\n```\n```sh\nexit 3\n```\n")
        self.assertEqual(len(faults), 1)
        self.assertIn("page.md:1: exit code 1 of\nfalse", faults[0])

    def test_so_does_one_in_a_pipe(self):
        self.assertIn("exit code 1", faults_of("```sh\nfalse | cat\n```\n")[0])

    def test_scripts_are_asked_for_help_alone(self):
        make = ("```sh\nmkdir scripts; echo 'for last; do :; done; test $last = --help' > scripts/a; chmod +x scripts/a\n"
                "```\n```sh\n{}\n```\n")
        for command in ("scripts/a", "scripts/a --out b \\\n  --more", "scripts/a\necho on"):
            with self.subTest(command):
                self.assertEqual(faults_of(make.format(command)), [])
        for command in ("scripts/b", "./scripts/a --out b", "scripts/a --help && false"):
            with self.subTest(command):
                self.assertEqual(len(faults_of(make.format(command))), 1)

    def test_python_that_fails_is_told(self):
        self.assertIn("page.md:3: exit code 1", faults_of("\n\n```python\n1 / 0\n```\n")[0])

    def test_shown_lines_are_printed_in_this_order(self):
        page = "```sh\nprintf 'one\\ntwo 2\\nthree\\n'\n```\n```text\n{}\n```\n"
        self.assertEqual(faults_of(page.format("one\ntwo")), [])
        self.assertEqual(faults_of(page.format("one\n\nthree")), [])
        self.assertIn('page.md:4: shows "one"', faults_of(page.format("two\none"))[0])
        self.assertIn('shows "four"', faults_of(page.format("four"))[0])

    def test_numbers_may_differ_a_little_and_words_not(self):
        page = "```sh\necho 'rate  161 of 200 (80.5 %), p = 7.46e-09'\n```\n```text\n{}\n```\n"
        self.assertEqual(faults_of(page.format("rate 160 of 200 (80 %)")), [])
        self.assertEqual(faults_of(page.format("(80.5 %), p = 3e-08")), [])
        for wrong in ("rate 120 of 200", "rate 161 from 200", "rate 161 of 200 (60", "rat 161", "161 161"):
            with self.subTest(wrong):
                self.assertEqual(len(faults_of(page.format(wrong))), 1)

    def test_what_is_shown_was_printed_by_the_last_block(self):
        self.assertIn('shows "one"', faults_of("```sh\necho one\n```\n```sh\necho two\n```\n```text\none\n```\n")[0])

    def test_output_needs_a_block_before_it(self):
        self.assertIn("nothing was run before it", faults_of("```text\none\n```\n")[0])

    def test_other_blocks_are_not_run(self):
        self.assertEqual(faults_of("```json\n{\n```\n```\nfalse\n```\n```cpp\nx\n```\n"), [])


if __name__ == "__main__":
    unittest.main()
