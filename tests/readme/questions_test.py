"""Each of the twelve questions of docs/questions.md has an answer in Python of at most five lines."""

import ast
import re
import unittest
from pathlib import Path

PAGE = Path(__file__).resolve().parents[2] / "docs/questions.md"
QUESTION = re.compile(r"^## (\d+)\. .*\?$", re.MULTILINE)
ANSWER = re.compile(r"^```python\n(.*?)^```$", re.DOTALL | re.MULTILINE)
SHOWN = re.compile(r"\A\n*```text\n")
QUESTIONS, MOST_LINES, MOST_COLUMNS = 12, 5, 140


def lines_of(answer):
    """The lines of an answer that count: all but the import of the package and empty ones."""
    return [line for line in answer.splitlines() if line.strip() and line != "import rockyard as ry"]


def has_shared_line(answer):
    """Whether two statements stand on one line."""
    begins = [node.lineno for node in ast.walk(ast.parse(answer)) if isinstance(node, ast.stmt)]
    return len(begins) != len(set(begins))


def faults_of(text):
    """What is wrong with the answers of a page."""
    parts = QUESTION.split(text)[1:]
    numbers, answers = parts[::2], parts[1::2]
    if numbers != [str(number) for number in range(1, QUESTIONS + 1)]:
        yield f"questions {', '.join(numbers)}"
    for number, part in zip(numbers, answers):
        found = list(ANSWER.finditer(part))
        if len(found) != 1:
            yield f"question {number} has {len(found)} answers in Python"
        for answer in found:
            lines = lines_of(answer[1])
            if not answer[1].startswith("import rockyard as ry\n"):
                yield f"question {number} does not begin with the import"
            if len(lines) > MOST_LINES:
                yield f"question {number} takes {len(lines)} lines of Python"
            if any(len(line) > MOST_COLUMNS for line in lines) or has_shared_line(answer[1]):
                yield f"question {number} has a line that is two"
            if not SHOWN.match(part[answer.end():]):
                yield f"question {number} does not show what comes out"


class QuestionsTest(unittest.TestCase):
    def setUp(self):
        self.text = PAGE.read_text(encoding="utf-8")

    def test_each_has_a_short_answer(self):
        self.assertEqual(list(faults_of(self.text)), [])

    def test_faults_are_found(self):
        first = ANSWER.search(self.text)
        lines = lines_of(first[1])
        for wanted, text in {
            "question 1 takes 6 lines of Python": self.text.replace(lines[0], "\n".join(["pass"] * (6 - len(lines)) + lines[:1])),
            "question 1 has 0 answers in Python": self.text.replace(first[0], ""),
            "question 1 does not begin with the import": self.text.replace("import rockyard as ry\n", "import rockyard\n", 1),
            "question 1 has a line that is two": self.text.replace(lines[0], f"pass; {lines[0]}"),
            "question 1 does not show what comes out": self.text.replace(first[0] + "\n\n```text", first[0] + "\n\nmore\n\n```text", 1),
            "questions 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12": self.text.replace("## 1. ", "## A. "),
        }.items():
            with self.subTest(wanted):
                self.assertEqual(list(faults_of(text))[0], wanted)


if __name__ == "__main__":
    unittest.main()
