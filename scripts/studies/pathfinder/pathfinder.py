#!/usr/bin/env python3
"""Runs what the tables of README.md and of the pages in results/ report and writes them anew.

Each table stands between two comments, <!-- begin NAME --> and <!-- end NAME -->. Runs that are there
already are taken as they are, so that this can be stopped and started again; delete the folder after
a change of the code. The whole takes some fifteen minutes of processor time.

    scripts/studies/pathfinder/pathfinder.py [--out results/runs/readme] [--tables comparison,causes,...]
"""

import functools
import json
import resource
import shutil
import sys
import time
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study as shared  # noqa: E402
from study import ROOT, ry, table  # noqa: E402
from calibrations.calibrate_odometer import calibrate  # noqa: E402
from navigator import navigator  # noqa: E402

REFERENCE = ROOT / "results/reference/matthies1995.json"
HAZARD_REFERENCE = ROOT / "results/reference/matthies1995_hazard_detection.json"
MISSION_REFERENCE = ROOT / "results/reference/matthies1995_mission.json"
SCENARIOS = ROOT / "scenarios"
PUBLISHED = ["obstacles_0.28", "obstacles_0.57", "obstacles_0.85", "nominal",
             "nominal_perfect_localization", "level_sand"]

# What nobody has measured.
UNMEASURED = ["obstacles_0.65", "obstacles_2.0", "vl2", "mfex_nominal", "mfex_vl2"]

# What the table of causes changes: name, settings, scenarios.
BOTH = ["nominal", "obstacles_0.85"]
FLAT_ROCKS = ["terrain.rocks.min_height_ratio=0.4", "terrain.rocks.max_height_ratio=0.9"]
BLIND = ["perception.hazard.enabled=false"]
CAUSES = [
    ("blind", "hazard sensing off", BLIND, BOTH),
    ("each_scan", "turn direction decided at each scan",
     ["navigation.pathfinder.turn_direction=each_scan"], BOTH),
    ("moving", "two-scan rule: consecutive scans of the moving rover",
     ["perception.hazard.agreement=consecutive_moving"], BOTH),
    ("threshold_3", "hazard threshold 3 cm", ["perception.hazard.neighbour_threshold_m=0.03"], BOTH),
    ("threshold_13", "hazard threshold 13 cm",
     ["perception.hazard.neighbour_threshold_m=0.13"], BOTH),
    ("oracle", "perfect localization", ["localization.estimator=oracle"], BOTH),
    ("no_inputs", "without the two published inputs (turn scale, scrape jumps)",
     ["sensors.gyro.scale=1", "sensors.gyro.scrape.enabled=false"], BOTH),
    ("stiff_sand", "sand twice as stiff in shear (K 2 mm), odometer calibrated on it",
     ["terrain.ground.soil.shear_modulus_m=0.002"], BOTH),
    ("hard_ground", "hard ground: no slip, no sinkage, odometer calibrated on it",
     ["terrain.ground.soil.preset=hard_ground"], BOTH),
    ("flat_rocks", "flatter rocks (height ratio 0.4 to 0.9)", FLAT_ROCKS, ["obstacles_0.85"]),
    ("flat_rocks_blind", "flatter rocks, hazard sensing off", FLAT_ROCKS + BLIND,
     ["obstacles_0.85"]),
]
# Causes that change the soil, on which the odometer is calibrated.
SOILS = {"stiff_sand", "hard_ground"}
FIDELITY = ["obstacles_0.28", "obstacles_0.85", "nominal", "vl2"]
# Drives with a map: name of the run, scenario, settings, words.
ORACLE = (["localization.estimator=oracle"], "the same, perfect localization")
GESTALT = [
    ("narrow", "gestalt_narrow_course", [], "narrow_course, 5 m"),
    ("vl2", "gestalt_viking_lander_2", [], "viking_lander_2, 17.5 m"),
    ("vl2_oracle", "gestalt_viking_lander_2", *ORACLE),
    ("error", "gestalt_localization_error", [], "localization_error, 7.6 m nominal"),
    ("error_oracle", "gestalt_localization_error", *ORACLE),
]
TABLE_3_STEPS = {
    "BM_Step<FitPlanes<false>>": "fit planes",
    "BM_Step<FitPlanes<true>>": "fit planes, with their slopes",
    "BM_Step<Hazards>": "traversability analysis",
    "BM_Step<PathVotes>": "path votes",
    "BM_Cycle": "a whole cycle of the map, 16384 points",
}
MEANS = ("first", "second", "difference", "low", "high")
QUASI_STATIC = ["rover.fidelity=quasi_static"]
# Rows of the first page, by their id in the references.
EXCERPT = {
    "obstacles_0.85.success": "arrivals, 0.85 rocks per m2",
    "nominal.success": "arrivals, nominal terrain",
    "nominal.hazards_begun": "hazards met a metre",
    "nominal.distance.mode": "most frequent distance (m)",
    "missed.nominal": "share of hazards missed",
}
VERDICTS = ("agrees", "holds", "differs", "underpowered", "not judged")


