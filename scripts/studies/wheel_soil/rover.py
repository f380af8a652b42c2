"""A rover of four wheels up a slope, by planar statics and a slip that all wheels share."""

import numpy as np

WHEELBASE_M, CENTRE_M = 1.3, 0.6  # assumed; the page shows how little they matter
SLIPS = (0.2, 0.4, 0.6, 0.8)
TOLERANCE_DEG = 2.0


def slope_deg(wheel, weight_N, slip, levers=True):
    """The slope that is climbed at a slip: the angle where four wheels pull as much as the weight does. NaN where
    they do not even pull on level ground."""
    def surplus(angle_rad):
        normal_N, down_N = weight_N * np.cos(angle_rad), weight_N * np.sin(angle_rad)
        shift_N = down_N * CENTRE_M / WHEELBASE_M if levers else 0.0
        loads_N = np.array([0.5 * normal_N - shift_N, 0.5 * normal_N + shift_N]) / 2.0  # a wheel in front, behind
        return 2.0 * wheel.steady(np.maximum(loads_N, 1e-3 * weight_N), slip)["pull_N"].sum() - down_N

    low, high = 0.0, np.radians(44.0)
    if surplus(low) < 0.0:
        return float("nan")
    for _ in range(40):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if surplus(middle) > 0.0 else (low, middle)
    return float(np.degrees(0.5 * (low + high)))


def crossing_deg(slopes, slips, slip):
    """The slope at which a measured curve crosses a slip, by straight lines between its points."""
    return float(np.interp(slip, slips, slopes))
