"""Howard 2012, figure 6: paths of several navigators among the same rocks."""

from . import Drawn, Figure, howard2012, style
from .matthies1995_figure16 import draw_ground, rocks_of, thinned

MARGIN_M = 1.0  # about the paths


def draw(sources, options):
    drives = howard2012.load_all(sources, options.trial)
    terrain = drives[0].terrain
    figure, axes = style.new_figure(8.0, 4.2)
    limits = _limits(drives, terrain)
    draw_ground(axes, terrain, [rock for rock in rocks_of(terrain) if is_in_view(limits, rock)])
    for drive, (colour, dash) in zip(drives, howard2012.LOOKS):
        axes.plot(*zip(*thinned(drive.believed_m)), color=colour, linestyle=dash, zorder=4,
                  label=f"{drive.name}, as recorded")
        axes.plot(*zip(*thinned(drive.true_m)), color=colour, linewidth=0.6, zorder=3)
    for place in (terrain["start_m"], terrain["goal_m"]):
        axes.plot(*place, "x", color=style.INK, markersize=9, markeredgewidth=2.2, zorder=6)
    axes.set(xlabel="x (m)", ylabel="y (m)", **limits)
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3, fontsize=8)
    numbers = {drive.name: {"believed": drive.believed_m, "true": drive.true_m} for drive in drives}
    return Drawn(figure, _caption(drives, options.trial), numbers)


def _limits(drives, terrain):
    """What holds every path, the start and the goal."""
    places = [tuple(terrain["start_m"]), tuple(terrain["goal_m"])]
    for drive in drives:
        places += [*drive.believed_m, *drive.true_m]
    return {f"{axis}lim": (min(values) - MARGIN_M, max(values) + MARGIN_M)
            for axis, values in zip("xy", zip(*places))}


def is_in_view(limits, rock):
    """Whether any of a rock (x, y, diameter) may be seen."""
    x, y, diameter = rock
    return all(low - diameter <= place <= high + diameter
               for place, (low, high) in ((x, limits["xlim"]), (y, limits["ylim"])))


def _caption(drives, trial):
    ways = "; ".join(f"{drive.name}: {drive.way_as_seen()}, "
                     f"{drive.record['true_distance_m']:.2f} m true, {drive.outcome.replace('_', ' ')}"
                     for drive in drives)
    return ("Paths among the same rocks in the manner of Howard 2012, figure 6: trial "
            f"{trial}. Thick: as the rover itself recorded it; thin, of the same colour: the true path. "
            f"Octagons: rocks. Crosses: start and goal. {ways}. Published, of one drive each on rocks of which "
            "no layout is printed, by visual odometry: 14.92 m (CSOD) and 14.94 m (CSAD).")


FIGURES = (Figure(name="howard2012-6", title="paths of several navigators among the same rocks",
                   runs=howard2012.RUNS, accepts=howard2012.ACCEPTS, draw=draw,
                   defaults=howard2012.DEFAULTS),)
