"""Matthies 1995, table 4: dead-reckoning errors, as distributions."""

from . import Drawn, Figure, FigureError, style

# Column, label, published minimum, mode and maximum of 40 runs (table 4).
ERRORS = (("distance_error_percent", "distance error (%)", (-3.0, 4.8, 9.0)),
          ("heading_error_deg", "heading error (deg)", (0.2, 8.0, 37.2)),
          ("position_error_m", "position error (m)", (0.22, 0.69, 2.45)))
BINS = 24


def draw(sources, _options):
    source = sources[0]
    rows = source.drives()
    if rows.empty:
        raise FigureError(f"{source.path}: has no finished trials")
    figure, panels = style.new_figure(8.6, 2.9, ncols=3)
    drawn = {}
    for axes, (column, label, published) in zip(panels, ERRORS):
        values = rows[column].dropna().tolist()
        drawn[column] = values
        _draw_error(axes, values, label, published)
    panels[0].set_ylabel("runs")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="upper center", ncols=2, fontsize=8)
    figure.set_layout_engine("constrained", rect=(0.0, 0.0, 1.0, 0.91))  # below the legend
    caption = (f"Dead-reckoning errors at the end of {len(rows)} runs of {source.name}, seed "
               f"{source.seed} (all ends, simulator faults left out, runs without a value too: each panel says "
               "how many it shows), with minimum, mode and maximum of "
               "the 40 runs of Matthies 1995, table 4 (marks above the bars). A maximum grows with the "
               "number of runs: compare by `rockyard check`, which draws samples of 40.")
    return Drawn(figure, caption, drawn)


def _draw_error(axes, values, label, published):
    axes.hist(values, bins=BINS, color=style.SKY, edgecolor=style.BLUE, linewidth=0.5, label="our runs")
    top = 1.12 * axes.get_ylim()[1]
    least, mode, most = published
    axes.errorbar([mode], [0.94 * top], xerr=[[mode - least], [most - mode]], fmt="D",
                  color=style.VERMILION, markersize=5, capsize=4, linewidth=1.2,
                  label="published: minimum, mode, maximum of 40 runs")
    axes.set(xlabel=f"{label}, {len(values)} runs", ylim=(0.0, top))
    axes.grid(axis="x", visible=False)


FIGURES = (Figure(name="matthies1995-table4", title="distributions of the dead-reckoning errors",
                   runs="a run of drives (nominal.json)", accepts=(1, 1), draw=draw),)