class Study:
    """Runs scenarios once each and remembers what they cost."""

    def __init__(self, rockyard, benchmark, out):
        self.rockyard, self.benchmark, self.out = rockyard, benchmark, out

    def run(self, name, scenario, trials=None, settings=()):
        """A run, of the scenario's own number of trials where none is given; `cpu_s` is added to it."""
        folder = self.out / name / scenario
        cost = folder / "cpu_seconds"
        if not cost.exists():
            print(f"{name}/{scenario}", file=sys.stderr)
            before = cpu_seconds()
            self.tool("run", scenario_file(scenario), "--threads", 1, "--out", folder, "--quiet", "--force",
                      *(["--trials", trials] if trials else []), *shared.settings(settings))
            cost.write_text(str(cpu_seconds() - before), encoding="utf-8")
        run = ry.Run(folder)
        run.cpu_s = float(cost.read_text(encoding="utf-8"))
        return run

    def published(self):
        return {name: self.run("published", name, 300) for name in PUBLISHED}

    def swept(self, name, trials):
        """What `rockyard sweep` prints of scenarios/sweeps/NAME.json; its folder keeps the files."""
        text = self.tool("sweep", SCENARIOS / "sweeps" / f"{name}.json", "--trials", trials,
                         "--out", self.out / "sweeps" / name, "--resume", "--force")
        return quoted(text.rsplit("  results in ", 1)[0])

    def tool(self, *arguments):
        # A comparison may differ or be inconclusive.
        return shared.called([self.rockyard, *arguments], codes=(0, 1, 4)).stdout


def quoted(text):
    return f"```\n{text.strip()}\n```"


def scenario_file(name):
    """The scenario file whose member "name" it is."""
    for path in sorted(SCENARIOS.rglob("*.json")):
        if json.loads(path.read_text(encoding="utf-8")).get("name") == name:
            return path
    sys.exit(f"{SCENARIOS} has no scenario {name}")


def cpu_seconds():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def percent(rate):
    return f"{100 * rate.rate:.0f} % ({100 * rate.low:.0f}..{100 * rate.high:.0f})"


def trials_per_second(run):
    return f"{run.summary['trials']['completed'] / run.cpu_s:.3g}"


def comparison(study):
    study.published()
    return quoted(study.tool("check", study.out / "published", "--against", REFERENCE))


def comparison_excerpt(study):
    """Five numbers for the first page, of each verdict some; whole tables stand on pages of their own."""
    study.published()
    found = {row["id"]: row for runs, file in ((study.out / "published", REFERENCE),
                                               (hazard_runs(study), HAZARD_REFERENCE))
             for row in checked(study, runs, file)}
    return table(["Matthies 1995", "published", "simulated (95 %)", "verdict"],
                 [[words, *excerpt(found[name]), found[name]["verdict"]] for name, words in EXCERPT.items()])


def excerpt(row):
    """What was published and what is predicted; of successes in as many runs."""
    published, median, low, high = (f"{float(row[key]):.3g}" for key in (
        "published", "predicted_median", "predicted_low", "predicted_high"))
    runs = f" of {row['published_runs']}" if row["unit"] == "runs" else ""
    return published + runs, f"{median} ({low} to {high})"


