"""Curves over the orientation of the coloured cylinder, one for each distance: figures 9 to 12 of Matthies 1995."""

import math

from . import Drawn, Figure, FigureError, style

LOOKS = ((style.BLUE, "-", "o"), (style.GREEN, "--", "s"), (style.VERMILION, "-.", "^"), (style.PURPLE, ":", "D"))
NEEDS = "a run of scenarios/cylinder/published.json"
FARTHEST_M = 14.0  # the published figures have four distances, up to 10.058 m


def mean_and_spread(row, name, suffix):
    """Of the measurements of a view that were found; None where there are too few."""
    found = row["published_found"]
    if found < 1:
        return None
    mean = row[f"published_{name}_bias{suffix}"] / found
    square = row[f"published_{name}_error{suffix}"] / found - mean * mean
    spread = math.sqrt(max(square, 0.0) * found / (found - 1)) if found > 1 else None
    return mean, spread


def curves(source, name, suffix, which):
    """{distance: [(orientation, value)]}, orientations from -180 on."""
    source.require_experiment("cylinder_sighting", "scenarios/cylinder/published.json")
    rows = source.trials()
    if "orientation_deg" not in rows:
        raise FigureError(f"{source.path}: has no orientations; take {NEEDS}")
    found = {}
    for row in rows.to_dict("records"):
        distance, orientation = row["distance_m"], row["orientation_deg"]
        values = mean_and_spread(row, name, suffix)
        value = None if values is None else values[which]
        if value is not None and distance < FARTHEST_M:
            found.setdefault(distance, []).append((-180.0 if orientation == 180.0 else orientation, value))
    return {distance: sorted(points) for distance, points in sorted(found.items())}


def draw_curves(sources, name, suffix, which, label, what):
    source = sources[0]
    drawn = curves(source, name, suffix, which)
    figure, axes = style.new_figure(5.6, 3.6)
    for (colour, dashes, mark), (distance, points) in zip(LOOKS, drawn.items()):
        axes.plot([x for x, _ in points], [y for _, y in points], color=colour, linestyle=dashes, marker=mark,
                  markersize=2.5, linewidth=0.9, label=f"{distance:g} m")
    axes.set(xlabel="orientation of the cylinder (deg)", ylabel=label, xlim=(-185, 185), xticks=range(-180, 181, 45))
    axes.legend(fontsize=8, ncols=4, loc="best")
    study = source.scenario["cylinder_sighting"]
    caption = (f"{what} of the published finder against the orientation of the coloured cylinder, in the manner of "
               f"Matthies 1995: {study['measurements_per_view']} pairs of rendered images at each orientation "
               f"({source.name}, seed {source.seed}); orientations without a result have no point. The points of the "
               "paper's own figure are not available, so none are drawn.")
    return Drawn(figure, caption, {f"{distance:g} m": points for distance, points in drawn.items()})


# Number of the figure, its title, column, its suffix, mean or deviation, label, what is drawn.
CURVES = (
    (9, "mean angular error of the coloured cylinder", "orientation", "_deg", 0, "mean error (deg)", "Mean angular error"),
    (10, "mean relative error of its distance by stereo", "stereo", "", 0, "mean error / distance",
     "Mean relative error of the distance by stereo"),
    (11, "standard deviation of its angle", "orientation", "_deg", 1, "standard deviation (deg)",
     "Standard deviation of the measured angle"),
    (12, "standard deviation of its distance by stereo", "stereo", "", 1, "standard deviation / distance",
     "Standard deviation of the normalized distance by stereo"),
)
FIGURES = tuple(Figure(name=f"matthies1995-{number}", title=title, runs=NEEDS, accepts=(1, 1),
                       draw=lambda sources, _, drawn=drawn: draw_curves(sources, *drawn)) for number, title, *drawn in CURVES)
