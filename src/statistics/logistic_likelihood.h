// The likelihood of a logistic curve and its maximum. Internal to the fits of this folder.
#pragma once

#include <span>
#include <vector>

#include "statistics/logistic_fit.h"

namespace rockyard::statistics {

// A setting on the scale of the fit.
struct Dose {
  double u = 0.0;
  double count = 0.0;
  double trials = 0.0;
};

double Transform(FitScale scale, double x);
double Inverse(FitScale scale, double u);
double Expit(double logit);

// Returns the settings ascending, equal ones pooled, those without trials left out.
std::vector<Dose> PoolDoses(std::span<const DosePoint> points, FitScale scale);

// logit = a + b (u - centre): a and b are nearly independent where the centre is that of the runs.
struct LogitLine {
  double a = 0.0;
  double b = 0.0;
  double centre = 0.0;

  double At(double u) const { return a + b * (u - centre); }
};

LikelihoodSlopes SlopesAt(std::span<const Dose> doses, const LogitLine& line);

// Which parameters a maximum is sought over; the others stay as they are.
enum class FreeParameters { kBoth, kIntercept, kSlope };

// Climbs by Newton's method from `line`, with steps halved that go too far, and returns the
// log-likelihood at its end. There must be a maximum.
double MaximizeLikelihood(std::span<const Dose> doses, FreeParameters free, LogitLine& line);

}  // namespace rockyard::statistics