def first_answer(study):
    """The lines of the first command of README that tell how often the rover arrived."""
    folder = study.out / "first"
    text = study.tool("run", "nominal", "--trials", 40, "--out", folder, "--resume", "--force")
    return "```text\n" + "\n".join(line for line in text.splitlines() if " success  " in line) + "\n```"


def hazards(study):
    return quoted(study.tool("check", hazard_runs(study), "--against", HAZARD_REFERENCE))


def hazard_runs(study):
    """Folder of the runs that the reference of hazard detection needs."""
    values = json.loads(HAZARD_REFERENCE.read_text(encoding="utf-8"))["values"]
    for name in sorted({value["scenario"] for value in values if value.get("scenario")}):
        study.run("hazards", name)
    return study.out / "hazards"


def checked(study, runs, reference_file):
    """Rows of a comparison with published values, without what is only shown beside them."""
    path = study.out / f"{reference_file.stem}.csv"
    study.tool("check", runs, "--against", reference_file, "--csv", path)
    return [row for row in shared.read_csv(path) if row["verdict"]]


def mission(study):
    """Arithmetic of the paper; the run is there because the command wants one, and says nothing."""
    study.run("hazards", "traverse_one_hour")
    return shared.listed(checked(study, study.out / "hazards/traverse_one_hour", MISSION_REFERENCE), {
        "computed, not simulated": "{what}", "place": "{place}", "published": lambda row: f"{float(row['published']):.4g}",
        "computed": lambda row: f"{float(row['simulated']):.4g}", "unit": lambda row: row["unit"] if row["unit"] != "1" else "",
        "verdict": "{verdict}"})


def verdicts(study):
    """How many rows of each verdict there are, by what the row can say of the simulation."""
    study.published()
    rows = []
    for runs, file, title in (
            (study.out / "published", REFERENCE, "trials"),
            (hazard_runs(study), HAZARD_REFERENCE, "hazard detection"),
            (study.out / "hazards/traverse_one_hour", MISSION_REFERENCE, "mission")):
        counts = {}
        for row in checked(study, runs, file):
            kind = row["role"] if row["scenario"] else "computed, not simulated"
            counts.setdefault(kind, dict.fromkeys(VERDICTS, 0))[row["verdict"]] += 1
        rows += [[f"{title}, {kind}", *map(str, found.values())] for kind, found in counts.items()]
    return table(["numbers of Matthies 1995", *VERDICTS], rows)


def reference(scenario, column, statistic):
    """The published number as printed; '-' where there is none."""
    values = json.loads(REFERENCE.read_text(encoding="utf-8"))["values"]
    wanted = scenario, column, statistic
    found = [value for value in values if (value["scenario"], value.get("column"), value["statistic"]) == wanted]
    return "/".join(str(found[0][key]) for key in ("value", "sample_size")[:1 + (statistic == "outcome_count")]) if found else "-"


def errors(study):
    settings = next(cause[2] for cause in CAUSES if cause[0] == "no_inputs")
    runs = [study.published()["nominal"], study.run("no_inputs", "nominal", 100, settings)]
    rows = []
    for column, name in (("heading_error_deg", "heading error (deg)"),
                         ("position_error_m", "position error (m)"),
                         ("distance_error_percent", "distance error (%)")):
        printed = [reference("nominal", column, statistic) for statistic in ("minimum", "mode", "median", "maximum")]
        found = [" / ".join(f"{run.summary['dead_reckoning'][column][part]:.2f}"
                            for part in ("min", "mode", "median", "max")) for run in runs]
        rows.append([name, " / ".join(printed), *found])
    return table(["nominal, min / mode / median / max", "published", "with both inputs (300)", "without (100)"], rows)


def corridor(study):
    """Rocks along the course against the law, by placement rule."""
    return quoted("\n\n".join(study.tool("terrain", scenario_file(name), "--density", "--fields", 4000).strip()
                              for name in ("nominal", "obstacles_0.57")))


def spread(study, scenario, metric):
    """5 and 95 % of the envelope; "-" where the scenario was not among its runs."""
    path = study.out.parent / "envelope/envelope.json"
    found = json.loads(path.read_text(encoding="utf-8"))["scenarios"] if path.exists() else {}
    if scenario not in found:
        return "-"
    values = found[scenario][metric]
    return f"{100 * values['p05']:.0f}..{100 * values['p95']:.0f}"


