"""Matthies 1995, figure 16: map of one run with the true and the dead-reckoned path."""

import math

import numpy as np
import study

from . import Drawn, Figure, FigureError, style

# Samples nearer than this to the last one drawn add nothing that can be seen.
LEAST_STEP_M = 0.01


def thinned(points):
    """Without points that hardly moved; the last one stays."""
    kept = [*points[:1]]
    for point in points[1:]:
        if math.dist(point, kept[-1]) >= LEAST_STEP_M:
            kept.append(point)
    return kept if tuple(kept[-1]) == tuple(points[-1]) else [*kept, points[-1]]


def rocks_of(terrain):
    """(x, y, diameter) of every rock, mirror images too."""
    return [(rock["center_m"][0], rock["center_m"][1], rock["diameter_m"]) for rock in terrain["rocks"]]


def draw(sources, options):
    source = sources[0]
    terrain = source.terrain(options.trial)
    trace = source.trace(options.trial)
    hazards = trace.events[trace.events.kind == "hazard"]
    seen_at = np.searchsorted(trace["time_s"], hazards.time_s, side="right") - 1
    true, believed = (list(map(tuple, trace[name][:, :2].tolist())) for name in ("position_m", "believed"))
    drawn = {"rocks": rocks_of(terrain), "true": thinned(true[1:]), "believed": thinned(believed[1:]),
             "hazards_true": list(zip(hazards.x_m, hazards.y_m)), "hazards_believed": [believed[at] for at in seen_at]}
    figure, axes = style.new_figure(8.0, 3.3)
    draw_ground(axes, terrain, drawn["rocks"])
    _draw_paths(axes, drawn)
    for place in (terrain["start_m"], terrain["goal_m"]):
        axes.plot(*place, "x", color=style.INK, markersize=9, markeredgewidth=2.2, zorder=6)
    axes.set(xlabel="x (m)", ylabel="y (m)")
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3, fontsize=8)
    return Drawn(figure, _caption(source, options.trial, trace.events.iloc[-1], drawn, terrain["goal_m"]), drawn)


def draw_ground(axes, terrain, rocks):
    style.octagons(axes, rocks, facecolor=style.PALE, edgecolor=style.GREY, linewidth=0.7, zorder=2)
    bounds = terrain["drivable"]
    axes.set(aspect="equal", xlim=bounds["x_m"], ylim=bounds["y_m"])
    axes.grid(False)
    for y in terrain.get("mirror_lines_y_m", []):
        axes.axhline(y, color=style.GREY, linewidth=0.7, linestyle=(0, (1, 4)), zorder=1)


def _draw_paths(axes, drawn):
    axes.plot(*zip(*drawn["true"]), color=style.BLUE, label="true path", zorder=4)
    axes.plot(*zip(*drawn["believed"]), color=style.VERMILION, linestyle=":", linewidth=1.8,
              label="dead-reckoned path", zorder=4)
    for name, colour in (("hazards_true", style.BLUE), ("hazards_believed", style.VERMILION)):
        if drawn[name]:
            label = f"obstacle detected here ({'true' if name == 'hazards_true' else 'believed'} place)"
            axes.plot(*zip(*drawn[name]), "o", color=colour, markersize=4.5, label=label, zorder=5)


def _caption(source, trial, end, drawn, goal):
    off = math.dist(drawn["true"][-1], drawn["believed"][-1])
    return (f"Map of one run in the manner of Matthies 1995, figure 16: {source.name}, seed "
            f"{source.seed}, trial {trial}, which ended: {end.detail or end.kind}. Octagons: "
            "rocks. Solid: true path; dotted: dead-reckoned path. Filled circles: where obstacles were "
            f"detected ({len(drawn['hazards_true'])} detections). Crosses: start (left) and goal. "
            f"At the end the rover is {off:.2f} m from where it believes itself, and "
            f"{math.dist(drawn['true'][-1], goal):.2f} m from the goal (1.4 m in the published run). Thin dotted lines: where the virtual arena reflects, if it does.")


def like_the_published(source):
    """The first trial that was declared a success 1.2 to 1.6 m from the goal; the published one was at 1.4 m."""
    drives = source.drives()
    found = drives.index[drives.outcome.isin(study.ARRIVED) & drives.true_goal_distance_m.between(1.2, 1.6)]
    if len(found):
        return int(found[0])
    raise FigureError(f"{source.path}: no trial was declared a success 1.2 to 1.6 m from the goal; "
                      "name one with --trial")


FIGURES = (Figure(name="matthies1995-16", title="map of one run: rocks, true and dead-reckoned path",
                   runs="a run of drives; --trial says which of its trials", accepts=(1, 1), draw=draw,
                   chosen=like_the_published),)
