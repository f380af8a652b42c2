"""What a figure reads: a run folder, and what the rockyard command says of it."""

import csv
import json
import shutil
import subprocess
import tempfile
import weakref
from functools import cached_property
from pathlib import Path

from . import FigureError


def read_csv(path):
    """Rows of a CSV file as dictionaries of text."""
    try:
        with open(path, encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))
    except OSError as error:
        raise FigureError(f"{path}: cannot be read ({error.strerror}); was the run finished?") from None


def numbers(rows, column, path=""):
    """One column as numbers; empty fields are left out."""
    if rows and column not in rows[0]:
        raise FigureError(f"{path}: has no column {column}; is the run one of drives?")
    try:
        return [float(row[column]) for row in rows if row[column] not in ("", None)]
    except ValueError as error:
        raise FigureError(f"{path}: {column}: {error}") from None


class Source:
    """A run folder (or, for figures of terrain alone, a scenario file)."""

    def __init__(self, path, rockyard):
        self.path = Path(path)
        self._rockyard = Path(rockyard)
        self._scratch = Path(tempfile.mkdtemp(prefix="rockyard-figure-"))
        weakref.finalize(self, shutil.rmtree, self._scratch, ignore_errors=True)
        if not self.path.exists():
            raise FigureError(f"{path}: does not exist; make it with: rockyard run SCENARIO --out {path}")

    @property
    def is_run(self):
        return self.path.is_dir()

    def require_run(self, what="a run folder"):
        """One of a single scenario: a sweep folder has many of everything."""
        if not self.is_run:
            raise FigureError(f"{self.path}: is a file, and this figure needs {what}")
        if "scenario" not in self.summary:
            raise FigureError(f"{self.path}: holds no run of one scenario (a sweep or a shard?); "
                              "run one of its cells by itself")

    def require_drives(self):
        self.require_run("the folder of a run of drives")
        if "outcomes" not in self.summary:
            raise FigureError(f"{self.path}: is no run of drives, which this figure shows")

    def _json(self, name):
        path = self.path / name
        try:
            return json.loads(path.read_text(encoding="utf-8"))
        except OSError as error:
            raise FigureError(f"{path}: cannot be read ({error.strerror}); name the folder of a "
                              "finished run") from None
        except ValueError as error:
            raise FigureError(f"{path}: is no JSON ({error})") from None

    @cached_property
    def summary(self):
        return self._json("summary.json")

    @cached_property
    def scenario(self):
        """Every setting of the run."""
        document = self._json("scenario.resolved.json")
        if not isinstance(document, dict) or "scenario" not in document:
            raise FigureError(f"{self.path / 'scenario.resolved.json'}: holds no scenario")
        return document["scenario"]

    @property
    def name(self):
        return self.scenario["name"] if self.is_run else self.path.stem

    @property
    def seed(self):
        return self.scenario["seed"] if self.is_run else None

    def drives(self):
        """Rows of trials.csv without simulator faults."""
        self.require_drives()
        return [row for row in read_csv(self.path / "trials.csv")
                if row.get("outcome") != "simulator_fault"]

    def distance_cdf(self):
        self.require_drives()
        return read_csv(self.path / "distance_cdf.csv")

    def terrain(self, trial):
        """The rocks of a trial, as `rockyard terrain` tells them."""
        path = self._scratch / f"terrain-{trial}.json"
        source = self.path
        if self.is_run:
            source = self._scratch / "scenario.json"
            source.write_text(json.dumps(self.scenario), encoding="utf-8")
        self._call("terrain", source, "--trial", trial, "--out", path)
        return json.loads(path.read_text(encoding="utf-8"))

    def trace(self, trial):
        """Samples and events of a trial, run again: rows of `rockyard trace --csv`."""
        self.require_drives()
        path = self._scratch / f"trace-{trial}.csv"
        self._call("trace", self.path, "--trial", trial, "--csv", path)
        return read_csv(path)

    def trace_of(self, scenario, trial):
        """The same of a trial of any scenario, given as a document."""
        source = self._scratch / "traced.json"
        source.write_text(json.dumps(scenario), encoding="utf-8")
        path = self._scratch / f"traced-{trial}.csv"
        self._call("trace", source, "--trial", trial, "--csv", path)
        return read_csv(path)

    def moments(self, trial):
        """Every moment of a trial, run again: the arrays of `rockyard trace --npz` (src/replay/README.md)
        by name, of a run folder or of a scenario with its seed; `meta` as a document."""
        import numpy  # pylint: disable=import-outside-toplevel  # comes with matplotlib
        path = self._scratch / f"trace-{trial}.npz"
        self._call("trace", self.path, "--trial", trial, "--npz", path)
        with numpy.load(path) as file:
            arrays = dict(file)
        return {**arrays, "meta": json.loads(str(arrays["meta"]))}

    def step(self, trial, step):
        """Folder with map.csv, votes.csv and points.csv of a decision of a map-based navigator."""
        self.require_drives()
        folder = self._scratch / f"step-{trial}-{step}"
        self._call("replay", self.path, "--trial", trial, "--step", step, "--out", folder)
        return folder

    def _call(self, *words):
        command = [str(word) for word in (self._rockyard, *words)]
        try:
            result = subprocess.run(command, capture_output=True, text=True, check=False)
        except OSError as error:
            raise FigureError(f"{self._rockyard}: {error.strerror}; build it with "
                              "scripts/quickstart.sh, or name it with --rockyard") from None
        if result.returncode != 0:
            raise FigureError(f"{' '.join(command[1:])}: exit code {result.returncode}\n"
                              f"{result.stderr.strip()}")
