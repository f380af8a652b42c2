// Descent to a minimum of a fit's squared residuals: Gauss-Newton with numerical derivatives and
// Levenberg's damping.
#pragma once

#include <Eigen/Core>
#include <limits>

#include "vision/cylinder/fit_problem.h"

namespace rockyard::vision {

using FitInformation = Eigen::Matrix<double, 6, 6>;

struct FitState {
  FitUnknowns unknowns = FitUnknowns::Zero();
  double squares = std::numeric_limits<double>::infinity();  // infinite where nothing is imaged
  // Of the unknowns, by the derivatives before the last step.
  FitInformation information = FitInformation::Identity();
  FitProblem::Evaluation evaluation;  // at the unknowns
};

// Whether a descent may change the radius, beside the place across and along the view, theta, the
// roll and the blur.
enum class FitRadius { kFixed, kFree };

// The standard deviation of the radius's prior over the cylinder's own.
double RadiusDeviation(FitRadius radius);

// At most `most_steps` steps from a start, fewer where the squares no longer fall.
FitState DescendFrom(const FitProblem& problem, const FitUnknowns& start, FitRadius radius,
                     int most_steps);

}  // namespace rockyard::vision
