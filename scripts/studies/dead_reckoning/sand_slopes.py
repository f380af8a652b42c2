"""Errors of dead reckoning along runs, and the slopes of their variance, as Matthies 1995, section 5, has them.

"Error in heading and total distance traveled was estimated as the difference between the deadreckoned
estimates and those measured by the overhead tracking system", over twenty runs of some 7 m (figure 5), and
the slope is that of the best fit. Which line was fitted is not said: both are here.
"""

import csv
import math

RUNS = 20      # behind figure 5
STEP_M = 0.25  # of the distances at which the variance is taken


def course_of(rows, step_m=STEP_M):
    """Errors (heading in deg, distance in m) every `step_m` of true way: believed less true.

    `rows` are those of `rockyard trace --csv`. Between two samples errors are interpolated.
    """
    errors, target = [], step_m
    before = (0.0, 0.0, 0.0, 0.0, 0.0)  # way, x, y, errors of heading and distance
    for row in rows:
        if row["row"] != "sample":
            continue
        x, y = float(row["true_x_m"]), float(row["true_y_m"])
        way = before[0] + math.hypot(x - before[1], y - before[2])
        turn = float(row["believed_heading_rad"]) - float(row["true_heading_rad"])
        heading = math.degrees(math.remainder(turn, 2.0 * math.pi))
        distance = float(row["odometer_m"]) - way
        while way >= target:
            share = (target - before[0]) / (way - before[0])
            errors.append((before[3] + share * (heading - before[3]),
                           before[4] + share * (distance - before[4])))
            target += step_m
        before = (way, x, y, heading, distance)
    return errors


def read_course(path, step_m=STEP_M):
    with open(path, encoding="utf-8", newline="") as file:
        return course_of(csv.DictReader(file), step_m)


def read_courses(folder, step_m=STEP_M):
    """Courses of a run that was made with --traces all --trace-format csv, by trial."""
    paths = sorted((folder / "traces").glob("trial-*.csv"))
    return [read_course(path, step_m) for path in paths]


def variances(courses, which):
    """Variance over the runs (about their mean) at every distance that all of them reach.

    `which`: 0 for the heading, 1 for the distance.
    """
    result = []
    for index in range(min(len(course) for course in courses)):
        values = [course[index][which] for course in courses]
        mean = sum(values) / len(values)
        result.append(sum((value - mean) ** 2 for value in values) / (len(values) - 1))
    return result


def slope_through_origin(values, step_m=STEP_M):
    """Of the line y = b x by least squares."""
    x = [step_m * (index + 1) for index in range(len(values))]
    return sum(a * b for a, b in zip(x, values)) / sum(a * a for a in x)


def slope_free(values, step_m=STEP_M):
    """Of the line y = a + b x by least squares."""
    n = len(values)
    x = [step_m * (index + 1) for index in range(n)]
    x_mean, y_mean = sum(x) / n, sum(values) / n
    return (sum((a - x_mean) * (b - y_mean) for a, b in zip(x, values)) /
            sum((a - x_mean) ** 2 for a in x))


def exponent(values, step_m=STEP_M):
    """p of y = b x^p by least squares of logarithms: 1 for noise a metre, 2 for a scale error."""
    x = [math.log(step_m * (index + 1)) for index in range(len(values))]
    y = [math.log(value) for value in values]
    x_mean, y_mean = sum(x) / len(x), sum(y) / len(y)
    return (sum((a - x_mean) * (b - y_mean) for a, b in zip(x, y)) /
            sum((a - x_mean) ** 2 for a in x))
