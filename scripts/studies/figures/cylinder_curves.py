"""Curves over the orientation of the coloured cylinder, one for each distance: figures 9 to 12 of Matthies 1995."""

import math

from . import Drawn, FigureError, style
from .source import read_csv

LOOKS = ((style.BLUE, "-", "o"), (style.GREEN, "--", "s"), (style.VERMILION, "-.", "^"), (style.PURPLE, ":", "D"))
NEEDS = "a run of scenarios/cylinder/published.json"
FARTHEST_M = 14.0  # the published figures have four distances, up to 10.058 m


def mean_and_spread(row, name, suffix):
    """Of the measurements of a view that were found; None where there are too few."""
    found = float(row["published_found"])
    if found < 1:
        return None
    mean = float(row[f"published_{name}_bias{suffix}"]) / found
    square = float(row[f"published_{name}_error{suffix}"]) / found - mean * mean
    spread = math.sqrt(max(square, 0.0) * found / (found - 1)) if found > 1 else None
    return mean, spread


def curves(source, name, suffix, which):
    """{distance: [(orientation, value)]}, orientations from -180 on."""
    source.require_run()
    if source.scenario.get("experiment") != "cylinder_sighting":
        raise FigureError(f"{source.path}: is no run of the experiment cylinder_sighting; take {NEEDS}")
    found = {}
    for row in read_csv(source.path / "trials.csv"):
        if row["outcome"] == "simulator_fault":
            continue
        if "orientation_deg" not in row:
            raise FigureError(f"{source.path}: has no orientations; take {NEEDS}")
        distance, orientation = float(row["distance_m"]), float(row["orientation_deg"])
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
    axes.set(xlabel="orientation of the cylinder (deg)", ylabel=label, xlim=(-185, 185),
             xticks=range(-180, 181, 45))
    axes.legend(fontsize=8, ncols=4, loc="best")
    study = source.scenario["cylinder_sighting"]
    caption = (f"{what} of the published finder against the orientation of the coloured cylinder, in the manner of "
               f"Matthies 1995: {study['measurements_per_view']} pairs of rendered images at each orientation "
               f"({source.name}, seed {source.seed}); orientations without a result have no point. The points of the "
               "paper's own figure are not available, so none are drawn.")
    return Drawn(figure, caption, {f"{distance:g} m": points for distance, points in drawn.items()})
