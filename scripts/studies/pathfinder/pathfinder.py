#!/usr/bin/env python3
"""Runs what the tables of README.md and of the pages in results/ report and writes them anew.

Each table stands between two comments, <!-- begin NAME --> and <!-- end NAME -->. Runs that are there
already are taken as they are, so that this can be stopped and started again; delete the folder after
a change of the code. The whole takes some fifteen minutes of processor time.

    scripts/studies/pathfinder/pathfinder.py [--out results/runs/readme] [--tables comparison,causes,...]
"""

import argparse
import csv
import json
import resource
import shutil
import subprocess
import sys
import time
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
from study import ROOT, compare, failures, table, trial_columns, write_table  # noqa: E402
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
# Drives with a map: name of the run, scenario, settings.
GESTALT = [
    ("narrow", "gestalt_narrow_course", []),
    ("vl2", "gestalt_viking_lander_2", []),
    ("vl2_oracle", "gestalt_viking_lander_2", ["localization.estimator=oracle"]),
    ("error", "gestalt_localization_error", []),
    ("error_oracle", "gestalt_localization_error", ["localization.estimator=oracle"]),
]
GESTALT_NAMES = {
    "narrow": "narrow_course, 5 m",
    "vl2": "viking_lander_2, 17.5 m",
    "vl2_oracle": "the same, perfect localization",
    "error": "localization_error, 7.6 m nominal",
    "error_oracle": "the same, perfect localization",
}
TABLE_3_STEPS = {
    "BM_Step<FitPlanes<false>>": "fit planes",
    "BM_Step<FitPlanes<true>>": "fit planes, with their slopes",
    "BM_Step<Hazards>": "traversability analysis",
    "BM_Step<PathVotes>": "path votes",
    "BM_Cycle": "a whole cycle of the map, 16384 points",
}
MEANS = ("mean_a", "mean_b", "difference", "ci95_low", "ci95_high")
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

    def folder(self, name, scenario):
        return self.out / name / scenario

    def run(self, name, scenario, trials=None, settings=()):
        """summary.json of a run, of the scenario's own number of trials where none is given;
        `cpu_s` is added to it."""
        folder = self.folder(name, scenario)
        cost = folder / "cpu_seconds"
        if not cost.exists():
            print(f"{name}/{scenario}", file=sys.stderr)
            command = [self.rockyard, "run", scenario_file(scenario), "--threads", 1,
                       "--out", folder, "--quiet", "--force"]
            command += ["--trials", trials] if trials else []
            command += [part for setting in settings for part in ("--set", setting)]
            before = cpu_seconds()
            subprocess.run([str(part) for part in command], check=True)
            cost.write_text(str(cpu_seconds() - before), encoding="utf-8")
        summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
        summary["cpu_s"] = float(cost.read_text(encoding="utf-8"))
        return summary

    def published(self):
        return {name: self.run("published", name, 300) for name in PUBLISHED}

    def swept(self, name, trials):
        """What `rockyard sweep` prints of scenarios/sweeps/NAME.json; its folder keeps the files."""
        folder = self.out / "sweeps" / name
        text = self.tool("sweep", SCENARIOS / "sweeps" / f"{name}.json", "--trials", trials,
                         "--out", folder, "--resume", "--force")
        return "```\n" + text.rsplit("  results in ", 1)[0].strip() + "\n```"

    def tool(self, *arguments):
        result = subprocess.run([str(part) for part in (self.rockyard, *arguments)],
                                capture_output=True, text=True, check=False)
        if result.returncode not in (0, 1, 4):  # a comparison may differ or be inconclusive
            sys.exit(result.stderr)
        return result.stdout


def scenario_file(name):
    """The scenario file whose member "name" it is."""
    for path in sorted(SCENARIOS.rglob("*.json")):
        if json.loads(path.read_text(encoding="utf-8")).get("name") == name:
            return path
    sys.exit(f"{SCENARIOS} has no scenario {name}")


def cpu_seconds():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def rate(summary, key="declared_success"):
    value = summary[key]
    low, high = value["ci95"]
    return f"{100 * value['rate']:.0f} % ({100 * low:.0f}..{100 * high:.0f})"


def trials_per_second(summary):
    return f"{summary['trials']['completed'] / summary['cpu_s']:.3g}"


def published_check(study):
    study.published()
    return study.tool("check", study.out / "published", "--against", REFERENCE)


def comparison(study):
    return f"```\n{published_check(study).strip()}\n```"


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
    text = study.tool("check", hazard_runs(study), "--against", HAZARD_REFERENCE)
    return f"```\n{text.strip()}\n```"


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
    with open(path, encoding="utf-8", newline="") as file:
        return [row for row in csv.DictReader(file) if row["verdict"]]


