"""Drives step by step, in the shape of Gymnasium: the caller is the navigator.

    env = Environment("nominal", set={"rover.fidelity": "quasi_static"})
    observation, info = env.reset(seed=7, index=3)
    while True:
        observation, reward, terminated, truncated, info = env.step(forward(until_distance_m=0.5))
        if terminated or truncated: break

One step is one decision: the drive's own loop goes on until it would ask its navigator again. An
episode is trial `index` of the campaign `seed`, and a scripted policy gives the record of the same
navigator run plainly. Observations hold what is measured and believed on board, never the truth; the
record at the end (info["record"]) holds the truth. The observation beside it is the last one that a
decision was made on. No dependency: spaces are plain classes with the
members of Gymnasium's; gymnasium_environment() wraps one where Gymnasium is installed.
"""

from __future__ import annotations

import enum
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Callable, Mapping, Sequence

import numpy as np

from . import _core
from .errors import MOST_SEED, InputError, Problem, need, whole
from .inprocess import add_deciders
from .scenario import Scenario, assignments

if TYPE_CHECKING:
    from os import PathLike

    Array = np.ndarray[Any, Any]
    Reward = Callable[[dict[str, Any], dict[str, Any], bool, "dict[str, Any] | None"], float]


class Kind(enum.IntEnum):
    """What an action asks for."""

    FORWARD = 0
    BACKWARD = 1
    TURN_LEFT = 2
    TURN_RIGHT = 3
    LOOK_AHEAD = 4
    LOOK_BEHIND = 5
    REST = 6
    ARRIVED = 7
    GAVE_UP = 8


# Columns of an action: name, least, largest, meaning. Must agree: ActionColumn in environment.cc.
ACTION = (
    ("kind", 0.0, 8.0, "a value of Kind; the nearest one where it lies between two"),
    ("curvature_per_m", -1000.0, 1000.0, "of an arc, positive to the left"),
    ("distance_m", 0.0, np.inf, "until the odometer has gone so far; 0: until an event"),
    ("turn_rad", 0.0, np.inf, "until the heading has changed so much; 0: until an event"),
    ("period_s", 0.0, np.inf, "of a rest; 0: until an event"),
    ("speed_share", 0.0, 1.0, "of full speed; 0: all of it"),
)


def _action(kind: Kind, **columns: float) -> "Array":
    return np.array([float(kind), *(columns.get(name, 0.0) for name, *_ in ACTION[1:])])


def forward(curvature_per_m: float = 0.0, until_distance_m: float = 0.0, speed_share: float = 1.0) -> "Array":
    """Drives an arc, positive curvatures to the left, until the odometer has gone so far; 0: until an event."""
    return _action(Kind.FORWARD, curvature_per_m=curvature_per_m, distance_m=until_distance_m, speed_share=speed_share)


def backward(curvature_per_m: float = 0.0, until_distance_m: float = 0.0, speed_share: float = 1.0) -> "Array":
    """Drives the same backwards."""
    return _action(Kind.BACKWARD, curvature_per_m=curvature_per_m, distance_m=until_distance_m, speed_share=speed_share)


def turn(direction: int, turn_rad: float = 0.0) -> "Array":
    """Turns in place, +1 to the left."""
    return _action(Kind.TURN_LEFT if direction > 0 else Kind.TURN_RIGHT, turn_rad=turn_rad)


def look(behind: bool = False) -> "Array":
    """Stops and looks; the next observation holds what was seen."""
    return _action(Kind.LOOK_BEHIND if behind else Kind.LOOK_AHEAD)


def rest(period_s: float) -> "Array":
    """Stands so long; 0: until an event."""
    return _action(Kind.REST, period_s=period_s)


def arrived() -> "Array":
    """Says that the goal is reached, which ends the drive."""
    return _action(Kind.ARRIVED)


def gave_up() -> "Array":
    """Says that there is no way, which ends the drive."""
    return _action(Kind.GAVE_UP)


@dataclass(frozen=True)
class Box:
    """Bounds of an array, with the unit of each of its last axis' members."""

    low: "Array"
    high: "Array"
    shape: tuple[int, ...]
    dtype: Any
    units: tuple[str, ...] = ()

    def contains(self, value: Any) -> bool:
        """Returns whether a value has this shape and lies within the bounds."""
        array = np.asarray(value)
        return array.shape == self.shape and bool(np.all((array >= self.low) & (array <= self.high)))

    def sample(self, generator: "np.random.Generator") -> "Array":
        """Draws evenly between the bounds; an end that has none counts as 1 from 0."""
        low, high = np.where(np.isfinite(self.low), self.low, -1.0), np.where(np.isfinite(self.high), self.high, 1.0)
        return np.asarray(generator.uniform(low, high), dtype=self.dtype)


