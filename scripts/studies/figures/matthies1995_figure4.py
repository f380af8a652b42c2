"""Matthies 1995, figure 4: errors of designated goals against their distance."""

import math

from study import rates

from . import Drawn, Figure, style

# name, line style, mark and colour of each of the three errors
CURVES = (("downrange", "-", "o", style.BLUE), ("crossrange", "--", "s", style.GREEN),
          ("pan", ":", "^", style.VERMILION))
LABELS = {"downrange": "downrange, standard deviation", "crossrange": "crossrange, standard deviation",
          "pan": "crossrange, pan error of {pan:g}°"}


def equations(range_m, settings):
    """Equations 1 to 3 of section 4 at a range, m."""
    pixel = settings["pixel_rad"]
    return {"downrange": settings["disparity_sd_px"] * pixel * range_m ** 2 / settings["baseline_m"],
            "crossrange": settings["pixel_sd_px"] * pixel * range_m,
            "pan": math.radians(settings["pan_error_deg"]) * range_m}


def deviation(row, mean, rms):
    """Standard deviation from a column of means and one of root mean squares."""
    return math.sqrt(max(row[f"rms_{rms}"] ** 2 - row[f"mean_{mean}"] ** 2, 0.0))


def measured(row):
    """{curve: (value, half of its 95 % interval)} of a cell; a standard deviation is known to its
    2 n-th root."""
    count = row["found"] * row["designations"]
    downrange = deviation(row, "downrange_m", "downrange_error_m")
    crossrange = deviation(row, "crossrange_m", "crossrange_error_m")
    panned = deviation(row, "panned_crossrange_m", "panned_crossrange_error_m")
    return {"downrange": (downrange, rates.Z95 * downrange / math.sqrt(2.0 * count)),
            "crossrange": (crossrange, rates.Z95 * crossrange / math.sqrt(2.0 * count)),
            "pan": (row["mean_panned_crossrange_m"], rates.Z95 * panned / math.sqrt(count))}


def draw(sources, _options):
    source = sources[0]
    source.require_experiment("designation", "scenarios/localization/designation.json")
    settings = source.scenario["course"]["designation"]
    rows = source.table("cells.csv").sort_values("range_m", kind="stable")
    ranges = rows.range_m.tolist()
    points = [measured(row) for _, row in rows.iterrows()]
    lines = [0.5 * i for i in range(2 * math.ceil(ranges[-1]) + 1)]
    figure, axes = style.new_figure(5.6, 4.0)
    drawn = {"range_m": ranges}
    for name, dashes, mark, colour in CURVES:
        label = LABELS[name].format(pan=settings["pan_error_deg"])
        axes.plot(lines, [equations(r, settings)[name] for r in lines], color=colour,
                  linestyle=dashes, linewidth=1.2, label=label)
        drawn[name] = [point[name] for point in points]
        axes.errorbar(ranges, [value for value, _ in drawn[name]],
                      yerr=[half for _, half in drawn[name]], fmt=mark, markersize=4, color=colour,
                      linewidth=0.8, capsize=2)
    axes.set(xlabel="distance from the lander (m)", ylabel="designation error (m)",
             xlim=(0.0, 1.02 * ranges[-1]), ylim=(0.0, None))
    axes.legend(fontsize=8, loc="upper left")
    return Drawn(figure, _caption(source, rows, settings), drawn)


def _caption(source, rows, settings):
    beyond = (rows.beyond * rows.designations).sum()
    return (f"Designation error against distance, in the manner of Matthies 1995, figure 4: lines are its "
            f"equations 1 to 3, points are places triangulated in images of the lander's cameras "
            f"({source.name}, seed {source.seed}, {rows.designations.iloc[0]:.0f} goals a range; bars: "
            f"95 % intervals). Operators pick goals to {settings['pixel_sd_px']:g} px and disparities are "
            f"known to {settings['disparity_sd_px']:g} px. {beyond:.0f} goals had no positive disparity. The "
            "points of the paper's own figure are not available, so none are drawn.")


FIGURES = (Figure(name="matthies1995-4", title="designation error against distance",
                   runs="a run of scenarios/localization/designation.json", accepts=(1, 1), draw=draw),)
