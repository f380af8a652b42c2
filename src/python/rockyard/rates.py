"""Rates with intervals, and exact tests. The numbers are those of the command's reports."""

from __future__ import annotations

import math
from dataclasses import dataclass
from statistics import NormalDist
from typing import TYPE_CHECKING, Any, Iterable, Iterator, Mapping

import numpy as np

from . import _core

if TYPE_CHECKING:
    Interval = tuple[float, float]
    Estimate = tuple[float, float, float]  # value, low, high


Z95 = 1.959963984540054  # two-sided 95 % of a normal law, correctly rounded


@dataclass(frozen=True)
class Rate:
    """`count` of `trials`, with an interval of confidence 0.95 unless it was made with another one.

    No trials: the rate is NaN and the interval [0, 1]. `method`: wilson, clopper_pearson (also where
    fewer than five trials are of either kind), clopper_pearson_stopped, clustered.
    """

    count: int
    trials: int
    rate: float
    low: float
    high: float
    method: str

    def __repr__(self) -> str:
        return f"Rate({self.count}/{self.trials}, {self.rate:.2f}, {self.low:.2f} .. {self.high:.2f})"

    def __iter__(self) -> Iterator[float]:
        """rate, low, high"""
        return iter((self.rate, self.low, self.high))

    def __float__(self) -> float:
        return self.rate


def rate(count: int, trials: int, confidence: float = 0.95, method: str = "wilson") -> Rate:
    """Returns the rate of `count` among independent `trials` with its two-sided interval.

    Wilson 1927, or Clopper and Pearson 1934 (`method="clopper_pearson"`, and wherever fewer than five
    trials are of either kind). Raises InputError where 0 <= count <= trials does not hold.
    """
    return Rate(count, trials, *_core.proportion(count, trials, confidence, method))


def rate_from(told: Mapping[str, Any]) -> Rate:
    """Returns a rate as summary.json has it; its interval knows of trials that share rocks."""
    low, high = told["ci95"]
    value = float("nan") if told["rate"] is None else told["rate"]
    return Rate(told["count"], told["trials"], value, low, high, told.get("ci_method", "wilson"))


def wilson_interval(count: int, trials: int, confidence: float = 0.95) -> Interval:
    """Returns Wilson's interval of a share (1927), whatever the counts; `rate` takes another one of rare events."""
    return _core.wilson_interval(int(count), int(trials), confidence)


def exact_interval(count: float, trials: float, confidence: float = 0.95) -> Interval:
    """Returns Clopper and Pearson's interval of a share (1934). Counts need not be whole."""
    return _core.exact_interval(count, trials, confidence)


def difference(first: Rate, second: Rate, confidence: float = 0.95) -> tuple[float, float]:
    """Returns the interval of second less first, two independent rates (Newcombe 1998, method 10)."""
    return _core.difference(first.count, first.trials, second.count, second.trials, confidence)


def paired_difference(both: int, only_first: int, only_second: int, neither: int, confidence: float = 0.95,
                      method: str = "agresti_min") -> tuple[float, float]:
    """Returns the interval of second less first over pairs of trials (Agresti and Min 2005; `method="tango"`:
    the score interval of Tango 1998, which two one-sided tests of equivalence go by)."""
    return _core.paired_difference(both, only_first, only_second, neither, confidence, method)


def fisher(first: Rate, second: Rate) -> float:
    """Returns the two-sided p-value of Fisher's exact test of two independent rates."""
    return _core.fisher(first.count, first.trials, second.count, second.trials)


def mcnemar(only_first: int, only_second: int) -> float:
    """Returns the two-sided p-value of McNemar's exact test, by the pairs in which one succeeded alone."""
    return _core.mcnemar(only_first, only_second)


def poisson_interval(count: int, confidence: float = 0.95) -> tuple[float, float]:
    """Returns the exact interval of the mean of a Poisson number of which `count` was seen (Garwood 1936)."""
    return _core.poisson(count, confidence)


def trials_for(half_width: float, rate: float = 0.5, confidence: float = 0.95) -> int:
    """Returns how many trials give an interval of that half-width around `rate` (Wilson)."""
    return _core.trials_for_half_width(rate, half_width, confidence)


def holm(p_values: Iterable[float]) -> list[float]:
    """Returns p-values adjusted for all of them together (Holm 1979), in the order given."""
    return _core.holm(list(p_values))


def quantile(values: Iterable[float], share: float) -> float:
    """Returns the quantile of the finite values by straight lines between order statistics (type 7); NaN of none."""
    return _core.quantile(list(values), share)


def median_interval(values: Iterable[float], confidence: float = 0.95) -> Interval:
    """Returns two order statistics that hold the median of any law (Thompson 1936); NaN where too few are there."""
    return _core.median_interval(list(values), confidence)


def student_tail(t: float, freedom: float) -> float:
    """Returns P(T > t) of Student's T for t >= 0."""
    return _core.student_tail(t, freedom)


def _half_width(residuals: list[float], confidence: float, law: str) -> float:
    """Returns the half-width of the interval of the mean of residuals, whose mean is 0; NaN below two values."""
    n = len(residuals)
    if n < 2:
        return math.nan
    if law == "student":
        low, high = _core.student_interval(residuals, confidence)
        return 0.5 * (high - low)
    z = Z95 if confidence == 0.95 else NormalDist().inv_cdf(0.5 + 0.5 * confidence)
    return z * math.sqrt(sum(value ** 2 for value in residuals) / (n - 1) / n)


def mean(values: Iterable[float], confidence: float = 0.95, law: str = "normal", least: float = -math.inf) -> Estimate:
    """Returns the mean of independent values with its interval, by the normal or Student's (`law="student"`) law.

    Limits: some dozens of values without a heavy tail; the metrics of summary.json have better ones. NaN where fewer
    than two values are. `least`: what no value is below, nor the interval.
    """
    listed = np.asarray(list(values), float).tolist()
    middle = sum(listed) / len(listed) if listed else math.nan
    half = _half_width([value - middle for value in listed], confidence, law)
    return middle, max(middle - half, least), middle + half


def ratio_of_sums(parts: Iterable[float], wholes: Iterable[float], confidence: float = 0.95, law: str = "normal") -> Estimate:
    """Returns sum(parts) / sum(wholes) over independent trials with its interval, linearized: events a metre."""
    x, y = (np.asarray(list(values), float).tolist() for values in (parts, wholes))
    whole = sum(y)
    value = sum(x) / whole
    half = _half_width([part - value * each for part, each in zip(x, y)], confidence, law) * len(x) / whole
    return value, value - half, value + half


def share(parts: Iterable[float], wholes: Iterable[float], confidence: float = 0.95) -> Estimate:
    """Returns sum(parts) / sum(wholes) over independent trials, parts no larger than wholes, with its interval.

    What happens within one trial hangs together: it is the exact interval of both sums divided by the design effect
    (Korn and Graubard 1998), the variance by trials over the binomial one, at least 1. From few events that is
    uncertain, from none it cannot be seen and is 1. NaN where the wholes are 0.
    """
    x, y = (np.asarray(list(values), float).tolist() for values in (parts, wholes))
    n, whole = len(y), sum(y)
    if whole == 0.0:
        return math.nan, math.nan, math.nan
    value = sum(x) / whole
    binomial = whole * value * (1.0 - value)
    square = sum((part - value * each) ** 2 for part, each in zip(x, y)) * n / max(1, n - 1)
    effect = max(1.0, square / binomial) if binomial > 0.0 else 1.0
    return (value, *exact_interval(sum(x) / effect, whole / effect, confidence))
