"""Runs the snippets of a page in order, and holds the output that the page shows against what came out.

A page is Markdown. Blocks of "sh" run in bash, stopping at the first command that fails; blocks of
"python" run in Python; both in one folder, each going on from what those before it left. A block of
"text" shows lines of what the block before it printed: each of its lines is part of a printed line,
in this order. Other blocks (json, cpp, none) are not run. A line that begins with scripts/ gets --help: these install
packages, or run for long.

Numbers of results may differ a little from those that are shown (SLACK): the mathematical functions of
another processor round otherwise in the last place, which changes the course of a trial in a thousand.
Words and everything else are the same.

A check may find a difference (1) or too little to tell (4), and that is no fault of the page: write
`|| test $? -eq 1` behind it on the page, as a reader would have to.
"""

import re
import subprocess
from dataclasses import dataclass

BLOCK = re.compile(r"^```(sh|python|text)\n(.*?)^```$", re.DOTALL | re.MULTILINE)
SCRIPT = re.compile(r"^scripts/(?:\\\n|.)*", re.MULTILINE)
NUMBER = re.compile(r"\d+(?:\.\d+)?(?:e[+-]?\d+)?")
TIMEOUT_S = 1200  # against one that hangs
SLACK = 3.0       # of a number: three trials, points, degrees
RELATIVE_SLACK = 0.1


@dataclass
class Snippet:
    """One block of a page."""

    kind: str
    text: str
    line: int


def snippets_of(page):
    """The blocks that are run or compared, in order."""
    text = page.read_text(encoding="utf-8")
    return [Snippet(found[1], found[2], text.count("\n", 0, found.start()) + 1) for found in BLOCK.finditer(text)]


def run(snippet, folder, environment, python):
    """(exit code, all that was printed) of a block."""
    program = ["bash", "-euo", "pipefail", "-c"] if snippet.kind == "sh" else [python, "-c"]
    text = SCRIPT.sub(r"\g<0> --help", snippet.text) if snippet.kind == "sh" else snippet.text
    result = subprocess.run([*program, text], cwd=folder, env=environment, text=True, check=False,
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=TIMEOUT_S)
    return result.returncode, result.stdout


def alike(shown, printed):
    """Whether two texts of numbers alone are near each other."""
    pairs = zip(map(float, shown), map(float, printed))
    return all(abs(a - b) <= max(SLACK, RELATIVE_SLACK * abs(a)) for a, b in pairs)


def is_part(wanted, line):
    """Whether a printed line holds the shown one, blanks and small differences of numbers apart."""
    gaps = [r"\s+".join(map(re.escape, text.split())) for text in NUMBER.split(wanted)]
    pattern = rf"({NUMBER.pattern})".join(rf"\s*{gap}\s*" for gap in gaps)
    found = re.search(pattern, line)
    return found is not None and alike(NUMBER.findall(wanted), found.groups())


def missing_line(shown, printed):
    """The first shown line that is not part of a printed one, in order; None where all are."""
    lines = iter(printed.splitlines())
    for wanted in filter(None, (line.strip() for line in shown.splitlines())):
        if not any(is_part(wanted, line) for line in lines):
            return wanted
    return None


def faults_of(page, folder, environment, python):
    """What is wrong with the page, each with its line; stops where a block fails."""
    printed = None
    for snippet in snippets_of(page):
        if snippet.kind == "text":
            if printed is None:
                yield f"{page.name}:{snippet.line}: shows output, but nothing was run before it"
                continue
            missing = missing_line(snippet.text, printed)
            if missing is not None:
                yield f"{page.name}:{snippet.line}: shows \"{missing}\", printed was\n{printed}"
            continue
        code, printed = run(snippet, folder, environment, python)
        if code != 0:
            yield f"{page.name}:{snippet.line}: exit code {code} of\n{snippet.text}\n{printed}"
            return
