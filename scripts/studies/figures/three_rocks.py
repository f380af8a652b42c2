"""Accepted runs of the experiment three_rock_run, and how the published history lies among them.

    scripts/studies/figures/three_rocks.py RUN

Prints percentiles of the published numbers among the accepted runs, and the joint distance of the
whole history.
"""

import sys
from pathlib import Path

import numpy as np

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402
from study import rates  # noqa: E402

# Matthies 1995, section 5: column, what is published. The errors along the way are signed so that
# the turn at rock A, which the gyro underestimates, leaves a negative one.
PUBLISHED = {"after_a_deg": -5.0, "after_b_deg": 10.0, "at_c_deg": 10.0, "after_c_deg": 15.0,
             "heading_error_deg": 15.3, "position_error_m": 1.0}
HISTORY = ("after_a_deg", "after_b_deg", "at_c_deg", "after_c_deg")


def accepted(run):
    """The records of the accepted runs as a frame."""
    rows = study.counted(run)
    return rows[rows.accepted == 1]


def share_below(values, published):
    """Of the values, those that tie counted half."""
    return np.mean(0.5 * (values == published) + (values < published))


def joint_p(points, published):
    """How far the published point lies from a sample, against how far its own points lie.

    Coordinates over their standard deviations in the sample; the distance of a point is its mean
    Euclidean distance to the others. The p-value (1 + points at least as far) / (1 + points) is
    exact where the published point is one more of the sample.
    """
    everything = np.array([*points, published])
    scaled = everything / np.where((spread := everything.std(axis=0, ddof=1)) > 0.0, spread, 1.0)
    distances = np.linalg.norm(scaled[:, None] - scaled, axis=2).sum(axis=1)
    return np.mean(distances >= distances[-1])


def effective_size(weights):
    """Kish: the number of equal weights that would scatter as much."""
    return weights.sum() ** 2 / (weights ** 2).sum()


def weights_of(rows):
    """Of each its chance to be accepted: one over its tries of B and of C."""
    return 1.0 / (rows.b_tries * rows.c_tries)


def report(rows):
    lines = [f"{len(rows)} accepted runs"]
    for column, published in PUBLISHED.items():
        middle, low, high = (rates.quantile(rows[column], share) for share in (0.5, 0.025, 0.975))
        lines.append(f"{column}: published {published}, ensemble median {middle:.2f}, 95 % {low:.2f} .. {high:.2f}, share below "
                     f"{share_below(rows[column], published):.3f}, weighted by tries "
                     f"{np.average(rows[column] < published, weights=weights_of(rows)):.3f}")
    points = rows[list(HISTORY)].to_numpy()
    lines.append(f"joint p of the history: {joint_p(points, [PUBLISHED[c] for c in HISTORY]):.3f}")
    lines.append(f"effective size under these weights: {effective_size(weights_of(rows)):.1f}")
    return lines


def main(arguments):
    if len(arguments) != 1:
        print(__doc__, file=sys.stderr)
        return 2
    rows = accepted(study.ry.Run(arguments[0]))
    if len(rows) < 2:
        print(f"error: {arguments[0]}: fewer than two accepted runs; run more", file=sys.stderr)
        return 2
    print("\n".join(report(rows)))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
