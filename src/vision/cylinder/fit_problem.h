// The residuals of a place of the cylinder against the profiles of both eyes, and the descent to a
// minimum of their squares.
#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "vision/cylinder/colour_model.h"
#include "vision/cylinder/cylinder_fit.h"
#include "vision/cylinder/wall_colours.h"

namespace rockyard::vision {

// Across the view to the right, along it (m, from the start), theta, roll (rad), the radius over
// the cylinder's less 1, and the logarithm of the blur over edge_blur_px.
using FitUnknowns = Eigen::Matrix<double, 6, 1>;

class FitProblem {
 public:
  // Starts where lines of sight to the middles of the candidate's boxes meet.
  FitProblem(const ColourPair& pair, const EyeGeometry& eyes, const ColourCylinder& cylinder,
             const RegionPair& candidate, const LogRatios& light, const RobustFinderParams& params);

  CylinderPlace PlaceOf(const FitUnknowns& unknowns) const;

  // The standard deviation of the blur of edges.
  double BlurOf(const FitUnknowns& unknowns) const;

  // What the eyes show of a place.
  struct Evaluation {
    // Residuals over their standard deviations, of equal number for all places: of the pixels, of
    // the quadrants' colours, and, the last three, of the priors of the blur, of the roll and,
    // about 0, of the radius with sd `radius_sd`.
    Eigen::VectorXd residuals;
    // The squares of those of the colours: how unlike those of the surfaces, and each other's, what
    // the eyes see is (colour_model.h).
    double colour_misfit = 0.0;
  };

  // Nothing where the place cannot be imaged.
  std::optional<Evaluation> Evaluate(const FitUnknowns& unknowns, double radius_sd) const;

  // Steps of numerical derivatives: some hundredths of a pixel each.
  FitUnknowns Steps() const;

  // Samples of pixels among the residuals.
  int samples() const { return samples_; }

  const std::array<EyeProfile, 2>& profiles() const { return profiles_; }

  // The start moved up or down to the rows of the rims, and the wall's height there.
  double height_m() const { return height_m_; }

 private:
  // Moves the start to the middle of the rims.
  void TakeRows();

  std::array<const CameraModel*, 2> cameras_;
  const EyeGeometry& eyes_;
  const ColourCylinder& cylinder_;
  LogRatios light_;
  const RobustFinderParams& params_;
  QuadrantDirections directions_;
  std::array<EyeProfile, 2> profiles_;
  math::Vector3 start_L_;
  double depth_m_;
  double height_m_ = 0.0;
  int samples_ = 0;
};

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

// Gauss-Newton with numerical derivatives and Levenberg's damping: at most `most_steps` steps from
// a start, fewer where the squares no longer fall.
FitState DescendFrom(const FitProblem& problem, const FitUnknowns& start, FitRadius radius,
                     int most_steps);

}  // namespace rockyard::vision
