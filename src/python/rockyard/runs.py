"""Finished runs: records, rates, traces, single trials; campaigns of several cells."""

from __future__ import annotations

import contextlib
import functools
import io
import json
import os
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import TYPE_CHECKING, Any, Iterable, Iterator

import numpy as np

from . import _core, records as _records
from .errors import InputError, Problem, need, whole
from .rates import Rate, rate, rate_from
from .scenario import Scenario
from .traces import Trace, quantity_of

if TYPE_CHECKING:
    from os import PathLike

    import pandas

    from .inprocess import Decider
    from .places import Images, Place


def _codes(outcomes: "Iterable[str]") -> list[int]:
    """Returns the places of outcomes in OUTCOMES; raises InputError."""
    unknown = [each for each in outcomes if each not in _records.OUTCOMES]
    if unknown:
        raise InputError(f"{', '.join(unknown)} is no outcome: there are {', '.join(_records.OUTCOMES)}")
    return [_records.OUTCOMES.index(each) for each in outcomes]


def _counted(records: "np.ndarray[Any, Any]") -> "np.ndarray[Any, Any]":
    counted: "np.ndarray[Any, Any]" = records[records["outcome"] != _records.OUTCOMES.index("simulator_fault")]
    return counted


class Run:
    """The folder of a run, or one cell of a campaign. What follows is read when it is asked for."""

    def __init__(self, folder: "str | PathLike[str]", cell: str = "", deciders: "tuple[Decider, ...]" = (),
                 _head: "dict[str, Any] | None" = None) -> None:
        self.folder = Path(folder)
        self._deciders = deciders
        self._head = _head or _core.head(str(self.folder), cell)
        if self._head["is_sweep"] and not cell:
            raise InputError([Problem(str(folder), "is a sweep", "open it by load(), or name a cell")])
        self.cell: str = self._head["name"]

    @property
    def name(self) -> str:
        """That of the scenario, or of the cell's."""
        return str(self._head["name"] or self._head["scenario"])

    @property
    def seed(self) -> int:
        """The seed of all random streams of its trials."""
        return int(self._head["seed"])

    @functools.cached_property
    def _read(self) -> _records.Told:
        return _records.read(self.folder, self.cell, [name for name, _, _ in self._head["columns"]])

    @property
    def records(self) -> "np.ndarray[Any, Any]":
        """All stored records: a structured array of trial, outcome (place in rockyard.OUTCOMES), and the
        columns in SI units, NaN where undefined. Opened from a column cache beside the store."""
        return self._read.records

    @functools.cached_property
    def counted(self) -> "np.ndarray[Any, Any]":
        """The records of the trials that count: all but simulator faults."""
        return _counted(self.records)

    def ended(self, *outcomes: str) -> "np.ndarray[Any, Any]":
        """Returns for each of the `counted` trials whether it ended as one of these outcomes."""
        return np.isin(self.counted["outcome"], _codes(outcomes))

    @property
    def hash(self) -> str:
        """The hash over all records: equal for equal runs, whoever made them."""
        return self._read.hash

    @property
    def details(self) -> list[str]:
        """What is said of the end of each trial, in the order of `records`."""
        return [self._read.detail(row) for row in range(len(self))]

    @property
    def units(self) -> dict[str, str]:
        """The unit of each column; "1" where it has none."""
        return {name: unit for name, unit, _ in self._head["columns"]}

    @property
    def meanings(self) -> dict[str, str]:
        """What each column is, in a sentence."""
        return {name: meaning for name, _, meaning in self._head["columns"]}

    @functools.cached_property
    def trials(self) -> "pandas.DataFrame":
        """The records as a frame, a row a trial: outcome as a category, columns as in trials.csv.
        attrs["units"] and attrs["meanings"] say what the columns are."""
        pandas = need("pandas", "python3-pandas", "Run.trials")
        rows = self.records
        frame = pandas.DataFrame({name: rows[name] for name in rows.dtype.names or () if name not in ("trial", "outcome")},
                                 index=pandas.Index(rows["trial"].astype("int64"), name="trial"))
        frame.insert(0, "outcome", pandas.Categorical.from_codes(rows["outcome"], list(_records.OUTCOMES)))
        frame.attrs.update(units=self.units, meanings=self.meanings)
        return frame

    @functools.cached_property
    def summary(self) -> dict[str, Any]:
        """summary.json, or the part of it that is about this cell."""
        told = json.loads((self.folder / "summary.json").read_text(encoding="utf-8"))
        if not self.cell:
            return dict(told)
        return dict(next(each for each in told["cells"] if each["name"] == self.cell))

    def _success(self, kind: str) -> Rate:
        if kind not in self.summary:
            raise InputError([Problem(str(self.folder), f"has no {kind}: it holds no drives", "look at trials and summary")])
        return rate_from(self.summary[kind])

    @property
    def true_success(self) -> Rate:
        """Arrived by its own belief and in truth."""
        return self._success("true_success")

    @property
    def declared_success(self) -> Rate:
        """Arrived by its own belief (Matthies 1995, section 7)."""
        return self._success("declared_success")

    def rate(self, *outcomes: str) -> Rate:
        """Returns the rate of these outcomes among the trials that are no simulator faults.

        Trials that share rocks are no independent ones: then take those of `summary`.
        """
        if "simulator_fault" in outcomes:
            raise InputError("simulator_fault counts in no rate: Run.outcomes has how many there are")
        ended = self.ended(*outcomes)
        return rate(int(ended.sum()), len(ended))

    @property
    def outcomes(self) -> dict[str, int]:
        """How many trials ended how; those that none did are left out."""
        codes, counts = np.unique(self.records["outcome"], return_counts=True)
        return {_records.OUTCOMES[code]: int(count) for code, count in zip(codes, counts)}

    @functools.cached_property
    def scenario(self) -> Scenario:
        """Every setting that the trials had."""
        made = Scenario(None, deciders=self._deciders)
        with self._knowing():
            made._take(_core.Scenario.parse(self._head["resolved"], [], str(self.folder), made._core), self._deciders)
        return made

    @contextlib.contextmanager
    def _knowing(self) -> "Iterator[None]":
        """Where a scenario names what only Python knows, says so."""
        try:
            yield
        except InputError as error:
            program, decided, _ = self._head["builds"][0].rpartition(" with ")
            if self._deciders or not decided:
                raise
            raise InputError([Problem("deciders", f"are missing: {program} decided in {self.folder}",
                                      "open it with their classes: load(folder, deciders=[...])"), *error.problems]) from None

    def trial(self, trial: int) -> "Trial":
        """Returns one trial, by its index in the campaign."""
        return Trial(self, trial)

    def __iter__(self) -> "Iterator[Trial]":
        return (self.trial(int(trial)) for trial in self.records["trial"])

    def __len__(self) -> int:
        return len(self.records)

    @property
    def stored_traces(self) -> list[Path]:
        """The traces that were written with the run (traces=["all"], ["failures"], ["worst:5"], ["share:0.1"])."""
        return sorted((self.folder / self._head["traces"]).glob("trial-*.npz"))

    def traces(self, quantity: str, trials: "Iterable[int] | None" = None) -> "pandas.DataFrame":
        """Returns one quantity of many trials as a frame of trial, time_s and the quantity.

        quantity  an array of the traces, or position_error_m, heading_error_rad, speed_m_s (Trace has them)
        trials    those that are driven again for it; None: all that left a trace with the run
        """
        pandas = need("pandas", "python3-pandas", "Run.traces")
        found: list[tuple[int, Any, Any]] = []
        if trials is None:
            if not self.stored_traces:
                raise InputError([Problem(str(self.folder), "has no traces", 'name trials, or run it with traces=["all"]')])
            for file in self.stored_traces:
                found.append((int(file.stem.split("-")[1]), *quantity_of(file, quantity)))
        else:
            def driven(trial: int) -> tuple[int, Any, Any]:
                trace = self.trial(trial)._traced()  # not its property, of which all trials have one lock
                return trial, trace["time_s"], trace[quantity]

            pool = ThreadPoolExecutor(os.cpu_count())
            try:
                found.extend(pool.map(driven, trials))
            finally:
                pool.shutdown(cancel_futures=True)
        if any(np.ndim(values) != 1 or len(values) != len(times) for _, times, values in found):
            raise InputError([Problem(quantity, "is not one number a moment", "take it from Trial.trace")])
        lengths = [len(times) for _, times, _ in found]
        return pandas.DataFrame({
            "trial": np.repeat([trial for trial, _, _ in found], lengths),
            "time_s": np.concatenate([times for _, times, _ in found] or [np.empty(0)]),
            quantity: np.concatenate([values for _, _, values in found] or [np.empty(0)])})

    def report(self, page: "str | PathLike[str] | None" = None, replays: int = 5, tracks: int = 100) -> Path:
        """Writes the page of the run for a browser, report.html in its folder unless `page` says where."""
        return report([self], page, replays, tracks)

    def __repr__(self) -> str:
        told = f"{len(self)} trials" + (f", cell {self.cell}" if self.cell else "")
        try:
            return f"<Run {self.name}, seed {self.seed}: {told}, true success {self.true_success}>"
        except (OSError, InputError, StopIteration):
            return f"<Run {self.name}, seed {self.seed}: {told}>"


