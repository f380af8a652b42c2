"""Goldberg 2002, figure 3, part 4: how GESTALT ranks headings, beside what it saw."""

import math

import numpy as np

from . import Drawn, Figure, FigureError, style
from .source import read_table

ROWS = ("waypoint", "hazard", "merged")  # from the top, as in the paper
GROUPS = ("backward", "forward")
ARC_M = 1.5      # length of the candidates that is drawn
CELL_M = 0.1     # over which measured elevations are averaged
SIGHT_M = 3.0    # how far they are drawn
BEST_VOTE = 255


def votes_of(folder):
    """{'forward': [...], 'backward': [...]}: rows of votes.csv as numbers, from left to right."""
    # The highest curvature turns furthest left, which is left on the page too.
    rows = read_table(folder / "votes.csv").sort_values("curvature_per_m", ascending=False, kind="stable")
    votes = {group: rows[rows.kind == group].to_dict("records") for group in GROUPS}
    if not votes["forward"]:
        raise FigureError("this decision has no votes for arcs")
    return votes


def elevations_of(folder):
    """{(column, row): mean elevation} of the measured points within sight, in the rover's frame."""
    points = read_table(folder / "points.csv")
    near = points[(points.x_m.abs() <= SIGHT_M) & (points.y_m.abs() <= SIGHT_M)]
    return near.z_m.groupby([np.floor(near.x_m / CELL_M).astype(int), np.floor(near.y_m / CELL_M).astype(int)]).mean().to_dict()


def arc_points(curvature_per_m, direction, pieces=24):
    """(forward, left) of points along an arc that starts at the rover."""
    points = []
    for i in range(pieces + 1):
        s = direction * ARC_M * i / pieces
        half = 0.5 * curvature_per_m * s
        chord = s if half == 0.0 else s * math.sin(half) / half
        points.append((chord * math.cos(half), chord * math.sin(half)))
    return points


def draw(sources, options):
    source = sources[0]
    folder = source.step(options.trial, options.step)
    votes, elevations = votes_of(folder), elevations_of(folder)
    figure, (left, right) = style.new_figure(9.2, 3.9, ncols=2, width_ratios=(1.0, 1.9))
    _draw_scene(figure, left, votes, elevations)
    _draw_ranking(figure, right, votes)
    chosen = [(group, arc["curvature_per_m"], arc["merged"]) for group in GROUPS
              for arc in votes[group] if arc["chosen"]]
    drawn = {"votes": votes, "elevations": elevations, "chosen": chosen}
    return Drawn(figure, _caption(source, options, chosen), drawn)


def _draw_scene(figure, axes, votes, elevations):
    """Elevations and candidate arcs around the rover; its front is up."""
    cells = int(round(SIGHT_M / CELL_M))
    grid = np.full((2 * cells, 2 * cells), np.nan)
    for (forward, left), mean in elevations.items():
        if -cells <= forward < cells and -cells <= left < cells:
            grid[forward + cells, left + cells] = mean
    edges = np.linspace(-SIGHT_M, SIGHT_M, 2 * cells + 1)
    axes.set_facecolor("white")
    span = max(max(elevations.values(), default=0.0) - min(elevations.values(), default=0.0), 0.01)
    # White is what was not measured: the ramp begins above it.
    picture = axes.pcolormesh(edges, edges, grid, cmap="Greys", rasterized=True,
                              vmin=min(elevations.values(), default=0.0) - 0.4 * span)
    figure.colorbar(picture, ax=axes, label="measured elevation (m)", shrink=0.8)
    for group in GROUPS:
        for arc in votes[group]:
            points = arc_points(arc["curvature_per_m"], arc["direction"])
            look = {"color": style.VERMILION, "linewidth": 2.6, "zorder": 4} if arc["chosen"] else \
                {"color": style.BLUE, "linewidth": 0.5}
            axes.plot([left for _, left in points], [forward for forward, _ in points], **look)
    axes.plot(0.0, 0.0, "^", color=style.INK, markersize=7, zorder=5)
    axes.set(aspect="equal", xlim=(SIGHT_M, -SIGHT_M), ylim=(-SIGHT_M, SIGHT_M),
             xlabel="left of the rover (m)", ylabel="ahead (m)", title="view and arcs")
    axes.grid(False)


def _signed(value):
    """With a typographic minus, and no sign where it is zero."""
    text = f"{value:+.2f}"
    return "0" if float(text) == 0.0 else text.replace("-", "\u2212")


def _draw_ranking(figure, axes, votes):
    """Three rows of votes for each direction; candidates underlined, the choice in a box."""
    from matplotlib.patches import Rectangle  # pylint: disable=import-outside-toplevel
    ticks, labels = [], []
    picture = None
    for block, group in enumerate(GROUPS):
        arcs = votes[group]
        bottom = block * (len(ROWS) + 1.2)
        values = np.array([[arc[row] for arc in arcs] for row in reversed(ROWS)])
        picture = axes.pcolormesh(np.arange(len(arcs) + 1), bottom + np.arange(len(ROWS) + 1),
                                  values, cmap=style.RAMP, vmin=0, vmax=BEST_VOTE,
                                  edgecolors="white", linewidth=0.4)
        ticks += [bottom + i + 0.5 for i in range(len(ROWS))]
        labels += list(reversed(ROWS))
        axes.annotate(group, (0, bottom + len(ROWS) + 0.12), fontweight="bold", fontsize=8)
        for i, arc in enumerate(arcs):
            if arc["best"]:
                axes.plot([i + 0.08, i + 0.92], [bottom - 0.2] * 2, color=style.GREEN, linewidth=3.5,
                          solid_capstyle="butt")
            if arc["chosen"]:
                axes.add_patch(Rectangle((i, bottom - 0.4), 1, len(ROWS) + 0.5, fill=False,
                                         edgecolor=style.GREEN, linewidth=2.0, zorder=5))
    arcs = votes["forward"]
    middle, step = len(arcs) // 2, max(1, len(arcs) // 6)
    shown = range(middle % step, len(arcs), step)  # with the straight one
    axes.set(yticks=ticks, yticklabels=labels, title="ranking of arcs",
             xticks=[i + 0.5 for i in shown],
             xticklabels=[_signed(arcs[i]["curvature_per_m"]) for i in shown],
             xlabel="curvature of the arc (1/m): left turns to the left",
             ylim=(-0.6, 2 * (len(ROWS) + 1.2) - 0.4), xlim=(-0.2, len(arcs) + 0.2))
    axes.grid(False)
    axes.spines[:].set_visible(False)
    axes.tick_params(length=0)
    figure.colorbar(picture, ax=axes, label="vote", shrink=0.8)


def _caption(source, options, chosen):
    choice = "; ".join(f"{group}, curvature {curvature:+.2f} per m, merged vote {vote:.0f}"
                       for group, curvature, vote in chosen) or "a turn in place"
    return ("Ranking of headings in the manner of Goldberg 2002, figure 3, part 4: "
            f"{source.name}, seed {source.seed}, trial {options.trial}, step {options.step}. Rows of "
            "votes (0 to 255): toward the waypoint, against hazards, and merged, for arcs forward and "
            f"backward. Underlined: the best candidates; boxed: the choice ({choice}). Left: mean "
            "elevation that the cameras measured (white: nothing), and the arcs, in the rover's frame.")


FIGURES = (Figure(name="goldberg2002-3", title="ranking of arcs by GESTALT in one decision",
                   runs="a run with GESTALT (scenarios/gestalt); --trial and --step say which decision",
                   accepts=(1, 1), draw=draw),)
