"""Matthies 1995, figure 17: how far the rover drives."""

import study

from . import Drawn, Figure, FigureError, style

SHORTEST_PUBLISHED_M = 7.0  # Matthies 1995, section 7: of the 40 real runs
STRAIGHT_M = 7.6            # section 7: from start to goal
MODE_PUBLISHED_M = 8.39     # table 4, caption
FEW_RUNS = 60               # up to which every run gets a mark of its own, as in the paper

# The first run is the solid curve, the second the dotted one.
LOOKS = ({"color": style.BLUE, "linestyle": "-"}, {"color": style.VERMILION, "linestyle": ":"})


def curve(source):
    """(distance, share of runs that drove no further, its band) from distance_cdf.csv."""
    source.require_drives()
    rows = source.table("distance_cdf.csv")
    if rows.empty:
        raise FigureError(f"{source.path}: has no finished trials")
    return [rows[column].tolist() for column in ("distance_m", "ecdf", "ecdf_low", "ecdf_high")]


def label_of(source, runs):
    believed = "perfect localization" if source.summary.get("localization") == "oracle" else "dead reckoning"
    return f"{source.name}: {runs} runs, {believed}"


def draw(sources, _options):
    figure, axes = style.new_figure(7.0, 4.6)
    drawn, notes = {}, []
    curves = [curve(source) for source in sources]
    furthest = max(distance[-1] for distance, *_ in curves)
    nearest = min(SHORTEST_PUBLISHED_M, *(distance[0] for distance, *_ in curves))
    for source, look, (distance, share, low, high) in zip(sources, LOOKS, curves):
        x = [distance[0], *distance, furthest + 0.2]
        axes.fill_between(x, [0.0, *low, low[-1]], [0.0, *high, high[-1]], step="post",
                          color=look["color"], alpha=0.15, linewidth=0)
        axes.step(x, [0.0, *share, 1.0], where="post", label=label_of(source, len(distance)), **look)
        if len(distance) <= FEW_RUNS:
            axes.plot(distance, share, "D", color=look["color"], markersize=3.5)
        drawn[source.name] = {"distance_m": distance, "ecdf": share, "ecdf_low": low, "ecdf_high": high}
        notes.append(_note(source, distance))
    _mark_published(axes)
    axes.set(xlabel="total distance travelled (m)", ylabel="share of runs that drove no further",
             ylim=(0.0, 1.02), xlim=(nearest - 0.2, furthest + 0.2))
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.04), fontsize=8)
    return Drawn(figure, _caption(notes), drawn)


def _note(source, distance):
    """Runs that failed may have driven next to nothing."""
    drives = source.drives()
    arrived = drives.true_distance_m[drives.outcome.isin(study.ARRIVED)]
    text = (f"{source.name}: {len(distance)} runs, seed {source.summary['seed']}, longest "
            f"{distance[-1]:.2f} m, shortest {distance[0]:.2f} m")
    return text + (f", shortest of those that believed to arrive {min(arrived):.2f} m" if len(arrived)
                   else ", none of which believed to arrive")


def _mark_published(axes):
    """The numbers that the text gives; its curves' points are not in it."""
    for at in (SHORTEST_PUBLISHED_M, STRAIGHT_M, MODE_PUBLISHED_M):
        line = axes.axvline(at, color=style.GREY, linewidth=0.9, linestyle=(0, (6, 3)))
        axes.annotate(f"{at:.2f}".removesuffix("0"), (at, 1.0), xycoords=("data", "axes fraction"), xytext=(0, 2),
                      textcoords="offset points", ha="center", fontsize=7.5)
    line.set_label("published: 7.0 m shortest and 8.39 m mode of 40 runs, 7.6 m straight to the goal")


def _caption(notes):
    return ("Cumulative distribution of the total distance over runs, in the manner of Matthies 1995, "
            "figure 17, with bands that hold the whole curve with 95 % (Dvoretzky, Kiefer and "
            f"Wolfowitz). {'; '.join(notes)}. Dashed lines: what the paper's text gives. The points of "
            "its own curves (40 real runs, 300 simulated ones without dead-reckoning error) are not "
            "available, so none are drawn.")


FIGURES = (Figure(name="matthies1995-17", title="distribution of the total distance over runs",
                   runs="a run of nominal.json; then, dotted, one of nominal_perfect_localization.json",
                   accepts=(1, 2), draw=draw),)
