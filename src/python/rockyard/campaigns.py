"""Runs and sweeps: what the commands run, sweep, merge, check and compare do."""

from __future__ import annotations

import contextlib
import json
import logging
import re
import sys
import tempfile
import time
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any, Callable, Iterable, Iterator, Mapping, TypeVar, Union

import numpy as np

from . import _core
from .errors import InputError, MachineError, Problem, TooManyFaults, WorkError, in_python, need
from .inprocess import add_deciders
from .records import OUTCOMES
from .runs import Run, Sweep
from .scenario import Scenario, assignments

if TYPE_CHECKING:
    from os import PathLike

    import pandas

    from .inprocess import Decider

    Plugin = Union[str, PathLike[str], Mapping[str, str]]
    Plugins = Union[Plugin, Iterable[Plugin]]
    Progress = Union[bool, Callable[[int, int], None]]

Opened = TypeVar("Opened", Run, Sweep)

DONE, DIFFERS, BAD_INPUT, TOO_MANY_FAULTS, INCONCLUSIVE, FAILED, INTERRUPTED = 0, 1, 2, 3, 4, 5, 130


class _Line:
    """A progress line on a terminal or in a notebook."""

    def __init__(self) -> None:
        self._began = time.monotonic()
        self._first: "int | None" = None

    def __call__(self, finished: int, planned: int) -> None:
        first = self._first if self._first is not None else finished
        self._first = first
        passed = time.monotonic() - self._began
        speed = (finished - first) / passed if passed > 0 else 0.0
        pace = f", {speed:.3g}/s" if speed > 0 else ""
        left = f", {(planned - finished) / speed:.0f} s left" if speed > 0 and finished < planned else ""
        bar = "#" * (30 * finished // max(planned, 1))
        end = "\n" if finished >= planned else ""
        print(f"\r  [{bar:<30}] {finished}/{planned}{pace}{left}   ", end=end, file=sys.stderr, flush=True)


def _shown(progress: "Progress | None") -> "Callable[[int, int], None] | None":
    if progress is None:
        progress = sys.stderr.isatty() or "ipykernel" in sys.modules
    if progress is True:
        return _Line()
    return progress if callable(progress) else None


def _warn(note: str) -> None:
    """Warns of a note at the line that called the package."""
    level, frame = 2, sys._getframe(1)
    while frame.f_back is not None and Path(frame.f_code.co_filename).parent == Path(__file__).parent:
        level, frame = level + 1, frame.f_back
    warnings.warn(note, stacklevel=level)


def told(result: Any, run: "Callable[[Path], object] | None" = None) -> Path:
    """Returns the folder of work that went well; raises what went wrong."""
    outcome, folder, notes, problems, _ = result
    for is_warning, note in notes if outcome != BAD_INPUT else ():
        note = in_python(note)
        if is_warning:
            _warn(note)
        else:
            logging.getLogger("rockyard").info(note)
    if outcome == BAD_INPUT:
        raise InputError(problems)
    if outcome == INTERRUPTED:  # by a signal that Python did not see
        raise KeyboardInterrupt
    if outcome in (TOO_MANY_FAULTS, FAILED):
        # Of a worker that died there is nothing to say but the notes.
        problems = problems or [Problem("", note, "") for is_warning, note in notes if is_warning]
        opened = None
        if run and folder:
            with contextlib.suppress(InputError, WorkError):  # a disk that was full at once has no store
                opened = run(Path(folder))
        raise (TooManyFaults if outcome == TOO_MANY_FAULTS else MachineError)(problems, opened)
    if outcome == DIFFERS:
        raise WorkError(problems)
    return Path(folder)


def _options(source: str, **given: Any) -> Any:
    options = _core.RunOptions()
    options.source = source
    for name, value in given.items():
        try:
            if value is not None:
                setattr(options, name, value)
        except TypeError:
            raise InputError([Problem(name, f"is {value!r}", "see help(rockyard.run)")]) from None
    return options


def _existing(resume: bool, force: bool) -> str:
    return {(False, False): "refuse", (True, False): "resume", (False, True): "set_aside",
            (True, True): "resume_or_set_aside"}[resume, force]


def _listed(given: Any) -> list[Any]:
    """Returns what is given as a list; one text, file, class or mapping is a list of one."""
    one = isinstance(given, (str, type, Mapping, Run)) or hasattr(given, "__fspath__")
    return [given] if one else list(given)


def _plugged(plugins: list[Any]) -> list[str]:
    """Returns the settings that open plugins and choose what a single one adds."""
    if not plugins:
        return []
    processes = [each["process"] for each in plugins if isinstance(each, Mapping)]
    return _core.plugin_settings([str(each) for each in plugins if not isinstance(each, Mapping)], processes)


def run(scenario: "str | PathLike[str] | Scenario", trials: "int | None" = None, seed: "int | None" = None, *,
        set: "Mapping[str, Any] | None" = None, folder: "str | PathLike[str] | None" = None, resume: bool = False,
        force: bool = False, deciders: "Decider | Iterable[Decider]" = (), plugins: "Plugins" = (),
        ablate: "str | Iterable[str]" = (), traces: "str | Iterable[str]" = (),
        until_half_width: "float | None" = None, threads: int = 0, shard: str = "", max_fault_fraction: float = 0.01,
        progress: "Progress | None" = None) -> Run:
    """Runs the trials of a scenario and returns the run. The store is that of `rockyard run`, bit for bit.

    scenario  a name ("nominal"), a file, the folder of a run, or a Scenario
    trials, seed       None: the scenario's
    set       values by path: {"rover.fidelity": "quasi_static"}
    folder    where the run is kept; None: results/runs/<name>-seed<seed>. A run that is there already is
              refused; resume=True goes on with it, force=True sets it aside
    deciders  classes of navigators and estimators in Python, chosen where they are named here
    plugins   libraries of navigators and estimators (files), or {"process": "python3 mine.py"}; one that
              adds a single navigator or estimator has it chosen. One alone needs no list, nor does a rule
    ablate    causes of failure that are taken away ("perfect_localization"; `rockyard list --ablations`)
    traces    which trials leave a trace: "all", "failures", "worst:5", "share:0.1"
    until_half_width   goes on until the interval of success is that narrow (trials: None)
    threads   0: as many as the machine runs at once. With deciders in Python they take turns in them
    progress  True: a line on stderr; a function of (finished, planned); None: a line on a terminal

    Ctrl-C ends it early: the trials in flight end and are stored, KeyboardInterrupt is raised, and the
    same call with resume=True goes on. Raises InputError (nothing written), TooManyFaults, MachineError.
    Trials run in this process, and with libraries in workers of it, which may crash.
    """
    done: Run = _run(_core.run, lambda at, kinds: Run(at, "", kinds), scenario, deciders, plugins, set, progress,
                     trials=trials, seed=seed, folder=folder, existing=_existing(resume, force),
                     ablations=_listed(ablate), traces=_listed(traces), half_width=until_half_width, threads=threads,
                     shard=shard, max_fault_fraction=max_fault_fraction)
    return done


def sweep(design: "str | PathLike[str] | Mapping[str, Any]", trials: "int | None" = None, seed: "int | None" = None, *,
          set: "Mapping[str, Any] | None" = None, folder: "str | PathLike[str] | None" = None, resume: bool = False,
          force: bool = False, deciders: "Decider | Iterable[Decider]" = (), plugins: "Plugins" = (),
          traces: "str | Iterable[str]" = (), until_half_width: "float | None" = None, threads: int = 0,
          max_fault_fraction: float = 0.01, progress: "Progress | None" = None) -> Sweep:
    """Runs a scenario over the cells of a design and returns the sweep.

    design  a sweep's name or file, or its members as a dict:
            {"name": "slopes", "scenario": "nominal", "axes": [{"path": "terrain.ground.slope_deg", "values": [0, 5, 10]}]}
            Its scenario is a name, a file or a Scenario. "common_random_numbers": True gives each cell the same rocks
    The rest is that of run().
    """
    given = dict(trials=trials, seed=seed, folder=folder, existing=_existing(resume, force), traces=_listed(traces),
                 half_width=until_half_width, threads=threads, max_fault_fraction=max_fault_fraction)
    done: Sweep
    if not isinstance(design, Mapping):
        done = _run(_core.sweep, Sweep, _core.find(str(design), "sweep"), deciders, plugins, set, progress, **given)
        return done
    members, scenario = dict(design), design.get("scenario")
    with tempfile.TemporaryDirectory() as made:
        if isinstance(scenario, Scenario):
            deciders = (*_listed(deciders), *scenario._deciders)
            scenario.save(Path(made) / "scenario.json")
            members["scenario"] = "scenario.json"
        elif scenario is not None:
            members["scenario"] = str(Path(_core.find(str(scenario), "scenario")).resolve())
        file = Path(made) / "sweep.json"
        try:
            text = json.dumps(members)
        except (TypeError, ValueError) as error:
            raise InputError([Problem("design", str(error), "use numbers, texts, lists and dicts")]) from None
        file.write_text(text, encoding="utf-8")
        with _called("design", made):
            done = _run(_core.sweep, Sweep, str(file), deciders, plugins, set, progress, **given)
    return done


@contextlib.contextmanager
def _called(name: str, folder: str) -> "Iterator[None]":
    """Has errors name what was given, not the file that it was put into for the work."""
    try:
        yield
    except InputError as error:
        named = [each._replace(path=re.sub(rf"{re.escape(folder)}/\w+\.json", name, each.path)) for each in error.problems]
        raise InputError(named) from None


def _warn_of_faults(run: "Run | Sweep") -> None:
    """Warns where classes in Python failed as they drove: a rate alone does not say so."""
    for each in [run] if isinstance(run, Run) else list(run):
        faults = each.summary.get("outcomes", {}).get("navigator_fault", 0)
        if faults:
            first = int(np.argmax(each.records["outcome"] == OUTCOMES.index("navigator_fault")))
            _warn(f"{faults} of {len(each)} drives of {each.name} ended as navigator_fault; the first: {each.details[first]}")


def _run(work: Any, opened: "Callable[..., Opened]", source: Any, deciders: Any, plugins: Any, set: Any, progress: Any,
         **given: Any) -> "Opened":
    base = _core.Scenario()
    added = tuple(dict.fromkeys(_listed(deciders)))
    own = tuple(each for each in (source._deciders if isinstance(source, Scenario) else ()) if each not in added)
    kinds = own + added
    add_deciders(base, own)  # chosen or not, as in the source
    plugged = _listed(plugins)
    given["supervised"] = any(not isinstance(each, Mapping) for each in plugged)
    given["overrides"] = add_deciders(base, added) + _plugged(plugged) + assignments(set)
    if given.get("folder") is not None:
        given["folder"] = str(given["folder"])
    if isinstance(source, Scenario):
        with tempfile.TemporaryDirectory() as made:
            file = Path(made) / "scenario.json"
            source.save(file)
            with _called("scenario", made):
                result = told(work(_options(str(file), **given), base, _shown(progress)), lambda at: opened(at, kinds))
    else:
        path = str(source) if work is _core.sweep else _core.find(str(source), "scenario")
        result = told(work(_options(path, **given), base, _shown(progress)), lambda at: opened(at, kinds))
    done = opened(result, kinds)
    if kinds:
        _warn_of_faults(done)
    return done


def _folders(runs: "Iterable[Run | str | PathLike[str]]") -> list[str]:
    folders = [str(getattr(each, "folder", each)) for each in runs]
    if not folders:
        raise InputError([Problem("runs", "are none", "name at least one")])
    return folders


def merge(shards: "Iterable[str | PathLike[str] | Run]", folder: "str | PathLike[str]", partial: bool = False) -> "Run | Sweep":
    """Puts the shards of a campaign together in a new folder."""
    told(_core.merge(_folders(shards), str(folder), partial))
    return load(folder)


def load(folder: "str | PathLike[str]", deciders: "Decider | Iterable[Decider]" = ()) -> "Run | Sweep":
    """Opens the folder of a run or of a sweep. `deciders`: what it was driven with, to drive it again. Where a type
    checker has to know which it is: Run(folder), Sweep(folder)."""
    head, kinds = _core.head(str(folder), ""), tuple(_listed(deciders))
    return Sweep(folder, kinds, head) if head["is_sweep"] else Run(folder, "", kinds, head)


class Check:
    """Runs held against published values or a baseline. `agrees`: True, False, None (inconclusive)."""

    def __init__(self, outcome: int, told: dict[str, Any]) -> None:
        self.agrees = {DONE: True, DIFFERS: False}.get(outcome)
        self.json = told

    @property
    def rows(self) -> "pandas.DataFrame":
        """A row a published value, or a metric of the baseline."""
        pandas = need("pandas", "python3-pandas", "Check.rows")
        return pandas.DataFrame(self.json["values"] if "values" in self.json else self.json["metrics"])

    def __repr__(self) -> str:
        word = {True: "agrees", False: "differs", None: "inconclusive"}[self.agrees]
        return f"<Check: {word}, {len(self.json.get('values', self.json.get('metrics', [])))} rows>"


class Comparison:
    """Two runs held against each other: trial by trial where the seeds are the same."""

    def __init__(self, outcome: int, told: dict[str, Any]) -> None:
        self.json = told
        self.differs = outcome == DIFFERS
        found = told.get("comparison", {})
        self.pairs: int = found.get("pairs", 0)
        self.settings = found.get("settings", [])

    @property
    def successes(self) -> "pandas.DataFrame":
        """declared and true success: both rates, second less first, its 95 % interval, p-value."""
        return self._frame("successes")

    @property
    def differences(self) -> "pandas.DataFrame":
        """Every column: both means, second less first with its 95 % interval; each on its own."""
        return self._frame("columns")

    def _frame(self, member: str) -> "pandas.DataFrame":
        pandas = need("pandas", "python3-pandas", "Comparison")
        found = self.json.get("comparison")
        return pandas.DataFrame(found[member] if found else self.json["cells"])

    def __repr__(self) -> str:
        if "comparison" not in self.json:
            return f"<Comparison of {len(self.json['cells'])} cells>"
        row = self.json["comparison"]["successes"][-1]
        ends = f"{100 * row['low']:+.1f} .. {100 * row['high']:+.1f}" if row["low"] is not None else "no interval"
        of = f"{self.pairs} pairs" if self.pairs else "independent trials"
        return f"<Comparison of {of}: {row['what']} {100 * row['difference']:+.1f} points ({ends})>"


def compare(first: "Run | str | PathLike[str]", second: "Run | str | PathLike[str]") -> Comparison:
    """Compares two runs, or two cells (Sweep[...]). Raises InputError."""
    one, other = (str(getattr(run, "folder", run)) for run in (first, second))
    outcome, text = _core.compare(one, other, getattr(first, "cell", ""), getattr(second, "cell", ""))
    return Comparison(outcome, json.loads(text))


def check(runs: "Run | str | PathLike[str] | Iterable[Run | str | PathLike[str]]", against: "str | PathLike[str]", cell: str = "") -> Check:
    """Holds runs against a file of published values or a baseline (results/reference, results/baselines)."""
    listed = _listed(runs)
    outcome, text = _core.check(_folders(listed), str(against), cell)
    return Check(outcome, json.loads(text))


def write_baseline(runs: "Run | Iterable[Run | str | PathLike[str]]", file: "str | PathLike[str]", name: str, reason: str) -> None:
    """Keeps the results of finished runs for later builds to be held against (check). `reason`: why they are right."""
    if not reason:
        raise InputError([Problem("reason", "is empty", "say why these numbers may be what they are")])
    _core.write_baseline(_folders([runs] if isinstance(runs, Run) else runs), str(file), name, reason)
