"""A navigator of one's own as a process in Python: standard library only, Python 3.9 or later.

    class Mine(Navigator):
        name, doc, version = "mine", "drives straight ahead", "1.0"
        parameters = [parameter("goal_tolerance_m", "real", 0.3, "arrives within", min=0, max=5)]
        def decide(self, input):
            return drive(until_distance_m=1.0)
    run(Mine)

    rockyard run nominal --navigator-process "python3 mine.py"

SI units, radians. Members that a message lacks are None. A trial has to repeat bit for bit: read no
clock, and seed random numbers by setup.random_seed. What is printed is shown where the navigator
fails. docs/navigators.md has the messages.
"""
import base64
import json
import struct
import traceback


class Values(dict):
    """A JSON object whose members are attributes, too."""
    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return self.get(name)


class Parameters(Values):
    """The same, of which all members are declared."""
    def __getattr__(self, name):
        if name in self:
            return self[name]
        raise AttributeError(f"no parameter {name} is declared: there are {', '.join(self)}")


def parameter(name, kind, default, doc, **more):
    """Declares a parameter; `more`: min, max, study, origin, source, choices, parameters."""
    return {"name": name, "type": kind, "default": default, "doc": doc, **more}


# Decisions. What asks again earlier than events do stands in "until".
def drive(curvature_per_m=0.0, until_distance_m=None, direction=1, speed_share=1.0, near_goal_m=0.0):
    """Drives an arc; positive curvatures turn left, direction -1 backs off. Distances of None have no end."""
    return {"motion": {"kind": "arc", "curvature_per_m": curvature_per_m, "direction": direction,
                       "speed_share": speed_share},
            "until": {"distance_m": until_distance_m, "near_goal_m": near_goal_m}}

def turn(direction, turn_rad):
    """Turns in place, +1 to the left, until the heading is another one by turn_rad."""
    return {"motion": {"kind": "turn", "direction": direction}, "until": {"turn_rad": turn_rad}}

def look(direction="ahead"):
    """Stops and looks; the next input carries what was seen."""
    return {"look": direction}

def rest(period_s):
    """Stands so long."""
    return {"motion": {"kind": "stop"}, "until": {"period_s": period_s}}

def arrived():
    """Says that the goal is reached, which ends the drive."""
    return {"status": "arrived"}

def gave_up():
    """Says that there is no way, which ends the drive."""
    return {"status": "gave_up"}


class Navigator:
    """One object drives one trial. self.p: parameters; self.goal; self.own: own values by name."""
    name, doc, version = "", "", "1"
    parameters = []  # of parameter()
    own_values = []  # of (name, unit, meaning): columns of the record

    def traits(self):
        """What a trial has to know beside decisions."""
        return {"reads": "nothing", "cost": {"kind": "look", "time_s": 0.0},
                "goal_tolerance": {"parameter": "goal_tolerance_m", "value_m": self.p.goal_tolerance_m}}

    def start(self, setup):
        """Begins a drive."""
    def decide(self, input):
        """Returns a decision."""
        raise NotImplementedError("decide()")
    def jump(self, corrected, before, after):
        """The estimate was corrected; or else operators have moved the rover."""
    def set_goal(self, goal, moved):
        """The goal is the next one; `moved`: the same, seen elsewhere."""
    def overlay(self):
        """Returns {"lines": [...], "grids": [...]} for replays. No decision may depend on it."""
        return {}


def _answer(cls, navigator, ask):
    """Returns the answer to a message, and the navigator that the next one is for."""
    if ask.type == "describe":
        own = [dict(zip(("name", "unit", "meaning"), value)) for value in cls.own_values]
        return {"protocol": 1, "name": cls.name, "doc": cls.doc, "version": cls.version,
                "parameters": cls.parameters, "own_values": own}, navigator
    if ask.type in ("traits", "start"):
        made = cls()
        made.p = Parameters(ask.parameters)
        if ask.type == "traits":
            return made.traits(), navigator
        made.goal, made.own = ask.setup.goal, {value[0]: 0 for value in cls.own_values}
        made.start(ask.setup)
        return {}, made
    if ask.type == "decide":
        for eye in (ask.images.left, ask.images.right) if ask.images else ():
            eye["grey"] = base64.b64decode(eye.grey)  # bytes, row by row from the upper left
        decision = navigator.decide(ask)
        if decision is None:
            raise TypeError("decide() returned None")
        return {**decision, "own_values": list(navigator.own.values())}, navigator
    if ask.type == "jump":
        navigator.jump(ask.corrected, ask.before, ask.after)
    elif ask.type == "goal":
        navigator.goal = ask.goal
        navigator.set_goal(ask.goal, ask.moved)
    return (navigator.overlay() if ask.type == "overlay" else {}), navigator


def reply(cls, navigator, text, show=traceback.print_exc):
    """Returns the text of the answer to a message, and the navigator that the next one is for. `show` is
    called where the navigator raises something."""
    try:
        ask = json.loads(text, object_hook=Values, parse_constant=lambda _: None)
        answer, navigator = _answer(cls, navigator, ask)
        return json.dumps({**answer, "id": ask.id}, allow_nan=False).encode(), navigator
    except Exception as error:  # the drive ends with its text
        show()
        at = traceback.extract_tb(error.__traceback__)[-1]
        told = f"{type(error).__name__}: {error} ({at.filename}:{at.lineno})"
        return json.dumps({"error": told}).encode(), navigator


def run(cls):
    """Serves the navigator until rockyard closes its end."""
    navigator = None
    with open(3, "rb") as requests, open(4, "wb") as answers:
        while len(size := requests.read(4)) == 4:
            data, navigator = reply(cls, navigator, requests.read(struct.unpack("<I", size)[0]))
            answers.write(struct.pack("<I", len(data)) + data)
            answers.flush()
