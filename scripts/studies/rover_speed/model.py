"""How fast a rover gets on, in closed form: what its computer, cameras, estimator and navigator leave of its wheels.

A rover that stops to look (Matthies 1995, section 2.1.2: one activity at a time) takes for a metre

    t = 1 / v + (o + s + L) / d + W / w                                                     (1)

    v  speed of its wheels                      d  way between two looks, or moves
    o  overhead of a move, s steering at rest   w  way between two poses by visual odometry
    L  a look: I + S + N by stereo (images, stereo, map and votes), Q + N by light stripe (scan), 0 where it is blind
    W  a pose: I + V by visual odometry (its own images, features to motion), 0 by wheels

A rover that does not stop takes images once a fraction f of a motion of length d is done; its plan is ready C = L + W
later and replaces the motion. It goes on meanwhile, as far as the motion leads, and stands from there until the plan
is ready:

    way of a cycle     g = min(d, f d + v C)                                                (2)
    time of a cycle    P = f d / v + C + s                                                  (3)
    speed              u = g / P                                                            (4)

where s is the time at rest in which wheels are steered: that of CSOD, 0 for CSAD (Howard 2012 section 2). One
processor computes everything, one after the other. Speeds go along the path: detours, turns in place, slower curves,
slip and climbing are left out, so that (1) and (4) are what a rover gets at most.
"""

import math
from dataclasses import dataclass, replace

import study

M_PER_H = 3600.0


@dataclass(frozen=True)
class Times:
    """What the computer and the sensors take, s."""
    images: float
    stereo: float
    navigation: float
    visual: float
    scan: float = 20.0  # light stripe of MFEX, whichever computer (Matthies 1995 section 6)


@dataclass(frozen=True)
class Rover:
    """Wheels and moves."""
    speed_m_s: float
    step_m: float            # d
    pose_m: float            # w
    overhead_s: float = 0.0  # o
    steering_s: float = 0.0  # s
    fraction: float = 0.5    # f


STOPS = ("blind", "stop")          # equation 1
CONTINUOUS = ("csod", "csad")      # equations 2 to 4
STRIPE_STEP_M = 0.065              # a scan every wheel radius (Matthies 1995 section 6)


def look_s(times, sensor):
    """L: a look at the terrain."""
    return times.navigation + (times.scan if sensor == "stripe" else times.images + times.stereo)


def pose_s(times, estimator):
    """W: a pose."""
    return times.images + times.visual if estimator == "vision" else 0.0


def stopping_speed(rover, times, navigator, sensor, estimator):
    """Equation 1, m/s."""
    step_m, at_rest_s = rover.step_m, rover.overhead_s
    if navigator != "blind":
        step_m = STRIPE_STEP_M if sensor == "stripe" else rover.step_m
        at_rest_s += rover.steering_s + look_s(times, sensor)
    return 1.0 / (1.0 / rover.speed_m_s + at_rest_s / step_m + pose_s(times, estimator) / rover.pose_m)


def continuous_speed(rover, times, navigator, estimator):
    """Equations 2 to 4, m/s."""
    latency_s = look_s(times, "stereo") + pose_s(times, estimator)
    steering_s = rover.steering_s if navigator == "csod" else 0.0
    before_m = rover.fraction * rover.step_m
    way_m = min(rover.step_m, before_m + rover.speed_m_s * latency_s)
    return way_m / (before_m / rover.speed_m_s + latency_s + steering_s)


def speed(rover, times, navigator, sensor="stereo", estimator="wheels"):
    """m/s along the path."""
    if navigator in STOPS:
        return stopping_speed(rover, times, navigator, sensor, estimator)
    if sensor != "stereo":
        raise ValueError(f"{navigator} with {sensor}: a light stripe scan stops the rover")
    return continuous_speed(rover, times, navigator, estimator)


def wheels_for(rover, times, wanted_m_s, navigator, sensor="stereo", estimator="wheels"):
    """The least speed of the wheels with which a rover gets that far, m/s; infinite where none does."""
    def reaches(speed_m_s):
        return speed(replace(rover, speed_m_s=speed_m_s), times, navigator, sensor, estimator) >= wanted_m_s
    low, high = wanted_m_s, 1e3
    if not reaches(high):
        return math.inf
    for _ in range(100):
        middle = math.sqrt(low * high)
        low, high = (low, middle) if reaches(middle) else (middle, high)
    return high


@dataclass(frozen=True)
class Range:
    """A value with its ends; a factor on a time where `value` is 1."""
    value: float
    low: float
    high: float


@dataclass(frozen=True)
class Computer:
    """A profile of the program (src/trial/clock/compute_profile.h), and how well its times are known, as factors."""
    profile: str
    name: str
    width_px: int
    stereo: Range
    navigation: Range
    visual: Range


