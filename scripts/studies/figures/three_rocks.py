"""Accepted runs of the experiment three_rock_run, and how the published history lies among them.

    scripts/studies/figures/three_rocks.py RUN

Prints percentiles of the published numbers among the accepted runs, and the joint distance of the
whole history. Needs nothing but Python.
"""

import math
import sys
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402

# Matthies 1995, section 5: column, what is published. The errors along the way are signed so that
# the turn at rock A, which the gyro underestimates, leaves a negative one.
PUBLISHED = {"after_a_deg": -5.0, "after_b_deg": 10.0, "at_c_deg": 10.0, "after_c_deg": 15.0,
             "heading_error_deg": 15.3, "position_error_m": 1.0}
HISTORY = ("after_a_deg", "after_b_deg", "at_c_deg", "after_c_deg")


def accepted(folder):
    """Rows of the accepted runs of a run folder, numbers where they are some."""
    rows = [row for row in study.read_csv(Path(folder) / "trials.csv") if row.get("accepted") == "1"]
    return [{key: _number(value) for key, value in row.items()} for row in rows]


def _number(text):
    try:
        return float(text)
    except (TypeError, ValueError):
        return text


def share_below(values, published):
    """Of the values, those that tie counted half."""
    return sum(0.5 * (value == published) + (value < published) for value in values) / len(values)


def joint_p(points, published):
    """How far the published point lies from a sample, against how far its own points lie.

    Coordinates over their standard deviations in the sample; the distance of a point is its mean
    Euclidean distance to the others. The p-value (1 + points at least as far) / (1 + points) is
    exact where the published point is one more of the sample.
    """
    everything = [*points, published]
    deviations = [_deviation(column) for column in zip(*everything)]
    scaled = [[x / deviation for x, deviation in zip(point, deviations)] for point in everything]
    distances = [sum(math.dist(point, other) for other in scaled) for point in scaled]
    return sum(distance >= distances[-1] for distance in distances) / len(distances)


def _deviation(values):
    mean = sum(values) / len(values)
    return math.sqrt(sum((value - mean) ** 2 for value in values) / (len(values) - 1)) or 1.0


def effective_size(weights):
    """Kish: the number of equal weights that would scatter as much."""
    return sum(weights) ** 2 / sum(weight * weight for weight in weights)


def weighted_share(rows, column, published):
    """Share of rows below, each by its chance to be accepted: one over its tries of B and of C."""
    weights = [1.0 / (row["b_tries"] * row["c_tries"]) for row in rows]
    below = sum(weight for weight, row in zip(weights, rows) if row[column] < published)
    return below / sum(weights)


def report(rows):
    lines = [f"{len(rows)} accepted runs"]
    for column, published in PUBLISHED.items():
        values = [row[column] for row in rows]
        lines.append(f"{column}: published {published}, ensemble median {study.quantile(values, 0.5):.2f}, "
                     f"95 % {study.quantile(values, 0.025):.2f} .. {study.quantile(values, 0.975):.2f}, share below "
                     f"{share_below(values, published):.3f}, weighted by tries "
                     f"{weighted_share(rows, column, published):.3f}")
    points = [[row[column] for column in HISTORY] for row in rows]
    lines.append(f"joint p of the history: {joint_p(points, [PUBLISHED[c] for c in HISTORY]):.3f}")
    weights = [1.0 / (row["b_tries"] * row["c_tries"]) for row in rows]
    lines.append(f"effective size under these weights: {effective_size(weights):.1f}")
    return lines


def main(arguments):
    if len(arguments) != 1:
        print(__doc__, file=sys.stderr)
        return 2
    rows = accepted(arguments[0])
    if len(rows) < 2:
        print(f"error: {arguments[0]}: fewer than two accepted runs; run more", file=sys.stderr)
        return 2
    print("\n".join(report(rows)))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
