"""The map and the cycle of ground_map.h and stop_and_look.h in Python, with the same numbers bit for
bit: the same operations in the same order, and no function that Python computes by itself
(math.hypot). An algorithm derives from StopAndLook and says what follows a look (plan). Poses are
tuples (x_m, y_m, heading_rad) in the odometry frame O.
"""
import math

from rockyard_navigator import Navigator, arrived, drive, gave_up, look, parameter, rest, turn

SIDE = 128  # cells of the map; a power of two, so that & wraps
MEMORY = 10  # looks
IX, IY, SUM, POINTS, LOOK, FELT = range(6)  # of a cell


def is_sane(*values):
    """Returns whether numbers can be calculated with: all are there, and none is infinite."""
    return None not in values and max(values) < 1e6 and min(values) > -1e6


def wrapped(angle_rad):
    return math.remainder(angle_rad, 2.0 * math.pi)


def length(dx_m, dy_m):
    return math.sqrt(dx_m * dx_m + dy_m * dy_m)


def beside(at, x_m, y_m):
    """Returns the pose that lies x_m ahead and y_m to the left of another one."""
    c, s = math.cos(at[2]), math.sin(at[2])
    return (at[0] + (c * x_m - s * y_m), at[1] + (s * x_m + c * y_m), at[2])


class GroundMap:
    """The mean height of each cell of the ground around the rover. A square that wraps around: a cell
    is forgotten when another one needs its place."""

    def __init__(self, cell_m):
        self.cell_m, self.looks = cell_m, 0
        self.clear()

    def clear(self):
        self.cells = [None] * (SIDE * SIDE)

    def index(self, place_m):
        return math.floor(place_m / self.cell_m)

    def find(self, ix, iy):
        """Returns the cell, or None where nothing is known of it."""
        cell = self.cells[(iy & SIDE - 1) * SIDE + (ix & SIDE - 1)]
        return cell if cell is not None and cell[IX] == ix and cell[IY] == iy else None

    def take(self, ix, iy):
        slot = (iy & SIDE - 1) * SIDE + (ix & SIDE - 1)
        cell = self.cells[slot]
        if cell is None or cell[IX] != ix or cell[IY] != iy:
            cell = self.cells[slot] = [ix, iy, 0.0, 0.0, 0, False]
        return cell

    def add(self, cloud, moment):
        """Takes the points of a look. A cell that is seen again after MEMORY looks begins anew: the
        believed pose has drifted meanwhile."""
        at, stance = moment.odometry, moment.attitude
        if not is_sane(at.x_m, at.y_m, at.heading_rad, stance.roll_rad, stance.pitch_rad, stance.z_m):
            return
        self.looks += 1
        x0_m, y0_m, z0_m, oldest = at.x_m, at.y_m, stance.z_m, self.looks - MEMORY
        cr, sr = math.cos(stance.roll_rad), math.sin(stance.roll_rad)
        cp, sp = math.cos(stance.pitch_rad), math.sin(stance.pitch_rad)
        ch, sh = math.cos(at.heading_rad), math.sin(at.heading_rad)
        points = iter(cloud.points_R)
        for x_R, y_R, z_R in zip(points, points, points):
            if not is_sane(x_R, y_R, z_R):
                continue
            y_m = cr * y_R - sr * z_R  # R_OR = Rz(heading) Ry(pitch) Rx(roll)
            up_m = sr * y_R + cr * z_R
            x_m = cp * x_R + sp * up_m
            cell = self.take(self.index(x0_m + (ch * x_m - sh * y_m)),
                             self.index(y0_m + (sh * x_m + ch * y_m)))
            if cell[LOOK] < oldest:
                cell[SUM] = cell[POINTS] = 0.0
            cell[LOOK] = self.looks
            cell[SUM] += z0_m + (cp * up_m - sp * x_R)
            cell[POINTS] += 1.0

    def step_m(self, ix, iy):
        """Returns by how much a cell rises above the lowest around it; 0 where nothing is known."""
        cell = self.find(ix, iy)
        if cell is None:
            return 0.0
        if cell[FELT]:
            return 1.0
        around = [self.find(i, j) for j in range(iy - 1, iy + 2) for i in range(ix - 1, ix + 2)]
        heights = [near[SUM] / near[POINTS] for near in around if near is not None and near[LOOK] > 0]
        return cell[SUM] / cell[POINTS] - min(heights)


def assumed(name, value, doc, reason, bounds, studied):
    """Declares a real number that nobody published."""
    return parameter(name, "real", value, doc, min=bounds[0], max=bounds[1], study=list(studied), origin="assumed",
                     source=reason)


CYCLE_PARAMETERS = [
    parameter("goal_tolerance_m", "real", 0.3, "believed distance from the goal at which it has arrived",
              min=0.01, max=5.0, origin="setting"),
    assumed("cell_m", 0.1, "side of a cell of the map", "the test set-up of ACE has 0.1 m (Otsu 2020)",
            (0.02, 1.0), (0.05, 0.2)),
    assumed("back_off_m", 0.3, "how far it drives back from a hazard that it feels",
            "half of a small rover's length", (0.01, 2.0), (0.1, 0.5)),
    parameter("max_fruitless_looks", "integer", 60, "looks without a gain on the goal after which it gives up",
              min=1, max=100000, origin="setting"),
]


