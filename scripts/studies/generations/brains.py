"""Who drives in the study of generations, on which ground, and by what it knows where it is.

All of them drive the same rover, Athena as of 2012, with the same stereo cameras, to the same goal with the same
tolerance, among the same rocks and noise; what differs is the navigator.
"""

import json
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402

BASE = study.ROOT / "scenarios/bench/points_athena_2012.json"
STRIPE = study.ROOT / "scenarios/gestalt/abundance_behaviour.json"  # the light stripe at this rover's size
TUNED = study.ROOT / "results/studies/generations_tuned.json"
EVERYWHERE = {"rover.fidelity": "quasi_static", "referee.no_path_distance_m": 40, "referee.no_path_turn_deg": 7200}
ABUNDANCES = (0.002, 0.0055, 0.009, 0.0125)  # k of Moore's law, per m2; nominal Mars is 0.00415, Viking Lander 2 0.013
SLOPES = {"level": (0, 0), "5 deg up": (5, 0), "10 deg up": (10, 0), "10 deg across": (10, 90)}
DEAD, VISUAL, PERFECT, IDEAL = "dead reckoning", "visual odometry", "perfect pose", "perfect pose, exact points"
KNOWS = {DEAD: {"localization.estimator": "dead_reckoning", "sensors.visual_odometry.enabled": False},
         VISUAL: {}, PERFECT: {"localization.estimator": "oracle"},
         IDEAL: {"localization.estimator": "oracle", "sensors.stereo.fidelity": "ideal"}}
ENAV = {"navigation.navigator": "enav", "navigation.enav.tree.lengths": "by_wheelbase",
        "navigation.enav.drive.goal_tolerance_m": 0.5}
GESTALT, WAY = "navigation.gestalt.", "navigation.gestalt.remedies.cost_to_go."
CSAD = {GESTALT + "continuous.cycle": "csad", "clock.overlap.steering": True}
# The behaviour controller's lengths at this rover's size, as in STRIPE.
BEHAVIOUR = {"navigation.navigator": "pathfinder", "navigation.pathfinder.goal_tolerance_m": 0.5} | {
    f"navigation.pathfinder.{name}": value
    for name, value in json.loads(STRIPE.read_text(encoding="utf-8"))["navigation"]["pathfinder"].items()}


def paths(group, name):
    """The values of a group by their paths: a group itself would take the place of the other members."""
    return {path: value for key, member in group.items()
            for path, value in (paths(member, f"{name}.{key}") if isinstance(member, dict) else {f"{name}.{key}": member}).items()}


def stripe():
    """The sensor of 1995 in the place of the cameras."""
    told = json.loads(STRIPE.read_text(encoding="utf-8"))
    return paths(told["sensors"], "sensors") | paths(told["perception"], "perception") | {
        "perception.hazard.agreement": "rescan_same_pose"}


@dataclass(frozen=True)
class Brain:
    """A navigator: the year of its source, its settings, and which parameters are tuned."""

    year: str
    values: dict
    levers: tuple = ()
    plugin: str = ""
    knows: tuple = tuple(KNOWS)


_BEHAVIOUR = tuple(f"navigation.pathfinder.{name}" for name in (
    "turn_increment_deg", "clear_distance_m", "heading_deadband_deg", "tight_arc_bearing_deg", "point_turn_bearing_deg",
    "both_sides", "right_is_clear", "vehicle_reaction.back_off_m"))
_GESTALT = tuple(GESTALT + name for name in (
    "map.roughness_fraction", "arcs.num_point_turns", "plan.far_weight", "plan.unknown_cells", "plan.max_path_turn_deg",
    "drive.point_turn_margin", "drive.back_off_m", "drive.felt_radius_m"))
_WAY = (*_GESTALT[:4], *(WAY + name for name in ("unseen_cost", "rough_cost", "way_m", "loss_m")))
_MOVING = (*_GESTALT[:4], *(GESTALT + name for name in (
    "continuous.motion_m", "continuous.replan_fraction", "continuous.no_safe_plan", "drive.felt_radius_m")))
_ENAV = tuple(f"navigation.enav.{name}" for name in (
    "ace.min_clearance_share", "ace.max_tilt_deg", "ace.max_wheel_drop_radii", "ace.wheel_box_diameters", "ace.min_seen_share",
    "map.unseen_factor", "tree.max_curvature_per_m", "drive.max_checks"))