SURE = Range(1, 1, 1)
ROOT_TEN = Range(1, 10 ** -0.5, 10 ** 0.5)       # an order of magnitude, instructions or clock
TWO_ORDERS = Range(1, 10 ** -(0.5 ** 0.5), 10 ** (0.5 ** 0.5))  # two of them: their logarithms' squares add up
PRINTED_STEREO = Range(1, 24 / 27, 30 / 27)      # 24 to 30 s (Howard 2012 section 3)
PRINTED_VISUAL = Range(1, 120 / 160, 180 / 160)  # two to three minutes (section 1)
UP_TO_ROOT_TEN = Range(1, 1, 10 ** 0.5)          # flown stereo took four times as long as table 3's
COMPUTERS = (
    Computer("mer_rad6000", "RAD6000, 20 MHz (MER)", 256, PRINTED_STEREO, UP_TO_ROOT_TEN, PRINTED_VISUAL),
    Computer("msl_rad750", "RAD750, 200 MHz (MSL)", 256, PRINTED_STEREO, ROOT_TEN, PRINTED_VISUAL),
    Computer("powerpc_750_133mhz", "PowerPC 750, 133 MHz", 256, ROOT_TEN, ROOT_TEN, ROOT_TEN),
    Computer("powerpc_g4_500mhz", "PowerPC G4, 500 MHz", 256, TWO_ORDERS, TWO_ORDERS, TWO_ORDERS),
    # What is left to the processor, 0.05 to 10 s on a RAD6000 and up to 0.2 s (5 Hz) on a Pentium.
    Computer("virtex_5_fpga", "Virtex 5 beside a RAD6000", 256, SURE, UP_TO_ROOT_TEN, Range(1, 0.66, 100)),
    Computer("athena_2012", "Virtex 4, Pentium M (Athena 2012)", 512, Range(1, 1, 2), ROOT_TEN, Range(1, 0.66, 2.32)),
    Computer("sapphire_rapids_core", "one core of 2026", 512, Range(1, 1, 10), Range(1, 1, 10), Range(1, 1, 10)),
)

SLOW_CAMERAS = Range(8.974, 0.5, 10.0)  # Athena SDM (Goldberg 2002 table 2); range of clock.compute.acquisition_s
FAST_CAMERAS = Range(0.1, 1 / 15, 0.2)  # 5 to 15 Hz, assumed


def read_times(path):
    """Rows of compute_times.csv by profile and width."""
    return {(row["computer"], int(row["width_px"])): row for row in study.read_csv(path)}


def times_of(rows, computer, cameras, end="value"):
    """Times of a computer, in the middle or at an end (`low`: all fast, `high`: all slow) of what is known."""
    row = rows[computer.profile, computer.width_px]
    return Times(images=getattr(cameras, end),
                 stereo=float(row["stereo_s"]) * getattr(computer.stereo, end),
                 navigation=float(row["navigation_s"]) * getattr(computer.navigation, end),
                 visual=float(row["visual_s"]) * getattr(computer.visual, end))


@dataclass(frozen=True)
class RoverCase:
    """A rover in the middle and with what makes it slow and fast."""
    name: str
    middle: Rover
    slow: Rover
    fast: Rover

    def at(self, end):
        return {"value": self.middle, "low": self.fast, "high": self.slow}[end]


# Spirit and Opportunity. 3.7 cm/s is the fastest straight drive that was ever commanded (Guinness World Records 2022,
# "Land speed record on Mars", which has 5 cm/s for the wheels); 75 cm are the longest motion with GESTALT and visual
# odometry (Howard 2012 section 1). Assumed: nothing at rest beside the looks, at most the 7.4 s a move of the Athena
# SDM; steps of 35 cm (Goldberg 2002 section 4) to 75 cm; no time for steering, at most 1.5 s.
MER = RoverCase("MER's rover",
                Rover(0.037, 0.75, 0.75),
                Rover(0.037, 0.35, 0.6, overhead_s=7.4, steering_s=1.5),
                Rover(0.05, 0.75, 0.75))

# Athena of 2012: 7 cm/s at most (Howard 2012 section 3). Assumed: motions of 75 cm (35 to 75), planned anew after half
# of them; 10 deg to steer (none to 30) at the 20 deg/s of scenarios/rovers/athena_sdm.json, and 0.2 s of ramps.
ATHENA = RoverCase("a rover of 7 cm/s",
                   Rover(0.07, 0.75, 0.75, steering_s=0.7),
                   Rover(0.07, 0.35, 0.35, steering_s=1.7),
                   Rover(0.07, 0.75, 0.75, steering_s=0.2))


FRACTIONS = (0.25, 0.5, 0.75)  # of a motion that is done when the next one is planned; assumed, not published


def speed_range(case, rows, computer, cameras, navigator, sensor="stereo", estimator="wheels"):
    """Speed in the middle, and the least and most with everything slow or fast and any of FRACTIONS, m/h."""
    def at(end, fraction):
        rover = replace(case.at(end), fraction=fraction)
        return M_PER_H * speed(rover, times_of(rows, computer, cameras, end), navigator, sensor, estimator)
    ends = [at(end, fraction) for end in ("low", "high") for fraction in FRACTIONS]
    return Range(at("value", case.middle.fraction), min(ends), max(ends))