def mission(study):
    """Arithmetic of the paper; the run is there because the command wants one, and says nothing."""
    study.run("hazards", "traverse_one_hour")
    rows = [[row["what"], row["place"], f"{float(row['published']):.4g}",
             f"{float(row['simulated']):.4g}", "" if row["unit"] == "1" else row["unit"],
             row["verdict"]]
            for row in checked(study, study.folder("hazards", "traverse_one_hour"),
                               MISSION_REFERENCE)]
    return table(["computed, not simulated", "place", "published", "computed", "unit", "verdict"],
                 rows)


def verdicts(study):
    """How many rows of each verdict there are, by what the row can say of the simulation."""
    study.published()
    rows = []
    for runs, file, title in (
            (study.out / "published", REFERENCE, "trials"),
            (hazard_runs(study), HAZARD_REFERENCE, "hazard detection"),
            (study.folder("hazards", "traverse_one_hour"), MISSION_REFERENCE, "mission")):
        counts = {}
        for row in checked(study, runs, file):
            kind = row["role"] if row["scenario"] else "computed, not simulated"
            counts.setdefault(kind, dict.fromkeys(VERDICTS, 0))[row["verdict"]] += 1
        rows += [[f"{title}, {kind}", *map(str, found.values())] for kind, found in counts.items()]
    return table(["numbers of Matthies 1995", *VERDICTS], rows)


def reference(scenario, column, statistic):
    """The published number as printed; '-' where there is none."""
    values = json.loads(REFERENCE.read_text(encoding="utf-8"))["values"]
    for value in values:
        if (value["scenario"], value.get("column"), value["statistic"]) == (
                scenario, column, statistic):
            size = f"/{value['sample_size']}" if statistic == "outcome_count" else ""
            return f"{value['value']}{size}"
    return "-"


def errors(study):
    settings = next(cause[2] for cause in CAUSES if cause[0] == "no_inputs")
    runs = [study.published()["nominal"], study.run("no_inputs", "nominal", 100, settings)]
    rows = []
    for column, name in (("heading_error_deg", "heading error (deg)"),
                         ("position_error_m", "position error (m)"),
                         ("distance_error_percent", "distance error (%)")):
        printed = [reference("nominal", column, statistic)
                   for statistic in ("minimum", "mode", "median", "maximum")]
        found = [" / ".join(f"{run['dead_reckoning'][column][part]:.2f}"
                            for part in ("min", "mode", "median", "max")) for run in runs]
        rows.append([name, " / ".join(printed), *found])
    return table(["nominal, min / mode / median / max", "published", "with both inputs (300)",
                  "without (100)"], rows)


def corridor(study):
    """Rocks along the course against the law, by placement rule."""
    text = [study.tool("terrain", scenario_file(name), "--density", "--fields", 4000).strip()
            for name in ("nominal", "obstacles_0.57")]
    return "```\n" + "\n\n".join(text) + "\n```"


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
        columns = trial_columns(study.folder("unmeasured", scenario))
        metres = sum(columns["true_distance_m"])
        distance = run["distance_m"]
        rows.append([scenario, rate(run), spread(study, scenario, "declared success rate"),
                     rate(run, "true_success"), spread(study, scenario, "true success rate"),
                     f"{distance['median']:.1f} ({distance['p05']:.1f}..{distance['p95']:.1f})",
                     f"{sum(columns['hazards_begun']) / metres:.2f}", failures(run)])
    return table(["scenario, 300 trials", "declared success", "envelope (%)", "true success",
                  "envelope (%)", "distance, median (5..95 %) (m)", "avoidances begun a metre",
                  "failures"], rows)


def causes(study):
    published = study.published()
    rows = [["as chosen (300 trials)", *(rate(published[scenario]) for scenario in BOTH)]]
    for name, text, settings, scenarios in CAUSES:
        if name in SOILS:
            found, _ = calibrate(study.rockyard, settings)
            settings = settings + [f"{path}={value}" for path, value in found.items()]
        rows.append([text, *(rate(study.run(name, scenario, 100, settings))
                             if scenario in scenarios else "-" for scenario in BOTH)])
    return table(["change", "nominal", "0.85 per m2"], rows)


def mean_cells(row):
    """Both means and their difference; `compare` gives no interval where a few trials decide it."""
    a, b, difference, low, high = (f"{float(row[part]):.4g}" if row[part] else "" for part in MEANS)
    return a, b, f"{difference} ({low}..{high})" if low and high else f"{difference} (no interval)"


def fidelity(study):
    rows = []
    for scenario in FIDELITY:
        multibody = "published" if scenario in PUBLISHED else "multibody"
        runs = [study.run(multibody, scenario, 300),
                study.run("quasi_static", scenario, 300, QUASI_STATIC)]
        success, means = compare(study.rockyard, study.folder(multibody, scenario),
                                 study.folder("quasi_static", scenario))
        points, low, high, _ = success["declared"]
        rows.append([f"**{scenario}**", "", "", ""])
        rows.append(["declared success", rate(runs[0]), rate(runs[1]),
                     f"{points:+.1f} points ({low:+.1f}..{high:+.1f})"])
        rows.append(["true success", rate(runs[0], "true_success"), rate(runs[1], "true_success"),
                     ""])
        for key, text in (("true_distance_m", "distance (m)"),
                          ("distance_error_percent", "distance error (%)"),
                          ("heading_error_deg", "heading error (deg)"),
                          ("position_error_m", "position error (m)"),
                          ("scrapes", "scrapes"), ("max_tilt_deg", "largest tilt (deg)")):
            rows.append([text, *mean_cells(means["all", key])])
        rows.append(["trials per CPU-second", *(trials_per_second(run) for run in runs), ""])
    return table(["mean over 300 trials", "multibody", "quasi-static", "paired difference (95 %)"],
                 rows)