class Trial:
    """One trial of a run. What was not stored is driven again, bit for bit."""

    def __init__(self, run: Run, index: int) -> None:
        self.run, self.index = run, whole("trial", index)

    @property
    def record(self) -> dict[str, Any]:
        """Its record: trial, outcome by its name, detail (how it ended, in words), and every column."""
        rows = self.run.records
        at = int(np.searchsorted(rows["trial"], self.index))
        if at == len(rows) or rows["trial"][at] != self.index:
            raise self._missing()
        trial, outcome, *values = rows[at].tolist()
        return {"trial": trial, "outcome": _records.OUTCOMES[outcome], "detail": self.run._read.detail(at),
                **dict(zip((rows.dtype.names or ())[2:], values))}

    @property
    def outcome(self) -> str:
        """How it ended: one of rockyard.OUTCOMES."""
        return str(self.record["outcome"])

    @property
    def detail(self) -> str:
        """How it ended, in a sentence; of a fault also why."""
        return str(self.record["detail"])

    def _missing(self) -> InputError:
        return InputError([Problem(f"trial {self.index}", f"is not stored in {self.run.folder}", "name a finished trial")])

    @functools.cached_property
    def trace(self) -> Trace:
        """Its course: arrays over time. Driven again where no trace is stored (the cost of the trial).

        Raises InputError where the drive does not repeat the stored record.
        """
        return self._traced()

    def _traced(self) -> Trace:
        for file in self.run.stored_traces:
            if file.stem == f"trial-{self.index:06}":
                return Trace(file)
        return Trace(io.BytesIO(self._driven("npz")))

    def _driven(self, form: str) -> bytes:
        made = Scenario(None, deciders=self.run._deciders)
        with self.run._knowing():
            data, repeats, differences = _core.trace(str(self.run.folder), self.run.cell, made._core, self.index, form)
        if repeats is False:
            raise InputError([Problem(f"trial {self.index}", each, "use the program that made the run")
                              for each in differences])
        return bytes(data)

    @property
    def events(self) -> "pandas.DataFrame":
        """What happened: time_s, true x_m, y_m, heading_rad, kind, detail."""
        return self.trace.events

    @functools.cached_property
    def place(self) -> "Place":
        """Its terrain."""
        from .places import Place

        return Place(self.run.scenario, self.index)

    def images(self, time_s: "float | None" = None, behind: bool = False) -> "Images":
        """What the stereo cameras see from where the rover is at a time; None: at the start."""
        from .places import images

        pose = None if time_s is None else self.trace.pose_at(time_s)
        return images(self.run.scenario, self.index, pose, behind)

    def replay(self, page: "str | PathLike[str]" = "", plan: "str | PathLike[str]" = "") -> Path:
        """Writes the 3-D replay, a page for a browser; returns its path."""
        from .campaigns import told

        target = Path(page) if page else self.run.folder / f"trial-{self.index}.html"
        told(_core.replay(str(self.run.folder), self.run.cell, self.index, str(target), str(plan)))
        return target

    def tum(self, path: "str | PathLike[str]", believed: bool = False) -> None:
        """Writes its trajectory in the TUM format that evo reads; x, y and heading where it is believed."""
        self.trace.tum(path, believed)

    def mcap(self, path: "str | PathLike[str]") -> None:
        """Writes its course as MCAP with standard messages (poses, points, images, tf) for Foxglove and its like."""
        with Path(path).open("xb") as file:
            file.write(self._driven("mcap"))

    def __repr__(self) -> str:
        try:
            told = self.outcome
        except InputError:
            told = "not stored"
        return f"<Trial {self.index} of {self.run.folder}: {told}>"