class StopAndLook(Navigator):
    """Look, plan, move, until the goal is near."""

    def traits(self):
        return {**super().traits(), "reads": "points"}

    def plan(self, here, goal):
        """Returns what follows a look: ("turn", turn_rad), ("drive", curvature_per_m, way_m) or None,
        and the operations that it took to find it."""
        raise NotImplementedError("plan()")

    def on_other_way(self):
        """The goal or the ground is another one: what was begun ends."""

    def start(self, setup):
        self.rover, self.map = setup.rover, GroundMap(self.p.cell_m)
        self.estimate = self.here = (0.0, 0.0, 0.0)
        self.motion = None  # (kind, sense, begun, amount, curvature_per_m)
        self.best_m, self.fruitless = math.inf, 0

    def decide(self, input):
        at, O = input.estimate, input.odometry
        if not is_sane(at.x_m, at.y_m, at.heading_rad, at.distance_m) or not is_sane(
                O.x_m, O.y_m, O.heading_rad, O.distance_m):
            return rest(1.0)  # nothing to plan by
        self.estimate, self.here = (at.x_m, at.y_m, at.heading_rad), (O.x_m, O.y_m, O.heading_rad)
        self.odometer_m = at.distance_m
        goal_m = length(self.goal.x_m - at.x_m, self.goal.y_m - at.y_m)
        if goal_m <= self.p.goal_tolerance_m:
            return arrived()
        if input.cloud is not None and input.look is not None:
            self.map.add(input.cloud, input.look)
            return self.begin(goal_m)
        backs_off = self.motion is not None and self.motion[:2] == ("arc", -1)
        feels = input.hazard is not None and "hazard" in input.events
        if self.motion is not None and not backs_off and feels:
            self.mark_ahead(input.hazard)
            return self.move("arc", -1, self.p.back_off_m)
        if "stuck" in input.events:  # the reaction to it has backed off already
            self.mark_ahead(None)
            self.motion = None
        # Asked for another reason than the end of the motion: it goes on.
        backs_into = backs_off and input.touches_behind
        if self.motion is not None and not backs_into and self.left() > 1e-6:
            return self.go_on()
        self.motion = None
        return look()

    def jump(self, corrected, before, after):
        if not corrected:  # operators have moved the rover: it stands on other ground
            self.map.clear()
            self.motion = None
            self.on_other_way()

    def set_goal(self, goal, moved):
        if not moved:
            self.best_m = math.inf
            self.on_other_way()

    def begin(self, goal_m):
        if goal_m < self.best_m - 0.2:
            self.best_m, self.fruitless = goal_m, 0
        else:
            self.fruitless += 1
            if self.fruitless > self.p.max_fruitless_looks:
                return gave_up()
        # The goal lies in O as it lies from the rover.
        here = (self.here[0], self.here[1], -self.turned_rad())
        goal = beside(here, self.goal.x_m - self.estimate[0], self.goal.y_m - self.estimate[1])
        move, work_ops = self.plan(self.here, goal)
        if move is None:
            decision = gave_up()
        elif move[0] == "turn":  # at most 150 degrees, so that left and right stay apart
            decision = self.move("turn", 1 if move[1] > 0.0 else -1,
                                 min(abs(move[1]), 5.0 * math.pi / 6.0))
        else:
            decision = self.move("arc", 1, move[2], move[1])
        return {**decision, "work_ops": work_ops}

    def move(self, kind, sense, amount, curvature_per_m=0.0):
        begun = self.odometer_m if kind == "arc" else self.here[2]
        self.motion = (kind, sense, begun, amount, curvature_per_m)
        return self.go_on()

    def left(self):
        kind, sense, begun, amount, _ = self.motion
        if kind == "arc":
            return amount - (self.odometer_m - begun)
        return amount - sense * wrapped(self.here[2] - begun)

    def go_on(self):
        kind, sense, _, _, curvature_per_m = self.motion
        decision = (drive(curvature_per_m, self.left(), direction=sense) if kind == "arc"
                    else turn(sense, self.left()))
        decision["until"]["near_goal_m"] = self.p.goal_tolerance_m
        return decision

    def turned_rad(self):
        return self.estimate[2] - self.here[2]

    def mark_ahead(self, hazard):
        """Nobody knows where a felt hazard is: before the front, on the side that the sensor names."""
        y_m = {"left": self.rover.width_m, "right": -self.rover.width_m}.get(hazard and hazard.side, 0.0)
        x_m, y_m, _ = beside(self.here, 0.5 * self.rover.length_m, 0.5 * y_m)
        self.map.take(self.map.index(x_m), self.map.index(y_m))[FELT] = True

    def told(self, place):
        """Returns a place of O in the frame in which goals are told, for overlays."""
        at = (self.estimate[0], self.estimate[1], self.turned_rad())
        return list(beside(at, place[0] - self.here[0], place[1] - self.here[1])[:2])

    def steps_grid(self, limit_m):
        """Returns the steps of the map within 4 m of the rover, as shares of limit_m."""
        cell_m, side, values = self.map.cell_m, min(80, SIDE), []
        middle = (self.here[0], self.here[1], -self.turned_rad())
        for j in range(side):
            for i in range(side):
                x_m, y_m, _ = beside(middle, (i + 0.5 - 0.5 * side) * cell_m, (j + 0.5 - 0.5 * side) * cell_m)
                ix, iy = self.map.index(x_m), self.map.index(y_m)
                known = self.map.find(ix, iy) is not None
                values.append(min(1.0, self.map.step_m(ix, iy) / limit_m) if known else None)
        return {"name": "steps", "x0_m": self.estimate[0] - 0.5 * side * cell_m,
                "y0_m": self.estimate[1] - 0.5 * side * cell_m, "step_m": cell_m, "nx": side, "ny": side,
                "values": values}