def speed(study):
    published = study.published()
    return table(["scenario", "trials per CPU-second"],
                 [[name, trials_per_second(published[name])] for name in PUBLISHED])


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
            value = chosen[scenario]
            for key in metric["path"]:
                value = value[key]
            rows.append([scenario, name, published_metric(scenario, metric["path"]), f"{value:.2f}",
                         *(f"{metric[part]:.2f}" for part in ("p05", "median", "p95"))])
    head = (f"{found['points']} points over {found['parameters']} assumed parameters, "
            f"{found['trials']} trials a point, {', '.join(found['held'])}\n\n")
    return head + table(["scenario", "prediction", "published", "chosen", "envelope 5 %", "median",
                         "95 %"], rows)


def gestalt(study):
    """The two drives of Goldberg 2002, their failures and distances, and what localization does."""
    rows = []
    for name, scenario, settings in GESTALT:
        summary = study.run("gestalt_" + name, scenario, 500, settings)
        distance, speed = summary["distance_m"], summary["columns"]["net_rate_m_s"]
        looks = trial_columns(study.folder("gestalt_" + name, scenario))
        images, moves = sum(looks["image_sets"]), sum(looks["moves"])  # turns in place among them
        rows.append([GESTALT_NAMES[name], rate(summary), rate(summary, "true_success"),
                     failures(summary),
                     " / ".join(f"{distance[key]:.1f}" for key in ("min", "median", "p95", "max")),
                     f"{100.0 * speed['median']:.2f}", f"{images / moves:.2f}",
                     f"{100.0 * sum(looks['reversals']) / moves:.0f}",
                     trials_per_second(summary)])
    return table(["500 trials", "declared success", "true success", "failures",
                  "distance, min / median / 95 % / max (m)", "median speed (cm/s)",
                  "image sets a move", "moves the other way (%)", "trials per CPU-second"], rows)


def navigators(study):
    """Both navigators over abundance, from the study that scripts/studies/navigator/navigator.py left."""
    with open(ROOT / "results/studies/navigators.csv", encoding="utf-8", newline="") as file:
        runs = {(row["rover"], row["k_per_m2"], row["arm"]): row for row in csv.DictReader(file)}
    with open(ROOT / "results/studies/navigators_pairs.csv", encoding="utf-8", newline="") as file:
        pairs = [row for row in csv.DictReader(file)
                 if (row["first"], row["second"]) == navigator.MAIN]
    rows = []
    for row in pairs:
        both = [runs[row["rover"], row["k_per_m2"], arm] for arm in navigator.MAIN]
        number = lambda key: float(row[key])
        rows.append([row["rover"], row["k_per_m2"],
                     *(f"{100 * float(run['declared']):.0f} / {100 * float(run['true']):.0f}"
                       for run in both),
                     f"{number('true_points'):+.0f} ({number('true_low'):+.0f}.."
                     f"{number('true_high'):+.0f})", f"{number('true_holm'):.2g}",
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
    return table(["Athena SDM, 7.6 m of nominal terrain, one core", "multibody", "quasi-static"],
                 rows)


def table_3(study):
    """Steps of GESTALT beside table 3 of Goldberg 2002; None where the benchmark is not built."""
    if not study.benchmark.exists():
        return None
    output = subprocess.run([study.benchmark, "--benchmark_format=json"], capture_output=True,
                            text=True, check=True).stdout
    rows = []
    for result in json.loads(output)["benchmarks"]:
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
    return "```\n" + text.split("  every trial of cell")[0].rstrip() + "\n```"


def scaling(study):
    """On a machine that does nothing else."""
    result = subprocess.run([sys.executable, ROOT / "scripts/studies/scaling/scaling.py", "--rockyard", study.rockyard,
                             "--out", study.out / "scaling"], capture_output=True, text=True, check=False)
    return result.stdout.strip() if result.returncode == 0 else sys.exit(result.stderr)


TABLES = {f.__name__: f for f in (comparison, comparison_excerpt, first_answer, hazards, mission, verdicts,
                                 errors, envelope, corridor, unmeasured, causes, fidelity, speed,
                                 gestalt, navigators, navigator_speed, table_3,
                                 abundance_sweep, navigator_sweep, attribution, scaling)}


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rockyard", type=Path, default=ROOT / "build/release/bin/rockyard")
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
        write_table(args.pages, name, content)
        print(f"{name}: {time.monotonic() - started:.0f} s", file=sys.stderr)


if __name__ == "__main__":
    main()
