#!/usr/bin/env python3
"""What computers make of a rover's speed: closed forms (model.py) of the times that the program has.

Reads results/studies/compute_times.csv (target compute_times_study) and visual_odometry.csv. Tables:
  mer_speeds     published speeds with what the closed form makes of them
  computers      metres per hour by computer and navigator, for a rover of 7 cm/s with fast cameras
  cameras        the same with the cameras of the Athena SDM, and MER's rover
  smart_lander   what the Smart Lander wished (Goldberg 2002 section 6), and who meets it
Writes rover_speed.csv and rover_speed.svg.

    scripts/studies/rover_speed/rover_speed.py [--out FOLDER] [--markdown results/speed.md]
"""

import math
import sys
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402
from rover_speed import figure  # noqa: E402
from rover_speed import model  # noqa: E402

# Navigator, sensor, estimator, and what the tables call them.
COMBINATIONS = (
    ("blind", "stereo", "wheels", "blind, wheels"),
    ("blind", "stereo", "vision", "blind, vision"),
    ("stop", "stripe", "wheels", "light stripe, stops, wheels"),
    ("stop", "stereo", "wheels", "stereo, stops, wheels"),
    ("stop", "stereo", "vision", "stereo, stops, vision"),
    ("csod", "stereo", "wheels", "CSOD, wheels"),
    ("csod", "stereo", "vision", "CSOD, vision"),
    ("csad", "stereo", "wheels", "CSAD, wheels"),
    ("csad", "stereo", "vision", "CSAD, vision"),
)
SETTINGS = (  # of the CSV and the tables
    ("MER, slow cameras", model.MER, model.SLOW_CAMERAS),
    ("7 cm/s, slow cameras", model.ATHENA, model.SLOW_CAMERAS),
    ("7 cm/s, fast cameras", model.ATHENA, model.FAST_CAMERAS),
)
MER, ATHENA = model.COMPUTERS[0], model.COMPUTERS[5]

WISH_M, WISH_S, WISH_SHARE = 675.0, 3 * 3600.0, 0.03  # Goldberg 2002 section 6
WISH_M_S = WISH_M / WISH_S

# MFEX's and Rocky 3.2's steps (Matthies 1995 section 6): 0.67 cm/s, scans of 20 s, no map.
STRIPE_ROVER = model.Rover(0.0067, model.STRIPE_STEP_M, 1.0)


def show(span):
    return f"{span.value:.3g} ({span.low:.3g}..{span.high:.3g})"


PRINTED = 0.025  # half of the last of two printed digits, 0.22 cm/s


def verdict(published, span):
    """Whether a published speed lies within what is known, or is the closed form where nothing is assumed."""
    if span.low == span.high and abs(span.value / published - 1.0) < PRINTED:
        return "holds"
    return "in range" if span.low <= published <= span.high else "differs"


def lines_of(rows):
    """One line of the CSV for each setting, computer and combination."""
    for setting, case, cameras in SETTINGS:
        for computer in model.COMPUTERS:
            for navigator, sensor, estimator, _ in COMBINATIONS:
                span = model.speed_range(case, rows, computer, cameras, navigator, sensor, estimator)
                yield {"setting": setting, "computer": computer.profile, "navigator": navigator, "sensor": sensor,
                       "estimator": estimator, "m_per_h": round(span.value, 3), "low": round(span.low, 3),
                       "high": round(span.high, 3)}


def published_speeds(rows):
    """(what, m/h, place, closed form, taken for granted) of each published speed."""
    def mer(navigator, estimator):
        return model.speed_range(model.MER, rows, MER, model.SLOW_CAMERAS, navigator, "stereo", estimator)

    def athena(navigator):
        return model.speed_range(model.ATHENA, rows, ATHENA, model.FAST_CAMERAS, navigator, "stereo", "vision")
    stripe = model.M_PER_H * model.speed(STRIPE_ROVER, model.Times(0, 0, 0, 0), "stop", "stripe")
    return (
        ("MER, blind", 124.0, "Howard 2012 sec. 1", mer("blind", "wheels"),
         "3.7 cm/s (3.7 to 5) of the wheels, nothing at rest (7.4 s a move of 35 cm)"),
        ("MER, AutoNav by wheels", 36.0, "Howard 2012 sec. 1", mer("stop", "wheels"),
         "a look each 75 cm (35 to 75): images 8.97 s (0.5 to 10), stereo 27 s (24 to 30), map 6.6 s (to 21)"),
        ("MER, visual odometry without AutoNav", 10.0, "Howard 2012 sec. 1", mer("blind", "vision"),
         "a pose each 75 cm (60 to 75): images as above, 160 s (120 to 180)"),
        ("MER, both", None, "\"rarely been used\"", mer("stop", "vision"), "both of the above, one after the other"),
        ("MFEX, light stripe", 7.92, "Matthies 1995 sec. 6: 0.22 cm/s", model.Range(stripe, stripe, stripe),
         "a scan of 20 s each 6.5 cm, 0.67 cm/s; printed with two digits"),
        ("Athena 2012, CSOD", 186.8, "Howard 2012 sec. 3: 5.19 cm/s", athena("csod"),
         "7 cm/s, motions of 75 cm (35 to 75), 0.7 s at rest to steer (0.2 to 1.7), Virtex 5's times"),
        ("Athena 2012, CSAD", 231.8, "Howard 2012 sec. 3: 6.44 cm/s", athena("csad"),
         "7 cm/s throughout: curves are not slower"),
    )


