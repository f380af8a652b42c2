"""Navigators and estimators in Python within the process that runs the trials.

A navigator is a class of rockyard.navigator, the same that a process serves: the same messages, the
same decisions, the same records. Trials call it under the interpreter's lock; where it computes for
long, run it as a process instead (plugins=[...]), one for each thread.
"""

from __future__ import annotations

import functools
import hashlib
import inspect
import json
import sys
import time
import traceback
import types
from typing import TYPE_CHECKING, Any, Iterable, Union

from . import navigator as _navigator
from .errors import InputError, Problem

if TYPE_CHECKING:
    from . import _core
    from .estimator import Estimator

    Decider = Union[type[_navigator.Navigator], type[Estimator]]
else:
    Decider = type


class Uses:
    """What the decisions of a class have cost in this process."""

    def __init__(self) -> None:
        self.decisions = 0
        self.cpu_s = 0.0
        self.longest_s = 0.0
        self._shown: set[str] = set()

    def show(self) -> None:
        """Shows where a navigator failed: once, as all trials of a run may fail alike."""
        text = traceback.format_exc()
        if text not in self._shown and len(self._shown) < 10:
            self._shown.add(text)
            print(text, end="", file=sys.stderr)

    def __repr__(self) -> str:
        each = 1e6 * self.cpu_s / max(self.decisions, 1)
        return f"<{self.decisions} decisions, {each:.0f} us of CPU each, the longest {1e3 * self.longest_s:.1f} ms>"


class Session:
    """Answers the messages of one drive after the other."""

    def __init__(self, cls: "type[_navigator.Navigator]", uses: Uses) -> None:
        self._cls, self._uses = cls, uses
        self._navigator: "_navigator.Navigator | None" = None
        self.used_s = 0.0

    def __call__(self, text: bytes) -> bytes:
        began = time.thread_time()
        answer, self._navigator = _navigator.reply(self._cls, self._navigator, text, self._uses.show)
        self.used_s = time.thread_time() - began
        self._uses.decisions += b'"type":"decide"' in text[:4096]
        self._uses.cpu_s += self.used_s
        self._uses.longest_s = max(self._uses.longest_s, self.used_s)
        return answer


def _constant(value: Any) -> str:
    """Returns a constant as text that is the same in every process: no address, no order of a set. What can change
    (lists, dicts, objects) may be state, and counts by its type alone."""
    if isinstance(value, types.CodeType):
        inner = ", ".join(map(_constant, value.co_consts))
        return f"code({value.co_code.hex()}, {value.co_names}, {value.co_varnames}, {inner})"
    if isinstance(value, tuple):
        return f"({', '.join(map(_constant, value))})"
    if isinstance(value, frozenset):
        return f"{{{', '.join(sorted(map(_constant, value)))}}}"
    if isinstance(value, (staticmethod, classmethod)):
        return _constant(value.__func__)
    if isinstance(value, property):
        return _constant((value.fget, value.fset, value.fdel))
    if inspect.isfunction(value):
        cells = tuple(map(_held, value.__closure__ or ()))
        return _constant((value.__code__, value.__defaults__, tuple((value.__kwdefaults__ or {}).items()), cells))
    plain = isinstance(value, (bool, int, float, complex, str, bytes, type(None), type(...)))
    return repr(value) if plain else type(value).__qualname__


def _held(cell: types.CellType) -> Any:
    """Returns what a closure holds; of a function its code alone, as it may hold itself."""
    try:
        return getattr(cell.cell_contents, "__code__", cell.cell_contents)
    except ValueError:  # nothing yet
        return None


def _source(cls: type) -> str:
    """Returns the source of a class, or what stands for it where there is none (typed into a prompt)."""
    members = vars(cls)
    try:
        file = inspect.getsourcefile(cls)
        if all(each.__code__.co_filename == file for each in members.values() if inspect.isfunction(each)):
            return inspect.getsource(cls)
    except (OSError, TypeError):
        pass
    made = ("__module__", "__dict__", "__weakref__", "__doc__", "uses")  # by Python or here
    return "\n".join(f"{name} = {_constant(members[name])}" for name in sorted(members) if name not in made)


