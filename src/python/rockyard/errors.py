"""What goes wrong, as exceptions."""

from __future__ import annotations

import difflib
import operator
import re
import traceback
from typing import TYPE_CHECKING, Any, Iterable, NamedTuple, Sequence

if TYPE_CHECKING:
    from types import TracebackType


MOST_SEED = 2**63 - 1


class Problem(NamedTuple):
    """One thing wrong with an input."""

    path: str  # JSON path or file: "terrain.rocks.min_diameter_m"
    reason: str  # what is wrong
    suggestion: str  # what would be right

    def __str__(self) -> str:
        return ": ".join(part for part in (self.path, "; ".join(filter(None, self[1:]))) if part)


# What the command's options are called here, where that is another word; the others that calls have.
_RENAMED = {"out": "folder=", "plugin": "plugins", "resume": "resume=True", "force": "force=True"}
_SAME = {"ablate", "cell", "max_fault_fraction", "seed", "set", "shard", "threads", "traces", "trials", "until_half_width"}


def in_python(text: str) -> str:
    """Returns a sentence of the command with its options as the parameters of this package: --out is folder."""
    def renamed(option: "re.Match[str]") -> str:
        name = option[1].replace("-", "_")
        return _RENAMED.get(name, name if name in _SAME else option[0])

    return re.sub(r"--([a-z][a-z-]*[a-z])", renamed, text)


class InputError(ValueError):
    """An input cannot be used. `problems` names everything that is wrong with it; nothing was written."""

    def __init__(self, problems: Sequence[Problem] | str) -> None:
        told = [Problem("", problems, "")] if isinstance(problems, str) else problems
        self.problems = [Problem(*map(in_python, each)) for each in told]
        super().__init__("\n".join(map(str, self.problems)))

    def __str__(self) -> str:  # not a KeyError's, which quotes its text
        return "\n".join(map(str, self.problems))

    def __reduce__(self) -> Any:  # to another process, whatever the parameters of its type are
        return InputError, (self.problems,)


class UnknownName(InputError, KeyError):
    """A mapping has no such name."""

    def __init__(self, what: str, name: str, names: "Iterable[str]") -> None:
        known = list(names)
        near = difflib.get_close_matches(name, known, 3, 0.6)
        meant = f"did you mean {' or '.join(near)}?" if near else f"there are {', '.join(known)}"
        super().__init__([Problem("", f"{what} has no {name}: {meant}", "")])


class WorkError(RuntimeError):
    """Work failed while it went on. What was finished is stored: `run` opens it (None: no folder)."""

    def __init__(self, problems: Sequence[Problem], run: object = None) -> None:
        self.problems = [Problem(*map(in_python, each)) for each in problems]
        self.run = run
        super().__init__("\n".join(map(str, self.problems)))

    def __reduce__(self) -> Any:  # without the run, which the other process opens by itself
        return type(self), (self.problems,)


class MachineError(WorkError):
    """Disk, memory or processes are short: the same call may succeed later."""


class TooManyFaults(WorkError):
    """More simulator faults than `max_fault_fraction` allows. All trials are stored."""


class MissingPart(ImportError):
    """A package that this needs is not installed; everything else works without it."""


def whole(name: str, value: object, most: int = 2**32 - 1) -> int:
    """Returns a whole number from 0 to `most`; raises InputError where it is none."""
    try:
        number = operator.index(value)  # type: ignore[arg-type]
    except TypeError:
        number = -1
    if not 0 <= number <= most:
        raise InputError([Problem(name, f"is {value!r}", f"use a whole number from 0 to {most}")])
    return number


def told(error: BaseException, trace: "TracebackType | None") -> str:
    """Returns an error in one line, with the place where it came up."""
    frames = traceback.extract_tb(trace)
    place = f" ({frames[-1].filename}:{frames[-1].lineno})" if frames else ""
    return f"{type(error).__name__}: {error}{place}"


def need(package: str, debian: str, what: str):  # type: ignore[no-untyped-def]
    """Imports a package that is no condition for the rest."""
    import importlib

    try:
        return importlib.import_module(package)
    except ImportError as error:
        raise MissingPart(f"{what} needs {package.partition('.')[0]} (Debian: {debian})") from error
