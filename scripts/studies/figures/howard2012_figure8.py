"""Howard 2012, figure 8: the angle of each steered wheel over time."""

from . import Drawn, Figure, howard2012, style

WHEELS = ("left front", "left middle", "left rear", "right front", "right middle", "right rear")
# Left and right by colour, front, middle and rear by dash.
LOOKS = tuple((colour, dash) for colour in (style.BLUE, style.VERMILION)
              for dash in ("-", (0, (1, 1)), (0, (5, 1.5))))


def draw(sources, options):
    drives = howard2012.load_all(sources, options.trial)
    figure, panels = style.new_figure(7.0, 0.5 + 2.1 * len(drives), nrows=len(drives), sharex=True,
                                      sharey=True, squeeze=False)
    numbers = {}
    for drive, (axes,) in zip(drives, panels):
        steered = [wheel for wheel, turned in enumerate(drive.turned_rad()) if turned > 0.0]
        for wheel in steered:
            colour, dash = LOOKS[wheel]
            angles = drive.trace["steer_rad"][:, wheel]
            axes.plot(*howard2012.curve(drive.time_s, angles), color=colour, linestyle=dash,
                      linewidth=1.1, label=WHEELS[wheel])
        axes.set(ylabel="angle (rad)", title=drive.name)
        numbers[drive.name] = {"time_s": drive.time_s, "steer_rad": drive.trace["steer_rad"],
                               "steered": [WHEELS[wheel] for wheel in steered],
                               "turned_rad": drive.turned_rad(),
                               "mean_turned_rad": drive.record["steer_turned_rad"]}
    panels[-1][0].set(xlabel="time (s)", xlim=(0.0, None))
    # Of the navigator that steers most wheels.
    fullest = max((axes for (axes,) in panels), key=lambda axes: len(axes.get_lines()))
    if fullest.get_lines():
        panels[0][0].legend(*fullest.get_legend_handles_labels(), loc="lower right", bbox_to_anchor=(1.0, 1.0),
                            borderaxespad=0.2, ncols=4, fontsize=7)  # above: curves fill the panels
    return Drawn(figure, _caption(numbers, options.trial), numbers)


def _caption(numbers, trial):
    totals = "; ".join(f"{name}: {each['mean_turned_rad']:.2f} rad" for name, each in numbers.items())
    return (f"Steering angles over time in the manner of Howard 2012, figure 8: trial {trial}; positive is to the "
            "left, wheels that never turned are left out. Total turning of a steering motor, mean over the "
            f"motors: {totals}. Published, of one drive each: 2.03 rad (CSOD) and 0.93 rad (CSAD).")


FIGURES = (Figure(name="howard2012-8", title="steering angles over time, by navigator",
                   runs=howard2012.RUNS, accepts=howard2012.ACCEPTS, draw=draw,
                   defaults=howard2012.DEFAULTS),)
