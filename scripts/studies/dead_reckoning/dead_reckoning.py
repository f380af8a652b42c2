#!/usr/bin/env python3
"""Figure 5 of Matthies 1995 backwards: what twenty runs of 7 m can tell of dead reckoning on sand.

Reads runs of scenarios/pathfinder/level_sand.json that kept their courses (--traces all), cuts them into sets of twenty, estimates slopes of the error variance of every set as section 5
does, and says where the printed slopes (0.70 deg2/m, 0.0039 m2/m) lie among them. Then, without any
run: whether an error of the odometer's scale that a run keeps could be told from noise a metre, and how
likely footnote 4's largest error of +10 % is. Writes dead_reckoning.csv (a row a set) and
dead_reckoning.md.

    rockyard run scenarios/pathfinder/level_sand.json --trials 2000 --seed 24 --traces all \\
      --trace-format csv --out results/runs/sand/level
    scripts/studies/dead_reckoning/dead_reckoning.py results/runs/sand/level

With two further runs, up and down a course (--set terrain.ground.slope_deg=1, and
terrain.ground.slope_direction_deg=180 for down; 500 trials, seeds 25 and 26), sets of ten and ten of
these are added: "ten runs each direction up and down the course".
"""

import math
import random
import sys
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402
from study import rates, ry  # noqa: E402
from dead_reckoning import sand_slopes  # noqa: E402

PUBLISHED = (0.70, 0.0039)  # section 5: deg2/m, m2/m
NAMES = ("heading (deg2/m)", "distance (m2/m)")
LENGTH_M = 7.0
LEAST, MODE, MOST = -0.04, 0.002, 0.10  # footnote 4: errors in distance of the twenty runs
ROUNDING = 0.005                        # of the printed per cent
ALPHA = 0.05
SCALE_SHARES = (0.0, 0.25, 0.5, 0.75, 0.9)


def any_of(chance, n=sand_slopes.RUNS):
    """That at least one of n independent events happens."""
    return -math.expm1(n * math.log1p(-chance))


def linear_deviation(slope=PUBLISHED[1], length_m=LENGTH_M):
    """Standard deviation of the relative error at the end if the variance is slope x distance."""
    return math.sqrt(slope * length_m) / length_m


def fitted_scale(slope=PUBLISHED[1], length_m=LENGTH_M):
    """Standard deviation c of a scale error whose variance (c x)^2 has that slope when y = b x is
    fitted to it over 0 .. length: b = c^2 (integral of x^3) / (integral of x^2) = 3/4 c^2 length."""
    return math.sqrt(slope / (0.75 * length_m))


def largest_chances(deviation):
    """That the largest of twenty normal errors about the mode reaches what rounds to the printed
    10 %, and the smallest what rounds to -4 %."""
    normal_tail = lambda z: 0.5 * math.erfc(z / math.sqrt(2.0))
    return (any_of(normal_tail((MOST - ROUNDING - MODE) / deviation)),
            any_of(normal_tail((MODE - LEAST - ROUNDING) / deviation)))


def heavy_tail_chance(deviation, freedom):
    """The same of the largest for Student's t of that standard deviation; freedom > 2."""
    unit = math.sqrt(freedom / (freedom - 2.0))
    return any_of(rates.student_tail((MOST - ROUNDING - MODE) / deviation * unit, freedom))


def grubbs_p(largest, n=sand_slopes.RUNS):
    """Upper bound of the chance that the largest of n normal errors, whatever their law's mean and
    variance, lies `largest` sample standard deviations or more above the sample's mean (Grubbs 1950)."""
    room = (n - 1) ** 2 - n * largest ** 2
    if room <= 0.0:
        return 0.0
    return min(1.0, n * rates.student_tail(largest * math.sqrt(n * (n - 2) / room), n - 2))


def largest_of_footnote(deviation, n=sand_slopes.RUNS):
    """Sample deviations from the sample's mean to the largest error; all but both extremes at the mode."""
    mean = (LEAST + MOST + (n - 2) * MODE) / n
    return (MOST - ROUNDING - mean) / deviation


def share_of_extremes(deviation, n=sand_slopes.RUNS):
    """Share of the sample's variance that the two extremes alone make, all others at the mode."""
    extremes = (LEAST + ROUNDING, MOST - ROUNDING)
    mean = (sum(extremes) + (n - 2) * MODE) / n
    squares = sum((value - mean) ** 2 for value in extremes) + (n - 2) * (MODE - mean) ** 2
    return squares / (n - 1) / deviation ** 2