def identity(cls: Decider) -> str:
    """Returns what stores know a class by: its name, its version, a hash of its source.

    A run goes on only with the same one. Of a class whose source cannot be found (typed into a prompt),
    its code and constants are hashed.
    """
    hasher = hashlib.sha256()
    for each in reversed(cls.__mro__[:-1]):
        hasher.update(_source(each).encode())
    return f"{cls.name} {cls.version} {hasher.hexdigest()[:16]}"


def as_process(cls: "type[_navigator.Navigator]") -> dict[str, str]:
    """Returns the plugin by which a navigator runs in processes of its own, one for each thread of a run.

    For one that computes for long: run(..., plugins=[as_process(Mine)]). The class stands in a file that
    can be imported; its decisions and records are the same.
    """
    import shlex
    import sys

    try:
        file = inspect.getsourcefile(cls)
    except TypeError:
        file = None
    if file is None or cls.__qualname__ != cls.__name__:
        raise InputError(f"{cls.__name__} stands in no file, at its top level: a process has to find it there")
    from . import serve

    return {"process": shlex.join([sys.executable, serve.__file__, file, cls.__name__])}


def _navigates(cls: type) -> bool:
    """Whether it is a navigator, also of a copy of the module, as those that run as processes import one."""
    return any(each.__name__ == "Navigator" and each.__module__ in (_navigator.__name__, "rockyard_navigator")
               for each in cls.__mro__)


def _own_values(cls: Decider) -> list[dict[str, str]]:
    values = [tuple(each) if isinstance(each, (list, tuple)) else () for each in cls.own_values]
    for each in values:
        if len(each) != 3 or not all(isinstance(word, str) for word in each):
            raise InputError([Problem(f"{cls.__name__}.own_values", "is no list of three texts each",
                                      'use [("replans", "1", "How often it planned anew.")]')])
    return [dict(zip(("name", "unit", "meaning"), each)) for each in values]


def _check(cls: Decider) -> None:
    """Raises InputError where what a class says of itself is of a wrong type."""
    for member in ("name", "doc", "version"):
        if not isinstance(getattr(cls, member), str):
            raise InputError([Problem(f"{cls.__name__}.{member}", f"is {getattr(cls, member)!r}", "use a text")])
    for member in ("parameters", "own_values"):
        if not isinstance(getattr(cls, member), (list, tuple)):
            raise InputError([Problem(f"{cls.__name__}.{member}", f"is {getattr(cls, member)!r}", "use a list")])
    _own_values(cls)
    try:
        json.dumps(cls.parameters, allow_nan=False)
    except (TypeError, ValueError) as error:
        raise InputError([Problem(f"{cls.__name__}.parameters", str(error), "use parameter(...)")]) from None


def add_deciders(scenario: "_core.Scenario", classes: "Iterable[Decider]") -> list[str]:
    """Adds the classes to a scenario and returns the settings that choose the last of each kind."""
    from .estimator import Estimator, Made

    chosen: dict[str, str] = {}
    for cls in classes:
        if not inspect.isclass(cls):
            raise InputError(f"{cls!r} is no class: give the class of a navigator or an estimator, which makes one object a trial")
        if _navigates(cls):
            _check(cls)
            uses = cls.__dict__.get("uses")
            if uses is None:
                uses = Uses()
                cls.uses = uses
            scenario.add_navigator(cls.name, identity(cls), functools.partial(Session, cls, uses))
            chosen["navigation.navigator"] = cls.name
        elif issubclass(cls, Estimator):
            _check(cls)
            description: dict[str, Any] = {
                "name": cls.name, "doc": cls.doc, "parameters": cls.parameters, "own_values": _own_values(cls),
                "takes_fixes": cls.takes_fixes, "takes_motions": cls.takes_motions}
            scenario.add_estimator(json.dumps(description), identity(cls), functools.partial(Made, cls))
            chosen["localization.estimator"] = cls.name
        else:
            raise InputError(f"{cls.__name__} is neither a rockyard.Navigator nor a rockyard.Estimator")
    return [f"{path}={name}" for path, name in chosen.items()]
