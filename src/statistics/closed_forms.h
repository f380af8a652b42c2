// Arithmetic that a publication does in its text, so that it can be done again: chances, rates,
// power laws, and how far dead reckoning along a straight line goes wrong. Comparisons with
// published values compute by it the values of StatisticKind::kComputed. No record depends on it,
// but whether such a value `holds` or `differs`, and so the exit code of a check, does.
#pragma once

#include <span>

#include "statistics/published_values.h"

namespace rockyard::statistics {

// A straight drive by dead reckoning, after the state equations of Matthies 1995, section 5: steps
// of length s, each wrong by N(0, r s), and after each a turn wrong by N(0, q s), with the
// variances r of the distance and q of the heading a metre. Beside them stands a scale error N(0,
// c^2) that a run keeps. All errors are independent.
struct StraightDrift {
  double step_m = 0.0;      // length of a step
  double distance_m = 0.0;  // taken as the nearest number of whole steps
  double distance_variance_m2_per_m = 0.0;
  double heading_variance_deg2_per_m = 0.0;
  double scale_deviation = 0.0;
};

// Errors at the end of a drive, believed less true. The means of across and heading are 0.
struct DriftMoments {
  double along_bias_m = 0.0;
  double along_m = 0.0;  // standard deviations
  double across_m = 0.0;
  double heading_deg = 0.0;
};

// Returns the exact moments of the walk in steps, to every order in the heading: it may turn right
// round. DriftMoments::heading_deg is the deviation of the sum of all turns, which does not wrap.
// Cost: the number of steps. Needs step_m > 0 and at least one step.
DriftMoments ExactMoments(const StraightDrift& drift);

// Returns the chance that at least one of n independent events of chance p happens: 1 - (1 - p)^n.
// With one point of 20 in a hundred found in a wrong place it is Matthies 1995, section 6: one
// false alarm in five scans.
double AnyOf(double p, double n);

// Returns the distance per time with a scan after every step, m/s: step / (step / speed + scan
// time).
double NetRate(double step_m, double speed_m_s, double scan_time_s);

// Returns the range that one pixel stands for, m: pitch range^2 / baseline (Matthies 1995 eq. 2,
// differentiated).
double RangeResolution(double pitch_rad, double range_m, double baseline_m);

// Returns how many things of size d and larger there are where their number is k d^-m: of rocks,
// Matthies 1995 eq. 4, per m2 for d in m.
double PowerLaw(double k, double size, double exponent);

// Returns the share of the ground under circles of diameter d and larger, up to any size, where
// there are k d^-m of them per unit area: pi/4 k m / (m - 2) d^(2 - m). Needs m > 2.
double PowerLawCover(double k, double diameter, double exponent);

// Returns how many numbers a formula takes; 0 means any number of them, at least one.
std::size_t FormulaArity(Formula formula);

// Whether a formula has a value for as many inputs as it takes.
bool InDomain(Formula formula, std::span<const double> inputs);

// Returns the formula's value. There must be as many `inputs` as FormulaArity says, InDomain.
double Evaluate(Formula formula, std::span<const double> inputs);

}  // namespace rockyard::statistics