BRAINS = {
    "behaviour, light stripe": Brain("1995", BEHAVIOUR | stripe(), knows=(DEAD, VISUAL, PERFECT)),
    "behaviour": Brain("1995", BEHAVIOUR, _BEHAVIOUR),
    "behaviour, steps from the plane": Brain("", BEHAVIOUR | {"perception.cloud_elevations.frame": "plane"}, _BEHAVIOUR),
    "bug2": Brain("1987", {"navigation.bug2.goal_tolerance_m": 0.5}, tuple(f"navigation.bug2.{name}" for name in (
        "cell_m", "back_off_m", "obstacle_share", "margin_m", "step_m", "line_m", "gain_m", "round_m")), plugin="bug2"),
    "a_star": Brain("1968", {"navigation.a_star.goal_tolerance_m": 0.5}, tuple(f"navigation.a_star.{name}" for name in (
        "cell_m", "back_off_m", "obstacle_share", "margin_m", "step_m", "step_points")), plugin="a_star"),
    "gestalt, printed": Brain("2002", {GESTALT + "map.step_reference": "level", GESTALT + "map.tests.pitch": False,
                                       GESTALT + "drive.backward_arcs": "below_threshold",
                                       GESTALT + "drive.point_turns": "below_min_vote"}),
    "gestalt": Brain("2002", {}, _GESTALT),
    "gestalt, way to go": Brain("2007", {WAY + "enabled": True}, _WAY),
    "csod": Brain("2012", {GESTALT + "continuous.cycle": "csod", "navigation.wheel_driver.steer_while_driving_deg": 0}, _MOVING),
    "csad": Brain("2012", CSAD, _MOVING),
    "csad, remedied": Brain("", CSAD | {f"{GESTALT}remedies.{name}.enabled": True for name in (
        "cost_to_go", "turn_first", "stop_to_turn", "against_drift")}, _MOVING),
    "enav": Brain("2020", ENAV, _ENAV),
    "enav, p-ACE": Brain("2018", ENAV | {"navigation.enav.ace.risk": 0.001}, _ENAV),
}


def swept(args, name, folder, axes, base):
    """The trials of a full crossing, run or gone on with, as a frame with the levels of the axes."""
    brain = BRAINS[name]
    design = {"name": "generations", "scenario": str(BASE), "common_random_numbers": True, "trials": args.layouts,
              "seed": args.seed, "set": EVERYWHERE | brain.values | base, "axes": axes}
    folder.parent.mkdir(parents=True, exist_ok=True)
    path = folder.with_suffix(".json")
    path.write_text(json.dumps(design, indent=1) + "\n", encoding="utf-8")
    plugin = ["--plugin", study.example_navigator(brain.plugin, args.out / "plugins")] if brain.plugin else []
    print(folder.name, file=sys.stderr, flush=True)
    study.run([args.rockyard, "sweep", path, "--out", folder, "--threads", args.threads, "--quiet", *plugin,
               *(["--resume", "--force"] if folder.exists() else [])])
    return study.counted(study.ry.Sweep(folder)), study.program(study.ry.Sweep(folder))


def file_of(name):
    return "".join(c if c.isalnum() else "_" for c in name)


def ground_axes(slopes=tuple(SLOPES), abundances=ABUNDANCES):
    return [{"name": "ground", "levels": [{"name": slope, "set": {
        "terrain.ground.slope_deg": SLOPES[slope][0], "terrain.ground.slope_direction_deg": SLOPES[slope][1]}}
        for slope in slopes]}, {"path": "terrain.rocks.k_per_m2", "values": list(abundances)}]


def knowing_axis(levels):
    return {"name": "knows", "levels": [{"name": name, "set": KNOWS[name]} for name in levels]}


def by_layout(trials, value=None):
    """A score for each layout: the mean over all its cells, of true arrival unless something else is given."""
    value = (trials.outcome == "goal_reached") if value is None else value
    return value.astype(float).groupby(trials.trial).mean().sort_index()


def estimate(values, digits=1, scale=100.0):
    """A mean over layouts with Student's 95 % interval, as text."""
    return study.with_interval(study.rates.mean(np.asarray(values, float)), digits, scale)
