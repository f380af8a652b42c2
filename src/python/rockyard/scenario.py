"""A scenario as a mapping: s["rover.fidelity"], s.rover.fidelity, s.terrain.rocks["k_per_m2"] = 0.02."""

from __future__ import annotations

import copy
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any, Iterable, Iterator, Mapping, MutableMapping, Union

import numpy as np

from . import _core
from .errors import MOST_SEED, InputError, Problem, UnknownName, whole
from .inprocess import Decider, add_deciders

if TYPE_CHECKING:
    from os import PathLike

    from ._core import Scenario as Core

    Source = Union[str, PathLike[str], "Scenario"]


def _plain(value: Any) -> Any:
    """Returns a value of NumPy as one of Python."""
    if isinstance(value, (np.generic, np.ndarray)):
        return value.tolist()
    raise TypeError(f"is of type {type(value).__name__}")


def _text(path: str, value: Any) -> str:
    try:
        return value if isinstance(value, str) else json.dumps(value, default=_plain)
    except (TypeError, ValueError) as error:
        raise InputError([Problem(path, str(error), "use a number, a text, a truth value, or lists of them")]) from None


def assignments(values: Mapping[str, Any] | None) -> list[str]:
    """Returns {"rover.fidelity": "quasi_static"} as the command's --set takes it."""
    return [f"{path}={_text(path, value)}" for path, value in (values or {}).items()]


class Group(MutableMapping[str, Any]):
    """A group of a scenario's parameters. Keys are paths below it; attributes complete in a shell."""

    _scenario: "Scenario"
    _path: str

    def __init__(self, scenario: "Scenario", path: str) -> None:
        object.__setattr__(self, "_scenario", scenario)
        object.__setattr__(self, "_path", path)

    def _at(self, key: str) -> str:
        return f"{self._path}.{key}" if self._path else key

    def _members(self) -> dict[str, Any]:
        node: Any = self._scenario._all()
        for part in filter(None, self._path.split(".")):
            node = node[part]
        return node  # type: ignore[no-any-return]

    def __getitem__(self, key: str) -> Any:
        path = self._at(key)
        node: Any = self._scenario._all()
        above = ""
        for part in path.split("."):
            if not isinstance(node, dict) or part not in node:
                raise UnknownName(above or "a scenario", part, node if isinstance(node, dict) else ())
            node, above = node[part], f"{above}.{part}" if above else part
        return Group(self._scenario, path) if isinstance(node, dict) else copy.deepcopy(node)

    def __setitem__(self, key: str, value: Any) -> None:
        self._scenario.set({self._at(key): value})

    def __delitem__(self, key: str) -> None:
        raise InputError([Problem(self._at(key), "cannot be taken away", "set it to another value")])

    def __iter__(self) -> Iterator[str]:
        return iter(self._members())

    def __len__(self) -> int:
        return len(self._members())

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self[name]
        except UnknownName as error:
            raise AttributeError(str(error)) from None

    def __setattr__(self, name: str, value: Any) -> None:
        self[name] = value

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self]

    def _ipython_key_completions_(self) -> list[str]:
        return list(self)

    def __repr__(self) -> str:
        return f"<{self._path}: {', '.join(self)}>"


class Scenario(Group):
    """Every parameter of a drive or another experiment. Copies are independent.

    source   a scenario's name ("nominal"), a file, the folder of a run; None: every default
    set      values by path, in the units that the paths end in: {"terrain.ground.slope_deg": 10}
    deciders navigators and estimators in Python that the scenario may name; the last navigator and the
             last estimator among them are chosen

    Raises InputError with everything that is wrong: unknown keys, values out of bounds, conditions
    across parameters.
    """

    _core: "Core"
    _deciders: tuple[Decider, ...]
    _values: dict[str, Any] | None

    def __init__(self, source: "Source | None" = None, set: Mapping[str, Any] | None = None,
                 deciders: Iterable[Decider] = ()) -> None:
        super().__init__(self, "")
        own = source._deciders if isinstance(source, Scenario) else ()
        more = tuple(deciders)
        base = _core.Scenario()
        add_deciders(base, (each for each in own if each not in more))  # chosen or not, as in the source
        settings = add_deciders(base, dict.fromkeys(more)) + assignments(set)
        if source is None or isinstance(source, Scenario):
            text = "{}" if source is None else source.resolved()
            made = _core.Scenario.parse(text, settings, ".", base)
        else:
            made = _core.Scenario.load(_core.find(str(source), "scenario"), settings, base)
        self._take(made, tuple(dict.fromkeys(own + more)))

    def _take(self, made: "Core", deciders: tuple[Decider, ...]) -> None:
        object.__setattr__(self, "_core", made)
        object.__setattr__(self, "_deciders", deciders)
        object.__setattr__(self, "_values", None)

    def set(self, values: Mapping[str, Any]) -> "Scenario":
        """Changes values; all of them or, with InputError, none. Returns the scenario."""
        self._take(Scenario(self, values)._core, self._deciders)
        return self

    def copy(self) -> "Scenario":
        """Returns another scenario of the same values."""
        return Scenario(self)

    def to_dict(self) -> dict[str, Any]:
        """Returns every value as nested dicts."""
        return copy.deepcopy(self._all())

    def _all(self) -> dict[str, Any]:
        if self._values is None:
            object.__setattr__(self, "_values", json.loads(self.resolved()))
        assert self._values is not None
        return self._values

    def resolved(self) -> str:
        """Returns the text of a scenario file that reads back to the same scenario, bit for bit."""
        return self._core.resolved()

    def save(self, path: "str | PathLike[str]") -> None:
        """Writes that text to a new file."""
        with Path(path).open("x", encoding="utf-8") as file:
            file.write(self.resolved())

    def run_trial(self, trial: int, seed: int | None = None) -> dict[str, Any]:
        """Runs one trial and returns its record: trial, outcome, detail, and every column by its name."""
        seed = self._core.seed if seed is None else whole("seed", seed, MOST_SEED)
        record = self._core.run_trial(seed, whole("trial", trial))
        values = record.pop("values")
        return {**record, **dict(zip([column[0] for column in self._core.columns()], values.tolist()))}

    def __repr__(self) -> str:
        return f"<Scenario {self._core.name}: {self._core.trials} trials, seed {self._core.seed}>"


def scenarios() -> list[str]:
    """Returns the names of the scenarios that are found by name."""
    return _core.scenario_names()


def sweeps() -> list[str]:
    """Returns the names of the sweeps that are found by name."""
    return _core.sweep_names()