def unmeasured(study):
    """Predictions for cases that nobody has measured."""
    rows = []
    for scenario in UNMEASURED:
        run = study.run("unmeasured", scenario, 300)
        distance, begun = run.summary["distance_m"], run.counted["hazards_begun"].sum()
        rows.append([scenario, percent(run.declared_success), spread(study, scenario, "declared success rate"),
                     percent(run.true_success), spread(study, scenario, "true success rate"),
                     f"{distance['median']:.1f} ({distance['p05']:.1f}..{distance['p95']:.1f})",
                     f"{begun / run.counted['true_distance_m'].sum():.2f}", failures(run)])
    return table(["scenario, 300 trials", "declared success", "envelope (%)", "true success",
                  "envelope (%)", "distance, median (5..95 %) (m)", "avoidances begun a metre",
                  "failures"], rows)


def rocks_unknown(study):
    """Rates at Viking Lander 2 over what is not known of its rocks, and how far each unknown moves them."""
    study.swept("viking_lander_2", 250)
    sweep = ry.Sweep(study.out / "sweeps/viking_lander_2")
    cells, unknowns = sweep.cells, sweep.axes
    kinds = ["declared_success", "true_success"]
    rows = []
    for unknown in unknowns:
        for level, group in cells.groupby(unknown, sort=False):
            rows.append([unknown.replace("_", " "), level if isinstance(level, str) else f"{level:.2g}",
                         *(shares(group[kind]) for kind in kinds)])
    rows.append(["all", f"{len(cells)} cells", *(shares(cells[kind]) for kind in kinds)])
    return table(["unknown", "level", "declared success (%): mean, lowest and highest cell", "true success (%)"], rows)


def shares(rates):
    return f"{100 * rates.mean():.1f} ({100 * rates.min():.1f}..{100 * rates.max():.1f})"


def failures(run):
    return shared.ends(run, *shared.ARRIVED)


def causes(study):
    published = study.published()
    rows = [["as chosen (300 trials)", *(percent(published[scenario].declared_success) for scenario in BOTH)]]
    for name, text, settings, scenarios in CAUSES:
        if name in SOILS:
            found, _ = calibrate(study.rockyard, settings)
            settings = settings + [f"{path}={value}" for path, value in found.items()]
        rows.append([text, *(percent(study.run(name, scenario, 100, settings).declared_success)
                             if scenario in scenarios else "-" for scenario in BOTH)])
    return table(["change", "nominal", "0.85 per m2"], rows)


def mean_cells(row):
    """Both means and their difference; there is no interval where a few trials decide it."""
    a, b, difference, low, high = ("" if row[part] is None else f"{row[part]:.4g}" for part in MEANS)
    return a, b, f"{difference} ({low}..{high})" if low and high else f"{difference} (no interval)"


def fidelity(study):
    rows = []
    for scenario in FIDELITY:
        runs = [study.run("published" if scenario in PUBLISHED else "multibody", scenario, 300),
                study.run("quasi_static", scenario, 300, QUASI_STATIC)]
        success, means = shared.compare(*runs)
        points, low, high, _ = success["declared"]
        rows += [[f"**{scenario}**", "", "", ""],
                 ["declared success", *(percent(run.declared_success) for run in runs),
                  f"{points:+.1f} points ({low:+.1f}..{high:+.1f})"],
                 ["true success", *(percent(run.true_success) for run in runs), ""]]
        rows += [[text, *mean_cells(means["all", key])] for key, text in (
            ("true_distance_m", "distance (m)"), ("distance_error_percent", "distance error (%)"),
            ("heading_error_deg", "heading error (deg)"), ("position_error_m", "position error (m)"),
            ("scrapes", "scrapes"), ("max_tilt_deg", "largest tilt (deg)"))]
        rows.append(["trials per CPU-second", *(trials_per_second(run) for run in runs), ""])
    return table(["mean over 300 trials", "multibody", "quasi-static", "paired difference (95 %)"], rows)


