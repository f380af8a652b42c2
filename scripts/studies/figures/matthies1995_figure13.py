"""Matthies 1995, figure 13: the light stripe sensor from above, and where its array lands on flat ground."""

import math

from . import Drawn, Figure, FigureError, style

STRIPES, ROWS = 5, 4
EDGE_STEPS = 40   # of each side of an image, to draw the outline of what it sees
MARGIN_M = 0.12   # around what is drawn
DIMENSION_M = 0.06  # from the middle stripe to the arrow of its length


class Layout:
    """Where the sensor's parts and points are in the rover's frame, as the program places them."""

    def __init__(self, sensor):
        self.sensor = sensor
        self.front_m = sensor["front_x_m"]
        self.height_m = sensor["emitter_height_m"] - sensor["datum_z_m"]
        outer, inner = sensor["outer_emitter_y_m"], sensor["inner_emitter_y_m"]
        self.emitters = [(sensor["emitter_x_m"], y) for y in (outer, inner, 0.0, -inner, -outer)]
        outer, inner = sensor["outer_stripe_y_m"], sensor["inner_stripe_y_m"]
        self.far_points = [(self.front_m + sensor["row_ahead_m"][-1], y) for y in (outer, inner, 0.0, -inner, -outer)]
        half = 0.5 * sensor["camera_separation_m"]
        self.cameras = [(sensor["camera_x_m"], y) for y in (half, -half)]

    def on_stripe(self, stripe, x):
        """The point of a light plane, which is vertical, on flat ground at x."""
        (x0, y0), (x1, y1) = self.emitters[stripe], self.far_points[stripe]
        return x, y0 + (y1 - y0) * (x - x0) / (x1 - x0)

    def points(self):
        """(x, y) row by row from the nearest on, each from the left stripe to the right one."""
        return [self.on_stripe(stripe, self.front_m + ahead)
                for ahead in self.sensor["row_ahead_m"] for stripe in range(STRIPES)]

    def lit(self, stripe):
        """Nearest and farthest place of a stripe that the fan lights; infinite above the horizon."""
        start = self.emitters[stripe]
        def depression(x):
            return math.atan2(self.height_m, math.dist(start, self.on_stripe(stripe, x)))
        far = depression(self.far_points[stripe][0])
        middle = 0.5 * (depression(self.front_m + self.sensor["row_ahead_m"][0]) + far)
        along = (self.far_points[stripe][0] - start[0]) / math.dist(start, self.far_points[stripe])
        ends = []
        for angle in (middle + 0.5 * self.sensor["fan_rad"], middle - 0.5 * self.sensor["fan_rad"]):
            way = math.inf if angle <= 0.0 else self.height_m / math.tan(angle)
            ends.append(start[0] + along * way)
        return ends

    def seen(self, camera):
        """Outline on flat ground of what a camera sees: (x, y) along the edges of its image."""
        sensor = self.sensor
        a_most, b_most = (0.5 * sensor[f"active_{way}_m"] / sensor["focal_length_m"] for way in ("width", "height"))
        steps = [2.0 * i / EDGE_STEPS - 1.0 for i in range(EDGE_STEPS + 1)]
        edges = ([(a_most * s, -b_most) for s in steps] + [(a_most, b_most * s) for s in steps] +
                 [(-a_most * s, b_most) for s in steps] + [(-a_most, -b_most * s) for s in steps])
        height = sensor["camera_height_m"] - sensor["datum_z_m"]
        x0, y0 = self.cameras[camera]
        pitch = math.radians(sensor["camera_pitch_deg"])
        outline = []
        for a, b in edges:
            x, y, z = ray(sensor["lens"], a, b)
            ahead = x * math.cos(pitch) + z * math.sin(pitch)
            up = z * math.cos(pitch) - x * math.sin(pitch)
            if up < 0.0:
                outline.append((x0 - ahead * height / up, y0 - y * height / up))
        return outline


def ray(lens, a, b):
    """Direction (ahead, left, up) of an image place: a to the right, b downwards, both over the focal
    length (src/vision/lens.h)."""
    if lens == "equidistant_rows":
        return math.cos(a) * math.cos(b), -math.sin(a), -math.cos(a) * math.sin(b)
    if lens == "equidistant":
        theta = math.hypot(a, b)
        share = math.sin(theta) / theta if theta > 0.0 else 1.0
        return math.cos(theta), -share * a, -share * b
    return 1.0, -a, -b