class Sweep:
    """The folder of a campaign of cells. sweep["name of a cell"] or sweep[3] is the Run of a cell."""

    def __init__(self, folder: "str | PathLike[str]", deciders: "tuple[Decider, ...]" = (),
                 _head: "dict[str, Any] | None" = None) -> None:
        self.folder = Path(folder)
        self._deciders = deciders
        head = _head or _core.head(str(self.folder), "")
        if not head["is_sweep"]:
            raise InputError([Problem(str(folder), "is the folder of a run", "use load(folder) or Run(folder)")])
        self.names: list[str] = head["cells"]

    @functools.cached_property
    def summary(self) -> dict[str, Any]:
        """summary.json."""
        return dict(json.loads((self.folder / "summary.json").read_text(encoding="utf-8")))

    @property
    def name(self) -> str:
        """That of the design."""
        return str(self.summary["name"])

    @property
    def axes(self) -> list[str]:
        """The names of what is varied."""
        return [axis["name"] for axis in self.summary["axes"]]

    @functools.cached_property
    def cells(self) -> "pandas.DataFrame":
        """A row a cell: its levels along the axes, trials, true_success and declared_success with _low and
        _high (95 %, of the cell alone), mean metrics, outcome counts."""
        pandas = need("pandas", "python3-pandas", "Sweep.cells")
        rows = []
        for cell in self.summary["cells"]:
            row: dict[str, Any] = {"cell": cell["name"], **cell["levels"], "trials": cell["trials"]["completed"]}
            for kind in ("true_success", "declared_success"):
                if kind in cell:
                    made = rate_from(cell[kind])
                    row.update({kind: made.rate, f"{kind}_low": made.low, f"{kind}_high": made.high})
            row.update(cell.get("outcomes", {}))
            row.update({name: metric["mean"] for name, metric in cell.get("metrics", {}).items() if name not in row})
            rows.append(row)
        frame = pandas.DataFrame(rows)
        frame.attrs["units"] = {axis["name"]: axis.get("unit", "") for axis in self.summary["axes"]}
        return frame

    @functools.cached_property
    def trials(self) -> "pandas.DataFrame":
        """All trials of all cells, tidy: the levels along the axes, then the columns of Run.trials."""
        pandas = need("pandas", "python3-pandas", "Sweep.trials")
        columns, cells = _core.read_campaign(str(self.folder))
        names = [name for name, _, _ in columns]
        frames = []
        for cell, (trials, outcomes, values) in zip(self.summary["cells"], cells):
            frame = pandas.DataFrame({"cell": cell["name"], **cell["levels"], "trial": trials.astype("int64")})
            frame["outcome"] = pandas.Categorical.from_codes(outcomes, list(_records.OUTCOMES))
            frames.append(pandas.concat([frame, pandas.DataFrame(values, columns=names)], axis=1))
        return pandas.concat(frames, ignore_index=True)

    def __getitem__(self, cell: "str | int") -> Run:
        return Run(self.folder, self.names[cell] if isinstance(cell, int) else cell, self._deciders)

    def __iter__(self) -> "Iterator[Run]":
        return (self[name] for name in self.names)

    def __len__(self) -> int:
        return len(self.names)

    def report(self, page: "str | PathLike[str] | None" = None, replays: int = 5) -> Path:
        """Writes the page of the sweep for a browser, report.html in its folder unless `page` says where."""
        return report([self], page, replays)

    def __repr__(self) -> str:
        return f"<Sweep {self.folder}: {len(self)} cells along {', '.join(self.axes)}>"


def report(runs: "Iterable[Run | Sweep]", page: "str | PathLike[str] | None" = None, replays: int = 5,
           tracks: int = 100, title: str = "") -> Path:
    """Writes a page for a browser; several runs are compared with the first. Returns its path."""
    from .campaigns import told

    listed = list(runs)
    if not listed:
        raise InputError([Problem("runs", "are none", "name at least one")])
    cells = {run.cell for run in listed if isinstance(run, Run)}
    target = Path(page) if page is not None else listed[0].folder / "report.html"
    told(_core.report([str(run.folder) for run in listed], cells.pop() if len(cells) == 1 else "",
                      str(target), title, replays, tracks))
    return target