def halves(share, rng, n=sand_slopes.RUNS):
    """Distance errors of n runs at half their way and at its end, of unit variance at the end, of
    which `share` is a scale error that the run keeps and the rest noise a metre."""
    noise, scale = math.sqrt(0.5 * (1.0 - share)), math.sqrt(share)
    runs = []
    for _ in range(n):
        kept = 0.5 * scale * rng.gauss(0.0, 1.0)
        first = kept + noise * rng.gauss(0.0, 1.0)
        runs.append((first, first + kept + noise * rng.gauss(0.0, 1.0)))
    return runs


def variance_ratio(runs):
    """Variance at the end over that at half the way: 2 for noise a metre, 4 for a scale error."""
    def variance(values):
        mean = sum(values) / len(values)
        return sum((value - mean) ** 2 for value in values)
    return variance([end for _, end in runs]) / variance([middle for middle, _ in runs])


def halves_correlation(runs):
    """Of the errors of both halves: 0 for noise a metre, 1 for a scale error."""
    first = [middle for middle, _ in runs]
    second = [end - middle for middle, end in runs]
    mean_1, mean_2 = sum(first) / len(first), sum(second) / len(second)
    cross = sum((a - mean_1) * (b - mean_2) for a, b in zip(first, second))
    return cross / math.sqrt(sum((a - mean_1) ** 2 for a in first) * sum((b - mean_2) ** 2 for b in second))


def powers(replicates, seed):
    """Of a one-sided test of 5 % for a scale error, by each statistic and share: lists."""
    result = {}
    for name, statistic in (("variances", variance_ratio), ("courses", halves_correlation)):
        rng = random.Random(seed)
        null = sorted(statistic(halves(0.0, rng)) for _ in range(replicates))
        limit = null[math.ceil((1.0 - ALPHA) * replicates) - 1]
        result[name] = []
        for share in SCALE_SHARES:
            found = sum(statistic(halves(share, rng)) > limit for _ in range(replicates))
            result[name].append((found / replicates, *rates.wilson_interval(found, replicates)))
    return result


def sets_of(courses, size=sand_slopes.RUNS):
    """Sets of `size` courses, one after the other; what is left over is left out."""
    return [courses[i:i + size] for i in range(0, len(courses) - size + 1, size)]


def slopes_of(courses):
    """Slopes of one set, of heading and distance: through the origin, with a free line, exponent."""
    return [(sand_slopes.slope_through_origin(values), sand_slopes.slope_free(values),
             sand_slopes.exponent(values))
            for values in (sand_slopes.variances(courses, which) for which in (0, 1))]


def middle(values, digits, of_sets):
    """Mean with its interval, and what holds 95 % of the sets."""
    low, high = (rates.quantile(values, share) for share in (0.025, 0.975))
    return study.with_interval(rates.mean(values), digits), f"{low:.{of_sets}f} .. {high:.{of_sets}f}"


def slope_rows(name, slopes):
    """Rows of the table for the sets of one campaign."""
    rows = []
    for which in (0, 1):
        for fit, label in ((0, "through the origin"), (1, "free line")):
            values = [each[which][fit] for each in slopes]
            below = sum(value < PUBLISHED[which] for value in values)
            rows.append([name, NAMES[which], label, f"{len(values)}", *middle(values, 5, 4),
                         f"{100.0 * below / len(values):.0f} %"])
    return rows


def exponent_rows(name, slopes):
    rows = []
    for which, label in ((0, "heading"), (1, "distance")):
        values = [each[which][2] for each in slopes]
        rows.append([name, label, *middle(values, 2, 2),
                     f"{100.0 * sum(value > 1.5 for value in values) / len(values):.0f} %"])
    return rows


def footnote_rows():
    laws = [("noise a metre, 0.0039 m2/m", linear_deviation()),
            ("scale error, the same slope fitted", fitted_scale())]
    rows = []
    for name, deviation in laws:
        most, least = largest_chances(deviation)
        tails = [f"{heavy_tail_chance(deviation, freedom):.4f}" for freedom in (3, 4, 6)]
        p_value = grubbs_p(largest_of_footnote(deviation))
        rows.append([name, f"{100.0 * deviation:.2f} %", f"{most:.5f}", f"{least:.2f}", *tails,
                     f"{100.0 * share_of_extremes(deviation):.0f} %", f"{p_value:.1e}"])
    return rows