def is_published(row, stripe):
    """Section 6 places the farthest points of the middle stripe and of the outermost ones."""
    return row == ROWS - 1 and stripe in (0, STRIPES // 2, STRIPES - 1)


def sensor_of(source):
    sensors = source.scenario["sensors"]
    if sensors["terrain_sensor"] != "light_stripe":
        raise FigureError(f"{source.path}: its rover looks with {sensors['terrain_sensor']}; figure 13 "
                          "shows the light stripe sensor: take a run of scenarios/pathfinder/nominal.json")
    sensor = sensors["light_stripe"]
    if (sensor["row_subdivision"], sensor["stripe_subdivision"]) != (1, 1):
        raise FigureError(f"{source.path}: its array is denser than the published 4 x 5 points")
    return sensor


def draw(sources, options):
    del options  # one sensor for all trials
    source = sources[0]
    source.require_drives()
    sensor = sensor_of(source)
    body = source.scenario["rover"]["geometry"]
    layout = Layout(sensor)
    points = layout.points()
    drawn = {"points": points, "emitters": layout.emitters, "cameras": layout.cameras,
             "seen": [layout.seen(camera) for camera in range(2)],
             "lit": [layout.lit(stripe) for stripe in range(STRIPES)]}
    figure, axes = style.new_figure(7.2, 4.6)
    rear = layout.front_m - body["length_m"]
    axes.plot(*box(rear, layout.front_m, 0.5 * body["width_m"]), color=style.INK, label="rover")
    far = max(x for x, _ in points) + 0.5
    _draw_sensor(axes, layout, drawn, far)
    _draw_points(axes, points)
    _draw_published(axes, layout, body["width_m"], sensor)
    side = max(y for _, y in points) + 2.0 * MARGIN_M
    axes.set(aspect="equal", xlim=(rear - MARGIN_M, far), ylim=(-side, side),
             xlabel="x, ahead of the chassis' centre (m)", ylabel="y, to the left (m)")
    axes.grid(False)
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3, fontsize=8)
    return Drawn(figure, _caption(source, sensor), drawn)


def box(rear, front, half_width):
    """A closed rectangle as lists of x and of y."""
    return ([rear, front, front, rear, rear], [half_width, half_width, -half_width, -half_width, half_width])


def _draw_sensor(axes, layout, drawn, far):
    for outline in drawn["seen"]:
        axes.plot(*zip(*outline, outline[0]), color=style.GREY, linewidth=0.9,
                  label="fields of view on flat ground" if outline is drawn["seen"][0] else None)
    for stripe, (near, most) in enumerate(drawn["lit"]):
        ends = [layout.emitters[stripe], layout.on_stripe(stripe, min(most, far))]
        axes.plot(*zip(*ends), color=style.VERMILION, linestyle=":", linewidth=0.8)
        lit = [layout.on_stripe(stripe, x) for x in (near, min(most, far))]
        axes.plot(*zip(*lit), color=style.VERMILION, linestyle=":", linewidth=1.8,
                  label="light planes; bold: light on the ground" if stripe == 0 else None)
    axes.plot(*zip(*layout.emitters), "^", color=style.VERMILION, markersize=4.5, zorder=5, label="emitters")
    axes.plot(*zip(*layout.cameras), "s", color=style.INK, markersize=4.5, zorder=5, label="cameras")


def _draw_points(axes, points):
    places = {True: [], False: []}
    for i, point in enumerate(points):
        places[is_published(i // STRIPES, i % STRIPES)].append(point)
    axes.plot(*zip(*places[True]), "o", color=style.BLUE, markersize=6, zorder=6,
              label="measured points: place published")
    axes.plot(*zip(*places[False]), "o", color=style.BLUE, fillstyle="none", markersize=6, zorder=6,
              label="measured points: place assumed")


def _draw_published(axes, layout, width_m, sensor):
    """The two lengths that section 6 gives, as arrows."""
    far_x, far_y = layout.far_points[0]
    look = {"arrowstyle": "<->", "color": style.BLUE, "linewidth": 0.9, "shrinkA": 0, "shrinkB": 0}
    aside = -DIMENSION_M  # beside the stripe, whose points it would hide
    axes.annotate("", (layout.front_m, aside), (far_x, aside), arrowprops=look)
    axes.plot([far_x] * 2, [0.0, aside], color=style.BLUE, linewidth=0.6, linestyle="--")
    axes.annotate(f"{100 * sensor['row_ahead_m'][-1]:.0f} cm (published)", (far_x, aside),
                  xytext=(5, -3), textcoords="offset points", fontsize=7.5, color=style.BLUE)
    axes.annotate("", (far_x, 0.5 * width_m), (far_x, far_y), arrowprops=look)
    axes.plot([layout.front_m, far_x], [0.5 * width_m] * 2, color=style.BLUE, linewidth=0.6, linestyle="--")
    axes.annotate(f"{100 * (far_y - 0.5 * width_m):.0f} cm (published)", (far_x, far_y),
                  xytext=(8, -10), textcoords="offset points", fontsize=7.5, color=style.BLUE)


def _caption(source, sensor):
    rows = ", ".join(f"{100 * ahead:.0f}" for ahead in sensor["row_ahead_m"])
    return (f"The light stripe sensor of {source.name} from above, in the manner of Matthies 1995, figure "
            "13, which is missing from the text that was at hand: drawn from the sensor's parameters, "
            "not from the figure. Published (section 6, table 3) are how far the middle stripe reaches "
            "ahead of the rover and the outermost ones beyond its sides (filled points, arrows; that all "
            "reach as far ahead is assumed), the "
            f"separation of the cameras ({100 * sensor['camera_separation_m']:.0f} cm), baselines of 5 "
            "to 10 cm from camera to emitter, optics and fan. Assumed is the rest: the places of the "
            f"other points (rows {rows} cm ahead of the front), where cameras and emitters sit "
            f"({100 * sensor['camera_height_m']:.0f} cm above the ground), and that the cameras look "
            f"{sensor['camera_pitch_deg']:.0f} deg down. Fields of view end at the edge of the drawing.")


FIGURES = (Figure(name="matthies1995-13", title="the light stripe sensor from above: what is published, what assumed",
                   runs="a run of drives with the light stripe sensor", accepts=(1, 1), draw=draw),)
