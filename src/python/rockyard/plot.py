"""Figures, one line each: map, cdf, success, outcomes, over_time. Each returns the matplotlib Axes.

Colours, marks and dashes are those of the report pages in their light look: no two curves or outcomes
differ by colour alone. With `ax` a figure is drawn into axes of the caller's, whose looks it leaves alone.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, Iterable

import numpy as np

from .errors import UnknownName, need
from .records import OUTCOMES
from .runs import Run, Sweep, Trial

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Must agree: --series-1 and on of src/web/shared/theme.css, and SYMBOLS and DASHES of src/web/report/series.ts.
SERIES = ("#0072b2", "#d55e00", "#009e73", "#b85f90", "#b27b00", "#3190c8")
MARKS = ("o", "s", "^", "D", "*", "x")
DASHES: "tuple[Any, ...]" = ("-", (0, (7, 3)), (0, (2, 3)), (0, (10, 3, 2, 3)), (0, (5, 2)), (0, (1, 4)))
TEXT, MUTED, LINE, BAD = "#1b2024", "#545d66", "#d3d9dd", "#a53c00"
# Must agree: --scene-... of src/web/replay/styles/colours.css.
TRUE, BELIEVED, GOAL = "#0060a0", "#a3195b", "#007a56"
# Colour and hatch of an outcome. Must agree: the colours of STYLES of src/web/report/series.ts.
OUTCOME_LOOKS = {
    "goal_reached": (SERIES[2], ""), "false_goal": (SERIES[4], "//"), "no_path": (SERIES[1], ""),
    "high_centred": (SERIES[0], ""), "jammed": (SERIES[3], "\\\\"), "tip_over": (BAD, "xx"),
    "energy_depleted": (MUTED, ".."), "time_limit": (MUTED, "--"), "left_arena": (MUTED, "xx"),
    "excessive_slip": (MUTED, "||"), "navigator_fault": (BAD, "++"), "simulator_fault": (TEXT, ""),
    "measured": (TEXT, "..")}

_STYLE = {
    "font.size": 9.0, "axes.spines.top": False, "axes.spines.right": False, "axes.edgecolor": MUTED, "axes.labelcolor": TEXT,
    "text.color": TEXT, "xtick.color": TEXT, "ytick.color": TEXT, "axes.grid": True, "grid.color": LINE,
    "grid.linewidth": 0.6, "axes.axisbelow": True, "figure.dpi": 100}
_UNITS = {"m_s": "m/s", "m2": "m²", "m3": "m³", "m": "m", "s": "s", "rad": "rad", "deg": "°", "percent": "%", "wh": "Wh"}


def axes(ax: "Axes | None" = None, size: tuple[float, float] = (7.5, 4.0)) -> "Axes":
    """Returns the axes, or new ones in the project's style."""
    pyplot = need("matplotlib.pyplot", "python3-matplotlib", "rockyard.plot")
    if ax is None:
        with pyplot.rc_context(_STYLE):
            ax = pyplot.subplots(figsize=size, layout="constrained")[1]
    return ax


def label(name: str, unit: "str | None" = None) -> str:
    """Returns what stands on an axis: "true distance [m]" of true_distance_m. `unit` None: that of the name's end."""
    found = re.search(r"(_per)?_(m_s|m2|m3|m|s|rad|deg|percent|wh)$", name)
    shown = unit or ""
    if unit is None and found:
        shown = ("1/" if found[1] else "") + _UNITS[found[2]]
    shown = re.sub(r"m([23])\b", lambda power: "m" + "²³"[int(power[1]) - 2], _UNITS.get(shown, shown))
    words = (name[:found.start()] if found else name).replace("_", " ")
    return f"{words} [{shown}]" if shown not in ("", "1") else words


def _level(name: str, level: Any, unit: str) -> str:
    """Returns a level along an axis in words: "slope 4 °"."""
    words, _, shown = label(name, unit).partition(" [")
    return f"{words} {level} {shown[:-1]}".rstrip()


def _finish(ax: "Axes", title: str, key: bool = True, **more: Any) -> "Axes":
    """Gives the axes their labels and title, and the legend to the right of them, where it hides nothing."""
    ax.set(**more)
    ax.set_title(title, loc="left", fontsize=10, fontweight="bold")
    if key:
        ax.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0.0, frameon=False, fontsize=9)
    return ax


def _names(runs: "list[Run]") -> list[str]:
    """Returns what tells runs apart: their names, or else their cells, or else their folders."""
    for told in ([run.name for run in runs], [run.cell for run in runs], [run.folder.name for run in runs]):
        if len(set(told)) == len(runs):
            return told
    return [f"{run.folder} {run.cell}" for run in runs]


