"""What a figure reads: a run folder by the package, and what the rockyard command says of it."""

import json
import shutil
import subprocess
import tempfile
import weakref
from functools import cached_property
from pathlib import Path

import pandas
from study import counted, ry

from . import FigureError


def read_table(path):
    """A CSV file as a frame, numbers with every digit."""
    try:
        return pandas.read_csv(path, float_precision="round_trip")
    except OSError as error:
        raise FigureError(f"{path}: cannot be read ({error.strerror}); was the run finished?") from None


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

    @cached_property
    def run(self):
        """One of a single scenario: a sweep folder has many of everything."""
        if not self.is_run:
            raise FigureError(f"{self.path}: is a file, and this figure needs a run folder")
        try:
            return ry.Run(self.path)
        except ry.InputError as error:
            raise FigureError(str(error)) from None

    def require_drives(self):
        if "true_success" not in self.summary:
            raise FigureError(f"{self.path}: is no run of drives, which this figure shows")

    def require_experiment(self, name, example):
        if self.scenario["experiment"] != name:
            raise FigureError(f"{self.path}: is no run of the experiment {name}; take one of {example}")

    @property
    def summary(self):
        try:
            return self.run.summary
        except (OSError, ValueError) as error:
            raise FigureError(f"{self.path}: its summary cannot be read ({error}); was the run finished?") from None

    @property
    def scenario(self):
        """Every setting of the run."""
        return self.run.scenario

    @property
    def name(self):
        return self.scenario["name"] if self.is_run else self.path.stem

    @property
    def seed(self):
        return self.scenario["seed"] if self.is_run else None

    def trials(self):
        """The records as a frame, without simulator faults."""
        return counted(self.run)

    def drives(self):
        self.require_drives()
        return self.trials()

    def table(self, name):
        return read_table(self.path / name)

    def _written(self, name, document):
        path = self._scratch / name
        path.write_text(document, encoding="utf-8")
        return path

    def terrain(self, trial):
        """The rocks of a trial, as `rockyard terrain` tells them."""
        path = self._scratch / f"terrain-{trial}.json"
        source = self._written("scenario.json", self.scenario.resolved()) if self.is_run else self.path
        self._call("terrain", source, "--trial", trial, "--out", path)
        return json.loads(path.read_text(encoding="utf-8"))

    def trace(self, trial, scenario=None):
        """Every moment of a trial, run again, of the run, of the file or of another scenario (a document). A file is
        driven by the command, so that the runner of studies notes it."""
        path = self._scratch / f"trace-{trial}.npz"
        path.unlink(missing_ok=True)
        self._call("trace", self.path if scenario is None else self._written("traced.json", json.dumps(scenario)),
                   "--trial", trial, "--npz", path)
        trace = ry.Trace(path)
        if len(trace["time_s"]) < 2:
            raise FigureError(f"{self.path}: trial {trial} ended before it began (a simulator fault?); "
                              "take another one with --trial")
        return trace

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
            raise FigureError(f"{' '.join(command[1:])}: exit code {result.returncode}\n" f"{result.stderr.strip()}")
