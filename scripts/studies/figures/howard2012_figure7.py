"""Howard 2012, figure 7: distance to the goal over time."""

from . import Drawn, Figure, howard2012, style


def draw(sources, options):
    drives = howard2012.load_all(sources, options.trial)
    figure, axes = style.new_figure(6.4, 3.8)
    numbers = {}
    for drive, (colour, dash) in zip(drives, howard2012.LOOKS):
        believed, true = drive.believed_distances(), drive.true_distances()
        axes.plot(*howard2012.curve(drive.time_s, believed), color=colour, linestyle=dash,
                  label=f"{drive.name}, as recorded", zorder=4)
        axes.plot(*howard2012.curve(drive.time_s, true), color=colour, linewidth=0.6, zorder=3)
        numbers[drive.name] = {"time_s": drive.time_s, "believed_m": believed, "true_m": true,
                               "within_s": drive.time_within_s(believed),
                               "truly_within_s": drive.time_within_s(true)}
    axes.axhline(howard2012.WITHIN_M, color=style.GREY, linewidth=0.8, zorder=1)
    axes.set(xlabel="time (s)", ylabel="distance to the goal (m)", xlim=(0.0, None), ylim=(0.0, None))
    axes.legend(fontsize=8)
    return Drawn(figure, _caption(numbers, options.trial), numbers)


def _caption(numbers, trial):
    times = "; ".join(f"{name}: {howard2012.seconds(each['within_s'])} as recorded, "
                      f"{howard2012.seconds(each['truly_within_s'])} in truth" for name, each in numbers.items())
    return (f"Distance to the goal over time in the manner of Howard 2012, figure 7: trial {trial}. Thick: by "
            "the rover's own position and the goal that it was told; thin, of the same colour: the true "
            f"distance. Grey: {howard2012.WITHIN_M} m, to which the published times count. First within it: "
            f"{times}. Published, of one drive each: 287.58 s (CSOD) and 231.97 s (CSAD).")


FIGURES = (Figure(name="howard2012-7", title="distance to the goal over time, by navigator",
                   runs=howard2012.RUNS, accepts=howard2012.ACCEPTS, draw=draw,
                   defaults=howard2012.DEFAULTS),)
