"""Matthies 1995, figure 5: variance of the errors of heading and distance along runs on level sand."""

from dead_reckoning import sand_slopes

from . import Drawn, Figure, FigureError, style

SLOPES = (0.70, 0.0039)  # section 5: deg2/m, m2/m
MOST_SETS = 20           # of twenty runs each, drawn thinly beside the first


def courses_of(source):
    source.require_drives()
    courses = sand_slopes.read_courses(source.run)
    if not courses:
        raise FigureError(f"{source.path}: keeps no courses; run it with --traces all")
    if len(courses) < sand_slopes.RUNS:
        raise FigureError(f"{source.path}: has {len(courses)} runs, and a set has {sand_slopes.RUNS}")
    return courses


def sets_of(courses):
    size = sand_slopes.RUNS
    return [courses[i:i + size] for i in range(0, len(courses) - size + 1, size)][:MOST_SETS]


def draw(sources, _options):
    (source,) = sources
    courses = courses_of(source)
    sets = sets_of(courses)
    figure, axes = style.new_figure(7.0, 3.6, ncols=2)
    drawn = {}
    for which, (panel, unit, title) in enumerate(zip(axes, ("deg²", "m²"), ("heading", "distance travelled"))):
        curves = [sand_slopes.variances(each, which) for each in sets]
        pooled = sand_slopes.variances(courses, which)
        for index, values in enumerate(curves):
            look = {"color": style.BLUE, "marker": ".", "label": f"first {sand_slopes.RUNS} runs"} \
                if index == 0 else {"color": style.PALE, "linewidth": 0.8, "zorder": 1}
            panel.plot(sand_slopes.distances(values), values, **look)
        panel.plot(sand_slopes.distances(pooled), pooled, color=style.GREEN, linestyle="--",
                   label=f"all {len(courses)} runs")
        longest = sand_slopes.distances(pooled)[-1]
        panel.plot((0.0, longest), (0.0, SLOPES[which] * longest), color=style.VERMILION, linestyle=":",
                   label=f"published slope, {SLOPES[which]:g} {unit}/m")
        panel.set(xlabel="true distance travelled (m)", ylabel=f"variance of the error ({unit})",
                  xlim=(0.0, None), ylim=(0.0, None))
        panel.set_title(title)
        panel.legend(loc="upper left", fontsize=7)
        drawn[title] = {"first": curves[0], "sets": curves, "all": pooled,
                        "slope": sand_slopes.slope_through_origin(curves[0])}
    return Drawn(figure, _caption(source, len(courses), len(sets), drawn), drawn)


def _caption(source, runs, sets, drawn):
    heading, distance = (each["slope"] for each in drawn.values())
    return ("Variance of the errors of heading and distance against true distance, in the manner of Matthies "
            f"1995, figure 5: {source.name}, {runs} runs, seed {source.seed}. Points: the first twenty runs, "
            f"whose slopes through the origin are {heading:.2f} deg2/m and {distance:.4f} m2/m; pale: "
            f"{sets - 1} further sets of twenty; dashed: all runs. Dotted: the best fit slopes that section 5 "
            "prints. The points of its own figure are not in the text, so none are drawn.")


FIGURES = (Figure(name="matthies1995-5", title="variance of dead-reckoning errors along runs on sand",
                   runs="a run of level_sand.json with --traces all, 20 trials or more",
                   accepts=(1, 1), draw=draw),)