def _box(low: Any, high: Any, shape: tuple[int, ...], dtype: Any, *units: str) -> Box:
    return Box(np.broadcast_to(np.asarray(low, dtype), shape), np.broadcast_to(np.asarray(high, dtype), shape),
               shape, np.dtype(dtype), units)


def _spaces(seen: "Mapping[str, Array]") -> dict[str, Box]:
    """Returns the space of each member of an observation. Must agree: Seen in environment.cc."""
    stripes, points = seen["hazards"].shape[1], seen["points"].shape[1]
    pi = np.pi
    return {
        "time_s": _box(0, np.inf, (), "f8", "s"),
        "events": _box(0, 2**13 - 1, (), "u4", "bits of navigation::Event"),
        "pose": _box(-np.inf, np.inf, (4,), "f8", "m", "m", "rad", "m"),
        "attitude": _box([-pi, -pi, -np.inf], [pi, pi, np.inf], (3,), "f8", "rad", "rad", "m"),
        "goal": _box([-np.inf, -np.inf, 0, -pi], [np.inf, np.inf, np.inf, pi], (4,), "f8", "m", "m", "m", "rad"),
        "looked": _box(0, 1, (), "i1", "1"),
        "hazards": _box(-1, 1, (stripes,), "i1", "-1 not known, 0 free, 1 hazard"),
        "points": _box(-np.inf, np.inf, (points, 3), "f4", "m, in R"),
        "point_count": _box(0, points, (), "i4", "1"),
        "felt": _box(0, [6, 1, 1], (3,), "i1", "0 or 1 + kind of hazard", "touches behind", "notices stuck"),
    }


def arrival(before: dict[str, Any], after: dict[str, Any], ended: bool, record: "dict[str, Any] | None") -> float:
    """The reward unless another is given: 1 for true arrival, else 0."""
    return float(ended and record is not None and record["outcome"] == "goal_reached")


class Environments:
    """`count` drives side by side, on `threads` threads. Arrays have a row each drive.

    scenario  a name, a file or a Scenario of drives
    points    how many range points of a look an observation holds; 0: it holds the hazards of stripes
    goal_tolerance_m   within which the caller may say that it has arrived; look_time_s: what its software
              computes for after each look
    threads   a drive stays on one of them. With 1 it goes on in the thread that calls, which may be another
              one each time; two threads at once are refused

    A fork cannot go on with the drives of its parent, and makes its own.
    """

    def __init__(self, scenario: "str | PathLike[str] | Scenario" = "nominal", count: int = 1, *, set: "Mapping[str, Any] | None" = None,
                 points: int = 0, goal_tolerance_m: float = 0.3, look_time_s: float = 0.0, threads: int = 1) -> None:
        for name, value, least in (("count", count, 1), ("points", points, 0), ("threads", threads, 1)):
            if whole(name, value) < least:
                raise InputError([Problem(name, f"is {value}", f"use {least} or more")])
        self.scenario = Scenario(scenario, set)
        base = _core.Scenario()
        add_deciders(base, self.scenario._deciders)
        base.add_caller()
        caller = {"navigation.navigator": "caller", "navigation.caller.reads_points": points > 0,
                  "navigation.caller.goal_tolerance_m": goal_tolerance_m, "navigation.caller.look_time_s": look_time_s}
        made = _core.Scenario.parse(self.scenario.resolved(), assignments(caller), ".", base)
        self.count = count
        self._seed = made.seed
        self._drives = _core.Drives(made, count, threads, points)
        self._seen: dict[str, Array] = self._drives.observations()
        self.observation_space = _spaces(self._seen)
        self.action_space = _box([low for _, low, _, _ in ACTION], [high for _, _, high, _ in ACTION], (len(ACTION),), "f8",
                                 *(name for name, *_ in ACTION))
        self._names = [column[0] for column in self._drives.columns()]

    def __repr__(self) -> str:
        return f"<Environments: {self.count} of {self.scenario._core.name}, {int(self.driving.sum())} driving>"

    @property
    def driving(self) -> "Array":
        """Which drives wait for a decision; the others have ended, or have not begun."""
        return self._drives.driving()

    def reset(self, indices: Sequence[int], seed: "int | None" = None, lanes: "Sequence[int] | None" = None) -> "dict[str, Array]":
        """Begins the trials `indices` in these lanes (None: in all) and returns the observations.

        What is returned are views of arrays that the next call fills anew.
        """
        where = list(range(self.count)) if lanes is None else list(lanes)
        if len(indices) != len(where):
            raise InputError(f"{len(indices)} trials for {len(where)} drives")
        seed = self._seed if seed is None else whole("seed", seed, MOST_SEED)
        self._drives.begin([whole("lanes", lane, self.count - 1) for lane in where], [seed] * len(where),
                           [whole("indices", index) for index in indices])
        return self._seen

    def step(self, actions: "Array") -> "tuple[dict[str, Array], Array]":
        """Makes the decisions (count x 6; rows of drives that have ended do not count) and returns the
        observations with a flag for each drive that has ended by it."""
        return self._seen, self._drives.step(actions)

    def record(self, lane: int) -> "dict[str, Any] | None":
        """Returns the record of a drive that has ended: trial, outcome, detail, every column; None before."""
        told = self._drives.record(lane)
        if told is None:
            return None
        values = told.pop("values")
        return {**told, **dict(zip(self._names, values.tolist()))}