def ratio_quantiles(replicates, seed, shares=(0.5, 0.95, 0.99)):
    """Quantiles of the variance at the end over that at half the way, of noise a metre alone."""
    rng = random.Random(seed)
    ratios = [variance_ratio(halves(0.0, rng)) for _ in range(replicates)]
    return [rates.quantile(ratios, share) for share in shares]


def power_rows(replicates, seed):
    found = powers(replicates, seed)
    return [[f"{share:g}", *(study.with_interval(found[name][index], 3) for name in found)]
            for index, share in enumerate(SCALE_SHARES)]


def campaigns(runs):
    """(name, sets of twenty) of each campaign."""
    courses = [sand_slopes.read_courses(run) for run in runs]
    result = [("level", sets_of(courses[0]))]
    if len(courses) == 3:
        up, down = (sets_of(each, sand_slopes.RUNS // 2) for each in courses[1:])
        result.append(("up and down", [a + b for a, b in zip(up, down)]))
        result.append(("up", sets_of(courses[1])))
    return result


def page(measured, replicates, seed):
    slopes = [row for name, slopes in measured for row in slope_rows(name, slopes)]
    exponents = [row for name, slopes in measured for row in exponent_rows(name, slopes)]
    return "\n\n".join([
        "Slopes over sets of twenty runs; the last column is the share of sets below the printed slope.",
        study.table(["runs", "variance of", "fit", "sets", "mean (95 %)", "95 % of the sets",
                     "below the printed"], slopes),
        "Exponents p of a variance that grows as distance^p; 1 is noise a metre, 2 a scale error.",
        study.table(["runs", "of", "mean (95 %)", "95 % of the sets", "sets above 1.5"], exponents),
        f"Power of a test of {100 * ALPHA:.0f} % with twenty runs, by the share of the variance at the end "
        "that is a scale error: from variances at half the way and its end, as figure 5 has them, and "
        "from the courses of both halves of every run.",
        study.table(["share", "by variances", "by courses"], power_rows(replicates, seed)),
        "Of noise a metre alone the variance at the end is {:.2f} times that at half the way in the middle of "
        "all sets, and more than {:.2f} and {:.2f} times in 5 and 1 % of them.".format(
            *ratio_quantiles(replicates, seed)),
        "Footnote 4: chances that the largest of twenty errors rounds to +10 % or more, and the smallest "
        "to -4 % or less, about the mode of 0.2 %.",
        study.table(["law", "deviation at 7 m", "largest, normal", "smallest, normal", "largest, t3",
                     "largest, t4", "largest, t6", "variance of the two extremes", "Grubbs p"],
                    footnote_rows())])


def main():
    parser = study.argument_parser(__doc__)
    parser.add_argument("runs", nargs="+", type=Path, metavar="RUN")
    parser.add_argument("--replicates", type=int, default=20000, help="of the powers (20000)")
    parser.add_argument("--seed", type=int, default=24, help="of the powers (24)")
    parser.add_argument("--out", type=Path, default=study.ROOT / "results/studies")
    args = parser.parse_args()
    if len(args.runs) not in (1, 3):
        parser.error("give one run, or three: level, up, down")
    runs = [ry.Run(path) for path in args.runs]
    measured = [(name, [slopes_of(each) for each in sets]) for name, sets in campaigns(runs)]
    if not all(slopes for _, slopes in measured):
        parser.error("a run has fewer than twenty courses: make it with --traces all")
    study.write_csv(args.out / "dead_reckoning.csv",
                    [{"runs": name, "set": number,
                      **{f"{what}_{fit}": f"{value:.6g}"
                         for what, values in zip(("heading", "distance"), of_set)
                         for fit, value in zip(("origin", "free", "exponent"), values)}}
                     for name, slopes in measured for number, of_set in enumerate(slopes)])
    text = page(measured, args.replicates, args.seed)
    made = study.made_by(runs).removeprefix("made ")
    head = ("# Dead reckoning on sand: what twenty runs can tell\n\nMatthies 1995, section 5, figure 5 and "
            f"footnote 4. Made by `scripts/studies/dead_reckoning/dead_reckoning.py`; runs {made}, made as "
            "the first lines of the script say.\n\n")
    (args.out / "dead_reckoning.md").write_text(head + text + "\n", encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
