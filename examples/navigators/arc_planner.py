"""arc_planner.cc, clearance.h included, as a process: the same decisions, bit for bit. The comments on
why are there; here is how it reads in Python.

    rockyard run abundance_rocky_3_2 --navigator-process "python3 arc_planner.py"
"""
import math

from rockyard_navigator import parameter, run
from stop_and_look import CYCLE_PARAMETERS, FELT, LOOK, POINTS, SUM, StopAndLook, assumed, beside, length

TURNS, TURN_RAD = 5, math.pi / 6.0  # to either side
SEARCH = 12  # turns all round
OPS_PER_PLACEMENT = 400.0


def middle(a, b):  # bounds are (lowest, highest)
    return 0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])


def slope(rear, front, way_m):
    return (front[0] - rear[1]) / way_m, (front[1] - rear[0]) / way_m


def angle(bounds):
    return tuple(math.asin(min(1.0, max(-1.0, sine))) for sine in bounds)


def largest(bounds):
    return max(-bounds[0], bounds[1])


def height_m(cell):
    height = cell[SUM] / cell[POINTS] if cell[LOOK] > 0 else 0.0
    return height + 1.0 if cell[FELT] else height


class ArcPlanner(StopAndLook):
    name, doc, version = "arc_planner", "an arc planner in the manner of ENav, with the checks of ACE", "1.0"
    own_values = [("plans", "1", "Plans that were made."),
                  ("unsafe_arcs", "1", "Candidate motions whose first part was unsafe.")]
    parameters = CYCLE_PARAMETERS + [
        parameter("bogies_lead", "boolean", True, "whether the bogies are at the front, as those of Rocky 3.2",
                  origin="setting", source="rover.geometry.bogie_end, which navigators are not told"),
        assumed("limit_share", 0.9, "share that a pose may use of the limits of tilt, rockers and bogies",
                "some room before the hazard is felt", (0.1, 1.0), (0.6, 1.0)),
        parameter("drop_radii", "real", 1.33, "largest range of heights under a wheel, in wheel radii",
                  min=0.1, max=10.0, origin="published", source="Perseverance: 0.35 m (PIA26073), wheels of 0.263 m"),
        assumed("min_clearance_share", 0.3, "least room below the belly, as a share of its clearance",
                "the mean height of a cell lies below the top of a rock, and wheels sink", (0.0, 1.0), (0.1, 0.5)),
        parameter("arcs", "integer", 11, "arcs to choose from", min=2, max=101, origin="published",
                  source="11 in a layer of ENav"),
        assumed("max_curvature_per_m", 1.0, "curvature of the tightest arcs", "a circle three rover lengths wide",
                (0.0, 5.0), (0.5, 2.0)),
        assumed("arc_m", 1.5, "how far motions are followed over the map", "as far as a small rover sees well",
                (0.1, 10.0), (1.0, 3.0)),
        assumed("check_m", 0.15, "way from one judged pose to the next",
                "a quarter of a small rover's length; ENav: 0.25 m", (0.02, 1.0), (0.1, 0.25)),
        assumed("step_m", 0.45, "how far it drives between two looks", "a third of an arc, as ENav",
                (0.02, 5.0), (0.3, 1.0)),
        assumed("margin_weight_m", 0.5, "detour that a pose at its limits is worth", "a small rover's length",
                (0.0, 10.0), (0.0, 1.0)),
        assumed("unknown_weight_m", 0.5, "detour that a way over unseen ground is worth", "a pose at its limits",
                (0.0, 10.0), (0.0, 1.0)),
        assumed("turn_weight_m_per_rad", 0.3, "detour that a turn in place is worth",
                "turning takes time, and slips", (0.0, 10.0), (0.1, 1.0)),
    ]

    def start(self, setup):
        super().start(setup)
        x_m, y_m = self.rover.wheel_x_m, self.rover.wheel_y_m
        self.track_m = y_m[0] - y_m[3]
        self.half_belly_m = 0.5 * (x_m[0] - x_m[2]), 0.5 * (self.track_m - self.rover.wheel_width_m)
        self.searched, self.placements, self.candidates, self.chosen = 0, 0, [], None

    def on_other_way(self):
        self.searched = 0

    def plan(self, here, goal):
        self.placements = 0
        motions = [(0.0, self.p.max_curvature_per_m * (2.0 * i / (self.p.arcs - 1) - 1.0))
                   for i in range(self.p.arcs)]
        for i in range(1, TURNS + 1):
            motions += [(-TURN_RAD * i, 0.0), (TURN_RAD * i, 0.0)]
        self.candidates = [self.follow(here, goal, *motion) for motion in motions]
        safe = [candidate for candidate in self.candidates if candidate["safe"]]
        self.own["plans"] += 1
        self.own["unsafe_arcs"] += len(motions) - len(safe)
        self.chosen = min(safe, key=lambda candidate: candidate["cost_m"], default=None)
        if self.chosen is not None:
            self.searched, move = 0, self.chosen["move"]
        else:
            self.searched += 1
            move = ("turn", TURN_RAD) if self.searched < SEARCH else None
        return move, OPS_PER_PLACEMENT * self.placements

    def follow(self, here, goal, turn_rad, curvature_per_m):
        """Follows a motion over the map, to the first pose that is unsafe."""
        goal_m = length(goal[0] - here[0], goal[1] - here[1])
        checks = self.checks(min(self.p.arc_m, goal_m))
        bend_rad = self.p.check_m * curvature_per_m
        path, worst, unknown = [here], 0.0, 0
        at = (here[0], here[1], here[2] + turn_rad)
        while len(path) <= checks:
            heading_rad = at[2] + bend_rad
            x_m, y_m, _ = beside((at[0], at[1], at[2] + 0.5 * bend_rad), self.p.check_m, 0.0)
            at = (x_m, y_m, heading_rad)
            use, known = self.judge(at)
            if use > 1.0:
                break
            worst = max(worst, use)
            unknown += not known
            path.append(at)
        end = path[-1]
        return {"move": (("turn", turn_rad) if turn_rad != 0.0
                         else ("drive", curvature_per_m, min(self.p.step_m, goal_m))),
                "path": path, "safe": len(path) - 1 >= min(checks, self.checks(self.p.step_m)),
                "cost_m": (length(goal[0] - end[0], goal[1] - end[1]) + self.p.margin_weight_m * worst
                           + self.p.unknown_weight_m * unknown / checks
                           + self.p.turn_weight_m_per_rad * abs(turn_rad))}

    def checks(self, way_m):
        return max(1, math.floor(way_m / self.p.check_m))

    def judge(self, at):
        """Returns which share of its limits the rover uses at a pose, and whether the ground is known."""
        rover, wheel, total_m, known, use = self.rover, [], 0.0, 0, 0.0
        for x_m, y_m in zip(rover.wheel_x_m, rover.wheel_y_m):
            heights = self.under(beside(at, x_m, y_m))
            wheel.append(heights)
            if heights is not None:
                known += 1
                total_m += 0.5 * (heights[0] + heights[1])
                use = max(use, (heights[1] - heights[0]) / (self.p.drop_radii * rover.wheel_radius_m))
        if known < 3:
            return use, False
        wheel = [(total_m / known, total_m / known) if heights is None else heights for heights in wheel]
        (l_slope, l_rocker, l_height, l_use), (r_slope, r_rocker, r_height, r_use) = (
            self.side_on(0, wheel), self.side_on(3, wheel))
        use = max(max(use, l_use), r_use)
        share = self.p.limit_share
        bent = (0.5 * (l_rocker[0] - r_rocker[1]), 0.5 * (l_rocker[1] - r_rocker[0]))
        use = max(use, largest(bent) / (share * rover.max_rocker_rad))
        pitch_rad = largest(middle(l_rocker, r_rocker))
        across = slope(r_height, l_height, self.track_m)
        roll_rad = largest(angle(across))
        use = max(use, math.sqrt(pitch_rad * pitch_rad + roll_rad * roll_rad) / (share * rover.max_tilt_rad))
        if use > 1.0:
            return use, True
        room_m = self.room_m(at, middle(l_height, r_height)[0], middle(l_slope, r_slope), across)
        if room_m < self.p.min_clearance_share * rover.belly_clearance_m:
            return 2.0, True
        return max(use, 1.0 - room_m / rover.belly_clearance_m), True

    def side_on(self, first, wheel):
        """Returns bounds of a rocker's slope, its angle and its middle's height, and what the bogie uses."""
        x_m, lead = self.rover.wheel_x_m, self.p.bogies_lead
        front = first if lead else first + 1  # wheels of the bogie
        rear = front + 1
        pivot, pivot_x_m = middle(wheel[front], wheel[rear]), 0.5 * (x_m[front] + x_m[rear])
        head, tail = (pivot, wheel[first + 2]) if lead else (wheel[first], pivot)
        head_x_m, tail_x_m = (pivot_x_m, x_m[first + 2]) if lead else (x_m[first], pivot_x_m)
        rise = slope(tail, head, head_x_m - tail_x_m)
        rocker = angle(rise)
        bogie = angle(slope(wheel[rear], wheel[front], x_m[front] - x_m[rear]))
        bent = (bogie[0] - rocker[1], bogie[1] - rocker[0])
        share = (0.0 - tail_x_m) / (head_x_m - tail_x_m)
        height = tuple((1.0 - share) * tail[i] + share * head[i] for i in (0, 1))
        return rise, rocker, height, largest(bent) / (self.p.limit_share * self.rover.max_bogie_rad)

    def under(self, wheel):
        """Returns the heights that a wheel may stand on, or None where none is known."""
        self.placements += 1
        reach_m, index, heights = self.rover.wheel_radius_m, self.map.index, []
        rows = range(index(wheel[1] - reach_m), index(wheel[1] + reach_m) + 1)
        columns = range(index(wheel[0] - reach_m), index(wheel[0] + reach_m) + 1)
        for iy in rows:
            for ix in columns:
                cell = self.map.find(ix, iy)
                if cell is not None:
                    heights.append(height_m(cell))
        return (min(heights), max(heights)) if heights else None

    def room_m(self, at, low_m, along, across):
        """Returns the least room between the ground and the belly, a plane that hangs at its lowest."""
        half_x_m, half_y_m = self.half_belly_m
        nx = max(1, math.ceil(half_x_m / self.map.cell_m))
        ny = max(1, math.ceil(half_y_m / self.map.cell_m))
        clearance_m = room_m = self.rover.belly_clearance_m
        for i in range(-nx, nx + 1):
            x_m = half_x_m * i / nx
            for j in range(-ny, ny + 1):
                y_m = half_y_m * j / ny
                place = beside(at, x_m, y_m)
                cell = self.map.find(self.map.index(place[0]), self.map.index(place[1]))
                if cell is None:
                    continue
                belly_m = (low_m + clearance_m + min(along[0] * x_m, along[1] * x_m)
                           + min(across[0] * y_m, across[1] * y_m))
                room_m = min(room_m, belly_m - height_m(cell))
        return room_m

    def overlay(self):
        lines = [{"name": ("path" if candidate is self.chosen
                           else "safe motion" if candidate["safe"] else "unsafe motion"),
                  "points": [self.told(pose) for pose in candidate["path"]]}
                 for candidate in self.candidates]
        return {"lines": lines, "grids": [self.steps_grid(self.rover.belly_clearance_m)]}


if __name__ == "__main__":
    run(ArcPlanner)
