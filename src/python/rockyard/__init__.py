"""rockyard: Monte Carlo performance evaluation of planetary rovers.

    import rockyard as ry
    run = ry.run("nominal", trials=300, seed=7, set={"rover.fidelity": "quasi_static"})
    run.true_success                       # Rate(186/300, 0.62, 0.56 .. 0.67)
    run.trials                             # a pandas frame, a row a trial
    run.trial(17).trace.position_error_m   # over the moments of trial 17
    ry.plot.map(run.trial(17))

SI units and radians throughout, but for values of scenarios, whose paths end in their units. pandas is
needed for frames and matplotlib for figures only.
"""

from importlib import import_module as _import
from typing import TYPE_CHECKING as _TYPE_CHECKING

from . import _core
from .campaigns import Check, Comparison, check, compare, load, merge, run, sweep, write_baseline
from .environment import Environment, Environments
from .errors import InputError, MachineError, MissingPart, Problem, TooManyFaults, UnknownName, WorkError
from .estimator import Estimator, estimate
from .inprocess import as_process
from .navigator import Navigator, parameter
from .places import Images, Place, images
from .rates import Rate, rate
from .records import OUTCOMES
from .runs import Run, Sweep, Trial, report
from .scenario import Scenario, scenarios, sweeps
from .slopes import Mobility, mobility
from .traces import Trace
from .wheels import Wheel

if _TYPE_CHECKING:
    from . import plot as plot

__version__: str = _core.version
__all__ = [
    "Check", "Comparison", "Environment", "Environments", "Estimator", "Images", "InputError", "MachineError",
    "MissingPart", "Mobility", "Navigator", "OUTCOMES", "Place", "Problem", "Rate", "Run", "Scenario", "Sweep",
    "TooManyFaults", "Trace", "Trial", "UnknownName", "Wheel", "WorkError", "as_process", "check", "compare", "estimate",
    "images", "load", "merge", "mobility", "parameter", "plot", "rate", "report", "run", "scenarios", "sweep", "sweeps",
    "write_baseline"]


def __getattr__(name: str) -> object:
    if name == "plot":  # matplotlib is asked for when a figure is
        return _import(".plot", __name__)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> "list[str]":
    return sorted({*__all__, *(name for name in globals() if not name.startswith("_"))})
