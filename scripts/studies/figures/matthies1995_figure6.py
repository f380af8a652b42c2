"""Matthies 1995, figure 6: standard deviations of dead reckoning along a straight line."""

import numpy as np

from . import Drawn, Figure, FigureError, style

# Section 5: (distance in m, across in m, along in m), of simulated runs.
PANELS = ((0.70, "(a) Rocky 3.2 on sand, 0.70 deg²/m", ((10.0, 0.27, 0.20), (20.0, 0.76, 0.29))),
          (16.0, "(b) scaled to MFEX, 16 deg²/m", ((5.0, 0.45, 0.15), (10.0, 1.25, 0.24))))
CURVES = (("across", "mean_across_deviation_m", {"color": style.VERMILION, "marker": "o", "linestyle": "-"}),
          ("along", "mean_along_deviation_m", {"color": style.BLUE, "marker": "^", "linestyle": "--"}))
HEADING = "mean_heading_deviation_deg"
FURTHEST_M = 20.0  # what the text gives numbers for


def cells_of(source):
    source.require_experiment("dead_reckoning", "straight_sand.json")
    rows = source.table("cells.csv")
    return rows[(rows.scale_deviation == 0.0) & (rows.rest_s == 0.0) & (rows.distance_m <= FURTHEST_M)]


def draw(sources, _options):
    (source,) = sources
    cells = cells_of(source)
    figure, axes = style.new_figure(7.0, 3.9, ncols=2)
    drawn, walks = {}, 0
    for panel, (variance, title, published) in zip(axes, PANELS):
        rows = cells[np.isclose(cells.heading_variance_deg2_per_m, variance)].sort_values("distance_m", kind="stable")
        if rows.empty:
            raise FigureError(f"{source.path}: has no cell of {variance:g} deg2/m")
        walks = max(walks, int(rows.walks.iloc[0]))
        drawn[title] = _panel(panel, title, rows, published)
    return Drawn(figure, _caption(source, walks), drawn)


def _panel(panel, title, rows, published):
    x = rows.distance_m.tolist()
    series = {}
    for name, column, look in CURVES:
        series[name] = rows[column].tolist()
        panel.plot(x, series[name], label=f"{name} (m)", markersize=3.5, **look)
    for at, across, along in published:
        panel.plot((at, at), (across, along), "s", markerfacecolor="none", markeredgecolor=style.INK,
                   markersize=7, linestyle="none", label="published" if at == published[0][0] else None)
    panel.set(xlabel="distance (m)", ylabel="standard deviation of the position (m)", xlim=(0.0, None),
              ylim=(0.0, None))
    right = panel.twinx()
    series["heading"] = rows[HEADING].tolist()
    right.plot(x, series["heading"], color=style.GREEN, linestyle=":", label="heading (deg, right)")
    right.set(ylim=(0.0, None), ylabel="of the heading (deg)")
    right.grid(False)
    panel.set_title(title)
    lines = [*panel.get_legend_handles_labels()[0], *right.get_legend_handles_labels()[0]]
    panel.legend(handles=lines, loc="upper left", fontsize=7)
    series["distance_m"] = x
    return series


def _caption(source, walks):
    return ("Standard deviations of position and heading along a straight line, in the manner of Matthies "
            f"1995, figure 6: {source.name}, seed {source.seed}, {walks} walks a point through the dead "
            "reckoning that flies, in steps of 6.7 cm with 0.0039 m2/m. Lines join the points. Squares: the "
            "numbers that section 5 prints; the curves of its own figure are not in the text.")


FIGURES = (Figure(name="matthies1995-6", title="standard deviations of dead reckoning by distance",
                   runs="a run of straight_sand.json", accepts=(1, 1), draw=draw),)