def map(trial: Trial, ax: "Axes | None" = None) -> "Axes":
    """Rocks, true and believed path, start and goal, from above."""
    patches = need("matplotlib.patches", "python3-matplotlib", "rockyard.plot")
    trace, course = trial.trace, trial.run.scenario["course"]
    goal = np.array([course["goal_x_m"], course["goal_y_m"]])
    places = np.concatenate([trace.position_m[:, :2], trace.believed[:, :2], goal[np.newaxis]])
    low, high = places.min(axis=0) - 1.0, places.max(axis=0) + 1.0
    width, height = high - low
    ax = axes(ax, (8.0, float(np.clip(6.0 * height / width + 0.8, 2.2, 7.0))))
    for rock in trial.place.rocks:
        grey = str(max(0.3, 0.85 - 1.8 * rock["height_m"]))
        ax.add_patch(patches.Ellipse((rock["x_m"], rock["y_m"]), 2 * rock["semi_axis_x_m"], 2 * rock["semi_axis_y_m"],
                                     angle=np.degrees(rock["yaw_rad"]), color=grey, linewidth=0, zorder=1))
    ax.plot([], [], "o", color="0.6", markersize=7, label="rock (darker: higher)")
    ax.add_patch(patches.Circle((goal[0], goal[1]), course["goal_radius_m"], fill=False, edgecolor=GOAL, linewidth=1.2, zorder=2))
    ax.plot(*trace.position_m[:, :2].T, color=TRUE, linewidth=1.8, label="true path", zorder=3)
    ax.plot(*trace.believed[:, :2].T, color=BELIEVED, linewidth=1.4, linestyle=(0, (4, 2)), label="believed path", zorder=3)
    ax.plot(course["start_x_m"], course["start_y_m"], "o", color=TEXT, markersize=5, markerfacecolor="white", label="start", zorder=4)
    ax.plot(*goal, "x", color=GOAL, markersize=7, markeredgewidth=2, label="goal", zorder=4)
    return _finish(ax, f"{trial.run.name}, trial {trial.index}: {trace.meta['outcome'].replace('_', ' ')}",
                   xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal", xlabel="x [m]", ylabel="y [m]")


def cdf(runs: "Run | Iterable[Run]", column: str = "true_distance_m", ax: "Axes | None" = None) -> "Axes":
    """The distribution of a column over the trials that have a value of it, with the simultaneous 95 % band of
    Dvoretzky, Kiefer and Wolfowitz (Massart 1990)."""
    ax, listed = axes(ax), [runs] if isinstance(runs, Run) else list(runs)
    for slot, (run, name) in enumerate(zip(listed, _names(listed))):
        if column not in run.units:
            raise UnknownName("a record", column, run.units)
        values = np.sort(run.records[column][np.isfinite(run.records[column])])
        count = max(len(values), 1)
        half = np.sqrt(np.log(2 / 0.05) / (2 * count))
        values, share = np.concatenate([values[:1], values]), np.arange(len(values) + 1) / count
        share = share[:len(values)]
        colour = SERIES[slot % len(SERIES)]
        ax.step(values, share, where="post", color=colour, linestyle=DASHES[slot % len(DASHES)], label=f"{name} ({count} trials)")
        ax.fill_between(values, np.clip(share - half, 0, 1), np.clip(share + half, 0, 1), step="post", alpha=0.15,
                        color=colour, linewidth=0)
        ax.set_xlabel(label(column, run.units[column]))
    _percent(ax)
    return _finish(ax, "Distribution, with a 95 % band", ylabel="share of trials below", ylim=(0, 1.02))


def _percent(ax: "Axes") -> None:
    ticker = need("matplotlib.ticker", "python3-matplotlib", "rockyard.plot")
    ax.yaxis.set_major_formatter(ticker.PercentFormatter(1.0, decimals=0, symbol=" %"))


def success(sweep: Sweep, axis: "str | None" = None, kind: str = "true_success", ax: "Axes | None" = None) -> "Axes":
    """Success against an axis with its 95 % band, a line for each level of the other axes. Levels that are no
    numbers stand side by side, with bars in place of bands."""
    ax = axes(ax)
    along = axis or sweep.axes[0]
    if along not in sweep.axes:
        raise UnknownName("a sweep", along, sweep.axes)
    others = [name for name in sweep.axes if name != along]
    cells = sweep.cells
    numbers = any(each["name"] == along and each["numeric"] for each in sweep.summary["axes"])
    cells = cells.sort_values(along) if numbers else cells
    places = {level: place for place, level in enumerate(dict.fromkeys(cells[along]))}
    units = {name: cells.attrs["units"].get(name, "") for name in sweep.axes}
    parts = list(cells.groupby(others[0] if len(others) == 1 else others, sort=False)) if others else [("", cells)]
    for slot, (level, part) in enumerate(parts):
        levels = level if isinstance(level, tuple) else (level,)
        names = ", ".join(_level(name, value, units[name]) for name, value in zip(others, levels))
        look = {"color": SERIES[slot % len(SERIES)], "marker": MARKS[slot % len(MARKS)], "markersize": 5, "label": names or None}
        low, high = part[f"{kind}_low"], part[f"{kind}_high"]
        if numbers:
            ax.plot(part[along], part[kind], linestyle=DASHES[slot % len(DASHES)], **look)
            ax.fill_between(part[along], low, high, alpha=0.15, color=look["color"], linewidth=0)
        else:
            x = np.array([places[each] for each in part[along]]) + 0.12 * (slot - (len(parts) - 1) / 2)
            ax.errorbar(x, part[kind], [part[kind] - low, high - part[kind]], linestyle="", capsize=3, **look)
    if not numbers:
        ax.set_xticks(list(places.values()), [str(level) for level in places])
        ax.margins(x=0.3)
    least, most = cells["trials"].min(), cells["trials"].max()
    of = f"{least} trials" if least == most else f"{least} to {most} trials"
    _percent(ax)
    return _finish(ax, f"{sweep.name}: {of} a point, 95 % {'bands' if numbers else 'bars'}", bool(others),
                   xlabel=label(along, units[along]), ylabel=kind.replace("_", " "), ylim=(-0.02, 1.02))


def outcomes(run: Run, column: str = "true_distance_m", bins: int = 30, ax: "Axes | None" = None) -> "Axes":
    """How trials ended over a column: stacked counts of the trials that have a value of it."""
    ticker = need("matplotlib.ticker", "python3-matplotlib", "rockyard.plot")
    if column not in run.units:
        raise UnknownName("a record", column, run.units)
    ax = axes(ax)
    values, codes = run.records[column], run.records["outcome"]
    found = {name: values[(codes == OUTCOMES.index(name)) & np.isfinite(values)] for name in OUTCOME_LOOKS}
    found = {name: part for name, part in found.items() if len(part)}
    edges = np.histogram_bin_edges(np.concatenate([*found.values(), np.empty(0)]), bins)
    below = np.zeros(len(edges) - 1)
    for name, part in found.items():
        colour, hatch = OUTCOME_LOOKS[name]
        counts = np.histogram(part, edges)[0]
        ax.bar(edges[:-1], counts, np.diff(edges), below, align="edge", color=colour, hatch=hatch, edgecolor="white",
               linewidth=0.5, label=f"{name.replace('_', ' ')} ({len(part)})")
        below += counts
    ax.yaxis.set_major_locator(ticker.MaxNLocator(integer=True))
    return _finish(ax, f"{run.name}: how {len(run)} trials ended", xlabel=label(column, run.units[column]), ylabel="trials")


def over_time(run: Run, quantity: str = "position_error_m", trials: "Iterable[int] | None" = None, ax: "Axes | None" = None) -> "Axes":
    """A quantity of many traces over simulated time: each thin, with median and quartiles of those that still drive,
    for as long as a tenth of them do, and three."""
    ax = axes(ax)
    frame = run.traces(quantity, trials)
    grid = np.linspace(0.0, frame.time_s.max(), 500)
    lines: list[Any] = []
    for _, trace in frame.groupby("trial"):
        lines.append(np.interp(grid, trace.time_s, trace[quantity], right=np.nan))
        ax.plot(grid, lines[-1], color=MUTED, linewidth=0.6, alpha=0.35, label="a trial" if len(lines) == 1 else None)
    values = np.array(lines)
    enough = np.isfinite(values).sum(axis=0) >= max(3, 0.1 * len(lines))
    if enough.any():
        low, middle, high = np.nanpercentile(values[:, enough], (25, 50, 75), axis=0)
        ax.fill_between(grid[enough], low, high, color=TRUE, alpha=0.2, linewidth=0, label="quartiles")
        ax.plot(grid[enough], middle, color=TRUE, linewidth=2, label="median")
    name = label(quantity)
    return _finish(ax, f"{run.name}: {name.partition(' [')[0]} of {len(lines)} trials", xlabel="simulated time [s]",
                   ylabel=name, xlim=(0.0, None))
