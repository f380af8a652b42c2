"""Matthies 1995, figure 15: Moore's model of rock sizes, and what two obstacles per m2 look like."""

from study import rates

from . import Drawn, Figure, FigureError, style

EXPONENT = -2.66                # Matthies 1995, equation 4
SMALLEST_OBSTACLE_M = 0.15      # figure 15 (b)
ROVER_M = (0.65, 0.48)          # length and width of the Pathfinder rover, section 2
PUBLISHED = ((0.23, 0.65), (0.15, 2.0))  # (diameter, obstacles per m2) that section 7 reads off
DIAMETERS_M = [0.1 * 10 ** (i / 30) for i in range(31)]  # 10 cm to 1 m


def law_per_m2(k, diameter_m):
    """Rocks per m2 of that diameter and larger: N = k D^-2.66."""
    return k * diameter_m ** EXPONENT


def as_made(rocks, placed_per_m2):
    """Expected rocks per m2 in fields whose sizes end somewhere and whose course has clear ends."""
    most, least = (law_per_m2(rocks["k_per_m2"], rocks[name]) for name in ("min_diameter_m", "max_diameter_m"))
    return [placed_per_m2 * max(law_per_m2(rocks["k_per_m2"], d) - least, 0.0) / (most - least) for d in DIAMETERS_M]


def counted(terrains):
    """(diameters of all rocks that were placed, area of the layouts in m2); no mirror images."""
    diameters = [rock["diameter_m"] for terrain in terrains for rock in terrain["rocks"] if not rock["mirror_image"]]
    return diameters, sum(terrain["audit"]["layout_area_m2"] for terrain in terrains)


def count_at_least(diameters, diameter_m):
    return sum(1 for each in diameters if each >= diameter_m)


def moore_of(source):
    rocks = source.scenario["terrain"]["rocks"]
    if rocks["kind"] != "moore":
        raise FigureError(f"{source.path}: its rocks are of kind {rocks['kind']}; figure 15 (a) shows "
                          "Moore's model: take a run of scenarios/pathfinder/vl2.json")
    return rocks


def draw(sources, options):
    law_source, plan_source = sources[0], sources[-1]
    rocks = moore_of(law_source)
    terrains = [law_source.terrain(trial) for trial in range(options.fields)]
    diameters, area_m2 = counted(terrains)
    counts = [count_at_least(diameters, d) for d in DIAMETERS_M]
    plan = plan_source.terrain(options.trial)
    figure, (left, right) = style.new_figure(8.6, 4.0, ncols=2, width_ratios=(1.0, 1.15))
    law = [law_per_m2(rocks["k_per_m2"], d) for d in DIAMETERS_M]
    expected = sum(t["audit"]["expected_placed"] for t in terrains)
    made = as_made(rocks, expected / area_m2)
    _draw_law(left, law, counts, area_m2, rocks["k_per_m2"])
    left.plot(DIAMETERS_M, made, color=style.BLUE, linestyle="--", linewidth=1.0, label="what they are made to hold")
    left.legend(fontsize=8, loc="lower left")
    shown = _draw_plan(right, plan)
    drawn = {"diameter_m": DIAMETERS_M, "law_per_m2": law, "area_m2": area_m2, "counts": counts,
             "made_per_m2": made, "plan": shown}
    return Drawn(figure, _caption(law_source, plan_source, options, len(diameters), expected, area_m2, rocks), drawn)