def speed(study):
    return table(["scenario", "trials per CPU-second"],
                 [[name, trials_per_second(run)] for name, run in study.published().items()])


def published_metric(scenario, path):
    if path[0] == "declared_success":
        return reference(scenario, None, "outcome_count")
    column = "true_distance_m" if path[0] == "distance_m" else path[-2]
    return reference(scenario, column, {"min": "minimum", "max": "maximum"}.get(path[-1], path[-1]))


def envelope(study):
    """From the summary that scripts/studies/pathfinder/envelope.py leaves; None where it was not run."""
    path = study.out.parent / "envelope/envelope.json"
    if not path.exists():
        return None
    found = json.loads(path.read_text(encoding="utf-8"))
    chosen = study.published()
    rows = []
    for scenario, metrics in found["scenarios"].items():
        for name, metric in metrics.items():
            if scenario != "nominal" and "success" not in name:
                continue
            value = functools.reduce(dict.__getitem__, metric["path"], chosen[scenario].summary)
            rows.append([scenario, name, published_metric(scenario, metric["path"]), f"{value:.2f}",
                         *(f"{metric[part]:.2f}" for part in ("p05", "median", "p95"))])
    head = (f"{found['points']} points over {found['parameters']} assumed parameters, "
            f"{found['trials']} trials a point, {', '.join(found['held'])}\n\n")
    return head + table(["scenario", "prediction", "published", "chosen", "envelope 5 %", "median", "95 %"], rows)


def gestalt(study):
    """The two drives of Goldberg 2002, their failures and distances, and what localization does."""
    rows = []
    for name, scenario, settings, words in GESTALT:
        run = study.run("gestalt_" + name, scenario, 500, settings)
        distance, speed = run.summary["distance_m"], run.summary["columns"]["net_rate_m_s"]
        # Turns in place are among the moves.
        images, moves, reversals = (run.counted[column].sum() for column in ("image_sets", "moves", "reversals"))
        rows.append([words, percent(run.declared_success), percent(run.true_success), failures(run),
                     " / ".join(f"{distance[key]:.1f}" for key in ("min", "median", "p95", "max")),
                     f"{100.0 * speed['median']:.2f}", f"{images / moves:.2f}", f"{100.0 * reversals / moves:.0f}",
                     trials_per_second(run)])
    return table(["500 trials", "declared success", "true success", "failures",
                  "distance, min / median / 95 % / max (m)", "median speed (cm/s)",
                  "image sets a move", "moves the other way (%)", "trials per CPU-second"], rows)


def navigators(study):
    """Both navigators over abundance, from the study that scripts/studies/navigator/navigator.py left."""
    runs = {(row["rover"], row["k_per_m2"], row["arm"]): row for row in shared.read_csv(ROOT / "results/studies/navigators.csv")}
    rows = []
    for row in shared.read_csv(ROOT / "results/studies/navigators_pairs.csv"):
        if (row["first"], row["second"]) != navigator.MAIN:
            continue
        both = [runs[row["rover"], row["k_per_m2"], arm] for arm in navigator.MAIN]
        points, low, high = (float(row[f"true_{part}"]) for part in ("points", "low", "high"))
        rows.append([row["rover"], row["k_per_m2"],
                     *(f"{100 * float(run['declared']):.0f} / {100 * float(run['true']):.0f}" for run in both),
                     f"{points:+.0f} ({low:+.0f}..{high:+.0f})", f"{float(row['true_holm']):.2g}",
                     paired_mean(row, "all", "true_distance_m", 1.0, 1),
                     paired_mean(row, "arrived", "true_distance_m", 1.0, 1),
                     paired_mean(row, "all", "active_time_s", 1.0 / 60.0, 0),
                     paired_mean(row, "all", "active_energy_wh", 1.0, 1)])
    return table(["rover", "k (1/m2)", "behaviour: declared / true (%)",
                  "GESTALT: declared / true (%)", "difference of true success (points)", "Holm p",
                  "distance (m)", "the same where both arrived", "time (min)", "energy (Wh)"], rows)


def paired_mean(row, trials, column, scale, digits):
    text = navigator.mean_difference(row, trials, column, digits, scale)
    return text if trials == "all" else f"{text}, n {float(row[f'{trials}_{column}_n']):.0f}"


