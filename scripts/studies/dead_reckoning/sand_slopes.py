"""Errors of dead reckoning along runs, and the slopes of their variance, as Matthies 1995, section 5, has them.

"Error in heading and total distance traveled was estimated as the difference between the deadreckoned
estimates and those measured by the overhead tracking system", over twenty runs of some 7 m (figure 5), and
the slope is that of the best fit. Which line was fitted is not said: both are here.
"""

import numpy as np
from study import ry

RUNS = 20      # behind figure 5
STEP_M = 0.25  # of the distances at which the variance is taken


def course_of(trace, step_m=STEP_M):
    """Errors (heading in deg, distance in m) every `step_m` of true way: believed less true, between moments interpolated."""
    way_m = np.cumsum(np.hypot(*np.diff(trace["position_m"][:, :2], axis=0, prepend=0.0).T))
    at_m = step_m * np.arange(1, int(way_m[-1] / step_m) + 1)
    errors = np.degrees(trace["heading_error_rad"]), trace["believed"][:, 3] - way_m
    return np.transpose([np.interp(at_m, np.append(0.0, way_m), np.append(0.0, error)) for error in errors])


def read_courses(run):
    """Courses of a run that was made with --traces all, by trial."""
    return [course_of(ry.Trace(file)) for file in run.stored_traces]


def variances(courses, which):
    """Variance over the runs (about their mean) at every distance that all of them reach.

    `which`: 0 for the heading, 1 for the distance.
    """
    least = min(map(len, courses))
    return np.var([course[:least, which] for course in courses], axis=0, ddof=1)


def distances(values):
    return STEP_M * np.arange(1, len(values) + 1)


def slope_through_origin(values):
    """Of the line y = b x by least squares."""
    x = distances(values)
    return x @ values / (x @ x)


def slope_free(values):
    """Of the line y = a + b x by least squares."""
    return np.polyfit(distances(values), values, 1)[0]


def exponent(values):
    """p of y = b x^p by least squares of logarithms: 1 for noise a metre, 2 for a scale error."""
    return np.polyfit(np.log(distances(values)), np.log(values), 1)[0]
