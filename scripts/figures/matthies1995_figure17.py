"""Matthies 1995, figure 17: how far the rover drives."""

from . import Drawn, Figure, FigureError, style
from .source import numbers

SHORTEST_PUBLISHED_M = 7.0  # Matthies 1995, section 7: of the 40 real runs
STRAIGHT_M = 7.6            # section 7: from start to goal
MODE_PUBLISHED_M = 8.39     # table 4, caption
FEW_RUNS = 60               # up to which every run gets a mark of its own, as in the paper

# The first run is the solid curve, the second the dotted one.
LOOKS = ({"color": style.BLUE, "linestyle": "-"}, {"color": style.VERMILION, "linestyle": ":"})


def curve(source):
    """(distance, share of runs that drove no further, its band) from distance_cdf.csv."""
    rows = source.distance_cdf()
    if not rows:
        raise FigureError(f"{source.path}: has no finished trials")
    return [numbers(rows, column, source.path / "distance_cdf.csv")
            for column in ("distance_m", "ecdf", "ecdf_low", "ecdf_high")]


def label_of(source, runs):
    believed = "perfect localization" if source.summary.get("localization") == "oracle" \
        else "dead reckoning"
    return f"{source.name}: {runs} runs, {believed}"


def draw(sources, _options):
    figure, axes = style.new_figure(7.0, 4.3)
    drawn, notes = {}, []
    curves = [curve(source) for source in sources]
    furthest = max(distance[-1] for distance, *_ in curves)
    for source, look, (distance, share, low, high) in zip(sources, LOOKS, curves):
        x = [distance[0], *distance, furthest]
        axes.fill_between(x, [0.0, *low, low[-1]], [0.0, *high, high[-1]], step="post",
                          color=look["color"], alpha=0.15, linewidth=0)
        axes.step(x, [0.0, *share, 1.0], where="post", label=label_of(source, len(distance)), **look)
        if len(distance) <= FEW_RUNS:
            axes.plot(distance, share, "D", color=look["color"], markersize=3.5)
        drawn[source.name] = {"distance_m": distance, "ecdf": share, "ecdf_low": low,
                              "ecdf_high": high}
        notes.append(f"{source.name}: shortest {distance[0]:.2f} m, "
                     f"longest {distance[-1]:.2f} m, seed {source.summary['seed']}")
    _mark_published(axes)
    axes.set(xlabel="total distance travelled (m)", ylabel="share of runs that drove no further",
             ylim=(0.0, 1.02), xlim=(min(6.8, *(c[0][0] for c in curves)) - 0.1, furthest))
    axes.legend(loc="lower right")
    return Drawn(figure, _caption(notes), drawn)


def _mark_published(axes):
    """The numbers that the text gives; its curves' points are not in it."""
    for at, text in ((SHORTEST_PUBLISHED_M, "7.0 m: shortest of the 40 published runs"),
                     (STRAIGHT_M, "7.6 m: straight from start to goal"),
                     (MODE_PUBLISHED_M, "8.39 m: mode of the 40 published runs")):
        axes.axvline(at, color=style.GREY, linewidth=0.9, linestyle=(0, (6, 3)))
        axes.annotate(text, (at, 0.98), xytext=(-3, 0), textcoords="offset points", rotation=90,
                      ha="right", va="top", fontsize=7, color=style.GREY)


def _caption(notes):
    return ("Cumulative distribution of the total distance over runs, in the manner of Matthies 1995, "
            "figure 17, with bands that hold the whole curve with 95 % (Dvoretzky, Kiefer and "
            f"Wolfowitz). {'; '.join(notes)}. Dashed lines: what the paper's text gives. The points of "
            "its own curves (40 real runs, 300 simulated ones without dead-reckoning error) are not "
            "available, so none are drawn.")


FIGURE = Figure(name="matthies1995-17", title="distribution of the total distance over runs",
                runs="a run of nominal.json; then, dotted, one of nominal_perfect_localization.json",
                accepts=(1, 2), draw=draw)
