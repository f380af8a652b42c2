"""What the parts of fuzz.py share: how a command is run, what is wrong with its end, what is kept."""

import collections
import dataclasses
import functools
import os
import random
import re
import resource
import shlex
import shutil
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]

# src/app/README.md.
DONE, DIFFERS, BAD_INPUT, TOO_MANY_FAULTS, INCONCLUSIVE, FAILED, INTERRUPTED = 0, 1, 2, 3, 4, 5, 130
DOCUMENTED = {DONE, DIFFERS, BAD_INPUT, TOO_MANY_FAULTS, INCONCLUSIVE, FAILED, INTERRUPTED}

# Words of libraries and of the language, which no message of the project has.
FOREIGN = re.compile(
    r"json\.exception|std::|terminate called|basic_string|vector::|_M_[a-z]\w+|bad_\w+|\bsto(?:[idfl]|ul|u?ll|ld)\b|"
    r"filesystem error|what\(\)|error: rockyard: |Sanitizer|runtime error|SQLITE_|Assertion|core dumped|"
    r"CLI::|fmt::|boost::|invalid string position|mutex lock failed")

# What a message quotes of the file.
QUOTED = re.compile(r"last read: '.*'")

# No command of a part asks for as much; a runaway one must not take the machine with it.
MEMORY_BYTES = 6 << 30


@dataclasses.dataclass
class End:
    """How a command ended: `code` as Python has it (negative: a signal), None where it took too long."""
    code: int | None
    out: str
    err: str


def generator(seed, part, index):
    """Random numbers of one case, the same whatever other cases are made."""
    return random.Random(f"{seed}/{part}/{index}")


@functools.cache
def is_sanitized(rockyard):
    """Whether the program reserves terabytes of addresses, as sanitizers do."""
    version = subprocess.run([rockyard, "--version"], capture_output=True, text=True, check=False)
    return "-fsanitize" in version.stdout


@functools.cache
def limit_all(sanitized):
    """Limits of this process, which all that it starts inherit: half as dear as to set them in each."""
    if not sanitized:
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY_BYTES, MEMORY_BYTES))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def run(command, folder, timeout_s, stdout=subprocess.PIPE):
    limit_all(is_sanitized(command[0]))
    words = [os.fsencode(word) if isinstance(word, str) else word for word in command]
    try:
        done = subprocess.run(words, cwd=folder, stdin=subprocess.DEVNULL, stdout=stdout,
                              stderr=subprocess.PIPE, timeout=timeout_s, check=False)
    except subprocess.TimeoutExpired as late:
        return End(None, _text(late.stdout), _text(late.stderr))
    return End(done.returncode, _text(done.stdout), _text(done.stderr))


def _text(data):
    return "" if data is None else data.decode("utf-8", "replace")


def problem_of(end, expected=frozenset(DOCUMENTED - {FAILED})):
    """What is wrong with the end of a command that may end with `expected` codes; "" for nothing."""
    if end.code is None:
        return "hangs"
    if end.code < 0:
        return f"is ended by signal {-end.code}"
    if end.code not in DOCUMENTED:
        return f"ends with {end.code}, which no page knows"
    foreign = FOREIGN.search(QUOTED.sub("", end.err))
    if foreign:
        return f"shows a message that is not its own: {foreign.group(0)}"
    if end.code not in expected:
        return f"ends with {end.code}"
    if end.code == BAD_INPUT and "error: " not in end.err:
        return "refuses and does not say why"
    if re.search(r"^error: (\d+\.json: )?(: |[\w.\[\]]+\.: )", end.err, re.M):
        return "names no place"
    if re.search(r"[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069]", end.err):
        return "shows what a terminal would obey"
    return ""


class Findings:
    """Counts of a part, and its failures, each in a folder with what it takes to see it again."""

    def __init__(self, part, seed, folder):
        self.part, self.seed, self.folder = part, seed, Path(folder)
        self.counts = collections.Counter()
        self.failures = []

    def fail(self, index, reason, command, end, files=()):
        self.counts["failures"] += 1
        kept = self.folder / f"{self.part}-{self.seed}-{index}"
        while kept.exists():  # another failure of the same case
            kept = kept.with_name(kept.name + "+")
        kept.mkdir(parents=True)
        for file in files:
            if Path(file).is_file():
                shutil.copy(file, kept)
        words = " ".join(shlex.quote(os.fsdecode(word)) for word in command)
        again = f"tests/long/fuzz.py --seed {self.seed} --{self.part} {index + 1} --first {index}"
        (kept / "how.txt").write_text(f"{reason}\n{words}\nagain: {again}\n", encoding="utf-8",
                                      errors="backslashreplace")
        (kept / "stdout.txt").write_text(end.out, encoding="utf-8", errors="backslashreplace")
        (kept / "stderr.txt").write_text(end.err, encoding="utf-8", errors="backslashreplace")
        self.failures.append(f"{self.part} {index}: {reason}: {words[:300]}  (in {kept})")

    def summary(self):
        counts = ", ".join(f"{count} {what}" for what, count in sorted(self.counts.items()))
        return f"{self.part}: seed {self.seed}: {counts or 'nothing done'}"
