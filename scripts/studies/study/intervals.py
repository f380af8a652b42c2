"""Intervals and tests of what trials say."""

import math

Z95 = 1.959963984540054  # two-sided 95 % of a normal distribution


def quantile(values, share):
    """By straight lines between order statistics."""
    ordered = sorted(values)
    at = share * (len(ordered) - 1)
    low = int(at)
    high = min(low + 1, len(ordered) - 1)
    return ordered[low] + (at - low) * (ordered[high] - ordered[low])


def mean_interval(values):
    """Mean and its 95 % interval by the normal approximation; not below zero where no value is."""
    n = len(values)
    mean = sum(values) / n
    variance = sum((value - mean) ** 2 for value in values) / (n - 1) if n > 1 else 0.0
    half = Z95 * math.sqrt(variance / n)
    return mean, max(mean - half, 0.0 if min(values) >= 0.0 else -math.inf), mean + half


def signed_mean_interval(values):
    """Mean of values of either sign and its 95 % interval by the normal approximation."""
    n = len(values)
    mean = sum(values) / n if n else math.nan
    variance = sum((value - mean) ** 2 for value in values) / (n - 1) if n > 1 else math.nan
    half = Z95 * math.sqrt(variance / n) if n > 1 else math.nan
    return mean, mean - half, mean + half


def _beta_fraction(a, b, x):
    """Continued fraction of the incomplete beta function by Lentz (Press et al. 2007, 6.4.5)."""
    tiny = 1e-300
    c, d = 1.0, 1.0 / ((1.0 - (a + b) * x / (a + 1.0)) or tiny)
    value = d
    for m in range(1, 10000):
        for term in (m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m)),
                     -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1))):
            d = 1.0 / ((1.0 + term * d) or tiny)
            c = (1.0 + term / c) or tiny
            value *= c * d
        if abs(c * d - 1.0) < 1e-14:
            break
    return value


def beta_cdf(a, b, x):
    """Regularized incomplete beta function I_x(a, b)."""
    if x <= 0.0 or x >= 1.0:
        return float(x >= 1.0)
    front = math.exp(math.lgamma(a + b) - math.lgamma(a) - math.lgamma(b) + a * math.log(x) +
                     b * math.log1p(-x))
    if x < (a + 1.0) / (a + b + 2.0):
        return front * _beta_fraction(a, b, x) / a
    return 1.0 - front * _beta_fraction(b, a, 1.0 - x) / b


def exact_interval(count, trials):
    """Clopper's and Pearson's 95 % interval (1934); counts need not be whole."""
    def quantile(a, b, probability):
        low, high = 0.0, 1.0
        for _ in range(60):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if beta_cdf(a, b, middle) < probability else (low, middle)
        return 0.5 * (low + high)
    return (quantile(count, trials - count + 1.0, 0.025) if count > 0 else 0.0,
            quantile(count + 1.0, trials - count, 0.975) if count < trials else 1.0)


def wilson_interval(count, trials):
    """Wilson's 95 % interval of a share (1927)."""
    share, square = count / trials, Z95 ** 2 / trials
    middle = share + 0.5 * square
    half = math.sqrt(square * (share * (1.0 - share) + 0.25 * square))
    # Exact at the ends, where rounding is not.
    low = (middle - half) / (1.0 + square) if count > 0 else 0.0
    high = (middle + half) / (1.0 + square) if count < trials else 1.0
    return low, high


def ratio_interval(parts, wholes):
    """sum(parts) / sum(wholes) over trials, parts no larger than wholes, with its 95 % interval.

    Trials are independent, what happens within one is not: the exact interval of both sums divided
    by the design effect (Korn and Graubard 1998), the variance by trials over the binomial one, at
    least 1. From few events it is uncertain, from none it cannot be seen and is 1.
    """
    n, whole = len(wholes), sum(wholes)
    if whole == 0:
        return math.nan, math.nan, math.nan
    ratio = sum(parts) / whole
    binomial = whole * ratio * (1.0 - ratio)
    square = sum((part - ratio * w) ** 2 for part, w in zip(parts, wholes)) * n / max(1, n - 1)
    effect = max(1.0, square / binomial) if binomial > 0 else 1.0
    return (ratio, *exact_interval(sum(parts) / effect, whole / effect))


def mcnemar(only_first, only_second):
    """Two-sided exact p-value of paired trials: those that only the first or the second won."""
    n, fewer = only_first + only_second, min(only_first, only_second)
    return min(1.0, 2.0 * sum(math.comb(n, k) for k in range(fewer + 1)) / 2 ** n)


def holm(p_values):
    """p-values adjusted for all of them together (Holm 1979)."""
    adjusted, largest = [1.0] * len(p_values), 0.0
    for rank, index in enumerate(sorted(range(len(p_values)), key=lambda i: p_values[i])):
        largest = max(largest, min(1.0, (len(p_values) - rank) * p_values[index]))
        adjusted[index] = largest
    return adjusted