def _draw_law(axes, law, counts, area_m2, k):
    axes.plot(DIAMETERS_M, law, color=style.INK, label=f"N = {k:g} D⁻²·⁶⁶")
    drawn = [(d, n / area_m2, [each / area_m2 for each in rates.poisson_interval(n)])
             for d, n in zip(DIAMETERS_M, counts)]
    seen = [each for each in drawn if each[1] > 0.0]
    axes.errorbar([d for d, _, _ in seen], [n for _, n, _ in seen],
                  yerr=[[n - least for _, n, (least, _) in seen], [most - n for _, n, (_, most) in seen]],
                  fmt="o", markersize=3, color=style.BLUE, linewidth=0.8, label="rocks of our fields")
    none = [each for each in drawn if each[1] == 0.0]
    if none:  # no dot on a logarithmic axis: the upper limit, and an arrow down from it
        axes.plot([d for d, _, _ in none], [most for _, _, (_, most) in none], "v", markersize=4,
                  color=style.BLUE, fillstyle="none", label="none seen: 95 % upper limit")
    for diameter, density in PUBLISHED:
        axes.plot(diameter, density, "s", color=style.VERMILION, markersize=6, zorder=5,
                  label="read off in the paper" if diameter == PUBLISHED[0][0] else None)
        axes.annotate(f"{100 * diameter:.0f} cm: {density:g} per m²", (diameter, density),
                      xytext=(8, 4), textcoords="offset points", fontsize=8)
    axes.set(xscale="log", yscale="log", xlabel="diameter D (m)",
             ylabel="rocks per m² of diameter D and larger", title="(a)",
             xticks=[0.1, 0.2, 0.5, 1.0], xticklabels=["0.1", "0.2", "0.5", "1"],
             ylim=(0.5 * law[-1], 2.0 * max(law[0], PUBLISHED[-1][1])))
    axes.yaxis.set_major_formatter(lambda value, _: f"{value:g}")


def _draw_plan(axes, terrain):
    """Rocks from 15 cm, those below as outlines, and a rover to scale at the start."""
    rocks = [(r["center_m"][0], r["center_m"][1], r["diameter_m"]) for r in terrain["rocks"]]
    large = [rock for rock in rocks if rock[2] >= SMALLEST_OBSTACLE_M]
    small = [rock for rock in rocks if rock[2] < SMALLEST_OBSTACLE_M]
    style.octagons(axes, small, facecolor="none", edgecolor=style.GREY, linewidth=0.5)
    style.octagons(axes, large, facecolor=style.GREY, edgecolor=style.INK, linewidth=0.6)
    length, width = ROVER_M
    x, y = terrain["start_m"]
    corners = [(x + length * i, y + width * j) for i, j in
               ((0.5, 0.5), (-0.5, 0.5), (-0.5, -0.5), (0.5, -0.5), (0.5, 0.5))]
    axes.plot(*zip(*corners), color=style.BLUE)
    axes.annotate("rover", (x, y), ha="center", va="center", fontsize=7, color=style.BLUE)
    side = min(terrain["drivable"]["y_m"][1] - terrain["drivable"]["y_m"][0], 4.0)
    axes.set(aspect="equal", xlim=(x - 1.0, x - 1.0 + 1.15 * side), ylim=(y - side / 2, y + side / 2),
             xlabel="x (m)", ylabel="y (m)", title="(b)")
    axes.grid(False)
    return large


def _caption(law_source, plan_source, options, placed, expected, area_m2, rocks):
    at_15 = law_per_m2(rocks["k_per_m2"], SMALLEST_OBSTACLE_M)
    return (f"(a) Rock sizes in the manner of Matthies 1995, figure 15: Moore's model, k = "
            f"{rocks['k_per_m2']:g} per m2 (line), against {placed} rocks in {options.fields} fields of "
            f"{law_source.name}, seed {law_source.seed}, {area_m2:.0f} m2 (dots with exact 95 % "
            f"limits of a Poisson count; dots count the same large rocks and vary together). Dashed: what the fields are made to hold ({expected:.0f} rocks were expected): sizes "
            f"end at {rocks['max_diameter_m']:g} m, and no rock is within "
            f"{rocks['clear_radius_m']:g} m of start and goal. Squares: the two densities that section 7 reads off for VL-2. (b) Part "
            f"of the field of trial {options.trial} of {plan_source.name}: obstacles of at least 15 cm "
            f"are filled (the model says {at_15:.1f} per m2), smaller rocks outlined; rover to scale.")


FIGURES = (Figure(name="matthies1995-15", title="rock sizes of fields against Moore's model; a field",
                   runs="a run in Moore's terrain (vl2.json); a second one, if given, is shown in (b)",
                   accepts=(1, 2), draw=draw),)