def navigator_speed(study):
    """Trials per CPU-second of both navigators among the same rocks, 20 and 200 trials."""
    rows = []
    for name, scenario in (("behaviour, light stripe", "gestalt_abundance_behaviour"),
                           ("GESTALT, stereo", "gestalt_abundance")):
        slow = study.run("multibody_speed", scenario, 20, ["rover.fidelity=multibody"])
        fast = study.run("quasi_static_speed", scenario, 200)
        rows.append([name, trials_per_second(slow), trials_per_second(fast)])
    return table(["Athena SDM, 7.6 m of nominal terrain, one core", "multibody", "quasi-static"], rows)


def table_3(study):
    """Steps of GESTALT beside table 3 of Goldberg 2002; None where the benchmark is not built."""
    if not study.benchmark.exists():
        return None
    rows = []
    steps = f"--benchmark_filter=^({'|'.join(TABLE_3_STEPS)})(/|$)"
    for result in json.loads(shared.run([study.benchmark, "--benchmark_format=json", steps]))["benchmarks"]:
        step, cells = TABLE_3_STEPS[result["name"].split("/")[0]], result["label"].split(" cm ")[0]
        growth = [f"{result[key]:.2f}" if key in result else "-"
                  for key in ("growth", "P3_growth", "Sparc_growth", "RAD_growth")]
        printed = f"{result['P3_ms']:.4g}" if "P3_ms" in result else "-"
        rows.append([step, cells, f"{result['cpu_time']:.3f}", printed, *growth])
    return table(["step", "cells (cm)", "time (ms)", "Pentium III, printed (ms)",
                  "over the next coarser cells", "Pentium III", "Sparc", "RAD6000"], rows)


def abundance_sweep(study):
    """Success over rock abundance with its fit; the drawing goes to results/studies."""
    text = study.swept("abundance", 1000)
    shutil.copy(study.out / "sweeps/abundance/success.svg", ROOT / "results/studies/abundance.svg")
    return text


def navigator_sweep(study):
    return study.swept("navigators", 200)


def attribution(study):
    """Of the printed table the part about attribution, without the notes on equal cells below it."""
    text = study.swept("attribution", 300)
    text = text[text.index("attribution of failures"):]
    return quoted(text.split("  every trial of cell")[0].removesuffix("```"))


def scaling(study):
    """On a machine that does nothing else."""
    return shared.run([sys.executable, ROOT / "scripts/studies/scaling/scaling.py", "--rockyard", study.rockyard,
                       "--out", study.out / "scaling"]).strip()


TABLES = {f.__name__: f for f in (comparison, comparison_excerpt, first_answer, hazards, mission, verdicts,
                                 errors, envelope, corridor, unmeasured, rocks_unknown, causes, fidelity, speed,
                                 gestalt, navigators, navigator_speed, table_3,
                                 abundance_sweep, navigator_sweep, attribution, scaling)}


def main():
    parser = shared.argument_parser(__doc__)
    shared.add_program(parser)
    parser.add_argument("--benchmark", type=Path,
                        default=ROOT / "build/release/tests/navigation/gestalt_benchmark",
                        help="for table_3 (target benchmarks)")
    parser.add_argument("--out", type=Path, default=ROOT / "results/runs/readme")
    parser.add_argument("--pages", type=Path, nargs="+",
                        default=[ROOT / "README.md", *sorted((ROOT / "results").glob("*.md"))],
                        help="where the tables stand (README.md and results/*.md)")
    parser.add_argument("--tables", default=",".join(TABLES), help="which, joined by commas")
    args = parser.parse_args()
    study = Study(args.rockyard, args.benchmark, args.out)
    for name in args.tables.split(","):
        if name not in TABLES:
            sys.exit(f"{name} is no table; there are {', '.join(TABLES)}")
        started = time.monotonic()
        content = TABLES[name](study)
        if content is None:
            print(f"{name}: not run, left as it is", file=sys.stderr)
            continue
        shared.write_table(args.pages, name, content)
        print(f"{name}: {time.monotonic() - started:.0f} s", file=sys.stderr)


if __name__ == "__main__":
    main()