def mer_speeds(rows):
    header = ["drive", "published, m/h", "place", "closed form, m/h", "published over it", "verdict",
              "takes for granted"]
    return study.table(header, [
        [what, *(("-", place, show(span), "-", "-") if speed is None else
                 (f"{speed:.4g}", place, show(span), f"{speed / span.value:.2f}", verdict(speed, span))), granted]
        for what, speed, place, span, granted in published_speeds(rows)])


def speeds_table(rows, settings, combinations):
    header = ["rover and cameras", "computer", *(name for *_, name in combinations)]
    return study.table(header, [
        [setting, computer.name,
         *(show(model.speed_range(case, rows, computer, cameras, *which)) for *which, _ in combinations)]
        for setting, case, cameras in settings for computer in model.COMPUTERS])


def computers(rows):
    return speeds_table(rows, SETTINGS[2:], COMBINATIONS)


def cameras(rows):
    shown = [combination for combination in COMBINATIONS if combination[:3] in (
        ("blind", "stereo", "vision"), ("stop", "stereo", "wheels"), ("stop", "stereo", "vision"),
        ("csad", "stereo", "wheels"), ("csad", "stereo", "vision"))]
    return speeds_table(rows, SETTINGS[:2], shown)


def meets(span_m_h):
    """Who meets the wish: always, by what is most likely, only where all is fast, or never."""
    wish = model.M_PER_H * WISH_M_S
    for name, value in (("yes", span_m_h.low), ("by the middle", span_m_h.value), ("where all is fast", span_m_h.high)):
        if value >= wish:
            return name
    return "no"


def smart_lander(rows):
    header = ["computer", "cameras", "stops, vision: wheels needed, cm/s", "CSAD, vision: wheels needed, cm/s",
              "CSAD, vision at 7 cm/s, m/h", "675 m in 3 h?", "by wheels alone, m/h"]
    lines = []
    for computer in model.COMPUTERS:
        for name, cameras_ in (("slow", model.SLOW_CAMERAS), ("fast", model.FAST_CAMERAS)):
            times = model.times_of(rows, computer, cameras_)
            needed = [model.wheels_for(model.ATHENA.middle, times, WISH_M_S, navigator, estimator="vision")
                      for navigator in ("stop", "csad")]
            span, wheels = (model.speed_range(model.ATHENA, rows, computer, cameras_, "csad", "stereo", estimator)
                            for estimator in ("vision", "wheels"))
            lines.append([computer.name, name,
                          *("none" if math.isinf(speed) else f"{100 * speed:.3g}" for speed in needed),
                          show(span), meets(span), show(wheels)])
    return study.table(header, lines)


def position_shares(path):
    """Error of the end over the way, median and 95 %, by (terrain, localization): rows of visual_odometry.csv."""
    return {(row["terrain"], row["localization"]):
            tuple(float(row[name]) / float(row["way_m"]) for name in ("error_median_m", "error_95_m"))
            for row in study.read_csv(path)}


def position(shares):
    header = ["terrain", "localization", "error over way, %: median", "95 %", "3 %?"]
    return study.table(header, [
        [terrain, localization, f"{100 * median:.2g}", f"{100 * most:.2g}",
         "yes" if most <= WISH_SHARE else "half of the drives" if median <= WISH_SHARE else "no"]
        for (terrain, localization), (median, most) in shares.items() if localization != "both"])


SERIES = (
    (figure.Series("stops to look, knows its place by its wheels", "#1b6ca8"), ("stop", "stereo", "wheels")),
    (figure.Series("stops to look, sees itself move (visual odometry)", "#8e5ea2"), ("stop", "stereo", "vision")),
    (figure.Series("drives on while it computes, stops to steer (CSOD), visual odometry", "#d98200"),
     ("csod", "stereo", "vision")),
    (figure.Series("drives on and steers as it drives (CSAD), visual odometry", "#2e8b57"), ("csad", "stereo", "vision")),
)


def draw(rows):
    def panel(title, case, cameras_, shown, lines):
        return figure.Panel(title, tuple(
            (computer.name, tuple(model.speed_range(case, rows, computer, cameras_, *which) for _, which in SERIES))
            for computer in shown), lines)
    panels = (
        panel("MER's rover: wheels of 3.7 cm/s, cameras that take 9 s a pair", model.MER, model.SLOW_CAMERAS,
              model.COMPUTERS[:4], ((10, "MER drove 10"), (36, "36 with AutoNav"), (124, "124 blind"))),
        panel("A rover of 7 cm/s with cameras of 10 Hz", model.ATHENA, model.FAST_CAMERAS, model.COMPUTERS,
              ((model.M_PER_H * WISH_M_S, "225: Smart Lander's wish"),)),
    )
    foot = ("Dots: closed form; bars: everything slow to everything fast (results/speed.md). Dashed: published.",
            "MER's 10 are with visual odometry and without AutoNav. No rocks, slip or upsets: what computer and cameras leave at most.")
    return figure.draw(panels, [one for one, _ in SERIES], foot)


TABLES = {"mer_speeds": mer_speeds, "computers": computers, "cameras": cameras, "smart_lander": smart_lander}


def main():
    parser = study.argument_parser(__doc__)
    parser.add_argument("--out", type=Path, default=study.ROOT / "results/studies")
    study.add_page(parser)
    args = parser.parse_args()
    rows = model.read_times(study.ROOT / "results/studies/compute_times.csv")
    study.write_csv(args.out / "rover_speed.csv", list(lines_of(rows)))
    (args.out / "rover_speed.svg").write_text(draw(rows), encoding="utf-8")
    shares = position_shares(study.ROOT / "results/studies/visual_odometry.csv")
    study.show(args, {name: make(rows) for name, make in TABLES.items()} | {"position": position(shares)})


if __name__ == "__main__":
    main()