class Environment:
    """One drive. Parameters are those of Environments; `reward(before, after, ended, record)` is asked at each step."""

    metadata: dict[str, Any] = {"render_modes": []}
    render_mode = None

    def __init__(self, scenario: "str | PathLike[str] | Scenario" = "nominal", *, reward: "Reward" = arrival, **more: Any) -> None:
        self._made: "Environments | None" = Environments(scenario, 1, **more)
        self._drives: Any = self._made._drives
        self._reward = reward
        self._index = -1
        self._over = self._ended = True
        self._before: dict[str, Any] = {}
        self.scenario = self._all.scenario
        self.observation_space = self._all.observation_space
        self.action_space = self._all.action_space

    def __repr__(self) -> str:
        if self._made is None:
            return "<Environment, closed>"
        now = f"trial {self._index}" + (", at its end" if self._over else "") if self._index >= 0 else "not begun"
        return f"<Environment of {self.scenario._core.name}: {now}>"

    @property
    def _all(self) -> Environments:
        if self._made is None:
            raise InputError([Problem("environment", "is closed", "make another one")])
        return self._made

    def reset(self, *, seed: "int | None" = None, index: "int | None" = None,
              options: "Mapping[str, Any] | None" = None) -> tuple[dict[str, Any], dict[str, Any]]:
        """Begins trial `index` (None: the next one) of the campaign `seed` (None: the scenario's)."""
        index = (options or {}).get("index", index)
        self._index = self._index + 1 if index is None else whole("index", index)
        self._over = True
        self._all.reset([self._index], seed)
        self._over, self._ended = False, not self._drives.driving()[0]
        self._before = self._drives.observe(0)
        return self._before, {"index": self._index}

    def step(self, action: Any) -> tuple[dict[str, Any], float, bool, bool, dict[str, Any]]:
        """Makes one decision. Returns observation, reward, terminated, truncated (by the scenario's limit of
        time), info; of an ended drive info["record"]."""
        if self._over:
            raise InputError([Problem("environment", "has no drive that goes on", "call reset() first")])
        if self._ended:  # before the first decision
            after, over = self._before, True
        else:
            after, over = self._drives.advance(0, action)
        self._over = over
        record = self._all.record(0) if over else None
        reward = self._reward(self._before, after, over, record)
        self._before = after
        truncated = record is not None and record["outcome"] == "time_limit"
        return after, reward, over and not truncated, truncated, {"record": record} if record else {}

    def close(self) -> None:
        """Gives a drive under way up. Only a new environment drives again."""
        self._made = self._drives = None
        self._over = True


def gymnasium_environment(*given: Any, **more: Any) -> Any:
    """Returns Environment(...) as a gymnasium.Env, with Gymnasium's own spaces."""
    gymnasium = need("gymnasium", "not packaged; PyPI: gymnasium", "gymnasium_environment()")
    inner = Environment(*given, **more)

    class Wrapped(gymnasium.Env):  # type: ignore[misc, name-defined]
        metadata = inner.metadata
        observation_space = gymnasium.spaces.Dict(
            {name: gymnasium.spaces.Box(box.low, box.high, box.shape, box.dtype) for name, box in inner.observation_space.items()})
        action_space = gymnasium.spaces.Box(inner.action_space.low, inner.action_space.high, inner.action_space.shape, np.float64)

        def reset(self, *, seed: "int | None" = None, options: "Mapping[str, Any] | None" = None) -> Any:
            super().reset(seed=seed)
            return inner.reset(seed=seed, options=options)

        def step(self, action: Any) -> Any:
            return inner.step(action)

        def close(self) -> None:
            inner.close()

    return Wrapped()
